//! The rod of [`super::rod`] with a driver: its angle, which counts turns, follows a polynomial of
//! time.

use core::array::from_fn;

use super::dense;
use super::rod::Rod;
use crate::mechanism::{
    AngleParts, Block, DisplacementParts, Driven, ExplicitTime, HasAngle, HasDisplacement, Joint,
    JointInfo, Pivot, Stabilisation, Terms,
};
use crate::state::State;
use crate::*;

/// The angle is `start + speed t + acceleration t^2 / 2`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crank {
    pub(super) start: f64,
    pub(super) speed: f64,
    pub(super) acceleration: f64,
}

/// A hinge with a driver in its last row.
pub(super) struct DrivenHinge;

impl Joint for DrivenHinge {
    const NAME: &'static str = "DrivenHinge";
    const EQUATIONS: usize = 6;
    const BODIES: usize = 2;
    const FINGERPRINT: u64 = 1;
}

impl HasAngle for DrivenHinge {}

impl HasDisplacement for DrivenHinge {}

impl Driven for DrivenHinge {
    const ROW: usize = 5;
}

pub(super) const CRANK: BodyHandle<Crank> = BodyHandle::new(0);
pub(super) const MOTOR: JointHandle<Crank, DrivenHinge> = JointHandle::new(0);

/// The constants of the rod, and those of the law.
type Constants<S> = [S; 9];

fn rod<S>(c: &Constants<S>) -> &[S; 6] {
    c.first_chunk().unwrap()
}

/// Value, rate and second derivative of the law.
fn law<S: Scalar>(c: &Constants<S>, t: S) -> [S; 3] {
    let [.., start, speed, acceleration] = *c;
    let half = S::constant(0.5);
    [
        start + t * (speed + t * half * acceleration),
        speed + t * acceleration,
        acceleration,
    ]
}

fn body<S: Scalar>(state: &State<S, 8, 6>) -> State<S, 7, 6> {
    State::from_parts(from_fn(|k| state.coordinates()[k]), *state.velocities())
}

fn and<S: Copy>(rows: [S; 5], last: S) -> [S; 6] {
    from_fn(|k| rows.get(k).copied().unwrap_or(last))
}

impl Mechanism for Crank {
    type Coordinates = crate::mechanism::Absolute;
    type State<S: Scalar> = State<S, 8, 6>;
    type Velocities<S: Scalar> = [S; 6];
    type Multipliers<S: Scalar> = [S; 6];
    type Jacobian<S: Scalar> = [S; 36];
    type Parameters<S: Scalar> = [S; 3];
    type Inputs<S: Scalar> = ();
    type Constants<S: Scalar> = Constants<S>;
    /// The two gains, and a compliance for each row.
    type Coefficients<S: Scalar> = [S; 8];
    type Factors<S: Scalar> = dense::Factors<S, 36, 6>;
    type Handles = ();
    type PerLimit<T: Clone> = crate::mechanism::Nothing;

    const HANDLES: () = ();
    const REPORT: Report = Report {
        name: "Crank",
        joints: &[JointInfo {
            name: "motor",
            kind: "DrivenHinge",
            row: 0,
            rows: 6,
            bodies: &[None, Some(0)],
            has_angle: true,
            has_displacement: true,
            has_point: true,
            auxiliary: 7,
            auxiliaries: 1,
            undetermined: &[],
        }],
        blocks: &[Block {
            joint: 0,
            body: 0,
            row: 0,
            rows: 6,
            column: 0,
            columns: 6,
            offset: 0,
        }],
        auxiliaries: 1,
        states: &[],
        equations: 6,
        degrees_of_freedom: 0,
        velocity_rows: &[],
        time: ExplicitTime {
            constraints: true,
            ..ExplicitTime::NONE
        },
        ..Rod::REPORT
    };

    fn inputs<S: Scalar>(&self) {}

    fn limits_of<S: Scalar, T: Clone>(
        _: &Self::Parameters<S>,
        _: impl FnMut(crate::mechanism::JointLimits<S>) -> T,
    ) -> crate::mechanism::Nothing {
        crate::mechanism::Nothing
    }

    fn parameters<S: Scalar>(&self) -> Result<[S; 3], ParameterError> {
        Ok([self.start, self.speed, self.acceleration].map(S::constant))
    }

    fn prepare<S: Scalar>(law: &[S; 3]) -> Constants<S> {
        let rod = Rod::prepare(&[S::constant(7.02)]);
        from_fn(|k| rod.get(k).copied().unwrap_or_else(|| law[k - 6]))
    }

    fn coefficients_by_row<S: Scalar>(
        _: &Constants<S>,
        stabilisation: &Stabilisation<S>,
        compliances: &[S; 6],
    ) -> Self::Coefficients<S> {
        let Stabilisation { rate, position, .. } = *stabilisation;
        let [a, b, c, d, e, f] = *compliances;
        [rate, position, a, b, c, d, e, f]
    }

    fn initial_state<S: Scalar>(c: &Constants<S>) -> State<S, 8, 6> {
        let rod = Rod::initial_state(rod(c));
        let coordinates = from_fn(|k| rod.coordinates().get(k).copied().unwrap_or(S::zero()));
        State::from_parts(coordinates, *rod.velocities())
    }

    fn constraints<S: Scalar>(c: &Constants<S>, time: S, state: &State<S, 8, 6>) -> [S; 6] {
        let rows = Rod::constraints(rod(c), time, &body(state));
        let [angle, ..] = law(c, time);
        and(rows, Self::joint_angle(c, state, 0).angle() - angle)
    }

    fn constraint_rates<S: Scalar>(c: &Constants<S>, time: S, state: &State<S, 8, 6>) -> [S; 6] {
        let rows = Rod::constraint_rates(rod(c), time, &body(state));
        let [_, rate, _] = law(c, time);
        and(rows, state.velocities()[3] - rate)
    }

    fn jacobian<S: Scalar>(c: &Constants<S>, time: S, state: &State<S, 8, 6>) -> [S; 36] {
        let rod = Rod::jacobian(rod(c), time, &body(state));
        let mut jacobian = [S::zero(); 36];
        jacobian[..30].copy_from_slice(&rod);
        jacobian[33] = S::one();
        jacobian
    }

    fn gamma<S: Scalar>(c: &Constants<S>, time: S, state: &State<S, 8, 6>) -> [S; 6] {
        let [_, _, acceleration] = law(c, time);
        and(Rod::gamma(rod(c), time, &body(state)), acceleration)
    }

    fn mass<S: Scalar>(c: &Constants<S>) -> [S; 6] {
        Rod::mass(rod(c))
    }

    fn forces<S: Scalar>(c: &Constants<S>, time: S, state: &State<S, 8, 6>) -> [S; 6] {
        Rod::forces(rod(c), time, &body(state))
    }

    fn kinetic_energy<S: Scalar>(c: &Constants<S>, state: &State<S, 8, 6>) -> S {
        Rod::kinetic_energy(rod(c), &body(state))
    }

    fn potential_energy<S: Scalar>(c: &Constants<S>, time: S, state: &State<S, 8, 6>) -> S {
        Rod::potential_energy(rod(c), time, &body(state))
    }

    fn coordinate_rates<S: Scalar>(c: &Constants<S>, state: &State<S, 8, 6>) -> [S; 8] {
        let rates = Rod::coordinate_rates(rod(c), &body(state));
        let turning = state.velocities()[3];
        from_fn(|k| rates.get(k).copied().unwrap_or(turning))
    }

    fn rewrap<S: Scalar>(c: &Constants<S>, state: &mut State<S, 8, 6>) {
        state.coordinates_mut()[7] = Self::joint_angle(c, state, 0).angle();
    }

    fn evaluate_into<S: Scalar, T: Terms>(
        c: &Constants<S>,
        coefficients: &Self::Coefficients<S>,
        time: S,
        state: &State<S, 8, 6>,
        rates: &mut State<S, 8, 6>,
        multipliers: &mut [S; 6],
    ) -> Pivot<S> {
        let read = &crate::mechanism::orientations::with_unit_orientations::<S, Self>(state);
        let (factors, pivot) = Self::factor::<S, T>(c, coefficients, time, read);
        let mut lower = Self::gamma(c, time, read);
        if T::STABILISED {
            let phi = Self::constraints(c, time, read);
            let phi_rate = Self::constraint_rates(c, time, read);
            let [rate, position, ..] = *coefficients;
            lower = from_fn(|i| lower[i] - (rate * phi_rate[i] + position * phi[i]));
        }
        let upper = Self::forces(c, time, read);
        let accelerations;
        (accelerations, *multipliers) =
            Self::solve::<S, T>(c, coefficients, &factors, &upper, &lower);
        *rates = State::from_parts(Self::coordinate_rates(c, state), accelerations);
        pivot
    }

    fn factor<S: Scalar, T: Terms>(
        c: &Constants<S>,
        coefficients: &Self::Coefficients<S>,
        time: S,
        state: &State<S, 8, 6>,
    ) -> (Self::Factors<S>, Pivot<S>) {
        let compliance = T::COMPLIANT.then_some(coefficients.last_chunk()).flatten();
        dense::factor(Self::jacobian(c, time, state), rod(c), compliance)
    }

    fn solve<S: Scalar, T: Terms>(
        c: &Constants<S>,
        _: &Self::Coefficients<S>,
        factors: &Self::Factors<S>,
        upper: &[S; 6],
        lower: &[S; 6],
    ) -> ([S; 6], [S; 6]) {
        dense::solve(factors, rod(c), upper, lower)
    }

    fn joint_angle<S: Scalar>(
        c: &Constants<S>,
        state: &State<S, 8, 6>,
        joint: usize,
    ) -> AngleParts<S> {
        AngleParts {
            turns: Some(state.coordinates()[7]),
            ..Rod::joint_angle(rod(c), &body(state), joint)
        }
    }

    /// The height of the tip above the hinge.
    fn joint_displacement<S: Scalar>(
        _: &Constants<S>,
        _: S,
        state: &State<S, 8, 6>,
        _: usize,
    ) -> DisplacementParts<S> {
        let two = S::constant(2.0);
        DisplacementParts {
            value: two * state.coordinates()[2],
            rate: two * state.velocities()[2],
        }
    }

    fn joint_point<S: Scalar>(c: &Constants<S>, joint: usize, place: usize) -> [S; 3] {
        Rod::joint_point(rod(c), joint, place)
    }

    fn user_axes(body: usize) -> [f64; 4] {
        Rod::user_axes(body)
    }
}

/// A crank at a constant speed (rad/s).
pub(super) fn crank(speed: f64) -> Crank {
    Crank {
        start: 0.0,
        speed,
        acceleration: 0.0,
    }
}
