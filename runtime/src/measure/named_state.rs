//! A state in a file, by the names of bodies.
//!
//! A state is arrays, whose order is that of the fields of the struct: another struct reads them as
//! something else. So nothing is written without its name, and nothing is read but into the name
//! that it has. Numbers are those of the arrays, in principal axes, so that they come back bit for
//! bit. Names are compared as they are read: no heap is needed.

mod bodies;
mod counters;
mod names;
mod states;

use core::fmt;

use serde::de::Error as _;
use serde::ser::{Error as _, SerializeStruct as _};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use self::bodies::Bodies;
use self::counters::Counters;
use self::names::NameOf;
use self::states::States;
use crate::error::StepFault;
use crate::math::scalar::Real;
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::check_state;

/// A state of a mechanism at a time, to be written to a file and read from it, with the feature
/// `serde`.
///
/// The file names the mechanism, its bodies, and the joints and forces that count turns. A file of
/// another mechanism is refused with a sentence, and so is one in which a body is missing, or whose
/// body has other principal axes. The order of fields does not matter. Parameters and inputs are
/// not in a state.
///
/// | field | meaning |
/// |---|---|
/// | `mechanism` | the name of the struct |
/// | `time` | the time (s) |
/// | `bodies` | by the name of the field, for every body |
/// | `.. position`, `velocity` | of the centre of mass (m, m/s, global) |
/// | `.. orientation` | Euler parameters, scalar first, of the rotation from **principal** axes to global axes; not of a particle |
/// | `.. angular_velocity` | along **principal** axes (rad/s); not of a particle |
/// | `.. principal_axes` | Euler parameters of the rotation from the user's axes to the principal axes; not of a particle |
/// | `unwrapped_angles` | by the name of the joint or force that counts turns: its angles (rad) |
/// | `states` | by the name of the field: the value of a state of the user's own; only where there are any |
///
/// Numbers come back bit for bit where the format keeps them: with `serde_json`, turn on its
/// feature `float_roundtrip`.
///
/// ```
/// use holonom::measure::NamedState;
/// use holonom::prelude::*;
///
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81])]
/// struct Pendulum {
///     #[body(mass = 1.0, inertia = [0.1, 0.01, 0.1], position = [0.0, 0.5, 0.0])]
///     rod: Body,
///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
///     pivot: Revolute,
/// }
///
/// let state = Pendulum::default().described_state()?;
/// let text = serde_json::to_string(&NamedState::<Pendulum>::new(0.5, state))?;
/// assert!(text.starts_with(r#"{"mechanism":"Pendulum","time":0.5,"bodies":{"rod":{"#));
/// let read: NamedState<Pendulum> = serde_json::from_str(&text)?;
/// assert!(read.time == 0.5 && read.state == state);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct NamedState<M: Mechanism, S: Real = f64> {
    /// The time (s).
    pub time: S,
    /// The state of the bodies.
    pub state: M::State<S>,
}

impl<M: Mechanism, S: Real> NamedState<M, S> {
    /// A state at a time (s).
    #[must_use]
    pub fn new(time: S, state: M::State<S>) -> Self {
        Self { time, state }
    }
}

copied!([M: Mechanism, S: Real] NamedState<M, S>);

impl<M: Mechanism, S: Real> PartialEq for NamedState<M, S> {
    fn eq(&self, other: &Self) -> bool {
        self.time == other.time && self.state == other.state
    }
}

impl<M: Mechanism, S: Real> fmt::Debug for NamedState<M, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("NamedState")
            .field("mechanism", &M::REPORT.name)
            .field("time", &self.time)
            .field("state", &self.state)
            .finish()
    }
}

/// # Errors
/// That of the format; a state that is not finite, or that holds no orientation.
impl<M: Mechanism, S: Real + Serialize> Serialize for NamedState<M, S> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        check::<M, S>(self.time, &self.state).map_err(W::Error::custom)?;
        let count = if States::<M, S>::NONE { 4 } else { 5 };
        let mut fields = serializer.serialize_struct("NamedState", count)?;
        fields.serialize_field("mechanism", M::REPORT.name)?;
        fields.serialize_field("time", &self.time)?;
        fields.serialize_field("bodies", &Bodies::<M, S>(self.state))?;
        fields.serialize_field("unwrapped_angles", &Counters::<M, S>(self.state))?;
        if !States::<M, S>::NONE {
            fields.serialize_field("states", &States::<M, S>(self.state))?;
        }
        fields.end()
    }
}

/// # Errors
/// That of the format; another mechanism, body, joint or force than the file has; a state that is
/// not finite, or that holds no orientation.
impl<'de, M: Mechanism, S: Real + Deserialize<'de>> Deserialize<'de> for NamedState<M, S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let read = Parts::<M, S>::deserialize(deserializer)?;
        let Parts {
            time,
            bodies: Bodies(mut state),
            ..
        } = read;
        read.unwrapped_angles.put_into(&mut state);
        match &read.states {
            Some(states) => states.put_into(&mut state),
            None if States::<M, S>::NONE => {}
            None => return Err(D::Error::missing_field("states")),
        }
        check::<M, S>(time, &state).map_err(D::Error::custom)?;
        Ok(Self { time, state })
    }
}

/// What is written, and nothing else.
#[derive(Deserialize)]
#[serde(
    rename = "NamedState",
    deny_unknown_fields,
    bound(deserialize = "S: Deserialize<'de>")
)]
struct Parts<M: Mechanism, S: Real> {
    #[serde(rename = "mechanism")]
    _mechanism: NameOf<M>,
    time: S,
    bodies: Bodies<M, S>,
    unwrapped_angles: Counters<M, S>,
    #[serde(default = "none")]
    states: Option<States<M, S>>,
}

const fn none<T>() -> Option<T> {
    None
}

/// Refuses a state that is none.
fn check<M: Mechanism, S: Real>(time: S, state: &M::State<S>) -> Result<(), StepFault> {
    if !time.is_finite() {
        return Err(StepFault::StateNotFinite);
    }
    check_state::<S, M>(state)
}
