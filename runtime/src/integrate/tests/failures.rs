//! What integrators do when they cannot go on.

use super::*;
use crate::error::{NotFinite, StartFault, StepFault};

/// How an integration from 1 towards two seconds ends: the fault, and the last good time and state.
fn ended<I: Integrator<f64, Y>, Y: System<f64, State = [f64; 1]>>(
    method: I,
    system: &mut Y,
) -> (Fault, f64, [f64; 1]) {
    let mut integration = method.start(system, span(2.0, 2.0), [1.0]).unwrap();
    loop {
        if let Err(fault) = integration.advance(system) {
            return (fault, integration.time(), *integration.state());
        }
    }
}

#[test]
fn a_solution_that_blows_up_ends_with_an_underflow_of_the_step() {
    let mut system = equation(|_: f64, &[y]: &[f64; 1]| [y * y]);
    let (fault, time, [end]) = ended(DormandPrince::default(), &mut system);
    assert!(
        matches!(fault, Fault::Step(StepFault::SizeUnderflow { step, joint: None, .. }) if step < 1e-14)
    );
    assert!(time < 1.001 && time > 0.999 && end.is_finite() && end > 1e6);
    let (fault, time, [end]) = ended(Adams::default(), &mut system);
    assert!(
        matches!(fault, Fault::Step(StepFault::SizeUnderflow { step, joint: None, .. }) if step < 1e-14)
    );
    assert!(time < 1.001 && time > 0.999 && end.is_finite() && end > 1e6);
}

/// Rates that cannot be computed from `t = 1` on.
struct Cliff;

impl System<f64> for Cliff {
    type State = [f64; 1];

    fn rates(&mut self, time: f64, state: &[f64; 1]) -> Result<[f64; 1], Fault> {
        if time < 1.0 {
            Ok([-state[0]])
        } else {
            Err(Fault::Step(StepFault::RatesNotFinite {
                origin: NotFinite::Unknown,
            }))
        }
    }
}

#[test]
fn a_fault_leaves_the_last_good_state() {
    for (fault, time, [end]) in [
        ended(DormandPrince::default(), &mut Cliff),
        ended(Adams::default(), &mut Cliff),
    ] {
        assert!(matches!(
            fault,
            Fault::Step(StepFault::RatesNotFinite { .. })
        ));
        assert!(time < 1.0 && time > 1.0 - 1e-12);
        assert!((end - (-time).exp()).abs() < 1e-5);
    }

    let mut integration = Rk4::every(0.3)
        .start(&mut Cliff, span(2.0, 2.0), [1.0])
        .unwrap();
    while integration.advance(&mut Cliff).is_ok() {}
    assert!((integration.time() - 0.9).abs() < 1e-15);
    assert!((integration.state()[0] - (-integration.time()).exp()).abs() < 1e-3);
}

#[test]
fn rates_of_nan_leave_the_last_good_state() {
    let nan = |time: f64, &[y]: &[f64; 1]| [if time < 1.0 { -y } else { f64::NAN }];
    let mut system = equation(nan);
    let (fault, time, [end]) = ended(DormandPrince::default(), &mut system);
    assert!(
        matches!(fault, Fault::Step(StepFault::SizeUnderflow { .. }))
            && time < 1.0
            && end.is_finite()
    );
    let (fault, time, [end]) = ended(Adams::default(), &mut system);
    assert!(
        matches!(fault, Fault::Step(StepFault::SizeUnderflow { .. }))
            && time < 1.0
            && end.is_finite()
    );

    let mut state = [1.0];
    assert_eq!(
        Rk4.step(&mut system, 0.5, &mut state, 1.0),
        Err(Fault::Step(StepFault::StateNotFinite))
    );
    assert_eq!(state, [1.0]);
}

/// `y' = -y`; at one stage of a step, and there alone, the rate is not finite, or there is none.
/// Only [`System::rates`] says why.
struct Hole {
    /// Beyond this time.
    time: f64,
    /// What [`System::stage`] leaves there; nothing where it refuses.
    left: Option<f64>,
    /// Calls of both.
    calls: (usize, usize),
}

const WHY: Fault = Fault::Step(StepFault::RatesNotFinite {
    origin: NotFinite::Body("a body"),
});

impl System<f64> for Hole {
    type State = [f64; 1];

    fn rates(&mut self, time: f64, state: &[f64; 1]) -> Result<[f64; 1], Fault> {
        self.calls.1 += 1;
        if time > self.time {
            Err(WHY)
        } else {
            Ok([-state[0]])
        }
    }

    fn stage(&mut self, time: f64, state: &[f64; 1], rates: &mut [f64; 1]) -> Result<(), Fault> {
        self.calls.0 += 1;
        if time > self.time {
            *rates = [self.left.ok_or(Fault::Step(StepFault::StateNotFinite))?];
        } else {
            *rates = [-state[0]];
        }
        Ok(())
    }
}

#[test]
fn the_stage_that_is_not_finite_is_asked_why() {
    let left = [
        Some(f64::NAN),
        Some(f64::INFINITY),
        Some(-f64::INFINITY),
        None,
    ];
    // Stages of a step of 1 from 0: all of Dormand and Prince's, both of the classical method's,
    // and the start.
    for (left, time) in left
        .into_iter()
        .flat_map(|left| [-0.1, 0.0, 0.1, 0.25, 0.4, 0.6, 0.85, 0.95].map(|time| (left, time)))
    {
        let hole = || Hole {
            time,
            left,
            calls: (0, 0),
        };
        let mut state = [1.0];
        assert_eq!(Rk4.step(&mut hole(), 0.0, &mut state, 1.0), Err(WHY));
        assert_eq!(
            DormandPrince5.step(&mut hole(), 0.0, &mut state, 1.0),
            Err(WHY)
        );
        assert_eq!(state, [1.0]);
        if time < 0.0 {
            continue;
        }
        let mut system = hole();
        let mut integration = Rk4::every(1.0)
            .start(&mut system, span(2.0, 2.0), [1.0])
            .unwrap();
        assert_eq!(integration.advance(&mut system), Err(WHY));
        assert_eq!((integration.time(), *integration.state()), (0.0, [1.0]));
        // With control of the step it gets as near as steps resolve, and each trial is asked once.
        for (fault, reached, [end]) in [
            ended(DormandPrince::default(), &mut hole()),
            ended(Adams::default(), &mut hole()),
        ] {
            assert_eq!(fault, WHY);
            assert!(reached <= time && reached > time - 1e-12);
            assert!((end - (-reached).exp()).abs() < 1e-5);
        }
    }
}

#[test]
fn a_fault_that_says_why_is_not_asked_again() {
    let mut system = Hole {
        time: 0.1,
        left: Some(f64::NAN),
        calls: (0, 0),
    };
    let mut state = [1.0];
    assert_eq!(Rk4.step(&mut system, 0.0, &mut state, 1.0), Err(WHY));
    // Four stages, two again up to the first that is not finite, which is asked why.
    assert_eq!(system.calls, (6, 1));

    /// Says why at once.
    struct Told(usize);
    impl System<f64> for Told {
        type State = [f64; 1];
        fn rates(&mut self, _: f64, _: &[f64; 1]) -> Result<[f64; 1], Fault> {
            self.0 += 1;
            Err(WHY)
        }
    }
    let mut system = Told(0);
    assert_eq!(Rk4.step(&mut system, 0.0, &mut state, 1.0), Err(WHY));
    assert_eq!(system.0, 1);
}

#[test]
fn a_slope_for_output_that_is_not_finite_is_refused() {
    let mut system = Hole {
        time: 0.0,
        left: None,
        calls: (0, 0),
    };
    system.time = f64::INFINITY;
    let mut integration = Rk4::every(0.5)
        .start(&mut system, span(2.0, 2.0), [1.0])
        .unwrap();
    integration.advance(&mut system).unwrap();
    for left in [Some(f64::NAN), Some(f64::INFINITY), None] {
        (system.time, system.left) = (0.4, left);
        assert_eq!(integration.at(&mut system, 0.25), Err(WHY));
    }
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
            assert!(matches!(
                start,
                Err(Fault::Start(StartFault::Setting { .. }))
            ));
        }
        let start = Rk4::every(value).start(&mut system, span(1.0, 1.0), curve(0.0));
        assert!(matches!(
            start,
            Err(Fault::Start(StartFault::Setting { name: "step", .. }))
        ));
    }
}
