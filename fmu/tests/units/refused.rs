//! What is no unit, and why.

use crate::unit::path;
use holonom::mechanism::Relative;
use holonom::prelude::*;
use holonom_fmu::{Fmu, FmuError};
use holonom_models::CartPole;

/// A slider between two stops.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Stopped {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.0])]
    slider: Body,
    #[joint(
        between = [ground, slider],
        point = [0.0, 0.0, 0.0],
        axis = [1.0, 0.0, 0.0],
        limits = [-1.0, 1.0]
    )]
    rail: Prismatic,
}

fn cart() -> Fmu<CartPole, Relative> {
    Fmu::new(&CartPole::default(), StandardLagrange).without_binary()
}

fn refused<M: Mechanism>(unit: Fmu<M, Relative>) -> String
where
    Relative: holonom::mechanism::TracedCoordinates<M>,
{
    let path = path("refused.fmu");
    let message = unit.write(&path).expect_err("refused").to_string();
    assert!(!path.exists());
    message
}

#[test]
fn what_is_refused_is_named() {
    let message = refused(Fmu::new(&Stopped::default(), StandardLagrange));
    assert!(message.contains("joint `rail` has limits"), "{message}");
    let message = refused(cart().internal_step(0.0));
    assert!(message.contains("internal step is 0 s"), "{message}");
    let message = refused(cart().about("pull", "force (N)"));
    assert_eq!(message, "there is no variable `pull`");
    let message = refused(cart().named("fmi3_functions"));
    assert!(message.contains("`fmi3_functions`"), "{message}");
    let message = refused(cart().reading("step", "s", |view| view.time()));
    assert_eq!(message, "the name `step` is given twice");
}

#[test]
fn limits_are_passed_where_that_is_said() {
    let unit = Fmu::<_, Relative>::new(&Stopped::default(), StandardLagrange);
    let written = unit
        .without_limits()
        .without_binary()
        .write(path("passed.fmu"));
    assert_eq!(written.expect("written").platform, None);
}

#[test]
fn a_folder_that_is_not_there_is_a_fault_of_the_file() {
    let fault = cart().write(path("nowhere/at/all.fmu"));
    assert!(matches!(fault, Err(FmuError::File(_))), "{fault:?}");
}
