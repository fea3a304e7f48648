//! Bodies by meshes: against trimesh, against the formulas of blocks, and refused where they
//! enclose nothing or something twice.

mod common;

use common::{checked, definition, tokens};
use holonom_engine::mesh::of_triangles;
use holonom_engine::model::inertia::rotation;
use holonom_engine::model::number::literals;
use holonom_engine::model::{Body, Model, ShapeKind};

type Triangles = Vec<[[f64; 3]; 3]>;

fn described(attribute: &str) -> Result<Model, String> {
    let fields = format!("#[body({attribute}, free)] body: Body,");
    checked(
        &tokens(&format!("struct Meshed {{ {fields} }}")),
        definition,
    )
}

fn body(attribute: &str) -> Body {
    described(attribute).expect("sound").bodies.remove(0)
}

/// Mass, centre of mass, and the tensor about it in global axes.
fn numbers(body: &Body) -> (f64, [f64; 3], [[f64; 3]; 3]) {
    let all = |numbers| literals(numbers).expect("numbers");
    let p = literals(&body.orientation).expect("numbers");
    let (a, c) = (rotation(p), rotation(body.user_axes));
    let moments = all(&body.inertia);
    let column = |m: usize| [0, 1, 2].map(|k| (0..3).map(|l| a[k][l] * c[m][l]).sum::<f64>());
    let columns = [0, 1, 2].map(column);
    let entry = |k: usize, l: usize| -> f64 {
        (0..3)
            .map(|m| columns[m][k] * moments[m] * columns[m][l])
            .sum()
    };
    (
        body.mass.literal().expect("a number"),
        all(&body.position),
        [0, 1, 2].map(|k| [0, 1, 2].map(|l| entry(k, l))),
    )
}

fn same(found: &Body, wanted: &Body) {
    let ((m, s, j), (mass, centre, tensor)) = (numbers(found), numbers(wanted));
    near(m, mass, mass);
    let long = tensor[0][0].max(tensor[1][1]).max(tensor[2][2]);
    for k in 0..3 {
        near(s[k], centre[k], (long / mass).sqrt());
        (0..3).for_each(|l| near(j[k][l], tensor[k][l], long));
    }
}

fn near(found: f64, wanted: f64, size: f64) {
    assert!(
        (found - wanted).abs() < 1e-13 * size,
        "{found} beside {wanted}"
    );
}

/// A sleeve of 16 corners, in mm, turned and far from the origin of its file. Values of trimesh
/// 5.2.0: `volume`, `center_mass`, `moment_inertia` of `tests/data/sleeve.stl`.
#[test]
fn a_sleeve_has_the_inertia_that_trimesh_finds() {
    let volume = 39_186.783_326_540_44;
    let centre = [
        30.000_000_327_834_74,
        -10.000_000_113_399_798,
        4.999_999_670_376_291,
    ];
    let tensor = [
        [
            13_340_066.421_906_497,
            163_210.710_412_845_02,
            -162_983.425_248_884_6,
        ],
        [
            163_210.710_412_845_02,
            11_880_176.984_722_912,
            1_475_854.672_133_108_1,
        ],
        [
            -162_983.425_248_884_6,
            1_475_854.672_133_108_1,
            11_884_291.286_648_05,
        ],
    ];
    let sleeve =
        body("shape = mesh(file = \"tests/data/sleeve.stl\", scale = 0.001), density = 2700.0");
    let (m, s, j) = numbers(&sleeve);
    near(m, 2700.0 * 1e-9 * volume, m);
    for k in 0..3 {
        near(s[k], 1e-3 * centre[k], 0.03);
        (0..3).for_each(|l| near(j[k][l], 2700.0 * 1e-15 * tensor[k][l], j[0][0]));
    }
}

/// The triangles of a box; a hollow where it is inside out.
fn block(low: [f64; 3], high: [f64; 3], is_hollow: bool) -> Triangles {
    let corner = |at: usize| [0, 1, 2].map(|k| if at >> k & 1 == 0 { low[k] } else { high[k] });
    let faces: [[usize; 4]; 6] = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let halves = faces
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    let triangles = halves.map(|[a, b, c]| if is_hollow { [a, c, b] } else { [a, b, c] });
    triangles.map(|face| face.map(corner)).collect()
}

/// The path of an OBJ file among those that are temporary.
fn obj(name: &str, triangles: &Triangles) -> String {
    let folder = std::env::temp_dir().join(format!("holonom-meshes-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join(name);
    let corners = triangles.iter().flatten();
    let mut text: String = corners
        .map(|[x, y, z]| format!("v {x} {y} {z}\n"))
        .collect();
    for face in 0..triangles.len() {
        let first = 3 * face + 1;
        text += &format!("f {first} {} {}\n", first + 1, first + 2);
    }
    std::fs::write(&file, text).expect("a file");
    file.to_str().expect("text").into()
}

#[test]
fn a_box_by_its_triangles_is_the_block() {
    let file = obj("box.obj", &block([0.1, 0.2, 0.3], [0.4, 0.4, 0.4], false));
    let block = "block(size = [0.3, 0.2, 0.1], at = [0.25, 0.3, 0.35])";
    same(
        &body(&format!(
            "shape = mesh(file = {file:?}, scale = 1.0), density = 7850.0"
        )),
        &body(&format!("shape = {block}, density = 7850.0")),
    );
    same(
        &body(&format!(
            "shape = mesh(file = {file:?}, scale = 1), mass = 3.0"
        )),
        &body(&format!("shape = {block}, mass = 3.0")),
    );
    // Turned by a quarter about z and moved, in axes of the body that are other ones again.
    let place = "at = [1.0, 0.0, -0.1], orientation = rotation([0.0, 0.0, 1.0], deg(90.0))";
    let turned = body(&format!(
        "shape = mesh(file = {file:?}, scale = 10.0, {place}), density = 1.0, orientation = rpy(0.3, 0.1, -0.4)"
    ));
    same(
        &turned,
        &body("shape = block(size = [2.0, 3.0, 1.0], at = [-2.0, 2.5, 3.4]), density = 1.0"),
    );
    // What is drawn: the origin of the file and its axes, from the body.
    let [shape] = &turned.shapes[..] else {
        panic!("one shape")
    };
    assert_eq!(shape.kind, ShapeKind::Mesh);
    assert_eq!(literals(&shape.sizes), Some([10.0; 3]));
    assert_eq!(shape.file.as_deref(), Some(&*file));
    let a = rotation(literals(&turned.orientation).expect("numbers"));
    let origin = [0, 1, 2].map(|k| (0..3).map(|l| a[k][l] * shape.centre[l]).sum::<f64>());
    for (k, wanted) in [3.0, -2.5, -3.5].into_iter().enumerate() {
        near(origin[k], wanted, 1.0);
    }
}

/// Hollows are taken away, by an own surface or by a shape of negative density.
#[test]
fn hollows_are_taken_away() {
    let outer = block([0.0; 3], [1.0, 2.0, 3.0], false);
    let inner = block([0.25; 3], [0.75; 3], true);
    let hollow = obj("hollow.obj", &[outer.clone(), inner].concat());
    let outer = obj("outer.obj", &outer);
    let shapes = "block(size = [1.0, 2.0, 3.0], at = [0.5, 1.0, 1.5], density = 2.0), \
         block(size = [0.5, 0.5, 0.5], at = [0.5, 0.5, 0.5], density = -2.0)";
    let wanted = body(&format!("shapes = [{shapes}]"));
    same(
        &body(&format!(
            "shape = mesh(file = {hollow:?}, scale = 1.0), density = 2.0"
        )),
        &wanted,
    );
    let (_, hole) = shapes.split_once("), ").expect("two");
    let mixed = body(&format!(
        "shapes = [mesh(file = {outer:?}, scale = 1.0, density = 2.0), {hole}]"
    ));
    same(&mixed, &wanted);
}

/// Beside a mass and an inertia a mesh is drawn, and may be open.
#[test]
fn a_mesh_beside_mass_and_inertia_is_only_drawn() {
    let open = obj("open.obj", &block([0.0; 3], [1.0; 3], false)[1..].to_vec());
    let measured = "mass = 1.0, inertia = [1.0, 1.0, 1.0], position = [1.0, 2.0, 3.0]";
    let drawn = body(&format!(
        "{measured}, shape = mesh(file = {open:?}, scale = 0.5)"
    ));
    assert_eq!(drawn.shapes[0].centre, [-1.0, -2.0, -3.0]);
    let said = described(&format!(
        "shape = mesh(file = {open:?}, scale = 0.5), density = 1.0"
    ));
    let said = said.expect_err("open");
    assert!(
        said.contains("does not enclose a volume: it has 3 edges at a hole"),
        "{said}"
    );
}

#[test]
fn what_encloses_nothing_or_something_twice_is_refused() {
    let cube = |low: f64, high: f64| block([low; 3], [high; 3], false);
    let hollow = |low: [f64; 3], high: [f64; 3]| block(low, high, true);
    let refused = |what: &[Triangles], wanted: &str| {
        let found = of_triangles(&what.concat()).expect_err(wanted);
        assert!(found.contains(wanted), "{found}");
    };
    refused(&[], "no triangles");
    refused(&[vec![[[0.0; 3]; 3]]], "no triangles");
    refused(&[vec![[[f64::NAN; 3]; 3]]], "not a number");
    refused(&[cube(0.0, 1e100)], "no volume that is a number");
    refused(&[cube(0.0, 1e-200)], "no volume that is a number");
    refused(&[hollow([0.0; 3], [1.0; 3])], "is inside out");
    let mut flipped = cube(0.0, 1.0);
    flipped[3].swap(0, 1);
    refused(&[flipped], "one is inside out");
    let twice = "would count twice";
    refused(&[cube(0.0, 1.0), cube(0.25, 0.75)], twice);
    refused(&[cube(0.0, 1.0), cube(0.5, 1.5)], twice);
    refused(&[cube(0.0, 1.0), cube(0.0, 1.0)], twice);
    // They share edges.
    refused(
        &[cube(0.0, 1.0), block([0.0; 3], [1.0, 1.0, 2.0], false)],
        twice,
    );
    // A shaft through a disc: no corner of one is in the other.
    refused(
        &[
            block([0.4, 0.4, -1.0], [0.6, 0.6, 2.0], false),
            cube(0.0, 1.0),
        ],
        twice,
    );
    let inside_out = "a piece that is inside out";
    refused(&[cube(0.0, 4.0), hollow([5.0; 3], [6.0; 3])], inside_out);
    refused(
        &[cube(0.0, 4.0), hollow([4.0, 4.0, 0.0], [5.0, 5.0, 4.0])],
        inside_out,
    );
    let hollows = [
        hollow([1.0; 3], [2.5, 2.0, 2.0]),
        hollow([2.0, 1.0, 1.0], [3.0, 2.0, 2.0]),
    ];
    refused(&[&[cube(0.0, 4.0)], &hollows[..]].concat(), inside_out);
    let hollow = hollow([1.0; 3], [2.0; 3]);
    refused(&[cube(0.0, 4.0), hollow.clone(), hollow], inside_out);
}

/// Solids beside each other may touch, and one may be in a hollow of another.
#[test]
fn what_touches_or_lies_in_a_hollow_is_counted_once() {
    let cube = |low: f64, high: f64, is_hollow| block([low; 3], [high; 3], is_hollow);
    let volume = |triangles: &[Triangles], wanted: f64| {
        let found = of_triangles(&triangles.concat()).expect("sound").volume;
        near(found, wanted, wanted);
    };
    let shell = [cube(0.0, 4.0, false), cube(1.0, 3.0, true)];
    volume(&shell, 56.0);
    volume(&[&shell[..], &[cube(1.5, 2.5, false)]].concat(), 57.0);
    // It fills its hollow, corner by corner, and against a wall that is not its own.
    volume(&[&shell[..], &[cube(1.0, 3.0, false)]].concat(), 64.0);
    volume(&[&shell[..], &[cube(1.0, 2.0, false)]].concat(), 57.0);
    // A hollow that touches a wall.
    volume(
        &[
            cube(0.0, 2.0, false),
            block([0.0, 0.5, 0.5], [1.0, 1.5, 1.5], true),
        ],
        7.0,
    );
    let beside = block([4.0, 1.0, 1.0], [5.0, 2.0, 2.0], false);
    volume(&[cube(0.0, 4.0, false), beside], 65.0);
    volume(&[cube(0.0, 1.0, false), cube(1.0, 2.0, false)], 2.0);
    // A plate, and a sheet of two sides that encloses nothing.
    let plate = block([2.0, 0.0, 0.0], [3.0, 1.0, 1e-6], false);
    let [a, b, c] = [[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, 1.0, 0.0]];
    volume(
        &[cube(0.0, 1.0, false), plate, vec![[a, b, c], [a, c, b]]],
        1.0 + 1e-6,
    );
    // A triangle that is a point, far away, moves nothing.
    volume(&[cube(0.0, 1.0, false), vec![[[1e6; 3]; 3]]], 1.0);
}

/// Touching, turned, and rounded as files are.
#[test]
fn what_touches_but_for_round_off_is_counted_once() {
    let (sine, cosine) = 0.3_f64.sin_cos();
    for far in [0.0, 20.0, 300.0] {
        let turned = |[x, y, z]: [f64; 3]| {
            let placed = [
                cosine * x - sine * y + far,
                sine * x + cosine * y,
                z + 0.5 * far,
            ];
            placed.map(|x| f64::from(x as f32))
        };
        let both = [
            block([0.0; 3], [10.0; 3], false),
            block([10.0, 2.0, 2.0], [20.0, 8.0, 8.0], false),
        ];
        let both: Triangles = both
            .concat()
            .into_iter()
            .map(|face| face.map(turned))
            .collect();
        let found = of_triangles(&both).expect("sound").volume;
        assert!((found - 1360.0).abs() < 0.01, "{found}");
    }
}

/// Files as programs write them.
#[test]
fn files_of_all_kinds_are_read() {
    let folder = std::env::temp_dir().join(format!("holonom-files-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("part");
    let read = |ending: &str, bytes: &[u8]| {
        let file = file.with_extension(ending);
        std::fs::write(&file, bytes).expect("a file");
        holonom_engine::mesh::enclosed(&file).map(|bulk| bulk.volume)
    };
    let solid = |name: &str, triangles: &Triangles| {
        let mut text = format!("solid {name}\n");
        for face in triangles {
            text += "facet normal nan 0 0\nouter loop\n";
            face.iter()
                .for_each(|[x, y, z]| text += &format!(" vertex {x} {y} {z}\n"));
            text += "endloop\nendfacet\n";
        }
        text + "endsolid\n"
    };
    let cube = block([0.0; 3], [1.0; 3], false);
    let other = block([2.0, 0.0, 0.0], [3.0, 2.0, 2.0], false);
    let two = solid("a vertex", &cube) + &solid("", &other);
    near(read("stl", two.as_bytes()).expect("sound"), 5.0, 5.0);
    let upper = two
        .to_ascii_uppercase()
        .replace("NAN", "nan")
        .replace('\n', "\r\n");
    assert_eq!(
        read("STL", format!("\u{feff}\n {upper}").as_bytes()),
        Ok(5.0)
    );
    // With all digits of the text.
    let far = block([1_000_000.0; 3], [1_000_000.25; 3], false);
    let found = read("stl", solid("far", &far).as_bytes()).expect("sound");
    assert!((found - 0.015_625).abs() < 1e-9, "{found}");
    let cut = two.replacen("endloop", "", 1);
    assert!(
        read("stl", cut.as_bytes())
            .expect_err("cut")
            .contains("three corners before this in line")
    );
    // Bytes, with a title that begins like a text.
    let mut bytes = b"solid of a program".to_vec();
    bytes.resize(80, b' ');
    bytes.extend((cube.len() as u32).to_le_bytes());
    for face in &cube {
        bytes.extend([0; 12]);
        bytes.extend(
            face.iter()
                .flatten()
                .flat_map(|&x| (x as f32).to_le_bytes()),
        );
        bytes.extend([0; 2]);
    }
    near(read("stl", &bytes).expect("sound"), 1.0, 1.0);
    bytes[..5].fill(b' ');
    let padded = [&bytes[..], &[0; 8]].concat();
    near(read("stl", &padded).expect("sound"), 1.0, 1.0);
    let both = [&bytes[..], &bytes[..]].concat();
    assert!(
        read("stl", &both)
            .expect_err("two")
            .contains("is no STL file")
    );
    assert!(read("stl", b"").is_err());
    let obj = "\u{feff}# a box\nmtllib none.mtl\nv 0 0 0 1\nv 1 0 0 2.0\nv 1 1 0 # a corner\nv 0 1 0\n\
         v 0 0 1 0.5 0.5 0.5\nv 1 0 1\nv 1 1 1\nv 0 1 1\nl 1 2 3\nusemtl\nf 1 4 3 2 # bottom\n\
         f 5/1 6/2 7/3 8//4\nf -8 -7 \\\n-3 -4\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    near(read("obj", obj.as_bytes()).expect("sound"), 1.0, 1.0);
    assert!(
        read("obj", b"v 0 0 0\nf 1 2 3\n")
            .expect_err("none")
            .contains("corners that are there in line 2")
    );
}

#[test]
fn what_is_written_of_a_mesh_is_checked() {
    let said = |mesh: &str| described(&format!("shape = mesh({mesh}), density = 1.0"));
    let has = |mesh: &str, wanted: &str| {
        let said = said(mesh).expect_err(mesh);
        assert!(said.contains(wanted), "{mesh}: {said}");
    };
    let sleeve = "file = \"tests/data/sleeve.stl\"";
    has(sleeve, "`mesh` lacks `scale`");
    has("scale = 1.0", "`mesh` lacks `file`");
    has(
        "file = 1.0, scale = 1.0",
        "expected the path of a file in quotes",
    );
    has("file = \"no.stl\", scale = 1.0", "there is no such file");
    has(
        "file = \"tests/data/row.rs\", scale = 1.0",
        "neither an STL (.stl) nor an OBJ",
    );
    has(
        &format!("{sleeve}, scale = 0.0"),
        "must be positive, in m for a unit of its file",
    );
    has(&format!("{sleeve}, scale = -1.0"), "must be positive");
    has(
        &format!("{sleeve}, scale = 1.0, size = 2.0"),
        "`mesh` has no `size`",
    );
    let said = described("mesh = \"part.stl\", density = 1.0").expect_err("a key");
    assert!(said.contains("write `shape = mesh(file"), "{said}");
}
