//! What the file says, element by element.

use nalgebra::{Matrix3, Vector3};
use roxmltree::Node;

use crate::elements::{Lines, Reader, is};
use crate::faults::Collector;
use crate::spatial::{Frame, Inertia};
use crate::visuals::{self, Visual};

/// The joints of URDF.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum JointKind {
    /// A hinge with limits.
    Revolute,
    /// A hinge without limits.
    Continuous,
    /// A slide.
    Prismatic,
    /// A plane on a plane.
    Planar,
    /// No joint: six free motions.
    Floating,
    /// A weld. Its links are merged into one body.
    Fixed,
}

impl JointKind {
    const NAMES: [(&'static str, Self); 6] = [
        ("revolute", Self::Revolute),
        ("continuous", Self::Continuous),
        ("prismatic", Self::Prismatic),
        ("fixed", Self::Fixed),
        ("floating", Self::Floating),
        ("planar", Self::Planar),
    ];

    /// Whether the joint has one coordinate, an angle or a displacement.
    #[must_use]
    pub const fn is_single(self) -> bool {
        matches!(self, Self::Revolute | Self::Continuous | Self::Prismatic)
    }

    pub(crate) const fn is_turn(self) -> bool {
        matches!(self, Self::Revolute | Self::Continuous)
    }

    pub(crate) const fn is_fixed(self) -> bool {
        matches!(self, Self::Fixed)
    }

    /// Whether the mechanism has a joint for it: none leaves all six motions.
    pub(crate) const fn has_field(self) -> bool {
        !matches!(self, Self::Fixed | Self::Floating)
    }
}

#[derive(Debug)]
pub(crate) struct Document {
    pub(crate) name: String,
    pub(crate) links: Vec<Link>,
    pub(crate) joints: Vec<Joint>,
}

#[derive(Debug)]
pub(crate) struct Link {
    pub(crate) name: String,
    pub(crate) line: usize,
    /// In the link's frame. Nothing where it was refused.
    pub(crate) inertia: Option<Inertia>,
    /// What it looks like.
    pub(crate) visuals: Vec<Visual>,
}

#[derive(Debug)]
pub(crate) struct Joint {
    pub(crate) name: String,
    pub(crate) line: usize,
    /// Nothing where it was refused.
    pub(crate) kind: Option<JointKind>,
    pub(crate) parent: String,
    pub(crate) child: String,
    /// Of the child's frame in the parent's.
    pub(crate) origin: Frame,
    /// In the child's frame.
    pub(crate) axis: Vector3<f64>,
    pub(crate) limits: Limits,
    /// In N m s/rad, of a slide N s/m.
    pub(crate) damping: f64,
    /// In N m, of a slide N.
    pub(crate) friction: f64,
    pub(crate) mimic: Option<Mimic>,
}

/// What the file says of the range of a joint. Runs heed positions; nothing in
/// the mechanism holds rates and efforts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Lowest and highest position (rad, of a slide m), infinite where there is none.
    pub position: [f64; 2],
    /// Largest rate (rad/s, of a slide m/s), infinite where there is none.
    pub rate: f64,
    /// Largest effort (N m, of a slide N), infinite where there is none.
    pub effort: f64,
}

impl Limits {
    pub(crate) const NONE: Self = Self {
        position: [f64::NEG_INFINITY, f64::INFINITY],
        rate: f64::INFINITY,
        effort: f64::INFINITY,
    };

    /// Whether two positions are given, the lower one first.
    pub(crate) fn leave_a_range(&self) -> bool {
        let [lower, upper] = self.position;
        lower < upper && lower.is_finite() && upper.is_finite()
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Mimic {
    pub(crate) joint: String,
    pub(crate) line: usize,
    pub(crate) multiplier: f64,
    pub(crate) offset: f64,
}

/// What else stands in a robot, a link and a joint, and changes no motion of rigid bodies.
const BESIDE_LINKS: &[&str] = &[
    "material",
    "transmission",
    "gazebo",
    "sensor",
    "ros2_control",
];
const BESIDE_INERTIAL: &[&str] = &[
    "visual",
    "collision",
    "contact",
    "sensor",
    "self_collision_checking",
    "self_filter",
    "collision_checking",
    "surface",
    "verbose",
];
const BESIDE_ORIGIN: &[&str] = &["safety_controller", "calibration", "hardwareInterface"];

pub(crate) fn read(
    robot: Node<'_, '_>,
    lines: &Lines,
    quarter_turns: bool,
    faults: &mut Collector,
) -> Document {
    let name = robot.attribute("name").unwrap_or("robot").to_owned();
    let mut reader = Reader {
        lines,
        faults,
        owner: format!("robot \"{name}\""),
        quarter_turns,
    };
    reader.skip_others(robot, &["link", "joint"], BESIDE_LINKS);
    let mut document = Document {
        name,
        links: Vec::new(),
        joints: Vec::new(),
    };
    for node in robot.children().filter(Node::is_element) {
        let tags = ["link", "joint"];
        let Some(tag) = tags.into_iter().find(|tag| is(node, tag)) else {
            continue;
        };
        reader.owner = tag.to_owned();
        let Some(name) = reader.text(node, "name") else {
            continue;
        };
        reader.owner = format!("{tag} \"{name}\"");
        if tag == "link" {
            document.links.push(link(&mut reader, node, name));
        } else {
            document.joints.extend(joint(&mut reader, node, name));
        }
    }
    document
}

fn link(reader: &mut Reader<'_>, node: Node<'_, '_>, name: &str) -> Link {
    reader.skip_others(node, &["inertial"], BESIDE_INERTIAL);
    let inertia = match reader.child(node, "inertial") {
        Some(inertial) => inertia(reader, inertial),
        None => Some(Inertia::ZERO),
    };
    let visuals = visuals::read(reader, node);
    Link {
        name: name.to_owned(),
        line: reader.lines.of_node(node),
        inertia,
        visuals,
    }
}

fn inertia(reader: &mut Reader<'_>, node: Node<'_, '_>) -> Option<Inertia> {
    reader.refuse_others(node, &["origin", "mass", "inertia"]);
    let frame = reader.origin(node);
    let Some(mass) = reader.child(node, "mass") else {
        reader.at(node, "<inertial> has no <mass>");
        return None;
    };
    let mass = reader.number(mass, "value").and_then(|value| {
        if value < 0.0 {
            let message = format!("the mass is {value} kg; a positive mass is accepted");
            reader.at(mass, &message);
            return None;
        }
        Some(value)
    });
    let Some(tensor) = reader.child(node, "inertia") else {
        reader.say(node, "<inertial> has no <inertia>, and zeros are taken");
        return Some(Inertia::point(mass?, frame?.origin));
    };
    let diagonal = ["ixx", "iyy", "izz"].map(|name| reader.number(tensor, name));
    let products = ["ixy", "ixz", "iyz"].map(|name| {
        if tensor.attribute(name).is_none() {
            reader.say(tensor, &format!("`{name}` is left out, and 0 is taken"));
        }
        reader.number_or(tensor, name, 0.0)
    });
    let ([Some(xx), Some(yy), Some(zz)], [Some(xy), Some(xz), Some(yz)]) = (diagonal, products)
    else {
        return None;
    };
    let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let own = Inertia {
        mass: mass?,
        centre: Vector3::zeros(),
        tensor,
    };
    Some(own.carried(&frame?))
}

fn joint(reader: &mut Reader<'_>, node: Node<'_, '_>, name: &str) -> Option<Joint> {
    let read = [
        "parent", "child", "origin", "axis", "limit", "dynamics", "mimic",
    ];
    reader.skip_others(node, &read, BESIDE_ORIGIN);
    let kind = reader.text(node, "type").and_then(|found| {
        let known = JointKind::NAMES.iter().find(|(name, _)| *name == found);
        if known.is_none() {
            let message = format!(
                "type \"{found}\" is no joint of URDF; revolute, continuous, prismatic, fixed, \
                 floating, planar are"
            );
            reader.at(node, &message);
        }
        known.map(|(_, kind)| *kind)
    });
    let mut end = |tag: &str| match reader.child(node, tag) {
        Some(end) => reader.text(end, "link").map(str::to_owned),
        None => {
            reader.at(node, &format!("<joint> has no <{tag}>"));
            None
        }
    };
    let (parent, child) = (end("parent"), end("child"));
    let origin = reader.origin(node);
    let axis = axis(reader, node, kind);
    let (limits, [damping, friction]) = (limits(reader, node, kind), dynamics(reader, node));
    let mimic = reader.child(node, "mimic").and_then(|mimic| {
        // A weld moves as little as it would without.
        if kind == Some(JointKind::Fixed) {
            return None;
        }
        let joint = reader.text(mimic, "joint")?.to_owned();
        Some(Mimic {
            joint,
            line: reader.lines.of_node(mimic),
            multiplier: reader.number_or(mimic, "multiplier", 1.0)?,
            offset: reader.number_or(mimic, "offset", 0.0)?,
        })
    });
    Some(Joint {
        name: name.to_owned(),
        line: reader.lines.of_node(node),
        kind,
        parent: parent?,
        child: child?,
        origin: origin.unwrap_or(Frame::IDENTITY),
        axis,
        limits,
        damping,
        friction,
        mimic,
    })
}

fn axis(reader: &mut Reader<'_>, node: Node<'_, '_>, kind: Option<JointKind>) -> Vector3<f64> {
    let Some(written) = reader.child(node, "axis") else {
        return Vector3::x();
    };
    let axis = reader.vector_or(written, "xyz", [1.0, 0.0, 0.0]);
    let needs = !matches!(kind, Some(JointKind::Fixed | JointKind::Floating));
    if needs && axis.is_some_and(|axis| axis.norm() < 1e-6) {
        reader.at(
            written,
            "the axis has no direction; one that is not zero is accepted",
        );
    }
    axis.unwrap_or_else(Vector3::x)
}

fn limits(reader: &mut Reader<'_>, node: Node<'_, '_>, kind: Option<JointKind>) -> Limits {
    let mut limits = Limits::NONE;
    let Some(limit) = reader.child(node, "limit") else {
        return limits;
    };
    if matches!(kind, Some(JointKind::Revolute | JointKind::Prismatic)) {
        let bounds = ["lower", "upper"].map(|name| reader.number_or(limit, name, 0.0));
        if let [Some(lower), Some(upper)] = bounds {
            if lower > upper {
                let message = format!(
                    "the lower limit {lower} exceeds the upper limit {upper}, and none is taken"
                );
                reader.say(limit, &message);
            }
            limits.position = [lower, upper];
        }
    }
    let mut largest = |name: &str| match limit.attribute(name) {
        Some(_) => reader.size(limit, name).unwrap_or(f64::INFINITY),
        None => f64::INFINITY,
    };
    (limits.rate, limits.effort) = (largest("velocity"), largest("effort"));
    limits
}

/// Damping and friction.
fn dynamics(reader: &mut Reader<'_>, node: Node<'_, '_>) -> [f64; 2] {
    match reader.child(node, "dynamics") {
        Some(node) => ["damping", "friction"].map(|name| reader.size(node, name).unwrap_or(0.0)),
        None => [0.0; 2],
    }
}
