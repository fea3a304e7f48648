//! The mechanisms of `study compare`, each beside its run-time assembler.

mod assemblers;
mod catalogue;
pub mod compile;
#[cfg(feature = "large")]
pub mod scenes;

pub use catalogue::{Entry, entries, names};

use holonom::{Fault, Scalar as _};
use holonom_study::compare::measure::{Refused, Scene, candidates};
use holonom_study::compare::record::Row;
use holonom_study::compare::run::{self, Baseline, ReferenceKernel};
use holonom_study::counted::{Counted, counted};
use holonom_study::timing::Schedule;
use holonom_study::{StudyError, compare};

use crate::baselines::START;
use crate::reference_kernel::{self, Written};

/// Times the given scenes beside the reference kernel; what was measured, and what was refused.
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
    let mut baselines: Vec<Baseline> = Vec::new();
    for (place, entry) in entries.iter().enumerate() {
        let fault = |fault: Fault| StudyError::Run {
            name: format!("{} {}", entry.scene, entry.n),
            reason: fault.to_string(),
        };
        let mut scene: Scene = (entry.prepare)(entry).map_err(fault)?;
        if let Some(assembler) = entry.assembler {
            let which = (entry.scene, entry.n);
            baselines.extend(assemblers::baselines(which, &assembler(), &scene.states));
        }
        refused.append(&mut scene.refused);
        scenes.push(scene);
        prepared(place + 1);
    }
    let rows = run::run(unit()?, scenes, baselines, schedule, round)?;
    Ok((rows, refused))
}

/// The reference kernel, ready for the race.
fn unit() -> Result<ReferenceKernel, StudyError> {
    let start = START.map(Counted::constant);
    let (operations, _) = counted(|| reference_kernel::evaluate(&start));
    let candidates = candidates::<f64, _>(Written::default(), START, 1e-3);
    let candidates = candidates.map_err(|fault| StudyError::Run {
        name: compare::REFERENCE_KERNEL.into(),
        reason: fault.to_string(),
    })?;
    Ok(ReferenceKernel {
        operations,
        candidates,
    })
}
