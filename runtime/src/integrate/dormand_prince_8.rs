//! The method of Dormand and Prince of order 8.

use super::explicit::explicit;
use super::tableau::terms;
use super::tableau_853 as tableau;
use super::{Adaptive, EmbeddedPair, StepEnds, StepRecord};
use crate::math::scalar::Real;
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

explicit! {
    /// One step of Dormand-Prince, of order 8: twelve evaluations, one of them shared with the next
    /// step.
    ///
    /// It keeps slopes 6 to 12, and 14 to 16 where a step was looked into.
    DormandPrince8;
    slopes {
        k1, inner [k2, k3, k4, k5],
        kept [k6, k7, k8, k9, k10, k11, k12, _k14, _k15, _k16]
    }
    stages {
        0.052_600_151_958_767_73 => k2 { k1: 0.052_600_151_958_767_73 }
        0.078_900_227_938_151_6 => k3 { k1: 0.019_725_056_984_537_9, k2: 0.059_175_170_953_613_7 }
        0.118_350_341_907_227_4 => k4 { k1: 0.029_587_585_476_806_85, k3: 0.088_762_756_430_420_54 }
        0.281_649_658_092_772_6 => k5 {
            k1: 0.241_365_134_159_266_7,
            k3: -0.884_549_479_328_286_1,
            k4: 0.924_834_003_261_792,
        }
        0.333_333_333_333_333_3 => k6 {
            k1: 0.037_037_037_037_037_035,
            k4: 0.170_828_608_729_473_86,
            k5: 0.125_467_687_566_822_42,
        }
        0.25 => k7 {
            k1: 0.037_109_375,
            k4: 0.170_252_211_019_544_05,
            k5: 0.060_216_538_980_455_96,
            k6: -0.017_578_125,
        }
        0.307_692_307_692_307_7 => k8 {
            k1: 0.037_092_000_118_504_79,
            k4: 0.170_383_925_712_239_98,
            k5: 0.107_262_030_446_373_28,
            k6: -0.015_319_437_748_624_402,
            k7: 0.008_273_789_163_814_023,
        }
        0.651_282_051_282_051_3 => k9 {
            k1: 0.624_110_958_716_075_7,
            k4: -3.360_892_629_446_941_4,
            k5: -0.868_219_346_841_726,
            k6: 27.592_099_699_446_71,
            k7: 20.154_067_550_477_894,
            k8: -43.489_884_181_069_96,
        }
        0.6 => k10 {
            k1: 0.477_662_536_438_264_34,
            k4: -2.488_114_619_971_667_7,
            k5: -0.590_290_826_836_843,
            k6: 21.230_051_448_181_193,
            k7: 15.279_233_632_882_423,
            k8: -33.288_210_968_984_86,
            k9: -0.020_331_201_708_508_627,
        }
        0.857_142_857_142_857_1 => k11 {
            k1: -0.937_142_430_085_987_3,
            k4: 5.186_372_428_844_064,
            k5: 1.091_437_348_996_729_5,
            k6: -8.149_787_010_746_927,
            k7: -18.520_065_659_996_96,
            k8: 22.739_487_099_350_505,
            k9: 2.493_605_552_679_652_3,
            k10: -3.046_764_471_898_219_6,
        }
        1.0 => k12 {
            k1: 2.273_310_147_516_538,
            k4: -10.534_495_466_737_25,
            k5: -2.000_872_058_224_862_5,
            k6: -17.958_931_863_118_8,
            k7: 27.948_884_529_419_96,
            k8: -2.858_998_277_135_023_5,
            k9: -8.872_856_933_530_63,
            k10: 12.360_567_175_794_303,
            k11: 0.643_392_746_015_763_6,
        }
    }
    result {
        k1: tableau::RESULT[0],
        k6: tableau::RESULT[1],
        k7: tableau::RESULT[2],
        k8: tableau::RESULT[3],
        k9: tableau::RESULT[4],
        k10: tableau::RESULT[5],
        k11: tableau::RESULT[6],
        k12: tableau::RESULT[7],
    }
    model {}
    items {
        fn prepare<Y: System<S>>(
            &self,
            system: &mut Y,
            time: S,
            ends: StepEnds<'_, S, Y::State>,
            stages: &mut Self::Stages<Y::State>,
        ) -> Result<(), Fault> {
            let StepEnds { step, from, first: k1, last: k13 } = ends;
            let [k6, k7, k8, k9, k10, k11, k12, k14, k15, k16] = stages;
            let at = |part| time + S::constant(part) * step;
            let [t14, t15, t16] = tableau::TIMES_BETWEEN.map(at);
            let slopes = [k1, k7, k8, k9, k10, k11, k12, k13];
            *k14 = system.rates(t14, &from.plus(terms(tableau::STAGE_14, step, slopes)))?;
            let slopes = [k1, k6, k7, k8, k11, k12, k13, k14];
            *k15 = system.rates(t15, &from.plus(terms(tableau::STAGE_15, step, slopes)))?;
            let slopes = [k1, k6, k7, k8, k9, k13, k14, k15];
            *k16 = system.rates(t16, &from.plus(terms(tableau::STAGE_16, step, slopes)))?;
            Ok(())
        }

        /// `y0 + x (F0 + (1 - x) (F1 + x (F2 + (1 - x) (F3 + x (F4 + (1 - x) (F5 + x F6))))))` at
        /// the fraction `x`: `F0` is the increment of the step, `F1 = h k1 - F0`,
        /// `F2 = 2 F0 - h (k1 + k13)`, the others are given. Here it is a sum of slopes.
        fn interpolate<X: Vector<S>>(
            &self,
            record: StepRecord<'_, S, X, Self::Stages<X>>,
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
                record.step * theta * inner
            });
            let [a, b, c, d, e, f, g, h, i, j, k, l] = weights;
            let [k6, k7, k8, k9, k10, k11, k12, k14, k15, k16] = record.stages;
            record.from.plus([
                (a, record.first),
                (b, k6),
                (c, k7),
                (d, k8),
                (e, k9),
                (f, k10),
                (g, k11),
                (h, k12),
                (i, record.last),
                (j, k14),
                (k, k15),
                (l, k16),
            ])
        }
    }
}

impl<S: Real> EmbeddedPair<S> for DormandPrince8 {
    const POWER: f64 = 8.0;

    #[inline]
    fn error<X: Vector<S>>(&self, record: &StepRecord<'_, S, X, [X; 10]>, floor: S) -> S {
        let [k6, k7, k8, k9, k10, k11, k12, ..] = record.stages;
        let slopes = [record.first, k6, k7, k8, k9, k10, k11, k12];
        let norm = |weights: [f64; 8]| {
            let terms = terms(weights, record.step, slopes);
            record.from.weighted_norm(record.to, floor, terms)
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
