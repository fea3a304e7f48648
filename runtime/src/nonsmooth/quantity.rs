//! Quantities of a mechanism along which an effort acts.

use core::marker::PhantomData;

use crate::forward::Forward;
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::handle::{HasAngle, HasDisplacement, JointHandle};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::mechanism::turns;
use crate::nonsmooth::place::At;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::shape::{Direction, Shape, Surface};
use crate::state::vector::{Array, StateParts};

/// The angle (rad) or the displacement (m) of a joint, by [`JointHandle::angle`] and
/// [`JointHandle::displacement`], with the signs of [`View::angle`](crate::View::angle) and
/// [`View::displacement`](crate::View::displacement).
pub struct JointQuantity<M> {
    pub(crate) reading: JointReading,
    mechanism: PhantomData<fn() -> M>,
}

impl<M> Clone for JointQuantity<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M> Copy for JointQuantity<M> {}

/// Which of both, and the index of the joint.
impl<M> core::fmt::Debug for JointQuantity<M> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.reading.fmt(f)
    }
}

impl<M: Mechanism, J: HasAngle> JointHandle<M, J> {
    /// The angle of the joint (rad), as a quantity along which an effort (N m) acts: what an
    /// [`Interaction`](crate::run::Interaction) takes.
    #[must_use]
    pub const fn angle(self) -> JointQuantity<M> {
        JointQuantity {
            reading: JointReading::Angle(self.index()),
            mechanism: PhantomData,
        }
    }
}

impl<M: Mechanism, J: HasDisplacement> JointHandle<M, J> {
    /// The displacement of the joint (m), as a quantity along which an effort (N) acts: what an
    /// [`Interaction`](crate::run::Interaction) takes.
    #[must_use]
    pub const fn displacement(self) -> JointQuantity<M> {
        JointQuantity {
            reading: JointReading::Displacement(self.index()),
            mechanism: PhantomData,
        }
    }
}

/// A reading of a joint by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum JointReading {
    Angle(usize),
    Displacement(usize),
}

impl JointReading {
    pub(crate) fn joint(self) -> usize {
        match self {
            Self::Angle(joint) | Self::Displacement(joint) => joint,
        }
    }
}

/// Along what an effort acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity<S> {
    /// An angle or a displacement.
    Joint(JointReading),
    /// The first less so many times the second.
    Difference(JointReading, JointReading, S),
    /// The distance of a shape about a point from a surface.
    Gap(At, Surface<S>, Shape<S>),
    /// What touches there, along a direction of the surface: a rate, and no value.
    Slip(At, Surface<S>, Shape<S>, Direction),
    /// The distance of two points.
    Distance(At, At),
}

impl<S> Quantity<S> {
    /// What it is of, without its numbers.
    pub(crate) fn without_numbers(&self) -> Quantity<()> {
        match self {
            Self::Joint(reading) => Quantity::Joint(*reading),
            Self::Difference(first, second, _) => Quantity::Difference(*first, *second, ()),
            Self::Gap(at, surface, shape) => {
                Quantity::Gap(*at, surface.without_numbers(), shape.without_numbers())
            }
            Self::Slip(at, surface, shape, direction) => Quantity::Slip(
                *at,
                surface.without_numbers(),
                shape.without_numbers(),
                *direction,
            ),
            Self::Distance(a, b) => Quantity::Distance(*a, *b),
        }
    }
}

impl<S: Scalar> Quantity<S> {
    /// The same over numbers that carry derivatives.
    pub(crate) fn lifted<const N: usize>(self) -> Quantity<Forward<S, N>> {
        match self {
            Self::Joint(reading) => Quantity::Joint(reading),
            Self::Difference(first, second, ratio) => {
                Quantity::Difference(first, second, Forward::fixed(ratio))
            }
            Self::Gap(at, surface, shape) => Quantity::Gap(at, surface.lifted(), shape.lifted()),
            Self::Slip(at, surface, shape, direction) => {
                Quantity::Slip(at, surface.lifted(), shape.lifted(), direction)
            }
            Self::Distance(a, b) => Quantity::Distance(a, b),
        }
    }

    /// Whether the velocities of a body count.
    pub(super) fn is_of<M: Mechanism>(&self, body: usize) -> bool {
        let of_joint = |reading: &JointReading| {
            let joint = M::REPORT.joints.get(reading.joint());
            joint.is_some_and(|joint| joint.bodies.contains(&Some(body)))
        };
        let body_of = |at: &At| at.body::<M>() == Some(body);
        match self {
            Self::Joint(reading) => of_joint(reading),
            Self::Difference(first, second, _) => of_joint(first) || of_joint(second),
            Self::Gap(at, surface, _) | Self::Slip(at, surface, ..) => {
                body_of(at) || surface.body::<M>() == Some(body)
            }
            Self::Distance(a, b) => body_of(a) || body_of(b),
        }
    }

    /// The name of the joint or the point that it is told by.
    pub(crate) fn name<M: Mechanism>(&self) -> &'static str {
        match self {
            Self::Joint(reading) | Self::Difference(reading, ..) => {
                let info = M::REPORT.joints.get(reading.joint());
                info.map_or("", |info| info.name)
            }
            Self::Gap(at, ..) | Self::Slip(at, ..) | Self::Distance(at, _) => at.name::<M>(),
        }
    }

    /// The value (rad, m); not that of a difference or of a slip, which no law asks for.
    pub(crate) fn value<M: Mechanism>(&self, scene: &Scene<'_, S, M>) -> S {
        match *self {
            Self::Joint(reading) => scene.value(reading),
            Self::Difference(..) | Self::Slip(..) => S::zero(),
            Self::Gap(at, ref surface, ref shape) => scene.touch(at, surface, shape).gap,
            Self::Distance(a, b) => {
                let [value, _] = scene.distance(a, b);
                value
            }
        }
    }

    /// The point, the surface and the shape that touch; `None` of what is no contact.
    pub(super) fn contact_parts(&self) -> Option<(&At, &Surface<S>, &Shape<S>)> {
        match self {
            Self::Gap(at, surface, shape) | Self::Slip(at, surface, shape, _) => {
                Some((at, surface, shape))
            }
            _ => None,
        }
    }

    /// Whether it is of what touches at a contact.
    pub(super) fn is_contact(&self) -> bool {
        self.contact_parts().is_some()
    }

    /// Along which direction of a surface; `None` of all but slip.
    pub(super) fn direction(&self) -> Option<Direction> {
        match self {
            Self::Slip(.., direction) => Some(*direction),
            _ => None,
        }
    }

    /// Whether it is an angle, and no length.
    pub(crate) fn is_angle(&self) -> bool {
        matches!(self, Self::Joint(JointReading::Angle(_)))
    }

    /// Whether it has a value that a law asks for, or a rate alone.
    pub(crate) fn has_value(&self) -> bool {
        !matches!(self, Self::Difference(..) | Self::Slip(..))
    }

    /// The rate of what is no contact.
    pub(super) fn rate_between<M: Mechanism>(&self, scene: &Scene<'_, S, M>) -> S {
        match *self {
            Self::Joint(reading) => scene.rate(reading),
            Self::Difference(first, second, ratio) => {
                scene.rate(first) - ratio * scene.rate(second)
            }
            Self::Gap(..) | Self::Slip(..) => S::zero(),
            Self::Distance(a, b) => {
                let [_, rate] = scene.distance(a, b);
                rate
            }
        }
    }

    /// Calls with every velocity of the bodies of what is no contact, and its part in the rate.
    pub(super) fn each_part_between<M: Mechanism>(
        &self,
        scene: &Scene<'_, S, M>,
        mut each: impl FnMut(usize, S),
    ) {
        let mut still = *scene.bodies;
        *still.velocities_mut() = Array::zeros();
        let read = |still: &M::State<S>| {
            let bodies = still;
            self.rate_between(&Scene::<S, M> { bodies, ..*scene })
        };
        let offset = read(&still);
        let set = |still: &mut M::State<S>, place: usize, value| {
            if let Some(velocity) = still.velocities_mut().as_mut_slice().get_mut(place) {
                *velocity = value;
            }
        };
        for (body, info) in M::REPORT.bodies.iter().enumerate() {
            if !self.is_of::<M>(body) {
                continue;
            }
            let velocities = if info.kind == BodyKind::Rigid { 6 } else { 3 };
            for place in info.velocity..info.velocity + velocities {
                set(&mut still, place, S::one());
                let part = read(&still) - offset;
                set(&mut still, place, S::zero());
                each(place, part);
            }
        }
    }
}

impl<S: Real> Quantity<S> {
    /// How far it is from a value where it is held, the short way round for an angle: the state of
    /// an integration counts no turns.
    pub(crate) fn beyond<M: Mechanism>(&self, scene: &Scene<'_, S, M>, from: S) -> S {
        let difference = self.value(scene) - from;
        let Self::Joint(JointReading::Angle(joint)) = *self else {
            return difference;
        };
        let counts = M::joint_angle(scene.constants, scene.bodies, joint).turns;
        if counts.is_some() {
            return difference;
        }
        turns::nearest(difference, S::zero())
    }
}

impl<S: Scalar, M: Mechanism> Scene<'_, S, M> {
    fn value(&self, reading: JointReading) -> S {
        match reading {
            JointReading::Angle(joint) => turns::angle::<S, M>(self.constants, self.bodies, joint),
            JointReading::Displacement(joint) => {
                M::joint_displacement(self.constants, self.time, self.bodies, joint).value
            }
        }
    }

    fn rate(&self, reading: JointReading) -> S {
        match reading {
            JointReading::Angle(joint) => M::joint_angle(self.constants, self.bodies, joint).rate,
            JointReading::Displacement(joint) => {
                M::joint_displacement(self.constants, self.time, self.bodies, joint).rate
            }
        }
    }
}
