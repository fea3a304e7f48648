//! Acceleration of an iteration by what its former changes tell.

use crate::formulation::add;
use crate::math::scalar::{Real, Scalar};
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::Array;

/// How many pairs are kept before they are begun anew: as many stiff springs and dampers may be
/// followed at once.
const PAIRS: usize = 5;

/// A difference that is known from the others to this part tells nothing.
const KNOWN: f64 = 1e-5;

/// What an iteration changes: velocities, and positions as displacements.
pub(super) struct Change<S: Scalar, M: Mechanism> {
    pub(super) faster: M::Velocities<S>,
    pub(super) farther: M::Velocities<S>,
}

copied!([S: Scalar, M: Mechanism] Change<S, M>);

impl<S: Real, M: Mechanism> Change<S, M> {
    pub(super) fn none() -> Self {
        Self {
            faster: M::Velocities::<S>::zeros(),
            farther: M::Velocities::<S>::zeros(),
        }
    }

    /// `self + factor * other`.
    fn plus(mut self, factor: S, other: &Self) -> Self {
        add(self.faster.as_mut_slice(), factor, other.faster.as_slice());
        add(
            self.farther.as_mut_slice(),
            factor,
            other.farther.as_slice(),
        );
        self
    }

    pub(super) fn scaled(self, factor: S) -> Self {
        Self::none().plus(factor, &self)
    }

    /// The product in the metric of the mass; displacements count as velocities over a step.
    fn dot(&self, other: &Self, (step, mass): (S, &M::Velocities<S>)) -> S {
        let sum = |a: &M::Velocities<S>, b: &M::Velocities<S>| {
            let pairs = a.as_slice().iter().zip(b.as_slice());
            let pairs = pairs.zip(mass.as_slice());
            pairs.fold(S::zero(), |sum, ((&a, &b), &mass)| (a * b).fused(mass, sum))
        };
        sum(&self.faster, &other.faster) + sum(&self.farther, &other.farther).quotient(step * step)
    }
}

/// The changes that an iteration by fixed points has made, and what has become of them: the next
/// one is the combination that leaves least (Anderson, *Iterative procedures for nonlinear integral
/// equations*, J. ACM 12 (1965), 547-560; for linear forces the method of generalised minimal
/// residuals: Walker and Ni, *Anderson acceleration for fixed-point iterations*, SIAM J. Numer.
/// Anal. 49 (2011), 1715-1735).
pub(super) struct Secants<S: Scalar, M: Mechanism> {
    /// Steps, and by what they have changed the changes: those are of length 1 and perpendicular to
    /// each other.
    pairs: [(Change<S, M>, Change<S, M>); PAIRS],
    count: usize,
    /// The last step, and the change that it was made from.
    last: Option<(Change<S, M>, Change<S, M>)>,
}

impl<S: Real, M: Mechanism> Secants<S, M> {
    pub(super) fn new() -> Self {
        Self {
            pairs: [(Change::none(), Change::none()); PAIRS],
            count: 0,
            last: None,
        }
    }

    /// The step to take where an iteration has changed so much.
    pub(super) fn step(
        &mut self,
        change: &Change<S, M>,
        metric: (S, &M::Velocities<S>),
    ) -> Change<S, M> {
        if let Some((step, before)) = self.last {
            self.learn(step, change.plus(-S::one(), &before), metric);
        }
        let mut step = *change;
        for (moved, changed) in self.pairs.iter().take(self.count) {
            let part = change.dot(changed, metric);
            step = step.plus(-part, moved).plus(-part, changed);
        }
        self.last = Some((step, *change));
        step
    }

    /// That a part of the last step was taken only.
    pub(super) fn shortened(&mut self, step: Change<S, M>) {
        if let Some((last, _)) = &mut self.last {
            *last = step;
        }
    }

    fn learn(
        &mut self,
        mut moved: Change<S, M>,
        mut changed: Change<S, M>,
        metric: (S, &M::Velocities<S>),
    ) {
        if self.count == PAIRS {
            self.count = 0;
        }
        let whole = changed.dot(&changed, metric).sqrt();
        let newest = (moved, changed);
        for (other, direction) in self.pairs.iter().take(self.count) {
            let part = changed.dot(direction, metric);
            moved = moved.plus(-part, other);
            changed = changed.plus(-part, direction);
        }
        let mut length = changed.dot(&changed, metric).sqrt();
        if length <= S::constant(KNOWN) * whole {
            // The direction is known: its newest pair takes the place of all.
            (moved, changed) = newest;
            (self.count, length) = (0, whole);
        }
        if let Some(pair) = self.pairs.get_mut(self.count)
            && length > S::zero()
        {
            let factor = length.reciprocal();
            *pair = (moved.scaled(factor), changed.scaled(factor));
            self.count += 1;
        }
    }
}
