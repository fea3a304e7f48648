//! Kernels of any mechanism against finite differences of its `Phi`.

use kinematics::{Mechanism, MechanismExt, StateParts, mechanism::BodyKind, state::Array};

/// What a difference of unit-sized numbers may be off by.
const TOLERANCE: f64 = 1e-7;

/// A step for differences of fourth order.
const STEP: f64 = 4e-3;

/// The described state, away from its configuration and moving: every body displaced, turned and
/// given velocities that depend on its place alone.
///
/// # Panics
/// If the mechanism has a parameter that is not acceptable.
#[must_use]
pub fn disturbed<M: Mechanism>(mechanism: &M) -> M::State<f64> {
    let mut state = mechanism.described_state().expect("acceptable parameters");
    let mut number = 0.37;
    let mut next = || {
        number = (number * 7.3 + 0.19) % 1.0;
        number - 0.5
    };
    for element in state.velocities_mut().as_mut_slice() {
        *element = 0.3 * next();
    }
    state = moved::<M>(&state, 1.0);
    for element in state.velocities_mut().as_mut_slice() {
        *element = 2.0 * next();
    }
    state
}

/// `Phi`.
///
/// # Panics
/// If the mechanism has a parameter that is not acceptable.
#[must_use]
pub fn constraints<M: Mechanism>(mechanism: &M, state: &M::State<f64>) -> M::Multipliers<f64> {
    M::constraints(&constants(mechanism), 0.0, state)
}

/// Asserts that `D`, `Phi'` and `gamma` are the derivatives of `Phi` at a state.
///
/// `D` along displacements and rotations about body axes; `Phi' = D u`; `gamma` from the second
/// derivative along the motion with constant `u`, where `0 = D u' = Phi'' + gamma`.
///
/// # Panics
/// If they are not.
pub fn assert_derivatives<M: Mechanism>(mechanism: &M, state: &M::State<f64>) {
    let constants = constants(mechanism);
    let phi = |state: &M::State<f64>| M::constraints(&constants, 0.0, state);
    let rates = M::constraint_rates(&constants, 0.0, state);
    let gamma = M::gamma(&constants, 0.0, state);
    let jacobian = M::jacobian(&constants, 0.0, state);
    let mut products = M::Multipliers::<f64>::zeros();
    for column in 0..M::REPORT.velocities {
        let mut along = *state;
        let velocities = along.velocities_mut().as_mut_slice();
        velocities.fill(0.0);
        velocities[column] = 1.0;
        let slope = stencil::<M>(FIRST, STEP, |h| phi(&moved::<M>(&along, h)));
        let speed = state.velocities().as_slice()[column];
        for row in 0..M::REPORT.equations {
            let entry = entry::<M>(jacobian.as_slice(), row, column);
            assert_near("D", [row, column], entry, slope.as_slice()[row]);
            products.as_mut_slice()[row] += entry * speed;
        }
    }
    let acceleration = stencil::<M>(SECOND, STEP * STEP, |h| phi(&moved::<M>(state, h)));
    for row in 0..M::REPORT.equations {
        assert_near(
            "Phi'",
            [row, 0],
            rates.as_slice()[row],
            products.as_slice()[row],
        );
        assert_near(
            "gamma",
            [row, 0],
            gamma.as_slice()[row],
            -acceleration.as_slice()[row],
        );
    }
}

/// Asserts that two numbers agree as well as finite differences can.
///
/// # Panics
/// If they do not.
#[track_caller]
pub fn assert_near(what: &str, place: [usize; 2], found: f64, expected: f64) {
    let error = (found - expected).abs() / expected.abs().max(1.0);
    assert!(
        error < TOLERANCE,
        "{what} at {place:?}: {found} is not {expected}"
    );
}

fn constants<M: Mechanism>(mechanism: &M) -> M::Constants<f64> {
    mechanism.constants().expect("acceptable parameters")
}

/// An element of `D` from its blocks.
fn entry<M: Mechanism>(values: &[f64], row: usize, column: usize) -> f64 {
    M::REPORT
        .blocks
        .iter()
        .filter(|block| (block.row..block.row + block.rows).contains(&row))
        .filter(|block| (block.column..block.column + block.columns).contains(&column))
        .map(|block| {
            values[block.offset + (row - block.row) * block.columns + column - block.column]
        })
        .sum()
}

/// Weights at -2, -1, 0, 1 and 2 steps, over 12.
const FIRST: [f64; 5] = [1.0, -8.0, 0.0, 8.0, -1.0];
/// The same for the second derivative.
const SECOND: [f64; 5] = [-1.0, 16.0, -30.0, 16.0, -1.0];

fn stencil<M: Mechanism>(
    weights: [f64; 5],
    scale: f64,
    f: impl Fn(f64) -> M::Multipliers<f64>,
) -> M::Multipliers<f64> {
    let mut sum = M::Multipliers::<f64>::zeros();
    for (weight, place) in weights.into_iter().zip([-2.0, -1.0, 0.0, 1.0, 2.0]) {
        let value = f(place * STEP);
        for (sum, value) in sum.as_mut_slice().iter_mut().zip(value.as_slice()) {
            *sum += weight / (12.0 * scale) * value;
        }
    }
    sum
}

/// The state after a time with constant `u`: exact, because a constant rate about body axes turns
/// about a fixed axis.
fn moved<M: Mechanism>(state: &M::State<f64>, time: f64) -> M::State<f64> {
    let mut result = *state;
    let velocities = state.velocities().as_slice();
    let coordinates = result.coordinates_mut().as_mut_slice();
    for body in M::REPORT.bodies {
        let (q, u) = (body.coordinate, body.velocity);
        for k in 0..3 {
            coordinates[q + k] += time * velocities[u + k];
        }
        if body.kind == BodyKind::Rigid {
            let p: &mut [f64] = &mut coordinates[q + 3..q + 7];
            let w = &velocities[u + 3..u + 6];
            let rate = w.iter().map(|w| w * w).sum::<f64>().sqrt();
            let (sine, c) = (0.5 * rate * time).sin_cos();
            let [x, y, z] = [0, 1, 2].map(|k| if rate > 0.0 { sine * w[k] / rate } else { 0.0 });
            let [e0, e1, e2, e3] = [p[0], p[1], p[2], p[3]];
            p[0] = e0 * c - e1 * x - e2 * y - e3 * z;
            p[1] = e0 * x + e1 * c + e2 * z - e3 * y;
            p[2] = e0 * y - e1 * z + e2 * c + e3 * x;
            p[3] = e0 * z + e1 * y - e2 * x + e3 * c;
        }
    }
    result
}
