//! Runge-Kutta methods of order 2.

use super::explicit::explicit;

/// Half the angle of a step, `z`, times the ratio of `z^3 / 3`, by which an angle is off after it,
/// and `z^4 / 8`, by which `|p|` is.
const ANGLE_ERROR_OF_SHORT_STEPS: f64 = 8.0 / 3.0;
/// The ratio for steps of a radian.
const ANGLE_ERROR: f64 = 2.0 * ANGLE_ERROR_OF_SHORT_STEPS;

explicit! {
    /// The explicit midpoint method of order 2, of Runge: two evaluations a step, no estimate of
    /// the error.
    ///
    /// Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, (II.1.4). Output
    /// within a step is by the cubic through states and slopes at both ends.
    ///
    /// A step of Euler parameters at a constant angular velocity `w` multiplies `|p|^2` by
    /// `1 + z^4 / 4` with `z = |w| h / 2`.
    Midpoint;
    slopes { k1, inner [k2], kept [] }
    stages { 1.0 / 2.0 => k2 { k1: 1.0 / 2.0 } }
    result { k2: 1.0 }
    model {
        angle_error: ANGLE_ERROR,
        angle_error_of_short_steps: ANGLE_ERROR_OF_SHORT_STEPS,
        phase_error: 1.0 / 6.0,
    }
}

explicit! {
    /// The method of Heun of order 2, the trapezoidal rule with a predictor: two evaluations a
    /// step, at its start and at its end, no estimate of the error.
    ///
    /// Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, exercise II.1.1.
    /// Output within a step is by the cubic through states and slopes at both ends; Euler
    /// parameters lose their length as with [`Midpoint`].
    Heun;
    slopes { k1, inner [k2], kept [] }
    stages { 1.0 => k2 { k1: 1.0 } }
    result { k1: 1.0 / 2.0, k2: 1.0 / 2.0 }
    model {
        angle_error: ANGLE_ERROR,
        angle_error_of_short_steps: ANGLE_ERROR_OF_SHORT_STEPS,
        phase_error: 1.0 / 6.0,
    }
}
