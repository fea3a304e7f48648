//! Points and planes of a mechanism, and the gaps between them.

use core::marker::PhantomData;

use crate::forward::Forward;
use crate::math::quaternion::{normalised, rotate};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{cross, minus, norm, plus, read, times};
use crate::mechanism::handle::BodyHandle;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::point::{Located, Place};
use crate::nonsmooth::scene::Scene;
use crate::state::vector::{Array, StateParts};

/// A plane that is fixed on a body or on the ground, with the side that is free, for
/// [`Interaction::contact`](crate::run::Interaction::contact).
pub struct Plane<S, M> {
    pub(crate) place: PlaceOfPlane<S>,
    mechanism: PhantomData<fn() -> M>,
}

impl<S: Copy, M> Clone for Plane<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Copy, M> Copy for Plane<S, M> {}

impl<S: core::fmt::Debug, M> core::fmt::Debug for Plane<S, M> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.place.fmt(f)
    }
}

impl<S: Real, M: Mechanism> Plane<S, M> {
    /// A plane on the ground through a point (m, global); the normal (global, of any length but
    /// zero) points to the free side.
    #[must_use]
    pub fn on_ground(point: [S; 3], normal: [S; 3]) -> Self {
        Self::new(None, point, normal)
    }

    /// A plane on a body through a point (m) from its centre of mass; point and normal along the
    /// user's body axes.
    #[must_use]
    pub fn on(body: BodyHandle<M>, point: [S; 3], normal: [S; 3]) -> Self {
        let axes = M::user_axes(body.index()).map(S::constant);
        let [point, normal] = [point, normal].map(|vector| rotate(&axes, &vector));
        Self::new(Some(body.index()), point, normal)
    }

    fn new(body: Option<usize>, point: [S; 3], normal: [S; 3]) -> Self {
        let normal = of_length_1(&normal);
        // The axis that is farthest from the normal, the first one of several.
        let [x, y, z] = normal.map(|component| component.abs());
        let axis = if x <= y && x <= z {
            [S::one(), S::zero(), S::zero()]
        } else if y <= z {
            [S::zero(), S::one(), S::zero()]
        } else {
            [S::zero(), S::zero(), S::one()]
        };
        Self {
            place: PlaceOfPlane {
                body,
                point,
                normal,
                along: of_length_1(&within(&axis, &normal)),
            },
            mechanism: PhantomData,
        }
    }

    /// With the direction along which the first effort of its friction is counted: the part of a
    /// vector within the plane, along the axes that the normal is given in. The second is along
    /// the normal times the first. Without a word it is that of the axis which is farthest from the
    /// normal.
    #[must_use]
    pub fn along(mut self, direction: [S; 3]) -> Self {
        let direction = match self.place.body {
            Some(body) => rotate(&M::user_axes(body).map(S::constant), &direction),
            None => direction,
        };
        self.place.along = of_length_1(&within(&direction, &self.place.normal));
        self
    }
}

/// A direction of length 1 along the user's axes of a body, in its principal axes; global on the
/// ground.
pub(super) fn direction_on<S: Real, M: Mechanism>(body: Option<usize>, along: &[S; 3]) -> [S; 3] {
    let along = of_length_1(along);
    match body {
        Some(body) => rotate(&M::user_axes(body).map(S::constant), &along),
        None => along,
    }
}

pub(super) fn of_length_1<S: Real>(vector: &[S; 3]) -> [S; 3] {
    let length = norm(vector);
    vector.map(|component| component.quotient(length))
}

/// The part of a vector at right angles to a normal of length 1.
pub(super) fn within<S: Real>(vector: &[S; 3], normal: &[S; 3]) -> [S; 3] {
    minus(vector, &times(normal, dot(vector, normal)))
}

/// The plane in principal axes of its body; global on the ground. The normal has length 1, and so
/// has a direction within it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PlaceOfPlane<S> {
    pub(crate) body: Option<usize>,
    pub(super) point: [S; 3],
    pub(super) normal: [S; 3],
    pub(super) along: [S; 3],
}

impl<S> PlaceOfPlane<S> {
    /// What it is fixed on.
    pub(crate) fn without_numbers(&self) -> PlaceOfPlane<()> {
        PlaceOfPlane {
            body: self.body,
            point: [(); 3],
            normal: [(); 3],
            along: [(); 3],
        }
    }
}

impl<S: Scalar> PlaceOfPlane<S> {
    pub(crate) fn lifted<const N: usize>(self) -> PlaceOfPlane<Forward<S, N>> {
        PlaceOfPlane {
            body: self.body,
            point: self.point.map(Forward::fixed),
            normal: self.normal.map(Forward::fixed),
            along: self.along.map(Forward::fixed),
        }
    }
}

impl<S: Real> PlaceOfPlane<S> {
    /// How far its point is from where it is counted from (m).
    pub(super) fn arm(&self) -> S {
        norm(&self.point)
    }

    /// What of it is not finite, by its setting: a normal or a direction of no length is none.
    pub(crate) fn check(&self) -> Result<(), &'static str> {
        let is_finite = |vector: &[S; 3]| vector.iter().all(|number| number.is_finite());
        if !is_finite(&self.point) || !is_finite(&self.normal) {
            return Err("normal");
        }
        if !is_finite(&self.along) {
            return Err("along");
        }
        Ok(())
    }
}

/// A centre of mass, or a named point, by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum At {
    Body(usize),
    Point(usize),
}

impl At {
    pub(crate) fn of<M>(at: impl Located<M>) -> Self {
        match at.located() {
            Place::Body(body) => Self::Body(body.index()),
            Place::Point(point) => Self::Point(point.index()),
        }
    }

    /// The body that it is fixed on.
    pub(crate) fn body<M: Mechanism>(self) -> Option<usize> {
        match self {
            Self::Body(body) => Some(body),
            Self::Point(point) => M::REPORT.points.get(point).and_then(|info| info.body),
        }
    }

    pub(crate) fn name<M: Mechanism>(self) -> &'static str {
        match self {
            Self::Body(body) => M::REPORT.bodies.get(body).map_or("", |info| info.name),
            Self::Point(point) => M::REPORT.points.get(point).map_or("", |info| info.name),
        }
    }

    /// From the centre of mass of its body, in principal axes; global on the ground.
    pub(super) fn arm<S: Scalar, M: Mechanism>(self, constants: &M::Constants<S>) -> [S; 3] {
        match self {
            Self::Body(_) => [S::zero(); 3],
            Self::Point(point) => M::named_point(constants, point),
        }
    }
}

/// The point that a surface is counted from, its velocity, and its normal and first direction
/// there.
pub(super) struct Frame<S> {
    pub(super) base: [S; 3],
    pub(super) velocity: [S; 3],
    pub(super) normal: [S; 3],
    pub(super) along: [S; 3],
    /// How far (m) it is beyond that point, along the normal.
    pub(super) beyond: S,
}

/// Points that are closer than this (m) have no direction from one to the other.
const NO_DIRECTION: f64 = 1e-30;

/// A point or a direction, and its rate (global).
type Moving<S> = [[S; 3]; 2];

impl<S: Scalar, M: Mechanism> Scene<'_, S, M> {
    /// A vector that is fixed in principal axes of a body.
    pub(super) fn turned(&self, body: usize, vector: &[S; 3]) -> Moving<S> {
        let Some((info, place)) = BodyHandle::<M>::new(body).orientation() else {
            return [*vector, [S::zero(); 3]];
        };
        let p = normalised(&read(self.bodies.coordinates().as_slice(), place));
        let spin = read(self.bodies.velocities().as_slice(), info.velocity + 3);
        let (vector, spin) = (rotate(&p, vector), rotate(&p, &spin));
        [vector, cross(&spin, &vector)]
    }

    /// The angular velocity (rad/s) of a body, global; zero of a particle.
    pub(super) fn spin(&self, body: usize) -> [S; 3] {
        let Some((info, place)) = BodyHandle::<M>::new(body).orientation() else {
            return [S::zero(); 3];
        };
        let p = normalised(&read(self.bodies.coordinates().as_slice(), place));
        rotate(
            &p,
            &read(self.bodies.velocities().as_slice(), info.velocity + 3),
        )
    }

    /// A point from the centre of mass of a body; global on the ground.
    pub(super) fn point(&self, body: Option<usize>, arm: &[S; 3]) -> Moving<S> {
        let Some(body) = body else {
            return [*arm, [S::zero(); 3]];
        };
        let [arm, turning] = self.turned(body, arm);
        let info = BodyHandle::<M>::new(body).info();
        let (coordinate, velocity) = info.map_or((0, 0), |info| (info.coordinate, info.velocity));
        let centre = read(self.bodies.coordinates().as_slice(), coordinate);
        let moving = read(self.bodies.velocities().as_slice(), velocity);
        [plus(&centre, &arm), plus(&moving, &turning)]
    }

    pub(super) fn at(&self, at: At) -> Moving<S> {
        self.point(at.body::<M>(), &at.arm::<S, M>(self.constants))
    }

    /// The distance (m) of two points, and its rate; no rate where they meet.
    pub(crate) fn distance(&self, a: At, b: At) -> [S; 2] {
        let ([a, a_rate], [b, b_rate]) = (self.at(a), self.at(b));
        let (way, faster) = (minus(&a, &b), minus(&a_rate, &b_rate));
        let length = dot(&way, &way).sqrt();
        let least = S::constant(NO_DIRECTION);
        let reciprocal = length.select(least, S::zero(), length.reciprocal());
        [length, dot(&way, &faster) * reciprocal]
    }
}

pub(super) fn dot<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> S {
    let pairs = a.iter().zip(b);
    pairs.fold(S::zero(), |sum, (&a, &b)| a.fused(b, sum))
}
