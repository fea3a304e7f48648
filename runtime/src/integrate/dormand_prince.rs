//! The method of Dormand and Prince.

use super::tableau::{dormand_prince as tableau, scaled};
use super::{
    AdaptiveCourse, FixedStep, Integrator, Scheme, Span, Start, Stride, System, Tolerance, dense,
};
use crate::array::Vector;
use crate::error::Fault;
use crate::scalar::{Real, Scalar};

/// Dormand-Prince 5(4) with the step control of MATLAB's `ode45`.
///
/// First-same-as-last: an integration without faults takes `6 k + 1` evaluations for `k` steps, accepted and
/// rejected. Output within a step is by the free interpolant of order 4. The control (Shampine and Reichelt, *The
/// MATLAB ODE Suite*, SIAM J. Sci. Comput. 18 (1997), 1-22, with the `ode45` of later versions):
///
/// - first step `min(T / 10, time to the first output)`, made smaller to `0.8 rtol^(1/5) / max |y'| / max(|y|, atol / rtol)`;
///   largest step `T / 10`, smallest `16 ulp(t)`;
/// - error `h max |E| / max(|y|, |y new|, atol / rtol)`, accepted up to `rtol`;
/// - after an acceptance `h / max(0.2, 1.25 (error / rtol)^(1/5))`, unchanged if the step had been rejected before;
/// - after a rejection `h max(0.1, 0.8 (rtol / error)^(1/5))`, then halves;
/// - the step is stretched to the end of the interval if `1.1 h` reaches it.
///
/// Beyond `ode45`: a trial whose rates cannot be computed counts as rejected and is tried again with half the step, and the
/// integration ends with that fault only where the step gets too small.
///
/// ```
/// use holonom::{DormandPrince, Tolerance};
///
/// let ode45 = DormandPrince::new(Tolerance { relative: 1e-6, absolute: 1e-9 });
/// assert_eq!(ode45, DormandPrince::default());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DormandPrince<S> {
    /// The error to be allowed in a step.
    pub tolerance: Tolerance<S>,
    /// What steps are held to besides.
    pub limits: StepLimits<S>,
}

/// What a step control is held to besides its tolerance. Nothing of it is set by default but the budget.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepLimits<S> {
    /// The first step (s), in the place of that of `ode45`.
    pub first: Option<S>,
    /// The smallest step (s): where a smaller one would be needed, the integration ends with
    /// [`Fault::StepSizeUnderflow`]. Never below the resolution of the time.
    pub least: Option<S>,
    /// The largest step (s), in the place of a tenth of the interval. What happens within a step and leaves no trace at its stages, such as a
    /// short pulse of a force, is not seen: a step must not be longer than that.
    pub largest: Option<S>,
    /// How many evaluations a run may take, [`StepLimits::EVALUATIONS`] by default: then it ends with [`Fault::Budget`].
    pub evaluations: usize,
}

impl<S> StepLimits<S> {
    /// Ten million evaluations. What takes more is most often caught at a singular configuration, or stiff.
    pub const EVALUATIONS: usize = 10_000_000;

    /// No limits but the budget of evaluations.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            first: None,
            least: None,
            largest: None,
            evaluations: Self::EVALUATIONS,
        }
    }
}

impl<S> Default for StepLimits<S> {
    fn default() -> Self {
        Self::new()
    }
}

impl<S> DormandPrince<S> {
    /// The method with a tolerance.
    #[must_use]
    pub const fn new(tolerance: Tolerance<S>) -> Self {
        Self {
            tolerance,
            limits: StepLimits::new(),
        }
    }

    /// Begins with this step (s).
    #[must_use]
    pub fn first_step(mut self, step: S) -> Self {
        self.limits.first = Some(step);
        self
    }

    /// Takes no step shorter than this (s); see [`StepLimits::least`].
    #[must_use]
    pub fn least_step(mut self, step: S) -> Self {
        self.limits.least = Some(step);
        self
    }

    /// Takes no step longer than this (s); see [`StepLimits::largest`].
    #[must_use]
    pub fn largest_step(mut self, step: S) -> Self {
        self.limits.largest = Some(step);
        self
    }

    /// Lets a run take so many evaluations; see [`StepLimits::evaluations`].
    #[must_use]
    pub fn budget(mut self, evaluations: usize) -> Self {
        self.limits.evaluations = evaluations;
        self
    }

    /// The same method at a fixed step (s), without control of the error; see [`DormandPrince5`].
    #[must_use]
    pub const fn every(step: S) -> FixedStep<S, DormandPrince5> {
        FixedStep {
            step,
            scheme: DormandPrince5,
        }
    }
}

/// With the default [`Tolerance`].
impl<S: Real> Default for DormandPrince<S> {
    fn default() -> Self {
        Self::new(Tolerance::default())
    }
}

impl<S: Real> Integrator<S> for DormandPrince<S> {
    type Course<X: Vector<S>> = AdaptiveCourse<S, X>;

    fn start<Y: System<S>>(
        &self,
        system: &mut Y,
        span: Span<S>,
        state: Y::State,
    ) -> Result<AdaptiveCourse<S, Y::State>, Fault> {
        AdaptiveCourse::start(self, system, span, state)
    }

    fn budget(&self) -> Option<usize> {
        Some(self.limits.evaluations)
    }

    fn turning_error(&self) -> f64 {
        TURNING_ERROR
    }

    fn tolerance(&self) -> Option<Tolerance<S>> {
        Some(self.tolerance)
    }
}

/// With `z` half the angle of a step, the method leaves `|p|` by `z^6 / 3600` and an angle by less than `z^7 / 3600`: their ratio is below one where a step
/// turns by less than two radians.
const TURNING_ERROR: f64 = 1.0;

/// One step of Dormand-Prince, of order 5: six evaluations, one of them shared with the next step where a
/// [`FixedStep`] drives it.
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

impl<X> DormandPrinceStages<X> {
    /// Weights and slopes of `h E`, the result less that of order 4.
    pub(super) fn error_terms<'a, S: Scalar>(
        &'a self,
        step: S,
        first: &'a X,
        last: &'a X,
    ) -> [(S, &'a X); 6] {
        let [e1, e3, e4, e5, e6, e7] = scaled(tableau::ERROR, step);
        [
            (e1, first),
            (e3, &self.third),
            (e4, &self.fourth),
            (e5, &self.fifth),
            (e6, &self.sixth),
            (e7, last),
        ]
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
