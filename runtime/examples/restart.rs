//! A state in a file, by the names of bodies, and a run that goes on from it.
//!
//! ```text
//! cargo run -p holonom --features serde --example restart
//! ```

use holonom::measure::NamedState;
use holonom::prelude::*;

/// A plate on a universal joint.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Plate {
    #[body(
        mass = 2.0, inertia = [[0.08, 0.01, 0.0], [0.01, 0.09, 0.0], [0.0, 0.0, 0.12]],
        position = [0.1, 0.2, -0.5], angular_velocity = [1.0, 0.0, 0.0]
    )]
    plate: Body,
    #[joint(
        between = [ground, plate], point = [0.1, 0.2, 0.0], axis_i = [1.0, 0.0, 0.0],
        axis_j = [0.0, 1.0, 0.0]
    )]
    cross: Universal,
}

/// Another mechanism.
#[derive(Mechanism)]
struct Ball {
    #[body(mass = 1.0, free)]
    ball: Particle,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let plate = Plate::default();
    let run = || {
        plate
            .simulation(StandardLagrange, Rk4::every(1e-3))
            .assembled()
    };
    let report = run().run(0.0..=1.0, every(0.5), |_| ())?;

    let saved = NamedState::<Plate>::new(report.time, report.state);
    let text = serde_json::to_string_pretty(&saved)?;
    println!("{text}");
    let read: NamedState<Plate> = serde_json::from_str(&text)?;
    assert_eq!(read, saved); // to the last bit
    let report = run()
        .initial_state(read.state)
        .run(read.time..=2.0, every(0.5), |_| ())?;
    println!("{}", serde_json::to_string_pretty(&report)?);

    let fault = serde_json::from_str::<NamedState<Ball>>(&text).expect_err("another mechanism");
    println!("{fault}");
    let refused = "this is a state of `Plate`, and not of `Ball`";
    assert!(fault.to_string().starts_with(refused));
    Ok(())
}
