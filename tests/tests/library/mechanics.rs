//! Forces and momenta of bodies, as screws at the global origin.

use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::{BodyId, Kind};
use holonom_assembler::kinematics::Kinematics;
use nalgebra::{DMatrix, Vector3, Vector6};

use crate::freedom::{Freedom, at_origin, complement};

/// A force (N) and a moment (N m) about the global origin, global axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Screw {
    pub(crate) force: Vector3<f64>,
    pub(crate) moment: Vector3<f64>,
}

impl Screw {
    /// About another point.
    pub(crate) fn about(&self, point: &Vector3<f64>) -> Vector6<f64> {
        let moment = self.moment - point.cross(&self.force);
        let (f, m) = (self.force, moment);
        Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z)
    }
}

/// Of `(force, moment about the centre of mass in body axes)` on a body.
pub(crate) fn screw(at: &Kinematics, body: BodyId, kind: Kind, values: &[f64]) -> Screw {
    let frame = at.frame(body);
    let force = Vector3::from_column_slice(&values[..3]);
    let spin = match kind {
        Kind::Rigid => frame.rotation * Vector3::from_column_slice(&values[3..6]),
        _ => Vector3::zeros(),
    };
    Screw {
        force,
        moment: spin + frame.position.cross(&force),
    }
}

/// The motions that are free at every instant, as velocities at the origin and angular velocities
/// that stand still in space.
pub(crate) fn standing(instants: &[Freedom]) -> Vec<Vector6<f64>> {
    let mut beside = DMatrix::<f64>::zeros(6, 6);
    for freedom in instants {
        let span: Vec<Vector6<f64>> = freedom
            .twists
            .iter()
            .map(|twist| at_origin(twist, &freedom.point))
            .collect();
        beside += complement(&span);
    }
    let eigen = (beside / instants.len() as f64).symmetric_eigen();
    let pairs = eigen
        .eigenvalues
        .iter()
        .zip(eigen.eigenvectors.column_iter());
    let found = pairs
        .filter(|(value, _)| **value < 1e-9)
        .map(|(_, vector)| Vector6::from_iterator(vector.iter().copied()));
    found.collect()
}

/// The momentum of a body and the moment of momentum about the origin.
pub(crate) fn momentum(scene: &Assembler, body: BodyId, x: &[f64]) -> Vector6<f64> {
    let (at, described) = (scene.kinematics(x), scene.body(body));
    let frame = at.frame(body);
    let p = described.mass * frame.velocity;
    let spin = match described.kind {
        Kind::Rigid => frame.rotation * described.inertia.component_mul(&frame.rate),
        _ => Vector3::zeros(),
    };
    let l = spin + frame.position.cross(&p);
    Vector6::new(p.x, p.y, p.z, l.x, l.y, l.z)
}
