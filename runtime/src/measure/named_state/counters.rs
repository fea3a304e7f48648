//! The angles that count turns, by name.

use core::fmt;
use core::marker::PhantomData;
use core::ops::Range;

use serde::de::{DeserializeSeed, Error as _, MapAccess, SeqAccess, Visitor};
use serde::ser::SerializeMap as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::names::Among;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::turns::{FAR, place_of};
use crate::state::vector::{Array as _, MovingState as _, StateParts, Vector as _};

/// The angles of which turns are counted by joints and forces, by name; the rest of the state is
/// zero once read.
pub(super) struct Counters<M: Mechanism, S: Real>(pub(super) M::State<S>);

/// Where the angles of a joint or force are in a state.
#[derive(Clone)]
enum Places {
    /// Among the auxiliary variables.
    Auxiliary(Range<usize>),
    /// In the account of angles that no variable counts.
    Account(usize),
}

impl Places {
    fn of<'s, S: Real, X: StateParts<S>>(&self, state: &'s X) -> &'s [S] {
        let angles = match self {
            Self::Auxiliary(places) => state.coordinates().as_slice().get(places.clone()),
            Self::Account(place) => state.turns().get(*place..=*place),
        };
        angles.unwrap_or(&[])
    }

    fn of_mut<'s, S: Real, X: StateParts<S>>(&self, state: &'s mut X) -> &'s mut [S] {
        let angles = match self {
            Self::Auxiliary(places) => {
                let coordinates = state.coordinates_mut().as_mut_slice();
                coordinates.get_mut(places.clone())
            }
            Self::Account(place) => state.turns_mut().get_mut(*place..=*place),
        };
        angles.unwrap_or(&mut [])
    }

    /// Whether a file must have them: one that has not was written before turns were counted.
    fn are_needed(&self) -> bool {
        matches!(self, Self::Auxiliary(_))
    }
}

/// Joints and forces that count turns, and the places of their angles.
fn counters<M: Mechanism>() -> impl Iterator<Item = (&'static str, Places)> {
    let joints = M::REPORT.joints.iter().enumerate();
    let joints = joints.filter_map(|(index, joint)| {
        let (first, count) = (joint.auxiliary, joint.auxiliaries);
        let places = if count > 0 {
            Places::Auxiliary(first..first + count)
        } else {
            Places::Account(place_of::<M>(index)?)
        };
        Some((joint.name, places))
    });
    let forces = M::REPORT
        .forces
        .iter()
        .filter(|force| force.auxiliaries > 0);
    let forces = forces.map(|force| {
        let (first, count) = (force.auxiliary, force.auxiliaries);
        (force.name, Places::Auxiliary(first..first + count))
    });
    joints.chain(forces)
}

impl<M: Mechanism, S: Real> Counters<M, S> {
    /// Puts the angles into their places in a state.
    pub(super) fn put_into(&self, state: &mut M::State<S>) {
        for (_, places) in counters::<M>() {
            let to = places.of_mut(state);
            to.copy_from_slice(places.of(&self.0));
        }
        // A joint of which a variable counts the angle has it in the account as well.
        for (index, joint) in M::REPORT.joints.iter().enumerate() {
            let counted = state.coordinates().as_slice().get(joint.auxiliary).copied();
            let place = place_of::<M>(index).filter(|_| joint.auxiliaries == 1);
            let account = place.and_then(|place| state.turns_mut().get_mut(place));
            if let (Some(account), Some(counted)) = (account, counted) {
                *account = counted;
            }
        }
        // They are of some time ago.
        if let Some(since) = state.turns_mut().last_mut() {
            *since = S::constant(FAR);
        }
    }
}

impl<M: Mechanism, S: Real + Serialize> Serialize for Counters<M, S> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let mut angles = serializer.serialize_map(Some(counters::<M>().count()))?;
        for (name, places) in counters::<M>() {
            angles.serialize_entry(name, places.of(&self.0))?;
        }
        angles.end()
    }
}

impl<'de, M: Mechanism, S: Real + Deserialize<'de>> Deserialize<'de> for Counters<M, S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(CountersByName(PhantomData))
    }
}

struct CountersByName<M, S>(PhantomData<fn() -> (M, S)>);

impl<'de, M: Mechanism, S: Real + Deserialize<'de>> Visitor<'de> for CountersByName<M, S> {
    type Value = Counters<M, S>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the unwrapped angles of `{}` by name", M::REPORT.name)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut state = M::State::<S>::zeros();
        let places_of = |name: &str| counters::<M>().find(|(known, _)| *known == name);
        let mut seen = M::State::<S>::zeros();
        loop {
            let (what, mechanism) = ("joint or force that counts turns", M::REPORT.name);
            let names = Among {
                find: places_of,
                what,
                mechanism,
            };
            let Some((name, places)) = map.next_key_seed(names)? else {
                break;
            };
            let flags = places.of_mut(&mut seen);
            if flags.iter().any(|flag| *flag == S::one()) {
                let twice = format_args!("`{name}` is there twice");
                return Err(A::Error::custom(twice));
            }
            flags.fill(S::one());
            map.next_value_seed(Angles(places.of_mut(&mut state)))?;
        }
        let is_missing =
            |places: &Places| places.are_needed() && places.of(&seen).contains(&S::zero());
        let missing = counters::<M>().find(|(_, places)| is_missing(places));
        let Some((missing, _)) = missing else {
            return Ok(Counters(state));
        };
        let mechanism = M::REPORT.name;
        let missing =
            format_args!("the unwrapped angles of `{missing}` of `{mechanism}` are missing");
        Err(A::Error::custom(missing))
    }
}

/// Angles that are read in their places.
struct Angles<'a, S>(&'a mut [S]);

impl<'de, S: Deserialize<'de>> DeserializeSeed<'de> for Angles<'_, S> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de, S: Deserialize<'de>> Visitor<'de> for Angles<'_, S> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} unwrapped angles (rad)", self.0.len())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut angles: A) -> Result<(), A::Error> {
        for place in 0..self.0.len() {
            let Some(angle) = angles.next_element()? else {
                return Err(A::Error::invalid_length(place, &self));
            };
            if let Some(element) = self.0.get_mut(place) {
                *element = angle;
            }
        }
        match angles.next_element::<S>()? {
            Some(_) => Err(A::Error::invalid_length(self.0.len() + 1, &self)),
            None => Ok(()),
        }
    }
}
