//! The joints of this crate in a mechanism, against their formulas written by hand.

use kinematics::nalgebra::Vector3;
use kinematics::prelude::*;

use super::averaging::{Coplanar, Midpoint};
use super::differences::{assert_derivatives, assert_near, constraints, disturbed};
use super::{OnSphere, Revolute, Rod, Slider, Spherical};

/// Every joint of this crate once.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Everything {
    #[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [0.0, 1.0, 0.0])]
    crank: Body,
    #[body(
        mass = 2.0,
        inertia = [0.2, 0.2, 0.3],
        position = [1.0, 0.0, 0.5],
        orientation = rotation([0.0, 0.0, 1.0], deg(90.0))
    )]
    rocker: Body,
    #[body(mass = 0.5, position = [0.5, 0.5, 0.25])]
    bead: Particle,
    #[joint(between = [crank, rocker], head = [0.0, 1.5, 0.0], tail = [1.0, 0.0, 0.0], length = 2.0)]
    rod: Rod,
    #[joint(between = [ground, crank], pin = [0.0, 0.5, 0.0], axis = [0.0, 0.0, 2.0])]
    shaft: Revolute,
    #[joint(between = [ground, rocker], point = [1.0, 0.2, 0.5], seat = [0.0, 0.0, 1.0], play = 0.25)]
    ball: Spherical,
    #[joint(between = [rocker], radius = 1.0)]
    sphere: OnSphere,
    #[joint(
        between = [crank, rocker, bead],
        left = [0.0, 1.0, 0.0],
        right = [1.0, 0.0, 0.5],
        middle = [0.5, 0.5, 0.25]
    )]
    middle: Midpoint,
    // Not as described: all three are perpendicular there.
    #[joint(
        between = [ground, crank, rocker],
        first = [1.0, 0.0, 0.0],
        second = [0.0, 0.0, 1.0],
        third = local([0.0, 3.0, 0.0], [0.0, 3.0, 0.0], [3.0, 0.0, 0.0])
    )]
    plane: Coplanar,
}

#[test]
fn phi_is_what_the_formulas_say() {
    type M = Everything;
    let mechanism = Everything::default();
    let state = disturbed(&mechanism);
    let vector = |[x, y, z]: [f64; 3]| Vector3::new(x, y, z);
    let (crank, rocker, bead) = (M::HANDLES.crank, M::HANDLES.rocker, M::HANDLES.bead);
    // Points and directions in body axes, by hand: the crank's axes are global at the start, those
    // of the rocker turned by a right angle, so that a global (x, y, z) is (y, -x, z) along them.
    let on_crank = |p| M::point(&state, crank, vector(p));
    let on_rocker = |p| M::point(&state, rocker, vector(p));
    let centres = [crank, rocker, bead].map(|body| M::pose(&state, body).position);
    let mut phi = std::vec::Vec::new();
    phi.push((on_rocker([0.0, 0.0, -0.5]) - on_crank([0.0, 0.5, 0.0])).norm_squared() - 4.0);
    let axis = on_crank([0.0, 0.0, 1.0]) - centres[0];
    let pin = on_crank([0.0, -0.5, 0.0]) - vector([0.0, 0.5, 0.0]);
    // The normals of the z axis on the ground: e_1 x e_3, and e_3 x that.
    let normals = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0]].map(vector);
    phi.extend(normals.map(|normal| normal.dot(&axis)));
    phi.extend(normals.map(|normal| normal.dot(&pin)));
    let ball = on_rocker([0.2, 0.0, 0.0]) - vector([1.0, 0.2, 0.5]) - vector([0.0, 0.0, 0.25]);
    phi.extend(ball.iter());
    phi.push(0.5 * (centres[1].norm_squared() - 1.0));
    let middle = centres[2] - 0.5 * (centres[0] + centres[1]);
    phi.extend(middle.iter());
    let third = on_rocker([3.0, 0.0, 0.0]) - centres[1];
    phi.push(-vector([1.0, 0.0, 0.0]).cross(&axis).dot(&third));
    let found = constraints(&mechanism, &state);
    assert_eq!(found.len(), phi.len());
    for (row, (found, expected)) in found.iter().zip(phi).enumerate() {
        assert_near("Phi", [row, 0], *found, expected);
    }
}

#[test]
fn kernels_are_the_derivatives_of_phi() {
    let mechanism = Everything::default();
    assert_derivatives(&mechanism, &disturbed(&mechanism));
    let slider = Slider::default();
    assert_derivatives(&slider, &disturbed(&slider));
}

#[test]
fn a_private_joint_serves_the_mechanism_beside_it() {
    assert_eq!(Slider::REPORT.degrees_of_freedom, 1);
    assert_eq!(Slider::REPORT.joints[0].kind, "Prismatic");
    let phi = constraints(
        &Slider::default(),
        &Slider::default().described_state().unwrap(),
    );
    assert!(phi.iter().all(|phi| phi.abs() < 1e-15), "{phi:?}");
}
