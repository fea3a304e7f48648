//! A mechanism as a system of differential equations.

use core::marker::PhantomData;

use crate::access::MechanismExt;
use crate::array::{Array, StateParts, finite};
use crate::error::Fault;
use crate::formulation::{Formulation, Saddle};
use crate::integrate::System;
use crate::load::{AppliedForces, ForceLaw, Loads, NoForces};
use crate::mechanism::{
    Evaluation, Mechanism, Normalised, Orientation, Pivot, Stabilisation, Terms,
};
use crate::rotation::{
    bring_to_unit_length, check_state, scale_euler_rates, with_unit_orientations,
};
use crate::scalar::Real;
use crate::view::View;

/// A mechanism with a formulation, prepared: what an integrator moves.
///
/// `P` says how Euler parameters are read, `A` which forces come on top of those of the description.
pub struct Dynamics<S: Real, M: Mechanism, F: Formulation<S>, P = Normalised, A = NoForces> {
    constants: M::Constants<S>,
    coefficients: M::Coefficients<S>,
    stabilisation: Stabilisation<S>,
    formulation: F,
    forces: A,
    iterations: Iterations,
    orientation: PhantomData<P>,
}

/// How often the augmented Lagrangian solved its system.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Iterations {
    /// In all evaluations together.
    pub total: usize,
    /// In the evaluation that took the most.
    pub largest: usize,
}

impl<S: Real, M: Mechanism, F: Formulation<S>> Dynamics<S, M, F> {
    /// Prepares the kernels: Euler parameters normalised inside the evaluation, no forces beyond the description.
    ///
    /// # Errors
    /// A parameter of the mechanism or a coefficient of the formulation that is not acceptable.
    pub fn new(mechanism: &M, formulation: F) -> Result<Self, Fault> {
        let stabilisation = formulation.stabilisation()?;
        let constants = mechanism.constants::<S>()?;
        Ok(Self {
            constants,
            coefficients: M::coefficients(&constants, &stabilisation),
            stabilisation,
            formulation,
            forces: NoForces,
            iterations: Iterations::default(),
            orientation: PhantomData,
        })
    }
}

impl<S: Real, M: Mechanism, F: Formulation<S>, P: Orientation, A> Dynamics<S, M, F, P, A> {
    /// The same with Euler parameters read in another way.
    #[must_use]
    pub fn orientation<P2: Orientation>(self) -> Dynamics<S, M, F, P2, A> {
        self.exchange(|forces| forces)
    }

    /// The same with forces from a closure.
    #[must_use]
    pub fn forces<G>(self, law: G) -> Dynamics<S, M, F, P, ForceLaw<G>>
    where
        G: Fn(S, &M::State<S>, &mut Loads<'_, S, M>),
    {
        self.exchange(|_| ForceLaw(law))
    }

    pub(crate) fn exchange<P2, A2>(
        self,
        forces: impl FnOnce(A) -> A2,
    ) -> Dynamics<S, M, F, P2, A2> {
        Dynamics {
            constants: self.constants,
            coefficients: self.coefficients,
            stabilisation: self.stabilisation,
            formulation: self.formulation,
            forces: forces(self.forces),
            iterations: self.iterations,
            orientation: PhantomData,
        }
    }

    /// Takes the present parameters and inputs of the mechanism.
    ///
    /// # Errors
    /// A parameter that is not acceptable; the former ones then stay.
    pub fn update(&mut self, mechanism: &M) -> Result<(), Fault> {
        self.constants = mechanism.constants()?;
        self.coefficients = M::coefficients(&self.constants, &self.stabilisation);
        Ok(())
    }

    /// What depends on the parameters of the mechanism alone.
    #[must_use]
    pub fn constants(&self) -> &M::Constants<S> {
        &self.constants
    }

    /// How often the augmented Lagrangian solved its system in [`System::rates`]; zero for other formulations.
    #[must_use]
    pub fn iterations(&self) -> Iterations {
        self.iterations
    }

    /// Readable access to a state.
    #[must_use]
    pub fn view<'a>(&'a self, time: S, state: &'a M::State<S>) -> View<'a, S, M> {
        View::new(&self.constants, time, state).reading::<P>()
    }
}

impl<S, M, F, P, A> Dynamics<S, M, F, P, A>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    P: Orientation,
    A: AppliedForces<S, M>,
{
    /// Rates of the state and multipliers, and how often the system was solved.
    ///
    /// # Errors
    /// [`Fault::Singular`] where constraints depend on each other and the formulation has no compliance,
    /// [`Fault::NotConverged`] of the augmented Lagrangian, a state or rates that are not finite.
    #[inline]
    pub fn evaluate(
        &self,
        time: S,
        state: &M::State<S>,
    ) -> Result<(Evaluation<S, M>, usize), Fault> {
        if A::PRESENT || F::ITERATED {
            self.evaluate_in_parts(time, state)
        } else {
            Ok((self.evaluate_fused(time, state)?, 1))
        }
    }

    /// A fault of an integrator, which knows no joints, with the joint whose pivot has nearly vanished at a state.
    #[cold]
    pub(crate) fn explained(&self, fault: Fault, time: S, state: &M::State<S>) -> Fault {
        /// A pivot that has lost this part of its size.
        const NEARLY_VANISHED: f64 = 1e-4;
        let Fault::StepSizeUnderflow { step, .. } = fault else {
            return fault;
        };
        let joint = self.evaluate(time, state).ok().and_then(|(evaluation, _)| {
            let Pivot { relative, joint } = evaluation.pivot;
            let near = !F::Terms::COMPLIANT && relative < S::constant(NEARLY_VANISHED);
            near.then(|| field::<M>(joint.to_f64() as usize))
        });
        Fault::StepSizeUnderflow { step, joint }
    }

    /// The evaluation in one straight line.
    #[inline(always)]
    fn evaluate_fused(&self, time: S, state: &M::State<S>) -> Result<Evaluation<S, M>, Fault> {
        let (constants, coefficients) = (&self.constants, &self.coefficients);
        let mut evaluation = M::evaluate::<S, F::Terms, P>(constants, coefficients, time, state);
        if P::NORMALISED_RATES {
            let rates = evaluation.rates.coordinates_mut();
            scale_euler_rates::<S, M>(rates, state, |length| length.reciprocal());
        }
        if sound::<S, M, F::Terms>(&evaluation) {
            Ok(evaluation)
        } else {
            Err(fault::<S, M, F::Terms>(evaluation.pivot, state))
        }
    }

    /// The evaluation from its parts: applied forces enter, and a formulation may iterate.
    fn evaluate_in_parts(
        &self,
        time: S,
        state: &M::State<S>,
    ) -> Result<(Evaluation<S, M>, usize), Fault> {
        let unit;
        let read = if P::NORMALISED {
            unit = with_unit_orientations::<S, M>(state);
            &unit
        } else {
            state
        };
        let (constants, coefficients) = (&self.constants, &self.coefficients);
        let (factors, pivot) = M::factor::<S, F::Terms>(constants, coefficients, time, read);
        if vanishes::<S, F::Terms>(&pivot) {
            return Err(singular::<S, M>(&pivot));
        }
        let mut upper = M::forces(constants, time, read);
        if A::PRESENT {
            self.forces
                .apply(time, read, &mut Loads::new(read, &mut upper));
        }
        let lower = self.stabilised(time, read);
        let saddle = Saddle::<S, M, F::Terms> {
            constants,
            coefficients,
            factors: &factors,
            compliance: self.stabilisation.compliance,
            time,
            state: read,
            upper: &upper,
            lower: &lower,
            terms: PhantomData,
        };
        let solution = self.formulation.solve(&saddle)?;
        let mut coordinate_rates = M::coordinate_rates(constants, read);
        if P::NORMALISED && !P::NORMALISED_RATES {
            scale_euler_rates::<S, M>(&mut coordinate_rates, state, |length| length);
        }
        let rates = M::State::from_parts(coordinate_rates, solution.accelerations);
        let multipliers = solution.multipliers;
        let evaluation = Evaluation {
            rates,
            multipliers,
            pivot,
        };
        if sound::<S, M, F::Terms>(&evaluation) {
            Ok((evaluation, solution.iterations))
        } else {
            Err(fault::<S, M, F::Terms>(pivot, state))
        }
    }

    /// `gamma* = gamma - 2 a Phi' - b^2 Phi`.
    fn stabilised(&self, time: S, state: &M::State<S>) -> M::Multipliers<S> {
        let mut gamma = M::gamma(&self.constants, time, state);
        if F::Terms::STABILISED {
            let Stabilisation { rate, position, .. } = self.stabilisation;
            let phi = M::constraints(&self.constants, time, state);
            let phi_rate = M::constraint_rates(&self.constants, time, state);
            let terms = phi.as_slice().iter().zip(phi_rate.as_slice());
            for (gamma, (&phi, &phi_rate)) in gamma.as_mut_slice().iter_mut().zip(terms) {
                *gamma = *gamma - (rate * phi_rate + position * phi);
            }
        }
        gamma
    }
}

impl<S, M, F, P, A> System<S> for Dynamics<S, M, F, P, A>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    P: Orientation,
    A: AppliedForces<S, M>,
{
    type State = M::State<S>;

    // Part of every stage of an integrator: rates then reach the next stage without passing through memory.
    #[inline(always)]
    fn rates(&mut self, time: S, state: &M::State<S>) -> Result<M::State<S>, Fault> {
        if !(A::PRESENT || F::ITERATED) {
            return self
                .evaluate_fused(time, state)
                .map(|evaluation| evaluation.rates);
        }
        let (evaluation, iterations) = self.evaluate_in_parts(time, state)?;
        if F::ITERATED {
            self.iterations.total = self.iterations.total.saturating_add(iterations);
            self.iterations.largest = self.iterations.largest.max(iterations);
        }
        Ok(evaluation.rates)
    }

    #[inline]
    fn settle(&self, state: &mut M::State<S>, rates: Option<&mut M::State<S>>) {
        if P::NORMALISED && !P::NORMALISED_RATES {
            bring_to_unit_length::<S, M>(state, rates);
        }
        M::recount(&self.constants, state);
    }
}

/// Whether the rates are finite and no pivot vanishes: below `64 EPSILON`, relative, no digit of the multiplier is left.
///
/// With a compliance the system is solvable whatever the constraints are. A pivot of NaN shows in the rates.
#[inline(always)]
fn sound<S: Real, M: Mechanism, T: Terms>(evaluation: &Evaluation<S, M>) -> bool {
    finite(&evaluation.rates) && !vanishes::<S, T>(&evaluation.pivot)
}

#[inline(always)]
fn vanishes<S: Real, T: Terms>(pivot: &Pivot<S>) -> bool {
    !T::COMPLIANT && pivot.relative < S::constant(64.0) * S::EPSILON
}

/// Why an evaluation is not sound.
#[cold]
#[inline(never)]
fn fault<S: Real, M: Mechanism, T: Terms>(pivot: Pivot<S>, state: &M::State<S>) -> Fault {
    if let Err(fault) = check_state::<S, M>(state) {
        fault
    } else if vanishes::<S, T>(&pivot) {
        singular::<S, M>(&pivot)
    } else {
        Fault::RatesNotFinite
    }
}

#[cold]
fn singular<S: Real, M: Mechanism>(pivot: &Pivot<S>) -> Fault {
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
