//! The page, and the film that it shows until its module runs.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::{env, fs};

use holonom::Mechanism;
use holonom::dynamics::Solvable;
use holonom::run::Steps;

use crate::error::LiveError;
use crate::module;
use crate::session::Session;
use crate::settings::Live;

/// Frames of the film.
const FRAMES: f64 = 120.0;

/// Whether this program has made its page.
static MADE: AtomicBool = AtomicBool::new(false);

impl<M, P, K> Live<M, P, K>
where
    M: Mechanism,
    P: Solvable<Number = f64, Mechanism = M, Forces: Clone> + 'static,
    K: Steps<P> + Copy + 'static,
{
    /// Writes the page to a file, and makes its folder. The program is compiled once more for
    /// WebAssembly, in the profile in which it runs, by the cargo that started it.
    ///
    /// In the module itself it serves the mechanism to the page. So call it last, and once.
    ///
    /// # Errors
    /// A setting or a start that is refused; why the module or the page cannot be made.
    pub fn page(self, file: impl AsRef<Path>) -> Result<(), LiveError> {
        if cfg!(target_arch = "wasm32") {
            return self.serve();
        }
        if MADE.swap(true, Ordering::Relaxed) {
            return Err(LiveError::Second);
        }
        let (session, file) = (self.session()?, file.as_ref());
        // The compiler takes a while: first what does not.
        if let Some(folder) = file.parent() {
            fs::create_dir_all(folder).map_err(|reason| LiveError::Write {
                file: file.into(),
                reason,
            })?;
        }
        write(session, file, &module::built()?)
    }

    /// Writes the page with a module that was compiled elsewhere: the whole file, of this program.
    ///
    /// # Errors
    /// As [`Live::page`]; [`LiveError::NoModule`].
    pub fn page_with(self, file: impl AsRef<Path>, module: &[u8]) -> Result<(), LiveError> {
        if cfg!(target_arch = "wasm32") {
            return self.serve();
        }
        write(self.session()?, file.as_ref(), module)
    }

    fn serve(self) -> Result<(), LiveError> {
        let served = match self.session() {
            Ok(session) => Ok(Box::new(session) as Box<dyn holonom_live_border::Session>),
            Err(error) => Err(error.to_string()),
        };
        holonom_live_border::serve(served);
        Ok(())
    }
}

/// Writes the page of a session that is at its start.
fn write<M, P, K>(session: Session<M, P, K>, file: &Path, module: &[u8]) -> Result<(), LiveError>
where
    M: Mechanism,
    P: Solvable<Number = f64, Mechanism = M, Forces: Clone>,
    K: Steps<P> + Copy,
{
    let module = module::stripped(module).ok_or(LiveError::NoModule)?;
    let page = session.film()?.html_with_module(&module)?;
    let failed = |reason| LiveError::Write {
        file: file.into(),
        reason,
    };
    fs::write(file, &page).map_err(failed)?;
    let shown = env::current_dir().map_or(file.into(), |folder| folder.join(file));
    println!("{}: {} kB", shown.display(), page.len() / 1000);
    Ok(())
}

impl<M, P, K> Session<M, P, K>
where
    M: Mechanism,
    P: Solvable<Number = f64, Mechanism = M, Forces: Clone>,
    K: Steps<P> + Copy,
{
    /// The film of the first seconds. A fault ends it, and is its warning.
    fn film(mut self) -> Result<holonom_film::Film<M>, LiveError> {
        let mut film = self.drawn();
        let all = (self.preview() / self.step()).max(0.0);
        let steps = (all / FRAMES).ceil().max(1.0);
        for _ in 0..(all / steps) as usize {
            if self.advance(steps as usize).is_err() {
                break;
            }
            self.record(&mut film);
        }
        Ok(film)
    }
}
