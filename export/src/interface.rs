//! What a program is given and gives, by name: for those who write something around it.

use std::f64::consts::PI;

use holonom::Mechanism;
use holonom::mechanism::{Freedom, TracedCoordinates};

use crate::c::used_constants;
use crate::export::{CONSTANTS, Export, STATE};
use crate::number::Precision;
use crate::openings::Opening;
use crate::program::{Function, Kind, Member};
use crate::values::Value;

/// What a program is given and gives.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Interface {
    /// The name of the program, with which every name in it begins.
    pub name: String,
    /// The members of its struct of parameters, which is not there if there are none.
    pub parameters: Vec<Quantity>,
    /// The members of its struct of inputs, which is not there if there are none.
    pub inputs: Vec<Quantity>,
    /// What is integrated, in the order of the numbers of a slope.
    pub states: Vec<Coordinate>,
    /// The functions that read a state.
    pub readings: Vec<Quantity>,
    /// The members of its struct of gaps, three for each joint with limits: how far it is above
    /// the lower one and below the upper one, and its rate. Empty where limits are passed.
    pub gaps: Vec<Quantity>,
    /// The members of its struct of switches.
    pub switches: Vec<Quantity>,
    /// What its struct of openings is about, which has two members for each: by how much it is
    /// open, and how fast it opens.
    pub openings: Vec<Opens>,
    /// The states that count angles over all turns, where these follow from the joints.
    pub turned: Vec<Turned>,
    /// Whether the program has a struct of constants.
    pub has_constants: bool,
}

/// A number, or an array of numbers.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Quantity {
    /// Its name in C, without that of the program.
    pub name: String,
    /// What it is, with its unit in parentheses; empty where nothing is known.
    pub about: String,
    /// Whether it is an array.
    pub is_array: bool,
    /// The numbers that it has at the start. A reading has none.
    pub start: Vec<f64>,
}

/// Equations of a joint that may be violated.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Opens {
    /// The field of the joint.
    pub joint: &'static str,
    /// The unit, `m` or `rad`.
    pub unit: &'static str,
    /// The violation that a start may have.
    pub accepted: f64,
}

/// A state that counts an angle over all turns: the sum of an angle (rad) and of parts of what the
/// joints have, all by their places among the states.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Turned {
    /// The state that counts.
    pub state: usize,
    /// The angle in the described configuration (rad).
    pub described: f64,
    /// Coordinates of joints, and how much of each is added.
    pub parts: Vec<(usize, f64)>,
}

/// A coordinate or a velocity, as a joint counts it.
///
/// A state has cosine and sine of an angle, and in a run of parallel axes the angle and its rate
/// are sums:
///
/// ```text
/// in the state = +-(of the joint) + offset + that of another one in the state
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Coordinate {
    /// What the joint has, at the start of the program.
    pub quantity: Quantity,
    /// What its rate is, with its unit in parentheses.
    pub about_rate: String,
    /// Whether a state has its cosine and sine in its place.
    pub is_angle: bool,
    /// Whether the joint counts the other way round.
    pub is_reversed: bool,
    /// What is added (rad).
    pub offset: f64,
    /// The coordinate or velocity that is added, by its place among the states.
    pub against: Option<usize>,
}

impl Quantity {
    fn of(member: &Member, start: Vec<f64>) -> Self {
        Self {
            name: member.name.clone(),
            about: member.about.clone(),
            is_array: member.length.is_some(),
            start,
        }
    }
}

impl<M: Mechanism, P: Precision, C: TracedCoordinates<M>> Export<M, P, C> {
    /// What the program is given and gives, by name; nothing where the mechanism was refused
    /// ([`Export::checked`]).
    #[must_use]
    pub fn interface(&self) -> Interface {
        let of = |values: &[Value]| values.iter().map(|value| self.value(value)).collect();
        let [parameters, inputs] = &self.values;
        let members = |name: &str| {
            let mut structs = self.program.structs.iter();
            let found = structs.find(|of| of.name == name);
            let members = found.map_or(&[][..], |of| &of.members);
            let members = members.iter();
            members.map(|of| Quantity::of(of, Vec::new())).collect()
        };
        Interface {
            name: self.name.clone(),
            parameters: of(parameters),
            inputs: of(inputs),
            states: self.coordinates(),
            readings: self.readings().map(reading).collect(),
            gaps: if self.is_passing_limits {
                Vec::new()
            } else {
                members("gaps")
            },
            switches: members("switches"),
            openings: self.openings.all.iter().map(opens).collect(),
            turned: self.turned.clone(),
            has_constants: used_constants(&self.program).iter().any(Option::is_some),
        }
    }

    /// The functions that return what they read of a state.
    pub(crate) fn readings(&self) -> impl Iterator<Item = &Function> {
        self.program.functions.iter().filter(|function| {
            let kinds = function.arguments.iter().map(|argument| argument.kind);
            function.is_public
                && function.returned.is_some()
                && kinds.eq([CONSTANTS, STATE].map(Kind::Struct))
        })
    }

    fn value(&self, value: &Value) -> Quantity {
        let number = |place: &usize| self.defaults.get(*place).copied().unwrap_or(0.0);
        Quantity::of(&value.member, value.places.iter().map(number).collect())
    }

    /// Coordinates and velocities, first as they are in a state.
    fn coordinates(&self) -> Vec<Coordinate> {
        let mut states = Vec::new();
        let mut elements = self.elements.iter().zip(&self.start).peekable();
        while let Some((element, &start)) = elements.next() {
            let Some(rate) = &element.of_slope else {
                continue;
            };
            let mut quantity = Quantity::of(&element.of_state, vec![start]);
            let sine = elements.next_if(|(next, _)| next.of_slope.is_none());
            if let Some((_, sine)) = sine {
                let cosine = quantity.name.strip_suffix("_cos");
                let stem = cosine.unwrap_or(&quantity.name);
                quantity.about = format!("angle of {stem} (rad)");
                quantity.name = format!("{stem}_angle");
                quantity.start = vec![sine.atan2(start)];
            }
            states.push(Coordinate {
                quantity,
                about_rate: rate.about.clone(),
                is_angle: sine.is_some(),
                is_reversed: false,
                offset: 0.0,
                against: None,
            });
        }
        self.count_as_joints(&mut states);
        states
    }

    fn count_as_joints(&self, states: &mut [Coordinate]) {
        let Some(report) = C::JOINTS.filter(|_| !states.is_empty()) else {
            return;
        };
        let before = states.iter().map(|state| state.quantity.start[0]);
        let before: Vec<f64> = before.collect();
        let rate = |velocity: usize| self.first_rate(report) - self.pairs() + velocity;
        let mut count = |place: usize, reversed: bool, offset: f64, against: Option<usize>| {
            let Some(state) = states.get_mut(place) else {
                return;
            };
            let added = against.map_or(0.0, |place| before[place]);
            let own = before[place] - offset - added;
            let own = if state.is_angle { wrapped(own) } else { own };
            // No zero below zero.
            state.quantity.start = vec![0.0 + if reversed { -own } else { own }];
            (state.is_reversed, state.offset, state.against) = (reversed, offset, against);
        };
        for motion in report.motions {
            let carrier = motion.against.and_then(|place| report.motions.get(place));
            let reversed = motion.is_reversed();
            if let Freedom::Turn { .. } | Freedom::Screw { .. } = motion.freedom {
                let offset = motion.zero - carrier.map_or(0.0, |carrier| carrier.zero);
                let against = carrier.map(|carrier| carrier.coordinate);
                count(motion.coordinate, reversed, offset, against);
            }
            if motion.freedom != Freedom::Ball {
                let against = carrier.map(|carrier| rate(carrier.velocity));
                count(rate(motion.velocity), reversed, 0.0, against);
            }
        }
        // What the text of a state says about sums does not hold of the joint.
        let of_joint = |about: &str| match about.split_once("), ") {
            Some((about, _)) => format!("{about})"),
            None => about.to_owned(),
        };
        for state in states {
            state.quantity.about = of_joint(&state.quantity.about);
            state.about_rate = of_joint(&state.about_rate);
        }
    }
}

fn opens(of: &Opening) -> Opens {
    Opens {
        joint: of.joint,
        unit: if of.is_length { "m" } else { "rad" },
        accepted: of.accepted,
    }
}

fn reading(function: &Function) -> Quantity {
    Quantity {
        name: function.name.clone(),
        about: function.about.clone(),
        is_array: false,
        start: Vec::new(),
    }
}

/// An angle from `-pi` to `pi`.
fn wrapped(angle: f64) -> f64 {
    if angle.abs() <= PI {
        angle
    } else {
        angle.sin().atan2(angle.cos())
    }
}
