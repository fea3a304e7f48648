//! Both coordinates, and a gear box.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode;

use super::{Arm, Gearbox, tight};

/// Angles, rates and modes of an arm with limits and friction at times.
fn course<C: Coordinates<Arm>, F: Formulation<f64>>(
    formulation: F,
) -> Vec<([f64; 4], [InteractionMode; 3])> {
    let (arm, h) = (Arm::default(), Arm::HANDLES);
    let mut start = arm.described_state().expect("it is described");
    arm.set_angle(&mut start, h.elbow, 0.4).expect("it is free");
    arm.set_angle_rate(&mut start, h.shoulder, 2.0)
        .expect("it is free");
    arm.set_angle_rate(&mut start, h.elbow, -3.0)
        .expect("it is free");
    let interactions = [
        Interaction::limits(h.elbow.angle(), [-0.5, 0.8]).restitution(0.5),
        Interaction::friction(h.elbow.angle(), 0.4).stiction(0.5),
        Interaction::friction(h.shoulder.angle(), 1.5),
    ];
    let handles = Interaction::handles(&interactions);
    let mut course = Vec::new();
    let report = Simulation::new(&arm, formulation, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start)
        .interactions(interactions)
        .run(0.0..=10.0, every(0.1), |sample| {
            let readings = [
                sample.angle(h.shoulder),
                sample.angle(h.elbow),
                sample.angle_rate(h.shoulder),
                sample.angle_rate(h.elbow),
            ];
            let modes = handles.map(|handle| sample.mode(handle).expect("three"));
            course.push((readings, modes));
        })
        .expect("it moves");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    course
}

fn agree(
    name: &str,
    a: &[([f64; 4], [InteractionMode; 3])],
    b: &[([f64; 4], [InteractionMode; 3])],
    bound: f64,
) {
    assert_eq!(a.len(), b.len(), "{name}");
    for ((x, at), (y, also)) in a.iter().zip(b) {
        for (x, y) in x.iter().zip(y) {
            assert!((x - y).abs() < bound, "{name}: {x} {y}");
        }
        assert_eq!(at, also, "{name}");
    }
}

#[test]
fn both_coordinates_go_through_the_same_modes() {
    let joints = course::<Relative, _>(StandardLagrange);
    let mut seen = Vec::new();
    for (_, modes) in &joints {
        if !seen.contains(modes) {
            seen.push(*modes);
        }
    }
    assert!(seen.len() > 2, "{seen:?}");
    let (_, last) = joints.last().expect("it has states");
    assert_eq!(last[1..], [InteractionMode::Sticking; 2]);
    let bodies = course::<Absolute, _>(StandardLagrange);
    agree("bodies", &joints, &bodies, 1e-9);
    let augmented = course::<Absolute, _>(AugmentedLagrangian::default());
    agree("augmented", &joints, &augmented, 1e-5);
}

fn shifts<C: Coordinates<Gearbox>>() {
    let (mut gearbox, h) = (Gearbox::default(), Gearbox::HANDLES);
    (gearbox.torque, gearbox.load) = (3.0, 1.0);
    // The first clutch drives the output at a third of the motor's rate, the second at its rate.
    let clutches = [3.0, 1.0].map(|ratio| {
        let (motor, output) = (h.input_shaft.angle(), h.output_shaft.angle());
        Interaction::clutch(motor, output, ratio, 20.0).released()
    });
    let [low, high] = Interaction::handles(&clutches);
    let (motor, output) = (0.02, 0.1);
    // The motor alone, then both in the low gear, after a time of slip.
    let idle = 3.0 / motor * 0.2;
    let modes = |sample: &Sample<'_, f64, Gearbox>| {
        [low, high].map(|clutch| sample.mode(clutch).expect("two clutches"))
    };
    let mut all = Vec::new();
    let report = Simulation::new(&gearbox, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions(clutches)
        .on(
            "low",
            Crossing::Rising,
            |s| s.time() - 0.2,
            |event| event.engage(low),
        )
        .on(
            "high",
            Crossing::Rising,
            |s| s.time() - 1.0,
            |event| {
                event.release(low)?;
                event.engage(high)
            },
        )
        .on(
            "both",
            Crossing::Rising,
            |s| s.time() - 2.0,
            |event| event.engage(low),
        )
        .run(0.0..=3.0, every(0.01), |sample| {
            let now = modes(sample);
            if all.last() != Some(&now) {
                all.push(now);
            }
            let rates = [h.input_shaft, h.output_shaft].map(|joint| sample.angle_rate(joint));
            if now == [InteractionMode::Sticking, InteractionMode::Released] {
                assert!((rates[0] - 3.0 * rates[1]).abs() < 1e-10, "{rates:?}");
                // One freedom: the motor's torque less a third of the load.
                let acceleration = (3.0 - 1.0 / 3.0) / (motor + output / 9.0);
                let found = sample
                    .angle_acceleration(h.input_shaft)
                    .expect("it is known");
                assert!(
                    (found - acceleration).abs() < 1e-9,
                    "{found} {acceleration}"
                );
                let effort = sample.effort(low).expect("two clutches");
                assert!(
                    (effort - (motor * acceleration - 3.0)).abs() < 1e-9,
                    "{effort}"
                );
            }
            if now == [InteractionMode::Released; 2] && sample.time() <= 0.2 {
                assert!((rates[0] - 150.0 * sample.time()).abs() < 1e-9, "{rates:?}");
            }
        })
        .expect("it shifts");
    assert!((idle - 30.0).abs() < 1e-12);
    use InteractionMode::{Released, SlidingUp, Sticking};
    let wanted = [
        [Released, Released],
        [SlidingUp, Released],
        [Sticking, Released],
        [Released, SlidingUp],
        [Released, Sticking],
    ];
    assert_eq!(all[..wanted.len()], wanted, "{all:?}");
    assert!(all.len() > wanted.len(), "both gears at once: {all:?}");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

#[test]
fn a_gear_box_goes_through_its_modes() {
    shifts::<Relative>();
    shifts::<Absolute>();
}
