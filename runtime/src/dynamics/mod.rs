//! A mechanism as a system of differential equations.
//!
//! A run in joint coordinates moves a `JointState`, and shows, watches, projects and reports the
//! bodies made of it (`moving.rs`). `jacobian.rs` has the exact Jacobian:
//! `docs/decisions/009-jacobian-by-forward-numbers.md`.
//!
//! Faults. The smallest pivot leaves a kernel with its result, and `faults.rs` makes an error with
//! the joint's name. `origin.rs` finds where a non-finite rate began, after a fault only:
//! `docs/decisions/007-checks-after-a-step.md`. Where joint coordinates give no rates, their own
//! numbers name the body.
//!
//! `likes.rs` judges the values of parameters with `like`: it assembles, from the described state
//! or by continuation from the typical values. Then it looks at the pivots. For each omitted
//! equation it compares value and gradient with the others, at the start and at a few
//! configurations and times.

pub(crate) mod evaluate;
mod faults;
mod jacobian;
pub(crate) mod joint_dynamics;
mod kept;
pub(crate) mod likes;
pub(crate) mod moving;
mod on_constraints;
pub(crate) mod origin;
mod secants;
mod system;
mod trial;
mod watched;

pub use joint_dynamics::JointDynamics;
pub use moving::{Bodies, Description, Joints, Moving};

use core::marker::PhantomData;

pub(crate) use faults::singular;
pub(crate) use watched::lesser;

use crate::constraints::compliance::compliances;
use crate::error::{Fault, ParameterError};
use crate::formulation::{Formulation, Saddle, inconsistency};
use crate::math::scalar::{Real, Scalar};
use crate::measure::load::{AppliedForces, ForceLaw, Loads, NoForces};
use crate::measure::view::View;
use crate::mechanism::kernels::{
    Evaluation, Mechanism, Normalised, Orientation, Pivot, Stabilisation, Terms,
};
use crate::mechanism::orientations::{scale_euler_rates, with_unit_orientations};
use crate::state::vector::{Array, StateParts, Vector};
use crate::watch::Seen;

/// A mechanism with a formulation, prepared: what an integrator moves.
///
/// `P` says how Euler parameters are read, `A` which forces come on top of those of the
/// description.
pub struct Dynamics<S: Real, M: Mechanism, F: Formulation<S>, P = Normalised, A = NoForces> {
    parameters: M::Parameters<S>,
    constants: M::Constants<S>,
    coefficients: M::Coefficients<S>,
    stabilisation: Stabilisation<S>,
    compliances: M::Multipliers<S>,
    formulation: F,
    forces: A,
    pub(crate) iterations: Iterations,
    pub(crate) seen: Seen<S, M>,
    orientation: PhantomData<P>,
}

/// The parameters and inputs of a mechanism; inputs are finite in the number type of the run, too.
fn parameters<S: Real, M: Mechanism>(mechanism: &M) -> Result<M::Parameters<S>, ParameterError> {
    let mut parameters = mechanism.parameters()?;
    M::put_inputs(&mechanism.inputs(), &mut parameters)?;
    Ok(parameters)
}

/// How often the augmented Lagrangian solved its system.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Iterations {
    /// In all evaluations together.
    pub total: usize,
    /// In the evaluation that took the most.
    pub largest: usize,
    /// The evaluations in which the iteration was ended before its tolerance, near a singular
    /// configuration.
    pub excused: usize,
}

impl<S: Real, M: Mechanism, F: Formulation<S>> Dynamics<S, M, F> {
    /// Prepares the kernels: Euler parameters normalised inside the evaluation, no forces beyond
    /// the description.
    ///
    /// # Errors
    /// A parameter of the mechanism or a coefficient of the formulation that is not acceptable.
    pub fn new(mechanism: &M, formulation: F) -> Result<Self, Fault> {
        let stabilisation = formulation.stabilisation()?;
        let parameters = parameters(mechanism)?;
        mechanism.check_likes::<S>(None)?;
        let constants = M::prepare(&parameters);
        let radian = formulation.radian();
        let compliances = compliances::<S, M, F::Terms>(&constants, &stabilisation, radian)?;
        Ok(Self {
            parameters,
            constants,
            coefficients: M::coefficients_by_row(&constants, &stabilisation, &compliances),
            stabilisation,
            compliances,
            formulation,
            forces: NoForces,
            iterations: Iterations::default(),
            seen: Seen::nothing(),
            orientation: PhantomData,
        })
    }
}

impl<S: Real, M: Mechanism, F: Formulation<S>, P, A: Clone> Clone for Dynamics<S, M, F, P, A> {
    fn clone(&self) -> Self {
        Self {
            parameters: self.parameters,
            constants: self.constants,
            coefficients: self.coefficients,
            stabilisation: self.stabilisation,
            compliances: self.compliances,
            formulation: self.formulation,
            forces: self.forces.clone(),
            iterations: self.iterations,
            seen: self.seen,
            orientation: PhantomData,
        }
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
            parameters: self.parameters,
            constants: self.constants,
            coefficients: self.coefficients,
            stabilisation: self.stabilisation,
            compliances: self.compliances,
            formulation: self.formulation,
            forces: forces(self.forces),
            iterations: self.iterations,
            seen: self.seen,
            orientation: PhantomData,
        }
    }

    /// Takes the present parameters and inputs of the mechanism.
    ///
    /// # Errors
    /// A parameter that is not acceptable; the former ones then stay.
    pub fn update(&mut self, mechanism: &M) -> Result<(), Fault> {
        let parameters = parameters(mechanism)?;
        mechanism.check_likes(Some(&self.parameters))?;
        let constants = M::prepare(&parameters);
        let radian = self.formulation.radian();
        self.compliances = compliances::<S, M, F::Terms>(&constants, &self.stabilisation, radian)?;
        self.coefficients =
            M::coefficients_by_row(&constants, &self.stabilisation, &self.compliances);
        self.parameters = parameters;
        self.constants = constants;
        Ok(())
    }

    /// Takes these inputs, and leaves the parameters: in the number type of the run, at the cost of
    /// what depends on inputs.
    ///
    /// # Errors
    /// An input that is not finite; the former ones then stay.
    #[inline]
    pub fn set_inputs(&mut self, inputs: &M::Inputs<S>) -> Result<(), Fault> {
        M::put_inputs(inputs, &mut self.parameters)?;
        M::take_inputs(&self.parameters, &mut self.constants);
        Ok(())
    }

    /// The values that the constants are made of.
    pub(crate) fn parameters(&self) -> &M::Parameters<S> {
        &self.parameters
    }

    /// What depends on the parameters of the mechanism alone.
    #[must_use]
    pub fn constants(&self) -> &M::Constants<S> {
        &self.constants
    }

    /// The compliance of every row; zeros for a formulation without.
    pub(crate) fn compliances(&self) -> &M::Multipliers<S> {
        &self.compliances
    }

    pub(crate) fn formulation(&self) -> &F {
        &self.formulation
    }

    /// How often the augmented Lagrangian solved its system in
    /// [`System::rates`](crate::integrate::System::rates); zero for other formulations.
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
    /// Whether an evaluation is done in its parts: applied forces enter there, and a formulation
    /// may iterate.
    const IN_PARTS: bool = A::PRESENT || F::ITERATED;

    /// Rates of the state and multipliers, and how often the system was solved.
    ///
    /// # Errors
    /// [`Fault::Singular`] where constraints depend on each other and the formulation has no
    /// compliance, [`Fault::NotConverged`] of the augmented Lagrangian, a state or rates that are
    /// not finite.
    #[inline(always)]
    pub fn evaluate(
        &self,
        time: S,
        state: &M::State<S>,
    ) -> Result<(Evaluation<S, M>, usize), Fault> {
        let mut evaluation = Evaluation::<S, M>::zeros();
        let iterations = self.evaluate_into(time, state, &mut evaluation)?;
        Ok((evaluation, iterations))
    }

    /// The same, written into a place ([`Evaluation::zeros`] makes one): nothing is copied, which
    /// counts beside a short kernel. What stands there after a fault is of no use.
    ///
    /// # Errors
    /// As [`Dynamics::evaluate`].
    #[inline(always)]
    pub fn evaluate_into(
        &self,
        time: S,
        state: &M::State<S>,
        evaluation: &mut Evaluation<S, M>,
    ) -> Result<usize, Fault> {
        let Evaluation {
            rates,
            multipliers,
            pivot,
        } = evaluation;
        let mut iterations = 1;
        if Self::IN_PARTS {
            match self.evaluate_in_parts(time, state, rates, multipliers) {
                Ok(parts) => (*pivot, iterations) = (parts.pivot, parts.iterations),
                Err(Fault::StateNotFinite) => return Err(self.fault(time, state)),
                Err(fault) => return Err(fault),
            }
        } else {
            *pivot = self.straight(time, state, rates, multipliers);
        }
        if sound::<S, M, F::Terms>(evaluation) {
            Ok(iterations)
        } else {
            Err(self.fault(time, state))
        }
    }

    /// The evaluation in one straight line.
    #[inline(always)]
    fn straight(
        &self,
        time: S,
        state: &M::State<S>,
        rates: &mut M::State<S>,
        multipliers: &mut M::Multipliers<S>,
    ) -> Pivot<S> {
        let prepared = (&self.constants, &self.coefficients);
        straight::<S, M, F::Terms, P>(prepared, time, state, rates, multipliers)
    }

    /// The state as the kernels read it.
    #[inline]
    fn read(state: &M::State<S>) -> M::State<S> {
        as_read::<S, M, P>(state)
    }

    /// Forces and moments of the closure alone, as [`Mechanism::forces`] has them, in a state whose
    /// Euler parameters have length 1.
    pub(crate) fn applied(&self, time: S, state: &M::State<S>) -> M::Velocities<S> {
        let mut forces = M::Velocities::<S>::zeros();
        self.forces
            .apply(time, state, &mut Loads::new(state, &mut forces));
        forces
    }

    /// The evaluation from its parts: applied forces enter, and a formulation may iterate.
    ///
    /// # Errors
    /// [`Fault::StateNotFinite`] where a pivot vanishes or something is not finite:
    /// [`Dynamics::fault`] says what, once this has given its stack back.
    fn evaluate_in_parts(
        &self,
        time: S,
        state: &M::State<S>,
        rates: &mut M::State<S>,
        multipliers: &mut M::Multipliers<S>,
    ) -> Result<Parts<S>, Fault> {
        // In the place of the rates, which are as long: the stack of a controller is short.
        *rates = Self::read(state);
        let read = &*rates;
        let (constants, coefficients) = (&self.constants, &self.coefficients);
        let (factors, pivot) = M::factor::<S, F::Terms>(constants, coefficients, time, read);
        if vanishes::<S, F::Terms>(pivot.relative) {
            return Err(Fault::StateNotFinite);
        }
        let mut upper = M::forces(constants, time, read);
        let mut applied_power = S::zero();
        if A::PRESENT {
            let described = upper;
            self.forces
                .apply(time, read, &mut Loads::new(read, &mut upper));
            let velocities = read.velocities().as_slice();
            let loads = upper.as_slice().iter().zip(described.as_slice());
            for ((&whole, &own), &u) in loads.zip(velocities) {
                applied_power = (whole - own).fused(u, applied_power);
            }
        }
        let lower = self.stabilised(time, read);
        let saddle = Saddle::<S, M, F::Terms> {
            constants,
            coefficients,
            factors: &factors,
            compliances: &self.compliances,
            time,
            state: read,
            upper: &upper,
            lower: &lower,
            terms: PhantomData,
        };
        let mut solution = saddle.solve();
        match self.formulation.refine(&saddle, &mut solution) {
            Ok(()) => {}
            Err(Fault::RatesNotFinite { .. }) => return Err(Fault::StateNotFinite),
            Err(fault) => return Err(fault),
        }
        let coordinate_rates = coordinate_rates::<S, M, P>(constants, state, read);
        *rates.coordinates_mut() = coordinate_rates;
        *rates.velocities_mut() = solution.accelerations;
        *multipliers = solution.multipliers;
        Ok(Parts {
            pivot,
            iterations: solution.iterations,
            excused: solution.excused,
            applied_power,
        })
    }

    /// Forces and moments of the description and of a closure, in a state whose Euler parameters
    /// have length 1.
    fn all_forces(&self, time: S, state: &M::State<S>) -> M::Velocities<S> {
        let mut forces = M::forces(&self.constants, time, state);
        if A::PRESENT {
            self.forces
                .apply(time, state, &mut Loads::new(state, &mut forces));
        }
        forces
    }

    /// How far the accelerations of an evaluation at a state are from what the constraints ask: the
    /// largest `|D u' - gamma*|` of a row, relative to the sum of the sizes of its terms and of
    /// what the applied forces would do without constraints; and the row's joint.
    ///
    /// Round-off for rigid constraints; the bias of a [`Penalty`](crate::Penalty), which a motion
    /// gathers; for an augmented Lagrangian what its tolerance, or an excuse, leaves. It costs
    /// about as much as one evaluation. `p` is read as by the formulation.
    pub fn inconsistency(
        &self,
        time: S,
        state: &M::State<S>,
        evaluation: &Evaluation<S, M>,
    ) -> (S, Option<&'static str>) {
        let read = &Self::read(state);
        let forces = self.all_forces(time, read);
        let gamma = self.stabilised(time, read);
        let accelerations = evaluation.rates.velocities();
        let (row, size) = inconsistency::<S, M>(
            &self.constants,
            (time, read),
            accelerations,
            &forces,
            &gamma,
        );
        (size, M::REPORT.joint_of(row))
    }

    /// `gamma* = gamma - 2 a Phi' - b^2 Phi`.
    fn stabilised(&self, time: S, state: &M::State<S>) -> M::Multipliers<S> {
        let Stabilisation { rate, position, .. } = self.stabilisation;
        stabilised::<S, M, F::Terms>(&self.constants, [rate, position], time, state)
    }
}

/// The evaluation in one straight line, from constants and coefficients.
#[inline(always)]
fn straight<S: Scalar, M: Mechanism, T: Terms, P: Orientation>(
    (constants, coefficients): (&M::Constants<S>, &M::Coefficients<S>),
    time: S,
    state: &M::State<S>,
    rates: &mut M::State<S>,
    multipliers: &mut M::Multipliers<S>,
) -> Pivot<S> {
    let pivot =
        M::evaluate_into::<S, T, P>(constants, coefficients, time, state, rates, multipliers);
    if P::NORMALISED_RATES {
        scale_euler_rates::<S, M>(rates.coordinates_mut(), state, |length| length.reciprocal());
    }
    pivot
}

/// The state as the kernels read it.
#[inline]
fn as_read<S: Scalar, M: Mechanism, P: Orientation>(state: &M::State<S>) -> M::State<S> {
    if P::NORMALISED {
        with_unit_orientations::<S, M>(state)
    } else {
        *state
    }
}

/// The rates of the coordinates of a state, from the state as the kernels read it.
#[inline]
fn coordinate_rates<S: Scalar, M: Mechanism, P: Orientation>(
    constants: &M::Constants<S>,
    state: &M::State<S>,
    read: &M::State<S>,
) -> <M::State<S> as StateParts<S>>::Coordinates {
    let mut rates = M::coordinate_rates(constants, read);
    if P::NORMALISED && !P::NORMALISED_RATES {
        scale_euler_rates::<S, M>(&mut rates, state, |length| length);
    }
    rates
}

/// `gamma* = gamma - r Phi' - p Phi` with the gains `r` and `p`, where the terms have them.
pub(crate) fn stabilised<S: Scalar, M: Mechanism, T: Terms>(
    constants: &M::Constants<S>,
    [rate, position]: [S; 2],
    time: S,
    state: &M::State<S>,
) -> M::Multipliers<S> {
    let mut gamma = M::gamma(constants, time, state);
    if T::STABILISED {
        let phi = M::constraints(constants, time, state);
        let phi_rate = M::constraint_rates(constants, time, state);
        let terms = phi.as_slice().iter().zip(phi_rate.as_slice());
        for (gamma, (&phi, &phi_rate)) in gamma.as_mut_slice().iter_mut().zip(terms) {
            *gamma = *gamma - (rate * phi_rate + position * phi);
        }
    }
    gamma
}

/// What an evaluation from its parts tells besides rates and multipliers.
struct Parts<S> {
    pivot: Pivot<S>,
    iterations: usize,
    /// Whether the iteration was ended before its tolerance.
    excused: bool,
    /// The power (W) of the forces of a closure.
    applied_power: S,
}

/// Whether the rates are finite and no pivot vanishes: below `64 EPSILON`, relative, no digit of
/// the multiplier is left.
///
/// With a compliance the system is solvable whatever the constraints are. A pivot of NaN shows in
/// the rates.
#[inline(always)]
fn sound<S: Real, M: Mechanism, T: Terms>(evaluation: &Evaluation<S, M>) -> bool {
    evaluation.rates.is_finite() && !vanishes::<S, T>(evaluation.pivot.relative)
}

#[inline(always)]
pub(crate) fn vanishes<S: Real, T: Terms>(relative_pivot: S) -> bool {
    !T::COMPLIANT && relative_pivot < S::constant(64.0) * S::EPSILON
}
