//! Shapes as they are written.

use quote::ToTokens;
use syn::{Expr, ExprCall};

use super::formula::{difference, length, sum, times};
use super::mesh::{self, Mesh};
use super::reader::Reader;
use super::volume::{self, Volume};
use crate::diag::{code, did_you_mean, list};
use crate::syntax::files::MESH;
use crate::syntax::ungroup;

/// What shapes there are, and what they take.
const SHAPES: [(&str, &[&str]); 9] = [
    ("cylinder", &["radius", "from", "to"]),
    ("rod", &["radius", "from", "to"]),
    ("tube", &["outer", "inner", "from", "to"]),
    ("cone", &["radius", "from", "to"]),
    ("bar", &["width", "height", "from", "to", "up"]),
    ("disc", &["radius", "thickness", "at", "axis"]),
    ("block", &["size", "at"]),
    ("ball", &["radius", "at"]),
    (MESH, &mesh::KEYS),
];

/// Whether a key of a shape may be left out.
fn is_optional(shape: &str, key: &str) -> bool {
    matches!(key, "up" | "density") || shape == MESH && mesh::MAY_MISS.contains(&key)
}

/// A shape as it is written.
#[derive(Debug)]
pub(super) enum Written<'a> {
    Formulas(Box<Formulas<'a>>),
    Mesh(Mesh<'a>),
}

impl<'a> Written<'a> {
    /// What was written.
    pub(super) fn call(&self) -> &'a ExprCall {
        match self {
            Self::Formulas(shape) => shape.call,
            Self::Mesh(mesh) => mesh.call,
        }
    }

    /// Its own density (kg/m^3), where that is given.
    pub(super) fn density(&self) -> Option<&'a Expr> {
        match self {
            Self::Formulas(shape) => shape.density,
            Self::Mesh(mesh) => mesh.density,
        }
    }
}

/// Which axes a shape has.
#[derive(Clone, Debug)]
pub(super) enum Axes {
    /// Those of its body.
    Body,
    /// x along a direction, z as near as possible to another one, if that is given.
    Along(Box<[Expr; 3]>, Option<Box<Expr>>),
}

/// A shape, by formulas of what is written.
#[derive(Debug)]
pub(super) struct Formulas<'a> {
    /// What was written.
    pub(super) call: &'a ExprCall,
    pub(super) volume: Volume,
    /// The centre of mass (m, global).
    pub(super) centre: [Expr; 3],
    pub(super) axes: Axes,
    /// Its own density (kg/m^3), where that is given.
    pub(super) density: Option<&'a Expr>,
}

impl Reader<'_, '_> {
    /// A shape, of which `own_density` may tell its density itself.
    pub(super) fn shape<'e>(&mut self, expr: &'e Expr, own_density: bool) -> Option<Written<'e>> {
        let names = SHAPES.map(|(name, _)| name);
        let Expr::Call(call) = ungroup(expr) else {
            self.faults.at(
                expr,
                format!(
                    "expected a shape, as in `cylinder(radius = 0.01, from = [0.0, 0.0, 0.0], to = [0.5, 0.0, 0.0])`; there are {}",
                    list(names)
                ),
            );
            return None;
        };
        let found = code(&call.func);
        let Some((name, keys)) = SHAPES.into_iter().find(|(name, _)| *name == found) else {
            let near = did_you_mean(&found, names);
            self.faults.at(
                &call.func,
                format!("no shape `{found}`; there are {}{near}", list(names)),
            );
            return None;
        };
        let given = self.given(call, name, keys, own_density)?;
        let density = given.last().copied().flatten();
        let needed: Option<Vec<&Expr>> = given[..keys.len()]
            .iter()
            .zip(keys)
            .filter(|(_, key)| !is_optional(name, key))
            .map(|(given, _)| *given)
            .collect();
        let needed = needed?;
        if name == MESH {
            let mesh = self.mesh(call, &given[..keys.len()], density)?;
            return Some(Written::Mesh(mesh));
        }
        let (volume, centre, axes) = match (name, &needed[..]) {
            ("ball", &[radius, at]) => {
                self.positive(name, [("radius", radius)])?;
                (
                    volume::ball(radius),
                    self.components_of("at", at)?,
                    Axes::Body,
                )
            }
            ("block", &[size, at]) => {
                let size = self.components_of("size", size)?;
                self.positive(name, size.each_ref().map(|size| ("size", size)))?;
                (
                    volume::block(size),
                    self.components_of("at", at)?,
                    Axes::Body,
                )
            }
            ("disc", &[radius, thickness, at, axis]) => {
                self.positive(name, [("radius", radius), ("thickness", thickness)])?;
                let along = self.components_of("axis", axis)?;
                self.directed(
                    axis,
                    &along,
                    "the `axis` of a `disc` must not be the zero vector",
                )?;
                let axes = Axes::Along(Box::new(along), None);
                let volume = volume::cylinder(radius, thickness);
                (volume, self.components_of("at", at)?, axes)
            }
            (_, &[ref sizes @ .., from, to]) => {
                let (from, to) = (
                    self.components_of("from", from),
                    self.components_of("to", to),
                );
                let (from, to) = (from?, to?);
                let d = [0, 1, 2].map(|k| difference(&to[k], &from[k]));
                self.directed(call, &d, "`from` and `to` must not be one point")?;
                let volume = self.long(call, name, sizes, &length(&d))?;
                let share = volume.share;
                let centre =
                    [0, 1, 2].map(|k| sum(&times(1.0 - share, &from[k]), &times(share, &to[k])));
                let up = keys.iter().position(|key| *key == "up");
                let up = up.and_then(|up| given[up]).cloned().map(Box::new);
                (volume, centre, Axes::Along(Box::new(d), up))
            }
            _ => return None,
        };
        Some(Written::Formulas(Box::new(Formulas {
            call,
            volume,
            centre,
            axes,
            density,
        })))
    }

    /// A shape between two points, by its other sizes.
    fn long(
        &mut self,
        call: &ExprCall,
        name: &str,
        sizes: &[&Expr],
        long: &Expr,
    ) -> Option<Volume> {
        match (name, sizes) {
            ("tube", &[outer, inner]) => {
                self.positive(name, [("outer", outer), ("inner", inner)])?;
                self.wall(call, outer, inner)?;
                Some(volume::tube(outer, inner, long))
            }
            ("bar", &[width, height]) => {
                self.positive(name, [("width", width), ("height", height)])?;
                Some(volume::block([long.clone(), width.clone(), height.clone()]))
            }
            (_, &[radius]) => {
                self.positive(name, [("radius", radius)])?;
                Some(match name {
                    "cone" => volume::cone(radius, long),
                    "rod" => volume::rod(radius, long),
                    _ => volume::cylinder(radius, long),
                })
            }
            _ => None,
        }
    }

    /// What is given for each key; behind them, for `density`.
    fn given<'e>(
        &mut self,
        call: &'e ExprCall,
        name: &str,
        keys: &[&str],
        own_density: bool,
    ) -> Option<Vec<Option<&'e Expr>>> {
        let density: &[&str] = if own_density { &["density"] } else { &[] };
        let keys: Vec<&str> = keys.iter().chain(density).copied().collect();
        let mut given = vec![None; keys.len().max(1)];
        let mut is_sound = true;
        for argument in &call.args {
            let pair = match argument {
                Expr::Assign(assign) => Some((code(&assign.left), &*assign.right)),
                _ => None,
            };
            let Some((key, value)) = pair else {
                self.faults.at(
                    argument,
                    format!(
                        "`{name}` takes {}, each as in `{} = ..`",
                        list(&keys),
                        keys[0]
                    ),
                );
                is_sound = false;
                continue;
            };
            match keys.iter().position(|known| *known == key) {
                Some(place) if given[place].is_none() => given[place] = Some(value),
                Some(_) => {
                    self.faults
                        .at(argument, format!("`{key}` stands here twice; give it once"));
                    is_sound = false;
                }
                None => {
                    let near = did_you_mean(&key, keys.iter().copied());
                    self.faults.at(
                        argument,
                        format!("`{name}` has no `{key}`; it takes {}{near}", list(&keys)),
                    );
                    is_sound = false;
                }
            }
        }
        let missing: Vec<&str> = keys
            .iter()
            .zip(&given)
            .filter(|(key, given)| given.is_none() && !is_optional(name, key))
            .map(|(key, _)| *key)
            .collect();
        if is_sound && !missing.is_empty() {
            self.faults
                .at(call, format!("`{name}` lacks {}", list(&missing)));
            is_sound = false;
        }
        if !own_density {
            given.push(None);
        }
        is_sound.then_some(given)
    }

    fn components_of(&mut self, key: &str, expr: &Expr) -> Option<[Expr; 3]> {
        self.at(key);
        self.components(expr)
    }

    /// A direction is not zero, as far as the macro sees it.
    fn directed(&mut self, at: impl ToTokens, d: &[Expr; 3], message: &str) -> Option<()> {
        let seen = d.each_ref().map(|part| self.glance(part));
        let is_nothing = seen.iter().all(|part| *part == Some(0.0));
        if is_nothing {
            self.faults.at(at, message);
        }
        (!is_nothing).then_some(())
    }

    /// Dimensions are positive, as far as the macro sees them.
    fn positive<const N: usize>(&mut self, name: &str, sizes: [(&str, &Expr); N]) -> Option<()> {
        let mut is_sound = true;
        for (key, size) in sizes {
            self.at(key);
            let part = self.numbers.part(size, self.faults);
            if let Some(value) = part.and_then(|part| part.seen)
                && value <= 0.0
            {
                self.faults.at(
                    size,
                    format!("the {key} of a `{name}` must be positive, in m; this is {value}"),
                );
                is_sound = false;
            }
            is_sound &= part.is_some();
        }
        is_sound.then_some(())
    }

    fn wall(&mut self, call: &ExprCall, outer: &Expr, inner: &Expr) -> Option<()> {
        let wall = difference(outer, inner);
        let part = self.numbers.part(&wall, self.faults)?;
        if part.seen.is_some_and(|wall| wall <= 0.0) {
            self.faults.at(
                call,
                "the `outer` radius of a `tube` must be larger than its `inner` one",
            );
            return None;
        }
        Some(())
    }
}
