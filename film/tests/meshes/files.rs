//! The same tetrahedron in every format that is read.

use std::fmt::Write as _;
use std::fs;

use holonom::prelude::*;
use holonom_models::RodPendulum;

use crate::{FACES, POINTS, Result, Shown, VOLUME, film, folder, meshes};

fn stl_facets(mut each: impl FnMut([[f64; 3]; 3])) {
    for face in FACES {
        each(face.map(|corner| POINTS[corner]));
    }
}

pub(crate) fn stl_text() -> String {
    let mut text = String::from("solid tetrahedron\n");
    stl_facets(|corners| {
        text.push_str("facet normal 0 0 0\nouter loop\n");
        for [x, y, z] in corners {
            let _ = writeln!(text, "vertex {x} {y} {z}");
        }
        text.push_str("endloop\nendfacet\n");
    });
    text + "endsolid tetrahedron\n"
}

/// Its title begins with the word that text files begin with, as some programs write it.
pub(crate) fn stl_binary() -> Vec<u8> {
    let mut bytes = b"solid of a CAD program".to_vec();
    bytes.resize(80, b' ');
    bytes.extend((FACES.len() as u32).to_le_bytes());
    stl_facets(|corners| {
        bytes.extend([0; 12]);
        let numbers = corners.iter().flatten();
        bytes.extend(numbers.flat_map(|&x| (x as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    });
    bytes
}

pub(crate) const MTL: &str = "newmtl blue\nKd 0.2 0.5 1.0\n";

pub(crate) fn obj() -> String {
    let mut text = String::from("mtllib wall.mtl\nusemtl blue\n");
    for [x, y, z] in POINTS {
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for [a, b, c] in FACES.map(|face| face.map(|corner| corner + 1)) {
        let _ = writeln!(text, "f {a} {b} {c}");
    }
    text
}

/// In centimetres, in a node that is moved and turned; one face as triangles, the rest as polygons,
/// with normals between their corners.
fn dae() -> String {
    // What the node does, undone: a quarter turn about z after a move along x.
    let points = POINTS.map(|[x, y, z]| [100.0 * y, -100.0 * (x - 2.0), 100.0 * z]);
    let floats: Vec<String> = points.iter().flatten().map(ToString::to_string).collect();
    let with_normals = |faces: &[[usize; 3]]| {
        let corners = faces.iter().flatten();
        let words: Vec<String> = corners.map(|corner| format!("{corner} 0")).collect();
        words.join(" ")
    };
    let (first, rest) = FACES.split_at(1);
    let inputs = r##"<input semantic="VERTEX" source="#v" offset="0"/>
        <input semantic="NORMAL" source="#n" offset="1"/>"##;
    format!(
        r##"<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimetre" meter="0.01"/><up_axis>Y_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert><diffuse>
  <color>0 1 0 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
  <source id="p"><float_array id="pa" count="12">{}</float_array><technique_common>
    <accessor source="#pa" count="4" stride="3"/></technique_common></source>
  <source id="n"><float_array id="na" count="3">0 0 1</float_array></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <triangles count="1" material="s">{inputs}<p>{}</p></triangles>
  <polylist count="3">{inputs}<vcount>3 3 3</vcount><p>{}</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene"><node>
  <translate>200 0 0</translate><rotate>0 0 1 90</rotate>
  <node><scale>1 1 1</scale><instance_geometry url="#g"><bind_material><technique_common>
    <instance_material symbol="s" target="#m"/></technique_common></bind_material></instance_geometry>
  </node></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene></COLLADA>"##,
        floats.join(" "),
        with_normals(first),
        with_normals(rest),
    )
}

/// One solid, whatever the format: its volume, by parts of it, and its colours.
#[test]
fn formats_give_one_solid() -> Result {
    let folder = folder("formats")?;
    fs::write(folder.join("wall.mtl"), MTL)?;
    let cases = [
        ("text.stl", stl_text().into_bytes(), vec![None]),
        ("binary.STL", stl_binary(), vec![None]),
        ("wall.obj", obj().into_bytes(), vec![Some("#3380ff")]),
        ("arm.dae", dae().into_bytes(), vec![Some("#00ff00"), None]),
    ];
    let rod = RodPendulum::default();
    for (name, bytes, colours) in cases {
        let file = folder.join(name);
        fs::write(&file, bytes)?;
        let mut film = film()?;
        film.mesh(&rod, RodPendulum::HANDLES.rod, &file, 1.0)?;
        let meshes = meshes(&film)?;
        let found: Vec<_> = meshes.iter().map(|mesh| mesh.colour.as_deref()).collect();
        assert_eq!(found, colours, "{name}");
        let volume: f64 = meshes.iter().map(Shown::volume).sum();
        assert!((volume - VOLUME).abs() < 1e-3, "{name}: {volume}");
        let faces: usize = meshes.iter().map(|mesh| mesh.faces.len()).sum();
        assert_eq!(faces, 4, "{name}");
    }
    Ok(())
}
