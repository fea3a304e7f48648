//! Runs of a mechanism with numbers of type `f64`.

use crate::dynamics::Problem;
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::integrate::{Method, Scheme};
use crate::mechanism::kernels::Mechanism;
use crate::run::kinematics::KinematicAnalysis;
use crate::run::simulation::Simulation;
use crate::run::stepper::Stepper;

/// A simulation, a stepper or an analysis as a method of the mechanism, with numbers of type `f64`,
/// so that literals need no suffix: `arm.simulation(StandardLagrange, Rk4::every(1e-3))`.
///
/// For `f32` or numbers of your own call [`Simulation::new`], [`Stepper::new`] and
/// [`KinematicAnalysis::new`].
pub trait Simulate: Mechanism {
    /// [`Simulation::new`] with numbers of type `f64`.
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// # #[derive(Mechanism)]
    /// # #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// # struct Rod {
    /// #     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    /// #     rod: Body,
    /// #     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    /// #     hinge: Revolute,
    /// # }
    /// let rod = Rod::default();
    /// let mut highest = -1.0;
    /// rod.simulation(StandardLagrange, DormandPrince::default())
    ///     .run(0.0..=2.0, every(0.01), |sample| {
    ///         highest = sample.angle(Rod::HANDLES.hinge).sin().max(highest);
    ///     })?;
    /// assert!(highest.abs() < 1e-4); // as high as it began
    /// # Ok::<(), SimulationError<StateOf<Rod>>>(())
    /// ```
    #[must_use]
    fn simulation<F: Formulation<f64>, I: Method<f64>>(
        &self,
        formulation: F,
        integrator: I,
    ) -> Simulation<'_, Problem<Self, F>, I> {
        Simulation::new(self, formulation, integrator)
    }

    /// [`Stepper::new`] with numbers of type `f64`.
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// # #[derive(Mechanism)]
    /// # #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// # struct Rod {
    /// #     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    /// #     rod: Body,
    /// #     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    /// #     hinge: Revolute,
    /// # }
    /// let rod = Rod::default();
    /// let mut stepper = rod.stepper(StandardLagrange, Rk4)?;
    /// let mut state = stepper.initial_state()?;
    /// stepper.step(&mut state, 1e-3)?;
    /// assert!(stepper.view(&stepper.bodies(&state)).angle(Rod::HANDLES.hinge) < 0.0);
    /// # Ok::<(), Fault>(())
    /// ```
    ///
    /// # Errors
    /// As [`Stepper::new`].
    fn stepper<F: Formulation<f64>, K: Scheme<f64>>(
        &self,
        formulation: F,
        scheme: K,
    ) -> Result<Stepper<Problem<Self, F>, K>, Fault> {
        Stepper::new(self, formulation, scheme)
    }

    /// [`KinematicAnalysis::new`] with numbers of type `f64`.
    #[must_use]
    fn kinematic_analysis<F: Formulation<f64>>(
        &self,
        formulation: F,
    ) -> KinematicAnalysis<'_, Problem<Self, F>> {
        KinematicAnalysis::new(self, formulation)
    }
}

impl<M: Mechanism> Simulate for M {}
