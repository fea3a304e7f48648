//! What a fault says, word for word, and what is shown of it.

extern crate std;

use crate::error::ParameterFault;
use crate::error::Quantity;
use crate::error::{AnalysisFault, AssemblyFault, LeavesOut, ReadingFault, StartFault, StepFault};
use crate::state::State;
use core::ops::ControlFlow;
use std::boxed::Box;
use std::error::Error;
use std::format;
use std::string::ToString;

use super::rod::{PIVOT, ROD, Rod, rod};
use crate::*;

fn not_converged(iterations: u32, joint: Option<&'static str>, alpha: Option<f64>) -> Fault {
    Fault::Step(StepFault::NotConverged {
        iterations,
        residual: 3.2e-2,
        joint,
        alpha,
    })
}

fn underflow(is_least: bool, joint: Option<&'static str>, resolution: Option<f64>) -> Fault {
    Fault::Step(StepFault::SizeUnderflow {
        step: 4e-16,
        is_least,
        joint,
        resolution,
    })
}

#[test]
fn a_state_that_does_not_satisfy_the_constraints_is_told_by_how_much() {
    let says = |quantity: Quantity, message: &str| {
        let fault = Fault::Analysis(AnalysisFault::NotAssembled {
            joint: "pin",
            quantity,
            violation: 0.05,
        });
        assert_eq!(fault.to_string(), message);
    };
    says(
        Quantity::Length,
        "joint `pin` is open by 0.05 m: the state does not satisfy the constraints, `state_near` finds one that does",
    );
    says(
        Quantity::Speed,
        "the bodies of joint `pin` move against it at 0.05 m/s: the state does not satisfy the constraints, `with_rates` finds one that does",
    );
}

#[test]
fn a_step_size_that_vanishes_names_a_cause() {
    let says = |fault: Fault, message: &str| assert_eq!(fault.to_string(), message);
    says(
        underflow(false, None, None),
        "the step size 4e-16 s is below the resolution of the time; constraints that cannot be met, a singular configuration, \
         and forces that jump or grow without bound are the usual causes",
    );
    says(
        underflow(false, Some("pull"), Some(1e-4)),
        "the step size 4e-16 s is below the resolution of the time; the constraints all but depend on each other at joint `pull`: \
         a singular configuration, or constraints that cannot be met beyond it",
    );
    says(
        underflow(false, None, Some(6.103_515_625e-5)),
        "the step size 4e-16 s is below the resolution of the time; positions of this size are known to 6.1e-5 m, which is coarser than \
         the absolute tolerance: give a larger one, a number type of more digits, or an origin that is nearer; if that does not help, the \
         cause is a singular configuration, constraints that cannot be met, or forces that jump",
    );
    says(
        underflow(true, None, None),
        "the error of a step of 4e-16 s, the least that may be taken, is beyond the tolerance; constraints that cannot be met, a singular \
         configuration, and forces that jump or grow without bound are the usual causes",
    );
}

#[test]
fn a_start_is_refused_with_what_helps() {
    let open = |is_final| {
        Fault::Start(StartFault::Inconsistent {
            joint: "hook",
            quantity: Quantity::Length,
            violation: 0.01,
            is_final,
        })
    };
    assert_eq!(
        open(false).to_string(),
        "joint `hook` is open by 0.01 m at the start: `.assembled()` corrects the start, `.inconsistent_start()` accepts it"
    );
    assert_eq!(
        open(true).to_string(),
        "joint `hook` is open by 0.01 m at the start, and joint coordinates describe no such state: `.assembled()` or `assemble` corrects it"
    );
}

#[test]
fn what_cannot_be_set_is_told_with_what_can() {
    let carries_nothing = |instead| {
        Fault::Assembly(AssemblyFault::CarriesNothing {
            joint: "pin",
            instead,
        })
    };
    for (fault, message) in [
        (
            carries_nothing(Some("hinge")),
            "joint `pin` carries no body in the spanning tree: set `hinge`, which carries one of its bodies, and let `assemble` close `pin`",
        ),
        (
            carries_nothing(None),
            "joint `pin` carries no body in the spanning tree",
        ),
        (
            Fault::Step(StepFault::WithoutInertia { body: "yoke" }),
            "the mass or inertia of `yoke`, as given, is not positive: the mechanism moves by its joints, and bodies have no equations for accelerations, reactions and impulses of events",
        ),
        (
            Fault::Assembly(AssemblyFault::NotFree { joint: "pin" }),
            "what is to be set of joint `pin` is no motion that its equations leave free",
        ),
        (
            Fault::Start(StartFault::Times {
                name: "kick",
                time: 0.5,
            }),
            "the times of `kick` must be finite, and each greater than the one before; 0.5 s is not",
        ),
    ] {
        assert_eq!(fault.to_string(), message);
    }
}

#[test]
fn who_leaves_states_out_says_so() {
    for (by, message) in [
        (
            LeavesOut::StepMethod,
            "the state `current` of the mechanism has a rate of its own: the generalized-alpha method moves bodies alone; take another method",
        ),
        (
            LeavesOut::Kinematics,
            "the state `current` of the mechanism has a rate of its own: a kinematic analysis integrates nothing; take a simulation",
        ),
        (
            LeavesOut::Linearisation,
            "the state `current` of the mechanism has a rate of its own: linearisations and equilibria know the chosen coordinates alone",
        ),
    ] {
        let state = "current";
        assert_eq!(
            Fault::Start(StartFault::StateLeftOut { state, by }).to_string(),
            message
        );
    }
}

#[test]
fn one_is_singular_and_more_are_plural() {
    let not_driven =
        |degrees_of_freedom| Fault::Analysis(AnalysisFault::NotDriven { degrees_of_freedom });
    for (fault, message) in [
        (
            not_converged(1, Some("driver"), None),
            "no convergence after 1 iteration: joint `driver` is violated most (residual 0.032)",
        ),
        (
            not_converged(0, Some("driver"), None),
            "no convergence after 0 iterations: joint `driver` is violated most (residual 0.032)",
        ),
        (
            not_converged(20, None, None),
            "no convergence after 20 iterations (residual 0.032)",
        ),
        (
            not_converged(20, Some("driver"), Some(1e3)),
            "no convergence after 20 iterations of the augmented Lagrangian with `alpha = 1000`: joint `driver` is violated most \
             (residual 0.032); a larger `alpha` for these masses needs fewer iterations",
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

#[test]
fn numbers_are_those_of_a_person() {
    let setting = |value| {
        Fault::Start(StartFault::Setting {
            name: "step",
            value,
        })
    };
    let interval = |start, end| Fault::Start(StartFault::Interval { start, end });
    for (fault, message) in [
        (setting(-1.0), "`step` must be finite and positive, not -1"),
        (setting(-0.0), "`step` must be finite and positive, not 0"),
        (
            Fault::Step(StepFault::Singular {
                joint: 0,
                name: "pivot",
                relative_pivot: 0.0,
            }),
            "the constraints depend on each other at joint `pivot` (relative pivot 0)",
        ),
        (
            Fault::Step(StepFault::TooShort {
                step: 1e-20,
                time: 0.125,
            }),
            "a step of 1e-20 s is below the resolution of the time 0.125 s",
        ),
        (
            Fault::Step(StepFault::NoFixedPoint {
                step: 0.1,
                iterations: 12,
            }),
            "the equation of a step of 0.1 s was not solved in 12 iterations: the step is too long for an iteration by fixed points, which converges up to about \
             one over the largest rate of the motion and of its stabilisation",
        ),
        (
            Fault::Step(StepFault::NotSolved {
                step: 0.1,
                iterations: 12,
                joint: None,
            }),
            "a step of 0.1 s was not solved in 12 iterations: it is too long for the motion, or for springs and dampers that are stiff; take a shorter one",
        ),
        (
            Fault::Step(StepFault::NotSolved {
                step: 0.1,
                iterations: 12,
                joint: Some("crank"),
            }),
            "a step of 0.1 s was not solved in 12 iterations: the constraints of joint `crank` nearly depend on others here",
        ),
        (
            Fault::Start(StartFault::SpectralRadius { value: 1.5 }),
            "the spectral radius of the generalized-alpha method is from 0 to 1, not 1.5",
        ),
        (
            Fault::Analysis(AnalysisFault::MotionLeftFree { share: 0.123_45 }),
            "the equations leave a motion free here (0.123 of a trial motion): they depend on each other, or a driver is missing",
        ),
        (
            interval(-2.0, -3.0),
            "the interval from -2 s to -3 s must not end before it begins",
        ),
        (
            interval(f64::NEG_INFINITY, 0.0),
            "the interval from -inf s to 0 s must begin at a finite time",
        ),
        (
            interval(0.0, f64::NAN),
            "the interval from 0 s to NaN s must end at a finite time",
        ),
        (
            interval(1.0, 1.0),
            "the interval from 1 s to 1 s must have a length",
        ),
        (
            Fault::Assembly(AssemblyFault::CountedAngles {
                element: "spring",
                counted: 1,
                given: 2,
            }),
            "`spring` counts turns of one angle, not of 2",
        ),
    ] {
        assert_eq!(fault.to_string(), message);
    }
}

/// A program that returns its error prints it by `Debug`.
#[test]
fn a_main_that_returns_an_error_prints_the_sentence() {
    let rod = Rod { mass: -1.0 };
    let run = |rod: &Rod| -> Result<(), Box<dyn Error>> {
        Simulation::new(rod, StandardLagrange, Rk4::every(0.1)).run(
            2.0..=1.0,
            every(0.1),
            |_| ControlFlow::Continue(()),
        )?;
        Ok(())
    };
    assert_eq!(
        format!("{:?}", run(&rod).unwrap_err()),
        "at 2 s: `mass` of `rod` must be positive"
    );
    assert_eq!(
        format!("{:?}", run(&self::rod()).unwrap_err()),
        "at 2 s: the interval from 2 s to 1 s must not end before it begins"
    );
    let described: Result<State<f64, 7, 6>, _> = rod.described_state();
    assert_eq!(
        format!("{:?}", described.unwrap_err()),
        "`mass` of `rod` must be positive"
    );
    assert_eq!(
        format!("{:?}", Fault::Step(StepFault::StateNotFinite)),
        "the state holds a number that is not finite"
    );
}

#[test]
fn what_is_not_there_is_not_read_as_zero() {
    let rod = rod();
    let constants = rod.constants().unwrap();
    let state = rod.described_state().unwrap();
    let view = View::<f64, Rod>::new(&constants, 0.0, &state);
    let multipliers = [1.0; 5];
    assert!(view.reaction(&multipliers, PIVOT, ROD).is_ok());
    let stranger = BodyHandle::<Rod>::new(7);
    let fault = view.reaction(&multipliers, PIVOT, stranger).unwrap_err();
    assert!(matches!(
        fault,
        ReadingFault::NotBetween {
            element: "pivot",
            ..
        }
    ));
    let fault = view.reaction_on_place(&multipliers, PIVOT, 2).unwrap_err();
    assert_eq!(
        fault.to_string(),
        "joint `pivot` has 2 bodies, counted from 0: there is none at 2"
    );
}

/// Who walks along the sources and prints each one says every sentence once.
#[test]
fn a_chain_of_sources_says_a_sentence_once() {
    let error = refused();
    assert_eq!(
        error.to_string(),
        "at 1.5 s: `value` of `mass` must be positive"
    );
    assert!(error.source().is_none() && error.fault.source().is_none());
    let run = RunError::<(), &str>::Simulation(error);
    assert!(run.source().is_none());
}

fn refused() -> SimulationError<()> {
    let fault = Fault::Parameter(ParameterError {
        field: "mass",
        attribute: "value",
        fault: ParameterFault::NotPositive,
    });
    SimulationError {
        time: 1.5,
        fault,
        state: (),
    }
}

/// In one line an error is a sentence; in several it keeps what it holds, but the state.
#[test]
fn an_error_that_is_shown_in_full_has_its_fields() {
    let singular = Fault::Step(StepFault::Singular {
        joint: 2,
        name: "pivot",
        relative_pivot: 0.0,
    });
    assert_eq!(
        format!("{singular:?}"),
        "the constraints depend on each other at joint `pivot` (relative pivot 0)"
    );
    let fields = "Step(
    Singular {
        joint: 2,
        name: \"pivot\",
        relative_pivot: 0.0,
    },
)";
    assert_eq!(format!("{singular:#?}"), fields);
    let run = RunError::<(), &str>::Simulation(refused());
    assert_eq!(
        format!("{run:?}"),
        "at 1.5 s: `value` of `mass` must be positive"
    );
    let fields = "Simulation(
    SimulationError {
        time: 1.5,
        fault: Parameter(
            ParameterError {
                field: \"mass\",
                attribute: \"value\",
                fault: NotPositive,
            },
        ),
        ..
    },
)";
    assert_eq!(format!("{run:#?}"), fields);
    let stopped = RunError::<(), &str>::Observer("the disk is full");
    assert_eq!(format!("{stopped:#?}"), "the disk is full");
}

/// A step hands it on.
#[test]
#[cfg(target_pointer_width = "64")]
fn a_fault_is_as_small_as_what_it_says() {
    assert_eq!(size_of::<Fault>(), size_of::<ParameterError>());
}

#[test]
fn what_runs_can_be_shown() {
    let rod = rod();
    let run = Simulation::new(&rod, StandardLagrange, Rk4::every(0.125));
    let shown = "Simulation { mechanism: \"Rod\", formulation: StandardLagrange, integrator: ";
    assert!(format!("{:?}", run.clone()).starts_with(shown), "{run:?}");
    let stepper = Stepper::<dynamics::Problem<_, _>, _>::new(&rod, StandardLagrange, Rk4).unwrap();
    assert_eq!(
        format!("{stepper:?}"),
        "Stepper { mechanism: \"Rod\", method: Rk4, .. }"
    );
    let constants = rod.constants().unwrap();
    let state = rod.described_state().unwrap();
    let view = View::<f64, Rod>::new(&constants, 0.5, &state);
    let shown = "View { mechanism: \"Rod\", time: 0.5, state: State {";
    assert!(format!("{view:?}").starts_with(shown), "{view:?}");
}
