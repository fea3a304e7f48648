//! The mechanisms of `study compare`, each beside its run-time assembler.

mod assemblers;
mod catalogue;
pub mod compile;
#[cfg(feature = "large")]
pub mod scenes;

pub use catalogue::{Entry, entries, names};

use holonom::{Fault, Scalar as _};
use holonom_study::compare::measure::{Refused, Scene, contestants};
use holonom_study::compare::record::Row;
use holonom_study::compare::run::{self, Opponent, Yardstick};
use holonom_study::counted::{Counted, counted};
use holonom_study::timing::Schedule;
use holonom_study::{StudyError, compare};

use crate::opponents::START;
use crate::yardstick::{self, Written};

/// Times the given scenes beside the yardstick; what was measured, and what was refused.
///
/// `prepared` is called with the number of every scene that is ready, `round` with every round that
/// is done.
///
/// # Errors
/// [`StudyError`] where a mechanism cannot be evaluated at all, or a time is not finite.
pub fn measure(
    entries: &[Entry],
    schedule: Schedule,
    mut prepared: impl FnMut(usize),
    round: impl FnMut(usize),
) -> Result<(Vec<Row>, Vec<Refused>), StudyError> {
    let (mut scenes, mut refused) = (Vec::new(), Vec::new());
    let mut opponents: Vec<Opponent> = Vec::new();
    for (place, entry) in entries.iter().enumerate() {
        let fault = |fault: Fault| StudyError::Run {
            name: format!("{} {}", entry.scene, entry.n),
            reason: fault.to_string(),
        };
        let mut scene: Scene = (entry.prepare)(entry).map_err(fault)?;
        if let Some(assembler) = entry.assembler {
            let which = (entry.scene, entry.n);
            opponents.extend(assemblers::opponents(which, &assembler(), &scene.states));
        }
        refused.append(&mut scene.refused);
        scenes.push(scene);
        prepared(place + 1);
    }
    let rows = run::run(unit()?, scenes, opponents, schedule, round)?;
    Ok((rows, refused))
}

/// The yardstick, ready for the race.
fn unit() -> Result<Yardstick, StudyError> {
    let start = START.map(Counted::constant);
    let (operations, _) = counted(|| yardstick::evaluate(&start));
    let contestants = contestants::<f64, _>(Written::default(), START, 1e-3);
    let contestants = contestants.map_err(|fault| StudyError::Run {
        name: compare::YARDSTICK.into(),
        reason: fault.to_string(),
    })?;
    Ok(Yardstick {
        operations,
        contestants,
    })
}
