//! Forces with interactions: those that a run is given, and the limits of the description.

use core::fmt::{self, Debug};

use crate::error::Fault;
use crate::formulation::{Formulation, Solution};
use crate::math::scalar::{Real, Scalar};
use crate::measure::load::{AppliedForces, Loads};
use crate::measure::view::View;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::limits::{Nothing, Several, Visit};
use crate::nonsmooth::columns::Setting;
use crate::nonsmooth::described::renewed;
use crate::nonsmooth::efforts::complete;
use crate::nonsmooth::interaction::Interaction;
use crate::nonsmooth::loads::Reactions;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::status::{Show, Tracked};
use crate::state::sealed::Sealed;

/// Further forces `A`, and `K` interactions with the limits of the description among them
/// ([`Simulation::interactions`](crate::Simulation::interactions)).
pub struct Interacting<S, M, A, const K: usize> {
    forces: A,
    list: [Interaction<S, M>; K],
}

impl<S: Copy, M, A: Clone, const K: usize> Clone for Interacting<S, M, A, K> {
    fn clone(&self) -> Self {
        Self {
            forces: self.forces.clone(),
            list: self.list,
        }
    }
}

/// The interactions.
impl<S: Debug, M, A, const K: usize> Debug for Interacting<S, M, A, K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(&self.list).finish()
    }
}

impl<S: Real, M: Mechanism, A, const K: usize> Interacting<S, M, A, K> {
    pub(crate) fn new(forces: A, list: [Interaction<S, M>; K]) -> Self {
        Self { forces, list }
    }
}

impl<S: Real, M: Mechanism, A: AppliedForces<S, M>, const K: usize> AppliedForces<S, M>
    for Interacting<S, M, A, K>
{
    const PRESENT: bool = A::PRESENT;
    const INTERACTS: bool = K > 0;
    const HEEDS: bool = A::HEEDS;
    const SCALES: bool = A::SCALES;

    type Tracked = [Tracked<S, M>; K];
    type Own = [Tracked<S, M>; K];
    type List = Nothing;
    type With<B: AppliedForces<S, M>> = Interacting<S, M, A::With<B>, K>;

    #[inline(always)]
    fn apply(&self, time: S, state: &M::State<S>, loads: &mut Loads<'_, S, M>) {
        self.forces.apply(time, state, loads);
    }

    fn tracked(&self, parameters: &M::Parameters<S>) -> Self::Tracked {
        renewed(&self.list, parameters, A::HEEDS)
    }

    fn own(&self, parameters: &M::Parameters<S>) -> Self::Own {
        renewed(&self.list, parameters, false)
    }

    fn with<B: AppliedForces<S, M>>(self, forces: B) -> Self::With<B> {
        Interacting {
            forces: self.forces.with(forces),
            list: self.list,
        }
    }

    fn scale(
        &self,
        view: &View<'_, S, M>,
        inputs: &M::Inputs<S>,
        list: &mut [Tracked<S, M>],
    ) -> Result<(), Fault> {
        self.forces.scale(view, inputs, list)
    }
}

/// Forces without the limits of the description
/// ([`Simulation::without_limits`](crate::Simulation::without_limits)).
#[derive(Clone, Copy, Debug)]
pub struct Unlimited<A>(pub(crate) A);

impl<S, M, A, const K: usize> Sealed for Interacting<S, M, A, K> {}
impl<A> Sealed for Unlimited<A> {}
impl<S: Scalar, M: Mechanism, A: AppliedForces<S, M>> Sealed for Heeding<S, M, A> {}

impl<S: Scalar, M: Mechanism, A: AppliedForces<S, M>> AppliedForces<S, M> for Unlimited<A> {
    const PRESENT: bool = A::PRESENT;
    const INTERACTS: bool = A::INTERACTS;
    const HEEDS: bool = false;
    const SCALES: bool = A::SCALES;

    type Tracked = A::Own;
    type Own = A::Own;
    type List = Nothing;
    type With<B: AppliedForces<S, M>> = Unlimited<A::With<B>>;

    #[inline(always)]
    fn apply(&self, time: S, state: &M::State<S>, loads: &mut Loads<'_, S, M>) {
        self.0.apply(time, state, loads);
    }

    fn tracked(&self, parameters: &M::Parameters<S>) -> A::Own
    where
        S: Real,
    {
        self.0.own(parameters)
    }

    fn own(&self, parameters: &M::Parameters<S>) -> A::Own
    where
        S: Real,
    {
        self.0.own(parameters)
    }

    fn with<B: AppliedForces<S, M>>(self, forces: B) -> Self::With<B> {
        Unlimited(self.0.with(forces))
    }

    fn scale(
        &self,
        view: &View<'_, S, M>,
        inputs: &M::Inputs<S>,
        list: &mut [Tracked<S, M>],
    ) -> Result<(), Fault>
    where
        S: Real,
    {
        self.0.scale(view, inputs, list)
    }
}

/// Forces in a run or a stepper under way, with the statuses of all interactions.
pub struct Heeding<S: Scalar, M: Mechanism, A: AppliedForces<S, M>> {
    forces: A,
    list: A::Tracked,
    /// For functions that scale capacities.
    inputs: M::Inputs<S>,
}

impl<S: Scalar, M: Mechanism, A: AppliedForces<S, M> + Clone> Clone for Heeding<S, M, A> {
    fn clone(&self) -> Self {
        Self {
            forces: self.forces.clone(),
            list: self.list.clone(),
            inputs: self.inputs,
        }
    }
}

/// How many interactions there are.
impl<S: Scalar, M: Mechanism, A: AppliedForces<S, M>> Debug for Heeding<S, M, A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Heeding")
            .field("interactions", &A::Tracked::COUNT)
            .finish_non_exhaustive()
    }
}

impl<S: Real, M: Mechanism, A: AppliedForces<S, M>> Heeding<S, M, A> {
    /// At the start, with the limits of the description by these parameters.
    pub(crate) fn new(forces: A, parameters: &M::Parameters<S>) -> Self {
        Self {
            list: forces.tracked(parameters),
            forces,
            inputs: M::inputs_of(parameters),
        }
    }

    /// The forces alone.
    pub(crate) fn into_forces(self) -> A {
        self.forces
    }

    /// All interactions, with their statuses now.
    pub(crate) fn list(&self) -> &A::Tracked {
        &self.list
    }

    /// Adds the efforts of friction that slides, by the capacities of the instant. A factor that is
    /// not acceptable adds none, and is refused where the solution is completed.
    #[inline(never)]
    fn slide_scaled(&self, time: S, state: &M::State<S>, loads: &mut Loads<'_, S, M>) {
        let mut list = self.list.clone();
        if self.scale_now(&loads.view(), list.as_mut()).is_ok() {
            slide(list.as_ref(), time, state, loads);
        }
    }

    /// Completes a solution by the capacities of the instant.
    #[inline(never)]
    fn complete_scaled<F: Formulation<S>, C: Coordinates<M>>(
        &self,
        setting: &Setting<'_, S, M, F, C>,
        complete: Complete<'_, '_, '_, S, M, F, C>,
    ) -> Result<(), Fault> {
        let mut list = self.list.clone();
        setting.here(|scene| {
            let view = View::new(scene.constants, scene.time, scene.bodies);
            self.scale_now(&view, list.as_mut())
        })?;
        list.visit(complete).unwrap_or(Ok(()))
    }
}

/// A solution that interactions complete.
struct Complete<'a, 't, 's, S: Real, M: Mechanism, F: Formulation<S>, C: Coordinates<M>> {
    setting: &'a Setting<'a, S, M, F, C>,
    reactions: Option<Reactions<'a, S, M, F>>,
    solution: &'t mut Solution<S, M, C>,
    show: Option<&'t mut Show<'s, S>>,
}

impl<S, M, F, C> Visit<Tracked<S, M>> for Complete<'_, '_, '_, S, M, F, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    type Output = Result<(), Fault>;

    // One piece of code, apart from what a step without interactions is.
    #[inline(never)]
    fn visit<const K: usize>(self, list: &[Tracked<S, M>; K]) -> Result<(), Fault> {
        let completed = (self.solution, self.show);
        complete(self.setting, self.reactions, list, completed)
    }
}

impl<S: Real, M: Mechanism, A: AppliedForces<S, M>> AppliedForces<S, M> for Heeding<S, M, A> {
    const PRESENT: bool = A::PRESENT || A::Tracked::COUNT > 0;
    const INTERACTS: bool = A::Tracked::COUNT > 0;
    const HEEDS: bool = A::HEEDS;
    const OF_RUN: bool = A::OF_RUN;
    const SCALES: bool = A::SCALES;

    type Tracked = Nothing;
    type Own = Nothing;
    type List = A::Tracked;
    type With<B: AppliedForces<S, M>> = B;

    #[inline(always)]
    fn apply(&self, time: S, state: &M::State<S>, loads: &mut Loads<'_, S, M>) {
        self.forces.apply(time, state, loads);
        if A::Tracked::COUNT > 0 {
            if A::SCALES {
                self.slide_scaled(time, state, loads);
            } else {
                slide(self.list.as_ref(), time, state, loads);
            }
        }
    }

    fn tracked(&self, _parameters: &M::Parameters<S>) -> Nothing {
        Nothing
    }

    fn own(&self, _parameters: &M::Parameters<S>) -> Nothing {
        Nothing
    }

    fn with<B: AppliedForces<S, M>>(self, forces: B) -> B {
        forces
    }

    #[inline(always)]
    fn interactions(&self) -> &[Tracked<S, M>] {
        self.list.as_ref()
    }

    #[inline(always)]
    fn list_mut(&mut self) -> Option<&mut A::Tracked> {
        Some(&mut self.list)
    }

    fn renew(&mut self, parameters: &M::Parameters<S>) {
        let fresh = self.forces.tracked(parameters);
        for (now, fresh) in self.list.as_mut().iter_mut().zip(fresh.as_ref()) {
            now.interaction = fresh.interaction;
        }
    }

    #[inline(always)]
    fn complete<F: Formulation<S>, C: Coordinates<M>>(
        &self,
        setting: &Setting<'_, S, M, F, C>,
        reactions: Option<Reactions<'_, S, M, F>>,
        solution: &mut Solution<S, M, C>,
        show: Option<&mut Show<'_, S>>,
    ) -> Result<(), Fault> {
        let complete = Complete {
            setting,
            reactions,
            solution,
            show,
        };
        if A::SCALES {
            return self.complete_scaled(setting, complete);
        }
        self.list.visit(complete).unwrap_or(Ok(()))
    }

    #[inline(always)]
    fn take_inputs(&mut self, parameters: &M::Parameters<S>) {
        if A::SCALES {
            self.inputs = M::inputs_of(parameters);
        }
    }

    fn scale_now(&self, view: &View<'_, S, M>, list: &mut [Tracked<S, M>]) -> Result<(), Fault> {
        for tracked in list.iter_mut() {
            tracked.status.factor = S::one();
        }
        self.forces.scale(view, &self.inputs, list)
    }
}

/// Adds the efforts of friction that slides.
fn slide<S: Real, M: Mechanism>(
    list: &[Tracked<S, M>],
    time: S,
    state: &M::State<S>,
    loads: &mut Loads<'_, S, M>,
) {
    let view = loads.view();
    let scene = Scene {
        constants: view.constants(),
        time,
        bodies: state,
    };
    for tracked in list {
        if let Some(effort) = tracked.sliding_effort(&scene) {
            let quantity = &tracked.interaction.quantity;
            quantity.add_effort(&scene, effort, loads.forces);
        }
    }
}
