//! The textbook forms against the one saddle system that stands for all four.

use nalgebra::DVector;

use super::ORIENTATIONS;
use crate::accuracy::{assert_close, largest_error};
use crate::assembler::Assembler;
use crate::formulation::{Evaluator, Formulation, SolveError};
use crate::saddle::Coefficients;
use crate::scenes;
use crate::schur::SchurEvaluator;
use crate::smatrix::Pendulum;
use crate::states::{Spread, generator, make_consistent, random_state};

/// The values of chapter 15.
const ALPHA: f64 = 1e7;
const OMEGA: f64 = 10.0;
const MU: f64 = 1.0;

/// Accelerations and multipliers of a formulation.
fn solve(scene: &Assembler, formulation: Formulation, x: &[f64]) -> (Vec<f64>, DVector<f64>) {
    let mut evaluator = Evaluator::new(scene.clone(), formulation);
    let mut out = vec![0.0; x.len()];
    // Twice, so that what the first call leaves behind shows.
    for _ in 0..2 {
        evaluator.rates(0.0, x, &mut out).expect("solvable");
    }
    let rates = scene.coordinate_rates(x);
    assert_close("q'", &out[..scene.coordinates()], rates.as_slice(), 0.0);
    (
        out.split_off(scene.coordinates()),
        evaluator.multipliers().clone(),
    )
}

#[test]
fn textbook_forms_equal_the_saddle_system() {
    let mut rng = generator(3);
    for orientation in ORIENTATIONS {
        let scene = scenes::chain(3).with_orientation(orientation);
        for _ in 0..20 {
            let x = random_state(&scene, Spread::default(), &mut rng);
            let x = x.as_slice();
            let cases = [
                (Formulation::Standard, 0.0, 1e-11),
                (
                    Formulation::Baumgarte {
                        alpha: 5.0,
                        beta: 7.0,
                    },
                    0.0,
                    1e-11,
                ),
                // The textbook matrix loses digits: alpha / m times rounding.
                (
                    Formulation::Penalty {
                        alpha: ALPHA,
                        omega: OMEGA,
                        mu: MU,
                    },
                    1.0 / ALPHA,
                    1e-6,
                ),
            ];
            for (formulation, eps, tolerance) in cases {
                let (a, b) = formulation.stabilisation();
                let reference = scene
                    .solve_saddle(x, Coefficients { a, b, eps }, None)
                    .expect("independent rows");
                let (accelerations, lambda) = solve(&scene, formulation, x);
                let what = format!("{formulation:?}");
                assert_close(
                    &what,
                    &accelerations,
                    reference.accelerations.as_slice(),
                    tolerance,
                );
                let limit = tolerance.max(1e-10);
                assert_close(
                    &what,
                    lambda.as_slice(),
                    reference.multipliers.as_slice(),
                    limit,
                );
            }
        }
    }
}

#[test]
fn augmented_lagrangian_equals_the_iterated_saddle_system() {
    let scene = scenes::chain(3);
    let mut rng = generator(4);
    let x = random_state(&scene, Spread::default(), &mut rng);
    let x = x.as_slice();
    let alpha = 1e3;
    let formulation = |max_iterations| Formulation::AugmentedLagrangian {
        alpha,
        omega: OMEGA,
        mu: MU,
        tolerance: 0.0,
        max_iterations,
    };
    let coefficients = Coefficients {
        a: OMEGA * MU,
        b: OMEGA,
        eps: 1.0 / alpha,
    };
    let mut previous = DVector::zeros(scene.equations());
    for iterations in 1..6 {
        let reference = scene
            .solve_saddle(x, coefficients, Some(&previous))
            .expect("eps is positive");
        previous.copy_from(&reference.multipliers);
        let mut evaluator = Evaluator::new(scene.clone(), formulation(iterations));
        let mut out = vec![0.0; x.len()];
        let result = evaluator.rates(0.0, x, &mut out);
        assert_eq!(result, Err(SolveError::NotConverged));
        assert_eq!(evaluator.iterations(), iterations);
        let ours = &out[scene.coordinates()..];
        assert_close("u'", ours, reference.accelerations.as_slice(), 1e-9);
        let lambda = evaluator.multipliers().as_slice();
        assert_close("lambda", lambda, reference.multipliers.as_slice(), 1e-9);
    }
}

#[test]
fn augmented_lagrangian_comes_to_the_baumgarte_solution() {
    let scene = scenes::pendulum();
    let mut rng = generator(5);
    let x = random_state(&scene, Spread::default(), &mut rng);
    let x = x.as_slice();
    let augmented = Formulation::AugmentedLagrangian {
        alpha: ALPHA,
        omega: OMEGA,
        mu: MU,
        tolerance: 1e-7,
        max_iterations: 10,
    };
    let baumgarte = Formulation::Baumgarte {
        alpha: OMEGA * MU,
        beta: OMEGA,
    };
    let (left, lambda_left) = solve(&scene, augmented, x);
    let (right, lambda_right) = solve(&scene, baumgarte, x);
    assert_close("u'", &left, &right, 1e-7);
    assert_close(
        "lambda",
        lambda_left.as_slice(),
        lambda_right.as_slice(),
        1e-5,
    );
}

#[test]
fn schur_and_static_forms_equal_the_dense_ones() {
    let mut rng = generator(6);
    for orientation in ORIENTATIONS {
        let scene = scenes::pendulum().with_orientation(orientation);
        let fixed = Pendulum::chapter_15(orientation);
        let mut schur = SchurEvaluator::new(scene.clone(), 0.0, 0.0);
        let spread = Spread {
            norm: 0.01,
            ..Spread::default()
        };
        for _ in 0..20 {
            let x = random_state(&scene, spread, &mut rng);
            let x: [f64; 13] = x.as_slice().try_into().expect("13 states");
            let mut dense = Evaluator::new(scene.clone(), Formulation::Standard);
            let mut reference = [0.0; 13];
            dense.rates(0.0, &x, &mut reference).expect("solvable");
            let lambda = dense.multipliers().as_slice();

            let mut out = [0.0; 13];
            schur.rates(0.0, &x, &mut out).expect("solvable");
            assert_close("schur", &out, &reference, 1e-12);
            assert_close("schur", schur.multipliers().as_slice(), lambda, 1e-12);
            for rates in [Pendulum::rates_schur, Pendulum::rates_lu] {
                let mut out = [0.0; 13];
                let multipliers = rates(&fixed, 0.0, &x, &mut out).expect("solvable");
                assert_close("static", &out, &reference, 1e-12);
                assert_close("static", multipliers.as_slice(), lambda, 1e-12);
            }
        }
    }
    let scene = scenes::chain(4);
    let x = random_state(&scene, Spread::default(), &mut rng);
    let mut out = vec![0.0; x.len()];
    let mut schur = SchurEvaluator::new(scene.clone(), 3.0, 4.0);
    schur.rates(0.0, x.as_slice(), &mut out).expect("solvable");
    let baumgarte = Formulation::Baumgarte {
        alpha: 3.0,
        beta: 4.0,
    };
    let (reference, lambda) = solve(&scene, baumgarte, x.as_slice());
    let error = largest_error(&out[scene.coordinates()..], &reference);
    assert!(error < 1e-11, "{error:e}");
    assert_close(
        "lambda",
        schur.multipliers().as_slice(),
        lambda.as_slice(),
        1e-10,
    );
}

#[test]
fn a_rough_state_is_corrected_onto_the_constraints() {
    let mut rng = generator(7);
    for scene in [
        scenes::pendulum(),
        scenes::chain(5),
        scenes::heavy_top(),
        scenes::door(),
    ] {
        for _ in 0..10 {
            let mut x = random_state(&scene, Spread::default(), &mut rng);
            let left = make_consistent(&scene, x.as_mut_slice()).expect("close enough");
            assert!(left < 1e-13, "{left:e}");
            let rate = scene.constraint_rates(x.as_slice()).amax();
            assert!(rate < 1e-12, "{rate:e}");
        }
    }
}
