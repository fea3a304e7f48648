//! The way back: what the cost from a step on changes by with the state there.

use core::cell::OnceCell;
use std::vec::Vec;

use super::instant::{Instant, Lazy};
use super::transposed::Transposed;
use super::{Adjoint, ByJoints, Gradient, LANES, Steps, are_inputs, by_joints};
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::forward::{Forward, Lifted, lifted};
use crate::independent::{Along, IndependentCoordinates};
use crate::integrate::{FixedStep, OneStep};
use crate::math::scalar::Real;
use crate::mechanism::handle::ValueHandle;
use crate::mechanism::joint_rates::JointRates;
use crate::sensitivity::Differentiable;

/// What a direction belongs to.
#[derive(Clone, Copy)]
enum Part {
    Control,
    Value,
    Position,
    Rate,
}

impl Part {
    const fn is_of_state(self) -> bool {
        matches!(self, Self::Position | Self::Rate)
    }
}

/// Directions that are taken at once.
struct Chunk {
    directions: [Option<Along>; LANES],
    /// What each belongs to, and its number there.
    parts: Vec<(Part, usize)>,
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
    sums: Sums<N, U, P, S>,
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
            chunks: [false, true].map(|is_end| chunks::<M, N>(&held, &values, is_end)),
            adjoint,
            held,
            values,
            space,
            sums: Sums {
                cost: S::zero(),
                by_positions: [S::zero(); N],
                by_rates: [S::zero(); N],
                by_controls: [S::zero(); U],
                by_values: [S::zero(); P],
            },
        })
    }

    pub(super) fn found(
        self,
        by_controls: Vec<[S; U]>,
        states: Vec<M::JointState<S>>,
    ) -> Gradient<M::JointState<S>, N, U, P, S> {
        Gradient {
            cost: self.sums.cost,
            by_controls,
            by_positions: self.sums.by_positions.into(),
            by_rates: self.sums.by_rates.into(),
            by_values: self.sums.by_values,
            states,
        }
    }

    /// Goes back before a step, or to the end of all; the derivatives by its controls.
    pub(super) fn before(
        &mut self,
        number: usize,
        state: &M::JointState<S>,
        controls: Option<&[S; U]>,
        cost: &impl Fn(&Instant<'_, M, U, S>) -> Lifted<S>,
    ) -> Result<[S; U], Fault> {
        let Self { space, held, .. } = self;
        space.set_time(self.adjoint.time(number));
        if let Some(controls) = controls {
            space.set_values(held, controls)?;
        }
        let mut sums = Sums {
            by_controls: [S::zero(); U],
            by_positions: [S::zero(); N],
            by_rates: [S::zero(); N],
            ..self.sums
        };
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
                    sums.cost = sums.cost + now.value();
                }
                (is_first, was_read) = (false, here.was_read());
            }
            if is_stepped {
                let after = (&self.sums.by_positions, &self.sums.by_rates);
                self.road.through_numbers(
                    (self.adjoint, inputs_alone),
                    &here,
                    after,
                    &mut slopes,
                )?;
            }
            for (&(part, column), slope) in chunk.parts.iter().zip(slopes) {
                sums.add(part, column, slope);
            }
        }
        if !is_end {
            self.through_kernel(number, &mut sums);
        }
        self.sums = sums;
        Ok(sums.by_controls)
    }

    /// Adds what a step does, all of it by the kernel.
    fn through_kernel(&mut self, number: usize, sums: &mut Sums<N, U, P, S>) {
        let Road::ByKernel(transposed) = &mut self.road else {
            return;
        };
        let space = &self.space;
        let after = [self.sums.by_positions, self.sums.by_rates].map(|by| space.placed(&by));
        let before = transposed.before(number, space.joint_constants(), after);
        let [by_positions, by_rates] = before.state.map(|by| space.chosen_of(&by));
        for (column, slope) in by_positions.into_iter().enumerate() {
            sums.add(Part::Position, column, slope);
        }
        for (column, slope) in by_rates.into_iter().enumerate() {
            sums.add(Part::Rate, column, slope);
        }
        for (column, &input) in self.held.iter().enumerate() {
            sums.add(Part::Control, column, before.by(input));
        }
        for (column, &input) in self.values.iter().enumerate() {
            sums.add(Part::Value, column, before.by(input));
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
        (by_positions, by_rates): (&[S; N], &[S; N]),
        slopes: &mut [S; LANES],
    ) -> Result<(), Fault>
    where
        K: Copy + OneStep<Lifted<S>, Steps<Lifted<S>, M, F::Carrying>>,
    {
        let Self::ByNumbers(dynamics) = self else {
            return Ok(());
        };
        let (there, space) = (here.there()?, here.space());
        if inputs_alone {
            dynamics.set_inputs(&M::inputs_of(&there.parameters))?;
        } else {
            *dynamics = by_joints(there.parameters, adjoint.formulation.carrying())?;
        }
        let mut next = there.state;
        let FixedStep { step, scheme } = adjoint.integrator;
        let time = Forward::fixed(space.time());
        scheme.step(dynamics, time, &mut next, Forward::fixed(step))?;
        let positions = space.positions_of(&next)?;
        let rates = space.rates_of(&next);
        let of_rates = rates.iter().zip(by_rates);
        for (number, &adjoint) in positions.iter().zip(by_positions).chain(of_rates) {
            for (slope, by) in slopes.iter_mut().zip(number.derivatives()) {
                *slope = adjoint.fused(by, *slope);
            }
        }
        Ok(())
    }
}

/// What the cost from a step on is, and changes by.
#[derive(Clone, Copy)]
struct Sums<const N: usize, const U: usize, const P: usize, S> {
    cost: S,
    by_positions: [S; N],
    by_rates: [S; N],
    by_controls: [S; U],
    by_values: [S; P],
}

impl<const N: usize, const U: usize, const P: usize, S: Real> Sums<N, U, P, S> {
    fn add(&mut self, part: Part, column: usize, slope: S) {
        let place = match part {
            Part::Control => self.by_controls.get_mut(column),
            Part::Value => self.by_values.get_mut(column),
            Part::Position => self.by_positions.get_mut(column),
            Part::Rate => self.by_rates.get_mut(column),
        };
        if let Some(place) = place {
            *place = *place + slope;
        }
    }
}

/// All directions: controls, unless it is the end, values, and the state. There is a chunk where
/// there are none.
fn chunks<M, const N: usize>(
    held: &[ValueHandle<M>],
    values: &[ValueHandle<M>],
    is_end: bool,
) -> Vec<Chunk> {
    let of = |part: Part, values: &[ValueHandle<M>]| -> Vec<_> {
        let values = values.iter().enumerate();
        let columns = values.map(|(column, value)| (part, column, Along::Value(value.index())));
        columns.collect()
    };
    let mut columns = of(Part::Control, if is_end { &[] } else { held });
    columns.extend(of(Part::Value, values));
    columns.extend((0..N).map(|column| (Part::Position, column, Along::Position(column))));
    columns.extend((0..N).map(|column| (Part::Rate, column, Along::Rate(column))));
    let chunks = (0..columns.len().max(1)).step_by(LANES).map(|first| {
        let columns = columns.iter().skip(first).take(LANES);
        let parts: Vec<_> = columns
            .clone()
            .map(|&(part, column, _)| (part, column))
            .collect();
        let mut directions = [None; LANES];
        for (direction, &(.., along)) in directions.iter_mut().zip(columns) {
            *direction = Some(along);
        }
        Chunk {
            directions,
            is_of_state: parts.iter().all(|(part, _)| part.is_of_state()),
            parts,
        }
    });
    chunks.collect()
}
