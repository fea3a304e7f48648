//! Shapes that touch surfaces, with the motion of what touches.

use crate::forward::Forward;
use crate::math::quaternion::{normalised, rotate_back};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{cross, minus, norm, plus, read, times};
use crate::mechanism::handle::BodyHandle;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::readout::ContactPoint;
use crate::nonsmooth::cam::Outline;
use crate::nonsmooth::place::{At, Frame, PlaceOfPlane, dot};
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::sphere::PlaceOfSphere;
use crate::state::vector::{Array, StateParts};

/// What a shape touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Surface<S> {
    Plane(PlaceOfPlane<S>),
    Sphere(PlaceOfSphere<S>),
    /// A cam about a point.
    Cam(At, Outline<S>),
}

/// What touches it, about the point that it is given by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape<S> {
    /// A ball with a radius (m): a point where that is zero.
    Ball(S),
    /// The edge of a disc about an axis, in principal axes of its body (global on the ground) and
    /// of length 1: a torus, with the radius (m) of its middle circle and that of its tube.
    Disc { axis: [S; 3], radius: S, tube: S },
    /// A thin plane cam.
    Cam(Outline<S>),
}

/// Along which direction of a surface, both at right angles to its normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Direction {
    Along,
    /// The normal times the other.
    Across,
}

/// How what is nearest to a surface lies and moves.
#[derive(Clone, Copy)]
pub(crate) struct Touch<S> {
    /// Its distance from the surface (m), positive on the free side.
    pub(super) gap: S,
    /// The rate of that (m/s).
    pub(super) rate: S,
    /// The velocity (m/s) of the material that is there against that of the surface, along both
    /// directions.
    pub(super) slip: [S; 2],
    /// Both directions (global).
    pub(super) directions: [[S; 3]; 2],
    /// The normal, and the point that touches (global).
    normal: [S; 3],
    point: [S; 3],
}

impl<S: Scalar> Touch<S> {
    /// Point, normal and slip.
    pub(super) fn contact(&self) -> ContactPoint<S> {
        ContactPoint::of([self.point, self.normal, self.slip_vector(true)])
    }

    /// The rate of the gap, or the slip in a direction (m/s).
    pub(super) fn rate_along(&self, direction: Option<Direction>) -> S {
        let [along, across] = self.slip;
        match direction {
            None => self.rate,
            Some(Direction::Along) => along,
            Some(Direction::Across) => across,
        }
    }

    /// The slip (m/s, global), in both directions or in the first one alone.
    pub(super) fn slip_vector(&self, has_both: bool) -> [S; 3] {
        let ([along, across], [x, y]) = (self.directions, self.slip);
        let first = times(&along, x);
        if has_both {
            plus(&first, &times(&across, y))
        } else {
            first
        }
    }
}

impl<S> Surface<S> {
    /// The body that it is fixed on.
    pub(super) fn body<M: Mechanism>(&self) -> Option<usize> {
        match self {
            Self::Plane(plane) => plane.body,
            Self::Sphere(sphere) => sphere.at.body::<M>(),
            Self::Cam(at, _) => at.body::<M>(),
        }
    }

    pub(super) fn without_numbers(&self) -> Surface<()> {
        match self {
            Self::Plane(plane) => Surface::Plane(plane.without_numbers()),
            Self::Sphere(sphere) => Surface::Sphere(sphere.without_numbers()),
            Self::Cam(at, outline) => Surface::Cam(*at, outline.without_numbers()),
        }
    }
}

impl<S: Scalar> Surface<S> {
    pub(super) fn lifted<const N: usize>(self) -> Surface<Forward<S, N>> {
        match self {
            Self::Plane(plane) => Surface::Plane(plane.lifted()),
            Self::Sphere(sphere) => Surface::Sphere(sphere.lifted()),
            Self::Cam(at, outline) => Surface::Cam(at, outline.lifted()),
        }
    }
}

impl<S: Real> Surface<S> {
    /// The largest of its lengths (m).
    pub(super) fn reach<M: Mechanism>(&self, constants: &M::Constants<S>) -> S {
        match self {
            Self::Plane(plane) => plane.arm(),
            Self::Sphere(sphere) => {
                let arm = norm(&sphere.at.arm::<S, M>(constants));
                arm.max(sphere.radius.abs())
            }
            Self::Cam(at, outline) => norm(&at.arm::<S, M>(constants)).max(outline.reach()),
        }
    }

    /// What is not acceptable of it, by its setting.
    pub(super) fn check(&self, shape: &Shape<S>) -> Result<(), (&'static str, S)> {
        shape.check()?;
        match (self, shape) {
            (Self::Plane(plane), _) => plane.check().map_err(|setting| (setting, S::zero())),
            (Self::Sphere(sphere), Shape::Ball(radius)) => sphere.check(*radius),
            (Self::Sphere(sphere), _) => Err(("sphere", sphere.radius)),
            (Self::Cam(_, outline), Shape::Ball(_)) => outline.check(),
            (Self::Cam(..), _) => Err(("cam", S::zero())),
        }
    }
}

impl<S> Shape<S> {
    pub(super) fn without_numbers(&self) -> Shape<()> {
        match self {
            Self::Ball(_) => Shape::Ball(()),
            Self::Disc { .. } => Shape::Disc {
                axis: [(); 3],
                radius: (),
                tube: (),
            },
            Self::Cam(outline) => Shape::Cam(outline.without_numbers()),
        }
    }
}

impl<S: Scalar> Shape<S> {
    pub(super) fn lifted<const N: usize>(self) -> Shape<Forward<S, N>> {
        match self {
            Self::Ball(radius) => Shape::Ball(Forward::fixed(radius)),
            Self::Disc { axis, radius, tube } => Shape::Disc {
                axis: axis.map(Forward::fixed),
                radius: Forward::fixed(radius),
                tube: Forward::fixed(tube),
            },
            Self::Cam(outline) => Shape::Cam(outline.lifted()),
        }
    }
}

impl<S: Real> Shape<S> {
    /// The largest of its lengths (m).
    pub(super) fn reach(&self) -> S {
        match *self {
            Self::Ball(radius) => radius.abs(),
            Self::Disc { radius, tube, .. } => radius.abs() + tube.abs(),
            Self::Cam(ref outline) => outline.reach(),
        }
    }

    /// What is not acceptable of it, by its setting: a length that is no radius.
    pub(super) fn check(&self) -> Result<(), (&'static str, S)> {
        let (radius, tube) = match *self {
            Self::Ball(radius) => (radius, S::zero()),
            Self::Disc { axis, radius, tube } => {
                if let Some(&component) = axis.iter().find(|component| !component.is_finite()) {
                    return Err(("axis", component));
                }
                (radius, tube)
            }
            Self::Cam(ref outline) => return outline.check(),
        };
        let is_radius = |length: S| length >= S::zero() && length.is_finite();
        if !is_radius(radius) {
            return Err(("radius", radius));
        }
        if !is_radius(tube) {
            return Err(("tube", tube));
        }
        Ok(())
    }
}

impl<S: Scalar, M: Mechanism> Scene<'_, S, M> {
    /// What a shape does against a surface. Not a number for a disc that lies flat on it, nor where
    /// a sphere has no direction along it.
    pub(crate) fn touch(&self, at: At, surface: &Surface<S>, shape: &Shape<S>) -> Touch<S> {
        let [centre, velocity] = self.at(at);
        let Frame {
            base,
            velocity: base_velocity,
            normal,
            along,
            beyond,
        } = match surface {
            Surface::Plane(plane) => self.on_plane(plane),
            Surface::Sphere(sphere) => self.on_sphere(sphere, &centre),
            Surface::Cam(at, outline) => self.on_cam(*at, outline, &centre),
        };
        let across = cross(&normal, &along);
        let arm = match shape {
            Shape::Ball(radius) => times(&normal, -*radius),
            Shape::Disc { axis, radius, tube } => {
                let axis = match at.body::<M>() {
                    Some(body) => self.turned(body, axis)[0],
                    None => *axis,
                };
                // The part of the normal in the plane of the disc.
                let within = minus(&normal, &times(&axis, dot(&normal, &axis)));
                let length = dot(&within, &within).sqrt();
                let deepest = times(&within, -(*radius * length.reciprocal()));
                plus(&deepest, &times(&normal, -*tube))
            }
            Shape::Cam(outline) => self.deepest_of_cam(at, outline, &normal),
        };
        let point = plus(&centre, &arm);
        let way = minus(&point, &base);
        let turning = match at.body::<M>() {
            Some(body) => cross(&self.spin(body), &arm),
            None => [S::zero(); 3],
        };
        let of_surface = match surface.body::<M>() {
            Some(body) => plus(&base_velocity, &cross(&self.spin(body), &way)),
            None => base_velocity,
        };
        let relative = minus(&plus(&velocity, &turning), &of_surface);
        Touch {
            gap: dot(&normal, &way) - beyond,
            rate: dot(&normal, &relative),
            slip: [dot(&along, &relative), dot(&across, &relative)],
            directions: [along, across],
            normal,
            point,
        }
    }

    /// Calls with every velocity of both bodies, and its part in the rate of a gap, or of a slip in
    /// a direction.
    pub(super) fn each_part_of_touch(
        &self,
        (at, surface, touch): (At, &Surface<S>, &Touch<S>),
        direction: Option<Direction>,
        mut each: impl FnMut(usize, S),
    ) {
        let [along, across] = touch.directions;
        let way = match direction {
            None => touch.normal,
            Some(Direction::Along) => along,
            Some(Direction::Across) => across,
        };
        let bodies = [
            (at.body::<M>(), way),
            (surface.body::<M>(), times(&way, -S::one())),
        ];
        for (body, way) in bodies {
            let Some(body) = body else {
                continue;
            };
            let Some(info) = BodyHandle::<M>::new(body).info() else {
                continue;
            };
            for (place, part) in (info.velocity..).zip(way) {
                each(place, part);
            }
            let coordinates = self.bodies.coordinates().as_slice();
            if let Some((_, place)) = BodyHandle::<M>::new(body).orientation() {
                let p = normalised(&read(coordinates, place));
                let arm = minus(&touch.point, &read(coordinates, info.coordinate));
                let moment = rotate_back(&p, &cross(&arm, &way));
                for (place, part) in (info.velocity + 3..).zip(moment) {
                    each(place, part);
                }
            }
        }
    }

    fn on_plane(&self, plane: &PlaceOfPlane<S>) -> Frame<S> {
        let [base, velocity] = self.point(plane.body, &plane.point);
        let [normal, along] = [plane.normal, plane.along].map(|vector| match plane.body {
            Some(body) => self.turned(body, &vector)[0],
            None => vector,
        });
        Frame {
            base,
            velocity,
            normal,
            along,
            beyond: S::zero(),
        }
    }

    /// At the point that is nearest to the middle of a ball.
    fn on_sphere(&self, sphere: &PlaceOfSphere<S>, centre: &[S; 3]) -> Frame<S> {
        let [base, velocity] = self.at(sphere.at);
        let way = minus(centre, &base);
        let length = dot(&way, &way).sqrt();
        let outwards = times(&way, length.reciprocal());
        let (normal, beyond) = if sphere.is_hollow {
            (outwards.map(|component| -component), -sphere.radius)
        } else {
            (outwards, sphere.radius)
        };
        let within = minus(&sphere.along, &times(&normal, dot(&sphere.along, &normal)));
        let along = times(&within, dot(&within, &within).sqrt().reciprocal());
        Frame {
            base,
            velocity,
            normal,
            along,
            beyond,
        }
    }
}
