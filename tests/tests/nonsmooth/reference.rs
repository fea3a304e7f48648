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
/// Times of the impacts of a block that rocks on ice (s).
pub(super) const ROCKING: [f64; 4] = [
    0.2348220782448003,
    0.4701004064777812,
    0.62153233754746,
    0.7240259947322709,
];
/// Amplitudes of a clock's pendulum after a beat and before one (rad), its period (s).
pub(super) const CLOCK: [f64; 3] = [0.1969121295935668, 0.19578695210515737, 2.0044007565260658];
