//! Masses and lengths far apart, restitution of 0 and of 1, and starts on a stop.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode as Mode;

use super::GRAVITY;

/// A ball on a vertical rail over a floor.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Ball {
    #[param]
    mass: f64,
    #[param]
    height: f64,
    #[body(
        mass = mass, inertia = [0.1 * mass, 0.1 * mass, 0.1 * mass],
        position = [0.0, 0.0, height]
    )]
    ball: Body,
    #[joint(between = [ground, ball], point = [0.0, 0.0, height], axis = [0.0, 0.0, 1.0])]
    rail: Prismatic,
}

/// The height at a time after bounces, of a fall from the height 1 m in units of its duration.
fn height(time: f64, restitution: f64) -> f64 {
    let (mut start, mut speed, mut duration) = (0.0, 0.0, 1.0);
    let mut from = 1.0;
    // In these units gravity is 2.
    while time > start + duration && duration > 1e-12 {
        start += duration;
        speed = restitution * if from == 1.0 { 2.0 } else { speed };
        from = 0.0;
        duration = speed;
    }
    if duration <= 1e-12 {
        return 0.0;
    }
    let since = time - start;
    from + speed * since - since * since
}

fn falls<C: Coordinates<Ball>>(mass: f64, from: f64, restitution: f64) {
    let what = format!("{mass} kg, {from} m, {restitution}");
    let (ball, h) = (Ball::new(mass, from).expect("acceptable"), Ball::HANDLES);
    let fall = (2.0 * from / GRAVITY).sqrt();
    let tolerance = Tolerance::of(&ball, 1e-12).expect("sizes");
    let floor = Interaction::limits(h.rail.displacement(), [-from, f64::INFINITY]);
    let interactions = [floor.restitution(restitution)];
    let [floor] = Interaction::handles(&interactions);
    let mut count = 0;
    ball.simulation(StandardLagrange, DormandPrince::new(tolerance))
        .coordinates::<C>()
        .interactions(interactions)
        .run(
            0.0..=4.3 * fall,
            every(0.1 * fall),
            |sample| -> Result<(), Fault> {
                let wanted = height(sample.time() / fall, restitution);
                let found = sample.pose(h.ball).position.z / from;
                let error = (found - wanted).abs();
                assert!(
                    error < 1e-9,
                    "{what}: {found} {wanted} at {}",
                    sample.time()
                );
                if restitution == 0.0 && sample.time() > 1.05 * fall {
                    assert_eq!(sample.mode(floor)?, Mode::AtLower, "{what}");
                    let weight = mass * GRAVITY;
                    assert!(
                        (sample.effort(floor)? / weight - 1.0).abs() < 1e-12,
                        "{what}"
                    );
                    count += 1;
                }
                Ok(())
            },
        )
        .unwrap_or_else(|error| panic!("{what}: {error}"));
    assert!(restitution > 0.0 || count > 20, "{what}");
}

#[test]
fn a_ball_falls_whatever_it_weighs_and_from_wherever() {
    for mass in [1e-6, 1.0, 1e6] {
        for from in [1e-10, 1e-3, 1.0, 1e3] {
            for restitution in [0.0, 0.6, 1.0] {
                falls::<Relative>(mass, from, restitution);
                falls::<Absolute>(mass, from, restitution);
            }
        }
    }
}

/// Bounces down to where round-off ends them, in single precision.
#[test]
fn a_ball_falls_by_micrometres_in_single_precision() {
    for from in [1e-5, 3e-6, 1e-7] {
        let (ball, h) = (Ball::new(2.0, from).expect("acceptable"), Ball::HANDLES);
        let fall = (2.0 * from / GRAVITY).sqrt();
        let relative = 1e-4;
        let absolute = relative * 1e-3 * from as f32;
        let integrator = DormandPrince::new(Tolerance { relative, absolute });
        let bounds = [-from as f32, f32::INFINITY];
        let floor = Interaction::limits(h.rail.displacement(), bounds).restitution(0.5);
        let span = 0.0..=(3.3 * fall) as f32;
        Simulation::new(&ball, StandardLagrange, integrator)
            .coordinates::<Relative>()
            .interactions([floor])
            .run(span, every((0.1 * fall) as f32), |sample| {
                let found = f64::from(sample.pose(h.ball).position.z) / from;
                let wanted = height(f64::from(sample.time()) / fall, 0.5);
                // The bounces that are left out are lower than a ten thousandth.
                assert!((found - wanted).abs() < 2e-4, "{from}: {found} {wanted}");
                assert!(found > -1e-5, "{from}: {found}");
            })
            .unwrap_or_else(|error| panic!("{from}: {error}"));
    }
}

/// Between stops a nanometre apart, at a metre from where positions are counted and at none.
#[test]
fn stops_may_be_a_nanometre_apart() {
    for (at, gap) in [(0.0, 1e-9), (0.0, 1e-6), (1.0, 1e-6), (1.0, 1e-9)] {
        let (ball, h) = (Ball::new(2.0, 1.0).expect("acceptable"), Ball::HANDLES);
        let mut start = ball.described_state().expect("described");
        ball.set_displacement(&mut start, h.rail, at + 0.5 * gap)
            .expect("free");
        let stops = Interaction::limits(h.rail.displacement(), [at, at + gap]).restitution(0.5);
        let relative = 1e-10;
        let absolute = 1e-3 * relative * gap;
        let fall = (gap / GRAVITY).sqrt();
        let mut beyond = 0.0_f64;
        let report = ball
            .simulation(
                StandardLagrange,
                DormandPrince::new(Tolerance { relative, absolute }),
            )
            .initial_state(start)
            .interactions([stops])
            .run(0.0..=5.0 * fall, every(0.01 * fall), |sample| {
                let above = sample.displacement(h.rail) - at;
                beyond = beyond.max(-above).max(above - gap);
            })
            .unwrap_or_else(|error| panic!("{at}, {gap}: {error}"));
        // Round-off of the metre.
        assert!(beyond < 1e-14, "{at}, {gap}: {beyond:e}");
        let view = ball.view(report.time, &report.state).expect("finite");
        let left = view.displacement(h.rail) - at;
        assert!(left.abs() < 1e-14, "{at}, {gap}: {left:e}");
        assert!(report.warnings().is_empty(), "{}", report.warnings());
    }
}

#[test]
fn a_start_on_the_stop_with_a_rate_into_it_is_an_impact() {
    for restitution in [0.0, 0.5, 1.0] {
        let (ball, h) = (Ball::new(2.0, 1.0).expect("acceptable"), Ball::HANDLES);
        let mut start = ball.described_state().expect("described");
        ball.set_displacement_rate(&mut start, h.rail, -3.0)
            .expect("free");
        let stop = Interaction::limits(h.rail.displacement(), [0.0, 9.0]).restitution(restitution);
        let [handle] = Interaction::handles(&[stop]);
        let mut first = None;
        ball.simulation(StandardLagrange, DormandPrince::new(super::tight()))
            .initial_state(start)
            .interactions([stop])
            .run(0.0..=0.1, every(0.1), |sample| -> Result<(), Fault> {
                let impact = sample.impact(handle)?;
                if let Some(impact) = impact {
                    first.get_or_insert(impact);
                }
                let speed = 3.0 * restitution;
                let time = sample.time();
                let wanted = if restitution == 0.0 {
                    0.0
                } else {
                    speed * time - 0.5 * GRAVITY * time * time
                };
                if impact.is_some() {
                    let error = sample.displacement(h.rail) - wanted;
                    assert!(error.abs() < 1e-12, "{restitution}: {error:e}");
                }
                Ok(())
            })
            .expect("it bounces");
        let impact = first.expect("an impact");
        assert_eq!(impact.time, 0.0);
        assert!((impact.impulse - 2.0 * 3.0 * (1.0 + restitution)).abs() < 1e-12);
        assert!((impact.lost_energy - 9.0 * (1.0 - restitution * restitution)).abs() < 1e-11);
    }
}

/// Two stops at one place share the load; the one that throws farther back decides.
#[test]
fn two_stops_at_one_place() {
    let (ball, h) = (Ball::new(2.0, 1.0).expect("acceptable"), Ball::HANDLES);
    let stop = |restitution| {
        Interaction::limits(h.rail.displacement(), [-1.0, 9.0]).restitution(restitution)
    };
    let speed = (2.0 * GRAVITY).sqrt();
    let fall = (2.0 / GRAVITY).sqrt();
    for (restitutions, decides) in [([0.5, 0.8], 0.8), ([0.8, 0.5], 0.8), ([0.5, 0.5], 0.5)] {
        let report = ball
            .simulation(StandardLagrange, DormandPrince::new(super::tight()))
            .interactions(restitutions.map(stop))
            .run(0.0..=fall + 0.1, every(1.0), |_| ())
            .expect("it bounces");
        let found = Ball::velocity(&report.state, h.ball).z;
        let wanted = decides * speed - 0.1 * GRAVITY;
        assert!(
            (found - wanted).abs() < 1e-10,
            "{restitutions:?}: {found} {wanted}"
        );
    }
    let stops = [stop(0.0), stop(0.0)];
    let [first, second] = Interaction::handles(&stops);
    let mut efforts = [0.0; 2];
    ball.simulation(StandardLagrange, DormandPrince::new(super::tight()))
        .interactions(stops)
        .run(0.0..=2.0, every(1.0), |sample| -> Result<(), Fault> {
            efforts = [sample.effort(first)?, sample.effort(second)?];
            Ok(())
        })
        .expect("it lies there");
    let sum = efforts[0] + efforts[1];
    assert!((sum - 2.0 * GRAVITY).abs() < 1e-11, "{efforts:?}");
    assert!(efforts.iter().all(|effort| *effort >= 0.0), "{efforts:?}");
}

/// Two masses on a rail, the second one on the first, so that its displacement is their distance.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Two {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    first: Body,
    #[body(mass = 2.0, inertia = [0.1, 0.1, 0.1])]
    second: Body,
    #[joint(between = [ground, first], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[joint(between = [first, second], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    gap: Prismatic,
}

/// An upper and a lower limit are met at once. With the rates `a` and `r` before, and impulses
/// `x <= 0` and `y >= 0`, the changes are `x - y` and `y / 2 - x + y`.
fn met_at_once<C: Coordinates<Two>>(rate: f64, wanted: [f64; 2], impulses: [f64; 2]) {
    let (two, h) = (Two::default(), Two::HANDLES);
    let mut start = two.described_state().expect("described");
    two.set_displacement_rate(&mut start, h.rail, 1.0)
        .and_then(|()| two.set_displacement_rate(&mut start, h.gap, rate))
        .expect("free");
    let limits = [
        Interaction::limits(h.rail.displacement(), [-9.0, 1.0]).restitution(0.5),
        Interaction::limits(h.gap.displacement(), [rate, 9.0]).restitution(0.5),
    ];
    let run = |is_reversed: bool| {
        let mut limits = limits;
        if is_reversed {
            limits.reverse();
        }
        let handles = Interaction::handles(&limits);
        let mut found = [0.0; 2];
        let report = two
            .simulation(StandardLagrange, DormandPrince::new(super::tight()))
            .coordinates::<C>()
            .initial_state(start)
            .interactions(limits)
            .run(0.0..=1.5, every(0.5), |sample| -> Result<(), Fault> {
                for (number, limits) in handles.into_iter().enumerate() {
                    let place = if is_reversed { 1 - number } else { number };
                    if let Some(impact) = sample.impact(limits)? {
                        assert!((impact.time - 1.0).abs() < 1e-12);
                        found[place] = impact.impulse;
                    }
                }
                Ok(())
            })
            .expect("they collide");
        let [a, b] = [h.first, h.second].map(|body| Two::velocity(&report.state, body).x);
        ([a, b - a], found)
    };
    for is_reversed in [false, true] {
        let (rates, found) = run(is_reversed);
        for (x, y) in rates.iter().zip(&wanted).chain(found.iter().zip(&impulses)) {
            assert!(
                (x - y).abs() < 1e-11,
                "{rates:?} {wanted:?}, {found:?} {impulses:?}"
            );
        }
    }
}

#[test]
fn limits_in_both_directions_at_one_time() {
    // Both push.
    met_at_once::<Relative>(-1.2, [-0.5, 0.6], [-0.9, 0.6]);
    met_at_once::<Absolute>(-1.2, [-0.5, 0.6], [-0.9, 0.6]);
    // The second one throws the first one back by more than its own stop would.
    met_at_once::<Relative>(-2.0, [-1.0, 1.0], [0.0, 2.0]);
    met_at_once::<Absolute>(-2.0, [-1.0, 1.0], [0.0, 2.0]);
}

/// A rotor at 100 rad/s that nothing slows down, so that its steps are many turns.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Rotor {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], angular_velocity = [0.0, 0.0, 100.0])]
    rotor: Body,
    #[joint(between = [ground, rotor], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge: Revolute,
}

fn no_stop_is_passed<C: Coordinates<Rotor>>(stop: f64) {
    let (rotor, h) = (Rotor::default(), Rotor::HANDLES);
    let stops = h.hinge.angle().limits();
    let mut hits = 0;
    rotor
        .simulation(StandardLagrange, DormandPrince::default())
        .coordinates::<C>()
        .interactions([Interaction::limits(h.hinge.angle(), [-stop, stop]).restitution(1.0)])
        .run(0.0..=1.0, every(1e-3), |sample| -> Result<(), Fault> {
            // To and fro between both stops.
            let period = 4.0 * stop / 100.0;
            let phase = (sample.time() + 0.25 * period).rem_euclid(period);
            let wanted = 100.0 * (phase.min(period - phase) - 0.25 * period);
            let found = sample.angle(h.hinge);
            // What would be missed is a bounce.
            let turn = core::f64::consts::TAU;
            let error = (found - wanted + 0.5 * turn).rem_euclid(turn) - 0.5 * turn;
            assert!(
                error.abs() < 1e-4,
                "{stop}: {found} {wanted} {}",
                sample.time()
            );
            hits += usize::from(sample.impact(stops)?.is_some());
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{stop}: {error}"));
    assert!(hits > 10, "{stop}");
}

#[test]
fn no_stop_is_passed_whatever_the_step() {
    for stop in [0.1, 1.0] {
        no_stop_is_passed::<Relative>(stop);
        no_stop_is_passed::<Absolute>(stop);
    }
}

#[test]
fn no_stop_near_half_a_turn_is_passed_whatever_the_step() {
    for stop in [3.0, 3.1, 3.125, core::f64::consts::PI, 4.0, 7.5] {
        no_stop_is_passed::<Relative>(stop);
        no_stop_is_passed::<Absolute>(stop);
    }
}

/// A rotor that a constant moment turns ever faster, so that its method is exact in any step.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Driven {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    rotor: Body,
    #[joint(between = [ground, rotor], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge: Revolute,
    #[force(between = [ground, rotor], axis = [0.0, 0.0, 1.0], moment = 100.0)]
    motor: TorsionalActuator,
}

#[test]
fn a_rate_that_grows_within_a_step_passes_no_stop() {
    for stop in [3.0, 4.0, 20.0] {
        let (driven, h) = (Driven::default(), Driven::HANDLES);
        // It comes back to where it began, at rest.
        let half = (2.0_f64 * stop / 1000.0).sqrt();
        let stops = h.hinge.angle().limits();
        let mut hits = 0;
        driven
            .simulation(StandardLagrange, DormandPrince::default())
            .interactions([Interaction::limits(h.hinge.angle(), [-stop, stop]).restitution(1.0)])
            .run(0.0..=2.0, every(0.01), |sample| -> Result<(), Fault> {
                let phase = sample.time().rem_euclid(2.0 * half);
                let since = phase.min(2.0 * half - phase);
                let turn = core::f64::consts::TAU;
                let error = sample.angle(h.hinge) - 500.0 * since * since;
                let error = (error + 0.5 * turn).rem_euclid(turn) - 0.5 * turn;
                assert!(error.abs() < 1e-6, "{stop}: {error} at {}", sample.time());
                hits += usize::from(
                    sample
                        .impact(stops)?
                        .is_some_and(|i| i.time == sample.time()),
                );
                Ok(())
            })
            .unwrap_or_else(|error| panic!("{stop}: {error}"));
        assert!(hits > 4, "{stop}: {hits}");
    }
}
