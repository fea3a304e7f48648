//! Checkpoints that are refused, word for word.

use holonom::mechanism::Coordinates;
use holonom::prelude::*;
use holonom::run::Checkpoint;
use holonom::{Runs, measure::NamedState};
use serde_json::{Value, from_str, from_value, json, to_string, to_value};

use super::{Flap, flap};

/// The same fields in another order.
mod reordered {
    use holonom::prelude::*;

    #[derive(Mechanism)]
    #[mechanism(gravity = [0.0, 0.0, -9.81])]
    pub(super) struct Rod {
        #[body(mass = 1.0, free)]
        ball: Particle,
        #[body(mass = 1.0, inertia = [0.1, 0.01, 0.1], position = [0.0, 0.5, 0.0])]
        rod: Body,
        #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
        hinge: Revolute,
    }
}

/// Another mass.
mod heavier {
    use holonom::prelude::*;

    #[derive(Mechanism)]
    #[mechanism(gravity = [0.0, 0.0, -9.81])]
    pub(super) struct Rod {
        #[body(mass = 1.1, inertia = [0.1, 0.01, 0.1], position = [0.0, 0.5, 0.0])]
        rod: Body,
        #[body(mass = 1.0, free)]
        ball: Particle,
        #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
        hinge: Revolute,
    }
}

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Rod {
    #[body(mass = 1.3, inertia = [0.1, 0.01, 0.1], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[body(mass = 1.0, free)]
    ball: Particle,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

fn of<M: Mechanism, I, C>(mechanism: &M, method: I) -> Checkpoint<M>
where
    C: Coordinates<M>,
    I: Runs<Problem<M, StandardLagrange, f64, C>>,
{
    let mut last = None;
    Simulation::new(mechanism, StandardLagrange, method)
        .coordinates::<C>()
        .checkpoints(3, |checkpoint| {
            last = Some(checkpoint.clone());
            ControlFlow::Break(())
        })
        .run(0.0..=1.0, every(0.1), |_| ())
        .expect("it runs");
    last.expect("one")
}

fn refused<M: Mechanism>(value: Value) -> String {
    match from_value::<Checkpoint<M>>(value) {
        Ok(_) => panic!("it is read"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn files_of_something_else_are_refused() {
    let checkpoint = of::<_, _, holonom::mechanism::Absolute>(&Rod::default(), Rk4::every(0.01));
    let written = to_value(&checkpoint).expect("finite");
    let with = |part: &str, key: &str, value: Value| {
        let mut other = written.clone();
        match part {
            "" => other[key] = value,
            part => other[part][key] = value,
        }
        other
    };
    assert_eq!(
        refused::<Flap>(written.clone()),
        "this is a checkpoint of `Rod`, and not of `Flap`"
    );
    assert_eq!(
        refused::<reordered::Rod>(written.clone()),
        "`Rod` has other fields than at the time of this checkpoint, or they are in another order"
    );
    assert_eq!(
        refused::<Rod>(with("of", "format", json!(7))),
        "this is a checkpoint in the format 7, and this program reads the format 2"
    );
    let other = refused::<Rod>(with("of", "holonom", json!("0.0.1")));
    assert!(
        other.starts_with("this is a checkpoint of holonom 0.0.1, and not of "),
        "{other}"
    );
    assert_eq!(
        refused::<Rod>(with("of", "numbers", json!("f32"))),
        "this checkpoint has numbers of type f32, and not of type f64"
    );
    let damaged =
        "this checkpoint is damaged: numbers are missing, not finite or beyond all counts";
    assert_eq!(refused::<Rod>(with("", "steps", json!(u64::MAX))), damaged);
    assert_eq!(refused::<Rod>(with("", "given", json!([1.0]))), damaged);
    let mut short = written.clone();
    short["segment"]["memory"]["numbers"]
        .as_array_mut()
        .expect("some")
        .pop();
    let short: Checkpoint<Rod> = from_value(short).expect("it is read");
    let rod = Rod::default();
    let error = rod
        .simulation(StandardLagrange, Rk4::every(0.01))
        .resume(&short, |_| ());
    assert_eq!(
        error.expect_err("too short").fault.to_string(),
        "what the checkpoint keeps of the method does not fit this run: the file is damaged, or not of this mechanism"
    );
    // The state is one that can be read by itself.
    let state: NamedState<Rod> = from_value(written["state"].clone()).expect("a state");
    assert_eq!(
        state,
        NamedState::new(checkpoint.time(), *checkpoint.state())
    );

    // Literal masses are no part of the structure: they show in the rates.
    let text = to_string(&checkpoint).expect("finite");
    let read: Result<Checkpoint<heavier::Rod>, _> = from_str(&text);
    let heavier = heavier::Rod::default();
    let run = heavier.simulation(StandardLagrange, Rk4::every(0.01));
    let error = run.resume(&read.expect("the same structure"), |_| ());
    let sentence = error.expect_err("another mass").fault.to_string();
    assert!(
        sentence.starts_with("the rates at the checkpoint differ by "),
        "{sentence}"
    );
}

#[test]
fn runs_of_another_kind_are_refused() {
    use holonom::mechanism::{Absolute, Relative};
    let method = DormandPrince::default();
    let checkpoint = of::<_, _, Relative>(&flap(), method);
    let fault = |error: Result<RunReport<f64, Flap>, SimulationError<StateOf<Flap>>>| {
        error.expect_err("another run").fault.to_string()
    };
    let flap = flap();
    let other = Simulation::new(&flap, StandardLagrange, Rk4::every(0.01)).joint_coordinates();
    assert!(fault(other.resume(&checkpoint, |_| ())).starts_with(
        "the checkpoint is of a run by another method, or with another step, tolerance or limit"
    ));
    let tighter = DormandPrince::new(Tolerance {
        relative: 1e-7,
        absolute: 1e-9,
    });
    let other = Simulation::new(&flap, StandardLagrange, tighter).joint_coordinates();
    assert!(fault(other.resume(&checkpoint, |_| ())).contains("another method"));
    let other = Simulation::new(&flap, Baumgarte::default(), method).joint_coordinates();
    assert!(fault(other.resume(&checkpoint, |_| ())).contains("another formulation"));
    let other = Simulation::new(&flap, StandardLagrange, method).coordinates::<Absolute>();
    assert_eq!(
        fault(other.resume(&checkpoint, |_| ())),
        "the checkpoint is of a run in joint coordinates, and this one is in absolute coordinates"
    );
    let run = || Simulation::new(&flap, StandardLagrange, method).joint_coordinates();
    let period = run()
        .every_period(0.1, |_, _| ())
        .resume(&checkpoint, |_| ());
    assert_eq!(
        fault(period),
        "the checkpoint is of a run with other events, controllers or interactions; give the same ones, in the same order"
    );
    let forced = run().forces(|_, _, loads| loads.force(Flap::HANDLES.door, [1.0, 0.0, 0.0]));
    assert!(fault(forced.resume(&checkpoint, |_| ())).contains("closure of forces"));
    assert!(fault(run().verified().resume(&checkpoint, |_| ())).contains("no companion"));
    let softer = Flap::new(0.6).expect("acceptable");
    let other = Simulation::new(&softer, StandardLagrange, method).joint_coordinates();
    assert_eq!(
        fault(other.resume(&checkpoint, |_| ())),
        "the checkpoint is of a run that began with `stiffness` = 0.7, and this mechanism has 0.6; begin with the values of that run"
    );
    let none = run()
        .checkpoints(0, |_| ())
        .run(0.0..=1.0, every(0.1), |_| ());
    assert!(fault(none).contains("steps between checkpoints"));
}
