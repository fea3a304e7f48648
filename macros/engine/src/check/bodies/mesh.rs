//! Shapes that files have.

use std::path::PathBuf;

use syn::{Expr, ExprCall, ExprLit, Lit};

use super::lumps::{Frame, Lump, turned};
use super::reader::Reader;
use crate::mesh::{Bulk, enclosed};
use crate::model::inertia::{IDENTITY, rotation};
use crate::model::{Number, Shape, ShapeKind};
use crate::syntax::files::{MESH, place};
use crate::syntax::ungroup;

/// What a mesh takes; of these `file` and `scale` must be there.
pub(super) const KEYS: [&str; 4] = ["file", "scale", "at", "orientation"];
pub(super) const MAY_MISS: [&str; 2] = ["at", "orientation"];

/// A mesh as it is written.
#[derive(Debug)]
pub(super) struct Mesh<'a> {
    pub(super) call: &'a ExprCall,
    /// Its own density (kg/m^3), where that is given.
    pub(super) density: Option<&'a Expr>,
    /// Where its file is written, and which it is.
    written: &'a Expr,
    file: PathBuf,
    /// Of a unit of the file (m).
    scale: f64,
    /// Origin and axes of the file.
    pub(super) frame: Frame,
}

impl Reader<'_, '_> {
    /// A mesh, by what is given for its keys.
    pub(super) fn mesh<'e>(
        &mut self,
        call: &'e ExprCall,
        given: &[Option<&'e Expr>],
        density: Option<&'e Expr>,
    ) -> Option<Mesh<'e>> {
        let &[Some(written), Some(scale), at, orientation] = given else {
            return None;
        };
        let file = self.file(written);
        let scale = self.scale(scale);
        let centre = at.map_or(Some([0.0; 3]), |at| self.point_of_file(at));
        let axes = orientation.map_or(Some(IDENTITY), |turn| {
            self.seen_turn("the `orientation` of a `mesh`", turn)
        });
        Some(Mesh {
            call,
            density,
            written,
            file: file?,
            scale: scale?,
            frame: Frame {
                centre: centre?,
                axes: axes?,
            },
        })
    }

    fn file(&mut self, written: &Expr) -> Option<PathBuf> {
        let Expr::Lit(ExprLit {
            lit: Lit::Str(name),
            ..
        }) = ungroup(written)
        else {
            let message =
                "expected the path of a file in quotes, as in `file = \"meshes/part.stl\"`";
            self.faults.at(written, message);
            return None;
        };
        let file = place(&name.value());
        if file.is_file() {
            return Some(file);
        }
        self.faults.at(
            written,
            "there is no such file; a path from the folder of `Cargo.toml` is accepted",
        );
        None
    }

    fn scale(&mut self, written: &Expr) -> Option<f64> {
        self.at("scale");
        let scale = self.numbers.written(written, self.faults)?;
        if scale > 0.0 {
            return Some(scale);
        }
        self.faults.at(
            written,
            format!("the scale of a `{MESH}` must be positive, in m for a unit of its file; this is {scale}"),
        );
        None
    }

    fn point_of_file(&mut self, at: &Expr) -> Option<[f64; 3]> {
        self.at("at");
        let [x, y, z] = self.components(at)?;
        let mut seen = |part: &Expr| self.numbers.written(part, self.faults);
        let point = [seen(&x), seen(&y), seen(&z)];
        Some([point[0]?, point[1]?, point[2]?])
    }

    /// What a mesh encloses, of a density that the macro sees.
    pub(super) fn mesh_lump(&mut self, mesh: &Mesh<'_>, density: f64) -> Option<Lump> {
        let Bulk {
            volume,
            centre,
            tensor,
        } = match enclosed(&mesh.file) {
            Ok(bulk) => bulk,
            Err(reason) => {
                self.faults.at(mesh.written, format!("the mesh {reason}"));
                return None;
            }
        };
        let (scale, frame) = (mesh.scale, mesh.frame.unit());
        let a = rotation(frame.axes);
        let along = |k: usize| (0..3).map(|l| a[k][l] * centre[l]).sum::<f64>();
        let mass = density * volume * scale.powi(3);
        let of_density = density * scale.powi(5);
        let back = [0, 1, 2].map(|k| [0, 1, 2].map(|l| a[l][k]));
        let tensor = tensor.map(|row| row.map(|entry| of_density * entry));
        Some(Lump {
            mass,
            centre: [0, 1, 2].map(|k| frame.centre[k] + scale * along(k)),
            tensor: turned(tensor, back),
            axes: frame.axes,
        })
    }

    /// What is drawn of a mesh on a body, both in global axes.
    pub(super) fn drawn_mesh(
        mesh: &Mesh<'_>,
        (centre, axes): ([f64; 3], [f64; 4]),
        is_hole: bool,
    ) -> Shape {
        Shape {
            kind: ShapeKind::Mesh,
            sizes: [Number::Literal(mesh.scale); 3],
            centre,
            axes,
            is_hole,
            file: mesh.file.to_str().map(Into::into),
        }
    }
}
