//! A disc that rolls: discs of all sizes in steady circles, and Euler's disc.

use holonom::Pose;
use holonom::nalgebra::{Quaternion, UnitQuaternion, Vector3};
use holonom::prelude::*;

use crate::free::{Disc, GRAVITY, disc, steady};

/// Discs from 1 mm to 1 km and from 1 mg to 1000 t, with turns up to 10 000 rad/s. Errors are
/// relative to the radius of the circle, or of the disc where that is larger.
#[test]
fn discs_of_all_sizes_roll_in_steady_circles() {
    let h = Disc::HANDLES;
    for radius in [1e-3, 0.1, 1.0, 30.0, 1e3] {
        for mass in [1e-6, 1.0, 1e6] {
            let disc = Disc::new(mass, radius, 0.0).expect("a disc");
            // As slow as gravity alone would have it, faster, and 10 000 rad/s.
            let slow = (GRAVITY / radius).sqrt();
            for (lean, turn) in [
                (0.3, slow),
                (-0.7, 4.0 * slow),
                (1.2, -20.0 * slow),
                (0.5, 1e4),
            ] {
                let (state, circle) = steady(&disc, lean, turn);
                let period = core::f64::consts::TAU / turn.abs();
                let mut first = None;
                let observe = |sample: &Sample<'_, f64, Disc>| {
                    let pose = sample.pose(h.disc);
                    let axle = UnitQuaternion::new_unchecked(pose.orientation) * Vector3::y();
                    let off = (axle.z - lean.sin()).abs();
                    assert!(off < 1e-9, "{radius} {mass} {lean} {turn}: {off:e}");
                    let begin = *first.get_or_insert(pose.position);
                    let chord = 2.0 * circle * (0.5 * turn * sample.time()).sin().abs();
                    let off = ((pose.position - begin).norm() - chord).abs();
                    let size = circle.max(radius);
                    assert!(off < 1e-9 * size, "{radius} {mass} {lean} {turn}: {off:e}");
                };
                let simulation = Simulation::new(&disc, StandardLagrange, Rk4::every(period / 2e3))
                    .initial_state(state);
                if mass == 1.0 {
                    simulation
                        .joint_coordinates()
                        .run(0.0..=period, every(period / 8.0), observe)
                        .expect("a run");
                } else {
                    simulation
                        .absolute_coordinates()
                        .run(0.0..=period, every(period / 8.0), observe)
                        .expect("a run");
                }
            }
        }
    }
}

/// A disc that lies flat has no lowest point: it is refused, with the name of its joint.
#[test]
fn a_flat_disc_is_named() {
    let (disc, h) = (disc(0.0), Disc::HANDLES);
    let half = core::f64::consts::FRAC_1_SQRT_2;
    for [e, x] in [[half, half], [half, -half]] {
        let mut state: StateOf<Disc> = disc.described_state().expect("as described");
        let flat = Quaternion::new(e, x, 0.0, 0.0);
        let pose = Pose {
            position: Vector3::zeros(),
            orientation: flat,
        };
        Disc::set_pose(&mut state, h.disc, pose);
        let run = Simulation::new(&disc, StandardLagrange, DormandPrince::default())
            .initial_state(state)
            .run(0.0..=1.0, every(0.1), |_| {});
        let fault = run.expect_err("it has no lowest point").to_string();
        assert!(fault.contains("`contact`"), "{fault}");
    }
}

/// Euler's disc, braked by a moment against its angular velocity whose power is constant: its
/// energy falls along a line, and its point of contact runs round ever faster (Moffatt 2000).
/// Positions are projected: their drift is energy, of which little is left.
#[test]
fn eulers_disc_spins_up_as_it_falls() {
    let h = Disc::HANDLES;
    // A coin whose centre is at rest, which turns at `W^2 = 4 g / (r cos(lean))`.
    let (mass, radius, above) = (0.005, 0.012, 0.02_f64);
    let coin = Disc::new(mass, radius, 0.0).expect("a disc");
    let turn = (4.0 * GRAVITY / (radius * above.sin())).sqrt();
    let (state, circle) = steady(&coin, core::f64::consts::FRAC_PI_2 - above, turn);
    assert!(circle < 1e-12);
    let begin = 1.5 * mass * GRAVITY * radius * above.sin();
    let power = 1.7 * begin;
    let tight = DormandPrince853::new(Tolerance {
        relative: 1e-13,
        absolute: 1e-15,
    });
    let simulation = || {
        Simulation::new(&coin, StandardLagrange, tight)
            .initial_state(state)
            .projection(Projection::default())
            .forces(|_, _, loads| {
                let spin = loads.view().angular_velocity_global(h.disc);
                let moment = spin * (-power / spin.norm_squared());
                loads.moment(h.disc, moment.into());
            })
    };
    let mut fastest = 0.0_f64;
    let mut observe = |sample: &Sample<'_, f64, Disc>| {
        let orientation = UnitQuaternion::new_unchecked(sample.pose(h.disc).orientation);
        let axle = orientation * Vector3::y();
        let upward = (Vector3::z() - axle.z * axle).normalize();
        let spin = sample.angular_velocity_global(h.disc);
        fastest = fastest.max(spin.dot(&upward) / axle.xy().norm());
        let left = begin - power * sample.time();
        let off = (sample.energy() - left).abs() / left;
        assert!(off < 1e-10, "{} {off:e}", sample.time());
    };
    simulation()
        .absolute_coordinates()
        .run(0.0..=0.5, every(0.01), &mut observe)
        .expect("a run");
    simulation()
        .joint_coordinates()
        .run(0.0..=0.5, every(0.01), &mut observe)
        .expect("a run");
    assert!(fastest > 1e3, "{fastest}");
}
