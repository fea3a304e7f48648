//! The gain of a linear-quadratic regulator.

use nalgebra::SMatrix;

/// Doublings, each of which looks twice as far ahead: 60 are more steps than any loop makes.
const DOUBLINGS: usize = 60;
/// What is left of a state, when the loop is closed, that counts as nothing.
const LEFT: f64 = 1e-12;

/// The gain `K` of `u = -K x` that minimises the sum over all steps of `x^T Q x + u^T R u`, for
/// `x(t + dt) = A x + B u`: `A` and `B` are those of [`to_discrete`](super::to_discrete).
///
/// The order of `x` is that of [`Linearised`](super::Linearised): coordinates, then their rates.
/// `Q` and `R` are symmetric, `Q` without negative eigenvalues. What counts of them is their
/// symmetric part.
///
/// `None` where no such gain brings every state to rest. Then `u` does not reach a motion that does
/// not decay by itself, or `Q` does not weigh it. `None` too where `R` is not positive definite, or
/// a number is not finite.
///
/// From the discrete algebraic Riccati equation by structured doubling (Chu, Fan, Lin and Wang,
/// *Structure-preserving algorithms for periodic discrete-time algebraic Riccati equations*,
/// International Journal of Control 77 (2004), 767-788).
///
/// ```
/// use holonom::independent::{discrete_lqr, to_discrete};
/// use holonom::nalgebra::{Matrix1, Matrix2, Vector2};
///
/// // A mass of 1 kg that a force moves, in steps of 10 ms.
/// let (a, b) = (Matrix2::new(0.0, 1.0, 0.0, 0.0), Vector2::new(0.0, 1.0));
/// let (a, b) = to_discrete(&a, &b, 0.01);
/// let gain = discrete_lqr(&a, &b, &Matrix2::identity(), &Matrix1::new(1.0)).expect("it can");
/// // Without steps they were 1 N/m and sqrt(3) N s/m.
/// assert!((gain - Vector2::new(1.0, 3_f64.sqrt()).transpose()).amax() < 0.02);
/// ```
#[must_use]
pub fn discrete_lqr<const X: usize, const U: usize>(
    a: &SMatrix<f64, X, X>,
    b: &SMatrix<f64, X, U>,
    q: &SMatrix<f64, X, X>,
    r: &SMatrix<f64, U, U>,
) -> Option<SMatrix<f64, U, X>> {
    let (q, r) = ((q + q.transpose()) * 0.5, (r + r.transpose()) * 0.5);
    let inverse = r.cholesky()?.inverse();
    // Over some steps, twice as many each time: the transition, in the end with the loop closed.
    // Then how far inputs of unit cost lead, and the cost of what is there at their start.
    let (mut transition, mut reach, mut cost) = (*a, b * inverse * b.transpose(), q);
    for _ in 0..DOUBLINGS {
        let inner = (SMatrix::identity() + reach * cost).try_inverse()?;
        let change = transition.transpose() * cost * inner * transition;
        reach += transition * inner * reach * transition.transpose();
        transition = transition * inner * transition;
        cost += change;
        if change.amax() <= f64::EPSILON * cost.amax() && transition.amax() <= LEFT {
            let gain = (r + b.transpose() * cost * b).try_inverse()? * b.transpose() * cost * a;
            return gain.iter().all(|entry| entry.is_finite()).then_some(gain);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix1, Matrix2, SMatrix, Vector2};

    use super::discrete_lqr;

    fn single(a: f64, b: f64, q: f64, r: f64) -> Option<f64> {
        let [a, b, q, r] = [a, b, q, r].map(Matrix1::new);
        discrete_lqr(&a, &b, &q, &r).map(|gain| gain[0])
    }

    /// Of one state, `b^2 p^2 + (r - a^2 r - b^2 q) p - q r = 0` and `k = a b p / (r + b^2 p)`.
    #[test]
    fn one_state_has_a_quadratic_equation() {
        for (a, b, q, r) in [
            (1.1, 0.5, 2.0, 3.0),
            (0.9, 0.01, 1.0, 1e-4),
            (-2.0, 1.0, 1e-3, 10.0),
            (1.0, 1e-3, 1.0, 1.0),
        ] {
            let (two, one): (f64, f64) = (b * b, r - a * a * r - b * b * q);
            let p = ((one * one + 4.0 * two * q * r).sqrt() - one) / (2.0 * two);
            let wanted = a * b * p / (r + b * b * p);
            let found = single(a, b, q, r).expect("it can be held");
            assert!((found / wanted - 1.0).abs() < 1e-11, "{found} {wanted}");
            assert!((a - b * found).abs() < 1.0);
        }
    }

    #[test]
    fn what_cannot_be_held_has_no_gain() {
        // Not reached, not weighed, without a price, with a wrong one, not a number.
        assert_eq!(single(1.1, 0.0, 1.0, 1.0), None);
        assert_eq!(single(1.1, 1.0, 0.0, 1.0), None);
        assert_eq!(single(1.0, 1.0, 0.0, 1.0), None);
        assert_eq!(single(0.5, 1.0, 1.0, 0.0), None);
        assert_eq!(single(0.5, 1.0, 1.0, -1.0), None);
        assert_eq!(single(f64::NAN, 1.0, 1.0, 1.0), None);
        assert_eq!(single(0.5, 1.0, f64::INFINITY, 1.0), None);
        // What decays by itself needs none.
        assert_eq!(single(0.5, 0.0, 1.0, 1.0), Some(0.0));
        let a = Matrix2::new(1.2, 0.0, 0.3, 0.8);
        let gain = |b| discrete_lqr(&a, &b, &Matrix2::identity(), &Matrix1::new(1.0));
        assert!(gain(Vector2::new(1.0, 0.0)).is_some());
        assert_eq!(gain(Vector2::new(0.0, 1.0)), None);
    }

    #[test]
    fn the_symmetric_part_of_weights_counts() {
        let a = Matrix2::new(1.2, 0.1, 0.3, 0.8);
        let b = Matrix2::new(1.0, 0.2, 0.0, 0.5);
        let skew = Matrix2::new(0.0, 0.7, -0.7, 0.0);
        let q = SMatrix::identity();
        let r = Matrix2::new(2.0, 0.5, 0.5, 1.0);
        let plain = discrete_lqr(&a, &b, &q, &r).expect("it can be held");
        let turned = discrete_lqr(&a, &b, &(q + skew), &(r + skew)).expect("it can be held");
        assert!((plain - turned).amax() < 1e-14);
    }
}
