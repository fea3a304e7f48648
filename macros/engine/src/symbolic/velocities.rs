//! Gradients, by velocities, of what is linear in them.
//!
//! Of a rate it is the gradient, by positions, of what the rate is taken of; an angular velocity is
//! a velocity itself. Of a product, what holds rates is the one factor.

use super::arena::Expr;
use super::expression::{ScalarExpr, VectorExpr};
use super::motion::{Gradient, Motion};
use super::vector::{Frame, Space, VectorId};

impl VectorExpr {
    /// Whether it holds a rate.
    pub fn has_rate(&self) -> bool {
        match self {
            Self::Rate(_) | Self::Spin(_) => true,
            Self::Fixed(..) | Self::Point(..) => false,
            Self::Sum(terms) => terms.iter().any(|(_, term)| term.has_rate()),
            Self::Scaled(factor, inner) => factor.has_rate() || inner.has_rate(),
            Self::Cross(a, b) => a.has_rate() || b.has_rate(),
        }
    }

    /// Adds the gradient of `covector . self` by velocities.
    pub fn pull_back_rates(
        &self,
        space: &mut Space,
        motion: &Motion,
        factor: Expr,
        covector: VectorId,
        gradient: &mut Gradient,
    ) {
        if !self.has_rate() {
            return;
        }
        match self {
            Self::Fixed(..) | Self::Point(..) => {}
            Self::Rate(inner) => inner.pull_back(space, motion, factor, covector, gradient),
            Self::Spin([from, to]) => {
                for (body, factor) in [(*to, factor), (*from, -factor)] {
                    if let Some(body) = body {
                        let moment = space.moment_on(covector, body);
                        gradient.push_moment(body, factor, moment);
                    }
                }
            }
            Self::Sum(terms) => {
                for (coefficient, term) in terms {
                    let factor = space.arena.mul(factor, *coefficient);
                    term.pull_back_rates(space, motion, factor, covector, gradient);
                }
            }
            Self::Scaled(scalar, vector) if scalar.has_rate() => {
                let vector = vector.value(space, motion);
                let along = space.dot(covector, vector);
                let seed = space.arena.mul(factor, along);
                scalar.pull_back_rates(space, motion, seed, gradient);
            }
            Self::Scaled(scalar, vector) => {
                let value = scalar.value(space, motion);
                let scaled = space.arena.mul(factor, value);
                vector.pull_back_rates(space, motion, scaled, covector, gradient);
            }
            // c . (a' x b) = a' . (b x c) and c . (a x b') = b' . (c x a)
            Self::Cross(a, b) if a.has_rate() => {
                let fixed = b.value(space, motion);
                let on_a = space.cross(Frame::Global, fixed, covector);
                a.pull_back_rates(space, motion, factor, on_a, gradient);
            }
            Self::Cross(a, b) => {
                let fixed = a.value(space, motion);
                let on_b = space.cross(Frame::Global, covector, fixed);
                b.pull_back_rates(space, motion, factor, on_b, gradient);
            }
        }
    }
}

impl ScalarExpr {
    /// Whether it holds a rate.
    pub fn has_rate(&self) -> bool {
        match self {
            Self::Rate(_) => true,
            Self::Dot(a, b) => a.has_rate() || b.has_rate(),
            Self::Sum(terms) => terms.iter().any(|(_, term)| term.has_rate()),
            Self::Product(a, b) => a.has_rate() || b.has_rate(),
            Self::Function(_, inner) => inner.has_rate(),
            Self::Direction(angle) => angle.sine.has_rate() || angle.cosine.has_rate(),
            Self::Side { of, .. } => of.has_rate(),
            Self::Select { side, parts } => {
                side.has_rate() || parts.iter().any(|part| part.has_rate())
            }
            Self::Constant(_)
            | Self::Time
            | Self::Angle(_)
            | Self::Setpoint(_)
            | Self::State { .. } => false,
        }
    }

    /// Adds `seed` times the gradient by velocities.
    pub fn pull_back_rates(
        &self,
        space: &mut Space,
        motion: &Motion,
        seed: Expr,
        gradient: &mut Gradient,
    ) {
        match self {
            Self::Rate(inner) => inner.pull_back(space, motion, seed, gradient),
            Self::Dot(a, b) => {
                let (moving, fixed) = if a.has_rate() { (a, b) } else { (b, a) };
                let fixed = fixed.value(space, motion);
                moving.pull_back_rates(space, motion, seed, fixed, gradient);
            }
            Self::Sum(terms) => {
                for (factor, term) in terms {
                    let seed = space.arena.mul(seed, *factor);
                    term.pull_back_rates(space, motion, seed, gradient);
                }
            }
            Self::Product(a, b) => {
                let (moving, fixed) = if a.has_rate() { (a, b) } else { (b, a) };
                let fixed = fixed.value(space, motion);
                let seed = space.arena.mul(seed, fixed);
                moving.pull_back_rates(space, motion, seed, gradient);
            }
            // What holds rates is linear in them.
            _ => {}
        }
    }
}
