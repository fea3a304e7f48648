//! Problems with known answers: the rod of chapter 15 and the heavy top.

use nalgebra::Vector3;

use super::{ORIENTATIONS, integrate};
use crate::accuracy::{assert_close, relative_error};
use crate::assembler::{Assembler, JointId};
use crate::formulation::{Evaluator, Formulation};
use crate::scenes;

fn first_joint(scene: &Assembler) -> JointId {
    scene.joint_ids().next().expect("a joint")
}

fn energy(scene: &Assembler, x: &[f64]) -> f64 {
    scene.kinetic_energy(x) + scene.potential_energy(x)
}

#[test]
fn the_rod_starts_with_the_accelerations_of_the_closed_form() {
    for orientation in ORIENTATIONS {
        let scene = scenes::pendulum().with_orientation(orientation);
        let x = scene.initial_state();
        let mut evaluator = Evaluator::new(scene.clone(), Formulation::Standard);
        let mut out = vec![0.0; 13];
        evaluator
            .rates(0.0, x.as_slice(), &mut out)
            .expect("solvable");
        // phi'' = -w0^2 sin phi about x, r'' = phi'' / 2 down.
        let w0_squared = 14.711_689_869_779_3;
        let expected = [0.0, 0.0, -0.5 * w0_squared, -w0_squared, 0.0, 0.0];
        assert_close("u'", &out[7..], &expected, 1e-14);
        // Transverse force at the pin: m (g - w0^2 / 2), upwards on the rod.
        let lambda = evaluator.multipliers();
        let [ground, rod] = scene.reactions(first_joint(&scene), x.as_slice(), lambda);
        let up = 7.02 * (9.81 - 0.5 * w0_squared);
        assert_close("force", rod.force.as_slice(), &[0.0, 0.0, up], 1e-13);
        assert_close("force", ground.force.as_slice(), &[0.0, 0.0, -up], 1e-13);
        assert_close("moment", rod.moment.as_slice(), &[0.0; 3], 1e-13);
    }
}

#[test]
fn the_rod_swings_as_the_closed_form_and_keeps_its_energy() {
    let scene = scenes::pendulum();
    let mut x = scene.initial_state();
    let start = energy(&scene, x.as_slice());
    let mut evaluator = Evaluator::new(scene.clone(), Formulation::Standard);
    integrate(&mut evaluator, x.as_mut_slice(), 5e-4, 2000);
    let drift = energy(&scene, x.as_slice()) - start;
    assert!(drift.abs() < 1e-9, "{drift:e}");
    // At 1 s; phi from the vertical, the rod along (sin phi, -cos phi) in y and z.
    let phi: f64 = -1.562_676_795_263_082_5;
    assert_close(
        "r",
        &x.as_slice()[..3],
        &[0.0, 0.5 * phi.sin(), -0.5 * phi.cos()],
        1e-9,
    );
    assert!((x[10] - 0.488_775_443_886_885_4).abs() < 1e-9);

    // Reaction: N towards the pin, S across, turned into global axes; on the pin they are opposite.
    let mut out = vec![0.0; 13];
    evaluator
        .rates(0.0, x.as_slice(), &mut out)
        .expect("solvable");
    let [_, rod] = scene.reactions(first_joint(&scene), x.as_slice(), evaluator.multipliers());
    let along = Vector3::new(0.0, phi.sin(), -phi.cos());
    let across = Vector3::new(0.0, phi.cos(), phi.sin());
    assert!(relative_error(-rod.force.dot(&along), 1.397_699_173_704_197) < 1e-8);
    assert!(relative_error(rod.force.dot(&across), -17.227_600_661_249_58) < 1e-8);
}

#[test]
fn the_heavy_top_presses_as_published_and_keeps_its_invariants() {
    let scene = scenes::heavy_top();
    let joint = first_joint(&scene);
    let mut x = scene.initial_state();
    let mut evaluator = Evaluator::new(scene.clone(), Formulation::Standard);
    let mut out = vec![0.0; 13];
    evaluator
        .rates(0.0, x.as_slice(), &mut out)
        .expect("solvable");
    let [_, top] = scene.reactions(joint, x.as_slice(), evaluator.multipliers());
    let published = [0.0, -319.525988166, -317.262461538462];
    assert_close("reaction", top.force.as_slice(), &published, 1e-12);
    assert_close("moment", top.moment.as_slice(), &[0.0; 3], 1e-12);

    let published = 5435.696790865547;
    assert!(relative_error(energy(&scene, x.as_slice()), published) < 1e-14);
    integrate(&mut evaluator, x.as_mut_slice(), 2e-5, 10_000);
    assert!(relative_error(energy(&scene, x.as_slice()), published) < 1e-9);
    // State at 0.2 s: r, p, w.
    let r = [0.60555056137707, 0.59895768179494, -0.52398302743003];
    let p = [
        -0.70827915297432,
        0.438781088126574,
        0.545728396145418,
        0.0893997528239758,
    ];
    let w = [-2.69159091214303, 150.0, 4.91726098989459];
    assert_close("r", &x.as_slice()[..3], &r, 1e-7);
    assert_close("p", &x.as_slice()[3..7], &p, 1e-7);
    assert_close("w", &x.as_slice()[10..], &w, 1e-7);
}

#[test]
fn the_door_with_redundant_hinges_starts_as_the_closed_form() {
    let scene = scenes::door();
    let formulation = Formulation::AugmentedLagrangian {
        alpha: 1e6,
        omega: 10.0,
        mu: 1.0,
        tolerance: 1e-8,
        max_iterations: 20,
    };
    let mut evaluator = Evaluator::new(scene.clone(), formulation);
    let x = scene.initial_state();
    let mut out = vec![0.0; 13];
    evaluator
        .rates(0.0, x.as_slice(), &mut out)
        .expect("positive definite");
    let w0_squared = 3.19204613912415;
    let expected = [0.0, 0.0, -0.4 * w0_squared, 0.0, w0_squared, 0.0];
    assert_close("u'", &out[7..], &expected, 1e-7);
    let reactions = scene.generalised_reactions(x.as_slice(), evaluator.multipliers());
    let inertial = scene
        .mass()
        .component_mul(&nalgebra::DVector::from_column_slice(&out[7..]));
    let sum = scene.forces(x.as_slice()) + reactions;
    assert_close(
        "M u' = g - D^T lambda",
        inertial.as_slice(),
        sum.as_slice(),
        1e-6,
    );
}
