//! What integrators do when they cannot go on.

use super::*;
use crate::NotFinite;

#[test]
fn a_solution_that_blows_up_ends_with_an_underflow_of_the_step() {
    let mut system = equation(|_: f64, &[y]: &[f64; 1]| [y * y]);
    let mut course = DormandPrince::<f64>::default()
        .start(&mut system, span(2.0, 2.0), [1.0])
        .unwrap();
    let fault = loop {
        if let Err(fault) = course.advance(&mut system) {
            break fault;
        }
    };
    assert!(matches!(fault, Fault::StepSizeUnderflow { step, joint: None, .. } if step < 1e-14));
    assert!(course.time() < 1.001 && course.time() > 0.999);
    assert!(course.state()[0].is_finite() && course.state()[0] > 1e6);
}

/// Rates that cannot be computed from `t = 1` on.
struct Cliff;

impl System<f64> for Cliff {
    type State = [f64; 1];

    fn rates(&mut self, time: f64, state: &[f64; 1]) -> Result<[f64; 1], Fault> {
        if time < 1.0 {
            Ok([-state[0]])
        } else {
            Err(Fault::RatesNotFinite {
                origin: NotFinite::Unknown,
            })
        }
    }
}

#[test]
fn a_fault_leaves_the_last_good_state() {
    let mut course = DormandPrince::<f64>::default()
        .start(&mut Cliff, span(2.0, 2.0), [1.0])
        .unwrap();
    let fault = loop {
        if let Err(fault) = course.advance(&mut Cliff) {
            break fault;
        }
    };
    assert!(matches!(fault, Fault::RatesNotFinite { .. }));
    assert!(course.time() < 1.0 && course.time() > 1.0 - 1e-12);
    assert!((course.state()[0] - (-course.time()).exp()).abs() < 1e-5);

    let mut course = Rk4::every(0.3)
        .start(&mut Cliff, span(2.0, 2.0), [1.0])
        .unwrap();
    while course.advance(&mut Cliff).is_ok() {}
    assert!((course.time() - 0.9).abs() < 1e-15);
    assert!((course.state()[0] - (-course.time()).exp()).abs() < 1e-3);
}

#[test]
fn rates_of_nan_leave_the_last_good_state() {
    let nan = |time: f64, &[y]: &[f64; 1]| [if time < 1.0 { -y } else { f64::NAN }];
    let mut system = equation(nan);
    let mut course = DormandPrince::<f64>::default()
        .start(&mut system, span(2.0, 2.0), [1.0])
        .unwrap();
    let fault = loop {
        if let Err(fault) = course.advance(&mut system) {
            break fault;
        }
    };
    assert!(matches!(fault, Fault::StepSizeUnderflow { .. }));
    assert!(course.time() < 1.0 && course.state()[0].is_finite());

    let mut state = [1.0];
    assert_eq!(
        Rk4.step(&mut system, 0.5, &mut state, 1.0),
        Err(Fault::StateNotFinite)
    );
    assert_eq!(state, [1.0]);
}

#[test]
fn settings_that_are_not_positive_are_refused() {
    let mut system = equation(curved);
    for value in [0.0, -1e-6, f64::NAN, f64::INFINITY] {
        for tolerance in [
            Tolerance {
                relative: value,
                absolute: 1e-9,
            },
            Tolerance {
                relative: 1e-6,
                absolute: value,
            },
        ] {
            let start =
                DormandPrince::new(tolerance).start(&mut system, span(1.0, 1.0), curve(0.0));
            assert!(matches!(start, Err(Fault::Setting { .. })));
        }
        let start = Rk4::every(value).start(&mut system, span(1.0, 1.0), curve(0.0));
        assert!(matches!(start, Err(Fault::Setting { name: "step", .. })));
    }
}
