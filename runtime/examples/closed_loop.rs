//! A closed loop: a four-bar that is set to an angle of its crank, assembled and released.
//!
//! ```text
//! cargo run -p holonom --example closed_loop
//! ```

use holonom::prelude::*;

/// A crank of 0.3 m, a coupler of 0.86 m and a rocker of 0.7 m on a base of 0.8 m. Four parallel
/// hinges have redundant equations, which are left out.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "joints")]
struct FourBar {
    #[body(mass = 0.3, inertia = [0.0001, 0.003, 0.003], position = [0.15, 0.0, 0.0])]
    crank: Body,
    #[body(mass = 1.2, inertia = [0.1, 0.1, 0.1], position = [0.5, 0.35, 0.0])]
    coupler: Body,
    #[body(mass = 0.7, inertia = [0.03, 0.03, 0.03], position = [0.8, 0.35, 0.0])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    foot: Revolute,
    #[joint(between = [crank, coupler], point = [0.3, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    #[joint(between = [coupler, rocker], point = [0.8, 0.7, 0.0], axis = [0.0, 0.0, 1.0])]
    knee: Revolute,
    #[joint(between = [ground, rocker], point = [0.8, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    stand: Revolute,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (four_bar, handles) = (FourBar::default(), FourBar::HANDLES);
    let mut state = four_bar.described_state::<f64>()?;
    four_bar.set_angle(&mut state, handles.foot, 1.0)?; // the loop is open now
    let correction = four_bar.assemble(0.0, &mut state)?; // and closed again
    println!("assembled: {:?}", correction.moved);
    let view = four_bar.view(0.0, &state)?;
    assert!((view.angle(handles.foot) - 1.0).abs() < 1e-9);
    let energy = view.energy();

    let mut crank = holonom::measure::UnwrappedAngle::default();
    let report = four_bar
        .simulation(StandardLagrange, DormandPrince::default())
        .projection(Projection::default())
        .initial_state(state)
        .run(0.0..=2.0, every(0.1), |sample| {
            let (time, angle) = (sample.time(), crank.read(sample, handles.foot));
            println!(
                "{time:.1} s: crank {angle:8.4} rad, rocker {:8.4} rad",
                sample.angle(handles.stand)
            );
            assert!((sample.energy() - energy).abs() < 1e-3);
        })?;
    println!("{}", report.warnings());
    assert!(report.worst_violation < 1e-20);
    Ok(())
}
