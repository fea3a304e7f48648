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

/// Writes the eliminations, and the row of the pivot of every column. The inverse of the shift;
/// `None` if a pivot vanishes or is not finite.
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
        if first > 0 {
            column.add_real_behind(C::negative(inverse), &kinematics.coupling[first + row]);
        }
    }
    let mut is_free = like.each(true);
    for place in first..first + count {
        let mut column = eliminations[place].clone();
        let (mut row, mut largest) = (0, S::zero());
        for candidate in 0..count {
            let size = C::size(column.behind(candidate));
            if is_free[first + candidate] && size > largest {
                (row, largest) = (candidate, size);
            }
        }
        if !(largest > S::zero() && largest.is_finite()) {
            return None;
        }
        let pivot = C::inverse(column.behind(row));
        column.scale_behind(C::negative(pivot));
        column.set_behind(row, pivot);
        rows[place] = row;
        is_free[first + row] = false;
        for later in place + 1..first + count {
            eliminate(row, &column, &mut eliminations[later]);
        }
        eliminations[place] = column;
    }
    Some(inverse)
}

/// The solution for a right-hand side.
#[inline(always)]
pub(super) fn solve<S: Real, X: Vector<S>, C: Column<S, X>>(
    (eliminations, rows): (&X::Each<C>, &X::Each<usize>),
    inverse: C::Number,
    kinematics: &Kinematics<'_, S, X>,
    (mut right, like): (C, &X),
) -> C {
    let (first, count) = (like.coordinate_count(), like.velocities_slice().len());
    for coordinate in 0..first {
        let scaled = C::product(right.at(coordinate), inverse);
        right.set(coordinate, scaled);
        if kinematics.moved[coordinate].acts {
            right.add_real_behind(scaled, &kinematics.columns[coordinate]);
        }
    }
    for place in first..first + count {
        eliminate(rows[place], &eliminations[place], &mut right);
    }
    let mut solution = right.clone();
    for row in 0..count {
        solution.set_behind(row, right.behind(rows[first + row]));
    }
    for coordinate in 0..first {
        let mut sum = right.at(coordinate);
        for (velocity, factor) in kinematics.moved[coordinate].by {
            if factor != S::zero() {
                let velocity = C::times(solution.behind(velocity), factor);
                sum = C::sum(sum, C::product(inverse, velocity));
            }
        }
        solution.set(coordinate, sum);
    }
    solution
}

/// Eliminates the number at a row from a column.
#[inline(always)]
fn eliminate<S: Real, X: Vector<S>, C: Column<S, X>>(row: usize, by: &C, of: &mut C) {
    let factor = of.behind(row);
    of.set_behind(row, C::zero());
    of.add_behind(factor, by);
}
