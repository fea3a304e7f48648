//! Contacts of shapes with surfaces, as a user writes them.

use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::point::Located;
use crate::nonsmooth::cam::Cam;
use crate::nonsmooth::interaction::Interaction;
use crate::nonsmooth::law::{Friction, Law, Tangent};
use crate::nonsmooth::place::{At, Plane, direction_on};
use crate::nonsmooth::quantity::Quantity;
use crate::nonsmooth::shape::{Direction, Shape, Surface};
use crate::nonsmooth::sphere::Sphere;

impl<S: Real, M: Mechanism> Interaction<S, M> {
    /// A point of a body, or a centre of mass, that does not pass a plane: a limit on its distance
    /// from it (m). With [`Interaction::radius`] it is the centre of a ball. Without friction
    /// unless [`Interaction::with_friction`] says so.
    #[must_use]
    pub fn contact(point: impl Located<M>, plane: Plane<S, M>) -> Self {
        Self::touching(
            At::of(point),
            Surface::Plane(plane.place),
            Shape::Ball(S::zero()),
        )
    }

    /// A ball about a point of a body or a centre of mass that does not pass a sphere: another
    /// ball, or a bowl that it is in. [`Interaction::radius`] is that of the first one.
    #[must_use]
    pub fn contact_with_sphere(centre: impl Located<M>, sphere: Sphere<S, M>) -> Self {
        Self::touching(
            At::of(centre),
            Surface::Sphere(sphere.place),
            Shape::Ball(S::zero()),
        )
    }

    /// The edge of a disc that does not pass a plane: a wheel, a coin, the rim of a cylinder. Its
    /// centre is a point of a body or a centre of mass. Its axis, of any length but zero, is along
    /// the user's axes of that body. `radius` (m) is that of the edge. With [`Interaction::tube`]
    /// the edge is round: a tyre.
    ///
    /// A disc that lies flat touches nowhere in particular: a run that gets there ends with
    /// [`StepFault::EventNotANumber`](crate::error::StepFault::EventNotANumber).
    #[must_use]
    pub fn contact_of_disc(
        centre: impl Located<M>,
        axis: [S; 3],
        radius: S,
        plane: Plane<S, M>,
    ) -> Self {
        let at = At::of(centre);
        let axis = direction_on::<S, M>(at.body::<M>(), &axis);
        let tube = S::zero();
        let shape = Shape::Disc { axis, radius, tube };
        Self::touching(at, Surface::Plane(plane.place), shape)
    }

    /// A cam that does not pass a plane, as of a flat follower: see [`Cam::about`].
    ///
    /// In space the cam is thin. A plane whose normal is along its axis touches it nowhere in
    /// particular, as a disc that lies flat, [`Interaction::contact_of_disc`].
    #[must_use]
    pub fn contact_of_cam(cam: Cam<S, M>, plane: Plane<S, M>) -> Self {
        let shape = Shape::Cam(cam.outline);
        Self::touching(cam.at, Surface::Plane(plane.place), shape)
    }

    /// A roller or a ball about a point of a body or a centre of mass that does not pass a cam,
    /// with the [`Interaction::radius`] of the roller. Friction is counted along the direction of
    /// increasing angles of the cam, and along its axis.
    ///
    /// The gap is the distance from the profile as long as the centre of the roller is outside of
    /// the cam. Within, it is negative and at least as deep as the distance.
    #[must_use]
    pub fn contact_with_cam(centre: impl Located<M>, cam: Cam<S, M>) -> Self {
        Self::touching(
            At::of(centre),
            Surface::Cam(cam.at, cam.outline),
            Shape::Ball(S::zero()),
        )
    }

    fn touching(at: At, surface: Surface<S>, shape: Shape<S>) -> Self {
        Self::apart(Quantity::Gap(at, surface, shape), S::zero())
    }

    /// The radius (m) of the cross section of the edge of [`Interaction::contact_of_disc`], whose
    /// middle circle has the radius that was given there.
    #[must_use]
    pub fn tube(mut self, tube: S) -> Self {
        match &mut self.quantity {
            Quantity::Gap(_, _, Shape::Disc { tube: place, .. }) => *place = tube,
            _ => self.misplaced = Some("tube"),
        }
        self
    }

    /// The contact with dry friction in its plane: Coulomb's, `|T| <= mu N`, with the cone. What
    /// results stands in the list of [`Simulation::interactions`](crate::Simulation::interactions)
    /// side by side: the contact, and its friction along both directions of the plane, which are
    /// those of [`Plane::along`] and of the normal times that. Their efforts (N) act on the body of
    /// the point, and their rates (m/s) are the slip: the velocity of the material that touches,
    /// against that of the plane.
    ///
    /// A contact that sticks rolls, and slips where its friction is at `mu N`. Both are found
    /// together with what opens and closes, for all contacts at once. Say restitution, radius and
    /// tube before.
    ///
    /// ```
    /// use holonom::prelude::*;
    /// use holonom::run::{InteractionMode, Plane};
    ///
    /// /// A bowling ball of 7 kg, thrown at 8 m/s without a turn.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81])]
    /// struct Bowling {
    ///     #[body(
    ///         free, mass = 7.0, inertia = [0.028, 0.028, 0.028],
    ///         position = [0.0, 0.0, 0.1], velocity = [8.0, 0.0, 0.0]
    ///     )]
    ///     ball: Body,
    /// }
    ///
    /// let (bowling, h) = (Bowling::default(), Bowling::HANDLES);
    /// let floor = Plane::on_ground([0.0; 3], [0.0, 0.0, 1.0]);
    /// let contact = Interaction::contact(h.ball, floor).radius(0.1).with_friction(0.2);
    /// let [_, along, _] = Interaction::handles(&contact);
    /// bowling
    ///     .simulation(StandardLagrange, DormandPrince::default())
    ///     .interactions(contact)
    ///     .run(0.0..=2.0, every(0.01), |sample| -> Result<(), Fault> {
    ///         // It rolls from 2 v / (7 mu g) on, at 5 v / 7.
    ///         let rolls = sample.mode(along)? == InteractionMode::Sticking;
    ///         let after = sample.time() - 2.0 * 8.0 / (7.0 * 0.2 * 9.81);
    ///         assert!(after.abs() < 1e-9 || rolls == (after > 0.0));
    ///         let speed = sample.velocity(h.ball).x;
    ///         assert!(!rolls || (speed - 5.0 / 7.0 * 8.0).abs() < 1e-9);
    ///         Ok(())
    ///     })?;
    /// # Ok::<(), RunError<StateOf<Bowling>, Fault>>(())
    /// ```
    #[must_use]
    pub fn with_friction(self, coefficient: S) -> [Self; 3] {
        let along = self.tangent(coefficient, Direction::Along, 1, true);
        let across = self.tangent(coefficient, Direction::Across, 2, true);
        [self, along, across]
    }

    /// The contact with dry friction along [`Plane::along`] alone: of a plane mechanism, whose
    /// joints leave no slip in the other direction. It costs less than
    /// [`Interaction::with_friction`].
    #[must_use]
    pub fn with_plane_friction(self, coefficient: S) -> [Self; 2] {
        let along = self.tangent(coefficient, Direction::Along, 1, false);
        [self, along]
    }

    fn tangent(self, coefficient: S, along: Direction, behind: usize, has_both: bool) -> Self {
        let place = Tangent { behind, has_both };
        let law = Law::Friction(Friction::of_contact(coefficient, place));
        match self.quantity {
            Quantity::Gap(at, surface, shape) => {
                Self::new(Quantity::Slip(at, surface, shape, along), law)
            }
            quantity => {
                let mut tangent = Self::new(quantity, law);
                tangent.misplaced = Some("with_friction");
                tangent
            }
        }
    }
}
