//! What implicit methods have in common: a simplified Newton iteration, and the Jacobian of the
//! rates.

use super::Memory;
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::math::scalar::increment;
use crate::state::vector::Vector;

/// A simplified Newton iteration under way, by the sizes of its changes (Hairer and Wanner,
/// *Solving Ordinary Differential Equations II*, IV.8).
#[derive(Clone, Copy, Debug)]
pub(super) struct Newton<S> {
    /// What it may leave, relative to what is allowed of errors.
    allowed: S,
    most: i32,
    pub(super) iterations: i32,
    before: Option<S>,
    /// What the last change was of the one before.
    pub(super) rate: Option<S>,
}

/// What a change says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Progress {
    GoesOn,
    Converged,
    /// It does not converge within the iterations that are left, or leaves the numbers.
    Fails,
}

impl<S: Real> Newton<S> {
    /// For errors that are held to a relative tolerance.
    pub(super) fn new(relative: S, most: i32) -> Self {
        let round_off = S::constant(10.0) * S::EPSILON.quotient(relative);
        Self {
            allowed: round_off.max(S::constant(0.03).min(relative.sqrt())),
            most,
            iterations: 0,
            before: None,
            rate: None,
        }
    }

    /// Takes the size of a change, relative to what is allowed of errors.
    pub(super) fn take(&mut self, size: S) -> Progress {
        self.iterations += 1;
        if !size.is_finite() {
            return Progress::Fails;
        }
        if let Some(before) = self.before.replace(size) {
            let rate = size.quotient(before);
            let left = self.iterations..self.most;
            let last = left.fold(size.quotient(S::one() - rate), |size, _| rate * size);
            if rate >= S::one() || last > self.allowed {
                return Progress::Fails;
            }
            self.rate = Some(rate);
        }
        let is_small = |rate: S| rate.quotient(S::one() - rate) * size < self.allowed;
        if size == S::zero() || self.rate.is_some_and(is_small) {
            Progress::Converged
        } else if self.iterations == self.most {
            Progress::Fails
        } else {
            Progress::GoesOn
        }
    }

    /// What the next step is made shorter by for the sake of its acceptance, the more the harder
    /// the iteration was.
    pub(super) fn safety(&self) -> S {
        let most = 2 * self.most;
        S::constant(0.9 * f64::from(most + 1) / f64::from(most + self.iterations))
    }
}

/// Where the Jacobian is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Age {
    /// The present state.
    Present,
    /// A former state, and good enough so far.
    Former,
    /// It is to be computed.
    Unknown,
}

impl Age {
    /// Its part of [`Integration::remember`](super::Integration::remember).
    pub(super) fn remember<S: Real>(&mut self, memory: &mut Memory<'_, S>) {
        let mut place = match self {
            Self::Present => 0,
            Self::Former => 1,
            Self::Unknown => 2,
        };
        memory.count(&mut place);
        *self = match place {
            0 => Self::Present,
            1 => Self::Former,
            _ => Self::Unknown,
        };
    }
}

/// The part of a Jacobian in [`Integration::remember`](super::Integration::remember).
pub(super) fn remember_columns<S: Real, X: Vector<S>>(
    memory: &mut Memory<'_, S>,
    columns: &mut X::Each<X>,
    length: usize,
) {
    for column in 0..length {
        memory.vector(&mut columns[column]);
    }
}

/// The Jacobian of the rates by differences of them, one evaluation for every element of the state
/// that has a part in increments.
///
/// With increments of `sqrt(EPSILON max(1e-5, |y|))` (Hairer and Wanner, *Solving Ordinary
/// Differential Equations II*, IV.8), of angles on a circle as well.
pub(crate) fn by_differences<S: Real, X: Vector<S>>(
    state: &X,
    rates: &X,
    columns: &mut X::Each<X>,
    mut evaluate: impl FnMut(&X, &mut X) -> Result<(), Fault>,
) -> Result<usize, Fault> {
    let length = state.length();
    let mut direction = state.zip(state, |_, _| S::zero());
    let mut evaluations = 0;
    for column in 0..length {
        let there = &mut columns[column];
        if !state.is_independent(column) {
            *there = state.zip(state, |_, _| S::zero());
            continue;
        }
        let increment = increment(state.element(column));
        direction.set_element(column, increment);
        evaluate(&state.plus([(S::one(), &direction)]), there)?;
        *there = there.zip(rates, |there, here| (there - here).quotient(increment));
        direction.set_element(column, S::zero());
        evaluations += 1;
    }
    Ok(evaluations)
}
