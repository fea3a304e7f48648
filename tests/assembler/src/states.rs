//! States for tests: random ones near the initial configuration, and their correction onto the
//! constraints.

use core::f64::consts::TAU;

use nalgebra::{DMatrix, DVector, Vector3, Vector4};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::assembler::Assembler;
use crate::bodies::{Kind, euler_rate};
use crate::jacobi::SingularValues;

/// A generator that gives the same numbers on every machine.
#[must_use]
pub fn generator(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// How far a random state is from the initial one; every bound is a largest magnitude per body and
/// axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Displacement of the centre of mass (m).
    pub position: f64,
    /// Largest rotation (rad).
    pub angle: f64,
    /// Velocity (m/s).
    pub velocity: f64,
    /// Angular velocity (rad/s).
    pub rate: f64,
    /// Relative departure of `|p|` from 1.
    pub norm: f64,
}

impl Default for Spread {
    /// 0.1 m and 0.1 rad off the constraints, 1 m/s and 2 rad/s, unit `p`.
    fn default() -> Self {
        Self {
            position: 0.1,
            angle: 0.1,
            velocity: 1.0,
            rate: 2.0,
            norm: 0.0,
        }
    }
}

impl Spread {
    /// From one state of a walk to the next: far enough to get about, near enough to stay on a
    /// branch.
    pub const STRIDE: Self = Self {
        position: 0.1,
        angle: 0.4,
        velocity: 1.0,
        rate: 2.0,
        norm: 0.0,
    };
}

/// A state around the initial one, with random velocities; in general it violates every constraint.
#[must_use]
pub fn random_state(assembler: &Assembler, spread: Spread, rng: &mut ChaCha8Rng) -> DVector<f64> {
    moved(assembler, &assembler.initial_state(), spread, rng)
}

/// A state with every body moved by a random displacement, its Euler parameters scaled, and with
/// random velocities.
#[must_use]
pub fn moved(
    assembler: &Assembler,
    x: &DVector<f64>,
    spread: Spread,
    rng: &mut ChaCha8Rng,
) -> DVector<f64> {
    let mut any = |size: f64| size * rng.random_range(-1.0..=1.0);
    let mut x = x.clone();
    let mut motion = DVector::zeros(assembler.velocities());
    for (body, _, n) in assembler.bodies() {
        let u = assembler.coordinates() + n;
        for k in 0..body.kind.velocities() {
            // A rotation vector with components up to a / sqrt(3) is no longer than a.
            let turns = k >= 3;
            motion[n + k] = any(if turns {
                spread.angle / 3_f64.sqrt()
            } else {
                spread.position
            });
            x[u + k] = any(if turns { spread.rate } else { spread.velocity });
        }
    }
    displace(assembler, x.as_mut_slice(), motion.as_slice());
    for (body, q, _) in assembler.bodies() {
        if body.kind == Kind::Rigid {
            x.fixed_rows_mut::<4>(q + 3)
                .scale_mut(1.0 + any(spread.norm));
        }
    }
    x
}

/// Moves the coordinates of `x = (q, u)` by finite displacements: translations (m, global axes),
/// and rotation vectors (rad, body axes) that leave `p` at unit length. Angles keep their count
/// while they change by less than half a turn.
pub fn displace(assembler: &Assembler, x: &mut [f64], motion: &[f64]) {
    for (body, q, n) in assembler.bodies() {
        if body.kind != Kind::Ground {
            for k in 0..3 {
                x[q + k] += motion[n + k];
            }
        }
        if body.kind == Kind::Rigid {
            let turn = Vector3::from_column_slice(&motion[n + 3..n + 6]);
            let half = 0.5 * turn.norm();
            let p = Vector4::from_column_slice(&x[q + 3..q + 7]).normalize();
            // p times (cos half, sin half * direction); 2 p' of the rate `turn` is p times (0,
            // turn).
            let sinc = if half == 0.0 { 1.0 } else { half.sin() / half };
            let p = half.cos() * p + sinc * euler_rate(&p, &turn);
            x[q + 3..q + 7].copy_from_slice(p.normalize().as_slice());
        }
    }
    assembler.rewrap(x);
}

/// Lets the auxiliary states of `x = (q, u)` count up to three turns more or fewer, and drift from
/// the angles by up to 1 rad as an integration would let them.
pub fn add_turns(assembler: &Assembler, x: &mut [f64], rng: &mut ChaCha8Rng) {
    for s in &mut x[assembler.body_coordinates()..assembler.coordinates()] {
        *s += TAU * f64::from(rng.random_range(-3..=3_i8)) + rng.random_range(-1.0..=1.0);
    }
}

/// Corrects `x = (q, u)` onto `Phi = 0` and `Phi' = 0` with the pseudo-inverse of `D` (Flores 2015,
/// chapter 12): Newton steps `-D^+ Phi` on the coordinates, rotations as rotations, then
/// `u - D^+ Phi'`. Redundant rows are allowed. `p` comes out with unit length.
///
/// Returns the largest `|Phi|` that is left, or `None` if 50 steps do not bring it to rounding.
#[must_use]
pub fn make_consistent(assembler: &Assembler, x: &mut [f64]) -> Option<f64> {
    make_consistent_at(assembler, 0.0, x)
}

/// The same at a time (s): `Phi' = D u + Phi_t`.
#[must_use]
pub fn make_consistent_at(assembler: &Assembler, time: f64, x: &mut [f64]) -> Option<f64> {
    const SMALL: f64 = 1e-14;
    displace(assembler, x, &vec![0.0; assembler.velocities()]);
    let mut left = assembler.constraints_at(time, x).amax();
    for _ in 0..50 {
        if left <= SMALL {
            break;
        }
        let step = pseudo_inverse(assembler, x) * assembler.constraints_at(time, x);
        let before = x.to_vec();
        displace(assembler, x, (-step).as_slice());
        let now = assembler.constraints_at(time, x).amax();
        if now >= left && left < 100.0 * SMALL {
            // Rounding: no step makes it better.
            x.copy_from_slice(&before);
            break;
        }
        left = now;
    }
    if left.is_nan() || left >= 1e3 * SMALL {
        return None;
    }
    let correction = pseudo_inverse(assembler, x) * assembler.constraint_rates_at(time, x);
    let velocities = &mut x[assembler.coordinates()..];
    for (u, correction) in velocities.iter_mut().zip(correction.iter()) {
        *u -= correction;
    }
    Some(left)
}

/// A random state on the constraints at a time (s): [`random_state`], corrected. Drivers must be
/// near the initial configuration at that time.
///
/// # Panics
/// If 100 random states cannot be corrected.
#[must_use]
pub fn random_consistent_state(
    assembler: &Assembler,
    time: f64,
    spread: Spread,
    rng: &mut ChaCha8Rng,
) -> DVector<f64> {
    for _ in 0..100 {
        let mut x = random_state(assembler, spread, rng);
        if make_consistent_at(assembler, time, x.as_mut_slice()).is_some() {
            return x;
        }
    }
    panic!("no random state near the initial one can be corrected");
}

/// `D^+`, singular values below `1e-9` of the largest counted as zero.
fn pseudo_inverse(assembler: &Assembler, x: &[f64]) -> DMatrix<f64> {
    SingularValues::new(&assembler.jacobian(x)).pseudo_inverse(1e-9)
}
