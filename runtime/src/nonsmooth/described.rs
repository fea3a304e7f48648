//! The limits that a description has.

use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::interaction::Interaction;
use crate::state::vector::Array as _;

/// A mechanism with `N` joints that have limits, `#[joint(.., limits = [-1.0, 1.0])]`; the macro
/// implements it. A run heeds them where it is told to, by
/// [`Simulation::limits`](crate::Simulation::limits).
#[diagnostic::on_unimplemented(
    message = "no joint of `{Self}` has limits",
    label = "without limits in its description",
    note = "a hinge or a slide has limits by `#[joint(.., limits = [-1.0, 1.0])]`"
)]
pub trait Limited<const N: usize>: Mechanism {
    /// The limits with parameters that were accepted.
    #[doc(hidden)]
    fn limits_of<S: Real>(parameters: &Self::Parameters<S>) -> [Interaction<S, Self>; N];

    /// The limits in the order of the fields, to stand beside other interactions:
    ///
    /// ```
    /// use holonom::prelude::*;
    ///
    /// /// A rod of 1 m, released from the horizontal.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// struct Rod {
    ///     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    ///     rod: Body,
    ///     #[joint(
    ///         between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0],
    ///         limits = [-1.0, 1.0], restitution = 0.4
    ///     )]
    ///     hinge: Revolute,
    /// }
    ///
    /// let (rod, h) = (Rod::default(), Rod::HANDLES);
    /// let [hinge] = rod.limits();
    /// rod.simulation(StandardLagrange, DormandPrince::default())
    ///     .interactions([hinge, Interaction::friction(h.hinge.angle(), 0.2)])
    ///     .run(0.0..=10.0, every(0.01), |sample| {
    ///         assert!(sample.angle(h.hinge) > -1.0 - 1e-9);
    ///     })?;
    /// # Ok::<(), SimulationError<StateOf<Rod>>>(())
    /// ```
    ///
    /// Limits that are parameters have the values of this mechanism, also where a handler sets
    /// others in a run. With parameters that are not acceptable, for which any run is refused, they
    /// say nothing.
    fn limits<S: Real>(&self) -> [Interaction<S, Self>; N] {
        let parameters = self.parameters::<S>();
        Self::limits_of(&parameters.unwrap_or_else(|_| Self::Parameters::zeros()))
    }
}
