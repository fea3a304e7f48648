//! The coefficients of the formulas of Adams on times that are not equally spaced, with the letters
//! of Shampine and Gordon, *Computer Solution of Ordinary Differential Equations* (1975), chapter 5
//! and subroutines STEP and INTRP.

use core::ops::{Index, IndexMut};

use crate::integrate::Memory;
use crate::math::scalar::Real;

/// The highest order of a predictor.
pub(super) const HIGHEST: usize = 12;

/// Numbered from 1, as in the book; place 0 is not used.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row<T>([T; ROW]);

/// More than [`HIGHEST`] and two. A power of two, so that a place is always one of the row.
const ROW: usize = 16;

impl<T> Row<T> {
    pub(super) fn of(value: &T) -> Self
    where
        T: Clone,
    {
        Self(core::array::from_fn(|_| value.clone()))
    }

    /// Visits the places, in order.
    pub(super) fn each(&mut self, visit: impl FnMut(&mut T)) {
        self.0.iter_mut().for_each(visit);
    }
}

impl<T> Index<usize> for Row<T> {
    type Output = T;

    #[inline(always)]
    fn index(&self, place: usize) -> &T {
        &self.0[place % ROW]
    }
}

impl<T> IndexMut<usize> for Row<T> {
    #[inline(always)]
    fn index_mut(&mut self, place: usize) -> &mut T {
        &mut self.0[place % ROW]
    }
}

/// The coefficients of a step, and what those of the next one are made of.
#[derive(Clone, Debug)]
pub(super) struct Coefficients<S> {
    /// `h / psi_i`.
    alpha: Row<S>,
    /// What takes the differences of the last step to the spacing of this one.
    pub(super) beta: Row<S>,
    /// The time from the end of the step back to the start of the `i`-th before it, itself counted.
    psi: Row<S>,
    /// What the error of an order is multiplied by because steps are not equal.
    pub(super) sigma: Row<S>,
    /// The weights of the differences in a predictor.
    pub(super) g: Row<S>,
    v: Row<S>,
    w: Row<S>,
    /// `ns`: steps of this size one after the other, this one counted, as far as they matter.
    pub(super) equal: usize,
    /// The last accepted step and its order; zero before the first.
    pub(super) last_step: S,
    pub(super) last_order: usize,
}

impl<S: Real> Coefficients<S> {
    pub(super) fn new() -> Self {
        let zeros = Row::of(&S::zero());
        let mut sigma = zeros;
        sigma[1] = S::one();
        let mut g = sigma;
        g[2] = S::constant(0.5);
        Self {
            alpha: zeros,
            beta: zeros,
            psi: zeros,
            sigma,
            g,
            v: zeros,
            w: zeros,
            equal: 0,
            last_step: S::zero(),
            last_order: 0,
        }
    }

    /// Makes the coefficients of a step of this size and order: block 1 of STEP. Nothing changes
    /// while equal steps outnumber the order.
    pub(super) fn prepare(&mut self, step: S, order: usize) {
        if step != self.last_step {
            self.equal = 0;
        }
        if self.equal <= self.last_order {
            self.equal += 1;
        }
        let equal = self.equal;
        if order < equal {
            return;
        }
        self.beta[equal] = S::one();
        self.alpha[equal] = whole::<S>(equal).reciprocal();
        self.sigma[equal + 1] = S::one();
        let mut reach = step * whole(equal);
        for i in equal + 1..=order {
            let before = self.psi[i - 1];
            self.psi[i - 1] = reach;
            self.beta[i] = self.beta[i - 1] * reach.quotient(before);
            reach = before + step;
            self.alpha[i] = step.quotient(reach);
            self.sigma[i + 1] = whole::<S>(i) * self.alpha[i] * self.sigma[i];
        }
        self.psi[order] = reach;
        self.weigh(order);
    }

    /// Makes `g` from the integrals `v` and `w`.
    fn weigh(&mut self, order: usize) {
        let equal = self.equal;
        if equal == 1 {
            for i in 1..=order {
                self.v[i] = whole::<S>(i * (i + 1)).reciprocal();
            }
            self.w = self.v;
        } else {
            if order > self.last_order {
                self.v[order] = whole::<S>(order * (order + 1)).reciprocal();
                for j in 1..equal - 1 {
                    let above = self.alpha[j + 1] * self.v[order - j + 1];
                    self.v[order - j] = self.v[order - j] - above;
                }
            }
            for i in 1..=order + 1 - equal {
                self.v[i] = self.v[i] - self.alpha[equal] * self.v[i + 1];
                self.w[i] = self.v[i];
            }
            self.g[equal + 1] = self.w[1];
        }
        for i in equal + 2..=order + 1 {
            for j in 1..=order + 2 - i {
                self.w[j] = self.w[j] - self.alpha[i - 1] * self.w[j + 1];
            }
            self.g[i] = self.w[1];
        }
    }

    /// Takes a step back that was rejected: block 3 of STEP.
    pub(super) fn take_back(&mut self, step: S, order: usize) {
        for i in 2..=order {
            self.psi[i - 1] = self.psi[i] - step;
        }
    }

    /// Its part of [`Integration::remember`](crate::integrate::Integration::remember).
    pub(super) fn remember(&mut self, memory: &mut Memory<'_, S>) {
        let Self {
            alpha,
            beta,
            psi,
            sigma,
            g,
            v,
            w,
            equal,
            last_step,
            last_order,
        } = self;
        for row in [alpha, beta, psi, sigma, g, v, w] {
            row.each(|number| memory.number(number));
        }
        memory.count(equal);
        memory.number(last_step);
        memory.count(last_order);
        // A file may hold any number.
        *equal = (*equal).min(HIGHEST + 1);
        *last_order = (*last_order).min(HIGHEST);
    }

    /// The weights of the differences at a time from the end of the last step, negative within it:
    /// INTRP.
    pub(super) fn within(&self, time: S) -> Row<S> {
        let terms = self.last_order + 1;
        let mut w = Row::of(&S::zero());
        for i in 1..=terms {
            w[i] = whole::<S>(i).reciprocal();
        }
        let mut g = Row::of(&S::one());
        let mut reach = S::zero();
        for j in 2..=terms {
            let gamma = (time + reach).quotient(self.psi[j - 1]);
            let eta = time.quotient(self.psi[j - 1]);
            for i in 1..=terms + 1 - j {
                w[i] = gamma * w[i] - eta * w[i + 1];
            }
            g[j] = w[1];
            reach = self.psi[j - 1];
        }
        g
    }
}

fn whole<S: Real>(number: usize) -> S {
    S::constant(number as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of equal steps, the weights are those of Bashforth: Hairer, Norsett and Wanner, *Solving
    /// Ordinary Differential Equations I*, table III.1.1.
    #[test]
    fn equal_steps_have_the_weights_of_bashforth() {
        let mut coefficients = Coefficients::new();
        for step in 1..40 {
            let order = usize::min(step, 8);
            coefficients.prepare(0.25, order);
            (coefficients.last_step, coefficients.last_order) = (0.25, order);
        }
        let known = [
            1.0,
            0.5,
            5.0 / 12.0,
            3.0 / 8.0,
            251.0 / 720.0,
            95.0 / 288.0,
            19087.0 / 60480.0,
            5257.0 / 17280.0,
            1070017.0 / 3628800.0,
        ];
        for (place, known) in known.into_iter().enumerate() {
            let g: f64 = coefficients.g[place + 1];
            assert!((g - known).abs() < 1e-14, "{place}: {g} {known}");
            assert_eq!(coefficients.sigma[place + 1], 1.0);
        }
        assert_eq!(coefficients.psi[8], 2.0);
    }

    #[test]
    fn a_step_that_is_taken_back_leaves_no_trace() {
        let accept = |c: &mut Coefficients<f64>, step, order| {
            c.prepare(step, order);
            (c.last_step, c.last_order) = (step, order);
        };
        let steps = [(0.1, 1), (0.2, 2), (0.4, 3), (0.3, 4), (0.3, 4), (0.3, 5)];
        let [mut straight, mut troubled] = [Coefficients::new(), Coefficients::new()];
        for (step, order) in steps {
            accept(&mut straight, step, order);
            for tried in [4.0, 2.0] {
                troubled.prepare(tried * step, order);
                troubled.take_back(tried * step, order);
            }
            accept(&mut troubled, step, order);
            for place in 1..=order + 1 {
                for (a, b) in [
                    (straight.g[place], troubled.g[place]),
                    (straight.sigma[place], troubled.sigma[place]),
                ] {
                    assert!((a - b).abs() < 1e-14, "{step} {order} {place}: {a} {b}");
                }
            }
        }
    }
}
