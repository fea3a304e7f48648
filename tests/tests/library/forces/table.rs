//! The table of all forces.

use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::BodyId;
use holonom_assembler::forces::Force;
use holonom_assembler::laws::ForceLaw;

use crate::data::{Data, Member};
use crate::library::Placement;

/// A force in the assembler.
pub(super) type Assemble = fn(&Assembler, &[BodyId], &Data) -> Force;

/// A force of the library.
pub(super) struct Entry {
    pub(super) name: &'static str,
    /// Parameters everywhere; the last of two with literals.
    pub(super) placements: Vec<Placement>,
    /// Without one, the energy alone judges.
    pub(super) assemble: Option<Assemble>,
}

macro_rules! placement {
    ($mode:ident $bodies:tt $between:tt [$($member:ident),*] $force:ident $attributes:tt) => {
        Placement {
            members: &[$(Member::$member),*],
            late: late!($mode),
            describe: describe! { $mode $bodies $between force $force $attributes },
        }
    };
}

/// A force between two bodies, or on one.
macro_rules! force {
    (both $force:ident $attributes:tt, $assemble:expr) => {
        Entry {
            name: stringify!($force),
            placements: vec![
                placement! { param [i j] [i, j] [I, J] $force $attributes },
                placement! { literal [j] [ground, j] [Ground, J] $force $attributes },
            ],
            assemble: $assemble,
        }
    };
    (one $force:ident $attributes:tt, $assemble:expr) => {
        Entry {
            name: stringify!($force),
            placements: vec![placement! { param [j] [j] [J] $force $attributes }],
            assemble: $assemble,
        }
    };
}

holonom::force! {
    /// A rubber band that stiffens.
    force Band(i, j; head: Point, tail: Point, stiffness: Number) {
        let stretch = length(j.tail - i.head) - initial(length(j.tail - i.head));
        potential 0.25 * stiffness * stretch * stretch * stretch * stretch;
    }
}

holonom::force! {
    /// Masses that attract each other, and a term that depends on time.
    force Attraction(i, j; head: Point, tail: Point, strength: Number) {
        potential -strength / length(j.tail - i.head) + 0.3 * sin(time) * squared(j.tail - i.head);
    }
}

holonom::force! {
    /// A dipole of `j` in a field fixed on `i`, which fades along it; and a magnetic detent about
    /// the axis.
    force Dipole(i, j; point: Point, axis: Axis, field: Vector) {
        let height = dot(i.axis, j.point - i.point);
        potential -dot(i.field, j.axis) * exp(-0.3 * height) + 0.2 * cos(3.0 * angle(i, j, axis));
        potential sqrt(1.0 + height * height) + dot(cross(i.field, j.axis), j.point - i.point);
    }
}

/// `-20 (x - 0.4) - 3 x' + sin(t)`.
fn law() -> ForceLaw {
    ForceLaw::new(|x, rate, time| -20.0 * (x - 0.4) - 3.0 * rate + time.sin())
}

fn two(bodies: &[BodyId]) -> [BodyId; 2] {
    bodies.try_into().expect("two bodies")
}

pub(super) fn entries() -> Vec<Entry> {
    vec![
        force! {
            both SpringDamper { head = head, tail = tail, stiffness = (40.0), damping = (3.0), free_length = number },
            Some(|s, b, d| Force::spring_damper(s, two(b), d.head, d.tail, 40.0, 3.0, d.number))
        },
        force! {
            both SpringDamper { head = head, tail = tail, stiffness = (40.0), free_length = number },
            Some(|s, b, d| Force::spring_damper(s, two(b), d.head, d.tail, 40.0, 0.0, d.number))
        },
        force! {
            both TorsionalSpringDamper { axis = a, stiffness = (8.0), damping = (0.6), free_angle = number },
            Some(|s, b, d| Force::torsional_spring_damper(s, two(b), d.a, 8.0, 0.6, d.number))
        },
        force! {
            both TorsionalSpringDamper { axis = a, stiffness = (8.0) },
            Some(|s, b, d| Force::torsional_spring_damper(s, two(b), d.a, 8.0, 0.0, 0.0))
        },
        force! {
            both RotationalDamper { damping = (0.9) },
            Some(|_, b, _| Force::rotational_damper(two(b), 0.9))
        },
        force! {
            both Actuator { head = head, tail = tail, force = (-20.0 * (length - 0.4) - 3.0 * rate + sin(time)) },
            Some(|s, b, d| Force::actuator(s, two(b), d.head, d.tail, law()))
        },
        force! {
            both TorsionalActuator { axis = a, moment = (-20.0 * (angle - 0.4) - 3.0 * rate + sin(time)) },
            Some(|s, b, d| Force::torsional_actuator(s, two(b), d.a, law()))
        },
        force! {
            both PointForce { point = tail, force = b },
            Some(|s, b, d| Force::point_force(s, two(b), d.tail, d.b))
        },
        force! {
            one FollowerForce { point = tail, force = b },
            Some(|s, b, d| Force::follower_force(s, b[0], d.tail, d.b))
        },
        force! {
            both ConstantMoment { moment = b },
            Some(|s, b, d| Force::constant_moment(s, two(b), d.b))
        },
        force! {
            one FollowerMoment { moment = b },
            Some(|s, b, d| Force::follower_moment(s, b[0], d.b))
        },
        force! { both Band { head = head, tail = tail, stiffness = (40.0) }, None },
        force! { both Attraction { head = head, tail = tail, strength = number }, None },
        force! { both Dipole { point = head, axis = a, field = b }, None },
    ]
}
