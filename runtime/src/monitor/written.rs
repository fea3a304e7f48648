//! Warnings as they are written to a file: each with its sentence.

use serde::ser::SerializeSeq as _;
use serde::{Serialize, Serializer};

use crate::error::sentence::Sentence;
use crate::monitor::warning::{Warning, Warnings};

/// A warning as it is written.
#[derive(Serialize)]
#[serde(rename = "Warning")]
struct Written {
    /// What it says.
    sentence: Sentence<Warning>,
    /// Its kind, and its numbers.
    warning: Warning,
}

/// A sequence, the gravest first: each with a `sentence` and a `warning`, its kind and its numbers.
impl Serialize for Warnings {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let mut all = serializer.serialize_seq(Some(self.len()))?;
        for warning in *self {
            let sentence = Sentence(warning);
            all.serialize_element(&Written { sentence, warning })?;
        }
        all.end()
    }
}
