//! The saddle system of the bodies by loops over its rows: for mechanisms that run by their joints,
//! which solve it for a start, a projection or an impulse.
//!
//! ```text
//! (D M^-1 D^T + E) lambda = D M^-1 upper - lower        u' = M^-1 (upper - D^T lambda)
//! ```
//!
//! The matrix is symmetric and positive (semi)definite, so that every order of the rows will do.
//! It is factorised as `L d L^T` within its profile: of each row from the first place that it is
//! coupled with to the diagonal.

use crate::math::scalar::Scalar;
use crate::mechanism::blocks::{add_loads, add_product};
use crate::mechanism::kernels::{Mechanism, Pivot, Terms};
use crate::mechanism::report::Block;
use crate::state::vector::Array;

/// Which entries of `D M^-1 D^T` are kept.
#[derive(Clone, Copy, Debug)]
pub struct Profile {
    /// The place of each row in the order of elimination.
    pub places: &'static [usize],
    /// Where the entries of each place end, the last of which is the diagonal.
    pub ends: &'static [usize],
}

impl Profile {
    fn end(&self, place: usize) -> usize {
        self.ends.get(place).copied().unwrap_or(0)
    }

    /// Where the entries of a place begin, and how many there are before the diagonal.
    fn row(&self, place: usize) -> (usize, usize) {
        let start = place.checked_sub(1).map_or(0, |before| self.end(before));
        let entries = self.end(place).saturating_sub(start);
        (start, entries.saturating_sub(1))
    }

    /// The entry of two rows, and `None` if they are not coupled.
    fn entry(&self, row: usize, other: usize) -> Option<usize> {
        let place = |row: usize| self.places.get(row).copied();
        let (one, other) = (place(row)?, place(other)?);
        let (later, earlier) = (one.max(other), one.min(other));
        let entry = self.end(later).checked_sub(later - earlier + 1)?;
        (entry >= self.row(later).0).then_some(entry)
    }

    /// The entries of a place before the diagonal, and the diagonal.
    fn read<'e, S: Scalar>(&self, entries: &'e [S], place: usize) -> (&'e [S], S) {
        let (start, before) = self.row(place);
        let row = entries.get(start..start + before).unwrap_or(&[]);
        let diagonal = entries.get(start + before).copied();
        (row, diagonal.unwrap_or(S::zero()))
    }
}

/// A factorised saddle system: `D`, the inverse masses, and `L` with `1 / d` on its diagonal.
#[derive(Clone, Copy, Debug)]
pub struct RowFactors<J, U, L> {
    jacobian: J,
    inverse_mass: U,
    entries: L,
}

/// The factors of a mechanism.
type FactorsOf<S, M, L> =
    RowFactors<<M as Mechanism>::Jacobian<S>, <M as Mechanism>::Velocities<S>, L>;

/// [`Mechanism::factor`].
#[inline(never)]
pub fn factor_by_rows<S: Scalar, M: Mechanism, T: Terms, L: Array<S>>(
    profile: Profile,
    constants: &M::Constants<S>,
    compliances: &M::Multipliers<S>,
    time: S,
    state: &M::State<S>,
) -> (FactorsOf<S, M, L>, Pivot<S>) {
    let mut inverse_mass = M::metric(constants);
    for mass in inverse_mass.as_mut_slice() {
        *mass = mass.reciprocal();
    }
    let jacobian = M::jacobian(constants, time, state);
    let mut entries = L::zeros();
    let matrix = entries.as_mut_slice();
    let (values, inverse) = (jacobian.as_slice(), inverse_mass.as_slice());
    assemble(M::REPORT.blocks, profile, values, inverse, matrix);
    if T::COMPLIANT {
        for (row, &compliance) in compliances.as_slice().iter().enumerate() {
            let entry = profile.entry(row, row);
            if let Some(entry) = entry.and_then(|entry| matrix.get_mut(entry)) {
                *entry = *entry + compliance;
            }
        }
    }
    let mut relative = M::Multipliers::<S>::zeros();
    eliminate(profile, matrix, relative.as_mut_slice());
    let mut pivot = Pivot::unchecked();
    if !T::COMPLIANT {
        for (joint, info) in M::REPORT.joints.iter().enumerate() {
            let places = profile.places.iter().skip(info.row).take(info.rows);
            for &relative in places.filter_map(|&place| relative.as_slice().get(place)) {
                pivot = pivot.and(relative, joint);
            }
        }
    }
    let factors = RowFactors {
        jacobian,
        inverse_mass,
        entries,
    };
    (factors, pivot)
}

/// `D M^-1 D^T`.
fn assemble<S: Scalar>(
    blocks: &[Block],
    profile: Profile,
    jacobian: &[S],
    inverse_mass: &[S],
    matrix: &mut [S],
) {
    let row_of = |block: &Block, row: usize| {
        let first = block.offset + block.columns * row;
        jacobian.get(first..first + block.columns).unwrap_or(&[])
    };
    for (number, block) in blocks.iter().enumerate() {
        let others = blocks.iter().take(number + 1);
        for other in others.filter(|other| other.body == block.body) {
            for row in 0..block.rows {
                let own = row_of(block, row);
                let rows = if other.row == block.row {
                    row + 1
                } else {
                    other.rows
                };
                for column in 0..rows {
                    let entry = profile.entry(block.row + row, other.row + column);
                    let Some(entry) = entry.and_then(|entry| matrix.get_mut(entry)) else {
                        continue;
                    };
                    let masses = inverse_mass.iter().skip(block.column);
                    let pairs = own.iter().zip(row_of(other, column)).zip(masses);
                    *entry = pairs.fold(*entry, |sum, ((&a, &b), &mass)| (a * mass).fused(b, sum));
                }
            }
        }
    }
}

/// `L`, with `1 / d` on its diagonal, in the place of a matrix; each pivot over what it would be
/// without the other rows.
fn eliminate<S: Scalar>(profile: Profile, matrix: &mut [S], relative: &mut [S]) {
    for (place, relative) in relative.iter_mut().enumerate() {
        let (start, before) = profile.row(place);
        let first = place.saturating_sub(before);
        let Some((done, rest)) = matrix.split_at_mut_checked(start) else {
            return;
        };
        for column in 0..before {
            let (other, _) = profile.read(done, first + column);
            // The columns that both have.
            let shared = column.min(other.len());
            let Some((known, rest)) = rest.split_at_mut_checked(column) else {
                return;
            };
            let known = known.iter().skip(column - shared);
            let other = other.iter().skip(other.len() - shared);
            let sum = known
                .zip(other)
                .fold(S::zero(), |sum, (&a, &b)| a.fused(b, sum));
            if let Some(entry) = rest.first_mut() {
                *entry = *entry - sum;
            }
        }
        let Some((row, diagonal)) = rest.split_at_mut_checked(before) else {
            return;
        };
        let mut sum = S::zero();
        for (column, entry) in row.iter_mut().enumerate() {
            let (_, reciprocal) = profile.read(done, first + column);
            let scaled = *entry * reciprocal;
            sum = entry.fused(scaled, sum);
            *entry = scaled;
        }
        if let Some(diagonal) = diagonal.first_mut() {
            let pivot = *diagonal - sum;
            *relative = (pivot * diagonal.reciprocal()).abs();
            *diagonal = pivot.reciprocal();
        }
    }
}

/// [`Mechanism::solve`].
#[inline(never)]
pub fn solve_by_rows<S: Scalar, M: Mechanism, L: Array<S>>(
    profile: Profile,
    factors: &FactorsOf<S, M, L>,
    upper: &M::Velocities<S>,
    lower: &M::Multipliers<S>,
) -> (M::Velocities<S>, M::Multipliers<S>) {
    let (blocks, jacobian) = (M::REPORT.blocks, factors.jacobian.as_slice());
    let weighted = |forces: &M::Velocities<S>| {
        let mut weighted = *forces;
        let inverse = factors.inverse_mass.as_slice();
        for (force, &inverse) in weighted.as_mut_slice().iter_mut().zip(inverse) {
            *force = *force * inverse;
        }
        weighted
    };
    let mut right = *lower;
    right.as_mut_slice().iter_mut().for_each(|row| *row = -*row);
    let free = weighted(upper);
    add_product(blocks, jacobian, free.as_slice(), right.as_mut_slice());
    let mut solution = M::Multipliers::<S>::zeros();
    for (&place, &value) in profile.places.iter().zip(right.as_slice()) {
        if let Some(element) = solution.as_mut_slice().get_mut(place) {
            *element = value;
        }
    }
    substitute(profile, factors.entries.as_slice(), solution.as_mut_slice());
    let mut multipliers = right;
    let rows = multipliers.as_mut_slice().iter_mut().zip(profile.places);
    for (multiplier, &place) in rows {
        let value = solution.as_slice().get(place).copied();
        *multiplier = -value.unwrap_or(S::zero());
    }
    let mut forces = *upper;
    let loads = multipliers.as_slice();
    add_loads(blocks, jacobian, loads, forces.as_mut_slice());
    multipliers
        .as_mut_slice()
        .iter_mut()
        .for_each(|row| *row = -*row);
    (weighted(&forces), multipliers)
}

/// Solves `L d L^T x = b` in the place of `b`.
fn substitute<S: Scalar>(profile: Profile, entries: &[S], x: &mut [S]) {
    for place in 0..x.len() {
        let (row, _) = profile.read(entries, place);
        let known = x.iter().take(place).skip(place.saturating_sub(row.len()));
        let sum = row
            .iter()
            .zip(known)
            .fold(S::zero(), |sum, (&l, &x)| l.fused(x, sum));
        if let Some(element) = x.get_mut(place) {
            *element = *element - sum;
        }
    }
    for (place, element) in x.iter_mut().enumerate() {
        let (_, reciprocal) = profile.read(entries, place);
        *element = *element * reciprocal;
    }
    for place in (0..x.len()).rev() {
        let (row, _) = profile.read(entries, place);
        let value = x.get(place).copied().unwrap_or(S::zero());
        let known = x
            .iter_mut()
            .take(place)
            .skip(place.saturating_sub(row.len()));
        for (element, &l) in known.zip(row) {
            *element = (-l).fused(value, *element);
        }
    }
}
