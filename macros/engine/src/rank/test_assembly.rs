//! How a definition says that its joint moves, against its equations, where the definition stands.
//!
//! Two free bodies are given the joint, with points, axes and numbers that its equations hold for.
//! Which do is tried; where none of these do, nothing can be said: only a mechanism can tell.

use proc_macro2::{Ident, TokenStream};

use super::moves;
use super::random::Random;
use crate::model::inertia::{IDENTITY, rotation};
use crate::model::{
    Binding, Body, BodyKind, Comparison, Coordinates, Element, ElementDef, Extent, Independence,
    Model, Number, ParameterKind, Term,
};

/// The largest definition that is compared: macros run unoptimised, and every choice of parameters
/// is differentiated.
const LARGEST: f64 = 300.0;

/// What all choices of parameters that can be compared agree in. Nothing can be said where there is
/// none, or where with one of them the motions are those that the equations leave: with the others
/// the joint may be a special case.
#[must_use]
pub fn compare(joint: &ElementDef) -> Comparison {
    if joint.motions.is_none() {
        return Comparison::Undecided;
    }
    let has_law = joint
        .parameters
        .iter()
        .any(|parameter| parameter.kind == ParameterKind::Law);
    let size = joint.extent(&|_, _| Extent::ONE).size;
    if has_law || size > LARGEST {
        return Comparison::Undecided;
    }
    let mut first = None;
    for choice in choices(joint) {
        match moves::compare(&model(joint, choice), 0) {
            Comparison::Agrees => return Comparison::Undecided,
            Comparison::Undecided => {}
            other => first = first.or(Some(other)),
        }
    }
    first.unwrap_or(Comparison::Undecided)
}

/// Parameters of a joint in the reference configuration.
#[derive(Clone, Copy)]
struct Choice {
    axes: Axes,
    points: Points,
    /// Whether the centres of mass are at the first point.
    is_centred: bool,
}

#[derive(Clone, Copy)]
enum Axes {
    /// All of one direction.
    Parallel,
    /// At right angles to each other.
    Frame,
}

#[derive(Clone, Copy)]
enum Points {
    /// Anywhere.
    Apart,
    /// One behind the other along the first axis.
    Along,
    /// The same at a right angle to that axis.
    Across,
    /// All at one place.
    Together,
}

/// The choices that are not the same for a joint.
fn choices(joint: &ElementDef) -> Vec<Choice> {
    let count = |wanted: fn(ParameterKind) -> bool| {
        let parameters = joint.parameters.iter();
        parameters.filter(|p| wanted(p.kind)).count()
    };
    let points = count(|kind| kind == ParameterKind::Point);
    let axes = count(|kind| kind.is_vector() && kind != ParameterKind::Point);
    let axes: &[Axes] = match axes {
        0 | 1 => &[Axes::Parallel],
        _ => &[Axes::Frame, Axes::Parallel],
    };
    let points: &[Points] = match points {
        0 | 1 => &[Points::Apart],
        _ => &[
            Points::Apart,
            Points::Along,
            Points::Across,
            Points::Together,
        ],
    };
    let speaks_of_centres = joint
        .terms()
        .any(|term| term.has(|term| matches!(term, Term::Origin(_))));
    let centred: &[bool] = if speaks_of_centres {
        &[false, true]
    } else {
        &[false]
    };
    let mut choices = Vec::new();
    for &is_centred in centred {
        for &points in points {
            for &axes in axes {
                choices.push(Choice {
                    axes,
                    points,
                    is_centred,
                });
            }
        }
    }
    choices
}

/// Two free bodies and the joint.
fn model(joint: &ElementDef, choice: Choice) -> Model {
    let mut random = Random::new();
    let frame = rotation(unit(&mut random));
    let first = vector(&mut random);
    let (mut points, mut axes) = (0, 0);
    let mut bindings = Vec::new();
    for parameter in &joint.parameters {
        let binding = match parameter.kind {
            ParameterKind::Point => {
                let place = f64::from(points);
                points += 1;
                let ahead = |axis: usize| [0, 1, 2].map(|k| first[k] + place * frame[k][axis]);
                global(match choice.points {
                    _ if place == 0.0 => first,
                    Points::Apart => vector(&mut random),
                    Points::Along => ahead(0),
                    Points::Across => ahead(1),
                    Points::Together => first,
                })
            }
            ParameterKind::Axis | ParameterKind::Vector => {
                let place = match choice.axes {
                    Axes::Parallel => 0,
                    Axes::Frame => axes % 3,
                };
                axes += 1;
                global([0, 1, 2].map(|k| frame[k][place]))
            }
            _ if parameter.default.is_some() => Binding::Default,
            _ => Binding::Scalar(Number::ONE),
        };
        bindings.push(binding);
    }
    let bodies = [0, 1].map(|place| {
        let name = &joint.bodies[place];
        let position = vector(&mut random);
        let orientation = unit(&mut random);
        body(
            name,
            if choice.is_centred { first } else { position },
            orientation,
        )
    });
    let used = Element {
        name: joint.name.clone().into(),
        path: TokenStream::new(),
        definition: 0,
        bodies: vec![Some(0), Some(1)],
        bindings,
        dropped: Vec::new(),
        components: Vec::new(),
        is_cut: false,
        read: Vec::new(),
        limits: None,
    };
    Model {
        name: joint.name.clone(),
        gravity: [Number::ZERO; 3],
        bodies: bodies.into(),
        joints: vec![used],
        forces: Vec::new(),
        states: Vec::new(),
        points: Vec::new(),
        parts: Vec::new(),
        constants: Vec::new(),
        lengths: Vec::new(),
        comments: Vec::new(),
        values: Vec::new(),
        definitions: vec![joint.clone()],
        symbols: Vec::new(),
        splines: Vec::new(),
        switches: Vec::new(),
        independence: Independence::default(),
        asked: Vec::new(),
        derived_by: Vec::new(),
        coordinates: Coordinates::Bodies,
    }
}

fn body(name: &Ident, position: [f64; 3], orientation: [f64; 4]) -> Body {
    Body {
        name: name.clone().into(),
        kind: BodyKind::Rigid,
        mass: Number::ONE,
        inertia: [Number::ONE; 3],
        user_axes: IDENTITY,
        position: position.map(Number::Literal),
        orientation: orientation.map(Number::Literal),
        velocity: [Number::ZERO; 3],
        angular_velocity: [Number::ZERO; 3],
        free: true,
        as_given: false,
        shapes: Vec::new(),
    }
}

fn global(vector: [f64; 3]) -> Binding {
    Binding::Global(vector.map(Number::Literal))
}

fn vector(random: &mut Random) -> [f64; 3] {
    [0; 3].map(|_| random.number())
}

/// Euler parameters of a random rotation.
fn unit(random: &mut Random) -> [f64; 4] {
    let p = [0; 4].map(|_| random.number());
    let length = p.iter().map(|e| e * e).sum::<f64>().sqrt();
    if length > 0.1 {
        p.map(|e| e / length)
    } else {
        IDENTITY
    }
}
