//! Traits that `derive` would bound by the parameters of a type, and that hold without.

/// `Clone` and `Copy` of types whose fields are `Copy` for all parameters: those in brackets, with
/// their bounds.
macro_rules! copied {
    ($([$($parameters:tt)*] $type:ty);* $(;)?) => {$(
        impl<$($parameters)*> Clone for $type {
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<$($parameters)*> Copy for $type {}
    )*};
}
pub(crate) use copied;

/// `Debug` by the name alone, of what holds many numbers or what it borrows.
macro_rules! opaque {
    ($([$($parameters:tt)*] $type:ty, $name:literal);* $(;)?) => {$(
        impl<$($parameters)*> core::fmt::Debug for $type {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.debug_struct($name).finish_non_exhaustive()
            }
        }
    )*};
}
pub(crate) use opaque;
