//! The method of Dormand and Prince.

use super::Adaptive;
use super::explicit::explicit;

/// Dormand-Prince 5(4) with the step control of MATLAB's `ode45`, see [`Adaptive`]: `6 k + 1`
/// evaluations for `k` steps. Output within a step is by the free interpolant of order 4.
///
/// ```
/// use holonom::{DormandPrince, Tolerance};
///
/// let ode45 = DormandPrince::new(Tolerance { relative: 1e-6, absolute: 1e-9 });
/// assert_eq!(ode45, DormandPrince::default());
/// ```
pub type DormandPrince<S> = Adaptive<S, DormandPrince5>;

explicit! {
    /// One step of Dormand-Prince, of order 5: six evaluations, one of them shared with the next
    /// step where a [`FixedStep`](super::FixedStep) drives it.
    ///
    /// Dormand and Prince, *A family of embedded Runge-Kutta formulae*, J. Comp. Appl. Math. 6
    /// (1980), 19-26; Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, 2nd
    /// ed., table II.5.2. Within a step, `ntrp45` of MATLAB (Shampine, *Some practical Runge-Kutta
    /// formulas*, Math. Comp. 46 (1986), 135-150). Slope 2 is in the stages alone.
    DormandPrince5;
    slopes { k1, inner [k2], kept [k3, k4, k5, k6] }
    stages {
        1.0 / 5.0 => k2 { k1: 1.0 / 5.0 }
        3.0 / 10.0 => k3 { k1: 3.0 / 40.0, k2: 9.0 / 40.0 }
        4.0 / 5.0 => k4 { k1: 44.0 / 45.0, k2: -56.0 / 15.0, k3: 32.0 / 9.0 }
        8.0 / 9.0 => k5 {
            k1: 19372.0 / 6561.0,
            k2: -25360.0 / 2187.0,
            k3: 64448.0 / 6561.0,
            k4: -212.0 / 729.0,
        }
        1.0 => k6 {
            k1: 9017.0 / 3168.0,
            k2: -355.0 / 33.0,
            k3: 46732.0 / 5247.0,
            k4: 49.0 / 176.0,
            k5: -5103.0 / 18656.0,
        }
    }
    result {
        k1: 35.0 / 384.0,
        k3: 500.0 / 1113.0,
        k4: 125.0 / 192.0,
        k5: -2187.0 / 6784.0,
        k6: 11.0 / 84.0,
    }
    error 5.0, k7 {
        k1: 71.0 / 57600.0,
        k3: -71.0 / 16695.0,
        k4: 71.0 / 1920.0,
        k5: -17253.0 / 339_200.0,
        k6: 22.0 / 525.0,
        k7: -1.0 / 40.0,
    }
    within k7 {
        k1: [1.0, -183.0 / 64.0, 37.0 / 12.0, -145.0 / 128.0],
        k3: [0.0, 1500.0 / 371.0, -1000.0 / 159.0, 1000.0 / 371.0],
        k4: [0.0, -125.0 / 32.0, 125.0 / 12.0, -375.0 / 64.0],
        k5: [0.0, 9477.0 / 3392.0, -729.0 / 106.0, 25515.0 / 6784.0],
        k6: [0.0, -11.0 / 7.0, 11.0 / 3.0, -55.0 / 28.0],
        k7: [0.0, 3.0 / 2.0, -4.0, 5.0 / 2.0],
    }
    model {
        // With `z` half the angle of a step, the method leaves `|p|` by `z^6 / 3600` and an angle
        // by less than `z^7 / 3600`: their ratio is below one where a step turns by less than two
        // radians.
        angle_error: 1.0,
    }
}
