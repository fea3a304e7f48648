//! Slip at contacts: how it is read, and what of it counts as nothing.

use crate::math::scalar::Real;
use crate::math::vec3::{plus, times};
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::cone_problem::length;
use crate::nonsmooth::mode::InteractionMode;
use crate::nonsmooth::pace::SlipHere;
use crate::nonsmooth::place::dot;
use crate::nonsmooth::reader::Reader;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::sizes::{ENDED, ROUND_OFF, part};
use crate::nonsmooth::status::{Status, Tracked};

/// The cosine below which slip has passed its zero, and not turned.
const OPPOSITE: f64 = -0.9;

/// The places of the friction of a contact.
pub(super) fn tangents_of<S: Real, M: Mechanism>(
    list: &[Tracked<S, M>],
    contact: usize,
) -> [Option<usize>; 2] {
    [1, 2].map(|behind| {
        let index = contact.checked_add(behind)?;
        let tangent = list.get(index)?.tangent()?;
        (tangent.behind == behind).then_some(index)
    })
}

impl<S: Real, M: Mechanism> Tracked<S, M> {
    /// The contact of friction that stands at an index.
    pub(super) fn contact(&self, index: usize) -> Option<usize> {
        index.checked_sub(self.tangent()?.behind)
    }

    /// The slip at its contact, along the directions in which that has friction.
    pub(super) fn slip(&self, reader: &mut Reader<'_, S, M>) -> Slip<S> {
        let has_both = self.tangent().is_some_and(|tangent| tangent.has_both);
        let Some(touch) = reader.touch(&self.interaction.quantity) else {
            return Slip {
                components: [S::zero(); 2],
                directions: [[S::zero(); 3]; 2],
                vector: [S::zero(); 3],
            };
        };
        let [along, across] = touch.slip;
        let components = [along, if has_both { across } else { S::zero() }];
        Slip {
            components,
            directions: touch.directions,
            vector: touch.slip_vector(has_both),
        }
    }

    /// Whether its contact slips, and it tells how: the friction in the first direction does.
    fn tells_slip(&self) -> bool {
        let is_first = self.tangent().is_some_and(|tangent| tangent.behind == 1);
        is_first && self.mode() == InteractionMode::Slipping
    }

    /// The direction of the slip at its contact, along the directions of its surface. Beyond its
    /// zero, as a step that ends its mode looks there, it is the one until then: so the friction of
    /// a step goes on smoothly. Slip that only turns does not come near the opposite direction.
    pub(super) fn direction_of_slip(&self, reader: &mut Reader<'_, S, M>) -> [S; 2] {
        if !self.tells_slip() {
            return [S::zero(); 2];
        }
        let slip = self.slip(reader);
        let [along, across] = slip.components;
        let size = length([along, across]);
        let known = self.status.slip;
        if self.status.ends || self.has_ended(size) {
            return slip.along(&known);
        }
        let is_opposite = dot(&known, &slip.vector) < S::constant(OPPOSITE) * size;
        let divisor = if is_opposite { -size } else { size };
        [along.quotient(divisor), across.quotient(divisor)]
    }

    /// The same where modes have just begun.
    pub(super) fn direction_at_beginning(&self, reader: &mut Reader<'_, S, M>) -> [S; 2] {
        if self.begins() && self.tells_slip() {
            self.slip(reader).along(&self.status.slip)
        } else {
            self.direction_of_slip(reader)
        }
    }

    /// The same where modes are chosen, after impulses. Slip that is none keeps what it had.
    pub(super) fn direction_to_choose(&self, reader: &mut Reader<'_, S, M>) -> [S; 2] {
        let slip = self.slip(reader);
        let size = length(slip.components);
        let Status {
            slip: known,
            before,
            ..
        } = self.status;
        let went_on = before == InteractionMode::Slipping && dot(&known, &slip.vector) > S::zero();
        if went_on && self.has_ended(size) {
            return slip.along(&known);
        }
        let size = size.max(S::smallest());
        slip.components.map(|component| component.quotient(size))
    }

    /// Whether slip of a size (m/s) is none.
    fn has_ended(&self, size: S) -> bool {
        let none = part::<S>(ENDED, ROUND_OFF) * self.status.largest;
        size <= none.max(S::smallest())
    }

    /// Its slip, of which a direction is that of what drives it within a moment (s).
    pub(crate) fn slip_at(&self, scene: &Scene<'_, S, M>, moment: S) -> SlipHere<S> {
        if !self.tells_slip() {
            return SlipHere {
                direction: self.status.slip,
                pace: None,
                led: None,
            };
        }
        let mut reader = Reader::of(scene);
        let direction = self.direction_of_slip(&mut reader);
        let slip = self.slip(&mut reader);
        let size = length(slip.components);
        SlipHere {
            direction: combined(&slip.directions, direction),
            pace: self.status.pace_of(size, scene.time),
            led: self.status.led(size, moment),
        }
    }

    /// How far (m/s) slip that begins is beyond its beginning.
    pub(crate) fn begun(&self, scene: &Scene<'_, S, M>) -> Option<S> {
        let beginning = self.status.beginning.filter(|_| self.begins())?;
        let slip = self.slip(&mut Reader::of(scene));
        Some(length(slip.components) - beginning)
    }
}

/// Slip at a contact.
pub(super) struct Slip<S> {
    /// Along both directions of the surface (m/s).
    pub(super) components: [S; 2],
    pub(super) directions: [[S; 3]; 2],
    /// The same (global).
    pub(super) vector: [S; 3],
}

impl<S: Real> Slip<S> {
    /// A direction (global) along both directions of the surface, of length 1.
    fn along(&self, direction: &[S; 3]) -> [S; 2] {
        let [x, y] = self.directions.each_ref().map(|way| dot(way, direction));
        let size = length([x, y]).max(S::smallest());
        [x.quotient(size), y.quotient(size)]
    }
}

/// A vector along two directions.
pub(super) fn combined<S: Real>([along, across]: &[[S; 3]; 2], [x, y]: [S; 2]) -> [S; 3] {
    plus(&times(along, x), &times(across, y))
}

/// What counts as nothing in one direction of a contact is told by the velocities in both.
pub(super) fn share_sizes<S: Real, M: Mechanism, const K: usize>(list: &mut [Tracked<S, M>; K]) {
    for contact in 0..K {
        let places = tangents_of(list, contact);
        let size = |index: usize| list.get(index).map(|tracked| tracked.status.largest);
        let sizes = places.into_iter().flatten().filter_map(size);
        let largest = sizes.fold(S::zero(), S::max);
        for index in places.into_iter().flatten() {
            if let Some(tracked) = list.get_mut(index) {
                tracked.status.largest = largest;
            }
        }
    }
}
