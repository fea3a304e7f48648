//! Collada 1.4 and 1.5, as robots have it: triangles and polygons, their nodes, and plain colours.
//!
//! The axis that is named as up is not turned to z, as RViz does not turn it: files of robots have
//! the axes of their links. The unit of the file counts. Skins, splines and textures are left out.
//!
//! Read here because the crates that read all of Collada end the program at files that they do not
//! expect, or have licences that `deny.toml` does not allow.

use std::collections::HashMap;

use holonom::nalgebra::{Matrix4, Rotation3, Unit, Vector3};
use roxmltree::{Document, Node};

use super::part::{Part, colour};

/// Nodes in nodes, at most: a node may name one that it is in.
const DEPTH: usize = 64;

pub(super) fn read(text: &str) -> Result<Vec<Part>, String> {
    let xml = Document::parse(text).map_err(|error| error.to_string())?;
    let named = xml.descendants();
    let named = named.filter_map(|node| Some((node.attribute("id")?, node)));
    let mut file = File {
        named: named.collect(),
        parts: Vec::new(),
    };
    let root = xml.root_element();
    let units = all(root, "asset").flat_map(|asset| all(asset, "unit"));
    let mut units = units.filter_map(|unit| unit.attribute("meter")?.trim().parse().ok());
    let unit = units.find(|metres: &f64| *metres > 0.0 && metres.is_finite());
    let whole = Matrix4::new_scaling(unit.unwrap_or(1.0));
    let scenes = || xml.descendants().filter(|node| is(*node, "visual_scene"));
    let shown = xml
        .descendants()
        .filter(|node| is(*node, "instance_visual_scene"));
    let shown = shown.filter_map(|node| file.target(node, "url")).next();
    match shown.or_else(|| scenes().next()) {
        Some(scene) => {
            for node in all(scene, "node") {
                file.node(node, &whole, DEPTH);
            }
        }
        None => {
            for geometry in xml.descendants().filter(|node| is(*node, "geometry")) {
                file.geometry(geometry, None, &whole);
            }
        }
    }
    Ok(file.parts)
}

fn is(node: Node<'_, '_>, name: &str) -> bool {
    node.is_element() && node.tag_name().name() == name
}

/// Child elements of a name.
fn all<'n, 'i>(node: Node<'n, 'i>, name: &str) -> impl Iterator<Item = Node<'n, 'i>> {
    node.children().filter(move |child| is(*child, name))
}

fn numbers<T: std::str::FromStr>(node: Node<'_, '_>) -> Vec<T> {
    let words = node.text().unwrap_or_default().split_ascii_whitespace();
    words.map_while(|word| word.parse().ok()).collect()
}

struct File<'n, 'i> {
    /// Elements by their `id`.
    named: HashMap<&'n str, Node<'n, 'i>>,
    parts: Vec<Part>,
}

impl<'n, 'i> File<'n, 'i> {
    /// The element that an attribute such as `#id` names.
    fn target(&self, node: Node<'n, 'i>, attribute: &str) -> Option<Node<'n, 'i>> {
        let name = node.attribute(attribute)?.trim().strip_prefix('#')?;
        self.named.get(name).copied()
    }

    /// A node of the scene, in the frame of the one that it is in.
    fn node(&mut self, node: Node<'n, 'i>, outer: &Matrix4<f64>, depth: usize) {
        let Some(depth) = depth.checked_sub(1) else {
            return;
        };
        let steps = node.children().filter(Node::is_element).filter_map(step);
        let place = steps.fold(*outer, |place, step| place * step);
        for child in node.children().filter(Node::is_element) {
            match (child.tag_name().name(), self.target(child, "url")) {
                ("node", _) => self.node(child, &place, depth),
                ("instance_node", Some(other)) => self.node(other, &place, depth),
                ("instance_geometry", Some(geometry)) => {
                    self.geometry(geometry, Some(child), &place);
                }
                _ => {}
            }
        }
    }

    /// The meshes of a geometry, whose materials the element that shows it names.
    fn geometry(
        &mut self,
        geometry: Node<'n, 'i>,
        shown: Option<Node<'n, 'i>>,
        place: &Matrix4<f64>,
    ) {
        for mesh in all(geometry, "mesh") {
            for primitive in mesh.children().filter(Node::is_element) {
                if let Some(mut part) = self.primitive(primitive) {
                    part.colour = self.colour(primitive, shown);
                    part.transform(place);
                    self.parts.push(part);
                }
            }
        }
    }

    /// Points and triangles; nothing of what is no surface.
    fn primitive(&self, primitive: Node<'n, 'i>) -> Option<Part> {
        let offset = |input: &Node<'_, '_>| {
            let text = input.attribute("offset").unwrap_or("0");
            text.trim().parse::<usize>().ok()
        };
        let inputs: Vec<_> = all(primitive, "input").collect();
        let stride = inputs.iter().filter_map(offset).max()? + 1;
        let semantic = |input: &&Node<'_, '_>| input.attribute("semantic") == Some("VERTEX");
        let vertex = inputs.iter().find(semantic)?;
        let first = offset(vertex)?;
        let corners = |list: Node<'_, '_>| -> Vec<u32> {
            numbers(list)
                .into_iter()
                .skip(first)
                .step_by(stride)
                .collect()
        };
        let lists = all(primitive, "p").map(corners);
        let polygons: Vec<Vec<u32>> = match primitive.tag_name().name() {
            "triangles" => lists.flat_map(|list| split(&list, |_| 3)).collect(),
            "polylist" => {
                let counts: Vec<usize> = all(primitive, "vcount").flat_map(numbers).collect();
                let count = |k: usize| counts.get(k).copied().unwrap_or(usize::MAX);
                lists.flat_map(|list| split(&list, count)).collect()
            }
            // A hole in a polygon is closed.
            "polygons" => {
                let holed = all(primitive, "ph").flat_map(|holed| all(holed, "p"));
                lists.chain(holed.map(corners)).collect()
            }
            "trifans" => lists.collect(),
            "tristrips" => lists.flat_map(|list| strip(&list)).collect(),
            _ => return None,
        };
        // Convex, as they nearly always are.
        let fan = |polygon: &Vec<u32>| -> Vec<[u32; 3]> {
            let edges = polygon.get(1..).unwrap_or_default().windows(2);
            edges.map(|edge| [polygon[0], edge[0], edge[1]]).collect()
        };
        Some(Part {
            colour: None,
            points: self.points(*vertex)?,
            faces: polygons.iter().flat_map(fan).collect(),
        })
    }

    /// The points of the vertices that an input names.
    fn points(&self, input: Node<'n, 'i>) -> Option<Vec<Vector3<f64>>> {
        let vertices = self.target(input, "source")?;
        let mut inputs = all(vertices, "input");
        let position = inputs.find(|input| input.attribute("semantic") == Some("POSITION"))?;
        let source = self.target(position, "source")?;
        let values: Vec<f64> = numbers(all(source, "float_array").next()?);
        let accessor = source.descendants().find(|node| is(*node, "accessor"));
        let number =
            |name: &str| -> Option<usize> { accessor?.attribute(name)?.trim().parse().ok() };
        let stride = number("stride").unwrap_or(3).max(3);
        let rows = values.get(number("offset").unwrap_or(0)..)?.chunks(stride);
        let rows = rows.filter(|row| row.len() >= 3);
        Some(
            rows.map(|row| Vector3::new(row[0], row[1], row[2]))
                .collect(),
        )
    }

    /// The plain colour of a primitive's material.
    fn colour(&self, primitive: Node<'n, 'i>, shown: Option<Node<'n, 'i>>) -> Option<String> {
        let symbol = primitive.attribute("material")?;
        let mut bound = shown?
            .descendants()
            .filter(|node| is(*node, "instance_material"));
        let material = bound.find(|node| node.attribute("symbol") == Some(symbol));
        let material = self.target(material?, "target")?;
        let effect = self.target(all(material, "instance_effect").next()?, "url")?;
        let diffuse = effect.descendants().find(|node| is(*node, "diffuse"))?;
        match numbers::<f64>(all(diffuse, "color").next()?)[..] {
            [red, green, blue, ..] => Some(colour([red, green, blue])),
            _ => None,
        }
    }
}

/// A list in pieces, of which the k-th has so many corners. A piece that is cut off is left out.
fn split(list: &[u32], count: impl Fn(usize) -> usize) -> Vec<Vec<u32>> {
    let (mut pieces, mut rest) = (Vec::new(), list);
    while let Some((piece, behind)) = rest.split_at_checked(count(pieces.len()).max(1)) {
        if piece.is_empty() || rest.is_empty() {
            break;
        }
        pieces.push(piece.to_vec());
        rest = behind;
    }
    pieces
}

/// Triangles of a strip, every second one turned.
fn strip(list: &[u32]) -> Vec<Vec<u32>> {
    let triangles = list.windows(3).enumerate();
    let turned = triangles.map(|(k, face)| match k % 2 {
        0 => face.to_vec(),
        _ => vec![face[1], face[0], face[2]],
    });
    turned.collect()
}

/// A transformation of a node. What else is in a node is none.
fn step(node: Node<'_, '_>) -> Option<Matrix4<f64>> {
    let values: Vec<f64> = numbers(node);
    match (node.tag_name().name(), &values[..]) {
        ("matrix", rows) if rows.len() == 16 => Some(Matrix4::from_row_slice(rows)),
        ("translate", &[x, y, z]) => Some(Matrix4::new_translation(&Vector3::new(x, y, z))),
        ("scale", &[x, y, z]) => Some(Matrix4::new_nonuniform_scaling(&Vector3::new(x, y, z))),
        ("rotate", &[x, y, z, degrees]) => {
            let axis = Unit::try_new(Vector3::new(x, y, z), 0.0)?;
            Some(Rotation3::from_axis_angle(&axis, degrees.to_radians()).to_homogeneous())
        }
        _ => None,
    }
}
