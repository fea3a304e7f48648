//! The figure of the guide's reference: every joint and driver with the points and axes that one
//! writes, and the positive sense of its angle or displacement.

use std::fmt::{Display, Write as _};

use crate::pen::{Of, Pen, V, v};

const COLUMNS: usize = 4;
const WIDE: usize = 160;
const HIGH: usize = 156;

/// A cell: the name, the parameters, and the drawing in tenths of a pixel about its middle.
type Cell = (&'static str, &'static str, fn(&mut Pen));

pub(crate) fn figure() -> String {
    let label =
        "Every joint and driver: points, axes, and the positive sense of angles and displacements";
    drawn(label, &CELLS)
}

/// Those of rolling, in the guide's page on it.
pub(crate) fn rolling() -> String {
    let rolls =
        |name: &str| name.starts_with("Rolling") || ["WheelPair", "KnifeEdge"].contains(&name);
    let cells: Vec<Cell> = CELLS.into_iter().filter(|(name, ..)| rolls(name)).collect();
    drawn(
        "Joints that roll, and the knife edge: points and axes",
        &cells,
    )
}

/// Cells in rows.
pub(crate) fn drawn<N: Display, K: Display, D: Fn(&mut Pen)>(
    label: &str,
    cells: &[(N, K, D)],
) -> String {
    let (wide, high) = (COLUMNS * WIDE, cells.len().div_ceil(COLUMNS) * HIGH);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {wide} {high}\" width=\"100%\" style=\"max-width:{wide}px\" \
         role=\"img\" aria-label=\"{label}\"><style>{STYLE}</style>\
         <g class=\"holonom-joints\">"
    );
    for (place, (name, parameters, draw)) in cells.iter().enumerate() {
        let (x, y) = (place % COLUMNS * WIDE, place / COLUMNS * HIGH);
        let (middle, base) = (WIDE / 2, HIGH - 26);
        let mut pen = Pen::default();
        draw(&mut pen);
        let _ = write!(
            text,
            "<g transform=\"translate({x},{y})\"><g transform=\"translate({middle},66)scale(.1)\">{}</g>\
             <text class=\"n\" x=\"{middle}\" y=\"{base}\">{name}</text><text class=\"k\" x=\"{middle}\" y=\"{}\">{parameters}</text></g>",
            pen.text,
            base + 14
        );
    }
    text += "</g></svg>\n";
    text
}

/// Of the classes of the pen: bodies, what is written, positive senses, thin lines, words.
const STYLE: &str = ".holonom-joints path,.holonom-joints circle{stroke-width:8;stroke-linejoin:round;stroke:#39414f}\
.holonom-joints .i1,.holonom-joints .k1{fill:#c9cfda}.holonom-joints .i2,.holonom-joints .k2{fill:#aab2c0}.holonom-joints .i3,.holonom-joints .k3{fill:#8f98a8}\
.holonom-joints .k1,.holonom-joints .k2,.holonom-joints .k3{fill-opacity:.45}\
.holonom-joints .j1{fill:#7fb0ea}.holonom-joints .j2{fill:#5f97dc}.holonom-joints .j3{fill:#4480c8}\
.holonom-joints .a{stroke:#d9722e;stroke-width:15;stroke-dasharray:50 30;fill:none}.holonom-joints .p{fill:#d9722e;stroke:none}\
.holonom-joints .g{stroke:#2f9e56;stroke-width:20;fill:none}.holonom-joints .q{fill:#2f9e56;stroke:none}\
.holonom-joints .l{stroke:currentColor;stroke-width:12;fill:none}.holonom-joints .h{fill:none}\
.holonom-joints text{fill:currentColor;font:12px sans-serif}.holonom-joints .n,.holonom-joints .k{text-anchor:middle}.holonom-joints .n{font-weight:600}\
.holonom-joints .k{font-size:10.5px;opacity:.75}.holonom-joints .o,.holonom-joints .s{font-size:105px}.holonom-joints .o{fill:#d9722e}.holonom-joints .s{fill:#2f9e56}";

const O: V = V::new(0.0, 0.0, 0.0);
const X: V = V::new(1.0, 0.0, 0.0);
const Y: V = V::new(0.0, 1.0, 0.0);
const Z: V = V::new(0.0, 0.0, 1.0);

/// A base of the first body below the origin.
fn base(pen: &mut Pen) {
    pen.block(Of::I, v(0.0, 0.0, -36.0), v(24.0, 24.0, 6.0));
    pen.cylinder(Of::I, v(0.0, 0.0, -30.0), v(0.0, 0.0, 0.0), 8.0);
}

/// Two bodies apart, for joints without parts of their own: the first to the left.
fn apart(pen: &mut Pen) {
    pen.block(Of::I, v(0.0, -34.0, -8.0), v(14.0, 14.0, 14.0));
    pen.block(Of::J, v(0.0, 34.0, -8.0), v(14.0, 14.0, 14.0));
}

const HEAD: V = V::new(0.0, -34.0, 8.0);
const TAIL: V = V::new(0.0, 34.0, 8.0);

const CELLS: [Cell; 30] = [
    ("Spherical", "point", |pen| {
        base(pen);
        pen.cylinder(Of::J, v(0.0, 8.0, 4.0), v(0.0, 56.0, 26.0), 6.0);
        pen.ball(Of::J, O, 13.0);
        pen.dot(O);
    }),
    ("Revolute", "point, axis", |pen| {
        base(pen);
        pen.block(Of::J, v(0.0, 26.0, 5.0), v(11.0, 38.0, 5.0));
        pen.axis(v(0.0, 0.0, -52.0), v(0.0, 0.0, 56.0));
        pen.dot(v(0.0, 0.0, 5.0));
        pen.turn(v(0.0, 0.0, 22.0), Z, 30.0 * Y, [-55.0, 65.0]);
        pen.word("s", v(0.0, 0.0, 36.0), [26.0, 0.0], "angle");
    }),
    ("Universal", "point, axis_i, axis_j", |pen| {
        pen.cylinder(Of::I, v(0.0, -60.0, 0.0), v(0.0, -26.0, 0.0), 8.0);
        pen.block(Of::I, v(-18.0, -12.0, 0.0), v(4.0, 18.0, 6.0));
        pen.block(Of::I, v(0.0, -26.0, 0.0), v(22.0, 4.0, 6.0));
        pen.cylinder(Of::J, v(0.0, 0.0, -22.0), v(0.0, 0.0, 22.0), 4.0);
        pen.cylinder(Of::I, v(-18.0, 0.0, 0.0), v(18.0, 0.0, 0.0), 4.0);
        pen.block(Of::J, v(0.0, 12.0, -18.0), v(6.0, 18.0, 4.0));
        pen.block(Of::J, v(0.0, 26.0, 0.0), v(6.0, 4.0, 22.0));
        pen.block(Of::J, v(0.0, 12.0, 18.0), v(6.0, 18.0, 4.0));
        pen.cylinder(Of::J, v(0.0, 30.0, 0.0), v(0.0, 60.0, 0.0), 8.0);
        pen.block(Of::I, v(18.0, -12.0, 0.0), v(4.0, 18.0, 6.0));
        pen.axis(v(-40.0, 0.0, 0.0), v(54.0, 0.0, 0.0));
        pen.axis(v(0.0, 0.0, -42.0), v(0.0, 0.0, 50.0));
        pen.dot(O);
        pen.word("o", v(54.0, 0.0, 0.0), [-34.0, 4.0], "axis_i");
        pen.word("o", v(0.0, 0.0, 50.0), [5.0, 4.0], "axis_j");
    }),
    ("Cylindrical", "point, axis", |pen| {
        pen.cylinder(Of::J, v(0.0, -52.0, 0.0), v(0.0, -18.0, 0.0), 7.0);
        pen.cylinder(Of::I, v(0.0, -18.0, 0.0), v(0.0, 18.0, 0.0), 17.0);
        pen.cylinder(Of::J, v(0.0, 18.0, 0.0), v(0.0, 48.0, 0.0), 7.0);
        pen.axis(v(0.0, -66.0, 0.0), v(0.0, 72.0, 0.0));
        pen.dot(O);
        pen.turn(v(0.0, 40.0, 0.0), Y, 17.0 * Z, [-20.0, 130.0]);
        pen.way(v(0.0, -10.0, 34.0), v(0.0, 34.0, 34.0));
        pen.word("s", v(0.0, 0.0, 34.0), [-44.0, -8.0], "displacement");
        pen.word("s", v(0.0, 40.0, -22.0), [2.0, 10.0], "angle");
    }),
    ("Prismatic", "point, axis", |pen| {
        pen.block(Of::I, v(0.0, 0.0, -8.0), v(8.0, 58.0, 8.0));
        pen.block(Of::J, v(0.0, 0.0, 4.0), v(18.0, 20.0, 12.0));
        pen.axis(v(0.0, -68.0, 0.0), v(0.0, 72.0, 0.0));
        pen.dot(O);
        pen.way(v(0.0, -14.0, 30.0), v(0.0, 32.0, 30.0));
        pen.word("s", v(0.0, 0.0, 30.0), [-44.0, -8.0], "displacement");
    }),
    ("Fixed", "point", |pen| {
        pen.block(Of::I, v(0.0, -22.0, 0.0), v(16.0, 22.0, 16.0));
        pen.block(Of::J, v(0.0, 22.0, 0.0), v(16.0, 22.0, 16.0));
        pen.dot(v(16.0, 0.0, 16.0));
    }),
    ("Planar", "point, normal", |pen| {
        pen.block(Of::I, v(0.0, 0.0, -20.0), v(44.0, 48.0, 4.0));
        pen.block(Of::J, v(0.0, 0.0, -6.0), v(16.0, 20.0, 10.0));
        pen.axis(v(0.0, 0.0, -16.0), v(0.0, 0.0, 50.0));
        pen.dot(v(0.0, 0.0, -16.0));
        pen.word("o", v(0.0, 0.0, 50.0), [6.0, 4.0], "normal");
    }),
    ("ConstantVelocity", "point, axis_i, axis_j", |pen| {
        pen.cylinder(Of::I, v(0.0, -58.0, 0.0), v(0.0, -10.0, 0.0), 8.0);
        pen.ball(Of::I, O, 17.0);
        pen.cylinder(Of::J, v(0.0, 9.0, 6.0), v(0.0, 50.0, 33.0), 8.0);
        pen.axis(v(0.0, -70.0, 0.0), v(0.0, 46.0, 0.0));
        pen.axis(v(0.0, -30.0, -20.0), v(0.0, 64.0, 42.0));
        pen.dot(O);
        pen.word("o", v(0.0, 46.0, 0.0), [-26.0, 14.0], "axis_i");
        pen.word("o", v(0.0, 64.0, 42.0), [-26.0, -6.0], "axis_j");
    }),
    ("Screw", "point, axis, pitch", |pen| {
        pen.cylinder(Of::J, v(0.0, -54.0, 0.0), v(0.0, -12.0, 0.0), 8.0);
        pen.thread(v(0.0, -54.0, 0.0), v(0.0, -12.0, 0.0), 8.0, 8);
        pen.cylinder(Of::I, v(0.0, -12.0, 0.0), v(0.0, 12.0, 0.0), 18.0);
        pen.cylinder(Of::J, v(0.0, 12.0, 0.0), v(0.0, 50.0, 0.0), 8.0);
        pen.thread(v(0.0, 12.0, 0.0), v(0.0, 50.0, 0.0), 8.0, 8);
        pen.axis(v(0.0, -68.0, 0.0), v(0.0, 74.0, 0.0));
        pen.dot(O);
        pen.turn(v(0.0, 40.0, 0.0), Y, 19.0 * Z, [-20.0, 130.0]);
        pen.way(v(0.0, -10.0, 34.0), v(0.0, 34.0, 34.0));
        pen.word("s", v(0.0, 0.0, 34.0), [-44.0, -8.0], "displacement");
        pen.word("s", v(0.0, 40.0, -22.0), [2.0, 12.0], "angle");
    }),
    ("Gear", "axis_i, axis_j, ratio", |pen| {
        pen.block(Of::K, v(0.0, 8.0, -32.0), v(10.0, 54.0, 4.0));
        pen.cylinder(Of::K, v(0.0, -29.0, -28.0), v(0.0, -29.0, 0.0), 4.0);
        pen.cylinder(Of::K, v(0.0, 22.0, -28.0), v(0.0, 22.0, 0.0), 4.0);
        pen.wheel(Of::I, v(0.0, -29.0, 0.0), Z, 17.0, 10, 0.0);
        pen.wheel(Of::J, v(0.0, 22.0, 0.0), Z, 34.0, 20, 0.5);
        pen.axis(v(0.0, -29.0, -44.0), v(0.0, -29.0, 44.0));
        pen.axis(v(0.0, 22.0, -44.0), v(0.0, 22.0, 44.0));
        pen.turn(v(0.0, -29.0, 14.0), Z, 16.0 * Y, [-60.0, 70.0]);
        pen.turn(v(0.0, 22.0, 14.0), Z, 30.0 * Y, [70.0, -50.0]);
        pen.word("o", v(0.0, -29.0, 44.0), [-34.0, -2.0], "axis_i");
        pen.word("o", v(0.0, 22.0, 44.0), [5.0, -2.0], "axis_j");
        pen.word("s", v(0.0, 8.0, -50.0), [-28.0, 0.0], "ratio = -1/2");
    }),
    ("RackAndPinion", "axis, hub, point, slide, radius", |pen| {
        pen.block(Of::K, v(-4.0, 0.0, -33.0), v(14.0, 56.0, 3.0));
        pen.block(Of::J, v(0.0, 0.0, -24.0), v(6.0, 48.0, 6.0));
        for tooth in -6..=6 {
            pen.block(
                Of::J,
                v(0.0, 7.3 * f64::from(tooth), -15.5),
                v(6.0, 1.8, 2.5),
            );
        }
        pen.wheel(Of::I, v(0.0, 0.0, 9.0), X, 23.0, 20, 0.0);
        pen.axis(v(-30.0, 0.0, 9.0), v(46.0, 0.0, 9.0));
        pen.axis(v(6.0, -62.0, -20.0), v(6.0, 72.0, -20.0));
        pen.dot(v(6.0, 0.0, -20.0));
        pen.dot(v(12.0, 0.0, 9.0));
        pen.turn(v(8.0, 0.0, 9.0), X, 31.0 * Z, [-50.0, 50.0]);
        pen.way(v(12.0, -24.0, -44.0), v(12.0, 24.0, -44.0));
        pen.word("o", v(46.0, 0.0, 9.0), [-30.0, -4.0], "axis");
        pen.word("o", v(6.0, 72.0, -20.0), [-14.0, -8.0], "slide");
    }),
    ("RollingWheel", "center, axle, normal, radius", |pen| {
        pen.block(Of::I, v(0.0, 0.0, -24.0), v(34.0, 50.0, 3.0));
        pen.cylinder(Of::J, v(-4.0, 0.0, 11.0), v(4.0, 0.0, 11.0), 32.0);
        pen.axis(v(-30.0, 0.0, 11.0), v(46.0, 0.0, 11.0));
        pen.axis(v(-20.0, -38.0, -21.0), v(-20.0, -38.0, 28.0));
        pen.dot(v(4.0, 0.0, 11.0));
        pen.dot(v(-20.0, -38.0, -21.0));
        pen.way(v(30.0, -16.0, -20.0), v(30.0, 34.0, -20.0));
        pen.word("o", v(46.0, 0.0, 11.0), [-34.0, -2.0], "axle");
        pen.word("o", v(-20.0, -38.0, 28.0), [-20.0, -6.0], "normal");
    }),
    ("RollingBall", "center, normal, radius", |pen| {
        pen.block(Of::I, v(0.0, 0.0, -24.0), v(34.0, 50.0, 3.0));
        pen.ball(Of::J, v(0.0, 0.0, 5.0), 26.0);
        pen.axis(v(-20.0, -38.0, -21.0), v(-20.0, -38.0, 28.0));
        pen.dot(v(-20.0, -38.0, -21.0));
        pen.way(v(30.0, -16.0, -20.0), v(30.0, 34.0, -20.0));
        pen.way(v(34.0, 4.0, -20.0), v(-30.0, 4.0, -20.0));
        pen.word("o", v(-20.0, -38.0, 28.0), [-20.0, -6.0], "normal");
    }),
    ("RollingBallInBowl", "center, bowl, axis, radius", |pen| {
        pen.ball(Of::I, v(0.0, 0.0, 6.0), 46.0);
        pen.ball(Of::J, v(0.0, 20.0, -17.0), 15.5);
        pen.axis(v(0.0, 0.0, -46.0), v(0.0, 0.0, 66.0));
        pen.dot(v(0.0, 0.0, 6.0));
        pen.dot(v(0.0, 20.0, -17.0));
        pen.way(v(0.0, -24.0, -18.0), v(0.0, 2.0, -28.0));
        pen.word("o", v(0.0, 0.0, 6.0), [-30.0, -2.0], "bowl");
        pen.word("o", v(0.0, 0.0, 66.0), [4.0, 6.0], "axis");
    }),
    ("WheelPair", "center_j, center_k, axle, normal", |pen| {
        pen.block(Of::I, v(0.0, 0.0, -24.0), v(44.0, 46.0, 3.0));
        pen.cylinder(Of::K, v(-34.0, 0.0, 3.0), v(-26.0, 0.0, 3.0), 24.0);
        pen.axis(v(-52.0, 0.0, 3.0), v(60.0, 0.0, 3.0));
        pen.cylinder(Of::J, v(22.0, 0.0, 3.0), v(30.0, 0.0, 3.0), 24.0);
        pen.axis(v(-10.0, -40.0, -21.0), v(-10.0, -40.0, 28.0));
        pen.dot(v(-10.0, -40.0, -21.0));
        pen.dot(v(30.0, 0.0, 3.0));
        pen.dot(v(-26.0, 0.0, 3.0));
        pen.way(v(44.0, -16.0, -20.0), v(44.0, 34.0, -20.0));
        pen.word("o", v(60.0, 0.0, 3.0), [-34.0, -2.0], "axle");
        pen.word("o", v(-10.0, -40.0, 28.0), [-20.0, -6.0], "normal");
    }),
    ("RollingPair", "point, tangent", |pen| {
        pen.block(Of::K, v(0.0, 4.0, -32.0), v(10.0, 54.0, 4.0));
        pen.cylinder(Of::K, v(0.0, -32.0, -28.0), v(0.0, -32.0, 0.0), 4.0);
        pen.cylinder(Of::K, v(0.0, 24.0, -28.0), v(0.0, 24.0, 0.0), 4.0);
        pen.cylinder(Of::I, v(0.0, -32.0, -6.0), v(0.0, -32.0, 6.0), 20.0);
        pen.cylinder(Of::J, v(0.0, 24.0, -6.0), v(0.0, 24.0, 6.0), 36.0);
        pen.axis(v(-40.0, -12.0, 6.0), v(48.0, -12.0, 6.0));
        pen.dot(v(0.0, -12.0, 6.0));
        pen.turn(v(0.0, -32.0, 14.0), Z, 16.0 * Y, [-60.0, 70.0]);
        pen.turn(v(0.0, 24.0, 14.0), Z, 30.0 * Y, [70.0, -50.0]);
        pen.word("o", v(48.0, -12.0, 6.0), [-44.0, 8.0], "tangent");
    }),
    ("KnifeEdge", "point, side", |pen| {
        pen.block(Of::I, v(0.0, 0.0, -24.0), v(34.0, 50.0, 3.0));
        pen.block(Of::J, v(0.0, 0.0, 20.0), v(16.0, 40.0, 6.0));
        pen.block(Of::J, v(0.0, 10.0, -3.0), v(1.5, 14.0, 18.0));
        pen.axis(v(-30.0, 10.0, -18.0), v(46.0, 10.0, -18.0));
        pen.dot(v(1.5, 10.0, -18.0));
        pen.way(v(0.0, 30.0, -20.0), v(0.0, 66.0, -20.0));
        pen.word("o", v(46.0, 10.0, -18.0), [-26.0, 2.0], "side");
    }),
    ("PointOnLine", "point, axis", |pen| {
        pen.block(Of::I, v(0.0, -52.0, -16.0), v(5.0, 5.0, 22.0));
        pen.block(Of::I, v(0.0, 52.0, -16.0), v(5.0, 5.0, 22.0));
        pen.cylinder(Of::I, v(0.0, -50.0, 0.0), v(0.0, 50.0, 0.0), 3.0);
        pen.cylinder(Of::J, v(0.0, 0.0, -6.0), v(14.0, 0.0, -44.0), 5.0);
        pen.ball(Of::J, O, 11.0);
        pen.axis(v(0.0, -68.0, 0.0), v(0.0, 72.0, 0.0));
        pen.dot(O);
        pen.way(v(0.0, -14.0, 26.0), v(0.0, 32.0, 26.0));
        pen.word("s", v(0.0, 0.0, 26.0), [-44.0, -8.0], "displacement");
    }),
    ("PointOnPlane", "point, normal", |pen| {
        pen.block(Of::I, v(0.0, 0.0, -22.0), v(44.0, 48.0, 4.0));
        pen.cylinder(Of::J, v(0.0, 6.0, -12.0), v(0.0, 42.0, 34.0), 5.0);
        pen.ball(Of::J, v(0.0, 0.0, -14.0), 9.0);
        pen.axis(v(0.0, 0.0, -18.0), v(0.0, 0.0, 48.0));
        pen.dot(v(0.0, 0.0, -18.0));
        pen.word("o", v(0.0, 0.0, 48.0), [-42.0, 4.0], "normal");
    }),
    ("Distance", "head, tail, length", |pen| {
        apart(pen);
        pen.line(HEAD, TAIL);
        pen.dot(HEAD);
        pen.dot(TAIL);
        pen.word("o", HEAD, [-14.0, -9.0], "head");
        pen.word("o", TAIL, [-4.0, -9.0], "tail");
    }),
    ("RevoluteSpherical", "hinge, axis, ball", |pen| {
        apart(pen);
        pen.line(HEAD, TAIL);
        pen.axis(v(-38.0, -34.0, 8.0), v(44.0, -34.0, 8.0));
        pen.ball(Of::J, TAIL, 7.0);
        pen.dot(HEAD);
        pen.dot(TAIL);
        pen.word("o", HEAD, [-4.0, -9.0], "hinge");
        pen.word("o", TAIL, [-8.0, -11.0], "ball");
    }),
    ("RevoluteRevolute", "first, second, axis", |pen| {
        apart(pen);
        pen.line(HEAD, TAIL);
        pen.axis(v(-38.0, -34.0, 8.0), v(44.0, -34.0, 8.0));
        pen.axis(v(-38.0, 34.0, 8.0), v(44.0, 34.0, 8.0));
        pen.dot(HEAD);
        pen.dot(TAIL);
        pen.word("o", HEAD, [-4.0, -9.0], "first");
        pen.word("o", TAIL, [4.0, -9.0], "second");
    }),
    ("Perpendicular1", "axis_i, axis_j", |pen| {
        apart(pen);
        pen.axis(v(0.0, -34.0, -8.0), v(0.0, -34.0, 50.0));
        pen.axis(v(0.0, 20.0, -8.0), v(0.0, 76.0, -8.0));
        pen.word("o", v(0.0, -34.0, 50.0), [5.0, 4.0], "axis_i");
        pen.word("o", v(0.0, 76.0, -8.0), [-18.0, 14.0], "axis_j");
    }),
    ("Perpendicular2", "axis, head, tail", |pen| {
        apart(pen);
        pen.line(HEAD, TAIL);
        pen.axis(HEAD, v(0.0, -34.0, 56.0));
        pen.dot(HEAD);
        pen.dot(TAIL);
        pen.word("o", v(0.0, -34.0, 56.0), [5.0, 4.0], "axis");
        pen.word("o", HEAD, [-30.0, -7.0], "head");
        pen.word("o", TAIL, [-4.0, -9.0], "tail");
    }),
    ("Parallel1", "axis_i, axis_j", |pen| {
        apart(pen);
        pen.axis(v(0.0, -34.0, -8.0), v(0.0, -34.0, 50.0));
        pen.axis(v(0.0, 34.0, -8.0), v(0.0, 34.0, 50.0));
        pen.word("o", v(0.0, -34.0, 50.0), [5.0, 4.0], "axis_i");
        pen.word("o", v(0.0, 34.0, 50.0), [5.0, 4.0], "axis_j");
    }),
    ("Parallel2", "axis, head, tail", |pen| {
        apart(pen);
        pen.line(HEAD, TAIL);
        pen.axis(HEAD, v(0.0, 10.0, 8.0));
        pen.dot(HEAD);
        pen.dot(TAIL);
        pen.word("o", v(0.0, 0.0, 8.0), [-8.0, -9.0], "axis");
        pen.word("o", HEAD, [-24.0, -9.0], "head");
        pen.word("o", TAIL, [-4.0, -9.0], "tail");
    }),
    ("AngleDriver", "axis, motion", |pen| {
        base(pen);
        pen.cylinder(Of::I, v(0.0, 0.0, -26.0), v(0.0, 0.0, -4.0), 16.0);
        pen.block(Of::J, v(0.0, 26.0, 5.0), v(11.0, 38.0, 5.0));
        pen.axis(v(0.0, 0.0, -52.0), v(0.0, 0.0, 56.0));
        pen.turn(v(0.0, 0.0, 22.0), Z, 30.0 * Y, [-55.0, 65.0]);
        pen.word("s", v(0.0, 0.0, 36.0), [26.0, 0.0], "motion");
    }),
    ("DistanceDriver", "head, tail, motion", |pen| {
        pen.block(Of::I, v(0.0, -56.0, 0.0), v(14.0, 8.0, 14.0));
        pen.cylinder(Of::J, v(0.0, -2.0, 0.0), v(0.0, 42.0, 0.0), 4.0);
        pen.block(Of::J, v(0.0, 50.0, 0.0), v(14.0, 8.0, 14.0));
        pen.cylinder(Of::I, v(0.0, -48.0, 0.0), v(0.0, -2.0, 0.0), 9.0);
        pen.dot(v(0.0, -48.0, 0.0));
        pen.dot(v(0.0, 42.0, 0.0));
        pen.way(v(0.0, -20.0, 26.0), v(0.0, 30.0, 26.0));
        pen.word("s", v(0.0, 0.0, 26.0), [-30.0, -8.0], "motion");
        pen.word("o", v(0.0, -48.0, 0.0), [-4.0, 26.0], "head");
        pen.word("o", v(0.0, 42.0, 0.0), [-24.0, 25.0], "tail");
    }),
    ("DisplacementDriver", "point, axis, motion", |pen| {
        pen.block(Of::I, v(0.0, 0.0, -8.0), v(8.0, 58.0, 8.0));
        pen.block(Of::I, v(0.0, -52.0, 6.0), v(12.0, 8.0, 12.0));
        pen.cylinder(Of::J, v(0.0, -44.0, 8.0), v(0.0, -18.0, 8.0), 4.0);
        pen.block(Of::J, v(0.0, 0.0, 4.0), v(18.0, 20.0, 12.0));
        pen.axis(v(0.0, -68.0, 0.0), v(0.0, 72.0, 0.0));
        pen.dot(O);
        pen.way(v(0.0, -14.0, 30.0), v(0.0, 32.0, 30.0));
        pen.word("s", v(0.0, 0.0, 30.0), [-30.0, -8.0], "motion");
    }),
    ("OrientationDriver", "axis, motion", |pen| {
        pen.block(Of::I, v(0.0, -44.0, -8.0), v(12.0, 12.0, 12.0));
        pen.block(Of::J, v(0.0, 26.0, -8.0), v(14.0, 24.0, 7.0));
        pen.axis(v(0.0, 24.0, -36.0), v(0.0, 24.0, 52.0));
        pen.turn(v(0.0, 24.0, 16.0), Z, 26.0 * Y, [-55.0, 65.0]);
        pen.word("s", v(0.0, 24.0, 30.0), [20.0, -6.0], "motion");
    }),
];
