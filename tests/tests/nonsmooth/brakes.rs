//! Brakes and clutches that engage while they turn.

use core::cell::Cell;

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode as Mode;

use super::tight;

/// Two rods of 1 m and 0.7 m in the plane, stretched along y, that fall and turn.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Arm {
    #[body(
        mass = 2.0, inertia = [1.0 / 6.0, 0.001, 1.0 / 6.0], position = [0.0, 0.5, 0.0],
        velocity = [0.0, 0.0, 0.5], angular_velocity = [1.0, 0.0, 0.0]
    )]
    upper: Body,
    #[body(
        mass = 1.5, inertia = [0.06125, 0.001, 0.06125], position = [0.0, 1.35, 0.0],
        velocity = [0.0, 0.0, 0.3], angular_velocity = [-2.0, 0.0, 0.0]
    )]
    fore: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [upper, fore], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
}

/// The mass matrix of the arm in both angles, by hand.
fn mass(elbow: f64) -> [f64; 3] {
    let (upper, fore) = (2.0 / 3.0, 1.5 * 0.49 / 3.0);
    let coupled = 1.5 * 0.35 * elbow.cos();
    [upper + 1.5 + fore + 2.0 * coupled, fore + coupled, fore]
}

fn kinetic([first, mixed, second]: [f64; 3], [shoulder, elbow]: [f64; 2]) -> f64 {
    0.5 * first * shoulder * shoulder + mixed * shoulder * elbow + 0.5 * second * elbow * elbow
}

/// Locks the elbow after 0.4 s and compares what is left with the projection of the rates in the
/// metric of the mass, which keeps the momentum of what is free.
fn locked<C: Coordinates<Arm>>(end: f64) -> f64 {
    let (arm, h) = (Arm::default(), Arm::HANDLES);
    let before = Cell::new([0.0; 3]);
    let interactions = [Interaction::brake(h.elbow.angle(), f64::INFINITY).released()];
    let [brake] = Interaction::handles(&interactions);
    let mut checked = 0;
    let report = arm
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions(interactions)
        .on(
            "lock",
            Crossing::Rising,
            |sample| sample.time() - 0.4,
            |event| {
                let rates = [event.angle_rate(h.shoulder), event.angle_rate(h.elbow)];
                before.set([event.angle(h.elbow), rates[0], rates[1]]);
                event.engage(brake)
            },
        )
        .on(
            "after",
            Crossing::Rising,
            |sample| sample.time() - 0.4 - 1e-9,
            |_| (),
        )
        .run(0.0..=end, every(0.05), |sample| -> Result<(), Fault> {
            let elbow_rate = sample.angle_rate(h.elbow);
            if sample.mode(brake)? != Mode::Sticking {
                assert!(sample.time() <= 0.4);
                return Ok(());
            }
            assert!(elbow_rate.abs() < 1e-12, "{elbow_rate:e}");
            let [elbow, rates @ ..] = before.get();
            assert!((sample.angle(h.elbow) - elbow).abs() < 1e-12);
            let impact = sample.impact(brake)?.expect("it was stopped");
            assert!((impact.rates[0] / rates[1] - 1.0).abs() < 1e-13);
            assert!(impact.rates[1].abs() < 1e-13);
            let matrix = mass(elbow);
            let shoulder = rates[0] + matrix[1] / matrix[0] * rates[1];
            let after = kinetic(matrix, [shoulder, 0.0]);
            let lost = kinetic(matrix, rates) - after;
            assert!((impact.lost_energy / lost - 1.0).abs() < 1e-12);
            let impulse = (matrix[2] - matrix[1] * matrix[1] / matrix[0]) * -rates[1];
            assert!((impact.impulse / impulse - 1.0).abs() < 1e-12);
            // Soon after it, all that has changed is what gravity did.
            let since = sample.time() - impact.time;
            if since < 1e-8 {
                checked += 1;
                let found = sample.angle_rate(h.shoulder);
                assert!(
                    (found / shoulder - 1.0).abs() < 1e-13 + 20.0 * since,
                    "{found}"
                );
                let found = sample.kinetic_energy();
                assert!(
                    (found / after - 1.0).abs() < 1e-13 + 40.0 * since,
                    "{found} {after}"
                );
            }
            Ok(())
        })
        .expect("it falls");
    assert!(checked > 0);
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    arm.view(report.time, &report.state)
        .expect("a state")
        .angle(h.shoulder)
}

#[test]
fn an_elbow_that_locks_leaves_the_projection_in_the_metric_of_the_mass() {
    let joints = locked::<Relative>(1.5);
    let bodies = locked::<Absolute>(1.5);
    assert!((joints - bodies).abs() < 1e-9, "{joints} {bodies}");
}

const MOTOR: f64 = 3.0;
const LOAD: f64 = 5.0;
const INPUT: f64 = 0.1;
const OUTPUT: f64 = 0.5;

/// A gear box: an input shaft with a motor, an output shaft with a load against it.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct GearBox {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], angular_velocity = [0.0, 0.0, 100.0])]
    input: Body,
    #[body(mass = 1.0, inertia = [0.5, 0.5, 0.5], position = [1.0, 0.0, 0.0])]
    output: Body,
    #[joint(between = [ground, input], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    first: Revolute,
    #[joint(between = [ground, output], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    second: Revolute,
    #[force(between = [ground, input], moment = [0.0, 0.0, 3.0])]
    motor: ConstantMoment,
    #[force(between = [ground, output], moment = [0.0, 0.0, -5.0])]
    load: ConstantMoment,
}

/// Both rates after a clutch of a ratio has closed: what it does not push keeps its momentum.
fn engaged([first, second]: [f64; 2], ratio: f64) -> [f64; 2] {
    let output = (ratio * INPUT * first + OUTPUT * second) / (ratio * ratio * INPUT + OUTPUT);
    [ratio * output, output]
}

/// Both rates after a time in gear.
fn driven([first, second]: [f64; 2], ratio: f64, time: f64) -> [f64; 2] {
    let rate = (ratio * MOTOR - LOAD) / (ratio * ratio * INPUT + OUTPUT);
    [first + ratio * rate * time, second + rate * time]
}

fn gears<C: Coordinates<GearBox>>(capacity: f64) -> Vec<(f64, [f64; 2], [Mode; 2])> {
    let (gears, h) = (GearBox::default(), GearBox::HANDLES);
    let clutch =
        |ratio| Interaction::clutch(h.first.angle(), h.second.angle(), ratio, capacity).released();
    let clutches = [clutch(2.0), clutch(3.0)];
    let [high, low] = Interaction::handles(&clutches);
    let mut seen = Vec::new();
    gears
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions(clutches)
        .on(
            "low",
            Crossing::Rising,
            |s| s.time() - 1.0,
            |event| event.engage(low),
        )
        .on(
            "high",
            Crossing::Rising,
            |s| s.time() - 2.0,
            |event| event.release(low).and_then(|()| event.engage(high)),
        )
        .on(
            "both",
            Crossing::Rising,
            |s| s.time() - 3.0,
            |event| event.engage(low),
        )
        .on(
            "neutral",
            Crossing::Rising,
            |s| s.time() - 4.0,
            |event| event.release(high).and_then(|()| event.release(low)),
        )
        .run(0.0..=5.0, every(0.5), |sample| -> Result<(), Fault> {
            let rates = [sample.angle_rate(h.first), sample.angle_rate(h.second)];
            let modes = [sample.mode(high)?, sample.mode(low)?];
            seen.push((sample.time(), rates, modes));
            Ok(())
        })
        .expect("it turns");
    seen
}

#[test]
fn a_gear_box_of_two_dogs_has_four_modes() {
    use Mode::{Released, Sticking};
    let neutral = [100.0 + MOTOR / INPUT, -LOAD / OUTPUT];
    let low = driven(engaged(neutral, 3.0), 3.0, 1.0);
    let high = driven(engaged(low, 2.0), 2.0, 1.0);
    let half = [0.5 * MOTOR / INPUT, -0.5 * LOAD / OUTPUT];
    let wanted = [
        (0.5, [100.0 + half[0], half[1]], [Released, Released]),
        (
            1.5,
            driven(engaged(neutral, 3.0), 3.0, 0.5),
            [Released, Sticking],
        ),
        (
            2.5,
            driven(engaged(low, 2.0), 2.0, 0.5),
            [Sticking, Released],
        ),
        (3.5, [0.0, 0.0], [Sticking, Sticking]),
        (4.5, half, [Released, Released]),
    ];
    assert!(high[0].abs() > 1.0);
    for seen in [
        gears::<Relative>(f64::INFINITY),
        gears::<Absolute>(f64::INFINITY),
    ] {
        for (time, rates, modes) in wanted {
            let found = seen.iter().find(|(at, ..)| *at == time);
            let (_, found, in_gear) = found.expect("it is reported");
            assert_eq!(*in_gear, modes, "{time}");
            for (x, y) in found.iter().zip(&rates) {
                assert!((x - y).abs() < 1e-10, "{time}: {found:?} {rates:?}");
            }
        }
    }
}

/// A clutch of a finite capacity slips until both rates agree, and then holds.
#[test]
fn a_clutch_slips_until_both_shafts_agree() {
    let capacity = 40.0;
    let neutral = [100.0 + MOTOR / INPUT, -LOAD / OUTPUT];
    let slip = neutral[0] - 3.0 * neutral[1];
    // The effort is along the first; three times as much drives the second.
    let rate = (MOTOR - capacity) / INPUT - 3.0 * (3.0 * capacity - LOAD) / OUTPUT;
    let closes = -slip / rate;
    assert!(closes < 0.5, "{closes}");
    let output = neutral[1] + closes * (3.0 * capacity - LOAD) / OUTPUT;
    let wanted = driven([3.0 * output, output], 3.0, 0.5 - closes);
    for seen in [gears::<Relative>(capacity), gears::<Absolute>(capacity)] {
        let found = seen.iter().find(|(at, ..)| *at == 1.5);
        let (_, found, modes) = found.expect("it is reported");
        assert_eq!(*modes, [Mode::Released, Mode::Sticking]);
        for (x, y) in found.iter().zip(&wanted) {
            assert!((x - y).abs() < 1e-9, "{found:?} {wanted:?}");
        }
        let at = |(time, ..): &&(f64, _, _)| (time - 1.0 - closes).abs() < 1e-9;
        assert!(
            seen.iter().any(|seen| at(&seen)),
            "the end of slipping is reported"
        );
    }
}
