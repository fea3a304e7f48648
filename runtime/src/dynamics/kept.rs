//! How near equations that depend on each other are to a configuration where more of them do.
//!
//! Their pivots vanish everywhere, so the rank is followed by the least eigenvalue beside zero of
//! the rows' own matrix, `G = D M^-1 D^T`, in the scale of its diagonal.

use super::{Dynamics, Solvable};
use crate::constraints::rows::Rows;
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::{Compliant, Mechanism, Pivot};
use crate::state::vector::Array;

/// Steps of the inverse iteration. Near a singular configuration one is enough; far from it any
/// estimate is.
const ITERATIONS: usize = 3;

impl<P, S: Real, M: Mechanism, C: Coordinates<M>> Dynamics<P>
where
    P: Solvable<Number = S, Mechanism = M, Coordinates = C>,
{
    /// The least eigenvalue beside zero of `S^-1 G S^-1`, with `S^2` the diagonal of `G`, and the
    /// joint whose rows have most of it. It goes with the square of the distance from where it
    /// vanishes, as a relative pivot does, down to the compliance that keeps the matrix regular.
    ///
    /// An inverse iteration with `e = sqrt(EPSILON)`: `x / (G + e)`, and `x - e x / (G + e)`, by
    /// which what depends on others for good drops out.
    #[inline(never)]
    pub(super) fn kept_pivot(&self, time: S, state: &M::State<S>) -> Pivot<S> {
        let rows = Rows::<S, M>::at(self.constants(), time, state);
        let stiffness = rows.stiffness.as_slice();
        let largest = stiffness.iter().fold(S::zero(), |most, &x| most.max(x));
        let compliance = S::EPSILON.sqrt();
        let least = compliance * largest;
        let mut compliances = M::Multipliers::<S>::zeros();
        let mut scales = M::Multipliers::<S>::zeros();
        let places = compliances.as_mut_slice().iter_mut();
        let places = places.zip(scales.as_mut_slice()).zip(stiffness);
        for ((e, scale), &g) in places {
            let g = g.max(least);
            *e = compliance * g;
            *scale = g.sqrt();
        }
        let (constants, scales) = (self.constants(), scales.as_slice());
        let coefficients = M::coefficients_by_row(constants, &self.stabilisation, &compliances);
        let (factors, _) = M::factor::<S, Compliant>(constants, &coefficients, time, state);
        let solve = |x: &M::Multipliers<S>| {
            let mut lower = *x;
            for (b, &scale) in lower.as_mut_slice().iter_mut().zip(scales) {
                *b = -(*b * scale);
            }
            let nothing = M::Velocities::<S>::zeros();
            let (_, mut solved) =
                M::solve::<S, Compliant>(constants, &coefficients, &factors, &nothing, &lower);
            for (y, &scale) in solved.as_mut_slice().iter_mut().zip(scales) {
                *y = *y * scale;
            }
            solved
        };
        // What depends on others for good drops out.
        let independent = |x: &M::Multipliers<S>| {
            let mut rest = *x;
            let dependent = solve(x);
            for (x, &y) in rest.as_mut_slice().iter_mut().zip(dependent.as_slice()) {
                *x = *x - compliance * y;
            }
            rest
        };
        let mut x = independent(&beginning::<S, M>());
        let mut eigenvalue = S::one();
        for _ in 0..ITERATIONS {
            let size = norm(x.as_slice());
            if size <= S::smallest() || !size.is_finite() {
                break;
            }
            for x in x.as_mut_slice() {
                *x = x.quotient(size);
            }
            let solved = solve(&x);
            eigenvalue = norm(solved.as_slice()).reciprocal();
            x = independent(&solved);
        }
        Pivot {
            relative: eigenvalue,
            joint: S::constant(joint_of::<S, M>(x.as_slice()) as f64),
        }
    }
}

/// Numbers without a pattern that a mechanism could share, from 0.5 to 1 (Weyl's sequence of the
/// golden ratio).
fn beginning<S: Real, M: Mechanism>() -> M::Multipliers<S> {
    let mut x = M::Multipliers::<S>::zeros();
    let mut fraction = 0.5;
    for (k, x) in x.as_mut_slice().iter_mut().enumerate() {
        fraction += 0.618_033_988_749_894_9;
        if fraction >= 1.0 {
            fraction -= 1.0;
        }
        let size = 0.5 + 0.5 * fraction;
        *x = S::constant(if k % 3 == 1 { -size } else { size });
    }
    x
}

fn norm<S: Real>(elements: &[S]) -> S {
    let sum = elements.iter().fold(S::zero(), |sum, &x| x.fused(x, sum));
    sum.sqrt()
}

/// The joint of the largest element.
fn joint_of<S: Real, M: Mechanism>(rows: &[S]) -> usize {
    let mut largest = (S::zero(), 0);
    for (place, joint) in M::REPORT.joints.iter().enumerate() {
        for x in rows.iter().skip(joint.row).take(joint.rows) {
            if x.abs() > largest.0 {
                largest = (x.abs(), place);
            }
        }
    }
    largest.1
}
