//! The generalized-alpha method on constraints, with steps of positions on the group of motions.

use core::mem::replace;

use super::fixed::Grid;
use super::lobatto::better_end;
use super::record::{LastStep, Reached, reached};
use super::{
    Advance, Counts, ErrorModel, Integration, Integrator, Memory, Method, NoStages,
    RigidConstraints, TimeSpan, dense,
};
use crate::error::{Fault, StartFault};
use crate::math::scalar::Real;
use crate::math::without_bounds::opaque;
use crate::state::vector::Vector;

/// The generalized-alpha method of order 2 for mechanisms with rigid constraints, fixed step:
/// positions *and* velocities are on the constraints after every step, high frequencies are damped
/// as much as wanted, and positions of bodies and orientations never leave their joints or length
/// 1, so that no stabilisation is needed.
///
/// From `q0`, `u0`, the accelerations `u0'` and the method's own `a0`, a step `h` solves for `u1'`,
/// `lambda` and `eta`
///
/// ```text
/// M u1' + D^T lambda = g(t1, q1, u1)                     Phi(q1, t1) = 0,  Phi'(q1, u1, t1) = 0
/// (1 - alpha_m) a1 + alpha_m a0 = (1 - alpha_f) u1' + alpha_f u0'
/// u1 = u0 + h ((1 - gamma) a0 + gamma a1)
/// q1 = q0 o exp(d),  d = h u0 + h^2 ((1/2 - beta) a0 + beta a1) - M^-1 (D0 + D1)^T eta / 2
/// ```
///
/// where `o exp(d)` adds the displacement to positions and turns orientations by the rotation
/// vector along body axes. With the spectral radius `rho` at infinite frequency,
/// `alpha_m = (2 rho - 1) / (rho + 1)`, `alpha_f = rho / (rho + 1)`,
/// `gamma = 1/2 + alpha_f - alpha_m`, `beta = (gamma + 1/2)^2 / 4` (Chung and Hulbert 1993; Arnold
/// and Bruls, *Convergence of the generalized-alpha scheme for constrained mechanical systems*,
/// Multibody System Dynamics 18 (2007), 185-202; on the group: Bruls and Cardona, *On the use of
/// Lie group time integrators in multibody dynamics*, J. Comput. Nonlinear Dynam. 5 (2010),
/// 031002). With `eta` and `Phi'` it is the stabilised form of index 2 of Gear, Gupta and
/// Leimkuhler (for this method: Arnold, Bruls and Cardona, *Error analysis of generalized-alpha Lie
/// group time integration methods for constrained mechanical systems*, Numer. Math. 129 (2015),
/// 149-179; here `eta` acts through `M^-1`, as in a [`Projection`](crate::Projection), and by the
/// gradients at both ends, so that a step with `rho = 1` is symmetric). Without them, on index 3,
/// velocities would leave the constraints by the second order of the step, `rho = 1` would be
/// unstable, and round-off of positions would reach multipliers by `1 / h^2`.
///
/// **The iteration** is Newton's with the matrix `[M D^T; D 0]`, factorised at every iterate: the
/// saddle system that the mechanism is generated with, without derivatives of forces. Its unknowns
/// are increments of velocities and positions with multipliers scaled to these, so that the matrix
/// does not depend on `h` and short steps lose no digits. Former iterates tell what forces do: the
/// next one is the combination of the last five changes that leaves least of them (Anderson's
/// acceleration, which for linear forces is the method of generalised minimal residuals), so that a
/// few stiff springs and dampers are followed at steps far beyond their own times: the governor's
/// dampers decay with 8117 1/s and are solved for at steps of 0.01 s. It goes on until it changes
/// by round-off only: some six iterations for what is not stiff, up to some thirty for what is,
/// each of the cost of an evaluation or somewhat more. Where it does not converge the run ends with
/// [`StepFault::NotSolved`](crate::error::StepFault::NotSolved), and time and state are those
/// before the step. Many different stiff springs at once, as of a finite element mesh, are beyond
/// it.
///
/// **What it needs** is a system with [`RigidConstraints`]: a mechanism in absolute coordinates
/// with [`StandardLagrange`](crate::StandardLagrange). With another formulation and in joint
/// coordinates (a tree has no constraints: any method keeps its joints closed) a run does not
/// compile. Where equations depend on each other it ends with
/// [`StepFault::Singular`](crate::error::StepFault::Singular).
///
/// `a0` begins as `u0'`, and so it does after a break. Energy: kept for `rho = 1` but for a swing
/// of the order of `h^2`; a motion of `x` radians a step loses `((1 - rho) / (1 + rho))^3 x^4 / 2`
/// of its amplitude a step, and is late by `(1/12 + 3/8 ((1 - rho) / (1 + rho))^2) x^3` radians.
/// Output within a step is by the cubic through states and slopes at both ends, on the constraints
/// to its order.
///
/// ```
/// use holonom::prelude::*;
/// use holonom::GeneralizedAlpha;
///
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81])]
/// struct Pendulum {
///     #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5, 0.0, 0.0])]
///     bob: Body,
///     #[joint(between = [ground, bob], point = [0.0, 0.0, 0.0])]
///     pivot: Spherical,
/// }
///
/// let method = GeneralizedAlpha::every(0.005).spectral_radius(0.9);
/// let pendulum = Pendulum::default();
/// Simulation::new(&pendulum, StandardLagrange, method).run(0.0..=2.0, every(0.1), |sample| {
///     assert!(sample.violation() < 1e-12);
/// })?;
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeneralizedAlpha<S> {
    /// The step `h` (s).
    pub step: S,
    /// The spectral radius at infinite frequency, from 0 (what is fast is gone after a step) to 1
    /// (it stays).
    pub rho: S,
}

impl<S: Real> GeneralizedAlpha<S> {
    /// With a fixed step (s) and a spectral radius of 0.8.
    #[must_use]
    pub fn every(step: S) -> Self {
        Self {
            step,
            rho: S::constant(0.8),
        }
    }

    /// With another spectral radius at infinite frequency, from 0 to 1.
    #[must_use]
    pub fn spectral_radius(self, rho: S) -> Self {
        Self { rho, ..self }
    }

    /// `(1 - rho) / (1 + rho)`, from 0 to 1.
    fn damping(&self) -> f64 {
        let rho = self.rho.to_f64();
        (1.0 - rho) / (1.0 + rho)
    }
}

/// The coefficients of a step of the generalized-alpha method.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct AlphaWeights<S> {
    /// What `a0` counts in the relation of accelerations.
    pub alpha_m: S,
    /// What `u0'` counts there.
    pub alpha_f: S,
    /// What `h^2 a1` counts in the step of positions.
    pub beta: S,
    /// What `h a1` counts in the step of velocities.
    pub gamma: S,
}

impl<S: Real> AlphaWeights<S> {
    /// Those of order 2 and the least error at low frequencies for a spectral radius.
    ///
    /// # Errors
    /// [`StartFault::SpectralRadius`] if it is not from 0 to 1.
    pub fn of(rho: S) -> Result<Self, StartFault> {
        if !(rho >= S::zero() && rho <= S::one()) {
            return Err(StartFault::SpectralRadius {
                value: rho.to_f64(),
            });
        }
        let sum = rho + S::one();
        let alpha_m = (rho + rho - S::one()).quotient(sum);
        let alpha_f = rho.quotient(sum);
        let half = S::constant(0.5);
        let gamma = half + alpha_f - alpha_m;
        let root = gamma + half;
        Ok(Self {
            alpha_m,
            alpha_f,
            beta: S::constant(0.25) * root * root,
            gamma,
        })
    }
}

/// A step that is asked for, see [`RigidConstraints::step_on_constraints`].
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct AlphaStep<'a, S, X> {
    /// Its coefficients.
    pub weights: AlphaWeights<S>,
    /// Its end (s).
    pub end: S,
    /// Its size `h` (s).
    pub step: S,
    /// The state at its start.
    pub state: &'a X,
    /// The rates there: `u0'` among them.
    pub slope: &'a X,
    /// `a0`, in the places of the accelerations.
    pub auxiliary: &'a X,
}

/// A step that was solved.
#[derive(Clone, Debug)]
pub struct AlphaEnd<X> {
    /// The state at its end.
    pub state: X,
    /// The rates there: `u1'` among them.
    pub slope: X,
    /// `a1`, in the places of the accelerations.
    pub auxiliary: X,
    /// Evaluations that it took.
    pub evaluations: usize,
}

impl<S: Real, Y: RigidConstraints<S>> Integrator<S, Y> for GeneralizedAlpha<S> {
    type Integration = GeneralizedAlphaIntegration<S, Y::State>;

    fn start(
        &self,
        system: &mut Y,
        span: TimeSpan<S>,
        state: Y::State,
    ) -> Result<GeneralizedAlphaIntegration<S, Y::State>, Fault> {
        let weights = AlphaWeights::of(self.rho)?;
        let grid = Grid::new(self.step, &span)?;
        let reached = Reached::start(system, &span, state)?;
        Ok(GeneralizedAlphaIntegration {
            weights,
            grid,
            last: LastStep::none(&reached),
            auxiliary: reached.slope.clone(),
            reached,
        })
    }
}

impl<S: Real> Method<S> for GeneralizedAlpha<S> {
    fn fixed_step(&self) -> Option<S> {
        Some(self.step)
    }

    fn companion(&self, _duration: S) -> Option<Self> {
        let step = self.step * S::constant(0.5);
        Some(Self { step, ..*self })
    }

    /// `|p|` stays 1 and says nothing of the angle. The phase error is three times that of a linear
    /// oscillation: a rod that swings by a right angle to either side is off by 2.3 times as much.
    fn error_model(&self) -> ErrorModel {
        ErrorModel {
            angle_error: 1.0,
            phase_error: 3.0 * (1.0 / 12.0 + 0.375 * self.damping() * self.damping()),
            ..Default::default()
        }
    }
}

/// An integration with [`GeneralizedAlpha`] under way.
#[derive(Clone)]
pub struct GeneralizedAlphaIntegration<S: Real, X: Vector<S>> {
    weights: AlphaWeights<S>,
    grid: Grid<S>,
    /// With the rates that the last step has solved for.
    reached: Reached<S, X>,
    auxiliary: X,
    last: LastStep<S, X>,
}

opaque!([S: Real, X: Vector<S>] GeneralizedAlphaIntegration<S, X>, "GeneralizedAlphaIntegration");

impl<S: Real, X: Vector<S>> Integration<S, X> for GeneralizedAlphaIntegration<S, X> {
    reached!();

    fn remember(&mut self, memory: &mut Memory<'_, S>) -> bool {
        self.reached.remember(memory);
        memory.vector(&mut self.auxiliary);
        true
    }
}

impl<S, Y> Advance<S, Y> for GeneralizedAlphaIntegration<S, Y::State>
where
    S: Real,
    Y: RigidConstraints<S>,
{
    fn advance(&mut self, system: &mut Y) -> Result<(), Fault> {
        self.reached.know_slope(system)?;
        let reached = &mut self.reached;
        let (step, time) = self.grid.next(reached.counts.accepted, reached.time)?;
        let mut end = system.step_on_constraints(AlphaStep {
            weights: self.weights,
            end: time,
            step,
            state: &reached.state,
            slope: &reached.slope,
            auxiliary: &self.auxiliary,
        })?;
        reached.counts.evaluations += end.evaluations;
        system.renormalise(&mut end.state, Some(&mut end.slope));
        system.follow(&reached.state, step, &mut end.state);
        self.last.first = replace(&mut reached.slope, end.slope);
        self.auxiliary = end.auxiliary;
        self.last.go(reached, (step, time), end.state);
        Ok(())
    }

    fn at(&mut self, _system: &mut Y, time: S) -> Result<Y::State, Fault> {
        let record = self.last.record(&self.reached, &NoStages);
        Ok(dense::cubic(&record, self.last.theta(&self.reached, time)))
    }

    fn better_end(&self, system: &mut Y) -> Result<Option<Y::State>, Fault> {
        better_end(system, &self.last, &self.reached).map(Some)
    }
}
