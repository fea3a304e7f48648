//! Laws of time and of the state: what drivers follow and what actuators exert.

use core::fmt;
use std::sync::Arc;

/// A function of time (s) with its first two derivatives, each written down by hand.
#[derive(Clone)]
pub enum Motion {
    /// The same at all times.
    Constant(f64),
    /// `[f, f', f'']` at a time (s).
    Law(Arc<dyn Fn(f64) -> [f64; 3] + Send + Sync>),
}

impl fmt::Debug for Motion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(value) => f.debug_tuple("Constant").field(value).finish(),
            Self::Law(_) => f.write_str("Law(..)"),
        }
    }
}

impl Motion {
    /// A law from the function and its two derivatives.
    pub fn new(
        value: impl Fn(f64) -> f64 + Send + Sync + 'static,
        rate: impl Fn(f64) -> f64 + Send + Sync + 'static,
        curvature: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        Self::Law(Arc::new(move |t| [value(t), rate(t), curvature(t)]))
    }

    /// `c0 + c1 t + c2 t^2 + c3 t^3`.
    #[must_use]
    pub fn polynomial(c: [f64; 4]) -> Self {
        Self::Law(Arc::new(move |t| {
            [
                c[0] + t * (c[1] + t * (c[2] + t * c[3])),
                c[1] + t * (2.0 * c[2] + t * 3.0 * c[3]),
                2.0 * c[2] + 6.0 * c[3] * t,
            ]
        }))
    }

    /// `offset + amplitude sin(frequency t + phase)`, the frequency in rad/s.
    #[must_use]
    pub fn sine(offset: f64, amplitude: f64, frequency: f64, phase: f64) -> Self {
        Self::Law(Arc::new(move |t| {
            let (sin, cos) = (frequency * t + phase).sin_cos();
            [
                offset + amplitude * sin,
                amplitude * frequency * cos,
                -amplitude * frequency * frequency * sin,
            ]
        }))
    }

    /// `from` before `start`, `to` after `start + duration`, between them
    /// `6 x^5 - 15 x^4 + 10 x^3`.
    #[must_use]
    pub fn smooth_step(from: f64, to: f64, start: f64, duration: f64) -> Self {
        Self::Law(Arc::new(move |t| {
            let x = ((t - start) / duration).clamp(0.0, 1.0);
            let rise = to - from;
            [
                from + rise * x * x * x * (x * (6.0 * x - 15.0) + 10.0),
                rise / duration * 30.0 * x * x * (x - 1.0) * (x - 1.0),
                rise / (duration * duration) * 60.0 * x * (x * (2.0 * x - 3.0) + 1.0),
            ]
        }))
    }

    /// `[f, f', f'']` at a time (s).
    #[must_use]
    pub fn at(&self, time: f64) -> [f64; 3] {
        match self {
            Self::Constant(value) => [*value, 0.0, 0.0],
            Self::Law(law) => law(time),
        }
    }
}

/// What an actuator exerts (N or N m) for a length or an angle (m or rad), its rate and the time
/// (s).
#[derive(Clone)]
pub struct ForceLaw(Arc<dyn Fn(f64, f64, f64) -> f64 + Send + Sync>);

impl fmt::Debug for ForceLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("ForceLaw(..)")
    }
}

impl ForceLaw {
    /// A law of `(length, rate, time)`, or of `(angle, rate, time)`.
    pub fn new(law: impl Fn(f64, f64, f64) -> f64 + Send + Sync + 'static) -> Self {
        Self(Arc::new(law))
    }

    /// Its value.
    #[must_use]
    pub fn at(&self, coordinate: f64, rate: f64, time: f64) -> f64 {
        (self.0)(coordinate, rate, time)
    }
}
