//! Why a mechanism has no rates: asked after a step was refused, apart from what a step takes.

use super::{Dynamics, vanishes};
use crate::constraints::extent::farthest;
use crate::dynamics::origin::{differing, origin};
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::kernels::{Evaluation, Mechanism, Orientation, Pivot, Terms};
use crate::mechanism::orientations::check_state;
use crate::state::vector::{Array, StateParts};

impl<S, M, F, P, A> Dynamics<S, M, F, P, A>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    P: Orientation,
    A: AppliedForces<S, M>,
{
    /// A fault of an integrator, which knows no joints, with the joint whose pivot has nearly
    /// vanished at a state, and with what the number type resolves of a position where that is
    /// coarser than an absolute tolerance.
    #[cold]
    pub(crate) fn explained(
        &self,
        fault: Fault,
        absolute: Option<S>,
        (time, state): (S, M::State<S>),
    ) -> Fault {
        match fault {
            Fault::StepSizeUnderflow { step, is_least, .. } => {
                let resolution = farthest(M::REPORT.bodies, state.coordinates().as_slice()).ulp();
                Fault::StepSizeUnderflow {
                    step,
                    is_least,
                    joint: self.nearly_singular(time, &state),
                    resolution: absolute
                        .is_some_and(|absolute| resolution > absolute)
                        .then(|| resolution.to_f64()),
                }
            }
            Fault::Budget { evaluations, .. } => Fault::Budget {
                evaluations,
                joint: self.nearly_singular(time, &state),
            },
            _ => fault,
        }
    }

    /// Asks a closure twice at a time and a state, and at another time and state in between, so
    /// that a sum over times does not stand still.
    ///
    /// # Errors
    /// [`Fault::TwoAnswers`] where its forces differ in any digit.
    #[inline]
    pub(crate) fn ask_twice(
        &self,
        (time, state): (S, &M::State<S>),
        between: (S, &M::State<S>),
    ) -> Result<(), Fault> {
        if !A::PRESENT {
            return Ok(());
        }
        let read = Self::read(state);
        let one = self.applied(time, &read);
        let _ = self.applied(between.0, &Self::read(between.1));
        let other = self.applied(time, &read);
        match differing(&M::REPORT, [one.as_slice(), other.as_slice()]) {
            None => Ok(()),
            Some(body) => Err(Fault::TwoAnswers {
                body,
                time: time.to_f64(),
            }),
        }
    }

    /// The joint whose pivot has nearly vanished at a state.
    #[cold]
    fn nearly_singular(&self, time: S, state: &M::State<S>) -> Option<&'static str> {
        /// A pivot that has lost this part of its size.
        const NEARLY_VANISHED: f64 = 1e-4;
        if F::Terms::COMPLIANT || M::REPORT.keeps_redundant() {
            return None;
        }
        let (Pivot { relative, joint }, _) = self.solved_again(time, state);
        (relative < S::constant(NEARLY_VANISHED)).then(|| field::<M>(joint.to_f64() as usize))
    }

    /// Why an evaluation is not sound: solved again, so that the rates of one that is sound need
    /// not be kept.
    #[cold]
    #[inline(never)]
    pub(super) fn fault(&self, time: S, state: &M::State<S>) -> Fault {
        if let Err(fault) = check_state::<S, M>(state) {
            return fault;
        }
        let (pivot, accelerations) = self.solved_again(time, state);
        if vanishes::<S, F::Terms>(pivot.relative) {
            return singular::<S, M>(&pivot);
        }
        let read = &Self::read(state);
        let applied = A::PRESENT.then(|| self.all_forces(time, read));
        Fault::RatesNotFinite {
            origin: origin::<S, M, F::Terms>(
                &self.constants,
                time,
                read,
                applied.as_ref(),
                &accelerations,
            ),
        }
    }

    /// Pivot and accelerations as an evaluation computes them, by the kernels that it uses, so that
    /// no others are compiled.
    #[cold]
    #[inline(never)]
    pub(super) fn solved_again(
        &self,
        time: S,
        state: &M::State<S>,
    ) -> (Pivot<S>, M::Velocities<S>) {
        if !Self::IN_PARTS {
            let mut evaluation = Evaluation::<S, M>::zeros();
            let Evaluation {
                rates, multipliers, ..
            } = &mut evaluation;
            let pivot = self.straight(time, state, rates, multipliers);
            return (pivot, *rates.velocities());
        }
        let read = &Self::read(state);
        let (constants, coefficients) = (&self.constants, &self.coefficients);
        let (factors, pivot) = M::factor::<S, F::Terms>(constants, coefficients, time, read);
        let upper = self.all_forces(time, read);
        let lower = self.stabilised(time, read);
        let (accelerations, _) =
            M::solve::<S, F::Terms>(constants, coefficients, &factors, &upper, &lower);
        (pivot, accelerations)
    }
}

#[cold]
pub(crate) fn singular<S: Real, M: Mechanism>(pivot: &Pivot<S>) -> Fault {
    let joint = pivot.joint.to_f64() as usize;
    Fault::Singular {
        joint,
        name: field::<M>(joint),
        relative_pivot: pivot.relative.to_f64(),
    }
}

/// The field of a joint.
fn field<M: Mechanism>(joint: usize) -> &'static str {
    M::REPORT.joints.get(joint).map_or("", |info| info.name)
}
