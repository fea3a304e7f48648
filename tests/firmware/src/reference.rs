//! What the host computes in `f64`: an angle (rad) and a force (N) after the last period.
//! `tests/tests/firmware.rs` holds it.

/// The pendulum by its bodies.
pub const PENDULUM_BY_BODIES: [f64; 2] = [-0.794677366553959, 96.12261239583279];
/// The pendulum by its joints.
pub const PENDULUM_BY_JOINTS: [f64; 2] = [-0.7946773777861279, 96.12261430085297];
/// The four-bar by its bodies.
pub const FOUR_BAR_BY_BODIES: [f64; 2] = [0.2783268020723936, 11.097543293278411];
/// The four-bar by its joints.
pub const FOUR_BAR_BY_JOINTS: [f64; 2] = [0.2783268020357297, 11.097543295832459];
/// The UR5 by its joints.
pub const UR5_BY_JOINTS: [f64; 2] = [0.09193173430336518, 36.255066520248505];
