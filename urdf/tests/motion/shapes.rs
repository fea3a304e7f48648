//! Visuals of a file, on the bodies of the mechanism in place.

use holonom::View;
use holonom::mechanism::ShapeKind;
use holonom::prelude::*;

holonom::urdf! { struct Arm = "arm.urdf"; }

/// The columns of the rotation by Euler parameters.
fn columns([a, b, c, d]: [f64; 4]) -> [[f64; 3]; 3] {
    let row = |x: f64, y: f64, z: f64| [2.0 * x, 2.0 * y, 2.0 * z];
    let mut columns = [
        row(a * a + b * b, b * c + a * d, b * d - a * c),
        row(b * c - a * d, a * a + c * c, c * d + a * b),
        row(b * d + a * c, c * d - a * b, a * a + d * d),
    ];
    for (k, column) in columns.iter_mut().enumerate() {
        column[k] -= 1.0;
    }
    columns
}

fn near(found: &[f64], wanted: &[f64]) {
    assert_eq!(found.len(), wanted.len());
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found - wanted).abs() < 4e-15, "{found} {wanted}");
    }
}

#[test]
fn visuals_are_shapes_on_their_bodies() {
    let arm = Arm::default();
    let state = arm.described_state::<f64>().expect("it can be");
    let constants = arm.constants::<f64>().expect("they are sound");
    let view = View::<f64, Arm>::new(&constants, 0.0, &state);
    let half = 0.5_f64.sqrt();
    // Bodies, kinds, sizes, and centres from the centres of mass, in axes of the links.
    let wanted = [
        (0, ShapeKind::Block, [0.06, 0.05, 0.4], [0.0, 0.0, 0.0]),
        (0, ShapeKind::Cylinder, [0.12, 0.05, 0.0], [0.0, 0.0, -0.2]),
        (1, ShapeKind::Block, [0.035, 0.035, 0.3], [0.0, 0.0, 0.0]),
        (1, ShapeKind::Cylinder, [0.1, 0.04, 0.0], [0.0, 0.0, -0.15]),
        (1, ShapeKind::Ball, [0.03, 0.0, 0.0], [0.0, 0.0, 0.15]),
    ];
    let shapes = Arm::REPORT.shapes;
    assert_eq!(shapes.len(), wanted.len());
    for (place, (body, kind, sizes, centre)) in wanted.into_iter().enumerate() {
        let shape = &shapes[place];
        assert_eq!((shape.body, shape.kind), (body, kind));
        assert!(!shape.is_hole);
        near(&view.shape(place), &sizes);
        near(&shape.centre, &centre);
    }
    // Cylinders lie along y; the box of the forearm is turned by 45 degrees about z.
    for place in [1, 3] {
        let [[x, y, z], ..] = columns(shapes[place].axes);
        near(&[x, y.abs(), z], &[0.0, 1.0, 0.0]);
    }
    let [x, _, z] = columns(shapes[2].axes);
    near(&x, &[half, half, 0.0]);
    near(&z, &[0.0, 0.0, 1.0]);
}
