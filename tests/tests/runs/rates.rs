//! What the rates of Baumgarte's terms and of a penalty cost and gain, over the rate of the motion:
//! why `of` takes those that it takes.

use core::f64::consts::TAU;

use holonom::prelude::*;
use holonom::{DormandPrince853, Runs, constraints::Scales, state::Array};
use holonom_models::{
    Bricard, Door, HeavyTop, RodPendulum, SliderCrank, SqueezingMechanism, VariableLengthPendulum,
};

/// Rates over `1 / time`.
const RATES: [f64; 5] = [0.25, 0.5, 1.0, 2.0, 4.0];
/// Steps of a turn by a radian a `time`.
const STEPS: [f64; 3] = [50.0, 200.0, 1000.0];

/// The places of all bodies (m) at twenty times, and the evaluations.
fn places<M: Mechanism, F: Formulation<f64>, I: Runs<Problem<M, F>>>(
    (mechanism, end): (&M, f64),
    formulation: F,
    integrator: I,
    is_projected: bool,
) -> (Vec<f64>, f64) {
    let mut seen = Vec::new();
    let mut run = Simulation::new(mechanism, formulation, integrator).assembled();
    if is_projected {
        run = run.projection(Projection::default());
    }
    let report = run.run(0.0..=end, every(end / 20.0), |sample| {
        let q = sample.state().coordinates().as_slice();
        for body in M::REPORT.bodies {
            seen.extend_from_slice(&q[body.coordinate..][..3]);
        }
        ControlFlow::Continue(())
    });
    (seen, report.expect("solvable").evaluations as f64)
}

fn written(numbers: &[f64]) -> String {
    let numbers = numbers.iter().map(|number| format!("{number:.1e}"));
    numbers.collect::<Vec<_>>().join(" ")
}

/// The errors of the step control and its evaluations over those of standard multipliers, with
/// Baumgarte's terms of every rate; asserts what the guide says of fixed steps.
fn tried<M: Mechanism>(mechanism: &M, end: f64) {
    let scales = Scales::of(mechanism).expect("finite");
    let motion = (mechanism, end);
    let tight = DormandPrince853::new(Tolerance {
        relative: 1e-12,
        absolute: 1e-14 * scales.length,
    });
    let (reference, _) = places(motion, StandardLagrange, tight, true);
    let off = |found: &[f64]| {
        let pairs = found.iter().zip(&reference);
        let largest = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        largest / scales.length
    };
    let at = |rate: f64| Scales {
        time: scales.time / rate,
        ..scales
    };
    println!("{}", M::REPORT.name);
    for steps in STEPS {
        let h = TAU * scales.time / steps;
        let standard = off(&places(motion, StandardLagrange, Rk4::every(h), false).0);
        let terms = RATES.map(|rate| {
            let formulation = Baumgarte::with_scales(&at(rate)).at_step(h);
            off(&places(motion, formulation, Rk4::every(h), false).0)
        });
        let penalties = RATES.map(|rate| {
            let formulation = Penalty::with_scales(&at(rate)).at_step(h);
            off(&places(motion, formulation, Rk4::every(h), false).0)
        });
        println!(
            "  {steps:4} steps: standard {standard:.0e}, Baumgarte {}, penalty {}",
            written(&terms),
            written(&penalties)
        );
        let best = terms.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(terms[2] <= standard && terms[2] <= 8.0 * best);
        // Twice the rate is what `of` takes for a penalty.
        assert!(penalties[3] <= 1e-4_f64.max(1.1 * standard));
    }
    for tolerance in [1e-6, 1e-9] {
        let ode45 = || DormandPrince::new(Tolerance::of(mechanism, tolerance).expect("finite"));
        let (standard, evaluations) = places(motion, StandardLagrange, ode45(), false);
        let terms = RATES.map(|rate| {
            let formulation = Baumgarte::with_scales(&at(rate));
            let (found, taken) = places(motion, formulation, ode45(), false);
            (off(&found), taken / evaluations)
        });
        println!(
            "  {tolerance:.0e}: standard {:.0e}, Baumgarte {}, evaluations {}",
            off(&standard),
            written(&terms.map(|(error, _)| error)),
            written(&terms.map(|(_, taken)| taken))
        );
        assert!(terms[2].0 <= 1.5 * off(&standard) && terms[2].1 < 2.0);
        assert!(terms[4].1 > terms[2].1);
    }
}

#[test]
fn the_rate_of_the_motion_is_a_good_one() {
    tried(&RodPendulum::default(), 10.0);
    tried(&SqueezingMechanism::default(), 0.03);
    tried(&HeavyTop::default(), 1.0);
    tried(&VariableLengthPendulum::default(), 5.0);
    tried(&SliderCrank::default(), 0.2);
    tried(&Bricard::default(), 10.0);
    tried(&Door::default(), 10.0);
}
