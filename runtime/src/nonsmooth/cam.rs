//! Plane cams, as a user writes them, and how they lie.

use core::marker::PhantomData;

use crate::forward::Forward;
use crate::math::scalar::{Real, Scalar};
use crate::math::spline::Spline;
use crate::math::vec3::{cross, minus, norm, plus, times};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::point::Located;
use crate::nonsmooth::place::{At, Frame, direction_on, dot, of_length_1, within};
use crate::nonsmooth::profile::Profile;
use crate::nonsmooth::scene::Scene;

/// A convex plane cam about a point of a body or of the ground, for
/// [`Interaction::contact_of_cam`](crate::run::Interaction::contact_of_cam) and
/// [`Interaction::contact_with_cam`](crate::run::Interaction::contact_with_cam).
pub struct Cam<S, M> {
    pub(super) at: At,
    pub(super) outline: Outline<S>,
    mechanism: PhantomData<fn() -> M>,
}

impl<S: Copy, M> Clone for Cam<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Copy, M> Copy for Cam<S, M> {}

impl<S: core::fmt::Debug, M> core::fmt::Debug for Cam<S, M> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Cam")
            .field("at", &self.at)
            .field("outline", &self.outline)
            .finish_non_exhaustive()
    }
}

impl<S: Real, M: Mechanism> Cam<S, M> {
    /// A cam by the support function `h` of its profile. `h(phi)` (m) is the distance from the
    /// centre to the tangent whose outward normal is at the angle `phi` (rad) from the zero
    /// direction, right-handed about the axis. A flat follower has the lift `h`. The radius of
    /// curvature is `h + h''`, which is positive everywhere (Angeles and Lopez-Cajun, *Optimization
    /// of Cam Mechanisms*, 1991).
    ///
    /// Both directions have any length but zero, along the user's axes of the body of the centre
    /// (global on the ground). The zero direction is made perpendicular to the axis. The profile
    /// repeats itself after `2 pi`; one that is made at run time is kept by `Box::leak`. Along the
    /// axis the cam goes on without end.
    ///
    /// ```
    /// use holonom::prelude::*;
    /// use holonom::run::{Cam, InteractionMode};
    /// use holonom::spline::{Spline, uniform_knots};
    ///
    /// /// A cam that turns below a roller of 10 mm, which a spring presses on it.
    /// #[derive(Mechanism)]
    /// #[mechanism(coordinates = "joints")]
    /// struct Valve {
    ///     #[body(
    ///         mass = 1.0, inertia = [0.001, 0.001, 0.001], angular_velocity = [0.0, 20.0, 0.0]
    ///     )]
    ///     cam: Body,
    ///     #[body(mass = 0.2, inertia = [0.001, 0.001, 0.001], position = [0.0, 0.0, 0.05])]
    ///     valve: Body,
    ///     #[joint(between = [ground, cam], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    ///     shaft: Revolute,
    ///     #[joint(between = [ground, valve], point = [0.0, 0.0, 0.05], axis = [0.0, 0.0, 1.0])]
    ///     guide: Prismatic,
    ///     #[force(
    ///         between = [ground, valve], head = [0.0, 0.0, 0.3], tail = [0.0, 0.0, 0.05],
    ///         stiffness = 5000.0, free_length = 0.27
    ///     )]
    ///     spring: SpringDamper,
    /// }
    ///
    /// /// 40 mm, and 6 mm more at its nose, which is below at the start.
    /// static PROFILE: Spline<9> = Spline::periodic(
    ///     uniform_knots(0.0, core::f64::consts::TAU),
    ///     [0.046, 0.044, 0.041, 0.04, 0.04, 0.04, 0.041, 0.044, 0.046],
    /// );
    ///
    /// let (valve, h) = (Valve::default(), Valve::HANDLES);
    /// let cam = Cam::about(h.cam, [0.0, 1.0, 0.0], [0.0, 0.0, -1.0], &PROFILE);
    /// let contact = [Interaction::contact_with_cam(h.valve, cam).radius(0.01)];
    /// let [touches] = Interaction::handles(&contact);
    /// valve
    ///     .simulation(StandardLagrange, DormandPrince::default())
    ///     .interactions(contact)
    ///     .run(0.0..=1.0, every(0.01), |sample| -> Result<(), Fault> {
    ///         assert_eq!(sample.mode(touches)?, InteractionMode::AtLower);
    ///         assert!(sample.position(h.valve).z < 0.0561);
    ///         Ok(())
    ///     })?;
    /// # Ok::<(), RunError<StateOf<Valve>, Fault>>(())
    /// ```
    #[must_use]
    pub fn about<const N: usize>(
        centre: impl Located<M>,
        axis: [S; 3],
        zero: [S; 3],
        profile: &'static Spline<N>,
    ) -> Self {
        let at = At::of(centre);
        let [axis, zero] = [axis, zero].map(|way| direction_on::<S, M>(at.body::<M>(), &way));
        let across = within(&zero, &axis);
        // Of parallel directions there is round-off left.
        let is_across = norm(&across) > S::EPSILON.sqrt();
        Self {
            at,
            outline: Outline {
                axis,
                zero: if is_across {
                    of_length_1(&across)
                } else {
                    [S::constant(f64::NAN); 3]
                },
                profile: Profile::of(profile),
            },
            mechanism: PhantomData,
        }
    }
}

/// A profile about a point. Both directions have length 1 and are at right angles, in principal
/// axes of the body; global on the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Outline<S> {
    axis: [S; 3],
    zero: [S; 3],
    profile: Profile,
}

impl<S> Outline<S> {
    pub(super) fn without_numbers(&self) -> Outline<()> {
        Outline {
            axis: [(); 3],
            zero: [(); 3],
            profile: self.profile,
        }
    }
}

impl<S: Scalar> Outline<S> {
    pub(super) fn lifted<const N: usize>(self) -> Outline<Forward<S, N>> {
        Outline {
            axis: self.axis.map(Forward::fixed),
            zero: self.zero.map(Forward::fixed),
            profile: self.profile,
        }
    }
}

impl<S: Real> Outline<S> {
    /// The largest of its lengths (m).
    pub(super) fn reach(&self) -> S {
        S::constant(self.profile.reach())
    }

    /// What is not acceptable of it, by its setting.
    pub(super) fn check(&self) -> Result<(), (&'static str, S)> {
        for (setting, direction) in [("axis", self.axis), ("zero direction", self.zero)] {
            if let Some(&component) = direction.iter().find(|number| !number.is_finite()) {
                return Err((setting, component));
            }
        }
        let checked = self.profile.check();
        checked.map_err(|(setting, value)| (setting, S::constant(value)))
    }
}

impl<S: Scalar, M: Mechanism> Scene<'_, S, M> {
    /// The zero direction and that a quarter of a turn ahead (global).
    fn across_axis(&self, body: Option<usize>, outline: &Outline<S>) -> [[S; 3]; 2] {
        let [axis, zero] = [outline.axis, outline.zero].map(|vector| match body {
            Some(body) => self.turned(body, &vector)[0],
            None => vector,
        });
        [zero, cross(&axis, &zero)]
    }

    /// From the centre of a cam to where it is deepest against a normal (global). Not a number for
    /// a normal along its axis.
    pub(super) fn deepest_of_cam(&self, at: At, outline: &Outline<S>, normal: &[S; 3]) -> [S; 3] {
        let [zero, quarter] = self.across_axis(at.body::<M>(), outline);
        let [x, y] = [&zero, &quarter].map(|way| -dot(normal, way));
        let reciprocal = x.fused(x, y * y).sqrt().reciprocal();
        let [x, y] = outline.profile.point([x * reciprocal, y * reciprocal]);
        plus(&times(&zero, x), &times(&quarter, y))
    }

    /// At the point of a cam that is nearest to the middle of a ball. The first direction is that
    /// of increasing angles, the second one the axis.
    pub(super) fn on_cam(&self, at: At, outline: &Outline<S>, centre: &[S; 3]) -> Frame<S> {
        let [base, velocity] = self.at(at);
        let axes = self.across_axis(at.body::<M>(), outline);
        let way = minus(centre, &base);
        let point = axes.each_ref().map(|axis| dot(&way, axis));
        let [angle, beyond] = outline.profile.facing(point);
        let (sine, cosine) = (angle.sin(), angle.cos());
        let [zero, quarter] = axes;
        Frame {
            base,
            velocity,
            normal: plus(&times(&zero, cosine), &times(&quarter, sine)),
            along: minus(&times(&quarter, cosine), &times(&zero, sine)),
            beyond,
        }
    }
}
