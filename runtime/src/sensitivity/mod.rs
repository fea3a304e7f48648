//! Runs whose numbers carry derivatives: how what is read changes with parameters, inputs and the
//! start (forward sensitivities).
//!
//! A run over [`Forward`] numbers is the plain run, but for the choice of its steps. Numbers are
//! ordered by their values. The steps of a control are no functions of what they were chosen by,
//! and are held to a tolerance of values and derivatives together (`forward/shares.rs`).
//! `differentiable.rs` says through what derivatives go. Newton's method ends by values, when
//! derivatives are one iteration behind, so implicit methods are not among that.
//!
//! `start.rs` looks whether the derivatives of a start satisfy those of the constraints, which
//! nothing in a run would notice. `least_squares.rs` fits unknowns to measurements.

#[cfg(feature = "std")]
mod adjoint;
mod chosen;
mod differentiable;
mod least_squares;
mod simulation;
mod start;

use core::array::from_fn;
use core::fmt::{self, Debug};

#[cfg(feature = "std")]
pub use adjoint::{Adjoint, Gradient, Instant};
pub use differentiable::Differentiable;
pub use least_squares::{Fit, FitError, Squares, fit};
use simulation::Lifted;
pub use simulation::SensitivitySimulation;

use crate::dynamics::{Dynamics, Problem, parameters};
use crate::error::Fault;
use crate::error::setting::positive;
use crate::formulation::Formulation;
use crate::forward::{Forward, lifted};
use crate::independent::vary;
use crate::integrate::Method;
use crate::math::scalar::Real;
use crate::math::without_bounds::copied;
use crate::mechanism::handle::ValueHandle;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::Array as _;

/// A mechanism along `K` directions, each of a parameter, an input or the start: by
/// [`SensitivityExt::sensitivities`], or by `sensitivities` of
/// [`IndependentCoordinates`](crate::independent::IndependentCoordinates).
pub struct Sensitivities<M: Mechanism, const K: usize, S: Real = f64> {
    pub(crate) parameters: M::Parameters<Forward<S, K>>,
    pub(crate) start: Option<M::State<Forward<S, K>>>,
    /// Whether the limits of the description are left out.
    pub(crate) passes_limits: bool,
    scales: Option<[S; K]>,
}

/// The equations of motion along `K` directions.
type Equations<M, F, S, const K: usize> = Dynamics<Problem<M, F, Forward<S, K>>>;

copied!([M: Mechanism, const K: usize, S: Real] Sensitivities<M, K, S>);

impl<M: Mechanism, const K: usize, S: Real> Debug for Sensitivities<M, K, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sensitivities")
            .field("mechanism", &M::REPORT.name)
            .field("directions", &K)
            .finish_non_exhaustive()
    }
}

/// Derivatives of runs, by a method of the mechanism.
pub trait SensitivityExt: Mechanism {
    /// Runs from the described state that carry derivatives by these parameters and inputs.
    ///
    /// Everything that is read in such a run is a [`Forward`] number. Its value is that of the
    /// plain run. Its derivatives are exact ones of the numbers that the method computes.
    ///
    /// ```
    /// use holonom::prelude::*;
    ///
    /// /// A rod that swings, damped in its hinge.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// struct Rod {
    ///     #[param] // m
    ///     length: f64,
    ///     #[param] // N m s
    ///     damping: f64,
    ///     #[body(mass = 1.0, inertia = [0.1, 0.001, 0.1], position = [0.0, length / 2.0, 0.0])]
    ///     rod: Body,
    ///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    ///     hinge: Revolute,
    ///     #[force(
    ///         between = [ground, rod],
    ///         axis = [1.0, 0.0, 0.0],
    ///         stiffness = 0.0,
    ///         damping = damping,
    ///     )]
    ///     oil: TorsionalSpringDamper,
    /// }
    ///
    /// let (rod, h) = (Rod::new(1.0, 0.2)?, Rod::HANDLES);
    /// rod.sensitivities([h.length, h.damping])?
    ///     .simulation(StandardLagrange, DormandPrince::default())
    ///     .run(0.0..=2.0, every(0.5), |sample| {
    ///         let angle = sample.angle(h.hinge);
    ///         let [by_length, by_damping] = angle.derivatives();
    ///         println!("{:.3} rad, {by_length:+.3} rad/m, {by_damping:+.3}", angle.value());
    ///     })?;
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A parameter that is not acceptable.
    fn sensitivities<const K: usize>(
        &self,
        values: [ValueHandle<Self>; K],
    ) -> Result<Sensitivities<Self, K>, Fault> {
        let given = parameters::<f64, Self>(self)?;
        self.check_likes::<f64>(None)?;
        let mut parameters: Self::Parameters<Forward<f64, K>> = lifted(&given);
        for (direction, value) in values.iter().enumerate() {
            let place = parameters.as_mut_slice().get_mut(value.index());
            vary(place, direction);
        }
        Ok(Sensitivities::of(parameters, None))
    }
}

impl<M: Mechanism> SensitivityExt for M {}

impl<M: Mechanism, const K: usize, S: Real> Sensitivities<M, K, S> {
    fn of(
        parameters: M::Parameters<Forward<S, K>>,
        start: Option<M::State<Forward<S, K>>>,
    ) -> Self {
        Self {
            parameters,
            start,
            passes_limits: false,
            scales: None,
        }
    }

    /// Gives each direction a scale, in its unit: a change that counts. A step control holds
    /// derivatives to its relative tolerance, and to its absolute one over the scale.
    ///
    /// By default it is the size of the parameter or the input; one (unit of SI) where that is
    /// zero, and of coordinates and rates of the start.
    ///
    /// # Errors
    /// A scale that is not finite and positive.
    pub fn scales(mut self, scales: [S; K]) -> Result<Self, Fault> {
        for scale in scales {
            positive("scale of a direction", scale)?;
        }
        self.scales = Some(scales);
        Ok(self)
    }

    /// The scales that were given, or those of the parameters.
    fn known_scales(&self) -> [S; K] {
        self.scales.unwrap_or_else(|| {
            from_fn(|direction| {
                let along = self.parameters.as_slice().iter().filter(|number| {
                    let slope = number.derivatives().get(direction).copied();
                    slope.is_some_and(|slope| slope != S::zero())
                });
                let size = along.fold(S::zero(), |most: S, number| {
                    Real::max(most, number.value().abs())
                });
                if size > S::zero() { size } else { S::one() }
            })
        })
    }

    /// Starts from this state, whose numbers carry the derivatives of the start.
    ///
    /// A run refuses a start whose derivatives violate those of the constraints: where a parameter
    /// moves a joint, bodies move with it.
    #[must_use]
    pub fn initial_state(mut self, state: M::State<Forward<S, K>>) -> Self {
        self.start = Some(state);
        self
    }

    /// Passes the limits of the description. Runs that carry derivatives do not heed them, and are
    /// refused otherwise.
    #[must_use]
    pub fn without_limits(mut self) -> Self {
        self.passes_limits = true;
        self
    }

    /// A simulation in the coordinates that the attribute of the mechanism names.
    #[must_use]
    pub fn simulation<F, I>(
        self,
        formulation: F,
        integrator: I,
    ) -> SensitivitySimulation<Lifted<M, F::Carrying, S, K>, I::Carrying>
    where
        F: Differentiable<S, K, Carrying: Formulation<Forward<S, K>>>,
        I: Differentiable<S, K, Carrying: Method<Forward<S, K>>>,
    {
        let integrator = integrator.scaled(&self.known_scales());
        SensitivitySimulation::new(&self, formulation.carrying(), integrator)
    }

    /// The equations of motion with a formulation, for evaluations and for steps of one's own.
    ///
    /// # Errors
    /// A coefficient of the formulation that is not acceptable.
    pub fn dynamics<F>(&self, formulation: F) -> Result<Equations<M, F::Carrying, S, K>, Fault>
    where
        F: Differentiable<S, K, Carrying: Formulation<Forward<S, K>>>,
    {
        Dynamics::of_parameters(self.parameters, formulation.carrying())
    }

    /// The state that a run starts from.
    #[must_use]
    pub fn start(&self) -> M::State<Forward<S, K>> {
        self.start
            .unwrap_or_else(|| M::initial_state(&M::prepare(&self.parameters)))
    }
}
