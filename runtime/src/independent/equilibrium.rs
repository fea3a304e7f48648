//! States in which nothing accelerates: at rest, and in steady motion.

use nalgebra::SVector;

use super::IndependentCoordinates;
use super::balance::{Reached, longest, newton, not_converged, row_sizes, square};
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::joint_rates::{HasInverse, HasMassMatrix};

/// Steps that may be taken.
pub(super) const STEPS: usize = 200;
/// Halvings of a step.
pub(super) const HALVINGS: usize = 12;
/// Steps along the accelerations, where Newton's lead nowhere.
const FALLS: usize = 25;

impl<M, const N: usize, S> IndependentCoordinates<M, N, S>
where
    M: HasInverse + HasMassMatrix,
    S: Real,
{
    /// The equilibrium near a state: the positions in which the coordinates do not accelerate under
    /// the described forces, with the rates that they have in `guess`. These are zero for a
    /// mechanism at rest. A coordinate on whose position nothing depends, the angle of a shaft, may
    /// have one: then the motion is steady.
    ///
    /// By Newton's method on exact derivatives, in steps of at most a radian or a length of the
    /// mechanism. Where that does not lead on, it steps down along the accelerations. Which
    /// equilibrium is found, where there are several, depends on the guess: near one it is that,
    /// from afar rather one below. Whether it is stable is told by
    /// [`Linearised::modes`](super::Linearised::modes).
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// /// A rod on a hinge, held by a spring.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, inverse])]
    /// struct Lever {
    ///     #[body(mass = 2.0, inertia = [0.2, 0.2, 0.2], position = [0.0, 0.5, 0.0])]
    ///     rod: Body,
    ///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    ///     hinge: Revolute,
    ///     #[force(between = [ground, rod], axis = [1.0, 0.0, 0.0], stiffness = 30.0)]
    ///     spring: TorsionalSpringDamper,
    /// }
    ///
    /// let (lever, h) = (Lever::default(), Lever::HANDLES);
    /// let space = lever.coordinates([h.hinge])?;
    /// let rest = space.equilibrium(&space.state([0.0], [0.0])?)?;
    /// let angle = space.positions(&rest)?[0];
    /// // The moment of the spring holds the weight.
    /// assert!((30.0 * angle + 9.81 * angle.cos()).abs() < 1e-13);
    /// # Ok::<(), Fault>(())
    /// ```
    ///
    /// # Errors
    /// [`AnalysisFault::NotSteady`] for a rate of a coordinate on which something depends;
    /// [`StepFault::NotConverged`](crate::error::StepFault::NotConverged) with the largest
    /// acceleration that is left (rad/s^2, m/s^2);
    /// [`AnalysisFault::OnSwitch`](crate::error::AnalysisFault::OnSwitch) where a law jumps in the
    /// state that was found, as dry friction that holds it does: it is one of many;
    /// [`AssemblyFault::BeyondLimit`](crate::error::AssemblyFault::BeyondLimit) of one that lies
    /// beyond a limit of the description, unless the space is
    /// [`without_limits`](IndependentCoordinates::without_limits), for a stop is no force here;
    /// what [`IndependentCoordinates::linearise`] refuses.
    ///
    /// [`AnalysisFault::NotSteady`]: crate::error::AnalysisFault::NotSteady
    pub fn equilibrium(&self, guess: &M::JointState<S>) -> Result<M::JointState<S>, Fault> {
        let rates = self.rates(guess);
        let scales = self.scales();
        let tolerance = S::EPSILON.powf(0.75);
        let mut state = *guess;
        let mut falls = 0;
        let mut left = self.accelerations(&state)?;
        for taken in 0..STEPS {
            let linear = self.linearise_by(&state, &[])?;
            let slopes = linear.by_positions;
            let (way, unexplained) = newton(&slopes, &left, &scales);
            let widest = longest(&way, &scales);
            let floor = self.floor(&state, &slopes, &linear.by_efforts, &scales)?;
            let is_explained = unexplained
                .iter()
                .zip(floor)
                .all(|(off, floor)| off.abs() <= floor);
            if widest <= tolerance && is_explained {
                // As near as the numbers go.
                if let Ok(next) = self.displaced(&state, &way, &rates) {
                    state = next;
                }
                self.off_jumps(&state)?;
                let found = self.steady(&state, &slopes, &rates)?;
                return self.within_limits(found);
            }
            let rows = row_sizes(&slopes, &scales);
            let before = square(&left, &rows);
            let mut share = S::one();
            if widest > S::one() {
                share = widest.reciprocal();
            }
            // From afar rather down than up.
            let may_fall = falls < FALLS;
            let is_up = widest > S::one() && self.power(&state, &left, &way)? < S::zero();
            let mut found = None;
            if !(is_up && may_fall) {
                found = self.halved(&state, (&way, share), &rates, |there, share| {
                    square(there, &rows) < before * (S::one() - share * S::constant(1e-4))
                });
            }
            if found.is_none() && may_fall {
                falls += 1;
                found = self.fallen(&state, &left, &rates);
            }
            let Some(next) = found else {
                // The cause, where something moves that should not.
                self.steady(&state, &slopes, &rates)?;
                return Err(not_converged(taken, &left));
            };
            (state, left) = next;
        }
        Err(not_converged(STEPS, &left))
    }

    /// A share of a way, halved until what is wanted of the accelerations holds there.
    fn halved(
        &self,
        state: &M::JointState<S>,
        (way, mut share): (&[S; N], S),
        rates: &SVector<S, N>,
        is_wanted: impl Fn(&SVector<S, N>, S) -> bool,
    ) -> Option<Reached<M, N, S>> {
        for _ in 0..HALVINGS {
            let step = way.map(|way| way * share);
            let next = self.reached(state, &step, rates);
            if let Some((_, there)) = &next
                && is_wanted(there, share)
            {
                return next;
            }
            share = share * S::constant(0.5);
        }
        None
    }

    /// A step along the accelerations.
    fn fallen(
        &self,
        state: &M::JointState<S>,
        left: &SVector<S, N>,
        rates: &SVector<S, N>,
    ) -> Option<Reached<M, N, S>> {
        /// Its length (rad, lengths of the mechanism).
        const FALL: f64 = 0.2;
        let scales = self.scales();
        let mut down: [S; N] = (*left).into();
        for (down, &scale) in down.iter_mut().zip(&scales) {
            *down = *down * scale;
        }
        let longest = longest(&down, &scales);
        if longest <= S::zero() {
            return None;
        }
        let step = down.map(|down| (down * S::constant(FALL)).quotient(longest));
        self.reached(state, &step, rates)
    }

    /// The work that the forces of these accelerations would do on a way.
    fn power(
        &self,
        state: &M::JointState<S>,
        left: &SVector<S, N>,
        way: &[S; N],
    ) -> Result<S, Fault> {
        let mass = self.mass(state)?;
        let entries = (0..N).flat_map(|row| (0..N).map(move |column| (row, column)));
        Ok(entries.fold(S::zero(), |sum, (row, column)| {
            (mass[(row, column)] * left[column]).fused(way[row], sum)
        }))
    }
}
