//! Random numbers and motions.

/// The size of a motion: in radians, and in fractions of the size of the mechanism.
const MOTION: f64 = 0.2;

/// Numbers without a pattern, the same at every expansion (Marsaglia's xorshift).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) const fn new() -> Self {
        Self(0x9e37_79b9_7f4a_7c15)
    }

    /// Between -1 and 1.
    pub(crate) fn number(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// A motion of [`MOTION`] at most.
    pub(super) fn motion(&mut self, velocities: usize) -> Vec<f64> {
        (0..velocities).map(|_| MOTION * self.number()).collect()
    }
}
