//! Impacts at several contacts at once, and points on planes.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::{InteractionMode, Plane};

use super::{Falling, GRAVITY, Row, tight};

fn row<C: Coordinates<Row>>() {
    let (row, h) = (Row::default(), Row::HANDLES);
    let mut start = row.described_state().expect("it is described");
    row.set_displacement_rate(&mut start, h.first, 1.0)
        .expect("it is free");
    // The second touches the third, the first meets the second after 0.5 s: by Moreau's law with a
    // restitution of 1 the rates after that are -1/3, 2/3 and 2/3.
    let contacts = [
        Interaction::contact_of_balls(h.a, h.b, 0.5).restitution(1.0),
        Interaction::contact_of_balls(h.b, h.c, 0.5).restitution(1.0),
    ];
    let [_, second] = Interaction::handles(&contacts);
    let report = Simulation::new(&row, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start)
        .interactions(contacts)
        .run(0.0_f64..=2.0, every(0.1), |sample| {
            let rates = [h.first, h.second, h.third].map(|joint| sample.displacement_rate(joint));
            let wanted = if sample.time() <= 0.5 + 1e-9 {
                [1.0, 0.0, 0.0]
            } else {
                [-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0]
            };
            for (rate, wanted) in rates.iter().zip(wanted) {
                let close = (rate - wanted).abs() < 1e-12;
                assert!(close || sample.time() < 0.5 + 1e-9, "{rates:?}");
            }
            if let Some(impact) = sample.impact(second).expect("two interactions") {
                assert!((impact.impulse - 2.0 / 3.0).abs() < 1e-12);
                assert!(impact.lost_energy.abs() < 1e-12, "{impact:?}");
            }
        })
        .expect("they meet");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

#[test]
fn three_balls_part_by_moreaus_law() {
    row::<Relative>();
    row::<Absolute>();
}

fn falls<C: Coordinates<Falling>>() {
    let (falling, h) = (Falling::default(), Falling::HANDLES);
    let mut start = falling.described_state().expect("it is described");
    // Turned by 0.3 rad about x: the end is 0.5 sin 0.3 higher, the other lower.
    let mut pose = falling.view(0.0, &start).expect("a view").pose(h.rod);
    let (sine, cosine) = (0.15_f64.sin(), 0.15_f64.cos());
    pose.orientation = holonom::nalgebra::Quaternion::new(cosine, sine, 0.0, 0.0);
    Falling::set_pose(&mut start, h.rod, pose);
    let restitution = 0.6;
    let floor = Plane::on_ground([0.0, 0.0, 0.0], [0.0, 0.0, 2.0]);
    let contacts =
        [h.end, h.other].map(|point| Interaction::contact(point, floor).restitution(restitution));
    let [_, other] = Interaction::handles(&contacts);
    let mut first = None;
    let report = Simulation::new(&falling, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start)
        .interactions(contacts)
        .run(0.0_f64..=8.0, every(0.05), |sample| {
            for point in [h.end, h.other] {
                assert!(sample.position(point).z > -1e-11, "{}", sample.time());
            }
            if let Some(impact) = sample.impact(other).expect("two interactions") {
                first.get_or_insert(impact);
            }
        })
        .expect("it falls");
    // The other end falls by 1 m less 0.5 sin 0.3.
    let first = first.expect("it falls on the floor");
    let fall = 1.0 - 0.5 * 0.3_f64.sin();
    let time = (2.0 * fall / GRAVITY).sqrt();
    assert!((first.time - time).abs() < 1e-11, "{first:?}");
    let arm = 0.5 * 0.3_f64.cos();
    let compliance = 1.0 / 2.0 + arm * arm * 6.0;
    let impulse = (1.0 + restitution) * GRAVITY * time / compliance;
    assert!((first.impulse / impulse - 1.0).abs() < 1e-11, "{first:?}");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    // It has come to rest on both ends, which carry half the weight each.
    let view = falling.view(report.time, &report.state).expect("a view");
    assert!(view.velocity(h.rod).norm() < 1e-9 && view.position(h.rod).z.abs() < 1e-11);
}

#[test]
fn a_rod_falls_on_its_ends() {
    falls::<Relative>();
    falls::<Absolute>();
}

/// A foot that lands throws the other off. The speeds and times of that are a geometric series.
fn rocks<C: Coordinates<Falling>>(rate: f64, bound: f64) {
    let (falling, h) = (Falling::default(), Falling::HANDLES);
    let mut start = falling.described_state().expect("it is described");
    Falling::set_velocity(&mut start, h.rod, [0.0, 0.0, 0.2 * rate].into());
    Falling::set_angular_velocity_global(&mut start, h.rod, [rate, 0.0, 0.0].into());
    let floor = Plane::on_ground([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]);
    let contacts = [h.foot, h.other_foot].map(|point| Interaction::contact(point, floor));
    let feet = Interaction::handles(&contacts);
    let (mut rests, mut lost, mut impacts) = (None, 0.0, 0);
    let moment = 1.0 / 6.0 + 2.0 * 0.2 * 0.2;
    let first = 2.0 * rate * moment / (2.0 * GRAVITY * 0.2);
    let ratio = (1.0 / 2.0 - 0.04 * 6.0) / (1.0 / 2.0 + 0.04 * 6.0);
    let wanted = first / (1.0 - ratio);
    let report = Simulation::new(&falling, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start)
        .interactions(contacts)
        .run(0.0..=2.0 * wanted, every_step(), |sample| {
            let modes = feet.map(|foot| sample.mode(foot).expect("two interactions"));
            if modes == [InteractionMode::AtLower; 2] {
                rests.get_or_insert(sample.time());
            } else {
                assert_eq!(rests, None, "{rate}: it leaves again, {modes:?}");
            }
            for foot in feet {
                if let Some(impact) = sample.impact(foot).expect("two interactions")
                    && impact.time == sample.time()
                    && impact.rates[0] < 0.0
                    && sample.mode(foot) == Ok(InteractionMode::AtLower)
                {
                    lost += impact.lost_energy;
                    impacts += 1;
                }
            }
        })
        .expect("it rocks");
    let rests: f64 = rests.expect("it comes to rest");
    assert!(
        (rests / wanted - 1.0).abs() < bound,
        "{rate}: {rests} for {wanted}"
    );
    let energy = 0.5 * moment * rate * rate;
    assert!(
        (lost / energy - 1.0).abs() < 0.1 * bound,
        "{rate}: {lost} of {energy}"
    );
    // The speeds fall below a ten-thousandth after nine impacts.
    assert!(impacts < 12, "{rate}: {impacts}");
    assert!(report.accepted < 300, "{rate}: {}", report.accepted);
}

#[test]
fn a_rod_rocks_to_rest_on_two_feet() {
    // The slowest flight rises by 1e-12 m, and those that follow end within the round-off of a gap.
    for (rate, bound) in [(1e-1, 1e-3), (1e-3, 2e-3), (1e-5, 0.2)] {
        rocks::<Relative>(rate, bound);
        rocks::<Absolute>(rate, bound);
    }
}

#[test]
fn a_rod_at_rest_stands_on_both_ends() {
    let (falling, h) = (Falling::default(), Falling::HANDLES);
    let floor = Plane::on_ground([0.0, 0.0, 0.9], [0.0, 0.0, 1.0]);
    let contacts = [h.end, h.other].map(|point| Interaction::contact(point, floor).radius(0.1));
    let handles = Interaction::handles(&contacts);
    Simulation::new(&falling, StandardLagrange, DormandPrince::default())
        .interactions(contacts)
        .run(0.0_f64..=100.0, every(1.0), |sample| {
            for contact in handles {
                assert_eq!(sample.mode(contact), Ok(InteractionMode::AtLower));
                let effort = sample.effort(contact).expect("two interactions");
                assert!((effort - GRAVITY).abs() < 1e-11, "{effort}");
            }
            assert!((sample.position(h.rod).z - 1.0).abs() < 1e-12);
        })
        .expect("it rests");
}
