//! The integrators against those of a crate that somebody else keeps, `differential-equations`: on the pendulum of chapter 15 as one equation of second order.

#![forbid(unsafe_code)]

use differential_equations::methods::ExplicitRungeKutta;
use differential_equations::prelude::{IVP, ODE};
use holonom::prelude::*;
use holonom::{Course as _, DormandPrince853, Integrator, Span, System};
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

fn ours<I: Integrator<f64>>(method: I) -> Point {
    let span = Span {
        start: 0.0,
        end: END,
        first_output: END,
    };
    let start = [PENDULUM.amplitude, 0.0];
    let mut course = method.start(&mut Swinging, span, start).expect("a start");
    while course.time() < END {
        course.advance(&mut Swinging).expect("a regular equation");
    }
    let error = course.state()[0] - PENDULUM.at(END).angle;
    (course.counts().evaluations as f64, error.abs())
}

/// By how much more evaluations ours take than theirs at equal errors, on average over the errors that both reach: their points between ours, on logarithmic scales.
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
