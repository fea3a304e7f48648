//! Named points, as types of a mechanism's fields.

use core::fmt;
use core::marker::PhantomData;

use crate::mechanism::handle::BodyHandle;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::PointInfo;

/// A point that is fixed on a body and has a name: a tool, a marker of a camera, a place to push.
///
/// Described by `#[point(on = body, at = [..])]` above the field. `at` is in global axes (m) in the
/// reference configuration, like the points of joints; `on` may be `ground`. Joints, drivers and
/// forces take its name in the place of a point: `tail = tool`.
/// [`View::position`](crate::View::position) reads it by its handle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Point;

/// A named point of the mechanism `M`.
pub struct PointHandle<M> {
    index: usize,
    mechanism: PhantomData<fn() -> M>,
}

impl<M> PointHandle<M> {
    #[doc(hidden)]
    #[must_use]
    pub const fn new(index: usize) -> Self {
        Self {
            index,
            mechanism: PhantomData,
        }
    }

    /// The place in [`Report::points`](crate::Report::points).
    #[must_use]
    pub const fn index(self) -> usize {
        self.index
    }
}

impl<M: Mechanism> PointHandle<M> {
    /// The name of the field.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.info().map_or("", |info| info.name)
    }

    pub(crate) fn info(self) -> Option<&'static PointInfo> {
        M::REPORT.points.get(self.index)
    }
}

impl<M> Clone for PointHandle<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M> Copy for PointHandle<M> {}

impl<M> PartialEq for PointHandle<M> {
    fn eq(&self, other: &Self) -> bool {
        self.index == other.index
    }
}

impl<M> Eq for PointHandle<M> {}

impl<M> fmt::Debug for PointHandle<M> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "PointHandle({})", self.index)
    }
}

/// What has a place: a body, which is at its centre of mass, or a named point.
pub trait Located<M>: Copy + sealed::Sealed {
    #[doc(hidden)]
    fn located(self) -> Place<M>;
}

/// A body, or a named point.
#[doc(hidden)]
#[derive(Debug)]
pub enum Place<M> {
    Body(BodyHandle<M>),
    Point(PointHandle<M>),
}

impl<M> Located<M> for BodyHandle<M> {
    fn located(self) -> Place<M> {
        Place::Body(self)
    }
}

impl<M> Located<M> for PointHandle<M> {
    fn located(self) -> Place<M> {
        Place::Point(self)
    }
}

mod sealed {
    pub trait Sealed {}

    impl<M> Sealed for super::BodyHandle<M> {}
    impl<M> Sealed for super::PointHandle<M> {}
}
