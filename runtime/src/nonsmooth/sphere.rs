//! Spheres that balls touch, from outside or from within.

use core::marker::PhantomData;

use crate::forward::Forward;
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::point::Located;
use crate::nonsmooth::place::{At, of_length_1};

/// A sphere about a point of a body or of the ground, for
/// [`Interaction::contact_with_sphere`](crate::run::Interaction::contact_with_sphere).
pub struct Sphere<S, M> {
    pub(crate) place: PlaceOfSphere<S>,
    mechanism: PhantomData<fn() -> M>,
}

impl<S: Copy, M> Clone for Sphere<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Copy, M> Copy for Sphere<S, M> {}

impl<S: core::fmt::Debug, M> core::fmt::Debug for Sphere<S, M> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.place.fmt(f)
    }
}

impl<S: Real, M: Mechanism> Sphere<S, M> {
    /// A ball with a radius (m), which is touched from outside.
    #[must_use]
    pub fn about(centre: impl Located<M>, radius: S) -> Self {
        let (zero, one) = (S::zero(), S::one());
        Self {
            place: PlaceOfSphere {
                at: At::of(centre),
                radius,
                along: [zero, zero, one],
                is_hollow: false,
            },
            mechanism: PhantomData,
        }
    }

    /// A bowl: it is touched from within.
    #[must_use]
    pub fn hollow(mut self) -> Self {
        self.place.is_hollow = true;
        self
    }

    /// With the direction (global) along which the first effort of its friction is counted: the
    /// part of a vector at right angles to the normal. Without a word it is that of the global z
    /// axis. There is none where the normal is along the vector: a run that gets there ends with
    /// [`StepFault::EventNotANumber`](crate::error::StepFault::EventNotANumber), so take one that
    /// the contact never comes to.
    #[must_use]
    pub fn along(mut self, direction: [S; 3]) -> Self {
        self.place.along = of_length_1(&direction);
        self
    }
}

/// The sphere, with a direction of length 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PlaceOfSphere<S> {
    pub(super) at: At,
    pub(super) radius: S,
    pub(super) along: [S; 3],
    pub(super) is_hollow: bool,
}

impl<S> PlaceOfSphere<S> {
    pub(super) fn without_numbers(&self) -> PlaceOfSphere<()> {
        PlaceOfSphere {
            at: self.at,
            radius: (),
            along: [(); 3],
            is_hollow: self.is_hollow,
        }
    }
}

impl<S: Scalar> PlaceOfSphere<S> {
    pub(super) fn lifted<const N: usize>(self) -> PlaceOfSphere<Forward<S, N>> {
        PlaceOfSphere {
            at: self.at,
            radius: Forward::fixed(self.radius),
            along: self.along.map(Forward::fixed),
            is_hollow: self.is_hollow,
        }
    }
}

impl<S: Real> PlaceOfSphere<S> {
    /// What is not acceptable of it beside a ball of a radius, by its setting.
    pub(super) fn check(&self, of_ball: S) -> Result<(), (&'static str, S)> {
        let is_radius = self.radius >= S::zero() && self.radius.is_finite();
        // Two points have no direction, and a bowl has room for the ball.
        let has_room = if self.is_hollow {
            self.radius > of_ball
        } else {
            self.radius + of_ball > S::zero()
        };
        if !is_radius || !has_room {
            return Err(("radius of a sphere", self.radius));
        }
        match self.along.iter().find(|component| !component.is_finite()) {
            Some(component) => Err(("along", *component)),
            None => Ok(()),
        }
    }
}
