//! The predictor-corrector method of Adams at a fixed step.

use super::pairs::{Spinning, pairs, starts};
use super::{Spring, curve, curved, distance, equation, errors, order, span};
use crate::Fault;
use crate::error::AnalysisFault;
use crate::integrate::{
    AdamsBashforthMoulton4, Advance as _, Counts, Integration as _, Integrator as _, Rk4, System,
    TimeSpan,
};

#[test]
fn it_has_order_four_at_and_within_steps() {
    let [coarse, fine] = [0.01, 0.005].map(|step| errors(AdamsBashforthMoulton4::every(step)));
    let orders = [order((coarse.0, fine.0)), order((coarse.1, fine.1))];
    assert!(
        orders.iter().all(|order| (order - 4.0).abs() < 0.15),
        "{orders:?}"
    );
}

/// Polynomials of degree four in the time come out to round-off, the last step shortened or not.
#[test]
fn it_is_exact_for_polynomials_and_ends_at_the_end() {
    for (end, evaluations) in [(1.0, 1 + 3 * 4 + 7 * 2), (0.95, 1 + 3 * 4 + 6 * 2 + 4)] {
        let mut calls = 0;
        let mut system = equation(|t: f64, _: &[f64; 1]| {
            calls += 1;
            assert!(t <= end);
            [1.0 + t * (2.0 + t * (3.0 + 4.0 * t))]
        });
        let mut integration = AdamsBashforthMoulton4::every(0.1)
            .start(&mut system, span(end, end), [0.0])
            .unwrap();
        while integration.time() < end {
            integration.advance(&mut system).unwrap();
            let t = integration.time();
            let exact = t * (1.0 + t * (1.0 + t * (1.0 + t)));
            assert!((integration.state()[0] - exact).abs() < 1e-14);
        }
        assert_eq!(integration.time(), end);
        // The slope at the end is nobody's.
        let counts = integration.counts();
        assert_eq!(
            counts,
            Counts {
                evaluations: evaluations - 1,
                accepted: 10,
                rejected: 0
            }
        );
        integration.at(&mut system, 0.99 * end).unwrap();
        assert_eq!(integration.counts().evaluations, evaluations);
        drop(system);
        assert_eq!(calls, evaluations);
    }
}

#[test]
fn pairs_turn_as_angles_do() {
    let end = |step: f64| {
        let (mut system, (start, _)) = (pairs(Spinning), starts([4.0]));
        let mut integration = AdamsBashforthMoulton4::every(step)
            .start(&mut system, span(3.0, 3.0), start)
            .unwrap();
        while integration.time() < 3.0 {
            integration.advance(&mut system).unwrap();
        }
        let [pair] = *integration.state().pairs();
        assert!((pair[0].hypot(pair[1]) - 1.0).abs() < 4.0 * f64::EPSILON);
        pair
    };
    let exact = end(2.5e-4);
    let errors = [0.005, 0.0025].map(|step| distance(end(step), exact));
    let order = order((errors[0], errors[1]));
    assert!((order - 4.0).abs() < 0.3, "{order} {errors:?}");
}

/// Half the step at half the evaluations: with as many it is about as exact as the classical
/// method.
#[test]
fn it_is_as_exact_as_the_classical_method_for_as_many_evaluations() {
    let exact = [10.0_f64.cos(), -(10.0_f64.sin())];
    let multistep = {
        let mut integration = AdamsBashforthMoulton4::every(0.05)
            .start(&mut Spring, span(10.0, 10.0), [1.0, 0.0])
            .unwrap();
        while integration.time() < 10.0 {
            integration.advance(&mut Spring).unwrap();
        }
        (
            integration.counts().evaluations,
            distance(*integration.state(), exact),
        )
    };
    let classical = {
        let mut integration = Rk4::every(0.1)
            .start(&mut Spring, span(10.0, 10.0), [1.0, 0.0])
            .unwrap();
        while integration.time() < 10.0 {
            integration.advance(&mut Spring).unwrap();
        }
        (
            integration.counts().evaluations,
            distance(*integration.state(), exact),
        )
    };
    assert!(
        multistep.0 <= classical.0 + 8,
        "{multistep:?} {classical:?}"
    );
    assert!(
        multistep.1 < 1.5 * classical.1,
        "{multistep:?} {classical:?}"
    );
}

/// A correction of the size of the error after every step does not cost the order, nor an
/// evaluation.
#[test]
fn a_corrected_state_keeps_the_slopes_before() {
    let run = |is_corrected: bool| {
        let mut integration = AdamsBashforthMoulton4::every(0.05)
            .start(&mut Spring, span(10.0, 10.0), [1.0, 0.0])
            .unwrap();
        while integration.time() < 10.0 {
            integration.advance(&mut Spring).unwrap();
            if is_corrected {
                let [q, u] = *integration.state();
                let length = q.hypot(u);
                integration.replace([q / length, u / length]);
            }
        }
        let exact = [10.0_f64.cos(), -(10.0_f64.sin())];
        (
            integration.counts().evaluations,
            distance(*integration.state(), exact),
        )
    };
    let [plain, corrected] = [run(false), run(true)];
    assert_eq!(plain.0, corrected.0);
    assert!(
        corrected.1 < 1.5 * plain.1 && plain.1 < 1e-4,
        "{plain:?} {corrected:?}"
    );
}

/// What a run takes from [`crate::integrate::Method::error_model`]: with `z` half the angle
/// of a step, an angle is off by less than `|p|`.
#[test]
fn an_angle_is_off_by_less_than_the_length_of_euler_parameters() {
    let mut system = equation(|_, &[a, b]: &[f64; 2]| [-b, a]);
    let method = AdamsBashforthMoulton4::every(0.25);
    let mut integration = method
        .start(&mut system, span(25.0, 25.0), [1.0, 0.0])
        .unwrap();
    while integration.time() < 25.0 {
        integration.advance(&mut system).unwrap();
    }
    let [a, b] = *integration.state();
    let length = a.hypot(b) - 1.0;
    let (sine, cosine) = 25.0_f64.sin_cos();
    let angle = 2.0 * (b * cosine - a * sine).atan2(a * cosine + b * sine);
    let allowed = crate::integrate::Method::<f64>::error_model(&method).angle_error;
    assert!(
        angle.abs() < allowed * length.abs(),
        "{angle:e} {length:e} {}",
        angle / length
    );
}

#[test]
fn single_precision_and_faults() {
    let mut system = equation(|_: f32, &[y]: &[f32; 1]| [-y]);
    let span = TimeSpan {
        start: 0.0,
        end: 1.0,
        first_output: 1.0,
    };
    let mut integration = AdamsBashforthMoulton4::every(0.01_f32)
        .start(&mut system, span, [1.0])
        .unwrap();
    while integration.time() < 1.0 {
        integration.advance(&mut system).unwrap();
    }
    assert!((integration.state()[0] - (-1.0_f32).exp()).abs() < 1e-6);
    assert_eq!(integration.counts().evaluations, 3 * 4 + 97 * 2);

    /// Without rates from `t = 0.55` on.
    struct Until;
    impl System<f64> for Until {
        type State = [f64; 2];
        fn rates(&mut self, time: f64, state: &[f64; 2]) -> Result<[f64; 2], Fault> {
            if time > 0.55 {
                return Err(Fault::Analysis(AnalysisFault::NotDriven {
                    degrees_of_freedom: 1,
                }));
            }
            Ok(curved(time, state))
        }
        fn stage(
            &mut self,
            time: f64,
            state: &[f64; 2],
            rates: &mut [f64; 2],
        ) -> Result<(), Fault> {
            *rates = curved(time, state).map(|x| if time > 0.55 { f64::NAN } else { x });
            Ok(())
        }
    }
    let mut integration = AdamsBashforthMoulton4::every(0.1)
        .start(&mut Until, super::span(1.0, 1.0), curve(0.0))
        .unwrap();
    let fault = loop {
        if let Err(fault) = integration.advance(&mut Until) {
            break fault;
        }
    };
    assert!(
        matches!(fault, Fault::Analysis(AnalysisFault::NotDriven { .. })),
        "{fault}"
    );
    assert!((integration.time() - 0.5).abs() < 1e-15 && integration.counts().accepted == 5);
    assert!(distance(*integration.state(), curve(0.5)) < 1e-4);
}
