//! The method of Bogacki and Shampine.

use super::Adaptive;
use super::explicit::explicit;

/// Bogacki-Shampine 3(2) with the step control of MATLAB's `ode23`, see [`Adaptive`]: `3 k + 1`
/// evaluations for `k` steps. For loose tolerances. Output within a step is by the cubic through
/// states and slopes at both ends.
///
/// ```
/// use holonom::{BogackiShampine, Tolerance};
///
/// let ode23 = BogackiShampine::new(Tolerance { relative: 1e-3, absolute: 1e-6 });
/// assert_eq!(ode23.limits.evaluations, 10_000_000);
/// ```
pub type BogackiShampine<S> = Adaptive<S, BogackiShampine3>;

explicit! {
    /// One step of Bogacki-Shampine, of order 3: three evaluations, one of them shared with the
    /// next step.
    ///
    /// Bogacki and Shampine, *A 3(2) pair of Runge-Kutta formulas*, Appl. Math. Lett. 2 (1989),
    /// 321-325.
    BogackiShampine3;
    slopes { k1, inner [], kept [k2, k3] }
    stages {
        1.0 / 2.0 => k2 { k1: 1.0 / 2.0 }
        3.0 / 4.0 => k3 { k2: 3.0 / 4.0 }
    }
    result { k1: 2.0 / 9.0, k2: 1.0 / 3.0, k3: 4.0 / 9.0 }
    error 3.0, k4 { k1: -5.0 / 72.0, k2: 1.0 / 12.0, k3: 1.0 / 9.0, k4: -1.0 / 8.0 }
    model {
        // With `z` half the angle of a step, the method leaves `|p|` by `z^4 / 24` and an angle by
        // `z^5 / 15`: their ratio is below one where a step turns by less than a radian.
        angle_error: 1.0,
    }
}
