//! Accelerations and multipliers of all formulations equal a dense LU of the same saddle system.
//!
//! The deviation is that of the whole vector `(M^(1/2) u', lambda)` in the Euclidean norm, relative
//! to the reference, and the condition number is that of the matrix that goes with it,
//! `[I, M^(-1/2) D^T; D M^(-1/2), -e I]`: in SI units alone the moment of inertia of a thin rod
//! would be 1e-4 of its mass for no reason. A condition number (largest over smallest singular
//! value) bounds what a solution in floating point may be off by. Where a ratio that is never more
//! than the condition number shows that the bound holds, the singular values are not computed: that
//! of the largest to the smallest column of the matrix, or of what the matrix and its inverse make
//! of a vector.

use holonom::{
    AugmentedLagrangian, Real, StateParts,
    dynamics::{Dynamics, Problem},
    mechanism::{Compliant, Plain, Stabilisation, Stabilised, Terms},
    state::Array,
};
use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies;
use holonom_assembler::jacobi::SingularValues;
use holonom_assembler::saddle::Coefficients;
use nalgebra::{DMatrix, DVector};

use crate::comparison::{SOLUTION, Worst, distance, tolerance};
use crate::scene::{Scene, consistent, constants, rounded, state, states_to_try, values, violated};

/// `(u', lambda)` of the fused evaluation, and the rates of the coordinates.
pub(crate) fn evaluated<S: Real, M: Scene, T: Terms>(
    coefficients: Coefficients,
    x: &[f64],
) -> (Vec<f64>, Vec<f64>) {
    let constants = constants::<S, M>();
    let prepared = M::coefficients(&constants, &stabilisation(coefficients));
    let state = state::<S, M>(x);
    let evaluation = M::evaluate::<S, T>(&constants, &prepared, S::zero(), &state);
    let mut solution = values(evaluation.rates.velocities().as_slice());
    solution.extend(values(evaluation.multipliers.as_slice()));
    (solution, values(evaluation.rates.coordinates().as_slice()))
}

/// `(u', lambda)` by factorisation and back-substitution, with the right-hand side put together
/// from kernels.
pub(crate) fn solved_in_parts<S: Real, M: Scene, T: Terms>(
    coefficients: Coefficients,
    x: &[f64],
) -> Vec<f64> {
    let constants = constants::<S, M>();
    let stabilisation = stabilisation::<S>(coefficients);
    let prepared = M::coefficients(&constants, &stabilisation);
    let (time, state) = (S::zero(), state::<S, M>(x));
    let (factors, _) = M::factor::<S, T>(&constants, &prepared, time, &state);
    let upper = M::forces(&constants, time, &state);
    let mut lower = M::gamma(&constants, time, &state);
    let phi = M::constraints(&constants, time, &state);
    let rates = M::constraint_rates(&constants, time, &state);
    for (k, gamma) in lower.as_mut_slice().iter_mut().enumerate() {
        let rate = stabilisation.rate * rates.as_slice()[k];
        *gamma = *gamma - rate - stabilisation.position * phi.as_slice()[k];
    }
    let (accelerations, multipliers) =
        M::solve::<S, T>(&constants, &prepared, &factors, &upper, &lower);
    let mut solution = values(accelerations.as_slice());
    solution.extend(values(multipliers.as_slice()));
    solution
}

fn stabilisation<S: Real>(coefficients: Coefficients) -> Stabilisation<S> {
    let Coefficients { a, b, eps } = coefficients;
    Stabilisation {
        rate: S::constant(2.0 * a),
        position: S::constant(b * b),
        compliance: S::constant(eps),
    }
}

/// A reference solution with the system that it solves.
pub(crate) struct Reference {
    /// `(u', lambda)`.
    pub(crate) solution: Vec<f64>,
    matrix: DMatrix<f64>,
    /// The square roots of the masses, 1 for multipliers.
    weights: DVector<f64>,
}

impl Reference {
    /// By the assembler's dense LU.
    pub(crate) fn new(scene: &Assembler, coefficients: Coefficients, x: &[f64]) -> Self {
        let found = scene
            .solve_saddle(x, coefficients, None)
            .expect("no pivot is exactly zero");
        let solution = found.accelerations.iter().chain(&found.multipliers);
        let roots = scene.mass().map(f64::sqrt);
        Self {
            solution: solution.copied().collect(),
            weights: roots.resize_vertically(found.matrix.nrows(), 1.0),
            matrix: found.matrix,
        }
    }

    /// `(M^(1/2) u', lambda)`.
    fn weighted(&self, solution: &[f64]) -> Vec<f64> {
        let pairs = solution.iter().zip(&self.weights);
        pairs.map(|(value, weight)| value * weight).collect()
    }

    /// The deviation of a solution over the condition number; over a lower bound of it where that
    /// is enough.
    pub(crate) fn deviation(&self, solution: &[f64], limit: f64) -> f64 {
        let [computed, reference] = [solution, &self.solution].map(|s| self.weighted(s));
        let deviation = distance(&computed, &reference, 0.0);
        let matrix = DMatrix::from_fn(self.matrix.nrows(), self.matrix.ncols(), |row, column| {
            self.matrix[(row, column)] / (self.weights[row] * self.weights[column])
        });
        let columns = matrix.column_iter().map(|column| column.norm());
        let (least, most) = columns.fold((f64::INFINITY, 0.0_f64), |(least, most), norm| {
            (least.min(norm), most.max(norm))
        });
        let by_columns = deviation * least / most;
        if by_columns <= limit {
            return by_columns;
        }
        let by_vectors = deviation / condition_from_below(&matrix);
        if by_vectors <= limit {
            return by_vectors;
        }
        deviation / SingularValues::new(&matrix).condition()
    }
}

/// A bound of the condition number from below, and close to it: how much longer a vector becomes by
/// the matrix and by its inverse, along what some steps of the power method make of it.
fn condition_from_below(matrix: &DMatrix<f64>) -> f64 {
    let factors = matrix.clone().lu();
    let stretch = |step: &dyn Fn(&DVector<f64>) -> DVector<f64>| {
        let mut vector = DVector::from_element(matrix.nrows(), 1.0).normalize();
        let mut stretch = 0.0;
        for _ in 0..4 {
            let next = step(&vector);
            stretch = next.norm();
            vector = next / stretch;
        }
        stretch
    };
    let solved = |v: &DVector<f64>| factors.solve(v).expect("no pivot is exactly zero");
    stretch(&|v| matrix * v) * stretch(&solved)
}

/// The states of both sets, as the number type sees them.
fn states<M: Scene, S: Real>() -> Vec<Vec<f64>> {
    let scene = M::assembler();
    let mut states = consistent(&scene, states_to_try(), 3);
    states.extend(violated(&scene, states_to_try(), 4));
    states.iter().map(|x| rounded::<S>(x.as_slice())).collect()
}

/// One formulation at all states: fused, and in parts, which read `p` as it is.
fn formulation<S: Real, M: Scene, T: Terms>(
    what: &str,
    coefficients: Coefficients,
    states: &[Vec<f64>],
) {
    let raw = M::read_as(bodies::Orientation::Raw);
    let normalised = M::read_as(bodies::Orientation::Normalised);
    let limit = tolerance::<S>(SOLUTION);
    let mut worst = Worst::default();
    for x in states {
        let reference = Reference::new(&raw, coefficients, x);
        let solution = solved_in_parts::<S, M, T>(coefficients, x);
        let deviation = reference.deviation(&solution, limit);
        worst.take(&format!("{what}, in parts"), deviation, limit);
        let reference = Reference::new(&normalised, coefficients, x);
        let (solution, _) = evaluated::<S, M, T>(coefficients, x);
        let deviation = reference.deviation(&solution, limit);
        worst.take(&format!("{what}, fused"), deviation, limit);
    }
    println!("{what}: largest deviation {:e} of the condition", worst.0);
}

/// Baumgarte's coefficients, and those of a penalty of chapter 15: rigid, soft.
const BAUMGARTE: Coefficients = Coefficients {
    a: 5.0,
    b: 7.0,
    eps: 0.0,
};
const RIGID: Coefficients = Coefficients {
    a: 10.0,
    b: 10.0,
    eps: 1e-7,
};
const SOFT: Coefficients = Coefficients {
    a: 8.0,
    b: 10.0,
    eps: 1e-2,
};

fn formulations<S: Real, M: Scene>() {
    let states = states::<M, S>();
    formulation::<S, M, Plain>("standard", Coefficients::default(), &states);
    formulation::<S, M, Stabilised>("baumgarte", BAUMGARTE, &states);
    formulation::<S, M, Compliant>("penalty 1e7", RIGID, &states);
    formulation::<S, M, Compliant>("penalty 1e2", SOFT, &states);
}

fn in_double_precision<M: Scene>() {
    formulations::<f64, M>();
}

fn in_single_precision<M: Scene>() {
    formulations::<f32, M>();
}

/// With a compliance, also where equations are redundant.
fn with_a_compliance<M: Scene>() {
    let states = states::<M, f64>();
    formulation::<f64, M, Compliant>("penalty 1e7", RIGID, &states);
    formulation::<f64, M, Compliant>("penalty 1e2", SOFT, &states);
}

/// As many iterations of the saddle system as the run time took, by one dense LU; then the run
/// time's own rule to stop has to hold, and not before.
fn augmented_lagrangian<M: Scene>() {
    let scene = M::read_as(bodies::Orientation::Normalised);
    let method = AugmentedLagrangian::<f64>::default();
    let dynamics = Dynamics::<Problem<M, _>>::new(&M::default(), method)
        .expect("acceptable")
        .absolute_coordinates();
    let mut worst = Worst::default();
    let mut most = 0;
    for x in states::<M, f64>() {
        let state = state::<f64, M>(&x);
        let (evaluation, iterations) = dynamics.evaluate(0.0, &state).expect("converges");
        let mut solution = values(evaluation.rates.velocities().as_slice());
        let velocities = solution.len();
        solution.extend(values(evaluation.multipliers.as_slice()));
        let mut reference = Reference::new(&scene, RIGID, &x);
        let factors = reference.matrix.clone().lu();
        let mut right = &reference.matrix * DVector::from_column_slice(&reference.solution);
        let lower = right
            .rows(velocities, right.len() - velocities)
            .into_owned();
        let mut changes = Vec::new();
        for _ in 1..iterations {
            let before = DVector::from_column_slice(&reference.solution);
            let multipliers = before.rows(velocities, lower.len());
            right
                .rows_mut(velocities, lower.len())
                .copy_from(&(&lower - RIGID.eps * multipliers));
            let next = factors.solve(&right).expect("solvable");
            let change = (next.rows(0, velocities) - before.rows(0, velocities)).norm();
            changes.push(change / (1.0 + next.rows(0, velocities).norm()));
            reference.solution = next.iter().copied().collect();
        }
        let last = changes.pop().expect("two iterations or more");
        assert!(
            last <= 1.01 * method.tolerance,
            "stopped too early: {last:e}"
        );
        let before = changes
            .iter()
            .fold(f64::INFINITY, |m, change| m.min(*change));
        assert!(
            before > 0.99 * method.tolerance,
            "stopped too late: {before:e}"
        );
        let deviation = reference.deviation(&solution, SOLUTION);
        worst.take("augmented Lagrangian", deviation, SOLUTION);
        most = most.max(iterations);
    }
    println!(
        "augmented Lagrangian: largest deviation {:e}, at most {most} iterations",
        worst.0
    );
}

mod in_double_precision {
    every_independent_mechanism! { in_double_precision }
}

mod in_single_precision {
    every_independent_mechanism! { in_single_precision }
}

mod with_a_compliance {
    every_redundant_mechanism! { with_a_compliance }
}

mod augmented_lagrangian {
    every_independent_mechanism! { augmented_lagrangian }
}
