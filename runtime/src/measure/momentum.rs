//! Mass, centre of mass and momentum of a mechanism, or of some of its bodies.
//!
//! Greenwood, *Advanced Dynamics* (2003), section 1.3. Momenta are sums over the bodies, also of
//! those without mass. Moments of inertia are about the centre of mass of each body, along its
//! principal axes.

use core::borrow::Borrow;

use nalgebra::Vector3;

use crate::error::ReadingFault;
use crate::math::scalar::Real;
use crate::math::vec3::{cross, minus, plus, read, times};
use crate::measure::access::MechanismExt as _;
use crate::measure::reaction::in_global_axes;
use crate::measure::view::View;
use crate::mechanism::bodies::Bodies;
use crate::mechanism::handle::BodyHandle;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::{Array as _, StateParts as _};

/// Of the whole mechanism, `view.centre_of_mass(..)`, of one body, or of some,
/// `view.linear_momentum([h.thigh, h.shank])`. The ground has no mass.
impl<S: Real, M: Mechanism, K: Borrow<M::Constants<S>>> View<'_, S, M, K> {
    /// The mass of these bodies together (kg).
    #[must_use]
    pub fn mass(&self, of: impl Bodies<M>) -> S {
        self.sum([S::zero()], &of, |_, mass| [mass])[0]
    }

    /// Their centre of mass (m, global).
    ///
    /// # Errors
    /// [`ReadingFault::NoMass`] where their masses add up to zero.
    pub fn centre_of_mass(&self, of: impl Bodies<M>) -> Result<Vector3<S>, ReadingFault> {
        let position = |body| M::pose(self.state(), body).position.into();
        Ok(self.mean(&of, position)?.into())
    }

    /// The velocity of their centre of mass (m/s, global).
    ///
    /// # Errors
    /// As [`View::centre_of_mass`].
    pub fn centre_of_mass_velocity(&self, of: impl Bodies<M>) -> Result<Vector3<S>, ReadingFault> {
        let velocity = |body| M::velocity(self.state(), body).into();
        Ok(self.mean(&of, velocity)?.into())
    }

    /// Their linear momentum (kg m/s, global): the sum of `m v`.
    #[must_use]
    pub fn linear_momentum(&self, of: impl Bodies<M>) -> Vector3<S> {
        let none = [S::zero(); 3];
        let momentum = |body, mass| times(&M::velocity(self.state(), body).into(), mass);
        self.sum(none, &of, momentum).into()
    }

    /// Their angular momentum (kg m^2/s, global) about a point (m, global) that is at rest: the sum
    /// of `(r - about) x m v` and of the angular momentum of each body about its own centre.
    #[must_use]
    pub fn angular_momentum(&self, of: impl Bodies<M>, about: Vector3<S>) -> Vector3<S> {
        let none = [S::zero(); 3];
        self.angular(&of, &about.into(), &none).into()
    }

    /// Their angular momentum (kg m^2/s, global) about their common centre of mass, with the
    /// velocities against it.
    ///
    /// # Errors
    /// As [`View::centre_of_mass`].
    pub fn angular_momentum_about_centre(
        &self,
        of: impl Bodies<M>,
    ) -> Result<Vector3<S>, ReadingFault> {
        let centre = self.centre_of_mass(&of)?.into();
        let velocity = self.centre_of_mass_velocity(&of)?.into();
        Ok(self.angular(&of, &centre, &velocity).into())
    }

    /// The angular momentum about a point that moves, with the velocities against it.
    fn angular(&self, of: &impl Bodies<M>, about: &[S; 3], moving: &[S; 3]) -> [S; 3] {
        let state = self.state_of_kernels();
        let masses = M::mass::<S>(self.constants());
        self.sum([S::zero(); 3], of, |body, mass| {
            let arm = minus(&M::pose(self.state(), body).position.into(), about);
            let velocity = minus(&M::velocity(self.state(), body).into(), moving);
            let orbital = times(&cross(&arm, &velocity), mass);
            let Some((info, _)) = body.orientation() else {
                return orbital;
            };
            let [j1, j2, j3]: [S; 3] = read(masses.as_slice(), info.velocity + 3);
            let [w1, w2, w3] = read(self.state().velocities().as_slice(), info.velocity + 3);
            let spin = in_global_axes::<S, M>(&state, body, [j1 * w1, j2 * w2, j3 * w3]);
            plus(&orbital, &spin)
        })
    }

    /// The mean of a vector of each body, by masses.
    fn mean(
        &self,
        of: &impl Bodies<M>,
        vector: impl Fn(BodyHandle<M>) -> [S; 3],
    ) -> Result<[S; 3], ReadingFault> {
        let total = total_mass::<S, M>(self.constants(), of)?;
        // By shares, so that the mean over one body is that of the body to the last bit.
        Ok(self.sum([S::zero(); 3], of, |body, mass| {
            times(&vector(body), mass.quotient(total))
        }))
    }

    /// The sum of what each of some bodies adds, by its mass (kg).
    fn sum<const N: usize>(
        &self,
        none: [S; N],
        of: &impl Bodies<M>,
        part: impl Fn(BodyHandle<M>, S) -> [S; N],
    ) -> [S; N] {
        let mut sum = none;
        for (body, mass) in masses::<S, M>(self.constants(), of) {
            let added = part(BodyHandle::new(body), mass);
            for (sum, part) in sum.iter_mut().zip(added) {
                *sum = *sum + part;
            }
        }
        sum
    }
}

/// The places and masses (kg) of some bodies.
pub(crate) fn masses<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    of: &impl Bodies<M>,
) -> impl Iterator<Item = (usize, S)> {
    let masses = M::mass::<S>(constants);
    let bodies = M::REPORT.bodies.iter().enumerate();
    bodies.filter_map(move |(number, body)| {
        let [mass] = read(masses.as_slice(), body.velocity);
        of.has(number).then_some((number, mass))
    })
}

/// The mass of some bodies together (kg), which is more than round-off. Bodies that are `as_given`
/// may have masses that cancel.
pub(crate) fn total_mass<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    of: &impl Bodies<M>,
) -> Result<S, ReadingFault> {
    let (mut total, mut size, mut bodies) = (S::zero(), S::zero(), 0);
    for (_, mass) in masses::<S, M>(constants, of) {
        total = total + mass;
        size = size + mass.abs();
        bodies += 1;
    }
    if total.abs() > size * S::EPSILON * S::constant(f64::from(bodies)) {
        Ok(total)
    } else {
        Err(ReadingFault::NoMass { bodies })
    }
}
