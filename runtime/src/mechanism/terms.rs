//! What formulations have in common with kernels: their terms, the coefficients of these, and the
//! rates of Euler parameters.

use core::fmt::Debug;

use crate::state::sealed::Sealed;

/// The coefficients of a formulation: `gamma* = gamma - 2 a Phi' - b^2 Phi` and the compliance `e`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stabilisation<S> {
    /// `2 a` (1/s), the factor of `Phi'`.
    pub rate: S,
    /// `b^2` (1/s^2), the factor of `Phi`.
    pub position: S,
    /// `e`, zero for rigid constraints; `1 / alpha` for a penalty `alpha`.
    pub compliance: S,
}

/// Which terms a formulation has: a type-level choice, so that a formulation pays for its own terms
/// only.
pub trait Terms: Copy + Debug + Sealed + 'static {
    /// Terms of `Phi` and `Phi'`.
    const STABILISED: bool;
    /// A compliance `e > 0`. Implies [`Terms::STABILISED`].
    const COMPLIANT: bool;
}

/// Terms under which constraints neither yield nor may be violated.
#[diagnostic::on_unimplemented(
    message = "with the terms `{Self}` of this formulation constraints yield, or are violated for a while",
    label = "no rigid constraints",
    note = "`GeneralizedAlpha` solves for positions on rigid constraints: it takes `StandardLagrange`"
)]
pub trait Rigid: Terms {}

impl Rigid for Plain {}

/// Neither stabilisation nor compliance.
#[derive(Clone, Copy, Debug)]
pub struct Plain;

/// Terms of `Phi` and `Phi'`, rigid.
#[derive(Clone, Copy, Debug)]
pub struct Stabilised;

/// Terms of `Phi` and `Phi'`, and a compliance.
#[derive(Clone, Copy, Debug)]
pub struct Compliant;

impl Sealed for Plain {}
impl Sealed for Stabilised {}
impl Sealed for Compliant {}

impl Terms for Plain {
    const STABILISED: bool = false;
    const COMPLIANT: bool = false;
}

impl Terms for Stabilised {
    const STABILISED: bool = true;
    const COMPLIANT: bool = false;
}

impl Terms for Compliant {
    const STABILISED: bool = true;
    const COMPLIANT: bool = true;
}

/// Whether the rates of Euler parameters are those of `p` or of `p / |p|`.
#[doc(hidden)]
pub trait Orientation: Copy + Debug + Default + 'static {
    /// Whether they are those of `p / |p|`.
    const NORMALISED_RATES: bool;
}

/// `p' = 1/2 L(p)^T w` with `p` as it is; `p` comes to length 1 after every step.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, Default)]
pub struct Normalised;

impl Orientation for Normalised {
    const NORMALISED_RATES: bool = false;
}
