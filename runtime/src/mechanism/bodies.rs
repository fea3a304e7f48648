//! Sets of bodies, by handle.

use core::ops::RangeFull;

use crate::mechanism::handle::BodyHandle;

/// Some bodies of a mechanism: `..` for all of them, a handle for one, or handles in an array or a
/// slice. It is a set: a body that is named twice counts once.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no set of bodies of `{M}`",
    label = "neither `..`, nor a body, nor bodies in brackets",
    note = "write `..` for all bodies, `h.rod` for one, `[h.rod, h.wheel]` for some"
)]
pub trait Bodies<M>: sealed::Sealed {
    /// Whether the body at this place of [`Report::bodies`](crate::Report::bodies) is one of them.
    #[doc(hidden)]
    fn has(&self, body: usize) -> bool;
}

impl<M> Bodies<M> for RangeFull {
    fn has(&self, _body: usize) -> bool {
        true
    }
}

impl<M> Bodies<M> for BodyHandle<M> {
    fn has(&self, body: usize) -> bool {
        self.index() == body
    }
}

impl<M> Bodies<M> for [BodyHandle<M>] {
    fn has(&self, body: usize) -> bool {
        self.iter().any(|one| one.index() == body)
    }
}

impl<M, const N: usize> Bodies<M> for [BodyHandle<M>; N] {
    fn has(&self, body: usize) -> bool {
        self.as_slice().has(body)
    }
}

impl<M, B: Bodies<M> + ?Sized> Bodies<M> for &B {
    fn has(&self, body: usize) -> bool {
        (**self).has(body)
    }
}

mod sealed {
    use super::{BodyHandle, RangeFull};

    pub trait Sealed {}

    impl Sealed for RangeFull {}
    impl<M> Sealed for BodyHandle<M> {}
    impl<M> Sealed for [BodyHandle<M>] {}
    impl<M, const N: usize> Sealed for [BodyHandle<M>; N] {}
    impl<B: Sealed + ?Sized> Sealed for &B {}
}
