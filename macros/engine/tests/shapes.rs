//! Bodies by shapes and rotations by words: against integrals by numbers, and turns one by one.

mod common;

use std::f64::consts::TAU;

use common::{model, tokens};
use holonom_engine::model::inertia::rotation;
use holonom_engine::model::{Body, Model};

type Vector = [f64; 3];

/// Mass, centre and tensor about it, in global axes.
struct Spread {
    mass: f64,
    centre: Vector,
    tensor: [Vector; 3],
}

fn described(fields: &str) -> Model {
    model(&tokens(&format!("struct Shaped {{ {fields} }}")))
}

fn one(attribute: &str) -> Model {
    described(&format!("#[body({attribute}, free)] body: Body,"))
}

fn numbers<const N: usize>(model: &Model, of: impl Fn(&Body) -> [f64; N]) -> [f64; N] {
    of(&model.bodies[0])
}

fn seen(model: &Model, number: holonom_engine::model::Number) -> f64 {
    model.seen(number).expect("a number that the macro sees")
}

/// The rotation of the body's axes, columns in global axes.
fn axes(model: &Model) -> [Vector; 3] {
    let p = numbers(model, |body| body.orientation.map(|e| seen(model, e)));
    let norm = p.iter().map(|e| e * e).sum::<f64>().sqrt();
    rotation(p.map(|e| e / norm))
}

fn spread(model: &Model) -> Spread {
    let body = &model.bodies[0];
    let moments = body.inertia.map(|moment| seen(model, moment));
    let (a, c) = (axes(model), rotation(body.user_axes));
    // The column of a principal axis in global axes.
    let column = |m: usize| [0, 1, 2].map(|k| (0..3).map(|l| a[k][l] * c[m][l]).sum::<f64>());
    let columns = [0, 1, 2].map(column);
    let entry = |k: usize, l: usize| {
        (0..3)
            .map(|m| columns[m][k] * moments[m] * columns[m][l])
            .sum::<f64>()
    };
    Spread {
        mass: seen(model, body.mass),
        centre: body.position.map(|part| seen(model, part)),
        tensor: [0, 1, 2].map(|k| [0, 1, 2].map(|l| entry(k, l))),
    }
}

/// Gauss and Legendre: exact up to the power 9.
const GAUSS: [(f64, f64); 5] = [
    (0.5, 128.0 / 450.0),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_23),
    (0.230_765_344_947_158_5, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
    (0.046_910_077_030_668_02, 0.118_463_442_528_094_54),
];

/// The sum over a map of the unit cube into space, with what a small cube becomes.
fn integral(density: f64, map: impl Fn(f64, f64, f64) -> (Vector, f64)) -> Vec<(f64, Vector)> {
    const AROUND: usize = 16;
    let mut points = Vec::new();
    for (u, weight_u) in GAUSS {
        for (v, weight_v) in GAUSS {
            // Around an axis equal steps are exact, between walls the points of Gauss are.
            for step in 0..AROUND {
                let (point, size) = map(u, v, step as f64 / AROUND as f64);
                points.push((density * weight_u * weight_v * size / AROUND as f64, point));
            }
        }
    }
    points
}

/// The same where the third direction lies between walls too.
fn integral_of_box(
    density: f64,
    map: impl Fn(f64, f64, f64) -> (Vector, f64),
) -> Vec<(f64, Vector)> {
    let mut points = Vec::new();
    for (u, weight_u) in GAUSS {
        for (v, weight_v) in GAUSS {
            for (w, weight_w) in GAUSS {
                let (point, size) = map(u, v, w);
                points.push((density * weight_u * weight_v * weight_w * size, point));
            }
        }
    }
    points
}

fn summed(points: &[(f64, Vector)]) -> Spread {
    let mass: f64 = points.iter().map(|(mass, _)| mass).sum();
    let mean = |k: usize| points.iter().map(|(m, p)| m * p[k]).sum::<f64>() / mass;
    let centre = [0, 1, 2].map(mean);
    let mut tensor = [[0.0; 3]; 3];
    for (m, p) in points {
        let s = [0, 1, 2].map(|k| p[k] - centre[k]);
        let square: f64 = s.iter().map(|x| x * x).sum();
        for (k, row) in tensor.iter_mut().enumerate() {
            for (l, entry) in row.iter_mut().enumerate() {
                *entry += m * (if k == l { square } else { 0.0 } - s[k] * s[l]);
            }
        }
    }
    Spread {
        mass,
        centre,
        tensor,
    }
}

#[track_caller]
fn assert_same(found: &Spread, wanted: &Spread, what: &str) {
    let near = |a: f64, b: f64, scale: f64, of: &str| {
        let off = (a - b).abs() / scale;
        assert!(off < 1e-13, "{what}, {of}: {a} beside {b}");
    };
    near(found.mass, wanted.mass, wanted.mass, "mass");
    for k in 0..3 {
        near(found.centre[k], wanted.centre[k], 1.0, "centre");
        for l in 0..3 {
            let scale = wanted.tensor[0][0] + wanted.tensor[1][1] + wanted.tensor[2][2];
            near(found.tensor[k][l], wanted.tensor[k][l], scale, "tensor");
        }
    }
}

fn combined<const N: usize>(at: Vector, parts: [(f64, Vector); N]) -> Vector {
    [0, 1, 2].map(|k| at[k] + parts.iter().map(|(factor, v)| factor * v[k]).sum::<f64>())
}

fn norm(v: Vector) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Any two directions across another one.
fn across(d: Vector) -> [Vector; 2] {
    let other = if d[0].abs() < 0.8 * norm(d) {
        [1.0, 0.0, 0.0]
    } else {
        [0.0, 1.0, 0.0]
    };
    let n = cross(d, other);
    let n = n.map(|x| x / norm(n));
    let m = cross(d, n);
    [n, m.map(|x| x / norm(m))]
}

const FROM: Vector = [0.3, -0.2, 0.1];

/// Along every axis and in every plane of them, forth and back.
const DIRECTIONS: [Vector; 14] = [
    [0.5, 0.0, 0.0],
    [-0.5, 0.0, 0.0],
    [0.0, 0.5, 0.0],
    [0.0, -0.5, 0.0],
    [0.0, 0.0, 0.5],
    [0.0, 0.0, -0.5],
    [0.3, 0.4, 0.0],
    [-0.3, 0.4, 0.0],
    [0.3, 0.0, -0.4],
    [-0.3, 0.0, -0.4],
    [0.0, 0.3, 0.4],
    [0.0, -0.3, 0.4],
    [0.2, -0.3, 0.4],
    [-0.2, -0.3, -0.4],
];

fn to(d: Vector) -> Vector {
    [0, 1, 2].map(|k| FROM[k] + d[k])
}

/// Of radii at the two ends.
fn around(d: Vector, [inner, outer]: [f64; 2], tip: f64) -> Vec<(f64, Vector)> {
    let ([n, m], long) = (across(d), norm(d));
    integral(700.0, |u, v, w| {
        let (thin, thick) = (inner, outer * (1.0 - v) + tip * v);
        let radius = thin + u * (thick - thin);
        let (sine, cosine) = (TAU * w).sin_cos();
        let point = combined(FROM, [(v, d), (radius * cosine, n), (radius * sine, m)]);
        (point, radius * (thick - thin) * TAU * long)
    })
}

#[test]
fn round_shapes_are_their_integrals() {
    for d in DIRECTIONS {
        let (from, to) = (FROM, to(d));
        let ends = format!("from = {from:?}, to = {to:?}");
        let written = format!("shape = cylinder(radius = 0.11, {ends}), density = 700.0");
        let cylinder = summed(&around(d, [0.0, 0.11], 0.11));
        assert_same(&spread(&one(&written)), &cylinder, &written);
        let written = format!("shape = tube(outer = 0.11, inner = 0.04, {ends}), density = 700.0");
        let tube = summed(&around(d, [0.04, 0.11], 0.11));
        assert_same(&spread(&one(&written)), &tube, &written);
        let written = format!("shape = cone(radius = 0.11, {ends}), density = 700.0");
        let cone = summed(&around(d, [0.0, 0.11], 0.0));
        assert_same(&spread(&one(&written)), &cone, &written);
        let (middle, long) = ([0, 1, 2].map(|k| 0.5 * (from[k] + to[k])), norm(d));
        let written = format!(
            "shape = disc(radius = 0.11, thickness = {long:?}, at = {middle:?}, axis = {d:?}), density = 700.0"
        );
        assert_same(&spread(&one(&written)), &cylinder, &written);
    }
}

#[test]
fn a_ball_is_its_integral() {
    let ball = integral(700.0, |u, v, w| {
        let (radius, height) = (0.2 * u, 2.0 * v - 1.0);
        let wide = (1.0 - height * height).sqrt();
        let (sine, cosine) = (TAU * w).sin_cos();
        let point = combined(
            FROM,
            [
                (radius * wide * cosine, [1.0, 0.0, 0.0]),
                (radius * wide * sine, [0.0, 1.0, 0.0]),
                (radius * height, [0.0, 0.0, 1.0]),
            ],
        );
        (point, 0.2 * radius * radius * 2.0 * TAU)
    });
    let written = format!("shape = ball(radius = 0.2, at = {FROM:?}), density = 700.0");
    assert_same(&spread(&one(&written)), &summed(&ball), &written);
}

/// Columns along width and height of a bar without `up`, as the guide says.
fn width_and_height(d: Vector) -> [Vector; 2] {
    let x = d.map(|part| part / norm(d));
    let z = match d {
        [_, _, 0.0] => [0.0, 0.0, 1.0],
        [_, 0.0, _] => cross(x, [0.0, 1.0, 0.0]),
        [0.0, _, _] => [1.0, 0.0, 0.0],
        // The least rotation takes z along with x; what points backwards begins with half a turn
        // about z.
        _ => {
            let start = [d[0].signum(), 0.0, 0.0];
            let axis = cross(start, x);
            let sine = norm(axis);
            let axis = axis.map(|part| part / sine);
            let cosine = start[0] * x[0];
            let z = [0.0, 0.0, 1.0];
            let along: f64 = axis[2] * (1.0 - cosine);
            let side = cross(axis, z);
            [0, 1, 2].map(|k| cosine * z[k] + sine * side[k] + along * axis[k])
        }
    };
    [cross(z, x), z]
}

fn bar(d: Vector, [y, z]: [Vector; 2]) -> Spread {
    let (width, height, long) = (0.08, 0.05, norm(d));
    summed(&integral_of_box(700.0, |u, v, w| {
        let parts = [(u, d), ((v - 0.5) * width, y), ((w - 0.5) * height, z)];
        (combined(FROM, parts), width * height * long)
    }))
}

#[test]
fn a_bar_has_its_height_where_the_guide_says() {
    for d in DIRECTIONS {
        let ends = format!("from = {FROM:?}, to = {:?}", to(d));
        let written = format!("shape = bar(width = 0.08, height = 0.05, {ends}), density = 700.0");
        let model = one(&written);
        assert_same(&spread(&model), &bar(d, width_and_height(d)), &written);
        // Its own axes are the body's.
        let a = axes(&model);
        for k in 0..3 {
            assert!((a[k][0] - d[k] / norm(d)).abs() < 1e-15, "{written}");
        }
        let up = [0.1, -0.7, 0.35];
        let written = format!(
            "shape = bar(width = 0.08, height = 0.05, {ends}, up = {up:?}), density = 700.0"
        );
        let x = d.map(|part| part / norm(d));
        let y = cross(up, x);
        let y = y.map(|part| part / norm(y));
        assert_same(&spread(&one(&written)), &bar(d, [y, cross(x, y)]), &written);
    }
}

#[test]
fn a_block_stands_in_the_axes_of_its_body() {
    let turn = "rotation([0.3, -0.5, 0.8], 0.7)";
    let written = format!(
        "shape = block(size = [0.3, 0.2, 0.1], at = {FROM:?}), density = 700.0, orientation = {turn}"
    );
    let model = one(&written);
    let a = axes(&model);
    let column = |l: usize| [0, 1, 2].map(|k| a[k][l]);
    let block = summed(&integral_of_box(700.0, |u, v, w| {
        let parts = [
            ((u - 0.5) * 0.3, column(0)),
            ((v - 0.5) * 0.2, column(1)),
            ((w - 0.5) * 0.1, column(2)),
        ];
        (combined(FROM, parts), 0.3 * 0.2 * 0.1)
    }));
    assert_same(&spread(&model), &block, &written);
    // The same of its halves.
    let half = |side: f64| {
        let at = combined(FROM, [(side * 0.075, column(0))]);
        format!("block(size = [0.15, 0.2, 0.1], at = {at:?})")
    };
    let halves = format!(
        "shapes = [{}, {}], density = 700.0, orientation = {turn}",
        half(-1.0),
        half(1.0)
    );
    assert_same(&spread(&one(&halves)), &block, &halves);
}

#[test]
fn a_thin_rod_has_the_moments_of_tables() {
    let model =
        one("shape = rod(radius = 0.01, from = [0.0, 0.0, 0.0], to = [0.6, 0.0, 0.0]), mass = 2.0");
    let found = spread(&model);
    let across = 2.0 * 0.36 / 12.0;
    let wanted = Spread {
        mass: 2.0,
        centre: [0.3, 0.0, 0.0],
        tensor: [
            [2.0 * 1e-4 / 2.0, 0.0, 0.0],
            [0.0, across, 0.0],
            [0.0, 0.0, across],
        ],
    };
    assert_same(&found, &wanted, "a thin rod");
}

/// A hammer with a hole, in given axes, and of a given mass.
#[test]
fn several_shapes_are_one_body() {
    let handle =
        "rod(radius = 0.01, from = [0.0, 0.0, 0.0], to = [0.0, 0.3, 0.0], density = 600.0)";
    let head = "tube(outer = 0.03, inner = 0.01, from = [-0.05, 0.3, 0.0], to = [0.05, 0.3, 0.0])";
    let solid = "cylinder(radius = 0.03, from = [-0.05, 0.3, 0.0], to = [0.05, 0.3, 0.0])";
    let hole = "cylinder(radius = 0.01, from = [0.05, 0.3, 0.0], to = [-0.05, 0.3, 0.0], density = -7850.0)";
    let whole = one(&format!("shapes = [{handle}, {head}], density = 7850.0"));
    let drilled = one(&format!(
        "shapes = [{handle}, {solid}, {hole}], density = 7850.0"
    ));
    assert_same(&spread(&drilled), &spread(&whole), "a hole");
    let turned = one(&format!(
        "shapes = [{handle}, {head}], density = 7850.0, orientation = rotation([1.0, 2.0, 3.0], 0.4)"
    ));
    assert_same(&spread(&turned), &spread(&whole), "other axes");
    // By hand: parts, and what Steiner's theorem adds.
    let [light, heavy] = [handle, head].map(|part| {
        let density = if part == handle {
            ""
        } else {
            ", density = 7850.0"
        };
        spread(&one(&format!(
            "shape = {}{density}",
            part.replace(", density = 600.0)", "), density = 600.0")
        )))
    });
    let mass = light.mass + heavy.mass;
    let centre = (light.mass * 0.15 + heavy.mass * 0.3) / mass;
    let found = spread(&whole);
    assert!((found.centre[1] - centre).abs() < 1e-16);
    let steiner = light.mass * (centre - 0.15).powi(2) + heavy.mass * (0.3 - centre).powi(2);
    let about_z = light.tensor[2][2] + heavy.tensor[2][2] + steiner;
    assert!((found.tensor[2][2] - about_z).abs() < 1e-15 * about_z.max(1.0));
    // A mass for all of one density.
    let even = handle.replace(", density = 600.0", "");
    let by_mass = spread(&one(&format!("shapes = [{even}, {head}], mass = 3.0")));
    let by_density = spread(&one(&format!(
        "shapes = [{even}, {head}], density = 7850.0"
    )));
    let factor = 3.0 / by_density.mass;
    let scaled = Spread {
        mass: 3.0,
        tensor: by_density.tensor.map(|row| row.map(|x| factor * x)),
        ..by_density
    };
    assert_same(&by_mass, &scaled, "a mass for all");
}

/// What parameters are like stands for them; directions that do not depend on them are written.
#[test]
fn dimensions_may_be_parameters() {
    let fields = |attribute: &str| {
        described(&format!(
            "#[param(like = 0.5)] long: f64, #[param(like = 0.02)] thin: f64, #[param(like = 0.3)] side: f64, \
             #[param(like = 2000.0)] weight: f64, #[body({attribute}, free)] body: Body,"
        ))
    };
    for (parametric, plain, is_along_an_axis) in [
        (
            "shape = cylinder(radius = thin, from = [0.0, 0.0, 0.0], to = [long, 0.0, 0.0]), density = weight",
            "shape = cylinder(radius = 0.02, from = [0.0, 0.0, 0.0], to = [0.5, 0.0, 0.0]), density = 2000.0",
            true,
        ),
        (
            "shape = tube(outer = 2.0 * thin, inner = thin, from = [side, long, 0.1], to = [side, 0.0, 0.1]), density = weight",
            "shape = tube(outer = 0.04, inner = 0.02, from = [0.3, 0.5, 0.1], to = [0.3, 0.0, 0.1]), density = 2000.0",
            true,
        ),
        (
            "shape = cone(radius = thin, from = [0.0, 0.0, 0.0], to = [0.0, side, -long]), mass = 2.0",
            "shape = cone(radius = 0.02, from = [0.0, 0.0, 0.0], to = [0.0, 0.3, -0.5]), mass = 2.0",
            false,
        ),
        (
            "shape = bar(width = thin, height = 2.0 * thin, from = [long, 0.0, 0.0], to = [0.0, side, 0.0]), mass = weight",
            "shape = bar(width = 0.02, height = 0.04, from = [0.5, 0.0, 0.0], to = [0.0, 0.3, 0.0]), mass = 2000.0",
            false,
        ),
        (
            "shape = bar(width = thin, height = 2.0 * thin, from = [long, 0.0, thin], to = [0.0, side, 0.0]), mass = weight",
            "shape = bar(width = 0.02, height = 0.04, from = [0.5, 0.0, 0.02], to = [0.0, 0.3, 0.0]), mass = 2000.0",
            false,
        ),
    ] {
        let found = fields(parametric);
        assert_same(&spread(&found), &spread(&one(plain)), parametric);
        let orientation = found.bodies[0].orientation;
        let is_written = orientation.iter().all(|e| e.literal().is_some());
        assert_eq!(is_written, is_along_an_axis, "{parametric}");
    }
    // In the plane of x and y the normal of the plane is an axis, whatever the lengths.
    let planar = fields(
        "shape = rod(radius = 0.01, from = [0.0, 0.0, 0.0], to = [long, -side, 0.0]), mass = 1.0",
    );
    let [_, e1, e2, _] = planar.bodies[0].orientation;
    assert_eq!([e1, e2].map(|e| e.literal()), [Some(0.0); 2]);
}

/// In an array the number of the element stands in the shape.
#[test]
fn elements_of_an_array_have_shapes_of_their_own() {
    let row = described(
        "#[body(shape = rod(radius = 0.01, from = [0.5 * k, 0.0, 0.0], to = [0.5 * k + 0.5, 0.0, 0.0]), mass = 1.0 + k, free)] \
         links: [Body; 3],",
    );
    for (k, body) in row.bodies.iter().enumerate() {
        let k = k as f64;
        assert_eq!(seen(&row, body.position[0]), 0.5 * k + 0.25);
        assert_eq!(seen(&row, body.mass), 1.0 + k);
    }
}

/// The matrix of a turn about one axis.
fn about(axis: usize, angle: f64) -> [Vector; 3] {
    let (s, c) = angle.sin_cos();
    let (k, l) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut turn = [[0.0; 3]; 3];
    turn[axis][axis] = 1.0;
    (turn[k][k], turn[l][l], turn[k][l], turn[l][k]) = (c, c, -s, s);
    turn
}

fn times(a: [Vector; 3], b: [Vector; 3]) -> [Vector; 3] {
    a.map(|row| [0, 1, 2].map(|l| (0..3).map(|m| row[m] * b[m][l]).sum()))
}

#[test]
fn rotations_by_words_are_their_turns() {
    let (a, b, c) = (0.3, -0.8, 1.9);
    let cases = [
        // Fixed axes: the roll is first.
        (
            "rpy(0.3, -0.8, 1.9)",
            times(times(about(2, c), about(1, b)), about(0, a)),
        ),
        (
            "euler_zxz(0.3, -0.8, 1.9)",
            times(times(about(2, a), about(0, b)), about(2, c)),
        ),
        (
            "bryant_xyz(0.3, -0.8, 1.9)",
            times(times(about(0, a), about(1, b)), about(2, c)),
        ),
        (
            "rotation([0.0, 0.0, 1.0], 0.3) * rotation([1.0, 0.0, 0.0], -0.8) * rotation([0.0, 0.0, 1.0], 1.9)",
            times(times(about(2, a), about(0, b)), about(2, c)),
        ),
        (
            "axes(x = [0.0, 2.0, 0.0], z = [1.0, 0.0, 0.0])",
            [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        ),
        (
            "axes(y = [0.0, 0.0, 3.0], x = [0.0, 1.0, 0.0])",
            [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        ),
        (
            "along(z, [0.0, 0.0, 0.0], [2.0, 0.0, 0.0])",
            [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]],
        ),
        ("[0.0, 0.0, 0.0, 2.0]", about(2, std::f64::consts::PI)),
    ];
    for (words, wanted) in cases {
        let model = one(&format!(
            "mass = 1.0, inertia = [1.0, 1.1, 1.2], orientation = {words}"
        ));
        let found = axes(&model);
        for k in 0..3 {
            for l in 0..3 {
                assert!(
                    (found[k][l] - wanted[k][l]).abs() < 1e-15,
                    "{words}: {found:?}"
                );
            }
        }
    }
}

/// Diag(1, 2, 2.5) in axes that are turned by a right angle about z is diag(2, 1, 2.5).
#[test]
fn inertia_may_have_axes_of_its_own() {
    let tensor = |axes: &str| {
        spread(&one(&format!(
            "mass = 1.0, inertia = [1.0, 2.0, 2.5], inertia_axes = {axes}"
        )))
    };
    let found = tensor("rotation([0.0, 0.0, 1.0], deg(90.0))").tensor;
    for (k, moment) in [2.0, 1.0, 2.5].into_iter().enumerate() {
        assert!((found[k][k] - moment).abs() < 1e-15, "{found:?}");
    }
    // A tensor in turned axes, against R J R^T.
    let found = spread(&one(
        "mass = 1.0, inertia = [[1.0, 0.1, 0.2], [0.1, 2.0, -0.3], [0.2, -0.3, 2.5]], inertia_axes = rpy(0.3, -0.8, 1.9)",
    ))
    .tensor;
    let r = times(times(about(2, 1.9), about(1, -0.8)), about(0, 0.3));
    let j = [[1.0, 0.1, 0.2], [0.1, 2.0, -0.3], [0.2, -0.3, 2.5]];
    let transposed = [0, 1, 2].map(|k| [0, 1, 2].map(|l| r[l][k]));
    let wanted = times(times(r, j), transposed);
    for k in 0..3 {
        for l in 0..3 {
            assert!((found[k][l] - wanted[k][l]).abs() < 4e-15, "{found:?}");
        }
    }
}
