//! Points that meet, or pass close by, with a force along the line between them; contacts that are
//! stiffer than the steps.

use core::f64::consts::FRAC_PI_2;

use holonom::error::ModeFault;
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::{Reached, Run};
use holonom::{
    Adams, AdamsBashforthMoulton4, Bdf, GeneralizedAlpha, Heun, Midpoint, RadauIIA, Runs,
    SemiImplicitEuler,
};

use super::oscillators::arcs;
use super::{run, tight};

/// A bead that is drawn towards a point on its rail or beside it, with a hard ball about the point.
/// No other mechanism here has points that meet.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Drawn {
    #[param]
    pull: f64,
    #[param]
    damping: f64,
    #[param]
    beside: f64,
    #[param]
    stiffness: f64,
    #[param]
    radius: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.0, 0.0, 0.0])]
    bead: Body,
    #[joint(between = [ground, bead], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[force(
        between = [ground, bead], head = [0.0, beside, 0.0], tail = [1.0, 0.0, 0.0],
        force = stiffness * max(0.0, radius - length) - pull - damping * rate
    )]
    towards: Actuator,
}

fn drawn(pull: f64, damping: f64, beside: f64) -> Drawn {
    Drawn::new(pull, damping, beside, 0.0, 0.25).expect("acceptable")
}

/// Where the bead is after a time (s).
fn place<I, C>(mechanism: &Drawn, integrator: I, end: f64) -> f64
where
    C: Coordinates<Drawn>,
    I: Runs<Problem<Drawn, StandardLagrange, f64, C>>,
{
    let report = run::<_, _, C>(mechanism, integrator, end, every(end), |_| ());
    Drawn::pose(&report.state, Drawn::HANDLES.bead).position.x
}

#[test]
fn a_bead_that_passes_the_point_that_draws_it_is_right_after_ten_periods() {
    let (mechanism, end) = (drawn(1.0, 0.0, 0.0), 40.7 * 2.0_f64.sqrt());
    let found = [
        place::<_, Relative>(&mechanism, Rk4::every(1e-2), end),
        place::<_, Absolute>(&mechanism, Rk4::every(1e-2), end),
        place::<_, Relative>(&mechanism, Midpoint::every(1e-2), end),
        place::<_, Relative>(&mechanism, AdamsBashforthMoulton4::every(1e-2), end),
        place::<_, Absolute>(&mechanism, GeneralizedAlpha::every(1e-2), end),
        place::<_, Relative>(&mechanism, DormandPrince::default(), end),
        place::<_, Absolute>(&mechanism, Adams::default(), end),
        place::<_, Relative>(&mechanism, RadauIIA::default(), end),
    ];
    for (index, found) in found.iter().enumerate() {
        let error = (found - arcs(end)).abs();
        assert!(error < 1e-7, "{index}: off by {error:e}");
    }
}

/// A bead on a spring of 4 N/m that pulls by 2 N at length zero, where it has no direction. The
/// force of an actuator is zero there, so that a run does not feel it.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Sprung {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.0, 0.0, 0.0])]
    bead: Body,
    #[joint(between = [ground, bead], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[force(between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0], stiffness = 4.0, free_length = -0.5)]
    spring: SpringDamper,
}

/// A step on the way to the point may end within some last digits of it. It does from these starts
/// (m), with these tolerances.
#[test]
fn a_bead_passes_its_point_wherever_its_steps_end() {
    let (mechanism, h) = (Sprung::default(), Sprung::HANDLES);
    for (x, size) in [
        (0.5654867841077658_f64, 1.1634227153014196e-11),
        (0.3916159375828871, 4.4917515864495603e-8),
        (0.407377682790162, 4.267210754135403e-11),
        (0.9311510140820445, 3.610105808200529e-11),
    ] {
        let mut state = mechanism.described_state().expect("described");
        mechanism
            .set_displacement(&mut state, h.rail, x - 1.0)
            .expect("free");
        let tolerance = Tolerance {
            relative: size,
            absolute: size,
        };
        let report = mechanism
            .simulation(StandardLagrange, DormandPrince::new(tolerance))
            .initial_state(state)
            .run(0.0..=5.0, every(0.1), |_| ())
            .unwrap_or_else(|error| panic!("from {x} m: {error}"));
        let view = mechanism.view(5.0, &report.state).expect("it is one");
        let place = view.displacement(h.rail) + 1.0;
        let rate = view.displacement_rate(h.rail);
        let energy = |x: f64| 2.0 * (x + 0.5) * (x + 0.5);
        let gained = 0.5 * rate * rate + energy(place.abs()) - energy(x);
        assert!(gained.abs() < 1e-5, "from {x} m: {gained:e} J");
    }
}

/// A step that is refused, to be tried again shorter, is not shown to who leads a run.
#[test]
fn every_step_of_a_run_that_is_led_goes_on() {
    let mechanism = Sprung::default();
    let simulation = mechanism.simulation(StandardLagrange, DormandPrince::new(tight()));
    let mut run = simulation.begin(0.0..=5.0).expect("it begins");
    let mut passages = 0;
    loop {
        let (time, side) = (run.time(), is_beyond(&run));
        if run.advance().expect("it swings") == Reached::End {
            break;
        }
        assert!(run.time() > time, "{time}");
        passages += usize::from(is_beyond(&run) != side);
    }
    assert!(passages > 2, "{passages}");
}

/// Whether the bead is beyond its point.
fn is_beyond(run: &Run<'_, Problem<Sprung, StandardLagrange>, DormandPrince<f64>>) -> bool {
    run.sample().displacement(Sprung::HANDLES.rail) > -1.0
}

/// A quarter of the period (s) under a pull of 1 N towards a point that is so far (m) beside the
/// rail: the integral of `dx / v`, where `v^2 / 2` is the energy less the distance.
fn quarter(beside: f64) -> f64 {
    const PARTS: usize = 200_000;
    let widest = 1.0_f64.hypot(beside);
    let width = FRAC_PI_2 / PARTS as f64;
    let parts = (0..PARTS).map(|part| {
        // The distance from the point falls from the widest with the square of the sine.
        let sine = ((part as f64 + 0.5) * width).sin();
        let distance = widest - (widest - beside) * sine * sine;
        2.0 * distance / (2.0 * (distance + beside)).sqrt()
    });
    parts.sum::<f64>() * width
}

#[test]
fn a_point_beside_the_way_is_passed_as_well_as_one_on_it() {
    for (beside, allowed) in [(1e-12, 1e-6), (1e-9, 1e-6), (1e-6, 1e-4), (1e-3, 1e-3)] {
        let mechanism = drawn(1.0, 0.0, beside);
        // In the middle once more, after five passages.
        let end = 11.0 * quarter(beside);
        let found = [
            place::<_, Relative>(&mechanism, Rk4::every(1e-2), end),
            place::<_, Absolute>(&mechanism, Rk4::every(3e-2), end),
            place::<_, Relative>(&mechanism, DormandPrince::default(), end),
        ];
        for (index, error) in found.iter().enumerate() {
            assert!(error.abs() < allowed, "{beside:e}, {index}: {error:e}");
        }
    }
}

/// How far off a bead is after many passages, over what it swings by, and whether that was told.
fn after_many<I, C>(mechanism: &Drawn, integrator: I, (end, right): (f64, f64)) -> (f64, bool)
where
    C: Coordinates<Drawn>,
    I: Runs<Problem<Drawn, StandardLagrange, f64, C>>,
{
    let report = Simulation::new(mechanism, StandardLagrange, integrator)
        .coordinates::<C>()
        .run(0.0..=end, every(end), |_| ())
        .unwrap_or_else(|error| panic!("{error}"));
    let place = Drawn::pose(&report.state, Drawn::HANDLES.bead).position.x;
    ((place - right).abs(), !report.warnings().is_empty())
}

#[test]
fn many_passages_are_right_or_told() {
    for beside in [1e-6, 5e-3] {
        let mechanism = drawn(1.0, 0.0, beside);
        // In the middle once more, after twenty passages.
        let end = (41.0 * quarter(beside), 0.0);
        let found = [
            after_many::<_, Relative>(&mechanism, Rk4::every(1e-2), end),
            after_many::<_, Relative>(&mechanism, Midpoint::every(1e-2), end),
            after_many::<_, Relative>(&mechanism, Heun::every(1e-2), end),
            after_many::<_, Absolute>(&mechanism, GeneralizedAlpha::every(1e-2), end),
            after_many::<_, Relative>(&mechanism, DormandPrince::default(), end),
            after_many::<_, Relative>(&mechanism, Adams::default(), end),
            after_many::<_, Relative>(&mechanism, Bdf::default(), end),
            after_many::<_, Relative>(&mechanism, SemiImplicitEuler::every(1e-3), end),
        ];
        println!("{beside:e} m beside the point: {found:?}");
        for (index, (error, is_told)) in found.iter().enumerate() {
            // Warnings find what is off by a hundredth.
            assert!(
                *error < 1.2e-2 || *is_told,
                "{beside:e}, {index}: {error:e}"
            );
        }
        // What is of order 2 is not left to warnings.
        let [_, midpoint, heun, ..] = found;
        assert!(midpoint.0 < 5e-3 && heun.0 < 5e-3, "{beside:e}: {found:?}");
        // Nor what has no control and order 4.
        let of_order_4 = [
            after_many::<_, Relative>(&mechanism, Rk4::every(0.1), end),
            after_many::<_, Relative>(&mechanism, AdamsBashforthMoulton4::every(1e-2), end),
        ];
        assert!(
            of_order_4.iter().all(|(error, _)| *error < 5e-3),
            "{of_order_4:?}"
        );
    }
}

#[test]
fn what_many_passages_leave_is_told_and_no_less() {
    for beside in [1e-3, 5e-3] {
        let mechanism = drawn(1.0, 0.0, beside);
        // In the middle once more, after 52 passages.
        let end = (105.0 * quarter(beside), 0.0);
        let found = [
            after_many::<_, Relative>(&mechanism, Rk4::every(3e-2), end),
            after_many::<_, Relative>(&mechanism, AdamsBashforthMoulton4::every(3e-2), end),
            after_many::<_, Relative>(&mechanism, Adams::default(), end),
            after_many::<_, Relative>(&mechanism, DormandPrince::default(), end),
            after_many::<_, Relative>(&mechanism, Midpoint::every(1e-2), end),
        ];
        println!("{beside:e} m beside the point: {found:?}");
        for (index, (error, is_told)) in found.iter().enumerate() {
            let is_right = if *is_told {
                *error > 5e-3
            } else {
                *error < 1.2e-2
            };
            assert!(is_right, "{beside:e}, {index}: {error:e}, told: {is_told}");
        }
        let [_, adams_bashforth, adams, dormand_prince, midpoint] = found;
        assert!(adams_bashforth.1 && adams.1, "{beside:e}: {found:?}");
        assert!(!dormand_prince.1 && !midpoint.1, "{beside:e}: {found:?}");
    }
}

#[test]
fn at_length_zero_the_motion_tells_the_side() {
    let (mechanism, h) = (drawn(5.0, 0.0, 0.0), Drawn::HANDLES);
    // In the last ones a stage is at zero.
    for (x, speed) in [(0.0, 1.0), (0.0, -1.0), (-0.05, 10.0), (-0.1, 10.0)] {
        let mut start = mechanism.described_state().expect("acceptable");
        let mut pose = Drawn::pose(&start, h.bead);
        pose.position.x = x;
        Drawn::set_pose(&mut start, h.bead, pose);
        Drawn::set_velocity(&mut start, h.bead, [speed, 0.0, 0.0].into());
        let report = mechanism
            .simulation(StandardLagrange, Rk4::every(1e-2))
            .initial_state(start)
            .run(0.0..=0.1, every(0.1), |_| ())
            .unwrap_or_else(|error| panic!("from {x}: {error}"));
        let place = Drawn::pose(&report.state, h.bead).position.x;
        let rate = Drawn::velocity(&report.state, h.bead).x;
        let energy = |x: f64, v: f64| 0.5 * v * v + 5.0 * f64::abs(x);
        assert!((energy(place, rate) - energy(x, speed)).abs() < 1e-9);
    }
    // A damper leaves it less and less to swing.
    let fault = drawn(1.0, 20.0, 0.0)
        .simulation(StandardLagrange, Rk4::every(5e-2))
        .run(0.0..=30.0, every(1.0), |_| ())
        .expect_err("it is held")
        .fault;
    let Fault::Mode(ModeFault::SlidingLaw {
        law, expression, ..
    }) = fault
    else {
        panic!("{fault}");
    };
    assert_eq!((law, expression), ("towards", "length"));
}

/// What is off by how much of 5 J, and what was said, under a pull of 10 N on a hard ball.
fn bounces<I>(stiffness: f64, integrator: I, dt: f64) -> (f64, String)
where
    I: Runs<Problem<Drawn, StandardLagrange, f64, Relative>>,
{
    let mechanism = Drawn::new(10.0, 0.0, 0.0, stiffness, 0.5).expect("acceptable");
    let mut worst = 0.0_f64;
    let outcome = Simulation::new(&mechanism, StandardLagrange, integrator)
        .joint_coordinates()
        .run(0.0..=3.0, every(dt), |sample| {
            let (x, v) = (
                sample.pose(Drawn::HANDLES.bead).position.x,
                sample.velocity(Drawn::HANDLES.bead).x,
            );
            let pressed = (0.5 - x).max(0.0);
            let energy = 0.5 * v * v + 10.0 * x + 0.5 * stiffness * pressed * pressed;
            worst = worst.max((energy - 10.0).abs() / 5.0);
        });
    let said = match outcome {
        Ok(report) => report.warnings().to_string(),
        Err(error) => error.to_string(),
    };
    (worst, said)
}

#[test]
fn a_hard_contact_by_a_continuous_law_does_not_slide() {
    assert!(Drawn::SWITCHES.iter().all(|switch| switch.is_continuous));
    for stiffness in [1e5, 1e9, 1e11, 1e13, 1e15] {
        let (worst, said) = bounces(stiffness, DormandPrince::default(), 0.05);
        assert!(worst < 1e-2, "{stiffness:e}: {worst:e}; {said}");
        assert!(said == "no warnings", "{stiffness:e}: {said}");
    }
    // Where a step of a millisecond does not resolve the contact, it is said.
    for (stiffness, dt) in [(1e9, 0.05), (1e11, 0.05), (1e11, 0.007), (1e13, 0.3)] {
        for (worst, said) in [
            bounces(stiffness, Midpoint::every(1e-3), dt),
            bounces(stiffness, Heun::every(1e-3), dt),
            bounces(stiffness, Rk4::every(1e-3), dt),
        ] {
            assert!(
                said != "no warnings",
                "{stiffness:e}, {dt}: off by {worst:e}"
            );
        }
    }
}
