//! What the motion cannot tell apart: where origins lie on the axes of turns, and which link a part
//! of the inertia belongs to.

use super::algebra::{Inertia, NOTHING, add_tensors, scale, scale_tensor, sub};
use super::freedom::Freedom;
use super::handover::Handover;
use super::links::Links;
use crate::symbolic::arena::Arena;
use crate::symbolic::vector::{Triple, ZERO};

/// How far an origin moves at most, in lengths of its offset. Seen from far away an inertia is a
/// small difference of large numbers.
const FARTHEST: f64 = 4.0;

impl Links {
    /// Moves the origins of turning links along their axes to where offsets have the most zeros.
    pub(super) fn slide_origins(&mut self, arena: &mut Arena) {
        for link in 0..self.links.len() {
            let Some((axis, _)) = self.links[link].freedom.turn() else {
                continue;
            };
            let own = self.links[link].offset;
            // The axis as the carrier sees it, in the reference configuration.
            let along = self.axis_on_carrier(arena, link, axis);
            let mut best = (self.zeros(arena, link, along, axis, 0.0), 0.0);
            let size = own.iter().filter_map(|&x| arena.literal(x));
            let size = size.fold(0.0, |sum: f64, x| sum.hypot(x));
            for k in 0..3 {
                let (Some(x), Some(a)) = (arena.literal(own[k]), arena.literal(along[k])) else {
                    continue;
                };
                let distance = -x / a;
                let is_near = distance.abs() <= FARTHEST * size;
                if !is_near {
                    continue;
                }
                let zeros = self.zeros(arena, link, along, axis, distance);
                if zeros > best.0 {
                    best = (zeros, distance);
                }
            }
            if best.1 != 0.0 {
                self.slide_origin(arena, link, along, axis, best.1);
            }
        }
    }

    /// The zeros among the offsets of a link and of those that it carries, were its origin moved.
    fn zeros(
        &self,
        arena: &mut Arena,
        link: usize,
        along: Triple,
        axis: usize,
        distance: f64,
    ) -> usize {
        let distance = arena.constant(distance);
        let offset = moved(arena, self.links[link].offset, along, distance);
        let mut zeros = offset.iter().filter(|&&x| x == Arena::ZERO).count();
        for child in self.children(Some(link)) {
            let offset = moved(arena, self.links[child].offset, Self::unit(axis), -distance);
            zeros += offset.iter().filter(|&&x| x == Arena::ZERO).count();
        }
        zeros
    }

    fn slide_origin(
        &mut self,
        arena: &mut Arena,
        link: usize,
        along: Triple,
        axis: usize,
        distance: f64,
    ) {
        let distance = arena.constant(distance);
        self.links[link].offset = moved(arena, self.links[link].offset, along, distance);
        let shift = Self::unit(axis);
        let back = scale(arena, -distance, shift);
        let inertia = self.links[link].inertia;
        self.links[link].inertia = inertia.seen_at(arena, back);
        for child in 0..self.links.len() {
            if self.links[child].carrier == Some(link) {
                self.links[child].offset = moved(arena, self.links[child].offset, shift, -distance);
            }
        }
        for body in &mut self.bodies {
            if body.link == Some(link) {
                body.centre = moved(arena, body.centre, shift, -distance);
            }
        }
    }

    /// Hands on to the carrier, from the leaves to the ground, what is the same whether it moves
    /// with the link or with its carrier: of a link that turns, its mass, its first moment along
    /// the axis and an equal share of the two transverse moments of inertia; of a screw, that share
    /// alone, for its mass moves along; of a ball, its mass; of a slide, its inertia, for it turns
    /// with the carrier.
    ///
    /// The equations of motion stay what they are; reactions do not. Masses are handed over closing
    /// joints on the way.
    pub(super) fn regroup(&mut self, arena: &mut Arena, handovers: &mut [Handover]) {
        for link in self.leaves_first() {
            for handover in handovers.iter_mut().filter(|given| given.giver == link) {
                self.hand_over(arena, handover);
            }
            let own = self.links[link].clone();
            let inertia = own.inertia;
            let mut part = Inertia {
                mass: inertia.mass,
                ..Inertia::NONE
            };
            match own.freedom {
                Freedom::Turn { axis, .. } => {
                    let (k, l) = ((axis + 1) % 3, (axis + 2) % 3);
                    part.first[axis] = inertia.first[axis];
                    part.tensor[k][k] = inertia.tensor[l][l];
                    part.tensor[l][l] = inertia.tensor[l][l];
                }
                Freedom::Ball { .. } => {}
                Freedom::Screw { axis, .. } => {
                    let (k, l) = ((axis + 1) % 3, (axis + 2) % 3);
                    part.mass = Arena::ZERO;
                    part.tensor[k][k] = inertia.tensor[l][l];
                    part.tensor[l][l] = inertia.tensor[l][l];
                }
                Freedom::Slide { .. } => {
                    part.mass = Arena::ZERO;
                    part.tensor = inertia.tensor;
                }
            }
            let minus = scale_tensor(arena, -Arena::ONE, part.tensor);
            self.links[link].inertia = Inertia {
                mass: arena.sub(inertia.mass, part.mass),
                first: sub(arena, inertia.first, part.first),
                tensor: add_tensors(arena, inertia.tensor, minus),
            };
            let Some(carrier) = own.carrier else { continue };
            if part.mass == Arena::ZERO && part.first == ZERO && part.tensor == NOTHING {
                continue;
            }
            let onto = self.part_on_carrier(arena, link, part);
            let sum = self.links[carrier].inertia.plus(arena, onto);
            self.links[carrier].inertia = sum;
        }
    }
}

/// `offset + distance along`, without round-off.
fn moved(
    arena: &mut Arena,
    offset: Triple,
    along: Triple,
    distance: crate::symbolic::arena::Expr,
) -> Triple {
    let scale_of = crate::symbolic::fixed::size(arena, offset);
    let shift = scale(arena, distance, along);
    let sum = super::algebra::add(arena, offset, shift);
    crate::symbolic::fixed::clean(arena, sum, scale_of)
}
