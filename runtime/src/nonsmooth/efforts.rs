//! Efforts within a step, where the modes are fixed.

use crate::error::{Fault, ModeFault, StepFault};
use crate::formulation::{Formulation, Solution};
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::box_problem::Factors;
use crate::nonsmooth::columns::{Columns, Setting};
use crate::nonsmooth::cones::{self, are_rough};
use crate::nonsmooth::interaction::Interaction;
use crate::nonsmooth::loads::{BearingLoads, Reactions};
use crate::nonsmooth::mode::InteractionMode;
use crate::nonsmooth::pace::Haste;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::slipping::{Refusal, Slipping, held};
use crate::nonsmooth::status::{Exerted, Show, Tracked};
use crate::state::vector::Array;

/// Rounds of correction. The second takes what round-off and an iterated formulation leave, so that
/// what is held does not creep.
const ROUNDS: usize = 2;

impl<S: Real, M: Mechanism> Tracked<S, M> {
    /// The effort of friction that slides, which is known; `None` in another mode.
    pub(crate) fn sliding_effort(&self, scene: &Scene<'_, S, M>) -> Option<S> {
        if self.bearing().is_some() {
            return None;
        }
        self.effort_of_sliding(scene)
    }

    /// The effort over the load of friction that slides by it.
    fn slipping(&self, scene: &Scene<'_, S, M>) -> Option<S> {
        self.bearing()?;
        self.effort_of_sliding(scene)
    }

    fn effort_of_sliding(&self, scene: &Scene<'_, S, M>) -> Option<S> {
        let sign = self.mode().sliding::<S>()?;
        let friction = self.friction()?;
        if self.status.is_saturated {
            let [lower, upper] = friction.bounds();
            return Some(if sign > S::zero() { lower } else { upper });
        }
        Some(friction.effort(sign, self.interaction.quantity.rate(scene)))
    }

    /// Its power (W) in a state by its effort. What holds has none: its rate is zero.
    pub(crate) fn power(&self, effort: S, scene: &Scene<'_, S, M>) -> S {
        if self.mode().slides() {
            effort * self.interaction.quantity.rate(scene)
        } else {
            S::zero()
        }
    }

    /// Whether it slides by its load.
    pub(crate) fn slips_by_load(&self) -> bool {
        let slides = self.bearing().is_some() && self.mode().sliding::<S>().is_some();
        slides || self.mode() == InteractionMode::Slipping
    }

    /// The fault of an effort of this friction.
    pub(super) fn refused(&self, refusal: Refusal, time: S) -> Fault {
        match refusal {
            Refusal::NotUnique(_) => Fault::Mode(ModeFault::NoUniqueFriction {
                joint: self.interaction.name(),
                time: time.to_f64(),
            }),
            Refusal::NotFinite => Fault::Step(StepFault::StateNotFinite),
        }
    }
}

/// The fault of a refusal.
pub(super) fn refused<S: Real, M: Mechanism, const K: usize>(
    refusal: Refusal,
    list: &[Tracked<S, M>; K],
    time: S,
) -> Fault {
    let index = match refusal {
        Refusal::NotUnique(index) => index,
        Refusal::NotFinite => 0,
    };
    let fault = list
        .get(index)
        .map(|tracked| tracked.refused(refusal, time));
    fault.unwrap_or(Fault::Step(StepFault::StateNotFinite))
}

/// Adds the efforts that hold, and those of what slides by its load, to a solution, which has those
/// of other sliding friction. Shows what all of them exert where that is wanted.
pub(crate) fn complete<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    reactions: Option<Reactions<'_, S, M, F>>,
    list: &[Tracked<S, M>; K],
    (solution, show): (&mut Solution<S, M, C>, Option<&mut Show<'_, S>>),
) -> Result<(), Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    if are_rough(list) {
        return cones::complete(setting, list, (solution, show));
    }
    let holds = list.each_ref().map(|tracked| tracked.mode().holds());
    let any_holds = holds.contains(&true);
    let mut chosen = holds;
    let mut coefficients = [None; K];
    if list.iter().any(Tracked::slips_by_load) {
        coefficients = setting.here(|scene| list.each_ref().map(|tracked| tracked.slipping(scene)));
        for (chosen, coefficient) in chosen.iter_mut().zip(&coefficients) {
            *chosen |= coefficient.is_some();
        }
    }
    // Beside friction by load, what is held keeps its share.
    let mut shares = [S::zero(); K];
    if list.iter().any(|tracked| tracked.bearing().is_some()) {
        for (share, tracked) in shares.iter_mut().zip(list) {
            if tracked.mode().holds() {
                *share = tracked.status.share;
            }
        }
    }
    let mut efforts = [S::zero(); K];
    let mut loads = None;
    if chosen.contains(&true) {
        let columns = Columns::of(setting, list, &chosen)?;
        let is_wanted = show.is_some();
        if list.iter().any(|tracked| tracked.asks_for_load(is_wanted)) {
            loads = Some(BearingLoads::of(
                setting, reactions, list, &columns, solution,
            )?);
        }
        let factors = Factors::of(&columns.delassus, &holds);
        let bias = if any_holds {
            setting.bias(list)
        } else {
            [S::zero(); K]
        };
        for round in 0..if any_holds { ROUNDS } else { 1 } {
            let accelerations = if any_holds {
                columns.accelerations(setting, list, &bias, &solution.accelerations)
            } else {
                [S::zero(); K]
            };
            let change = match &loads {
                Some(loads) if round == 0 => Slipping {
                    matrix: &columns.delassus,
                    loads,
                    holds,
                    coefficients,
                }
                .efforts(&accelerations, &shares)
                .map_err(|refusal| refused(refusal, list, setting.saddle.time))?,
                None if round == 0 && shares.iter().any(|share| *share != S::zero()) => {
                    held(&factors, &columns.delassus, &accelerations, &shares)
                }
                _ => factors.solve(&accelerations).map(|change| -change),
            };
            columns.add_to(&change, solution);
            for (effort, change) in efforts.iter_mut().zip(change) {
                *effort = *effort + change;
            }
        }
    }
    if let Some(show) = show {
        let loads = loads.map(|loads| loads.sizes(&efforts));
        let exerted: [Exerted<S>; K] = setting.here(|scene| {
            core::array::from_fn(|index| {
                let (tracked, effort) = (&list[index], efforts[index]);
                Exerted {
                    effort: tracked.sliding_effort(scene).unwrap_or(effort),
                    capacity: tracked.capacity(loads.map(|loads| loads[index])),
                    size: S::zero(),
                    haste: Haste::none(),
                    determinant: S::zero(),
                }
            })
        });
        show(&exerted);
    }
    Ok(())
}

impl<S: Real, M: Mechanism> Tracked<S, M> {
    /// Whether its effort asks for its load, or its capacity, where efforts are wanted.
    pub(crate) fn asks_for_load(&self, is_wanted: bool) -> bool {
        let sticks = is_wanted && self.mode() == InteractionMode::Sticking;
        self.bearing().is_some() && (self.slips_by_load() || sticks)
    }

    /// The largest effort at rest, by its load where it goes with one: that which was known last
    /// where this is not known. Zero where there is none, as of a dog.
    pub(super) fn capacity(&self, load: Option<S>) -> S {
        let Some(friction) = self.friction().filter(|of| of.at_rest().is_finite()) else {
            return S::zero();
        };
        match (friction.bearing, load) {
            (None, _) => friction.at_rest(),
            (Some(_), Some(load)) => friction.at_rest() * load,
            (Some(_), None) => self.status.exerted.capacity,
        }
    }
}

/// What brings back what is held, to where it is held and to rest: changes of velocities, and of
/// coordinates as velocities over a unit of time. The least ones in the metric of the mass. A limit
/// that has just been found is brought to its zero beside them: so all that come to theirs together
/// with it are found at this instant.
pub(crate) fn corrections<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    list: &mut [Tracked<S, M>; K],
    [velocities, displacements]: [&mut C::Velocities<S>; 2],
) -> Result<(), Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let holds = list.each_ref().map(|tracked| tracked.mode().holds());
    if !holds.contains(&true) {
        return Ok(());
    }
    let stands = list.each_ref().map(Tracked::stands);
    let columns = Columns::of(setting, list, &stands)?;
    let efforts = list
        .each_ref()
        .map(|tracked| tracked.status.exerted.effort.abs());
    for (tracked, row) in list.iter_mut().zip(&columns.delassus) {
        let terms = row.iter().zip(&efforts);
        let change = terms.fold(S::zero(), |sum, (&w, &effort)| w.abs().fused(effort, sum));
        tracked.status.is_brought_back(setting.saddle.time, change);
    }
    let factors = Factors::of(&columns.delassus, &holds);
    let (rates, beyond) = setting.here(|scene| {
        let rates = super::columns::rates(list, scene);
        let beyond = list.each_ref().map(|tracked| tracked.beyond(scene));
        (rates, beyond)
    });
    let impulses = factors.solve(&rates).map(|impulse| -impulse);
    columns.add_velocities(&impulses, velocities);
    let factors = if stands == holds {
        factors
    } else {
        Factors::of(&columns.delassus, &stands)
    };
    let moves = factors.solve(&beyond).map(|by| -by);
    *displacements = Array::zeros();
    columns.add_velocities(&moves, displacements);
    Ok(())
}

impl<S: Real, M: Mechanism> Tracked<S, M> {
    /// Whether a limit has just been found.
    pub(crate) fn lands(&self) -> bool {
        let is_limit = self.interaction.law.limits().is_some();
        is_limit && self.mode() == InteractionMode::Free && self.status.is_found
    }

    /// Whether it is held, or a limit that has just been found.
    fn stands(&self) -> bool {
        self.mode().holds() || self.lands()
    }

    /// How far it is from where it is held, or from the limit that has been found; zero where
    /// nothing but the rate is held.
    fn beyond(&self, scene: &Scene<'_, S, M>) -> S {
        let Interaction { quantity, law, .. } = &self.interaction;
        let held = match self.mode() {
            InteractionMode::Sticking => quantity.has_value().then_some(self.status.held),
            InteractionMode::Free if self.stands() => law.nearest(quantity.value(scene)),
            mode => law.held_at(mode),
        };
        held.map_or(S::zero(), |held| quantity.beyond(scene, held))
    }
}
