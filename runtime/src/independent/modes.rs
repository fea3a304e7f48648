//! Natural motions of a linearised mechanism.

use nalgebra::{Complex, ComplexField, DMatrix, DVector, Schur};

use super::linearised::Linearised;
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

impl<const N: usize, const K: usize, const P: usize, S: Real> Linearised<N, K, P, S> {
    /// The natural motions, slowest first: eigenvalues of `A` in double precision (Schur's form)
    /// and their vectors by inverse iteration. Of eigenvalues that are equal the vectors may be,
    /// too. Without elements where the iteration does not converge.
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
    pub fn modes(&self) -> std::vec::Vec<Mode<N>> {
        /// Far more than an eigenvalue takes.
        const ITERATIONS: usize = 10_000;
        if N == 0 {
            return std::vec::Vec::new();
        }
        let a = DMatrix::from_fn(2 * N, 2 * N, |row, column| self.of_a(row, column).to_f64());
        let Some(schur) = Schur::try_new(a.clone(), f64::EPSILON, ITERATIONS) else {
            return std::vec::Vec::new();
        };
        let size = a.amax();
        let rates = schur.complex_eigenvalues();
        let mut modes: std::vec::Vec<Mode<N>> = rates
            .iter()
            .filter(|rate| rate.im >= 0.0)
            .map(|&rate| Mode {
                rate,
                shape: shape(&a, rate, size),
            })
            .collect();
        modes.sort_by(|a, b| a.rate.modulus().total_cmp(&b.rate.modulus()));
        modes
    }
}

/// The coordinates of an eigenvector.
fn shape<const N: usize>(a: &DMatrix<f64>, rate: Complex<f64>, size: f64) -> [Complex<f64>; N] {
    // Off the eigenvalue by a little, where the matrix is regular.
    let off = rate + Complex::new(size, size) * (4.0 * f64::EPSILON);
    let shifted = DMatrix::from_fn(2 * N, 2 * N, |row, column| {
        let diagonal = if row == column { off } else { Complex::ZERO };
        Complex::new(a[(row, column)], 0.0) - diagonal
    });
    let factors = shifted.lu();
    // In no direction that a mechanism prefers.
    let start = |place: usize| Complex::new(1.0 + 0.37 * place as f64, 0.21 * place as f64);
    let mut vector = DVector::from_fn(2 * N, |place, _| start(place));
    for _ in 0..3 {
        let Some(next) = factors.solve(&vector) else {
            break;
        };
        let most = next.iter().map(|entry| entry.modulus()).fold(0.0, f64::max);
        vector = next.map(|entry| entry / most);
    }
    let coordinates: [Complex<f64>; N] =
        core::array::from_fn(|place| vector.get(place).copied().unwrap_or(Complex::ZERO));
    let by_size = |a: &&Complex<f64>, b: &&Complex<f64>| a.modulus().total_cmp(&b.modulus());
    let largest = coordinates.iter().max_by(by_size).copied();
    let largest = largest.filter(|largest| largest.modulus() > 0.0);
    largest.map_or(coordinates, |largest| {
        coordinates.map(|entry| entry / largest)
    })
}
