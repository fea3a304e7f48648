//! What links look like: primitives, which become shapes, and what has only a name.

use nalgebra::Vector3;
use roxmltree::Node;

use crate::elements::{Reader, is};
use crate::mechanism::Shape;
use crate::spatial::{Frame, clean};

/// A `<visual>`.
#[derive(Debug)]
pub(crate) enum Visual {
    /// A primitive, with the frame of its centre in that of the link.
    Solid(Frame, Solid),
    /// A mesh, or another geometry: what it is called.
    Named(String),
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
    match solid {
        Some(solid) => Some(Visual::Solid(reader.origin(node)?, solid)),
        None => Some(Visual::Named(called(shape))),
    }
}

/// A length that must be there, and is not negative.
fn length(reader: &mut Reader<'_>, node: Node<'_, '_>, name: &str) -> Option<f64> {
    reader.text(node, name)?;
    reader.size(node, name)
}

/// The file of a mesh without its folders; the element otherwise.
fn called(shape: Node<'_, '_>) -> String {
    let file = shape.attribute("filename");
    let file = file.map(|path| path.rsplit(['/', '\\']).next().unwrap_or(path));
    file.unwrap_or(shape.tag_name().name())
        .replace(char::is_whitespace, " ")
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
