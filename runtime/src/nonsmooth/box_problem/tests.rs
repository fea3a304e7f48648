//! Against an enumeration of all `3^K` ways in which unknowns may be at their bounds or inside.

use std::vec::Vec;

use super::{BoxProblem, BoxSolution, Place};
use crate::tests::numbers::Numbers;

/// `B B^T` of a random matrix with so many columns.
fn matrix<const K: usize>(numbers: &mut Numbers, rank: usize) -> [[f64; K]; K] {
    let rows: [Vec<f64>; K] = core::array::from_fn(|_| (0..rank).map(|_| numbers.next()).collect());
    core::array::from_fn(|i| {
        core::array::from_fn(|j| rows[i].iter().zip(&rows[j]).map(|(a, b)| a * b).sum())
    })
}

fn problem<const K: usize>(numbers: &mut Numbers, rank: usize) -> BoxProblem<f64, K> {
    let matrix = matrix(numbers, rank);
    // In the range of the matrix, as accelerations are.
    let efforts: [f64; K] = core::array::from_fn(|_| 3.0 * numbers.next());
    let offset = core::array::from_fn(|i| {
        let row = matrix[i].iter().zip(&efforts);
        -row.map(|(w, x)| w * x).sum::<f64>()
    });
    let mut problem = BoxProblem::at_rest(matrix, offset);
    for index in 0..K {
        let (lower, upper) = match (numbers.next() * 2.0 + 2.0) as u8 {
            0 => (0.0, f64::INFINITY),
            1 => (f64::NEG_INFINITY, 0.0),
            2 => (-1.0, 1.0),
            _ => (f64::NEG_INFINITY, f64::INFINITY),
        };
        (problem.lower[index], problem.upper[index]) = (lower, upper);
    }
    problem
}

/// What is wrong with a solution.
fn wrong<const K: usize>(problem: &BoxProblem<f64, K>, solution: &BoxSolution<f64, K>) -> f64 {
    let mut worst = 0.0_f64;
    for i in 0..K {
        let (x, w) = (solution.efforts[i], problem.offset[i]);
        let row = problem.matrix[i].iter().zip(&solution.efforts);
        let w = row.fold(w, |sum, (w, x)| sum + w * x);
        let (lower, upper) = (problem.lower[i], problem.upper[i]);
        worst = worst.max(lower - x).max(x - upper);
        let (at_lower, at_upper) = (x <= lower + 1e-12, x >= upper - 1e-12);
        worst = match (at_lower, at_upper) {
            (true, true) => worst,
            (true, false) => worst.max(-w),
            (false, true) => worst.max(w),
            (false, false) => worst.max(w.abs()),
        };
    }
    worst
}

/// All solutions by enumeration, with elimination in full pivoting left to a dense solver.
fn enumerated<const K: usize>(problem: &BoxProblem<f64, K>) -> Vec<[f64; K]> {
    let mut found = Vec::new();
    for code in 0..3_usize.pow(K as u32) {
        let mut digits = code;
        let mut efforts = [0.0; K];
        let mut inside = Vec::new();
        let mut is_possible = true;
        for (index, effort) in efforts.iter_mut().enumerate() {
            match digits % 3 {
                0 => *effort = problem.lower[index],
                1 => *effort = problem.upper[index],
                _ => inside.push(index),
            }
            is_possible &= effort.is_finite();
            digits /= 3;
        }
        if !is_possible {
            continue;
        }
        let n = inside.len();
        if n == 0 {
            let candidate = BoxSolution {
                efforts,
                residuals: [0.0; K],
                places: [Place::Lower; K],
            };
            if wrong(problem, &candidate) < 1e-9 {
                found.push(efforts);
            }
            continue;
        }
        let w = nalgebra::DMatrix::from_fn(n, n, |i, j| problem.matrix[inside[i]][inside[j]]);
        let right = nalgebra::DVector::from_fn(n, |i, _| {
            let row = problem.matrix[inside[i]].iter().zip(&efforts);
            -row.fold(problem.offset[inside[i]], |sum, (w, x)| sum + w * x)
        });
        let Some(x) = w.lu().solve(&right) else {
            continue;
        };
        for (i, &index) in inside.iter().enumerate() {
            efforts[index] = x[i];
        }
        let candidate = BoxSolution {
            efforts,
            residuals: [0.0; K],
            places: [Place::Inside; K],
        };
        if wrong(problem, &candidate) < 1e-9 {
            found.push(efforts);
        }
    }
    found
}

fn agrees<const K: usize>(seed: u64, rank: usize) {
    let mut numbers = Numbers(seed);
    for _ in 0..200 {
        let problem = problem::<K>(&mut numbers, rank);
        let solution = problem.solved().expect("pivoting ends");
        let rest = wrong(&problem, &solution);
        // Where rows depend on each other, places are right to the floor.
        let bound = if rank < K { 1e-6 } else { 1e-9 };
        assert!(rest < bound, "{rest} in {problem:?}: {solution:?}");
        if rank < K {
            continue;
        }
        let all = enumerated(&problem);
        assert!(!all.is_empty(), "the enumeration finds it, too");
        for other in &all {
            for (a, b) in other.iter().zip(&solution.efforts) {
                assert!(
                    (a - b).abs() < 1e-6 * (1.0 + a.abs()),
                    "{other:?} {solution:?}"
                );
            }
        }
    }
}

#[test]
fn solutions_are_those_of_an_enumeration() {
    agrees::<1>(1, 3);
    agrees::<2>(2, 5);
    agrees::<3>(3, 7);
    agrees::<4>(4, 9);
    agrees::<5>(5, 11);
}

#[test]
fn dependent_rows_are_solved_as_well() {
    agrees::<3>(6, 2);
    agrees::<5>(7, 3);
    agrees::<6>(8, 2);
}

#[test]
fn equal_rows_share_the_effort() {
    // Two equal stops, and 10 N against both.
    let mut problem = BoxProblem::at_rest([[2.0, 2.0], [2.0, 2.0]], [-20.0, -20.0]);
    problem.upper = [f64::INFINITY; 2];
    let solution = problem.solved().expect("pivoting ends");
    for effort in solution.efforts {
        // To what the floor resolves, `EPSILON^(1/4)`.
        assert!((effort - 5.0).abs() < 1e-3, "{effort}");
    }
    let sum: f64 = solution.efforts.iter().sum();
    assert!((sum - 10.0).abs() < 1e-9, "{sum}");
    assert_eq!(solution.places, [Place::Inside; 2]);
}

#[test]
fn a_row_without_freedom_has_no_effort() {
    let mut problem = BoxProblem::at_rest([[0.0, 0.0], [0.0, 1.0]], [0.0, -3.0]);
    problem.upper = [f64::INFINITY; 2];
    let solution = problem.solved().expect("pivoting ends");
    assert_eq!(solution.efforts[0], 0.0);
    assert!((solution.efforts[1] - 3.0).abs() < 1e-12);
    let mut nothing = problem;
    nothing.offset = [f64::NAN; 2];
    assert!(nothing.solved().is_none());
}
