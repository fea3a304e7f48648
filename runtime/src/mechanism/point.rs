//! Named points, as types of a mechanism's fields.

use crate::mechanism::handle::{BodyHandle, PointHandle};

/// A point that is fixed on a body and has a name: a tool, a marker of a camera, a place to push.
///
/// Described by `#[point(on = body, at = [..])]` above the field. `at` is in global axes (m) in the
/// reference configuration, like the points of joints; `on` may be `ground`. Joints, drivers and
/// forces take its name in the place of a point: `tail = tool`.
/// [`View::position`](crate::View::position) reads it by its handle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Point;

/// What has a place: a body, which is at its centre of mass, or a named point.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no place of its own",
    label = "neither a body nor a named point",
    note = "take the handle of a body, which is at its centre of mass, or of a `#[point(on = body, at = [..])]`"
)]
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
