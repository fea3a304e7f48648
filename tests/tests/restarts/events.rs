//! Events, controllers and handlers in a run that goes on.

use std::cell::{Cell, RefCell};

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::Checkpoint;
use holonom::{AdamsBashforthMoulton4, Bdf, DormandPrince853, Runs};
use serde_json::{from_str, to_string};

use super::{Flap, Shown, flap};

/// What the controller remembers.
#[derive(Clone, Copy, Default)]
struct Controller {
    integral: f64,
    calls: usize,
}

/// A checkpoint, what the controller remembered, how often the observer had been called and how
/// often the condition had been met.
type Kept = (Checkpoint<Flap>, Controller, usize, usize);

/// A run and all its checkpoints. Its controller remembers, and sets the input by the one before.
/// The handler of its condition gives the flap a push and, every second time, another spring.
fn run<I, C>(
    method: I,
    from: Option<&Kept>,
    end: f64,
) -> (RunReport<f64, Flap>, Shown<Flap>, usize, Vec<Kept>)
where
    C: Coordinates<Flap>,
    I: Runs<Problem<Flap, StandardLagrange, f64, C>>,
{
    let (flap, h) = (flap(), Flap::HANDLES);
    let memory = Cell::new(from.map_or(Controller::default(), |kept| kept.1));
    let met = Cell::new(from.map_or(0, |kept| kept.3));
    let shown = RefCell::new(Shown::<Flap>::new());
    let before = from.map_or(0, |kept| kept.2);
    let mut kept = Vec::new();
    let mut simulation = Simulation::new(&flap, StandardLagrange, method)
        .projection(Projection::default())
        .coordinates::<C>()
        .every_period(0.05, |sample, inputs| {
            let mut now = memory.get();
            now.integral += 0.5 - sample.angle(h.hinge);
            now.calls += 1;
            inputs.torque = 0.9 * inputs.torque + 0.1 * now.integral;
            memory.set(now);
        })
        .on(
            "a sixth of a turn of the flap",
            Crossing::Either,
            |sample| (3.0 * sample.angle(h.pin)).sin(),
            |event| {
                met.set(met.get() + 1);
                event.set_angle_rate(h.pin, 0.95 * event.angle_rate(h.pin))?;
                if usize::is_multiple_of(met.get(), 2) {
                    let mut other = Flap::new(0.9)?;
                    other.torque = event.inputs_mut().torque;
                    event.update(&other)?;
                }
                Ok::<(), Fault>(())
            },
        )
        .checkpoints(1, |checkpoint| {
            let shown = before + shown.borrow().len();
            kept.push((checkpoint.clone(), memory.get(), shown, met.get()));
        });
    let observe = |sample: &Sample<'_, f64, Flap>| {
        let mut shown = shown.borrow_mut();
        shown.push((sample.time(), *sample.state()));
    };
    let report = match from {
        None => simulation.run(0.0..=end, every(0.03), observe),
        Some((checkpoint, ..)) => simulation.resume(checkpoint, observe),
    };
    let report = report.expect("it runs");
    (report, shown.into_inner(), met.get(), kept)
}

fn goes_on<I, C>(what: &str, method: I)
where
    C: Coordinates<Flap>,
    I: Runs<Problem<Flap, StandardLagrange, f64, C>>,
{
    let (report, shown, met, kept) = run::<I, C>(method, None, 2.0);
    assert!(met > 3, "{what}: {met}");
    let last = kept.len() - 1;
    for place in [0, 1, last / 5, last / 3, last / 2, 2 * last / 3, last - 1] {
        let from = &kept[place];
        let (resumed, tail, again, rest) = run::<I, C>(method, Some(from), 2.0);
        assert_eq!(again, met, "{what} {place}");
        assert_eq!(resumed, report, "{what} {place} of {last}");
        assert!(tail == shown[from.2..], "{what} {place}");
        // The checkpoints are those of the whole run, too.
        assert_eq!(rest.len(), last - place, "{what} {place}");
        assert!(rest[..] == kept[place + 1..], "{what} {place}");

        let text = to_string(&from.0).expect("finite");
        let read = (
            from_str(&text).expect("that of this mechanism"),
            from.1,
            from.2,
            from.3,
        );
        let (of_file, tail_of_file, ..) = run::<I, C>(method, Some(&read), 2.0);
        assert!(tail_of_file == tail, "{what} {place}: from a file");
        assert_eq!(of_file.evaluations, report.evaluations, "{what} {place}");
    }
}

impl PartialEq for Controller {
    fn eq(&self, other: &Self) -> bool {
        self.integral.to_bits() == other.integral.to_bits() && self.calls == other.calls
    }
}

#[test]
fn events_and_controllers_go_on() {
    goes_on::<_, Relative>("Rk4", Rk4::every(0.011));
    goes_on::<_, Absolute>("Rk4", Rk4::every(0.011));
    goes_on::<_, Relative>("Dormand-Prince", DormandPrince::default());
    goes_on::<_, Absolute>("Dormand-Prince 8", DormandPrince853::default());
    goes_on::<_, Relative>("Adams", AdamsBashforthMoulton4::every(0.004));
    goes_on::<_, Relative>("BDF", Bdf::default());
}

/// The last checkpoint of a run with another end is that from which a longer run goes on.
#[test]
fn a_run_goes_on_for_longer_than_was_planned() {
    let method = Rk4::every(0.01);
    let (.., kept) = run::<_, Relative>(method, None, 1.0);
    let (whole, shown, met, _) = run::<_, Relative>(method, None, 2.0);
    // The end lies at an instant of the controller, where integrations begin anew.
    let (checkpoint, memory, at, times) = kept.last().expect("that of the end").clone();
    assert_eq!(checkpoint.time(), 1.0);
    let longer = (checkpoint.until(2.0), memory, at, times);
    let (resumed, tail, again, _) = run::<_, Relative>(method, Some(&longer), 2.0);
    assert_eq!(again, met);
    assert_eq!(resumed.state, whole.state);
    assert!(tail.len() > 20 && shown.ends_with(&tail));
}

/// What stops a run by its checkpoint loses nothing, and what else stops it a step.
#[test]
fn a_run_stops_at_a_checkpoint() {
    let flap = flap();
    let build = || flap.simulation(StandardLagrange, DormandPrince::default());
    let whole = build().run(0.0..=1.0, every(0.1), |_| ()).expect("it runs");
    let mut last = None;
    let stopped = build()
        .checkpoints(7, |checkpoint| {
            last = Some(checkpoint.clone());
            ControlFlow::Break(())
        })
        .run(0.0..=1.0, every(0.1), |_| ())
        .expect("it runs");
    assert!(stopped.stopped && stopped.accepted == 7);
    let last = last.expect("one");
    assert_eq!(stopped.time, last.time());
    assert_eq!(build().resume(&last, |_| ()).expect("it goes on"), whole);
}

/// A pendulum on a slide that is driven from outside.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Driven {
    #[input(order = 2)]
    target: Setpoint,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    slide: Body,
    #[body(mass = 1.0, inertia = [0.083, 0.083, 0.001], position = [0.0, 0.0, -0.5])]
    rod: Body,
    #[joint(between = [ground, slide], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[joint(
        between = [ground, slide], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0], motion = target
    )]
    drive: DisplacementDriver,
    #[joint(between = [slide, rod], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    hinge: Revolute,
}

/// A target moves at 0.1 m/s^2 from rest. Value, rate and acceleration are held for a millisecond.
fn target(time: f64) -> Setpoint {
    Setpoint {
        value: 0.05 * time * time,
        rate: 0.1 * time,
        acceleration: 0.1,
    }
}

#[test]
fn inputs_with_derivatives_go_on() {
    let driven = Driven::default();
    let build = || {
        driven
            .simulation(StandardLagrange, Rk4::every(1e-3))
            .joint_coordinates()
            .every_period(1e-3, |sample, inputs| inputs.target = target(sample.time()))
    };
    let mut kept = None;
    let whole = build()
        .checkpoints(501, |checkpoint| {
            kept = kept.take().or(Some(checkpoint.clone()))
        })
        .run(0.0..=1.0, every(0.25), |_| ())
        .expect("it runs");
    let kept = kept.expect("one");
    let resumed = build().resume(&kept, |_| ()).expect("it goes on");
    assert_eq!(resumed.state, whole.state);
    // The slide drags the rod behind: about 0.1 / 9.81 rad.
    let view = driven.view(1.0, &whole.state).expect("sound parameters");
    let angle = view.angle(Driven::HANDLES.hinge);
    assert!(angle.abs() > 1e-4, "{angle}");
}
