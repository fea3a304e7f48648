//! Relative coordinates, by the kernels of a mechanism in joint coordinates.

use crate::error::StepFault;
use crate::math::quaternion::{from_matrix, scale, scale_near_unit_length, to_unit_length};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{read, write};
use crate::mechanism::absolute::{nearer_sign, take_nearer_sign};
use crate::mechanism::coordinates::{
    AbsoluteEquations, Coordinates, Equations, EquationsIn, First, Prepared, Relative, RightSide,
};
use crate::mechanism::joint_columns;
use crate::mechanism::joint_kernels::{JointCoordinates, JointParts};
use crate::mechanism::kernels::{Normalised, Pivot, Stabilisation, Terms};
use crate::mechanism::report::{BodyInfo, BodyKind};
use crate::mechanism::turns;
use crate::state::sealed::Sealed;
use crate::state::sums::sum_of_sizes_in_both;
use crate::state::vector::{Array, MovingState, StateParts, Vector};

impl Sealed for Relative {}

impl<M: JointCoordinates> Coordinates<M> for Relative {
    type State<S: Scalar> = M::JointState<S>;
    type Velocities<S: Scalar> = M::JointVelocities<S>;
    type Multipliers<S: Scalar> = M::ClosingMultipliers<S>;
    type Constants<S: Scalar> = M::JointConstants<S>;
    type Coefficients<S: Scalar> = M::JointCoefficients<S>;
    type Factors<S: Scalar> = M::JointFactors<S>;
    type Own<S: Scalar> = EquationsIn<S, M, Self>;
    type Orientation = Normalised;

    const IS_RELATIVE: bool = true;
    const HAS_PIVOTS: bool = !M::JOINT_REPORT.rows.is_empty();
    const HAS_LINEAR_PIVOTS: bool = M::JOINT_REPORT.determines;

    #[inline(always)]
    fn equations<'e, S: Scalar>(
        _absolute: &'e AbsoluteEquations<S, M>,
        own: &'e Self::Own<S>,
    ) -> &'e EquationsIn<S, M, Self> {
        own
    }

    fn own<S: Scalar>(
        parameters: &M::Parameters<S>,
        stabilisation: &Stabilisation<S>,
        absolute: &AbsoluteEquations<S, M>,
    ) -> Self::Own<S> {
        let constants = M::prepare_joints(parameters);
        let compliances = closing_compliances::<S, M>(&absolute.compliances, stabilisation);
        Equations {
            coefficients: M::joint_coefficients(&constants, stabilisation, &compliances),
            constants,
            compliances,
        }
    }

    #[inline(always)]
    fn take_inputs<S: Scalar>(parameters: &M::Parameters<S>, own: &mut Self::Own<S>) {
        M::take_joint_inputs(parameters, &mut own.constants);
    }

    fn differentiated<S: Real, T: Terms>(
        constants: &M::JointConstants<S>,
        _coefficients: &M::JointCoefficients<S>,
        time: S,
        state: &M::JointState<S>,
        columns: &mut <M::JointState<S> as Vector<S>>::Each<M::JointState<S>>,
    ) -> bool {
        joint_columns::written::<M, S, T>(constants, time, state, columns)
    }

    #[inline(always)]
    fn evaluate_into<S: Scalar, T: Terms>(
        constants: &M::JointConstants<S>,
        coefficients: &M::JointCoefficients<S>,
        time: S,
        state: &M::JointState<S>,
        rates: &mut M::JointState<S>,
        multipliers: &mut M::ClosingMultipliers<S>,
    ) -> Pivot<S> {
        M::evaluate_joints_into::<S, T>(constants, coefficients, time, state, rates, multipliers)
    }

    #[inline(always)]
    fn rates_into<S: Scalar, T: Terms>(
        constants: &M::JointConstants<S>,
        coefficients: &M::JointCoefficients<S>,
        time: S,
        state: &M::JointState<S>,
        rates: &mut M::JointState<S>,
        _multipliers: &mut M::ClosingMultipliers<S>,
    ) -> Pivot<S> {
        M::joint_rates_into::<S, T>(constants, coefficients, time, state, rates)
    }

    /// The right side is the first solution: the equations are linear in their right-hand sides.
    #[inline(always)]
    fn begin<S: Scalar, T: Terms, R>(
        prepared: Prepared<'_, S, M, Self>,
        time: S,
        state: &M::JointState<S>,
        rates: &mut M::JointState<S>,
        law: Option<impl FnOnce(&M::JointState<S>, &mut M::Velocities<S>)>,
        then: impl FnOnce(&First<'_, S, M, Self>, &mut M::JointState<S>) -> R,
    ) -> R {
        let Prepared {
            constants,
            coefficients,
            ..
        } = prepared;
        let mut multipliers = M::ClosingMultipliers::<S>::zeros();
        let pivot = M::evaluate_joints_into::<S, T>(
            constants,
            coefficients,
            time,
            state,
            rates,
            &mut multipliers,
        );
        let factors = M::factor_joints::<S, T>(constants, coefficients, time, state);
        let mut accelerations = M::JointVelocities::<S>::zeros();
        add(accelerations.as_mut_slice(), rates.rates_slice());
        if let Some(law) = law {
            let mut forces = M::Velocities::<S>::zeros();
            law(state, &mut forces);
            let (further, loads) = M::solve_joints::<S, T>(
                constants,
                coefficients,
                &factors,
                &forces,
                &Array::zeros(),
            );
            add(accelerations.as_mut_slice(), further.as_slice());
            add(multipliers.as_mut_slice(), loads.as_slice());
        }
        let first = First {
            factors: &factors,
            right: (&accelerations, &multipliers),
            pivot,
            accelerations: &accelerations,
            multipliers: &multipliers,
        };
        then(&first, rates)
    }

    #[inline(always)]
    fn as_read<'s, S: Scalar>(
        state: &'s M::JointState<S>,
        _rates: &'s M::JointState<S>,
    ) -> &'s M::JointState<S> {
        state
    }

    #[inline(always)]
    fn solve_after<S: Scalar, T: Terms>(
        (constants, coefficients): (&M::JointConstants<S>, &M::JointCoefficients<S>),
        factors: &M::JointFactors<S>,
        (accelerations, multipliers): RightSide<'_, S, M, Self>,
        yielded: &M::ClosingMultipliers<S>,
    ) -> (M::JointVelocities<S>, M::ClosingMultipliers<S>) {
        let mut lower = *yielded;
        lower.as_mut_slice().iter_mut().for_each(|row| *row = -*row);
        let (further, loads) =
            M::solve_joints::<S, T>(constants, coefficients, factors, &Array::zeros(), &lower);
        let mut solution = (*accelerations, *multipliers);
        add(solution.0.as_mut_slice(), further.as_slice());
        add(solution.1.as_mut_slice(), loads.as_slice());
        solution
    }

    fn solve_loads<S: Scalar, T: Terms, R>(
        (constants, coefficients): (&M::JointConstants<S>, &M::JointCoefficients<S>),
        factors: &M::JointFactors<S>,
        loads: &M::Velocities<S>,
        then: impl FnOnce(
            RightSide<'_, S, M, Self>,
            (M::JointVelocities<S>, M::ClosingMultipliers<S>),
        ) -> R,
    ) -> R {
        let lower = Array::zeros();
        let solution = M::solve_joints::<S, T>(constants, coefficients, factors, loads, &lower);
        then((&solution.0, &solution.1), solution)
    }

    #[inline(always)]
    fn finish<S: Scalar>(
        _constants: &M::JointConstants<S>,
        _time: S,
        _state: &M::JointState<S>,
        rates: &mut M::JointState<S>,
        accelerations: &M::JointVelocities<S>,
    ) {
        let places = rates.rates_slice_mut().iter_mut();
        places
            .zip(accelerations.as_slice())
            .for_each(|(place, &rate)| *place = rate);
    }

    fn way<S: Scalar>(
        constants: &M::JointConstants<S>,
        time: S,
        state: &M::JointState<S>,
        velocities: &M::JointVelocities<S>,
    ) -> M::JointState<S> {
        let mut moving = *state;
        let places = moving.rates_slice_mut().iter_mut();
        places
            .zip(velocities.as_slice())
            .for_each(|(place, &velocity)| *place = velocity);
        rates_of_motion::<S, M>(constants, time, &moving)
    }

    #[inline]
    fn with_new_velocities<S: Scalar>(
        constants: &M::JointConstants<S>,
        time: S,
        state: &M::JointState<S>,
        step: S,
        rates: &mut M::JointState<S>,
    ) {
        let mut end = *state;
        let velocities = end.rates_slice_mut().iter_mut();
        for (velocity, &rate) in velocities.zip(rates.rates_slice()) {
            *velocity = rate.fused(step, *velocity);
        }
        let mut of_coordinates = M::joint_coordinate_rates(constants, time, &end);
        let places = of_coordinates.rates_slice_mut().iter_mut();
        for (place, &rate) in places.zip(rates.rates_slice()) {
            *place = rate;
        }
        *rates = of_coordinates;
    }

    #[inline]
    fn normalise<S: Real>(
        absolute: &AbsoluteEquations<S, M>,
        constants: &M::JointConstants<S>,
        state: &mut M::JointState<S>,
        mut rates: Option<&mut M::JointState<S>>,
    ) -> Option<S> {
        let mut norm_drift = None;
        for &place in M::JOINT_REPORT.euler_parameters {
            let p: [S; 4] = read(state.rest_slice(), place);
            let (off, factor) = to_unit_length(&p);
            norm_drift = Some(norm_drift.map_or(off, |known: S| known.max(off)));
            let Some(factor) = factor else { continue };
            scale(state.rest_slice_mut(), place, factor);
            if let Some(rates) = rates.as_deref_mut() {
                // They are linear in `p`.
                scale(rates.rest_slice_mut(), place, factor);
            }
        }
        recount::<S, M>(&absolute.constants, state, |state| {
            bodies_of::<S, M>(constants, state)
        });
        norm_drift
    }

    #[inline(always)]
    fn normalise_near<S: Scalar>(state: &mut M::JointState<S>) -> bool {
        if M::JOINT_REPORT.rewraps || M::JOINT_REPORT.has_screws() {
            return false;
        }
        if M::JOINT_REPORT.euler_parameters.is_empty() {
            return true;
        }
        let mut unit = *state;
        for &place in M::JOINT_REPORT.euler_parameters {
            if scale_near_unit_length(unit.rest_slice_mut(), place).is_none() {
                return false;
            }
        }
        *state = unit;
        true
    }

    #[inline(always)]
    fn with_bodies<S: Real, R>(
        constants: &M::JointConstants<S>,
        state: &M::JointState<S>,
        then: impl FnOnce(&M::State<S>) -> R,
    ) -> R {
        then(&bodies_of::<S, M>(constants, state))
    }

    #[inline(always)]
    fn turning<S: Scalar>(from: &M::JointState<S>, to: &M::JointState<S>) -> S {
        if const { M::JOINT_REPORT.moves_one_by_one(&M::REPORT) } {
            M::JOINT_REPORT.fastest(from, to)
        } else {
            sum_of_sizes_in_both(from.rates_slice(), to.rates_slice())
        }
    }

    fn bodies<S: Real>(constants: &M::JointConstants<S>, state: &M::JointState<S>) -> M::State<S> {
        bodies_of::<S, M>(constants, state)
    }

    // Turns about an axis are pairs on a circle, which do not tell the two signs apart.
    fn bodies_near<S: Real>(
        constants: &M::JointConstants<S>,
        state: &M::JointState<S>,
        near: &M::State<S>,
    ) -> M::State<S> {
        bodies_of_near::<S, M>(constants, state, near)
    }

    fn of_bodies<S: Real>(
        constants: &M::JointConstants<S>,
        bodies: &M::State<S>,
    ) -> M::JointState<S> {
        joint_state_of::<S, M>(constants, bodies)
    }

    fn of_bodies_near<S: Real>(
        constants: &M::JointConstants<S>,
        bodies: &M::State<S>,
        near: &M::JointState<S>,
    ) -> M::JointState<S> {
        let mut state = joint_state_of::<S, M>(constants, bodies);
        for &place in M::JOINT_REPORT.euler_parameters {
            take_nearer_sign(state.rest_slice_mut(), near.rest_slice(), place);
        }
        state
    }

    fn check<S: Real>(state: &M::JointState<S>) -> Result<(), StepFault> {
        if state.is_finite() {
            Ok(())
        } else {
            Err(StepFault::StateNotFinite)
        }
    }

    fn body_of_velocity(place: usize) -> Option<&'static str> {
        let motion = M::JOINT_REPORT.motion_of_rate(place);
        motion.map(|(_, motion)| motion.body)
    }

    fn joint_of_row(row: usize) -> Option<&'static str> {
        M::JOINT_REPORT.closing.get(row).copied()
    }

    fn row_of_all(row: usize) -> Option<usize> {
        M::JOINT_REPORT.rows.get(row).copied().flatten()
    }

    fn keeps_equations(joint: &str) -> bool {
        M::JOINT_REPORT.closing.contains(&joint)
    }
}

/// Puts the auxiliary variables of a state right.
#[inline(always)]
pub(crate) fn recount<S: Scalar, M: JointCoordinates>(
    absolute: &M::Constants<S>,
    state: &mut M::JointState<S>,
    bodies: impl FnOnce(&M::JointState<S>) -> M::State<S>,
) {
    if const { M::JOINT_REPORT.has_screws() } {
        M::JOINT_REPORT.rewrap_screws(state);
    }
    if M::JOINT_REPORT.rewraps {
        let mut bodies = bodies(state);
        M::rewrap(absolute, &mut bodies);
        let counted = bodies.coordinates().as_slice();
        let counted = counted.get(M::REPORT.coordinates..).unwrap_or(&[]);
        let rest = state.rest_slice_mut();
        let last = M::JOINT_REPORT.auxiliaries + M::JOINT_REPORT.states.len();
        let first = rest.len().saturating_sub(last);
        let counted = counted.iter().take(M::JOINT_REPORT.auxiliaries);
        for (place, &value) in counted.enumerate() {
            write(rest, first + place, [value]);
        }
    }
}

/// The rates of the coordinates by the velocities alone: the user's own states stay what they are
/// along a way that is no motion in time.
pub(crate) fn rates_of_motion<S: Scalar, M: JointCoordinates>(
    constants: &M::JointConstants<S>,
    time: S,
    state: &M::JointState<S>,
) -> M::JointState<S> {
    let mut rates = M::joint_coordinate_rates(constants, time, state);
    for own in M::JOINT_REPORT.states {
        write(rates.rest_slice_mut(), own.coordinate, [S::zero()]);
    }
    rates
}

/// `x = x + y`.
fn add<S: Scalar>(x: &mut [S], y: &[S]) {
    x.iter_mut().zip(y).for_each(|(x, &y)| *x = *x + y);
}

/// How a body stands and moves, as [`JointCoordinates::body_motions`] has it.
pub(crate) struct BodyMotion<'a, S> {
    /// The centre of mass (m, global).
    pub(crate) position: &'a [S; 3],
    /// Its velocity (m/s, global).
    pub(crate) velocity: &'a [S; 3],
    /// Of a rigid body the rotation from principal to global axes, row by row, and the angular
    /// velocity (rad/s) in principal axes.
    pub(crate) rotation: Option<(&'a [[S; 3]; 3], &'a [S; 3])>,
}

impl<'a, S> BodyMotion<'a, S> {
    /// Of the first body of some, of which the others are left.
    fn first(kind: BodyKind, rest: &mut &'a [S]) -> Option<Self> {
        let (position, others) = rest.split_first_chunk()?;
        let (velocity, mut others) = others.split_first_chunk()?;
        let rotation = match kind {
            BodyKind::Rigid => {
                let (rows, more) = others.split_at_checked(9)?;
                let (spin, more) = more.split_first_chunk()?;
                others = more;
                Some((rows.as_chunks().0.first_chunk()?, spin))
            }
            BodyKind::Particle => None,
        };
        *rest = others;
        Some(Self {
            position,
            velocity,
            rotation,
        })
    }
}

/// The motions of the bodies one after the other, and behind them the auxiliary variables and the
/// user's own states.
pub(crate) fn each_body<S: Scalar, M: JointCoordinates>(
    motions: &[S],
    mut then: impl FnMut(usize, &'static BodyInfo, BodyMotion<'_, S>),
) -> &[S] {
    // Of each body at once: parts of places that are not known cost a comparison for each.
    let mut rest = motions;
    for (number, body) in M::REPORT.bodies.iter().enumerate() {
        if let Some(motion) = BodyMotion::first(body.kind, &mut rest) {
            then(number, body, motion);
        }
    }
    let others = M::REPORT.auxiliaries + M::REPORT.states.len();
    rest.get(..others).unwrap_or(rest)
}

/// How the bodies of joint coordinates stand and move.
pub(crate) fn bodies_of<S: Real, M: JointCoordinates>(
    constants: &M::JointConstants<S>,
    state: &M::JointState<S>,
) -> M::State<S> {
    let motions = M::body_motions(constants, state);
    let mut bodies = bodies_by::<S, M>(&motions, |_, rows| from_matrix(rows));
    turns::copy(state, &mut bodies);
    bodies
}

/// The same with the nearer sign of Euler parameters to those of bodies a moment ago.
fn bodies_of_near<S: Real, M: JointCoordinates>(
    constants: &M::JointConstants<S>,
    state: &M::JointState<S>,
    near: &M::State<S>,
) -> M::State<S> {
    let motions = M::body_motions(constants, state);
    let near = near.coordinates().as_slice();
    let mut bodies = bodies_by::<S, M>(&motions, |place, rows| {
        nearer_sign(from_matrix(rows), &read(near, place))
    });
    turns::copy(state, &mut bodies);
    bodies
}

/// The joint coordinates of bodies, or nearly so, with the turns that these have counted.
pub(crate) fn joint_state_of<S: Real, M: JointCoordinates>(
    constants: &M::JointConstants<S>,
    bodies: &M::State<S>,
) -> M::JointState<S> {
    let mut state = M::joint_state(constants, bodies);
    turns::copy(bodies, &mut state);
    state
}

/// The same of their motions; Euler parameters are made of their place and the rotation.
#[inline]
pub(crate) fn bodies_by<S: Scalar, M: JointCoordinates>(
    motions: &M::BodyMotions<S>,
    euler_parameters: impl Fn(usize, &[[S; 3]; 3]) -> [S; 4],
) -> M::State<S> {
    let mut bodies = M::State::from_parts(Array::zeros(), Array::zeros());
    let others = each_body::<S, M>(motions.as_slice(), |_, body, motion| {
        let (place, speed) = (body.coordinate, body.velocity);
        write(coordinates_of(&mut bodies), place, *motion.position);
        write(velocities_of(&mut bodies), speed, *motion.velocity);
        if let Some((rows, spin)) = motion.rotation {
            let euler_parameters = euler_parameters(place + 3, rows);
            write(coordinates_of(&mut bodies), place + 3, euler_parameters);
            write(velocities_of(&mut bodies), speed + 3, *spin);
        }
    });
    for (place, &value) in others.iter().enumerate() {
        let place = M::REPORT.coordinates + place;
        write(coordinates_of(&mut bodies), place, [value]);
    }
    bodies
}

fn coordinates_of<S: Scalar, X: StateParts<S>>(bodies: &mut X) -> &mut [S] {
    bodies.coordinates_mut().as_mut_slice()
}

fn velocities_of<S: Scalar, X: StateParts<S>>(bodies: &mut X) -> &mut [S] {
    bodies.velocities_mut().as_mut_slice()
}

/// The compliances of the equations that close loops: those of the same rows of the bodies, so that
/// one coefficient means the same in both coordinates.
pub(crate) fn closing_compliances<S: Scalar, M: JointCoordinates>(
    compliances: &M::Multipliers<S>,
    stabilisation: &Stabilisation<S>,
) -> M::ClosingMultipliers<S> {
    let mut closing = M::ClosingMultipliers::<S>::zeros();
    let rows = closing.as_mut_slice().iter_mut();
    for (compliance, row) in rows.zip(M::JOINT_REPORT.rows) {
        let known = row.and_then(|row| compliances.as_slice().get(row));
        *compliance = known.copied().unwrap_or(stabilisation.compliance);
    }
    closing
}
