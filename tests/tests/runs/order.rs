//! Halving the step divides the error by 2 to the power of the order.

use holonom::prelude::*;
use holonom::{FixedStep, Integrator, Orientation, Scheme};
use holonom_models::HeavyTop;
use nalgebra::Vector4;

use crate::pendulum::{SWINGS, Swing, final_swing};

/// How far the slope of two errors may be from the order: the next term of the expansion, at the steps taken.
const SLACK: f64 = 0.25;

/// The observed orders of a method between steps that are halved.
fn orders(steps: [f64; 4], error: impl Fn(f64) -> f64) -> [f64; 3] {
    let errors = steps.map(error);
    println!("steps {steps:?}: errors {errors:?}");
    [0, 1, 2].map(|k| (errors[k] / errors[k + 1]).log2())
}

#[track_caller]
fn has_order(order: f64, observed: [f64; 3]) {
    println!("orders {observed:?}");
    for observed in observed {
        assert!(
            (observed - order).abs() <= SLACK,
            "{observed} is not {order}"
        );
    }
}

const fn halved(step: f64) -> [f64; 4] {
    [step, step / 2.0, step / 4.0, step / 8.0]
}

/// The error of the pendulum at an instant against the closed form: of angle and rate, the latter over the frequency of small
/// oscillations. The angle alone would not do, close to where the rod turns back.
fn of_the_pendulum<P: Orientation>(
    method: impl Formulation<f64>,
    integrator: impl Integrator<f64>,
    swing: Swing,
) -> f64 {
    const FREQUENCY: f64 = 3.8356;
    let [angle, rate] = final_swing::<_, _, P>(method, integrator, swing.time);
    (angle - swing.angle).hypot((rate - swing.rate) / FREQUENCY)
}

fn rk4<P: Orientation>(method: impl Formulation<f64>) {
    let error = |step| of_the_pendulum::<P>(method, Rk4::every(step), SWINGS[0]);
    has_order(4.0, orders(halved(1.0 / 128.0), error));
}

/// At 5 s: earlier the error of order 5 is so small that, with stabilising terms, that of order 6 hides it.
fn dormand_prince<P: Orientation>(method: impl Formulation<f64>) -> [f64; 3] {
    let error = |step| of_the_pendulum::<P>(method, DormandPrince::every(step), SWINGS[1]);
    orders(halved(1.0 / 50.0), error)
}

#[test]
fn rk4_has_order_4_on_the_pendulum() {
    rk4::<Normalised>(StandardLagrange);
    rk4::<Normalised>(Baumgarte::default());
    rk4::<Normalised>(AugmentedLagrangian::default());
    rk4::<Raw>(StandardLagrange);
}

#[test]
fn dormand_prince_has_order_5_on_the_pendulum() {
    has_order(5.0, dormand_prince::<Normalised>(StandardLagrange));
    has_order(5.0, dormand_prince::<Raw>(StandardLagrange));
    has_order(5.0, dormand_prince::<Normalised>(Baumgarte::default()));
    // Here the stabilising terms are so fast that the error of order 6 is the larger one at any step above round-off.
    let observed = dormand_prince::<Normalised>(AugmentedLagrangian::default());
    println!("orders {observed:?}");
    assert!(observed.iter().all(|&order| order >= 5.0 - SLACK));
}

/// The heavy top at 0.2 s: independent integrations (Gauss and DOP853 in minimal coordinates) agree to 14 digits.
const TOP: [f64; 4] = [
    -0.708_279_152_974_32,
    0.438_781_088_126_574,
    0.545_728_396_145_418,
    0.089_399_752_823_975_8,
];

/// The error of the top's Euler parameters, up to their sign.
fn of_the_top<K: Scheme<f64>>(every: impl Fn(f64) -> FixedStep<f64, K>, step: f64) -> f64 {
    let top = HeavyTop::default();
    let report = Simulation::new(&top, StandardLagrange, every(step))
        .run(
            0.0..=0.2,
            holonom::every(0.2),
            |_| ControlFlow::Continue(()),
        )
        .expect("solvable");
    let p = HeavyTop::pose(&report.state, HeavyTop::HANDLES.top).orientation;
    let p = Vector4::new(p.w, p.i, p.j, p.k);
    let reference = Vector4::from(TOP);
    (p - reference).norm().min((p + reference).norm())
}

#[test]
fn rk4_has_order_4_on_the_heavy_top() {
    has_order(
        4.0,
        orders(halved(1e-3), |step| of_the_top(Rk4::every, step)),
    );
}

#[test]
fn dormand_prince_has_order_5_on_the_heavy_top() {
    has_order(
        5.0,
        orders(halved(2e-3), |step| of_the_top(DormandPrince::every, step)),
    );
}
