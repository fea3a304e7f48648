//! The way back: what the cost from a step on changes by with the state there.

use core::cell::OnceCell;
use core::mem::swap;
use std::vec::Vec;

use super::instant::{Instant, Lazy};
use super::slopes::Slopes;
use super::transposed::Transposed;
use super::{Adjoint, ByJoints, Gradient, LANES, Steps, are_inputs, by_joints};
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::forward::{Forward, Lifted, lifted};
use crate::independent::{Along, IndependentCoordinates, Whole};
use crate::integrate::{FixedStep, OneStep};
use crate::math::scalar::Real;
use crate::mechanism::handle::ValueHandle;
use crate::mechanism::joint_rates::JointRates;
use crate::sensitivity::Differentiable;
use crate::state::vector::Array as _;

/// What a direction belongs to, beside the state.
#[derive(Clone, Copy)]
enum Column {
    Control(usize),
    Value(usize),
    State(Whole),
}

/// Directions that are taken at once.
struct Chunk {
    directions: [Option<Whole>; LANES],
    /// What each belongs to.
    columns: Vec<Column>,
    is_of_state: bool,
}

/// How a step is gone through.
enum Road<M, F, S>
where
    M: JointRates,
    S: Real,
    F: Differentiable<S, LANES, Carrying: Formulation<Lifted<S>>>,
{
    ByKernel(Transposed<M, S>),
    ByNumbers(Steps<Lifted<S>, M, F::Carrying>),
}

/// The way back.
pub(super) struct Backwards<'a, M, F, K, const N: usize, const U: usize, const P: usize, S>
where
    M: JointRates,
    S: Real,
    F: Differentiable<S, LANES, Carrying: Formulation<Lifted<S>>>,
{
    adjoint: &'a Adjoint<'a, ByJoints<M, F, S>, K, N>,
    held: [ValueHandle<M>; U],
    values: [ValueHandle<M>; P],
    /// Of a step, and of the end.
    chunks: [Vec<Chunk>; 2],
    /// With the controls and the time of a step.
    space: IndependentCoordinates<M, N, S>,
    road: Road<M, F, S>,
    cost: S,
    by_values: [S; P],
    /// By the state at the instant behind, and by the one at hand.
    after: Slopes<M, S>,
    here: Slopes<M, S>,
}

impl<'a, M, F, K, const N: usize, const U: usize, const P: usize, S>
    Backwards<'a, M, F, K, N, U, P, S>
where
    M: JointRates,
    S: Real,
    F: Formulation<S> + Differentiable<S, LANES, Carrying: Formulation<Lifted<S>>>,
    K: Copy + OneStep<S, Steps<S, M, F>> + OneStep<Lifted<S>, Steps<Lifted<S>, M, F::Carrying>>,
    FixedStep<S, K>: Differentiable<S, LANES>,
{
    pub(super) fn new(
        adjoint: &'a Adjoint<'a, ByJoints<M, F, S>, K, N>,
        held: [ValueHandle<M>; U],
        values: [ValueHandle<M>; P],
        transposed: Option<Transposed<M, S>>,
    ) -> Result<Self, Fault> {
        let space = *adjoint.space;
        Ok(Self {
            road: match transposed {
                Some(transposed) => Road::ByKernel(transposed),
                None => {
                    let carrying = adjoint.formulation.carrying();
                    Road::ByNumbers(by_joints(lifted(&space.parameters), carrying)?)
                }
            },
            chunks: [false, true].map(|is_end| chunks::<M>(&held, &values, is_end)),
            adjoint,
            held,
            values,
            space,
            cost: S::zero(),
            by_values: [S::zero(); P],
            after: Slopes::zeros(),
            here: Slopes::zeros(),
        })
    }

    /// All of it, by the coordinates that are chosen at the start: the others follow, and what a
    /// value changes there counts.
    pub(super) fn found(
        mut self,
        by_controls: Vec<[S; U]>,
        states: Vec<M::JointState<S>>,
    ) -> Result<Gradient<M::JointState<S>, N, U, P, S>, Fault> {
        let (mut by_positions, mut by_rates) = ([S::zero(); N], [S::zero(); N]);
        if let Some(start) = states.first() {
            let mut space = *self.adjoint.space;
            space.set_time(self.adjoint.time(0));
            let values = self.values.iter().map(|value| Along::Value(value.index()));
            let chosen = (0..N).map(Along::Position).chain((0..N).map(Along::Rate));
            let all: Vec<Along> = values.chain(chosen).collect();
            let state = by_positions.iter_mut().chain(&mut by_rates);
            let mut places = self.by_values.iter_mut().chain(state);
            for columns in all.chunks(LANES) {
                let mut directions = [None; LANES];
                for (direction, &column) in directions.iter_mut().zip(columns) {
                    *direction = Some(column);
                }
                let there = space.standing_state(start, &directions)?;
                let slopes = self.after.along(&there.state);
                // Slopes first: where they end, no place is passed.
                for (slope, place) in slopes.into_iter().take(columns.len()).zip(&mut places) {
                    *place = *place + slope;
                }
            }
        }
        Ok(Gradient {
            cost: self.cost,
            by_controls,
            by_positions: by_positions.into(),
            by_rates: by_rates.into(),
            by_values: self.by_values,
            states,
        })
    }

    /// Goes back before a step to the next state, or to the end of all; the derivatives by its
    /// controls.
    pub(super) fn before(
        &mut self,
        number: usize,
        (state, next): (&M::JointState<S>, Option<&M::JointState<S>>),
        controls: Option<&[S; U]>,
        cost: &impl Fn(&Instant<'_, M, U, S>) -> Lifted<S>,
    ) -> Result<[S; U], Fault> {
        let Self { space, held, .. } = self;
        space.set_time(self.adjoint.time(number));
        if let Some(controls) = controls {
            space.set_values(held, controls)?;
        }
        self.here.clear();
        let mut by_controls = [S::zero(); U];
        let is_end = controls.is_none();
        let is_stepped = !is_end && matches!(self.road, Road::ByNumbers(_));
        let inputs_alone = are_inputs::<M>(held) && are_inputs::<M>(&self.values);
        let (mut is_first, mut was_read) = (true, true);
        let positions = OnceCell::new();
        for chunk in &self.chunks[usize::from(is_end)] {
            // A cost that reads nothing of the state does not change with it.
            let is_read = is_first || was_read || !chunk.is_of_state;
            if !is_read && !is_stepped {
                break;
            }
            let here = Lazy::new(space, (state, &positions), &chunk.directions);
            let mut slopes = [S::zero(); LANES];
            if is_read {
                let now = here.cost((number, is_end), held, cost)?;
                slopes = now.derivatives();
                if is_first {
                    self.cost = self.cost + now.value();
                }
                (is_first, was_read) = (false, here.was_read());
            }
            if is_stepped {
                let way = (self.adjoint, inputs_alone);
                self.road
                    .through_numbers(way, &here, &self.after, &mut slopes)?;
            }
            for (&column, slope) in chunk.columns.iter().zip(slopes) {
                let place = match column {
                    Column::Control(control) => by_controls.get_mut(control),
                    Column::Value(value) => self.by_values.get_mut(value),
                    Column::State(Whole::Position(place)) => {
                        self.here.positions.as_mut_slice().get_mut(place)
                    }
                    Column::State(Whole::Rate(place)) => {
                        self.here.rates.as_mut_slice().get_mut(place)
                    }
                    Column::State(Whole::Own(own)) => self.here.own.get_mut(own),
                    Column::State(Whole::Value(_)) => None,
                };
                if let Some(place) = place {
                    *place = *place + slope;
                }
            }
        }
        if let Some(next) = next {
            self.through_kernel(number, next, &mut by_controls);
        }
        swap(&mut self.after, &mut self.here);
        Ok(by_controls)
    }

    /// Adds what a step does, all of it by the kernel.
    fn through_kernel(&mut self, number: usize, next: &M::JointState<S>, by_controls: &mut [S; U]) {
        let Road::ByKernel(transposed) = &mut self.road else {
            return;
        };
        let constants = self.space.joint_constants();
        let after = (&self.after, next);
        let inputs = transposed.before::<F::Terms>(number, constants, after, &mut self.here);
        let of_values = self.by_values.iter_mut().zip(&self.values);
        for (place, &input) in by_controls.iter_mut().zip(&self.held).chain(of_values) {
            *place = *place + inputs.by(input);
        }
    }
}

impl<M, F, S> Road<M, F, S>
where
    M: JointRates,
    S: Real,
    F: Formulation<S> + Differentiable<S, LANES, Carrying: Formulation<Lifted<S>>>,
{
    /// Adds what a step does along some directions, by numbers that carry derivatives.
    fn through_numbers<K, const N: usize>(
        &mut self,
        (adjoint, inputs_alone): (&Adjoint<'_, ByJoints<M, F, S>, K, N>, bool),
        here: &Lazy<'_, M, N, S>,
        after: &Slopes<M, S>,
        slopes: &mut [S; LANES],
    ) -> Result<(), Fault>
    where
        K: Copy + OneStep<Lifted<S>, Steps<Lifted<S>, M, F::Carrying>>,
    {
        let Self::ByNumbers(dynamics) = self else {
            return Ok(());
        };
        let (there, space) = (here.there(), here.space());
        if inputs_alone {
            dynamics.set_inputs(&M::inputs_of(&there.parameters))?;
        } else {
            *dynamics = by_joints(there.parameters, adjoint.formulation.carrying())?;
        }
        let mut next = there.state;
        let FixedStep { step, scheme } = adjoint.integrator;
        let time = Forward::fixed(space.time());
        scheme.step(dynamics, time, &mut next, Forward::fixed(step))?;
        for (slope, by) in slopes.iter_mut().zip(after.along(&next)) {
            *slope = *slope + by;
        }
        Ok(())
    }
}

/// All directions: controls, unless it is the end, values, and the state. There is a chunk where
/// there are none.
fn chunks<M: JointRates>(
    held: &[ValueHandle<M>],
    values: &[ValueHandle<M>],
    is_end: bool,
) -> Vec<Chunk> {
    let rates = M::JointVelocities::<f64>::zeros().as_slice().len();
    let held = if is_end { &[] } else { held };
    let held = held
        .iter()
        .enumerate()
        .map(|(column, value)| (Column::Control(column), Whole::Value(value.index())));
    let values = values
        .iter()
        .enumerate()
        .map(|(column, value)| (Column::Value(column), Whole::Value(value.index())));
    let state = (0..rates).map(Whole::Position);
    let state = state.chain((0..rates).map(Whole::Rate));
    let state = state.chain((0..M::JOINT_REPORT.states.len()).map(Whole::Own));
    let state = state.map(|along| (Column::State(along), along));
    let columns: Vec<(Column, Whole)> = held.chain(values).chain(state).collect();
    let chunks = (0..columns.len().max(1)).step_by(LANES).map(|first| {
        let of_chunk = columns.iter().skip(first).take(LANES);
        let mut directions = [None; LANES];
        for (direction, &(_, along)) in directions.iter_mut().zip(of_chunk.clone()) {
            *direction = Some(along);
        }
        let columns: Vec<Column> = of_chunk.map(|&(column, _)| column).collect();
        Chunk {
            directions,
            is_of_state: columns
                .iter()
                .all(|column| matches!(column, Column::State(_))),
            columns,
        }
    });
    chunks.collect()
}
