//! What a joint gives its links: points, directions and pitches.

use super::links::Links;
use super::spanning::Carried;
use crate::model::{Binding, Direction, Model, Turn};
use crate::symbolic::arena::{Arena, Expr};
use crate::symbolic::bind::advance;
use crate::symbolic::fixed::{axis_and_normals, triple};
use crate::symbolic::vector::Triple;

impl Carried {
    /// A point of the joint in the reference configuration.
    pub(super) fn point(&self, arena: &mut Arena, model: &Model, parameter: usize) -> Triple {
        match self
            .joint
            .map(|joint| &model.joints[joint].bindings[parameter])
        {
            Some(Binding::Global(given)) => triple(arena, *given),
            // A body without a joint turns about its centre of mass.
            _ => triple(arena, model.bodies[self.body].position),
        }
    }

    /// The place among all auxiliary variables of that which counts the turns of its screw.
    pub(super) fn counter(&self, model: &Model, axis: usize) -> usize {
        let turn = Turn::of_joint(axis);
        let mut counters = model.counters().into_iter();
        let place = counters
            .position(|counter| Some(counter.element) == self.joint && counter.turn == turn);
        place.expect("the definition of a screw counts its turns")
    }

    /// The translation of its screw for a radian.
    pub(super) fn advance(&self, arena: &mut Arena, model: &Model, pitch: usize) -> Expr {
        self.joint.map_or(Arena::ZERO, |joint| {
            advance(arena, model, &model.joints[joint], pitch)
        })
    }

    /// A direction of the joint in the reference configuration, of unit length.
    pub(super) fn direction(
        &self,
        arena: &mut Arena,
        model: &Model,
        direction: Direction,
    ) -> Triple {
        match self
            .joint
            .map(|joint| &model.joints[joint].bindings[direction.parameter])
        {
            Some(Binding::Global(given)) => {
                let given = triple(arena, *given);
                let axes = axis_and_normals(arena, given);
                axes[direction.normal.map_or(0, |normal| normal + 1)]
            }
            // A body without a joint slides along the global axes.
            _ => Links::unit(direction.parameter),
        }
    }
}
