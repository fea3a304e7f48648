//! Coefficients of the Runge-Kutta methods.

use crate::math::scalar::Scalar;

/// A row of a tableau times the step.
#[inline(always)]
pub(super) fn scaled<S: Scalar, const N: usize>(row: [f64; N], step: S) -> [S; N] {
    let mut weights = [step; N];
    for (weight, factor) in weights.iter_mut().zip(row) {
        *weight = S::constant(factor) * step;
    }
    weights
}

/// The pair of Bogacki and Shampine, order 3 with an embedded order 2.
///
/// Bogacki and Shampine, *A 3(2) pair of Runge-Kutta formulas*, Appl. Math. Lett. 2 (1989),
/// 321-325. Slope 4 is that at the end of the step.
pub(super) mod bogacki_shampine {
    /// Times of the stages 2 and 3.
    pub(crate) const TIMES: [f64; 2] = [1.0 / 2.0, 3.0 / 4.0];
    /// Stage 2 from slope 1.
    pub(crate) const STAGE_2: [f64; 1] = [1.0 / 2.0];
    /// Stage 3 from slope 2.
    pub(crate) const STAGE_3: [f64; 1] = [3.0 / 4.0];
    /// The result, from slopes 1, 2, 3.
    pub(crate) const RESULT: [f64; 3] = [2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0];
    /// The result less that of order 2, from slopes 1, 2, 3, 4.
    pub(crate) const ERROR: [f64; 4] = [-5.0 / 72.0, 1.0 / 12.0, 1.0 / 9.0, -1.0 / 8.0];
}

/// The pair of Dormand and Prince, order 5 with an embedded order 4, and its free interpolant of
/// order 4.
///
/// Dormand and Prince, *A family of embedded Runge-Kutta formulae*, J. Comp. Appl. Math. 6 (1980),
/// 19-26; Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., table
/// II.5.2. The second column of slopes has no part in the result, in the error, and in the
/// interpolant.
///
/// ```text
///   0   |
///  1/5  | 1/5
///  3/10 | 3/40        9/40
///  4/5  | 44/45      -56/15       32/9
///  8/9  | 19372/6561 -25360/2187  64448/6561 -212/729
///  1    | 9017/3168  -355/33      46732/5247  49/176   -5103/18656
///  1    | 35/384      0           500/1113    125/192  -2187/6784   11/84
///  -----+------------------------------------------------------------------------
///  E    | 71/57600    0          -71/16695    71/1920  -17253/339200 22/525 -1/40
/// ```
pub(super) mod dormand_prince {
    /// Times of the stages 2 to 5; stages 6 and 7 are at the end of the step.
    pub(crate) const TIMES: [f64; 4] = [1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0];
    /// Stage 2 from slope 1.
    pub(crate) const STAGE_2: [f64; 1] = [1.0 / 5.0];
    /// Stage 3 from slopes 1 and 2.
    pub(crate) const STAGE_3: [f64; 2] = [3.0 / 40.0, 9.0 / 40.0];
    /// Stage 4 from slopes 1 to 3.
    pub(crate) const STAGE_4: [f64; 3] = [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0];
    /// Stage 5 from slopes 1 to 4.
    pub(crate) const STAGE_5: [f64; 4] = [
        19372.0 / 6561.0,
        -25360.0 / 2187.0,
        64448.0 / 6561.0,
        -212.0 / 729.0,
    ];
    /// Stage 6 from slopes 1 to 5.
    pub(crate) const STAGE_6: [f64; 5] = [
        9017.0 / 3168.0,
        -355.0 / 33.0,
        46732.0 / 5247.0,
        49.0 / 176.0,
        -5103.0 / 18656.0,
    ];
    /// The result, from slopes 1, 3, 4, 5, 6.
    pub(crate) const RESULT: [f64; 5] = [
        35.0 / 384.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
    ];
    /// The result less that of order 4, from slopes 1, 3, 4, 5, 6, 7.
    pub(crate) const ERROR: [f64; 6] = [
        71.0 / 57600.0,
        -71.0 / 16695.0,
        71.0 / 1920.0,
        -17253.0 / 339_200.0,
        22.0 / 525.0,
        -1.0 / 40.0,
    ];
    /// Weights of slopes 1, 3, 4, 5, 6, 7 at the fraction `theta`: a polynomial each, without
    /// constant term, from `theta` to `theta^4` (`ntrp45` of MATLAB; Shampine, *Some practical
    /// Runge-Kutta formulas*, Math. Comp. 46 (1986), 135-150).
    pub(crate) const INTERPOLANT: [[f64; 4]; 6] = [
        [1.0, -183.0 / 64.0, 37.0 / 12.0, -145.0 / 128.0],
        [0.0, 1500.0 / 371.0, -1000.0 / 159.0, 1000.0 / 371.0],
        [0.0, -125.0 / 32.0, 125.0 / 12.0, -375.0 / 64.0],
        [0.0, 9477.0 / 3392.0, -729.0 / 106.0, 25515.0 / 6784.0],
        [0.0, -11.0 / 7.0, 11.0 / 3.0, -55.0 / 28.0],
        [0.0, 3.0 / 2.0, -4.0, 5.0 / 2.0],
    ];
}
