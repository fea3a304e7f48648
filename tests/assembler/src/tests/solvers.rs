//! Elimination in place against nalgebra, and what is reported where there is no solution.

use nalgebra::{DMatrix, DVector, Vector3};
use rand::RngExt;

use crate::accuracy::assert_close;
use crate::assembler::Assembler;
use crate::bodies::{Body, GROUND};
use crate::formulation::{Evaluator, Formulation, SolveError};
use crate::jacobi::SingularValues;
use crate::joints::Joint;
use crate::lu::solve_in_place;
use crate::scenes;
use crate::schur::SchurEvaluator;
use crate::states::{Spread, generator, random_state};

#[test]
fn elimination_in_place_equals_nalgebra() {
    let mut rng = generator(8);
    for n in 1..30 {
        let mut entry = || {
            let value: f64 = rng.random_range(-1.0..1.0);
            if value.abs() < 0.3 { 0.0 } else { value }
        };
        let matrix = DMatrix::from_fn(n, n, |_, _| entry()) + 3.0 * permutation(n);
        let mut rhs = DVector::from_fn(n, |_, _| entry());
        let expected = matrix.clone().lu().solve(&rhs).expect("regular");
        assert!(solve_in_place(&mut matrix.clone(), rhs.as_mut_slice()));
        assert_close("solution", rhs.as_slice(), expected.as_slice(), 1e-12);
    }
}

/// Ones on the other diagonal, so that rows must be exchanged.
fn permutation(n: usize) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |i, j| if i + j + 1 == n { 1.0 } else { 0.0 })
}

#[test]
fn elimination_reports_zero_pivots_and_nan() {
    for entry in [0.0, f64::NAN] {
        let mut matrix = DMatrix::from_element(2, 2, entry);
        assert!(!solve_in_place(&mut matrix, &mut [1.0, 1.0]));
    }
}

#[test]
fn redundant_rows_are_singular_with_multipliers_and_solvable_with_penalty() {
    // A bead on two equal rods to one point: two equal rows.
    let mut scene = Assembler::new([0.0, 0.0, -10.0]);
    let bead = scene.add_body(Body::particle(1.0, [0.0, 0.0, -1.0]));
    for _ in 0..2 {
        scene.add_joint(Joint::distance_at(
            [GROUND, bead],
            [Vector3::zeros(); 2],
            1.0,
        ));
    }
    let x = scene.initial_state();
    let mut out = vec![0.0; x.len()];
    let mut standard = Evaluator::new(scene.clone(), Formulation::Standard);
    let result = standard.rates(0.0, x.as_slice(), &mut out);
    assert_eq!(result, Err(SolveError::Singular));
    let mut schur = SchurEvaluator::new(scene.clone(), 0.0, 0.0);
    let result = schur.rates(0.0, x.as_slice(), &mut out);
    assert_eq!(result, Err(SolveError::Singular));

    let penalty = Formulation::Penalty {
        alpha: 1e8,
        omega: 10.0,
        mu: 1.0,
    };
    let mut penalty = Evaluator::new(scene, penalty);
    penalty
        .rates(0.0, x.as_slice(), &mut out)
        .expect("positive definite");
    assert_close("rates", &out, &[0.0; 6], 1e-6);
    // Each row carries half of the weight: -2 z lambda = m g / 2 with z = -1.
    let lambda = penalty.multipliers().as_slice();
    assert_close("lambda", lambda, &[2.5, 2.5], 1e-6);
}

#[test]
fn the_pseudo_inverse_has_the_four_properties_of_penrose() {
    let mut rng = generator(9);
    let door = random_state(&scenes::door(), Spread::default(), &mut rng);
    let hinged = scenes::door().jacobian(door.as_slice());
    let low = DMatrix::from_fn(7, 2, |_, _| rng.random_range(-1.0..1.0));
    let wide = &low * DMatrix::from_fn(2, 9, |_, _| rng.random_range(-1.0..1.0));
    for (matrix, rank) in [(hinged, 5), (wide.transpose(), 2), (wide, 2)] {
        let values = SingularValues::new(&matrix);
        assert_eq!(values.rank(1e-9), rank);
        let inverse = values.pseudo_inverse(1e-9);
        let (left, right) = (&matrix * &inverse, &inverse * &matrix);
        for (what, a, b) in [
            ("A A+ A", &left * &matrix, matrix.clone()),
            ("A+ A A+", &inverse * &left, inverse.clone()),
            ("(A A+)^T", left.transpose(), left),
            ("(A+ A)^T", right.transpose(), right),
        ] {
            assert_close(what, a.as_slice(), b.as_slice(), 1e-12);
        }
    }
    let diagonal = DMatrix::from_diagonal(&DVector::from_column_slice(&[1.0, -4.0, 1e-6]));
    let condition = SingularValues::new(&diagonal).condition();
    assert_close("condition", &[condition], &[4e6], 1e-15);
}

#[test]
fn bodies_without_joints_fall() {
    let mut scene = Assembler::new([0.0, 0.0, -10.0]);
    scene.add_body(Body::particle(3.0, [0.0; 3]));
    let spin = Body::rigid(2.0, [1.0, 2.0, 4.0], [0.0; 3]).with_velocity([0.0; 3], [1.0, 1.0, 1.0]);
    scene.add_body(spin);
    let x = scene.initial_state();
    // J w' = -w x J w
    let expected = [0.0, 0.0, -10.0, 0.0, 0.0, -10.0, -2.0, 1.5, -0.25];
    let mut out = vec![0.0; x.len()];
    for formulation in [
        Formulation::Standard,
        Formulation::Penalty {
            alpha: 1e7,
            omega: 10.0,
            mu: 1.0,
        },
    ] {
        let mut evaluator = Evaluator::new(scene.clone(), formulation);
        let result = evaluator.rates(0.0, x.as_slice(), &mut out);
        assert_eq!(result, Ok(()));
        assert_close("u'", &out[scene.coordinates()..], &expected, 1e-15);
    }
    out.fill(0.0);
    let mut schur = SchurEvaluator::new(scene.clone(), 1.0, 1.0);
    assert_eq!(schur.rates(0.0, x.as_slice(), &mut out), Ok(()));
    assert_close("u'", &out[scene.coordinates()..], &expected, 1e-15);
}
