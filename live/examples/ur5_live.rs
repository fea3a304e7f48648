//! A UR5 that falls under gravity, with the torque of each motor and the pose it starts in as
//! sliders:
//!
//! ```text
//! cargo run --release -p holonom-live --example ur5_live -- target/films/ur5-live.html
//! ```

use holonom::prelude::*;
use holonom_live::Live;
use holonom_models::Ur5;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args().nth(1);
    let h = Ur5::HANDLES;
    let live = Live::new(Ur5::default())
        .slider(|of| &mut of.pan_torque, "N m", -20.0..=20.0)
        .slider(|of| &mut of.lift_torque, "N m", -100.0..=100.0)
        .slider(|of| &mut of.elbow_torque, "N m", -50.0..=50.0)
        .slider(|of| &mut of.wrist_1_torque, "N m", -5.0..=5.0)
        .slider(|of| &mut of.wrist_2_torque, "N m", -5.0..=5.0)
        .slider(|of| &mut of.wrist_3_torque, "N m", -5.0..=5.0)
        .start_angle(h.lift, ..)
        .start_angle(h.elbow, ..)
        .energies()
        .film(move |mut film| {
            film.trace(h.third_wrist);
            film.titled("UR5")
        });
    Ok(live.page(file.unwrap_or("ur5-live.html".into()))?)
}
