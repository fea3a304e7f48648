//! Components from one frame to another.

use super::{Frame, Space, Triple, ZERO, dot};
use crate::symbolic::rotation::turn_between;

impl Space {
    /// Components in another frame.
    pub fn turn(&mut self, components: Triple, from: Frame, to: Frame) -> Triple {
        if from == to || components == ZERO {
            return components;
        }
        match (from, to) {
            (Frame::Body(body), Frame::Global) => match self.rotations[body] {
                Some(rows) => rows.map(|row| dot(&mut self.arena, row, components)),
                None => components,
            },
            (Frame::Global, Frame::Body(body)) => match self.rotations[body] {
                Some(rows) => [0, 1, 2].map(|k| {
                    let column = [rows[0][k], rows[1][k], rows[2][k]];
                    dot(&mut self.arena, column, components)
                }),
                None => components,
            },
            _ => {
                let global = self.turn(components, from, Frame::Global);
                self.turn(global, Frame::Global, to)
            }
        }
    }

    /// Says that vectors may be turned from one body to another by the rotation between them.
    pub(in crate::symbolic) fn know_relation(&mut self, one: usize, other: usize) {
        let pair = [one.min(other), one.max(other)];
        if !self.related.contains(&pair) {
            self.related.push(pair);
        }
    }

    pub(super) fn is_related(&self, from: Frame, to: Frame) -> bool {
        match (from, to) {
            (Frame::Body(one), Frame::Body(other)) => {
                self.related.contains(&[one.min(other), one.max(other)])
            }
            _ => false,
        }
    }

    /// Components in the axes of another body, not by way of global axes.
    pub(super) fn turn_at_once(&mut self, components: Triple, from: Frame, to: Frame) -> Triple {
        let of = |frame: Frame| match frame {
            Frame::Body(body) => self.rotations[body],
            Frame::Global => None,
        };
        match (of(from), of(to)) {
            (Some(from), Some(to)) => turn_between(&mut self.arena, components, &from, &to),
            _ => self.turn(components, from, to),
        }
    }
}
