//! Impulses, where a mode ends or something else has changed.

use crate::error::{AssemblyFault, Fault, ModeFault, StepFault};
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::box_problem::{BoxProblem, BoxSolution, Factors};
use crate::nonsmooth::columns::{Columns, Setting};
use crate::nonsmooth::cone_problem::length;
use crate::nonsmooth::cones::{self, are_rough};
use crate::nonsmooth::law::{Friction, Limits, pushes};
use crate::nonsmooth::mode::InteractionMode;
use crate::nonsmooth::motion::Motion;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::sizes::{ENDED, OF_TIME, ROUND_OFF, part};
use crate::nonsmooth::slip::{share_sizes, tangents_of};
use crate::nonsmooth::status::{Impact, Next, Status, Tracked};
use crate::state::vector::{Array, StateParts as _};

/// Energy that impulses bring, of what they take and bring in all, beyond which it is no round-off.
const GAINS: f64 = 1e-9;

/// An impulse that does less than this part of what all do to its quantity is nothing but how these
/// share what they do together.
const OF_IMPULSES: f64 = 1e-9;

impl<S: Real, M: Mechanism> Tracked<S, M> {
    /// What comes after an instant: of a quantity on a limit or engaged, that rests there or goes
    /// on. Nothing of one that is held without a bound and does not rest.
    fn next(&self, one: &Struck<S>) -> Option<Next<S>> {
        let stops = |friction: Friction<S>| friction.stops(one.motion.rate);
        if self.friction().is_some_and(stops) && one.is_engaged && !one.rests {
            return None;
        }
        Some(match one.at_limit {
            Some(sign) if one.rests => Next::On(sign),
            _ if !one.is_engaged => Next::Without,
            _ if one.rests => Next::Still,
            _ if one.motion.rate > S::zero() => Next::Moving(S::one()),
            _ => Next::Moving(-S::one()),
        })
    }

    /// Begins what comes next, without an effort until that is known.
    fn enter_next(&mut self, next: Next<S>) {
        self.status.before = self.status.mode;
        self.status.next = next;
        self.status.mode = InteractionMode::Free;
    }

    /// The limit that the quantity is on, by its sign; the fault where it is beyond.
    fn limit(&self, limits: &Limits<S>, scene: &Scene<'_, S, M>) -> Result<Option<S>, Fault> {
        if self.interaction.is_dropped {
            return Ok(None);
        }
        let status = self.status;
        let near = self.near(limits, scene);
        let value = self.interaction.quantity.value(scene);
        let (gap, is_lower) = limits.gap(value);
        if gap.to_f64().is_nan() {
            return Err(Fault::Step(StepFault::EventNotANumber {
                event: self.interaction.name(),
                time: scene.time.to_f64(),
            }));
        }
        let sign = if is_lower { S::one() } else { -S::one() };
        if gap < -near.held {
            return Err(Fault::Assembly(AssemblyFault::BeyondLimit {
                joint: self.interaction.name(),
                value: value.to_f64(),
                limit: limits.bound(sign).to_f64(),
            }));
        }
        let is_held = match status.mode {
            InteractionMode::AtLower => is_lower,
            InteractionMode::AtUpper => !is_lower,
            _ => status.is_found,
        };
        let is_on = gap <= if is_held { near.held } else { near.free };
        Ok(is_on.then_some(sign))
    }
}

/// An interaction at an instant.
struct Struck<S> {
    /// How its quantity moves, after the impulses once they are known.
    motion: Motion<S>,
    /// The rate before.
    before: S,
    /// The limit that the quantity is on, by its sign.
    at_limit: Option<S>,
    /// It is friction that is engaged.
    is_engaged: bool,
    /// It takes part in what has an impulse of its own.
    is_struck: bool,
    impulse: S,
    /// Poisson's restitution of its impulse.
    restitution: S,
    /// It is at rest, to round-off.
    rests: bool,
}

impl<S: Real> Struck<S> {
    fn of<M: Mechanism>(tracked: &mut Tracked<S, M>, scene: &Scene<'_, S, M>) -> Self {
        let motion = Motion::of(tracked, scene);
        Self {
            before: motion.rate,
            motion,
            at_limit: None,
            is_engaged: tracked.friction().is_some() && tracked.status.is_engaged,
            is_struck: false,
            impulse: S::zero(),
            restitution: S::zero(),
            rests: false,
        }
    }

    /// Whether an impulse may act on it.
    fn is_chosen(&self) -> bool {
        self.is_engaged || self.at_limit.is_some()
    }
}

/// How impulses are looked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strike {
    /// A handler has moved the mechanism.
    pub(crate) is_moved: bool,
    /// It is tried whether little slip sticks.
    pub(crate) tries: bool,
}

/// Impulses of limits and dogs at an instant: writes what they change of the velocities, and what
/// may follow into the statuses. Brings to rest what comes to rest: what was held is, unless a
/// handler has moved it. So is little slip, where it is tried whether that sticks.
pub(crate) fn impulses<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    list: &mut [Tracked<S, M>; K],
    Strike { is_moved, tries }: Strike,
    change: &mut C::Velocities<S>,
) -> Result<(), Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let mut all: [Struck<S>; K] =
        setting.here(|scene| list.each_mut().map(|tracked| Struck::of(tracked, scene)));
    share_sizes(list);
    for (index, tracked) in list.iter().enumerate() {
        if let Some(limits) = tracked.interaction.law.limits() {
            let limit = setting.here(|scene| tracked.limit(limits, scene));
            all[index].at_limit = limit.map_err(|fault| driven(setting, list, index, fault))?;
        }
    }
    // Friction of a contact may act where that is closed.
    for (index, tracked) in list.iter().enumerate() {
        let slip = all[index].motion.size;
        let contact = tracked.contact(index);
        if let Some(contact) = contact.and_then(|contact| all.get_mut(contact)) {
            contact.motion.goes_with(slip);
            let is_closed = contact.at_limit.is_some();
            all[index].is_engaged = is_closed;
        }
    }
    let chosen = all.each_ref().map(Struck::is_chosen);
    let columns = Columns::of(setting, list, &chosen)?;
    let before = all.each_ref().map(|one| one.before);
    let mut problem = BoxProblem::at_rest(columns.delassus, before);
    for (index, tracked) in list.iter_mut().enumerate() {
        // Friction that is found has no rate, whether it stuck or slid: that takes no impulse.
        let is_found = tracked.status.is_found && tracked.friction().is_some();
        let may_bounce = is_moved || !tracked.status.has_not_flown();
        let collides = tracked.collides(&mut all[index], may_bounce, &mut problem, index);
        all[index].is_struck = collides && (is_moved || !is_found);
    }
    let is_struck = all.iter().any(|one| one.is_struck);
    if is_struck {
        let impulses = if are_rough(list) {
            let restitutions = all.each_ref().map(|one| one.restitution);
            let signs = all.each_ref().map(|one| one.at_limit);
            cones::impulses(setting, list, &problem, (signs, restitutions))?
        } else {
            solved(&problem, setting, list)?.efforts
        };
        for (index, row) in columns.delassus.iter().enumerate() {
            let (one, terms) = (&mut all[index], row.iter().zip(&impulses));
            one.impulse = impulses[index];
            one.motion.rate = terms.fold(one.before, |sum, (&w, &x)| w.fused(x, sum));
        }
        for (tracked, one) in list.iter().zip(&all) {
            tracked.refuse_to_go_on(setting, one)?;
        }
        report(setting, list, &all, &columns.delassus)?;
    }
    let are_round_off = is_struck && land_by_round_off(list, &all, setting.saddle.time);
    let hops = if is_struck {
        hops(list, &all, &columns.delassus, are_round_off)
    } else {
        [false; K]
    };
    for (index, tracked) in list.iter().enumerate() {
        let status = tracked.status;
        let was_at_rest = !is_struck && !is_moved && (status.mode.holds() || status.is_found);
        let unresolved = tracked.unresolved(setting.saddle.time, columns.delassus[index][index]);
        let one = &mut all[index];
        let is_slow = one.motion.rate.abs() <= one.motion.none().max(unresolved);
        let rests = is_slow || was_at_rest && status.mode != InteractionMode::Free;
        one.rests = one.is_chosen() && (rests || hops[index]);
    }
    let how = Sticking {
        tries,
        is_struck,
        are_round_off,
    };
    stick(list, &mut all, how);
    let rests = all.each_ref().map(|one| one.rests);
    let last = Factors::of(&columns.delassus, &rests);
    let last = last.solve(&all.each_ref().map(|one| one.motion.rate));
    let impulses = core::array::from_fn(|index| all[index].impulse - last[index]);
    *change = Array::zeros();
    columns.add_velocities(&impulses, change);
    for (tracked, one) in list.iter_mut().zip(&all) {
        let next = tracked.next(one);
        tracked.enter_next(next.ok_or_else(|| no_mode(setting, tracked))?);
    }
    Ok(())
}

/// What there is to know of slip that may end at an instant.
#[derive(Clone, Copy)]
struct Sticking {
    /// It is tried whether little slip sticks.
    tries: bool,
    is_struck: bool,
    /// Impulses are those of flights that were round-off.
    are_round_off: bool,
}

/// Friction of contacts rests in both directions, where its contact does.
fn stick<S: Real, M: Mechanism, const K: usize>(
    list: &mut [Tracked<S, M>; K],
    all: &mut [Struck<S>; K],
    how: Sticking,
) {
    let Sticking {
        tries,
        is_struck,
        are_round_off,
    } = how;
    // Slip that a step has led to its zero ends, and so does what ends together with it. What
    // impulses leave is known to the digits of their directions.
    let has_ended = |tracked: &Tracked<S, M>| {
        tracked.mode() == InteractionMode::Slipping && tracked.status.is_found
    };
    let found = is_struck || list.iter().any(has_ended);
    for contact in 0..K {
        let [Some(first), second] = tangents_of(list, contact) else {
            continue;
        };
        let closed = all[contact].rests;
        let mut rests = true;
        let (mut slip, mut size) = ([S::zero(); 2], S::zero());
        for (place, index) in [Some(first), second].into_iter().enumerate() {
            if let Some(one) = index.and_then(|index| all.get(index)) {
                rests &= one.rests;
                slip[usize::from(place > 0)] = one.motion.rate;
                size = size.max(one.motion.size);
            }
        }
        let slip = length(slip);
        let mut ended = found && slip <= part::<S>(ENDED, ROUND_OFF) * size;
        if let (Some(first), Some(_)) = (list.get_mut(first), second) {
            let status = &mut first.status;
            let sticks = status.mode == InteractionMode::Sticking;
            ended |= (status.ends || status.begins) && status.is_found || status.ends && sticks;
            let slips = status.mode == InteractionMode::Slipping;
            let may_stick = (slips || sticks) && status.is_little(slip) || sticks && are_round_off;
            status.is_tried = tries && closed && !rests && !ended && may_stick;
            ended |= status.is_tried;
        }
        for index in [Some(first), second].into_iter().flatten() {
            if let Some(one) = all.get_mut(index) {
                one.rests = closed && (rests || ended);
                one.is_engaged &= closed;
            }
        }
    }
}

/// Whether all that is struck ends a flight that was round-off.
fn land_by_round_off<S: Real, M: Mechanism, const K: usize>(
    list: &[Tracked<S, M>; K],
    all: &[Struck<S>; K],
    time: S,
) -> bool {
    let mut landings = list.iter().zip(all).filter(|(_, one)| one.is_struck);
    landings.all(|(tracked, one)| tracked.status.is_round_off(one.before.abs(), time))
}

/// Which quantities an impulse elsewhere throws off their limits, but so slowly that they rest: at
/// less than the rate of an approach without restitution, or by landings that are round-off.
///
/// Limits that throw each other off by turns do so in a geometric series, whose last flights end
/// within the round-off of a gap: that would never end. Approaches of different quantities are
/// compared by their energies.
fn hops<S: Real, M: Mechanism, const K: usize>(
    list: &[Tracked<S, M>; K],
    all: &[Struck<S>; K],
    matrix: &[[S; K]; K],
    are_round_off: bool,
) -> [bool; K] {
    let fastest = |index: usize| {
        let mut fastest = S::zero();
        for (other, tracked) in list.iter().enumerate() {
            let (at_limit, compliance) = (all[other].at_limit, matrix[other][other]);
            let is_coupled = matrix[index][other] != S::zero() && compliance > S::zero();
            if at_limit.is_some() && is_coupled {
                let ratio = matrix[index][index].max(S::zero()).quotient(compliance);
                fastest = fastest.max(ratio.sqrt() * tracked.status.fastest);
            }
        }
        fastest
    };
    core::array::from_fn(|index| {
        let one = &all[index];
        let (Some(limits), Some(sign)) = (list[index].interaction.law.limits(), one.at_limit)
        else {
            return false;
        };
        let (before, after) = (sign * one.before, sign * one.motion.rate);
        let is_thrown = before <= one.motion.none() && one.impulse == S::zero();
        let is_slow = are_round_off || after < limits.least(fastest(index));
        is_thrown && after > S::zero() && is_slow
    })
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
    let Fault::Assembly(AssemblyFault::BeyondLimit {
        joint,
        value,
        limit,
    }) = fault
    else {
        return fault;
    };
    let chosen = core::array::from_fn(|other| other == index);
    let columns = Columns::of(setting, list, &chosen);
    let is_free = columns.is_ok_and(|columns| columns.delassus[index][index] > S::zero());
    if is_free {
        return fault;
    }
    against(setting, joint, value > limit).unwrap_or(fault)
}

/// The fault of a driver that moves a joint on against its limit: of the one that moves fastest.
#[cold]
fn against<S, M, F, C>(
    setting: &Setting<'_, S, M, F, C>,
    joint: &'static str,
    is_upper: bool,
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
    (fastest.1 > S::zero()).then(|| {
        Fault::Mode(ModeFault::DrivenAgainst {
            joint,
            driver,
            is_upper,
            time: setting.saddle.time.to_f64(),
        })
    })
}

impl<S: Real, M: Mechanism> Tracked<S, M> {
    /// The rate that engaged friction ends within the digits of an instant.
    fn unresolved(&self, time: S, compliance: S) -> S {
        let capacity = match self.friction() {
            Some(friction) if friction.bearing.is_some() || friction.tangent.is_some() => {
                self.status.exerted.capacity
            }
            Some(friction) if friction.impulses().is_none() => friction.capacity,
            _ => return S::zero(),
        };
        compliance * capacity * S::constant(OF_TIME) * time.ulp()
    }

    /// Says in the problem of impulses which ones it has, and which rate is wanted; whether there
    /// is one that is not zero.
    fn collides<const K: usize>(
        &mut self,
        one: &mut Struck<S>,
        may_bounce: bool,
        problem: &mut BoxProblem<S, K>,
        index: usize,
    ) -> bool {
        let (motion, law) = (&one.motion, &self.interaction.law);
        let (impulses, is_struck) = if let (Some(limits), Some(sign)) = (law.limits(), one.at_limit)
        {
            let approach = -(sign * motion.rate);
            let is_struck = approach > motion.none();
            if is_struck {
                let restitution = self.status.restitution(limits, approach, may_bounce);
                if limits.is_of_impulses {
                    one.restitution = restitution;
                } else {
                    problem.offset[index] = (S::one() + restitution) * motion.rate;
                }
            }
            (pushes(sign), is_struck)
        } else if let (true, Some(impulses)) =
            (one.is_engaged, law.friction().and_then(Friction::impulses))
        {
            let stops = law.friction().is_some_and(|one| one.stops(motion.rate));
            (impulses, stops && motion.rate.abs() > motion.none())
        } else {
            return false;
        };
        [problem.lower[index], problem.upper[index]] = impulses;
        is_struck
    }

    /// Refuses an impulse that has not stopped what approaches a limit: a driver moves it.
    fn refuse_to_go_on<F: Formulation<S>, C: Coordinates<M>>(
        &self,
        setting: &Setting<'_, S, M, F, C>,
        one: &Struck<S>,
    ) -> Result<(), Fault> {
        let (Some(_), Some(sign)) = (self.interaction.law.limits(), one.at_limit) else {
            return Ok(());
        };
        let approaches = -(sign * one.before);
        let half = S::constant(0.5) * approaches;
        let goes_on = approaches > one.motion.none() && -(sign * one.motion.rate) > half;
        if !goes_on {
            return Ok(());
        }
        let driven = against(setting, self.interaction.name(), sign < S::zero());
        Err(driven.unwrap_or_else(|| no_mode(setting, self)))
    }
}

impl<S: Real> Status<S> {
    /// The restitution of an approach.
    fn restitution(&mut self, limits: &Limits<S>, approach: S, may_bounce: bool) -> S {
        self.fastest = self.fastest.max(approach);
        if may_bounce {
            limits.restitution(approach, self.fastest)
        } else {
            S::zero()
        }
    }
}

/// Leaves the impulses in the statuses, but those that are round-off of what rests meanwhile, or of
/// what the others do.
fn report<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    list: &mut [Tracked<S, M>; K],
    all: &[Struck<S>; K],
    matrix: &[[S; K]; K],
) -> Result<(), Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let half = S::constant(0.5);
    let (mut lost, mut terms, mut round_off) = (S::zero(), S::zero(), S::zero());
    for (index, one) in all.iter().enumerate() {
        let (before, after) = (one.before, one.motion.rate);
        let rates = before.abs() + after.abs();
        lost = lost - half * one.impulse * (before + after);
        terms = terms + half * (one.impulse * rates).abs();
        // Rates are known to round-off, and impulses to what makes such rates.
        if one.impulse != S::zero() {
            round_off = round_off + (one.motion.none() * rates).quotient(matrix[index][index]);
        }
    }
    if are_rough(list) && lost < -S::constant(GAINS).fused(terms, round_off) {
        let gains = all.iter().position(|one| one.impulse != S::zero());
        let first = gains.and_then(|index| list.get(index));
        return Err(Fault::Mode(ModeFault::GainsEnergy {
            joint: first.map_or("", |first| first.interaction.name()),
            gained: -lost.to_f64(),
            time: setting.saddle.time.to_f64(),
        }));
    }
    for (index, (tracked, one)) in list.iter_mut().zip(all).enumerate() {
        let terms = matrix[index].iter().zip(all);
        let others = terms.fold(S::zero(), |sum, (&w, one)| (w * one.impulse).abs() + sum);
        let none = one
            .motion
            .none()
            .max(part::<S>(OF_IMPULSES, ROUND_OFF) * others);
        let is_felt = (matrix[index][index] * one.impulse).abs() > none;
        if is_felt {
            let impact = Impact {
                time: setting.saddle.time,
                impulse: one.impulse,
                rates: [one.before, one.motion.rate],
                lost_energy: lost,
            };
            tracked.status.impact = Some(impact);
        }
    }
    Ok(())
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
        fault.unwrap_or(Fault::Step(StepFault::StateNotFinite))
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
    Fault::Mode(ModeFault::NoMode {
        joint: tracked.interaction.name(),
        time: setting.saddle.time.to_f64(),
    })
}
