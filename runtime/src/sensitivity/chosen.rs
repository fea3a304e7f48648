//! Runs from a state in chosen coordinates.

use super::Sensitivities;
use crate::error::Fault;
use crate::independent::{Direction, IndependentCoordinates};
use crate::math::scalar::Real;
use crate::mechanism::joint_rates::JointRates;

impl<M: JointRates, const N: usize, S: Real> IndependentCoordinates<M, N, S> {
    /// Runs from a state that carry derivatives along these directions: by parameters and inputs,
    /// and by the chosen coordinates and their rates at the start.
    ///
    /// A parameter leaves the chosen coordinates and rates of the start as they are. Where it
    /// changes a closed loop, the other coordinates follow. The parameters and inputs are those of
    /// the space.
    ///
    /// ```
    /// use holonom::independent::Direction;
    /// use holonom::prelude::*;
    /// use holonom::sensitivity::SensitivityExt;
    ///
    /// /// A pendulum.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass])]
    /// struct Rod {
    ///     #[param]
    ///     length: f64,
    ///     #[body(mass = 1.0, inertia = [0.1, 0.001, 0.1], position = [0.0, 0.0, -length / 2.0])]
    ///     rod: Body,
    ///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    ///     hinge: Revolute,
    /// }
    ///
    /// let (rod, h) = (Rod::new(1.0)?, Rod::HANDLES);
    /// let space = rod.coordinates([h.hinge])?;
    /// let start = space.state([0.01], [0.0])?;
    /// let directions = [h.length.into(), Direction::position(h.hinge)];
    /// let mut end = [0.0; 2];
    /// space
    ///     .sensitivities(&start, directions)?
    ///     .simulation(StandardLagrange, Rk4::every(1e-3))
    ///     .run(0.0..=1.0, every(1.0), |sample| {
    ///         end = sample.angle(h.hinge).derivatives();
    ///     })?;
    /// // A small swing: the angle is that of the start times `cos(w t)`.
    /// let w = (9.81 * 0.5_f64 / (0.1 + 0.25)).sqrt();
    /// assert!((end[1] - w.cos()).abs() < 1e-4);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`];
    /// [`AnalysisFault::NotChosen`] for a direction that is none of the chosen coordinates.
    ///
    /// [`AnalysisFault::NotChosen`]: crate::error::AnalysisFault::NotChosen
    pub fn sensitivities<const K: usize>(
        &self,
        start: &M::JointState<S>,
        directions: [Direction<M>; K],
    ) -> Result<Sensitivities<M, K, S>, Fault> {
        let (parameters, start) = self.start_along(start, &directions)?;
        let along = Sensitivities::of(parameters, Some(start));
        Ok(Sensitivities {
            passes_limits: self.passes_limits,
            ..along
        })
    }
}
