//! A film as glTF, for Blender, three.js, game engines and slides.
//!
//! One node a body, moved by an animation. Bodies look like their shapes, or like bars between the
//! points of their joints. A named point is an empty node of its body, or of the scene. glTF has y
//! up: the scene is turned so that gravity points down there.

use std::collections::BTreeMap;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gltf_json::accessor::{ComponentType, GenericComponentType, Type};
use gltf_json::animation::{Channel, Interpolation, Property, Sampler, Target};
use gltf_json::material::{PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::scene::{Node, Scene, UnitQuaternion as Turn};
use gltf_json::validation::{Checked::Valid, USize64};
use gltf_json::{Accessor, Animation, Buffer, Extras, Index, Material, Mesh, Root, buffer};
use holonom::nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};

use crate::page::{self, Shape};
use crate::solid::Surface;
use crate::subject::{GROUND, Subject, colour};

/// The thickness of a bar, over the size of the mechanism.
const THIN: f64 = 0.018;

/// The text of a file; numbers are in it.
pub(crate) fn gltf(
    subject: &Subject<'_>,
    (shapes, meshes): (&[Shape], &[page::Mesh]),
    names: &[&str],
) -> Result<String, serde_json::Error> {
    let mut file = File::default();
    let size = subject.size();
    let bodies: Vec<Index<Node>> = (0..subject.bodies)
        .map(|body| {
            let own = of_body(subject, (shapes, meshes), body, size);
            let mesh = file.mesh(&own, names[body]);
            file.root.push(Node {
                mesh: Some(mesh),
                name: Some(names[body].into()),
                ..Node::default()
            })
        })
        .collect();
    for (body, node) in bodies.iter().enumerate() {
        let points = file.points(subject, Some(body));
        file.root.nodes[node.value()].children = points;
    }
    file.animate(subject, &bodies);
    let mut ground = file.points(subject, None).unwrap_or_default();
    let root = drawn(meshes, None, GROUND);
    if !root.is_empty() {
        let mesh = file.mesh(&root, "ground");
        ground.push(file.root.push(Node {
            mesh: Some(mesh),
            name: Some("ground".into()),
            ..Node::default()
        }));
    }
    let up = Vector3::from(subject.gravity)
        .try_normalize(0.0)
        .map_or(Vector3::z(), |down| -down);
    let turn = UnitQuaternion::rotation_between(&up, &Vector3::y());
    let turn = turn.unwrap_or_else(|| {
        UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
    });
    let whole = file.root.push(Node {
        children: Some([bodies, ground].concat()),
        name: Some(subject.title.into()),
        rotation: Some(Turn(turn.coords.map(|e| e as f32).into())),
        ..Node::default()
    });
    let scene = file.root.push(Scene {
        extensions: None,
        extras: Extras::default(),
        name: None,
        nodes: vec![whole],
    });
    file.root.scene = Some(scene);
    file.root.asset.generator = Some("holonom-film".into());
    file.finished()
}

/// The surfaces of a body by their colours, in its axes.
fn of_body<'a>(
    subject: &Subject<'_>,
    (shapes, meshes): (&[Shape], &'a [page::Mesh]),
    body: usize,
    size: f64,
) -> Vec<(Surface, &'a str)> {
    let mut own = drawn(meshes, Some(body), colour(body));
    let has_shapes = shapes.iter().any(|shape| shape.body == body);
    if has_shapes || own.is_empty() {
        own.push((surface(subject, shapes, body, size), colour(body)));
    }
    own
}

/// The meshes of a body, or of the ground, by their colours.
fn drawn<'a>(
    meshes: &'a [page::Mesh],
    body: Option<usize>,
    colour: &'a str,
) -> Vec<(Surface, &'a str)> {
    let own = meshes.iter().filter(|mesh| mesh.body == body);
    let surfaces = own.map(|mesh| {
        let step = |k: usize, at: u16| {
            let part = f32::from(at) / f32::from(u16::MAX);
            mesh.low[k] + part * (mesh.high[k] - mesh.low[k])
        };
        let corners = mesh.corners.0.chunks_exact(3);
        let corners = corners.map(|at| Vector3::from([0, 1, 2].map(|k| step(k, at[k]))));
        let corners: Vec<_> = corners.collect();
        let faces = mesh.faces.0.chunks_exact(3);
        let faces = faces.map(|face| [0, 1, 2].map(|k| corners[usize::from(face[k])]));
        (
            Surface::flat(faces),
            mesh.colour.as_deref().unwrap_or(colour),
        )
    });
    surfaces.collect()
}

/// What a body without meshes looks like, in its axes.
fn surface(subject: &Subject<'_>, shapes: &[Shape], body: usize, size: f64) -> Surface {
    let mut surface = Surface::default();
    let own: Vec<&Shape> = shapes.iter().filter(|shape| shape.body == body).collect();
    for shape in &own {
        let [long, wide, narrow] = shape.sizes.map(|size| size as f32);
        let solid = match shape.kind {
            "cylinder" => Surface::tube(long, wide, 0.0),
            "tube" => Surface::tube(long, wide, narrow),
            "cone" => Surface::cone(long, wide),
            "block" => Surface::block([long, wide, narrow]),
            _ => Surface::ball(long),
        };
        let [w, i, j, k] = shape.axes.map(|e| e as f32);
        let turn = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k));
        let place = Translation3::from(Vector3::from(shape.centre.map(|x| x as f32)));
        surface.add(&solid, &Isometry3::from_parts(place, turn));
    }
    if own.is_empty() {
        let radius = (THIN * size) as f32;
        for [from, to] in subject.bars(body) {
            let [from, to] = [from, to].map(|end| end.map(|x| x as f32));
            let along = to - from;
            let turn = UnitQuaternion::rotation_between(&Vector3::x(), &along);
            let turn = turn.unwrap_or_else(|| {
                UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f32::consts::PI)
            });
            let middle = Translation3::from(0.5 * (from + to));
            surface.add(
                &Surface::tube(along.norm(), radius, 0.0),
                &Isometry3::from_parts(middle, turn),
            );
        }
        surface.add(&Surface::ball(1.6 * radius), &Isometry3::identity());
    }
    surface
}

/// A file that is being written, and the numbers that it refers to.
#[derive(Default)]
struct File {
    root: Root,
    numbers: Vec<u8>,
}

impl File {
    /// Empty nodes for the named points of a body; none where it has none.
    fn points(&mut self, subject: &Subject<'_>, body: Option<usize>) -> Option<Vec<Index<Node>>> {
        let own = subject.points.iter().filter(|point| point.body == body);
        let nodes = own.map(|point| {
            self.root.push(Node {
                name: Some(point.name.clone()),
                translation: Some(point.at.map(|x| x as f32)),
                ..Node::default()
            })
        });
        let nodes: Vec<_> = nodes.collect();
        (!nodes.is_empty()).then_some(nodes)
    }

    /// Numbers, `width` of them a row.
    fn accessor(&mut self, rows: &[f32], width: usize, bounded: bool) -> Index<Accessor> {
        let start = self.numbers.len();
        for number in rows {
            self.numbers.extend(number.to_le_bytes());
        }
        let view = self.root.push(buffer::View {
            buffer: Index::new(0),
            byte_length: USize64::from(self.numbers.len() - start),
            byte_offset: Some(USize64::from(start)),
            byte_stride: None,
            name: None,
            target: None,
            extensions: None,
            extras: Extras::default(),
        });
        let bound = |of: fn(f32, f32) -> f32| {
            let least: Vec<f32> = (0..width)
                .map(|k| {
                    rows[k..]
                        .iter()
                        .step_by(width)
                        .copied()
                        .reduce(of)
                        .unwrap_or(0.0)
                })
                .collect();
            bounded.then(|| gltf_json::Value::from(least))
        };
        let (min, max) = (bound(f32::min), bound(f32::max));
        self.root.push(Accessor {
            buffer_view: Some(view),
            byte_offset: None,
            count: USize64::from(rows.len() / width),
            component_type: Valid(GenericComponentType(ComponentType::F32)),
            extensions: None,
            extras: Extras::default(),
            type_: Valid(match width {
                1 => Type::Scalar,
                3 => Type::Vec3,
                _ => Type::Vec4,
            }),
            min,
            max,
            name: None,
            normalized: false,
            sparse: None,
        })
    }

    fn mesh(&mut self, surfaces: &[(Surface, &str)], name: &str) -> Index<Mesh> {
        let primitives = surfaces
            .iter()
            .map(|(surface, colour)| self.primitive(surface, colour, name));
        let primitives = primitives.collect();
        self.root.push(Mesh {
            extensions: None,
            extras: Extras::default(),
            name: Some(name.into()),
            primitives,
            weights: None,
        })
    }

    fn primitive(&mut self, surface: &Surface, colour: &str, name: &str) -> Primitive {
        let flat = |vectors: &[Vector3<f32>]| {
            vectors
                .iter()
                .flat_map(|v| [v.x, v.y, v.z])
                .collect::<Vec<_>>()
        };
        let points = self.accessor(&flat(&surface.points), 3, true);
        let normals = self.accessor(&flat(&surface.normals), 3, false);
        let material = self.root.push(Material {
            name: Some(name.into()),
            pbr_metallic_roughness: PbrMetallicRoughness {
                base_color_factor: PbrBaseColorFactor(linear(colour)),
                metallic_factor: StrengthFactor(0.2),
                roughness_factor: StrengthFactor(0.5),
                ..PbrMetallicRoughness::default()
            },
            ..Material::default()
        });
        Primitive {
            attributes: BTreeMap::from([
                (Valid(Semantic::Positions), points),
                (Valid(Semantic::Normals), normals),
            ]),
            extensions: None,
            extras: Extras::default(),
            indices: None,
            material: Some(material),
            mode: Valid(Mode::Triangles),
            targets: None,
        }
    }

    /// Positions and orientations over time.
    fn animate(&mut self, subject: &Subject<'_>, bodies: &[Index<Node>]) {
        let start = subject.times.first().copied().unwrap_or(0.0);
        let times: Vec<f32> = subject
            .times
            .iter()
            .map(|time| (time - start) as f32)
            .collect();
        let input = self.accessor(&times, 1, true);
        let (mut channels, mut samplers) = (Vec::new(), Vec::new());
        for (body, &node) in bodies.iter().enumerate() {
            let poses = subject
                .poses
                .chunks(7 * subject.bodies)
                .map(|frame| &frame[7 * body..7 * body + 7]);
            let places: Vec<f32> = poses
                .clone()
                .flat_map(|pose| [pose[0], pose[1], pose[2]])
                .collect();
            // Of either sign: the nearer one, so that what lies between turns the short way.
            let mut turns: Vec<f32> = Vec::new();
            for pose in poses {
                let turn = [pose[4], pose[5], pose[6], pose[3]];
                let before = turns.len().checked_sub(4).map(|last| &turns[last..]);
                let product = before.map_or(1.0, |before| {
                    before.iter().zip(turn).map(|(a, b)| a * b).sum()
                });
                turns.extend(turn.map(|e| if product < 0.0_f32 { -e } else { e }));
            }
            for (path, rows, width) in [
                (Property::Translation, places, 3),
                (Property::Rotation, turns, 4),
            ] {
                let output = self.accessor(&rows, width, false);
                let sampler = Index::push(
                    &mut samplers,
                    Sampler {
                        extensions: None,
                        extras: Extras::default(),
                        input,
                        interpolation: Valid(Interpolation::Linear),
                        output,
                    },
                );
                channels.push(Channel {
                    sampler,
                    target: Target {
                        extensions: None,
                        extras: Extras::default(),
                        node,
                        path: Valid(path),
                    },
                    extensions: None,
                    extras: Extras::default(),
                });
            }
        }
        if !channels.is_empty() {
            self.root.push(Animation {
                extensions: None,
                extras: Extras::default(),
                channels,
                name: Some(subject.title.into()),
                samplers,
            });
        }
    }

    fn finished(mut self) -> Result<String, serde_json::Error> {
        self.root.push(Buffer {
            byte_length: USize64::from(self.numbers.len()),
            name: None,
            uri: Some(format!(
                "data:application/octet-stream;base64,{}",
                STANDARD.encode(&self.numbers)
            )),
            extensions: None,
            extras: Extras::default(),
        });
        self.root.to_string()
    }
}

/// A colour such as `#4c8eda` as shares of linear light.
fn linear(colour: &str) -> [f32; 4] {
    let share = |k: usize| {
        let byte = colour
            .get(1 + 2 * k..3 + 2 * k)
            .and_then(|hex| u8::from_str_radix(hex, 16).ok());
        (f32::from(byte.unwrap_or(128)) / 255.0).powf(2.2)
    };
    [share(0), share(1), share(2), 1.0]
}
