//! Integrators: they move the state of a [`System`] through time and know nothing of mechanisms.
//!
//! | what a user writes | method | evaluations |
//! |---|---|---|
//! | [`SemiImplicitEuler::every(h)`](SemiImplicitEuler::every) | semi-implicit Euler of order 1, fixed step | 1 a step |
//! | [`Midpoint::every(h)`](Midpoint::every), [`Heun::every(h)`](Heun::every) | Runge-Kutta methods of order 2, fixed step | 2 a step |
//! | [`ImplicitMidpoint::every(h)`](ImplicitMidpoint::every) | implicit midpoint rule of order 2, symmetric, fixed step | 1 a step and 1 an iteration |
//! | [`GeneralizedAlpha::every(h)`](GeneralizedAlpha::every) | generalized-alpha of order 2 on rigid constraints, damping as wanted, fixed step | 1 an iteration |
//! | [`Kutta3::every(h)`](Kutta3::every) | Runge-Kutta method of order 3, fixed step | 3 a step |
//! | [`Rk4::every(h)`](Rk4::every) | classical Runge-Kutta of order 4, fixed step | 4 a step |
//! | [`AdamsBashforthMoulton4::every(h)`](AdamsBashforthMoulton4::every) | multistep method of order 4, predicted and corrected, fixed step | 2 a step |
//! | [`DormandPrince::every(h)`](DormandPrince::every) | Dormand-Prince of order 5, fixed step | 6 a step |
//! | [`BogackiShampine::every(h)`](BogackiShampine::every), [`DormandPrince853::every(h)`](DormandPrince853::every) | the methods of order 3 and 8 of the pairs below, fixed step | 3, 12 a step |
//! | [`BogackiShampine::new(tolerance)`](BogackiShampine::new) | Bogacki-Shampine 3(2), the step control of MATLAB's `ode23` | 3 a trial, and 1 |
//! | [`DormandPrince::new(tolerance)`](DormandPrince::new) | Dormand-Prince 5(4), the step control of MATLAB's `ode45` | 6 a trial, and 1 |
//! | [`DormandPrince853::new(tolerance)`](DormandPrince853::new) | Dormand-Prince 8(5,3), the same control | 12 a trial, and 1; 3 for each step with output within |
//! | [`RadauIIA::new(tolerance)`](RadauIIA::new) | Radau IIA of order 5 for stiff systems, step control of `RADAU5` | 3 an iteration, and 1; the Jacobian besides |
//! | [`Bdf::new(tolerance)`](Bdf::new) | backward differentiation of order 1 to 5 for stiff systems, order and step control of MATLAB's `ode15s` | 1 an iteration; the Jacobian besides |
//! | [`Adams::new(tolerance)`](Adams::new) | Adams of order 1 to 12 in divided differences, the step and order control of MATLAB's `ode113` | 2 a step, 1 a rejected trial, and 1 |
//!
//! [`OneStep::step`] takes one step at a time, for loops that somebody else owns;
//! [`Integrator::start`] begins a [`Integration`] over an interval, with output at any time within
//! the last step. What a method is, whatever it moves, is a [`Method`] or a [`Scheme`]. That it
//! moves a system of some type is an [`Integrator`] or a [`OneStep`] with that type. So a method
//! does not compile with a system that lacks what it needs.
//!
//! Structure. An explicit Runge-Kutta method is its table (`explicit.rs`). An embedded pair
//! (`embedded.rs`) is a scheme with error weights, their power of the step and an interpolant. The
//! control knows no more. `Scheme::prepare` evaluates what an
//! interpolant needs besides, only for steps that are looked into: three evaluations of
//! Dormand-Prince 8(5,3).
//!
//! Multistep methods (`adams`, `bdf.rs`) keep differences of slopes or increments. A correction
//! after a step must not change the sign of Euler parameters, which a one-step method does not
//! notice (`Coordinates::of_bodies_near`).
//!
//! After a step `System::renormalise` normalises the state and scales the slope, so nothing is
//! evaluated again. Choices: `docs/decisions` 006 (turns), 007 (checks), 009 and 010 (Jacobians
//! and matrices), 011 (generalized-alpha), 012 (phase of order 2).

mod adams;
mod adams_fixed;
mod adaptive;
mod bdf;
mod bogacki_shampine;
mod column;
mod controlled;
mod controller;
mod counted;
mod dense;
mod dormand_prince;
mod dormand_prince_8;
mod embedded;
mod error_model;
mod explicit;
mod fixed;
mod generalized_alpha;
mod implicit_midpoint;
mod jacobian;
mod linear;
mod lobatto;
mod looked_into;
mod memory;
mod newton;
mod radau;
mod record;
mod reduced;
mod rk2;
mod rk3;
mod rk4;
mod semi_implicit;
mod single;
mod slopes;
mod tableau;
mod tableau_853;
mod tableau_radau;
#[cfg(test)]
mod tests;

pub use adams::{Adams, AdamsIntegration};
pub use adams_fixed::{AdamsBashforthMoulton4, AdamsFixedIntegration};
pub use adaptive::AdaptiveIntegration;
pub use bdf::{Bdf, BdfIntegration};
pub use bogacki_shampine::{BogackiShampine, BogackiShampine3};
pub use controlled::StepLimits;
pub use controller::Tolerance;
pub use counted::Counts;
pub use dormand_prince::{DormandPrince, DormandPrince5};
pub use dormand_prince_8::{DormandPrince8, DormandPrince853};
pub use embedded::{Adaptive, EmbeddedPair};
pub use error_model::ErrorModel;
pub use fixed::{FixedIntegration, FixedStep};
pub use generalized_alpha::{
    AlphaEnd, AlphaStep, AlphaWeights, GeneralizedAlpha, GeneralizedAlphaIntegration,
};
pub use implicit_midpoint::ImplicitMidpoint;
pub use memory::Memory;
pub use radau::{RadauIIA, RadauIntegration};
pub use rk2::{Heun, Midpoint};
pub use rk3::Kutta3;
pub use rk4::Rk4;
pub use semi_implicit::SemiImplicitEuler;
pub use slopes::{Checking, Counting, Look, Slopes, Unlooked};
pub use tableau::Tableau;

use core::fmt::Debug;

pub(crate) use self::looked_into::StepWithin;
pub(crate) use self::memory::Reader;
#[cfg(feature = "std")]
pub(crate) use self::memory::Tape;
pub(crate) use self::newton::by_differences;
#[cfg(feature = "std")]
pub(crate) use self::single::recorded;
#[cfg(feature = "std")]
pub(crate) use self::slopes::Evaluated;

use self::single::{attempt, refused};
use self::slopes::named;
use crate::error::setting::interval;
use crate::error::{Fault, StartFault};
use crate::math::scalar::{Real, Scalar};
use crate::state::vector::Vector;

/// A system of ordinary differential equations of first order: `y' = f(t, y)`.
///
/// ```
/// use holonom::{Fault, Rk4, integrate::{OneStep, System}};
///
/// /// y' = -y
/// struct Decay;
///
/// impl System<f64> for Decay {
///     type State = [f64; 1];
///     fn rates(&mut self, _time: f64, state: &[f64; 1]) -> Result<[f64; 1], Fault> {
///         Ok([-state[0]])
///     }
/// }
///
/// let mut state = [1.0];
/// for step in 0..100 {
///     Rk4.step(&mut Decay, 0.01 * f64::from(step), &mut state, 0.01)?;
/// }
/// assert!((state[0] - (-1.0_f64).exp()).abs() < 1e-10);
/// # Ok::<(), Fault>(())
/// ```
pub trait System<S: Scalar> {
    /// The state; its rates have the same type.
    type State: Vector<S>;

    /// The rates of the state: `f(t, y)`.
    ///
    /// # Errors
    /// Rates that are not finite, and what else keeps the system from having rates here.
    fn rates(&mut self, time: S, state: &Self::State) -> Result<Self::State, Fault>;

    /// Writes the rates at a stage of a step. They need not be finite: whoever takes the step looks
    /// at what it leads to, once, and where that is not finite asks [`System::diagnose`] at the
    /// first stage that is not.
    ///
    /// # Errors
    /// What else keeps the system from having rates here;
    /// [`StepFault::StateNotFinite`](crate::error::StepFault::StateNotFinite) leaves it to
    /// [`System::diagnose`] to say why.
    #[inline(always)]
    fn stage(
        &mut self,
        time: S,
        state: &Self::State,
        rates: &mut Self::State,
    ) -> Result<(), Fault> {
        *rates = self.rates(time, state)?;
        Ok(())
    }

    /// Why the rates of a stage are not taken: asked once, after the step has given its stack back.
    /// `None` where nothing is wrong with them.
    fn diagnose(&mut self, time: S, state: &Self::State) -> Option<Fault> {
        self.rates(time, state).err()
    }

    /// Writes the Jacobian of the rates: column `k` is the change of the rates for an increment of
    /// element `k` of the state, divided by that increment. `rates` are those of the state; zero
    /// where [`Vector::is_independent`] says so. Returns how many evaluations that has taken; one
    /// that gives several columns counts once for each.
    ///
    /// Implicit methods ask for it, and need it for the sake of convergence only. By differences of
    /// rates, if a system does not know better. A mechanism does: its kernels give it over
    /// [`Forward`](crate::Forward) numbers.
    ///
    /// # Errors
    /// As [`System::stage`].
    fn jacobian(
        &mut self,
        time: S,
        state: &Self::State,
        rates: &Self::State,
        columns: &mut <Self::State as Vector<S>>::Each<Self::State>,
    ) -> Result<usize, Fault>
    where
        // No part of an object: else it would be compiled for every system, though explicit methods
        // never ask for it.
        Self: Sized,
        S: Real,
    {
        by_differences(state, rates, columns, |state, rates| {
            self.stage(time, state, rates)
        })
    }

    /// Counts on in a state that a step (s) has led to from another one what states count beside
    /// their elements, see [`Vector::turns`]. A method calls it once for every step that it takes,
    /// before or after [`System::renormalise`].
    #[inline(always)]
    fn follow(&mut self, _from: &Self::State, _step: S, _to: &mut Self::State) {}

    /// Brings a state that a step has led to into its normal form, and its rates, where they are
    /// known, with it.
    ///
    /// What the state says must not change, so that the rates stay valid; a step that goes on from
    /// it uses both as they come out.
    #[inline(always)]
    fn renormalise(&mut self, _state: &mut Self::State, _rates: Option<&mut Self::State>) {}
}

/// A system whose state is made of coordinates and velocities.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not tell velocities from coordinates",
    label = "no system of second order",
    note = "`SemiImplicitEuler` takes coordinates by the velocities at the end of a step: a mechanism has them, a `System` of one's own implements `integrate::SecondOrder`"
)]
pub trait SecondOrder<S: Scalar>: System<S> {
    /// Replaces the rates of the coordinates, which are those at the start of a step, by those at
    /// the velocities at its end, to which the other rates lead.
    fn with_new_velocities(
        &mut self,
        time: S,
        state: &Self::State,
        step: S,
        rates: &mut Self::State,
    );
}

/// A system that is solved with rigid constraints, its positions and velocities with it.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not solved with rigid constraints",
    label = "no constraints that `GeneralizedAlpha` could solve for",
    note = "`GeneralizedAlpha` moves a mechanism in absolute coordinates with `StandardLagrange`; in joint coordinates, with another formulation and for a `System` of one's own any other method does"
)]
pub trait RigidConstraints<S: Real>: System<S> {
    /// One step of [`GeneralizedAlpha`], solved together with multipliers: only the system knows
    /// masses and constraints.
    ///
    /// # Errors
    /// What keeps the step from being solved.
    fn step_on_constraints(
        &mut self,
        asked: AlphaStep<'_, S, Self::State>,
    ) -> Result<AlphaEnd<Self::State>, Fault>;
}

/// What a method that integrates over an interval is, whatever it moves: see [`Integrator`].
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not integrate over an interval",
    label = "no integrator: it does not know its steps",
    note = "a run takes a method with its steps: `Rk4::every(h)`, `DormandPrince::every(h)` or `DormandPrince::new(tolerance)`"
)]
pub trait Method<S: Real>: Copy + Debug {
    /// How many evaluations a run may take, where there is a limit.
    fn budget(&self) -> Option<usize> {
        None
    }

    /// The step (s) of a method that does not choose it.
    fn fixed_step(&self) -> Option<S> {
        None
    }

    /// How the errors of the method grow, for the warnings of a run.
    fn error_model(&self) -> ErrorModel {
        ErrorModel::default()
    }

    /// The error to be allowed in a step, for a method that controls it.
    fn tolerance(&self) -> Option<Tolerance<S>> {
        None
    }

    /// The same method for a mechanism of such a length (m), which the default of a tolerance goes
    /// with.
    fn for_length(&self, _length: S) -> Self {
        *self
    }

    /// The same method over a part of an interval of so many seconds. Where its longest step is a
    /// tenth of the interval by default, it is a tenth of the whole.
    fn for_duration(&self, _duration: S) -> Self {
        *self
    }

    /// The same method for a second run over an interval of so many seconds, by which the error of
    /// the first is estimated ([`Simulation::verified`](crate::Simulation::verified)): with half
    /// the step, or with another tolerance and steps that pass over nothing longer than 1/256 of
    /// the interval. `None` of a method that does not know.
    fn companion(&self, _duration: S) -> Option<Self> {
        None
    }
}

/// A method that integrates a system over an interval and decides on its steps.
///
/// Most methods move any [`System`]. [`SemiImplicitEuler`] needs a [`SecondOrder`] one, and
/// [`GeneralizedAlpha`] one with [`RigidConstraints`]: another does not compile.
pub trait Integrator<S: Real, Y: System<S>>: Method<S> {
    /// An integration under way, with all the memory that it needs.
    type Integration: Advance<S, Y>;

    /// Begins an integration.
    ///
    /// # Errors
    /// A setting that is not finite and positive, an interval without a length; a fault of the
    /// system at the start.
    fn start(
        &self,
        system: &mut Y,
        span: TimeSpan<S>,
        state: Y::State,
    ) -> Result<Self::Integration, Fault>;
}

/// The functions of a [`Method`], each by that of another one, which a macro calls an expression
/// with. It is beside the trait, so that no function is forgotten.
#[doc(hidden)]
#[macro_export]
macro_rules! __hooks_of_method {
    ($with:ident) => {
        $crate::__hooks_of_method! { $with:
            budget -> Option<usize>;
            fixed_step -> Option<S>;
            error_model -> $crate::integrate::ErrorModel;
            tolerance -> Option<$crate::Tolerance<S>>;
        }
    };
    ($with:ident: $($hook:ident -> $of:ty;)*) => {$(
        fn $hook(&self) -> $of {
            $with!(self, own => $crate::integrate::Method::<S>::$hook(&own))
        }
    )*};
}

/// Where an integration is.
pub trait Integration<S: Real, X: Vector<S>> {
    /// The time that was reached.
    fn time(&self) -> S;

    /// The state at that time.
    fn state(&self) -> &X;

    /// The error of the last step, as its control estimates it, relative to the state; `None` of
    /// fixed steps.
    fn estimate(&self) -> Option<S>;

    /// Puts a corrected state in the place of [`Integration::state`], as small a change as it was:
    /// a method that looks back at former steps goes on with these. Call [`Advance::at`] before,
    /// not after.
    fn replace(&mut self, state: X);

    /// Puts another account of angles in the place of the one of its state, see
    /// [`Vector::turns`]: a run counts through steps that tell too little.
    fn recount(&mut self, turns: &[S]) {
        let mut state = self.state().clone();
        put_turns(&mut state, turns);
        self.replace(state);
    }

    /// What it has cost so far.
    fn counts(&self) -> Counts;

    /// Hands everything that the next steps depend on to a [`Memory`], which writes it or replaces
    /// it. That is where it is, slopes and states of former steps, and the size of the next step.
    /// Whether it does so: a method that does not cannot go on from a checkpoint.
    ///
    /// It is asked between two steps. What it replaces was begun by the same method over the same
    /// interval.
    fn remember(&mut self, _memory: &mut Memory<'_, S>) -> bool {
        false
    }
}

/// Puts another account of angles in the place of the one of a state.
fn put_turns<S: Scalar, X: Vector<S>>(state: &mut X, turns: &[S]) {
    let places = state.turns_mut().iter_mut();
    places.zip(turns).for_each(|(place, &turn)| *place = turn);
}

/// An integration under way.
pub trait Advance<S: Real, Y: System<S>>: Integration<S, Y::State> {
    /// Goes on by one accepted step, at most to the end of the interval.
    ///
    /// # Errors
    /// Why it cannot go on. Time and state are then as before; the integration is over.
    fn advance(&mut self, system: &mut Y) -> Result<(), Fault>;

    /// The state at a time within the last step, by the interpolant of the method.
    ///
    /// # Errors
    /// A fault of the system, where the interpolant needs an evaluation at the end of the step.
    fn at(&mut self, system: &mut Y, time: S) -> Result<Y::State, Fault>;

    /// Where the last step would have led by the rule of Lobatto of order 4, from slopes at its
    /// ends and in its middle, each evaluated anew and counted nowhere; `None` for methods that
    /// control their errors, or whose energy tells of them.
    ///
    /// # Errors
    /// A fault of the system.
    fn better_end(&self, _system: &mut Y) -> Result<Option<Y::State>, Fault> {
        Ok(None)
    }
}

/// What a one-step method of fixed coefficients is, whatever it moves: see [`OneStep`].
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not take single steps",
    label = "no one-step method",
    note = "a `Stepper` takes a method without a step, such as `Rk4`, and the step with every `step(&mut state, dt)`"
)]
pub trait Scheme<S: Scalar>: Copy + Debug {
    /// The memory of a step: slopes at the inner stages.
    type Stages<X: Vector<S>>: Clone;

    /// Memory for states like this one.
    fn stages<X: Vector<S>>(&self, like: &X) -> Self::Stages<X>;

    /// See [`Method::error_model`].
    fn error_model(&self) -> ErrorModel {
        ErrorModel::default()
    }

    /// The tableau, of an explicit Runge-Kutta method.
    fn tableau(&self) -> Option<Tableau> {
        None
    }

    /// Evaluates what [`Scheme::interpolate`] needs besides the slopes of a step that began at
    /// `time`, once for each step that is looked into.
    ///
    /// # Errors
    /// A fault of the system.
    #[inline]
    fn prepare<Y: System<S>>(
        &self,
        _system: &mut Y,
        _time: S,
        _ends: StepEnds<'_, S, Y::State>,
        _stages: &mut Self::Stages<Y::State>,
    ) -> Result<(), Fault> {
        Ok(())
    }

    /// The state at the fraction `theta` (from 0 to 1) of a step: by the cubic through states and
    /// slopes at both ends, if a method does not know better.
    fn interpolate<X: Vector<S>>(
        &self,
        record: StepRecord<'_, S, X, Self::Stages<X>>,
        theta: S,
    ) -> X {
        dense::cubic(&record, theta)
    }
}

/// A one-step method with a system that it moves: most move any [`System`].
pub trait OneStep<S: Scalar, Y: System<S>>: Scheme<S> {
    /// The state after one step, from the slope at its start; not finite where a slope at a stage
    /// is not, see [`System::stage`].
    ///
    /// # Errors
    /// A fault of the system at a stage.
    fn advanced<L: Look<S, Y::State>>(
        &self,
        system: &mut Slopes<'_, Y, L>,
        start: StepStart<'_, S, Y::State>,
        step: S,
        stages: &mut Self::Stages<Y::State>,
    ) -> Result<Y::State, Fault>;

    /// One step of the size `step` from `time`, without control of the error.
    ///
    /// # Errors
    /// A fault of the system. The state is then as before.
    #[inline]
    fn step(&self, system: &mut Y, time: S, state: &mut Y::State, step: S) -> Result<(), Fault>
    where
        S: Real,
    {
        attempt(self, system, (time, state), step)
            .map_err(|fault| refused(self, system, (time, state), step, fault))
    }
}

/// No memory: inner slopes are not needed after the step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoStages;

/// Where a step starts.
#[derive(Clone, Copy, Debug)]
pub struct StepStart<'a, S, X> {
    /// The time.
    pub time: S,
    /// The state.
    pub state: &'a X,
    /// The rates of the state.
    pub slope: &'a X,
}

/// A step that was done, without the slopes within it.
#[derive(Clone, Copy, Debug)]
pub struct StepEnds<'a, S, X> {
    /// The size of the step.
    pub step: S,
    /// The state at its start.
    pub from: &'a X,
    /// The slope at its start.
    pub first: &'a X,
    /// The slope at its end.
    pub last: &'a X,
}

/// A step that was done, as the interpolant sees it.
#[derive(Clone, Copy, Debug)]
pub struct StepRecord<'a, S, X, K> {
    /// The size of the step.
    pub step: S,
    /// The state at its start.
    pub from: &'a X,
    /// The slope at its start.
    pub first: &'a X,
    /// The slopes at the inner stages.
    pub stages: &'a K,
    /// The state at its end.
    pub to: &'a X,
    /// The slope at its end.
    pub last: &'a X,
}

/// The interval of an integration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeSpan<S> {
    /// Where it starts (s).
    pub start: S,
    /// Where it ends (s), later than the start.
    pub end: S,
    /// The time from the start to the first output (s); a step control may begin with it, as
    /// `ode45` does.
    pub first_output: S,
}

impl<S: Real> TimeSpan<S> {
    /// Its length (s), finite and positive.
    fn duration(&self) -> Result<S, StartFault> {
        let duration = self.end - self.start;
        if duration.is_finite() && duration > S::zero() {
            Ok(duration)
        } else {
            Err(interval(self.start, self.end))
        }
    }
}

/// Room for a slope of a state: zeros, which cost less than a copy where one is written.
#[inline(always)]
fn room_for<S: Scalar, X: Vector<S>>(state: &X) -> X {
    state.room()
}
