//! The equations of motion over numbers that carry derivatives: second derivatives of all that is a
//! derivative already.

use super::IndependentCoordinates;
use super::points::moved;
use crate::forward::{Forward, lifted};
use crate::math::scalar::Real;
use crate::mechanism::joint_rates::JointRates;

impl<M: JointRates, const N: usize, S: Real> IndependentCoordinates<M, N, S> {
    /// The same coordinates over [`Forward`] numbers with `K` derivatives. Nothing varies yet:
    /// [`set_value`](Self::set_value) takes a parameter or an input that does,
    /// [`state`](Self::state) coordinates and rates.
    ///
    /// Whatever is computed then comes with its derivatives. Of what is a derivative already these
    /// are second ones. Of [`linearise`](Self::linearise) they are how a linear model changes. Of a
    /// [`gradient`](crate::sensitivity::Adjoint::gradient) they are products of the Hessian of a
    /// cost with the directions along which controls vary. Kernels that derivatives are taken by
    /// are used as they are.
    ///
    /// ```
    /// use holonom::Forward;
    /// use holonom::prelude::*;
    ///
    /// /// A weight at the end of a rod of a length that may be set.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, inverse])]
    /// struct Pendulum {
    ///     #[param] // m
    ///     length: f64,
    ///     #[body(mass = 1.0, inertia = [0.5, 0.5, 0.5], position = [0.0, 0.0, -length])]
    ///     weight: Body,
    ///     #[joint(between = [ground, weight], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    ///     hinge: Revolute,
    /// }
    ///
    /// let (pendulum, h) = (Pendulum::new(2.0)?, Pendulum::HANDLES);
    /// let mut space = pendulum.coordinates([h.hinge])?.carrying::<1>();
    /// space.set_value(h.length, Forward::along(2.0, 0))?;
    /// let zero = Forward::fixed(0.0);
    /// let hanging = space.state([zero], [zero])?;
    /// let linear = space.linearise(&hanging, [], |_| [])?;
    /// let stiffness = linear.a::<2>()[(1, 0)];
    /// // -m g l / (J + m l^2), and what it changes by with l.
    /// assert!((stiffness.value() + 9.81 * 2.0 / 4.5).abs() < 1e-14);
    /// assert!((stiffness.derivatives()[0] - 9.81 * 3.5 / 4.5 / 4.5).abs() < 1e-14);
    /// # Ok::<(), Fault>(())
    /// ```
    #[must_use]
    pub fn carrying<const K: usize>(&self) -> IndependentCoordinates<M, N, Forward<S, K>> {
        let described = self.described.as_ref().map(|(state, positions)| {
            let state = moved::<M, S, K>(state, |_| [S::zero(); K]);
            (state, positions.map(Forward::fixed))
        });
        IndependentCoordinates {
            parameters: lifted(&self.parameters),
            constants: lifted(&self.constants),
            equations: self.equations.lifted(),
            described,
            passes_limits: self.passes_limits,
        }
    }
}
