//! States as lists of numbers.

use holonom::prelude::*;
use holonom::{Real, StateParts, state::Array};

/// A state as `(q, u)`.
pub(crate) fn flat<S: Real, M: Mechanism>(state: &M::State<S>) -> Vec<f64> {
    let parts = [
        state.coordinates().as_slice(),
        state.velocities().as_slice(),
    ];
    parts.into_iter().flatten().map(|x| x.to_f64()).collect()
}
