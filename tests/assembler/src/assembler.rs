//! The generic run-time assembler: a list of bodies and joints, and the kernels of their equations
//! of motion.
//!
//! ```text
//! M u' + D^T lambda = g      Phi(q) = 0      Phi' = D u      D u' = gamma
//! reaction on the bodies = -D^T lambda
//! ```
//!
//! With a driver `Phi(q, t) = 0` and `Phi' = D u + Phi_t`. `q` holds `(r, p)` of all bodies in the
//! order in which they were added, `u` holds `(v, w)`; a particle has `r` and `v` only, the ground
//! nothing. Behind the bodies `q` holds one auxiliary state for every angle, those of the joints in
//! their order and then those of the forces. Equations stand in the order of the joints. Sources:
//! Nikravesh (1988), chapters 8 and 11; Flores (2015), chapters 10 and 11.

use nalgebra::{DVector, Vector3};

use crate::angles::Angle;
use crate::bodies::{Body, BodyId, Kind, Orientation, rotation};
use crate::forces::Force;
use crate::joints::{Joint, Normals, normals};

/// The place of a joint in its [`Assembler`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct JointId(usize);

/// A body and where its coordinates and velocities start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedBody {
    pub(crate) body: Body,
    pub(crate) coordinate: usize,
    pub(crate) velocity: usize,
}

/// A joint and its first equation.
#[derive(Clone, Debug)]
pub(crate) struct PlacedJoint {
    pub(crate) joint: Joint,
    pub(crate) row: usize,
}

/// A mechanism of bodies and joints that are chosen at run time.
#[derive(Clone, Debug)]
pub struct Assembler {
    pub(crate) bodies: Vec<PlacedBody>,
    pub(crate) joints: Vec<PlacedJoint>,
    pub(crate) forces: Vec<Force>,
    /// Those of the joints, then those of the forces; the place of each is its auxiliary state.
    angles: Vec<Angle>,
    gravity: Vector3<f64>,
    orientation: Orientation,
    normals: Normals,
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
            forces: Vec::new(),
            angles: Vec::new(),
            gravity: gravity.into(),
            orientation: Orientation::Raw,
            normals,
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

    /// The same, before joints are added, with another rule for the normals of an axis.
    #[must_use]
    pub fn with_normals(mut self, normals: Normals) -> Self {
        self.normals = normals;
        self
    }

    /// Two unit vectors that with the unit axis `a` make a right-handed frame `(n1, n2, a)`.
    #[must_use]
    pub fn normals(&self, a: &Vector3<f64>) -> [Vector3<f64>; 2] {
        (self.normals)(a)
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
    /// If it names a body twice, or one that is unknown.
    pub fn add_joint(&mut self, joint: Joint) -> JointId {
        let bodies = joint.bodies();
        for (k, body) in bodies.iter().enumerate() {
            assert!(!bodies[..k].contains(body), "a joint names a body twice");
            assert!(body.0 < self.bodies.len(), "a joint names an unknown body");
        }
        let row = self.equations;
        self.equations += joint.equations();
        self.joints.push(PlacedJoint { joint, row });
        self.number_angles();
        JointId(self.joints.len() - 1)
    }

    /// Adds a force.
    pub fn add_force(&mut self, force: Force) {
        self.forces.push(force);
        self.number_angles();
    }

    /// Gives every angle its auxiliary state.
    fn number_angles(&mut self) {
        self.angles.clear();
        let joints = self.joints.iter_mut().map(|placed| &mut placed.joint);
        let angles = joints
            .flat_map(Joint::angles_mut)
            .chain(self.forces.iter_mut().filter_map(Force::angle_mut));
        for angle in angles {
            angle.slot = Some(self.angles.len());
            self.angles.push(*angle);
        }
    }

    /// Adds a spherical joint at a point (m, global axes) of the initial configuration.
    pub fn add_spherical(&mut self, between: [BodyId; 2], point: [f64; 3]) -> JointId {
        self.add_joint(Joint::spherical(self, between, point))
    }

    /// Adds a revolute joint from a point (m) and an axis (any length), both in global axes at the
    /// initial configuration.
    pub fn add_revolute(
        &mut self,
        between: [BodyId; 2],
        point: [f64; 3],
        axis: [f64; 3],
    ) -> JointId {
        self.add_joint(Joint::revolute(self, between, point, axis))
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

    /// Number of coordinates `q`, auxiliary states included.
    #[must_use]
    pub fn coordinates(&self) -> usize {
        self.coordinates + self.angles.len()
    }

    /// Number of coordinates of the bodies: the place of the first auxiliary state.
    #[must_use]
    pub fn body_coordinates(&self) -> usize {
        self.coordinates
    }

    /// The unwrapped angles, in the order of their auxiliary states.
    #[must_use]
    pub fn angles(&self) -> &[Angle] {
        &self.angles
    }

    /// The forces in the order in which they were added.
    #[must_use]
    pub fn applied_forces(&self) -> &[Force] {
        &self.forces
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

    /// The bodies that were added (the ground is not among them), each with its first coordinate
    /// and velocity.
    pub fn bodies(&self) -> impl Iterator<Item = (&Body, usize, usize)> {
        self.bodies[1..]
            .iter()
            .map(|placed| (&placed.body, placed.coordinate, placed.velocity))
    }

    /// A body as it was described; the ground too.
    #[must_use]
    pub fn body(&self, body: BodyId) -> &Body {
        &self.bodies[body.0].body
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

    /// The initial state `x = (q, u)`, with every angle between -pi and pi.
    #[must_use]
    pub fn initial_state(&self) -> DVector<f64> {
        let mut x = DVector::zeros(self.coordinates() + self.velocities);
        for (body, q, u) in self.bodies() {
            let u = u + self.coordinates();
            if body.kind != Kind::Ground {
                x.fixed_rows_mut::<3>(q).copy_from(&body.position);
                x.fixed_rows_mut::<3>(u).copy_from(&body.velocity);
            }
            if body.kind == Kind::Rigid {
                x.fixed_rows_mut::<4>(q + 3).copy_from(&body.euler);
                x.fixed_rows_mut::<3>(u + 3).copy_from(&body.rate);
            }
        }
        self.rewrap(x.as_mut_slice());
        x
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
