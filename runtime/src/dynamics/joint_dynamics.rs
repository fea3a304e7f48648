//! A mechanism in joint coordinates as a system of differential equations.

mod jacobian;
mod watched;

use crate::state::vector::{Array, StateParts, Vector};
use core::marker::PhantomData;

use crate::assembly::consistent_start::check_start;
use crate::dynamics::origin::before_accelerations;
use crate::dynamics::{Dynamics, Iterations, singular, vanishes};
use crate::error::{Fault, NotFinite};
use crate::formulation::{Formulation, JointSaddle, JointSolution};
use crate::integrate::{System, by_differences};
use crate::math::quaternion::{from_matrix, scale, to_unit_length};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{read, write};
use crate::measure::load::{AppliedForces, ForceLaw, Loads, NoForces};
use crate::mechanism::joint_kernels::{Freedom, JointCoordinates, JointEvaluation, JointParts};
use crate::mechanism::kernels::{Normalised, Pivot, Stabilisation};
use crate::mechanism::orientations::check_state;
use crate::mechanism::report::BodyKind;

/// A mechanism in joint coordinates with a formulation, prepared: what an integrator moves.
///
/// Its states are [`JointCoordinates::JointState`]; [`JointDynamics::bodies`] says how the bodies
/// stand in one, and everything that can be read of a mechanism ([`View`](crate::View), reactions
/// by [`Dynamics::evaluate`]) is read there.
///
/// ```
/// use holonom::joints::Revolute;
/// use holonom::prelude::*;
/// use holonom::{dynamics::JointDynamics, integrate::Scheme};
///
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
/// struct Rod {
///     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
///     rod: Body,
///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
///     hinge: Revolute,
/// }
///
/// let mut dynamics = JointDynamics::<f64, _, _>::new(&Rod::default(), StandardLagrange)?;
/// let mut state = dynamics.initial_state()?;
/// for step in 0..100 {
///     Rk4.step(&mut dynamics, 0.01 * f64::from(step), &mut state, 0.01)?;
/// }
/// let bodies = dynamics.bodies(&state);
/// let angle = dynamics.of_bodies().view(1.0, &bodies).angle(Rod::HANDLES.hinge);
/// assert!((state.pairs()[0][0] - angle.cos()).abs() < 1e-14);
/// # Ok::<(), Fault>(())
/// ```
pub struct JointDynamics<S: Real, M: JointCoordinates, F: Formulation<S>, A = NoForces> {
    bodies: Dynamics<S, M, F, Normalised, A>,
    constants: M::JointConstants<S>,
    coefficients: M::JointCoefficients<S>,
    stabilisation: Stabilisation<S>,
    compliances: M::ClosingMultipliers<S>,
    pub(crate) iterations: Iterations,
}

impl<S: Real, M: JointCoordinates, F: Formulation<S>, A: Clone> Clone
    for JointDynamics<S, M, F, A>
{
    fn clone(&self) -> Self {
        Self {
            bodies: self.bodies.clone(),
            constants: self.constants,
            coefficients: self.coefficients,
            stabilisation: self.stabilisation,
            compliances: self.compliances,
            iterations: self.iterations,
        }
    }
}

impl<S: Real, M: JointCoordinates, F: Formulation<S>> JointDynamics<S, M, F> {
    /// Prepares the kernels.
    ///
    /// # Errors
    /// A parameter of the mechanism or a coefficient of the formulation that is not acceptable.
    pub fn new(mechanism: &M, formulation: F) -> Result<Self, Fault> {
        Self::with(Dynamics::new(mechanism, formulation)?)
    }
}

/// The compliances of the equations that remain: those of the same rows of the bodies, so that one
/// coefficient means the same in both descriptions.
fn closing<S: Real, M: JointCoordinates>(
    of_bodies: &M::Multipliers<S>,
    otherwise: S,
) -> M::ClosingMultipliers<S> {
    let mut closing = M::ClosingMultipliers::<S>::zeros();
    let rows = closing.as_mut_slice().iter_mut();
    for (compliance, row) in rows.zip(M::JOINT_REPORT.rows) {
        let known = row.and_then(|row| of_bodies.as_slice().get(row));
        *compliance = known.copied().unwrap_or(otherwise);
    }
    closing
}

impl<S: Real, M: JointCoordinates, F: Formulation<S>, A> JointDynamics<S, M, F, A> {
    /// The same with forces from a closure, which is shown the state of the bodies.
    #[must_use]
    pub fn forces<G>(self, law: G) -> JointDynamics<S, M, F, ForceLaw<G>>
    where
        G: Fn(S, &M::State<S>, &mut Loads<'_, S, M>),
    {
        JointDynamics {
            bodies: self.bodies.forces(law),
            constants: self.constants,
            coefficients: self.coefficients,
            stabilisation: self.stabilisation,
            compliances: self.compliances,
            iterations: self.iterations,
        }
    }

    /// Takes the present parameters and inputs of the mechanism.
    ///
    /// # Errors
    /// A parameter that is not acceptable; the former ones then stay.
    pub fn update(&mut self, mechanism: &M) -> Result<(), Fault> {
        self.bodies.update(mechanism)?;
        let constants = M::prepare_joints(self.bodies.parameters());
        let compliance = self.stabilisation.compliance;
        self.compliances = closing::<S, M>(self.bodies.compliances(), compliance);
        self.coefficients =
            M::joint_coefficients(&constants, &self.stabilisation, &self.compliances);
        self.constants = constants;
        Ok(())
    }

    /// Takes these inputs, and leaves the parameters, see [`Dynamics::set_inputs`].
    ///
    /// # Errors
    /// An input that is not finite; the former ones then stay.
    #[inline]
    pub fn set_inputs(&mut self, inputs: &M::Inputs<S>) -> Result<(), Fault> {
        self.bodies.set_inputs(inputs)?;
        M::take_joint_inputs(self.bodies.parameters(), &mut self.constants);
        Ok(())
    }

    /// How often the augmented Lagrangian solved its system in [`System::rates`]; zero for other
    /// formulations, and where no equation remains.
    #[must_use]
    pub fn iterations(&self) -> Iterations {
        self.iterations
    }

    /// The state that the attributes of the bodies describe.
    ///
    /// # Errors
    /// [`Fault::InconsistentStart`] where the bodies do not stand as the joints let them;
    /// [`MechanismExt::assemble`](crate::MechanismExt::assemble) mends that.
    pub fn initial_state(&self) -> Result<M::JointState<S>, Fault> {
        self.joints(&M::initial_state(self.bodies.constants()))
    }

    /// The same system by its joints.
    pub(crate) fn with(bodies: Dynamics<S, M, F, Normalised, A>) -> Result<Self, Fault> {
        let stabilisation = bodies.formulation().stabilisation()?;
        let constants = M::prepare_joints(bodies.parameters());
        let compliances = closing::<S, M>(bodies.compliances(), stabilisation.compliance);
        Ok(Self {
            bodies,
            coefficients: M::joint_coefficients(&constants, &stabilisation, &compliances),
            constants,
            stabilisation,
            compliances,
            iterations: Iterations::default(),
        })
    }

    /// The same mechanism as its bodies describe it.
    #[must_use]
    pub fn of_bodies(&self) -> &Dynamics<S, M, F, Normalised, A> {
        &self.bodies
    }

    /// How the bodies stand and move: exactly as the joints of the tree let them.
    #[must_use]
    pub fn bodies(&self, state: &M::JointState<S>) -> M::State<S> {
        bodies_of::<S, M>(&self.constants, state)
    }

    /// The joint coordinates of bodies.
    ///
    /// # Errors
    /// [`Fault::InconsistentStart`] where the bodies do not stand as the joints let them, or move
    /// so that one would open within a second, by more than four digits; smaller violations of the
    /// joints of the tree are taken away. [`Fault::StateNotFinite`] where the two axes of a joint
    /// are in line.
    pub fn joints(&self, bodies: &M::State<S>) -> Result<M::JointState<S>, Fault> {
        let mut bodies = *bodies;
        M::recount(self.bodies.constants(), &mut bodies);
        check_state::<S, M>(&bodies)?;
        let second = (S::zero(), S::one());
        check_start::<S, M>(self.bodies.constants(), second, &bodies, true)?;
        let joints = M::joint_state(&self.constants, &bodies);
        if joints.is_finite() {
            Ok(joints)
        } else {
            Err(Fault::StateNotFinite)
        }
    }

    pub(crate) fn nearest(&self, bodies: &M::State<S>) -> M::JointState<S> {
        M::joint_state(&self.constants, bodies)
    }

    #[inline(always)]
    fn straight(
        &self,
        time: S,
        state: &M::JointState<S>,
        rates: &mut M::JointState<S>,
        multipliers: &mut M::ClosingMultipliers<S>,
    ) -> Pivot<S> {
        let (constants, coefficients) = (&self.constants, &self.coefficients);
        M::evaluate_joints_into::<S, F::Terms>(
            constants,
            coefficients,
            time,
            state,
            rates,
            multipliers,
        )
    }
}

impl<S, M, F, A> JointDynamics<S, M, F, A>
where
    S: Real,
    M: JointCoordinates,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
{
    /// Whether an evaluation is done in its parts: applied forces enter there, and a formulation
    /// may iterate.
    const IN_PARTS: bool = A::PRESENT || F::ITERATED;

    /// The kernel of a step: without multipliers, unless it goes on from them.
    #[inline(always)]
    fn slope(
        &self,
        time: S,
        state: &M::JointState<S>,
        rates: &mut M::JointState<S>,
        multipliers: &mut M::ClosingMultipliers<S>,
    ) -> Pivot<S> {
        if Self::IN_PARTS {
            return self.straight(time, state, rates, multipliers);
        }
        let (constants, coefficients) = (&self.constants, &self.coefficients);
        M::joint_rates_into::<S, F::Terms>(constants, coefficients, time, state, rates)
    }

    /// Adds applied forces to what an evaluation gives, and lets the formulation iterate; returns
    /// how often the system was solved.
    #[inline(never)]
    fn completed(
        &self,
        time: S,
        state: &M::JointState<S>,
        rates: &mut M::JointState<S>,
        multipliers: &mut M::ClosingMultipliers<S>,
    ) -> Result<usize, Fault> {
        let (constants, coefficients) = (&self.constants, &self.coefficients);
        let factors = &M::factor_joints::<S, F::Terms>(constants, coefficients, time, state);
        let mut first = JointSolution::<S, M> {
            accelerations: Array::zeros(),
            multipliers: *multipliers,
            iterations: 1,
        };
        add(first.accelerations.as_mut_slice(), rates.rates_slice());
        if A::PRESENT {
            let forces = self.bodies.applied(time, &self.bodies(state));
            let (further, loads) = M::solve_joints::<S, F::Terms>(
                constants,
                coefficients,
                factors,
                &forces,
                &Array::zeros(),
            );
            add(first.accelerations.as_mut_slice(), further.as_slice());
            add(first.multipliers.as_mut_slice(), loads.as_slice());
        }
        let solution = self.bodies.formulation().solve_joints(&JointSaddle {
            constants,
            coefficients,
            factors,
            compliances: &self.compliances,
            first,
            terms: PhantomData,
        })?;
        let places = rates.rates_slice_mut().iter_mut();
        for (place, &rate) in places.zip(solution.accelerations.as_slice()) {
            *place = rate;
        }
        *multipliers = solution.multipliers;
        Ok(solution.iterations)
    }

    /// The slope of a state, and the multipliers of the equations that remain.
    ///
    /// # Errors
    /// As [`Dynamics::evaluate`].
    #[inline(always)]
    pub fn evaluate(
        &self,
        time: S,
        state: &M::JointState<S>,
    ) -> Result<JointEvaluation<S, M>, Fault> {
        let mut evaluation = JointEvaluation::zeros();
        self.evaluate_into(time, state, &mut evaluation)?;
        Ok(evaluation)
    }

    /// The same, written into a place ([`JointEvaluation::zeros`] makes one): nothing is copied,
    /// which counts beside a short kernel. What stands there after a fault is of no use.
    ///
    /// # Errors
    /// As [`Dynamics::evaluate`].
    #[inline(always)]
    pub fn evaluate_into(
        &self,
        time: S,
        state: &M::JointState<S>,
        JointEvaluation { rates, multipliers }: &mut JointEvaluation<S, M>,
    ) -> Result<(), Fault> {
        let pivot = self.straight(time, state, rates, multipliers);
        let is_sound = |rates: &M::JointState<S>| {
            rates.is_finite() && !vanishes::<S, F::Terms>(pivot.relative)
        };
        let mut sound = is_sound(rates);
        if Self::IN_PARTS && sound {
            match self.completed(time, state, rates, multipliers) {
                Ok(_) => sound = is_sound(rates),
                Err(Fault::RatesNotFinite { .. }) => sound = false,
                Err(fault) => return Err(fault),
            }
        }
        if sound {
            Ok(())
        } else {
            Err(self.fault(time, state, pivot))
        }
    }

    /// Why an evaluation is not sound.
    #[cold]
    #[inline(never)]
    fn fault(&self, time: S, state: &M::JointState<S>, pivot: Pivot<S>) -> Fault {
        if !state.is_finite() {
            return Fault::StateNotFinite;
        }
        if vanishes::<S, F::Terms>(pivot.relative) {
            return singular::<S, M>(&pivot);
        }
        let constants = self.bodies.constants();
        let bodies = &self.bodies(state);
        if let Err(fault) = check_state::<S, M>(bodies) {
            return fault;
        }
        let applied = A::PRESENT.then(|| {
            let mut forces = M::forces(constants, time, bodies);
            let law = self.bodies.applied(time, bodies);
            add(forces.as_mut_slice(), law.as_slice());
            forces
        });
        let origin =
            before_accelerations::<S, M, F::Terms>(constants, time, bodies, applied.as_ref());
        Fault::RatesNotFinite {
            origin: origin.unwrap_or_else(|| self.first_of_rates(time, state)),
        }
    }

    /// Why a stage is not sound, of which a fault of the formulation may be known.
    #[cold]
    #[inline(never)]
    fn refused(&self, time: S, state: &M::JointState<S>, known: Option<Fault>) -> Fault {
        let mut rates = M::JointState::<S>::zeros();
        let mut multipliers = M::ClosingMultipliers::<S>::zeros();
        let pivot = self.slope(time, state, &mut rates, &mut multipliers);
        let is_sound = rates.is_finite() && !vanishes::<S, F::Terms>(pivot.relative);
        match known {
            Some(fault) if is_sound && !matches!(fault, Fault::RatesNotFinite { .. }) => fault,
            _ => self.fault(time, state, pivot),
        }
    }

    /// The first body with a motion whose rate is not finite.
    fn first_of_rates(&self, time: S, state: &M::JointState<S>) -> NotFinite {
        let mut rates = M::JointState::<S>::zeros();
        let mut multipliers = M::ClosingMultipliers::<S>::zeros();
        self.slope(time, state, &mut rates, &mut multipliers);
        let mut left = rates.rates_slice().iter();
        let motion = M::JOINT_REPORT.motions.iter().find(|motion| {
            let count = match motion.freedom {
                Freedom::Ball => 3,
                Freedom::Turn { .. } | Freedom::Slide | Freedom::Screw { .. } => 1,
            };
            let mut own = left.by_ref().take(count);
            !own.all(|rate| rate.is_finite())
        });
        motion.map_or(NotFinite::Unknown, |motion| NotFinite::Body(motion.body))
    }
}

impl<S, M, F, A> System<S> for JointDynamics<S, M, F, A>
where
    S: Real,
    M: JointCoordinates,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
{
    type State = M::JointState<S>;

    #[inline(always)]
    fn rates(&mut self, time: S, state: &M::JointState<S>) -> Result<M::JointState<S>, Fault> {
        let mut rates = M::JointState::<S>::zeros();
        match self.stage(time, state, &mut rates) {
            Ok(()) if rates.is_finite() => Ok(rates),
            outcome => Err(self.refused(time, state, outcome.err())),
        }
    }

    #[inline(always)]
    fn stage(
        &mut self,
        time: S,
        state: &M::JointState<S>,
        rates: &mut M::JointState<S>,
    ) -> Result<(), Fault> {
        let mut multipliers = Array::zeros();
        let pivot = self.slope(time, state, rates, &mut multipliers);
        if vanishes::<S, F::Terms>(pivot.relative) {
            // Why is asked when the step is refused.
            return Err(Fault::StateNotFinite);
        }
        if Self::IN_PARTS {
            let solved = self.completed(time, state, rates, &mut multipliers)?;
            if F::ITERATED && solved > 1 {
                self.iterations.total = self.iterations.total.saturating_add(solved);
                self.iterations.largest = self.iterations.largest.max(solved);
            }
        }
        Ok(())
    }

    /// As that of [`Dynamics`].
    fn jacobian(
        &mut self,
        time: S,
        state: &M::JointState<S>,
        rates: &M::JointState<S>,
        columns: &mut <M::JointState<S> as Vector<S>>::Each<M::JointState<S>>,
    ) -> Result<usize, Fault> {
        if !F::ITERATED
            && let Some(evaluations) = self.differentiated(time, state, columns)
        {
            return Ok(evaluations);
        }
        by_differences(state, rates, columns, |state, rates| {
            self.stage(time, state, rates)
        })
    }

    #[inline]
    fn with_new_velocities(
        &mut self,
        time: S,
        state: &M::JointState<S>,
        step: S,
        rates: &mut M::JointState<S>,
    ) -> Result<(), Fault> {
        let mut end = *state;
        let velocities = end.rates_slice_mut().iter_mut();
        for (velocity, &rate) in velocities.zip(rates.rates_slice()) {
            *velocity = rate.fused(step, *velocity);
        }
        let mut of_coordinates = M::joint_coordinate_rates(&self.constants, time, &end);
        let places = of_coordinates.rates_slice_mut().iter_mut();
        for (place, &rate) in places.zip(rates.rates_slice()) {
            *place = rate;
        }
        *rates = of_coordinates;
        Ok(())
    }

    #[inline]
    fn settle(&mut self, state: &mut M::JointState<S>, mut rates: Option<&mut M::JointState<S>>) {
        let mut stretch = S::zero();
        for &place in M::JOINT_REPORT.euler_parameters {
            let p: [S; 4] = read(state.rest_slice(), place);
            let (off, factor) = to_unit_length(&p);
            stretch = stretch.max(off);
            let Some(factor) = factor else { continue };
            scale(state.rest_slice_mut(), place, factor);
            if let Some(rates) = rates.as_deref_mut() {
                // They are linear in `p`.
                scale(rates.rest_slice_mut(), place, factor);
            }
        }
        if !M::JOINT_REPORT.euler_parameters.is_empty() {
            self.bodies.see_stretch(stretch);
        }
        if const { M::JOINT_REPORT.has_screws() } {
            M::JOINT_REPORT.recount_screws(state);
        }
        let auxiliaries = M::JOINT_REPORT.auxiliaries;
        if M::JOINT_REPORT.recounts {
            let mut bodies = self.bodies(state);
            M::recount(self.bodies.constants(), &mut bodies);
            let counted = bodies.coordinates().as_slice();
            let counted = counted.get(M::REPORT.coordinates..).unwrap_or(&[]);
            let rest = state.rest_slice_mut();
            let first = rest.len().saturating_sub(auxiliaries);
            for (place, &value) in counted.iter().enumerate() {
                write(rest, first + place, [value]);
            }
        }
    }
}

/// `x = x + y`.
fn add<S: Scalar>(x: &mut [S], y: &[S]) {
    x.iter_mut().zip(y).for_each(|(x, &y)| *x = *x + y);
}

/// How the bodies of joint coordinates stand and move.
pub(crate) fn bodies_of<S: Real, M: JointCoordinates>(
    constants: &M::JointConstants<S>,
    state: &M::JointState<S>,
) -> M::State<S> {
    let motions = M::body_motions(constants, state);
    let mut parts = motions.as_slice();
    let mut bodies = M::State::from_parts(Array::zeros(), Array::zeros());
    let mut next = |count: usize| {
        let (first, rest) = parts.split_at_checked(count).unwrap_or((parts, &[]));
        parts = rest;
        first
    };
    for body in M::REPORT.bodies {
        let linear = next(6);
        let (position, velocity): ([S; 3], [S; 3]) = (read(linear, 0), read(linear, 3));
        let coordinates = bodies.coordinates_mut().as_mut_slice();
        write(coordinates, body.coordinate, position);
        if body.kind == BodyKind::Rigid {
            let angular = next(12);
            let rows = [0, 3, 6].map(|place| read(angular, place));
            write(coordinates, body.coordinate + 3, from_matrix(&rows));
            let spin: [S; 3] = read(angular, 9);
            let velocities = bodies.velocities_mut().as_mut_slice();
            write(velocities, body.velocity + 3, spin);
        }
        let velocities = bodies.velocities_mut().as_mut_slice();
        write(velocities, body.velocity, velocity);
    }
    let auxiliaries = next(M::REPORT.auxiliaries);
    let coordinates = bodies.coordinates_mut().as_mut_slice();
    for (place, &value) in auxiliaries.iter().enumerate() {
        write(coordinates, M::REPORT.coordinates + place, [value]);
    }
    bodies
}
