//! Natural motions of a linearised mechanism.

use std::vec::Vec;

use nalgebra::{Complex, ComplexField as _, DMatrix, SMatrix, SVector};

use super::jacobi::symmetric;
use super::linearised::Linearised;
use super::spectrum::{Eigenspace, spectrum};
use crate::math::scalar::Real;

/// A natural motion: all coordinates go with `shape exp(rate t)`, of which the real part counts.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Mode<const N: usize> {
    /// The eigenvalue of `A` (1/s), with an imaginary part that is not negative: a pair of
    /// conjugate ones is one mode.
    pub rate: Complex<f64>,
    /// What the coordinates do, in their order; the largest is one.
    pub shape: [Complex<f64>; N],
    /// The mass (kg, or kg m^2) of the motion: that of the shape by the mass matrix, `q^H M q`.
    pub mass: f64,
    /// How many eigenvalues of `A` are this one. There are as many modes at this rate as there are
    /// shapes. Where these are fewer, further motions go with `t exp(rate t)` and higher powers of
    /// the time, as at critical damping. What no force brings back goes on at a constant rate.
    pub multiplicity: usize,
}

impl<const N: usize> Mode<N> {
    /// The angular frequency (rad/s) of the oscillation, as it is seen; zero where there is none.
    #[must_use]
    pub const fn angular_frequency(&self) -> f64 {
        self.rate.im
    }

    /// The natural frequency (Hz), as it were without damping: `|rate| / 2 pi`.
    #[must_use]
    pub fn natural_frequency(&self) -> f64 {
        self.rate.modulus() / core::f64::consts::TAU
    }

    /// The damping ratio: 0 without damping, 1 where there is no oscillation any more, negative
    /// where the motion grows. Zero of a motion at no rate.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        let size = self.rate.modulus();
        if size > 0.0 {
            -self.rate.re / size
        } else {
            0.0
        }
    }
}

type C = Complex<f64>;
type Square<const N: usize> = SMatrix<f64, N, N>;

impl<const N: usize, const K: usize, const P: usize, S: Real> Linearised<N, K, P, S> {
    /// The natural motions, slowest first, in double precision.
    ///
    /// Without damping, and with one that goes with mass and stiffness, shapes are real and
    /// orthogonal by the mass matrix, whether frequencies are equal or not: divided by the root of
    /// [`Mode::mass`] they are orthonormal. Otherwise, as with gyroscopic and follower forces, the
    /// shapes of one rate are independent, orthogonal by the mass matrix
    /// among each other, and real where they may be. Frequencies below 1e-7 of the largest are
    /// round-off, and zero.
    ///
    /// By Cholesky's factors of the mass matrix and Jacobi's rotations, or by Schur's form with
    /// eigenvalues that are near to each other brought together. Without elements where an
    /// iteration does not converge.
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// /// A rod on a hinge.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, inverse])]
    /// struct Pendulum {
    ///     #[body(mass = 2.0, inertia = [0.5, 0.5, 0.5], position = [0.0, 0.0, -0.5])]
    ///     rod: Body,
    ///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    ///     hinge: Revolute,
    /// }
    ///
    /// let (pendulum, h) = (Pendulum::default(), Pendulum::HANDLES);
    /// let space = pendulum.coordinates([h.hinge])?;
    /// let hanging = space.state([0.0], [0.0])?;
    /// let modes = space.linearise(&hanging, [], |_| [])?.modes();
    /// // m g l over J + m l^2.
    /// assert!((modes[0].angular_frequency() - 9.81_f64.sqrt()).abs() < 1e-13);
    /// # Ok::<(), Fault>(())
    /// ```
    #[must_use]
    pub fn modes(&self) -> Vec<Mode<N>> {
        if N == 0 {
            return Vec::new();
        }
        let plain = |matrix: &SMatrix<S, N, N>| matrix.map(Real::to_f64);
        let Some(unit) = Unit::of(
            plain(&self.by_efforts),
            plain(&self.by_positions),
            plain(&self.by_rates),
            plain(&self.rates_by_positions),
        ) else {
            return Vec::new();
        };
        let unit = Unit {
            epsilon: S::EPSILON.to_f64().max(f64::EPSILON),
            ..unit
        };
        let mut modes = match unit.uncoupled() {
            Some(uncoupled) => unit.of_uncoupled(uncoupled),
            None => unit.coupled(),
        };
        modes.sort_by(|a, b| {
            let by_size = a.rate.modulus().total_cmp(&b.rate.modulus());
            by_size.then(a.rate.re.total_cmp(&b.rate.re))
        });
        modes
    }
}

/// The equations in coordinates `y` in which the mass matrix is one:
/// `y'' = -stiffness y - damping y'`.
struct Unit<const N: usize> {
    /// Takes `y` to coordinates; times its transpose it is the inverse of the mass matrix.
    lower: Square<N>,
    stiffness: Square<N>,
    damping: Square<N>,
    /// How small turns are carried round.
    carried: Square<N>,
    /// The round-off of the numbers.
    epsilon: f64,
}

impl<const N: usize> Unit<N> {
    fn of(
        inverse: Square<N>,
        by_positions: Square<N>,
        by_rates: Square<N>,
        carried: Square<N>,
    ) -> Option<Self> {
        let lower = inverse.cholesky()?.l();
        let to_unit = |matrix: Square<N>| lower.solve_lower_triangular(&(matrix * lower));
        Some(Self {
            stiffness: -to_unit(by_positions)?,
            damping: -to_unit(by_rates)?,
            carried: to_unit(carried)?,
            lower,
            epsilon: f64::EPSILON,
        })
    }

    /// What round-off leaves of entries, over the largest.
    fn noise(&self) -> f64 {
        100.0 * N as f64 * self.epsilon
    }

    /// Whether a matrix is symmetric, but for round-off.
    fn is_symmetric(&self, matrix: &Square<N>) -> bool {
        (matrix - matrix.transpose()).amax() <= self.noise() * matrix.amax()
    }

    /// Squares of frequencies, dampings and shapes, orthonormal, where no damping leads from one
    /// shape to another: without damping, and with one that goes with mass and stiffness.
    fn uncoupled(&self) -> Option<([f64; N], [f64; N], Square<N>)> {
        let is_symmetric = self.is_symmetric(&self.stiffness) && self.is_symmetric(&self.damping);
        if !is_symmetric || self.carried.amax() > 0.0 {
            return None;
        }
        let half = |matrix: &Square<N>| (matrix + matrix.transpose()) * 0.5;
        let (mut squares, mut shapes) = symmetric(half(&self.stiffness));
        let noise = self.noise() * self.stiffness.amax();
        let least = self.noise() * self.stiffness.amax().sqrt().max(self.damping.amax());
        // Of equal frequencies, those that the damping tells apart.
        let damping = half(&(shapes.transpose() * self.damping * shapes));
        let among_equal = Square::<N>::from_fn(|row, column| {
            let is_same = (squares[row] - squares[column]).abs() <= noise;
            if is_same { damping[(row, column)] } else { 0.0 }
        });
        let (_, turn) = symmetric(among_equal);
        shapes *= turn;
        let damping = turn.transpose() * damping * turn;
        let mut dampings: [f64; N] = damping.diagonal().into();
        let off = damping - Square::<N>::from_diagonal(&damping.diagonal());
        if off.amax() > least {
            return None;
        }
        let stiffness = shapes.transpose() * self.stiffness * shapes;
        squares = stiffness.diagonal().into();
        for square in squares.iter_mut().filter(|square| square.abs() <= noise) {
            *square = 0.0;
        }
        for damping in dampings.iter_mut().filter(|damping| damping.abs() <= least) {
            *damping = 0.0;
        }
        Some((squares, dampings, shapes))
    }

    /// The modes of `y'' + d y' + s y = 0` for each shape.
    fn of_uncoupled(
        &self,
        (squares, dampings, shapes): ([f64; N], [f64; N], Square<N>),
    ) -> Vec<Mode<N>> {
        let mut found = Vec::new();
        for (place, (square, damping)) in squares.into_iter().zip(dampings).enumerate() {
            for (rate, count) in roots(damping, square, self.noise()).into_iter().flatten() {
                found.push((rate, count, place));
            }
        }
        let sizes = found.iter().map(|(rate, ..)| rate.modulus());
        let noise = self.noise() * sizes.fold(0.0, f64::max);
        let modes = found.iter().map(|&(rate, _, place)| {
            let same = found
                .iter()
                .filter(|(other, ..)| (other - rate).modulus() <= noise);
            let multiplicity = same.map(|&(_, count, _)| count).sum();
            let y = shapes.column(place).map(|entry| C::new(entry, 0.0));
            self.mode((rate, multiplicity), &y)
        });
        modes.collect()
    }

    fn coupled(&self) -> Vec<Mode<N>> {
        // In a unit of time in which positions and rates are of one size.
        let rates = self.damping.amax().max(self.carried.amax());
        let unit = self.stiffness.amax().sqrt().max(rates);
        let entry = |row: usize, column: usize| match (row < N, column < N) {
            (true, true) => self.carried[(row, column)],
            (true, false) if column == row + N => unit,
            (true, false) => 0.0,
            (false, true) => -self.stiffness[(row - N, column)] / unit,
            (false, false) => -self.damping[(row - N, column - N)],
        };
        let matrix = DMatrix::from_fn(2 * N, 2 * N, entry);
        let spaces = spectrum(&matrix, self.epsilon);
        let spaces = spaces.iter().filter(|space| space.value.im >= 0.0);
        let modes = spaces.flat_map(|space| {
            let shapes = shapes::<N>(space).into_iter();
            shapes.map(|y| self.mode((space.value, space.multiplicity), &y))
        });
        modes.collect()
    }

    fn mode(&self, (rate, multiplicity): (C, usize), y: &SVector<C, N>) -> Mode<N> {
        let shape = self.lower.map(|entry| C::new(entry, 0.0)) * y;
        let by_size = |a: &C, b: &C| a.modulus().total_cmp(&b.modulus());
        let largest = shape.iter().copied().max_by(by_size);
        let largest = largest.filter(|largest| largest.modulus() > 0.0);
        let largest = largest.unwrap_or(C::new(1.0, 0.0));
        Mode {
            rate,
            shape: shape.map(|entry| entry / largest).into(),
            mass: length(y).powi(2) / largest.modulus_squared(),
            multiplicity,
        }
    }
}

/// The roots of `x^2 + d x + s`, each with how many there are of it; one of a conjugate pair. Those
/// are one that round-off leaves apart.
fn roots(d: f64, s: f64, noise: f64) -> [Option<(C, usize)>; 2] {
    // Not -0.
    let middle = 0.0 - 0.5 * d;
    let inner = middle * middle - s;
    if inner.abs() <= noise * s.abs() || d == 0.0 && s == 0.0 {
        return [Some((C::new(middle, 0.0), 2)), None];
    }
    let root = inner.abs().sqrt();
    if inner < 0.0 {
        return [Some((C::new(middle, root), 1)), None];
    }
    // The larger one without a difference of numbers that are near to each other.
    let larger = if d < 0.0 {
        middle + root
    } else {
        middle - root
    };
    [s / larger, larger].map(|root| Some((C::new(root, 0.0), 1)))
}

/// The shapes of an eigenspace, orthonormal; real where they may be.
fn shapes<const N: usize>(space: &Eigenspace) -> Vec<SVector<C, N>> {
    let columns = space.vectors.column_iter();
    let columns = columns.map(|column| SVector::from_fn(|row, _| column[row]));
    let whole: Vec<SVector<C, N>> = columns.collect();
    let parts = whole.iter().flat_map(|column| {
        let real = column.map(|entry| C::new(entry.re, 0.0));
        [real, column.map(|entry| C::new(entry.im, 0.0))]
    });
    let real = orthonormal(parts.collect());
    if real.len() == whole.len() {
        real
    } else {
        orthonormal(whole)
    }
}

/// An orthonormal basis of what some vectors span, but for what is hardly there; by Gram and
/// Schmidt, the longest first.
fn orthonormal<const N: usize>(mut vectors: Vec<SVector<C, N>>) -> Vec<SVector<C, N>> {
    /// A part of the longest that says nothing.
    const HARDLY: f64 = 1e-6;
    let longest = |vectors: &[SVector<C, N>]| {
        let lengths = vectors.iter().map(length).enumerate();
        lengths.max_by(|a, b| a.1.total_cmp(&b.1))
    };
    let least = longest(&vectors).map_or(0.0, |(_, most)| HARDLY * most);
    let mut found: Vec<SVector<C, N>> = Vec::new();
    while let Some((place, _)) = longest(&vectors) {
        let mut next = vectors.swap_remove(place);
        // Once more, for what round-off has left.
        for known in &found {
            next -= known * known.dotc(&next);
        }
        let size = length(&next);
        if size <= least {
            break;
        }
        next.unscale_mut(size);
        for other in &mut vectors {
            *other -= next * next.dotc(other);
        }
        found.push(next);
    }
    found
}

fn length<const N: usize>(vector: &SVector<C, N>) -> f64 {
    let squares = vector.iter().map(|entry| entry.modulus_squared());
    squares.sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use nalgebra::{Complex, ComplexField as _, Matrix1, Matrix2, Matrix3, SMatrix, SVector};

    use super::{C, Linearised, Mode};

    /// The modes of `M q'' + C q' + K q = 0`, each a solution. Those of one rate are orthonormal by
    /// the mass matrix, and all of them where there is no damping.
    fn modes<const N: usize>([m, c, k]: [SMatrix<f64, N, N>; 3]) -> std::vec::Vec<Mode<N>> {
        let mut linear = Linearised::<N, 0, 0>::zeros();
        linear.by_efforts = m.try_inverse().expect("a mass");
        linear.by_positions = -linear.by_efforts * k;
        linear.by_rates = -linear.by_efforts * c;
        let modes = linear.modes();
        let [m, c, k] = [m, c, k].map(|matrix| matrix.map(|entry| C::new(entry, 0.0)));
        let is_undamped = c.iter().all(|entry| *entry == C::new(0.0, 0.0));
        for (place, mode) in modes.iter().enumerate() {
            let (rate, shape) = (mode.rate, SVector::from(mode.shape));
            let left = (m * (rate * rate) + c * rate + k) * shape;
            let size = k.map(|entry| entry.modulus()).amax() + rate.modulus_squared();
            assert!(
                left.map(|entry| entry.modulus()).amax() <= 1e-12 * size,
                "{mode:?}"
            );
            let root = mode.mass.sqrt();
            for (number, other) in modes.iter().enumerate() {
                let product = (shape.adjoint() * m * SVector::from(other.shape))[0];
                let product = product / (root * other.mass.sqrt());
                let is_near = (rate - other.rate).modulus() < 1e-7 * rate.modulus();
                if place == number {
                    assert!((product - 1.0).modulus() < 1e-12, "{product}");
                } else if is_undamped && rate.re == 0.0 || is_near {
                    assert!(product.modulus() < 1e-7, "{mode:?} {other:?} {product}");
                }
            }
        }
        modes
    }

    fn diagonal<const N: usize>(entries: [f64; N]) -> SMatrix<f64, N, N> {
        SMatrix::from_diagonal(&entries.into())
    }

    /// What turns coordinates into others, none of which is any longer by itself.
    fn mixed<const N: usize>(matrix: SMatrix<f64, N, N>) -> SMatrix<f64, N, N> {
        let mix = SMatrix::<f64, N, N>::from_fn(|row, column| {
            let number = f64::from(u8::try_from(7 * row + 3 * column).unwrap_or(0));
            (number * number).sin() + if row == column { 2.0 } else { 0.0 }
        });
        mix.transpose() * matrix * mix
    }

    /// By `scipy.linalg.eigh` and `eig` of SciPy 1.17.1 (LAPACK), of three bodies that springs,
    /// dampers, gyroscopic terms and follower forces couple.
    #[test]
    fn three_bodies_as_by_lapack() {
        let m = Matrix3::new(2.0, 0.5, 0.25, 0.5, 3.0, 0.5, 0.25, 0.5, 1.5);
        let k = Matrix3::new(40.0, -10.0, -5.0, -10.0, 30.0, -8.0, -5.0, -8.0, 20.0);
        let c = Matrix3::new(1.0, -0.4, 0.1, -0.4, 0.9, 0.3, 0.1, 0.3, 0.7);
        let turning = Matrix3::new(0.0, 2.0, -1.0, -2.0, 0.0, 0.5, 1.0, -0.5, 0.0);
        let following = Matrix3::new(0.0, 3.0, -1.0, -3.0, 0.0, 2.0, 1.0, -2.0, 0.0);
        let none = Matrix3::zeros();
        let near = |found: &[Mode<3>], wanted: [(f64, f64); 3]| {
            assert_eq!(found.len(), 3);
            for (mode, (re, im)) in found.iter().zip(wanted) {
                assert!((mode.rate - C::new(re, im)).modulus() < 1e-12, "{mode:?}");
            }
        };
        let undamped = modes([m, none, k]);
        let wanted = [2.065813972808505, 4.503290435199279, 5.063480462845663];
        near(&undamped, wanted.map(|frequency| (0.0, frequency)));
        let are_real = undamped.iter().flat_map(|mode| mode.shape);
        assert!(are_real.into_iter().all(|entry| entry.im == 0.0));
        let damped = modes([m, c, k]);
        near(
            &damped,
            [
                (-0.15586401819439388, 2.0616820853304842),
                (-0.15627618420061473, 4.498745301826346),
                (-0.35723964256623164, 5.048626481864499),
            ],
        );
        let wanted = [
            C::new(0.5724913245271067, 0.0412669923435883),
            C::new(0.9899090719103391, 0.05401469405333058),
            C::new(1.0, 0.0),
        ];
        for (found, wanted) in damped[0].shape.into_iter().zip(wanted) {
            assert!((found - wanted).modulus() < 1e-12, "{found} {wanted}");
        }
        let frequencies = [2.060256528620687, 4.163410879130514, 5.491610601302744];
        near(&modes([m, turning, k]), frequencies.map(|rate| (0.0, rate)));
        let frequencies = [2.0730475770128836, 4.584603481463964, 4.986976155228477];
        let found = modes([m, none, k + following]);
        near(&found, frequencies.map(|rate| (0.0, rate)));
    }

    /// Two to four equal frequencies, and nearly equal ones, in any coordinates, with and without
    /// damping: as many independent shapes.
    #[test]
    fn equal_frequencies_have_shapes_of_their_own() {
        for apart in [0.0, 1e-13, 1e-8, 1e-4] {
            for equal in 2..5 {
                let squares: [f64; 6] = core::array::from_fn(|place| {
                    let number = f64::from(u8::try_from(place).unwrap_or(0));
                    if place < equal {
                        4.0 * (1.0 + apart * number)
                    } else {
                        1.0 + 3.0 * number
                    }
                });
                let m = mixed(diagonal([1.0; 6]));
                let k = mixed(diagonal(squares));
                for damping in [0.0, 0.1] {
                    let found = modes([m, m * damping, k]);
                    let same = |mode: &&Mode<6>| (mode.rate.modulus() - 2.0).abs() < 1e-3;
                    assert_eq!((found.len(), found.iter().filter(same).count()), (6, equal));
                }
            }
        }
        // Of other damping in every direction, twice the same.
        let twice = |matrix: Matrix3<f64>| {
            let both = SMatrix::<f64, 6, 6>::from_fn(|row, column| {
                let is_one = row / 3 == column / 3;
                if is_one {
                    matrix[(row % 3, column % 3)]
                } else {
                    0.0
                }
            });
            mixed(both)
        };
        let k = Matrix3::new(4.0, -1.0, 0.0, -1.0, 3.0, -1.0, 0.0, -1.0, 9.0);
        let c = Matrix3::new(0.3, -0.2, 0.0, -0.2, 0.4, 0.1, 0.0, 0.1, 0.1);
        let found = modes([twice(Matrix3::identity()), twice(c), twice(k)]);
        assert_eq!(found.len(), 6);
        assert!(found.iter().all(|mode| mode.multiplicity == 2));
    }

    /// What no force brings back, critical damping, gyroscopic and follower forces.
    #[test]
    fn rates_with_fewer_shapes_say_so() {
        let one = Matrix2::identity();
        let none = Matrix2::zeros();
        let pair = Matrix2::new(4.0, -4.0, -4.0, 4.0);
        let turning = Matrix2::new(0.0, 1.0, -1.0, 0.0);
        let told = |modes: &[Mode<2>]| {
            let told = modes.iter().map(|mode| (mode.rate, mode.multiplicity));
            told.collect::<std::vec::Vec<_>>()
        };
        let near = |found: &[(C, usize)], wanted: &[(f64, f64, usize)]| {
            assert_eq!(found.len(), wanted.len(), "{found:?}");
            for ((rate, count), &(re, im, wanted)) in found.iter().zip(wanted) {
                assert!((rate - C::new(re, im)).modulus() < 1e-13, "{found:?}");
                assert_eq!(*count, wanted, "{found:?}");
            }
        };
        let root = 8.0_f64.sqrt();
        near(
            &told(&modes([one, none, pair])),
            &[(0.0, 0.0, 2), (0.0, root, 1)],
        );
        near(
            &told(&modes([one, pair * 0.25, pair])),
            &[(0.0, 0.0, 2), (-1.0, 7.0_f64.sqrt(), 1)],
        );
        near(
            &told(&modes([one, none, none])),
            &[(0.0, 0.0, 4), (0.0, 0.0, 4)],
        );
        near(
            &told(&modes([one, one * 4.0, one * 4.0])),
            &[(-2.0, 0.0, 4), (-2.0, 0.0, 4)],
        );
        near(
            &told(&modes([one, turning, none])),
            &[(0.0, 0.0, 2), (0.0, 0.0, 2), (0.0, 1.0, 1)],
        );
        // A follower force that leads from one coordinate to another of the same frequency.
        let led = Matrix2::new(4.0, 1.0, 0.0, 4.0);
        near(&told(&modes([one, none, led])), &[(0.0, 2.0, 2)]);
        near(
            &told(&modes([one, none, diagonal([-4.0, 9.0])])),
            &[(-2.0, 0.0, 1), (2.0, 0.0, 1), (0.0, 3.0, 1)],
        );
        let critical = modes([Matrix1::new(1.0), Matrix1::new(4.0), Matrix1::new(4.0)]);
        assert_eq!((critical.len(), critical[0].multiplicity), (1, 2));
        assert_eq!(critical[0].shape, [Complex::new(1.0, 0.0)]);
    }
}
