//! Radau IIA of order 5: an implicit Runge-Kutta method for stiff systems.

use core::mem::{replace, swap};

use super::column::ComplexColumn;
use super::controlled::controlled;
use super::controller::{Controller, FIRST_SHARE};
use super::jacobian::Jacobian;
use super::linear::Factors;
use super::newton::{Age, Newton, Progress};
use super::record::{Reached, reached};
use super::tableau_radau as tableau;
use super::{Advance, Counts, Integration, Memory, Slopes, System, TimeSpan, Tolerance, named};
use crate::error::Fault;
use crate::error::setting::positive;
use crate::math::scalar::Real;
use crate::math::without_bounds::opaque;
use crate::state::sums::greater;
use crate::state::vector::Vector;

controlled! {
    /// Radau IIA of order 5 with step control: for stiff systems, whose fast motions have died out
    /// and still keep an explicit method at short steps.
    ///
    /// A method of collocation with three stages, stiffly accurate and L-stable, after `RADAU5`
    /// (Hairer and Wanner, *Solving Ordinary Differential Equations II*, IV.8): a simplified Newton
    /// iteration, one real and one complex system of linear equations of the size of the state, a
    /// Jacobian that is kept as long as the iteration converges fast ([`System::jacobian`]), and
    /// the step control of Gustafsson. Its estimate of the error is of order 3, which it holds to
    /// `0.1 rtol^(2/3)` for a tolerance `rtol` below 1e-3, so that the error is about the
    /// tolerance. A state within a step is that of a shorter step, so that it is as exact as those
    /// at ends.
    ///
    /// A step takes three evaluations for each iteration and one at its end; a Jacobian what
    /// [`System::jacobian`] counts; a state within a step, those of a shorter step. Memory is four
    /// matrices of the size of the state.
    ///
    /// ```
    /// use holonom::integrate::{Advance, Integration, Integrator, System, TimeSpan};
    /// use holonom::{Fault, RadauIIA};
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
    /// let mut integration = RadauIIA::default().start(&mut Stiff, span, [1.5])?;
    /// while integration.time() < 10.0 {
    ///     integration.advance(&mut Stiff)?;
    /// }
    /// assert!((integration.state()[0] - 10.0_f64.cos()).abs() < 1e-6);
    /// assert!(integration.counts().accepted < 100);
    /// # Ok::<(), Fault>(())
    /// ```
    RadauIIA, RadauIntegration, 1.5
}

/// Iterations of Newton's method in a step, at most.
const ITERATIONS: i32 = 6;

/// An integration with [`RadauIIA`] under way.
#[derive(Clone)]
pub struct RadauIntegration<S: Real, X: Vector<S>> {
    controller: Controller<S>,
    /// The iteration of a step before its first change.
    newton: Newton<S>,
    next_step: S,
    reached: Reached<S, X>,
    jacobian: Jacobian<S, X>,
    age: Age,
    real: Factors<S, X, X>,
    complex: Factors<S, X, ComplexColumn<X>>,
    /// The step that the factors are for.
    factorised: Option<S>,
    /// The last accepted step: its start, its size, its error, the increments to its stages.
    start: S,
    step: S,
    error: Option<S>,
    from: X,
    increments: [X; 3],
}

opaque!([S: Real, X: Vector<S>] RadauIntegration<S, X>, "RadauIntegration");

/// The coefficients of a row. Not by `map`, which is no part of its caller.
fn row<S: Real>([a, b, c]: [f64; 3]) -> [S; 3] {
    [S::constant(a), S::constant(b), S::constant(c)]
}

/// A matrix times a column of slopes.
fn product<S: Real, X: Vector<S>>([a, b, c]: [[f64; 3]; 3], slopes: &[X; 3]) -> [X; 3] {
    let [a, b, c] = [row(a), row(b), row(c)];
    [
        combined(a, slopes),
        combined(b, slopes),
        combined(c, slopes),
    ]
}

/// A sum of slopes.
fn combined<S: Real, X: Vector<S>>([a, b, c]: [S; 3], [x, y, z]: &[X; 3]) -> X {
    let sum = x.zip(y, |x, y| y.fused(b, a * x));
    sum.zip(z, |sum, z| z.fused(c, sum))
}

impl<S: Real, X: Vector<S>> RadauIntegration<S, X> {
    fn start<Y: System<S, State = X>>(
        method: &RadauIIA<S>,
        system: &mut Y,
        span: TimeSpan<S>,
        state: X,
    ) -> Result<Self, Fault> {
        let RadauIIA { tolerance, limits } = method;
        let relative = positive("relative tolerance", tolerance.relative)?;
        let absolute = positive("absolute tolerance", tolerance.absolute)?;
        // The estimate is that of order 3; that of order 5 is smaller by the power 3/2, which is
        // how `RADAU5` reads a tolerance.
        let estimated = relative.max(S::constant(0.1) * relative.powf(2.0 / 3.0));
        let tolerance = Tolerance {
            relative: estimated,
            absolute: absolute * estimated.quotient(relative),
        };
        let controller = Controller::new(tolerance, limits, tableau::POWER, &span)?;
        let reached = Reached::start(system, &span, state)?;
        let Reached { state, slope, .. } = &reached;
        let nothing = slope.zip(slope, |_, _| S::zero());
        Ok(Self {
            newton: Newton::new(controller.relative, ITERATIONS),
            next_step: controller.first(&span, state, slope, FIRST_SHARE),
            controller,
            jacobian: Jacobian::new(&nothing),
            age: Age::Unknown,
            real: Factors::new(&nothing),
            complex: Factors::new(&nothing),
            factorised: None,
            start: span.start,
            step: S::zero(),
            error: None,
            from: state.clone(),
            increments: [nothing.clone(), nothing.clone(), nothing],
            reached,
        })
    }

    /// What the polynomial of the last step adds to the state at its start, at a fraction of it,
    /// which may be beyond 1.
    fn polynomial(&self, theta: S) -> X {
        let powers = [theta, theta * theta, theta * theta * theta];
        let weight = |coefficients: [f64; 3]| {
            let terms = coefficients.into_iter().zip(powers);
            terms.fold(S::zero(), |sum, (p, power)| {
                power.fused(S::constant(p), sum)
            })
        };
        let [a, b, c] = tableau::POLYNOMIAL;
        combined([weight(a), weight(b), weight(c)], &self.increments)
    }

    /// Where the iteration begins: the last polynomial goes on.
    fn guess(&self, step: S) -> [X; 3] {
        let [_, _, last] = &self.increments;
        if self.error.is_none() {
            let nothing = last.zip(last, |_, _| S::zero());
            return [nothing.clone(), nothing.clone(), nothing];
        }
        let ratio = step.quotient(self.step);
        let further = |node: f64| {
            let theta = S::constant(node).fused(ratio, S::one());
            self.polynomial(theta).zip(last, |x, last| x - last)
        };
        let [a, b, c] = tableau::NODES;
        [further(a), further(b), further(c)]
    }

    /// Makes Jacobian and factors be those of the present state and this step. `false` if there are
    /// none.
    fn prepare<Y: System<S, State = X>>(&mut self, system: &mut Y, step: S) -> Result<bool, Fault> {
        if self.age == Age::Unknown {
            let mut counted = Slopes::counted(system, &mut self.reached.counts);
            self.factorised = None;
            let at = (&self.reached.state, &self.reached.slope);
            self.jacobian
                .evaluate(&mut counted, self.reached.time, at)?;
            self.age = Age::Present;
        }
        Ok(self.factorise(step))
    }

    /// Makes the factors be those of this step. `false` if there are none.
    fn factorise(&mut self, step: S) -> bool {
        if self.factorised != Some(step) {
            let shift = |number: f64| S::constant(number).quotient(step);
            let exists =
                self.real
                    .factorise(shift(tableau::REAL), &self.jacobian, &self.reached.slope)
                    && self.complex.factorise(
                        tableau::COMPLEX.map(shift),
                        &self.jacobian,
                        &self.reached.slope,
                    );
            self.factorised = exists.then_some(step);
        }
        self.factorised.is_some()
    }

    /// Solves for the increments to the stages of a step from a time and a state. `None` where the
    /// iteration does not converge, or leaves the numbers.
    fn collocate<Y: System<S, State = X>>(
        &self,
        system: &mut Y,
        (time, state, step): (S, &X, S),
        increments: &mut [X; 3],
    ) -> Result<Option<Newton<S>>, Fault> {
        let shift = |number: f64| -S::constant(number).quotient(step);
        let [alpha, beta] = tableau::COMPLEX.map(shift);
        let mut transformed = product(tableau::INVERSE, increments);
        let mut newton = self.newton;
        let mut slopes = [state.room(), state.room(), state.room()];
        loop {
            for ((slope, increment), node) in
                slopes.iter_mut().zip(&*increments).zip(tableau::NODES)
            {
                let time = S::constant(node).fused(step, time);
                let stage = state.plus([(S::one(), increment)]);
                system.stage(time, &stage, slope)?;
            }
            let [first, second, third] = product(tableau::INVERSE, &slopes);
            let [u, v, w] = &mut transformed;
            let mut change = first.zip(u, |f, u| u.fused(shift(tableau::REAL), f));
            let real = second.zip(v, |f, v| v.fused(alpha, f));
            let imaginary = third.zip(w, |f, w| w.fused(alpha, f));
            let mut complex = ComplexColumn {
                real: real.zip(w, |x, w| w.fused(-beta, x)),
                imaginary: imaginary.zip(v, |x, v| v.fused(beta, x)),
            };
            self.real.solve(&mut change, &self.jacobian);
            self.complex.solve(&mut complex, &self.jacobian);
            let ComplexColumn { real, imaginary } = &complex;
            let progress = newton.take(self.largest([&change, real, imaginary]));
            if progress == Progress::Fails {
                return Ok(None);
            }
            for (x, change) in [(u, &change), (v, real), (w, imaginary)] {
                *x = x.zip(change, |x, change| x + change);
            }
            *increments = product(tableau::TRANSFORMATION, &transformed);
            if progress == Progress::Converged {
                return Ok(Some(newton));
            }
        }
    }

    /// The size of the largest of these increments. NaN, or infinite, if one is not finite.
    fn largest(&self, increments: [&X; 3]) -> S {
        let state = &self.reached.state;
        if S::CARRIES_DERIVATIVES {
            let sizes = increments.map(|x| self.size(state, x));
            return sizes.into_iter().fold(S::zero(), S::max);
        }
        let [a, b, c] = increments;
        // A comparison loses the second number if it is none.
        let add = |most: S, x: S| x.fused(S::zero(), greater(most, x.abs()));
        let most = a.zip(b, |a, b| add(a.abs(), b));
        self.size(state, &most.zip(c, add))
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

    /// The error of a step, relative to what is allowed, from the difference to a method of order
    /// 3; looked at once more where it was rejected before, for it is too large where a fast motion
    /// has not died out.
    fn estimate<Y: System<S, State = X>>(
        &self,
        system: &mut Y,
        (step, increments): (S, &[X; 3]),
        end: &X,
        again: bool,
    ) -> Result<S, Fault> {
        let weights = row(tableau::ERROR).map(|weight: S| weight.quotient(step));
        let difference = combined(weights, increments);
        let error = |slope: &X| {
            let mut error = slope.zip(&difference, |x, y| x + y);
            self.real.solve(&mut error, &self.jacobian);
            error
        };
        let first = error(&self.reached.slope);
        let size = self.size(end, &first);
        if !(again && size > S::one()) {
            return Ok(size);
        }
        let mut slope = first.clone();
        let there = self.reached.state.plus([(S::one(), &first)]);
        system.stage(self.reached.time, &there, &mut slope)?;
        let error = error(&slope);
        Ok(self.size(end, &error))
    }

    /// One trial.
    fn attempt<Y: System<S, State = X>>(
        &self,
        system: &mut Y,
        (step, end): (S, S),
        rejected: bool,
    ) -> Result<Option<Trial<S, X>>, Fault> {
        let mut increments = self.guess(step);
        let Some(newton) = self.collocate(
            system,
            (self.reached.time, &self.reached.state, step),
            &mut increments,
        )?
        else {
            return Ok(None);
        };
        let [_, _, last] = &increments;
        let state = self.reached.state.plus([(S::one(), last)]);
        let error = self.estimate(system, (step, &increments), &state, rejected)?;
        let mut slope = self.reached.slope.clone();
        if error <= S::one() {
            system.stage(end, &state, &mut slope)?;
        }
        let is_finite = error.is_finite() && state.is_finite() && slope.is_finite();
        Ok(is_finite.then_some(Trial {
            newton,
            increments,
            state,
            slope,
            error,
        }))
    }

    /// Why a trial led nowhere, if its rates are the reason.
    #[cold]
    #[inline(never)]
    fn refused<Y: System<S, State = X>>(
        &self,
        system: &mut Y,
        step: (S, S),
        fault: Option<Fault>,
    ) -> Option<Fault> {
        named(fault, system, |system| self.attempt(system, step, false))
    }

    /// The factor for the next step (Gustafsson, *Control-theoretic techniques for stepsize
    /// selection in implicit Runge-Kutta methods*, ACM TOMS 20 (1994)), by roots of order
    /// [`tableau::POWER`].
    fn factor(&self, step: S, error: S, newton: &Newton<S>) -> S {
        let root = |of: S| of.sqrt().sqrt();
        let mut history = S::one();
        if let Some(before) = self.error
            && error > S::zero()
        {
            let ratio = step.quotient(self.step);
            history = history.min(ratio * root(before.quotient(error)));
        }
        // An error of zero takes the largest factor.
        (newton.safety() * history.quotient(root(error))).min(S::constant(10.0))
    }
}

/// A trial that converged.
struct Trial<S, X> {
    newton: Newton<S>,
    increments: [X; 3],
    state: X,
    slope: X,
    /// Relative to what is allowed.
    error: S,
}

impl<S: Real, X: Vector<S>> Integration<S, X> for RadauIntegration<S, X> {
    reached!();

    // Factors follow from the Jacobian and the step.
    fn remember(&mut self, memory: &mut Memory<'_, S>) -> bool {
        self.reached.remember(memory);
        memory.number(&mut self.next_step);
        self.age.remember(memory);
        self.jacobian.remember(memory, &self.reached.state);
        self.factorised = None;
        memory.number(&mut self.step);
        memory.optional(&mut self.error);
        for increment in &mut self.increments {
            memory.vector(increment);
        }
        true
    }
}

impl<S: Real, Y: System<S>> Advance<S, Y> for RadauIntegration<S, Y::State> {
    fn advance(&mut self, system: &mut Y) -> Result<(), Fault> {
        self.reached.know_slope(system)?;
        let time = self.reached.time;
        let smallest = self.controller.smallest(time);
        let (mut size, mut stretched) = self.controller.opening(time, self.next_step);
        let mut rejected = false;
        loop {
            let end = self.controller.end_of(time, size, stretched);
            let outcome = match self.prepare(system, size) {
                Ok(true) => {
                    let mut counts = self.reached.counts;
                    let mut counted = Slopes::counted(system, &mut counts);
                    let outcome = self.attempt(&mut counted, (size, end), rejected);
                    self.reached.counts = counts;
                    outcome
                }
                Ok(false) => Ok(None),
                Err(fault) => Err(fault),
            };
            let fault = match outcome {
                Ok(Some(trial)) if trial.error <= S::one() => {
                    self.accept(system, (size, end), trial, rejected);
                    return Ok(());
                }
                Ok(Some(trial)) => {
                    let factor = self.factor(size, trial.error, &trial.newton);
                    self.reached.counts.rejected += 1;
                    if size <= smallest {
                        return Err(self.controller.underflow(size, time));
                    }
                    size = smallest.max(size * factor.max(S::constant(0.2)).min(S::constant(0.9)));
                    (stretched, rejected) = (false, true);
                    continue;
                }
                // A Jacobian of a former state may be the reason.
                Ok(None) if self.age == Age::Former => {
                    self.age = Age::Unknown;
                    continue;
                }
                Ok(None) => None,
                Err(fault) => Some(fault),
            };
            self.reached.counts.rejected += 1;
            if size <= smallest {
                let named = self.refused(system, (size, end), fault);
                return Err(named
                    .or(fault)
                    .unwrap_or_else(|| self.controller.underflow(size, time)));
            }
            size = smallest.max(S::constant(0.5) * size);
            (stretched, rejected) = (false, true);
        }
    }

    /// A step of its own, for the polynomial of collocation is of order 3 and steps are long.
    fn at(&mut self, system: &mut Y, time: S) -> Result<Y::State, Fault> {
        let step = time - self.start;
        let theta = step.quotient(self.step);
        let polynomial = |node: f64| self.polynomial(S::constant(node) * theta);
        let mut increments = tableau::NODES.map(polynomial);
        if step > S::zero() && step < self.step && self.factorise(step) {
            let mut solved = increments.clone();
            let mut counts = self.reached.counts;
            let mut counted = Slopes::counted(system, &mut counts);
            let from = (self.start, &self.from, step);
            let outcome = self.collocate(&mut counted, from, &mut solved);
            self.reached.counts = counts;
            if outcome?.is_some() {
                increments = solved;
            }
        }
        let [_, _, last] = &increments;
        Ok(self.from.plus([(S::one(), last)]))
    }
}

impl<S: Real, X: Vector<S>> RadauIntegration<S, X> {
    fn accept<Y: System<S, State = X>>(
        &mut self,
        system: &mut Y,
        (step, end): (S, S),
        mut trial: Trial<S, X>,
        rejected: bool,
    ) {
        /// An iteration of so few steps, or one that converges so fast, has no need of a new
        /// Jacobian.
        const FEW: i32 = 2;
        const FAST: f64 = 1e-3;
        let newton = &trial.newton;
        let mut factor = self.factor(step, trial.error, newton);
        if rejected {
            factor = factor.min(S::one());
        }
        let is_fast = newton.rate.is_none_or(|rate| rate <= S::constant(FAST));
        let is_slow = newton.iterations > FEW && !is_fast;
        self.age = if is_slow { Age::Unknown } else { Age::Former };
        // Factors are dearer than a step that is somewhat too short.
        if !is_slow && factor >= S::one() && factor < S::constant(1.2) {
            factor = S::one();
        }
        self.next_step = step * factor.max(S::constant(0.2));
        let size = end - self.reached.time;
        system.renormalise(&mut trial.state, Some(&mut trial.slope));
        system.follow(&self.reached.state, size, &mut trial.state);
        self.reached.counts.accepted += 1;
        self.reached.estimate = Some(trial.error * self.controller.relative);
        // Errors near zero say nothing of the next one.
        self.error = Some(trial.error.max(S::constant(1e-2)));
        self.start = self.reached.time;
        self.step = end - self.reached.time;
        self.reached.time = end;
        self.increments = trial.increments;
        swap(&mut self.reached.slope, &mut trial.slope);
        self.from = replace(&mut self.reached.state, trial.state);
    }
}
