//! A run that its caller leads, against the same run with an observer.

use holonom::error::StartFault;
use holonom::prelude::*;
use holonom::run::{Leads, Reached, Run};
use holonom::{Adams, DormandPrince853, RadauIIA, Runs};

use super::{Ball, GRAVITY, Slider, height, tight};

const RESTITUTION: f64 = 0.7;
const END: f64 = 2.4;

type Solved<M> = Problem<M, StandardLagrange>;

/// A loop of one's own over a ball that bounces, and the observer's: times, states, counts.
fn agrees<I>(integrator: I)
where
    I: Runs<Problem<Ball, StandardLagrange>> + Leads<Solved<Ball>>,
{
    let (ball, rail) = (Ball::default(), Ball::HANDLES.rail);
    let bounce = move |event: &mut holonom::run::Event<'_, f64, Ball>| {
        event.set_displacement_rate(rail, -RESTITUTION * event.displacement_rate(rail))
    };
    let simulation = || {
        let simulation = ball.simulation(StandardLagrange, integrator);
        simulation.on("floor", Crossing::Falling, height, bounce)
    };
    // From step to step.
    let mut shown = Vec::new();
    let whole = simulation()
        .run(0.0..=END, every_step(), |sample| {
            shown.push((sample.time(), *sample.state()));
        })
        .expect("it bounces");
    let mut run = simulation().begin(0.0..=END).expect("it begins");
    let mut seen = vec![(run.time(), *run.state())];
    let mut events = 0;
    loop {
        let reached = run.advance().expect("it bounces");
        events += usize::from(reached == Reached::Event("floor"));
        seen.push((run.time(), *run.state()));
        if reached == Reached::End {
            break;
        }
    }
    assert!(events > 6, "{events}");
    assert_eq!(run.advance(), Ok(Reached::End));
    // An observer sees an event before its handler, too.
    shown.dedup_by_key(|(time, _)| *time);
    let behind = |(time, _): &(f64, StateOf<Ball>)| seen.iter().any(|(other, _)| other == time);
    assert!(shown.iter().all(behind) && seen.len() == shown.len());
    assert_eq!(run.state(), &whole.state);
    let report = run.report();
    assert_eq!(counts(&report), counts(&whole));
    assert_eq!(report.warnings(), whole.warnings());
    // From time to time.
    let mut shown = Vec::new();
    let whole = simulation()
        .run(0.0..=END, every(0.05), |sample| {
            shown.push((sample.time(), *sample.state()));
        })
        .expect("it bounces");
    let mut run = simulation().begin(0.0..=END).expect("it begins");
    for (time, state) in shown {
        if time < run.time() {
            // The state before an impact, which its handler has changed.
            continue;
        }
        while !matches!(run.advance_to(time), Ok(Reached::Time | Reached::End)) {}
        if (run.time(), height(&run.sample()) > 1e-9) == (time, true) {
            assert_eq!(run.state(), &state, "{time}");
        }
    }
    assert_eq!(run.state(), &whole.state);
    assert_eq!(counts(&run.report()), counts(&whole));
}

fn counts<M: Mechanism>(report: &RunReport<f64, M>) -> [usize; 3] {
    [report.evaluations, report.accepted, report.rejected]
}

#[test]
fn a_loop_of_ones_own_is_that_of_an_observer() {
    agrees(Rk4::every(0.01));
    agrees(DormandPrince::new(tight()));
    agrees(DormandPrince853::new(tight()));
    agrees(Adams::new(tight()));
    agrees(RadauIIA::new(tight()));
}

/// What a handler does, done by the caller at the event.
#[test]
fn a_caller_bounces_a_ball() {
    let (ball, rail) = (Ball::default(), Ball::HANDLES.rail);
    let simulation = ball.simulation(StandardLagrange, DormandPrince::new(tight()));
    let mut run = simulation
        .on("floor", Crossing::Falling, height, |_| ())
        .begin(0.0..=END)
        .expect("it begins");
    let mut speed = (2.0 * GRAVITY).sqrt();
    let mut time = speed / GRAVITY;
    let mut impacts = 0;
    loop {
        match run.advance_to(END).expect("it bounces") {
            Reached::Event("floor") => {
                assert!((run.time() - time).abs() < 1e-10, "{} {time}", run.time());
                run.change(|event| {
                    event.set_displacement_rate(rail, -RESTITUTION * event.displacement_rate(rail))
                })
                .expect("it is turned");
                speed *= RESTITUTION;
                time += 2.0 * speed / GRAVITY;
                impacts += 1;
            }
            Reached::End => break,
            other => panic!("{other:?}"),
        }
    }
    assert!(impacts > 6, "{impacts}");
    assert!(
        run.report().warnings().is_empty(),
        "{}",
        run.report().warnings()
    );
}

/// An experiment that holds its run, and acts in the middle of steps.
struct Experiment<'a> {
    run: Run<'a, Solved<Slider>, DormandPrince<f64>>,
}

#[test]
fn inputs_and_states_change_within_a_step() {
    let slider = Slider::new(0.0).expect("acceptable");
    let rail = Slider::HANDLES.rail;
    let simulation = slider.simulation(StandardLagrange, DormandPrince::new(tight()));
    let run = simulation.begin(0.0..=3.0).expect("it begins");
    let mut experiment = Experiment { run };
    let run = &mut experiment.run;
    // At rest until 0.7 s, then pushed by 2 N until 1.7 s, then thrown back at 1 m/s.
    assert_eq!(run.advance_to(0.7), Ok(Reached::Time));
    run.change(|event| event.inputs_mut().push = 2.0)
        .expect("an input");
    assert_eq!(run.advance_to(1.7), Ok(Reached::Time));
    assert!((run.sample().displacement(rail) - 1.0).abs() < 1e-12);
    assert!((run.sample().displacement_rate(rail) - 2.0).abs() < 1e-12);
    run.change(|event| event.inputs_mut().push = 0.0)
        .expect("an input");
    run.change(|event| event.set_displacement_rate(rail, -1.0))
        .expect("a state");
    assert_eq!(run.advance_to(9.0), Ok(Reached::End));
    assert!((run.sample().displacement(rail) - (1.0 - 1.3)).abs() < 1e-12);
    assert!(
        run.report().warnings().is_empty(),
        "{}",
        run.report().warnings()
    );
    // What is not acceptable leaves the state as it was.
    let refused = run.change(|event| event.set_displacement(rail, f64::NAN));
    assert!(refused.is_err() && (run.sample().displacement(rail) + 0.3).abs() < 1e-12);
    let error = run.advance_to(1.0).expect_err("it is past");
    assert!(
        matches!(error.fault, Fault::Start(StartFault::Interval { .. })),
        "{error}"
    );
}

#[test]
fn what_needs_an_observer_is_refused() {
    let ball = Ball::default();
    let simulation = || ball.simulation(StandardLagrange, Rk4::every(0.01));
    let verified = simulation().verified().begin(0.0..=1.0);
    let kept = simulation().checkpoints(3, |_| ()).begin(0.0..=1.0);
    let faults = [verified.map(drop), kept.map(drop)];
    for error in faults.map(|found| found.expect_err("nobody looks on")) {
        assert!(
            matches!(error.fault, Fault::Start(StartFault::NotLed)),
            "{error}"
        );
    }
}
