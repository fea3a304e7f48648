//! The rod of Flores 2015, chapter 15, hinged to the ground about x, with dense kernels written by
//! hand.
//!
//! The user's axes are chosen turned by 90 degrees about x against the principal axes, so that
//! access by handle has something to do.

use core::array::from_fn;

use super::dense;
use crate::error::ParameterFault;
use crate::math::quaternion::{self, rotate, rotate_back};
use crate::math::vec3::cross;
use crate::mechanism::{
    AngleParts, Block, BodyInfo, BodyKind, Carrier, ExplicitTime, HasAngle, Joint, JointInfo,
    Pivot, Rank, Stabilisation, Terms, orientations,
};
use crate::state::State;
use crate::*;

/// The rod; its mass is a parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rod {
    pub(super) mass: f64,
}

/// A revolute joint as a type.
pub(super) struct Hinge;

impl Joint for Hinge {
    const NAME: &'static str = "Hinge";
    const EQUATIONS: usize = 5;
    const BODIES: usize = 2;
    const FINGERPRINT: u64 = 0;
}

impl HasAngle for Hinge {}

pub(super) const ROD: BodyHandle<Rod> = BodyHandle::new(0);
pub(super) const PIVOT: JointHandle<Rod, Hinge> = JointHandle::new(0);
pub(super) const GRAVITY: f64 = 9.81;
const INERTIA: [f64; 3] = [0.5855265, 0.0010530, 0.5855265];

type Factors<S> = dense::Factors<S, 30, 5>;

fn split<S: Scalar>(state: &State<S, 7, 6>) -> ([S; 3], [S; 4], [S; 3], [S; 3]) {
    let [x, y, z, e0, e1, e2, e3] = *state.coordinates();
    let [vx, vy, vz, wx, wy, wz] = *state.velocities();
    ([x, y, z], [e0, e1, e2, e3], [vx, vy, vz], [wx, wy, wz])
}

fn vector<S: Scalar>(v: [f64; 3]) -> [S; 3] {
    v.map(S::constant)
}

fn dot<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// From the centre of mass to the hinge.
const ARM: [f64; 3] = [0.0, -0.5, 0.0];
const AXIS: [f64; 3] = [1.0, 0.0, 0.0];
const NORMALS: [[f64; 3]; 2] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl Mechanism for Rod {
    type Coordinates = crate::mechanism::Absolute;
    type State<S: Scalar> = State<S, 7, 6>;
    type Velocities<S: Scalar> = [S; 6];
    type Multipliers<S: Scalar> = [S; 5];
    type Jacobian<S: Scalar> = [S; 30];
    type Parameters<S: Scalar> = [S; 1];
    type Inputs<S: Scalar> = ();
    type Constants<S: Scalar> = [S; 6];
    /// The two gains, and a compliance for each row.
    type Coefficients<S: Scalar> = [S; 7];
    type Factors<S: Scalar> = Factors<S>;
    type Handles = ();
    type PerLimit<T: Clone> = crate::mechanism::Nothing;

    const HANDLES: () = ();
    const REPORT: Report = Report {
        name: "Rod",
        bodies: &[BodyInfo {
            name: "rod",
            kind: BodyKind::Rigid,
            coordinate: 0,
            velocity: 0,
        }],
        joints: &[JointInfo {
            name: "pivot",
            kind: "Hinge",
            row: 0,
            rows: 5,
            bodies: &[None, Some(0)],
            has_angle: true,
            has_displacement: false,
            has_point: true,
            auxiliary: 7,
            auxiliaries: 0,
            undetermined: &[],
        }],
        forces: &[],
        markers: &[],
        points: &[],
        values: &[],
        shapes: &[],
        carriers: &[Carrier {
            body: None,
            joint: Some(0),
        }],
        blocks: &[Block {
            joint: 0,
            body: 0,
            row: 0,
            rows: 5,
            column: 0,
            columns: 6,
            offset: 0,
        }],
        coordinates: 7,
        auxiliaries: 0,
        states: &[],
        velocities: 6,
        equations: 5,
        rank: Rank::Decided {
            rank: 5,
            at_start: 5,
        },
        redundant: &[],
        degrees_of_freedom: 1,
        velocity_rows: &[],
        time: ExplicitTime::NONE,
        curved: false,
        kernels: &[],
        plan: "",
    };

    fn inputs<S: Scalar>(&self) {}

    fn limits_of<S: Scalar, T: Clone>(
        _: &Self::Parameters<S>,
        _: impl FnMut(crate::mechanism::JointLimits<S>) -> T,
    ) -> crate::mechanism::Nothing {
        crate::mechanism::Nothing
    }

    fn parameters<S: Scalar>(&self) -> Result<[S; 1], ParameterError> {
        let fault = if !self.mass.is_finite() {
            ParameterFault::NotFinite
        } else if self.mass <= 0.0 {
            ParameterFault::NotPositive
        } else {
            return Ok([S::constant(self.mass)]);
        };
        Err(ParameterError {
            field: "rod",
            attribute: "mass",
            fault,
        })
    }

    fn prepare<S: Scalar>([mass]: &[S; 1]) -> [S; 6] {
        let [j1, j2, j3] = vector(INERTIA);
        [*mass, *mass, *mass, j1, j2, j3]
    }

    fn coefficients_by_row<S: Scalar>(
        _: &[S; 6],
        stabilisation: &Stabilisation<S>,
        compliances: &[S; 5],
    ) -> Self::Coefficients<S> {
        let Stabilisation { rate, position, .. } = *stabilisation;
        let [a, b, c, d, e] = *compliances;
        [rate, position, a, b, c, d, e]
    }

    fn initial_state<S: Scalar>(_: &[S; 6]) -> State<S, 7, 6> {
        let coordinates = [0.0, 0.5, 0.0, 1.0, 0.0, 0.0, 0.0].map(S::constant);
        State::from_parts(coordinates, [S::zero(); 6])
    }

    fn constraints<S: Scalar>(_: &[S; 6], _: S, state: &State<S, 7, 6>) -> [S; 5] {
        let (r, p, _, _) = split(state);
        let arm = rotate(&p, &vector(ARM));
        let axis = rotate(&p, &vector(AXIS));
        let [y, z] = NORMALS.map(|n| dot(&vector(n), &axis));
        [r[0] + arm[0], r[1] + arm[1], r[2] + arm[2], y, z]
    }

    fn constraint_rates<S: Scalar>(c: &[S; 6], time: S, state: &State<S, 7, 6>) -> [S; 5] {
        let d = Self::jacobian(c, time, state);
        let u = state.velocities();
        from_fn(|i| (0..6).fold(S::zero(), |sum, k| sum + d[6 * i + k] * u[k]))
    }

    fn jacobian<S: Scalar>(_: &[S; 6], _: S, state: &State<S, 7, 6>) -> [S; 30] {
        let (_, p, _, _) = split(state);
        let mut d = [S::zero(); 30];
        for axis in 0..3 {
            d[6 * axis + axis] = S::one();
            let unit: [S; 3] = from_fn(|k| if k == axis { S::one() } else { S::zero() });
            // n . A (w x s) = w . (s x A^T n)
            let row = cross(&vector(ARM), &rotate_back(&p, &unit));
            d[6 * axis + 3..6 * axis + 6].copy_from_slice(&row);
        }
        for (place, normal) in NORMALS.iter().enumerate() {
            let row = cross(&vector(AXIS), &rotate_back(&p, &vector(*normal)));
            d[21 + 6 * place..24 + 6 * place].copy_from_slice(&row);
        }
        d
    }

    fn gamma<S: Scalar>(_: &[S; 6], _: S, state: &State<S, 7, 6>) -> [S; 5] {
        let (_, p, _, w) = split(state);
        let turned = |s: [f64; 3]| rotate(&p, &cross(&w, &cross(&w, &vector(s))));
        let [x, y, z] = turned(ARM);
        let axis = turned(AXIS);
        let [n1, n2] = NORMALS.map(|n| dot(&vector(n), &axis));
        [-x, -y, -z, -n1, -n2]
    }

    fn mass<S: Scalar>(c: &[S; 6]) -> [S; 6] {
        *c
    }

    fn forces<S: Scalar>(c: &[S; 6], _: S, state: &State<S, 7, 6>) -> [S; 6] {
        let (_, _, _, w) = split(state);
        let [mx, my, mz] = cross(&w, &[c[3] * w[0], c[4] * w[1], c[5] * w[2]]);
        [
            S::zero(),
            S::zero(),
            -c[0] * S::constant(GRAVITY),
            -mx,
            -my,
            -mz,
        ]
    }

    fn kinetic_energy<S: Scalar>(c: &[S; 6], state: &State<S, 7, 6>) -> S {
        let u = state.velocities();
        S::constant(0.5) * (0..6).fold(S::zero(), |sum, k| sum + c[k] * u[k] * u[k])
    }

    fn potential_energy<S: Scalar>(c: &[S; 6], _: S, state: &State<S, 7, 6>) -> S {
        c[2] * S::constant(GRAVITY) * state.coordinates()[2]
    }

    fn coordinate_rates<S: Scalar>(_: &[S; 6], state: &State<S, 7, 6>) -> [S; 7] {
        let (_, p, [x, y, z], [w1, w2, w3]) = split(state);
        let half = S::constant(0.5);
        let rates = quaternion::product(&p, &[S::zero(), half * w1, half * w2, half * w3]);
        [x, y, z, rates[0], rates[1], rates[2], rates[3]]
    }

    fn evaluate_into<S: Scalar, T: Terms>(
        c: &[S; 6],
        coefficients: &Self::Coefficients<S>,
        time: S,
        state: &State<S, 7, 6>,
        rates: &mut State<S, 7, 6>,
        multipliers: &mut [S; 5],
    ) -> Pivot<S> {
        let read = &orientations::with_unit_orientations::<S, Self>(state);
        let (factors, pivot) = Self::factor::<S, T>(c, coefficients, time, read);
        let mut lower = Self::gamma(c, time, read);
        if T::STABILISED {
            let phi = Self::constraints(c, time, read);
            let phi_rate = Self::constraint_rates(c, time, read);
            let [rate, position, ..] = *coefficients;
            for k in 0..5 {
                lower[k] = lower[k] - rate * phi_rate[k] - position * phi[k];
            }
        }
        let upper = Self::forces(c, time, read);
        let accelerations;
        (accelerations, *multipliers) =
            Self::solve::<S, T>(c, coefficients, &factors, &upper, &lower);
        *rates = State::from_parts(Self::coordinate_rates(c, state), accelerations);
        pivot
    }

    fn factor<S: Scalar, T: Terms>(
        c: &[S; 6],
        coefficients: &Self::Coefficients<S>,
        time: S,
        state: &State<S, 7, 6>,
    ) -> (Factors<S>, Pivot<S>) {
        let compliance = T::COMPLIANT.then_some(coefficients.last_chunk()).flatten();
        dense::factor(Self::jacobian(c, time, state), c, compliance)
    }

    fn solve<S: Scalar, T: Terms>(
        c: &[S; 6],
        _: &Self::Coefficients<S>,
        factors: &Factors<S>,
        upper: &[S; 6],
        lower: &[S; 5],
    ) -> ([S; 6], [S; 5]) {
        dense::solve(factors, c, upper, lower)
    }

    fn joint_angle<S: Scalar>(_: &[S; 6], state: &State<S, 7, 6>, _: usize) -> AngleParts<S> {
        let (_, p, _, w) = split(state);
        let along = rotate(&p, &vector([0.0, 1.0, 0.0]));
        AngleParts {
            cosine: along[1],
            sine: along[2],
            rate: w[0],
            turns: None,
        }
    }

    fn joint_point<S: Scalar>(_: &[S; 6], _: usize, place: usize) -> [S; 3] {
        if place == 1 {
            vector(ARM)
        } else {
            [S::zero(); 3]
        }
    }

    fn user_axes(_: usize) -> [f64; 4] {
        let half = core::f64::consts::FRAC_1_SQRT_2;
        [half, half, 0.0, 0.0]
    }
}

/// The rod of the book.
pub(super) fn rod() -> Rod {
    Rod { mass: 7.02 }
}
