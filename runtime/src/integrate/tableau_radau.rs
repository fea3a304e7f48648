//! The coefficients of Radau IIA of order 5 (Hairer and Wanner, *Solving Ordinary Differential
//! Equations II*, second edition, IV.5 and IV.8).

/// The square root of six.
const ROOT: f64 = 2.449_489_742_783_178;

/// The power of the step that the estimate of the error goes with.
pub(super) const POWER: f64 = 4.0;

/// Where the stages are in a step.
pub(super) const NODES: [f64; 3] = [(4.0 - ROOT) / 10.0, (4.0 + ROOT) / 10.0, 1.0];

/// The real eigenvalue of the inverse of the tableau, `3 + 3^(2/3) - 3^(1/3)`.
pub(super) const REAL: f64 = 3.637_834_252_744_496;

/// One of the complex ones, real and imaginary part: `3 + (3^(1/3) - 3^(2/3)) / 2`,
/// `-(3^(5/6) + 3^(7/6)) / 2`.
pub(super) const COMPLEX: [f64; 2] = [2.681_082_873_627_752, -3.050_430_199_247_410_6];

/// The increments to the stages from those in which the inverse of the tableau falls apart into its
/// eigenvalues.
pub(super) const TRANSFORMATION: [[f64; 3]; 3] = [
    [
        0.094_438_762_488_975_24,
        -0.141_255_295_020_954_2,
        0.030_029_194_105_147_42,
    ],
    [
        0.250_213_122_965_333_3,
        0.204_129_352_293_799_94,
        -0.382_942_112_757_261_9,
    ],
    [1.0, 1.0, 0.0],
];

/// The inverse of [`TRANSFORMATION`].
pub(super) const INVERSE: [[f64; 3]; 3] = [
    [
        4.178_718_591_551_904,
        0.327_682_820_761_062_4,
        0.523_376_445_499_449_5,
    ],
    [
        -4.178_718_591_551_904,
        -0.327_682_820_761_062_4,
        0.476_623_554_500_550_5,
    ],
    [
        0.502_872_634_945_786_8,
        -2.571_926_949_855_605,
        0.596_039_204_828_224_9,
    ],
];

/// What the increments, over the step, add to the slope at the start in the estimate of the error.
pub(super) const ERROR: [f64; 3] = [
    (-13.0 - 7.0 * ROOT) / 3.0,
    (-13.0 + 7.0 * ROOT) / 3.0,
    -1.0 / 3.0,
];

/// The polynomial through the state at the start and the stages: the weights of an increment at the
/// powers 1, 2, 3 of the fraction of the step.
pub(super) const POLYNOMIAL: [[f64; 3]; 3] = [
    [
        13.0 / 3.0 + 7.0 * ROOT / 3.0,
        -23.0 / 3.0 - 22.0 * ROOT / 3.0,
        10.0 / 3.0 + 5.0 * ROOT,
    ],
    [
        13.0 / 3.0 - 7.0 * ROOT / 3.0,
        -23.0 / 3.0 + 22.0 * ROOT / 3.0,
        10.0 / 3.0 - 5.0 * ROOT,
    ],
    [1.0 / 3.0, -8.0 / 3.0, 10.0 / 3.0],
];
