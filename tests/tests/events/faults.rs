//! What ends a run, by name.

use holonom::error::{StartFault, StepFault};
use holonom::prelude::*;
use holonom::{Adams, AdamsBashforthMoulton4, Bdf, RadauIIA, Runs};

use super::{Ball, GRAVITY, Slider, height, tight};

/// How a ball ends that bounces ever shorter, and what it loses.
fn zeno<I: Runs<Problem<Ball, StandardLagrange>>>(integrator: I, restitution: f64) -> Fault {
    let (ball, rail) = (Ball::default(), Ball::HANDLES.rail);
    let error = Simulation::new(&ball, StandardLagrange, integrator)
        .on("floor", Crossing::Falling, height, |event| {
            let speed = event.displacement_rate(rail).abs();
            event.set_displacement_rate(rail, restitution * speed)
        })
        .run(0.0..=100.0, every(0.1), |sample| {
            assert!(
                height(sample) > -1e-9,
                "through the floor at {}",
                sample.time()
            );
        })
        .expect_err("it bounces without end");
    let fall = (2.0 / GRAVITY).sqrt();
    let wanted = fall * (1.0 + 2.0 * restitution / (1.0 - restitution));
    assert!((error.time - wanted).abs() < 1e-2, "{error}");
    error.fault
}

#[test]
fn chattering_is_told_by_name() {
    for restitution in [0.01, 0.1, 0.3, 0.5, 0.8, 0.9, 0.99] {
        let fault = zeno(DormandPrince::default(), restitution);
        let is_told = matches!(
            fault,
            Fault::Step(StepFault::Chattering { event: "floor", .. })
        );
        assert!(is_told, "{restitution}: {fault}");
    }
    for restitution in [0.1, 0.5, 0.9] {
        let faults = [
            zeno(Rk4::every(0.01), restitution),
            zeno(Rk4::every(0.1), restitution),
            zeno(AdamsBashforthMoulton4::every(0.01), restitution),
            zeno(Adams::new(tight()), restitution),
            zeno(Adams::default(), restitution),
            zeno(Bdf::new(tight()), restitution),
            zeno(RadauIIA::default(), restitution),
        ];
        for (index, fault) in faults.iter().enumerate() {
            let is_told = matches!(
                fault,
                Fault::Step(StepFault::Chattering { event: "floor", .. })
            );
            assert!(is_told, "{index}, {restitution}: {fault}");
        }
    }
}

#[test]
fn a_sliding_mode_is_told() {
    // Dry friction without its smoothing: the sign of the velocity leads back to where it changes.
    let (mut slider, h) = (Slider::new(0.0).expect("acceptable"), Slider::HANDLES);
    slider.push = -1.0;
    let mut start = slider.described_state().expect("described");
    slider
        .set_displacement_rate(&mut start, h.rail, 1.0)
        .expect("free");
    let error = slider
        .simulation(StandardLagrange, DormandPrince::default())
        .initial_state(start)
        .on(
            "rest",
            Crossing::Either,
            |s| s.displacement_rate(h.rail),
            |event| {
                let push = -event.inputs_mut().push;
                event.inputs_mut().push = push;
            },
        )
        .run(0.0..=5.0, every(0.1), |_| ())
        .expect_err("it slides");
    assert!(
        matches!(
            error.fault,
            Fault::Step(StepFault::Chattering { event: "rest", .. })
        ),
        "{error}"
    );
    assert!((error.time - 1.0).abs() < 1e-6, "{error}");
    let text = error.to_string();
    assert!(text.contains("event `rest` fires"), "{text}");
}

#[test]
fn a_reading_that_is_not_a_number_is_told() {
    let ball = Ball::default();
    for bad in [0.0, 0.3] {
        let error = ball
            .simulation(StandardLagrange, Rk4::every(0.01))
            .on(
                "lost",
                Crossing::Falling,
                |s| if s.time() >= bad { f64::NAN } else { 1.0 },
                |_| (),
            )
            .run(0.0..=1.0, every(0.1), |_| ())
            .expect_err("not a number");
        assert!(
            matches!(
                error.fault,
                Fault::Step(StepFault::EventNotANumber { event: "lost", .. })
            ),
            "{error}"
        );
        assert!((error.time - bad).abs() < 0.011, "{error}");
    }
    // Infinite readings have a sign.
    let report = ball
        .simulation(StandardLagrange, Rk4::every(0.01))
        .run_until(0.0..=1.0, Crossing::Rising, |s| {
            if s.time() < 0.3 {
                f64::NEG_INFINITY
            } else {
                f64::INFINITY
            }
        })
        .expect("it stops");
    assert!(
        report.stopped && (report.time - 0.3).abs() < 1e-12,
        "{}",
        report.time
    );
}

#[test]
fn settings_are_refused() {
    let slider = Slider::new(0.0).expect("acceptable");
    let simulation = slider.simulation(StandardLagrange, Rk4::every(0.01));
    for period in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = simulation
            .clone()
            .every_period(period, |_, _| ())
            .run(0.0..=1.0, every(0.1), |_| ())
            .expect_err("no period");
        assert!(
            matches!(
                error.fault,
                Fault::Start(StartFault::Setting { name: "period", .. })
            ),
            "{error}"
        );
    }
    let error = simulation
        .clone()
        .every_period(1e-18, |_, _| ())
        .run(0.0..=1.0, every(0.1), |_| ())
        .expect_err("too short");
    assert!(
        matches!(error.fault, Fault::Step(StepFault::TooShort { .. })),
        "{error}"
    );
    let error = simulation
        .verified()
        .every_period(0.1, |_, _| ())
        .run(0.0..=1.0, every(0.1), |_| ())
        .expect_err("no companion");
    assert!(
        matches!(error.fault, Fault::Start(StartFault::NotVerified)),
        "{error}"
    );
}

#[test]
fn a_budget_counts_over_events() {
    let (ball, rail) = (Ball::default(), Ball::HANDLES.rail);
    let error = ball
        .simulation(StandardLagrange, DormandPrince::default().budget(300))
        .on("floor", Crossing::Falling, height, |event| {
            event.set_displacement_rate(rail, -event.displacement_rate(rail))
        })
        .run(0.0..=1e3, every(100.0), |_| ())
        .expect_err("too many");
    assert!(
        matches!(error.fault, Fault::Step(StepFault::Budget { .. })),
        "{error}"
    );
}
