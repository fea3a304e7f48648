//! Meshes of bodies: files of CAD programs and of robots, with few enough triangles for a page.

mod collada;
mod files;
mod packages;
mod part;
mod robot;
mod simplify;

use std::path::Path;

use holonom::nalgebra::{Matrix4, Quaternion, UnitQuaternion};
use holonom::{BodyHandle, Mechanism, MechanismExt, Real, View};

use self::part::Part;
pub use self::robot::{Drawn, UrdfMeshes};
use crate::description::placement;
use crate::{Film, FilmError};

/// Triangles of a mesh that is drawn alone, at most.
const ALONE: usize = 20_000;

impl<M: Mechanism> Film<M> {
    /// Draws a body by a mesh. The coordinates of the file, times `scale`, are global ones (m) in
    /// the reference configuration of `mechanism`, as those of the points of its description are.
    /// Large meshes are simplified.
    ///
    /// STL, OBJ and Collada files are read, by the ending of their name. Colours of OBJ and Collada
    /// are shown, textures are not.
    ///
    /// # Errors
    /// [`FilmError::Mesh`] where the file cannot be read, or the configuration not be computed.
    pub fn mesh(
        &mut self,
        mechanism: &M,
        body: BodyHandle<M>,
        file: impl AsRef<Path>,
        scale: f64,
    ) -> Result<(), FilmError> {
        let file = file.as_ref();
        let fault = |reason: String| FilmError::mesh(file, reason);
        let constants = mechanism.constants::<f64>();
        let constants = constants.map_err(|error| fault(error.to_string()))?;
        let state = mechanism.described_state::<f64>();
        let state = state.map_err(|error| fault(error.to_string()))?;
        let view = View::<f64, M>::new(&constants, 0.0, &state);
        let (position, orientation) = placement(&view, body.index());
        let turn = UnitQuaternion::new_normalize(orientation).inverse();
        let on_body = turn.to_homogeneous() * Matrix4::new_translation(&-position);
        let mut parts = files::read(file).map_err(fault)?;
        for part in &mut parts {
            part.transform(&(on_body * Matrix4::new_scaling(scale)));
        }
        self.add_meshes(
            parts.into_iter().map(|part| (Some(body.index()), part)),
            ALONE,
        );
        Ok(())
    }

    /// Draws bodies that are described by meshes like these; what cannot be is returned, with the
    /// reason.
    pub(crate) fn described_meshes<S: Real>(&mut self, view: &View<'_, S, M>) -> Vec<String> {
        let mut left_out = Vec::new();
        for (index, shape) in crate::description::meshes::<M>() {
            let file = Path::new(shape.file.unwrap_or_default());
            let mut parts = match files::read(file) {
                Ok(parts) => parts,
                Err(reason) => {
                    left_out.push(format!("{}: {reason}", file.display()));
                    continue;
                }
            };
            let [e0, e1, e2, e3] = shape.axes;
            let turn = UnitQuaternion::new_normalize(Quaternion::new(e0, e1, e2, e3));
            let scale = view.shape(index).map(Real::to_f64);
            let on_body = Matrix4::new_translation(&shape.centre.into())
                * turn.to_homogeneous()
                * Matrix4::new_nonuniform_scaling(&scale.into());
            for part in &mut parts {
                part.transform(&on_body);
            }
            self.add_meshes(
                parts.into_iter().map(|part| (Some(shape.body), part)),
                ALONE,
            );
        }
        left_out
    }

    /// Adds meshes, each on a body or on the ground, with so many triangles in all.
    fn add_meshes(
        &mut self,
        meshes: impl Iterator<Item = (Option<usize>, Part)>,
        triangles: usize,
    ) {
        let (bodies, mut parts): (Vec<_>, Vec<_>) = meshes.unzip();
        simplify::to(&mut parts, triangles);
        for (body, part) in bodies.into_iter().zip(parts) {
            self.meshes.extend(part.packed(body));
        }
    }
}
