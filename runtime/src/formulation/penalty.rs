//! The penalty formulation.

use super::{Formulation, faster_decay};
use crate::error::Fault;
use crate::error::setting::positive;
use crate::math::scalar::Real;
use crate::mechanism::kernels::{Compliant, Stabilisation};

/// The penalty formulation: `lambda = alpha (Phi'' + 2 mu omega Phi' + omega^2 Phi)`.
///
/// `alpha` holds up to `1 / (64 EPSILON s)`, with `s` the largest of what a row yields to a unit
/// load, about one over the least mass: beyond it the compliance is lost in round-off. Where
/// equations are kept that depend on others, a larger one is refused with
/// [`StartFault::PenaltyFactor`](crate::error::StartFault::PenaltyFactor); elsewhere the
/// constraints are then rigid.
///
/// Every constraint is a spring, a damper and a mass on the violation. Solvable where constraints
/// are redundant or the configuration is singular; the motion has a bias of the order `1 / alpha`.
/// Bayo, Garcia de Jalon and Serna, *A modified Lagrangian formulation for the dynamic analysis of
/// constrained mechanical systems*, Comput. Methods Appl. Mech. Eng. 71 (1988), 183-195; Flores
/// 2015, chapter 13.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penalty<S> {
    /// `alpha`, positive: kg for a constraint in metres, kg m^2 for one in radians. A row in
    /// another unit is taken in metres: for a [`Distance`](crate::joints::Distance) of the length
    /// `l`, which is the difference of squares, `alpha / (2 l)^2`.
    pub alpha: S,
    /// `omega` (rad/s), positive: the frequency of the violation.
    pub omega: S,
    /// `mu`, positive: the damping ratio of the violation, 1 for critical damping.
    pub mu: S,
    /// How many metres a radian counts as, positive: a constraint in radians has `alpha radian^2`.
    /// `None` is one metre.
    pub radian: Option<S>,
}

impl<S> Penalty<S> {
    /// The formulation with its three coefficients; a radian counts as a metre.
    #[must_use]
    pub const fn new(alpha: S, omega: S, mu: S) -> Self {
        Self {
            alpha,
            omega,
            mu,
            radian: None,
        }
    }
}

/// `alpha = 1e7`, `omega = 10 rad/s`, `mu = 1`, as in Flores 2015, chapter 15: for a pendulum of a
/// metre and some kilograms. [`Penalty::of`] is for any mechanism.
impl<S: Real> Default for Penalty<S> {
    fn default() -> Self {
        Self::new(S::constant(1e7), S::constant(10.0), S::one())
    }
}

impl<S: Real> Formulation<S> for Penalty<S> {
    type Terms = Compliant;

    fn decay_rate(&self) -> Option<S> {
        Some(faster_decay(self.omega * self.mu, self.omega))
    }

    fn stabilisation(&self) -> Result<Stabilisation<S>, Fault> {
        checked(self.radian)?;
        stabilisation(self.alpha, self.omega, self.mu)
    }

    // With less of it, errors of steps could take away what the bias differs by.
    fn companion(&self) -> Self {
        let alpha = S::constant(2.0) * self.alpha;
        Self { alpha, ..*self }
    }

    fn radian(&self) -> S {
        self.radian.unwrap_or(S::one())
    }
}

/// Refuses a length of a radian that is none.
pub(super) fn checked<S: Real>(radian: Option<S>) -> Result<(), Fault> {
    if let Some(length) = radian {
        positive("length of a radian of the penalty", length)?;
    }
    Ok(())
}

/// `2 omega mu`, `omega^2` and `1 / alpha`.
pub(super) fn stabilisation<S: Real>(alpha: S, omega: S, mu: S) -> Result<Stabilisation<S>, Fault> {
    let alpha = positive("alpha of the penalty", alpha)?;
    let omega = positive("omega of the penalty", omega)?;
    let mu = positive("mu of the penalty", mu)?;
    Ok(Stabilisation {
        rate: (omega + omega) * mu,
        position: omega * omega,
        compliance: alpha.reciprocal(),
    })
}
