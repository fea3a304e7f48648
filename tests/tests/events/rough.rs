//! Events where they are hard: loops, projections, single precision, late times, many at once.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::{Adams, Bdf, DormandPrince853, RadauIIA, Runs, SemiImplicitEuler};

use super::{Ball, GRAVITY, Slider, height, tight};

/// A crank-rocker.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], redundant = "drop", coordinates = "both")]
struct Rocker {
    #[body(mass = 1.0, inertia = [0.01, 0.001, 0.01], position = [0.0, 0.0, 0.1], angular_velocity = [9.0, 0.0, 0.0], velocity = [0.0, -0.9, 0.0])]
    crank: Body,
    #[body(mass = 2.0, inertia = [0.1, 0.001, 0.1], position = [0.0, 0.3, 0.35], velocity = [0.0, -1.8, 0.0])]
    coupler: Body,
    #[body(mass = 1.5, inertia = [0.05, 0.001, 0.05], position = [0.0, 0.6, 0.25], angular_velocity = [3.6, 0.0, 0.0], velocity = [0.0, -0.9, 0.0])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    a: Revolute,
    #[joint(between = [crank, coupler], point = [0.0, 0.0, 0.2], axis = [1.0, 0.0, 0.0])]
    b: Revolute,
    #[joint(between = [coupler, rocker], point = [0.0, 0.6, 0.5], axis = [1.0, 0.0, 0.0])]
    c: Revolute,
    #[joint(between = [ground, rocker], point = [0.0, 0.6, 0.0], axis = [1.0, 0.0, 0.0])]
    d: Revolute,
}

/// The times at which the coupler is at a height, either way, by events.
fn passages<I, C>(integrator: I) -> Vec<f64>
where
    C: Coordinates<Rocker>,
    I: Runs<Problem<Rocker, StandardLagrange, f64, C>>,
{
    let (rocker, h) = (Rocker::default(), Rocker::HANDLES);
    let mut times = Vec::new();
    let report = Simulation::new(&rocker, StandardLagrange, integrator)
        .assembled()
        .projection(Projection::default())
        .coordinates::<C>()
        .on(
            "level",
            Crossing::Either,
            |sample| sample.pose(h.coupler).position.z - 0.3,
            |event| times.push(event.time()),
        )
        .run(0.0..=3.0, every(0.1), |_| ())
        .expect("it turns");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    times
}

#[test]
fn passages_of_a_loop_agree_between_coordinates_and_methods() {
    let fine = passages::<_, Relative>(DormandPrince::new(tight()));
    assert!(fine.len() > 4, "{fine:?}");
    let others = [
        passages::<_, Absolute>(DormandPrince::new(tight())),
        passages::<_, Relative>(holonom::DormandPrince853::new(tight())),
        passages::<_, Absolute>(holonom::Adams::new(tight())),
        passages::<_, Relative>(Rk4::every(5e-4)),
    ];
    for other in &others {
        assert_eq!(other.len(), fine.len(), "{other:?} {fine:?}");
        for (one, other) in fine.iter().zip(other) {
            assert!((one - other).abs() < 1e-8, "{one} {other}");
        }
    }
}

#[test]
fn single_precision_finds_events_to_its_digits() {
    let (ball, h) = (Ball::default(), Ball::HANDLES);
    let mut times: Vec<f32> = Vec::new();
    Simulation::new(&ball, StandardLagrange, Rk4::every(0.01_f32))
        .on(
            "floor",
            Crossing::Falling,
            |sample| sample.pose(h.ball).position.z,
            |event| {
                times.push(event.time());
                event.set_displacement_rate(h.rail, 0.8 * event.displacement_rate(h.rail).abs())
            },
        )
        .run(0.0_f32..=3.0, every(0.1), |sample| {
            assert!(sample.pose(h.ball).position.z > -1e-5);
        })
        .expect("it bounces");
    let (mut speed, mut wanted) = ((2.0 * GRAVITY).sqrt(), (2.0 / GRAVITY).sqrt());
    assert_eq!(times.len(), 6, "{times:?}");
    for time in times {
        assert!((f64::from(time) - wanted).abs() < 1e-4, "{time} {wanted}");
        speed *= 0.8;
        wanted += 2.0 * speed / GRAVITY;
    }
}

#[test]
fn late_and_negative_times_are_as_good_as_their_digits() {
    let ball = Ball::default();
    for start in [-1.0, -0.3, 1e6, 1e9] {
        let report = ball
            .simulation(StandardLagrange, DormandPrince::default())
            .run_until(start..=start + 1.0, Crossing::Falling, height)
            .expect("it falls");
        let wanted = start + (2.0 / GRAVITY).sqrt();
        let digits = 1e-12 + 8.0 * f64::EPSILON * f64::abs(start);
        assert!(
            report.stopped && (report.time - wanted).abs() < digits,
            "{start}"
        );
    }
    let slider = Slider::new(0.0).expect("acceptable");
    let mut calls = 0;
    slider
        .simulation(StandardLagrange, DormandPrince::default())
        .every_period(0.1, |_, _| calls += 1)
        .run(1e9..=1e9 + 1.0, every(0.25), |_| ())
        .expect("it rests");
    assert_eq!(calls, 10);
}

#[test]
fn a_run_may_be_repeated_and_has_no_length() {
    let ball = Ball::default();
    let mut found = Vec::new();
    let mut hybrid = ball
        .simulation(StandardLagrange, Rk4::every(0.01))
        .every_period(0.1, |_, _| ())
        .on("floor", Crossing::Falling, height, |event| {
            found.push(event.time())
        });
    for _ in 0..3 {
        hybrid.run(0.0..=1.0, every(0.1), |_| ()).expect("it falls");
    }
    hybrid
        .run(0.5..=0.5, every(0.1), |_| ())
        .expect("it stands");
    assert_eq!(found.len(), 3);
    assert!(found[0] == found[1] && found[1] == found[2]);
    let simulation = ball.simulation(StandardLagrange, Rk4::every(0.01));
    let report = simulation.run_until(0.5..=0.5, Crossing::Falling, height);
    assert!(!report.expect("it stands").stopped);
}

/// How many evaluations a run over an interval of the last digits takes.
fn evaluations<I: Runs<Problem<Ball, StandardLagrange>>>(integrator: I, start: f64) -> usize {
    let ball = Ball::default();
    let run = ball.simulation(StandardLagrange, integrator);
    let report = run.run(start..=2.0, every_step(), |_| ());
    let report = report.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(report.time, 2.0);
    report.evaluations
}

#[test]
fn an_interval_of_last_digits_ends() {
    let mut start = 2.0_f64;
    for digits in 1..=40 {
        start = start.next_down();
        let counts = [
            evaluations(DormandPrince::new(tight()), start),
            evaluations(DormandPrince853::new(tight()), start),
            evaluations(Adams::new(tight()), start),
            evaluations(Bdf::new(tight()), start),
            evaluations(RadauIIA::new(tight()), start),
        ];
        assert!(
            counts.iter().all(|&count| count < 100),
            "{digits}: {counts:?}"
        );
    }
}

#[test]
fn a_reading_may_take_an_evaluation() {
    let (slider, h) = (Slider::new(0.0).expect("acceptable"), Slider::HANDLES);
    let acceleration = |sample: &Sample<'_, f64, Slider>| {
        sample.displacement_acceleration(h.rail).unwrap_or(f64::NAN)
    };
    let mut when = 0.0;
    slider
        .simulation(StandardLagrange, DormandPrince::default())
        .forces(|time, _, loads| loads.force_between(h.rail, 1.0 - time))
        .on("lift", Crossing::Falling, acceleration, |event| {
            when = event.time()
        })
        .run(0.0..=2.0, every(0.1), |_| ())
        .expect("it moves");
    assert!((when - 1.0).abs() < 1e-12, "{when}");
}

#[test]
fn events_meet_breaks_reports_and_instants_at_one_time() {
    let (slider, h) = (Slider::new(0.0).expect("acceptable"), Slider::HANDLES);
    let count = core::cell::Cell::new(0);
    let report = slider
        .simulation(StandardLagrange, DormandPrince::default())
        .breaks(&[0.3, 0.5, 0.7])
        .every_period(0.1, |sample, inputs| {
            // What the handler of this instant has set is seen.
            if (sample.time() - 0.5).abs() < 1e-9 {
                assert_eq!(inputs.push, 7.0);
                inputs.push = 1.0;
            }
        })
        .on(
            "half",
            Crossing::Rising,
            |s| s.time() - 0.5,
            |event| {
                count.set(count.get() + 1);
                event.inputs_mut().push = 7.0;
            },
        )
        .run(0.0..=1.0, every(0.1), |_| ())
        .expect("it moves");
    assert_eq!(count.get(), 1);
    let speed = Slider::velocity(&report.state, h.slider).x;
    assert!((speed - 0.5).abs() < 1e-12, "{speed}");
}

#[test]
fn a_hundred_events_of_one_step_are_all_found() {
    let ball = Ball::default();
    let mut times = Vec::new();
    ball.simulation(StandardLagrange, Rk4::every(1.0))
        .on(
            "tick",
            Crossing::Either,
            |s| (100.0 * core::f64::consts::PI * s.time()).sin(),
            |event| times.push(event.time()),
        )
        .run(0.0..=0.0605, every(0.01), |_| ())
        .expect("it falls");
    // Six zeros within the first step: at least one in each sixth is found.
    assert_eq!(times.len(), 6, "{times:?}");
}

#[test]
fn semi_implicit_euler_has_events_too() {
    let ball = Ball::default();
    let report = ball
        .simulation(StandardLagrange, SemiImplicitEuler::every(1e-4))
        .run_until(0.0..=1.0, Crossing::Falling, height)
        .expect("it falls");
    let wanted = (2.0 / GRAVITY).sqrt();
    assert!((report.time - wanted).abs() < 1e-4, "{}", report.time);
}

#[test]
fn jumps_of_a_reading_are_where_they_are() {
    let (mut slider, h) = (Slider::new(0.0).expect("acceptable"), Slider::HANDLES);
    slider.push = 1.0;
    let acceleration = |sample: &Sample<'_, f64, Slider>| {
        sample.displacement_acceleration(h.rail).unwrap_or(f64::NAN)
    };
    let mut when = Vec::new();
    slider
        .simulation(StandardLagrange, DormandPrince::default())
        .every_period(0.25, |sample, inputs| {
            inputs.push = if sample.time() < 0.6 { 1.0 } else { -1.0 };
        })
        .on("jump", Crossing::Either, acceleration, |event| {
            when.push(event.time())
        })
        .run(0.0..=2.0, every(0.1), |_| ())
        .expect("it moves");
    assert_eq!(when, [0.75]);
}
