//! The run-time assembler and the static matrices as systems that our integrators move.
//!
//! All of them see a state whose Euler parameters were scaled to length 1 before anything is
//! computed from it, the rates of the Euler parameters included: that is what gives the published
//! counts of evaluations.

use holonom::error::StepFault;
use holonom::{Fault, error::NotFinite, integrate::System};
use holonom_assembler::bodies::Orientation;
use holonom_assembler::formulation::{Evaluator, Formulation, SolveError};
use holonom_assembler::scenes;
use holonom_assembler::schur::SchurEvaluator;
use holonom_assembler::smatrix;
use holonom_study::chapter15::run::{Kind, Rival};
use holonom_study::chapter15::{Method, Settings};
use holonom_study::run::candidate;

/// `x = (r, p, v, w)` of one body: position (m, global), Euler parameters, velocity (m/s, global),
/// angular velocity (rad/s, body axes).
pub type State = [f64; 13];

/// The start of chapter 15: at rest, the rod along +y.
pub const START: State = {
    let mut state = [0.0; 13];
    state[1] = 0.5;
    state[3] = 1.0;
    state
};

/// The change of the accelerations at which the textbook form of the augmented Lagrangian stops.
///
/// The criterion of our own form, 1e-10, is beyond it: at `alpha = 1e7` the round-off of
/// `M + alpha D^T D` keeps the accelerations from coming to rest below about 1e-9.
const TEXTBOOK_TOLERANCE: f64 = 1e-8;

/// The state with Euler parameters of length 1.
#[inline]
fn unit(state: &State) -> State {
    let [_, _, _, e0, e1, e2, e3, ..] = *state;
    let scale = (e0 * e0 + e1 * e1 + e2 * e2 + e3 * e3).sqrt().recip();
    let mut unit = *state;
    for element in &mut unit[3..7] {
        *element *= scale;
    }
    unit
}

/// The pendulum of chapter 15 in the run-time assembler, textbook form.
#[derive(Clone, Debug)]
pub struct Textbook(Evaluator);

impl Textbook {
    /// The pendulum with a formulation of chapter 15.
    #[must_use]
    pub fn of(method: Method, settings: &Settings) -> Self {
        Self::new(formulation(method, settings))
    }

    /// The pendulum with a formulation.
    #[must_use]
    pub fn new(formulation: Formulation) -> Self {
        let scene = scenes::pendulum().with_orientation(Orientation::Raw);
        Self(Evaluator::new(scene, formulation))
    }
}

/// A formulation of chapter 15 as the assembler knows it.
pub(crate) fn formulation(method: Method, settings: &Settings) -> Formulation {
    let (alpha, omega, mu) = settings.penalty;
    match method {
        Method::Standard => Formulation::Standard,
        Method::Baumgarte => {
            let (alpha, beta) = settings.baumgarte;
            Formulation::Baumgarte { alpha, beta }
        }
        Method::Penalty => Formulation::Penalty { alpha, omega, mu },
        Method::AugmentedLagrangian => Formulation::AugmentedLagrangian {
            alpha,
            omega,
            mu,
            tolerance: TEXTBOOK_TOLERANCE,
            max_iterations: settings.iteration_cap,
        },
    }
}

impl System<f64> for Textbook {
    type State = State;

    fn rates(&mut self, time: f64, state: &State) -> Result<State, Fault> {
        let mut rates = [0.0; 13];
        match self.0.rates(time, &unit(state), &mut rates) {
            Ok(()) => Ok(rates),
            Err(error) => Err(fault(error, self.0.iterations())),
        }
    }
}

/// The pendulum of chapter 15 in the run-time assembler, multipliers from the Schur complement.
#[derive(Clone, Debug)]
pub struct Schur(SchurEvaluator);

impl Schur {
    /// The pendulum with Baumgarte's `a` and `b` (1/s), both zero for plain multipliers.
    #[must_use]
    pub fn new(a: f64, b: f64) -> Self {
        let scene = scenes::pendulum().with_orientation(Orientation::Raw);
        Self(SchurEvaluator::new(scene, a, b))
    }
}

impl System<f64> for Schur {
    type State = State;

    fn rates(&mut self, time: f64, state: &State) -> Result<State, Fault> {
        let mut rates = [0.0; 13];
        match self.0.rates(time, &unit(state), &mut rates) {
            Ok(()) => Ok(rates),
            Err(error) => Err(fault(error, 1)),
        }
    }
}

/// The pendulum of chapter 15 with static matrices, multipliers from the Schur complement.
#[derive(Clone, Debug)]
pub struct StaticSchur(smatrix::Pendulum);

/// The pendulum of chapter 15 with static matrices, elimination of the whole saddle system.
#[derive(Clone, Debug)]
pub struct StaticElimination(smatrix::Pendulum);

impl Default for StaticSchur {
    fn default() -> Self {
        Self(smatrix::Pendulum::chapter_15(Orientation::Raw))
    }
}

impl Default for StaticElimination {
    fn default() -> Self {
        Self(smatrix::Pendulum::chapter_15(Orientation::Raw))
    }
}

impl System<f64> for StaticSchur {
    type State = State;

    #[inline]
    fn rates(&mut self, time: f64, state: &State) -> Result<State, Fault> {
        let mut rates = [0.0; 13];
        match self.0.rates_schur(time, &unit(state), &mut rates) {
            Some(_) => Ok(rates),
            None => Err(Fault::Step(StepFault::RatesNotFinite {
                origin: NotFinite::Unknown,
            })),
        }
    }
}

impl System<f64> for StaticElimination {
    type State = State;

    #[inline]
    fn rates(&mut self, time: f64, state: &State) -> Result<State, Fault> {
        let mut rates = [0.0; 13];
        match self.0.rates_lu(time, &unit(state), &mut rates) {
            Some(_) => Ok(rates),
            None => Err(Fault::Step(StepFault::RatesNotFinite {
                origin: NotFinite::Unknown,
            })),
        }
    }
}

/// All baselines in all formulations of chapter 15, ready for the race.
#[must_use]
pub fn rivals(settings: &Settings) -> Vec<Rival<'static>> {
    let (span, integrator) = (settings.span(), settings.integrator());
    let mut rivals = Vec::new();
    for method in Method::ALL {
        let system = Textbook::of(method, settings);
        let candidate = candidate("assembler, whole matrix", system, integrator, span, START);
        rivals.push(Rival {
            method,
            kind: Kind::Assembler,
            candidate,
        });
    }
    let (alpha, beta) = settings.baumgarte;
    for (method, a, b) in [
        (Method::Standard, 0.0, 0.0),
        (Method::Baumgarte, alpha, beta),
    ] {
        let system = Schur::new(a, b);
        let candidate = candidate(
            "assembler, Schur complement",
            system,
            integrator,
            span,
            START,
        );
        rivals.push(Rival {
            method,
            kind: Kind::Assembler,
            candidate,
        });
    }
    let (method, kind) = (Method::Standard, Kind::StaticMatrices);
    rivals.extend(
        [
            candidate(
                "static matrices, Schur complement",
                StaticSchur::default(),
                integrator,
                span,
                START,
            ),
            candidate(
                "static matrices, whole matrix",
                StaticElimination::default(),
                integrator,
                span,
                START,
            ),
        ]
        .map(|candidate| Rival {
            method,
            kind,
            candidate,
        }),
    );
    rivals
}

fn fault(error: SolveError, iterations: usize) -> Fault {
    match error {
        SolveError::Singular => Fault::Step(StepFault::RatesNotFinite {
            origin: NotFinite::Unknown,
        }),
        SolveError::NotConverged => Fault::Step(StepFault::NotConverged {
            iterations: u32::try_from(iterations).unwrap_or(u32::MAX),
            residual: f64::NAN,
            joint: None,
            alpha: None,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::{START, Schur, State, StaticElimination, StaticSchur, Textbook};
    use holonom::integrate::System;
    use holonom_assembler::formulation::Formulation;
    use holonom_study::chapter15::{Method, Settings};
    use holonom_study::run::integrate;

    /// A consistent state: the rod an angle below the horizontal, turning.
    fn state(angle: f64, rate: f64) -> State {
        let (sine, cosine) = angle.sin_cos();
        let (half_sine, half_cosine) = (0.5 * angle).sin_cos();
        let mut x = [0.0; 13];
        x[1..3].copy_from_slice(&[0.5 * cosine, 0.5 * sine]);
        x[3..5].copy_from_slice(&[half_cosine, half_sine]);
        x[8..10].copy_from_slice(&[-0.5 * rate * sine, 0.5 * rate * cosine]);
        x[10] = rate;
        x
    }

    #[test]
    fn all_baselines_agree() {
        let x = state(-0.7, -3.0);
        let expected = Textbook::new(Formulation::Standard).rates(0.0, &x).unwrap();
        // The closed form: I phi'' = -m g d cos(theta), theta from the horizontal.
        assert!((expected[10] + 7.02 * 9.81 * 0.5 * 0.7_f64.cos() / 2.340_526_5).abs() < 1e-12);
        let others = [
            Schur::new(0.0, 0.0).rates(0.0, &x).unwrap(),
            StaticSchur::default().rates(0.0, &x).unwrap(),
            StaticElimination::default().rates(0.0, &x).unwrap(),
        ];
        for other in others {
            assert!(
                other
                    .iter()
                    .zip(&expected)
                    .all(|(a, b)| (a - b).abs() < 1e-12)
            );
        }
    }
    #[test]
    fn euler_parameters_of_any_length_mean_the_same() {
        let x = state(-0.7, -3.0);
        let mut long = x;
        long[3..7].iter_mut().for_each(|e| *e *= 1.1);
        let rates = |x| Textbook::new(Formulation::Standard).rates(0.0, x).unwrap();
        assert!(
            rates(&x)
                .iter()
                .zip(rates(&long))
                .all(|(a, b)| (a - b).abs() < 1e-12)
        );
    }

    #[test]
    fn penalty_and_augmented_lagrangian_take_the_published_evaluations() {
        let settings = Settings::TABLE_15_2;
        for method in [Method::Penalty, Method::AugmentedLagrangian] {
            let mut system = Textbook::of(method, &settings);
            let integrator = settings.integrator();
            let counts = integrate(&mut system, &integrator, settings.span(), START, |_, _| ());
            assert_eq!(
                counts.unwrap().evaluations as u64,
                method.published().evaluations
            );
        }
    }
}
