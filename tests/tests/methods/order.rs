//! Halving the step divides the error by 2 to the power of the order.

use holonom::prelude::*;
use holonom::{
    Adams, AdamsBashforthMoulton4, Bdf, BogackiShampine, DormandPrince853, Heun, ImplicitMidpoint,
    Kutta3, Midpoint, RadauIIA, Runs, SemiImplicitEuler,
};
use holonom_models::{HeavyTop, RodPendulum};
use nalgebra::Vector4;

use crate::pendulum::{SWINGS, Swing, final_swing};

/// How far the slope of two errors may be from the order: the next term of the expansion, at the
/// steps taken.
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

/// The error of the pendulum at an instant against the closed form: of angle and rate, the latter
/// over the frequency of small oscillations. The angle alone would not do, close to where the rod
/// turns back.
fn of_the_pendulum<F: Formulation<f64>>(
    method: F,
    integrator: impl Runs<Problem<RodPendulum, F>>,
    swing: Swing,
) -> f64 {
    const FREQUENCY: f64 = 3.8356;
    let [angle, rate] = final_swing(method, integrator, swing.time);
    (angle - swing.angle).hypot((rate - swing.rate) / FREQUENCY)
}

fn rk4(method: impl Formulation<f64>) {
    let error = |step| of_the_pendulum(method, Rk4::every(step), SWINGS[0]);
    has_order(4.0, orders(halved(1.0 / 128.0), error));
}

/// At 5 s: earlier the error of order 5 is so small that, with stabilising terms, that of order 6
/// hides it.
fn dormand_prince(method: impl Formulation<f64>) -> [f64; 3] {
    let error = |step| of_the_pendulum(method, DormandPrince::every(step), SWINGS[1]);
    orders(halved(1.0 / 50.0), error)
}

#[test]
fn rk4_has_order_4_on_the_pendulum() {
    rk4(StandardLagrange);
    rk4(Baumgarte::default());
    rk4(AugmentedLagrangian::default());
}

#[test]
fn dormand_prince_has_order_5_on_the_pendulum() {
    has_order(5.0, dormand_prince(StandardLagrange));
    has_order(5.0, dormand_prince(Baumgarte::default()));
    // Here the stabilising terms are so fast that the error of order 6 is the larger one at any
    // step above round-off.
    let observed = dormand_prince(AugmentedLagrangian::default());
    println!("orders {observed:?}");
    assert!(observed.iter().all(|&order| order >= 5.0 - SLACK));
}

/// The heavy top at 0.2 s: independent integrations (Gauss and DOP853 in minimal coordinates) agree
/// to 14 digits.
const TOP: [f64; 4] = [
    -0.708_279_152_974_32,
    0.438_781_088_126_574,
    0.545_728_396_145_418,
    0.089_399_752_823_975_8,
];

/// The error of the top's Euler parameters, up to their sign.
fn of_the_top(integrator: impl Runs<Problem<HeavyTop, StandardLagrange>>) -> f64 {
    top_and_steps(integrator).0
}

/// The same with the steps that it took.
fn top_and_steps(integrator: impl Runs<Problem<HeavyTop, StandardLagrange>>) -> (f64, usize) {
    let top = HeavyTop::default();
    let report = Simulation::new(&top, StandardLagrange, integrator)
        .run(
            0.0..=0.2,
            holonom::every(0.2),
            |_| ControlFlow::Continue(()),
        )
        .expect("solvable");
    let p = HeavyTop::pose(&report.state, HeavyTop::HANDLES.top).orientation;
    let p = Vector4::new(p.w, p.i, p.j, p.k);
    let reference = Vector4::from(TOP);
    let error = (p - reference).norm().min((p + reference).norm());
    (error, report.accepted)
}

#[test]
fn rk4_has_order_4_on_the_heavy_top() {
    has_order(
        4.0,
        orders(halved(1e-3), |step| of_the_top(Rk4::every(step))),
    );
}

#[test]
fn dormand_prince_has_order_5_on_the_heavy_top() {
    has_order(
        5.0,
        orders(halved(2e-3), |step| of_the_top(DormandPrince::every(step))),
    );
}

/// A method of fixed steps on both, from these steps (s) on.
macro_rules! has_its_order_on_both {
    ($method:ident, $order:literal, $of_pendulum:expr, $of_top:expr) => {{
        let swing = |step| of_the_pendulum(StandardLagrange, $method::every(step), SWINGS[1]);
        has_order($order, orders(halved($of_pendulum), swing));
        let top = |step| of_the_top($method::every(step));
        has_order($order, orders(halved($of_top), top));
    }};
}

#[test]
fn methods_of_fixed_steps_have_their_order_on_the_pendulum_and_on_the_heavy_top() {
    has_its_order_on_both!(SemiImplicitEuler, 1.0, 1.0 / 4096.0, 1e-5);
    has_its_order_on_both!(Midpoint, 2.0, 1.0 / 1024.0, 1e-4);
    has_its_order_on_both!(Heun, 2.0, 1.0 / 1024.0, 1e-4);
    has_its_order_on_both!(ImplicitMidpoint, 2.0, 1.0 / 512.0, 1e-4);
    has_its_order_on_both!(Kutta3, 3.0, 1.0 / 512.0, 1e-4);
    has_its_order_on_both!(BogackiShampine, 3.0, 1.0 / 512.0, 1e-4);
    // Of the pendulum its error of order 4 is so small that those of order 5 and of the start take
    // turns with it.
    let swing = |step| {
        let method = AdamsBashforthMoulton4::every(step);
        of_the_pendulum(StandardLagrange, method, SWINGS[0])
    };
    let observed: f64 = orders(halved(1.0 / 256.0), swing).iter().sum();
    assert!(observed / 3.0 > 4.0 - SLACK, "{observed}");
    let top = |step| of_the_top(AdamsBashforthMoulton4::every(step));
    has_order(4.0, orders(halved(1e-4), top));
}

/// Its coefficients are small: two steps above round-off, and the orders behind it show.
#[test]
fn dormand_prince_has_order_8_on_the_pendulum_and_on_the_heavy_top() {
    let swing = |step| of_the_pendulum(StandardLagrange, DormandPrince853::every(step), SWINGS[1]);
    let top = |step| of_the_top(DormandPrince853::every(step));
    let errors = [[0.1, 0.05].map(swing), [4e-3, 2e-3].map(top)];
    println!("{errors:?}");
    for [coarse, fine] in errors {
        assert!((coarse / fine).log2() > 8.0 - 2.0 * SLACK, "{errors:?}");
    }
}

fn tolerance(relative: f64) -> Tolerance<f64> {
    Tolerance {
        relative,
        absolute: 1e-3 * relative,
    }
}

/// The order at which errors fall with the number of steps.
fn order_of_steps<I: Runs<Problem<HeavyTop, StandardLagrange>>>(
    method: impl Fn(f64) -> I,
    tolerances: [f64; 2],
) -> f64 {
    let [(coarse, few), (fine, many)] = tolerances.map(|relative| top_and_steps(method(relative)));
    println!("{few} steps {coarse:e}, {many} steps {fine:e}");
    (coarse / fine).ln() / (many as f64 / few as f64).ln()
}

#[test]
fn methods_with_control_of_steps_have_their_order_on_the_heavy_top() {
    /// Steps are no fixed part of the tolerance.
    const LOOSE: f64 = 0.8;
    let orders = [
        (
            3.0,
            order_of_steps(|x| BogackiShampine::new(tolerance(x)), [1e-5, 1e-8]),
        ),
        (
            5.0,
            order_of_steps(|x| DormandPrince::new(tolerance(x)), [1e-6, 1e-10]),
        ),
        (
            8.0,
            order_of_steps(|x| DormandPrince853::new(tolerance(x)), [1e-6, 1e-11]),
        ),
        (
            5.0,
            order_of_steps(|x| RadauIIA::new(tolerance(x)), [1e-5, 1e-9]),
        ),
    ];
    println!("{orders:?}");
    for (order, observed) in orders {
        assert!(observed > order - LOOSE, "{observed} is not {order}");
    }
}

/// A tolerance a thousand times smaller is an error a hundred times smaller at least, by orders
/// that go along with it.
#[test]
fn methods_of_many_orders_follow_their_tolerance_on_the_heavy_top() {
    let adams = |relative| top_and_steps(Adams::new(tolerance(relative)));
    let bdf = |relative| top_and_steps(Bdf::new(tolerance(relative)));
    let ends = [[1e-5, 1e-8, 1e-11].map(adams), [1e-4, 1e-7, 1e-10].map(bdf)];
    println!("{ends:?}");
    for [(a, _), (b, _), (c, _)] in ends {
        assert!(a > 100.0 * b && b > 100.0 * c, "{ends:?}");
    }
}
