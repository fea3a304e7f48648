//! Systems of linear equations `(shift I - J) x = b` between slopes, for implicit methods.

use super::column::Column;
use super::jacobian::Jacobian;
use super::reduced;
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// The inverse of a matrix as a product of eliminations, one for every column, with the largest
/// number of a column as its pivot (Gauss and Jordan).
///
/// All work is done on whole columns, which is what [`Vector`] offers, without a branch for each
/// element; an elimination whose factor is zero is left out. Most are where the coordinates of a
/// state keep their own rows ([`Vector::coordinate_count`]): the rates of a position are a
/// velocity, so that its column has nothing in the rows of other coordinates. For that a pivot of
/// such a column is sought in these rows, of the matrix `shift I - J` of rates of coordinates by
/// coordinates, whose numbers are about `shift` where a step resolves the motion; and in all of
/// them where the largest is below a hundredth of `shift`, so that no elimination is worse than a
/// hundred divisions by it.
pub(super) struct Factors<S: Real, X: Vector<S>, C: Column<S, X>> {
    eliminations: X::Each<C>,
    /// The row of the pivot of every column.
    rows: X::Each<usize>,
    /// The inverse of the shift, where only the velocities are solved for.
    reduced: Option<C::Number>,
}

impl<S: Real, X: Vector<S>, C: Column<S, X>> Clone for Factors<S, X, C> {
    fn clone(&self) -> Self {
        Self {
            eliminations: self.eliminations.clone(),
            rows: self.rows.clone(),
            reduced: self.reduced,
        }
    }
}

impl<S: Real, X: Vector<S>, C: Column<S, X>> Factors<S, X, C> {
    /// A place for matrices between slopes like this one.
    pub(super) fn new(like: &X) -> Self {
        Self {
            eliminations: like.each(C::real(like.clone())),
            rows: like.each(0),
            reduced: None,
        }
    }

    /// Factorises `shift I - jacobian`. `false` if a pivot vanishes or is not finite.
    #[must_use]
    pub(super) fn factorise(
        &mut self,
        shift: C::Number,
        jacobian: &Jacobian<S, X>,
        like: &X,
    ) -> bool {
        let Some(kinematics) = jacobian.kinematics() else {
            self.reduced = None;
            return self.factorise_all(shift, &jacobian.columns, like);
        };
        let factors = (&mut self.eliminations, &mut self.rows);
        self.reduced = reduced::factorise(factors, shift, &kinematics, like);
        self.reduced.is_some()
    }

    fn factorise_all(&mut self, shift: C::Number, jacobian: &X::Each<X>, like: &X) -> bool {
        /// Of the shift, what a pivot among the coordinates must have.
        const LEAST: f64 = 0.01;
        let (length, coordinates) = (like.length(), like.coordinate_count());
        let least = S::constant(LEAST) * C::size(shift);
        let mut is_free = like.each(true);
        for column in 0..length {
            let of_jacobian = &jacobian[column];
            let mut reduced = C::real(of_jacobian.zip(of_jacobian, |x, _| -x));
            let diagonal = C::sum(reduced.at(column), shift);
            reduced.set(column, diagonal);
            for before in 0..column {
                self.eliminate(before, &mut reduced);
            }
            let pivot = |rows: usize| {
                let (mut row, mut largest) = (column, S::zero());
                for candidate in 0..rows {
                    let size = C::size(reduced.at(candidate));
                    if is_free[candidate] && size > largest {
                        (row, largest) = (candidate, size);
                    }
                }
                (row, largest)
            };
            let (mut row, mut largest) = pivot(if column < coordinates {
                coordinates
            } else {
                length
            });
            if column < coordinates && largest < least {
                (row, largest) = pivot(length);
            }
            if !(largest > S::zero() && largest.is_finite()) {
                return false;
            }
            let inverse = C::inverse(reduced.at(row));
            reduced.scale(C::negative(inverse));
            reduced.set(row, inverse);
            self.eliminations[column] = reduced;
            self.rows[column] = row;
            is_free[row] = false;
        }
        true
    }

    /// Writes the solution in the place of a right-hand side. The Jacobian is that of the factors.
    pub(super) fn solve(&self, right: &mut C, jacobian: &Jacobian<S, X>) {
        if let (Some(inverse), Some(kinematics)) = (self.reduced, jacobian.kinematics()) {
            let factors = (&self.eliminations, &self.rows);
            reduced::solve(factors, inverse, &kinematics, right);
            return;
        }
        let length = right.like().length();
        for column in 0..length {
            self.eliminate(column, right);
        }
        let eliminated = right.clone();
        for column in 0..length {
            right.set(column, eliminated.at(self.rows[column]));
        }
    }

    #[inline(always)]
    fn eliminate(&self, column: usize, of: &mut C) {
        let row = self.rows[column];
        let factor = of.at(row);
        if C::size(factor) == S::zero() {
            return;
        }
        of.set(row, C::zero());
        of.add(factor, &self.eliminations[column]);
    }
}

#[cfg(test)]
mod tests {
    use core::array::from_fn;

    use super::Factors;
    use crate::integrate::column::{Column, Complex, ComplexColumn};
    use crate::integrate::jacobian::Jacobian;
    use crate::state::vector::{State, Vector};

    type X = State<f64, 4, 3>;

    /// Numbers without a pattern.
    fn scattered(seed: u64) -> impl FnMut() -> f64 {
        let mut bits = seed;
        move || {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (bits >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        }
    }

    #[test]
    fn solutions_satisfy_their_equations_wherever_the_pivots_are() {
        for seed in 1..40 {
            let mut number = scattered(seed);
            let mut column =
                || X::from_parts([(); 4].map(|()| number()), [(); 3].map(|()| number()));
            let like = column();
            let mut jacobian = Jacobian::new(&like);
            for k in 0..7 {
                jacobian.columns[k] = column();
            }
            jacobian.look(&like);
            assert!(jacobian.kinematics().is_none());
            let (shift, right) = ([0.3, -0.7], [column(), column()]);
            let mut real = Factors::<f64, X, X>::new(&like);
            assert!(real.factorise(shift[0], &jacobian, &like));
            let mut x = right[0];
            real.solve(&mut x, &jacobian);
            let mut complex = Factors::<f64, X, ComplexColumn<X>>::new(&like);
            assert!(complex.factorise(shift, &jacobian, &like));
            let mut z = ComplexColumn {
                real: right[0],
                imaginary: right[1],
            };
            complex.solve(&mut z, &jacobian);
            for row in 0..7 {
                let product = |v: &X| -> f64 {
                    (0..7)
                        .map(|k| jacobian.columns[k].element(row) * v.element(k))
                        .sum()
                };
                let rest = shift[0] * x.element(row) - product(&x) - right[0].element(row);
                assert!(rest.abs() < 1e-11, "{rest:e}");
                let (re, im) = (z.real.element(row), z.imaginary.element(row));
                let rest: Complex<f64> = [
                    shift[0] * re - shift[1] * im - product(&z.real) - right[0].element(row),
                    shift[0] * im + shift[1] * re - product(&z.imaginary) - right[1].element(row),
                ];
                assert!(rest.iter().all(|rest| rest.abs() < 1e-11), "{rest:?}");
            }
        }
    }

    /// The rates of coordinates are velocities, but for what is given; those of velocities are
    /// anything, and large.
    fn kinematic(
        coordinates: f64,
        seed: u64,
    ) -> (State<f64, 4, 3>, Jacobian<f64, State<f64, 4, 3>>) {
        let mut number = scattered(seed);
        let like = State::from_parts([0.0; 4], [0.0; 3]);
        let mut jacobian = Jacobian::new(&like);
        for column in 0..7 {
            let by_coordinate = column < 4;
            jacobian.columns[column] = State::from_parts(
                from_fn(|row| {
                    let own = if row == column { coordinates } else { 0.0 };
                    let velocity = if row + 4 == column { 1.0 } else { 0.0 };
                    own + velocity
                }),
                [(); 3].map(|()| number() * if by_coordinate { 1e6 } else { 1e3 }),
            );
        }
        (like, jacobian)
    }

    /// Also where the coordinates have no pivots of their own: their rates take away the shift, or
    /// nearly so.
    #[test]
    fn coordinates_keep_their_rows_where_they_can() {
        let shift = 40.0;
        for (coordinates, own) in [
            (0.0, true),
            (-1e3, true),
            (shift, false),
            (shift * (1.0 - 1e-9), false),
        ] {
            for seed in 1..20 {
                let (like, jacobian) = kinematic(coordinates, seed);
                let mut factors = Factors::<f64, State<f64, 4, 3>, State<f64, 4, 3>>::new(&like);
                let exists = factors.factorise(shift, &jacobian, &like);
                // A coordinate whose velocity is no state has no other row.
                assert_eq!(exists, coordinates != shift, "{coordinates}");
                if !exists {
                    continue;
                }
                assert_eq!((0..4).all(|column| factors.rows[column] == column), own);
                let mut number = scattered(seed + 100);
                let right =
                    State::from_parts([(); 4].map(|()| number()), [(); 3].map(|()| number()));
                let mut x = right;
                factors.solve(&mut x, &jacobian);
                for row in 0..7 {
                    let terms = |k: usize| {
                        let diagonal = if k == row { shift } else { 0.0 };
                        (diagonal - jacobian.columns[k].element(row)) * x.element(k)
                    };
                    let sum: f64 = (0..7).map(terms).sum();
                    let size: f64 = (0..7).map(|k| terms(k).abs()).sum();
                    let rest = sum - right.element(row);
                    assert!(
                        rest.abs() < 1e-13 * (1.0 + size),
                        "{coordinates} {row}: {rest:e}"
                    );
                }
            }
        }
    }

    /// The solution of a matrix whose zeros are known is that of the same matrix as any other.
    fn agrees<C: Column<f64, X>>(shift: C::Number, right: impl Fn(X) -> C, seed: u64) -> [C; 2] {
        let (like, mut jacobian) = kinematic(0.0, seed);
        // A coordinate of two velocities, and one of none.
        jacobian.columns[5].set_element(0, -0.5);
        let mut number = scattered(seed + 100);
        let right = right(X::from_parts(
            [(); 4].map(|()| number()),
            [(); 3].map(|()| number()),
        ));
        [false, true].map(|is_known| {
            if is_known {
                jacobian.look(&like);
            }
            assert_eq!(jacobian.kinematics().is_some(), is_known);
            let mut factors = Factors::<f64, X, C>::new(&like);
            assert!(factors.factorise(shift, &jacobian, &like));
            let mut solution = right.clone();
            factors.solve(&mut solution, &jacobian);
            solution
        })
    }

    #[test]
    fn velocities_are_solved_for_by_themselves() {
        for seed in 1..40 {
            let [all, reduced] = agrees::<X>(40.0, |right| right, seed);
            let complex = |real: X| ComplexColumn {
                real,
                imaginary: real.zip(&real, |x, _| 0.3 - x),
            };
            let [z, w] = agrees([40.0, -30.0], complex, seed);
            for (all, reduced) in [(all, reduced), (z.real, w.real), (z.imaginary, w.imaginary)] {
                for part in [0..4, 4..7] {
                    let size = part.clone().map(|row| all.element(row).abs());
                    let size = size.fold(0.0, f64::max);
                    for row in part {
                        let difference = all.element(row) - reduced.element(row);
                        assert!(difference.abs() < 1e-10 * size, "{row}: {difference:e}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_number_that_is_none_is_not_overlooked() {
        for (column, row) in [(0, 1), (1, 5), (4, 0), (5, 1), (6, 6)] {
            let (like, mut jacobian) = kinematic(0.0, 1);
            jacobian.columns[column].set_element(row, f64::NAN);
            jacobian.look(&like);
            let mut factors = Factors::<f64, X, X>::new(&like);
            let mut right = X::from_parts([1.0; 4], [1.0; 3]);
            let exists = factors.factorise(40.0, &jacobian, &like);
            if exists {
                factors.solve(&mut right, &jacobian);
            }
            let is_told = !exists || !right.is_finite();
            assert!(is_told, "{column} {row}");
        }
    }

    #[test]
    fn a_matrix_without_an_inverse_is_none() {
        let mut jacobian = Jacobian::new(&[0.0; 2]);
        jacobian.columns = [[1.0, 2.0], [2.0, 4.0]];
        jacobian.look(&[0.0; 2]);
        let mut factors = Factors::<f64, [f64; 2], [f64; 2]>::new(&[0.0; 2]);
        assert!(!factors.factorise(0.0, &jacobian, &[0.0; 2]));
        assert!(!factors.factorise(f64::NAN, &jacobian, &[0.0; 2]));
        assert!(factors.factorise(1.0, &jacobian, &[0.0; 2]));
    }
}
