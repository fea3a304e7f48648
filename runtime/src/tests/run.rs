//! Runs: chapter 15 of Flores, reports, failures.

use crate::dynamics::Iterations;
use crate::error::{NotFinite, StartFault, StepFault};
use crate::mechanism::{Normalised, Orientation};
use crate::state::State;
use core::ops::ControlFlow;

use super::rod::{PIVOT, ROD, Rod, rod};
use crate::*;

const ODE45: DormandPrince<f64> = DormandPrince::new(Tolerance {
    relative: 1e-6,
    absolute: 1e-9,
});

/// Euler parameters read as the programs of chapter 15 do.
#[derive(Clone, Copy, Debug, Default)]
struct Chapter15;

impl Orientation for Chapter15 {
    const NORMALISED_RATES: bool = true;
}

fn proceed<S: Real>(_: &Sample<'_, S, Rod>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

fn evaluations<F: Formulation<f64>, P: Orientation>(method: F) -> usize {
    let rod = rod();
    let simulation = Simulation::new(&rod, method, ODE45).orientation::<P>();
    let report = simulation.run(0.0..=10.0, every(0.02), proceed).unwrap();
    assert_eq!(
        report.evaluations,
        6 * (report.accepted + report.rejected) + 1
    );
    report.evaluations
}

/// Counts of an independent calculation with MATLAB's control (problem D01), and near them where
/// `p` is brought to length 1.
#[test]
fn chapter_15_takes_the_known_evaluations() {
    assert_eq!(evaluations::<_, Chapter15>(StandardLagrange), 1765);
    assert_eq!(evaluations::<_, Chapter15>(Baumgarte::default()), 2581);
    assert_eq!(evaluations::<_, Chapter15>(Penalty::default()), 3769);
    assert_eq!(
        evaluations::<_, Chapter15>(AugmentedLagrangian::default()),
        3769
    );
    assert_eq!(evaluations::<_, Normalised>(StandardLagrange), 1747);
    assert_eq!(evaluations::<_, Normalised>(Baumgarte::default()), 2623);
    assert_eq!(evaluations::<_, Normalised>(Penalty::default()), 3697);
}

/// Angle from the vertical, rate and reaction at 10 s (problem D01, closed form).
#[test]
fn a_tight_run_meets_the_closed_solution() {
    let (angle, rate) = (0.776118948971798, -4.58231724018501);
    let (radial, transverse) = (122.847198297600, 12.0685911483748);
    let tight = DormandPrince::new(Tolerance {
        relative: 1e-12,
        absolute: 1e-14,
    });
    let mut samples = 0;
    let rod = rod();
    Simulation::new(&rod, AugmentedLagrangian::default(), tight)
        .run(0.0..=10.0, every(2.5), |sample| {
            samples += 1;
            if sample.time() == 10.0 {
                // The rod starts along +y at rest and falls: its angle about x runs from 0 to -pi.
                let from_vertical = sample.angle(PIVOT) + core::f64::consts::FRAC_PI_2;
                assert!((from_vertical - angle).abs() < 1e-8, "{from_vertical}");
                assert!((sample.angle_rate(PIVOT) - rate).abs() < 1e-7);
                let wrench = sample.reaction(PIVOT, ROD).unwrap();
                let (sine, cosine) = from_vertical.sin_cos();
                let inwards = -sine * wrench.force.y + cosine * wrench.force.z;
                let across = cosine * wrench.force.y + sine * wrench.force.z;
                assert!((inwards - radial).abs() < 1e-5, "{inwards}");
                assert!((across - transverse).abs() < 1e-5, "{across}");
                assert!(
                    wrench.moment.iter().all(|m| m.abs() < 1e-5),
                    "{}",
                    wrench.moment
                );
                assert!(wrench.point.iter().all(|m| m.abs() < 1e-6));
                let ground = sample.reaction_on_place(PIVOT, 0).unwrap();
                assert!(
                    (ground.force + wrench.force)
                        .iter()
                        .all(|f| f.abs() < 1e-12)
                );
                assert!(
                    (ground.moment + wrench.moment)
                        .iter()
                        .all(|m| m.abs() < 1e-5)
                );
                assert!(sample.energy().abs() < 1e-6);
                assert!(sample.acceleration_violation().unwrap() < 1e-9);
            }
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(samples, 5);
}

#[test]
fn the_augmented_lagrangian_takes_about_two_iterations() {
    let rod = rod();
    let report = Simulation::new(&rod, AugmentedLagrangian::default(), ODE45)
        .run(0.0..=1.0, every(0.1), proceed)
        .unwrap();
    let Iterations { total, largest, .. } = report.iterations;
    assert!(
        total >= 2 * report.evaluations && total <= 3 * report.evaluations,
        "{total}"
    );
    assert!(largest <= 3);

    let hasty = AugmentedLagrangian {
        tolerance: 1e-18,
        max_iterations: 2,
        ..Default::default()
    };
    let error = Simulation::new(&rod, hasty, ODE45).run(0.0..=1.0, every(0.1), proceed);
    assert!(matches!(
        error.unwrap_err().fault,
        Fault::Step(StepFault::NotConverged { iterations: 2, .. })
    ));
}

#[test]
fn the_observer_sees_every_time_and_may_stop() {
    let rod = rod();
    let simulation = Simulation::new(&rod, StandardLagrange, ODE45);
    let mut count = 0_u32;
    let report = simulation
        .run(0.0..=1.0, every(0.3), |sample| {
            let expected = if count == 4 {
                1.0
            } else {
                0.3 * f64::from(count)
            };
            assert!((sample.time() - expected).abs() < 1e-15);
            count += 1;
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!((count, report.time, report.stopped), (5, 1.0, false));

    let stop = |sample: &Sample<'_, f64, Rod>| {
        if sample.time() < 0.5 {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    };
    let report = simulation.run(0.0..=1.0, every(0.1), stop).unwrap();
    assert!(report.stopped && (report.time - 0.5).abs() < 1e-15);

    let report = simulation.run(1.0..=1.0, every(0.1), proceed).unwrap();
    assert_eq!((report.evaluations, report.time), (1, 1.0));

    let mut steps = 0;
    let report = simulation
        .run(0.0..=1.0, every_step(), |_| {
            steps += 1;
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(steps, report.accepted + 1);
}

#[test]
fn lazy_evaluations_of_an_observer_are_not_counted() {
    let rod = rod();
    let simulation = Simulation::new(&rod, AugmentedLagrangian::default(), ODE45);
    let quiet = simulation.run(0.0..=1.0, every(0.1), proceed).unwrap();
    let curious = simulation
        .run(0.0..=1.0, every(0.1), |sample| {
            sample.multipliers().unwrap();
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(quiet, curious);
}

#[test]
fn applied_forces_enter_where_they_act() {
    // A force at the tip against gravity holds the rod: half its weight, at twice the arm.
    let rod = rod();
    let hold = 0.5 * rod.mass * super::rod::GRAVITY;
    for at_point in [true, false] {
        let report = Simulation::new(&rod, Baumgarte::default(), ODE45)
            .forces(|_, _, loads| {
                if at_point {
                    // The tip is at +y of the principal axes, which is -z of the user's.
                    loads.force_at(ROD, [0.0, 0.0, -0.5], [0.0, 0.0, hold]);
                } else {
                    loads.force(ROD, [0.0, 0.0, hold]);
                    loads.moment(ROD, [0.25 * hold, 0.0, 0.0]);
                    loads.moment_in_body_axes(ROD, [0.25 * hold, 0.0, 0.0]);
                }
            })
            .run(0.0..=1.0, every(0.1), proceed)
            .unwrap();
        let w = Rod::angular_velocity(&report.state, ROD);
        assert!(w.iter().all(|w| w.abs() < 1e-12), "{w}");
    }
}

#[test]
fn forces_of_zero_change_no_digit_that_counts() {
    let rod = rod();
    let fused = Simulation::new(&rod, Penalty::default(), ODE45);
    let parts = Simulation::new(&rod, Penalty::default(), ODE45).forces(|_, _, _| {});
    let fused = fused.run(0.0..=2.0, every(0.1), proceed).unwrap();
    let parts = parts.run(0.0..=2.0, every(0.1), proceed).unwrap();
    assert_eq!(fused.evaluations, parts.evaluations);
    let (a, b) = (fused.state.coordinates(), parts.state.coordinates());
    assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9));
}

#[test]
fn a_fixed_step_runs_and_single_precision_too() {
    let rod = rod();
    let report = Simulation::new(&rod, Baumgarte::default(), Rk4::every(1e-3))
        .run(0.0..=1.0, every(0.01), proceed)
        .unwrap();
    assert_eq!((report.evaluations, report.accepted), (4000, 1000));
    assert!((angle(&report.state) + 1.56267679526308 + core::f64::consts::FRAC_PI_2).abs() < 1e-8);

    let report = Simulation::new(&rod, Baumgarte::default(), Rk4::every(1e-3_f32))
        .run(0.0..=1.0, every(0.01), proceed)
        .unwrap();
    let single = Rod::orientation(&report.state, ROD).map(f64::from);
    let double = 2.0 * single[1].atan2(single[0]);
    assert!(double.is_finite() && report.worst_violation < 1e-10);
}

fn angle(state: &State<f64, 7, 6>) -> f64 {
    let constants = Rod::prepare(&[1.0]);
    View::<f64, Rod>::new(&constants, 0.0, state).angle(PIVOT)
}

#[test]
fn a_projection_after_every_step_holds_the_constraints() {
    let rod = rod();
    let loose = DormandPrince::new(Tolerance {
        relative: 1e-4,
        absolute: 1e-6,
    });
    let simulation = Simulation::new(&rod, StandardLagrange, loose);
    let drifting = simulation.run(0.0..=10.0, every(0.02), proceed).unwrap();
    assert!(drifting.worst_violation > 1e-12);
    let report = Simulation::new(&rod, StandardLagrange, loose)
        .projection(Projection::default())
        .run(0.0..=10.0, every(0.02), |sample| {
            assert!(sample.velocity_violation() < 1e-28);
            ControlFlow::Continue(())
        })
        .unwrap();
    assert!(
        report.worst_violation < 1e-29,
        "{:e}",
        report.worst_violation
    );
    // One evaluation more a step, at the corrected state.
    let expected = 7 * report.accepted + 6 * report.rejected;
    assert_eq!(report.evaluations, expected);
}

#[test]
fn what_is_refused_comes_with_time_and_state() {
    let bad = Rod { mass: -1.0 };
    let error = Simulation::new(&bad, StandardLagrange, ODE45).run(2.0..=3.0, every(0.1), proceed);
    let error = error.unwrap_err();
    assert!(matches!(
        error.fault,
        Fault::Parameter(ParameterError { field: "rod", .. })
    ));
    assert_eq!(error.time, 2.0);

    let rod = rod();
    let fault = |error: RunResult<f64, Rod>| error.unwrap_err().fault;
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = [
            fault(
                Simulation::new(&rod, Baumgarte::new(value, 5.0), ODE45).run(
                    0.0..=1.0,
                    every(0.1),
                    proceed,
                ),
            ),
            fault(
                Simulation::new(&rod, Penalty::new(value, 1.0, 1.0), ODE45).run(
                    0.0..=1.0,
                    every(0.1),
                    proceed,
                ),
            ),
            fault(Simulation::new(&rod, StandardLagrange, ODE45).run(
                0.0..=1.0,
                every(value),
                proceed,
            )),
            fault(
                Simulation::new(&rod, StandardLagrange, Rk4::every(value)).run(
                    0.0..=1.0,
                    every(0.1),
                    proceed,
                ),
            ),
        ];
        assert!(
            refused
                .iter()
                .all(|fault| matches!(fault, Fault::Start(StartFault::Setting { .. }))),
            "{refused:?}"
        );
    }
    let simulation = Simulation::new(&rod, StandardLagrange, ODE45);
    for interval in [1.0..=0.0, 0.0..=f64::NAN, f64::NEG_INFINITY..=0.0] {
        let refused = fault(simulation.run(interval, every(0.1), proceed));
        assert!(
            matches!(refused, Fault::Start(StartFault::Interval { .. })),
            "{refused}"
        );
    }
    let nan = State::from_parts([f64::NAN; 7], [0.0; 6]);
    let simulation = simulation.initial_state(nan);
    assert_eq!(
        fault(simulation.run(0.0..=1.0, every(0.1), proceed)),
        Fault::Step(StepFault::StateNotFinite)
    );
}

#[test]
fn forces_out_of_range_end_the_run_at_the_last_good_state() {
    let rod = rod();
    let error = Simulation::new(&rod, StandardLagrange, ODE45)
        .forces(|time, _, loads| {
            let force = if time < 0.7 { 0.0 } else { f64::INFINITY };
            loads.force(ROD, [0.0, 0.0, force]);
        })
        .run(0.0..=1.0, every(0.1), proceed)
        .unwrap_err();
    let origin = NotFinite::Closure("rod");
    assert_eq!(
        error.fault,
        Fault::Step(StepFault::RatesNotFinite { origin })
    );
    assert!(error.time > 0.6999 && error.time < 0.7);
    assert!(error.state.coordinates().iter().all(|q| q.is_finite()));
}

#[test]
fn a_run_of_no_length_is_refused_where_any_other_would_be() {
    let state = State::from_parts([0.0; 7], [0.0; 6]);
    let rod = rod();
    let run = |end: f64| {
        Simulation::new(&rod, StandardLagrange, ODE45)
            .initial_state(state)
            .run(0.0..=end, every(0.1), proceed)
            .map_err(|error| error.fault)
            .map(|report| report.evaluations)
    };
    assert_eq!(run(0.0).unwrap_err(), run(1.0).unwrap_err());
    let report = Simulation::new(&rod, StandardLagrange, ODE45).run(0.0..=0.0, every(0.1), proceed);
    assert_eq!(report.expect("regular").evaluations, 1);
}
