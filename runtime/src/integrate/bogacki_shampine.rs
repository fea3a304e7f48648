//! The method of Bogacki and Shampine.

use super::{Adaptive, EmbeddedPair, Scheme, Start, Stride, System, dense};
use crate::error::Fault;
use crate::integrate::tableau::{bogacki_shampine as tableau, scaled};
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// Bogacki-Shampine 3(2) with the step control of MATLAB's `ode23`, see [`Adaptive`]: `3 k + 1`
/// evaluations for `k` steps. For loose tolerances. Output within a step is by the cubic through
/// states and slopes at both ends.
///
/// ```
/// use holonom::{BogackiShampine, Tolerance};
///
/// let ode23 = BogackiShampine::new(Tolerance { relative: 1e-3, absolute: 1e-6 });
/// assert_eq!(ode23.limits.evaluations, 10_000_000);
/// ```
pub type BogackiShampine<S> = Adaptive<S, BogackiShampine3>;

/// With `z` half the angle of a step, the method leaves `|p|` by `z^4 / 24` and an angle by
/// `z^5 / 15`: their ratio is below one where a step turns by less than a radian.
const TURNING_ERROR: f64 = 1.0;

/// One step of Bogacki-Shampine, of order 3: three evaluations, one of them shared with the next
/// step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BogackiShampine3;

/// The slopes at stages 2 and 3.
#[derive(Clone, Copy, Debug)]
pub struct BogackiShampineStages<X> {
    second: X,
    third: X,
}

impl<S: Real> EmbeddedPair<S> for BogackiShampine3 {
    const POWER: f64 = 3.0;

    #[inline]
    fn error<X: Vector<S>>(
        &self,
        stride: &Stride<'_, S, X, BogackiShampineStages<X>>,
        floor: S,
    ) -> S {
        let k = stride.stages;
        let [e1, e2, e3, e4] = scaled(tableau::ERROR, stride.step);
        let terms = [
            (e1, stride.first),
            (e2, &k.second),
            (e3, &k.third),
            (e4, stride.last),
        ];
        stride.from.relative_norm(stride.to, floor, terms)
    }
}

impl<S: Real> Scheme<S> for BogackiShampine3 {
    type Stages<X: Vector<S>> = BogackiShampineStages<X>;

    fn stages<X: Vector<S>>(&self, like: &X) -> BogackiShampineStages<X> {
        BogackiShampineStages {
            second: like.clone(),
            third: like.clone(),
        }
    }

    #[inline]
    fn stride<Y: System<S>>(
        &self,
        system: &mut Y,
        start: Start<'_, S, Y::State>,
        step: S,
        k: &mut BogackiShampineStages<Y::State>,
    ) -> Result<Y::State, Fault> {
        let Start {
            time,
            state,
            slope: k1,
        } = start;
        let [t2, t3] = scaled(tableau::TIMES, step);
        let [a] = scaled(tableau::STAGE_2, step);
        system.stage(time + t2, &state.plus([(a, k1)]), &mut k.second)?;
        let [a] = scaled(tableau::STAGE_3, step);
        system.stage(time + t3, &state.plus([(a, &k.second)]), &mut k.third)?;
        let [a, b, c] = scaled(tableau::RESULT, step);
        Ok(state.plus([(a, k1), (b, &k.second), (c, &k.third)]))
    }

    fn turning_error(&self) -> f64 {
        TURNING_ERROR
    }

    fn interpolate<X: Vector<S>>(
        &self,
        stride: Stride<'_, S, X, BogackiShampineStages<X>>,
        theta: S,
    ) -> X {
        dense::cubic(&stride, theta)
    }
}
