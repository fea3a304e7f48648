//! The kernels once more, as functions of a state that return what they compute: for tests, not for
//! speed.

use nalgebra::{DMatrix, DVector, Vector3};

use crate::assembler::{Assembler, JointId, Wrench};
use crate::kinematics::Kinematics;
use crate::rows::Jacobian;

impl Assembler {
    /// The kinematics of all bodies at the state `x = (q, u)` and the time zero.
    #[must_use]
    pub fn kinematics(&self, x: &[f64]) -> Kinematics {
        self.kinematics_at(0.0, x)
    }

    /// The kinematics of all bodies at a time (s) and the state `x = (q, u)`.
    #[must_use]
    pub fn kinematics_at(&self, time: f64, x: &[f64]) -> Kinematics {
        let mut at = self.workspace();
        self.update(time, x, &mut at);
        at
    }

    /// A vector of one number per equation.
    fn rows(
        &self,
        time: f64,
        x: &[f64],
        kernel: impl Fn(&Self, &Kinematics, &mut [f64]),
    ) -> DVector<f64> {
        let mut out = DVector::zeros(self.equations());
        kernel(self, &self.kinematics_at(time, x), out.as_mut_slice());
        out
    }

    /// `Phi` at the state `x = (q, u)` and the time zero.
    #[must_use]
    pub fn constraints(&self, x: &[f64]) -> DVector<f64> {
        self.constraints_at(0.0, x)
    }

    /// `Phi` at a time (s) and the state `x = (q, u)`.
    #[must_use]
    pub fn constraints_at(&self, time: f64, x: &[f64]) -> DVector<f64> {
        self.rows(time, x, Self::write_constraints)
    }

    /// `Phi' = D u + Phi_t` at the state `x = (q, u)` and the time zero.
    #[must_use]
    pub fn constraint_rates(&self, x: &[f64]) -> DVector<f64> {
        self.constraint_rates_at(0.0, x)
    }

    /// `Phi' = D u + Phi_t` at a time (s) and the state `x = (q, u)`.
    #[must_use]
    pub fn constraint_rates_at(&self, time: f64, x: &[f64]) -> DVector<f64> {
        self.rows(time, x, Self::write_constraint_rates)
    }

    /// `gamma` at the state `x = (q, u)` and the time zero.
    #[must_use]
    pub fn gamma(&self, x: &[f64]) -> DVector<f64> {
        self.gamma_at(0.0, x)
    }

    /// `gamma` at a time (s) and the state `x = (q, u)`.
    #[must_use]
    pub fn gamma_at(&self, time: f64, x: &[f64]) -> DVector<f64> {
        self.rows(time, x, Self::write_gamma)
    }

    /// `Phi_t` for the order 1 and `Phi_tt` for the order 2 at a time (s); they do not depend on
    /// the state.
    #[must_use]
    pub fn time_derivatives(&self, time: f64, order: usize) -> DVector<f64> {
        let mut out = DVector::zeros(self.equations());
        self.write_time_derivatives(time, order, out.as_mut_slice());
        out
    }

    /// `D` at the state `x = (q, u)`: equations by velocities, with respect to `v` in global and
    /// `w` in body axes. It does not depend on the time.
    #[must_use]
    pub fn jacobian(&self, x: &[f64]) -> DMatrix<f64> {
        let mut out = DMatrix::zeros(self.equations(), self.velocities());
        self.write_jacobian(&self.kinematics(x), &mut Jacobian(&mut out));
        out
    }

    /// `g` at the state `x = (q, u)` and the time zero.
    #[must_use]
    pub fn forces(&self, x: &[f64]) -> DVector<f64> {
        self.forces_at(0.0, x)
    }

    /// `g` at a time (s) and the state `x = (q, u)`: weight, gyroscopic moment and the forces that
    /// were added (N, global axes; N m, body axes).
    #[must_use]
    pub fn forces_at(&self, time: f64, x: &[f64]) -> DVector<f64> {
        let mut out = DVector::zeros(self.velocities());
        self.write_forces(&self.kinematics_at(time, x), out.as_mut_slice());
        out
    }

    /// Power (W) at a time (s) of the forces that have no potential energy: dampers, actuators,
    /// forces at points, moments.
    #[must_use]
    pub fn power_at(&self, time: f64, x: &[f64]) -> f64 {
        let at = self.kinematics_at(time, x);
        self.applied_forces().iter().map(|f| f.power(&at)).sum()
    }

    /// The rates of the coordinates at the state `x = (q, u)`.
    #[must_use]
    pub fn coordinate_rates(&self, x: &[f64]) -> DVector<f64> {
        let mut out = DVector::zeros(self.coordinates());
        self.write_coordinate_rates(&self.kinematics(x), x, out.as_mut_slice());
        out
    }

    /// Kinetic energy (J), `1/2 u^T M u`.
    #[must_use]
    pub fn kinetic_energy(&self, x: &[f64]) -> f64 {
        let u = &x[self.coordinates()..];
        let mass = self.mass();
        0.5 * mass.iter().zip(u).map(|(m, u)| m * u * u).sum::<f64>()
    }

    /// Potential energy (J): of gravity, `-m g . r` summed, zero where all centres of mass are at
    /// the global origin; and of springs, zero where they are free.
    #[must_use]
    pub fn potential_energy(&self, x: &[f64]) -> f64 {
        let at = self.kinematics(x);
        let springs = self.applied_forces().iter();
        let springs: f64 = springs.map(|f| f.potential_energy(&at)).sum();
        let weight: f64 = self
            .bodies()
            .filter(|(body, ..)| body.kind.coordinates() > 0)
            .map(|(body, q, _)| {
                -body.mass
                    * self
                        .gravity()
                        .dot(&Vector3::from_column_slice(&x[q..q + 3]))
            })
            .sum();
        weight + springs
    }

    /// Reactions of all joints as generalised forces `-D^T lambda` (N, global axes; N m, body axes,
    /// about the centre of mass).
    #[must_use]
    pub fn generalised_reactions(&self, x: &[f64], lambda: &DVector<f64>) -> DVector<f64> {
        -self.jacobian(x).tr_mul(lambda)
    }

    /// What a joint exerts on its body `i` and on its body `j`: the first two of
    /// [`Assembler::wrenches`].
    ///
    /// # Panics
    /// If the joint has one body.
    #[must_use]
    pub fn reactions(&self, joint: JointId, x: &[f64], lambda: &DVector<f64>) -> [Wrench; 2] {
        let wrenches = self.wrenches(joint, x, lambda);
        [wrenches[0], wrenches[1]]
    }

    /// What a joint exerts on each of its bodies, reduced to the point of the joint on that body.
    ///
    /// What acts on the ground is found like the rest, from the rows that the ground would have if
    /// it could move. For `p` of unit length; with
    /// [`Orientation::Raw`](crate::bodies::Orientation::Raw) the moment is otherwise scaled like
    /// `A(p)`.
    #[must_use]
    pub fn wrenches(&self, joint: JointId, x: &[f64], lambda: &DVector<f64>) -> Vec<Wrench> {
        let (joint, row) = self.joint(joint);
        let mut at = self.kinematics(x);
        for (end, body) in joint.bodies().iter().enumerate() {
            at.frames[body.0].translation_column = Some(6 * end);
            at.frames[body.0].rotation_column = Some(6 * end + 3);
        }
        let mut rows = DMatrix::zeros(joint.equations(), 6 * joint.bodies().len());
        joint.jacobian(&at, 0, &mut Jacobian(&mut rows));
        let forces = -rows.tr_mul(&lambda.rows(row, joint.equations()));
        let ends = joint.bodies().iter().zip(joint.points()).enumerate();
        ends.map(|(end, (body, point))| {
            let force: Vector3<f64> = forces.fixed_rows::<3>(6 * end).into();
            let moment: Vector3<f64> = forces.fixed_rows::<3>(6 * end + 3).into();
            let turn = at.frame(*body).rotation;
            Wrench {
                force,
                moment: turn * moment - (turn * point).cross(&force),
            }
        })
        .collect()
    }
}
