//! The kernels once more, as functions of a state that return what they compute: for tests, not for speed.

use nalgebra::{DMatrix, DVector, Vector3};

use crate::assembler::{Assembler, JointId, Wrench};
use crate::bodies::{BodyId, Frame};
use crate::rows::Jacobian;

impl Assembler {
    /// The kinematics of all bodies at the state `x = (q, u)`, the ground first.
    #[must_use]
    pub fn kinematics(&self, x: &[f64]) -> Vec<Frame> {
        let mut frames = self.frames();
        self.update(x, &mut frames);
        frames
    }

    /// A vector of one number per equation.
    fn rows(&self, x: &[f64], kernel: impl Fn(&Self, &[Frame], &mut [f64])) -> DVector<f64> {
        let mut out = DVector::zeros(self.equations());
        kernel(self, &self.kinematics(x), out.as_mut_slice());
        out
    }

    /// `Phi` at the state `x = (q, u)`.
    #[must_use]
    pub fn constraints(&self, x: &[f64]) -> DVector<f64> {
        self.rows(x, Self::write_constraints)
    }

    /// `Phi' = D u` at the state `x = (q, u)`.
    #[must_use]
    pub fn constraint_rates(&self, x: &[f64]) -> DVector<f64> {
        self.rows(x, Self::write_constraint_rates)
    }

    /// `gamma` at the state `x = (q, u)`.
    #[must_use]
    pub fn gamma(&self, x: &[f64]) -> DVector<f64> {
        self.rows(x, Self::write_gamma)
    }

    /// `D` at the state `x = (q, u)`: equations by velocities, with respect to `v` in global and `w` in body axes.
    #[must_use]
    pub fn jacobian(&self, x: &[f64]) -> DMatrix<f64> {
        let mut out = DMatrix::zeros(self.equations(), self.velocities());
        self.write_jacobian(&self.kinematics(x), &mut Jacobian(&mut out));
        out
    }

    /// `g` at the state `x = (q, u)`: weight (N, global axes), gyroscopic moment (N m, body axes).
    #[must_use]
    pub fn forces(&self, x: &[f64]) -> DVector<f64> {
        let mut out = DVector::zeros(self.velocities());
        self.write_forces(&self.kinematics(x), out.as_mut_slice());
        out
    }

    /// The rates of the coordinates at the state `x = (q, u)`.
    #[must_use]
    pub fn coordinate_rates(&self, x: &[f64]) -> DVector<f64> {
        let mut out = DVector::zeros(self.coordinates());
        self.write_coordinate_rates(x, out.as_mut_slice());
        out
    }

    /// Kinetic energy (J), `1/2 u^T M u`.
    #[must_use]
    pub fn kinetic_energy(&self, x: &[f64]) -> f64 {
        let u = &x[self.coordinates()..];
        let mass = self.mass();
        0.5 * mass.iter().zip(u).map(|(m, u)| m * u * u).sum::<f64>()
    }

    /// Potential energy of gravity (J), `-m g . r` summed: zero where all centres of mass are at the global origin.
    #[must_use]
    pub fn potential_energy(&self, x: &[f64]) -> f64 {
        self.bodies()
            .filter(|(body, ..)| body.kind.coordinates() > 0)
            .map(|(body, q, _)| {
                -body.mass
                    * self
                        .gravity()
                        .dot(&Vector3::from_column_slice(&x[q..q + 3]))
            })
            .sum()
    }

    /// Reactions of all joints as generalised forces `-D^T lambda` (N, global axes; N m, body axes, about the centre
    /// of mass).
    #[must_use]
    pub fn generalised_reactions(&self, x: &[f64], lambda: &DVector<f64>) -> DVector<f64> {
        -self.jacobian(x).tr_mul(lambda)
    }

    /// What a joint exerts on its body `i` and on its body `j`, each reduced to the point of the joint on that body.
    ///
    /// What acts on the ground is found like the rest, from the rows that the ground would have if it could move. For
    /// `p` of unit length; with [`Orientation::Raw`](crate::bodies::Orientation::Raw) the moment is otherwise scaled like
    /// `A(p)`.
    #[must_use]
    pub fn reactions(&self, joint: JointId, x: &[f64], lambda: &DVector<f64>) -> [Wrench; 2] {
        let (joint, row) = self.joint(joint);
        let mut frames = joint.between().map(|BodyId(body)| self.kinematics(x)[body]);
        for (frame, column) in frames.iter_mut().zip([0, 6]) {
            frame.translation_column = Some(column);
            frame.rotation_column = Some(column + 3);
        }
        let [i, j] = &frames;
        let mut rows = DMatrix::zeros(joint.equations(), 12);
        joint.jacobian(i, j, 0, &mut Jacobian(&mut rows));
        let forces = -rows.tr_mul(&lambda.rows(row, joint.equations()));
        let points = joint.points();
        [0, 1].map(|end| {
            let force: Vector3<f64> = forces.fixed_rows::<3>(6 * end).into();
            let moment: Vector3<f64> = forces.fixed_rows::<3>(6 * end + 3).into();
            let arm = frames[end].rotation * points[end];
            Wrench {
                force,
                moment: frames[end].rotation * moment - arm.cross(&force),
            }
        })
    }
}
