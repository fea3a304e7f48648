//! Impulses, where a mode ends or something else has changed.

use crate::error::Fault;
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::box_problem::{BoxProblem, BoxSolution, Factors};
use crate::nonsmooth::columns::{Columns, Setting};
use crate::nonsmooth::interaction::{Friction, Law, Limits, Rest};
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::sizes::{AT_REST, OF_TIME, ROUND_OFF, part};
use crate::nonsmooth::status::{Impact, InteractionMode, Next, Tracked};
use crate::state::vector::{Array, StateParts as _};

/// How a quantity moves at an instant.
pub(super) struct Motion<S> {
    pub(super) rate: S,
    /// The sum of the sizes of the terms of the rate; the largest one so far. What is held has that
    /// of its effort too: a shaft that never turned has rates of nothing but round-off.
    pub(super) size: S,
}

impl<S: Real> Motion<S> {
    pub(super) fn of<M: Mechanism>(tracked: &Tracked<S, M>, scene: &Scene<'_, S, M>) -> Self {
        let quantity = &tracked.interaction.quantity;
        let velocities = scene.bodies.velocities().as_slice();
        let mut size = S::zero();
        quantity.each_part(scene, |place, part| {
            let velocity = velocities.get(place).copied().unwrap_or(S::zero());
            size = size + (part * velocity).abs();
        });
        tracked.update(|status| status.largest = status.largest.max(size));
        let status = tracked.status.get();
        let kept_from = if status.mode.holds() {
            status.kept_from
        } else {
            S::zero()
        };
        Self {
            rate: quantity.rate(scene),
            size: status.largest.max(kept_from),
        }
    }

    /// A rate up to this is none.
    fn none(&self) -> S {
        part::<S>(AT_REST, ROUND_OFF) * self.size
    }
}

impl<S: Real, M: Mechanism> Tracked<S, M> {
    /// What comes after an instant: of a quantity on a limit, by its sign, or engaged, that rests
    /// there or goes on. Nothing of one that is held without a bound and does not rest.
    fn next(
        &self,
        (at_limit, is_engaged, rests): (Option<S>, bool, bool),
        rate: S,
    ) -> Option<Next<S>> {
        let is_held = self
            .friction()
            .is_some_and(|held| !held.capacity.is_finite());
        if is_held && is_engaged && !rests {
            return None;
        }
        Some(match at_limit {
            Some(sign) if rests => Next::On(sign),
            _ if !is_engaged => Next::Without,
            _ if rests => Next::Still,
            _ if rate > S::zero() => Next::Moving(S::one()),
            _ => Next::Moving(-S::one()),
        })
    }

    /// Begins what comes next, without an effort until that is known.
    fn enter_next(&self, next: Next<S>) {
        self.update(|status| {
            status.before = status.mode;
            status.next = next;
            status.mode = InteractionMode::Free;
        });
    }

    pub(super) fn friction(&self) -> Option<&Friction<S>> {
        match &self.interaction.law {
            Law::Friction(friction) => Some(friction),
            Law::Limits(_) => None,
        }
    }

    /// The limit that the quantity is on, by its sign; the fault where it is beyond.
    fn limit(&self, limits: &Limits<S>, scene: &Scene<'_, S, M>) -> Result<Option<S>, Fault> {
        if self.interaction.is_dropped {
            return Ok(None);
        }
        let status = self.status.get();
        let [lower, upper] = limits.bounds;
        let near = self.near(limits, scene);
        let value = self.interaction.quantity.value(scene);
        let gaps = [value - lower, upper - value];
        let is_lower = gaps[0] <= gaps[1];
        let gap = gaps[0].min(gaps[1]);
        if gap < -near.held {
            return Err(Fault::BeyondLimit {
                joint: self.interaction.name(),
                value: value.to_f64(),
                limit: if is_lower { lower } else { upper }.to_f64(),
            });
        }
        let is_held = match status.mode {
            InteractionMode::AtLower => is_lower,
            InteractionMode::AtUpper => !is_lower,
            _ => status.is_found,
        };
        let is_on = gap <= if is_held { near.held } else { near.free };
        let sign = if is_lower { S::one() } else { -S::one() };
        Ok(is_on.then_some(sign))
    }
}

/// Impulses of limits and dogs at an instant: writes what they change of the velocities, and what
/// may follow into the statuses. Brings to rest what comes to rest: what was held is, unless a
/// handler has moved it.
pub(crate) fn impulses<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    list: &[Tracked<S, M>; K],
    is_moved: bool,
    change: &mut C::Velocities<S>,
) -> Result<(), Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let mut at_limit = [None; K];
    let mut is_engaged = [false; K];
    let mut motions: [Motion<S>; K] =
        setting.here(|scene| list.each_ref().map(|tracked| Motion::of(tracked, scene)));
    for (index, tracked) in list.iter().enumerate() {
        match &tracked.interaction.law {
            Law::Limits(limits) => {
                let limit = setting.here(|scene| tracked.limit(limits, scene));
                at_limit[index] = limit.map_err(|fault| driven(setting, list, index, fault))?;
            }
            Law::Friction(_) => is_engaged[index] = tracked.status.get().is_engaged,
        }
    }
    let mut chosen = is_engaged;
    for (chosen, at_limit) in chosen.iter_mut().zip(&at_limit) {
        *chosen |= at_limit.is_some();
    }
    let columns = Columns::of(setting, list, &chosen)?;
    let before = motions.each_ref().map(|motion| motion.rate);
    let mut problem = BoxProblem::at_rest(columns.delassus, before);
    let infinite = S::constant(f64::INFINITY);
    let mut is_struck = false;
    for (index, tracked) in list.iter().enumerate() {
        let motion = &motions[index];
        match &tracked.interaction.law {
            Law::Limits(limits) => {
                let Some(sign) = at_limit[index] else {
                    continue;
                };
                let approach = -(sign * motion.rate);
                if sign > S::zero() {
                    problem.upper[index] = infinite;
                } else {
                    problem.lower[index] = -infinite;
                }
                if approach > motion.none() {
                    is_struck = true;
                    let restitution = tracked.restitution(limits, approach);
                    problem.offset[index] = (S::one() + restitution) * motion.rate;
                }
            }
            Law::Friction(friction) => {
                if is_engaged[index] && !friction.capacity.is_finite() {
                    (problem.lower[index], problem.upper[index]) = (-infinite, infinite);
                    is_struck |= motion.rate.abs() > motion.none();
                }
            }
        }
    }
    let mut impulses = [S::zero(); K];
    if is_struck {
        let solution = solved(&problem, setting, list)?;
        impulses = solution.efforts;
        for motion in motions.iter_mut().zip(&columns.delassus) {
            let (motion, row) = motion;
            let terms = row.iter().zip(&impulses);
            motion.rate = terms.fold(motion.rate, |sum, (&w, &x)| w.fused(x, sum));
        }
        for (index, tracked) in list.iter().enumerate() {
            if let Some(sign) = at_limit[index]
                && let Law::Limits(limits) = &tracked.interaction.law
                && goes_on(sign, before[index], &motions[index])
            {
                let [lower, upper] = limits.bounds;
                let limit = if sign > S::zero() { lower } else { upper };
                let driven = against(setting, tracked.interaction.name(), limit.to_f64());
                return Err(driven.unwrap_or_else(|| no_mode(setting, tracked)));
            }
        }
        report(setting, list, &impulses, &before, &motions);
    }
    // What is at rest now, to round-off.
    let mut rests = [false; K];
    for (index, tracked) in list.iter().enumerate() {
        let (status, motion) = (tracked.status.get(), &motions[index]);
        let was_at_rest = !is_struck && !is_moved && (status.mode.holds() || status.is_found);
        let unresolved = tracked.unresolved(setting.saddle.time, columns.delassus[index][index]);
        let is_slow = motion.rate.abs() <= motion.none().max(unresolved);
        let rest = is_slow || was_at_rest && status.mode != InteractionMode::Free;
        rests[index] = chosen[index] && rest;
    }
    let last = Factors::of(&columns.delassus, &rests);
    let last = last.solve(&motions.each_ref().map(|motion| motion.rate));
    for (index, impulse) in impulses.iter_mut().enumerate() {
        *impulse = *impulse - last[index];
    }
    *change = Array::zeros();
    columns.add_velocities(&impulses, change);
    for (index, tracked) in list.iter().enumerate() {
        let (limit, engaged) = (at_limit[index], is_engaged[index]);
        let next = tracked.next((limit, engaged, rests[index]), motions[index].rate);
        tracked.enter_next(next.ok_or_else(|| no_mode(setting, tracked))?);
    }
    Ok(())
}

/// The fault of a quantity beyond its limit, where a driver has moved it there: it has no
/// compliance, so that no stop holds it.
#[cold]
fn driven<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    list: &[Tracked<S, M>; K],
    index: usize,
    fault: Fault,
) -> Fault
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let Fault::BeyondLimit { joint, limit, .. } = fault else {
        return fault;
    };
    let chosen = core::array::from_fn(|other| other == index);
    let columns = Columns::of(setting, list, &chosen);
    let is_free = columns.is_ok_and(|columns| columns.delassus[index][index] > S::zero());
    if is_free {
        return fault;
    }
    against(setting, joint, limit).unwrap_or(fault)
}

/// The fault of a driver that moves a joint on against its limit: of the one that moves fastest.
#[cold]
fn against<S, M, F, C>(
    setting: &Setting<'_, S, M, F, C>,
    joint: &'static str,
    limit: f64,
) -> Option<Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    if !M::REPORT.time.constraints {
        return None;
    }
    let by_time = setting.here(|scene| {
        let velocities = M::Velocities::<S>::zeros();
        let at_rest = M::State::from_parts(*scene.bodies.coordinates(), velocities);
        M::constraint_rates(scene.constants, scene.time, &at_rest)
    });
    let rates = by_time.as_slice().iter().enumerate();
    let mut fastest = (0, S::zero());
    for (row, rate) in rates {
        if rate.abs() > fastest.1 {
            fastest = (row, rate.abs());
        }
    }
    let driver = M::REPORT.joint_of(fastest.0)?;
    (fastest.1 > S::zero()).then(|| Fault::DrivenAgainst {
        joint,
        driver,
        limit,
        time: setting.saddle.time.to_f64(),
    })
}

impl<S: Real, M: Mechanism> Tracked<S, M> {
    /// The rate that engaged friction ends within the digits of an instant.
    fn unresolved(&self, time: S, compliance: S) -> S {
        let capacity = match self.friction() {
            Some(friction) if friction.bearing.is_some() => self.status.get().capacity,
            Some(friction) if friction.capacity.is_finite() => friction.capacity,
            _ => return S::zero(),
        };
        compliance * capacity * S::constant(OF_TIME) * time.ulp()
    }

    /// The restitution of an approach.
    fn restitution(&self, limits: &Limits<S>, approach: S) -> S {
        let fastest = self.status.get().fastest.max(approach);
        self.update(|status| status.fastest = fastest);
        let least = match limits.rest {
            Rest::Below(rate) => rate,
            Rest::Part(part) => part * fastest,
        };
        // What does not rise above round-off does not bounce.
        if approach < least || self.status.get().has_not_flown() {
            S::zero()
        } else {
            limits.restitution
        }
    }
}

/// Whether an impulse has not stopped what approaches a limit: a driver moves it.
fn goes_on<S: Real>(sign: S, before: S, after: &Motion<S>) -> bool {
    let approaches = -(sign * before);
    let half = S::constant(0.5) * approaches;
    approaches > after.none() && -(sign * after.rate) > half
}

/// Leaves the impulses in the statuses.
fn report<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    list: &[Tracked<S, M>; K],
    impulses: &[S; K],
    before: &[S; K],
    after: &[Motion<S>; K],
) where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let half = S::constant(0.5);
    let mut lost = S::zero();
    for (index, &impulse) in impulses.iter().enumerate() {
        lost = lost - half * impulse * (before[index] + after[index].rate);
    }
    for (index, tracked) in list.iter().enumerate() {
        let impulse = impulses[index];
        if impulse != S::zero() {
            let impact = Impact {
                time: setting.saddle.time,
                impulse,
                rates: [before[index], after[index].rate],
                lost_energy: lost,
            };
            tracked.update(|status| status.impact = Some(impact));
        }
    }
}

/// The solution of a problem, or the fault where there is none.
pub(super) fn solved<S, M, F, C, const K: usize>(
    problem: &BoxProblem<S, K>,
    setting: &Setting<'_, S, M, F, C>,
    list: &[Tracked<S, M>; K],
) -> Result<BoxSolution<S, K>, Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let asked = |index: &usize| problem.lower[*index] < problem.upper[*index];
    let first = (0..K).find(asked).and_then(|index| list.get(index));
    problem.solved().ok_or_else(|| {
        let fault = first.map(|tracked| no_mode(setting, tracked));
        fault.unwrap_or(Fault::StateNotFinite)
    })
}

/// No modes fit together.
#[cold]
pub(super) fn no_mode<S, M, F, C>(
    setting: &Setting<'_, S, M, F, C>,
    tracked: &Tracked<S, M>,
) -> Fault
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    Fault::NoMode {
        joint: tracked.interaction.name(),
        time: setting.saddle.time.to_f64(),
    }
}
