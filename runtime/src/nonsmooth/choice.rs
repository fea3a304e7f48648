//! The modes that follow, once impulses are known.

use crate::error::{Fault, ModeFault};
use crate::formulation::{Formulation, Solution};
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::box_problem::{BoxProblem, BoxSolution, Factors, Place};
use crate::nonsmooth::capacities::Capacities;
use crate::nonsmooth::columns::{Columns, Setting};
use crate::nonsmooth::cones::{self, are_rough};
use crate::nonsmooth::law::Friction;
use crate::nonsmooth::loads::{BearingLoads, Reactions};
use crate::nonsmooth::mode::InteractionMode;
use crate::nonsmooth::motion::Motion;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::sizes::{AT_BOUND, ENDED, ROUND_OFF, part, strength_of_forces};
use crate::nonsmooth::status::{Next, Tracked};

/// Accelerations that are none, in `EPSILON` of what efforts bring about.
const NO_ACCELERATION: f64 = 256.0;

/// What has no freedom turns back at a dead point with more than this part of the acceleration that
/// the forces would give it without constraints.
const TURNING: f64 = 1e-9;

/// Accelerations that differ by less than this part are alike: what is symmetric slides together.
const ALIKE: f64 = 1e-6;

/// What is held blocks a quantity of which it leaves less than this part of its compliance; at
/// least so many `EPSILON`.
const BLOCKED: f64 = 1e-9;
const OF_BLOCKED: f64 = 1e4;

/// The modes that follow, after impulses, from the solution without efforts of interactions.
pub(crate) fn modes<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    reactions: Option<Reactions<'_, S, M, F>>,
    list: &mut [Tracked<S, M>; K],
    free: &Solution<S, M, C>,
) -> Result<(), Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    if are_rough(list) {
        return cones::modes(setting, list, free);
    }
    let chosen = list.each_ref().map(|tracked| tracked.may_act());
    let columns = Columns::of(setting, list, &chosen)?;
    let bias = setting.bias(list);
    let offset = columns.accelerations(setting, list, &bias, &free.accelerations);
    let mut problem = BoxProblem::at_rest(columns.delassus, offset);
    let motions: [Motion<S>; K] =
        setting.here(|scene| list.each_mut().map(|tracked| Motion::of(tracked, scene)));
    let loads = if list.iter().any(|tracked| tracked.bearing().is_some()) {
        let loads = BearingLoads::of(setting, reactions, list, &columns, free)?;
        Some(loads)
    } else {
        None
    };
    let shares = core::array::from_fn(|index| {
        let others = core::array::from_fn(|other| other != index && chosen[other]);
        list[index].status.slips() && is_blocked(&columns.delassus, &others, index)
    });
    let capacities = Capacities {
        list: &*list,
        rates: motions.each_ref().map(|motion| motion.rate),
        loads: loads.as_ref(),
        shares,
    };
    // The sign of the rate at which friction slides, or begins to.
    let forces = setting.here(strength_of_forces);
    let no_acceleration = columns
        .free
        .map(|free| S::constant(TURNING) * (free * forces).sqrt());
    let mut sliding = capacities.sliding(&problem, &no_acceleration);
    let mut solution = capacities.solved(setting, &mut problem, &sliding)?;
    let roots: [S; K] = core::array::from_fn(|index| {
        let diagonal = columns.delassus[index][index];
        diagonal.max(S::zero()).sqrt()
    });
    // What begins to slide has the friction of sliding, and others may be held then.
    for _ in 0..=K {
        let at_work = (strength_of(&problem, &solution, &roots), &roots);
        let beginning = beginning(&capacities, &problem, &solution, at_work, &sliding);
        if !begin(&capacities, &problem, &solution, beginning, &mut sliding) {
            break;
        }
        solution = capacities.solved(setting, &mut problem, &sliding)?;
    }
    let strength = strength_of(&problem, &solution, &roots);
    let at_work = (strength, &roots);
    let saturated = saturated(&capacities, &problem, &solution, at_work, &sliding);
    let sizes = loads.as_ref().map(|loads| loads.sizes(&solution.efforts));
    for (index, tracked) in list.iter_mut().enumerate() {
        tracked.status.exerted.capacity = tracked.capacity(sizes.map(|sizes| sizes[index]));
    }
    if let Some(loads) = &loads {
        let holds = solution.places.map(|place| place == Place::Inside);
        let slides = sliding.map(|sign| sign.is_some());
        if let Some(index) = loads.shared(&columns.delassus, &holds, &slides) {
            return Err(Fault::Mode(ModeFault::LoadNotUnique {
                joint: list.get(index).map_or("", |first| first.interaction.name()),
            }));
        }
    }
    for (index, tracked) in list.iter_mut().enumerate() {
        let effort = solution.efforts[index];
        let diagonal = columns.delassus[index][index];
        let alone = if diagonal > S::zero() {
            offset[index].abs().quotient(diagonal)
        } else {
            S::zero()
        };
        // A limit that bears nothing is left.
        let bears = effort.abs() > part::<S>(AT_BOUND, ROUND_OFF) * alone;
        let is_inside = solution.places[index] == Place::Inside && bears;
        tracked.status.is_saturated = saturated[index].is_some();
        let mode = tracked.mode_after(is_inside, sliding[index].or(saturated[index]));
        let work = if roots[index] > S::zero() {
            strength.quotient(roots[index])
        } else {
            alone
        };
        let work = tracked.work_of_zero(work, forces.quotient(columns.free[index]));
        let efforts = [effort, alone, work];
        setting.here(|scene| tracked.enter(mode, scene, efforts, &motions[index]));
    }
    mark_blocked(list, &columns.delassus);
    Ok(())
}

/// The friction at rest that begins to slide in a solution: the sign of its rate, and by how much
/// it is accelerated, over the root of its compliance.
fn beginning<S: Real, M: Mechanism, const K: usize>(
    capacities: &Capacities<'_, S, M, K>,
    problem: &BoxProblem<S, K>,
    solution: &BoxSolution<S, K>,
    at_work: (S, &[S; K]),
    sliding: &[Option<S>; K],
) -> [Option<(S, S)>; K] {
    let (list, keeps_shares) = (capacities.list, capacities.loads.is_some());
    let can_be_held = held_at_bounds(list, problem, solution, at_work, sliding, keeps_shares);
    let holds = solution.places.map(|place| place == Place::Inside);
    let mut beginning = [None; K];
    for (index, tracked) in list.iter().enumerate() {
        let is_friction = tracked.friction().is_some();
        if !is_friction || (tracked.status.next, sliding[index]) != (Next::Still, None) {
            continue;
        }
        let at = (index, can_be_held[index]);
        let root = at_work.1[index];
        let acceleration = if root > S::zero() {
            solution.residuals[index].abs().quotient(root)
        } else {
            S::zero()
        };
        let sign = begins_to_slide(problem.upper[index], solution, at);
        let sign = sign.filter(|_| !is_blocked(&problem.matrix, &holds, index));
        beginning[index] = sign.map(|sign| (sign, acceleration));
    }
    beginning
}

/// The friction at rest that is at its capacity and does not slide, because what is held blocks it:
/// the sign of the rate that it would have.
fn saturated<S: Real, M: Mechanism, const K: usize>(
    capacities: &Capacities<'_, S, M, K>,
    problem: &BoxProblem<S, K>,
    solution: &BoxSolution<S, K>,
    at_work: (S, &[S; K]),
    sliding: &[Option<S>; K],
) -> [Option<S>; K] {
    let (list, keeps_shares) = (capacities.list, capacities.loads.is_some());
    let can_be_held = held_at_bounds(list, problem, solution, at_work, sliding, keeps_shares);
    let holds = solution.places.map(|place| place == Place::Inside);
    core::array::from_fn(|index| {
        let tracked = &list[index];
        let is_still = (tracked.status.next, sliding[index]) == (Next::Still, None);
        let moves = problem.matrix[index][index] > S::zero();
        let is_one = tracked.friction().is_some() && is_still && moves && !can_be_held[index];
        let sign = match solution.places[index] {
            Place::Lower => Some(S::one()),
            Place::Upper => Some(-S::one()),
            Place::Inside => None,
        };
        sign.filter(|_| is_one && is_blocked(&problem.matrix, &holds, index))
    })
}

/// Whether what holds leaves a quantity nothing of its compliance.
fn is_blocked<S: Real, const K: usize>(
    matrix: &[[S; K]; K],
    holds: &[bool; K],
    index: usize,
) -> bool {
    if !holds.contains(&true) {
        return false;
    }
    let column = matrix.each_ref().map(|row| row[index]);
    let others = Factors::of(matrix, holds).solve(&column);
    let diagonal = matrix[index][index];
    let terms = matrix[index].iter().zip(&others);
    let rest = terms.fold(diagonal, |rest, (&w, &x)| (-w).fused(x, rest));
    rest <= part::<S>(BLOCKED, OF_BLOCKED) * diagonal
}

/// Lets friction slide; whether an effort has changed by that. Of those whose stiction is more than
/// their friction only what is accelerated most goes first: without its stiction the others may
/// stick.
fn begin<S: Real, M: Mechanism, const K: usize>(
    capacities: &Capacities<'_, S, M, K>,
    problem: &BoxProblem<S, K>,
    solution: &BoxSolution<S, K>,
    beginning: [Option<(S, S)>; K],
    sliding: &mut [Option<S>; K],
) -> bool {
    let mut changes = [None; K];
    for (index, _) in capacities.list.iter().enumerate() {
        let Some((sign, acceleration)) = beginning[index] else {
            continue;
        };
        let load = capacities.load(index, &solution.efforts);
        let [effort, _] = capacities.bounds(index, Some(sign), load);
        let is_changed = problem.lower[index] != effort && problem.upper[index] != effort;
        changes[index] = is_changed.then_some(acceleration);
    }
    let most = changes.iter().flatten().copied().reduce(S::max);
    let least = most.map(|most| most * (S::one() - S::constant(ALIKE)));
    let next = beginning.iter().zip(&changes).zip(sliding);
    for ((beginning, change), sliding) in next {
        let goes = match (least, change) {
            (Some(least), Some(acceleration)) => *acceleration >= least,
            (Some(_), None) => false,
            (None, _) => true,
        };
        if let (true, Some((sign, _))) = (goes, beginning) {
            *sliding = Some(*sign);
        }
    }
    most.is_some()
}

/// Marks friction at its capacity that cannot move, because what is held blocks it.
fn mark_blocked<S: Real, M: Mechanism, const K: usize>(
    list: &mut [Tracked<S, M>; K],
    matrix: &[[S; K]; K],
) {
    let holds = list.each_ref().map(|tracked| tracked.mode().holds());
    for (index, tracked) in list.iter_mut().enumerate() {
        let status = &mut tracked.status;
        let is_still = status.next == Next::Still && status.mode.sliding::<S>().is_some();
        let rests = is_still && is_blocked(matrix, &holds, index);
        status.rests = rests;
    }
}

/// The largest acceleration that is at work, over the root of its compliance: so all quantities
/// can be compared, whatever their units.
fn strength_of<S: Real, const K: usize>(
    problem: &BoxProblem<S, K>,
    solution: &BoxSolution<S, K>,
    roots: &[S; K],
) -> S {
    let sizes = problem.sizes(&solution.efforts);
    let pairs = sizes.into_iter().zip(roots);
    pairs.fold(S::zero(), |strength, (size, &root)| {
        if root > S::zero() {
            strength.max(size.quotient(root))
        } else {
            strength
        }
    })
}

/// Which frictions can be held at their bounds: those without acceleration, if they have the same
/// effort where all that is held is solved for. They have not where a limit bears the rest. Beside
/// friction by load, what is held keeps the share that it has.
fn held_at_bounds<S: Real, M: Mechanism, const K: usize>(
    list: &[Tracked<S, M>; K],
    problem: &BoxProblem<S, K>,
    solution: &BoxSolution<S, K>,
    (strength, roots): (S, &[S; K]),
    sliding: &[Option<S>; K],
    keeps_shares: bool,
) -> [bool; K] {
    let round_off = S::constant(NO_ACCELERATION) * S::EPSILON * strength;
    let mut held = [false; K];
    let mut places = solution.places;
    for (index, tracked) in list.iter().enumerate() {
        let status = tracked.status;
        let is_still = status.next == Next::Still && sliding[index].is_none();
        let is_at_bound = places[index] != Place::Inside;
        let rests = solution.residuals[index].abs() <= round_off * roots[index];
        if is_still && is_at_bound && rests && !status.slips() {
            held[index] = true;
            places[index] = Place::Inside;
        }
    }
    if keeps_shares || !held.contains(&true) {
        return held;
    }
    let Some(efforts) = problem.with_places(&places) else {
        return [false; K];
    };
    for (index, held) in held.iter_mut().enumerate() {
        let effort = solution.efforts[index];
        let change = (efforts[index] - effort).abs();
        let nearly = part::<S>(AT_BOUND, ROUND_OFF) * effort.abs();
        let bound = nearly.max(round_off.quotient(roots[index]));
        *held &= roots[index] > S::zero() && change <= bound;
    }
    held
}

/// The sign of the rate at which friction begins to slide; `None` where it sticks, or can be held
/// at its bound.
fn begins_to_slide<S: Real, const K: usize>(
    capacity: S,
    solution: &BoxSolution<S, K>,
    (index, can_be_held): (usize, bool),
) -> Option<S> {
    let residual = solution.residuals[index];
    if can_be_held {
        return None;
    }
    if capacity > S::zero() {
        return match solution.places[index] {
            Place::Lower => Some(S::one()),
            Place::Upper => Some(-S::one()),
            Place::Inside => None,
        };
    }
    // Without a capacity the acceleration says it.
    if residual > S::zero() {
        Some(S::one())
    } else if residual < S::zero() {
        Some(-S::one())
    } else {
        None
    }
}

impl<S: Real, M: Mechanism> Tracked<S, M> {
    /// The mode that follows, where a limit bears something or not, and friction slides at a rate
    /// of a sign or not.
    fn mode_after(&self, is_inside: bool, sliding: Option<S>) -> InteractionMode {
        match (self.status.next, sliding) {
            (Next::On(sign), _) if is_inside && sign > S::zero() => InteractionMode::AtLower,
            (Next::On(_), _) if is_inside => InteractionMode::AtUpper,
            (_, Some(sign)) if sign > S::zero() => InteractionMode::SlidingUp,
            (_, Some(_)) => InteractionMode::SlidingDown,
            (Next::Still, None) => InteractionMode::Sticking,
            _ if self.friction().is_some() => InteractionMode::Released,
            _ => InteractionMode::Free,
        }
    }

    /// Whether an effort may follow.
    pub(super) fn may_act(&self) -> bool {
        !matches!(self.status.next, Next::Without)
    }

    fn is_one_way(&self) -> bool {
        self.friction().is_some_and(|friction| friction.is_one_way)
    }

    /// A freewheel that turned out to bear nothing: it turns upwards, whatever round-off says.
    pub(super) fn is_overrun(&self) -> bool {
        let effort = self.status.exerted.effort;
        let overrun = |friction: Friction<S>| friction.is_overrun(effort);
        self.status.slips() && self.friction().is_some_and(overrun)
    }

    /// The efforts at work. The bound of a freewheel and of a limit is zero, which is known beside
    /// the forces on the bodies. Their size is an effort that does as much without constraints; its
    /// square is given.
    fn work_of_zero(&self, work: S, square: S) -> S {
        if self.is_one_way() || self.interaction.law.limits().is_some() {
            work.max(square.sqrt())
        } else {
            work
        }
    }

    /// Enters a mode with its effort, the one that would hold it alone, and the size of those that
    /// are at work.
    pub(super) fn enter(
        &mut self,
        mode: InteractionMode,
        scene: &Scene<'_, S, M>,
        [effort, alone, work]: [S; 3],
        motion: &Motion<S>,
    ) {
        let status = &mut self.status;
        if mode == InteractionMode::Sticking && status.before != InteractionMode::Sticking {
            status.held = self.interaction.quantity.value(scene);
        }
        status.mode = mode;
        status.since = scene.time;
        (status.exerted.effort, status.share) = (effort, effort);
        let reading = self.reading(scene);
        let round_off = S::constant(ROUND_OFF) * S::EPSILON;
        let at_work = S::constant(NO_ACCELERATION) * S::EPSILON * work;
        let floor = match mode {
            InteractionMode::Free => match self.interaction.law.limits() {
                Some(limits) => self.round_off_of_gap(limits, scene),
                None => S::zero(),
            },
            InteractionMode::AtLower | InteractionMode::AtUpper => {
                at_work.max(part::<S>(AT_BOUND, ROUND_OFF) * effort.abs().max(alone))
            }
            InteractionMode::Sticking => at_work.max(part::<S>(AT_BOUND, ROUND_OFF) * effort.abs()),
            // What slips idly, as others hold it, has rates of nothing but the error of steps.
            InteractionMode::Slipping => {
                let ended = part::<S>(ENDED, ROUND_OFF) * motion.size;
                if reading > ended {
                    round_off * motion.size
                } else {
                    ended
                }
            }
            _ => round_off * motion.size,
        };
        self.status.stand(reading, floor);
    }
}
