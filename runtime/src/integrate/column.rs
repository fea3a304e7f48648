//! Columns of real and of complex numbers, of which implicit methods make matrices.
//!
//! Functions are parts of their callers, which know how long a slice is: with that and with what
//! else `docs/decisions/010-matrices-by-columns.md` says, solutions took half the time.

use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// A complex number: real and imaginary part.
pub(super) type Complex<S> = [S; 2];

/// A column of numbers, made of slopes `X`.
pub(super) trait Column<S: Real, X: Vector<S>>: Clone {
    type Number: Copy;

    /// A column of real numbers.
    fn real(column: X) -> Self;
    /// A column of real numbers of the same length.
    fn like(&self) -> &X;
    fn at(&self, row: usize) -> Self::Number;
    fn set(&mut self, row: usize, value: Self::Number);
    /// `self + factor * other`.
    fn add(&mut self, factor: Self::Number, other: &Self);
    fn scale(&mut self, factor: Self::Number);
    /// The absolute value of a number, or up to 1.5 times that.
    fn size(of: Self::Number) -> S;
    fn zero() -> Self::Number;
    fn product(a: Self::Number, b: Self::Number) -> Self::Number;
    fn times(of: Self::Number, real: S) -> Self::Number;
    fn sum(a: Self::Number, b: Self::Number) -> Self::Number;
    fn inverse(of: Self::Number) -> Self::Number;
    fn negative(of: Self::Number) -> Self::Number;

    /// The number at a row behind the coordinates, see [`Vector::velocities_slice`].
    fn behind(&self, row: usize) -> Self::Number;
    fn set_behind(&mut self, row: usize, value: Self::Number);
    /// `self + factor * other` there, by a real column.
    fn add_real_behind(&mut self, factor: Self::Number, other: &X);
    /// The same of all rows.
    fn add_real(&mut self, factor: Self::Number, other: &X);
    /// `self + factor * other` behind the coordinates, where the factor is what stands at a row,
    /// and zero takes its place.
    fn eliminate_behind(&mut self, row: usize, other: &Self);
    fn scale_behind(&mut self, factor: Self::Number);
    /// Makes that part of a column be the negative of a real one.
    fn oppose_behind(&mut self, other: &X);
}

/// `to + factor * other`.
#[inline(always)]
fn add<S: Real>(to: &mut [S], factor: S, other: &[S]) {
    for (to, other) in to.iter_mut().zip(other) {
        *to = other.fused(factor, *to);
    }
}

/// The same, with zero in the place of the element of `to` at a row. That element is compared for,
/// as a store of it would be waited for by all others.
#[inline(always)]
fn add_apart<S: Real>(to: &mut [S], row: usize, factor: S, other: &[S]) {
    for (place, (to, other)) in to.iter_mut().zip(other).enumerate() {
        let kept = if place == row { S::zero() } else { *to };
        *to = other.fused(factor, kept);
    }
}

#[inline(always)]
fn oppose<S: Real>(to: &mut [S], other: &[S]) {
    for (to, &other) in to.iter_mut().zip(other) {
        *to = -other;
    }
}

/// The element of a slice; zero where there is none.
#[inline(always)]
fn element<S: Real>(of: &[S], row: usize) -> S {
    of.get(row).copied().unwrap_or(S::zero())
}

#[inline(always)]
fn set_element<S: Real>(of: &mut [S], row: usize, value: S) {
    if let Some(element) = of.get_mut(row) {
        *element = value;
    }
}

impl<S: Real, X: Vector<S>> Column<S, X> for X {
    type Number = S;

    #[inline(always)]
    fn real(column: X) -> X {
        column
    }

    #[inline(always)]
    fn like(&self) -> &X {
        self
    }

    #[inline(always)]
    fn at(&self, row: usize) -> S {
        self.element(row)
    }

    #[inline(always)]
    fn set(&mut self, row: usize, value: S) {
        self.set_element(row, value);
    }

    #[inline(always)]
    fn add(&mut self, factor: S, other: &X) {
        *self = self.zip(other, |x, y| y.fused(factor, x));
    }

    #[inline(always)]
    fn scale(&mut self, factor: S) {
        *self = self.zip(self, |x, _| factor * x);
    }

    #[inline(always)]
    fn size(of: S) -> S {
        of.abs()
    }

    #[inline(always)]
    fn zero() -> S {
        S::zero()
    }

    #[inline(always)]
    fn product(a: S, b: S) -> S {
        a * b
    }

    #[inline(always)]
    fn times(of: S, real: S) -> S {
        of * real
    }

    #[inline(always)]
    fn sum(a: S, b: S) -> S {
        a + b
    }

    #[inline(always)]
    fn inverse(of: S) -> S {
        of.reciprocal()
    }

    #[inline(always)]
    fn negative(of: S) -> S {
        -of
    }

    #[inline(always)]
    fn behind(&self, row: usize) -> S {
        element(self.velocities_slice(), row)
    }

    #[inline(always)]
    fn set_behind(&mut self, row: usize, value: S) {
        set_element(self.velocities_slice_mut(), row, value);
    }

    #[inline(always)]
    fn add_real_behind(&mut self, factor: S, other: &X) {
        add(
            self.velocities_slice_mut(),
            factor,
            other.velocities_slice(),
        );
    }

    #[inline(always)]
    fn add_real(&mut self, factor: S, other: &X) {
        self.add(factor, other);
    }

    #[inline(always)]
    fn eliminate_behind(&mut self, row: usize, other: &X) {
        let factor = self.behind(row);
        let (to, other) = (self.velocities_slice_mut(), other.velocities_slice());
        add_apart(to, row, factor, other);
    }

    #[inline(always)]
    fn scale_behind(&mut self, factor: S) {
        for x in self.velocities_slice_mut() {
            *x = factor * *x;
        }
    }

    #[inline(always)]
    fn oppose_behind(&mut self, other: &X) {
        oppose(self.velocities_slice_mut(), other.velocities_slice());
    }
}

/// A column of complex numbers: real and imaginary parts.
#[derive(Clone)]
pub(super) struct ComplexColumn<X> {
    pub(super) real: X,
    pub(super) imaginary: X,
}

impl<S: Real, X: Vector<S>> Column<S, X> for ComplexColumn<X> {
    type Number = Complex<S>;

    #[inline(always)]
    fn real(column: X) -> Self {
        Self {
            imaginary: column.zip(&column, |_, _| S::zero()),
            real: column,
        }
    }

    #[inline(always)]
    fn like(&self) -> &X {
        &self.real
    }

    #[inline(always)]
    fn at(&self, row: usize) -> Complex<S> {
        [self.real.element(row), self.imaginary.element(row)]
    }

    #[inline(always)]
    fn set(&mut self, row: usize, [real, imaginary]: Complex<S>) {
        self.real.set_element(row, real);
        self.imaginary.set_element(row, imaginary);
    }

    #[inline(always)]
    fn add(&mut self, [a, b]: Complex<S>, other: &Self) {
        let Self { real, imaginary } = other;
        self.real = self.real.zip(real, |x, y| y.fused(a, x));
        self.real = self.real.zip(imaginary, |x, y| y.fused(-b, x));
        self.imaginary = self.imaginary.zip(imaginary, |x, y| y.fused(a, x));
        self.imaginary = self.imaginary.zip(real, |x, y| y.fused(b, x));
    }

    #[inline(always)]
    fn scale(&mut self, [a, b]: Complex<S>) {
        let real = self.real.zip(&self.imaginary, |x, y| a * x - b * y);
        self.imaginary = self.imaginary.zip(&self.real, |y, x| a * y + b * x);
        self.real = real;
    }

    #[inline(always)]
    fn size([a, b]: Complex<S>) -> S {
        a.abs() + b.abs()
    }

    #[inline(always)]
    fn zero() -> Complex<S> {
        [S::zero(); 2]
    }

    #[inline(always)]
    fn product([a, b]: Complex<S>, [c, d]: Complex<S>) -> Complex<S> {
        [a.fused(c, -(b * d)), a.fused(d, b * c)]
    }

    #[inline(always)]
    fn times([a, b]: Complex<S>, real: S) -> Complex<S> {
        [a * real, b * real]
    }

    #[inline(always)]
    fn sum([a, b]: Complex<S>, [c, d]: Complex<S>) -> Complex<S> {
        [a + c, b + d]
    }

    #[inline(always)]
    fn inverse([a, b]: Complex<S>) -> Complex<S> {
        let square = a.fused(a, b * b);
        [a.quotient(square), (-b).quotient(square)]
    }

    #[inline(always)]
    fn negative([a, b]: Complex<S>) -> Complex<S> {
        [-a, -b]
    }

    #[inline(always)]
    fn behind(&self, row: usize) -> Complex<S> {
        let parts = [&self.real, &self.imaginary];
        parts.map(|part| element(part.velocities_slice(), row))
    }

    #[inline(always)]
    fn set_behind(&mut self, row: usize, [real, imaginary]: Complex<S>) {
        set_element(self.real.velocities_slice_mut(), row, real);
        set_element(self.imaginary.velocities_slice_mut(), row, imaginary);
    }

    #[inline(always)]
    fn add_real_behind(&mut self, [a, b]: Complex<S>, other: &X) {
        let other = other.velocities_slice();
        add(self.real.velocities_slice_mut(), a, other);
        add(self.imaginary.velocities_slice_mut(), b, other);
    }

    #[inline(always)]
    fn add_real(&mut self, [a, b]: Complex<S>, other: &X) {
        self.real.add(a, other);
        self.imaginary.add(b, other);
    }

    #[inline(always)]
    fn eliminate_behind(&mut self, row: usize, other: &Self) {
        let [a, b] = self.behind(row);
        let [x, y] = [&other.real, &other.imaginary].map(Vector::velocities_slice);
        let real = self.real.velocities_slice_mut();
        add_apart(real, row, a, x);
        add(real, -b, y);
        let imaginary = self.imaginary.velocities_slice_mut();
        add_apart(imaginary, row, a, y);
        add(imaginary, b, x);
    }

    #[inline(always)]
    fn scale_behind(&mut self, [a, b]: Complex<S>) {
        let real = self.real.velocities_slice_mut().iter_mut();
        for (x, y) in real.zip(self.imaginary.velocities_slice_mut()) {
            [*x, *y] = [a * *x - b * *y, a * *y + b * *x];
        }
    }

    #[inline(always)]
    fn oppose_behind(&mut self, other: &X) {
        oppose(self.real.velocities_slice_mut(), other.velocities_slice());
        for y in self.imaginary.velocities_slice_mut() {
            *y = S::zero();
        }
    }
}
