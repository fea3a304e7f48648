//! Single runs: recorded with everything that can be read from them, or bare, to be timed.

use std::hint::black_box;
use std::ops::ControlFlow;

use holonom::{
    Fault, Formulation, Mechanism, Real, Runs, Sample, Simulation,
    dynamics::{Iterations, Problem},
    every,
    integrate::{Advance as _, Counts, Integration as _, Integrator, System, TimeSpan},
    mechanism::{Absolute, Orientation},
};

use crate::error::StudyError;
use crate::timing::Candidate;

/// What a run came to, and what was read from it at the reporting times.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording<T> {
    /// Evaluations of the equations of motion.
    pub evaluations: u64,
    /// Steps that were accepted.
    pub accepted: u64,
    /// Steps that were tried and rejected.
    pub rejected: u64,
    /// How often the augmented Lagrangian solved its system; zero for other formulations.
    pub iterations: Iterations,
    /// What was read at the start, at the reporting times and at the end.
    pub reports: Vec<T>,
}

/// Runs a mechanism over `span` and reads what `read` wants at its start, at every multiple of
/// `span.first_output` after it, and at its end. `P` says how Euler parameters are read.
///
/// # Errors
/// [`StudyError::Run`] under `name` where the run or a reading stops.
pub fn record<P, M, F, I, T>(
    name: &str,
    mechanism: &M,
    (formulation, integrator): (F, I),
    span: TimeSpan<f64>,
    mut read: impl FnMut(&Sample<'_, f64, M>) -> Result<T, Fault>,
) -> Result<Recording<T>, StudyError>
where
    P: Orientation,
    M: Mechanism,
    F: Formulation<f64>,
    I: Runs<Problem<M, F, f64, Absolute<P>>>,
{
    let stopped = |reason: String| StudyError::Run {
        name: name.to_owned(),
        reason,
    };
    let (mut reports, mut fault) = (Vec::new(), None);
    let simulation = Simulation::new(mechanism, formulation, integrator).orientation::<P>();
    let run = simulation.run(
        span.start..=span.end,
        every(span.first_output),
        |sample| match read(sample) {
            Ok(report) => {
                reports.push(report);
                ControlFlow::Continue(())
            }
            Err(error) => {
                fault = Some(format!("at {} s: {error}", sample.time()));
                ControlFlow::Break(())
            }
        },
    );
    let run = run.map_err(|error| stopped(error.to_string()))?;
    match fault {
        Some(reason) => Err(stopped(reason)),
        None => Ok(Recording {
            evaluations: run.evaluations as u64,
            accepted: run.accepted as u64,
            rejected: run.rejected as u64,
            iterations: run.iterations,
            reports,
        }),
    }
}

/// A bare run over `span`, with dense output at the reporting times, as a candidate of a
/// [race](crate::timing::race).
pub fn candidate<'a, S, Y, I>(
    name: impl Into<String>,
    mut system: Y,
    integrator: I,
    span: TimeSpan<S>,
    start: Y::State,
) -> Candidate<'a>
where
    S: Real + 'a,
    Y: System<S> + 'a,
    I: Integrator<S, Y> + 'a,
{
    let name = name.into();
    Candidate::new(name.clone(), move || {
        let report = |_, state: &Y::State| {
            black_box(state);
        };
        let run = integrate(
            &mut system,
            &integrator,
            span,
            black_box(start.clone()),
            report,
        );
        let counts = run.map_err(|fault| StudyError::Run {
            name: name.clone(),
            reason: fault.to_string(),
        })?;
        Ok(counts.evaluations as u64)
    })
}

/// Integrates over `span` and reports the state at its start, at every multiple of
/// `span.first_output` after it, and at its end. Returns what the integration has cost.
///
/// # Errors
/// A fault of the system or of the integrator.
pub fn integrate<S, Y, I>(
    system: &mut Y,
    integrator: &I,
    span: TimeSpan<S>,
    state: Y::State,
    mut report: impl FnMut(S, &Y::State),
) -> Result<Counts, Fault>
where
    S: Real,
    Y: System<S>,
    I: Integrator<S, Y>,
{
    report(span.start, &state);
    let mut integration = integrator.start(system, span, state)?;
    let mut reports = 1;
    while integration.time() < span.end {
        integration.advance(system)?;
        while let Some(time) = reporting_time(&span, reports).filter(|&t| t <= integration.time()) {
            // The end of a step is no matter of interpolation, which may take an evaluation.
            if time < integration.time() {
                report(time, &integration.at(system, time)?);
            } else {
                report(time, integration.state());
            }
            reports += 1;
        }
    }
    Ok(integration.counts())
}

/// The time of a report by its number, the start being number zero; `None` after the end.
fn reporting_time<S: Real>(span: &TimeSpan<S>, number: u32) -> Option<S> {
    // The end is reported once, also where round-off puts a multiple beside it.
    let margin = S::constant(1e-9) * span.first_output + S::constant(8.0) * span.end.ulp();
    let time = |number: u32| span.start + S::constant(f64::from(number)) * span.first_output;
    if time(number) < span.end - margin {
        Some(time(number))
    } else {
        (number == 0 || time(number - 1) < span.end - margin).then_some(span.end)
    }
}

#[cfg(test)]
mod tests {
    use super::integrate;
    use holonom::{
        DormandPrince, Fault, Rk4, Tolerance,
        integrate::{System, TimeSpan},
    };

    /// `y' = -y`
    struct Decay;

    impl System<f64> for Decay {
        type State = [f64; 1];

        fn rates(&mut self, _time: f64, state: &[f64; 1]) -> Result<[f64; 1], Fault> {
            Ok([-state[0]])
        }
    }

    fn times(end: f64, first_output: f64) -> Vec<f64> {
        let span = TimeSpan {
            start: 0.0,
            end,
            first_output,
        };
        let mut times = Vec::new();
        let integrator = DormandPrince::new(Tolerance {
            relative: 1e-8,
            absolute: 1e-12,
        });
        integrate(&mut Decay, &integrator, span, [1.0], |time, state| {
            assert!((state[0] - (-time).exp()).abs() < 1e-7);
            times.push(time);
        })
        .unwrap();
        times
    }

    #[test]
    fn start_and_end_are_reported_once() {
        let times_of_chapter_15 = times(10.0, 0.02);
        assert_eq!(times_of_chapter_15.len(), 501);
        assert_eq!(
            (times_of_chapter_15[0], times_of_chapter_15[500]),
            (0.0, 10.0)
        );
        assert_eq!(times(1.0, 0.4), [0.0, 0.4, 0.8, 1.0]);
        assert_eq!(times(1.0, 5.0), [0.0, 1.0]);
    }

    #[test]
    fn evaluations_are_counted() {
        let span = TimeSpan {
            start: 0.0,
            end: 1.0,
            first_output: 1.0,
        };
        let counts = integrate(&mut Decay, &Rk4::every(0.1), span, [1.0], |_, _| ()).unwrap();
        assert_eq!((counts.accepted, counts.rejected), (10, 0));
        assert!(counts.evaluations >= 40);
    }
}
