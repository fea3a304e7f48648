//! Numbers in sentences, as a person writes them.

use core::fmt;

/// A number as it was given: in full where it is neither very small nor very large.
pub(crate) struct Given(pub(crate) f64);

/// A number that was measured: three digits.
pub(crate) struct Measured(pub(crate) f64);

impl fmt::Display for Given {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // No sign of a zero.
        let value = if self.0 == 0.0 { 0.0 } else { self.0 };
        let size = value.abs();
        if value == 0.0 || (1e-4..1e6).contains(&size) || !value.is_finite() {
            write!(f, "{value}")
        } else {
            write!(f, "{value:e}")
        }
    }
}

impl fmt::Display for Measured {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Given(rounded(self.0)).fmt(f)
    }
}

/// The nearest number of three digits.
fn rounded(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let (mut size, mut factor) = (value.abs(), 1.0);
    let small = size < 100.0;
    // Powers of ten up to 22 are exact; beyond, the last digits matter no more.
    while size < 100.0 && factor < 1e300 {
        factor *= 10.0;
        size = value.abs() * factor;
    }
    while size >= 1000.0 {
        factor *= 10.0;
        size = value.abs() / factor;
    }
    let whole = (size + 0.5) as u64 as f64;
    let rounded = if small {
        whole / factor
    } else {
        whole * factor
    };
    if value < 0.0 { -rounded } else { rounded }
}

#[cfg(test)]
mod tests {
    use std::string::ToString;

    use super::{Given, Measured};

    #[test]
    fn numbers_read_as_a_person_writes_them() {
        for (value, text) in [
            (-1.0, "-1"),
            (-0.0, "0"),
            (0.1, "0.1"),
            (1e-20, "1e-20"),
            (2e7, "2e7"),
            (f64::NAN, "NaN"),
            (0.125, "0.125"),
        ] {
            assert_eq!(Given(value).to_string(), text);
        }
        for (value, text) in [
            (0.001_234_56, "0.00123"),
            (-12_345.6, "-12300"),
            (9.999_9e-7, "1e-6"),
            (1.0 / 3.0, "0.333"),
            (6.543_21e-18, "6.54e-18"),
            (1.234_5e12, "1.23e12"),
            (999.9, "1000"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(Measured(value).to_string(), text);
        }
    }
}
