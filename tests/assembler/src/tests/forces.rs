//! Forces against the gradient of their potential energy, their power and closed forms.

use core::f64::consts::FRAC_PI_2;

use nalgebra::{DVector, Vector3};
use rand_chacha::ChaCha8Rng;

use super::ORIENTATIONS;
use crate::accuracy::assert_close;
use crate::assembler::Assembler;
use crate::bodies::{Body, BodyId, GROUND};
use crate::dual;
use crate::forces::Force;
use crate::formulation::{Evaluator, Formulation};
use crate::laws::ForceLaw;
use crate::scenes::random_body;
use crate::states::{
    Spread, add_turns, displace, generator, random_consistent_state, random_state,
};

const LOOSE: Spread = Spread {
    position: 0.1,
    angle: 0.3,
    velocity: 1.0,
    rate: 2.0,
    norm: 0.05,
};

/// A point on either body, far enough apart.
const HEAD: [f64; 3] = [0.2, -0.1, 0.3];
const TAIL: [f64; 3] = [0.4, 0.9, -1.3];
const AXIS: [f64; 3] = [1.0, 2.0, -0.5];

fn law() -> ForceLaw {
    ForceLaw::new(|length, rate, time| -20.0 * (length - 0.4) - 3.0 * rate + time.sin())
}

/// Every force between two bodies.
fn forces(scene: &Assembler, [i, j]: [BodyId; 2]) -> Vec<Force> {
    let b = [i, j];
    vec![
        Force::spring_damper(scene, b, HEAD, TAIL, 40.0, 0.0, 0.7),
        Force::spring_damper(scene, b, HEAD, TAIL, 40.0, 3.0, 0.7),
        Force::torsional_spring_damper(scene, b, AXIS, 8.0, 0.0, 0.3),
        Force::torsional_spring_damper(scene, b, AXIS, 8.0, 0.6, 0.3),
        Force::rotational_damper(b, 0.9),
        Force::actuator(scene, b, HEAD, TAIL, law()),
        Force::torsional_actuator(scene, b, AXIS, law()),
        Force::point_force(scene, b, TAIL, [3.0, -1.0, 2.0]),
        Force::follower_force(scene, j, TAIL, [3.0, -1.0, 2.0]),
        Force::constant_moment(scene, b, [0.3, 0.7, -0.2]),
        Force::follower_moment(scene, j, [0.3, 0.7, -0.2]),
    ]
}

/// Two bodies, or one and the ground, without gravity.
fn bodies(ground: bool, rng: &mut ChaCha8Rng) -> (Assembler, [BodyId; 2]) {
    let mut scene = Assembler::new([0.0; 3]);
    let i = if ground {
        GROUND
    } else {
        scene.add_body(random_body(rng))
    };
    let j = scene.add_body(random_body(rng));
    (scene, [i, j])
}

/// What the forces of a scene add to the gyroscopic moments.
fn added(scene: &Assembler, without: &Assembler, time: f64, x: &[f64]) -> DVector<f64> {
    let mut bare = x[..scene.body_coordinates()].to_vec();
    bare.extend(&x[scene.coordinates()..]);
    scene.forces_at(time, x) - without.forces_at(time, &bare)
}

#[test]
fn forces_are_gradients_and_have_their_power() {
    let mut rng = generator(40);
    for ground in [false, true] {
        let (without, ends) = bodies(ground, &mut rng);
        for orientation in ORIENTATIONS {
            let without = without.clone().with_orientation(orientation);
            for force in forces(&without, ends) {
                let what = format!("{force:?}");
                let conservative = matches!(force, Force::Spring { damping: 0.0, .. });
                let mut scene = without.clone();
                scene.add_force(force);
                for _ in 0..20 {
                    let mut x = random_state(&scene, LOOSE, &mut rng);
                    add_turns(&scene, x.as_mut_slice(), &mut rng);
                    let x = x.as_slice();
                    let u = DVector::from_column_slice(&x[scene.coordinates()..]);
                    let g = added(&scene, &without, 0.6, x);
                    let springs = dual::spring_forces(&scene, x);
                    let energy = dual::spring_energy(&scene, &x[..scene.coordinates()]);
                    assert_close(&what, &[scene.potential_energy(x)], &[energy], 1e-12);
                    if conservative {
                        assert_close(&what, g.as_slice(), springs.as_slice(), 1e-12);
                    }
                    let power = (g - springs).dot(&u);
                    assert_close(&what, &[scene.power_at(0.6, x)], &[power], 1e-11);
                }
            }
        }
    }
}

#[test]
fn springs_are_the_slope_of_their_energy() {
    const STEP: f64 = 1e-5;
    let mut rng = generator(41);
    let (mut scene, ends) = bodies(false, &mut rng);
    for force in forces(&scene, ends).into_iter().step_by(2).take(2) {
        scene.add_force(force);
    }
    let x = random_state(&scene, Spread::default(), &mut rng);
    let mut rest = x.clone();
    rest.rows_mut(scene.coordinates(), scene.velocities())
        .fill(0.0);
    let g = scene.forces(rest.as_slice());
    for column in 0..scene.velocities() {
        let energy = |step: f64| {
            let mut x = rest.clone();
            let mut motion = vec![0.0; scene.velocities()];
            motion[column] = step;
            displace(&scene, x.as_mut_slice(), &motion);
            scene.potential_energy(x.as_slice())
        };
        let slope = (energy(STEP) - energy(-STEP)) / (2.0 * STEP);
        assert_close("force", &[g[column]], &[-slope], 1e-6);
    }
}

#[test]
fn between_bodies_action_equals_reaction() {
    let mut rng = generator(42);
    let (without, ends) = bodies(false, &mut rng);
    // A force or a moment of an outside body has no reaction: only those along a scalar.
    for force in forces(&without, ends).into_iter().take(7) {
        let mut scene = without.clone();
        scene.add_force(force);
        let x = random_state(&scene, Spread::default(), &mut rng);
        let g = added(&scene, &without, 0.2, x.as_slice());
        let at = scene.kinematics(x.as_slice());
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for (end, body) in ends.iter().enumerate() {
            let frame = at.frame(*body);
            let f: Vector3<f64> = g.fixed_rows::<3>(6 * end).into();
            let m: Vector3<f64> = g.fixed_rows::<3>(6 * end + 3).into();
            force += f;
            moment += frame.rotation * m + frame.position.cross(&f);
        }
        assert_close("forces", force.as_slice(), &[0.0; 3], 1e-12);
        assert_close("moments", moment.as_slice(), &[0.0; 3], 1e-12);
    }
}

#[test]
fn energy_changes_by_the_power_alone() {
    let mut rng = generator(43);
    let (mut scene, ends) = bodies(false, &mut rng);
    scene.add_revolute([GROUND, ends[0]], [0.1, 0.0, -0.2], AXIS);
    scene.add_spherical(ends, [0.3, 0.2, 0.4]);
    for force in forces(&scene, ends) {
        scene.add_force(force);
    }
    for _ in 0..10 {
        let x = random_consistent_state(&scene, 0.0, Spread::default(), &mut rng);
        let x = x.as_slice();
        let mut evaluator = Evaluator::new(scene.clone(), Formulation::Standard);
        let mut out = vec![0.0; x.len()];
        evaluator.rates(0.5, x, &mut out).expect("solvable");
        let u = DVector::from_column_slice(&x[scene.coordinates()..]);
        let accelerations = DVector::from_column_slice(&out[scene.coordinates()..]);
        let kinetic = scene.mass().component_mul(&u).dot(&accelerations);
        let potential = -dual::spring_forces(&scene, x).dot(&u);
        let power = scene.power_at(0.5, x);
        assert_close("energy", &[kinetic + potential], &[power], 1e-9);
    }
}

#[test]
fn forces_have_the_values_of_closed_forms() {
    let turned = [0.5_f64.sqrt(), 0.0, 0.0, 0.5_f64.sqrt()];
    let mut scene = Assembler::new([0.0; 3]);
    let body = Body::rigid(1.0, [1.0; 3], [2.0, 0.0, 0.0]);
    let j = scene.add_body(body.with_velocity([0.5, 0.0, 0.0], [0.0, 0.0, 2.0]));
    let mut x = scene.initial_state();
    // A quarter turn about z since the scene was described.
    x.rows_mut(3, 4).copy_from_slice(&turned);
    let b = [GROUND, j];
    let (at, z) = ([3.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    let actuator = ForceLaw::new(|length, rate, time| length + 10.0 * rate + 100.0 * time);
    let expected = [
        // Stretched by 1.5 m, and by 0.5 m/s.
        (
            Force::spring_damper(&scene, b, [0.0; 3], [2.0, 0.0, 0.0], 10.0, 4.0, 0.5),
            [-17.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        ),
        (
            Force::torsional_spring_damper(&scene, b, z, 10.0, 4.0, 0.5),
            [0.0, 0.0, 0.0, 0.0, 0.0, -10.0 * (FRAC_PI_2 - 0.5) - 8.0],
        ),
        (
            Force::rotational_damper(b, 4.0),
            [0.0, 0.0, 0.0, 0.0, 0.0, -8.0],
        ),
        (
            Force::actuator(&scene, b, [0.0; 3], [2.0, 0.0, 0.0], actuator.clone()),
            [2.0 + 5.0 + 300.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        ),
        (
            Force::torsional_actuator(&scene, b, z, actuator),
            [0.0, 0.0, 0.0, 0.0, 0.0, FRAC_PI_2 + 20.0 + 300.0],
        ),
        // The arm is along y now: (0, 1, 0) x (6, 0, 0).
        (
            Force::point_force(&scene, b, at, [6.0, 0.0, 0.0]),
            [6.0, 0.0, 0.0, 0.0, 0.0, -6.0],
        ),
        (
            Force::follower_force(&scene, j, at, [0.0, 6.0, 0.0]),
            [-6.0, 0.0, 0.0, 0.0, 0.0, 6.0],
        ),
        (
            Force::constant_moment(&scene, b, [7.0, 0.0, 0.0]),
            [0.0, 0.0, 0.0, 0.0, -7.0, 0.0],
        ),
        (
            Force::follower_moment(&scene, j, [7.0, 0.0, 0.0]),
            [0.0, 0.0, 0.0, 7.0, 0.0, 0.0],
        ),
    ];
    for (force, expected) in expected {
        let what = format!("{force:?}");
        let mut scene = scene.clone();
        scene.add_force(force);
        let mut full = x.rows(0, 7).iter().copied().collect::<Vec<_>>();
        full.resize(scene.coordinates(), 0.0);
        full.extend(x.rows(7, 6).iter());
        let g = scene.forces_at(3.0, &full);
        assert_close(&what, g.as_slice(), &expected, 1e-14);
    }
}
