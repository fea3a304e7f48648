//! Work on several cores, by threads that end with it: a process that forks later has none that
//! were left behind.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// How many threads there are to be for so many pieces of work.
pub(crate) fn count(asked: Option<usize>, pieces: usize) -> usize {
    let cores = || thread::available_parallelism().map_or(1, usize::from);
    asked.unwrap_or_else(cores).clamp(1, pieces.max(1))
}

/// Does pieces of work, each into its part of the results. A worker is made by every thread for
/// itself. Of several errors it returns that of the first piece.
pub(crate) fn each<W, T: Send, E: Send>(
    threads: usize,
    results: &mut [T],
    worker: impl Fn() -> Result<W, E> + Sync,
    work: impl Fn(&mut W, usize, &mut T) -> Result<(), E> + Sync,
) -> Result<(), E> {
    let pieces = results.len();
    let next = AtomicUsize::new(0);
    let ready: Vec<std::sync::Mutex<&mut T>> =
        results.iter_mut().map(std::sync::Mutex::new).collect();
    let begin = || -> Result<(), (usize, E)> {
        let mut own = worker().map_err(|error| (0, error))?;
        loop {
            let piece = next.fetch_add(1, Ordering::Relaxed);
            let Some(result) = ready.get(piece) else {
                return Ok(());
            };
            // Every piece is taken once.
            let Ok(mut result) = result.lock() else {
                return Ok(());
            };
            if let Err(error) = work(&mut own, piece, &mut result) {
                next.store(pieces, Ordering::Relaxed);
                return Err((piece, error));
            }
        }
    };
    if threads <= 1 {
        return begin().map_err(|(_, error)| error);
    }
    let failed = thread::scope(|scope| {
        let running: Vec<_> = (0..threads).map(|_| scope.spawn(begin)).collect();
        let mut failed: Vec<(usize, E)> = Vec::new();
        for thread in running {
            match thread.join() {
                Ok(outcome) => failed.extend(outcome.err()),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        failed
    });
    match failed.into_iter().min_by_key(|(piece, _)| *piece) {
        Some((_, error)) => Err(error),
        None => Ok(()),
    }
}
