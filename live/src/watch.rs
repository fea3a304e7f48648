//! The error of steps, from one step in many that is taken once more in two halves.

/// How long the error is added up in words (s).
const DURATION: f64 = 10.0;
/// Steps before anything is said: a single impact says nothing.
const ENOUGH: usize = 30;

/// What was found since the last change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watch {
    /// Of the mechanism (m).
    size: f64,
    steps: usize,
    /// Sum of the errors (m), and the time in which they arose (s).
    error: f64,
    time: f64,
}

impl Watch {
    pub(crate) const fn new(size: f64) -> Self {
        Self {
            size,
            steps: 0,
            error: 0.0,
            time: 0.0,
        }
    }

    pub(crate) const fn size(&self) -> f64 {
        self.size
    }

    /// Begins anew.
    pub(crate) const fn forget(&mut self) {
        *self = Self::new(self.size);
    }

    /// Adds a step with its error (m).
    pub(crate) fn add(&mut self, error: f64, step: f64) {
        self.steps += 1;
        self.error += error;
        self.time += step;
    }

    /// The error of positions after ten seconds, if errors of steps added up, in sizes of the
    /// mechanism; 0 until enough steps were looked at.
    pub(crate) fn error(&self) -> f64 {
        if self.steps < ENOUGH {
            return 0.0;
        }
        self.error / self.time * DURATION / self.size
    }
}
