//! Names in a file, compared as they are read.

use core::fmt;
use core::marker::PhantomData;

use serde::de::{DeserializeSeed, Visitor};
use serde::{Deserialize, Deserializer};

use crate::mechanism::kernels::Mechanism;

/// The name of a mechanism, which must be the one that is meant.
pub(super) struct NameOf<M>(PhantomData<fn() -> M>);

impl<'de, M: Mechanism> Deserialize<'de> for NameOf<M> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_str(Self(PhantomData))
    }
}

impl<M: Mechanism> Visitor<'_> for NameOf<M> {
    type Value = Self;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the name of the mechanism, `{}`", M::REPORT.name)
    }

    fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<Self, E> {
        let meant = M::REPORT.name;
        if name == meant {
            Ok(self)
        } else {
            Err(E::custom(format_args!(
                "this is a state of `{name}`, and not of `{meant}`"
            )))
        }
    }
}

/// A name that is looked for among some.
pub(super) struct Among<F> {
    pub(super) find: F,
    /// What it names.
    pub(super) what: &'static str,
    pub(super) mechanism: &'static str,
}

impl<'de, T, F: Fn(&str) -> Option<T>> DeserializeSeed<'de> for Among<F> {
    type Value = T;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<T, D::Error> {
        deserializer.deserialize_str(self)
    }
}

impl<T, F: Fn(&str) -> Option<T>> Visitor<'_> for Among<F> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the name of a {} of `{}`", self.what, self.mechanism)
    }

    fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<T, E> {
        let Self {
            find,
            what,
            mechanism,
        } = self;
        find(name).ok_or_else(|| E::custom(format_args!("`{mechanism}` has no {what} `{name}`")))
    }
}
