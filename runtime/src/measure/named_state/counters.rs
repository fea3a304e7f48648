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
use crate::state::vector::{Array, MovingState as _, StateParts};

/// The angles of which turns are counted by joints and forces, by name; the rest of the state is
/// zero once read.
pub(super) struct Counters<M: Mechanism, S: Real>(pub(super) M::State<S>);

/// Joints and forces that count turns, and the places of their angles.
fn counters<M: Mechanism>() -> impl Iterator<Item = (&'static str, Range<usize>)> {
    let joints = M::REPORT.joints.iter();
    let joints = joints.map(|joint| (joint.name, joint.auxiliary, joint.auxiliaries));
    let forces = M::REPORT.forces.iter();
    let forces = forces.map(|force| (force.name, force.auxiliary, force.auxiliaries));
    let all = joints.chain(forces).filter(|(_, _, count)| *count > 0);
    all.map(|(name, first, count)| (name, first..first + count))
}

impl<M: Mechanism, S: Real> Counters<M, S> {
    /// Puts the angles into their places in a state.
    pub(super) fn put_into(&self, state: &mut M::State<S>) {
        for (_, places) in counters::<M>() {
            let from = self.0.coordinates().as_slice().get(places.clone());
            let to = state.coordinates_mut().as_mut_slice().get_mut(places);
            if let (Some(from), Some(to)) = (from, to) {
                to.copy_from_slice(from);
            }
        }
    }
}

impl<M: Mechanism, S: Real + Serialize> Serialize for Counters<M, S> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let mut angles = serializer.serialize_map(Some(counters::<M>().count()))?;
        for (name, places) in counters::<M>() {
            let counted = self.0.coordinates().as_slice().get(places);
            angles.serialize_entry(name, counted.unwrap_or(&[]))?;
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
        let (mut state, mut count) = (M::State::<S>::zeros(), 0);
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
            let flags = seen
                .coordinates_mut()
                .as_mut_slice()
                .get_mut(places.clone());
            let flags = flags.unwrap_or(&mut []);
            if flags.iter().any(|flag| *flag == S::one()) {
                let twice = format_args!("`{name}` is there twice");
                return Err(A::Error::custom(twice));
            }
            flags.fill(S::one());
            let angles = state.coordinates_mut().as_mut_slice().get_mut(places);
            map.next_value_seed(Angles(angles.unwrap_or(&mut [])))?;
            count += 1;
        }
        if count == counters::<M>().count() {
            return Ok(Counters(state));
        }
        let is_missing = |places: &Range<usize>| {
            let flags = seen.coordinates().as_slice().get(places.clone());
            flags.is_none_or(|flags| flags.contains(&S::zero()))
        };
        let missing = counters::<M>().find(|(_, places)| is_missing(places));
        let missing = missing.map_or("", |(name, _)| name);
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
