//! What a value says, as it is written to a file.

use core::fmt::Display;

use serde::{Serialize, Serializer};

/// What a value says.
pub(crate) struct Sentence<T>(pub(crate) T);

impl<T: Display> Serialize for Sentence<T> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        serializer.collect_str(&self.0)
    }
}
