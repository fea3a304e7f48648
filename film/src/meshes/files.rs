//! Files of meshes by the ending of their name.

use std::fs;
use std::io::Cursor;
use std::path::Path;

use holonom::nalgebra::Vector3;

use super::collada;
use super::part::{Part, colour};

/// The parts of a mesh in the coordinates of its file, or why there are none.
pub(super) fn read(file: &Path) -> Result<Vec<Part>, String> {
    let ending = file.extension().unwrap_or_default().to_string_lossy();
    let mut parts = match &*ending.to_ascii_lowercase() {
        "stl" => vec![stl(bytes(file)?)?],
        "obj" => obj(file)?,
        "dae" => {
            let text = String::from_utf8(bytes(file)?);
            collada::read(&text.map_err(|error| error.to_string())?)?
        }
        _ => return Err("STL (.stl), OBJ (.obj) and Collada (.dae) files are read".into()),
    };
    for part in &mut parts {
        part.welded();
    }
    parts.retain(|part| !part.faces.is_empty());
    if parts.is_empty() {
        return Err("it has no triangles".into());
    }
    Ok(parts)
}

fn bytes(file: &Path) -> Result<Vec<u8>, String> {
    fs::read(file).map_err(|error| error.to_string())
}

/// Bytes before the triangles of a binary file, and of each triangle.
const HEAD: usize = 84;
const TRIANGLE: usize = 50;

fn stl(mut bytes: Vec<u8>) -> Result<Part, String> {
    // The title of some binary files begins with the word that text files begin with.
    if let Some(count) = bytes.get(HEAD - 4..HEAD) {
        let count = u32::from_le_bytes([count[0], count[1], count[2], count[3]]) as usize;
        if bytes.len() == HEAD.saturating_add(count.saturating_mul(TRIANGLE)) {
            bytes[..5].fill(b' ');
        }
    }
    let mesh = stl_io::read_stl(&mut Cursor::new(bytes)).map_err(|error| error.to_string())?;
    let points = mesh.vertices.iter();
    let faces = mesh.faces.iter();
    Ok(Part {
        colour: None,
        points: points
            .map(|point| vector([point[0], point[1], point[2]]))
            .collect(),
        faces: faces
            .map(|face| face.vertices.map(|corner| corner as u32))
            .collect(),
    })
}

fn obj(file: &Path) -> Result<Vec<Part>, String> {
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..tobj::LoadOptions::default()
    };
    let (models, materials) = tobj::load_obj(file, &options).map_err(|error| error.to_string())?;
    // Without its materials, a mesh has the colour of its body.
    let materials = materials.unwrap_or_default();
    let part = |model: tobj::Model| {
        let material = model.mesh.material_id.and_then(|id| materials.get(id));
        let diffuse = material.and_then(|material| material.diffuse);
        let points = model.mesh.positions.chunks_exact(3);
        let faces = model.mesh.indices.chunks_exact(3);
        Part {
            colour: diffuse.map(|shares| colour(shares.map(f64::from))),
            points: points
                .map(|point| vector([point[0], point[1], point[2]]))
                .collect(),
            faces: faces.map(|face| [face[0], face[1], face[2]]).collect(),
        }
    };
    Ok(models.into_iter().map(part).collect())
}

fn vector(point: [f32; 3]) -> Vector3<f64> {
    point.map(f64::from).into()
}
