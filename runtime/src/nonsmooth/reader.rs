//! Quantities of a list, read in its order.

use crate::forward::Forward;
use crate::math::scalar::Scalar;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::readout::ContactPoint;
use crate::nonsmooth::place::At;
use crate::nonsmooth::quantity::Quantity;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::shape::{Shape, Surface, Touch};
use crate::state::vector::Array;

/// Reads quantities of a scene. Friction stands behind its contact: what touches there is looked at
/// once for all of them.
pub(crate) struct Reader<'s, S: Scalar, M: Mechanism> {
    scene: Scene<'s, S, M>,
    last: Option<Contact<S>>,
}

/// A contact, and what touches there.
struct Contact<S> {
    at: At,
    surface: Surface<S>,
    shape: Shape<S>,
    touch: Touch<S>,
}

impl<'s, S: Scalar, M: Mechanism> Reader<'s, S, M> {
    pub(crate) fn of(scene: &Scene<'s, S, M>) -> Self {
        Self {
            scene: *scene,
            last: None,
        }
    }

    /// What touches at a contact; `None` of what is none.
    pub(super) fn touch(&mut self, quantity: &Quantity<S>) -> Option<&Touch<S>> {
        let (at, surface, shape) = quantity.contact_parts()?;
        let is_last = self
            .last
            .as_ref()
            .is_some_and(|last| last.at == *at && last.surface == *surface && last.shape == *shape);
        if !is_last {
            self.last = Some(Contact {
                at: *at,
                surface: *surface,
                shape: *shape,
                touch: self.scene.touch(*at, surface, shape),
            });
        }
        self.last.as_ref().map(|last| &last.touch)
    }

    /// The rate of a quantity.
    pub(crate) fn rate(&mut self, quantity: &Quantity<S>) -> S {
        match self.touch(quantity) {
            Some(touch) => touch.rate_along(quantity.direction()),
            None => quantity.rate_between(&self.scene),
        }
    }

    /// Calls with every velocity of the bodies of a quantity, and its part in the rate.
    pub(crate) fn each_part(&mut self, quantity: &Quantity<S>, each: impl FnMut(usize, S)) {
        let scene = self.scene;
        match (quantity.contact_parts(), self.touch(quantity)) {
            (Some((at, surface, _)), Some(touch)) => {
                let direction = quantity.direction();
                scene.each_part_of_touch((*at, surface, touch), direction, each);
            }
            _ => quantity.each_part_between(&scene, each),
        }
    }
}

/// Reads rates in a scene that carries derivatives.
pub(crate) struct LiftedReader<'s, S: Scalar, M: Mechanism, const N: usize> {
    reader: Reader<'s, Forward<S, N>, M>,
    last: Option<Quantity<S>>,
}

impl<'s, S: Scalar, M: Mechanism, const N: usize> LiftedReader<'s, S, M, N> {
    pub(crate) fn of(scene: &Scene<'s, Forward<S, N>, M>) -> Self {
        Self {
            reader: Reader::of(scene),
            last: None,
        }
    }

    /// The rate of a quantity.
    pub(crate) fn rate(&mut self, quantity: &Quantity<S>) -> Forward<S, N> {
        let is_last = self
            .last
            .as_ref()
            .is_some_and(|last| last.contact_parts() == quantity.contact_parts());
        if let (true, Some(contact)) = (is_last, &self.reader.last) {
            return contact.touch.rate_along(quantity.direction());
        }
        self.last = quantity.is_contact().then_some(*quantity);
        self.reader.rate(&quantity.lifted())
    }
}

impl<S: Scalar> Quantity<S> {
    /// Where a contact is; `None` of what is none.
    pub(crate) fn contact<M: Mechanism>(&self, scene: &Scene<'_, S, M>) -> Option<ContactPoint<S>> {
        Reader::of(scene).touch(self).map(Touch::contact)
    }

    /// Its rate.
    pub(crate) fn rate<M: Mechanism>(&self, scene: &Scene<'_, S, M>) -> S {
        Reader::of(scene).rate(self)
    }

    /// Calls with every velocity of its bodies, and its part in the rate.
    pub(crate) fn each_part<M: Mechanism>(
        &self,
        scene: &Scene<'_, S, M>,
        each: impl FnMut(usize, S),
    ) {
        Reader::of(scene).each_part(self, each);
    }

    /// Adds an effort to the forces on the bodies, by its power.
    pub(crate) fn add_effort<M: Mechanism>(
        &self,
        scene: &Scene<'_, S, M>,
        effort: S,
        forces: &mut M::Velocities<S>,
    ) {
        self.each_part(scene, |place, part| {
            if let Some(force) = forces.as_mut_slice().get_mut(place) {
                *force = *force + effort * part;
            }
        });
    }
}
