//! Sliders: what they move, what they are called, and how far they go.

use std::f64::consts::PI;
use std::ops::{Bound, RangeBounds};

use holonom::mechanism::{HasAngle, HasDisplacement, StateOf, ValueInfo};
use holonom::state::Array as _;
use holonom::{Fault, JointHandle, Mechanism, MechanismExt as _, ParameterError, View};

use crate::error::LiveError;

/// The part of a number by which it is moved to find out which one it is.
const NUDGE: f64 = 1e-6;

/// A field of the mechanism that is a number.
type Field<M> = Box<dyn for<'a> Fn(&'a mut M) -> &'a mut f64>;
/// What sets a coordinate of a joint, and what reads it.
type Set<M> = Box<dyn Fn(&M, &mut StateOf<M>, f64) -> Result<(), Fault>>;
pub(crate) type Read<M> = Box<dyn Fn(&View<'_, f64, M>) -> f64>;

/// What a slider moves.
pub(crate) enum Moves<M: Mechanism> {
    /// A parameter, whose joints are closed anew.
    Parameter(Field<M>),
    /// An input, which moves no point.
    Input(Field<M>),
    /// A coordinate at the start.
    Start { set: Set<M>, read: Read<M> },
}

impl<M: Mechanism> Moves<M> {
    /// As the viewer reads it.
    pub(crate) const fn group(&self) -> &'static str {
        match self {
            Self::Parameter(_) => "Parameters",
            Self::Input(_) => "Inputs",
            Self::Start { .. } => "Start",
        }
    }
}

pub(crate) struct Slider<M: Mechanism> {
    pub(crate) name: String,
    pub(crate) unit: String,
    /// The ends that were said.
    range: [Option<f64>; 2],
    /// What it is about a value, without that: an angle goes half a turn either way.
    span: Option<f64>,
    pub(crate) moves: Moves<M>,
}

impl<M: Mechanism> Slider<M> {
    /// Of a field, whose name is found among the values of the mechanism.
    pub(crate) fn of_field(
        mechanism: &mut M,
        field: Field<M>,
        unit: &str,
    ) -> Result<Self, LiveError> {
        let info = place(mechanism, &field)?.ok_or(LiveError::NoValue)?;
        let (name, is_input) = (info.name.to_owned(), info.is_input);
        let moves = if is_input {
            Moves::Input(field)
        } else {
            Moves::Parameter(field)
        };
        Ok(Self {
            name,
            unit: unit.to_owned(),
            range: [None; 2],
            span: None,
            moves,
        })
    }

    /// Of the angle of a joint at the start.
    pub(crate) fn of_angle<J: HasAngle + 'static>(joint: JointHandle<M, J>) -> Self {
        Self {
            name: joint.name().to_owned(),
            unit: "rad".to_owned(),
            range: [None; 2],
            span: Some(PI),
            moves: Moves::Start {
                set: Box::new(move |of, state, angle| of.set_angle(state, joint, angle)),
                read: Box::new(move |view| view.angle(joint)),
            },
        }
    }

    /// Of the displacement of a joint at the start.
    pub(crate) fn of_displacement<J: HasDisplacement + 'static>(joint: JointHandle<M, J>) -> Self {
        Self {
            name: joint.name().to_owned(),
            unit: "m".to_owned(),
            range: [None; 2],
            span: None,
            moves: Moves::Start {
                set: Box::new(move |of, state, far| of.set_displacement(state, joint, far)),
                read: Box::new(move |view| view.displacement(joint)),
            },
        }
    }

    /// With these ends.
    pub(crate) fn within(mut self, range: &impl RangeBounds<f64>) -> Self {
        self.range = [range.start_bound(), range.end_bound()].map(|bound| match bound {
            Bound::Included(end) | Bound::Excluded(end) => Some(*end),
            Bound::Unbounded => None,
        });
        self
    }

    /// From the least to the largest value, about what it is at first. Of a coordinate that is a
    /// length half the size (m) of the mechanism either way. The range always has the value.
    ///
    /// # Errors
    /// Ends that are none.
    pub(crate) fn ends(&self, value: f64, size: f64) -> Result<[f64; 2], LiveError> {
        let unsaid = match &self.moves {
            Moves::Start { .. } => {
                let span = self.span.unwrap_or(0.5 * size);
                [value - span, value + span]
            }
            _ if value == 0.0 => [-1.0, 1.0],
            _ => [f64::min(0.0, 2.0 * value), f64::max(0.0, 2.0 * value)],
        };
        let [low, high] = [0, 1].map(|end| self.range[end].unwrap_or(unsaid[end]));
        if !(low.is_finite() && high.is_finite() && low < high) {
            let name = self.name.clone();
            return Err(LiveError::Range { name, low, high });
        }
        Ok([low.min(value), high.max(value)])
    }
}

/// What the report says of the value that a field is: the one whose number changes with it.
fn place<M: Mechanism>(
    mechanism: &mut M,
    field: &Field<M>,
) -> Result<Option<&'static ValueInfo>, LiveError> {
    let before = numbers(mechanism)?;
    let value = *field(mechanism);
    let by = NUDGE * if value == 0.0 { 1.0 } else { value };
    let mut nudged = |by: f64| {
        *field(mechanism) = value + by;
        let after = numbers(mechanism);
        *field(mechanism) = value;
        after
    };
    // A number at the edge of what is accepted is moved the other way.
    let after = nudged(by).or_else(|_| nudged(-by))?;
    let mut changed = before.iter().zip(&after).map(|(one, other)| one != other);
    let Some(place) = changed.position(|changed| changed) else {
        return Ok(None);
    };
    let values = M::REPORT.values;
    if let Some(info) = values.get(place) {
        return Ok(Some(info));
    }
    // Behind the first numbers of all values are the further ones of each.
    let mut next = values.len();
    let mut owners = values.iter();
    Ok(owners.find(|info| {
        next += info.further;
        place < next
    }))
}

fn numbers<M: Mechanism>(mechanism: &M) -> Result<Vec<f64>, LiveError> {
    let numbers = || {
        let mut numbers = mechanism.parameters::<f64>()?;
        M::put_inputs(&mechanism.inputs(), &mut numbers)?;
        Ok(numbers.as_slice().to_vec())
    };
    numbers().map_err(|error: ParameterError| LiveError::Mechanism(error.into()))
}
