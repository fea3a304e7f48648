//! The kernels of the assembler, written into storage that the caller keeps: nothing here allocates
//! but the work space.

use nalgebra::{Vector3, Vector4};

use crate::angles::counted;
use crate::assembler::{Assembler, PlacedBody, PlacedJoint};
use crate::bodies::{Body, Frame, Kind, Orientation, euler_rate, rotation};
use crate::joints::Joint;
use crate::kinematics::Kinematics;
use crate::rows::Rows;

impl Assembler {
    /// Work space for [`Assembler::update`].
    #[must_use]
    pub fn workspace(&self) -> Kinematics {
        let place = |placed: &PlacedBody| Frame {
            translation_column: (placed.body.kind != Kind::Ground).then_some(placed.velocity),
            rotation_column: (placed.body.kind == Kind::Rigid).then_some(placed.velocity + 3),
            ..Frame::fixed()
        };
        Kinematics {
            time: 0.0,
            frames: self.bodies.iter().map(place).collect(),
            turns: vec![0.0; self.angles().len()],
        }
    }

    /// Computes the kinematics of all bodies at a time (s) and the state `x = (q, u)`.
    pub fn update(&self, time: f64, x: &[f64], at: &mut Kinematics) {
        let (q, u) = x.split_at(self.coordinates());
        at.time = time;
        at.turns.copy_from_slice(&q[self.body_coordinates()..]);
        for (placed, frame) in self.bodies.iter().zip(&mut at.frames) {
            let (q, u) = (&q[placed.coordinate..], &u[placed.velocity..]);
            if placed.body.kind != Kind::Ground {
                frame.position = Vector3::from_column_slice(&q[..3]);
                frame.velocity = Vector3::from_column_slice(&u[..3]);
            }
            if placed.body.kind == Kind::Rigid {
                let p = Vector4::from_column_slice(&q[3..7]);
                frame.rotation = rotation(&p);
                if self.orientation() == Orientation::Normalised {
                    frame.rotation /= p.norm_squared();
                }
                frame.rate = Vector3::from_column_slice(&u[3..6]);
            }
        }
    }

    /// Calls a kernel of every joint with the joint's part of `out`.
    fn for_rows(&self, out: &mut [f64], kernel: impl Fn(&Joint, &mut [f64])) {
        for PlacedJoint { joint, row } in &self.joints {
            kernel(joint, &mut out[*row..*row + joint.equations()]);
        }
    }

    /// Writes `Phi`.
    pub fn write_constraints(&self, at: &Kinematics, out: &mut [f64]) {
        self.for_rows(out, |joint, out| joint.constraints(at, out));
    }

    /// Writes `Phi' = D u + Phi_t`.
    pub fn write_constraint_rates(&self, at: &Kinematics, out: &mut [f64]) {
        self.for_rows(out, |joint, out| joint.constraint_rates(at, out));
    }

    /// Writes `gamma`.
    pub fn write_gamma(&self, at: &Kinematics, out: &mut [f64]) {
        self.for_rows(out, |joint, out| joint.gamma(at, out));
    }

    /// Writes `Phi_t` for the order 1 and `Phi_tt` for the order 2.
    pub fn write_time_derivatives(&self, time: f64, order: usize, out: &mut [f64]) {
        self.for_rows(out, |joint, out| joint.time_derivatives(time, order, out));
    }

    /// Writes the rows of `D`.
    pub(crate) fn write_jacobian(&self, at: &Kinematics, target: &mut impl Rows) {
        for PlacedJoint { joint, row } in &self.joints {
            joint.jacobian(at, *row, target);
        }
    }

    /// Writes `g`: weight (N, global axes) and gyroscopic moment `-w x J w` (N m, body axes) of
    /// every body, and the forces that were added.
    pub fn write_forces(&self, at: &Kinematics, out: &mut [f64]) {
        for (placed, frame) in self.bodies.iter().zip(&at.frames) {
            let Body { mass, inertia, .. } = &placed.body;
            if let Some(k) = frame.translation_column {
                out[k..k + 3].copy_from_slice((self.gravity() * *mass).as_slice());
            }
            if let Some(k) = frame.rotation_column {
                let momentum = inertia.component_mul(&frame.rate);
                out[k..k + 3].copy_from_slice(momentum.cross(&frame.rate).as_slice());
            }
        }
        for force in &self.forces {
            force.apply(at, out);
        }
    }

    /// Writes the rates of the coordinates at `x = (q, u)`, of which `at` is the kinematics:
    /// `r' = v`, `p' = 1/2 L(p)^T w` with `p` as it is, `s' = a . (w_j - w_i)` of the angles.
    pub fn write_coordinate_rates(&self, at: &Kinematics, x: &[f64], out: &mut [f64]) {
        let (q, u) = x.split_at(self.coordinates());
        for (body, k, n) in self.bodies() {
            if body.kind != Kind::Ground {
                out[k..k + 3].copy_from_slice(&u[n..n + 3]);
            }
            if body.kind == Kind::Rigid {
                let p = Vector4::from_column_slice(&q[k + 3..k + 7]);
                let w = Vector3::from_column_slice(&u[n + 3..n + 6]);
                out[k + 3..k + 7].copy_from_slice(euler_rate(&p, &w).as_slice());
            }
        }
        let auxiliary = &mut out[self.body_coordinates()..];
        for (rate, angle) in auxiliary.iter_mut().zip(self.angles()) {
            *rate = angle.turning_rate(at);
        }
    }

    /// Sets every auxiliary state of `x = (q, u)` to the angle itself, with the turns that it
    /// counted before.
    pub fn rewrap(&self, x: &mut [f64]) {
        if self.angles().is_empty() {
            return;
        }
        let at = self.kinematics(x);
        for (slot, angle) in self.angles().iter().enumerate() {
            x[self.body_coordinates() + slot] = counted(angle.principal(&at), at.turns[slot]);
        }
    }
}
