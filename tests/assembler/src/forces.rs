//! Forces between bodies: what they add to `g`, their potential energy and their power, derived by
//! hand.
//!
//! A force `F` along a scalar `f` (a length or an unwrapped angle) does the work `F df`, so it adds
//! `F` times the gradient of `f`; this holds off the constraints too. A force at a point adds the
//! gradient of `F . P` with `F` held, a moment `A^T M`, with `A` as it is read. Source: Haug
//! (1989), chapter 11 (springs, dampers and actuators between points and about axes).

use nalgebra::Vector3;

use crate::angles::Angle;
use crate::assembler::Assembler;
use crate::bodies::BodyId;
use crate::kinematics::{Kinematics, Mark};
use crate::laws::ForceLaw;
use crate::scalars::Scalar;

/// What acts between bodies besides weight and joints.
#[derive(Clone, Debug)]
pub enum Force {
    /// `-stiffness (f - free) - damping f'` along `f`, a length (m) or an angle (rad).
    Spring {
        /// `f`.
        along: Scalar,
        /// N/m or N m/rad.
        stiffness: f64,
        /// N s/m or N m s/rad.
        damping: f64,
        /// The length or angle without force.
        free: f64,
    },
    /// A law of `(f, f', t)` along `f`: positive pushes the points apart, or turns `j` forward
    /// against `i`.
    Actuator {
        /// `f`.
        along: Scalar,
        /// The force (N) or moment (N m).
        law: ForceLaw,
    },
    /// `-damping w` on `j`, and the opposite on `i`, with the angular velocity of `j` against `i`.
    Damper {
        /// `i` and `j`.
        between: [BodyId; 2],
        /// N m s/rad.
        damping: f64,
    },
    /// A force at a point.
    AtPoint {
        /// The force (N), in the axes of the body on which it is fixed.
        force: Mark,
        /// Where it acts.
        point: Mark,
    },
    /// A moment on a body.
    Moment {
        /// The moment (N m), in the axes of the body on which it is fixed.
        moment: Mark,
        /// On which it acts.
        on: BodyId,
    },
}

impl Force {
    /// A spring and a damper side by side between a point `head` of body `i` and a point `tail` of
    /// body `j` (m, global axes, reference configuration).
    #[must_use]
    pub fn spring_damper(
        scene: &Assembler,
        [i, j]: [BodyId; 2],
        head: [f64; 3],
        tail: [f64; 3],
        stiffness: f64,
        damping: f64,
        free_length: f64,
    ) -> Self {
        Self::Spring {
            along: Scalar::Length([scene.point(i, head), scene.point(j, tail)]),
            stiffness,
            damping,
            free: free_length,
        }
    }

    /// A torsional spring and damper on the unwrapped angle of `j` against `i` about an axis
    /// (global axes, reference configuration).
    #[must_use]
    pub fn torsional_spring_damper(
        scene: &Assembler,
        between: [BodyId; 2],
        axis: [f64; 3],
        stiffness: f64,
        damping: f64,
        free_angle: f64,
    ) -> Self {
        Self::Spring {
            along: Scalar::Angle(scene.angle(between, axis)),
            stiffness,
            damping,
            free: free_angle,
        }
    }

    /// A damper against the rotation of `j` against `i`.
    #[must_use]
    pub fn rotational_damper(between: [BodyId; 2], damping: f64) -> Self {
        Self::Damper { between, damping }
    }

    /// A law of `(length, rate, time)` between a point of `i` and a point of `j`.
    #[must_use]
    pub fn actuator(
        scene: &Assembler,
        [i, j]: [BodyId; 2],
        head: [f64; 3],
        tail: [f64; 3],
        law: ForceLaw,
    ) -> Self {
        Self::Actuator {
            along: Scalar::Length([scene.point(i, head), scene.point(j, tail)]),
            law,
        }
    }

    /// A law of `(angle, rate, time)` on the unwrapped angle of `j` against `i` about an axis.
    #[must_use]
    pub fn torsional_actuator(
        scene: &Assembler,
        between: [BodyId; 2],
        axis: [f64; 3],
        law: ForceLaw,
    ) -> Self {
        Self::Actuator {
            along: Scalar::Angle(scene.angle(between, axis)),
            law,
        }
    }

    /// A force (N, global axes in the reference configuration) fixed in the axes of `i`, at a point
    /// of `j` (m).
    #[must_use]
    pub fn point_force(
        scene: &Assembler,
        [i, j]: [BodyId; 2],
        point: [f64; 3],
        force: [f64; 3],
    ) -> Self {
        Self::AtPoint {
            force: scene.vector(i, force),
            point: scene.point(j, point),
        }
    }

    /// A force that turns with the body on which it acts.
    #[must_use]
    pub fn follower_force(
        scene: &Assembler,
        body: BodyId,
        point: [f64; 3],
        force: [f64; 3],
    ) -> Self {
        Self::point_force(scene, [body, body], point, force)
    }

    /// A moment (N m, global axes in the reference configuration) fixed in the axes of `i`, on `j`.
    #[must_use]
    pub fn constant_moment(scene: &Assembler, [i, j]: [BodyId; 2], moment: [f64; 3]) -> Self {
        Self::Moment {
            moment: scene.vector(i, moment),
            on: j,
        }
    }

    /// A moment that turns with the body on which it acts.
    #[must_use]
    pub fn follower_moment(scene: &Assembler, body: BodyId, moment: [f64; 3]) -> Self {
        Self::constant_moment(scene, [body, body], moment)
    }

    /// Its unwrapped angle.
    pub(crate) fn angle_mut(&mut self) -> Option<&mut Angle> {
        match self {
            Self::Spring {
                along: Scalar::Angle(angle),
                ..
            }
            | Self::Actuator {
                along: Scalar::Angle(angle),
                ..
            } => Some(angle),
            _ => None,
        }
    }

    /// The part along a scalar that is not booked as potential energy: damping, or the law of an
    /// actuator.
    fn driving(&self, at: &Kinematics) -> Option<(&Scalar, f64)> {
        match self {
            Self::Spring { along, damping, .. } => Some((along, -damping * along.rate(at))),
            Self::Actuator { along, law } => {
                let value = law.at(along.value(at), along.rate(at), at.time);
                Some((along, value))
            }
            Self::AtPoint { .. } | Self::Moment { .. } | Self::Damper { .. } => None,
        }
    }

    /// Adds the generalised force to `g` (N, global axes; N m, body axes).
    pub(crate) fn apply(&self, at: &Kinematics, g: &mut [f64]) {
        let mut add = |column: usize, line: &Vector3<f64>| {
            for k in 0..3 {
                g[column + k] += line[k];
            }
        };
        if let Some((along, force)) = self.driving(at) {
            along.gradient(at, force, &mut add);
        }
        match self {
            Self::Spring {
                along,
                stiffness,
                free,
                ..
            } => along.gradient(at, -stiffness * (along.value(at) - free), &mut add),
            Self::Actuator { .. } => {}
            Self::Damper { between, damping } => {
                let against = relative_rate(at, *between);
                for (body, sign) in between.iter().zip([1.0, -1.0]) {
                    let frame = at.frame(*body);
                    if let Some(column) = frame.rotation_column {
                        add(
                            column,
                            &frame.rotation.tr_mul(&(against * (sign * damping))),
                        );
                    }
                }
            }
            Self::AtPoint { force, point } => point.point_gradient(at, &force.vector(at), &mut add),
            Self::Moment { moment, on } => {
                let frame = at.frame(*on);
                if let Some(column) = frame.rotation_column {
                    add(column, &frame.rotation.tr_mul(&moment.vector(at)));
                }
            }
        }
    }

    /// Potential energy (J): of springs, zero where they are free; the other forces have none.
    #[must_use]
    pub fn potential_energy(&self, at: &Kinematics) -> f64 {
        match self {
            Self::Spring {
                along,
                stiffness,
                free,
                ..
            } => {
                let stretch = along.value(at) - free;
                0.5 * stiffness * stretch * stretch
            }
            _ => 0.0,
        }
    }

    /// Power (W) of what has no potential energy.
    #[must_use]
    pub fn power(&self, at: &Kinematics) -> f64 {
        match self {
            Self::AtPoint { force, point } => force.vector(at).dot(&point.point_rate(at)),
            Self::Moment { moment, on } => {
                let frame = at.frame(*on);
                moment.vector(at).dot(&(frame.rotation * frame.rate))
            }
            Self::Damper { between, damping } => {
                -damping * relative_rate(at, *between).norm_squared()
            }
            Self::Spring { .. } | Self::Actuator { .. } => self
                .driving(at)
                .map_or(0.0, |(along, force)| force * along.rate(at)),
        }
    }
}

/// The angular velocity (rad/s, global axes) of the second body against the first.
fn relative_rate(at: &Kinematics, between: [BodyId; 2]) -> Vector3<f64> {
    let [i, j] = between.map(|body| {
        let frame = at.frame(body);
        frame.rotation * frame.rate
    });
    j - i
}
