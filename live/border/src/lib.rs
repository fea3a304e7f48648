//! What a page calls in its WebAssembly module.
//!
//! A module is a program: the page calls its `main`, which hands a [`Session`] to [`serve`]. From
//! then on the page calls the functions here. Numbers and texts are read from the memory of the
//! module: a function leaves them in one place, and says where that is.
//!
//! Of a function that returns a [`u32`], 0 means done. 1 means refused: [`holonom_text`] is then
//! the reason.

use std::cell::{Cell, RefCell};

/// What a page shows and moves.
pub trait Session {
    /// Sliders and the step, as JSON.
    fn controls(&self) -> String;
    /// What is drawn, as the viewer of `holonom-film` reads it.
    ///
    /// # Errors
    /// Why it cannot be drawn.
    fn scene(&self) -> Result<String, String>;
    /// Moves a slider.
    ///
    /// # Errors
    /// Why the value is refused. Everything is then as before.
    fn set(&mut self, control: usize, value: f64) -> Result<(), String>;
    /// Begins anew with the present values.
    ///
    /// # Errors
    /// Why there is no start. Everything is then as before.
    fn restart(&mut self) -> Result<(), String>;
    /// Takes steps.
    ///
    /// # Errors
    /// Why a step could not be taken. The state is the last good one.
    fn advance(&mut self, steps: usize) -> Result<(), String>;
    /// The numbers of the present state.
    fn numbers(&self, numbers: &mut Vec<f64>);
}

/// What is served: a session, or why there is none.
type Served = Result<Box<dyn Session>, String>;

thread_local! {
    static SERVED: RefCell<Option<Served>> = const { RefCell::new(None) };
    static NUMBERS: RefCell<Vec<f64>> = const { RefCell::new(Vec::new()) };
    static TEXT: RefCell<String> = const { RefCell::new(String::new()) };
    /// How often `serve` was called: a program serves once.
    static CALLS: Cell<u32> = const { Cell::new(0) };
}

/// Serves a session to the page that called `main`, or tells it why there is none. A second call in
/// one program is refused.
pub fn serve(served: Served) {
    CALLS.set(CALLS.get() + 1);
    let second = "the program makes two pages: a module has one".to_owned();
    let served = if CALLS.get() > 1 { Err(second) } else { served };
    SERVED.set(Some(served));
    // A panic ends the module. What it says stays to be read.
    #[cfg(target_arch = "wasm32")]
    std::panic::set_hook(Box::new(|panic| TEXT.set(panic.to_string())));
}

/// Calls with the session; leaves the reason where there is none, or where it is refused.
fn with<T>(call: impl FnOnce(&mut dyn Session) -> Result<T, String>) -> Option<T> {
    let result = SERVED.with_borrow_mut(|served| match served {
        Some(Ok(session)) => call(&mut **session),
        Some(Err(reason)) => Err(reason.clone()),
        None => Err("the program made no page".to_owned()),
    });
    result.map_err(|reason| TEXT.set(reason)).ok()
}

fn code(done: Option<()>) -> u32 {
    u32::from(done.is_none())
}

/// Leaves sliders and the step, as JSON, for [`holonom_text`].
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn holonom_controls() -> u32 {
    code(with(|session| Ok(session.controls())).map(|text| TEXT.set(text)))
}

/// Leaves what is drawn, as JSON, for [`holonom_text`].
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn holonom_scene() -> u32 {
    code(with(|session| session.scene()).map(|text| TEXT.set(text)))
}

/// Moves a slider.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn holonom_set(control: u32, value: f64) -> u32 {
    code(with(|session| session.set(control as usize, value)))
}

/// Begins anew with the present values.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn holonom_restart() -> u32 {
    code(with(|session| session.restart()))
}

/// Takes steps.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn holonom_advance(steps: u32) -> u32 {
    code(with(|session| session.advance(steps as usize)))
}

/// Leaves the numbers of the present state; where they are, until the next call.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn holonom_numbers() -> *const f64 {
    NUMBERS.with_borrow_mut(|numbers| {
        numbers.clear();
        let _ = with(|session| {
            session.numbers(numbers);
            Ok(())
        });
        numbers.as_ptr()
    })
}

/// How many numbers were left.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn holonom_numbers_length() -> usize {
    NUMBERS.with_borrow(Vec::len)
}

/// Where the text is that was left last, in UTF-8, until the next call.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn holonom_text() -> *const u8 {
    TEXT.with_borrow(|text| text.as_ptr())
}

/// How many bytes the text has.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn holonom_text_length() -> usize {
    TEXT.with_borrow(String::len)
}
