//! Limits, dry friction, clutches and dogs in a run that goes on.

use std::cell::{Cell, RefCell};

use holonom::error::Fault as RunFault;
use holonom::measure::{Interacting, NoForces};
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::{Checkpoint, Impact, InteractionMode, Plane};
use holonom::{Adams, AdamsBashforthMoulton4, Bdf, DormandPrince853, RadauIIA, Runs};
use holonom_tests::is_exhaustive;
use serde_json::{from_str, to_string};

/// A motor with its current, a drum on a bearing that rubs, and a hammer on the drum that swings
/// between two stops. A ball falls beside them.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Mill {
    #[input]
    voltage: f64,
    #[state(rate = (voltage - 2.0 * current - 0.5 * shaft.rate) / 0.05, start = 0.1)]
    current: f64,
    #[body(mass = 1.0, inertia = [2e-3, 2e-3, 2e-3])]
    rotor: Body,
    #[joint(between = [ground, rotor], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shaft: Revolute,
    #[force(between = [ground, rotor], axis = [1.0, 0.0, 0.0], moment = 0.5 * current)]
    motor: TorsionalActuator,
    #[body(mass = 2.0, inertia = [0.02, 0.02, 0.02])]
    drum: Body,
    #[joint(between = [ground, drum], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    bearing: Revolute,
    #[body(mass = 0.3, inertia = [2e-3, 1e-4, 2e-3], position = [0.0, 0.3, 0.0])]
    hammer: Body,
    #[joint(
        between = [drum, hammer], point = [0.0, 0.2, 0.0], axis = [1.0, 0.0, 0.0],
        limits = [-0.6, 0.4], restitution = 0.6
    )]
    pin: Revolute,
    #[body(mass = 0.1, inertia = [1e-4, 1e-4, 1e-4], position = [0.0, 2.0, 0.3])]
    ball: Body,
    #[joint(between = [ground, ball], point = [0.0, 2.0, 0.0], axis = [0.0, 0.0, 1.0])]
    rail: Prismatic,
}

const INTERACTIONS: usize = 6;

/// Those and the stops of the description, whose place the first of them takes.
const ALL: usize = INTERACTIONS + 1;

/// The end (s) of a short run.
const SHORT: f64 = 0.3;

type Forces = Interacting<f64, Mill, NoForces, ALL>;

/// What an observer was shown of all interactions.
type Told = [(InteractionMode, f64, Option<Impact<f64>>); INTERACTIONS];

/// What it was shown.
type Shown = Vec<(f64, StateOf<Mill>, Told)>;

/// A checkpoint, what the controller remembered and how often the observer had been called.
type Kept = (Checkpoint<Mill>, f64, usize);

/// Friction by the load of the pin asks for that at every evaluation, so in short runs alone.
fn interactions(mill: &Mill, is_short: bool) -> [Interaction<f64, Mill>; INTERACTIONS] {
    let h = Mill::HANDLES;
    let [stops] = mill.limits();
    [
        stops,
        Interaction::clutch(h.shaft.angle(), h.bearing.angle(), 2.0, 0.8).released(),
        Interaction::friction(h.bearing.angle(), 0.05)
            .stiction(0.08)
            .stribeck(0.5),
        Interaction::contact(h.ball, Plane::on_ground([0.0; 3], [0.0, 0.0, 1.0])).restitution(0.7),
        Interaction::brake(h.shaft.angle(), f64::INFINITY).released(),
        if is_short {
            Interaction::friction_by_load(h.pin, 0.3).radius(0.01)
        } else {
            Interaction::friction(h.pin.angle(), 0.005)
        },
    ]
}

/// A run with a controller, a handler that engages the clutch, one that lets it go, a dog that
/// holds the shaft, and one that gives the hammer a push.
fn run<I, C>(method: I, from: Option<&Kept>, end: f64) -> (RunReport<f64, Mill>, Shown, Vec<Kept>)
where
    C: Coordinates<Mill>,
    I: Runs<Problem<Mill, StandardLagrange, f64, C, Forces>>,
{
    let (mill, h) = (Mill::default(), Mill::HANDLES);
    let interactions = interactions(&mill, end <= SHORT);
    let handles = Interaction::handles(&interactions);
    let [_, clutch, _, _, dog, _] = handles;
    let memory = Cell::new(from.map_or(0.0, |kept| kept.1));
    let shown = RefCell::new(Shown::new());
    let before = from.map_or(0, |kept| kept.2);
    let mut kept = Vec::new();
    let mut simulation = Simulation::new(&mill, StandardLagrange, method)
        .coordinates::<C>()
        .interactions(interactions)
        .every_period(0.05, |sample, inputs| {
            memory.set(0.8 * memory.get() + 0.5 * (20.0 - sample.angle_rate(h.shaft)));
            inputs.voltage = memory.get();
        })
        .on(
            "engage",
            Crossing::Rising,
            |sample| sample.angle_rate(h.shaft) - 8.0,
            |event| event.engage(clutch),
        )
        .on(
            "let go",
            Crossing::Rising,
            |sample| sample.time() - 0.8,
            |event| {
                event.release(clutch)?;
                event.engage(dog)
            },
        )
        .on(
            "push",
            Crossing::Rising,
            |sample| sample.time() - 1.1,
            |event| event.set_angle_rate(h.pin, 3.0),
        )
        .checkpoints(1, |checkpoint| {
            let shown = before + shown.borrow().len();
            kept.push((checkpoint.clone(), memory.get(), shown));
        });
    let observe = |sample: &Sample<'_, f64, Mill>| -> Result<(), RunFault> {
        let mut told = [(InteractionMode::Free, 0.0, None); INTERACTIONS];
        for (of, told) in handles.into_iter().zip(&mut told) {
            *told = (sample.mode(of)?, sample.effort(of)?, sample.impact(of)?);
        }
        shown
            .borrow_mut()
            .push((sample.time(), *sample.state(), told));
        Ok(())
    };
    let report = match from {
        None => simulation.run(0.0..=end, every(0.03), observe),
        Some((checkpoint, ..)) => simulation.resume(checkpoint, observe),
    };
    let report = report.expect("it runs");
    (report, shown.into_inner(), kept)
}

/// All kinds of modes and impacts are met, so that all of them are kept.
fn meets_everything(what: &str, shown: &Shown) {
    for mode in [
        InteractionMode::Free,
        InteractionMode::AtLower,
        InteractionMode::Sticking,
        InteractionMode::SlidingUp,
        InteractionMode::SlidingDown,
        InteractionMode::Released,
    ] {
        let mut all = shown.iter().flat_map(|(.., told)| told);
        assert!(all.any(|told| told.0 == mode), "{what}: {mode:?}");
    }
    for number in [0, 3, 4] {
        let met = shown.iter().any(|(.., told)| told[number].2.is_some());
        assert!(met, "{what}: no impact of {number}");
    }
}

fn goes_on<I, C>(what: &str, method: I)
where
    C: Coordinates<Mill>,
    I: Runs<Problem<Mill, StandardLagrange, f64, C, Forces>> + Copy,
{
    goes_on_until::<I, C>(what, method, 1.5);
}

fn goes_on_until<I, C>(what: &str, method: I, end: f64)
where
    C: Coordinates<Mill>,
    I: Runs<Problem<Mill, StandardLagrange, f64, C, Forces>> + Copy,
{
    let (report, shown, kept) = run::<I, C>(method, None, end);
    if end > 1.0 {
        meets_everything(what, &shown);
    }
    let last = kept.len() - 1;
    let places: Vec<usize> = if is_exhaustive() {
        (0..last).collect()
    } else {
        vec![1, last / 2, last - 1]
    };
    for place in places {
        let from = &kept[place];
        let (resumed, tail, rest) = run::<I, C>(method, Some(from), end);
        assert_eq!(resumed, report, "{what} {place} of {last}");
        assert!(tail == shown[from.2..], "{what} {place} of {last}");
        // The checkpoints are those of the whole run, too.
        assert!(rest[..] == kept[place + 1..], "{what} {place} of {last}");

        if !is_exhaustive() && place != last / 2 {
            continue;
        }
        let text = to_string(&from.0).expect("finite");
        let read = from_str(&text).expect("that of this mechanism");
        let read = (read, from.1, from.2);
        let (of_file, tail_of_file, _) = run::<I, C>(method, Some(&read), end);
        assert!(tail_of_file == tail, "{what} {place}: from a file");
        assert_eq!(of_file.evaluations, report.evaluations, "{what} {place}");
    }
}

#[test]
fn fixed_steps_go_on() {
    goes_on::<_, Relative>("Rk4", Rk4::every(0.004));
    goes_on::<_, Absolute>("Rk4", Rk4::every(0.004));
    goes_on::<_, Relative>("Adams", AdamsBashforthMoulton4::every(0.002));
    goes_on_until::<_, Relative>("Rk4 by load", Rk4::every(0.004), SHORT);
    goes_on_until::<_, Absolute>("Rk4 by load", Rk4::every(0.004), SHORT);
}

#[test]
fn controlled_steps_go_on() {
    goes_on::<_, Relative>("Dormand-Prince", DormandPrince::default());
    goes_on::<_, Absolute>("Dormand-Prince 8", DormandPrince853::default());
    goes_on_until::<_, Relative>("Dormand-Prince by load", DormandPrince::default(), SHORT);
}

#[test]
fn methods_with_a_memory_go_on() {
    goes_on::<_, Relative>("ode113", Adams::default());
    goes_on_until::<_, Relative>("BDF", Bdf::default(), 0.6);
    // Each look into a step of Radau is a step of its own.
    goes_on_until::<_, Absolute>("Radau", RadauIIA::default(), 0.31);
}

/// A clutch that closes with its input, the time and a reading, of which nothing is remembered.
fn scaled_goes_on<C: Coordinates<Mill>>(
    from: Option<&Checkpoint<Mill>>,
) -> (RunReport<f64, Mill>, Shown, Vec<Checkpoint<Mill>>) {
    let (mill, h) = (Mill::default(), Mill::HANDLES);
    let interactions = interactions(&mill, true);
    let handles = Interaction::handles(&interactions);
    let [_, clutch, bearing, .., pin] = handles;
    let (mut shown, mut kept) = (Shown::new(), Vec::new());
    let mut simulation = Simulation::new(&mill, StandardLagrange, DormandPrince::default())
        .coordinates::<C>()
        .interactions(interactions)
        .capacity_factor(clutch, |view, inputs| {
            inputs.voltage / 20.0 * (5.0 - 20.0 * view.time()).clamp(0.1, 4.0)
        })
        .capacity_factor(bearing, |view, _| 1.0 + 0.5 * view.angle(h.shaft).sin())
        .capacity_factor(pin, |view, _| 1.0 + view.angle_rate(h.pin).abs().min(1.0))
        .every_period(0.05, |sample, inputs| {
            inputs.voltage = 20.0 - 10.0 * sample.time()
        })
        .on(
            "engage",
            Crossing::Rising,
            |sample| sample.time() - 0.06,
            |event| event.engage(clutch),
        )
        .checkpoints(1, |checkpoint| kept.push(checkpoint.clone()));
    let observe = |sample: &Sample<'_, f64, Mill>| -> Result<(), RunFault> {
        let mut told = [(InteractionMode::Free, 0.0, None); INTERACTIONS];
        for (of, told) in handles.into_iter().zip(&mut told) {
            *told = (sample.mode(of)?, sample.effort(of)?, sample.impact(of)?);
        }
        assert!(sample.power().is_finite());
        shown.push((sample.time(), *sample.state(), told));
        Ok(())
    };
    let report = match from {
        None => simulation.run(0.0..=SHORT, every(0.03), observe),
        Some(checkpoint) => simulation.resume(checkpoint, observe),
    };
    let report = report.expect("it runs");
    (report, shown, kept)
}

fn scaled_capacities_go_on<C: Coordinates<Mill>>() {
    let (report, shown, kept) = scaled_goes_on::<C>(None);
    let modes = shown.iter().map(|(.., told)| told[1].0);
    let modes: Vec<InteractionMode> = modes.collect();
    for mode in [
        InteractionMode::Released,
        InteractionMode::SlidingUp,
        InteractionMode::Sticking,
    ] {
        assert!(modes.contains(&mode), "{mode:?}");
    }
    let last = kept.len() - 1;
    for place in [1, last / 2, last - 1] {
        let (resumed, tail, rest) = scaled_goes_on::<C>(Some(&kept[place]));
        assert_eq!(resumed, report, "{place} of {last}");
        assert!(shown.ends_with(&tail) && rest[..] == kept[place + 1..]);
    }
}

#[test]
fn scaled_capacities_go_on_to_the_last_bit() {
    scaled_capacities_go_on::<Relative>();
    scaled_capacities_go_on::<Absolute>();
}

/// Nothing is changed by checkpoints, nor by what is read of a run: its checkpoints are the same.
#[test]
fn checkpoints_and_readings_change_nothing() {
    let mill = Mill::default();
    let interactions = interactions(&mill, false);
    let handles = Interaction::handles(&interactions);
    let [_, clutch, ..] = handles;
    let simulation = || {
        mill.simulation(StandardLagrange, DormandPrince::default())
            .interactions(interactions)
            .on(
                "engage",
                Crossing::Rising,
                |s| s.time() - 0.1,
                move |event| event.engage(clutch),
            )
    };
    let kept = |is_read: bool| {
        let mut kept = Vec::new();
        let report = simulation()
            .checkpoints(1, |checkpoint| kept.push(checkpoint.clone()))
            .run(0.0..=1.0, every(0.1), |sample| {
                let read = handles.into_iter().filter(|_| is_read);
                assert!(
                    read.map(|of| sample.effort(of))
                        .all(|effort| effort.is_ok())
                );
            });
        (report.expect("it runs").state, kept)
    };
    let run = simulation().run(0.0..=1.0, every(0.1), |_| ());
    let (plain, quiet) = (run.expect("it runs").state, kept(false));
    assert_eq!(plain, quiet.0);
    assert!(quiet.1.len() > 10);
    assert!(quiet == kept(true));
}

/// The last checkpoint of a run with another end is that from which a longer run goes on.
#[test]
fn a_run_goes_on_for_longer_than_was_planned() {
    let method = Rk4::every(0.005);
    let (.., kept) = run::<_, Relative>(method, None, 0.5);
    let (whole, shown, _) = run::<_, Relative>(method, None, 1.5);
    let (checkpoint, memory, at) = kept.last().expect("that of the end").clone();
    let longer = (checkpoint.until(1.5), memory, at);
    let (resumed, tail, _) = run::<_, Relative>(method, Some(&longer), 1.5);
    assert_eq!(resumed.state, whole.state);
    assert!(tail.len() > 20 && shown.ends_with(&tail));
}

/// Other interactions are another run, and a damaged mode is refused.
#[test]
fn runs_with_other_interactions_are_refused() {
    let mill = Mill::default();
    let method = Rk4::every(0.01);
    let simulation = || mill.simulation(StandardLagrange, method);
    let mut kept = None;
    simulation()
        .checkpoints(10, |checkpoint| {
            kept = Some(checkpoint.clone());
            ControlFlow::Break(())
        })
        .run(0.0..=1.0, every(0.1), |_| ())
        .expect("it runs");
    let kept = kept.expect("one");
    let wanted = "the checkpoint is of a run with other events, controllers or interactions; give the same ones, in the same order";
    let refused = |run: RunResult<f64, Mill>| {
        let fault = run.expect_err("another run").fault.to_string();
        assert_eq!(fault, wanted);
    };
    let [stops] = mill.limits();
    assert!(simulation().resume(&kept, |_| ()).is_ok());
    refused(simulation().without_limits().resume(&kept, |_| ()));
    for other in [
        [stops.restitution(0.5)],
        [Interaction::limits(Mill::HANDLES.pin.angle(), [-0.6, 0.41]).restitution(0.6)],
        [Interaction::friction(Mill::HANDLES.pin.angle(), 1.0)],
    ] {
        refused(simulation().interactions(other).resume(&kept, |_| ()));
    }
    let friction = Interaction::friction(Mill::HANDLES.shaft.angle(), 1.0);
    refused(
        simulation()
            .interactions([stops, friction])
            .resume(&kept, |_| ()),
    );
}
