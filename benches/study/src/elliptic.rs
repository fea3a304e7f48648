//! Jacobi's elliptic functions by the arithmetic-geometric mean.
//!
//! Source: Abramowitz and Stegun, *Handbook of Mathematical Functions* (1964), sections 16.4 and
//! 17.6 (descending Landen transformation). Every stage doubles the number of correct digits.

/// The most stages of the arithmetic-geometric mean; `f64` needs fewer for every parameter below 1.
const STAGES: usize = 12;

/// The three basic functions of Jacobi at one argument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jacobi {
    /// `sn(u | m)`, the sine of the amplitude.
    pub sn: f64,
    /// `cn(u | m)`, the cosine of the amplitude.
    pub cn: f64,
    /// `dn(u | m) = sqrt(1 - m sn^2)`.
    pub dn: f64,
}

/// `sn`, `cn` and `dn` of the argument `u` for the parameter `m = k^2` in `0 <= m < 1`; NaN for any
/// other `m`.
///
/// The absolute error grows with the argument as `|u|` times the machine epsilon, because the
/// argument itself is known no better.
#[must_use]
pub fn jacobi(u: f64, m: f64) -> Jacobi {
    let Some(mean) = Mean::of(m) else {
        return Jacobi {
            sn: f64::NAN,
            cn: f64::NAN,
            dn: f64::NAN,
        };
    };
    // 16.4.2: the amplitude at the last stage, then back to the first by 16.4.3.
    let mut amplitude = mean.arithmetic * u * f64::from(1_u32 << mean.stages);
    for ratio in mean.ratios[..mean.stages].iter().rev() {
        amplitude = 0.5 * (amplitude + (ratio * amplitude.sin()).asin());
    }
    let (sn, cn) = amplitude.sin_cos();
    // Both terms are positive: no cancellation, also where m is near 1.
    Jacobi {
        sn,
        cn,
        dn: ((1.0 - m) + m * cn * cn).sqrt(),
    }
}

/// The complete elliptic integral of the first kind, `K(m)` for `0 <= m < 1`: a quarter of the
/// period of `sn`. NaN for any other `m`.
#[must_use]
pub fn quarter_period(m: f64) -> f64 {
    Mean::of(m).map_or(f64::NAN, |mean| {
        std::f64::consts::FRAC_PI_2 / mean.arithmetic
    })
}

/// The arithmetic-geometric mean of `1` and `sqrt(1 - m)`.
struct Mean {
    /// The common limit of both sequences.
    arithmetic: f64,
    /// `c_n / a_n` of the stages from the first on.
    ratios: [f64; STAGES],
    /// How many of them there are.
    stages: usize,
}

impl Mean {
    fn of(m: f64) -> Option<Self> {
        if !(0.0..1.0).contains(&m) {
            return None;
        }
        let mut mean = Self {
            arithmetic: 1.0,
            ratios: [0.0; STAGES],
            stages: 0,
        };
        let mut geometric = (1.0 - m).sqrt();
        while mean.stages < STAGES && (mean.arithmetic - geometric).abs() > f64::EPSILON {
            let difference = 0.5 * (mean.arithmetic - geometric);
            let next = 0.5 * (mean.arithmetic + geometric);
            geometric = (mean.arithmetic * geometric).sqrt();
            mean.arithmetic = next;
            mean.ratios[mean.stages] = difference / next;
            mean.stages += 1;
        }
        Some(mean)
    }
}

#[cfg(test)]
mod tests {
    use super::{jacobi, quarter_period};

    #[test]
    fn the_tables_of_abramowitz_and_stegun_come_out() {
        // Table 17.1: K(1/2) and K(0.81); example 1 of section 16: sn, cn, dn at u = 0.20, m =
        // 0.81.
        assert!((quarter_period(0.5) - 1.854_074_677_301_371_9).abs() < 1e-15);
        assert!((quarter_period(0.81) - 2.280_549_138_422_77).abs() < 1e-14);
        let value = jacobi(0.20, 0.81);
        assert!((value.sn - 0.197_62).abs() < 5e-6);
        assert!((value.cn - 0.980_28).abs() < 5e-6);
        assert!((value.dn - 0.984_06).abs() < 5e-6);
    }

    #[test]
    fn circular_functions_are_the_limit() {
        let value = jacobi(1.25, 0.0);
        assert_eq!(
            (value.sn, value.cn, value.dn),
            (1.25_f64.sin(), 1.25_f64.cos(), 1.0)
        );
    }

    #[test]
    fn squares_add_up_and_the_period_closes() {
        for m in [1e-12, 0.1, 0.5, 0.9, 0.999_999] {
            let period = 4.0 * quarter_period(m);
            for step in -40..40 {
                let u = 0.3 * f64::from(step);
                let value = jacobi(u, m);
                assert!((value.sn.powi(2) + value.cn.powi(2) - 1.0).abs() < 1e-14);
                assert!((value.dn.powi(2) + m * value.sn.powi(2) - 1.0).abs() < 1e-14);
                assert!((jacobi(u + period, m).sn - value.sn).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn the_derivative_of_sn_is_cn_dn() {
        let (u, m, step) = (0.7, 0.6, 1e-5);
        let slope = (jacobi(u + step, m).sn - jacobi(u - step, m).sn) / (2.0 * step);
        let value = jacobi(u, m);
        assert!((slope - value.cn * value.dn).abs() < 1e-9);
    }

    #[test]
    fn a_parameter_out_of_range_is_not_a_number() {
        for m in [-0.1, 1.0, 2.0, f64::NAN, f64::INFINITY] {
            assert!(jacobi(0.5, m).sn.is_nan() && quarter_period(m).is_nan());
        }
    }
}
