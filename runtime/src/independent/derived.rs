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
    values: &'static [usize],
    places: Places<N>,
    /// How many rates the joints have.
    rates: usize,
}

/// Which columns of a kernel, in their order.
#[derive(Clone, Copy)]
enum By {
    Positions,
    Rates,
    Efforts,
    Values,
    /// The rates that take away what positions do to `Phi'`.
    Following,
    /// Displacements that take away what values do to `Phi`.
    Opening,
    /// Rates that take away what they do to `Phi'`.
    Speeding,
}

impl<M: JointRates, const N: usize, S: Real> Derived<M, N, S> {
    /// The derivatives at a state. `None` where the kernel was not asked for. So it is where
    /// equations that close loops depend on each other, or nearly do: few digits would be left.
    pub(super) fn of(equations: &Equations<M, N, S>, state: &M::JointState<S>) -> Option<Self> {
        let values = M::DERIVED_BY?;
        let rates = M::JointVelocities::<S>::zeros().as_slice().len();
        let rows = M::JOINT_REPORT.closing.len();
        if rates != N + rows {
            return None;
        }
        let derived = Self {
            numbers: M::derivatives(&equations.constants, equations.time, state),
            values,
            places: equations.places,
            rates,
        };
        let columns = if rows > 0 {
            derived.first(By::Speeding) + values.len()
        } else {
            derived.first(By::Following)
        };
        let pivots = derived.numbers.as_slice().iter();
        let mut pivots = pivots.skip(derived.height() * (1 + columns));
        let is_sound = pivots.all(|pivot| pivot.abs().to_f64() > WEAK);
        is_sound.then_some(derived)
    }

    /// The numbers of a column: one for each rate, and for each of the user's own states.
    fn height(&self) -> usize {
        self.rates + M::JOINT_REPORT.states.len()
    }

    /// The first of the columns that are meant.
    fn first(&self, by: By) -> usize {
        let (n, values, states) = (self.rates, self.values.len(), M::JOINT_REPORT.states.len());
        match by {
            By::Positions => 0,
            By::Rates => n,
            By::Efforts => 2 * n + states,
            By::Values => 3 * n + states,
            By::Following => 3 * n + states + values,
            By::Opening => 4 * n + states + values,
            By::Speeding => 4 * n + states + 2 * values,
        }
    }

    /// Whether the kernel has a column along a direction.
    pub(super) fn has(&self, along: Along) -> bool {
        match along {
            Along::Position(_) | Along::Rate(_) => true,
            Along::Value(value) => self.values.contains(&value),
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
        let (positions, rates) = (&mut linear.by_positions, &mut linear.by_rates);
        match following {
            None => {
                self.copy(By::Positions, positions.as_mut_slice());
                self.copy(By::Rates, rates.as_mut_slice());
            }
            Some(partition) => {
                let columns = partition.columns.iter().enumerate();
                for (number, along) in columns {
                    let by_position = self.by_position(partition, along.as_slice());
                    self.put(by_position.as_slice(), number, positions.as_mut_slice());
                    let by_rate = self.sum(By::Rates, along.as_slice());
                    self.put(by_rate.as_slice(), number, rates.as_mut_slice());
                }
            }
        }
        // An effort along a chosen coordinate is one along its own rate.
        self.copy(By::Efforts, linear.by_efforts.as_mut_slice());
        for (number, &value) in values.iter().enumerate() {
            let matrix = linear.by_values.as_mut_slice();
            match value {
                Adjusted::Value(value) => {
                    let mut known = self.values.iter();
                    let Some(known) = known.position(|&known| known == value) else {
                        continue;
                    };
                    match following {
                        None => self.put(self.column(By::Values, known), number, matrix),
                        Some(partition) => {
                            let by_value = self.by_value(partition, known);
                            self.put(by_value.as_slice(), number, matrix);
                        }
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

    /// Accelerations by a chosen coordinate along which all positions go like this.
    fn by_position(&self, partition: &Partition<M, N, S>, along: &[S]) -> M::JointVelocities<S> {
        let none = M::JointVelocities::zeros();
        self.by_displacement(partition, along, none)
    }

    /// Accelerations by a value, at the same chosen coordinates and rates: the others close again
    /// what it opens.
    fn by_value(&self, partition: &Partition<M, N, S>, value: usize) -> M::JointVelocities<S> {
        let mut along = velocities::<M, S>(self.column(By::Opening, value));
        self.without_chosen(partition, &mut along);
        let rates = velocities::<M, S>(self.column(By::Speeding, value));
        let mut by_value = self.by_displacement(partition, along.as_slice(), rates);
        add(
            by_value.as_mut_slice(),
            S::one(),
            self.column(By::Values, value),
        );
        by_value
    }

    /// Accelerations by a displacement, beside which rates change: those that are not chosen follow
    /// it, so that `Phi'` stays.
    fn by_displacement(
        &self,
        partition: &Partition<M, N, S>,
        along: &[S],
        rates: M::JointVelocities<S>,
    ) -> M::JointVelocities<S> {
        let rates = self.following(partition, along, rates);
        let mut changes = self.sum(By::Rates, rates.as_slice());
        let by_positions = self.sum(By::Positions, along);
        add(changes.as_mut_slice(), S::one(), by_positions.as_slice());
        changes
    }

    /// What rates change by with a displacement, beside what they change by themselves: the chosen
    /// ones stay, and the others follow.
    fn following(
        &self,
        partition: &Partition<M, N, S>,
        along: &[S],
        mut rates: M::JointVelocities<S>,
    ) -> M::JointVelocities<S> {
        let following = self.sum(By::Following, along);
        add(rates.as_mut_slice(), S::one(), following.as_slice());
        self.without_chosen(partition, &mut rates);
        rates
    }

    /// What positions and rates of all joints change by along a chosen coordinate or rate.
    pub(super) fn changes(
        &self,
        following: Option<&Partition<M, N, S>>,
        along: Along,
    ) -> [M::JointVelocities<S>; 2] {
        let none = M::JointVelocities::<S>::zeros();
        let column = |number: usize| match following {
            Some(partition) => partition.columns.get(number).copied().unwrap_or(none),
            None => {
                let mut unit = none;
                let place = self.places.get(number).copied();
                let number = place.and_then(|place| unit.as_mut_slice().get_mut(place));
                if let Some(number) = number {
                    *number = S::one();
                }
                unit
            }
        };
        match (along, following) {
            (Along::Position(number), None) => [column(number), none],
            (Along::Position(number), Some(partition)) => {
                let column = column(number);
                [column, self.following(partition, column.as_slice(), none)]
            }
            (Along::Rate(number), _) => [none, column(number)],
            (Along::Value(_), _) => [none, none],
        }
    }

    /// Takes away the motion that has the chosen ones of these rates.
    fn without_chosen(&self, partition: &Partition<M, N, S>, rates: &mut M::JointVelocities<S>) {
        let chosen = self.places.take(rates.as_slice());
        for (column, rate) in partition.columns.iter().zip(chosen) {
            add(rates.as_mut_slice(), -rate, column.as_slice());
        }
    }

    /// What a column has for the rates.
    fn column(&self, by: By, number: usize) -> &[S] {
        let first = self.height() * (1 + self.first(by) + number);
        let numbers = self.numbers.as_slice();
        numbers.get(first..first + self.rates).unwrap_or(&[])
    }

    /// The sum of columns, each times a number.
    fn sum(&self, by: By, factors: &[S]) -> M::JointVelocities<S> {
        let mut sum = M::JointVelocities::<S>::zeros();
        for (place, &factor) in factors.iter().enumerate() {
            if factor != S::zero() {
                add(sum.as_mut_slice(), factor, self.column(by, place));
            }
        }
        sum
    }

    /// Copies the columns of the chosen coordinates.
    fn copy(&self, by: By, matrix: &mut [S]) {
        if self.places.are_all && self.height() == N {
            let block = self.numbers.as_slice().get(N * (1 + self.first(by))..);
            let entries = matrix.iter_mut().zip(block.unwrap_or(&[]));
            entries.for_each(|(entry, &slope)| *entry = slope);
            return;
        }
        for (number, &place) in self.places.iter().enumerate() {
            self.put(self.column(by, place), number, matrix);
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

/// These numbers as rates.
fn velocities<M: JointRates, S: Scalar>(numbers: &[S]) -> M::JointVelocities<S> {
    let mut velocities = M::JointVelocities::<S>::zeros();
    let places = velocities.as_mut_slice().iter_mut().zip(numbers);
    places.for_each(|(place, &number)| *place = number);
    velocities
}

/// Adds a number times others.
fn add<S: Scalar>(sum: &mut [S], factor: S, more: &[S]) {
    let places = sum.iter_mut().zip(more);
    places.for_each(|(place, &more)| *place = more.fused(factor, *place));
}
