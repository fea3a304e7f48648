//! The columns of a record.

use std::format;
use std::string::{String, ToString};
use std::vec::Vec;

use crate::error::AngleSet;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::{BodyInfo, BodyKind, JointInfo};

/// What is recorded beside what always is.
#[derive(Clone, Debug, Default)]
pub(super) struct Extra {
    pub(super) reactions: bool,
    /// In the order in which they were asked for.
    pub(super) angles: Vec<AngleSet>,
}

/// The places in `between` of the bodies whose reactions are recorded.
pub(super) fn loaded(joint: &JointInfo) -> core::ops::Range<usize> {
    let bodies = joint.bodies.len();
    if bodies > 2 {
        0..bodies
    } else {
        bodies.saturating_sub(1)..bodies
    }
}

/// Bodies with an orientation, with their places.
pub(super) fn rigid<M: Mechanism>() -> impl Iterator<Item = (usize, &'static BodyInfo)> {
    let bodies = M::REPORT.bodies.iter().enumerate();
    bodies.filter(|(_, body)| body.kind == BodyKind::Rigid)
}

/// The names of three angles: of all, and of each.
const fn names_of(angles: AngleSet) -> (&'static str, [&'static str; 3]) {
    match angles {
        AngleSet::EulerZxz => ("euler_angles", ["precession", "nutation", "spin"]),
        AngleSet::BryantXyz => ("bryant_angles", ["first", "second", "third"]),
        AngleSet::RollPitchYaw => ("roll_pitch_yaw", ["roll", "pitch", "yaw"]),
    }
}

/// The names of the columns.
pub(super) fn columns<M: Mechanism>(extra: &Extra) -> Vec<String> {
    let mut names = std::vec!["time [s]".to_string()];
    for body in M::REPORT.bodies {
        let rigid = body.kind == BodyKind::Rigid;
        vector3(&mut names, body.name, "position", "m");
        if rigid {
            names.extend((0..4).map(|k| format!("{}.orientation.e{k}", body.name)));
        }
        vector3(&mut names, body.name, "velocity", "m/s");
        if rigid {
            vector3(&mut names, body.name, "angular_velocity", "rad/s");
        }
    }
    for joint in M::REPORT.joints {
        let name = joint.name;
        if joint.has_angle {
            names.push(format!("{name}.angle [rad]"));
            names.push(format!("{name}.angle_rate [rad/s]"));
        }
        if joint.has_displacement {
            names.push(format!("{name}.displacement [m]"));
            names.push(format!("{name}.displacement_rate [m/s]"));
        }
    }
    names.extend(M::REPORT.states.iter().map(|state| state.name.to_string()));
    names.extend(["kinetic_energy [J]", "potential_energy [J]", "violation"].map(String::from));
    for &angles in &extra.angles {
        let (all, each) = names_of(angles);
        for (_, body) in rigid::<M>() {
            names.extend(each.map(|angle| format!("{}.{all}.{angle} [rad]", body.name)));
        }
    }
    if extra.reactions {
        for joint in M::REPORT.joints {
            for place in loaded(joint) {
                let name = reaction_name::<M>(joint, place);
                vector3(&mut names, &name, "force", "N");
                vector3(&mut names, &name, "moment", "N m");
            }
        }
    }
    names
}

fn vector3(names: &mut Vec<String>, name: &str, quantity: &str, unit: &str) {
    names.extend(["x", "y", "z"].map(|axis| format!("{name}.{quantity}.{axis} [{unit}]")));
}

/// The name of the joint; with the body where more than one is recorded.
fn reaction_name<M: Mechanism>(joint: &JointInfo, place: usize) -> String {
    if joint.bodies.len() <= 2 {
        return joint.name.to_string();
    }
    let body = joint.bodies.get(place).copied().flatten();
    let body = body.and_then(|body| M::REPORT.bodies.get(body));
    format!("{}.{}", joint.name, body.map_or("ground", |body| body.name))
}
