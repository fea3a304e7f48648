//! Contacts with friction, against closed forms and against equations of a test's own.

mod balls;
mod blocks;
mod cams;
mod corners;
mod faults;
mod going_on;
mod jams;
mod profiles;
mod tops;
mod turning;
mod woodpecker;

use holonom::prelude::*;

/// Where steps follow smooth motion to round-off.
fn tight() -> Tolerance<f64> {
    Tolerance {
        relative: 1e-12,
        absolute: 1e-13,
    }
}
