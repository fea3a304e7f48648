//! Ropes that go slack, struts, and limits of the distance of two points.

use holonom::error::StartFault;
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode as Mode;

use super::{Falling, GRAVITY, Row, tight};

/// A bob of 2 kg, and a nail in the origin.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Bob {
    #[body(free, mass = 2.0, position = [1.0, 0.0, 0.0])]
    bob: Particle,
    #[point(on = ground, at = [0.0, 0.0, 0.0])]
    nail: Point,
}

fn start(position: [f64; 3], velocity: [f64; 3]) -> StateOf<Bob> {
    let bob = Bob::default();
    let mut state = bob.described_state().expect("it is described");
    let pose = Bob::HANDLES.bob;
    let mut at = bob.view(0.0, &state).expect("a view").pose(pose);
    at.position = position.into();
    Bob::set_pose(&mut state, pose, at);
    Bob::set_velocity(&mut state, pose, velocity.into());
    state
}

/// Let go at `(0.6, 0, 0) l`, it falls by `0.8 l` until the rope is tight. That takes the rate
/// along the rope, `0.8` of it, times `1 + e`.
fn catches<C: Coordinates<Bob>>() {
    let (bob, h) = (Bob::default(), Bob::HANDLES);
    for (length, restitution) in [(1.0, 0.0), (1.0, 0.5), (1e-6, 0.0), (1e6, 0.7)] {
        let interactions = [Interaction::rope(h.nail, h.bob, length).restitution(restitution)];
        let [rope] = Interaction::handles(&interactions);
        let rate = f64::sqrt(2.0 * GRAVITY * 0.8 * length);
        let tight_at = rate / GRAVITY;
        let mut first = None;
        let report = Simulation::new(&bob, StandardLagrange, DormandPrince::new(tight()))
            .coordinates::<C>()
            .initial_state(start([0.6 * length, 0.0, 0.0], [0.0; 3]))
            .interactions(interactions)
            .run(0.0..=3.0 * tight_at, every(0.1 * tight_at), |sample| {
                let position = sample.position(h.bob);
                assert!(position.norm() < (1.0 + 1e-9) * length);
                let effort = sample.effort(rope).expect("it is listed");
                let mode = sample.mode(rope).expect("it is listed");
                if mode == Mode::AtUpper {
                    // m (v^2 / l + g cos)
                    let v = sample.velocity(h.bob);
                    let pull = 2.0 * (v.norm_squared() - GRAVITY * position.z) / length;
                    assert!((effort + pull).abs() < 1e-7 * pull, "{effort} {pull}");
                } else {
                    assert!(mode == Mode::Free && effort == 0.0);
                }
                if let Some(impact) = sample.impact(rope).expect("it is listed") {
                    first.get_or_insert(impact);
                }
            })
            .expect("it falls");
        let first = first.expect("it is caught");
        assert!((first.time / tight_at - 1.0).abs() < 1e-9);
        let impulse = -2.0 * 0.8 * rate * (1.0 + restitution);
        assert!((first.impulse / impulse - 1.0).abs() < 1e-9, "{first:?}");
        let lost = 0.64 * rate * rate * (1.0 - restitution * restitution);
        assert!((first.lost_energy / lost - 1.0).abs() < 1e-9, "{first:?}");
        if restitution == 0.0 {
            let view = bob.view(report.time, &report.state).expect("a view");
            let energy = view.energy() / (2.0 * GRAVITY * length);
            // It fell from 0, and keeps 0.36 of 0.8.
            assert!((energy + 0.512).abs() < 1e-8, "{energy}");
        }
    }
}

#[test]
fn a_rope_catches_what_falls() {
    catches::<Relative>();
    catches::<Absolute>();
}

/// A pendulum of 1 m with `v^2 = 3.5 g l` at its lowest point goes slack `0.5 l` above the nail,
/// with `v^2 = 0.5 g l`. There the parabola touches the circle. It meets it again after `4 v sin /
/// g`, where the angle from the vertical is 60 degrees, three times as far round.
fn goes_slack<C: Coordinates<Bob>>() {
    let (bob, h) = (Bob::default(), Bob::HANDLES);
    let interactions = [Interaction::rope(h.nail, h.bob, 1.0)];
    let [rope] = Interaction::handles(&interactions);
    let sine = f64::sqrt(0.75);
    let mut slack = None;
    let mut caught = None;
    Simulation::new(&bob, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start(
            [0.0, 0.0, -1.0],
            [f64::sqrt(3.5 * GRAVITY), 0.0, 0.0],
        ))
        .interactions(interactions)
        .run(0.0..=2.0, every(0.02), |sample| {
            let position = sample.position(h.bob);
            assert!(position.norm() < 1.0 + 1e-9);
            if sample.mode(rope) == Ok(Mode::Free) && slack.is_none() {
                slack = Some(sample.time());
                assert!((position.z - 0.5).abs() < 1e-8, "{position}");
                assert!((position.x - sine).abs() < 1e-8, "{position}");
            }
            if let (Some(impact), None) = (sample.impact(rope).expect("it is listed"), caught) {
                caught = Some(impact.time);
                // The parabola of the slack rope, at its end.
                let t = 4.0 * f64::sqrt(0.5 * GRAVITY) * sine / GRAVITY;
                let x = sine - 0.5 * f64::sqrt(0.5 * GRAVITY) * t;
                assert!((position.x - x).abs() < 1e-7, "{position} {x}");
            }
        })
        .expect("it swings");
    let flight = caught.expect("it is caught") - slack.expect("it goes slack");
    let wanted = 4.0 * f64::sqrt(0.5 / GRAVITY) * sine;
    assert!((flight - wanted).abs() < 1e-7, "{flight} {wanted}");
}

#[test]
fn a_pendulum_on_a_rope_goes_slack() {
    goes_slack::<Relative>();
    goes_slack::<Absolute>();
}

/// Its tension is `m g / cos`.
fn circles<C: Coordinates<Bob>>() {
    let (bob, h) = (Bob::default(), Bob::HANDLES);
    let interactions = [Interaction::rope(h.bob, h.nail, 1.0)];
    let [rope] = Interaction::handles(&interactions);
    let (sine, cosine) = (0.6, 0.8);
    let rate = f64::sqrt(GRAVITY / cosine);
    Simulation::new(&bob, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start([sine, 0.0, -cosine], [0.0, rate * sine, 0.0]))
        .interactions(interactions)
        .run(0.0..=10.0, every(0.5), |sample| {
            assert_eq!(sample.mode(rope), Ok(Mode::AtUpper));
            let effort = sample.effort(rope).expect("it is listed");
            assert!((effort + 2.0 * GRAVITY / cosine).abs() < 1e-8, "{effort}");
            let position = sample.position(h.bob);
            assert!((position.z + cosine).abs() < 1e-8);
            let phase = rate * sample.time();
            assert!((position.x - sine * phase.cos()).abs() < 1e-7);
            assert!(sample.impact(rope).expect("it is listed").is_none());
        })
        .expect("it circles");
    let mut stepper = bob
        .stepper(StandardLagrange, Rk4)
        .expect("it is prepared")
        .coordinates::<C>()
        .interactions(interactions);
    let begin = start([sine, 0.0, -cosine], [0.0, rate * sine, 0.0]);
    let mut state = stepper.state_of(&begin).expect("a state");
    for _ in 0..1000 {
        stepper.step(&mut state, 1e-3).expect("it steps");
    }
    let effort = stepper.effort(rope, &state).expect("it is listed");
    assert!((effort + 2.0 * GRAVITY / cosine).abs() < 1e-6, "{effort}");
}

#[test]
fn a_conical_pendulum_draws_its_rope() {
    circles::<Relative>();
    circles::<Absolute>();
}

/// From the nail itself, where the rope has no direction, it falls by its length and bounces.
#[test]
fn a_rope_begins_where_both_points_meet() {
    let (bob, h) = (Bob::default(), Bob::HANDLES);
    let interactions = [Interaction::rope(h.nail, h.bob, 1.25).restitution(1.0)];
    let [rope] = Interaction::handles(&interactions);
    let fall = f64::sqrt(2.5 / GRAVITY);
    let report = bob
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .initial_state(start([0.0; 3], [0.0; 3]))
        .interactions(interactions)
        .run(0.0..=1.5 * fall, every(0.1), |sample| {
            assert!(sample.position(h.bob).z > -1.25 - 1e-9);
            if let Some(impact) = sample.impact(rope).expect("it is listed") {
                assert!((impact.time - fall).abs() < 1e-9);
                assert!((impact.impulse + 4.0 * GRAVITY * fall).abs() < 1e-8);
            }
        })
        .expect("it falls");
    let view = bob.view(report.time, &report.state).expect("a view");
    let wanted = -1.25 + 0.375 * GRAVITY * fall * fall;
    assert!((view.position(h.bob).z - wanted).abs() < 1e-8);
}

/// It leaves a ball of 1 m, on which it slides down, at a height of two thirds.
#[test]
fn a_strut_bears_until_it_would_pull() {
    let (bob, h) = (Bob::default(), Bob::HANDLES);
    let interactions = [Interaction::strut(h.nail, h.bob, 1.0)];
    let [strut] = Interaction::handles(&interactions);
    let (sine, cosine) = (0.6, 0.8);
    let mut left = None;
    bob.simulation(StandardLagrange, DormandPrince::new(tight()))
        .initial_state(start([sine, 0.0, cosine], [0.0; 3]))
        .interactions(interactions)
        .run(0.0..=1.0, every(0.02), |sample| {
            let height = sample.position(h.bob).z;
            if sample.mode(strut) == Ok(Mode::AtLower) {
                // m (g cos - v^2 / l)
                let wanted = 2.0 * GRAVITY * (height - 2.0 * (cosine - height));
                let effort = sample.effort(strut).expect("it is listed");
                assert!((effort - wanted).abs() < 1e-8, "{effort} {wanted}");
            } else {
                left.get_or_insert(height);
            }
        })
        .expect("it slides");
    let left = left.expect("it leaves");
    assert!((left - cosine * 2.0 / 3.0).abs() < 1e-8, "{left}");
}

/// Two balls of 1 kg fly apart and together between a rope and a strut, without gravity.
fn rattles<C: Coordinates<Row>>() {
    let (row, h) = (Row::default(), Row::HANDLES);
    let mut begin = row.described_state().expect("it is described");
    row.set_displacement_rate(&mut begin, h.third, 1.0)
        .expect("it is free");
    let interactions = [Interaction::distance(h.b, h.c, [0.25, 0.75]).restitution(0.5)];
    let [rope] = Interaction::handles(&interactions);
    let report = Simulation::new(&row, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(begin)
        .interactions(interactions)
        .run(0.0_f64..=3.25, every(0.05), |sample| {
            let (b, c) = (sample.position(h.b).x, sample.position(h.c).x);
            assert!(c - b > 0.25 - 1e-9 && c - b < 0.75 + 1e-9);
            // At 0.25, then 0.5 m at 0.5 m/s, then 0.5 m at 0.25 m/s.
            let hits = [0.25, 1.25, 3.25];
            let time = sample.time();
            if hits.iter().all(|hit| (time - hit).abs() > 1e-9) {
                let hits = hits.iter().filter(|hit| **hit < time).count();
                let wanted = f64::powi(-0.5, i32::try_from(hits).expect("few"));
                let rate = sample.displacement_rate(h.third) - sample.displacement_rate(h.second);
                assert!((rate - wanted).abs() < 1e-12, "{time}: {rate} {wanted}");
            }
            if let Some(impact) = sample.impact(rope).expect("it is listed") {
                let is_drawn = (impact.time - 0.25).abs() < 1e-9;
                let wanted = if is_drawn { -0.75 } else { 0.375 };
                let is_third = impact.time > 3.0;
                assert!(
                    is_third || (impact.impulse - wanted).abs() < 1e-12,
                    "{impact:?}"
                );
            }
        })
        .expect("they move");
    let view = row.view(report.time, &report.state).expect("a view");
    let momentum = view.displacement_rate(h.second) + view.displacement_rate(h.third);
    assert!((momentum - 1.0).abs() < 1e-12);
}

#[test]
fn a_distance_has_two_limits() {
    rattles::<Relative>();
    rattles::<Absolute>();
}

/// A level rod falls by 0.2 m until the rope at its end is tight. The impulse is `v / (1/m +
/// a^2/I)`.
fn catches_a_rod<C: Coordinates<Falling>>() {
    let (falling, h) = (Falling::default(), Falling::HANDLES);
    let interactions = [Interaction::rope(h.end, h.nail, 1.2)];
    let [rope] = Interaction::handles(&interactions);
    let start = falling.described_state().expect("it is described");
    let energy = falling.view(0.0, &start).expect("a view").energy();
    let rate = f64::sqrt(2.0 * GRAVITY * 0.2);
    let report = Simulation::new(&falling, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions(interactions)
        .run(0.0..=0.5, every(0.01), |sample| {
            let Some(impact) = sample.impact(rope).expect("it is listed") else {
                return;
            };
            assert!((impact.time - rate / GRAVITY).abs() < 1e-10);
            assert!((impact.impulse + rate / 2.0).abs() < 1e-9, "{impact:?}");
            let wanted = energy - rate * rate / 4.0;
            let is_before = sample.time() == impact.time && sample.energy() > wanted + 0.1;
            assert!(is_before || (sample.energy() - wanted).abs() < 1e-8);
            assert!((sample.position(h.end) - sample.position(h.nail)).norm() < 1.2 + 1e-9);
        })
        .expect("it falls");
    let view = falling.view(0.5, &report.state).expect("a view");
    let distance = (view.position(h.end) - view.position(h.nail)).norm();
    assert!((distance - 1.2).abs() < 1e-9, "{distance}");
}

#[test]
fn a_rope_catches_the_end_of_a_rod() {
    catches_a_rod::<Relative>();
    catches_a_rod::<Absolute>();
}

/// The distance of two points of one body has no freedom, and the rope bears nothing.
#[test]
fn a_rope_along_a_rod_bears_nothing() {
    let (falling, h) = (Falling::default(), Falling::HANDLES);
    let interactions = [Interaction::rope(h.end, h.other, 1.0)];
    let [rope] = Interaction::handles(&interactions);
    falling
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .interactions(interactions)
        .run(0.0..=0.3, every(0.1), |sample| {
            let effort = sample.effort(rope).expect("it is listed");
            assert!(effort.abs() < 1e-9, "{effort}");
        })
        .expect("it falls");
}

#[test]
fn distances_without_a_direction_are_refused() {
    let (bob, h) = (Bob::default(), Bob::HANDLES);
    let refused = |interaction: Interaction<f64, Bob>, name: &str| {
        let run = bob
            .simulation(StandardLagrange, DormandPrince::default())
            .interactions([interaction])
            .run(0.0..=1.0, every(0.1), |_| ());
        let fault = run.expect_err("it is refused").fault;
        let is_told = matches!(fault, Fault::Start(StartFault::InteractionSetting { joint: "nail", setting, .. }) if setting == name);
        assert!(is_told, "{fault}");
    };
    refused(Interaction::rope(h.nail, h.bob, 0.0), "greatest distance");
    refused(Interaction::rope(h.nail, h.bob, -1.0), "greatest distance");
    refused(Interaction::rope(h.nail, h.bob, f64::NAN), "lower limit");
    refused(Interaction::strut(h.nail, h.bob, 0.0), "least distance");
    refused(
        Interaction::distance(h.nail, h.bob, [-1.0, 1.0]),
        "least distance",
    );
    refused(
        Interaction::distance(h.nail, h.bob, [2.0, 1.0]),
        "lower limit",
    );
}
