//! Accelerations with their derivatives by the kernel that `kernels = [derivatives]` asks for.

use super::Equations;
use super::directions::Along;
use super::elimination::at;
use super::linearised::Linearised;
use super::partition::Partition;
use super::places::Places;
use super::varied::Adjusted;
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::joint_rates::JointRates;
use crate::state::vector::Array;

/// A pivot that is less than this part of what it would be without its loop loses too many digits:
/// derivatives have its square.
const WEAK: f64 = 1e-3;

/// What the kernel gives at a state.
pub(super) struct Derived<M: JointRates, const N: usize, S: Scalar> {
    numbers: M::Derivatives<S>,
    inputs: &'static [usize],
    places: Places<N>,
    /// How many rates the joints have.
    rates: usize,
}

/// Where the columns by rates, by efforts and by inputs begin, in numbers of rates; those by
/// positions come first. Behind them all are those that take away what positions do to `Phi'`.
const BY_RATES: usize = 1;
const BY_EFFORTS: usize = 2;
const BY_INPUTS: usize = 3;

impl<M: JointRates, const N: usize, S: Real> Derived<M, N, S> {
    /// The derivatives at a state. `None` where the kernel was not asked for. So it is where
    /// equations that close loops depend on each other, or nearly do: few digits would be left.
    pub(super) fn of(equations: &Equations<M, N, S>, state: &M::JointState<S>) -> Option<Self> {
        let inputs = M::DERIVED_BY?;
        let rates = M::JointVelocities::<S>::zeros().as_slice().len();
        let rows = M::JOINT_REPORT.closing.len();
        if rates != N + rows {
            return None;
        }
        let derived = Self {
            numbers: M::derivatives(&equations.constants, equations.time, state),
            inputs,
            places: equations.places,
            rates,
        };
        let columns = BY_INPUTS * rates + inputs.len() + if rows > 0 { rates } else { 0 };
        let pivots = derived.numbers.as_slice().iter();
        let mut pivots = pivots.skip(rates * (1 + columns));
        let is_sound = pivots.all(|pivot| pivot.abs().to_f64() > WEAK);
        is_sound.then_some(derived)
    }

    /// Whether the kernel has a column along a direction.
    pub(super) fn has(&self, along: Along) -> bool {
        match along {
            Along::Position(_) | Along::Rate(_) => true,
            Along::Value(value) => self.inputs.contains(&value),
        }
    }

    /// Writes accelerations by all that the kernel has; with how the others follow where loops
    /// close.
    pub(super) fn write<const K: usize, const P: usize>(
        &self,
        values: &[Adjusted; K],
        following: Option<&Partition<M, N, S>>,
        linear: &mut Linearised<N, K, P, S>,
    ) {
        let n = self.rates;
        let (positions, rates) = (&mut linear.by_positions, &mut linear.by_rates);
        match following {
            None => {
                self.copy(0, positions.as_mut_slice());
                self.copy(BY_RATES * n, rates.as_mut_slice());
            }
            Some(partition) => {
                let columns = partition.columns.iter().enumerate();
                for (number, along) in columns {
                    let by_position = self.by_position(partition, along.as_slice());
                    self.put(by_position.as_slice(), number, positions.as_mut_slice());
                    let by_rate = self.sum(BY_RATES * n, along.as_slice());
                    self.put(by_rate.as_slice(), number, rates.as_mut_slice());
                }
            }
        }
        // An effort along a chosen coordinate is one along its own rate.
        self.copy(BY_EFFORTS * n, linear.by_efforts.as_mut_slice());
        for (number, &value) in values.iter().enumerate() {
            let matrix = linear.by_values.as_mut_slice();
            match value {
                Adjusted::Value(value) => {
                    if let Some(input) = self.inputs.iter().position(|&input| input == value) {
                        self.put(self.column(BY_INPUTS * n + input), number, matrix);
                    }
                }
                Adjusted::Rate(rate) => {
                    let by_rate = linear.by_rates.as_slice().iter().skip(N * rate).take(N);
                    let entries = matrix.iter_mut().skip(N * number);
                    entries
                        .zip(by_rate)
                        .for_each(|(entry, &slope)| *entry = slope);
                }
            }
        }
    }

    /// Accelerations by a chosen coordinate along which all positions go like this: rates that are
    /// not chosen go with them, so that `Phi'` stays.
    fn by_position(&self, partition: &Partition<M, N, S>, along: &[S]) -> M::JointVelocities<S> {
        let n = self.rates;
        let mut rates = self.sum(BY_INPUTS * n + self.inputs.len(), along);
        let chosen = self.places.take(rates.as_slice());
        for (column, rate) in partition.columns.iter().zip(chosen) {
            add(rates.as_mut_slice(), -rate, column.as_slice());
        }
        let mut by_position = self.sum(BY_RATES * n, rates.as_slice());
        add(
            by_position.as_mut_slice(),
            S::one(),
            self.sum(0, along).as_slice(),
        );
        by_position
    }

    /// A column of accelerations.
    fn column(&self, column: usize) -> &[S] {
        let first = self.rates * (1 + column);
        let numbers = self.numbers.as_slice();
        numbers.get(first..first + self.rates).unwrap_or(&[])
    }

    /// The sum of the columns from one on, each times a number.
    fn sum(&self, first: usize, factors: &[S]) -> M::JointVelocities<S> {
        let mut sum = M::JointVelocities::<S>::zeros();
        for (place, &factor) in factors.iter().enumerate() {
            if factor != S::zero() {
                add(sum.as_mut_slice(), factor, self.column(first + place));
            }
        }
        sum
    }

    /// Copies the columns of the chosen coordinates, from one on.
    fn copy(&self, first: usize, matrix: &mut [S]) {
        if self.places.are_all {
            let block = self
                .numbers
                .as_slice()
                .get(N * (1 + first)..)
                .unwrap_or(&[]);
            let entries = matrix.iter_mut().zip(block);
            entries.for_each(|(entry, &slope)| *entry = slope);
            return;
        }
        for (number, &place) in self.places.iter().enumerate() {
            self.put(self.column(first + place), number, matrix);
        }
    }

    /// Writes what a column has for the chosen coordinates as the column of a matrix.
    fn put(&self, column: &[S], number: usize, matrix: &mut [S]) {
        if let Some(entries) = matrix.get_mut(N * number..N * (number + 1)) {
            for (entry, &place) in entries.iter_mut().zip(self.places.iter()) {
                *entry = at(column, place);
            }
        }
    }
}

/// Adds a number times others.
fn add<S: Scalar>(sum: &mut [S], factor: S, more: &[S]) {
    let places = sum.iter_mut().zip(more);
    places.for_each(|(place, &more)| *place = more.fused(factor, *place));
}
