//! What a fault says, word for word.

extern crate std;

use std::string::ToString;

use crate::*;

fn not_converged(iterations: usize, joint: Option<&'static str>) -> Fault {
    Fault::NotConverged {
        iterations,
        residual: 3.2e-2,
        joint,
    }
}

#[test]
fn a_step_size_that_vanishes_names_a_cause() {
    let underflow = |joint| Fault::StepSizeUnderflow { step: 4e-16, joint };
    assert_eq!(
        underflow(None).to_string(),
        "the step size 4e-16 s is below the resolution of the time; constraints that cannot be met, a singular configuration, \
         and forces that jump or grow without bound are the usual causes"
    );
    assert_eq!(
        underflow(Some("pull")).to_string(),
        "the step size 4e-16 s is below the resolution of the time; the constraints all but depend on each other at joint `pull`: \
         a singular configuration, or constraints that cannot be met beyond it"
    );
}

#[test]
fn one_is_singular_and_more_are_plural() {
    let not_driven = |degrees_of_freedom| Fault::NotDriven { degrees_of_freedom };
    for (fault, message) in [
        (
            not_converged(1, Some("driver")),
            "no convergence after 1 iteration: joint `driver` is violated most (residual 3.2e-2)",
        ),
        (
            not_converged(0, Some("driver")),
            "no convergence after 0 iterations: joint `driver` is violated most (residual 3.2e-2)",
        ),
        (
            not_converged(20, None),
            "no convergence after 20 iterations (residual 3.2e-2)",
        ),
        (
            not_driven(1),
            "the mechanism has 1 more velocity than equations; a kinematic analysis needs a driver for it",
        ),
        (
            not_driven(2),
            "the mechanism has 2 more velocities than equations; a kinematic analysis needs a driver for each",
        ),
    ] {
        assert_eq!(fault.to_string(), message);
    }
}
