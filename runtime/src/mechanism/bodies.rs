//! Sets of bodies and of joints, by handle.

use core::ops::RangeFull;

use crate::mechanism::handle::{BodyHandle, JointHandle};

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

/// Some joints of a mechanism: a handle, handles of one type in brackets, of different types in a
/// tuple of up to six.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no set of joints of `{M}`",
    label = "neither a joint, nor joints in brackets or in a tuple",
    note = "write `h.a` for one joint, `[h.a, h.b]` for joints of one type, `(h.a, h.slide)` for joints of different types"
)]
pub trait Joints<M>: sealed::Sealed {
    /// Whether the joint at this place of [`Report::joints`](crate::Report::joints) is one of them.
    #[doc(hidden)]
    fn has_joint(&self, joint: usize) -> bool;
}

impl<M, J> Joints<M> for JointHandle<M, J> {
    fn has_joint(&self, joint: usize) -> bool {
        self.index() == joint
    }
}

impl<M, J, const N: usize> Joints<M> for [JointHandle<M, J>; N] {
    fn has_joint(&self, joint: usize) -> bool {
        self.iter().any(|one| one.index() == joint)
    }
}

macro_rules! tuples {
    ($(($($name:ident),*))*) => {$(
        impl<M, $($name: Joints<M>),*> Joints<M> for ($($name,)*) {
            #[expect(non_snake_case, reason = "each handle has the name of its type")]
            fn has_joint(&self, joint: usize) -> bool {
                let ($($name,)*) = self;
                false $(|| $name.has_joint(joint))*
            }
        }

        impl<$($name: sealed::Sealed),*> sealed::Sealed for ($($name,)*) {}
    )*};
}

tuples! { (A, B) (A, B, C) (A, B, C, D) (A, B, C, D, E) (A, B, C, D, E, F) }

mod sealed {
    use super::{BodyHandle, JointHandle, RangeFull};

    pub trait Sealed {}

    impl Sealed for RangeFull {}
    impl<M> Sealed for BodyHandle<M> {}
    impl<M> Sealed for [BodyHandle<M>] {}
    impl<M, const N: usize> Sealed for [BodyHandle<M>; N] {}
    impl<M, J> Sealed for JointHandle<M, J> {}
    impl<M, J, const N: usize> Sealed for [JointHandle<M, J>; N] {}
    impl<B: Sealed + ?Sized> Sealed for &B {}
}
