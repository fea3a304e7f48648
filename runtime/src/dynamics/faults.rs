//! Why a mechanism has no rates: asked after a step was refused, apart from what a step takes.

use super::{Dynamics, Evaluator, Solvable, vanishes};
use crate::constraints::extent::farthest;
use crate::dynamics::origin::{before_accelerations, differing, state_of};
use crate::error::{Fault, NotFinite, StepFault};
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::measure::load::{AppliedForces, Loads};
use crate::measure::view::View;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::{Mechanism, Pivot, Terms};
use crate::mechanism::orientations::{check_state, with_unit_orientations};
use crate::state::vector::{Array, MovingState, StateParts};

impl<P, S: Real, M: Mechanism, F: Formulation<S>, A> Dynamics<P>
where
    P: Solvable<Number = S, Mechanism = M, Formulation = F, Forces = A>,
{
    /// A fault of an integrator, which knows no joints, with the joint whose pivot has nearly
    /// vanished at a state, and with what the number type resolves of a position where that is
    /// coarser than an absolute tolerance.
    #[cold]
    pub(crate) fn explained(
        &self,
        fault: Fault,
        absolute: Option<S>,
        At {
            time,
            bodies: state,
        }: StateAt<S, M>,
    ) -> Fault {
        match fault {
            Fault::Step(StepFault::SizeUnderflow { step, is_least, .. }) => {
                let resolution = farthest(M::REPORT.bodies, state.coordinates().as_slice()).ulp();
                Fault::Step(StepFault::SizeUnderflow {
                    step,
                    is_least,
                    joint: self.nearly_singular(time, &state),
                    resolution: absolute
                        .is_some_and(|absolute| resolution > absolute)
                        .then(|| resolution.to_f64()),
                })
            }
            Fault::Step(StepFault::Budget { evaluations, .. }) => Fault::Step(StepFault::Budget {
                evaluations,
                joint: self.nearly_singular(time, &state),
            }),
            _ => fault,
        }
    }

    /// Asks a closure twice at a time and a state, and at another time and state in between, so
    /// that a sum over times does not stand still.
    ///
    /// # Errors
    /// [`StepFault::TwoAnswers`] where its forces differ in any digit.
    #[inline]
    pub(crate) fn ask_twice(
        &self,
        (time, state): (S, &M::State<S>),
        between: (S, &M::State<S>),
    ) -> Result<(), Fault> {
        if !A::PRESENT {
            return Ok(());
        }
        let read = with_unit_orientations::<S, M>(state);
        let one = self.applied(time, &read);
        let _ = self.applied(between.0, &with_unit_orientations::<S, M>(between.1));
        let other = self.applied(time, &read);
        match differing(&M::REPORT, [one.as_slice(), other.as_slice()]) {
            None => Ok(()),
            Some(body) => Err(Fault::Step(StepFault::TwoAnswers {
                body,
                time: time.to_f64(),
            })),
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
        let mut rates = M::State::zeros();
        let Pivot { relative, joint } = self.of_bodies().solved_again(time, state, &mut rates);
        (relative < S::constant(NEARLY_VANISHED)).then(|| field::<M>(joint.to_f64() as usize))
    }
}

impl<S, M, F, A, C> Evaluator<'_, S, M, F, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// Why an evaluation is not sound: solved again, so that the rates of one that is sound need
    /// not be kept.
    #[cold]
    #[inline(never)]
    pub(super) fn fault(&self, time: S, state: &C::State<S>) -> Fault {
        if let Err(fault) = C::check(state) {
            return fault.into();
        }
        let mut rates = C::State::zeros();
        let pivot = self.solved_again(time, state, &mut rates);
        if vanishes::<S, F::Terms>(pivot.relative) {
            return singular::<S, M>(&pivot);
        }
        let bodies = &C::bodies(&self.equations.constants, state);
        if let Err(fault) = check_state::<S, M>(bodies) {
            return fault.into();
        }
        let read = &with_unit_orientations::<S, M>(bodies);
        let applied = A::PRESENT.then(|| {
            let mut forces = M::forces(&self.absolute.constants, time, read);
            let view = View::new(&self.absolute.constants, time, read);
            self.forces
                .apply(time, read, &mut Loads::new(view, &mut forces));
            forces
        });
        let applied = applied.as_ref();
        let origin =
            before_accelerations::<S, M, F::Terms>(&self.absolute.constants, time, read, applied);
        let of_body = || {
            let mut accelerations = rates.rates_slice().iter();
            let place = accelerations.position(|rate| !rate.is_finite())?;
            C::body_of_velocity(place).map(NotFinite::Body)
        };
        Fault::Step(StepFault::RatesNotFinite {
            origin: origin
                .or_else(of_body)
                .or_else(|| state_of::<S, M>(&self.absolute.constants, time, read))
                .unwrap_or(NotFinite::Unknown),
        })
    }

    /// Pivot and accelerations as an evaluation computes them, by the kernels that it uses, so that
    /// no others are compiled.
    #[cold]
    #[inline(never)]
    pub(super) fn solved_again(
        &self,
        time: S,
        state: &C::State<S>,
        rates: &mut C::State<S>,
    ) -> Pivot<S> {
        if !Self::IN_PARTS {
            return self.slope(time, state, rates, &mut Array::zeros());
        }
        let constants = &self.equations.constants;
        let (pivot, _) = self.begin(time, state, rates, |first, rates| {
            C::finish(constants, time, state, rates, first.accelerations);
            first.pivot
        });
        pivot
    }
}

#[cold]
pub(crate) fn singular<S: Real, M: Mechanism>(pivot: &Pivot<S>) -> Fault {
    let joint = pivot.joint.to_f64() as usize;
    Fault::Step(StepFault::Singular {
        joint,
        name: field::<M>(joint),
        relative_pivot: pivot.relative.to_f64(),
    })
}

/// The field of a joint.
fn field<M: Mechanism>(joint: usize) -> &'static str {
    M::REPORT.joints.get(joint).map_or("", |info| info.name)
}
