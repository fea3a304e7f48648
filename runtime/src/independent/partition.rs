//! The rates of all joints by the chosen ones.

use super::Equations;
use super::elimination::{Elimination, Pivot, at, set};
use crate::error::{AnalysisFault, Fault};
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::joint_kernels::{Freedom, JointCoordinates};
use crate::mechanism::joint_rates::JointRates;
use crate::state::vector::{Array, MovingState as _};

/// `w = B z + d` and `w' = B z' + b`.
pub(super) struct Partition<M: JointRates, const N: usize, S: Scalar> {
    /// `B`, column by column.
    pub(super) columns: [M::JointVelocities<S>; N],
    /// `b`: the accelerations without those that are chosen.
    pub(super) bias: M::JointVelocities<S>,
    /// `d`: the rates without those that are chosen, where drivers move.
    pub(super) drift: M::JointVelocities<S>,
    /// The motion without the chosen one that takes `Phi` to zero.
    pub(super) closing: M::JointVelocities<S>,
    pub(super) standing: Standing,
}

/// How well a state stands on the equations that close loops.
#[derive(Clone, Copy)]
pub(super) struct Standing {
    /// The least pivot; `None` in a tree.
    pub(super) weakest: Option<Pivot>,
    /// The largest `Phi` over the size of its row, and the row.
    pub(super) open: (f64, usize),
    /// The same of `Phi'`.
    pub(super) opening: (f64, usize),
}

impl Standing {
    const TREE: Self = Self {
        weakest: None,
        open: (0.0, 0),
        opening: (0.0, 0),
    };
}

/// `D` of the joints, `gamma`, `Phi'` and `Phi`.
type ClosingRows<M, S> = (
    <M as JointRates>::ClosingJacobian<S>,
    [<M as JointCoordinates>::ClosingMultipliers<S>; 3],
);

impl<M: JointRates, const N: usize, S: Real> Equations<M, N, S> {
    /// What a rate compares by with others: one, or a length of the mechanism.
    pub(super) fn scale(&self, rate: usize) -> S {
        match M::JOINT_REPORT.motion_of_rate(rate) {
            Some((_, motion)) if motion.freedom == Freedom::Slide => self.length,
            _ => S::one(),
        }
    }

    /// The rows that close loops; of coordinates those of positions alone.
    fn closing_rows(&self, state: &M::JointState<S>) -> ClosingRows<M, S> {
        let (mut jacobian, values) = M::closing_rows(&self.constants, self.time, state);
        if self.leaves_velocities {
            let width = M::JointVelocities::<S>::zeros().as_slice().len().max(1);
            for (row, entries) in jacobian.as_mut_slice().chunks_mut(width).enumerate() {
                let known = M::JOINT_REPORT.rows.get(row).copied().flatten();
                if known.is_some_and(|row| M::REPORT.velocity_rows.contains(&row)) {
                    entries.fill(S::zero());
                }
            }
        }
        (jacobian, values)
    }

    /// Eliminates the dependent rates from the equations that close loops (Gauss and Jordan, with
    /// the largest pivots first). Whether the state is one to go by is told by
    /// [`IndependentCoordinates::known`](super::IndependentCoordinates::known).
    pub(super) fn partition(&self, state: &M::JointState<S>) -> Result<Partition<M, N, S>, Fault> {
        self.eliminated(state, None)
    }

    /// The same; with a row that is open by so much alone, in the place of `Phi`.
    pub(super) fn eliminated(
        &self,
        state: &M::JointState<S>,
        opened: Option<(usize, S)>,
    ) -> Result<Partition<M, N, S>, Fault> {
        let mut partition = Partition {
            columns: [M::JointVelocities::zeros(); N],
            bias: M::JointVelocities::zeros(),
            drift: M::JointVelocities::zeros(),
            closing: M::JointVelocities::zeros(),
            standing: Standing::TREE,
        };
        for (column, &place) in partition.columns.iter_mut().zip(self.places.iter()) {
            set(column, place, S::one());
        }
        if M::JOINT_REPORT.closing.is_empty() {
            return Ok(partition);
        }
        let (mut jacobian, [mut gamma, rates, mut values]) = self.closing_rows(state);
        let width = partition.bias.as_slice().len();
        let height = gamma.as_slice().len();
        if let Some((row, by)) = opened {
            values = M::ClosingMultipliers::zeros();
            set(&mut values, row, -by);
        }
        // `-dPhi/dt = D w - Phi'`, of which nothing but round-off is left without the time.
        let mut explicit = M::ClosingMultipliers::<S>::zeros();
        let mut joint_rates = M::JointVelocities::<S>::zeros();
        if const { M::REPORT.time.constraints } {
            explicit = rates;
            joint_rates = self::joint_rates::<M, S>(state);
        }
        let rows = explicit.as_mut_slice().iter_mut();
        for (right, row) in rows.zip(jacobian.as_slice().chunks(width.max(1))) {
            let products = row.iter().zip(joint_rates.as_slice());
            let moving = products.fold(S::zero(), |sum, (&d, &w)| d.fused(w, sum));
            *right = moving - *right;
        }
        values
            .as_mut_slice()
            .iter_mut()
            .for_each(|value| *value = -*value);
        let scale = |place: usize| self.scale(place);
        let mut sizes = self.sizes;
        let of_rows = sizes.as_mut_slice().iter_mut();
        for (size, row) in of_rows.zip(jacobian.as_slice().chunks(width.max(1))) {
            let entries = row.iter().enumerate();
            *size = entries.fold(*size, |most: S, (place, &entry)| {
                let entry = entry * scale(place);
                if entry.abs().to_f64() > most.abs().to_f64() {
                    entry
                } else {
                    most
                }
            });
        }
        partition.standing.open = largest_share::<M, S>(&values, &sizes);
        partition.standing.opening = largest_share::<M, S>(&rates, &sizes);
        let mut row_of = M::JointVelocities::<S>::zeros();
        let mut elimination = Elimination {
            entries: jacobian.as_mut_slice(),
            width,
            sizes: sizes.as_slice(),
            row_of: row_of.as_mut_slice(),
            // Below, more than half of the digits would be lost.
            least: S::EPSILON.to_f64().sqrt(),
        };
        let is_dependent = |column: usize| !self.places.contains(&column);
        partition.standing.weakest = elimination.run(
            [&mut gamma, &mut explicit, &mut values].map(Array::as_mut_slice),
            scale,
            is_dependent,
        );
        for column in (0..width).filter(|&column| is_dependent(column)) {
            let Some(row) = elimination.row(column) else {
                return Err(Fault::Analysis(AnalysisFault::NotDetermined {
                    joint: M::JOINT_REPORT.mover_of_rate(column),
                }));
            };
            let inverse = elimination.entry(row, column).reciprocal();
            for (of_chosen, &place) in partition.columns.iter_mut().zip(self.places.iter()) {
                set(of_chosen, column, -elimination.entry(row, place) * inverse);
            }
            let of = |right: &M::ClosingMultipliers<S>| at(right.as_slice(), row) * inverse;
            set(&mut partition.bias, column, of(&gamma));
            set(&mut partition.drift, column, of(&explicit));
            set(&mut partition.closing, column, of(&values));
        }
        // What is left of other rows restricts the chosen rates themselves.
        for row in (0..height).filter(|&row| !elimination.is_taken(row)) {
            let size = at(sizes.as_slice(), row).abs().to_f64();
            for &place in self.places.iter() {
                let left = (elimination.entry(row, place) * scale(place))
                    .abs()
                    .to_f64();
                if left > S::EPSILON.to_f64().sqrt() * size {
                    return Err(Fault::Analysis(AnalysisFault::NotIndependent {
                        joint: M::JOINT_REPORT.mover_of_rate(place),
                    }));
                }
            }
        }
        Ok(partition)
    }
}

/// The largest of some numbers over the sizes of their rows, and its row.
fn largest_share<M: JointRates, S: Real>(
    numbers: &M::ClosingMultipliers<S>,
    sizes: &M::ClosingMultipliers<S>,
) -> (f64, usize) {
    let places = numbers.as_slice().iter().zip(sizes.as_slice()).enumerate();
    places.fold((0.0, 0), |most, (row, (number, size))| {
        let number = number.abs().to_f64();
        let share = number / size.abs().to_f64();
        if number > 0.0 && share > most.0 {
            (share, row)
        } else {
            most
        }
    })
}

/// The rates of the joints at a state.
pub(super) fn joint_rates<M: JointRates, S: Scalar>(
    state: &M::JointState<S>,
) -> M::JointVelocities<S> {
    of_joints::<M, S>(state.rates_slice())
}

/// What velocities are as rates of the joints.
pub(super) fn of_joints<M: JointRates, S: Scalar>(velocities: &[S]) -> M::JointVelocities<S> {
    let mut rates = M::JointVelocities::<S>::zeros();
    for (place, rate) in rates.as_mut_slice().iter_mut().enumerate() {
        *rate = at(velocities, place);
    }
    for motion in M::JOINT_REPORT.motions {
        let own = at(velocities, motion.velocity);
        let against = motion
            .against
            .and_then(|of| M::JOINT_REPORT.motions.get(of));
        let rate = against.map_or(own, |against| own - at(velocities, against.velocity));
        if motion.is_reversed() {
            set(&mut rates, motion.velocity, -rate);
        } else {
            set(&mut rates, motion.velocity, rate);
        }
    }
    rates
}

/// The velocities of a state whose joints have these rates.
fn velocities<M: JointRates, S: Scalar>(rates: &M::JointVelocities<S>) -> M::JointVelocities<S> {
    let mut velocities = *rates;
    // What carries a motion stands before it.
    for motion in M::JOINT_REPORT.motions {
        let own = at(rates.as_slice(), motion.velocity);
        let own = if motion.is_reversed() { -own } else { own };
        let against = motion
            .against
            .and_then(|of| M::JOINT_REPORT.motions.get(of));
        if let Some(against) = against {
            let carried = at(velocities.as_slice(), against.velocity);
            set(&mut velocities, motion.velocity, own + carried);
        } else if motion.is_reversed() {
            set(&mut velocities, motion.velocity, own);
        }
    }
    velocities
}

/// Writes the velocities of a state that belong to chosen rates; with those of drivers, if wanted.
pub(super) fn write_rates<M: JointRates, const N: usize, S: Scalar>(
    partition: &Partition<M, N, S>,
    rates: &[S; N],
    are_driven: bool,
    state: &mut M::JointState<S>,
) {
    let mut all = M::JointVelocities::<S>::zeros();
    if are_driven {
        all = partition.drift;
    }
    for (column, &rate) in partition.columns.iter().zip(rates) {
        let places = all.as_mut_slice().iter_mut().zip(column.as_slice());
        places.for_each(|(place, &entry)| *place = entry.fused(rate, *place));
    }
    put_velocities::<M, S>(&all, state);
}

/// Writes the velocities of a state whose joints have these rates.
pub(super) fn put_velocities<M: JointRates, S: Scalar>(
    rates: &M::JointVelocities<S>,
    state: &mut M::JointState<S>,
) {
    let velocities = velocities::<M, S>(rates);
    for (place, velocity) in state.rates_slice_mut().iter_mut().enumerate() {
        *velocity = at(velocities.as_slice(), place);
    }
}
