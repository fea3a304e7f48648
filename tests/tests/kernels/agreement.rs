//! The public kernels equal those of the assembler, on the constraints and off them.

use holonom::{Real, state::Array};
use holonom_assembler::bodies::Kind;
use nalgebra::{DMatrix, Vector3};

use crate::comparison::{DOUBLE, Worst, distance, tolerance};
use crate::scene::{
    Scene, consistent, constants, dense, rounded, state, states_to_try, values, violated,
};

/// What a vector of residuals is compared with where it is smaller: residuals are differences of
/// numbers of the size 1 (m, m/s, m/s^2, and of unit vectors).
const UNIT: f64 = 1.0;

/// The states of both sets, as the number type sees them.
fn states<M: Scene, S: Real>(count: usize) -> Vec<Vec<f64>> {
    let scene = M::assembler();
    let mut states = consistent(&scene, count, 1);
    states.extend(violated(&scene, count, 2));
    states.iter().map(|x| rounded::<S>(x.as_slice())).collect()
}

/// `Phi`, `Phi'` and `gamma` joint by joint, `D` by its blocks.
fn constraint_kernels<M: Scene, S: Real>(count: usize) {
    let (scene, constants) = (M::assembler(), constants::<S, M>());
    let limit = tolerance::<S>(DOUBLE);
    let mut worst = Worst::default();
    for x in states::<M, S>(count) {
        let state = state::<S, M>(&x);
        for (what, computed, reference) in [
            (
                "Phi",
                M::constraints(&constants, S::zero(), &state),
                scene.constraints(&x),
            ),
            (
                "Phi'",
                M::constraint_rates(&constants, S::zero(), &state),
                scene.constraint_rates(&x),
            ),
            (
                "gamma",
                M::gamma(&constants, S::zero(), &state),
                scene.gamma(&x),
            ),
        ] {
            let computed = values(computed.as_slice());
            for joint in M::REPORT.joints {
                let rows = joint.row..joint.row + joint.rows;
                let deviation =
                    distance(&computed[rows.clone()], &reference.as_slice()[rows], UNIT);
                worst.take(&format!("{what} of {}", joint.name), deviation, limit);
            }
        }
        let blocks = M::jacobian(&constants, S::zero(), &state);
        let (computed, reference) = (dense::<S, M>(blocks.as_slice()), scene.jacobian(&x));
        let mut elsewhere = reference.clone();
        for block in M::REPORT.blocks {
            let part = |matrix: &DMatrix<f64>| -> Vec<f64> {
                let corner = (block.row, block.column);
                let view = matrix.view(corner, (block.rows, block.columns));
                view.iter().copied().collect()
            };
            let deviation = distance(&part(&computed), &part(&reference), 0.0);
            worst.take("D", deviation, limit);
            elsewhere
                .view_mut((block.row, block.column), (block.rows, block.columns))
                .fill(0.0);
        }
        assert_eq!(elsewhere.amax(), 0.0, "D has entries outside of its blocks");
    }
    println!("constraint kernels: largest deviation {:e}", worst.0);
}

/// Mass, `g`, `q'`, energies.
fn dynamic_kernels<M: Scene, S: Real>(count: usize) {
    let (scene, constants) = (M::assembler(), constants::<S, M>());
    let limit = tolerance::<S>(DOUBLE);
    let mut worst = Worst::default();
    let mass = values(M::mass(&constants).as_slice());
    worst.take("M", distance(&mass, scene.mass().as_slice(), 0.0), limit);
    for x in states::<M, S>(count) {
        let state = state::<S, M>(&x);
        let forces = values(M::forces(&constants, S::zero(), &state).as_slice());
        let reference = scene.forces(&x);
        for (body, _, n) in scene.bodies() {
            let weight = n..n + 3;
            let deviation = distance(&forces[weight.clone()], &reference.as_slice()[weight], 0.0);
            worst.take("weight", deviation, limit);
            if body.kind == Kind::Rigid {
                // About a principal axis nothing is left of w x J w.
                let w = Vector3::from_column_slice(&x[scene.coordinates() + n + 3..][..3]);
                let size = w.norm() * body.inertia.component_mul(&w).norm();
                let moment = n + 3..n + 6;
                let deviation =
                    distance(&forces[moment.clone()], &reference.as_slice()[moment], size);
                worst.take("gyroscopic moment", deviation, limit);
            }
        }
        let rates = values(M::coordinate_rates(&constants, &state).as_slice());
        let deviation = distance(&rates, scene.coordinate_rates(&x).as_slice(), 0.0);
        worst.take("q'", deviation, limit);
        let kinetic = M::kinetic_energy(&constants, &state).to_f64();
        let deviation = distance(&[kinetic], &[scene.kinetic_energy(&x)], 0.0);
        worst.take("kinetic energy", deviation, limit);
        // Heights cancel: what counts is the weight of all bodies at 1 m.
        let weight = scene.forces(&vec![0.0; x.len()]).amax() * UNIT;
        let potential = M::potential_energy(&constants, S::zero(), &state).to_f64();
        let deviation = distance(&[potential], &[scene.potential_energy(&x)], weight);
        worst.take("potential energy", deviation, limit);
    }
    println!("dynamic kernels: largest deviation {:e}", worst.0);
}

fn in_double_precision<M: Scene>() {
    constraint_kernels::<M, f64>(states_to_try());
    dynamic_kernels::<M, f64>(states_to_try());
}

fn in_single_precision<M: Scene>() {
    constraint_kernels::<M, f32>(states_to_try());
    dynamic_kernels::<M, f32>(states_to_try());
}

fn initial_state<M: Scene>() {
    /// Round-off of four Euler parameters.
    const ROUND_OFF: f64 = 1e-15;
    let scene = M::assembler();
    let constants = constants::<f64, M>();
    let computed = crate::scene::flat::<f64, M>(&M::initial_state(&constants));
    let reference = scene.initial_state();
    assert!(distance(&computed, reference.as_slice(), 0.0) <= ROUND_OFF);
}

mod in_double_precision {
    every_independent_mechanism! { in_double_precision }
    every_redundant_mechanism! { in_double_precision }
}

mod in_single_precision {
    every_independent_mechanism! { in_single_precision }
    every_redundant_mechanism! { in_single_precision }
}

mod the_initial_state_is_the_one_described {
    every_independent_mechanism! { initial_state }
    every_redundant_mechanism! { initial_state }
}
