//! The assembler judged by automatic differentiation, by closed forms and by its own other forms.

mod catalogue;
mod couplings;
mod forces;
mod formulations;
mod kernels;
mod library;
mod motion;
mod solvers;

use nalgebra::Vector3;

use crate::assembler::Assembler;
use crate::bodies::{Body, GROUND, Orientation};
use crate::formulation::Evaluator;
use crate::joints::Joint;

/// Both readings of Euler parameters.
const ORIENTATIONS: [Orientation; 2] = [Orientation::Raw, Orientation::Normalised];

/// Every joint between every sort of body, nothing along an axis.
fn everything() -> Assembler {
    let mut scene = Assembler::new([0.3, -0.7, -9.81]);
    let first = scene.add_body(
        Body::rigid(2.0, [0.3, 0.4, 0.5], [0.1, 0.4, -0.2])
            .with_euler([0.5, 0.5, -0.5, 0.5])
            .with_velocity([0.1, 0.2, 0.3], [1.0, -2.0, 0.5]),
    );
    let second = scene.add_body(
        Body::rigid(0.7, [0.02, 0.05, 0.04], [0.6, 0.9, 0.3]).with_euler([0.1, 0.7, 0.5, 0.5]),
    );
    let bead = scene.add_body(Body::particle(0.4, [1.2, 0.3, 0.1]));
    scene.add_revolute([GROUND, first], [0.2, 0.1, 0.3], [1.0, 2.0, -0.5]);
    scene.add_spherical([first, second], [0.4, 0.6, 0.1]);
    scene.add_revolute([second, first], [0.3, 0.5, 0.2], [-0.2, 0.4, 1.0]);
    scene.add_spherical([bead, GROUND], [1.2, 0.3, 0.1]);
    let points = [Vector3::new(0.1, 0.2, 0.3), Vector3::zeros()];
    scene.add_joint(Joint::distance_at([second, bead], points, 0.8));
    scene.add_joint(Joint::distance_at(
        [GROUND, second],
        [points[0], points[0]],
        0.8,
    ));
    for between in [[first, second], [second, GROUND], [bead, first]] {
        scene.add_joint(Joint::perpendicular_at(
            between,
            [Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.1, -2.0, 0.4)],
        ));
    }
    scene
}

/// Classical Runge-Kutta from the time zero with a fixed step (s).
fn integrate(evaluator: &mut Evaluator, x: &mut [f64], step: f64, steps: u16) {
    let n = x.len();
    let (mut k, mut stage, mut sum) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    for number in 0..steps {
        let time = step * f64::from(number);
        sum.copy_from_slice(x);
        for (s, weight) in [(0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)] {
            for i in 0..n {
                stage[i] = x[i] + s * step * k[i];
            }
            evaluator
                .rates(time + s * step, &stage, &mut k)
                .expect("solvable");
            for i in 0..n {
                sum[i] += weight * step / 6.0 * k[i];
            }
        }
        x.copy_from_slice(&sum);
    }
}
