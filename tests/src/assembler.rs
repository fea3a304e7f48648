//! The generic run-time assembler: a list of bodies and joints, and the kernels of their equations of motion.
//!
//! ```text
//! M u' + D^T lambda = g      Phi(q) = 0      Phi' = D u      D u' = gamma      reaction on the bodies = -D^T lambda
//! ```
//!
//! `q` holds `(r, p)` of all bodies in the order in which they were added, `u` holds `(v, w)`; a particle has `r` and
//! `v` only, the ground nothing. Equations stand in the order of the joints. Sources: Nikravesh (1988), chapters 8
//! and 11; Flores (2015), chapters 10 and 11.

use nalgebra::{DVector, Vector3, Vector4};

use crate::bodies::{Body, BodyId, Frame, Kind, Orientation, euler_rate, rotation};
use crate::joints::{Joint, normals};
use crate::rows::Rows;

/// The place of a joint in its [`Assembler`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct JointId(usize);

/// A body and where its coordinates and velocities start.
#[derive(Clone, Copy, Debug)]
struct PlacedBody {
    body: Body,
    coordinate: usize,
    velocity: usize,
}

/// A joint and its first equation.
#[derive(Clone, Copy, Debug)]
struct PlacedJoint {
    joint: Joint,
    row: usize,
}

/// A mechanism of bodies and joints that are chosen at run time.
#[derive(Clone, Debug)]
pub struct Assembler {
    bodies: Vec<PlacedBody>,
    joints: Vec<PlacedJoint>,
    gravity: Vector3<f64>,
    orientation: Orientation,
    coordinates: usize,
    velocities: usize,
    equations: usize,
}

/// A force and a moment in global axes, reduced to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench {
    /// Force (N, global axes).
    pub force: Vector3<f64>,
    /// Moment about the point (N m, global axes).
    pub moment: Vector3<f64>,
}

impl Assembler {
    /// The ground alone, with the acceleration of gravity (m/s^2, global axes).
    #[must_use]
    pub fn new(gravity: [f64; 3]) -> Self {
        Self {
            bodies: vec![PlacedBody {
                body: Body::ground(),
                coordinate: 0,
                velocity: 0,
            }],
            joints: Vec::new(),
            gravity: gravity.into(),
            orientation: Orientation::Raw,
            coordinates: 0,
            velocities: 0,
            equations: 0,
        }
    }

    /// The same mechanism with another reading of Euler parameters.
    #[must_use]
    pub fn with_orientation(mut self, orientation: Orientation) -> Self {
        self.orientation = orientation;
        self
    }

    /// Adds a body.
    pub fn add_body(&mut self, body: Body) -> BodyId {
        self.bodies.push(PlacedBody {
            body,
            coordinate: self.coordinates,
            velocity: self.velocities,
        });
        self.coordinates += body.kind.coordinates();
        self.velocities += body.kind.velocities();
        BodyId(self.bodies.len() - 1)
    }

    /// Adds a joint whose data are given in body axes.
    ///
    /// # Panics
    /// If both ends are the same body, or a body is unknown.
    pub fn add_joint(&mut self, joint: Joint) -> JointId {
        let [i, j] = joint.between();
        assert!(i != j, "a joint needs two bodies");
        assert!(
            i.0.max(j.0) < self.bodies.len(),
            "a joint names an unknown body"
        );
        self.joints.push(PlacedJoint {
            joint,
            row: self.equations,
        });
        self.equations += joint.equations();
        JointId(self.joints.len() - 1)
    }

    /// Adds a spherical joint at a point (m, global axes) of the initial configuration.
    pub fn add_spherical(&mut self, between: [BodyId; 2], point: [f64; 3]) -> JointId {
        let points = between.map(|body| self.to_body_point(body, point));
        self.add_joint(Joint::Spherical { between, points })
    }

    /// Adds a revolute joint from a point (m) and an axis (any length), both in global axes at the initial
    /// configuration. [`normals`] is applied to the axis in the axes of body `i`.
    pub fn add_revolute(
        &mut self,
        between: [BodyId; 2],
        point: [f64; 3],
        axis: [f64; 3],
    ) -> JointId {
        let points = between.map(|body| self.to_body_point(body, point));
        let [axis_i, axis] = between.map(|body| self.to_body_vector(body, axis).normalize());
        self.add_joint(Joint::Revolute {
            between,
            points,
            normals: normals(&axis_i),
            axis,
        })
    }

    /// A point of the initial configuration (m, global axes) in the axes of a body.
    #[must_use]
    pub fn to_body_point(&self, body: BodyId, point: [f64; 3]) -> Vector3<f64> {
        let relative = Vector3::from(point) - self.bodies[body.0].body.position;
        self.to_body_vector(body, relative.into())
    }

    /// A vector of the initial configuration (global axes) in the axes of a body.
    #[must_use]
    pub fn to_body_vector(&self, body: BodyId, vector: [f64; 3]) -> Vector3<f64> {
        let body = &self.bodies[body.0].body;
        rotation(&body.euler.normalize()).tr_mul(&vector.into())
    }

    /// Number of coordinates `q`.
    #[must_use]
    pub fn coordinates(&self) -> usize {
        self.coordinates
    }

    /// Number of velocities `u`.
    #[must_use]
    pub fn velocities(&self) -> usize {
        self.velocities
    }

    /// Number of equations `Phi`.
    #[must_use]
    pub fn equations(&self) -> usize {
        self.equations
    }

    /// The bodies that were added (the ground is not among them), each with its first coordinate and velocity.
    pub fn bodies(&self) -> impl Iterator<Item = (&Body, usize, usize)> {
        self.bodies[1..]
            .iter()
            .map(|placed| (&placed.body, placed.coordinate, placed.velocity))
    }

    /// The joints with their first equation.
    pub fn joints(&self) -> impl Iterator<Item = (&Joint, usize)> {
        self.joints.iter().map(|placed| (&placed.joint, placed.row))
    }

    /// The joints in the order in which they were added.
    pub fn joint_ids(&self) -> impl Iterator<Item = JointId> {
        (0..self.joints.len()).map(JointId)
    }

    /// A joint and its first equation.
    #[must_use]
    pub fn joint(&self, joint: JointId) -> (&Joint, usize) {
        let placed = &self.joints[joint.0];
        (&placed.joint, placed.row)
    }

    /// The acceleration of gravity (m/s^2, global axes).
    #[must_use]
    pub fn gravity(&self) -> &Vector3<f64> {
        &self.gravity
    }

    /// How Euler parameters are read.
    #[must_use]
    pub fn orientation(&self) -> Orientation {
        self.orientation
    }

    /// The initial state `x = (q, u)`.
    #[must_use]
    pub fn initial_state(&self) -> DVector<f64> {
        let mut x = DVector::zeros(self.coordinates + self.velocities);
        for (body, q, u) in self.bodies() {
            let u = u + self.coordinates;
            if body.kind != Kind::Ground {
                x.fixed_rows_mut::<3>(q).copy_from(&body.position);
                x.fixed_rows_mut::<3>(u).copy_from(&body.velocity);
            }
            if body.kind == Kind::Rigid {
                x.fixed_rows_mut::<4>(q + 3).copy_from(&body.euler);
                x.fixed_rows_mut::<3>(u + 3).copy_from(&body.rate);
            }
        }
        x
    }

    /// Work space for [`Assembler::update`]: one frame per body, the ground first.
    #[must_use]
    pub fn frames(&self) -> Vec<Frame> {
        let place = |placed: &PlacedBody| Frame {
            translation_column: (placed.body.kind != Kind::Ground).then_some(placed.velocity),
            rotation_column: (placed.body.kind == Kind::Rigid).then_some(placed.velocity + 3),
            ..Frame::fixed()
        };
        self.bodies.iter().map(place).collect()
    }

    /// Computes the kinematics of all bodies at the state `x = (q, u)`.
    pub fn update(&self, x: &[f64], frames: &mut [Frame]) {
        let (q, u) = x.split_at(self.coordinates);
        for (placed, frame) in self.bodies.iter().zip(frames) {
            let (q, u) = (&q[placed.coordinate..], &u[placed.velocity..]);
            if placed.body.kind != Kind::Ground {
                frame.position = Vector3::from_column_slice(&q[..3]);
                frame.velocity = Vector3::from_column_slice(&u[..3]);
            }
            if placed.body.kind == Kind::Rigid {
                let p = Vector4::from_column_slice(&q[3..7]);
                frame.rotation = rotation(&p);
                if self.orientation == Orientation::Normalised {
                    frame.rotation /= p.norm_squared();
                }
                frame.rate = Vector3::from_column_slice(&u[3..6]);
            }
        }
    }

    /// The frames of a joint's two bodies.
    fn ends<'a>(frames: &'a [Frame], joint: &Joint) -> [&'a Frame; 2] {
        joint.between().map(|body| &frames[body.0])
    }

    /// Calls a kernel of every joint with the joint's frames and its part of `out`.
    fn for_rows(
        &self,
        frames: &[Frame],
        out: &mut [f64],
        kernel: impl Fn(&Joint, &Frame, &Frame, &mut [f64]),
    ) {
        for PlacedJoint { joint, row } in &self.joints {
            let [i, j] = Self::ends(frames, joint);
            kernel(joint, i, j, &mut out[*row..*row + joint.equations()]);
        }
    }

    /// Writes `Phi`.
    pub fn write_constraints(&self, frames: &[Frame], out: &mut [f64]) {
        self.for_rows(frames, out, Joint::constraints);
    }

    /// Writes `Phi' = D u`.
    pub fn write_constraint_rates(&self, frames: &[Frame], out: &mut [f64]) {
        self.for_rows(frames, out, Joint::constraint_rates);
    }

    /// Writes `gamma`.
    pub fn write_gamma(&self, frames: &[Frame], out: &mut [f64]) {
        self.for_rows(frames, out, Joint::gamma);
    }

    /// Writes the rows of `D`.
    pub(crate) fn write_jacobian(&self, frames: &[Frame], target: &mut impl Rows) {
        for PlacedJoint { joint, row } in &self.joints {
            let [i, j] = Self::ends(frames, joint);
            joint.jacobian(i, j, *row, target);
        }
    }

    /// Writes `g`: weight (N, global axes) and gyroscopic moment `-w x J w` (N m, body axes) of every body.
    pub fn write_forces(&self, frames: &[Frame], out: &mut [f64]) {
        for (placed, frame) in self.bodies.iter().zip(frames) {
            let Body { mass, inertia, .. } = &placed.body;
            if let Some(k) = frame.translation_column {
                out[k..k + 3].copy_from_slice((self.gravity * *mass).as_slice());
            }
            if let Some(k) = frame.rotation_column {
                let momentum = inertia.component_mul(&frame.rate);
                out[k..k + 3].copy_from_slice(momentum.cross(&frame.rate).as_slice());
            }
        }
    }

    /// Writes the rates of the coordinates: `r' = v`, `p' = 1/2 L(p)^T w` with `p` as it is.
    pub fn write_coordinate_rates(&self, x: &[f64], out: &mut [f64]) {
        let (q, u) = x.split_at(self.coordinates);
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
    }

    /// The diagonal of the mass matrix: `(m, m, m, J1, J2, J3)` for a body (kg, kg m^2).
    #[must_use]
    pub fn mass(&self) -> DVector<f64> {
        let mut diagonal = DVector::zeros(self.velocities);
        for (body, _, n) in self.bodies() {
            if body.kind != Kind::Ground {
                diagonal.fixed_rows_mut::<3>(n).fill(body.mass);
            }
            if body.kind == Kind::Rigid {
                diagonal.fixed_rows_mut::<3>(n + 3).copy_from(&body.inertia);
            }
        }
        diagonal
    }
}
