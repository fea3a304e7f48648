//! A mechanism beside its assembler, and states for both.

use holonom::{Mechanism, MechanismExt, Real, Scalar, StateParts, state::Array};
use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::Orientation;
use holonom_assembler::states::{Spread, generator, make_consistent, moved};
use holonom_tests::is_exhaustive;
use nalgebra::{DMatrix, DVector};

/// A mechanism that is also described for the run-time assembler.
pub(crate) trait Scene: Mechanism + Default {
    /// The same mechanism, put together at run time.
    fn assembler() -> Assembler;

    /// The same with another reading of Euler parameters.
    fn read_as(orientation: Orientation) -> Assembler {
        Self::assembler().with_orientation(orientation)
    }
}

/// `x = (q, u)` as a state over any scalar.
pub(crate) fn state<S: Scalar, M: Mechanism>(x: &[f64]) -> M::State<S> {
    let mut state = M::State::<S>::from_parts(Array::zeros(), Array::zeros());
    let (q, u) = x.split_at(M::REPORT.coordinates);
    fill(state.coordinates_mut().as_mut_slice(), q);
    fill(state.velocities_mut().as_mut_slice(), u);
    state
}

fn fill<S: Scalar>(target: &mut [S], values: &[f64]) {
    assert_eq!(
        target.len(),
        values.len(),
        "the assembler has other coordinates"
    );
    for (element, value) in target.iter_mut().zip(values) {
        *element = S::constant(*value);
    }
}

/// A state as `x = (q, u)`.
pub(crate) fn flat<S: Real, M: Mechanism>(state: &M::State<S>) -> Vec<f64> {
    let parts = [
        state.coordinates().as_slice(),
        state.velocities().as_slice(),
    ];
    parts.into_iter().flat_map(values).collect()
}

/// The values of scalars.
pub(crate) fn values<S: Real>(elements: &[S]) -> Vec<f64> {
    elements.iter().map(|element| element.to_f64()).collect()
}

/// `x` as the number type sees it.
pub(crate) fn rounded<S: Real>(x: &[f64]) -> Vec<f64> {
    x.iter().map(|value| S::constant(*value).to_f64()).collect()
}

/// The constants of a mechanism that has no parameters to refuse.
pub(crate) fn constants<S: Scalar, M: Scene>() -> M::Constants<S> {
    let mechanism = M::default();
    mechanism
        .constants()
        .expect("the parameters are acceptable")
}

/// The Jacobian as a dense matrix, equations by velocities.
pub(crate) fn dense<S: Real, M: Mechanism>(blocks: &[S]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(M::REPORT.equations, M::REPORT.velocities);
    for block in M::REPORT.blocks {
        for row in 0..block.rows {
            for column in 0..block.columns {
                let value = blocks[block.offset + row * block.columns + column];
                matrix[(block.row + row, block.column + column)] += value.to_f64();
            }
        }
    }
    matrix
}

/// How many states of a kind are tried.
pub(crate) fn states_to_try() -> usize {
    if is_exhaustive() { 300 } else { 30 }
}

/// States on the constraints, in position and velocity: a walk that starts in the initial
/// configuration and gets far from it without leaving its branch, each corrected by the assembler's
/// own Newton method.
pub(crate) fn consistent(scene: &Assembler, count: usize, seed: u64) -> Vec<DVector<f64>> {
    let mut rng = generator(seed);
    let mut states = Vec::with_capacity(count);
    let mut at = scene.initial_state();
    while states.len() < count {
        let mut x = moved(scene, &at, Spread::STRIDE, &mut rng);
        if make_consistent(scene, x.as_mut_slice()).is_some() {
            states.push(x.clone());
            at = x;
        }
    }
    states
}

/// States up to 0.1 rad and 0.1 m off the constraints with Euler parameters of length 1: those of
/// [`consistent`], every body moved by itself.
pub(crate) fn violated(scene: &Assembler, count: usize, seed: u64) -> Vec<DVector<f64>> {
    off(scene, count, seed, Spread::default())
}

/// States off the constraints by a given amount.
pub(crate) fn off(scene: &Assembler, count: usize, seed: u64, spread: Spread) -> Vec<DVector<f64>> {
    let mut rng = generator(seed.wrapping_add(1));
    consistent(scene, count, seed)
        .iter()
        .map(|x| moved(scene, x, spread, &mut rng))
        .collect()
}
