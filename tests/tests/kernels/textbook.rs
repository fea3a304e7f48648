//! Penalty and augmented Lagrangian equal their textbook forms, `(M + alpha D^T D) u' = ..`, which
//! lose digits as alpha grows: how many is printed.

use holonom::{
    AugmentedLagrangian, Formulation, Penalty, StateParts,
    dynamics::{Dynamics, Problem},
    state::Array,
};
use holonom_assembler::bodies::Orientation;
use holonom_assembler::formulation::{self, Evaluator};

use crate::comparison::{Worst, distance};
use crate::scene::{Scene, consistent, flat, state, states_to_try, values, violated};

/// Where both forms keep their digits.
const SOFT: f64 = 1e2;
/// What they may then differ by: the matrix of the textbook has a condition of the order
/// `alpha / J`, 1e5 for the thinnest body here.
const AGREEMENT: f64 = 1e-10;
/// The penalty of chapter 15.
const RIGID: f64 = 1e7;
/// What the textbook form may lose there: round-off times `alpha / J`, 1e10 for the thinnest body,
/// is the worst case, and hardly met.
const LOSS: f64 = 1e-5;
const OMEGA: f64 = 10.0;
const MU: f64 = 1.0;
/// Where both iterations end. The textbook form stalls a little below, in its round-off.
const TOLERANCE: f64 = 1e-11;
const ITERATIONS: usize = 200;

/// The largest deviations of accelerations and of multipliers.
fn deviation<M: Scene, F: Formulation<f64>>(
    method: F,
    textbook: formulation::Formulation,
) -> (f64, f64) {
    let scene = M::read_as(Orientation::Normalised);
    let dynamics = Dynamics::<Problem<M, F>>::new(&M::default(), method)
        .expect("acceptable")
        .absolute_coordinates();
    let mut evaluator = Evaluator::new(scene.clone(), textbook);
    let (mut accelerations, mut multipliers) = (Worst::default(), Worst::default());
    let mut states = consistent(&scene, states_to_try(), 5);
    states.extend(violated(&scene, states_to_try(), 6));
    for x in states {
        let x = x.as_slice();
        let (evaluation, _) = dynamics
            .evaluate(0.0, &state::<f64, M>(x))
            .expect("converges");
        let mut rates = vec![0.0; x.len()];
        evaluator.rates(0.0, x, &mut rates).expect("converges");
        let computed = flat::<f64, M>(&evaluation.rates);
        let first = evaluation.rates.coordinates().as_slice().len();
        let error = distance(&computed[first..], &rates[first..], 0.0);
        accelerations.take("u'", error, f64::MAX);
        let lambda = values(evaluation.multipliers.as_slice());
        let error = distance(&lambda, evaluator.multipliers().as_slice(), 0.0);
        multipliers.take("lambda", error, f64::MAX);
    }
    (accelerations.0, multipliers.0)
}

fn penalty<M: Scene>(alpha: f64) -> (f64, f64) {
    deviation::<M, _>(
        Penalty::new(alpha, OMEGA, MU),
        formulation::Formulation::Penalty {
            alpha,
            omega: OMEGA,
            mu: MU,
        },
    )
}

fn augmented<M: Scene>(alpha: f64) -> (f64, f64) {
    let method = AugmentedLagrangian {
        alpha,
        omega: OMEGA,
        mu: MU,
        tolerance: TOLERANCE,
        max_iterations: ITERATIONS,
        is_exact: false,
        radian: None,
    };
    deviation::<M, _>(
        method,
        formulation::Formulation::AugmentedLagrangian {
            alpha,
            omega: OMEGA,
            mu: MU,
            tolerance: TOLERANCE,
            max_iterations: ITERATIONS,
        },
    )
}

fn agree_where_soft<M: Scene>() {
    let (accelerations, multipliers) = penalty::<M>(SOFT);
    println!("penalty {SOFT:e}: u' {accelerations:e}, lambda {multipliers:e}");
    assert!(accelerations <= AGREEMENT && multipliers <= AGREEMENT);
    let (accelerations, multipliers) = augmented::<M>(SOFT);
    println!("augmented Lagrangian {SOFT:e}: u' {accelerations:e}, lambda {multipliers:e}");
    assert!(accelerations <= AGREEMENT && multipliers <= AGREEMENT);
}

fn the_loss_of_the_textbook_form<M: Scene>() {
    let (accelerations, multipliers) = penalty::<M>(RIGID);
    println!("penalty {RIGID:e}: u' {accelerations:e}, lambda {multipliers:e}");
    assert!(accelerations <= LOSS);
}

mod agree_where_soft {
    every_independent_mechanism! { agree_where_soft }
}

mod the_loss_of_the_textbook_form {
    every_independent_mechanism! { the_loss_of_the_textbook_form }
}
