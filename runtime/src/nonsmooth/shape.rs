//! Shapes that touch a plane, with the motion of what touches.

use crate::forward::Forward;
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{cross, minus, plus, times};
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::place::{At, PlaceOfPlane, dot};
use crate::nonsmooth::scene::Scene;

/// What touches a plane, about the point that it is given by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape<S> {
    /// A ball with a radius (m): a point where that is zero.
    Ball(S),
    /// The edge of a disc about an axis, in principal axes of its body (global on the ground) and
    /// of length 1: a torus, with the radius (m) of its middle circle and that of its tube.
    Disc { axis: [S; 3], radius: S, tube: S },
}

/// Along which direction of a plane, both at right angles to its normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Direction {
    Along,
    /// The normal times the other.
    Across,
}

/// How what is nearest to a plane lies and moves.
#[derive(Clone, Copy)]
pub(crate) struct Touch<S> {
    /// Its distance from the plane (m), positive on the free side.
    pub(super) gap: S,
    /// The rate of that (m/s).
    pub(super) rate: S,
    /// The velocity (m/s) of the material that is there against that of the plane, along both
    /// directions.
    pub(super) slip: [S; 2],
}

impl<S> Shape<S> {
    pub(super) fn without_numbers(&self) -> Shape<()> {
        match self {
            Self::Ball(_) => Shape::Ball(()),
            Self::Disc { .. } => Shape::Disc {
                axis: [(); 3],
                radius: (),
                tube: (),
            },
        }
    }
}

impl<S: Scalar> Shape<S> {
    pub(super) fn lifted<const N: usize>(self) -> Shape<Forward<S, N>> {
        match self {
            Self::Ball(radius) => Shape::Ball(Forward::fixed(radius)),
            Self::Disc { axis, radius, tube } => Shape::Disc {
                axis: axis.map(Forward::fixed),
                radius: Forward::fixed(radius),
                tube: Forward::fixed(tube),
            },
        }
    }
}

impl<S: Real> Shape<S> {
    /// The largest of its lengths (m).
    pub(super) fn reach(&self) -> S {
        match *self {
            Self::Ball(radius) => radius.abs(),
            Self::Disc { radius, tube, .. } => radius.abs() + tube.abs(),
        }
    }

    /// A length that is no radius, by its setting.
    pub(super) fn check(&self) -> Result<(), (&'static str, S)> {
        let (radius, tube) = match *self {
            Self::Ball(radius) => (radius, S::zero()),
            Self::Disc { axis, radius, tube } => {
                if let Some(&component) = axis.iter().find(|component| !component.is_finite()) {
                    return Err(("axis", component));
                }
                (radius, tube)
            }
        };
        let is_radius = |length: S| length >= S::zero() && length.is_finite();
        if !is_radius(radius) {
            return Err(("radius", radius));
        }
        if !is_radius(tube) {
            return Err(("tube", tube));
        }
        Ok(())
    }
}

impl<S: Scalar, M: Mechanism> Scene<'_, S, M> {
    /// What a shape does against a plane. Not a number for a disc that lies flat on it.
    pub(crate) fn touch(&self, at: At, plane: &PlaceOfPlane<S>, shape: &Shape<S>) -> Touch<S> {
        let [centre, velocity] = self.at(at);
        let [base, base_velocity] = self.point(plane.body, &plane.point);
        let [normal, along] = [plane.normal, plane.along].map(|vector| match plane.body {
            Some(body) => self.turned(body, &vector)[0],
            None => vector,
        });
        let across = cross(&normal, &along);
        let arm = match shape {
            Shape::Ball(radius) => times(&normal, -*radius),
            Shape::Disc { axis, radius, tube } => {
                let axis = match at.body::<M>() {
                    Some(body) => self.turned(body, axis)[0],
                    None => *axis,
                };
                // The part of the normal in the plane of the disc.
                let within = minus(&normal, &times(&axis, dot(&normal, &axis)));
                let length = dot(&within, &within).sqrt();
                let deepest = times(&within, -(*radius * length.reciprocal()));
                plus(&deepest, &times(&normal, -*tube))
            }
        };
        let way = minus(&plus(&centre, &arm), &base);
        let turning = match at.body::<M>() {
            Some(body) => cross(&self.spin(body), &arm),
            None => [S::zero(); 3],
        };
        let of_plane = match plane.body {
            Some(body) => plus(&base_velocity, &cross(&self.spin(body), &way)),
            None => base_velocity,
        };
        let relative = minus(&plus(&velocity, &turning), &of_plane);
        Touch {
            gap: dot(&normal, &way),
            rate: dot(&normal, &relative),
            slip: [dot(&along, &relative), dot(&across, &relative)],
        }
    }
}
