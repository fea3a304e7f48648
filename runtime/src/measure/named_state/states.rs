//! The user's own states, by name.

use core::fmt;
use core::marker::PhantomData;

use serde::de::{Error as _, MapAccess, Visitor};
use serde::ser::SerializeMap as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::names::Among;
use crate::math::scalar::Real;
use crate::math::vec3::{read, write};
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::{Array, MovingState as _, StateParts};

/// The user's own states by name; the rest of the state is zero once read.
pub(super) struct States<M: Mechanism, S: Real>(pub(super) M::State<S>);

impl<M: Mechanism, S: Real> States<M, S> {
    /// Whether there are none, so that a file need not have a place for them.
    pub(super) const NONE: bool = M::REPORT.states.is_empty();

    /// Puts the values into their places in a state.
    pub(super) fn put_into(&self, state: &mut M::State<S>) {
        for info in M::REPORT.states {
            let value: [S; 1] = read(self.0.coordinates().as_slice(), info.coordinate);
            write(
                state.coordinates_mut().as_mut_slice(),
                info.coordinate,
                value,
            );
        }
    }
}

impl<M: Mechanism, S: Real + Serialize> Serialize for States<M, S> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let mut states = serializer.serialize_map(Some(M::REPORT.states.len()))?;
        for info in M::REPORT.states {
            let [value] = read(self.0.coordinates().as_slice(), info.coordinate);
            states.serialize_entry(info.name, &value)?;
        }
        states.end()
    }
}

impl<'de, M: Mechanism, S: Real + Deserialize<'de>> Deserialize<'de> for States<M, S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(StatesByName(PhantomData))
    }
}

struct StatesByName<M, S>(PhantomData<fn() -> (M, S)>);

impl<'de, M: Mechanism, S: Real + Deserialize<'de>> Visitor<'de> for StatesByName<M, S> {
    type Value = States<M, S>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the states of `{}` by name", M::REPORT.name)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let (mut state, mut seen) = (M::State::<S>::zeros(), M::State::<S>::zeros());
        let find = |name: &str| M::REPORT.states.iter().find(|info| info.name == name);
        let (what, mechanism) = ("state", M::REPORT.name);
        while let Some(info) = map.next_key_seed(Among {
            find,
            what,
            mechanism,
        })? {
            let (place, name) = (info.coordinate, info.name);
            let flags = seen.coordinates_mut().as_mut_slice();
            let [flag]: [S; 1] = read(flags, place);
            if flag == S::one() {
                return Err(A::Error::custom(format_args!(
                    "state `{name}` is there twice"
                )));
            }
            write(flags, place, [S::one()]);
            let value: S = map.next_value()?;
            write(state.coordinates_mut().as_mut_slice(), place, [value]);
        }
        let mut states = M::REPORT.states.iter();
        let missing = states.find(|info| {
            let [flag]: [S; 1] = read(seen.coordinates().as_slice(), info.coordinate);
            flag != S::one()
        });
        match missing {
            None => Ok(States(state)),
            Some(info) => Err(A::Error::custom(format_args!(
                "state `{}` of `{mechanism}` is missing",
                info.name
            ))),
        }
    }
}
