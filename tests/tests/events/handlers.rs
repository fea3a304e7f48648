//! What handlers change, and what is refused.

use holonom::Runs;
use holonom::error::StepFault;
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;

use super::{Ball, GRAVITY, Slider, height};

#[test]
fn a_handler_that_stops_leaves_the_state_that_was_found() {
    let ball = Ball::default();
    for end in [1.0, (2.0 / GRAVITY).sqrt()] {
        let mut last = 0.0;
        let report = ball
            .simulation(StandardLagrange, DormandPrince::default())
            .on("floor", Crossing::Falling, height, |_| {
                ControlFlow::Break(())
            })
            .run(0.0..=end + 1e-14, every(0.3), |sample| last = sample.time())
            .expect("it falls");
        let time = (2.0 / GRAVITY).sqrt();
        assert!(report.stopped && (report.time - time).abs() < 1e-13);
        assert_eq!(last, report.time);
        let there = Ball::pose(&report.state, Ball::HANDLES.ball).position.z;
        assert!(there <= 0.0 && there > -1e-14, "{there:e}");
    }
    let report = ball
        .simulation(StandardLagrange, DormandPrince::default())
        .run_until(0.0..=0.2, Crossing::Falling, height);
    let report = report.expect("it falls");
    assert!(!report.stopped && report.time == 0.2);
}

#[test]
fn a_handler_changes_parameters() {
    // With a damper from 1 s on: `v = exp(-(t - 1))`.
    fn run<C: Coordinates<Slider>>()
    where
        holonom::integrate::Adaptive<f64, holonom::integrate::DormandPrince5>:
            Runs<Problem<Slider, StandardLagrange, f64, C>>,
    {
        let (slider, h) = (Slider::new(0.0).expect("acceptable"), Slider::HANDLES);
        let mut start = slider.described_state().expect("described");
        slider
            .set_displacement_rate(&mut start, h.rail, 1.0)
            .expect("free");
        let mut other = Slider::new(0.0).expect("acceptable");
        let report = Simulation::new(
            &slider,
            StandardLagrange,
            DormandPrince::new(super::tight()),
        )
        .coordinates::<C>()
        .initial_state(start)
        .on(
            "oil",
            Crossing::Rising,
            |s| s.time() - 1.0,
            |event| {
                other.damping = 1.0;
                event.update(&other)
            },
        )
        .run(0.0..=3.0, every(0.1), |_| ())
        .expect("it moves");
        let speed = Slider::velocity(&report.state, h.slider).x;
        assert!((speed - (-2.0_f64).exp()).abs() < 1e-10, "{speed}");
        assert!(report.warnings().is_empty(), "{}", report.warnings());
    }
    run::<Absolute>();
    run::<Relative>();
}

#[test]
fn a_parameter_that_is_not_acceptable_ends_the_run() {
    let slider = Slider::new(0.0).expect("acceptable");
    let mut other = Slider::new(0.0).expect("acceptable");
    other.damping = f64::NAN;
    let error = slider
        .simulation(StandardLagrange, DormandPrince::default())
        .on(
            "oil",
            Crossing::Rising,
            |s| s.time() - 1.0,
            |event| event.update(&other),
        )
        .run(0.0..=3.0, every(0.1), |_| ())
        .expect_err("refused");
    assert!(matches!(error.fault, Fault::Parameter(_)), "{error}");
    assert_eq!(error.time, 1.0);
}

#[test]
fn a_handler_sets_a_position() {
    // A ball that is put back to the height 1 m at rest, again and again.
    let (ball, rail) = (Ball::default(), Ball::HANDLES.rail);
    let mut times = Vec::new();
    let report = ball
        .simulation(StandardLagrange, DormandPrince::default())
        .on(
            "floor",
            Crossing::Falling,
            height,
            |event| -> Result<(), Fault> {
                times.push(event.time());
                event.set_displacement(rail, 0.0)?;
                event.set_displacement_rate(rail, 0.0)
            },
        )
        .run(0.0..=3.0, every(0.1), |sample| {
            assert!(height(sample) > -1e-12)
        })
        .expect("it falls");
    let fall = (2.0 / GRAVITY).sqrt();
    assert_eq!(times.len(), 6);
    for (k, time) in times.iter().enumerate() {
        assert!((time - fall * (k + 1) as f64).abs() < 1e-12);
    }
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

#[test]
fn a_state_that_a_handler_sets_is_checked_as_a_start() {
    let ball = Ball::default();
    let h = Ball::HANDLES;
    let open = |event: &mut holonom::run::Event<'_, f64, Ball>| {
        Ball::set_velocity(event.state_mut(), h.ball, [1.0, 0.0, 0.0].into());
    };
    let error = ball
        .simulation(StandardLagrange, DormandPrince::default())
        .on("floor", Crossing::Falling, height, open)
        .run(0.0..=3.0, every(0.1), |_| ())
        .expect_err("it opens the rail");
    assert!(
        matches!(
            error.fault,
            Fault::Step(StepFault::HandlerOpens {
                event: "floor",
                joint: "rail",
                ..
            })
        ),
        "{error}"
    );
    assert!((error.time - (2.0 / GRAVITY).sqrt()).abs() < 1e-12);
    let error = ball
        .simulation(StandardLagrange, DormandPrince::default())
        .on("floor", Crossing::Falling, height, |event| {
            Ball::set_velocity(event.state_mut(), h.ball, [0.0, 0.0, f64::NAN].into());
        })
        .run(0.0..=3.0, every(0.1), |_| ())
        .expect_err("not a number");
    assert!(
        matches!(error.fault, Fault::Step(StepFault::StateNotFinite)),
        "{error}"
    );
}

#[test]
fn energy_that_an_event_gives_is_no_warning() {
    // A lossless bounce, a kick, and a fall into the deep.
    let (ball, rail) = (Ball::default(), Ball::HANDLES.rail);
    let report = ball
        .simulation(StandardLagrange, DormandPrince::default())
        .on("kick", Crossing::Falling, height, |event| {
            event.set_displacement_rate(rail, -1.3 * event.displacement_rate(rail))
        })
        .run(0.0..=20.0, every(0.1), |_| ())
        .expect("it bounces");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}
