//! Points of a branch of equilibria, and steps from one to another.
//!
//! By pseudo-arclength (Keller 1977). A step goes along the tangent of the branch, and Newton's
//! method leads back to it in the plane across. There is no bordered system: the unknown with the
//! largest share in the tangent is the parameter of the branch (Rheinboldt 1986). So the matrix is
//! regular at a fold, too.

use nalgebra::SVector;

use super::Linearised;
use super::balance::{longest, not_converged, solved};
use super::stability::eigenvalues;
use super::trim::{Set, Trial, sizes, trial, unit, with_values};
use super::varied::Adjusted;
use crate::error::{Fault, StepFault};
use crate::math::scalar::Real;
use crate::math::without_bounds::copied;
use crate::mechanism::joint_rates::{HasInverse, HasMassMatrix, JointRates};

/// Corrections of a point: more, and the step is too long.
const CORRECTIONS: usize = 12;
/// The cosine of the angle that a tangent may turn by in a step.
const STRAIGHT: f64 = 0.9;
/// A direction in the space of positions and the value.
#[derive(Clone, Copy)]
pub(super) struct Tangent<const N: usize, S> {
    pub(super) way: [S; N],
    pub(super) value: S,
}

/// A point of a branch, and the direction in which the branch goes on.
pub(super) struct Spot<M: JointRates, const N: usize, S: Real> {
    pub(super) set: Set<M, N, S>,
    pub(super) state: M::JointState<S>,
    pub(super) value: S,
    pub(super) linear: Linearised<N, 1, 0, S>,
    pub(super) tangent: Tangent<N, S>,
    /// How far corrections have led.
    pub(super) off: S,
}

/// What a branch is measured by.
#[derive(Clone, Copy)]
pub(super) struct Walk<const N: usize, S> {
    pub(super) along: Adjusted,
    pub(super) end: S,
    /// Radians and lengths of the mechanism.
    pub(super) scales: [S; N],
    /// The interval of the value.
    pub(super) interval: S,
}

copied!([M: JointRates, const N: usize, S: Real] Spot<M, N, S>);

impl<const N: usize, S: Real> Tangent<N, S> {
    pub(super) fn scaled(&self, factor: S) -> Self {
        Self {
            way: self.way.map(|way| way * factor),
            value: self.value * factor,
        }
    }

    fn plus(&self, factor: S, other: &Self) -> Self {
        let mut sum = *self;
        let ways = sum.way.iter_mut().zip(&other.way);
        ways.for_each(|(way, &other)| *way = other.fused(factor, *way));
        sum.value = other.value.fused(factor, sum.value);
        sum
    }
}

impl<const N: usize, S: Real> Walk<N, S> {
    /// The scalar product, in radians, lengths of the mechanism and shares of the interval.
    pub(super) fn product(&self, a: &Tangent<N, S>, b: &Tangent<N, S>) -> S {
        let value = a.value.quotient(self.interval) * b.value.quotient(self.interval);
        let ways = a.way.iter().zip(&b.way).zip(&self.scales);
        ways.fold(value, |sum, ((&a, &b), &scale)| {
            a.quotient(scale).fused(b.quotient(scale), sum)
        })
    }

    /// The direction in which only the value changes.
    fn pinned(&self) -> Tangent<N, S> {
        Tangent {
            way: [S::zero(); N],
            value: self.interval,
        }
    }

    /// The coordinate with the largest share in a direction; `None` of the value.
    fn leading(&self, tangent: &Tangent<N, S>) -> Option<usize> {
        let mut most = (tangent.value.quotient(self.interval).abs(), None);
        for (number, (way, &scale)) in tangent.way.iter().zip(&self.scales).enumerate() {
            let share = way.quotient(scale).abs();
            if share > most.0 {
                most = (share, Some(number));
            }
        }
        most.1
    }

    /// The point at which a branch begins: at the present value, or where that is a fold, near it.
    pub(super) fn start<M: HasInverse + HasMassMatrix>(
        &self,
        set: &Set<M, N, S>,
        state: &M::JointState<S>,
    ) -> Result<Spot<M, N, S>, Fault> {
        let pinned = self.pinned();
        let found = self.corrected(set, state, &pinned);
        let Err(fault) = found else { return found };
        for number in 0..N {
            let mut across = pinned.scaled(S::zero());
            across.way[number] = self.scales[number];
            if let Ok(found) = self.corrected(set, state, &across) {
                return Ok(found);
            }
        }
        Err(fault)
    }

    /// The next point, by a step of at most a length. The step becomes shorter where the branch
    /// bends. `None` where it would be too short, and where the value cannot change.
    pub(super) fn stepped<M: HasInverse + HasMassMatrix>(
        &self,
        from: &Spot<M, N, S>,
        length: &mut S,
        shortest: S,
    ) -> Option<Spot<M, N, S>> {
        while *length >= shortest {
            if let Ok(next) = self.ahead(from, *length) {
                let is_straight =
                    self.product(&from.tangent, &next.tangent) > S::constant(STRAIGHT);
                if is_straight && next.off < *length * S::constant(0.5) {
                    let mut slopes = [from.tangent.value, next.tangent.value].into_iter();
                    let is_free = slopes.all(|slope| slope == S::zero());
                    return (!is_free).then_some(next);
                }
            }
            *length = *length * S::constant(0.5);
        }
        None
    }

    /// The point of the branch in the plane at the end of a step.
    pub(super) fn ahead<M: HasInverse + HasMassMatrix>(
        &self,
        from: &Spot<M, N, S>,
        length: S,
    ) -> Result<Spot<M, N, S>, Fault> {
        let tangent = &from.tangent;
        let step = tangent.scaled(length);
        let (set, (state, _)) = self.tried(&from.set, &from.state, from.value, &step)?;
        self.corrected(&set, &state, tangent)
    }

    /// The point with the value of the end, near one.
    pub(super) fn at_end<M: HasInverse + HasMassMatrix>(
        &self,
        near: &Spot<M, N, S>,
    ) -> Result<Spot<M, N, S>, Fault> {
        let mut step = self.pinned().scaled(S::zero());
        step.value = self.end - near.value;
        let (mut set, (state, _)) = self.tried(&near.set, &near.state, near.value, &step)?;
        set.0.adjust(self.along, self.end, &mut set.1)?;
        self.corrected(&set, &state, &self.pinned())
    }

    fn tried<M: HasInverse + HasMassMatrix>(
        &self,
        set: &Set<M, N, S>,
        state: &M::JointState<S>,
        value: S,
        step: &Tangent<N, S>,
    ) -> Result<Trial<M, N, S>, Fault> {
        let next = trial(set, state, &step.way, |place| {
            (place == 0).then_some((self.along, value + step.value))
        });
        next.ok_or(Fault::Step(StepFault::StateNotFinite))
    }

    /// Newton's method in the plane across a direction of length one.
    fn corrected<M: HasInverse + HasMassMatrix>(
        &self,
        set: &Set<M, N, S>,
        state: &M::JointState<S>,
        across: &Tangent<N, S>,
    ) -> Result<Spot<M, N, S>, Fault> {
        let (mut set, mut state) = (*set, *state);
        let mut left = set.0.accelerations(&state)?;
        let mut leading = self.leading(across);
        let (mut before, mut off) = (S::zero(), S::zero());
        let tolerance = S::EPSILON.powf(0.75);
        for taken in 0..CORRECTIONS {
            let (space, rates) = &set;
            let value = space.present(self.along, rates);
            let linear = space.linearise_by(&state, &[self.along])?;
            let sizes = sizes(&linear, &self.scales, &[S::zero(); N]);
            let (particular, tangent, unexplained) =
                self.directions(&linear, &left, &sizes, &mut leading);
            let size = self.product(&tangent, &tangent).sqrt();
            let tangent = tangent.scaled(size.reciprocal());
            let along = self.product(across, &tangent);
            if !(along.abs() > S::constant(1e-6) && size.is_finite()) {
                return Err(not_converged(taken, &left));
            }
            let tangent = tangent.scaled(if along < S::zero() {
                -S::one()
            } else {
                S::one()
            });
            let back = -self.product(across, &particular).quotient(along.abs());
            let step = particular.plus(back, &tangent);
            let largest = Real::max(self.interval, value.abs());
            let widest = Real::max(
                longest(&step.way, &self.scales),
                step.value.abs().quotient(largest),
            );
            off = off + self.product(&step, &step).sqrt();
            let floor = space.floor(
                &state,
                &linear.by_positions,
                &linear.by_efforts,
                &self.scales,
            )?;
            let floor = with_values(floor, &linear, &[value]);
            let is_below = |numbers: &[S]| {
                numbers
                    .iter()
                    .zip(floor)
                    .all(|(off, floor)| off.abs() <= floor)
            };
            let is_least =
                widest < tolerance.sqrt() && widest + widest > before && is_below(left.as_slice());
            let next = self.tried(&set, &state, value, &step);
            if (widest <= tolerance || (taken > 0 && is_least)) && is_below(&unexplained) {
                if let Ok(next) = next {
                    (set, (state, _)) = next;
                }
                set.0.off_bends(&state, &[self.along])?;
                return Ok(Spot {
                    value: set.0.present(self.along, &set.1),
                    set,
                    state,
                    linear,
                    tangent,
                    off,
                });
            }
            if taken > 1 && widest > before {
                return Err(not_converged(taken, &left));
            }
            before = widest;
            (set, (state, left)) = next?;
        }
        Err(not_converged(CORRECTIONS, &left))
    }

    /// A step to the branch, the direction of the branch, and what of the accelerations no step
    /// explains.
    fn directions(
        &self,
        linear: &Linearised<N, 1, 0, S>,
        left: &SVector<S, N>,
        sizes: &[S; N],
        leading: &mut Option<usize>,
    ) -> (Tangent<N, S>, Tangent<N, S>, [S; N]) {
        let right: [S; N] = (-left).into();
        loop {
            let mut matrix = linear.by_positions;
            let mut units = self.scales;
            let mut other: [S; N] = (-linear.by_values.column(0)).into();
            if let Some(number) = *leading {
                other = (-linear.by_positions.column(number)).into();
                units[number] = unit(linear.by_values.iter(), sizes);
                matrix.set_column(number, &linear.by_values.column(0));
            }
            let found = solved(&matrix, [right, other], &units, sizes);
            let [mut particular, mut along] = found.ways.map(|way| Tangent {
                way,
                value: S::zero(),
            });
            let [unexplained, of_value] = found.unexplained;
            match *leading {
                Some(number) => {
                    (particular.value, particular.way[number]) =
                        (particular.way[number], S::zero());
                    (along.value, along.way[number]) = (along.way[number], S::one());
                }
                None => {
                    along.value = S::one();
                    // At a fold the value is no parameter of the branch: a coordinate is.
                    let mut rows = of_value.iter().zip(sizes);
                    let noise =
                        unit(linear.by_values.iter(), sizes).reciprocal() * S::EPSILON.sqrt();
                    if rows.any(|(off, &size)| off.abs() > size * noise) {
                        let without = |is_wanted: &dyn Fn(usize) -> bool| {
                            (0..N).find(|&column| !found.has_pivot[column] && is_wanted(column))
                        };
                        let depends = |column: usize| {
                            let entries = linear.by_positions.column(column);
                            entries.iter().any(|&entry| entry != S::zero())
                        };
                        *leading = without(&depends).or_else(|| without(&|_| true));
                        if leading.is_some() {
                            continue;
                        }
                    }
                }
            }
            return (particular, along, unexplained);
        }
    }

    /// The eigenvalues of the stiffness.
    pub(super) fn eigenvalues<M: HasInverse + HasMassMatrix>(
        &self,
        spot: &Spot<M, N, S>,
    ) -> Option<[S; N]> {
        let (space, rates) = &spot.set;
        let mass = space.mass(&spot.state).ok()?;
        eigenvalues(&mass, &spot.linear.by_positions, rates, &self.scales)
    }
}
