//! What nobody else implements: public traits below it may gain items.

/// Of traits that this crate alone implements.
pub trait Sealed {}

impl<S, const N: usize> Sealed for [S; N] {}
