//! What the studies print, and how far they are.

use std::error::Error;
use std::io::{self, Write as _};
use std::path::PathBuf;
use std::time::Duration;

use holonom_study::document::Document;
use indicatif::{HumanDuration, ProgressBar, ProgressStyle};

use crate::terminal;

/// Prints a document, writes its files and prints their names.
///
/// # Errors
/// What cannot be drawn or written.
pub fn show_all<E: Error + 'static>(
    document: &Document,
    write: impl FnOnce() -> Result<Vec<PathBuf>, E>,
) -> Result<(), Box<dyn Error>> {
    show(&terminal::text(document, terminal::width())?)?;
    for path in write()? {
        show(&format!("\n{}", path.display()))?;
    }
    show("\n")?;
    Ok(())
}

/// Says what is going to be measured, and how long that takes.
pub fn announce(what: &str, time: Duration) {
    let seconds = time.as_secs().max(1);
    eprintln!(
        "study: {what}: {}",
        HumanDuration(Duration::from_secs(seconds))
    );
}

/// A bar that says how far a study is, and how long it will take.
///
/// # Errors
/// None: the template is fixed.
pub fn bar(length: u64, message: &'static str) -> Result<ProgressBar, Box<dyn Error>> {
    let bar = ProgressBar::new(length);
    bar.set_style(ProgressStyle::with_template(
        "{msg} {wide_bar} {percent} %, {eta} left",
    )?);
    bar.set_message(message);
    Ok(bar)
}

/// Writes to the terminal. A reader that has seen enough, such as `head`, is no fault.
///
/// # Errors
/// What the terminal says.
pub fn show(text: &str) -> io::Result<()> {
    let mut terminal = io::stdout().lock();
    match terminal
        .write_all(text.as_bytes())
        .and_then(|()| terminal.flush())
    {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}
