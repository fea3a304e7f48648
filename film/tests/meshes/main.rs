//! Meshes of bodies: files that are written here, and where a page has them.

mod described;
mod files;
mod fine;

use std::error::Error;
use std::fs;
use std::path::PathBuf;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use holonom::nalgebra::{Rotation3, UnitQuaternion, Vector3};
use holonom::prelude::*;
use holonom_film::{Film, FilmError, UrdfMeshes};
use holonom_models::RodPendulum;
use serde_json::Value;

type Result<T = ()> = std::result::Result<T, Box<dyn Error>>;

/// A corner with three legs, and the faces of the tetrahedron that it makes.
const POINTS: [[f64; 3]; 4] = [
    [1.0, 2.0, 3.0],
    [4.0, 2.0, 3.0],
    [1.0, 4.0, 3.0],
    [1.0, 2.0, 4.0],
];
const FACES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
/// Its volume.
const VOLUME: f64 = 1.0;

/// A folder of a test, emptied.
fn folder(name: &str) -> Result<PathBuf> {
    let folder = std::env::temp_dir().join(format!("holonom-film-{name}-{}", std::process::id()));
    fs::create_dir_all(&folder)?;
    Ok(folder)
}

/// A film of the pendulum that ends where it begins.
fn film() -> Result<Film<RodPendulum>> {
    let mut film = Film::new();
    RodPendulum::default()
        .simulation(StandardLagrange, Rk4::every(0.1))
        .run(0.0..=0.1, every(0.1), |sample| film.record(sample))?;
    Ok(film)
}

/// A mesh of a page.
struct Shown {
    body: Option<u64>,
    colour: Option<String>,
    points: Vec<Vector3<f64>>,
    faces: Vec<[usize; 3]>,
}

impl Shown {
    fn volume(&self) -> f64 {
        let faces = self
            .faces
            .iter()
            .map(|face| face.map(|corner| self.points[corner]));
        faces.map(|[a, b, c]| a.dot(&b.cross(&c)) / 6.0).sum()
    }

    /// Whether these are its points, in any order.
    fn is_of(&self, points: &[Vector3<f64>]) -> bool {
        let near = |a: &Vector3<f64>, b: &Vector3<f64>| (a - b).norm() < 1e-4 * b.norm().max(1e-3);
        let found = |point| self.points.iter().any(|own| near(own, point));
        self.points.len() == points.len() && points.iter().all(found)
    }
}

fn shorts(value: &Value) -> Vec<u16> {
    let bytes = STANDARD.decode(value.as_str().expect("text"));
    let bytes = bytes.expect("base 64");
    let pairs = bytes.chunks_exact(2);
    pairs
        .map(|pair| u16::from_le_bytes([pair[0], pair[1]]))
        .collect()
}

/// The meshes of a page, as the viewer reads them.
fn meshes<M: Mechanism>(film: &Film<M>) -> Result<Vec<Shown>> {
    let page = film.html()?;
    let data = page.split_once("<script type=\"application/json\" id=\"film\">");
    let data = data.and_then(|(_, behind)| behind.split_once("</script>"));
    let data: Value = serde_json::from_str(data.ok_or("a place for data")?.0)?;
    let meshes = data["meshes"].as_array().ok_or("meshes")?.iter();
    let shown = meshes.map(|mesh| {
        let [low, high] = ["low", "high"]
            .map(|key| Vector3::from([0, 1, 2].map(|k| mesh[key][k].as_f64().expect("a number"))));
        let corners = shorts(&mesh["corners"]);
        let part = |at: u16, k: usize| low[k] + f64::from(at) / 65535.0 * (high[k] - low[k]);
        let points = corners.chunks_exact(3);
        let points = points.map(|at| Vector3::from([0, 1, 2].map(|k| part(at[k], k))));
        let faces = shorts(&mesh["faces"]);
        let faces = faces.chunks_exact(3);
        Shown {
            body: mesh["body"].as_u64(),
            colour: mesh["colour"].as_str().map(Into::into),
            points: points.collect(),
            faces: faces
                .map(|face| [0, 1, 2].map(|k| usize::from(face[k])))
                .collect(),
        }
    });
    Ok(shown.collect())
}

/// The coordinates of the file are those of the reference configuration, in which the pendulum
/// begins.
#[test]
fn a_mesh_is_where_the_points_of_the_description_are() -> Result {
    let folder = folder("described")?;
    let file = folder.join("rod.stl");
    fs::write(&file, files::stl_text())?;
    let (mut film, mut poses) = (Film::new(), Vec::new());
    let (pendulum, rod) = (RodPendulum::default(), RodPendulum::HANDLES.rod);
    let method = Rk4::every(0.1);
    pendulum
        .simulation(StandardLagrange, method)
        .run(0.0..=0.1, every(0.1), |sample| {
            film.record(sample);
            poses.push(sample.pose(rod));
        })?;
    film.mesh(&pendulum, rod, &file, 0.01)?;
    let [mesh] = &meshes(&film)?[..] else {
        panic!("one mesh");
    };
    assert_eq!(mesh.body, Some(0));
    let points = mesh.points.iter();
    let turn = UnitQuaternion::new_normalize(poses[0].orientation);
    let points: Vec<_> = points
        .map(|point| poses[0].position + turn * point)
        .collect();
    let shown = Shown {
        body: None,
        colour: None,
        points,
        faces: Vec::new(),
    };
    assert!(
        shown.is_of(&POINTS.map(|at| 0.01 * Vector3::from(at))),
        "{:?}",
        shown.points
    );
    assert!(
        (mesh.volume() - 1e-6 * VOLUME).abs() < 1e-9,
        "{}",
        mesh.volume()
    );
    Ok(())
}

const URDF: &str = r#"<robot name="swing"><material name="paint"><color rgba="1 0.5 0 1"/></material>
<link name="wall"><visual><origin xyz="0 0 1"/><geometry><mesh filename="wall.obj"/></geometry></visual></link>
<link name="rod">
  <inertial><origin xyz="0.1 0.5 0.2"/><mass value="2"/>
    <inertia ixx="0.2" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.2"/></inertial>
  <visual><origin xyz="0.3 0.2 0.1" rpy="0.1 0.2 0.3"/>
    <geometry><mesh filename="package://swing/meshes/rod.stl" scale="-0.1 0.2 0.3"/></geometry>
    <material name="paint"/></visual>
  <visual><geometry><mesh filename="rod.glb"/></geometry></visual>
</link>
<link name="bob"><inertial><mass value="1"/>
    <inertia ixx="0.2" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.2"/></inertial>
  <visual><geometry><mesh filename="wall.obj"/></geometry></visual></link>
<joint name="pivot" type="continuous"><parent link="wall"/><child link="rod"/><axis xyz="1 0 0"/></joint>
<joint name="wrist" type="continuous"><parent link="rod"/><child link="bob"/></joint></robot>"#;

/// Frames are worked out here from the text: of the mesh in its link, of the centre of mass.
#[test]
fn a_robot_looks_as_its_file_says() -> Result {
    let folder = folder("robot")?.join("swing");
    fs::create_dir_all(folder.join("meshes"))?;
    fs::create_dir_all(folder.join("urdf"))?;
    fs::write(folder.join("meshes/rod.stl"), files::stl_binary())?;
    fs::write(folder.join("urdf/wall.obj"), files::obj())?;
    fs::write(folder.join("urdf/wall.mtl"), files::MTL)?;
    fs::write(folder.join("urdf/rod.glb"), "glTF")?;
    let urdf = folder.join("urdf/swing.urdf");
    fs::write(&urdf, URDF)?;
    let mut film = film()?;
    let drawn = film.urdf_meshes(&UrdfMeshes::of(&urdf))?;
    assert_eq!((drawn.meshes, drawn.triangles), (2, [8, 8]), "{drawn}");
    let [ending, body] = &drawn.left_out[..] else {
        panic!("{drawn}");
    };
    assert_eq!(
        ending,
        "rod.glb: STL (.stl), OBJ (.obj) and Collada (.dae) files are read"
    );
    assert_eq!(body, "wall.obj: the mechanism has no body `bob`");
    let [wall, rod] = &meshes(&film)?[..] else {
        panic!("two meshes");
    };
    assert_eq!((wall.body, rod.body), (None, Some(0)));
    assert_eq!(rod.colour.as_deref(), Some("#ff8000"));
    assert_eq!(wall.colour.as_deref(), Some("#3380ff"));
    assert!(wall.is_of(&POINTS.map(|at| Vector3::from(at) + Vector3::z())));
    let turn = Rotation3::from_euler_angles(0.1, 0.2, 0.3);
    let off = Vector3::new(0.3, 0.2, 0.1) - Vector3::new(0.1, 0.5, 0.2);
    let scale = Vector3::new(-0.1, 0.2, 0.3);
    let on_body = POINTS.map(|at| turn * scale.component_mul(&Vector3::from(at)) + off);
    assert!(rod.is_of(&on_body), "{:?} {on_body:?}", rod.points);
    // The reflection is undone: outside is outside.
    assert!(
        (rod.volume() - 0.006 * VOLUME).abs() < 1e-6,
        "{}",
        rod.volume()
    );
    Ok(())
}

/// Other programs see the same surfaces, in the same colours, on bodies and on the ground.
#[test]
fn a_gltf_file_has_the_meshes() -> Result {
    let folder = folder("gltf")?;
    fs::create_dir_all(folder.join("swing/meshes"))?;
    fs::write(folder.join("swing/meshes/rod.stl"), files::stl_text())?;
    fs::write(folder.join("wall.obj"), files::obj())?;
    fs::write(folder.join("wall.mtl"), files::MTL)?;
    let urdf = folder.join("swing.urdf");
    fs::write(&urdf, URDF)?;
    let mut film = film()?;
    assert_eq!(film.urdf_meshes(&UrdfMeshes::of(&urdf))?.meshes, 2);
    let gltf::Gltf { document, .. } = gltf::Gltf::from_slice(film.gltf()?.as_bytes())?;
    let buffer = document.buffers().next().ok_or("a buffer")?;
    let gltf::buffer::Source::Uri(uri) = buffer.source() else {
        panic!("in the file");
    };
    let numbers = STANDARD.decode(uri.split_once(',').ok_or("a data URI")?.1)?;
    for (name, wanted, colour) in [
        ("rod", 0.006 * VOLUME, [1.0, 128.0 / 255.0, 0.0]),
        ("ground", VOLUME, [51.0 / 255.0, 128.0 / 255.0, 1.0]),
    ] {
        let mut nodes = document.nodes();
        let node = nodes.find(|node| node.name() == Some(name) && node.mesh().is_some());
        let mesh = node.and_then(|node| node.mesh()).ok_or(name)?;
        let primitives: Vec<_> = mesh.primitives().collect();
        let [primitive] = &primitives[..] else {
            panic!("{name}: one colour");
        };
        let reader = primitive.reader(|_| Some(&numbers));
        let points = reader.read_positions().ok_or("points")?;
        let points: Vec<_> = points.map(|at| Vector3::from(at.map(f64::from))).collect();
        let normals = reader.read_normals().ok_or("normals")?;
        let mut volume = 0.0;
        for (face, normal) in points.chunks(3).zip(normals.step_by(3)) {
            let across = (face[1] - face[0]).cross(&(face[2] - face[0]));
            let normal = Vector3::from(normal.map(f64::from));
            assert!(
                (across.normalize() - normal).norm() < 1e-3,
                "{name}: {normal}"
            );
            volume += face[0].dot(&face[1].cross(&face[2])) / 6.0;
        }
        assert!((volume / wanted - 1.0).abs() < 1e-3, "{name}: {volume}");
        let found = primitive
            .material()
            .pbr_metallic_roughness()
            .base_color_factor();
        for (share, wanted) in found.iter().zip(colour) {
            assert!(
                (f64::from(*share) - f64::powf(wanted, 2.2)).abs() < 1e-3,
                "{found:?}"
            );
        }
    }
    Ok(())
}

#[test]
fn packages_are_looked_for_in_the_folders_that_are_named() -> Result {
    let [folder, others] = [folder("package")?, folder("others")?];
    fs::create_dir_all(others.join("swing/meshes"))?;
    fs::write(others.join("swing/meshes/rod.stl"), files::stl_text())?;
    let urdf = folder.join("swing.urdf");
    fs::write(&urdf, URDF)?;
    let mut film = film()?;
    let drawn = film.urdf_meshes(&UrdfMeshes::of(&urdf))?;
    assert_eq!(drawn.meshes, 0, "{drawn}");
    assert!(
        drawn
            .to_string()
            .contains("`UrdfMeshes::package_folder` takes the folder that has `swing`"),
        "{drawn}"
    );
    let named = UrdfMeshes::of(&urdf).package_folder(&others);
    assert_eq!(film.urdf_meshes(&named)?.meshes, 1);
    assert_eq!(
        film.urdf_meshes(&named.package_folder("nowhere"))?.meshes,
        1
    );
    Ok(())
}

#[test]
fn what_is_wrong_with_a_file_is_said_with_its_name() -> Result {
    let folder = folder("wrong")?;
    let mut film = film()?;
    let (rod, handle) = (RodPendulum::default(), RodPendulum::HANDLES.rod);
    let cases: [(&str, &[u8], &str); 5] = [
        ("short.stl", b"solid a\nfacet", "short.stl"),
        ("empty.obj", b"# nothing\n", "it has no triangles"),
        ("text.dae", b"<COLLADA>", "text.dae"),
        ("bytes.dae", &[0xff, 0xfe, 0x00], "bytes.dae"),
        (
            "rod.step",
            b"ISO-10303-21;",
            "STL (.stl), OBJ (.obj) and Collada (.dae) files are read",
        ),
    ];
    for (name, bytes, said) in cases {
        let file = folder.join(name);
        fs::write(&file, bytes)?;
        let error = film.mesh(&rod, handle, &file, 1.0).expect_err(name);
        assert!(matches!(error, FilmError::Mesh { .. }), "{error:?}");
        assert!(error.to_string().contains(said), "{error}");
    }
    let error = film
        .urdf_meshes(&UrdfMeshes::of(folder.join("none.urdf")))
        .expect_err("none");
    assert!(error.to_string().contains("none.urdf"), "{error}");
    assert!(meshes(&film)?.is_empty());
    Ok(())
}
