//! Angles between bodies that turn by pairs about one axis: what a force, a driver or a reading
//! asks for is then known without any rotation matrix.

use super::frames::FrameId;
use super::links::Links;
use crate::symbolic::arena::{Arena, Expr};
use crate::symbolic::expression::PairedAngle;
use crate::symbolic::vector::Triple;

impl Links {
    /// The angle of the second body against the first about an axis, which is given in the
    /// reference configuration by a vector of unit length; `None` where anything else turns one
    /// against the other.
    pub(super) fn angle(
        &self,
        arena: &mut Arena,
        bodies: [Option<usize>; 2],
        axis: Triple,
    ) -> Option<PairedAngle> {
        let [mut from, mut to] =
            bodies.map(|body| self.frame_of(body.and_then(|body| self.bodies[body].link)));
        let mut angle = PairedAngle::ZERO;
        while from != to {
            // Frames between the first body and the other count backwards.
            let is_backwards = from > to;
            let frame = if is_backwards { &mut from } else { &mut to };
            if !self.frames.is_fixed(*frame) {
                let (sign, velocity, pair) = self.turn_about(arena, *frame, axis)?;
                let (_, c, s) = self.frames.pair(*frame)?;
                let [c, s] = self.since_reference(arena, pair, [c, s]);
                let sign = if is_backwards { -sign } else { sign };
                angle = angle.plus(arena, velocity, c, s, sign);
            }
            *frame = self.frames.base(*frame);
        }
        Some(angle)
    }

    /// Cosine and sine of the angle since the reference configuration, of those of a pair.
    pub(super) fn since_reference(
        &self,
        arena: &mut Arena,
        pair: usize,
        [c, s]: [Expr; 2],
    ) -> [Expr; 2] {
        let [from_c, from_s] = self.angles[pair];
        let [cc, ss, sc, cs] =
            [(c, from_c), (s, from_s), (s, from_c), (c, from_s)].map(|(a, b)| arena.mul(a, b));
        [arena.add(cc, ss), arena.sub(sc, cs)]
    }

    /// The sense in which a frame turns about an axis against the frame that it is based on, the
    /// velocity and the pair; `None` where it turns otherwise.
    fn turn_about(
        &self,
        arena: &Arena,
        frame: FrameId,
        axis: Triple,
    ) -> Option<(Expr, usize, usize)> {
        let (own, ..) = self.frames.pair(frame)?;
        let direction = self.rotation_into(frame)[own];
        let opposite = direction.map(|component| -component);
        let sign = if same(arena, direction, axis) {
            Arena::ONE
        } else if same(arena, opposite, axis) {
            -Arena::ONE
        } else {
            return None;
        };
        self.links
            .iter()
            .find_map(|link| match link.freedom.turn() {
                Some((_, pair)) if link.frame == frame => Some((sign, link.velocity, pair)),
                _ => None,
            })
    }
}

/// Whether two unit vectors are the same but for round-off.
fn same(arena: &Arena, a: Triple, b: Triple) -> bool {
    /// Three rotations of unit vectors.
    const ROUND_OFF: f64 = 24.0 * f64::EPSILON;
    a.iter().zip(b).all(|(&a, b)| {
        let both = arena.literal(a).zip(arena.literal(b));
        a == b || both.is_some_and(|(a, b)| (a - b).abs() <= ROUND_OFF)
    })
}
