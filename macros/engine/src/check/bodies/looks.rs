//! Shapes of a body whose mass and inertia are given: it looks like them, and nothing follows.

use syn::Expr;

use super::lumps::Frame;
use super::reader::Reader;
use super::shape::{Axes, Written};
use crate::model::number::literals;
use crate::model::{Number, Shape};

impl Reader<'_, '_> {
    /// What is drawn of a body with this centre of mass and these axes.
    pub(super) fn looks(
        &mut self,
        [single, several]: [Option<&Expr>; 2],
        position: Option<[Number; 3]>,
        orientation: Option<[Number; 4]>,
    ) -> Option<Vec<Shape>> {
        if single.is_none() && several.is_none() {
            return Some(Vec::new());
        }
        let formulas = self.written(single, several, false)?;
        let (position, orientation) = (position?, orientation?);
        let body = literals(&position).zip(literals(&orientation));
        let body = body.map(|(centre, axes)| Frame { centre, axes });
        let shapes = formulas.iter().map(|shape| self.look(shape, body));
        let shapes: Vec<_> = shapes.collect();
        shapes.into_iter().collect()
    }

    fn look(&mut self, shape: &Written<'_>, body: Option<Frame>) -> Option<Shape> {
        self.at("shape");
        let (centre, axes) = match shape {
            Written::Mesh(mesh) => (mesh.frame.centre.map(Some), Some(mesh.frame.axes)),
            Written::Formulas(formulas) => {
                let centre = formulas.centre.each_ref().map(|x| self.written_number(x));
                let axes = match (&formulas.axes, body) {
                    (Axes::Body, Some(body)) => Some(body.axes),
                    _ => literals(&self.own_axes(formulas)?),
                };
                (centre, axes)
            }
        };
        match (body, centre, axes) {
            (Some(body), [Some(x), Some(y), Some(z)], Some(axes)) => {
                let centre = [x, y, z];
                self.on_body(shape, Frame { centre, axes }.unit(), body.unit(), false)
            }
            _ => {
                self.faults.at(
                    shape.call(),
                    "a shape beside `mass` and `inertia` is only drawn; its points, and `position` and \
                     `orientation` of the body, must be numbers that the macro can see",
                );
                None
            }
        }
    }

    fn written_number(&mut self, number: &Expr) -> Option<f64> {
        let part = self.numbers.part(number, self.faults)?;
        part.seen.filter(|_| part.is_written)
    }
}
