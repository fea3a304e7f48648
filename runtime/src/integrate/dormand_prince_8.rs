//! The method of Dormand and Prince of order 8.

use super::tableau::scaled;
use super::tableau_853 as tableau;
use super::{Adaptive, EmbeddedPair, Ends, Scheme, Start, Stride, System};
use crate::error::Fault;
use crate::math::scalar::{Real, Scalar};
use crate::state::vector::Vector;

/// Dormand-Prince 8(5,3) with the step control of [`Adaptive`]: `12 k + 1` evaluations for `k`
/// steps, and three for every step that is looked into. For tight tolerances. Output within a step
/// is by the interpolant of order 7.
///
/// The error is `e5^2 / sqrt(e5^2 + 0.01 e3^2)` of the estimates of order 5 and 3, which goes with
/// the eighth power of the step (Hairer, Norsett and Wanner, *Solving Ordinary Differential
/// Equations I*, 2nd ed., (II.10.17), in the norm of [`Adaptive`]).
///
/// ```
/// use holonom::{DormandPrince853, Tolerance};
///
/// let tight = DormandPrince853::new(Tolerance { relative: 1e-12, absolute: 1e-15 });
/// assert_eq!(tight.limits.evaluations, 10_000_000);
/// ```
pub type DormandPrince853<S> = Adaptive<S, DormandPrince8>;

/// One step of Dormand-Prince, of order 8: twelve evaluations, one of them shared with the next
/// step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DormandPrince8;

/// The slopes at stages 6 to 12 of a step, and at 14 to 16 where it was looked into.
#[derive(Clone, Copy, Debug)]
pub struct DormandPrince8Stages<X> {
    late: [X; 7],
    between: [X; 3],
}

impl<X> DormandPrince8Stages<X> {
    /// Terms of slopes 1 and 6 to 12.
    #[inline(always)]
    fn terms<'a, S: Scalar>(&'a self, first: &'a X, weights: [S; 8]) -> [(S, &'a X); 8] {
        let [a, b, c, d, e, f, g, h] = weights;
        let [k6, k7, k8, k9, k10, k11, k12] = &self.late;
        [
            (a, first),
            (b, k6),
            (c, k7),
            (d, k8),
            (e, k9),
            (f, k10),
            (g, k11),
            (h, k12),
        ]
    }
}

impl<S: Real> EmbeddedPair<S> for DormandPrince8 {
    const POWER: f64 = 8.0;

    #[inline]
    fn error<X: Vector<S>>(
        &self,
        stride: &Stride<'_, S, X, DormandPrince8Stages<X>>,
        floor: S,
    ) -> S {
        let norm = |weights: [f64; 8]| {
            let terms = stride
                .stages
                .terms(stride.first, scaled(weights, stride.step));
            stride.from.relative_norm(stride.to, floor, terms)
        };
        let (fifth, third) = (norm(tableau::ERROR_5), norm(tableau::ERROR_3));
        if fifth == S::zero() {
            return fifth;
        }
        // Not squared: small numbers keep their digits.
        let ratio = S::constant(0.1) * third.quotient(fifth);
        fifth.quotient(ratio.fused(ratio, S::one()).sqrt())
    }
}

impl<S: Real> Scheme<S> for DormandPrince8 {
    type Stages<X: Vector<S>> = DormandPrince8Stages<X>;

    fn stages<X: Vector<S>>(&self, like: &X) -> DormandPrince8Stages<X> {
        DormandPrince8Stages {
            late: core::array::from_fn(|_| like.clone()),
            between: core::array::from_fn(|_| like.clone()),
        }
    }

    #[inline]
    fn stride<Y: System<S>>(
        &self,
        system: &mut Y,
        start: Start<'_, S, Y::State>,
        step: S,
        stages: &mut DormandPrince8Stages<Y::State>,
    ) -> Result<Y::State, Fault> {
        let Start {
            time,
            state,
            slope: k1,
        } = start;
        let [t2, t3, t4, t5, t6, t7, t8, t9, t10, t11] = scaled(tableau::TIMES, step);
        let [k6, k7, k8, k9, k10, k11, k12] = &mut stages.late;

        let [a] = scaled(tableau::STAGE_2, step);
        let mut k2 = k1.clone();
        system.stage(time + t2, &state.plus([(a, k1)]), &mut k2)?;
        let [a, b] = scaled(tableau::STAGE_3, step);
        let mut k3 = k1.clone();
        system.stage(time + t3, &state.plus([(a, k1), (b, &k2)]), &mut k3)?;
        let [a, b] = scaled(tableau::STAGE_4, step);
        let mut k4 = k1.clone();
        system.stage(time + t4, &state.plus([(a, k1), (b, &k3)]), &mut k4)?;
        let [a, b, c] = scaled(tableau::STAGE_5, step);
        let mut k5 = k1.clone();
        let stage = state.plus([(a, k1), (b, &k3), (c, &k4)]);
        system.stage(time + t5, &stage, &mut k5)?;
        let [a, b, c] = scaled(tableau::STAGE_6, step);
        let stage = state.plus([(a, k1), (b, &k4), (c, &k5)]);
        system.stage(time + t6, &stage, k6)?;
        let [a, b, c, d] = scaled(tableau::STAGE_7, step);
        let stage = state.plus([(a, k1), (b, &k4), (c, &k5), (d, k6)]);
        system.stage(time + t7, &stage, k7)?;
        let [a, b, c, d, e] = scaled(tableau::STAGE_8, step);
        let stage = state.plus([(a, k1), (b, &k4), (c, &k5), (d, k6), (e, k7)]);
        system.stage(time + t8, &stage, k8)?;
        let [a, b, c, d, e, f] = scaled(tableau::STAGE_9, step);
        let stage = state.plus([(a, k1), (b, &k4), (c, &k5), (d, k6), (e, k7), (f, k8)]);
        system.stage(time + t9, &stage, k9)?;
        let [a, b, c, d, e, f, g] = scaled(tableau::STAGE_10, step);
        let stage = state.plus([
            (a, k1),
            (b, &k4),
            (c, &k5),
            (d, k6),
            (e, k7),
            (f, k8),
            (g, k9),
        ]);
        system.stage(time + t10, &stage, k10)?;
        let [a, b, c, d, e, f, g, h] = scaled(tableau::STAGE_11, step);
        let stage = state.plus([
            (a, k1),
            (b, &k4),
            (c, &k5),
            (d, k6),
            (e, k7),
            (f, k8),
            (g, k9),
            (h, k10),
        ]);
        system.stage(time + t11, &stage, k11)?;
        let [a, b, c, d, e, f, g, h, i] = scaled(tableau::STAGE_12, step);
        let stage = state.plus([
            (a, k1),
            (b, &k4),
            (c, &k5),
            (d, k6),
            (e, k7),
            (f, k8),
            (g, k9),
            (h, k10),
            (i, k11),
        ]);
        system.stage(time + step, &stage, k12)?;
        Ok(state.plus(stages.terms(k1, scaled(tableau::RESULT, step))))
    }

    fn prepare<Y: System<S>>(
        &self,
        system: &mut Y,
        time: S,
        ends: Ends<'_, S, Y::State>,
        stages: &mut DormandPrince8Stages<Y::State>,
    ) -> Result<(), Fault> {
        let Ends {
            step,
            from,
            first: k1,
            last: k13,
        } = ends;
        let [k6, k7, k8, k9, k10, k11, k12] = &stages.late;
        let [k14, k15, k16] = &mut stages.between;
        let [t14, t15, t16] = scaled(tableau::TIMES_BETWEEN, step);
        let [a, b, c, d, e, f, g, h] = scaled(tableau::STAGE_14, step);
        let stage = from.plus([
            (a, k1),
            (b, k7),
            (c, k8),
            (d, k9),
            (e, k10),
            (f, k11),
            (g, k12),
            (h, k13),
        ]);
        *k14 = system.rates(time + t14, &stage)?;
        let [a, b, c, d, e, f, g, h] = scaled(tableau::STAGE_15, step);
        let stage = from.plus([
            (a, k1),
            (b, k6),
            (c, k7),
            (d, k8),
            (e, k11),
            (f, k12),
            (g, k13),
            (h, k14),
        ]);
        *k15 = system.rates(time + t15, &stage)?;
        let [a, b, c, d, e, f, g, h] = scaled(tableau::STAGE_16, step);
        let stage = from.plus([
            (a, k1),
            (b, k6),
            (c, k7),
            (d, k8),
            (e, k9),
            (f, k13),
            (g, k14),
            (h, k15),
        ]);
        *k16 = system.rates(time + t16, &stage)?;
        Ok(())
    }

    /// `y0 + x (F0 + (1 - x) (F1 + x (F2 + (1 - x) (F3 + x (F4 + (1 - x) (F5 + x F6))))))` at the
    /// fraction `x`: `F0` is the increment of the step, `F1 = h k1 - F0`,
    /// `F2 = 2 F0 - h (k1 + k13)`, the others are given. Here it is a sum of slopes.
    fn interpolate<X: Vector<S>>(
        &self,
        stride: Stride<'_, S, X, DormandPrince8Stages<X>>,
        theta: S,
    ) -> X {
        let rest = S::one() - theta;
        let [f3, f4, f5, f6] = tableau::INTERPOLANT;
        let result = tableau::RESULT;
        // Slopes 1 and 6 to 16.
        let weights: [S; 12] = core::array::from_fn(|k| {
            let of = |row: [f64; 12]| S::constant(row.get(k).copied().unwrap_or(0.0));
            let increment = S::constant(result.get(k).copied().unwrap_or(0.0));
            let is = |place: usize| S::constant(if k == place { 1.0 } else { 0.0 });
            let second = increment + increment - is(0) - is(8);
            let inner = of(f6).fused(theta, of(f5));
            let inner = inner.fused(rest, of(f4));
            let inner = inner.fused(theta, of(f3));
            let inner = inner.fused(rest, second);
            let inner = inner.fused(theta, is(0) - increment);
            let inner = inner.fused(rest, increment);
            stride.step * theta * inner
        });
        let [a, b, c, d, e, f, g, h, i, j, k, l] = weights;
        let [k6, k7, k8, k9, k10, k11, k12] = &stride.stages.late;
        let [k14, k15, k16] = &stride.stages.between;
        stride.from.plus([
            (a, stride.first),
            (b, k6),
            (c, k7),
            (d, k8),
            (e, k9),
            (f, k10),
            (g, k11),
            (h, k12),
            (i, stride.last),
            (j, k14),
            (k, k15),
            (l, k16),
        ])
    }
}
