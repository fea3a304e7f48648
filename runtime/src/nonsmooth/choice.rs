//! The modes that follow, once impulses are known.

use crate::error::Fault;
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::box_problem::{BoxProblem, BoxSolution, Place};
use crate::nonsmooth::columns::{Columns, Setting};
use crate::nonsmooth::interaction::{Friction, Law};
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::status::{InteractionMode, Next, Tracked};
use crate::nonsmooth::switch::{AT_BOUND, Motion, ROUND_OFF, part, solved};

/// What was found at its capacity slips, to this part of it: more than the floor of a problem.
const SLIPS: f64 = 1e-11;

/// Accelerations that are none, in `EPSILON` of what efforts bring about.
const NO_ACCELERATION: f64 = 256.0;

/// Round-off of a gap, in `EPSILON` of its size.
const OF_GAP: f64 = 16.0;

/// The modes that follow, after impulses, from accelerations without efforts of interactions.
pub(crate) fn modes<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    list: &[Tracked<S, M>; K],
    accelerations: &C::Velocities<S>,
) -> Result<(), Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let chosen = list.each_ref().map(|tracked| {
        let next = tracked.status.get().next;
        !matches!(next, Next::Without)
    });
    let columns = Columns::of(setting, list, &chosen)?;
    let offset = setting.accelerations(list, accelerations);
    let mut problem = BoxProblem::at_rest(columns.delassus, offset);
    let motions: [Motion<S>; K] =
        setting.here(|scene| list.each_ref().map(|tracked| Motion::of(tracked, scene)));
    let infinite = S::constant(f64::INFINITY);
    // The sign of the rate at which friction slides, or begins to.
    let mut sliding = [None; K];
    for (index, tracked) in list.iter().enumerate() {
        let (lower, upper) = match (tracked.status.get().next, tracked.friction()) {
            (Next::On(sign), _) if sign > S::zero() => (S::zero(), infinite),
            (Next::On(_), _) => (-infinite, S::zero()),
            (Next::Still, Some(friction)) => {
                // What was found at its capacity does not fall back by round-off.
                let status = tracked.status.get();
                let slips = status.is_found && status.before == InteractionMode::Sticking;
                let part = if slips {
                    S::one() - part::<S>(SLIPS, ROUND_OFF)
                } else {
                    S::one()
                };
                let capacity = part * friction.at_rest();
                (-capacity, capacity)
            }
            (Next::Moving(sign), Some(friction)) => {
                sliding[index] = Some(sign);
                let effort = -sign * friction.sliding(motions[index].rate);
                (effort, effort)
            }
            _ => (S::zero(), S::zero()),
        };
        (problem.lower[index], problem.upper[index]) = (lower, upper);
    }
    let mut solution = solved(&problem, setting, list)?;
    let roots: [S; K] = core::array::from_fn(|index| {
        let diagonal = columns.delassus[index][index];
        diagonal.max(S::zero()).sqrt()
    });
    let mut strength = strength_of(&problem, &solution, &roots);
    // What begins to slide has the friction of sliding: others may follow.
    for _ in 0..K {
        let mut is_changed = false;
        let can_be_held = held_at_bounds(list, &problem, &solution, (strength, &roots), &sliding);
        for (index, tracked) in list.iter().enumerate() {
            let (Next::Still, None) = (tracked.status.get().next, sliding[index]) else {
                continue;
            };
            let Some(friction) = tracked.friction() else {
                continue;
            };
            let is_held = can_be_held[index];
            let Some(sign) = begins_to_slide(friction, &solution, (index, is_held)) else {
                continue;
            };
            sliding[index] = Some(sign);
            let effort = -sign * friction.sliding(S::zero());
            is_changed |= problem.lower[index] != effort && problem.upper[index] != effort;
            (problem.lower[index], problem.upper[index]) = (effort, effort);
        }
        if !is_changed {
            break;
        }
        solution = solved(&problem, setting, list)?;
        strength = strength_of(&problem, &solution, &roots);
    }
    for (index, tracked) in list.iter().enumerate() {
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
        let mode = match (tracked.status.get().next, sliding[index]) {
            (Next::On(sign), _) if is_inside && sign > S::zero() => InteractionMode::AtLower,
            (Next::On(_), _) if is_inside => InteractionMode::AtUpper,
            (_, Some(sign)) if sign > S::zero() => InteractionMode::SlidingUp,
            (_, Some(_)) => InteractionMode::SlidingDown,
            (Next::Still, None) => InteractionMode::Sticking,
            _ if tracked.friction().is_some() => InteractionMode::Released,
            _ => InteractionMode::Free,
        };
        let work = if roots[index] > S::zero() {
            strength.quotient(roots[index])
        } else {
            alone
        };
        let efforts = [effort, alone, work];
        setting.here(|scene| tracked.enter(mode, scene, efforts, &motions[index]));
    }
    Ok(())
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
/// effort where all that is held is solved for. They have not where a limit bears the rest.
fn held_at_bounds<S: Real, M: Mechanism, const K: usize>(
    list: &[Tracked<S, M>; K],
    problem: &BoxProblem<S, K>,
    solution: &BoxSolution<S, K>,
    (strength, roots): (S, &[S; K]),
    sliding: &[Option<S>; K],
) -> [bool; K] {
    let round_off = S::constant(NO_ACCELERATION) * S::EPSILON * strength;
    let mut held = [false; K];
    let mut places = solution.places;
    for (index, tracked) in list.iter().enumerate() {
        let status = tracked.status.get();
        let slips = status.is_found && status.before == InteractionMode::Sticking;
        let is_still = status.next == Next::Still && sliding[index].is_none();
        let is_at_bound = places[index] != Place::Inside;
        let rests = solution.residuals[index].abs() <= round_off * roots[index];
        if is_still && is_at_bound && rests && !slips {
            held[index] = true;
            places[index] = Place::Inside;
        }
    }
    if !held.contains(&true) {
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
    friction: &Friction<S>,
    solution: &BoxSolution<S, K>,
    (index, can_be_held): (usize, bool),
) -> Option<S> {
    let residual = solution.residuals[index];
    if can_be_held {
        return None;
    }
    if friction.at_rest() > S::zero() {
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
    /// Enters a mode with its effort, the one that would hold it alone, and the size of those that
    /// are at work.
    fn enter(
        &self,
        mode: InteractionMode,
        scene: &Scene<'_, S, M>,
        [effort, alone, work]: [S; 3],
        motion: &Motion<S>,
    ) {
        self.update(|status| {
            if mode == InteractionMode::Sticking && status.before != InteractionMode::Sticking {
                status.held = self.interaction.quantity.value(scene);
            }
            status.mode = mode;
            status.effort = effort;
        });
        if let Law::Limits(limits) = &self.interaction.law {
            self.begin_turning(self.value_now(limits, scene), scene);
        }
        let reading = self.reading(scene);
        let round_off = S::constant(ROUND_OFF) * S::EPSILON;
        let floor = match mode {
            InteractionMode::Free => S::constant(OF_GAP) * S::EPSILON * self.size(scene),
            InteractionMode::AtLower | InteractionMode::AtUpper => {
                part::<S>(AT_BOUND, ROUND_OFF) * effort.abs().max(alone)
            }
            InteractionMode::Sticking => {
                let at_work = S::constant(NO_ACCELERATION) * S::EPSILON * work;
                at_work.max(part::<S>(AT_BOUND, ROUND_OFF) * effort.abs())
            }
            _ => round_off * motion.size,
        };
        self.update(|status| status.stand(reading, floor));
    }
}
