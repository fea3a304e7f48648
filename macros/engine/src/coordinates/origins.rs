//! Where origins of links are against those of their carriers, and how they move.

use super::algebra::{add, apply, scale};
use super::frames::{FrameId, Frames};
use super::freedom::Freedom;
use super::links::Links;
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::vector::{Triple, ZERO};

/// How vectors are brought to global axes.
#[derive(Clone, Debug)]
pub(super) enum ToGround {
    /// From frame to frame: what a single vector of few frames takes.
    Stepwise,
    /// By the rotation of each frame, which takes that of the one that it is based on: where all
    /// vectors are wanted, no more than their number.
    ByRotations(Vec<[Triple; 3]>),
}

impl ToGround {
    /// Global components of a vector.
    pub(super) fn turn(
        &self,
        arena: &mut Arena,
        links: &Links,
        v: Triple,
        from: FrameId,
    ) -> Triple {
        match self {
            Self::Stepwise => links.frames.turn(arena, v, from, Frames::GROUND),
            Self::ByRotations(rotations) => apply(arena, rotations[from.place()], v),
        }
    }
}

impl Links {
    /// The origin of a link from that of its carrier, in the axes of the carrier's motion.
    pub fn offset(&self, arena: &mut Arena, link: usize) -> Triple {
        let own = &self.links[link];
        let mut offset = own.offset;
        match own.freedom {
            Freedom::Slide { along, rest } => {
                let x = arena.input(Input::Coordinate((2 * self.turns + rest) as u32));
                let moved = scale(arena, x, along);
                offset = add(arena, offset, moved);
            }
            Freedom::Screw { counter, .. } => {
                let first = 2 * self.turns + self.rest;
                let angle = arena.input(Input::Coordinate((first + counter) as u32));
                let moved = self.advanced(arena, link, angle);
                offset = add(arena, offset, moved);
            }
            Freedom::Turn { .. } | Freedom::Ball { .. } => {}
        }
        self.in_axes(arena, offset, own.carrier)
    }

    /// How far a screw moves by an angle of its joint, in the frame of its carrier; nothing else
    /// does.
    pub(super) fn advanced(&self, arena: &mut Arena, link: usize, angle: Expr) -> Triple {
        let Freedom::Screw {
            axis,
            is_reversed,
            advance,
            ..
        } = self.links[link].freedom
        else {
            return ZERO;
        };
        let way = arena.mul(advance, angle);
        let along = self.axis_on_carrier(arena, link, axis);
        scale(arena, if is_reversed { -way } else { way }, along)
    }

    /// The velocity of a link's origin against its carrier, per unit of the link's own, in the axes
    /// of the carrier's motion; `None` of what turns on its place.
    pub(super) fn origin_rate(&self, arena: &mut Arena, link: usize) -> Option<Triple> {
        match self.links[link].freedom {
            Freedom::Slide { .. } => self.slide(arena, link),
            Freedom::Screw { axis, advance, .. } => {
                let along = self.axis_on_carrier(arena, link, axis);
                let along = scale(arena, advance, along);
                Some(self.in_axes(arena, along, self.links[link].carrier))
            }
            Freedom::Turn { .. } | Freedom::Ball { .. } => None,
        }
    }

    /// The origins of all links, in global axes.
    pub(super) fn origins_in_global_axes(&self, arena: &mut Arena, way: &ToGround) -> Vec<Triple> {
        let mut origins: Vec<Triple> = Vec::new();
        for link in 0..self.links.len() {
            let carrier = self.links[link].carrier;
            let offset = self.offset(arena, link);
            let from = self.axes(carrier);
            let offset = way.turn(arena, self, offset, from);
            let carrier = carrier.map_or(ZERO, |carrier| origins[carrier]);
            origins.push(add(arena, carrier, offset));
        }
        origins
    }

    /// The direction of a slide in the axes of a link's motion.
    pub fn slide(&self, arena: &mut Arena, link: usize) -> Option<Triple> {
        let Freedom::Slide { along, .. } = self.links[link].freedom else {
            return None;
        };
        Some(self.in_axes(arena, along, Some(link)))
    }
}
