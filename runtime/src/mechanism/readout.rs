//! What a joint shows of the relative motion of its bodies.

use core::f64::consts::TAU;

use nalgebra::Vector3;

use crate::math::scalar::Scalar;

/// Cosine and sine of a joint angle, its rate, and the count of turns where the joint keeps one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AngleParts<S> {
    /// The cosine; not normalised where the joint is violated.
    pub cosine: S,
    /// The sine; not normalised where the joint is violated.
    pub sine: S,
    /// The rate of the angle (rad/s).
    pub rate: S,
    /// For a joint whose definition counts turns, or beside which a joint or force between the same
    /// bodies counts them about the same axis: the auxiliary variable of the state (rad) that the
    /// angle lies near.
    pub turns: Option<S>,
}

impl<S: Scalar> AngleParts<S> {
    /// That of a joint without an angle: zero, at rest.
    #[must_use]
    pub fn none() -> Self {
        Self {
            cosine: S::one(),
            sine: S::zero(),
            rate: S::zero(),
            turns: None,
        }
    }

    /// The angle (rad): from `-pi` to `pi`, or, where turns are counted, the one of all angles with
    /// this sine and cosine that is nearest to the auxiliary variable.
    #[must_use]
    pub fn angle(&self) -> S {
        let angle = self.sine.atan2(self.cosine);
        match self.turns {
            Some(turns) => {
                let count = (turns - angle) * S::constant(TAU.recip());
                count.round().fused(S::constant(TAU), angle)
            }
            None => angle,
        }
    }
}

/// A displacement along a joint and its rate, as the joint's definition states it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisplacementParts<S> {
    /// The displacement (m).
    pub value: S,
    /// Its rate (m/s).
    pub rate: S,
}

impl<S: Scalar> DisplacementParts<S> {
    /// That of a joint without a displacement: zero, at rest.
    #[must_use]
    pub fn none() -> Self {
        Self {
            value: S::zero(),
            rate: S::zero(),
        }
    }
}

/// Where a body touches another, in global axes: of a joint that rolls
/// ([`View::contact`](crate::View::contact)), or of a contact of a run
/// ([`Sample::contact_of`](crate::Sample::contact_of)).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ContactPoint<S> {
    /// The point (m).
    pub position: Vector3<S>,
    /// The direction from there into the body that rolls or touches, of length 1.
    pub normal: Vector3<S>,
    /// The velocity (m/s) of the material of that body there against the material of the other,
    /// along the surface. Of what rolls without slip it is zero, to the drift of the velocities.
    pub slip: Vector3<S>,
}

impl<S: Scalar> ContactPoint<S> {
    /// Of point, normal and slip.
    pub(crate) fn of([position, normal, slip]: [[S; 3]; 3]) -> Self {
        Self {
            position: position.into(),
            normal: normal.into(),
            slip: slip.into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::{PI, TAU};

    use super::AngleParts;

    fn parts(angle: f64, turns: Option<f64>) -> AngleParts<f64> {
        AngleParts {
            cosine: angle.cos(),
            sine: angle.sin(),
            rate: 0.0,
            turns,
        }
    }

    #[test]
    fn an_angle_that_counts_turns_is_the_nearest_to_its_counter() {
        for turns in -3..=3 {
            for angle in [-3.1, -1.0, 0.0, 2.0, 3.1] {
                let whole = angle + TAU * f64::from(turns);
                for off in [-3.0, -0.1, 0.0, 3.0] {
                    let found = parts(angle, Some(whole + off)).angle();
                    assert!((found - whole).abs() < 1e-14, "{found} for {whole}");
                }
            }
        }
    }

    #[test]
    fn without_a_counter_an_angle_stays_within_half_a_turn() {
        assert!((parts(PI + 0.1, None).angle() - (0.1 - PI)).abs() < 1e-15);
        assert!(parts(f64::NAN, None).angle().is_nan());
        assert!(parts(0.1, Some(f64::NAN)).angle().is_nan());
    }
}

/// The energy of a force and what it does besides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceParts<S> {
    /// Its potential energy (J).
    pub potential: S,
    /// The power (W) of what has no potential: of dampers, actuators, given forces.
    pub power: S,
}
