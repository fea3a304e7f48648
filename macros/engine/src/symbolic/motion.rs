//! How the bodies stand and move, as vectors, and gradients by forces and moments on them.

use std::collections::BTreeMap;

use super::arena::{Arena, Expr};
use super::expression::ScalarExpr;
use super::vector::{Space, Triple, VectorId};

/// Position and rates of the bodies, as vectors.
#[derive(Clone, Debug)]
pub struct Motion {
    /// `r` of every body.
    pub position: Vec<VectorId>,
    /// `v` of every body.
    pub velocity: Vec<VectorId>,
    /// `w` of every body.
    pub spin: Vec<VectorId>,
    /// The components of `w` in body axes.
    pub spin_components: Vec<Triple>,
    /// The point of every body whose acceleration is an unknown and about which moments are taken,
    /// from the centre of mass in body axes: the centre of mass itself unless a plan says
    /// otherwise. Positions and velocities are always those of centres of mass.
    pub reference: Vec<Triple>,
    /// The time.
    pub time: Expr,
    /// The rates of the user's own states.
    pub states: Vec<ScalarExpr>,
}

impl Motion {
    /// A point of a body from the point of reference.
    pub(super) fn arm(&self, space: &mut Space, body: usize, point: Triple) -> Triple {
        let reference = self.reference[body];
        [0, 1, 2].map(|k| space.arena.sub(point[k], reference[k]))
    }
}

/// The gradient of a scalar: the force and the moment on every body by which a virtual motion
/// `(dr, dw)` is multiplied.
#[derive(Clone, Debug, Default)]
pub struct Gradient {
    force: BTreeMap<usize, Vec<(Expr, VectorId)>>,
    moment: BTreeMap<usize, Vec<(Expr, VectorId)>>,
    /// What is along a velocity by itself, not by way of a body.
    along: Vec<(usize, Expr)>,
    /// Whether nothing goes along velocities by itself, but all by way of the bodies.
    pub(super) is_by_bodies: bool,
}

impl Gradient {
    /// A gradient that is made of forces and moments on bodies alone, whatever coordinates know.
    #[must_use]
    pub fn by_bodies() -> Self {
        Self {
            is_by_bodies: true,
            ..Self::default()
        }
    }

    /// Adds a moment on a body.
    pub fn add_moment(&mut self, body: usize, moment: VectorId) {
        self.push_moment(body, Arena::ONE, moment);
    }

    /// Adds a multiple of a moment on a body.
    pub(super) fn push_moment(&mut self, body: usize, factor: Expr, moment: VectorId) {
        self.moment.entry(body).or_default().push((factor, moment));
    }

    /// Adds a multiple of a force on a body.
    pub(super) fn push_force(&mut self, body: usize, factor: Expr, force: VectorId) {
        self.force.entry(body).or_default().push((factor, force));
    }

    /// Adds a generalised force on a velocity.
    pub(super) fn push_along(&mut self, velocity: usize, factor: Expr) {
        self.along.push((velocity, factor));
    }

    /// Adds what is along velocities by itself to the generalised forces on them.
    pub(crate) fn add_along(&self, arena: &mut Arena, generalised: &mut [Expr]) {
        for &(velocity, factor) in &self.along {
            generalised[velocity] = arena.add(generalised[velocity], factor);
        }
    }

    /// The factor of `dr` of a body.
    pub fn force(&self, space: &mut Space, body: usize) -> VectorId {
        space.sum(self.force.get(&body).into_iter().flatten().copied())
    }

    /// The factor of `dw` of a body.
    pub fn moment(&self, space: &mut Space, body: usize) -> VectorId {
        space.sum(self.moment.get(&body).into_iter().flatten().copied())
    }
}
