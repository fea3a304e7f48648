//! What can be read of joints and forces at a state.

use crate::model::joint::Turn;
use crate::model::mechanism::Counter;
use crate::model::{BodyKind, Model, ParameterKind};
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::equations::{Kernel, with_scene};
use crate::symbolic::expression::VectorExpr;
use crate::symbolic::fixed::{point_on, triple};
use crate::symbolic::motion::Gradient;
use crate::symbolic::scene::Scene;
use crate::symbolic::start::on_body;
use crate::symbolic::vector::{Frame, Triple, VectorId};

/// Kernels of what can be read, by the place of joint or force.
#[derive(Clone, Debug)]
pub struct Readouts {
    /// Cosine, sine and rate of the angle of each joint that has one, and the auxiliary variable
    /// that counts its turns.
    pub angles: Vec<(usize, Kernel)>,
    /// Cosine, sine and rate of both angles of each joint that has two.
    pub two_angles: Vec<(usize, Kernel)>,
    /// Value and rate of the displacement of each joint that has one.
    pub displacements: Vec<(usize, Kernel)>,
    /// Point, normal and slip of each joint that has a contact, in global axes.
    pub contacts: Vec<(usize, Kernel)>,
    /// What is positive on the side that is meant, of each joint that says so.
    pub sides: Vec<(usize, Kernel)>,
    /// The reaction point of each joint on each of its bodies.
    pub points: Vec<(usize, usize, Kernel)>,
    /// The points and directions that joints and forces name, on each of their bodies.
    pub markers: Vec<Marker>,
    /// The components of each named point, as those of a marker.
    pub named_points: Vec<Kernel>,
    /// The sizes of each shape, body by body.
    pub shapes: Vec<Kernel>,
    /// The potential energy of each force, and the power of what it does besides.
    pub energies: Vec<Kernel>,
    /// The force (global axes) and the moment about the centre of mass (principal axes) of each
    /// force on each of its bodies.
    pub loads: Vec<(usize, usize, Kernel)>,
}

/// A point or direction that an element names, fixed on one of its bodies.
#[derive(Clone, Debug)]
pub struct Marker {
    /// The place of the joint, or behind the joints that of the force.
    pub element: usize,
    /// The place of the body in `between`.
    pub place: usize,
    /// The place of the parameter in the definition.
    pub parameter: usize,
    /// Its components in principal axes, a point from the centre of mass; global on the ground.
    pub components: Kernel,
}

impl Readouts {
    /// All kernels of a model.
    #[must_use]
    pub fn new(scene: &Scene, model: &Model) -> Self {
        Self {
            angles: angles(scene, model),
            two_angles: two_angles(scene, model),
            displacements: displacements(scene, model),
            contacts: contacts(scene, model),
            sides: sides(scene, model),
            points: points(scene, model),
            markers: markers(scene, model),
            named_points: named_points(scene, model),
            shapes: shapes(scene, model),
            energies: (0..model.forces.len())
                .map(|force| with_scene(scene, |scene| scene.energy_and_power(force).into()))
                .collect(),
            loads: loads(scene, model),
        }
    }
}

/// The angle of the second body against the first: with axis `a` and normals `n1`, `n2` on either
/// body, `cosine = n1(i) . n1(j)`, `sine = n2(i) . n1(j)`, rate `a(i) . (w(j) - w(i))`.
fn angles(scene: &Scene, model: &Model) -> Vec<(usize, Kernel)> {
    let mut angles = Vec::new();
    for (place, joint) in model.joints.iter().enumerate() {
        let Some(angle) = model.definition(joint).angle else {
            continue;
        };
        let kernel = with_scene(scene, |scene| {
            let copies = scene.copies[place][angle.axis].clone();
            let copies = copies.expect("the axis of an angle has copies");
            let (i, j) = (joint.bodies[angle.from], joint.bodies[angle.to]);
            let counter = counter_of(scene, model, place, angle);
            let frame = |body: Option<usize>| body.map_or(Frame::Global, Frame::Body);
            let space = &mut scene.space;
            let [n1, n2] = copies.normals[angle.from].map(|n| space.native(frame(i), n));
            let moving = space.native(frame(j), copies.normals[angle.to][0]);
            let axis = space.native(frame(i), copies.vector[angle.from]);
            let spin = |body: Option<usize>| -> Option<VectorId> {
                body.map(|body| scene.motion.spin[body])
            };
            let (cosine, sine) = (space.dot(n1, moving), space.dot(n2, moving));
            let mut rate = Arena::ZERO;
            for (body, sign) in [(j, Arena::ONE), (i, -Arena::ONE)] {
                if let Some(spin) = spin(body) {
                    let along = space.dot(axis, spin);
                    let signed = space.arena.mul(sign, along);
                    rate = space.arena.add(rate, signed);
                }
            }
            let mut outputs = vec![cosine, sine, rate];
            outputs.extend(counter.map(|(counter, sign)| {
                let place = scene.layout.coordinates + counter;
                let counted = space.arena.input(Input::Coordinate(place as u32));
                space.arena.mul(sign, counted)
            }));
            outputs
        });
        angles.push((place, kernel));
    }
    angles
}

/// The angles of the turns about `u` of the first body and `v` of the second, which the first turn
/// carries. With the copies `V` of `v` on the first body and `U` of `u` on the second:
/// `cosine = V . v - (u . V) (u . v)`, `sine = (u x V) . v` of the first, `cosine = u . U - (v . u)
/// (v . U)`, `sine = (v x u) . U` of the second. Rates `a`, `b` are those of the relative angular
/// velocity `w = a u + b v`, with the constant `g = u . V = u . v`: `a = (w . u - g w . v) / (1 -
/// g^2)`, `b` likewise.
fn two_angles(scene: &Scene, model: &Model) -> Vec<(usize, Kernel)> {
    let mut angles = Vec::new();
    for (place, joint) in model.joints.iter().enumerate() {
        let Some(axes) = model.definition(joint).angles else {
            continue;
        };
        let kernel = with_scene(scene, |scene| {
            let bodies = [joint.bodies[0], joint.bodies[1]];
            let mut copy = |of: usize, on: usize| {
                let copies = scene.copies[place][axes[of]].as_ref();
                let vector = copies.expect("the axis of an angle has copies").vector[of];
                let vector = VectorExpr::Fixed(bodies[of], vector);
                let here = on_body(&mut scene.space.arena, model, &vector, bodies[on]);
                let frame = bodies[on].map_or(Frame::Global, Frame::Body);
                scene.space.native(frame, here)
            };
            let [u, v_on_first] = [copy(0, 0), copy(1, 0)];
            let [u_on_second, v] = [copy(0, 1), copy(1, 1)];
            let motion = &scene.motion;
            let space = &mut scene.space;
            let spin = VectorExpr::Spin(bodies).value(space, motion);
            let along = [space.dot(u, spin), space.dot(v, spin)];
            let g = space.dot(u, v_on_first);
            let across = {
                let square = space.arena.square(g);
                let rest = space.arena.sub(Arena::ONE, square);
                space.arena.reciprocal(rest)
            };
            let mut outputs = Vec::new();
            let turns = [(u, v_on_first, v), (v, u, u_on_second)];
            for (k, (axis, from, to)) in turns.into_iter().enumerate() {
                let whole = space.dot(from, to);
                let beside = [space.dot(axis, from), space.dot(axis, to)];
                let arena = &mut space.arena;
                let beside = arena.mul(beside[0], beside[1]);
                let cosine = arena.sub(whole, beside);
                let normal = space.cross(Frame::Global, axis, from);
                let sine = space.dot(normal, to);
                let arena = &mut space.arena;
                let shared = arena.mul(g, along[1 - k]);
                let rate = arena.sub(along[k], shared);
                let rate = arena.mul(rate, across);
                outputs.extend([cosine, sine, rate]);
            }
            outputs
        });
        angles.push((place, kernel));
    }
    angles
}

/// The auxiliary variable that counts the angle of a joint, and its sign: its own, or that of
/// another joint or force between the same bodies about the same axis, such as a spring on a hinge.
fn counter_of(
    scene: &mut Scene,
    model: &Model,
    joint: usize,
    angle: Turn,
) -> Option<(usize, Expr)> {
    let counters = model.counters();
    let own = Counter {
        element: joint,
        turn: angle,
    };
    if let Some(counter) = counters.iter().position(|known| *known == own) {
        return Some((counter, Arena::ONE));
    }
    let sides = |element: usize, turn: Turn| {
        let bodies = &model.elements().nth(element)?.bodies;
        let copies = scene.copies[element][turn.axis].as_ref()?;
        let side = |place: usize| (bodies[place], copies.vector[place]);
        Some([side(turn.from), side(turn.to)])
    };
    let of_joint = sides(joint, angle)?;
    let negated = |scene: &mut Scene, sides: [(Option<usize>, Triple); 2]| {
        sides.map(|(body, axis)| {
            let arena = &mut scene.space.arena;
            (body, axis.map(|x| arena.mul(-Arena::ONE, x)))
        })
    };
    let others: Vec<_> = { counters.iter() }
        .map(|counter| sides(counter.element, counter.turn))
        .collect();
    others.into_iter().enumerate().find_map(|(place, other)| {
        let [from, to] = other?;
        // Against each other the other way round, or about the other axis, it is minus the angle.
        let back = negated(scene, of_joint);
        let sign = if [from, to] == of_joint || [to, from] == back {
            Arena::ONE
        } else if [to, from] == of_joint || [from, to] == back {
            -Arena::ONE
        } else {
            return None;
        };
        Some((place, sign))
    })
}

fn points(scene: &Scene, model: &Model) -> Vec<(usize, usize, Kernel)> {
    let mut points = Vec::new();
    for (place, joint) in model.joints.iter().enumerate() {
        let Some(parameter) = model.definition(joint).reaction_point() else {
            continue;
        };
        for body in 0..joint.bodies.len() {
            let kernel = with_scene(scene, |scene| {
                let copies = scene.copies[place][parameter].as_ref();
                copies.expect("a point has copies").vector[body].into()
            });
            points.push((place, body, kernel));
        }
    }
    points
}

fn markers(scene: &Scene, model: &Model) -> Vec<Marker> {
    let mut markers = Vec::new();
    let elements = model.joints.iter().chain(&model.forces);
    for ((element, of), parameters) in elements.enumerate().zip(&scene.copies) {
        let definition = model.definition(of);
        for (parameter, copies) in parameters.iter().enumerate() {
            // A spring has one end on each body: its other end is no point of that body.
            let is_point = definition.parameters[parameter].kind == ParameterKind::Point;
            let bodies = definition.bodies_of(parameter);
            let vectors = copies
                .iter()
                .flat_map(|copies| copies.vector.iter().enumerate());
            let used = vectors.filter(|(place, _)| !is_point || bodies.contains(place));
            markers.extend(used.map(|(place, &vector)| Marker {
                element,
                place,
                parameter,
                components: with_scene(scene, |_| vector.into()),
            }));
        }
    }
    markers
}

fn named_points(scene: &Scene, model: &Model) -> Vec<Kernel> {
    let points = model.points.iter();
    points
        .map(|point| {
            with_scene(scene, |scene| {
                point_on(&mut scene.space.arena, model, point.body, point.position).into()
            })
        })
        .collect()
}

fn shapes(scene: &Scene, model: &Model) -> Vec<Kernel> {
    let shapes = model.bodies.iter().flat_map(|body| &body.shapes);
    shapes
        .map(|shape| {
            with_scene(scene, |scene| {
                triple(&mut scene.space.arena, shape.sizes).into()
            })
        })
        .collect()
}

fn displacements(scene: &Scene, model: &Model) -> Vec<(usize, Kernel)> {
    let with = (0..model.joints.len()).filter(|&joint| {
        model
            .definition(&model.joints[joint])
            .displacement
            .is_some()
    });
    with.map(|joint| {
        let kernel = with_scene(scene, |scene| {
            let displacement = scene.displacements[joint].clone();
            let displacement = displacement.expect("its definition has a displacement");
            let (space, motion) = (&mut scene.space, &scene.motion);
            vec![
                displacement.value(space, motion),
                displacement.rate(space, motion),
            ]
        });
        (joint, kernel)
    })
    .collect()
}

fn contacts(scene: &Scene, model: &Model) -> Vec<(usize, Kernel)> {
    let with = (0..model.joints.len())
        .filter(|&joint| model.definition(&model.joints[joint]).contact.is_some());
    with.map(|joint| {
        let kernel = with_scene(scene, |scene| {
            let contact = scene.contact(model, joint);
            let (space, motion) = (&mut scene.space, &scene.motion);
            let vectors = contact.iter().flat_map(|vector| {
                let vector = vector.value(space, motion);
                space.components(vector, Frame::Global)
            });
            vectors.collect()
        });
        (joint, kernel)
    })
    .collect()
}

fn sides(scene: &Scene, model: &Model) -> Vec<(usize, Kernel)> {
    let says = |joint: &usize| {
        let definition = model.definition(&model.joints[*joint]);
        !definition.requirements.is_empty()
    };
    let with = (0..model.joints.len()).filter(says);
    with.map(|joint| {
        let kernel = with_scene(scene, |scene| {
            let sides = scene.sides(model, joint);
            let (space, motion) = (&mut scene.space, &scene.motion);
            let values = sides.iter().map(|side| side.value(space, motion));
            values.collect()
        });
        (joint, kernel)
    })
    .collect()
}

fn loads(scene: &Scene, model: &Model) -> Vec<(usize, usize, Kernel)> {
    let mut loads = Vec::new();
    for (place, force) in model.forces.iter().enumerate() {
        for (at, body) in force.bodies.iter().enumerate() {
            let Some(body) = *body else { continue };
            let kernel = with_scene(scene, |scene| {
                let mut gradient = Gradient::default();
                scene.add_effects(place, &mut gradient);
                let space = &mut scene.space;
                let force = gradient.force(space, body);
                let mut load: Vec<_> = space.components(force, Frame::Global).into();
                if model.bodies[body].kind == BodyKind::Rigid {
                    let moment = gradient.moment(space, body);
                    load.extend(space.components(moment, Frame::Body(body)));
                }
                load.resize(6, Arena::ZERO);
                load
            });
            loads.push((place, at, kernel));
        }
    }
    loads
}
