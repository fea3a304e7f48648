//! States on the switch of a law, where sides differ: what has no derivative, and what sticks.
//!
//! A kernel reads the side of a law off its expression, and its derivative is that of this side: so
//! off the switch nothing is to be done. On it, as near as the numbers of a state tell, both sides
//! are compared. They may be one, as those of a friction of zero and of the drag `abs(v) * v`.

use core::array::from_fn;

use nalgebra::SMatrix;

use super::IndependentCoordinates;
use super::directions::Along;
use super::elimination::at;
use super::varied::Adjusted;
use crate::error::{AnalysisFault, Fault};
use crate::forward::{Lifted, lifted};
use crate::math::scalar::Real;
use crate::mechanism::joint_rates::{HasInverse, HasMassMatrix};
use crate::mechanism::orientations::with_unit_orientations;
use crate::mechanism::switch::Switch;
use crate::state::vector::Array as _;

/// What round-off makes of the efforts of one law, in units of it.
const ROUND_OFF: f64 = 1e3;

impl<M, const N: usize, S> IndependentCoordinates<M, N, S>
where
    M: HasInverse + HasMassMatrix,
    S: Real,
{
    /// Refuses a state on a switch where efforts jump: it is one of a range of equilibria, if any.
    pub(super) fn off_jumps(&self, state: &M::JointState<S>) -> Result<(), Fault> {
        self.off_switches_where(state, |one, other| one.jumps(other, state))
    }

    /// Refuses a state on a switch where efforts jump or bend, as they change with these values
    /// too.
    pub(super) fn off_bends<const K: usize>(
        &self,
        state: &M::JointState<S>,
        values: &[Adjusted; K],
    ) -> Result<(), Fault> {
        self.off_switches_where(state, |one, other| {
            if one.jumps(other, state)? {
                return Ok(true);
            }
            let [a, b] = [
                one.efforts_by(state, values)?,
                other.efforts_by(state, values)?,
            ];
            let of_values = differ(a.by_values.as_slice(), b.by_values.as_slice());
            Ok(of_values
                || differ(a.by_positions.as_slice(), b.by_positions.as_slice())
                || differ(a.by_rates.as_slice(), b.by_rates.as_slice()))
        })
    }

    /// Whether efforts differ by more than what the state may be off by makes of them.
    fn jumps(&self, other: &Self, state: &M::JointState<S>) -> Result<bool, Fault> {
        let [a, b] = [self.bias(state)?, other.bias(state)?];
        let [one, two] = [self.efforts_by(state, &[])?, other.efforts_by(state, &[])?];
        let (scales, rates) = (self.scales(), self.rates(state));
        let round_off = S::constant(ROUND_OFF) * S::EPSILON * largest(a.as_slice(), b.as_slice());
        let is_beyond = |row: usize| {
            let columns = 0..N;
            let change = columns.fold(S::zero(), |sum, column| {
                let by = |k: &SMatrix<S, N, N>, l: &SMatrix<S, N, N>| {
                    Real::max(k[(row, column)].abs(), l[(row, column)].abs())
                };
                let moved = by(&one.by_positions, &two.by_positions) * scales[column];
                let turned = by(&one.by_rates, &two.by_rates) * rates[column].abs();
                sum + moved + turned
            });
            (a[row] - b[row]).abs() > change * off::<S>() + round_off
        };
        Ok((0..N).any(is_beyond))
    }

    /// Refuses a state on a switch whose sides differ, each beside either side of the others.
    fn off_switches_where(
        &self,
        state: &M::JointState<S>,
        differ: impl Fn(&Self, &Self) -> Result<bool, Fault>,
    ) -> Result<(), Fault> {
        if N == 0 || M::SWITCHES.iter().all(|switch| switch.is_of_time) {
            return Ok(());
        }
        let [readings, margins] = self.readings(state)?;
        let reading = |switch: &Switch| at(readings.as_slice(), switch.place);
        let is_near = |switch: &&Switch| {
            let margin = at(margins.as_slice(), switch.place);
            // NaN is near nothing, and the law will say so.
            !switch.is_of_time && reading(switch).abs() <= margin
        };
        for side in [S::one(), -S::one()] {
            let mut all = *self;
            for switch in M::SWITCHES.iter().filter(is_near) {
                all.hold(switch, side);
            }
            for switch in M::SWITCHES.iter().filter(is_near) {
                let mut other = all;
                other.hold(switch, -side);
                if differ(&all, &other)? {
                    return Err(Fault::Analysis(AnalysisFault::OnSwitch {
                        law: switch.law,
                        expression: switch.expression,
                    }));
                }
            }
        }
        Ok(())
    }

    /// Holds a law on a side of its switch.
    fn hold(&mut self, switch: &Switch, side: S) {
        if let Some(held) = self.parameters.as_mut_slice().get_mut(switch.place) {
            *held = side;
        }
        M::take_inputs(&self.parameters, &mut self.constants);
        M::take_joint_inputs(&self.parameters, &mut self.equations.constants);
    }

    /// The expressions whose signs decide, and what a state may be off by in them: as much as an
    /// equilibrium is.
    fn readings(&self, state: &M::JointState<S>) -> Result<[M::Parameters<S>; 2], Fault> {
        let scales = self.scales();
        let rates = self.rates(state);
        let positions = (0..N).map(|number| (Along::Position(number), at(&scales, number)));
        let moving = (0..N).map(|number| (Along::Rate(number), at(rates.as_slice(), number)));
        let mut directions = positions.chain(moving);
        let partition = self.equations.partition(state)?;
        let constants: M::Constants<Lifted<S>> = lifted(&self.constants);
        let off = off::<S>();
        let [mut readings, mut margins] = [M::Parameters::<S>::zeros(); 2];
        loop {
            let along: [_; 4] = from_fn(|_| directions.next());
            if along.iter().all(Option::is_none) {
                return Ok([readings, margins]);
            }
            let ways = along.map(|along| along.map(|(way, _)| way));
            let there = self.state_along(state, &partition, &ways)?;
            let bodies = self.bodies_along(state, &there);
            let bodies = with_unit_orientations::<Lifted<S>, M>(&bodies);
            let mut found = M::Parameters::<Lifted<S>>::zeros();
            M::switches_into(&constants, there.equations.time, &bodies, &mut found);
            let places = readings.as_mut_slice().iter_mut();
            let places = places.zip(margins.as_mut_slice());
            for ((reading, margin), found) in places.zip(found.as_slice()) {
                *reading = found.value();
                for (slope, along) in found.derivatives().into_iter().zip(along) {
                    let size = along.map_or(S::zero(), |(_, size)| size);
                    *margin = (slope * size * off).abs() + *margin;
                }
            }
        }
    }
}

/// What an equilibrium is off by: in radians, lengths of the mechanism and parts of its rates.
fn off<S: Real>() -> S {
    S::EPSILON.powf(0.75)
}

/// Whether numbers differ by more than round-off of the largest.
fn differ<S: Real>(a: &[S], b: &[S]) -> bool {
    let noise = S::constant(ROUND_OFF) * S::EPSILON * largest(a, b);
    a.iter().zip(b).any(|(&a, &b)| (a - b).abs() > noise)
}

fn largest<S: Real>(a: &[S], b: &[S]) -> S {
    let sizes = a.iter().chain(b).map(|number| number.abs());
    sizes.fold(S::zero(), Real::max)
}
