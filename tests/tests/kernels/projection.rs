//! The correction onto the constraints: to round-off, with the least movement in the metric of the
//! mass, or not at all.

use holonom::error::StepFault;
use holonom::prelude::*;
use holonom::{Fault, constraints::Correction, state::Array};
use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::Kind;
use holonom_assembler::jacobi::SingularValues;
use holonom_assembler::states::Spread;
use nalgebra::{DVector, Quaternion};

use crate::comparison::Worst;
use crate::mechanisms::PlanarFourBar;
use crate::scene::{Scene, constants, flat, off, state};

/// Round-off of `Phi` and `Phi'`, whose terms are of the size 1 m and some m/s.
const ROUND_OFF: f64 = 1e-14;

const STATES: usize = 200;

const fn disturbed(size: f64) -> Spread {
    Spread {
        position: size,
        angle: size,
        velocity: 1.0,
        rate: 2.0,
        norm: 0.0,
    }
}

/// The corrected state, and what the correction says of itself.
fn corrected<M: Scene>(x: &DVector<f64>) -> (DVector<f64>, Correction<f64>) {
    let mut state = state::<f64, M>(x.as_slice());
    let correction = M::default()
        .assemble(0.0, &mut state)
        .expect("it converges");
    (flat::<f64, M>(&state).into(), correction)
}

fn to_round_off<M: Scene>() {
    let (scene, constants) = (M::assembler(), constants::<f64, M>());
    let (mut phi, mut rates) = (Worst::default(), Worst::default());
    let spread = Spread {
        norm: 0.05,
        ..disturbed(0.05)
    };
    for x in off(&scene, STATES, 17, spread) {
        let (y, correction) = corrected::<M>(&x);
        let (before, left) = (
            scene.constraints(x.as_slice()),
            scene.constraints(y.as_slice()),
        );
        phi.take("Phi", left.amax(), ROUND_OFF);
        let left = scene.constraint_rates(y.as_slice());
        let speed = y.rows(scene.coordinates(), scene.velocities()).amax();
        rates.take("Phi'", left.amax(), ROUND_OFF * (1.0 + speed));
        for (body, q, _) in scene.bodies() {
            if body.kind == Kind::Rigid {
                let p = y.fixed_rows::<4>(q + 3);
                assert!((p.norm() - 1.0).abs() <= 2.0 * f64::EPSILON);
            }
        }
        let told = (
            correction.violation_before,
            correction.velocity_violation_before,
        );
        assert!((told.0 - before.norm_squared()).abs() <= 1e-12 * before.norm_squared());
        let given = state::<f64, M>(x.as_slice());
        let rates_before = M::constraint_rates(&constants, 0.0, &given);
        let before: f64 = rates_before.as_slice().iter().map(|rate| rate * rate).sum();
        assert!((told.1 - before).abs() <= 1e-12 * before);
        assert!(correction.violation_after <= (ROUND_OFF * 10.0).powi(2));
    }
    println!("corrected: Phi {:e}, Phi' {:e}", phi.0, rates.0);
}

/// From one configuration to another: displacements (m), and rotation vectors along body axes (rad)
/// to first order.
fn movement(scene: &Assembler, from: &DVector<f64>, to: &DVector<f64>) -> DVector<f64> {
    let mut movement = DVector::zeros(scene.velocities());
    for (body, q, n) in scene.bodies() {
        for k in 0..3 {
            movement[n + k] = to[q + k] - from[q + k];
        }
        if body.kind == Kind::Rigid {
            let p = |x: &DVector<f64>| Quaternion::new(x[q + 3], x[q + 4], x[q + 5], x[q + 6]);
            let turn = p(from).conjugate() * p(to);
            for k in 0..3 {
                movement[n + 3 + k] = 2.0 * turn.imag()[k] * turn.w.signum();
            }
        }
    }
    movement
}

/// The part of `M d` along the motions that the constraints leave free, relative to `|M d|`: zero
/// for the least movement. And the norm of `D^+`.
fn along_free_motions(scene: &Assembler, x: &DVector<f64>, movement: &DVector<f64>) -> (f64, f64) {
    let jacobian = scene.jacobian(x.as_slice());
    let inverse = SingularValues::new(&jacobian).pseudo_inverse(1e-9);
    let momentum = scene.mass().component_mul(movement);
    let free = &momentum - &inverse * (&jacobian * &momentum);
    (free.norm() / momentum.norm(), inverse.norm())
}

fn with_the_least_movement<M: Scene>() {
    /// A displacement is the least one up to its square: the rows of `D` turn with it, and where
    /// they are nearly dependent (`|D^+|` is large) the more so.
    const CURVATURE: f64 = 10.0;
    /// Velocities are corrected by a linear system, solved to the compliance of `sqrt(EPSILON)` and
    /// repeated.
    const LINEAR: f64 = 1e-9;
    let scene = M::assembler();
    let (mut positions, mut velocities) = (Worst::default(), Worst::default());
    for size in [1e-2, 1e-3, 1e-4] {
        for x in off(&scene, STATES / 4, 18, disturbed(size)) {
            let (y, _) = corrected::<M>(&x);
            let moved = movement(&scene, &x, &y);
            let (deviation, inverse) = along_free_motions(&scene, &y, &moved);
            let deviation = deviation / (size * inverse.max(1.0));
            positions.take("positions", deviation, CURVATURE);
            let change = (&y - &x)
                .rows(scene.coordinates(), scene.velocities())
                .into();
            let (deviation, _) = along_free_motions(&scene, &y, &change);
            velocities.take("velocities", deviation, LINEAR);
        }
    }
    println!(
        "least movement: positions {:e}, velocities {:e}",
        positions.0, velocities.0
    );
}

fn a_failure_leaves_the_state<M: Scene>() {
    let hasty = Projection {
        tolerance: 1e-14,
        max_iterations: 1,
    };
    let constants = constants::<f64, M>();
    for x in off(&M::assembler(), 20, 19, disturbed(0.1)) {
        let mut state = state::<f64, M>(x.as_slice());
        let fault = hasty.correct::<M>(&constants, 0.0, &mut state);
        assert!(
            matches!(fault, Err(Fault::Step(StepFault::NotConverged { iterations: 1, residual, .. })) if residual > 0.0),
            "{fault:?}"
        );
        assert_eq!(flat::<f64, M>(&state), x.as_slice());
    }
}

mod to_round_off {
    every_independent_mechanism! { to_round_off }
    every_redundant_mechanism! { to_round_off }
}

mod with_the_least_movement {
    every_independent_mechanism! { with_the_least_movement }
    each! { with_the_least_movement: door crate::mechanisms::Door }
}

/// Off the constraints the equations of a planar loop are nearly, not exactly, dependent: a
/// violation of the size `s` meets pivots of the size `s`, and part of the movement is along the
/// free motion, whatever `s` is.
#[test]
fn a_planar_loop_moves_little_more_than_it_must() {
    /// The part of `M d` along the free motion: a movement longer by some percent than the least.
    const PART: f64 = 0.5;
    let scene = PlanarFourBar::assembler();
    let mut worst = Worst::default();
    for size in [1e-2, 1e-3, 1e-4] {
        for x in off(&scene, STATES / 4, 18, disturbed(size)) {
            let (y, _) = corrected::<PlanarFourBar>(&x);
            let (part, _) = along_free_motions(&scene, &y, &movement(&scene, &x, &y));
            worst.take("free part", part, PART);
        }
    }
    println!(
        "free part of the correction of a planar loop: {:e}",
        worst.0
    );
}

mod a_failure_leaves_the_state {
    every_independent_mechanism! { a_failure_leaves_the_state }
    every_redundant_mechanism! { a_failure_leaves_the_state }
}

/// Two seconds of a redundant loop in single steps, corrected after each.
#[test]
fn a_run_with_corrections_stays_on_the_constraints() {
    let linkage = PlanarFourBar::default();
    let run = |projection: Option<Projection<f64>>| {
        let mut simulation = Simulation::new(&linkage, Penalty::default(), Rk4::every(5e-3));
        if let Some(projection) = projection {
            simulation = simulation.projection(projection);
        }
        simulation
            .run(0.0..=2.0, every_step(), |_| ControlFlow::Continue(()))
            .expect("solvable")
    };
    let (free, corrected) = (run(None), run(Some(Projection::default())));
    println!(
        "violation: {:e} without, {:e} with corrections",
        free.worst_violation, corrected.worst_violation
    );
    assert!(corrected.worst_violation <= ROUND_OFF.powi(2) * 20.0);
    assert!(
        free.worst_violation >= 1e6 * corrected.worst_violation,
        "nothing to correct"
    );
}
