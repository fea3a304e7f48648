//! Backward differentiation of variable order and step, for stiff systems.

use core::mem::replace;

use super::controlled::controlled;
use super::controller::{Controller, FIRST_SHARE};
use super::jacobian::Jacobian;
use super::linear::Factors;
use super::newton::{Age, Newton, Progress};
use super::record::{Reached, reached};
use super::{Advance, Counts, Integration, Memory, Slopes, System, TimeSpan, named};
use crate::error::{Fault, StepFault};
use crate::math::scalar::Real;
use crate::math::without_bounds::opaque;
use crate::state::vector::Vector;

controlled! {
    /// Gear's method: numerical differentiation formulas of order 1 to 5 with step control, for
    /// stiff systems that are smooth: one evaluation for each iteration of a step, where
    /// [`RadauIIA`](super::RadauIIA) takes three and its steps are longer.
    ///
    /// The formulas in backward differences, their coefficients and the choice of order and step
    /// after Shampine and Reichelt, *The MATLAB ODE Suite*, SIAM J. Sci. Comput. 18 (1997), 1-22
    /// (`ode15s`), a simplified Newton iteration with a Jacobian that is kept as long as it
    /// converges ([`System::jacobian`]). A step keeps its size until there are as many of them as
    /// the order and one more. Between steps the polynomial through the last states is read.
    ///
    /// Orders above 2 are not stable on the imaginary axis: a motion that oscillates without a loss
    /// makes steps short; [`RadauIIA`](super::RadauIIA) is for those. A run begins with order 1,
    /// and so it does after a break: not for short runs. Memory is two matrices of the size of the
    /// state and eight states.
    ///
    /// ```
    /// use holonom::{Bdf, Fault, integrate::{Advance, Integration, Integrator, TimeSpan, System}};
    ///
    /// /// Follows the cosine, and comes back to it within microseconds.
    /// struct Stiff;
    ///
    /// impl System<f64> for Stiff {
    ///     type State = [f64; 1];
    ///     fn rates(&mut self, time: f64, state: &[f64; 1]) -> Result<[f64; 1], Fault> {
    ///         Ok([-1e6 * (state[0] - time.cos()) - time.sin()])
    ///     }
    /// }
    ///
    /// let span = TimeSpan { start: 0.0, end: 10.0, first_output: 10.0 };
    /// let mut integration = Bdf::default().start(&mut Stiff, span, [1.5])?;
    /// while integration.time() < 10.0 {
    ///     integration.advance(&mut Stiff)?;
    /// }
    /// assert!((integration.state()[0] - 10.0_f64.cos()).abs() < 1e-5);
    /// assert!(integration.counts().evaluations < 500);
    /// # Ok::<(), Fault>(())
    /// ```
    Bdf, BdfIntegration
}

/// The highest order.
const HIGHEST: usize = 5;

/// How many backward differences are kept: those of the highest order, and two that tell its error
/// and that of the next one.
const DIFFERENCES: usize = HIGHEST + 2;

/// What the formulas of order 1 to 5 add to Gear's for the sake of accuracy (Shampine and Reichelt,
/// table 1).
const KAPPA: [f64; HIGHEST + 1] = [0.0, -0.185, -1.0 / 9.0, -0.0823, -0.0415, 0.0];

/// The sums of `1 / j` up to an order.
const GAMMA: [f64; HIGHEST + 1] = [0.0, 1.0, 3.0 / 2.0, 11.0 / 6.0, 25.0 / 12.0, 137.0 / 60.0];

/// Iterations of Newton's method in a step, at most.
const ITERATIONS: i32 = 4;

/// What the change of the highest difference in a step of this order says of its error.
fn error_constant<S: Real>(order: usize) -> S {
    S::constant(KAPPA[order] * GAMMA[order] + 1.0 / (order + 1) as f64)
}

/// The leading coefficient of the formula of an order.
fn leading(order: usize) -> f64 {
    (1.0 - KAPPA[order]) * GAMMA[order]
}

/// An integration with [`Bdf`] under way.
#[derive(Clone)]
pub struct BdfIntegration<S: Real, X: Vector<S>> {
    controller: Controller<S>,
    /// The iteration of a step before its first change.
    newton: Newton<S>,
    /// The size of the next step, which the differences are for.
    step: S,
    order: usize,
    /// Steps of this size and order so far.
    equal: usize,
    /// Its slope is that at the start, and then that of a Jacobian.
    reached: Reached<S, X>,
    /// The backward differences of the state, from the first: increments.
    differences: [X; DIFFERENCES],
    jacobian: Jacobian<S, X>,
    age: Age,
    factors: Factors<S, X, X>,
    /// The shift `alpha / h` that the factors are for.
    factorised: Option<S>,
}

opaque!([S: Real, X: Vector<S>] BdfIntegration<S, X>, "BdfIntegration");

/// A step that converged.
struct Trial<S, X> {
    newton: Newton<S>,
    state: X,
    /// What the highest difference changes by.
    change: X,
    /// Relative to what is allowed.
    error: S,
}

impl<S: Real, X: Vector<S>> BdfIntegration<S, X> {
    fn start<Y: System<S, State = X>>(
        method: &Bdf<S>,
        system: &mut Y,
        span: TimeSpan<S>,
        state: X,
    ) -> Result<Self, Fault> {
        /// Of the estimate of order 1.
        const POWER: f64 = 2.0;
        let Bdf { tolerance, limits } = method;
        let controller = Controller::new(*tolerance, limits, POWER, &span)?;
        let reached = Reached::start(system, &span, state)?;
        let Reached { state, slope, .. } = &reached;
        let step = controller.first(&span, state, slope, FIRST_SHARE);
        let nothing = slope.zip(slope, |_, _| S::zero());
        let mut differences = [(); DIFFERENCES].map(|()| nothing.clone());
        differences[0] = slope.zip(slope, |x, _| step * x);
        Ok(Self {
            newton: Newton::new(controller.relative, ITERATIONS),
            step,
            order: 1,
            equal: 0,
            jacobian: Jacobian::new(&nothing),
            age: Age::Unknown,
            factors: Factors::new(&nothing),
            factorised: None,
            reached,
            differences,
            controller,
        })
    }

    /// A sum of the differences from the first on.
    fn combined(&self, weights: impl IntoIterator<Item = S>) -> X {
        let [first, ..] = &self.differences;
        let nothing = first.zip(first, |_, _| S::zero());
        let terms = self.differences.iter().zip(weights);
        terms.fold(nothing, |sum, (difference, weight)| {
            sum.zip(difference, |sum, x| x.fused(weight, sum))
        })
    }

    /// Makes the differences be those of steps of another size: the polynomial through the states
    /// stays, of the present order.
    fn resize(&mut self, step: S) {
        if step == self.step {
            return;
        }
        let new = interpolation::<S>(step.quotient(self.step));
        let unit = interpolation::<S>(S::one());
        let before = self.differences.clone();
        for (column, difference) in self.differences.iter_mut().enumerate().take(self.order) {
            let mut sum = difference.zip(difference, |_, _| S::zero());
            for (row, old) in before.iter().enumerate().take(self.order) {
                let terms = new[row].iter().zip(&unit).take(self.order);
                let weight = terms.fold(S::zero(), |sum, (&r, u)| r.fused(u[column], sum));
                sum = sum.zip(old, |sum, x| x.fused(weight, sum));
            }
            *difference = sum;
        }
        self.step = step;
        self.equal = 0;
    }

    /// An increment, relative to what is allowed.
    fn size(&self, to: &X, increment: &X) -> S {
        let floor = self.controller.floor;
        let norm = self
            .reached
            .state
            .weighted_norm(to, floor, [(S::one(), increment)]);
        norm.quotient(self.controller.relative)
    }

    /// Where the differences lead.
    fn predicted(&self) -> X {
        self.combined([S::one(); DIFFERENCES].into_iter().take(self.order))
    }

    /// Solves for a step. `None` where the iteration does not converge, or leaves the numbers.
    fn attempt<Y: System<S, State = X>>(
        &self,
        system: &mut Y,
        end: S,
    ) -> Result<Option<Trial<S, X>>, Fault> {
        let shift = S::constant(leading(self.order)).quotient(self.step);
        let predicted = self.predicted();
        let history = GAMMA.iter().skip(1).take(self.order);
        let history =
            self.combined(history.map(|&gamma| S::constant(gamma / leading(self.order)) * shift));
        let mut change = predicted.zip(&predicted, |_, _| S::zero());
        let mut state = self.reached.state.plus([(S::one(), &predicted)]);
        let mut newton = self.newton;
        loop {
            let mut slope = change.clone();
            system.stage(end, &state, &mut slope)?;
            let right = slope.zip(&history, |f, psi| f - psi);
            let mut more = right.zip(&change, |x, change| change.fused(-shift, x));
            self.factors.solve(&mut more, &self.jacobian);
            let progress = newton.take(self.size(&state, &more));
            if progress == Progress::Fails {
                return Ok(None);
            }
            change = change.zip(&more, |x, more| x + more);
            let whole = predicted.zip(&change, |x, change| x + change);
            state = self.reached.state.plus([(S::one(), &whole)]);
            if progress == Progress::Converged {
                let error = error_constant::<S>(self.order) * self.size(&state, &change);
                let is_finite = error.is_finite() && state.is_finite();
                return Ok(is_finite.then_some(Trial {
                    newton,
                    state,
                    change,
                    error,
                }));
            }
        }
    }

    /// Makes Jacobian and factors be those that the step needs. `false` if there are none.
    fn prepare<Y: System<S, State = X>>(&mut self, system: &mut Y, end: S) -> Result<bool, Fault> {
        if self.age == Age::Unknown {
            let predicted = self.reached.state.plus([(S::one(), &self.predicted())]);
            let slope = &mut self.reached.slope;
            let mut counted = Slopes::counted(system, &mut self.reached.counts);
            counted.stage(end, &predicted, slope)?;
            self.factorised = None;
            let at = (&predicted, &*slope);
            self.jacobian.evaluate(&mut counted, end, at)?;
            self.age = Age::Present;
        }
        let shift = S::constant(leading(self.order)).quotient(self.step);
        if self.factorised != Some(shift) {
            let [like, ..] = &self.differences;
            let exists = self.factors.factorise(shift, &self.jacobian, like);
            self.factorised = exists.then_some(shift);
        }
        Ok(self.factorised.is_some())
    }

    /// Why a step led nowhere, if its rates are the reason.
    #[cold]
    #[inline(never)]
    fn refused<Y: System<S, State = X>>(
        &self,
        system: &mut Y,
        end: S,
        fault: Option<Fault>,
    ) -> Option<Fault> {
        named(fault, system, |system| self.attempt(system, end))
    }

    fn accept<Y: System<S, State = X>>(&mut self, system: &mut Y, end: S, trial: Trial<S, X>) {
        let Trial {
            newton,
            mut state,
            change,
            ..
        } = trial;
        let order = self.order;
        let size = end - self.reached.time;
        system.renormalise(&mut state, None);
        system.follow(&self.reached.state, size, &mut state);
        self.reached.counts.accepted += 1;
        self.reached.estimate = Some(trial.error * self.controller.relative);
        self.age = Age::Former;
        self.reached.time = end;
        self.reached.state = state;
        let highest = replace(&mut self.differences[order], change);
        self.differences[order + 1] = self.differences[order].zip(&highest, |new, old| new - old);
        for lower in (0..order).rev() {
            self.differences[lower] =
                self.differences[lower].zip(&self.differences[lower + 1], |x, y| x + y);
        }
        self.equal += 1;
        if self.equal <= order {
            return;
        }
        // By how much the next step may be longer at an order: the order of the longest is taken.
        let longer = |order: usize| {
            let size = self.size(&self.reached.state, &self.differences[order]);
            let exponent = -1.0 / (order + 1) as f64;
            (error_constant::<S>(order) * size).powf(exponent)
        };
        let mut best = (order, longer(order));
        for other in [order - 1, order + 1] {
            if (1..=HIGHEST).contains(&other) && longer(other) > best.1 {
                best = (other, longer(other));
            }
        }
        let (order, factor) = best;
        // Infinite where an error is zero.
        let factor = (newton.safety() * factor).min(S::constant(10.0));
        self.order = order;
        self.resize(self.step * factor);
        self.equal = 0;
    }
}

/// The values of the polynomials of backward differences at steps of another size, by rows from
/// order 1 (Shampine and Reichelt, 2.2).
fn interpolation<S: Real>(factor: S) -> [[S; HIGHEST]; HIGHEST] {
    let mut matrix = [[S::zero(); HIGHEST]; HIGHEST];
    let mut above = [S::one(); HIGHEST];
    for (row, line) in (1_u8..).zip(&mut matrix) {
        for (column, (element, above)) in (1_u8..).zip(line.iter_mut().zip(&mut above)) {
            let distance = S::constant(f64::from(row - 1)) - factor * S::constant(column.into());
            *above = *above * distance.quotient(S::constant(row.into()));
            *element = *above;
        }
    }
    matrix
}

impl<S: Real, X: Vector<S>> Integration<S, X> for BdfIntegration<S, X> {
    // Where a state is replaced, those before are moved along: their differences stay.
    reached!();

    // Factors follow from the Jacobian and the shift.
    fn remember(&mut self, memory: &mut Memory<'_, S>) -> bool {
        self.reached.remember(memory);
        memory.number(&mut self.step);
        memory.count(&mut self.order);
        memory.count(&mut self.equal);
        for difference in &mut self.differences {
            memory.vector(difference);
        }
        self.age.remember(memory);
        self.jacobian.remember(memory, &self.reached.state);
        self.factorised = None;
        // A file may hold any number.
        self.order = self.order.clamp(1, HIGHEST);
        true
    }
}

impl<S: Real, Y: System<S>> Advance<S, Y> for BdfIntegration<S, Y::State> {
    fn advance(&mut self, system: &mut Y) -> Result<(), Fault> {
        let time = self.reached.time;
        let smallest = self.controller.smallest(time);
        let remaining = self.controller.remaining(time);
        self.resize(self.controller.limited(time, self.step));
        let mut stretched = S::constant(1.0 + 1e-6) * self.step >= remaining;
        if stretched {
            self.resize(remaining);
        }
        loop {
            let end = self.controller.end_of(time, self.step, stretched);
            let outcome = match self.prepare(system, end) {
                Ok(true) => {
                    let mut counts = self.reached.counts;
                    let mut counted = Slopes::counted(system, &mut counts);
                    let outcome = self.attempt(&mut counted, end);
                    self.reached.counts = counts;
                    outcome
                }
                Ok(false) => Ok(None),
                Err(fault) => Err(fault),
            };
            let (fault, factor) = match outcome {
                Ok(Some(trial)) if trial.error <= S::one() => {
                    self.accept(system, end, trial);
                    return Ok(());
                }
                Ok(Some(trial)) => {
                    let exponent = -1.0 / (self.order + 1) as f64;
                    let factor = trial.newton.safety() * trial.error.powf(exponent);
                    (None, factor.max(S::constant(0.2)).min(S::constant(0.9)))
                }
                // A Jacobian of a former state may be the reason.
                Ok(None) | Err(Fault::Step(StepFault::StateNotFinite))
                    if self.age == Age::Former =>
                {
                    self.age = Age::Unknown;
                    continue;
                }
                outcome => {
                    // That of a place that a shorter step does not reach.
                    self.age = Age::Unknown;
                    (outcome.err(), S::constant(0.5))
                }
            };
            self.reached.counts.rejected += 1;
            if self.step <= smallest {
                let step = self.step;
                let named = self.refused(system, end, fault);
                return Err(named
                    .or(fault)
                    .unwrap_or_else(|| self.controller.underflow(step, time)));
            }
            self.resize(smallest.max(factor * self.step));
            stretched = false;
        }
    }

    fn at(&mut self, _system: &mut Y, time: S) -> Result<Y::State, Fault> {
        let mut power = S::one();
        let weights = (0..self.order).map(|k| {
            let steps = S::constant(k as f64);
            let distance = (time - self.reached.time).quotient(self.step) + steps;
            power = power * distance.quotient(steps + S::one());
            power
        });
        let increment = self.combined(weights);
        Ok(self.reached.state.plus([(S::one(), &increment)]))
    }
}
