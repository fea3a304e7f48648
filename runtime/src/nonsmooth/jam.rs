//! Where friction jams: the efforts of what slips pass through infinity.
//!
//! Friction that slips is a multiple of the effort that presses it on. So it has a part in what
//! that effort brings about, which may come to be none at all. There the determinant of the
//! equations of all that holds is zero. Efforts grow beyond all bounds, beyond it they would pull,
//! and no motion goes on (Genot and Brogliato, *New results on Painleve paradoxes*, 1999). Steps of
//! a fixed size may lead across, where such efforts look as good as any. So the determinant keeps
//! its sign, and a stage does not leave the half of it: a step that fails is tried again, shorter.

use crate::error::{Fault, ModeFault, StepFault};
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::status::{Status, Tracked};

/// The least part of the determinant at the start of a step, at its stages.
const LEAST_PART: f64 = 0.5;

/// Where a tolerance asks for steps that are too short, so much is left at the most of the
/// determinant with which modes began. It goes with the root of the time up to the jam.
const NEARLY_NOTHING: f64 = 1e-2;

impl<S: Real> Status<S> {
    /// A number that is positive up to where friction jams. Infinite where nothing slips on a
    /// contact.
    pub(crate) fn before_jam(&self) -> S {
        self.before_jam_at(self.exerted.determinant)
    }

    /// The same by a determinant: over that at the start of a step.
    fn before_jam_at(&self, determinant: S) -> S {
        if self.determinant == S::zero() || determinant == S::zero() {
            return S::constant(f64::INFINITY);
        }
        determinant.quotient(self.determinant)
    }
}

/// Keeps the determinant with which modes begin.
pub(super) fn begin<S: Real, M: Mechanism>(list: &mut [Tracked<S, M>], determinant: S) {
    for tracked in list {
        let status = &mut tracked.status;
        (status.began, status.determinant) = (determinant, determinant);
        status.exerted.determinant = determinant;
    }
}

/// Begins a step: from here on stages do not leave the half of the determinant. Of slip that begins
/// they may, for its direction is looked for at each of them.
pub(crate) fn begin_step<S: Real, M: Mechanism>(list: &mut [Tracked<S, M>]) {
    let least_part = if list.iter().any(Tracked::begins) {
        S::zero()
    } else {
        S::constant(LEAST_PART)
    };
    for tracked in list {
        let status = &mut tracked.status;
        (status.determinant, status.least_part) = (status.exerted.determinant, least_part);
    }
}

/// Ends a step, which others may look into.
pub(crate) fn end_step<S: Real, M: Mechanism>(list: &mut [Tracked<S, M>]) {
    for tracked in list {
        tracked.status.least_part = S::zero();
    }
}

/// Refuses what lies beyond a jam, by the determinant at a time (s).
pub(super) fn refuse<S: Real, M: Mechanism>(
    list: &[Tracked<S, M>],
    determinant: S,
    time: S,
) -> Result<(), Fault> {
    let status = list.first().map(|first| &first.status);
    if status.is_some_and(|status| status.before_jam_at(determinant) < status.least_part) {
        return Err(jammed(list, time));
    }
    Ok(())
}

/// Whether a step that has failed is to be tried again, of half its length. A stage of a fixed step
/// may look beyond the end of a mode, where the friction of that has no effort.
pub(crate) fn may_be_beyond(fault: &Fault) -> bool {
    matches!(fault, Fault::Mode(ModeFault::NoUniqueFriction { .. }))
}

/// The fault of steps that are too short at a time (s), with its cause where friction jams there.
pub(crate) fn explained<S: Real, M: Mechanism>(
    list: &[Tracked<S, M>],
    fault: Fault,
    time: S,
) -> Fault {
    let is_near = |tracked: &Tracked<S, M>| {
        let Status { began, exerted, .. } = &tracked.status;
        exerted.determinant.abs() < S::constant(NEARLY_NOTHING) * began.abs()
    };
    match fault {
        Fault::Step(StepFault::SizeUnderflow { .. }) if list.first().is_some_and(is_near) => {
            jammed(list, time)
        }
        _ => fault,
    }
}

/// The fault of friction that jams at a time (s): of the first contact that slips.
#[cold]
pub(crate) fn jammed<S: Real, M: Mechanism>(list: &[Tracked<S, M>], time: S) -> Fault {
    let first = list.iter().find(|tracked| tracked.slips_on_contact());
    let first = first.or(list.first());
    Fault::Mode(ModeFault::NoUniqueFriction {
        joint: first.map_or("", |first| first.interaction.name()),
        time: time.to_f64(),
    })
}
