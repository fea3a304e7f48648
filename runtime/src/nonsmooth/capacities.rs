//! Bounds of efforts, where capacities may depend on the efforts themselves.
//!
//! Of friction by load the bounds belong to a solution, and the solution to its bounds. At first
//! everything that may stick does. What then exceeds its capacity slides, its effort is solved
//! with its load, and the problem with those bounds says what sticks. That goes on until a solution
//! has the loads that its bounds are of.

use crate::error::{Fault, StepFault};
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::box_problem::{BoxProblem, BoxSolution, Place};
use crate::nonsmooth::columns::Setting;
use crate::nonsmooth::efforts::refused;
use crate::nonsmooth::law::pushes;
use crate::nonsmooth::loads::BearingLoads;
use crate::nonsmooth::sizes::{ROUND_OFF, part};
use crate::nonsmooth::slipping::Slipping;
use crate::nonsmooth::status::{Next, Tracked};
use crate::nonsmooth::switch::{no_mode, solved};

/// What was found at its capacity slips, to this part of it: more than the floor of a problem.
const SLIPS: f64 = 1e-11;

/// Loads that differ by less than this part of their terms are the same.
const SAME: f64 = 1e-11;

/// Rounds, besides those of each effort.
const ROUNDS: usize = 16;
const OF_EACH: usize = 8;

/// Where bounds come from.
pub(super) struct Capacities<'a, S: Real, M: Mechanism, const K: usize> {
    pub(super) list: &'a [Tracked<S, M>; K],
    pub(super) rates: [S; K],
    pub(super) loads: Option<&'a BearingLoads<S, K>>,
    /// What was found at its capacity, while others hold its quantity as well. It stays there: how
    /// they share a load is known to the fourth root of `EPSILON`, by the floor on the diagonal.
    pub(super) shares: [bool; K],
}

/// What is held, and what slides by its load.
struct Guess<S, const K: usize> {
    holds: [bool; K],
    coefficients: [Option<S>; K],
    /// The efforts of all others.
    given: [S; K],
}

impl<S: Real, const K: usize> Guess<S, K> {
    /// The efforts as a solution, if they are one with bounds of their own loads.
    fn admissible(
        &self,
        efforts: &[S; K],
        problem: &BoxProblem<S, K>,
    ) -> Option<BoxSolution<S, K>> {
        let residuals = problem.residuals(efforts);
        let sizes = problem.sizes(efforts);
        let same = part::<S>(SAME, ROUND_OFF);
        let mut places = [Place::Lower; K];
        for index in 0..K {
            let (effort, residual) = (efforts[index], residuals[index]);
            let (lower, upper) = (problem.lower[index], problem.upper[index]);
            let moves = problem.matrix[index][index] > S::zero();
            let noise = same * sizes[index];
            let near = same * effort.abs();
            let (place, is_right) = if self.holds[index] {
                let is_inside = effort >= lower - near && effort <= upper + near;
                let is_still = !moves || residual.abs() <= noise;
                (Place::Inside, is_inside && is_still)
            } else if (effort - lower).abs() <= near {
                let falls = residual < -noise && lower < upper;
                (Place::Lower, !falls)
            } else {
                let is_at = (effort - upper).abs() <= near;
                (Place::Upper, is_at && residual <= noise)
            };
            if !is_right {
                return None;
            }
            places[index] = place;
        }
        Some(BoxSolution {
            efforts: *efforts,
            residuals,
            places,
        })
    }
}

impl<S: Real, M: Mechanism, const K: usize> Capacities<'_, S, M, K> {
    /// The signs of the rates at which friction slides. What has no freedom at an instant does not
    /// stick there if it turns back: a slider at a dead point of its crank.
    pub(super) fn sliding(
        &self,
        problem: &BoxProblem<S, K>,
        no_acceleration: &[S; K],
    ) -> [Option<S>; K] {
        core::array::from_fn(|index| {
            let tracked = &self.list[index];
            tracked.friction()?;
            match tracked.status.next {
                Next::Moving(sign) => Some(sign),
                Next::Still if problem.matrix[index][index] <= S::zero() => {
                    let acceleration = problem.offset[index];
                    if acceleration.abs() <= no_acceleration[index] {
                        None
                    } else if acceleration > S::zero() {
                        Some(S::one())
                    } else {
                        Some(-S::one())
                    }
                }
                Next::Still if tracked.is_overrun() => Some(S::one()),
                _ => None,
            }
        })
    }

    /// The load of a bearing by efforts; 1 where the capacity is known.
    pub(super) fn load(&self, index: usize, efforts: &[S; K]) -> S {
        self.all_loads(efforts)[index]
    }

    fn all_loads(&self, efforts: &[S; K]) -> [S; K] {
        let Some(loads) = self.loads else {
            return [S::one(); K];
        };
        let mut sizes = loads.sizes(efforts);
        for (size, tracked) in sizes.iter_mut().zip(self.list) {
            if tracked.bearing().is_none() {
                *size = S::one();
            }
        }
        sizes
    }

    /// The bounds of an effort, where friction slides at a rate of a sign or may stick.
    pub(super) fn bounds(&self, index: usize, sliding: Option<S>, load: S) -> [S; 2] {
        match (self.list[index].status.next, sliding) {
            (Next::On(sign), _) => pushes(sign),
            (_, Some(_)) => [self.effort_of_sliding(index, sliding) * load; 2],
            (Next::Still, None) => self.at_rest(index).map(|bound| bound * load),
            _ => [S::zero(); 2],
        }
    }

    /// The effort of sliding, over the load.
    fn effort_of_sliding(&self, index: usize, sliding: Option<S>) -> S {
        let tracked = &self.list[index];
        let (Some(sign), Some(friction)) = (sliding, tracked.friction()) else {
            return S::zero();
        };
        let rate = match tracked.status.next {
            Next::Still => S::zero(),
            _ => self.rates[index],
        };
        friction.effort(sign, rate)
    }

    /// The bounds at rest, over the load.
    fn at_rest(&self, index: usize) -> [S; 2] {
        let tracked = &self.list[index];
        let Some(friction) = tracked.friction() else {
            return [S::zero(); 2];
        };
        let bounds = friction.bounds();
        if self.shares[index] {
            let [lower, upper] = bounds;
            let is_upper = tracked.status.exerted.effort > S::zero();
            return [if is_upper { upper } else { lower }; 2];
        }
        // What was found at its capacity does not fall back by round-off.
        if tracked.status.slips() {
            let rest = S::one() - part::<S>(SLIPS, ROUND_OFF);
            bounds.map(|bound| rest * bound)
        } else {
            bounds
        }
    }

    fn bound(&self, problem: &mut BoxProblem<S, K>, sliding: &[Option<S>; K], loads: &[S; K]) {
        for index in 0..K {
            let bounds = self.bounds(index, sliding[index], loads[index]);
            [problem.lower[index], problem.upper[index]] = bounds;
        }
    }

    /// The solution of a problem within the bounds that belong to it, which are left in the
    /// problem.
    pub(super) fn solved<F: Formulation<S>, C: Coordinates<M>>(
        &self,
        setting: &Setting<'_, S, M, F, C>,
        problem: &mut BoxProblem<S, K>,
        sliding: &[Option<S>; K],
    ) -> Result<BoxSolution<S, K>, Fault> {
        let mut solution = self.within(setting, problem, sliding)?;
        for (index, place) in solution.places.iter_mut().enumerate() {
            if self.shares[index] && solution.efforts[index] > S::zero() {
                *place = Place::Upper;
            }
        }
        Ok(solution)
    }

    fn within<F: Formulation<S>, C: Coordinates<M>>(
        &self,
        setting: &Setting<'_, S, M, F, C>,
        problem: &mut BoxProblem<S, K>,
        sliding: &[Option<S>; K],
    ) -> Result<BoxSolution<S, K>, Fault> {
        let Some(loads) = self.loads else {
            self.bound(problem, sliding, &[S::one(); K]);
            return solved(problem, setting, self.list);
        };
        let mut guess = self.everything_sticks(sliding);
        let mut efforts = [S::zero(); K];
        let mut refusal = None;
        for _ in 0..ROUNDS + OF_EACH * K {
            let slipping = Slipping {
                matrix: &problem.matrix,
                loads,
                holds: guess.holds,
                coefficients: guess.coefficients,
            };
            let found = slipping.efforts(&problem.offset, &guess.given);
            match found {
                Ok(found) => (efforts, refusal) = (found, None),
                Err(why) => refusal = Some(why),
            }
            let bounding = self.all_loads(&efforts);
            self.bound(problem, sliding, &bounding);
            if refusal.is_none()
                && let Some(solution) = guess.admissible(&efforts, problem)
            {
                return Ok(solution);
            }
            let solution = solved(problem, setting, self.list)?;
            let resulting = self.all_loads(&solution.efforts);
            let scales = loads.scales(&solution.efforts);
            let same = part::<S>(SAME, ROUND_OFF);
            let is_own = (0..K)
                .all(|index| (resulting[index] - bounding[index]).abs() <= same * scales[index]);
            if is_own {
                return match refusal {
                    None => Ok(solution),
                    Some(why) => Err(refused(why, self.list, setting.saddle.time)),
                };
            }
            guess = self.as_found(&solution, problem, sliding);
            efforts = solution.efforts;
        }
        if let Some(why) = refusal {
            return Err(refused(why, self.list, setting.saddle.time));
        }
        let mut by_load = self.list.iter();
        let first = by_load.find(|tracked| tracked.bearing().is_some());
        let fault = first.map(|tracked| no_mode(setting, tracked));
        Err(fault.unwrap_or(Fault::Step(StepFault::StateNotFinite)))
    }

    /// All limits that are touched hold, and all friction at rest.
    fn everything_sticks(&self, sliding: &[Option<S>; K]) -> Guess<S, K> {
        let mut guess = Guess {
            holds: [false; K],
            coefficients: [None; K],
            given: [S::zero(); K],
        };
        for (index, tracked) in self.list.iter().enumerate() {
            let effort = self.effort_of_sliding(index, sliding[index]);
            match (tracked.status.next, sliding[index]) {
                (_, Some(_)) if tracked.bearing().is_some() => {
                    guess.coefficients[index] = Some(effort);
                }
                (_, Some(_)) => guess.given[index] = effort,
                (Next::On(_) | Next::Still, None) => guess.holds[index] = true,
                _ => {}
            }
        }
        guess
    }

    /// What holds and what slides in a solution.
    fn as_found(
        &self,
        solution: &BoxSolution<S, K>,
        problem: &BoxProblem<S, K>,
        sliding: &[Option<S>; K],
    ) -> Guess<S, K> {
        let mut guess = self.everything_sticks(sliding);
        for (index, tracked) in self.list.iter().enumerate() {
            let place = solution.places[index];
            let sticks = tracked.status.next == Next::Still && sliding[index].is_none();
            let coefficient = match place {
                Place::Inside => continue,
                Place::Upper => self.at_rest(index)[1],
                Place::Lower => self.at_rest(index)[0],
            };
            guess.holds[index] = false;
            if sticks && tracked.bearing().is_some() {
                guess.coefficients[index] = Some(coefficient);
            } else if guess.coefficients[index].is_none() {
                guess.given[index] = match place {
                    Place::Upper => problem.upper[index],
                    _ => problem.lower[index],
                };
            }
        }
        guess
    }
}
