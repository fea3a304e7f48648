//! The integrators against those of a crate that somebody else keeps, `differential-equations`: on
//! the pendulum of chapter 15 as one equation of second order.

#![forbid(unsafe_code)]

use differential_equations::linalg::Matrix;
use differential_equations::methods::{
    AdamsPredictorCorrector, BackwardDifferentiationFormula, ExplicitRungeKutta, ImplicitRungeKutta,
};
use differential_equations::prelude::{IVP, ODE};
use holonom::prelude::*;
use holonom::{
    Adams, AdamsBashforthMoulton4, Bdf, DormandPrince853, RadauIIA,
    integrate::{Advance as _, Integration as _, Integrator, System, TimeSpan},
};
use holonom_study::pendulum::RigidPendulum;

/// `phi'' = -w^2 sin(phi)` from the horizontal at rest, for ten seconds.
const PENDULUM: RigidPendulum = RigidPendulum::CHAPTER_15;
const END: f64 = 10.0;

fn rates(&[angle, rate]: &[f64; 2]) -> [f64; 2] {
    [rate, -PENDULUM.frequency().powi(2) * angle.sin()]
}

struct Swinging;

impl System<f64> for Swinging {
    type State = [f64; 2];

    fn rates(&mut self, _time: f64, state: &[f64; 2]) -> Result<[f64; 2], Fault> {
        Ok(rates(state))
    }
}

impl ODE<f64, [f64; 2]> for Swinging {
    fn diff(&self, _time: f64, state: &[f64; 2], slope: &mut [f64; 2]) {
        *slope = rates(state);
    }
}

/// Evaluations, and the error of the angle at the end (rad).
type Point = (f64, f64);

fn ours<I: Integrator<f64, Swinging>>(method: I) -> Point {
    let span = TimeSpan {
        start: 0.0,
        end: END,
        first_output: END,
    };
    let start = [PENDULUM.amplitude, 0.0];
    let mut integration = method.start(&mut Swinging, span, start).expect("a start");
    while integration.time() < END {
        integration
            .advance(&mut Swinging)
            .expect("a regular equation");
    }
    let error = integration.state()[0] - PENDULUM.at(END).angle;
    (integration.counts().evaluations as f64, error.abs())
}

/// By how much more evaluations ours take than theirs at equal errors, on average over the errors
/// that both reach: their points between ours, on logarithmic scales.
fn ratio(ours: &[Point], theirs: &[Point]) -> f64 {
    let mut logarithms = Vec::new();
    for &(evaluations, error) in theirs {
        for pair in ours.windows(2) {
            let [(some, large), (more, small)] = [pair[0], pair[1]];
            if (small..=large).contains(&error) {
                let part = (large / error).ln() / (large / small).ln();
                let needed = some.ln() + part * (more / some).ln();
                logarithms.push(needed - evaluations.ln());
            }
        }
    }
    assert!(
        logarithms.len() >= 4,
        "too few errors in common: {ours:?} {theirs:?}"
    );
    (logarithms.iter().sum::<f64>() / logarithms.len() as f64).exp()
}

fn tolerance(relative: f64) -> Tolerance<f64> {
    Tolerance {
        relative,
        absolute: 1e-3 * relative,
    }
}

/// Both at tolerances from a thousandth down.
macro_rules! compared {
    ($method:ident, $theirs:ident, $digits:expr) => {{
        let (mut own, mut others) = (Vec::new(), Vec::new());
        for digits in $digits {
            let relative = 10.0_f64.powi(-digits);
            own.push(ours($method::new(tolerance(relative))));
            let method = ExplicitRungeKutta::$theirs()
                .rtol(relative)
                .atol(1e-3 * relative);
            let start = [PENDULUM.amplitude, 0.0];
            let solution = IVP::ode(&Swinging, 0.0, END, start)
                .method(method)
                .solve()
                .expect("a solution");
            let (time, state) = solution.last().expect("an end");
            assert!((time - END).abs() < 1e-12);
            let error = state[0] - PENDULUM.at(END).angle;
            others.push((solution.evals.function as f64, error.abs()));
        }
        let ratio = ratio(&own, &others);
        println!("{own:?}\n{others:?}\nratio {ratio}");
        ratio
    }};
}

/// The most evaluations over those of the other crate.
const MOST: f64 = 1.3;

#[test]
fn dormand_and_prince_take_as_many_evaluations_as_elsewhere() {
    assert!(compared!(DormandPrince, dopri5, 3..=12) <= MOST);
}

#[test]
fn dormand_and_prince_of_order_eight_take_as_many_evaluations_as_elsewhere() {
    assert!(compared!(DormandPrince853, dop853, 4..=13) <= MOST);
}

/// Three reactions of rates 0.04, 1e4 and 3e7 for forty seconds: stiff.
struct Reacting;

const REACTED: f64 = 40.0;

/// After that time (Hairer and Wanner, test set).
const LEFT: [f64; 3] = [
    0.715_827_068_719_394,
    9.185_534_764_557_338e-6,
    0.284_163_745_745_841_3,
];

/// The largest relative error of the three.
fn mistaken(state: &[f64; 3]) -> f64 {
    let errors = state.iter().zip(LEFT).map(|(x, y)| (x / y - 1.0).abs());
    errors.fold(0.0, f64::max)
}

fn reactions(&[a, b, c]: &[f64; 3]) -> [f64; 3] {
    let (first, second) = (0.04 * a - 1e4 * b * c, 3e7 * b * b);
    [-first, first - second, second]
}

impl System<f64> for Reacting {
    type State = [f64; 3];

    fn rates(&mut self, _time: f64, state: &[f64; 3]) -> Result<[f64; 3], Fault> {
        Ok(reactions(state))
    }
}

impl ODE<f64, [f64; 3]> for Reacting {
    fn diff(&self, _time: f64, state: &[f64; 3], slope: &mut [f64; 3]) {
        *slope = reactions(state);
    }

    // Its differences are made for states of size 1.
    fn jacobian(&self, _time: f64, &[_, b, c]: &[f64; 3], matrix: &mut Matrix<f64>) {
        let rows = [
            [-0.04, 1e4 * c, 1e4 * b],
            [0.04, -1e4 * c - 6e7 * b, -1e4 * b],
            [0.0, 6e7 * b, 0.0],
        ];
        for (row, line) in rows.into_iter().enumerate() {
            for (column, value) in line.into_iter().enumerate() {
                matrix[(row, column)] = value;
            }
        }
    }
}

/// Both at tolerances from a thousandth down; a Jacobian counts as the evaluations that its
/// differences take.
macro_rules! compared_where_stiff {
    ($method:ident, $theirs:expr, $digits:expr) => {{
        let (mut own, mut others) = (Vec::new(), Vec::new());
        for digits in $digits {
            let relative = 10.0_f64.powi(-digits);
            let absolute = 1e-6 * relative;
            let span = TimeSpan {
                start: 0.0,
                end: REACTED,
                first_output: REACTED,
            };
            let start = [1.0, 0.0, 0.0];
            let method = $method::new(Tolerance { relative, absolute });
            let mut integration = method.start(&mut Reacting, span, start).expect("a start");
            while integration.time() < REACTED {
                integration
                    .advance(&mut Reacting)
                    .expect("a regular equation");
            }
            own.push((
                integration.counts().evaluations as f64,
                mistaken(integration.state()),
            ));
            let solution = IVP::ode(&Reacting, 0.0, REACTED, start)
                .method($theirs.rtol(relative).atol(absolute))
                .solve()
                .expect("a solution");
            let (_, state) = solution.last().expect("an end");
            let evals = solution.evals;
            let count = evals.function + 3 * evals.jacobian;
            others.push((count as f64, mistaken(state)));
        }
        let ratio = ratio(&own, &others);
        println!("{own:?}\n{others:?}\nratio {ratio}");
        ratio
    }};
}

#[test]
fn backward_differentiation_takes_as_many_evaluations_as_elsewhere() {
    // The first step that it chooses itself is too short for it to begin with.
    let theirs = || BackwardDifferentiationFormula::adaptive().h0(1e-6);
    assert!(compared_where_stiff!(Bdf, theirs(), 3..=10) <= MOST);
}

#[test]
fn radau_takes_as_many_evaluations_as_elsewhere() {
    let theirs = || ImplicitRungeKutta::radau5();
    assert!(compared_where_stiff!(RadauIIA, theirs(), 3..=11) <= MOST);
}

/// Their method is of order 4 throughout, with a step that changes.
#[test]
fn adams_takes_fewer_evaluations_than_a_method_of_one_order_elsewhere() {
    let (mut own, mut others) = (Vec::new(), Vec::new());
    for digits in 3..=12 {
        let relative = 10.0_f64.powi(-digits);
        own.push(ours(Adams::new(tolerance(relative))));
        let start = [PENDULUM.amplitude, 0.0];
        let solution = IVP::ode(&Swinging, 0.0, END, start)
            .method(AdamsPredictorCorrector::v4().tol(relative))
            .solve();
        let Ok(solution) = solution else { continue };
        let (_, state) = solution.last().expect("an end");
        let error = state[0] - PENDULUM.at(END).angle;
        others.push((solution.evals.function as f64, error.abs()));
    }
    println!("{own:?}\n{others:?}");
    let ratio = ratio(&own, &others);
    println!("ratio {ratio}");
    assert!(ratio <= 1.0, "{ratio}");
}

/// The same formulas after the same start: nothing but round-off between them.
#[test]
fn adams_bashforth_and_moulton_come_to_the_same_end_as_elsewhere() {
    for step in [0.0625, 0.03125] {
        let (evaluations, error) = ours(AdamsBashforthMoulton4::every(step));
        let start = [PENDULUM.amplitude, 0.0];
        let solution = IVP::ode(&Swinging, 0.0, END, start)
            .method(AdamsPredictorCorrector::f4(step))
            .solve()
            .expect("a solution");
        let (time, state) = solution.last().expect("an end");
        assert!((time - END).abs() < 1e-12);
        let theirs = (state[0] - PENDULUM.at(END).angle).abs();
        println!("{step}: {error:e} {theirs:e}");
        assert!(
            (error - theirs).abs() < 1e-9 * error,
            "{error:e} {theirs:e}"
        );
        assert!(evaluations < 2.0 * END / step + 7.0);
    }
}
