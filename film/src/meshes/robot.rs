//! Meshes of a robot, as its URDF file names them.

use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

use holonom::Mechanism;
use holonom::nalgebra::{Matrix4, Quaternion, Translation3, UnitQuaternion, Vector3};
use holonom_urdf as urdf;

use super::part::{Part, colour};
use super::{files, packages};
use crate::{Film, FilmError};

/// Triangles of a robot, at most, unless another number is asked for.
const TRIANGLES: usize = 60_000;

/// The meshes of a robot: the `<visual>`s of its URDF file.
#[derive(Clone, Debug)]
pub struct UrdfMeshes {
    urdf: PathBuf,
    folders: Vec<PathBuf>,
    triangles: usize,
}

/// What was drawn of a robot.
#[derive(Clone, Debug)]
#[non_exhaustive]
#[must_use]
pub struct Drawn {
    /// The number of meshes of the URDF file that are drawn.
    pub meshes: usize,
    /// Triangles of these, and how many of them the page has.
    pub triangles: [usize; 2],
    /// The meshes that are not drawn, with the reason.
    pub left_out: Vec<String>,
}

impl fmt::Display for Drawn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [before, after] = self.triangles;
        write!(f, "{} meshes, {after} of {before} triangles", self.meshes)?;
        self.left_out
            .iter()
            .try_for_each(|one| write!(f, "\nnot drawn: {one}"))
    }
}

impl UrdfMeshes {
    /// The meshes of a URDF file.
    #[must_use]
    pub fn of(urdf: impl Into<PathBuf>) -> Self {
        Self {
            urdf: urdf.into(),
            folders: Vec::new(),
            triangles: TRIANGLES,
        }
    }

    /// Also looks for packages in this folder. `package://robot/link.stl` is first looked for in a
    /// folder `robot` there, then in the folders around the URDF file.
    #[must_use]
    pub fn package_folder(mut self, folder: impl Into<PathBuf>) -> Self {
        self.folders.push(folder.into());
        self
    }

    /// The largest number of triangles in the page, 60000 unless this is called. A triangle is some
    /// 12 bytes of the page.
    #[must_use]
    pub fn triangles(mut self, most: usize) -> Self {
        self.triangles = most;
        self
    }
}

impl<M: Mechanism> Film<M> {
    /// Draws a robot by the meshes of its URDF file: those of each link on the body that has its
    /// name, those of the root on the ground, unless it floats. Their frames are those of the
    /// bodies of `holonom::urdf!` and of the command `holonom-urdf`.
    ///
    /// STL, OBJ and Collada files are read, by the ending of their name. A mesh has the colours of
    /// its file, else that of the URDF's material, else that of its body. Textures are not shown.
    /// Meshes with more triangles than [`UrdfMeshes::triangles`] are simplified.
    ///
    /// # Errors
    /// [`FilmError::Mesh`] where the URDF file cannot be read. A mesh that cannot be is left out:
    /// see [`Drawn::left_out`].
    pub fn urdf_meshes(&mut self, meshes: &UrdfMeshes) -> Result<Drawn, FilmError> {
        let robot = robot::<M>(&meshes.urdf)?;
        let mut drawn = Drawn {
            meshes: 0,
            triangles: [0; 2],
            left_out: Vec::new(),
        };
        let mut parts = Vec::new();
        for mesh in &robot.meshes {
            match read::<M>(meshes, &robot, mesh) {
                Ok(read) => {
                    drawn.meshes += 1;
                    parts.extend(read);
                }
                Err(reason) => drawn.left_out.push(format!("{}: {reason}", mesh.file)),
            }
        }
        drawn.triangles[0] = parts.iter().map(|(_, part)| part.faces.len()).sum();
        let before = self.meshes.len();
        self.add_meshes(parts.into_iter(), meshes.triangles);
        let added = self.meshes[before..].iter();
        drawn.triangles[1] = added.map(|mesh| mesh.faces.0.len() / 3).sum();
        Ok(drawn)
    }
}

/// The place of a body by its name.
fn body<M: Mechanism>(name: &str) -> Option<usize> {
    M::REPORT.bodies.iter().position(|body| body.name == name)
}

/// The robot with the bodies of the mechanism: its root floats where it is one of them.
fn robot<M: Mechanism>(path: &Path) -> Result<urdf::Mechanism, FilmError> {
    let fault = |reason: String| FilmError::mesh(path, reason);
    let text = fs::read_to_string(path).map_err(|error| fault(error.to_string()))?;
    let robot = urdf::Robot::parse(&text).map_err(|faults| fault(faults.to_string()))?;
    let mut options = urdf::Options::default();
    // Whether the inertias are those of bodies is no matter of pictures.
    options.accept_inertia = true;
    options.floating = true;
    let floating = robot.mechanism(&options);
    let floats = floating.as_ref().is_ok_and(|robot| {
        let root = robot.bodies.first();
        root.is_some_and(|root| body::<M>(&root.field).is_some())
    });
    if floats {
        return floating.map_err(|faults| fault(faults.to_string()));
    }
    options.floating = false;
    robot
        .mechanism(&options)
        .map_err(|faults| fault(faults.to_string()))
}

/// The parts of a mesh in the axes of its body.
fn read<M: Mechanism>(
    meshes: &UrdfMeshes,
    robot: &urdf::Mechanism,
    mesh: &urdf::Mesh,
) -> Result<Vec<(Option<usize>, Part)>, String> {
    let field = mesh.body.map(|place| &robot.bodies[place].field);
    let on = match field {
        Some(field) => {
            let place = body::<M>(field);
            Some(place.ok_or_else(|| format!("the mechanism has no body `{field}`"))?)
        }
        None => None,
    };
    let mut parts = files::read(&packages::find(&mesh.file, &meshes.urdf, &meshes.folders)?)?;
    let [w, i, j, k] = mesh.orientation;
    let turn = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k));
    let place = Translation3::from(Vector3::from(mesh.origin)).to_homogeneous();
    let scale = Matrix4::new_nonuniform_scaling(&mesh.scale.into());
    let whole = place * turn.to_homogeneous() * scale;
    let material = mesh
        .colour
        .map(|[red, green, blue, _]| colour([red, green, blue]));
    for part in &mut parts {
        part.transform(&whole);
        part.colour = part.colour.take().or_else(|| material.clone());
    }
    Ok(parts.into_iter().map(|part| (on, part)).collect())
}
