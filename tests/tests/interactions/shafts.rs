//! Brakes and clutches.

use core::cell::Cell;

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode;

use super::{Arm, Gearbox, tight};

/// Rates of both joints.
fn moving(arm: &Arm, rates: [f64; 2]) -> StateOf<Arm> {
    let mut state = arm.described_state().expect("it is described");
    let h = Arm::HANDLES;
    arm.set_angle(&mut state, h.elbow, 0.7).expect("it is free");
    arm.set_angle_rate(&mut state, h.shoulder, rates[0])
        .expect("it is free");
    arm.set_angle_rate(&mut state, h.elbow, rates[1])
        .expect("it is free");
    state
}

fn locks<C: Coordinates<Arm>>() {
    let (arm, h) = (Arm::default(), Arm::HANDLES);
    let rates = [1.0, -2.5];
    let interactions = [Interaction::brake(h.elbow.angle(), f64::INFINITY).released()];
    let [dog] = Interaction::handles(&interactions);
    let seen = Cell::new([0.0; 2]);
    let mut lost = None;
    Simulation::new(&arm, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(moving(&arm, rates))
        .interactions(interactions)
        .on(
            "lock",
            Crossing::Rising,
            |sample| sample.time() - 0.3,
            |event| {
                // The metric of the mass in joint rates, by hand.
                let (q, r) = (event.angle(h.elbow), event.angle_rate(h.elbow));
                let w = event.angle_rate(h.shoulder);
                let (m1, m2, i1, i2, l, c1, c2) = (3.0, 2.0, 0.25, 0.1, 1.0, 0.5, 0.4);
                let a = i1 + m1 * c1 * c1 + i2 + m2 * (l * l + c2 * c2 + 2.0 * l * c2 * q.cos());
                let b = i2 + m2 * (c2 * c2 + l * c2 * q.cos());
                let d = i2 + m2 * c2 * c2;
                let before = 0.5 * (a * w * w + 2.0 * b * w * r + d * r * r);
                assert!((before - event.kinetic_energy()).abs() < 1e-12 * before);
                let after = w + b / a * r;
                seen.set([0.5 * a * after * after, after]);
                event.engage(dog)
            },
        )
        .run(0.0..=1.0, every(0.1), |sample| {
            if let Some(impact) = sample.impact(dog).expect("one interaction") {
                let energy = sample.kinetic_energy();
                assert!(
                    (energy / seen.get()[0] - 1.0).abs() < 1e-12,
                    "{energy} {}",
                    seen.get()[0]
                );
                assert_eq!(sample.mode(dog), Ok(InteractionMode::Sticking));
                assert!(sample.angle_rate(h.elbow).abs() < 1e-14);
                lost.get_or_insert(impact.lost_energy);
                assert!(impact.lost_energy > 0.0);
            }
        })
        .expect("it locks");
    assert!(lost.is_some());
}

#[test]
fn a_dog_takes_the_energy_of_a_projection_in_the_metric_of_the_mass() {
    locks::<Relative>();
    locks::<Absolute>();
}

/// A torque between friction and stiction on a shaft that never turned. Its rate is nothing but
/// round-off, whatever meets a stop beside it, a handler does, or a step begins with.
fn stays<C: Coordinates<Gearbox>>() {
    let gearbox = Gearbox {
        torque: -2.6,
        load: 2.0,
        ..Gearbox::default()
    };
    let h = Gearbox::HANDLES;
    let interactions = [
        Interaction::friction(h.input_shaft.angle(), 2.4).stiction(3.7),
        Interaction::limits(h.output_shaft.angle(), [-1.0, 1.0]).restitution(0.5),
    ];
    let [friction, _] = Interaction::handles(&interactions);
    let mut events = 0;
    gearbox
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions(interactions)
        .on(
            "passes",
            Crossing::Either,
            |sample| sample.angle(h.output_shaft) + 0.9,
            |_| events += 1,
        )
        .run(0.0..=2.0, every(0.1), |sample| {
            assert_eq!(sample.mode(friction), Ok(InteractionMode::Sticking));
            assert!(sample.angle(h.input_shaft).abs() < 1e-12);
        })
        .expect("it runs");
    assert!(events > 2, "{events}");
    let mut stepper = gearbox
        .stepper(StandardLagrange, Rk4)
        .expect("it is prepared")
        .coordinates::<C>()
        .interactions(interactions);
    let mut state = stepper.initial_state().expect("a state");
    for _ in 0..500 {
        stepper.step(&mut state, 2e-3).expect("it steps");
        assert_eq!(stepper.mode(friction), Ok(InteractionMode::Sticking));
    }
    let bodies = stepper.bodies(&state);
    let angle = stepper.view(&bodies).angle(h.input_shaft);
    assert!(angle.abs() < 1e-12, "{angle:e}");
}

#[test]
fn stiction_holds_what_never_turned() {
    stays::<Relative>();
    stays::<Absolute>();
}

/// With its stiction the brake would leave the clutch more than its capacity, with its friction
/// less: the brake slides, and the clutch sticks. Both accelerate by 6.8 N m over 0.12 kg m^2.
fn sticks_once_the_brake_slides<C: Coordinates<Gearbox>>() {
    let gearbox = Gearbox {
        torque: -1.0,
        load: 6.0,
        ..Gearbox::default()
    };
    let h = Gearbox::HANDLES;
    let interactions = [
        Interaction::clutch(h.input_shaft.angle(), h.output_shaft.angle(), 1.0, 0.45),
        Interaction::brake(h.input_shaft.angle(), 0.2).stiction(0.5),
    ];
    let [clutch, brake] = Interaction::handles(&interactions);
    let wanted = -0.1 * 6.8 / 0.12;
    let report = gearbox
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions(interactions)
        .run(0.0..=0.1, every(0.1), |_| ())
        .expect("it runs");
    let mut stepper = gearbox
        .stepper(StandardLagrange, Rk4)
        .expect("it is prepared")
        .coordinates::<C>()
        .interactions(interactions);
    let mut state = stepper.initial_state().expect("a state");
    for _ in 0..100 {
        stepper.step(&mut state, 1e-3).expect("it steps");
    }
    assert_eq!(stepper.mode(clutch), Ok(InteractionMode::Sticking));
    assert_eq!(stepper.mode(brake), Ok(InteractionMode::SlidingDown));
    for bodies in [report.state, stepper.bodies(&state)] {
        let view = stepper.view(&bodies);
        for shaft in [h.input_shaft, h.output_shaft] {
            let rate = view.angle_rate(shaft);
            assert!((rate - wanted).abs() < 1e-9, "{rate} {wanted}");
        }
    }
}

#[test]
fn a_clutch_sticks_once_the_brake_beside_it_slides() {
    sticks_once_the_brake_slides::<Relative>();
    sticks_once_the_brake_slides::<Absolute>();
}
