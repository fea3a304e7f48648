//! What is no unit, and why.

use crate::unit::path;
use holonom::mechanism::Relative;
use holonom::prelude::*;
use holonom_fmu::{Fmu, FmuError};
use holonom_models::CartPole;

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
fn a_folder_that_is_not_there_is_a_fault_of_the_file() {
    let fault = cart().write(path("nowhere/at/all.fmu"));
    assert!(matches!(&fault, Err(FmuError::File(_))), "{fault:?}");
    let message = fault.expect_err("refused").to_string();
    assert!(message.contains("nowhere/at/all.fmu"), "{message}");
}
