//! Equations `(shift I - J) x = b` where the rates of coordinates are velocities: these are solved
//! for by themselves, in a matrix of half the size or less.
//!
//! Of `J = [[0, B], [K, D]]`, the coordinates are `q = (b_q + B v) / shift`, and the velocities
//! satisfy `(shift I - D - K B / shift) v = b_v + K b_q / shift` (Hairer and Wanner, *Solving
//! Ordinary Differential Equations II*, IV.8, on equations of second order). The inverse of that
//! matrix is a product of eliminations, as in `linear.rs`, of columns behind the coordinates.

use super::column::Column;
use super::jacobian::Kinematics;
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// Writes the eliminations, of rows in such an order that pivots are on the diagonal, and that
/// order. The inverse of the shift; `None` if a pivot vanishes or is not finite.
pub(super) fn factorise<S: Real, X: Vector<S>, C: Column<S, X>>(
    (eliminations, rows): (&mut X::Each<C>, &mut X::Each<usize>),
    shift: C::Number,
    kinematics: &Kinematics<'_, S, X>,
    like: &X,
) -> Option<C::Number> {
    let (first, count) = (like.coordinate_count(), like.velocities_slice().len());
    let inverse = C::inverse(shift);
    if first > 0 && !C::size(inverse).is_finite() {
        return None;
    }
    for row in 0..count {
        let column = &mut eliminations[first + row];
        column.oppose_behind(&kinematics.columns[first + row]);
        column.set_behind(row, C::sum(column.behind(row), shift));
    }
    for coordinate in kinematics.acting() {
        for (velocity, factor) in kinematics.moved[coordinate] {
            if factor != S::zero() {
                let by = C::times(inverse, -factor);
                let column = &mut eliminations[first + velocity];
                column.add_real_behind(by, &kinematics.columns[coordinate]);
            }
        }
    }
    for row in 0..count {
        rows[first + row] = row;
    }
    for place in 0..count {
        let (mut row, mut largest) = (place, S::zero());
        for candidate in place..count {
            let size = C::size(eliminations[first + place].behind(candidate));
            if size > largest {
                (row, largest) = (candidate, size);
            }
        }
        if !(largest > S::zero() && largest.is_finite()) {
            return None;
        }
        if row != place {
            for column in first..first + count {
                exchange(&mut eliminations[column], row, place);
            }
            let before = rows[first + row];
            rows[first + row] = rows[first + place];
            rows[first + place] = before;
        }
        let mut column = eliminations[first + place].clone();
        let pivot = C::inverse(column.behind(place));
        column.scale_behind(C::negative(pivot));
        column.set_behind(place, pivot);
        for later in place + 1..count {
            eliminations[first + later].eliminate_behind(place, &column);
        }
        eliminations[first + place] = column;
    }
    Some(inverse)
}

/// Writes the solution in the place of a right-hand side.
#[inline(always)]
pub(super) fn solve<S: Real, X: Vector<S>, C: Column<S, X>>(
    (eliminations, rows): (&X::Each<C>, &X::Each<usize>),
    inverse: C::Number,
    kinematics: &Kinematics<'_, S, X>,
    right: &mut C,
) {
    /// Up to so many velocities their columns are added, zeros and all, in one piece.
    const FEW: usize = 12;
    let first = right.like().coordinate_count();
    let count = right.like().velocities_slice().len();
    for coordinate in kinematics.acting() {
        let scaled = C::product(right.at(coordinate), inverse);
        right.add_real_behind(scaled, &kinematics.columns[coordinate]);
    }
    let mut velocities = right.clone();
    for row in 0..count {
        velocities.set_behind(row, right.behind(rows[first + row]));
    }
    for place in 0..count {
        velocities.eliminate_behind(place, &eliminations[first + place]);
    }
    if first > 0 && count <= FEW {
        right.scale(inverse);
        for row in 0..count {
            let factor = C::product(inverse, velocities.behind(row));
            right.add_real(factor, &kinematics.columns[first + row]);
        }
    } else {
        for coordinate in 0..first {
            let mut sum = right.at(coordinate);
            for (velocity, factor) in kinematics.moved[coordinate] {
                sum = C::sum(sum, C::times(velocities.behind(velocity), factor));
            }
            right.set(coordinate, C::product(sum, inverse));
        }
    }
    for row in 0..count {
        right.set_behind(row, velocities.behind(row));
    }
}

/// Exchanges two rows.
fn exchange<S: Real, X: Vector<S>, C: Column<S, X>>(column: &mut C, row: usize, other: usize) {
    let value = column.behind(row);
    column.set_behind(row, column.behind(other));
    column.set_behind(other, value);
}
