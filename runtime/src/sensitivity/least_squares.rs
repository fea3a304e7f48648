//! Parameters by least squares, from readings with their derivatives.
//!
//! After Levenberg and Marquardt, with the scales of Marquardt: each unknown counts by how much it
//! changes the residuals (Moré, *The Levenberg-Marquardt algorithm*, Lecture Notes in Mathematics
//! 630 (1978)).

use core::fmt;

use nalgebra::{SMatrix, SVector};

use crate::forward::Forward;
use crate::math::scalar::Scalar;

/// Rounds after which the search is given up.
const ROUNDS: usize = 100;
/// A share of the unknowns, as they change the residuals, below which a step is none.
const STEP: f64 = 1e-10;
/// A share of the sum of squares below which what a step would gain is round-off.
const GAIN: f64 = 1e-15;
/// How often larger than by itself the variance of an unknown is beside the others, where they do
/// the same.
const ALIKE: f64 = 1e13;

/// A sum of squares of residuals, by what is unknown. The unit is that of the residuals, which
/// should have one size: divide each by its standard deviation.
#[derive(Clone, Copy, Debug)]
pub struct Squares<const N: usize> {
    sum: f64,
    /// Half of the gradient.
    gradient: SVector<f64, N>,
    /// Half of the second derivatives, after Gauss and Newton.
    normal: SMatrix<f64, N, N>,
    count: usize,
}

impl<const N: usize> Squares<N> {
    fn none() -> Self {
        Self {
            sum: 0.0,
            gradient: SVector::zeros(),
            normal: SMatrix::zeros(),
            count: 0,
        }
    }

    /// Adds the square of a residual.
    pub fn add(&mut self, residual: Forward<f64, N>) {
        let slopes = SVector::from(residual.derivatives());
        self.sum += residual.value() * residual.value();
        self.gradient += slopes * residual.value();
        self.normal += slopes * slopes.transpose();
        self.count += 1;
    }

    /// Adds the square of what a reading is off from a measured number.
    pub fn compare(&mut self, reading: Forward<f64, N>, measured: f64) {
        self.add(reading - Forward::fixed(measured));
    }

    fn is_finite(&self) -> bool {
        let all = self.gradient.iter().chain(&self.normal);
        self.sum.is_finite() && all.copied().all(f64::is_finite)
    }

    /// The first unknown that changes no residual.
    fn without_effect(&self) -> Option<usize> {
        (0..N).find(|&k| self.normal[(k, k)] <= 0.0)
    }

    /// The matrix in the scales of the unknowns: ones on its diagonal, but for the damping.
    fn scaled(&self, damping: f64) -> (SMatrix<f64, N, N>, SVector<f64, N>) {
        let scales = self.normal.diagonal().map(<f64 as Scalar>::sqrt);
        let matrix = SMatrix::from_fn(|row, column| {
            let entry = self.normal[(row, column)] / (scales[row] * scales[column]);
            if row == column { 1.0 + damping } else { entry }
        });
        (matrix, scales)
    }
}

/// Unknowns that fit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Fit<const N: usize> {
    /// The unknowns, in the order of the guess.
    pub values: [f64; N],
    /// Their standard deviations, if the residuals are independent and of one size; infinite where
    /// there are no more of them than unknowns.
    pub deviations: [f64; N],
    /// The sum of squares that is left.
    pub sum: f64,
    /// How often the residuals were computed.
    pub rounds: usize,
}

/// Why nothing fits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FitError<E> {
    /// The residuals could not be computed: at the guess, or whatever step is taken.
    Residuals(E),
    /// A residual or a derivative is not finite at the guess.
    NotFinite,
    /// An unknown changes no residual, or only as the others do.
    NoEffect {
        /// Its place in the guess.
        unknown: usize,
    },
    /// The sum of squares has not come to its least.
    NotConverged {
        /// How often the residuals were computed.
        rounds: usize,
    },
}

impl<E: fmt::Display> fmt::Display for FitError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Residuals(error) => error.fmt(f),
            Self::NotFinite => {
                f.write_str("a residual or its derivative is not finite at the guess")
            }
            Self::NoEffect { unknown } => write!(
                f,
                "unknown {unknown} (from 0) cannot be found: it changes no residual, or only as the others do"
            ),
            Self::NotConverged { rounds } => write!(
                f,
                "no least sum of squares after {rounds} rounds; begin nearer to it"
            ),
        }
    }
}

impl<E: fmt::Debug + fmt::Display> core::error::Error for FitError<E> {}

/// The unknowns with the least sum of squares, from a guess.
///
/// The closure adds the residuals of some unknowns. Where it fails away from the guess, as for a
/// length that is refused, the step was too long. The sum that is found is a least one near the
/// guess; there may be others, as of a phase.
///
/// ```
/// use holonom::prelude::*;
/// use holonom::sensitivity::fit;
///
/// /// A rod that swings, with a damper in its hinge.
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
/// struct Rod {
///     #[param] // N m s
///     damping: f64,
///     #[body(mass = 1.0, inertia = [0.1, 0.001, 0.1], position = [0.0, 0.5, 0.0])]
///     rod: Body,
///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
///     hinge: Revolute,
///     #[force(
///         between = [ground, rod], axis = [1.0, 0.0, 0.0], stiffness = 0.0, damping = damping
///     )]
///     oil: TorsionalSpringDamper,
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let h = Rod::HANDLES;
/// let mut measured = Vec::new();
/// Rod::new(0.2)?
///     .simulation(StandardLagrange, Rk4::every(0.01))
///     .run(0.0..=2.0, every(0.1), |sample| measured.push(sample.angle(h.hinge)))?;
///
/// let found = fit([0.05], |[damping], squares| -> Result<(), Box<dyn std::error::Error>> {
///     let mut measured = measured.iter();
///     Rod::new(damping)?
///         .sensitivities([h.damping])?
///         .simulation(StandardLagrange, Rk4::every(0.01))
///         .run(0.0..=2.0, every(0.1), |sample| {
///             let angle = measured.next().expect("as many as samples");
///             squares.compare(sample.angle(h.hinge), *angle);
///         })?;
///     Ok(())
/// })?;
/// assert!((found.values[0] - 0.2).abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
///
/// # Errors
/// [`FitError`].
pub fn fit<const N: usize, E>(
    guess: [f64; N],
    mut residuals: impl FnMut([f64; N], &mut Squares<N>) -> Result<(), E>,
) -> Result<Fit<N>, FitError<E>> {
    let mut at = SVector::from(guess);
    let mut squares_at = |at: &SVector<f64, N>| {
        let mut squares = Squares::none();
        residuals((*at).into(), &mut squares).map(|()| squares)
    };
    let mut here = squares_at(&at).map_err(FitError::Residuals)?;
    if !here.is_finite() {
        return Err(FitError::NotFinite);
    }
    let mut damping = 1e-3;
    for rounds in 1..=ROUNDS {
        if let Some(unknown) = here.without_effect() {
            return Err(FitError::NoEffect { unknown });
        }
        let (matrix, scales) = here.scaled(damping);
        let gradient = here.gradient.component_div(&scales);
        // In the scales of the unknowns.
        let step = matrix.try_inverse().map(|inverse| -(inverse * gradient));
        let step = step.unwrap_or_else(SVector::zeros);
        let gain = -step.dot(&gradient);
        let size = at.component_mul(&scales).norm();
        let next = at + step.component_div(&scales);
        if damping <= 1.0 && (step.norm() <= STEP * size || gain <= GAIN * here.sum) {
            // The last step is a correction of digits, and not worth another round.
            return match squares_at(&next) {
                Ok(there) if there.is_finite() => found(&next, &there, rounds),
                _ => found(&at, &here, rounds),
            };
        }
        match squares_at(&next) {
            Ok(there) if there.is_finite() && there.sum <= here.sum => {
                (at, here, damping) = (next, there, 0.1 * damping);
            }
            Err(error) if damping > 1e10 => return Err(FitError::Residuals(error)),
            _ if damping > 1e10 => return Err(FitError::NotConverged { rounds }),
            _ => damping *= 10.0,
        }
    }
    Err(FitError::NotConverged { rounds: ROUNDS })
}

/// The result, if every unknown has an effect of its own.
fn found<const N: usize, E>(
    at: &SVector<f64, N>,
    here: &Squares<N>,
    rounds: usize,
) -> Result<Fit<N>, FitError<E>> {
    let (matrix, scales) = here.scaled(0.0);
    let variances = matrix.try_inverse().map(|inverse| inverse.diagonal());
    let variances = variances.unwrap_or_else(|| SVector::repeat(f64::INFINITY));
    let is_alike = |variance: &f64| !(0.0..ALIKE).contains(variance);
    if let Some(unknown) = variances.iter().position(is_alike) {
        return Err(FitError::NoEffect { unknown });
    }
    let free = here.count.saturating_sub(N);
    let variance = if free == 0 {
        f64::INFINITY
    } else {
        here.sum / free as f64
    };
    let size = |own: f64| <f64 as Scalar>::sqrt(own * variance);
    let deviations = variances.zip_map(&scales, |own, scale| size(own) / scale);
    Ok(Fit {
        values: (*at).into(),
        deviations: deviations.into(),
        sum: here.sum,
        rounds,
    })
}

#[cfg(test)]
mod tests {
    use super::{Fit, FitError, Squares, fit};
    use crate::forward::Forward;
    use crate::math::scalar::Scalar as _;

    type Dual = Forward<f64, 2>;

    fn unknowns(at: [f64; 2]) -> [Dual; 2] {
        [0, 1].map(|k| {
            let mut direction = [0.0; 2];
            direction[k] = 1.0;
            Dual::new(at[k], direction)
        })
    }

    /// `a exp(-b t)`, every half of a second.
    fn decay(at: [f64; 2]) -> impl Iterator<Item = Dual> {
        let [a, b] = unknowns(at);
        (0..8_u8).map(move |k| a * (-b * Dual::constant(0.5 * f64::from(k))).exp())
    }

    fn decays(measured: [f64; 8], guess: [f64; 2]) -> Result<Fit<2>, FitError<&'static str>> {
        fit(guess, |at, squares| {
            for (reading, measured) in decay(at).zip(measured) {
                squares.compare(reading, measured);
            }
            Ok(())
        })
    }

    fn near(found: [f64; 2], wanted: [f64; 2], share: f64) {
        for (found, wanted) in found.into_iter().zip(wanted) {
            assert!((found / wanted - 1.0).abs() < share, "{found} {wanted}");
        }
    }

    /// By `least_squares` of SciPy 1.17.1 with tolerances of 1e-15, and the inverse of `J^T J`.
    #[test]
    fn noisy_numbers_fit_as_in_scipy() {
        let measured = [2.02, 1.19, 0.78, 0.41, 0.31, 0.13, 0.12, 0.04];
        let found = decays(measured, [1.0, 0.5]).expect("it fits");
        near(found.values, [2.013501229213869, 1.004603403791951], 1e-9);
        near(
            found.deviations,
            [0.033045792554142, 0.029697182660629],
            1e-8,
        );
        assert!((found.sum / 0.007535894114813103 - 1.0).abs() < 1e-12);
        assert!(found.rounds < 20, "{}", found.rounds);
    }

    #[test]
    fn exact_numbers_are_found_from_far_away() {
        let exact = |at| {
            let mut all = decay(at).map(|number| number.value());
            [(); 8].map(|()| all.next().expect("eight"))
        };
        let wanted = [-3.0, 0.7];
        for guess in [[1.0, 2.0], [-0.1, 0.0], [-3.0, 0.7], [50.0, 0.1]] {
            let found = decays(exact(wanted), guess).expect("it fits");
            near(found.values, wanted, 1e-12);
            assert!(found.sum < 1e-24);
        }
    }

    /// A line: `a + b t` with the textbook's deviations.
    #[test]
    fn a_line_has_the_deviations_of_the_textbook() {
        let measured = [1.0, 2.9, 5.2, 7.1];
        let found = fit([0.0, 0.0], |at, squares| -> Result<(), &str> {
            let [a, b] = unknowns(at);
            for (t, y) in (0..4_u8).zip(measured) {
                squares.compare(a + b * Dual::constant(f64::from(t)), y);
            }
            Ok(())
        })
        .expect("it fits");
        // Sums: t 6, t^2 14, y 16.2, t y 34.6; the determinant is 4 * 14 - 36 = 20.
        let (a, b) = (
            (14.0 * 16.2 - 6.0 * 34.6) / 20.0,
            (4.0 * 34.6 - 6.0 * 16.2) / 20.0,
        );
        near(found.values, [a, b], 1e-13);
        let errors = measured.iter().zip(0..4_u8);
        let sum: f64 = errors
            .map(|(y, t)| (a + b * f64::from(t) - y).powi(2))
            .sum();
        let variance = sum / 2.0;
        let wanted = [14.0 / 20.0, 4.0 / 20.0].map(|share: f64| (share * variance).sqrt());
        near(found.deviations, wanted, 1e-11);
    }

    #[test]
    fn what_cannot_be_found_is_refused() {
        let one = |which: [f64; 2]| {
            fit(
                [1.0, 1.0],
                |at, squares: &mut Squares<2>| -> Result<(), &str> {
                    let [a, b] = unknowns(at);
                    let line = a * Dual::constant(which[0]) + b * Dual::constant(which[1]);
                    for t in 1..5_u8 {
                        squares.compare(line * Dual::constant(f64::from(t)), f64::from(t));
                    }
                    Ok(())
                },
            )
        };
        assert_eq!(one([1.0, 0.0]), Err(FitError::NoEffect { unknown: 1 }));
        assert!(matches!(one([1.0, 2.0]), Err(FitError::NoEffect { .. })));
        assert!(matches!(one([f64::NAN, 1.0]), Err(FitError::NotFinite)));
        let none = fit([1.0, 1.0], |_, _| Ok::<(), &str>(()));
        assert_eq!(none, Err(FitError::NoEffect { unknown: 0 }));
        let refused = fit([1.0, 1.0], |_, _| Err("refused"));
        assert_eq!(refused, Err(FitError::Residuals("refused")));
        // Residuals that a step always makes larger: their derivatives are those of others.
        let wrong = fit([1.0, 1.0], |at, squares| -> Result<(), &str> {
            let [a, b] = unknowns(at);
            squares.add(Dual::new(at[0] * at[0] + 1.0, (-a).derivatives()));
            squares.add(b);
            Ok(())
        });
        assert!(matches!(wrong, Err(FitError::NotConverged { .. })));
    }

    /// Steps beyond what can be computed are taken back.
    #[test]
    fn failures_away_from_the_guess_shorten_steps() {
        let mut failures = 0;
        let found = fit([4.0, 1.0], |at, squares| {
            if at[0] <= 0.0 {
                failures += 1;
                return Err("a negative length");
            }
            let [a, b] = unknowns(at);
            squares.compare(a.reciprocal() * Dual::constant(4.0), 8.0);
            squares.compare(b, 3.0);
            Ok(())
        })
        .expect("it fits");
        near(found.values, [0.5, 3.0], 1e-10);
        assert!(failures > 0);
        assert_eq!(found.deviations, [f64::INFINITY; 2]);
    }
}
