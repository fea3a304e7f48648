//! What a mechanism has, by name: from its report, and from the comments of its description.

use holonom::independent::Motion;
use holonom::mechanism::{Freedom, JointReport};
use holonom::{JointCoordinates, JointHandle, Mechanism};

use crate::exposed::{Analysed, Exposed};

/// What a run-time value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Given on construction.
    Parameter,
    /// May change in a run.
    Input,
    /// Where a state of the user's own starts.
    Start,
}

/// A run-time value: a field that is a number, or several.
#[derive(Clone, Debug)]
pub(crate) struct Value {
    /// The field.
    pub(crate) name: &'static str,
    pub(crate) kind: Kind,
    /// Its numbers among the parameters of the mechanism.
    pub(crate) places: Vec<usize>,
    /// Whether it is an array, whatever its length.
    pub(crate) is_array: bool,
}

/// The field of a name, without the number of an element.
pub(crate) fn field(name: &'static str) -> &'static str {
    name.split('[').next().unwrap_or(name)
}

/// All values in the order of the fields. The elements of an array are one value; the derivatives
/// of a setpoint stand behind its value.
pub(crate) fn values<M: Mechanism>() -> Vec<Value> {
    let mut values: Vec<Value> = Vec::new();
    let mut further = M::REPORT.values.len();
    for (place, info) in M::REPORT.values.iter().enumerate() {
        let is_start = M::REPORT.states.iter().any(|state| state.value == place);
        let kind = match (info.is_input, is_start) {
            (true, _) => Kind::Input,
            (false, true) => Kind::Start,
            (false, false) => Kind::Parameter,
        };
        let name = field(info.name);
        let places = std::iter::once(place).chain(further..further + info.further);
        further += info.further;
        match values.last_mut().filter(|last| last.name == name) {
            Some(last) => last.places.extend(places),
            None => values.push(Value {
                name,
                kind,
                places: places.collect(),
                is_array: info.name != name || info.further > 0,
            }),
        }
    }
    values
}

/// The names of the values of a kind.
pub(crate) fn names_of<M: Mechanism>(kind: Kind) -> Vec<&'static str> {
    let values = values::<M>().into_iter();
    let values = values.filter(|value| value.kind == kind);
    values.map(|value| value.name).collect()
}

/// The comment above a field; above the struct where the name is empty.
pub(crate) fn comment<M: Mechanism>(field: &str) -> Option<&'static str> {
    let mut comments = M::COMMENTS.iter();
    let found = comments.find(|comment| comment.field == field);
    found.map(|comment| comment.text)
}

/// The first sentence of a comment, on one line.
pub(crate) fn first_sentence(text: &str) -> String {
    let paragraph = text.split("\n\n").next().unwrap_or(text);
    paragraph.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A coordinate: a joint, and which of its motions.
#[derive(Clone, Debug)]
pub(crate) struct Coordinate {
    /// The joint's field; with `.0`, `.1` where it has several motions.
    pub(crate) name: String,
    joint: usize,
    number: usize,
    pub(crate) is_length: bool,
}

impl Coordinate {
    /// The unit of its position.
    pub(crate) const fn unit(&self) -> &'static str {
        if self.is_length { "m" } else { "rad" }
    }
}

/// The coordinates of a class in their order: those that were named, else all.
pub(crate) fn coordinates<E: Exposed<Mechanism: JointCoordinates>>() -> Vec<Coordinate> {
    let mut found = Vec::new();
    let joints = E::Mechanism::REPORT.joints.iter().enumerate();
    for (joint, info) in joints {
        let motions = E::Mechanism::JOINT_REPORT.motions_of(info.name);
        let freedoms = motions.filter_map(|place| E::Mechanism::JOINT_REPORT.motions.get(place));
        let mut freedoms: Vec<Freedom> = freedoms.map(|motion| motion.freedom).collect();
        // As `Motion::of` counts them: from the first body of the joint.
        let mut carriers = E::Mechanism::REPORT.carriers.iter();
        let carried = carriers.position(|carrier| carrier.joint == Some(joint));
        if carried.is_some() && info.bodies.first() == Some(&carried) {
            freedoms.reverse();
        }
        let several = freedoms.len() > 1;
        for (number, freedom) in freedoms.into_iter().enumerate() {
            let name = if several {
                format!("{}.{number}", info.name)
            } else {
                info.name.to_owned()
            };
            found.push(Coordinate {
                name,
                joint,
                number,
                is_length: freedom == Freedom::Slide,
            });
        }
    }
    if E::CHOSEN.is_empty() {
        return found;
    }
    let chosen = E::CHOSEN.iter();
    let chosen = chosen.filter_map(|name| found.iter().find(|one| one.name == *name));
    chosen.cloned().collect()
}

/// The same as what the equations of motion are asked for by.
pub(crate) fn motions<E: Analysed<N>, const N: usize>() -> [Motion<E::Mechanism>; N] {
    let coordinates = coordinates::<E>();
    std::array::from_fn(|place| {
        let of = coordinates.get(place);
        // One that is not there is refused with the name of a joint.
        let (joint, number) = of.map_or((usize::MAX, 0), |of| (of.joint, of.number));
        Motion::of(JointHandle::<E::Mechanism, ()>::new(joint), number)
    })
}

/// How many inputs there are.
#[must_use]
pub const fn inputs(report: &holonom::Report) -> usize {
    let mut values = report.values;
    let mut count = 0;
    while let [first, rest @ ..] = values {
        count += first.is_input as usize;
        values = rest;
    }
    count
}

/// Whether a name is that of a joint which has one coordinate: no body, no joint that closes a
/// loop.
#[must_use]
pub const fn is_coordinate(report: &JointReport, name: &str) -> bool {
    let mut motions = report.motions;
    let mut count = 0;
    while let [first, rest @ ..] = motions {
        count += is_same(first.joint.as_bytes(), name.as_bytes()) as usize;
        motions = rest;
    }
    count == 1
}

/// Equality where no trait can be asked.
const fn is_same(mut one: &[u8], mut other: &[u8]) -> bool {
    while let ([a, one_rest @ ..], [b, other_rest @ ..]) = (one, other) {
        if *a != *b {
            return false;
        }
        (one, other) = (one_rest, other_rest);
    }
    one.is_empty() && other.is_empty()
}

/// Refuses at compile time what has no arrays of coordinates.
pub const fn check_coordinates(report: &JointReport, degrees_of_freedom: isize, chosen: usize) {
    let mut motions = report.motions;
    while let [first, rest @ ..] = motions {
        assert!(
            !matches!(first.freedom, Freedom::Ball) && !first.joint.is_empty(),
            "a ball joint or a free body has no coordinates: write `runs` before the mechanism, for a class with `simulate` alone"
        );
        motions = rest;
    }
    let count = if chosen > 0 {
        chosen
    } else {
        report.motions.len()
    };
    assert!(
        count as isize == degrees_of_freedom,
        "a mechanism with loops needs as many joints by name as it has degrees of freedom: `FourBar(crank)`"
    );
}
