//! What an observer of a run may return, and what the run makes of it.

use core::error::Error;
use core::ops::ControlFlow;
use std::boxed::Box;
use std::string::ToString;

use super::crank::Crank;
use super::rod::{PIVOT, ROD, Rod, rod};
use crate::error::StartFault;
use crate::state::State;
use crate::*;

macro_rules! simulation {
    ($rod:expr) => {
        Simulation::new($rod, StandardLagrange, Rk4::every(0.01))
    };
}

/// What an observer of the test could not do.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Full(usize);

impl core::fmt::Display for Full {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "no room for sample {}", self.0)
    }
}

#[test]
fn an_error_of_the_observer_stops_the_run_and_is_handed_on() {
    let mut seen = 0;
    let outcome = simulation!(&rod()).run(0.0..=1.0, every(0.1), |_| {
        seen += 1;
        if seen == 4 { Err(Full(seen)) } else { Ok(()) }
    });
    let error = outcome.unwrap_err();
    assert_eq!(error, RunError::Observer(Full(4)));
    assert_eq!(error.to_string(), "no room for sample 4");
    assert_eq!(seen, 4);
}

#[test]
fn an_observer_that_may_fail_and_does_not_changes_nothing() {
    let rod = rod();
    let plain = simulation!(&rod)
        .run(0.0..=1.0, every(0.1), |_| ())
        .unwrap();
    let careful = simulation!(&rod).run(0.0..=1.0, every(0.1), |sample| {
        sample.reaction(PIVOT, ROD)?;
        Ok::<(), Fault>(())
    });
    assert_eq!(careful.unwrap(), plain);
}

#[test]
fn an_observer_may_stop_or_fail() {
    let rod = rod();
    let until = |last: f64| {
        let outcome = simulation!(&rod).run(0.0..=1.0, every(0.1), |sample| {
            if sample.time() > 0.55 {
                return Err(Full(0));
            }
            let stops = sample.time() >= last;
            Ok(if stops {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            })
        });
        match outcome {
            Ok(report) => Ok((report.stopped, report.time)),
            Err(RunError::Observer(full)) => Err(full),
            Err(RunError::Simulation(error)) => panic!("{error}"),
        }
    };
    let (stopped, time) = until(0.35).unwrap();
    assert!(stopped && (time - 0.4).abs() < 1e-12);
    assert_eq!(until(2.0), Err(Full(0)));
}

#[test]
fn a_fault_of_the_run_is_told_from_one_of_the_observer() {
    let rod = rod();
    let refused = simulation!(&rod).run(f64::NAN..=1.0, every(0.1), |_| Ok::<(), Full>(()));
    let Err(RunError::Simulation(error)) = refused else {
        panic!("an interval from NaN was run");
    };
    assert!(matches!(
        error.fault,
        Fault::Start(StartFault::Interval { .. })
    ));
    // Who returns nothing has the same error as it is.
    let plain = simulation!(&rod).run(f64::NAN..=1.0, every(0.1), |_| ());
    let plain: SimulationError<State<f64, 7, 6>> = plain.unwrap_err();
    assert_eq!(plain.fault.to_string(), error.fault.to_string());
    let whole = RunError::<_, Full>::from(plain);
    assert_eq!(whole.to_string(), error.to_string());
}

/// `?` hands on either error of a run whose observer returns any error at all.
#[test]
fn an_observer_may_return_any_error() {
    fn run(rod: &Rod) -> Result<(), Box<dyn Error>> {
        simulation!(rod).run(
            0.0..=1.0,
            every(0.1),
            |sample| -> Result<(), Box<dyn Error>> {
                sample.multipliers()?;
                "a number".parse::<usize>()?;
                Ok(())
            },
        )?;
        Ok(())
    }
    let error = run(&rod()).unwrap_err();
    assert_eq!(error.to_string(), "invalid digit found in string");
}

#[test]
fn an_analysis_hands_on_an_error_of_its_observer() {
    let crank = Crank {
        start: 0.4,
        speed: -2.0,
        acceleration: 7.0,
    };
    let outcome =
        KinematicAnalysis::new(&crank, StandardLagrange)
            .run(0.0..=1.0, every(0.1), |_| Err::<(), _>(Full(1)));
    assert_eq!(outcome.unwrap_err(), RunError::Observer(Full(1)));
}
