//! Numbers as a reader of tables and pictures wants them.

/// `1.50·10⁻⁶` with the given digits after the point; `0` for zero, `not finite` for NaN and
/// infinities.
#[must_use]
pub fn scientific(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "not finite".into();
    }
    if value == 0.0 {
        return "0".into();
    }
    let text = format!("{value:.digits$e}").replace('-', "\u{2212}");
    match text.split_once('e') {
        Some((mantissa, "0")) => mantissa.into(),
        Some((mantissa, exponent)) => format!("{mantissa}·10{}", superscript(exponent)),
        None => text,
    }
}

/// `value` with the given digits after the point and a true minus sign; `not finite` for NaN and
/// infinities.
#[must_use]
pub fn fixed(value: f64, digits: usize) -> String {
    if value.is_finite() {
        format!("{value:.digits$}").replace('-', "\u{2212}")
    } else {
        "not finite".into()
    }
}

/// `10⁻¹²`.
#[must_use]
pub fn power_of_ten(exponent: i32) -> String {
    format!("10{}", superscript(&exponent.to_string()))
}

/// An integer raised.
fn superscript(integer: &str) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    integer
        .chars()
        .map(|c| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]))
        .collect()
}

/// A positive number to two digits, as one would write it.
#[cfg(feature = "trade")]
pub(crate) fn two_digits(value: f64) -> f64 {
    digits(value, 2)
}

/// A positive number to so many digits.
#[cfg(feature = "trade")]
pub(crate) fn digits(value: f64, count: i32) -> f64 {
    let exponent = value.log10().floor() as i32 + 1 - count;
    let digits = (value / 10.0_f64.powi(exponent)).round();
    // Powers of ten that are no numbers of the machine go into the divisor.
    if exponent < 0 {
        digits / 10.0_f64.powi(-exponent)
    } else {
        digits * 10.0_f64.powi(exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::{fixed, power_of_ten, scientific};

    #[test]
    fn numbers_are_readable() {
        assert_eq!(scientific(4.518e-11, 1), "4.5·10⁻¹¹");
        assert_eq!(scientific(-2.0, 0), "\u{2212}2");
        assert_eq!(scientific(1e12, 0), "1·10¹²");
        assert_eq!(scientific(0.0, 3), "0");
        assert_eq!(fixed(-1.25, 1), "\u{2212}1.2");
        assert_eq!(power_of_ten(-26), "10⁻²⁶");
        assert_eq!(power_of_ten(0), "10⁰");
    }

    #[test]
    fn what_is_no_number_says_so() {
        assert_eq!(scientific(f64::NAN, 1), "not finite");
        assert_eq!(fixed(f64::INFINITY, 1), "not finite");
    }

    #[cfg(feature = "trade")]
    #[test]
    fn numbers_of_two_digits_are_those_that_one_would_write() {
        assert_eq!(super::two_digits(0.483_388), 0.48);
        assert_eq!(super::two_digits(3.162_277e-7), 3.2e-7);
        assert_eq!(super::two_digits(0.001), 0.001);
        assert_eq!(super::two_digits(9.96), 10.0);
        assert_eq!(super::two_digits(1234.0), 1200.0);
    }
}
