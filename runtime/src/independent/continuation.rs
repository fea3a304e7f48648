//! Equilibria followed along a parameter, round the folds of their branch.

use core::fmt;
use core::ops::ControlFlow;

use super::folds::Passed;
use super::stability::negative;
use super::varied::{Adjusted, Varied};
use super::walk::{Spot, Walk};
use super::{IndependentCoordinates, Linearised};
use crate::error::{AnalysisFault, Fault, setting};
use crate::math::scalar::Real;
use crate::math::without_bounds::copied;
use crate::mechanism::joint_rates::{HasInverse, HasMassMatrix, JointRates};

/// The shortest step, of the longest.
const SHORTEST: f64 = 1e-6;

/// How equilibria are followed: along what, how far and in which steps.
pub struct Continuation<M, S = f64> {
    along: Varied<M>,
    end: S,
    step: S,
    points: usize,
}

impl<M, S: Real> Continuation<M, S> {
    /// Along a parameter or an input by its handle, or along a rate by [`Varied::rate`], from its
    /// present value to an end.
    #[must_use]
    pub fn new(along: impl Into<Varied<M>>, end: S) -> Self {
        Self {
            along: along.into(),
            end,
            step: S::constant(0.1),
            points: 1000,
        }
    }

    /// The longest step, 0.1 unless set: the root of the sum of squares of all changes, in radians,
    /// lengths of the mechanism and shares of the interval. Two folds within one step are not seen.
    #[must_use]
    pub const fn step(mut self, longest: S) -> Self {
        self.step = longest;
        self
    }

    /// The steps that may be taken, 1000 unless set.
    #[must_use]
    pub const fn points(mut self, most: usize) -> Self {
        self.points = most;
        self
    }
}

/// What a point of a branch is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PointKind {
    /// A point at the end of a step.
    Regular,
    /// A fold (limit point): the value turns back here, and stability changes.
    Fold,
    /// Stability changes while the value goes on: another branch passes through, as where a column
    /// buckles.
    Branching,
}

/// An equilibrium on a branch.
#[non_exhaustive]
pub struct BranchPoint<M: JointRates, const N: usize, S: Real = f64> {
    /// What it is.
    pub kind: PointKind,
    /// The value of the parameter or input, in its unit; of a rate rad/s or m/s.
    pub value: S,
    /// The state.
    pub state: M::JointState<S>,
    /// The equations there with the value set, such as for more readings.
    pub space: IndependentCoordinates<M, N, S>,
    /// The equations of motion, linear about the state: by positions, rates and the value.
    pub linear: Linearised<N, 1, 0, S>,
    /// The directions in which the equilibrium is unstable: negative eigenvalues of the stiffness
    /// (Lagrange and Dirichlet). At a fold or a branching one eigenvalue is zero and not counted.
    /// `None` in steady motion and where forces have no potential: there
    /// [`Linearised::modes`] decides.
    pub unstable: Option<usize>,
}

/// Why a branch was not followed further.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BranchEnd {
    /// The value reached the end that was asked for.
    Reached,
    /// The observer stopped it.
    Stopped,
    /// As many steps as it may take were taken.
    Points,
}

impl<M, const N: usize, S> IndependentCoordinates<M, N, S>
where
    M: HasInverse + HasMassMatrix,
    S: Real,
{
    /// Follows equilibria from one, `start`, while a parameter, an input or a rate changes from its
    /// present value to an end. The observer sees every point. It is told folds and branchings,
    /// which are found to round-off. The branch is followed round its folds: behind one the value
    /// goes back, possibly beyond where it began.
    ///
    /// Steps become shorter where the branch bends. Of a branching the branch that goes straight on
    /// is followed. In motion the rates of `start` stay, as in
    /// [`IndependentCoordinates::equilibrium`].
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// use core::ops::ControlFlow;
    /// use holonom::independent::{Continuation, PointKind};
    ///
    /// /// A block on a rail across a spring, which snaps through under a force.
    /// #[derive(Mechanism)]
    /// #[mechanism(coordinates = "joints", kernels = [mass, inverse])]
    /// struct Toggle {
    ///     #[input]
    ///     load: f64,
    ///     #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.3, 0.0])]
    ///     block: Body,
    ///     #[joint(between = [ground, block], point = [0.0, 0.3, 0.0], axis = [0.0, 1.0, 0.0])]
    ///     rail: Prismatic,
    ///     #[force(between = [ground, block], point = [0.0, 0.3, 0.0], force = [0.0, -load, 0.0])]
    ///     weight: PointForce,
    ///     #[force(
    ///         between = [ground, block],
    ///         head = [0.4, 0.0, 0.0],
    ///         tail = [0.0, 0.3, 0.0],
    ///         stiffness = 1000.0,
    ///         free_length = 0.5
    ///     )]
    ///     spring: SpringDamper,
    /// }
    ///
    /// let (toggle, h) = (Toggle::default(), Toggle::HANDLES);
    /// let space = toggle.coordinates([h.rail])?;
    /// let unloaded = space.state([0.0], [0.0])?;
    /// let mut largest: f64 = 0.0;
    /// space.follow(&unloaded, Continuation::new(h.load, 100.0), |point| {
    ///     if point.kind == PointKind::Fold {
    ///         largest = largest.max(point.value);
    ///     }
    ///     ControlFlow::Continue(())
    /// })?;
    /// // Where the length is the cube root of the free length and the square of 0.4 m.
    /// let length = (0.5_f64 * 0.16).cbrt();
    /// let height = (length * length - 0.16).sqrt();
    /// assert!((largest - 1000.0 * (0.5 / length - 1.0) * height).abs() < 1e-10);
    /// # Ok::<(), Fault>(())
    /// ```
    ///
    /// # Errors
    /// - [`AnalysisFault::BranchEnds`] with the last value: equilibria end, or bend more sharply
    ///   than steps can follow.
    /// - [`StepFault::NotConverged`](crate::error::StepFault::NotConverged) where the start is not
    ///   near an equilibrium.
    /// - [`AnalysisFault::NotSteady`], [`AnalysisFault::NotChosen`];
    ///   [`StartFault::Setting`](crate::error::StartFault::Setting) for the step,
    ///   [`Fault::Parameter`] for an end that is not finite.
    /// - What [`IndependentCoordinates::linearise`] refuses.
    pub fn follow(
        &self,
        start: &M::JointState<S>,
        continuation: Continuation<M, S>,
        mut observer: impl FnMut(&BranchPoint<M, N, S>) -> ControlFlow<()>,
    ) -> Result<BranchEnd, Fault> {
        let Continuation {
            along: varied,
            end,
            step,
            points,
        } = continuation;
        let along = varied.adjusted(&*self.equations.places)?;
        let step = setting::positive("step", step)?;
        let mut set = (*self, self.rates(start));
        let begin = self.present(along, &set.1);
        set.0.adjust(along, end, &mut set.1)?;
        set = (*self, self.rates(start));
        let interval = (end - begin).abs();
        let walk = Walk {
            along,
            end,
            scales: self.scales(),
            interval: if interval > S::zero() {
                interval
            } else {
                S::one()
            },
        };
        if let Adjusted::Rate(number) = along {
            // Of a coordinate on whose position something depends no rate is steady.
            let mut rates = set.1;
            let moves = if end == S::zero() { begin } else { end };
            rates
                .iter_mut()
                .skip(number)
                .take(1)
                .for_each(|rate| *rate = moves);
            let linear = self.linearise(start, [], |_| [])?;
            self.steady(start, &linear.by_positions, &rates)?;
        }
        let mut here = walk.start(&set, start).or_else(|fault| {
            // The cause, where a law jumps.
            self.off_jumps(start).and(Err(fault))
        })?;
        let slopes = &here.linear.by_positions;
        here.set.0.steady(&here.state, slopes, &here.set.1)?;
        if here.tangent.value * (end - begin) < S::zero() {
            here.tangent = here.tangent.scaled(-S::one());
        }
        let mut tell = |spot: &Spot<M, N, S>, kind| observer(&point(&walk, spot, kind)).is_break();
        if tell(&here, PointKind::Regular) {
            return Ok(BranchEnd::Stopped);
        }
        if end == begin {
            return Ok(BranchEnd::Reached);
        }
        let mut length = step;
        for _ in 0..points {
            let ended = Fault::Analysis(AnalysisFault::BranchEnds {
                along: varied.name(),
                value: here.value.to_f64(),
            });
            let shortest = step * S::constant(SHORTEST);
            // What cannot be searched through has led to another branch.
            let (next, passed) = loop {
                let next = walk.stepped(&here, &mut length, shortest).ok_or(ended)?;
                if let Ok(passed) = Passed::between(&walk, &here, (length, &next)) {
                    break (next, passed);
                }
                length = length * S::constant(0.5);
            };
            let Passed {
                fold,
                branching,
                last,
            } = passed;
            let fold = fold.map(|spot| (spot, PointKind::Fold));
            let branching = branching.map(|spot| (spot, PointKind::Branching));
            if let Some((spot, kind)) = fold.or(branching)
                && tell(&spot, kind)
            {
                return Ok(BranchEnd::Stopped);
            }
            if let Some(last) = last {
                let is_stopped = tell(&last, PointKind::Regular);
                return Ok([BranchEnd::Reached, BranchEnd::Stopped][usize::from(is_stopped)]);
            }
            if tell(&next, PointKind::Regular) {
                return Ok(BranchEnd::Stopped);
            }
            here = next;
            length = (length * S::constant(1.5)).min(step);
        }
        Ok(BranchEnd::Points)
    }
}

copied! {
    [M, S: Copy] Continuation<M, S>;
    [M: JointRates, const N: usize, S: Real] BranchPoint<M, N, S>;
}

impl<M, S: fmt::Debug> fmt::Debug for Continuation<M, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Continuation")
            .field("along", &self.along)
            .field("end", &self.end)
            .field("step", &self.step)
            .field("points", &self.points)
            .finish()
    }
}

impl<M: JointRates, const N: usize, S: Real> fmt::Debug for BranchPoint<M, N, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("BranchPoint")
            .field("kind", &self.kind)
            .field("value", &self.value)
            .field("state", &self.state)
            .field("unstable", &self.unstable)
            .finish_non_exhaustive()
    }
}

/// A point, as the observer sees it.
fn point<M: HasInverse + HasMassMatrix, const N: usize, S: Real>(
    walk: &Walk<N, S>,
    spot: &Spot<M, N, S>,
    kind: PointKind,
) -> BranchPoint<M, N, S> {
    BranchPoint {
        kind,
        value: spot.value,
        state: spot.state,
        space: spot.set.0,
        linear: spot.linear,
        unstable: walk.eigenvalues(spot).map(|values| negative(&values)),
    }
}
