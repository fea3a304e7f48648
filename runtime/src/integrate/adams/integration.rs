//! An integration with the methods of Adams under way.

use core::mem::replace;

use super::Adams;
use super::choice::{Errors, chosen, coefficient};
use super::coefficients::{Coefficients, HIGHEST, Row};
use crate::error::Fault;
use crate::integrate::controller::Controller;
use crate::integrate::record::{Reached, reached};
use crate::integrate::{Advance, Counts, Integration, Memory, Slopes, System, TimeSpan, named};
use crate::math::scalar::Real;
use crate::math::without_bounds::opaque;
use crate::state::vector::Vector;

/// What the first step takes of the change that the tolerance allows, and the power of the step
/// that the error at order 1 goes with.
const FIRST_SHARE: f64 = 0.25;
const FIRST_POWER: f64 = 2.0;

/// An integration with [`Adams`] under way.
#[derive(Clone)]
pub struct AdamsIntegration<S: Real, X: Vector<S>> {
    controller: Controller<S>,
    /// The size and the order of the next step.
    next_step: S,
    order: usize,
    /// While no error has forbidden it yet, every step is twice as long as that before, and of an
    /// order more.
    is_starting: bool,
    /// With the slope that was evaluated last: not that at the state, where another one was put in
    /// the place of that which the differences end at.
    reached: Reached<S, X>,
    coefficients: Coefficients<S>,
    /// The modified divided differences of the slopes, `phi`: the first is the slope at the state.
    differences: Row<X>,
}

opaque!([S: Real, X: Vector<S>] AdamsIntegration<S, X>, "AdamsIntegration");

/// What a trial ended with.
enum Trial<S, X> {
    Accepted { state: X, errors: Errors<S> },
    Rejected { errors: Errors<S> },
}

impl<S: Real, X: Vector<S>> AdamsIntegration<S, X> {
    pub(super) fn start<Y: System<S, State = X>>(
        method: &Adams<S>,
        system: &mut Y,
        span: TimeSpan<S>,
        state: X,
    ) -> Result<Self, Fault> {
        let Adams { tolerance, limits } = method;
        let controller = Controller::new(*tolerance, limits, FIRST_POWER, &span)?;
        let reached = Reached::start(system, &span, state)?;
        let mut differences = Row::of(&zero(&reached.slope));
        differences[1] = reached.slope.clone();
        Ok(Self {
            controller,
            next_step: controller.first(&span, &reached.state, &reached.slope, FIRST_SHARE),
            order: 1,
            is_starting: true,
            reached,
            coefficients: Coefficients::new(),
            differences,
        })
    }

    /// Puts the slope at a state that was corrected in the place of that at the state before, in
    /// all differences that it is part of.
    fn renew<Y: System<S, State = X>>(&mut self, system: &mut Y) -> Result<(), Fault> {
        self.reached.know_slope(system)?;
        let more = difference(&self.reached.slope, &self.differences[1]);
        let count = match self.coefficients.last_order {
            0 => 1,
            order => order + 2,
        };
        for i in 1..=count {
            self.differences[i] = sum(&self.differences[i], &more);
        }
        Ok(())
    }

    /// Predicts the state after a step, and the differences there: block 2 of STEP.
    fn predict(&mut self, step: S) -> X {
        let (order, differences) = (self.order, &mut self.differences);
        self.coefficients.prepare(step, order);
        for i in self.coefficients.equal + 1..=order {
            let beta = self.coefficients.beta[i];
            differences[i] = differences[i].zip(&differences[i], |x, _| beta * x);
        }
        differences[order + 2] = differences[order + 1].clone();
        differences[order + 1] = zero(&self.reached.slope);
        let mut slope = zero(&self.reached.slope);
        for i in (1..=order).rev() {
            let g = self.coefficients.g[i];
            slope = slope.zip(&differences[i], |slope, x| x.fused(g, slope));
            differences[i] = sum(&differences[i], &differences[i + 1]);
        }
        self.reached.state.plus([(step, &slope)])
    }

    /// Takes the differences back to where they were before a trial: block 3 of STEP.
    fn take_back(&mut self, step: S) {
        let (order, differences) = (self.order, &mut self.differences);
        for i in 1..=order {
            let beta = self.coefficients.beta[i];
            differences[i] =
                differences[i].zip(&differences[i + 1], |x, above| (x - above).quotient(beta));
        }
        self.coefficients.take_back(step, order);
    }

    /// The errors of a trial: blocks 2 and 3 of STEP. `surprise` is the slope at the predicted
    /// state less that which was predicted.
    fn errors(&self, step: S, predicted: &X, surprise: &X) -> (S, Errors<S>) {
        let (k, phi, c) = (self.order, &self.differences, &self.coefficients);
        let floor = self.controller.floor;
        let size = self
            .reached
            .state
            .weighted_norm(predicted, floor, [(step, surprise)]);
        let less = |order: usize| {
            let terms = [(step, &phi[order + 1]), (step, surprise)];
            let size = self.reached.state.weighted_norm(predicted, floor, terms);
            size * c.sigma[order + 1] * coefficient(order)
        };
        let error = size * (c.g[k] - c.g[k + 1]);
        let here = size * c.sigma[k + 1] * coefficient(k);
        let (mut below, mut lowers) = (here, false);
        if k == 2 {
            below = less(1);
            lowers = below <= S::constant(0.5) * here;
        } else if k > 2 {
            below = less(k - 1);
            lowers = below.max(less(k - 2)) <= here;
        }
        let errors = Errors {
            here,
            below,
            lowers,
        };
        (error, errors)
    }

    /// One trial to the time `end`; leaves the slope there in `self.reached.slope`.
    fn attempt<Y: System<S, State = X>>(
        &mut self,
        system: &mut Y,
        step: S,
        end: S,
    ) -> Result<Trial<S, X>, Fault> {
        let predicted = self.predict(step);
        let mut counted = Slopes::counted(system, &mut self.reached.counts);
        if let Err(fault) = counted.stage(end, &predicted, &mut self.reached.slope) {
            return Err(refused(system, end, &predicted, Some(fault)).unwrap_or(fault));
        }
        let surprise = difference(&self.reached.slope, &self.differences[1]);
        let (error, errors) = self.errors(step, &predicted, &surprise);
        if !error.is_finite() {
            return match refused(system, end, &predicted, None) {
                Some(fault) => Err(fault),
                None => Ok(Trial::Rejected { errors }),
            };
        }
        if !self.controller.accepts(error) {
            return Ok(Trial::Rejected { errors });
        }
        let weight = step * self.coefficients.g[self.order + 1];
        let state = predicted.plus([(weight, &surprise)]);
        let mut counted = Slopes::counted(system, &mut self.reached.counts);
        if let Err(fault) = counted.stage(end, &state, &mut self.reached.slope) {
            return Err(refused(system, end, &state, Some(fault)).unwrap_or(fault));
        }
        if !(state.is_finite() && self.reached.slope.is_finite()) {
            return match refused(system, end, &state, None) {
                Some(fault) => Err(fault),
                None => Ok(Trial::Rejected { errors }),
            };
        }
        Ok(Trial::Accepted { state, errors })
    }

    /// Takes the slope at the end of an accepted step into the differences, and chooses order and
    /// size of the next one: block 4 of STEP.
    fn go_on(&mut self, step: S, from: &X, errors: Errors<S>) {
        let (k, phi) = (self.order, &mut self.differences);
        phi[k + 1] = difference(&self.reached.slope, &phi[1]);
        phi[k + 2] = difference(&phi[k + 1], &phi[k + 2]);
        for i in 1..=k {
            phi[i] = sum(&phi[i], &phi[k + 1]);
        }
        self.coefficients.last_step = step;
        self.coefficients.last_order = k;
        self.is_starting &= !errors.lowers && k < HIGHEST;
        if self.is_starting {
            self.order = k + 1;
            self.next_step = step + step;
            return;
        }
        let above = (k < self.coefficients.equal && !errors.lowers).then(|| {
            let floor = self.controller.floor;
            from.weighted_norm(&self.reached.state, floor, [(step, &phi[k + 2])])
                * coefficient(k + 1)
        });
        let allowed = S::constant(0.5) * self.controller.relative;
        (self.order, self.next_step) = chosen((k, step), allowed, errors, above);
    }
}

impl<S: Real, X: Vector<S>> Integration<S, X> for AdamsIntegration<S, X> {
    reached!();

    fn remember(&mut self, memory: &mut Memory<'_, S>) -> bool {
        self.reached.remember(memory);
        memory.number(&mut self.next_step);
        memory.count(&mut self.order);
        memory.flag(&mut self.is_starting);
        self.coefficients.remember(memory);
        self.differences
            .each(|difference| memory.vector(difference));
        // A file may hold any number.
        self.order = self.order.clamp(1, HIGHEST);
        true
    }
}

impl<S: Real, Y: System<S>> Advance<S, Y> for AdamsIntegration<S, Y::State> {
    fn advance(&mut self, system: &mut Y) -> Result<(), Fault> {
        if !self.reached.is_known {
            self.renew(system)?;
        }
        let time = self.reached.time;
        let smallest = self.controller.smallest(time);
        let (mut size, mut stretched) = self.controller.opening(time, self.next_step);
        let mut failures = 0_usize;
        loop {
            let end = self.controller.end_of(time, size, stretched);
            let outcome = self.attempt(system, size, end);
            if let Ok(Trial::Accepted { mut state, errors }) = outcome {
                system.renormalise(&mut state, Some(&mut self.reached.slope));
                system.follow(&self.reached.state, end - time, &mut state);
                self.reached.counts.accepted += 1;
                self.reached.estimate = Some(errors.here);
                self.reached.time = end;
                let from = replace(&mut self.reached.state, state);
                self.go_on(size, &from, errors);
                return Ok(());
            }
            self.reached.counts.rejected += 1;
            stretched = false;
            if size <= smallest {
                return Err(match outcome {
                    Err(fault) => fault,
                    Ok(_) => self.controller.underflow(size, time),
                });
            }
            self.take_back(size);
            self.is_starting = false;
            failures += 1;
            let mut factor = S::constant(0.5);
            if let Ok(Trial::Rejected { errors }) = outcome {
                if errors.lowers {
                    self.order -= 1;
                }
                let less = (factor * self.controller.relative.quotient(errors.here)).sqrt();
                if failures > 3 && less < factor {
                    factor = less;
                }
            }
            if failures >= 3 {
                self.order = 1;
            }
            size = smallest.max(factor * size);
        }
    }

    fn at(&mut self, _system: &mut Y, time: S) -> Result<Y::State, Fault> {
        let back = time - self.reached.time;
        let weights = self.coefficients.within(back);
        let mut slope = zero(&self.reached.slope);
        for i in (1..=self.coefficients.last_order + 1).rev() {
            let weight = weights[i];
            slope = slope.zip(&self.differences[i], |slope, x| x.fused(weight, slope));
        }
        Ok(self.reached.state.plus([(back, &slope)]))
    }
}

/// Why a trial failed at a state, or why rates there are not finite; `None` where they are.
#[cold]
#[inline(never)]
fn refused<S: Real, X: Vector<S>, Y: System<S, State = X>>(
    system: &mut Y,
    time: S,
    state: &X,
    fault: Option<Fault>,
) -> Option<Fault> {
    named(fault, system, |system| system.rates(time, state))
}

fn zero<S: Real, X: Vector<S>>(slope: &X) -> X {
    slope.zip(slope, |_, _| S::zero())
}

fn sum<S: Real, X: Vector<S>>(a: &X, b: &X) -> X {
    a.zip(b, |a, b| a + b)
}

fn difference<S: Real, X: Vector<S>>(a: &X, b: &X) -> X {
    a.zip(b, |a, b| a - b)
}
