//! A Runge-Kutta method of order 3.

use super::explicit::explicit;

explicit! {
    /// The method of Kutta of order 3: three evaluations a step, no estimate of the error.
    ///
    /// Kutta, *Beitrag zur naherungsweisen Integration totaler Differentialgleichungen*, Z. Math.
    /// Phys. 46 (1901), 435-453; Hairer, Norsett and Wanner, *Solving Ordinary Differential
    /// Equations I*, II.1. Where rates depend on time alone it is Simpson's rule, of order 4. For
    /// the method of least truncation error (Ralston, *Runge-Kutta methods with minimum error
    /// bounds*, Math. Comp. 16 (1962), 431-437) take
    /// [`BogackiShampine::every`](crate::BogackiShampine::every), which has its stages.
    ///
    /// Output within a step is by the cubic through states and slopes at both ends. A step of Euler
    /// parameters at a constant angular velocity `w` multiplies `|p|^2` by `1 - z^4/12 + z^6/36`
    /// with `z = |w| h / 2`.
    Kutta3;
    slopes { k1, inner [k2, k3], kept [] }
    stages {
        1.0 / 2.0 => k2 { k1: 1.0 / 2.0 }
        1.0 => k3 { k1: -1.0, k2: 2.0 }
    }
    result { k1: 1.0 / 6.0, k2: 2.0 / 3.0, k3: 1.0 / 6.0 }
    model {
        // With `z` half the angle of a step, the method leaves `|p|` by `z^4 / 24` and an angle by
        // `z^5 / 15`: their ratio is below one where a step turns by a radian or less.
        angle_error: 1.0,
    }
}
