//! The method of Dormand and Prince.

use super::tableau::{dormand_prince as tableau, scaled};
use super::{Adaptive, EmbeddedPair, Scheme, Start, Stride, System, dense};
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// Dormand-Prince 5(4) with the step control of MATLAB's `ode45`, see [`Adaptive`]: `6 k + 1`
/// evaluations for `k` steps. Output within a step is by the free interpolant of order 4.
///
/// ```
/// use holonom::{DormandPrince, Tolerance};
///
/// let ode45 = DormandPrince::new(Tolerance { relative: 1e-6, absolute: 1e-9 });
/// assert_eq!(ode45, DormandPrince::default());
/// ```
pub type DormandPrince<S> = Adaptive<S, DormandPrince5>;

/// With `z` half the angle of a step, the method leaves `|p|` by `z^6 / 3600` and an angle by less
/// than `z^7 / 3600`: their ratio is below one where a step turns by less than two radians.
const TURNING_ERROR: f64 = 1.0;

/// One step of Dormand-Prince, of order 5: six evaluations, one of them shared with the next step
/// where a [`FixedStep`](super::FixedStep) drives it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DormandPrince5;

/// The slopes at stages 3 to 6.
#[derive(Clone, Copy, Debug)]
pub struct DormandPrinceStages<X> {
    pub(super) third: X,
    pub(super) fourth: X,
    pub(super) fifth: X,
    pub(super) sixth: X,
}

impl<S: Real> EmbeddedPair<S> for DormandPrince5 {
    const POWER: f64 = 5.0;

    #[inline]
    fn error<X: Vector<S>>(
        &self,
        stride: &Stride<'_, S, X, DormandPrinceStages<X>>,
        floor: S,
    ) -> S {
        let k = stride.stages;
        let [e1, e3, e4, e5, e6, e7] = scaled(tableau::ERROR, stride.step);
        let terms = [
            (e1, stride.first),
            (e3, &k.third),
            (e4, &k.fourth),
            (e5, &k.fifth),
            (e6, &k.sixth),
            (e7, stride.last),
        ];
        stride.from.relative_norm(stride.to, floor, terms)
    }
}

impl<S: Real> Scheme<S> for DormandPrince5 {
    type Stages<X: Vector<S>> = DormandPrinceStages<X>;

    fn stages<X: Vector<S>>(&self, like: &X) -> DormandPrinceStages<X> {
        DormandPrinceStages {
            third: like.clone(),
            fourth: like.clone(),
            fifth: like.clone(),
            sixth: like.clone(),
        }
    }

    #[inline]
    fn stride<Y: System<S>>(
        &self,
        system: &mut Y,
        start: Start<'_, S, Y::State>,
        step: S,
        k: &mut DormandPrinceStages<Y::State>,
    ) -> Result<Y::State, Fault> {
        let Start {
            time,
            state,
            slope: k1,
        } = start;
        let [t2, t3, t4, t5] = scaled(tableau::TIMES, S::one());
        let at = |fraction: S| fraction.fused(step, time);

        let [a] = scaled(tableau::STAGE_2, step);
        let mut k2 = k1.clone();
        system.stage(at(t2), &state.plus([(a, k1)]), &mut k2)?;
        let [a, b] = scaled(tableau::STAGE_3, step);
        let stage = state.plus([(a, k1), (b, &k2)]);
        system.stage(at(t3), &stage, &mut k.third)?;
        let [a, b, c] = scaled(tableau::STAGE_4, step);
        let stage = state.plus([(a, k1), (b, &k2), (c, &k.third)]);
        system.stage(at(t4), &stage, &mut k.fourth)?;
        let [a, b, c, d] = scaled(tableau::STAGE_5, step);
        let stage = state.plus([(a, k1), (b, &k2), (c, &k.third), (d, &k.fourth)]);
        system.stage(at(t5), &stage, &mut k.fifth)?;
        let [a, b, c, d, e] = scaled(tableau::STAGE_6, step);
        let stage = state.plus([
            (a, k1),
            (b, &k2),
            (c, &k.third),
            (d, &k.fourth),
            (e, &k.fifth),
        ]);
        system.stage(time + step, &stage, &mut k.sixth)?;
        let [a, b, c, d, e] = scaled(tableau::RESULT, step);
        Ok(state.plus([
            (a, k1),
            (b, &k.third),
            (c, &k.fourth),
            (d, &k.fifth),
            (e, &k.sixth),
        ]))
    }

    fn turning_error(&self) -> f64 {
        TURNING_ERROR
    }

    fn interpolate<X: Vector<S>>(
        &self,
        stride: Stride<'_, S, X, DormandPrinceStages<X>>,
        theta: S,
    ) -> X {
        let [w1, w3, w4, w5, w6, w7] = dense::quartic_weights(stride.step, theta);
        let k = stride.stages;
        stride.from.plus([
            (w1, stride.first),
            (w3, &k.third),
            (w4, &k.fourth),
            (w5, &k.fifth),
            (w6, &k.sixth),
            (w7, stride.last),
        ])
    }
}
