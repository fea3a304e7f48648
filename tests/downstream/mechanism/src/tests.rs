//! The mechanisms of this crate, against formulas written by hand.

use std::vec::Vec;

use downstream_joints::differences::{assert_derivatives, assert_near, constraints, disturbed};
use mech::nalgebra::Vector3;
use mech::prelude::*;

use super::{Crane, HALF, Linkage, sway};

#[test]
fn phi_is_what_the_formulas_say() {
    type M = Linkage;
    let mechanism = M::default();
    let state = disturbed(&mechanism);
    let (left, right, load) = (M::HANDLES.left, M::HANDLES.right, M::HANDLES.load);
    let fixed = |x: f64, y: f64, z: f64| Vector3::new(x, y, z);
    let on_left = |y: f64| M::point(&state, left, fixed(0.0, y - 0.5, 0.0));
    let on_right = |y: f64| M::point(&state, right, fixed(0.0, y - 0.5, 0.0));
    let [l, r, middle] = [left, right, load].map(|body| M::pose(&state, body).position);
    let along_x = |body| M::point(&state, body, Vector3::x()) - M::pose(&state, body).position;
    // The normals of the x axis on the ground: e_2 x e_1, and e_1 x that.
    let normals = [-Vector3::z(), Vector3::y()];
    let mut phi: Vec<f64> = Vec::new();
    phi.extend((on_left(0.0) - fixed(-HALF, 0.0, 0.0)).iter());
    phi.extend(normals.map(|normal| normal.dot(&along_x(left))));
    phi.extend(normals.map(|normal| normal.dot(&along_x(right))));
    phi.extend(normals.map(|normal| normal.dot(&(on_right(0.0) - fixed(HALF, 0.0, 0.0)))));
    phi.extend((middle - (l + r) / 2.0).iter());
    phi.push((on_right(1.0) - on_left(1.0)).norm_squared() - 1.0);
    phi.push((on_right(0.4) - on_left(0.2)).norm_squared() - 1.0);
    phi.push((r.norm_squared() - 0.49) / 2.0);
    phi.extend((on_right(0.0) - fixed(HALF, 0.0, 0.0)).iter());
    let centre_on_left = M::point(&state, left, fixed(HALF, 0.0, 0.0));
    let centre_on_right = M::point(&state, right, fixed(-HALF, 0.0, 0.0));
    let seat = M::point(&state, left, fixed(0.0, 0.1, 0.0)) - l;
    phi.extend((centre_on_right - centre_on_left - seat).iter());
    let found = constraints(&mechanism, &state);
    assert_eq!(found.len(), phi.len());
    for (row, (found, expected)) in found.iter().zip(phi).enumerate() {
        assert_near("Phi", [row, 0], *found, expected);
    }
}

#[test]
fn kernels_are_the_derivatives_of_phi() {
    let linkage = Linkage::default();
    assert_derivatives(&linkage, &disturbed(&linkage));
    let crane = Crane::default();
    assert_derivatives(&crane, &disturbed(&crane));
}

#[test]
fn joints_of_one_name_keep_apart() {
    let kinds: Vec<&str> = Linkage::REPORT
        .joints
        .iter()
        .map(|joint| joint.kind)
        .collect();
    let expected = [
        "Revolute",
        "Revolute",
        "Midpoint",
        "Rod",
        "Rod",
        "OnSphere",
        "Spherical",
        "Spherical",
    ];
    assert_eq!(kinds, expected);
    let rows: Vec<usize> = Linkage::REPORT
        .joints
        .iter()
        .map(|joint| joint.rows)
        .collect();
    assert_eq!(rows, [5, 4, 3, 1, 1, 1, 3, 3]);
}

#[test]
fn a_field_that_is_configured_out_leaves_no_trace() {
    assert_eq!(Linkage::REPORT.bodies.len(), 3);
}

#[test]
fn a_mechanism_in_a_function_moves() {
    // Hanging at rest at the angle a from the vertical: g sin(a) along the tangent, whose x component is -cos(a) of it.
    let sine: f64 = 0.1;
    let expected = -10.0 * sine * (1.0 - sine * sine).sqrt();
    assert_near("u'", [0, 0], sway().unwrap(), expected);
}
