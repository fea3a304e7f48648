//! Kernels against automatic differentiation and finite differences.

use nalgebra::{DVector, Vector3};

use super::{ORIENTATIONS, everything};
use crate::accuracy::assert_close;
use crate::dual;
use crate::joints::normals;
use crate::states::{Spread, displace, generator, random_state};

/// Random states with Euler parameters that are not of unit length.
const LOOSE: Spread = Spread {
    position: 0.1,
    angle: 0.1,
    velocity: 1.0,
    rate: 2.0,
    norm: 0.05,
};

#[test]
fn kernels_equal_automatic_derivatives() {
    let mut rng = generator(1);
    for orientation in ORIENTATIONS {
        let scene = everything().with_orientation(orientation);
        for _ in 0..50 {
            let x = random_state(&scene, LOOSE, &mut rng);
            let x = x.as_slice();
            let phi = dual::constraints(&scene, &x[..scene.coordinates()]);
            assert_close("Phi", scene.constraints(x).as_slice(), &phi, 1e-14);
            let d = dual::jacobian(&scene, x);
            assert_close("D", scene.jacobian(x).as_slice(), d.as_slice(), 1e-14);
            let (rate, gamma) = dual::constraint_rates_and_gamma(&scene, x);
            let (our_rate, our_gamma) = (scene.constraint_rates(x), scene.gamma(x));
            assert_close("Phi'", our_rate.as_slice(), rate.as_slice(), 1e-14);
            assert_close("gamma", our_gamma.as_slice(), gamma.as_slice(), 1e-14);
            let du = scene.jacobian(x) * DVector::from_column_slice(&x[scene.coordinates()..]);
            assert_close("D u", our_rate.as_slice(), du.as_slice(), 1e-14);
        }
    }
}

#[test]
fn jacobian_equals_finite_rotations_and_translations() {
    let scene = everything();
    let mut rng = generator(2);
    let x = random_state(&scene, Spread::default(), &mut rng);
    let d = scene.jacobian(x.as_slice());
    for column in 0..scene.velocities() {
        let h = 1e-5;
        let moved = |h: f64| {
            let mut x = x.clone();
            let mut motion = vec![0.0; scene.velocities()];
            motion[column] = h;
            displace(&scene, x.as_mut_slice(), &motion);
            scene.constraints(x.as_slice())
        };
        let slope = (moved(h) - moved(-h)) / (2.0 * h);
        assert_close("D", d.column(column).as_slice(), slope.as_slice(), 1e-9);
    }
}

#[test]
fn joints_hold_where_they_were_placed() {
    let scene = everything();
    let x = scene.initial_state();
    let phi = scene.constraints(x.as_slice());
    // Revolute, spherical, revolute, spherical: 16 rows that were given by points and axes.
    assert_close("Phi", &phi.as_slice()[..16], &[0.0; 16], 1e-15);
}

#[test]
fn normals_complete_a_right_handed_frame() {
    let axes = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.6, 0.64, 0.48]];
    for axis in axes.map(Vector3::from) {
        let [n1, n2] = normals(&axis);
        let triple = [n1.norm(), n2.norm(), n1.cross(&n2).dot(&axis)];
        assert_close("lengths and volume", &triple, &[1.0; 3], 1e-15);
    }
    // Smallest component, the first of equals: e_2 x e_1 = -e_3, then e_1 x -e_3 = e_2.
    let [n1, n2] = normals(&Vector3::x());
    assert_eq!((n1, n2), (-Vector3::z(), Vector3::y()));
}

#[test]
fn gyroscopic_moment_and_gravity() {
    let scene = everything();
    let x = scene.initial_state();
    let g = scene.forces(x.as_slice());
    let w = Vector3::new(1.0, -2.0, 0.5);
    let moment = -w.cross(&Vector3::new(0.3 * w.x, 0.4 * w.y, 0.5 * w.z));
    assert_close("moment", &g.as_slice()[3..6], moment.as_slice(), 1e-15);
    assert_close("weight", &g.as_slice()[12..], &[0.12, -0.28, -3.924], 1e-15);
}
