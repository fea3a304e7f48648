//! What follows for a body from its shapes: mass, centre of mass, axes and moments.
//!
//! One shape may have parameters: everything is a formula then, and the axes of the body are those
//! of the shape. Of several shapes, and in other axes, principal axes are to be found, which takes
//! numbers.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, ExprCall, ExprParen, parse_quote, token};

use super::formula::product;
use super::lumps::{Frame, Lump, about, norm, turned, unit};
use super::reader::{AS_GIVEN, Reader};
use super::rotation::cross;
use super::shape::{Axes, Formulas, Written};
use crate::check::number::elements;
use crate::check::pairs::Pairs;
use crate::model::inertia::{IDENTITY, compose, euler_parameters, principal, rotation};
use crate::model::number::literals;
use crate::model::{Number, Shape};

/// A body, as far as it follows from shapes.
pub(super) struct Solid {
    pub(super) mass: Number,
    pub(super) inertia: [Number; 3],
    pub(super) user_axes: [f64; 4],
    pub(super) position: [Number; 3],
    pub(super) orientation: [Number; 4],
    pub(super) shapes: Vec<Shape>,
    /// See [`crate::model::Body::as_given`].
    pub(super) as_given: bool,
}

/// Why a key is refused beside a shape.
const FOLLOWS: &str = "it follows from the shape";

/// What the mass is made of.
#[derive(Clone, Copy)]
enum Weight<'a> {
    Mass(&'a Expr),
    Density(&'a Expr),
    /// Every shape has its own.
    Densities,
}

impl Reader<'_, '_> {
    /// The body that `shape` or `shapes` describe.
    pub(super) fn solid(&mut self, pairs: &mut Pairs<'_>, owner: Span) -> Option<Solid> {
        let single = pairs.optional("shape", self.faults);
        let several = pairs.optional("shapes", self.faults);
        let mass = pairs.optional("mass", self.faults);
        let density = pairs.optional("density", self.faults);
        let orientation = pairs.optional("orientation", self.faults);
        for key in ["inertia", "inertia_axes", "position", AS_GIVEN] {
            pairs.refuse(key, FOLLOWS, self.faults);
        }
        let shapes = self.written(single, several, true)?;
        let owner = (!pairs.is_unreadable()).then_some(owner);
        let weight = self.weight(&shapes, mass, density, owner)?;
        match &shapes[..] {
            [Written::Formulas(shape)]
                if orientation.is_none() || matches!(shape.axes, Axes::Body) =>
            {
                self.one(shape, weight, orientation)
            }
            _ => self.in_numbers(&shapes, weight, orientation),
        }
    }

    /// Either `shape` or `shapes`; nothing without a fault.
    pub(super) fn written<'e>(
        &mut self,
        single: Option<&'e Expr>,
        several: Option<&'e Expr>,
        own_densities: bool,
    ) -> Option<Vec<Written<'e>>> {
        match (single, several) {
            (Some(single), None) => Some(vec![self.shape(single, false)?]),
            (None, Some(several)) => self.shapes(several, own_densities),
            (Some(_), Some(several)) => {
                let message = "a body has one `shape`, or several `shapes`; give either";
                self.faults.at(several, message);
                None
            }
            // Something that was reported.
            (None, None) => None,
        }
    }

    fn shapes<'e>(&mut self, expr: &'e Expr, own_densities: bool) -> Option<Vec<Written<'e>>> {
        let several = elements(expr).unwrap_or_default();
        if several.is_empty() {
            let message = "expected shapes in brackets, as in `[ball(..), cylinder(..)]`";
            self.faults.at(expr, message);
            return None;
        }
        let shapes: Vec<_> = several
            .into_iter()
            .map(|shape| self.shape(shape, own_densities))
            .collect();
        shapes.into_iter().collect()
    }

    fn weight<'e>(
        &mut self,
        shapes: &[Written<'_>],
        mass: Option<&'e Expr>,
        density: Option<&'e Expr>,
        owner: Option<Span>,
    ) -> Option<Weight<'e>> {
        let name = self.name;
        let own: Vec<&Expr> = shapes.iter().filter_map(Written::density).collect();
        match (mass, density) {
            (Some(mass), Some(_)) => {
                let message = format!("`{name}` has a `mass` and a `density`; give either");
                self.faults.at(mass, message);
                None
            }
            (Some(_), None) if !own.is_empty() => {
                let message = "the mass of all shapes is given; leave out their densities";
                own.iter().for_each(|own| self.faults.at(own, message));
                None
            }
            (Some(mass), None) => Some(Weight::Mass(mass)),
            (None, Some(density)) => {
                self.at("density");
                let part = self.numbers.part(density, self.faults)?;
                if let Some(value) = part.seen.filter(|value| *value <= 0.0) {
                    self.faults.at(
                        density,
                        format!(
                            "the density of `{name}` must be positive, in kg/m^3; this is {value}; a hole is one of several `shapes` with a negative density of its own"
                        ),
                    );
                    return None;
                }
                Some(Weight::Density(density))
            }
            (None, None) if own.len() == shapes.len() => Some(Weight::Densities),
            (None, None) => {
                let message = format!(
                    "body `{name}` lacks `density`; give one in kg/m^3, as in `density = 7850.0`, or a `mass` in kg"
                );
                if let Some(owner) = owner {
                    self.faults.at_span(owner, message);
                }
                None
            }
        }
    }

    /// By formulas, in the axes of the shape.
    fn one(
        &mut self,
        shape: &Formulas<'_>,
        weight: Weight<'_>,
        orientation: Option<&Expr>,
    ) -> Option<Solid> {
        let at = shape.call.span();
        let mass = match weight {
            Weight::Mass(mass) => mass.clone(),
            Weight::Density(density) => product(density, &shape.volume.volume),
            Weight::Densities => product(shape.density?, &shape.volume.volume),
        };
        let number = self.mass(&at_span(&mass, at));
        self.at("inertia");
        let inertia = shape
            .volume
            .moments
            .each_ref()
            .map(|moment| product(&mass, moment));
        let inertia = at_span(&parse_quote!([#(#inertia),*]), at);
        let moments: Option<[Number; 3]> = self.numbers.array(&inertia, self.faults);
        let moments = moments.filter(|moments| self.moments(&inertia, *moments).is_some());
        self.at("position");
        let centre = &shape.centre;
        let position = self
            .numbers
            .array(&at_span(&parse_quote!([#(#centre),*]), at), self.faults);
        let orientation = match orientation {
            Some(orientation) => self.orientation("orientation", orientation),
            None => self.own_axes(shape),
        };
        let drawn = self.drawn(shape, [0.0; 3], IDENTITY, false);
        Some(Solid {
            mass: number?,
            inertia: moments?,
            user_axes: IDENTITY,
            position: position?,
            orientation: orientation?,
            shapes: vec![drawn?],
            as_given: false,
        })
    }

    /// What a shape looks like, at a place on its body.
    fn drawn(
        &mut self,
        shape: &Formulas<'_>,
        centre: [f64; 3],
        axes: [f64; 4],
        is_hole: bool,
    ) -> Option<Shape> {
        self.at("shape");
        let sizes = &shape.volume.sizes;
        let sizes = at_span(&parse_quote!([#(#sizes),*]), shape.call.span());
        Some(Shape {
            kind: shape.volume.kind,
            sizes: self.numbers.array(&sizes, self.faults)?,
            centre,
            axes,
            is_hole,
            file: None,
        })
    }

    /// A shape on a body, both in global axes.
    pub(super) fn on_body(
        &mut self,
        shape: &Written<'_>,
        own: Frame,
        body: Frame,
        is_hole: bool,
    ) -> Option<Shape> {
        let (a, [e0, e1, e2, e3]) = (rotation(body.axes), body.axes);
        let s = [0, 1, 2].map(|k| own.centre[k] - body.centre[k]);
        let s = [0, 1, 2].map(|l| (0..3).map(|k| a[k][l] * s[k]).sum());
        let turned = compose([e0, -e1, -e2, -e3], own.axes);
        match shape {
            Written::Formulas(shape) => self.drawn(shape, s, turned, is_hole),
            Written::Mesh(mesh) => Some(Self::drawn_mesh(mesh, (s, turned), is_hole)),
        }
    }

    /// Euler parameters of a shape's axes.
    pub(super) fn own_axes(&mut self, shape: &Formulas<'_>) -> Option<[Number; 4]> {
        self.at("orientation");
        match &shape.axes {
            Axes::Body => Some(IDENTITY.map(Number::Literal)),
            Axes::Along(d, None) => {
                let p = self.leading(shape.call, 0, d)?;
                self.orientation(
                    "orientation",
                    &at_span(&parse_quote!([#(#p),*]), shape.call.span()),
                )
            }
            Axes::Along(d, Some(up)) => {
                let (d, up) = (self.seen(shape.call, d), self.components(up));
                let (d, up) = (d?, up?);
                let up = self.seen(shape.call, &up)?;
                let x = unit(d);
                let along: f64 = (0..3).map(|k| up[k] * x[k]).sum();
                let z = [0, 1, 2].map(|k| up[k] - along * x[k]);
                let least = 1e-6 * norm(up);
                if norm(z) <= least {
                    let message = "`up` is not along the bar, and not zero";
                    self.faults.at(shape.call, message);
                    return None;
                }
                let z = unit(z);
                let columns = [x, cross(z, x), z];
                let rows = [0, 1, 2].map(|row| columns.map(|column| column[row]));
                Some(euler_parameters(rows).map(Number::Literal))
            }
        }
    }

    /// Numbers that the macro can see.
    fn seen(&mut self, call: &ExprCall, parts: &[Expr; 3]) -> Option<[f64; 3]> {
        let [x, y, z] = parts;
        Some([
            self.seen_one(call, x)?,
            self.seen_one(call, y)?,
            self.seen_one(call, z)?,
        ])
    }

    fn seen_one(&mut self, call: &ExprCall, number: &Expr) -> Option<f64> {
        let part = self.numbers.part(number, self.faults)?;
        if !part.is_written {
            self.faults.at(
                call,
                "several shapes, a mesh, a given orientation and `up` need numbers that the macro can see, to find principal axes",
            );
            return None;
        }
        part.seen
    }

    fn in_numbers(
        &mut self,
        shapes: &[Written<'_>],
        weight: Weight<'_>,
        orientation: Option<&Expr>,
    ) -> Option<Solid> {
        let axes = match orientation {
            Some(orientation) => {
                self.at("orientation");
                self.seen_turn(
                    "the `orientation` of several shapes, or of a mesh,",
                    orientation,
                )?
            }
            None => IDENTITY,
        };
        let lumps: Vec<_> = shapes
            .iter()
            .map(|shape| self.lump(shape, weight, axes))
            .collect();
        let mut lumps: Vec<Lump> = lumps.into_iter().collect::<Option<_>>()?;
        let volume: f64 = lumps.iter().map(|lump| lump.mass).sum();
        if let Weight::Mass(mass) = weight {
            // So far of density 1.
            self.at("mass");
            let whole = self.seen_one(shapes[0].call(), mass)?;
            if whole <= 0.0 {
                // The sentence about it.
                self.mass(mass)?;
            }
            lumps.iter_mut().for_each(|lump| lump.scale(whole / volume));
        }
        let mass: f64 = lumps.iter().map(|lump| lump.mass).sum();
        let call = shapes[0].call();
        if mass <= 0.0 {
            let name = self.name;
            self.faults.at(
                call,
                format!("the shapes of `{name}` leave no body: their masses add up to {mass} kg"),
            );
            return None;
        }
        let moment = |k: usize| {
            lumps
                .iter()
                .map(|lump| lump.mass * lump.centre[k])
                .sum::<f64>()
        };
        let centre = [0, 1, 2].map(|k| moment(k) / mass);
        let tensor = turned(about(&lumps, centre), rotation(axes));
        let (moments, user_axes) = principal(tensor);
        let moments = moments.map(Number::Literal);
        self.moments(&Expr::Call(call.clone()), moments)?;
        let drawn = shapes.iter().zip(&lumps).map(|(shape, lump)| {
            let own = match shape {
                Written::Formulas(_) => Frame {
                    centre: lump.centre,
                    axes: lump.axes,
                },
                Written::Mesh(mesh) => mesh.frame.unit(),
            };
            let body = Frame { centre, axes };
            self.on_body(shape, own, body, lump.mass < 0.0)
        });
        let drawn: Vec<_> = drawn.collect();
        Some(Solid {
            mass: Number::Literal(mass),
            inertia: moments,
            user_axes,
            position: centre.map(Number::Literal),
            orientation: axes.map(Number::Literal),
            shapes: drawn.into_iter().collect::<Option<_>>()?,
            as_given: false,
        })
    }

    fn lump(&mut self, shape: &Written<'_>, weight: Weight<'_>, of_body: [f64; 4]) -> Option<Lump> {
        let density = match (shape.density(), weight) {
            (Some(own), _) => own.clone(),
            (None, Weight::Density(density)) => density.clone(),
            _ => parse_quote!(1.0),
        };
        let shape = match shape {
            Written::Formulas(shape) => shape,
            Written::Mesh(mesh) => {
                let density = self.seen_one(mesh.call, &density)?;
                return self.mesh_lump(mesh, density);
            }
        };
        let mass = product(&density, &shape.volume.volume);
        let mass = self.seen_one(shape.call, &mass)?;
        let centre = self.seen(shape.call, &shape.centre)?;
        let moments = self.seen(shape.call, &shape.volume.moments)?;
        let p = match &shape.axes {
            Axes::Body => of_body,
            Axes::Along(..) => literals(&self.own_axes(shape)?)?,
        };
        let a = rotation(p);
        let entry = |k: usize, l: usize| -> f64 {
            (0..3).map(|m| mass * a[k][m] * moments[m] * a[l][m]).sum()
        };
        let tensor = [0, 1, 2].map(|k| [0, 1, 2].map(|l| entry(k, l)));
        Some(Lump {
            mass,
            centre,
            tensor,
            axes: p,
        })
    }
}

/// An expression that stands at a place of what was written.
fn at_span(expr: &Expr, span: Span) -> Expr {
    Expr::Paren(ExprParen {
        attrs: Vec::new(),
        paren_token: token::Paren(span),
        expr: Box::new(expr.clone()),
    })
}
