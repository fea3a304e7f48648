//! Written by `reference.py`.

/// Times of the impacts of a rod on a stop (s).
pub(super) const PENDULUM: [f64; 6] = [
    0.39372132921604835,
    1.0495817199608342,
    1.5516069632592342,
    1.8737861135313179,
    2.0514737636357867,
    2.1429297811430956,
];
/// Times of the impacts of a four-bar's rocker (s).
pub(super) const FOUR_BAR: [f64; 4] = [
    0.4724755047255281,
    0.7893483014547434,
    0.939230738675156,
    1.0132295301281788,
];
/// Its coupler and its rocker at the start, and the stop against that (rad).
pub(super) const FOUR_BAR_ANGLES: [f64; 3] =
    [0.27132513712191536, 1.3905869587221644, -0.2247599978703779];
/// Gravity (m/s^2), a crank's angle (rad) and rate (rad/s) after 2 s, friction by the load.
pub(super) const SLIDER_CRANK: [[f64; 3]; 2] = [
    [0.0, 13.47673986537319, 5.909070564444864],
    [9.81, 12.045656361257464, 4.470395113341512],
];
/// Times of the impacts of a rocking block (s), and the ratio of its rates.
pub(super) const ROCKING: [f64; 4] = [
    0.45486731595255053,
    1.1564746822023768,
    1.7389272753962366,
    2.2380097746162937,
];
pub(super) const ROCKING_RATIO: f64 = 0.9117647058823529;
/// Amplitudes of a clock's pendulum after a beat and before one (rad), its period (s).
pub(super) const CLOCK: [f64; 3] = [0.19717623365031062, 0.19552284804841355, 1.993604050959789];
