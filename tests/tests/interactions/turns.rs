//! Limits, events and readings of an angle over many turns. The motor turns by `2 t^2`.

use core::cell::{Cell, RefCell};
use core::f64::consts::{PI, TAU};

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;

use super::{Gearbox, Rod, tight};

fn motor() -> Gearbox {
    Gearbox {
        torque: 0.08,
        ..Gearbox::default()
    }
}

fn start(angle: f64, rate: f64) -> StateOf<Gearbox> {
    let (gearbox, shaft) = (motor(), Gearbox::HANDLES.input_shaft);
    let mut state = gearbox.described_state().expect("it is described");
    gearbox
        .set_angle(&mut state, shaft, angle)
        .expect("it is free");
    gearbox
        .set_angle_rate(&mut state, shaft, rate)
        .expect("it is free");
    state
}

/// When a run from a state first strikes one of the limits (s), and its last state.
fn struck<C: Coordinates<Gearbox>>(
    state: StateOf<Gearbox>,
    limits: [f64; 2],
    [from, to]: [f64; 2],
) -> (Option<f64>, StateOf<Gearbox>) {
    let (gearbox, shaft) = (motor(), Gearbox::HANDLES.input_shaft);
    let first = Cell::new(None);
    let report = Simulation::new(&gearbox, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(state)
        .interactions([Interaction::limits(shaft.angle(), limits)])
        .run(from..=to, every(0.3), |sample| {
            let impact = sample
                .impact(shaft.angle().limits())
                .expect("one interaction");
            first.set(first.get().or(impact.map(|impact| impact.time)));
        })
        .expect("it turns");
    (first.get(), report.state)
}

fn stops<C: Coordinates<Gearbox>>() {
    let at = |angle: f64| (0.5 * angle).sqrt();
    let near = |found: Option<f64>, wanted: f64| {
        let found = found.expect("it strikes");
        assert!((found - wanted).abs() < 1e-8, "{found} for {wanted}");
    };
    // Beyond half a turn from the middle of the limits, at the end and at the start.
    let (found, _) = struck::<C>(start(0.0, 0.0), [-1.0, 14.0], [0.0, 3.0]);
    near(found, at(14.0));
    let (found, _) = struck::<C>(start(9.0, 0.0), [-10.0, 10.0], [0.0, 3.0]);
    near(found, at(1.0));
    let (found, _) = struck::<C>(start(-30.0, 0.0), [-40.0, 10.0], [0.0, 6.0]);
    near(found, at(40.0));
    // From the end of another run, a turn and a half on.
    let (found, state) = struck::<C>(start(0.0, 0.0), [-20.0, 20.0], [0.0, 2.1]);
    assert_eq!(found, None);
    let (found, _) = struck::<C>(state, [-20.0, 20.0], [2.1, 4.0]);
    near(found, at(20.0));
}

#[test]
fn a_stop_is_where_it_was_said_however_many_turns_away() {
    stops::<Relative>();
    stops::<Absolute>();
}

#[test]
fn a_stepper_stops_there_too() -> Result<(), Fault> {
    let (gearbox, shaft) = (motor(), Gearbox::HANDLES.input_shaft);
    for dt in [0.01, 0.37] {
        let mut stepper = gearbox
            .stepper(StandardLagrange, Rk4)?
            .joint_coordinates()
            .interactions([Interaction::limits(shaft.angle(), [-10.0, 30.0])]);
        let mut state = stepper.state_of(&start(9.0, 0.0))?;
        while stepper.time() < 4.0 {
            stepper.step(&mut state, dt)?;
        }
        let bodies = stepper.bodies(&state);
        let angle = stepper.view(&bodies).angle(shaft);
        assert!((angle - 30.0).abs() < 1e-9, "{angle}");
    }
    Ok(())
}

/// Times of events, and readings at any time.
fn fires<C: Coordinates<Gearbox>>() {
    let (gearbox, shaft) = (motor(), Gearbox::HANDLES.input_shaft);
    let times = RefCell::new([(); 3].map(|()| Vec::new()));
    let note = |number: usize, time: f64| times.borrow_mut()[number].push(time);
    // Backwards over two turns, and on over five.
    let wanted = |time: f64| (2.0 * time - 20.0) * time + 20.0;
    Simulation::new(&gearbox, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start(20.0, -20.0))
        .on(
            "one",
            Crossing::Either,
            |s| s.angle(shaft) - 1.0,
            |e| note(0, e.time()),
        )
        .on(
            "turn",
            Crossing::Rising,
            |s| s.angle(shaft) - TAU,
            |e| note(1, e.time()),
        )
        .on(
            "wrap",
            Crossing::Either,
            |s| s.angle(shaft) + PI,
            |e| note(2, e.time()),
        )
        .run(0.0..=10.0, every(0.7), |sample| {
            let (angle, time) = (sample.angle(shaft), sample.time());
            assert!((angle - wanted(time)).abs() < 1e-6, "{angle} at {time}");
            let within = sample.wrapped_angle(shaft);
            assert!(
                within.abs() <= PI && ((angle - within) / TAU).fract().abs() < 1e-9
                    || (((angle - within) / TAU).fract().abs() - 1.0).abs() < 1e-9
            );
        })
        .expect("it turns");
    let passes = |angle: f64| {
        let root = (100.0 - 2.0 * (20.0 - angle)).sqrt();
        [(10.0 - root) / 2.0, (10.0 + root) / 2.0]
    };
    let [one, turn, wrap] = times.into_inner();
    for (found, wanted) in [
        (one, passes(1.0).to_vec()),
        (turn, passes(TAU)[1..].to_vec()),
        (wrap, passes(-PI).to_vec()),
    ] {
        assert_eq!(found.len(), wanted.len(), "{found:?} for {wanted:?}");
        let off = found.iter().zip(&wanted).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-8, "{found:?} for {wanted:?}");
    }
}

#[test]
fn an_event_of_an_angle_is_where_it_passes_and_not_where_it_wraps() {
    fires::<Relative>();
    fires::<Absolute>();
}

#[test]
fn a_rod_falls_onto_the_near_one_of_limits_far_apart() {
    let (rod, hinge) = (Rod::default(), Rod::HANDLES.hinge);
    let mut lowest = 0.0_f64;
    rod.simulation(StandardLagrange, DormandPrince::default())
        .interactions([Interaction::limits(hinge.angle(), [-1.0, 9.0])])
        .run(0.0..=3.0, every(0.01), |sample| {
            lowest = lowest.min(sample.angle(hinge));
        })
        .expect("it falls");
    assert!((lowest + 1.0).abs() < 1e-9, "{lowest}");
}

#[test]
fn a_law_reads_the_angle_that_was_counted_within_a_step() {
    // The rate is 100 t^3: half of what it is at the end of the first step is four turns too many.
    let (gearbox, shaft) = (Gearbox::default(), Gearbox::HANDLES.input_shaft);
    let read = Cell::new(0.0);
    let turned = |time: f64| 25.0 * time.powi(4);
    Simulation::new(&gearbox, StandardLagrange, Rk4::every(1.0))
        .joint_coordinates()
        .forces(|time, _, loads| {
            if time == 1.0 {
                // The last time at the start of the second step.
                read.set(loads.view().angle(shaft));
            }
            loads.moment_between(shaft, 0.02 * 300.0 * time * time);
        })
        .run(0.0..=2.0, every_step(), |sample| {
            let (angle, time) = (sample.angle(shaft), sample.time());
            assert!((angle - turned(time)).abs() < 1e-9, "{angle} at {time}");
        })
        .expect("it turns");
    assert!((read.get() - turned(1.0)).abs() < 1e-9, "{}", read.get());
}
