//! Limits, friction, brakes and clutches, as a user writes them.

use core::fmt::{self, Debug};
use core::marker::PhantomData;

use crate::math::scalar::Real;
use crate::mechanism::handle::JointHandle;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::limits::JointLimits;
use crate::mechanism::point::Located;
use crate::nonsmooth::bearing::{Bearing, HasBearing};
use crate::nonsmooth::law::{Friction, Law, Limits, Rest};
use crate::nonsmooth::place::At;
use crate::nonsmooth::quantity::{JointQuantity, JointReading, Quantity};
use crate::nonsmooth::shape::Shape;

/// What holds a quantity of a mechanism by turns, and lets it go by turns: a limit, dry friction, a
/// brake or a clutch. For [`Simulation::interactions`](crate::Simulation::interactions), see
/// [`guide::contact`](mod@crate::guide::contact).
pub struct Interaction<S, M> {
    pub(crate) quantity: Quantity<S>,
    pub(crate) law: Law<S>,
    /// A setting that its kind does not have.
    pub(super) misplaced: Option<&'static str>,
    /// It is a limit of the description.
    pub(crate) is_described: bool,
    /// It is not heeded.
    pub(crate) is_dropped: bool,
    mechanism: PhantomData<fn() -> M>,
}

impl<S: Copy, M> Clone for Interaction<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Copy, M> Copy for Interaction<S, M> {}

impl<S: Debug, M> Debug for Interaction<S, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Interaction")
            .field("quantity", &self.quantity)
            .field("law", &self.law)
            .finish_non_exhaustive()
    }
}

impl<S: Real, M: Mechanism> Interaction<S, M> {
    pub(super) fn new(quantity: Quantity<S>, law: Law<S>) -> Self {
        Self {
            quantity,
            law,
            misplaced: None,
            is_described: false,
            is_dropped: false,
            mechanism: PhantomData,
        }
    }

    /// The limits of a joint of the description.
    #[doc(hidden)]
    #[must_use]
    pub fn of_description(limits: JointLimits<S>) -> Self {
        let reading = if limits.is_angle {
            JointReading::Angle(limits.joint)
        } else {
            JointReading::Displacement(limits.joint)
        };
        let law = Limits {
            restitution: limits.restitution,
            ..Limits::between(limits.bounds)
        };
        let interaction = Self::new(Quantity::Joint(reading), Law::Limits(law));
        Self {
            is_described: true,
            ..interaction
        }
    }

    /// What holds nothing.
    pub(crate) fn nothing() -> Self {
        let limits = JointLimits {
            joint: 0,
            is_angle: true,
            bounds: [S::zero(), S::one()],
            restitution: S::zero(),
        };
        Self {
            is_dropped: true,
            ..Self::of_description(limits)
        }
    }

    /// Whether it holds the same quantity between limits.
    pub(crate) fn limits_the_same(&self, other: &Self) -> bool {
        let are_limits = matches!((&self.law, &other.law), (Law::Limits(_), Law::Limits(_)));
        are_limits && self.quantity == other.quantity
    }

    /// Stops at the lower and at the upper end of a quantity (rad, m), which it does not pass;
    /// infinite where there is none. A stop pushes with whatever effort that takes, and does not
    /// pull.
    ///
    /// An impact has no restitution if none is given. Impulses act in the metric of the mass, on
    /// the whole mechanism, and all impacts of an instant are one problem.
    ///
    /// An angle is that of [`View::angle`](crate::View::angle), which goes on over turns: ends may
    /// be more than a turn apart, and are meant as they are written.
    #[must_use]
    pub fn limits(quantity: JointQuantity<M>, bounds: [S; 2]) -> Self {
        let law = Law::Limits(Limits::between(bounds));
        Self::new(Quantity::Joint(quantity.reading), law)
    }

    /// Two points whose distance is at least this one (m), without friction: two balls, with the
    /// sum of their radii. [`Interaction::strut`] is the same.
    #[must_use]
    pub fn contact_of_balls(first: impl Located<M>, second: impl Located<M>, distance: S) -> Self {
        Self::strut(first, second, distance)
    }

    /// A rope between two points: it does not stretch beyond its length (m), has no mass, and goes
    /// slack where they come closer. Each point is a named point, of a body or of the ground, or a
    /// centre of mass.
    ///
    /// Its effort is the tension (N) with a negative sign: it acts against a distance that grows.
    /// A rope that is drawn tight gives an impulse, with [`Interaction::restitution`].
    ///
    /// ```
    /// use holonom::prelude::*;
    ///
    /// /// A bob of 2 kg beside a nail, let go 0.6 m from it.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// struct Bob {
    ///     #[body(free, mass = 2.0, position = [0.6, 0.0, 0.0])]
    ///     bob: Particle,
    ///     #[point(on = ground, at = [0.0, 0.0, 0.0])]
    ///     nail: Point,
    /// }
    ///
    /// let (bob, h) = (Bob::default(), Bob::HANDLES);
    /// let interactions = [Interaction::rope(h.nail, h.bob, 1.0)];
    /// let [rope] = Interaction::handles(&interactions);
    /// bob.simulation(StandardLagrange, DormandPrince::default())
    ///     .interactions(interactions)
    ///     .run(0.0..=2.0, every(0.01), |sample| -> Result<(), Fault> {
    ///         assert!(sample.position(h.bob).norm() < 1.0 + 1e-5);
    ///         assert!(sample.effort(rope)? <= 0.0);
    ///         if let Some(impact) = sample.impact(rope)? {
    ///             // It has fallen by 0.8 m, and loses what is along the rope.
    ///             let rate = 0.8 * f64::sqrt(2.0 * 9.81 * 0.8);
    ///             assert!((impact.impulse + 2.0 * rate).abs() < 1e-6);
    ///         }
    ///         Ok(())
    ///     })?;
    /// # Ok::<(), RunError<StateOf<Bob>, Fault>>(())
    /// ```
    #[must_use]
    pub fn rope(first: impl Located<M>, second: impl Located<M>, length: S) -> Self {
        Self::distance(first, second, [S::constant(f64::NEG_INFINITY), length])
    }

    /// A strut between two points, as of [`Interaction::rope`]: it does not become shorter than its
    /// length (m), and does not pull. Its effort (N) is positive.
    #[must_use]
    pub fn strut(first: impl Located<M>, second: impl Located<M>, length: S) -> Self {
        Self::distance(first, second, [length, S::constant(f64::INFINITY)])
    }

    /// Stops at the least and at the greatest distance (m) of two points, as of
    /// [`Interaction::rope`]. Infinite where there is none: a least distance is positive, or
    /// `f64::NEG_INFINITY`. Efforts (N) are positive where they push the points apart.
    #[must_use]
    pub fn distance(first: impl Located<M>, second: impl Located<M>, bounds: [S; 2]) -> Self {
        let quantity = Quantity::Distance(At::of(first), At::of(second));
        Self::new(quantity, Law::Limits(Limits::between(bounds)))
    }

    pub(super) fn apart(quantity: Quantity<S>, least: S) -> Self {
        let bounds = [least, S::constant(f64::INFINITY)];
        Self::new(quantity, Law::Limits(Limits::between(bounds)))
    }

    /// The radius (m) of a ball about the point of [`Interaction::contact`]; the radius (m) at
    /// which a hinge with [`Interaction::friction_by_load`] rubs, and the mean one of a thread.
    #[must_use]
    pub fn radius(mut self, radius: S) -> Self {
        match (&mut self.law, &mut self.quantity) {
            (Law::Limits(_), Quantity::Gap(_, _, Shape::Ball(place))) => *place = radius,
            (
                Law::Friction(Friction {
                    bearing: Some(bearing),
                    ..
                }),
                Quantity::Joint(JointReading::Angle(_)),
            ) => bearing.radius = Some(radius),
            _ => self.misplaced = Some("radius"),
        }
        self
    }

    /// Dry friction (Coulomb) along a quantity. While it slides, an effort of `capacity` (N m for
    /// an angle, N for a displacement) acts against the rate. While it sticks, it has whatever
    /// effort up to that keeps it.
    ///
    /// The capacity is known: it does not depend on the load of the joint, see
    /// [`Interaction::friction_by_load`]. Friction of a finite capacity gives no impulse.
    #[must_use]
    pub fn friction(quantity: JointQuantity<M>, capacity: S) -> Self {
        Self::dry(Quantity::Joint(quantity.reading), capacity)
    }

    /// Dry friction of a slide or a hinge, whose capacity is a coefficient times the load of the
    /// joint at the same instant (Flores, *Concepts and Formulations for Spatial Multibody
    /// Dynamics*, 2015; Haug, *Simulation of friction and stiction in multibody dynamics model
    /// problems*, 2018). `coefficient` is Coulomb's `mu`; [`Interaction::stiction`] and
    /// [`Interaction::stribeck`] are of coefficients as well.
    ///
    /// - Of a slide the capacity (N) is `mu |F|`, with the part `F` of the reaction across the
    ///   axis.
    /// - Of a hinge it is `mu r |F|` (N m). It needs the [`Interaction::radius`] `r`. The force
    ///   along the axis does not count.
    /// - Of a hinge with a [`Interaction::collar`] the force along the axis counts as well.
    /// - Of a screw it is `mu r |N| / cos(l)` (N m). Here `r` is the mean [`Interaction::radius`]
    ///   of its thread, `l` the lead angle, `tan(l) = pitch / (2 pi r)`, and `N` the force across
    ///   the flank, which bears the thrust. So it locks itself where `mu > tan(l)`. The moment that
    ///   raises a load `F` is `F r tan(l + atan(mu))`. Of a flank that is inclined by an angle `b`
    ///   take `mu / cos(b)`. Forces across the axis do not count.
    /// - Moments do not count, unless the bearing has a length: [`Interaction::guide`].
    ///
    /// The load depends on the friction, so both are solved together. What can stick sticks.
    /// Refused are:
    ///
    /// - while it slides, an effort that does not exist or is not unique (Painleve's paradox):
    ///   [`ModeFault::NoUniqueFriction`](crate::error::ModeFault::NoUniqueFriction);
    /// - a joint whose reaction is not determined:
    ///   [`ModeFault::LoadNotUnique`](crate::error::ModeFault::LoadNotUnique).
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// /// A block of 2 kg on a plane that is inclined by 3 in 4.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// struct Incline {
    ///     #[body(mass = 2.0, inertia = [0.1, 0.1, 0.1])]
    ///     block: Body,
    ///     #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], axis = [0.8, 0.0, -0.6])]
    ///     slide: Prismatic,
    /// }
    /// let (incline, h) = (Incline::default(), Incline::HANDLES);
    /// let report = incline
    ///     .simulation(StandardLagrange, DormandPrince::default())
    ///     .interactions([Interaction::friction_by_load(h.slide, 0.5)])
    ///     .run(0.0..=1.0, every(0.1), |_| ())?;
    /// // g (sin - mu cos) = 9.81 (0.6 - 0.5 0.8)
    /// let view = incline.view(1.0, &report.state)?;
    /// assert!((view.displacement_rate(h.slide) - 1.962).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// A joint with more than one motion in its bearing is refused by the compiler:
    ///
    /// ```compile_fail,E0277
    /// # use holonom::prelude::*;
    /// # #[derive(Mechanism)]
    /// # struct Sleeve {
    /// #     #[body(mass = 2.0, inertia = [0.1, 0.1, 0.1])]
    /// #     shaft: Body,
    /// #     #[joint(between = [ground, shaft], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    /// #     sleeve: Cylindrical,
    /// # }
    /// let friction = Interaction::<f64, _>::friction_by_load(Sleeve::HANDLES.sleeve, 0.5);
    /// ```
    #[must_use]
    pub fn friction_by_load<J: HasBearing>(joint: JointHandle<M, J>, coefficient: S) -> Self {
        let reading = if J::TURNS {
            JointReading::Angle(joint.index())
        } else {
            JointReading::Displacement(joint.index())
        };
        Self::dry(Quantity::Joint(reading), coefficient).friction_setting("load", |friction| {
            friction.bearing = Some(Bearing {
                radius: None,
                half_length: None,
                collar: None,
                is_thread: J::IS_THREAD,
            });
        })
    }

    /// The half length (m) of the guide of a slide, or of the bearing of a hinge, with
    /// [`Interaction::friction_by_load`]. The middle is the joint's point on the second body, on
    /// the first one where the second is the ground.
    ///
    /// Two forces across the axis, at both ends, then carry the reaction with its moment across the
    /// axis, and the capacity is the coefficient times the sum of their sizes. A moment about the
    /// axis of a slide does not count.
    #[must_use]
    pub fn guide(mut self, half_length: S) -> Self {
        match &mut self.law {
            Law::Friction(Friction {
                bearing: Some(bearing),
                ..
            }) if !bearing.is_thread => bearing.half_length = Some(half_length),
            _ => self.misplaced = Some("guide"),
        }
        self
    }

    /// The mean radius (m) of a collar by which a hinge bears the force along its axis, with
    /// [`Interaction::friction_by_load`]: its capacity has `mu r |F|` more. A hinge with a collar
    /// alone needs no [`Interaction::radius`].
    #[must_use]
    pub fn collar(mut self, radius: S) -> Self {
        match (&mut self.law, &self.quantity) {
            (
                Law::Friction(Friction {
                    bearing: Some(bearing),
                    ..
                }),
                Quantity::Joint(JointReading::Angle(_)),
            ) if !bearing.is_thread => bearing.collar = Some(radius),
            _ => self.misplaced = Some("collar"),
        }
        self
    }

    /// A brake on a quantity: [`Interaction::friction`] that handlers engage and release,
    /// [`Event::engage`](crate::run::Event::engage). With an infinite capacity it is a dog, which
    /// stops the quantity by an impulse where it is engaged.
    #[must_use]
    pub fn brake(quantity: JointQuantity<M>, capacity: S) -> Self {
        Self::friction(quantity, capacity)
    }

    /// A clutch between two quantities: dry friction along the rate of the first less `ratio` times
    /// the rate of the second. The capacity is an effort along the first. With an infinite one it
    /// is a dog clutch.
    ///
    /// What it transmits acts on the joints: an effort `f` along the first, and `-ratio f` along
    /// the second.
    #[must_use]
    pub fn clutch(
        first: JointQuantity<M>,
        second: JointQuantity<M>,
        ratio: S,
        capacity: S,
    ) -> Self {
        Self::dry(
            Quantity::Difference(first.reading, second.reading, ratio),
            capacity,
        )
    }

    fn dry(quantity: Quantity<S>, capacity: S) -> Self {
        Self::new(quantity, Law::Friction(Friction::of(capacity)))
    }

    /// Newton's coefficient of restitution of [`Interaction::limits`], from 0 to 1: the rate after
    /// an impact over the one before it, with the sign turned.
    #[must_use]
    pub fn restitution(mut self, restitution: S) -> Self {
        match &mut self.law {
            Law::Limits(limits) => limits.restitution = restitution,
            Law::Friction(_) => self.misplaced = Some("restitution"),
        }
        self
    }

    /// Poisson's coefficient of restitution, from 0 to 1, in place of Newton's: the impulse of a
    /// contact after its greatest compression over the one until then (Glocker and Pfeiffer,
    /// *Multiple impacts with friction in rigid multibody systems*, 1995). With friction Newton's
    /// may bring energy where this one loses some.
    #[must_use]
    pub fn restitution_of_impulses(mut self, restitution: S) -> Self {
        match &mut self.law {
            Law::Limits(limits) => {
                (limits.restitution, limits.is_of_impulses) = (restitution, true);
            }
            Law::Friction(_) => self.misplaced = Some("restitution_of_impulses"),
        }
        self
    }

    /// The rate (rad/s, m/s) of approach below which there is no restitution, so that what bounces
    /// comes to rest instead of bouncing without end. If it is not said, it is 1e-4 of the fastest
    /// approach to this limit in the run so far (0.01 of it in `f32`).
    #[must_use]
    pub fn rest_below(mut self, rate: S) -> Self {
        match &mut self.law {
            Law::Limits(limits) => limits.rest = Rest::Below(rate),
            Law::Friction(_) => self.misplaced = Some("rest_below"),
        }
        self
    }

    /// A higher capacity while it sticks (N m, N).
    #[must_use]
    pub fn stiction(self, capacity: S) -> Self {
        self.friction_setting("stiction", |friction| friction.stiction = Some(capacity))
    }

    /// With [`Interaction::stiction`]: the rate `v0` (rad/s, m/s) by which friction falls from that
    /// of [`Interaction::stiction`] to that of sliding: `capacity + (stiction - capacity)
    /// exp(-(rate / v0)^2)` (Stribeck's curve; Armstrong-Helouvry, Dupont and Canudas de Wit, *A
    /// survey of models, analysis tools and compensation methods for the control of machines with
    /// friction*, 1994).
    #[must_use]
    pub fn stribeck(self, rate: S) -> Self {
        self.friction_setting("stribeck", |friction| friction.stribeck = Some(rate))
    }

    /// Not engaged at the start.
    #[must_use]
    pub fn released(self) -> Self {
        self.friction_setting("released", |friction| friction.is_engaged = false)
    }

    /// A freewheel: its effort is never negative. It bears what would turn the quantity downwards,
    /// up to its capacity, and turns freely upwards. An infinite capacity stops a negative rate by
    /// an impulse. Not for [`Interaction::friction_by_load`].
    #[must_use]
    pub fn one_way(mut self) -> Self {
        match &mut self.law {
            Law::Friction(friction) if friction.bearing.is_none() && friction.tangent.is_none() => {
                friction.is_one_way = true;
            }
            _ => self.misplaced = Some("one_way"),
        }
        self
    }

    fn friction_setting(
        mut self,
        setting: &'static str,
        set: impl FnOnce(&mut Friction<S>),
    ) -> Self {
        match &mut self.law {
            Law::Friction(friction) if friction.tangent.is_none() => set(friction),
            _ => self.misplaced = Some(setting),
        }
        self
    }

    /// The name of the joint or the point that it is told by.
    pub(crate) fn name(&self) -> &'static str {
        self.quantity.name::<M>()
    }
}
