//! The implicit midpoint rule.

use super::{Equation, Spring, curve, curved, distance, equation, errors, order, span};
use crate::Fault;
use crate::error::{AnalysisFault, StepFault};
use crate::integrate::{
    Advance as _, ImplicitMidpoint, Integration as _, Integrator as _, NoStages, OneStep as _,
    Slopes, StepStart, System,
};
use crate::state::JointState;

#[test]
fn it_has_order_two_at_and_within_steps() {
    let [coarse, fine] = [0.02, 0.01].map(|step| errors(ImplicitMidpoint::every(step)));
    let orders = [order((coarse.0, fine.0)), order((coarse.1, fine.1))];
    assert!(
        orders.iter().all(|order| (order - 2.0).abs() < 0.1),
        "{orders:?}"
    );
}

/// Problem C03, where RK4 leaves nothing of `|p|` at 1000 rad/s.
#[test]
fn euler_parameters_keep_their_length() {
    for speed in [10.0, 100.0, 1000.0] {
        let half = 0.5 * speed;
        let mut system =
            equation(|_, &[a, b, c, d]: &[f64; 4]| [-half * b, half * a, half * d, -half * c]);
        let mut p = [0.6, 0.0, 0.8, 0.0];
        for _ in 0..10_000 {
            ImplicitMidpoint
                .step(&mut system, 0.0, &mut p, 1e-3)
                .unwrap();
        }
        let square: f64 = p.iter().map(|e| e * e).sum();
        assert!((square - 1.0).abs() < 1e-12, "{:e}", square - 1.0);
    }
}

#[test]
fn the_energy_of_a_spring_stays() {
    let mut state = [1.0, 0.0];
    for _ in 0..10_000 {
        ImplicitMidpoint
            .step(&mut Spring, 0.0, &mut state, 0.1)
            .unwrap();
    }
    let energy = state[0] * state[0] + state[1] * state[1];
    assert!((energy - 1.0).abs() < 1e-13, "{:e}", energy - 1.0);
}

/// `angle'' = -9.81 sin(angle)`, the angle as a pair.
struct Pendulum;

impl System<f64> for Pendulum {
    type State = JointState<f64, 1, 0, 1>;

    fn rates(&mut self, _time: f64, state: &Self::State) -> Result<Self::State, Fault> {
        let ([[_, sine]], [rate]) = (*state.pairs(), *state.rates());
        Ok(JointState::from_parts([[rate, 0.0]], [], [-9.81 * sine]))
    }
}

#[test]
fn a_way_back_leads_to_the_start() {
    fn step<Y: System<f64>>(system: &mut Y, state: &Y::State, step: f64) -> Y::State {
        let slope = &system.rates(0.0, state).unwrap();
        let start = StepStart {
            time: 0.0,
            state,
            slope,
        };
        ImplicitMidpoint
            .advanced(&mut Slopes::new(system), start, step, &mut NoStages)
            .unwrap()
    }
    let start = JointState::from_parts([[2.0_f64.cos(), 2.0_f64.sin()]], [], [0.3]);
    let mut forward = start;
    for _ in 0..1000 {
        forward = step(&mut Pendulum, &forward, 0.02);
    }
    let energy = |state: &JointState<f64, 1, 0, 1>| {
        0.5 * state.rates()[0].powi(2) - 9.81 * state.pairs()[0][0]
    };
    // No invariant of the method, but of order h^2 off it at all times.
    assert!((energy(&forward) - energy(&start)).abs() < 0.05);
    let mut back = forward;
    for _ in 0..1000 {
        back = step(&mut Pendulum, &back, -0.02);
    }
    let [[rate], [wanted]] = [*back.rates(), *start.rates()];
    assert!((rate - wanted).abs() < 1e-11, "{:e}", rate - wanted);
    assert!(distance(back.pairs()[0], start.pairs()[0]) < 1e-11);
    // With the velocity turned round it goes the same way back.
    let mut mirrored = JointState::from_parts(*forward.pairs(), [], forward.rates().map(|u| -u));
    for _ in 0..1000 {
        mirrored = step(&mut Pendulum, &mirrored, 0.02);
    }
    assert!((mirrored.rates()[0] + wanted).abs() < 1e-11);
    assert!(distance(mirrored.pairs()[0], start.pairs()[0]) < 1e-11);
}

#[test]
fn iterations_are_few_and_counted() {
    let run = |step: f64| {
        let mut system = equation(curved);
        let mut integration = ImplicitMidpoint::every(step)
            .start(&mut system, span(2.0, 2.0), curve(0.0))
            .unwrap();
        while integration.time() < 2.0 {
            integration.advance(&mut system).unwrap();
        }
        let counts = integration.counts();
        counts.evaluations as f64 / counts.accepted as f64
    };
    let [short, long] = [run(0.01), run(0.2)];
    assert!((5.0..10.0).contains(&short), "{short}");
    assert!((12.0..22.0).contains(&long), "{long}");
}

#[test]
fn a_step_too_long_for_the_iteration_is_refused() {
    let decay = |rate: f64| equation(move |_: f64, &[y]: &[f64; 1]| [-rate * y]);
    let mut state = [1.0];
    ImplicitMidpoint
        .step(&mut decay(1.0), 0.0, &mut state, 1.0)
        .unwrap();
    assert!((state[0] - 1.0 / 3.0).abs() < 1e-15);
    for rate in [1.95, 2.0, 2.5, 1e6, 1e30] {
        let mut state = [1.0];
        let refused = ImplicitMidpoint.step(&mut decay(rate), 0.0, &mut state, 1.0);
        let Err(Fault::Step(StepFault::NoFixedPoint { step, iterations })) = refused else {
            panic!("{rate}: {refused:?} {state:?}");
        };
        assert!(step == 1.0 && iterations <= 100 && state == [1.0]);
    }
    // One that decays critically converges although its changes grow at first.
    let mut system = equation(|_: f64, &[q, u]: &[f64; 2]| [u, -q - 2.0 * u]);
    let mut state = [1.0, 0.0];
    ImplicitMidpoint
        .step(&mut system, 0.0, &mut state, 1.2)
        .unwrap();
    // Positions and velocities of different sizes, and one element that is nothing but round-off.
    let mut system = equation(|_: f64, &[q, u, noise]: &[f64; 3]| {
        [u, -1e4 * q, 1e-17 * (1e20 * q + noise).sin()]
    });
    let mut state = [1.0, 0.0, 0.0];
    ImplicitMidpoint
        .step(&mut system, 0.0, &mut state, 5e-3)
        .unwrap();
    assert!((state[0] - (1.0 - 0.0625) / (1.0 + 0.0625)).abs() < 1e-15);
}

#[test]
fn where_rates_end_the_system_says_why() {
    struct Until(f64);
    impl System<f64> for Until {
        type State = [f64; 1];
        fn rates(&mut self, time: f64, state: &[f64; 1]) -> Result<[f64; 1], Fault> {
            if time > self.0 {
                Err(Fault::Analysis(AnalysisFault::NotDriven {
                    degrees_of_freedom: 1,
                }))
            } else {
                Ok([-state[0]])
            }
        }
        fn stage(
            &mut self,
            time: f64,
            state: &[f64; 1],
            rates: &mut [f64; 1],
        ) -> Result<(), Fault> {
            *rates = [if time > self.0 { f64::NAN } else { -state[0] }];
            Ok(())
        }
    }
    let mut state = [1.0];
    let refused = ImplicitMidpoint.step(&mut Until(0.04), 0.0, &mut state, 0.1);
    assert!(
        matches!(
            refused,
            Err(Fault::Analysis(AnalysisFault::NotDriven { .. }))
        ) && state == [1.0]
    );
    let refused = ImplicitMidpoint.step(&mut Until(-1.0), 0.0, &mut state, 0.1);
    assert!(
        matches!(
            refused,
            Err(Fault::Analysis(AnalysisFault::NotDriven { .. }))
        ) && state == [1.0]
    );
    let mut system: Equation<'_, _, 1> = equation(|_: f32, &[y]: &[f32; 1]| [-y]);
    let mut single = [1.0];
    ImplicitMidpoint
        .step(&mut system, 0.0, &mut single, 0.1)
        .unwrap();
    assert!((single[0] - 0.95 / 1.05).abs() < 1e-6);
}
