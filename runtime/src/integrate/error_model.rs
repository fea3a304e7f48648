//! What is known of the errors of a method before it is used.

/// How the errors of a method grow, as far as its tables tell: what a run takes for its warnings.
///
/// A method of one's own gives what it knows:
/// `ErrorModel { phase_error: 1.0 / 6.0, ..Default::default() }`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorModel {
    /// By how much an angle (rad) is off, at most, where Euler parameters left length 1 by so much
    /// in a step: the angle error per unit of norm drift.
    ///
    /// With `z` half the angle of a step, the classical Runge-Kutta method leaves `|p|` by
    /// `z^6 / 144` and an angle by `z^5 / 60`. The default is their ratio for steps of half a
    /// radian, 10.
    pub angle_error: f64,
    /// The same for short steps, times half the angle (rad) of a step. For methods of even order
    /// the angle error is one order lower than the norm drift. Zero for others.
    pub angle_error_of_short_steps: f64,
    /// The leading phase-error constant `c` of a method of order 2: a step of `x` rad shifts the
    /// phase by `c x^3`, which no energy tells. Zero for others. Where it is not zero,
    /// [`Advance::better_end`](super::Advance::better_end) judges the steps.
    pub phase_error: f64,
    /// By what part of a step velocities are ahead of coordinates, for a method of order 1 that
    /// takes coordinates by velocities at the end of a step. Zero for others.
    pub stagger: f64,
    /// What a step adds to the error of the state, with `e` its estimated error relative to the
    /// state: `estimate_share * e ^ estimate_power`. An estimate that is of a lower order than the
    /// result is larger than what the result is off by. Both are 1 by default.
    pub estimate_power: f64,
    /// See `estimate_power`.
    pub estimate_share: f64,
}

impl Default for ErrorModel {
    fn default() -> Self {
        Self {
            angle_error: 10.0,
            angle_error_of_short_steps: 0.0,
            phase_error: 0.0,
            stagger: 0.0,
            estimate_power: 1.0,
            estimate_share: 1.0,
        }
    }
}
