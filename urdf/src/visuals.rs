//! What links look like: primitives, which become shapes, and what has only a name.

use nalgebra::Vector3;
use roxmltree::Node;

use crate::elements::{Reader, is};
use crate::mechanism::{Mesh, Shape};
use crate::spatial::{Frame, clean, euler_parameters, number};

/// A `<visual>`.
#[derive(Debug)]
pub(crate) enum Visual {
    /// A primitive, with the frame of its centre in that of the link.
    Solid(Frame, Solid),
    /// A mesh, with its frame in that of the link.
    Mesh(Frame, Surface),
    /// Another geometry: what it is called.
    Named(String),
}

/// A mesh of a file.
#[derive(Debug)]
pub(crate) struct Surface {
    pub(crate) file: String,
    scale: [f64; 3],
    colour: Option<[f64; 4]>,
}

/// Lengths in m, none of them zero.
#[derive(Debug)]
pub(crate) enum Solid {
    /// Along x, y, z.
    Box(Vector3<f64>),
    /// Its axis is z.
    Cylinder {
        radius: f64,
        length: f64,
    },
    Sphere {
        radius: f64,
    },
}

/// The visuals of a link, in the order of the file. Those without geometry are left out.
pub(crate) fn read(reader: &mut Reader<'_>, link: Node<'_, '_>) -> Vec<Visual> {
    let all = link.children().filter(|child| is(*child, "visual"));
    all.filter_map(|node| visual(reader, node)).collect()
}

fn visual(reader: &mut Reader<'_>, node: Node<'_, '_>) -> Option<Visual> {
    let geometry = node.children().find(|child| is(*child, "geometry"))?;
    let shape = geometry.children().find(Node::is_element)?;
    let name = shape.tag_name().name();
    let solid = match name {
        "box" => {
            reader.text(shape, "size")?;
            let size = reader.vector_or(shape, "size", [0.0; 3])?;
            if size.min() < 0.0 {
                let message = "`size` has a negative length; zero or positive ones are accepted";
                reader.at(shape, message);
                return None;
            }
            (size.min() > 0.0).then_some(Solid::Box(size))
        }
        "cylinder" => {
            let [radius, length] = ["radius", "length"].map(|key| length(reader, shape, key));
            let (radius, length) = (radius?, length?);
            (radius.min(length) > 0.0).then_some(Solid::Cylinder { radius, length })
        }
        "sphere" => {
            let radius = length(reader, shape, "radius")?;
            (radius > 0.0).then_some(Solid::Sphere { radius })
        }
        _ => None,
    };
    if let Some(solid) = solid {
        return Some(Visual::Solid(reader.origin(node)?, solid));
    }
    let file = shape.attribute("filename").map(str::trim);
    let (true, Some(file)) = (name == "mesh", file.filter(|file| !file.is_empty())) else {
        return Some(Visual::Named(called(name)));
    };
    let surface = Surface {
        file: file.to_owned(),
        scale: reader.vector_or(shape, "scale", [1.0; 3])?.into(),
        colour: colour(node),
    };
    Some(Visual::Mesh(reader.origin(node)?, surface))
}

/// The colour of the material of a visual: its own, or that of the robot's material of this name.
fn colour(visual: Node<'_, '_>) -> Option<[f64; 4]> {
    let material = visual.children().find(|child| is(*child, "material"))?;
    let own = |material: Node<'_, '_>| {
        let colour = material.children().find(|child| is(*child, "color"))?;
        let shares = colour.attribute("rgba")?.split_whitespace();
        let shares: Vec<f64> = shares.map_while(|word| word.parse().ok()).collect();
        let shares: [f64; 4] = shares.try_into().ok()?;
        let are_shares = shares.iter().all(|share| (0.0..=1.0).contains(share));
        are_shares.then_some(shares)
    };
    own(material).or_else(|| {
        let name = material.attribute("name")?;
        let robot = visual.document().root_element();
        let mut all = robot.descendants().filter(|node| is(*node, "material"));
        all.find_map(|other| own(other).filter(|_| other.attribute("name") == Some(name)))
    })
}

/// A length that must be there, and is not negative.
fn length(reader: &mut Reader<'_>, node: Node<'_, '_>, name: &str) -> Option<f64> {
    reader.text(node, name)?;
    reader.size(node, name)
}

/// A name in a line.
fn called(name: &str) -> String {
    name.replace(char::is_whitespace, " ")
}

impl Surface {
    /// The file without its folders.
    pub(crate) fn name(&self) -> String {
        let name = self.file.rsplit(['/', '\\']).next();
        called(name.unwrap_or(&self.file))
    }

    /// The mesh on a body, or on the ground, with its frame in theirs.
    pub(crate) fn on(&self, body: Option<usize>, frame: &Frame) -> Mesh {
        Mesh {
            file: self.file.clone(),
            scale: self.scale,
            body,
            origin: clean(frame.origin),
            orientation: euler_parameters(&frame.rotation).map(number),
            colour: self.colour,
        }
    }
}

impl Solid {
    /// The shape on its body, whose axes have the first rotation. Its own frame is `within` that of
    /// the body's first link, and `global` in global axes.
    pub(crate) fn on_body(&self, within: &Frame, global: &Frame) -> Shape {
        let along = |axis: Vector3<f64>, length: f64| {
            let half = global.rotation * axis * (0.5 * length);
            [global.origin - half, global.origin + half].map(clean)
        };
        let at = clean(global.origin);
        match *self {
            Self::Box(size) if within.rotation == Frame::IDENTITY.rotation => Shape::Block {
                size: size.into(),
                at,
            },
            Self::Box(size) => {
                let [from, to] = along(Vector3::x(), size.x);
                Shape::Bar {
                    width: size.y,
                    height: size.z,
                    from,
                    to,
                    up: clean(global.rotation * Vector3::z()),
                }
            }
            Self::Cylinder { radius, length } => {
                let [from, to] = along(Vector3::z(), length);
                Shape::Cylinder { radius, from, to }
            }
            Self::Sphere { radius } => Shape::Ball { radius, at },
        }
    }
}
