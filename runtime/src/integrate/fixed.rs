//! A scheme at a fixed step.

use super::lobatto::Taken;
use super::{
    Counted, Counts, Course, Ends, Heun, ImplicitMidpoint, Integrator, Midpoint, Rk4, Scheme,
    SemiImplicitEuler, Span, Start, Stride, System, named, refused,
};
use crate::error::Fault;
use crate::error::setting::positive;
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// A [`Scheme`] at a fixed step: times `t0 + k h`, the last step shortened to the end of the
/// interval.
///
/// Steps do not depend on output times; output between steps is by the interpolant of the scheme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedStep<S, K> {
    /// The step `h` (s).
    pub step: S,
    /// The method.
    pub scheme: K,
}

/// The constructors of methods that are schemes themselves.
macro_rules! constructors {
    ($($scheme:ident),*) => {$(
        impl $scheme {
            /// This method with a fixed step (s), for [`Simulation`](crate::Simulation).
            #[must_use]
            pub const fn every<S>(step: S) -> FixedStep<S, Self> {
                FixedStep { step, scheme: Self }
            }
        }
    )*};
}

constructors!(SemiImplicitEuler, Midpoint, Heun, ImplicitMidpoint, Rk4);

impl<S: Real, K: Scheme<S>> Integrator<S> for FixedStep<S, K> {
    type Course<X: Vector<S>> = FixedCourse<S, X, K>;

    fn start<Y: System<S>>(
        &self,
        system: &mut Y,
        span: Span<S>,
        state: Y::State,
    ) -> Result<FixedCourse<S, Y::State, K>, Fault> {
        let grid = Grid::new(self.step, &span)?;
        let mut counts = Counts::default();
        let last = Counted {
            system,
            counts: &mut counts,
        }
        .rates(span.start, &state)?;
        Ok(FixedCourse {
            scheme: self.scheme,
            grid,
            counts,
            time: span.start,
            from: state.clone(),
            first: last.clone(),
            stages: self.scheme.stages(&last),
            state,
            last,
            known: true,
            start: span.start,
            step: S::zero(),
            prepared: false,
        })
    }

    fn fixed_step(&self) -> Option<S> {
        Some(self.step)
    }

    fn turning_error(&self) -> f64 {
        self.scheme.turning_error()
    }

    fn turning_error_of_short_steps(&self) -> f64 {
        self.scheme.turning_error_of_short_steps()
    }

    fn silent_phase(&self) -> f64 {
        self.scheme.silent_phase()
    }

    fn velocity_lead(&self) -> f64 {
        self.scheme.velocity_lead()
    }
}

/// The times of a fixed step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid<S> {
    pub(super) nominal: S,
    origin: S,
    pub(super) end: S,
}

impl<S: Real> Grid<S> {
    pub(super) fn new(step: S, span: &Span<S>) -> Result<Self, Fault> {
        let nominal = positive("step", step)?;
        span.duration()?;
        Ok(Self {
            nominal,
            origin: span.start,
            end: span.end,
        })
    }

    /// The next step after so many, and the time that it leads to.
    pub(super) fn next(&self, accepted: usize, time: S) -> Result<(S, S), Fault> {
        let index = S::constant((accepted + 1) as f64);
        let mut end = index.fused(self.nominal, self.origin);
        let mut step = self.nominal;
        if end + S::constant(8.0) * self.end.ulp() >= self.end {
            end = self.end;
            step = end - time;
        }
        if end <= time {
            return Err(Fault::StepTooShort {
                step: step.to_f64(),
                time: time.to_f64(),
            });
        }
        Ok((step, end))
    }
}

/// The slope at a state, written over another; refused if it is not finite.
pub(super) fn slope<S: Real, Y: System<S>>(
    system: &mut Y,
    counts: &mut Counts,
    (time, state): (S, &Y::State),
    slope: &mut Y::State,
) -> Result<(), Fault> {
    let outcome = Counted { system, counts }.stage(time, state, slope);
    if outcome.is_err() || !slope.is_finite() {
        let fault = named(outcome.err(), system, |system| system.rates(time, state));
        return Err(fault.unwrap_or(Fault::StateNotFinite));
    }
    Ok(())
}

/// An integration with a [`FixedStep`] under way.
pub struct FixedCourse<S: Real, X: Vector<S>, K: Scheme<S>> {
    scheme: K,
    grid: Grid<S>,
    counts: Counts,
    time: S,
    state: X,
    /// The slope at `state`, if it is known.
    last: X,
    known: bool,
    /// The last step: its start, its size, the slopes within.
    start: S,
    step: S,
    from: X,
    first: X,
    stages: K::Stages<X>,
    /// Whether the interpolant has what it needs besides these.
    prepared: bool,
}

impl<S: Real, X: Vector<S>, K: Scheme<S>> FixedCourse<S, X, K> {
    /// Computes the slope at the state that was reached, once.
    fn slope<Y: System<S, State = X>>(&mut self, system: &mut Y) -> Result<(), Fault> {
        if !self.known {
            let at = (self.time, &self.state);
            slope(system, &mut self.counts, at, &mut self.last)?;
            self.known = true;
        }
        Ok(())
    }
}

impl<S: Real, X: Vector<S>, K: Scheme<S>> Course<S, X> for FixedCourse<S, X, K> {
    fn time(&self) -> S {
        self.time
    }

    fn state(&self) -> &X {
        &self.state
    }

    fn advance<Y: System<S, State = X>>(&mut self, system: &mut Y) -> Result<(), Fault> {
        self.slope(system)?;
        let (step, end) = self.grid.next(self.counts.accepted, self.time)?;
        let mut counted = Counted {
            system,
            counts: &mut self.counts,
        };
        let start = Start {
            time: self.time,
            state: &self.state,
            slope: &self.last,
        };
        let outcome = self
            .scheme
            .stride(&mut counted, start, step, &mut self.stages);
        let mut state = match outcome {
            Ok(state) if state.is_finite() => state,
            outcome => {
                let from = (self.time, &self.state);
                return Err(refused(&self.scheme, system, from, step, outcome.err()));
            }
        };
        system.settle(&mut state, None);
        self.counts.accepted += 1;
        core::mem::swap(&mut self.first, &mut self.last);
        self.known = false;
        self.from = core::mem::replace(&mut self.state, state);
        self.start = core::mem::replace(&mut self.time, end);
        self.step = step;
        self.prepared = false;
        Ok(())
    }

    fn at<Y: System<S, State = X>>(&mut self, system: &mut Y, time: S) -> Result<X, Fault> {
        self.slope(system)?;
        if !self.prepared {
            let mut counted = Counted {
                system,
                counts: &mut self.counts,
            };
            let ends = Ends {
                step: self.step,
                from: &self.from,
                first: &self.first,
                last: &self.last,
            };
            self.scheme
                .prepare(&mut counted, self.start, ends, &mut self.stages)?;
            self.prepared = true;
        }
        let theta = (time - self.start).quotient(self.time - self.start);
        let stride = Stride {
            step: self.step,
            from: &self.from,
            first: &self.first,
            stages: &self.stages,
            to: &self.state,
            last: &self.last,
        };
        Ok(self.scheme.interpolate(stride, theta))
    }

    fn better_end<Y: System<S, State = X>>(&self, system: &mut Y) -> Result<Option<X>, Fault> {
        if self.scheme.silent_phase() == 0.0 {
            return Ok(None);
        }
        let taken = Taken {
            start: self.start,
            end: self.time,
            step: self.step,
            from: &self.from,
            first: &self.first,
            to: &self.state,
        };
        taken.better_end(system).map(Some)
    }

    fn replace(&mut self, state: X) {
        self.state = state;
        self.known = false;
    }

    fn counts(&self) -> Counts {
        self.counts
    }
}
