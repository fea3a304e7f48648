//! Contacts with friction: which efforts they have, and in which modes they are.
//!
//! A contact stands in a list with its friction behind it, along one direction of its plane or
//! both. Where such a list is chosen for, `cone_problem.rs` takes the place of `box_problem.rs`.

use crate::error::{Fault, ModeFault, StepFault};
use crate::formulation::{Formulation, Solution};
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::box_problem::BoxProblem;
use crate::nonsmooth::columns::{Columns, Setting};
use crate::nonsmooth::cone_problem::{
    ConeProblem, ConeSolution, NoSolution, Outcome, Role, Rough, length,
};
use crate::nonsmooth::jam;
use crate::nonsmooth::law::Friction;
use crate::nonsmooth::mode::InteractionMode;
use crate::nonsmooth::motion::Motion;
use crate::nonsmooth::pace::Haste;
use crate::nonsmooth::reader::Reader;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::sizes::{ROUND_OFF, part, strength_of_forces};
use crate::nonsmooth::slip::{combined, share_sizes, tangents_of};
use crate::nonsmooth::status::{Exerted, Next, Show, Tracked};
use crate::nonsmooth::tied::{Tied, at, residuals};

/// What was found at the end of its sticking slips, to this part of what it can bear.
const AT_ITS_END: f64 = 1e-10;

/// What is as near to what it can bear as this is found there together with another.
const TOGETHER: f64 = 1e-9;

/// A contact that bears less than this part of what it would bear alone is left: shares of what
/// motion does not determine are known to some 1e-10.
const BEARS: f64 = 1e-9;

/// Rounds of correction, as of other efforts that hold.
const ROUNDS: usize = 2;

/// Whether the cone decides.
pub(super) fn are_rough<S: Real, M: Mechanism>(list: &[Tracked<S, M>]) -> bool {
    list.iter().any(|tracked| {
        let limits = tracked.interaction.law.limits();
        tracked.tangent().is_some() || limits.is_some_and(|limits| limits.is_of_impulses)
    })
}

/// The friction of a contact, by the modes that may follow.
fn rough<S: Real, M: Mechanism>(
    list: &[Tracked<S, M>],
    contact: usize,
    slips: Option<&[[S; 2]]>,
) -> Option<Rough<S>> {
    let tangents = tangents_of(list, contact);
    let place = tangents[0]?;
    let first = list.get(place)?;
    let coefficient = first.friction()?.capacity;
    let less = part::<S>(AT_ITS_END, ROUND_OFF);
    // What bears a load together is at its end together.
    let Exerted { capacity, size, .. } = first.status.exerted;
    let is_near = size >= capacity * (S::one() - part::<S>(TOGETHER, ROUND_OFF));
    let stuck = first.status.before == InteractionMode::Sticking;
    let at_rest = if first.status.slips() || stuck && is_near {
        coefficient * (S::one() - less)
    } else {
        coefficient
    };
    let moves = matches!(first.status.next, Next::Moving(_));
    let slip = slips.and_then(|slips| slips.get(place));
    Some(Rough {
        coefficient,
        at_rest,
        tangents,
        slip: slip.filter(|_| moves).copied(),
    })
}

/// What may act at every unknown, where accelerations are looked for.
fn roles<S: Real, M: Mechanism, const K: usize>(
    list: &[Tracked<S, M>; K],
    motions: &[Motion<S>; K],
    slips: &[[S; 2]; K],
) -> [Role<S>; K] {
    core::array::from_fn(|index| {
        let tracked = &list[index];
        if tracked.tangent().is_some() {
            return Role::Tangent;
        }
        let (friction, next) = (tracked.friction(), tracked.status.next);
        match (next, friction) {
            (Next::On(sign), _) => Role::Pushes {
                sign,
                least: S::zero(),
                rough: rough(list, index, Some(slips)).filter(|_| sign > S::zero()),
            },
            (Next::Moving(sign), Some(friction)) => {
                Role::Given(friction.effort(sign, motions[index].rate))
            }
            (Next::Still, Some(friction)) if tracked.is_overrun() => {
                Role::Given(friction.effort(S::one(), S::zero()))
            }
            (Next::Still, Some(friction)) => at_rest(&friction, tracked.status.slips()),
            _ => Role::Given(S::zero()),
        }
    })
}

fn at_rest<S: Real>(friction: &Friction<S>, slips: bool) -> Role<S> {
    let (zero, one) = (S::zero(), S::one());
    let rest = if slips {
        one - part::<S>(AT_ITS_END, ROUND_OFF)
    } else {
        one
    };
    Role::Within {
        bounds: friction.bounds().map(|bound| rest * bound),
        sliding: [one, -one].map(|sign| friction.effort(sign, zero)),
    }
}

/// The solution, or the fault where there is none.
pub(super) fn solved<S, M, F, C, const K: usize>(
    problem: &ConeProblem<S, K>,
    setting: &Setting<'_, S, M, F, C>,
    list: &[Tracked<S, M>; K],
) -> Result<ConeSolution<S, K>, Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let finite = problem.matrix.iter().flatten().chain(&problem.offset);
    if !finite.into_iter().all(|number| number.is_finite()) {
        return Err(Fault::Step(StepFault::StateNotFinite));
    }
    problem.solved().map_err(|why| {
        let is_rough = |role: &Role<S>| matches!(role, Role::Pushes { rough: Some(_), .. });
        let place = problem.roles.iter().position(is_rough);
        let first = place.and_then(|index| list.get(index)).or(list.first());
        let joint = first.map_or("", |first| first.interaction.name());
        let time = setting.saddle.time.to_f64();
        Fault::Mode(match why {
            NoSolution::TooMany => ModeFault::TooManyContacts { joint, time },
            NoSolution::None | NoSolution::Several => ModeFault::NoUniqueFriction { joint, time },
        })
    })
}

/// The impulses of an instant, by Newton's restitution, which the offset has already, or by
/// Poisson's: those after the greatest compression are at least so many times those until then.
pub(super) fn impulses<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    list: &[Tracked<S, M>; K],
    within: &BoxProblem<S, K>,
    (signs, restitutions): ([Option<S>; K], [S; K]),
) -> Result<[S; K], Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let mut least = [S::zero(); K];
    let role = |index: usize, least: S| match signs[index] {
        Some(sign) => Role::Pushes {
            sign,
            least,
            rough: rough(list, index, None).filter(|_| sign > S::zero()),
        },
        None if list[index].tangent().is_some() => Role::Tangent,
        None => {
            let bounds = [within.lower[index], within.upper[index]];
            Role::Within {
                bounds,
                sliding: bounds,
            }
        }
    };
    let mut problem = ConeProblem {
        matrix: within.matrix,
        offset: within.offset,
        roles: core::array::from_fn(|index| role(index, S::zero())),
    };
    let mut total = solved(&problem, setting, list)?.efforts;
    for (least, (&restitution, &impulse)) in least.iter_mut().zip(restitutions.iter().zip(&total)) {
        *least = restitution * impulse.abs();
    }
    if least.iter().any(|&least| least > S::zero()) {
        problem.offset = residuals(&problem.matrix, &problem.offset, &total);
        problem.roles = core::array::from_fn(|index| role(index, least[index]));
        let expansion = solved(&problem, setting, list)?.efforts;
        for (sum, impulse) in total.iter_mut().zip(expansion) {
            *sum = *sum + impulse;
        }
    }
    Ok(total)
}

/// The modes that follow, after impulses, from the solution without efforts of interactions.
pub(super) fn modes<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    list: &mut [Tracked<S, M>; K],
    free: &Solution<S, M, C>,
) -> Result<(), Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let chosen = list.each_ref().map(|tracked| tracked.may_act());
    let columns = Columns::of(setting, list, &chosen)?;
    let bias = setting.bias(list);
    let offset = columns.accelerations(setting, list, &bias, &free.accelerations);
    let motions: [Motion<S>; K] =
        setting.here(|scene| list.each_mut().map(|tracked| Motion::of(tracked, scene)));
    let forces = setting.here(strength_of_forces);
    share_sizes(list);
    let slips = setting.here(|scene| {
        let mut reader = Reader::of(scene);
        list.each_ref()
            .map(|tracked| tracked.direction_to_choose(&mut reader))
    });
    let problem = ConeProblem {
        matrix: columns.delassus,
        offset,
        roles: roles(list, &motions, &slips),
    };
    let solution = solved(&problem, setting, list)?;
    let mut sizes = exerted(list, &solution.efforts);
    let towards = (&solution.efforts, &slips);
    hasten(list, (&columns.delassus, &offset), towards, &mut sizes);
    for index in 0..K {
        let diagonal = columns.delassus[index][index];
        let alone = if diagonal > S::zero() {
            offset[index].abs().quotient(diagonal)
        } else {
            S::zero()
        };
        let bears = |sign: S| {
            let effort = sign * at(&solution.efforts, index);
            effort > part::<S>(BEARS, ROUND_OFF) * alone
        };
        let does_grow = does_grow(list, &sizes, index);
        let tracked = &mut list[index];
        let mut led = None;
        let mode = match (solution.outcomes[index], tracked.status.next) {
            (Outcome::Holds, Next::On(sign)) if bears(sign) => {
                if sign > S::zero() {
                    InteractionMode::AtLower
                } else {
                    InteractionMode::AtUpper
                }
            }
            (_, Next::On(_)) => InteractionMode::Free,
            (Outcome::Holds, _) => InteractionMode::Sticking,
            (Outcome::Slips(slip), next) => {
                let now = setting.here(|scene| tracked.slip(&mut Reader::of(scene)));
                tracked.status.slip = combined(&now.directions, slip);
                let goes_on = tracked.status.before == InteractionMode::Slipping;
                let size = length(now.components);
                led = tracked
                    .status
                    .goes_on_led(size)
                    .filter(|_| goes_on && does_grow);
                tracked.status.begins = led.is_some() || !matches!(next, Next::Moving(_));
                tracked.status.ends &= goes_on;
                tracked.status.has_turned &= goes_on;
                InteractionMode::Slipping
            }
            (Outcome::Slides(sign), _) => slides(sign),
            (Outcome::Given, Next::Moving(sign)) if tracked.tangent().is_none() => slides(sign),
            (Outcome::Given, Next::Still) if tracked.is_overrun() => slides(S::one()),
            _ => tracked.interaction.law.idle_mode(),
        };
        tracked.status.ends &= mode == InteractionMode::Slipping;
        tracked.status.is_saturated = false;
        tracked.status.rests = false;
        tracked.status.exerted = sizes[index];
        // A contact that bears nothing any more is known beside the forces on the bodies.
        let work = if columns.free[index] > S::zero() {
            alone.max(forces.quotient(columns.free[index]).sqrt())
        } else {
            alone
        };
        let efforts = [solution.efforts[index], alone, work];
        setting.here(|scene| {
            tracked.enter(mode, scene, efforts, &motions[index]);
            let size = length(tracked.slip(&mut Reader::of(scene)).components);
            tracked.status.pace_from(scene.time, size, led);
        });
    }
    free_what_is_open(list);
    let determinant = setting.here(|scene| determinant(list, scene, &columns.delassus));
    jam::begin(list, determinant);
    Ok(())
}

/// What bears nothing does not rub.
fn free_what_is_open<S: Real, M: Mechanism, const K: usize>(list: &mut [Tracked<S, M>; K]) {
    for index in 0..K {
        let contact = list[index].contact(index);
        let is_open = contact
            .and_then(|index| list.get(index))
            .is_some_and(|tracked| tracked.mode() == InteractionMode::Free);
        if is_open {
            list[index].status.mode = InteractionMode::Free;
        }
    }
}

/// Whether the slip in both directions of a contact does not shrink, as friction at an index does.
fn does_grow<S: Real, M: Mechanism, const K: usize>(
    list: &[Tracked<S, M>; K],
    sizes: &[Exerted<S>; K],
    index: usize,
) -> bool {
    let contact = list.get(index).and_then(|tracked| tracked.contact(index));
    match contact.map(|contact| tangents_of(list, contact)) {
        Some([Some(first), Some(_)]) => sizes.get(first).is_some_and(|first| first.haste.grows),
        _ => true,
    }
}

/// Makes friction that slips a multiple of the effort of its contact, by the direction of its slip.
fn follow<S: Real, M: Mechanism, const K: usize>(
    list: &[Tracked<S, M>; K],
    slips: &[[S; 2]; K],
    tied: &mut Tied<S, K>,
) {
    for index in 0..K {
        let tracked = &list[index];
        let (Some(contact), InteractionMode::Slipping) = (tracked.contact(index), tracked.mode())
        else {
            continue;
        };
        let [first, second] = tangents_of(list, contact);
        let coefficient = first.and_then(|first| Some(list.get(first)?.friction()?.capacity));
        let slip = first.and_then(|first| slips.get(first)).copied();
        let [along, across] = slip.unwrap_or([S::zero(); 2]);
        let component = if Some(index) == second { across } else { along };
        let factor = -(coefficient.unwrap_or(S::zero()) * component);
        tied.follows[index] = Some((contact, factor));
    }
}

/// What holds in the modes that there are, and what follows it.
fn tied_in_modes<S: Real, M: Mechanism, const K: usize>(
    list: &[Tracked<S, M>; K],
    slips: &[[S; 2]; K],
) -> Tied<S, K> {
    let mut tied = Tied::nothing();
    tied.holds = list.each_ref().map(|tracked| tracked.mode().holds());
    follow(list, slips, &mut tied);
    tied
}

/// The determinant of the equations of what holds, with which modes begin.
fn determinant<S: Real, M: Mechanism, const K: usize>(
    list: &[Tracked<S, M>; K],
    scene: &Scene<'_, S, M>,
    matrix: &[[S; K]; K],
) -> S {
    let mut reader = Reader::of(scene);
    let direction = |tracked: &Tracked<S, M>| tracked.direction_at_beginning(&mut reader);
    tied_in_modes(list, &list.each_ref().map(direction)).determinant(matrix)
}

/// What acts at every unknown in the modes that there are.
fn roles_in_modes<S: Real, M: Mechanism, const K: usize>(
    list: &[Tracked<S, M>; K],
    slips: &[[S; 2]; K],
) -> [Role<S>; K] {
    core::array::from_fn(|index| {
        let tracked = &list[index];
        let holds = tracked.mode().holds();
        if tracked.tangent().is_some() {
            return Role::Tangent;
        }
        if !holds {
            return Role::Given(S::zero());
        }
        let rough = rough(list, index, None).map(|rough| {
            let first = rough.tangents[0];
            let slips_now = first
                .and_then(|first| list.get(first))
                .is_some_and(|first| first.mode() == InteractionMode::Slipping);
            let slip = first.and_then(|first| slips.get(first)).copied();
            Rough {
                slip: slip.filter(|_| slips_now),
                ..rough
            }
        });
        Role::Pushes {
            sign: S::one(),
            least: S::zero(),
            rough,
        }
    })
}

/// The contact and the coefficient of all friction that sticks.
fn sticking<S: Real, M: Mechanism, const K: usize>(
    list: &[Tracked<S, M>; K],
) -> [Option<(usize, S)>; K] {
    core::array::from_fn(|index| {
        let contact = list[index].contact(index)?;
        let first = tangents_of(list, contact)[0].and_then(|first| list.get(first))?;
        let sticks = list[index].mode() == InteractionMode::Sticking;
        sticks.then_some((contact, first.friction()?.capacity))
    })
}

fn slides<S: Real>(sign: S) -> InteractionMode {
    if sign > S::zero() {
        InteractionMode::SlidingUp
    } else {
        InteractionMode::SlidingDown
    }
}

/// What all exert by their efforts. Of friction of a contact the capacity is `mu N`.
fn exerted<S: Real, M: Mechanism, const K: usize>(
    list: &[Tracked<S, M>; K],
    efforts: &[S; K],
) -> [Exerted<S>; K] {
    core::array::from_fn(|index| {
        let (tracked, effort) = (&list[index], efforts[index]);
        let Some(contact) = tracked.contact(index) else {
            return Exerted {
                effort,
                capacity: tracked.capacity(None),
                size: S::zero(),
                haste: Haste::none(),
                determinant: S::zero(),
            };
        };
        let places = tangents_of(list, contact);
        let first = places[0].and_then(|index| list.get(index));
        let coefficient = first.and_then(|first| Some(first.friction()?.capacity));
        let read = |index: Option<usize>| index.map_or(S::zero(), |index| at(efforts, index));
        Exerted {
            effort,
            capacity: coefficient.unwrap_or(S::zero()) * at(efforts, contact),
            size: length(places.map(read)),
            haste: Haste::none(),
            determinant: S::zero(),
        }
    })
}

/// Adds how fast slip changes that turns: by accelerations without efforts, and by directions.
fn hasten<S: Real, M: Mechanism, const K: usize>(
    list: &[Tracked<S, M>; K],
    (matrix, offset): (&[[S; K]; K], &[S; K]),
    (efforts, slips): (&[S; K], &[[S; 2]; K]),
    sizes: &mut [Exerted<S>; K],
) {
    for contact in 0..K {
        let [Some(first), Some(second)] = tangents_of(list, contact) else {
            continue;
        };
        if let (Some(exerted), Some(&slip)) = (sizes.get_mut(first), slips.get(first)) {
            exerted.haste = Haste::of((matrix, offset), efforts, [first, second], slip);
        }
    }
}

/// Adds the efforts that hold, and those of what slips on contacts, to a solution, which has those
/// of other sliding friction. Shows what all of them exert where that is wanted.
pub(super) fn complete<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    list: &[Tracked<S, M>; K],
    (solution, show): (&mut Solution<S, M, C>, Option<&mut Show<'_, S>>),
) -> Result<(), Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let slips = setting.here(|scene| {
        let mut reader = Reader::of(scene);
        let direction = |tracked: &Tracked<S, M>| tracked.direction_of_slip(&mut reader);
        list.each_ref().map(direction)
    });
    let mut tied = tied_in_modes(list, &slips);
    let mut chosen = tied.holds;
    for (chosen, tracked) in chosen.iter_mut().zip(list) {
        *chosen |= tracked.mode() == InteractionMode::Slipping;
    }
    let (mut efforts, mut determinant) = ([S::zero(); K], S::zero());
    let mut hastes = None;
    if chosen.contains(&true) {
        let columns = Columns::of(setting, list, &chosen)?;
        let (sticking, bias) = (sticking(list), setting.bias(list));
        // Correction is for what goes on from here: efforts alone are there after the first round.
        for round in 0..if show.is_some() { 1 } else { ROUNDS } {
            let solved = &solution.accelerations;
            let accelerations = columns.accelerations(setting, list, &bias, solved);
            if round == 0 && list.iter().any(Tracked::begins) {
                let problem = ConeProblem {
                    matrix: columns.delassus,
                    offset: accelerations,
                    roles: roles_in_modes(list, &slips),
                };
                let begins = list.each_ref().map(Tracked::begins);
                if let Some(directions) = problem.directions(&begins) {
                    follow(list, &directions, &mut tied);
                }
            }
            if round == 0 {
                determinant = tied.determinant(&columns.delassus);
            }
            let change = tied.shared(&columns.delassus, &accelerations, &sticking);
            columns.add_to(&change, solution);
            for (effort, change) in efforts.iter_mut().zip(change) {
                *effort = *effort + change;
            }
            hastes = Some((columns.delassus, accelerations)).filter(|_| show.is_some());
        }
    }
    let Some(show) = show else {
        return jam::refuse(list, determinant, setting.saddle.time);
    };
    let mut sizes = exerted(list, &efforts);
    if let Some((matrix, offset)) = &hastes {
        hasten(list, (matrix, offset), (&efforts, &slips), &mut sizes);
    }
    setting.here(|scene| {
        for (exerted, tracked) in sizes.iter_mut().zip(list) {
            exerted.determinant = determinant;
            if let Some(effort) = tracked.sliding_effort(scene) {
                exerted.effort = effort;
            }
        }
    });
    show(&sizes);
    Ok(())
}
