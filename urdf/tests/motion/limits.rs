//! Runs that heed the limits of a file.

use holonom::error::AssemblyFault;
use holonom::prelude::*;

use super::robots::panda::Panda;

/// A position of the Panda within its limits, with closed fingers.
fn start(panda: &Panda) -> Result<StateOf<Panda>, Fault> {
    let h = Panda::HANDLES;
    let mut state = panda.described_state::<f64>()?;
    panda.set_angle(&mut state, h.panda_joint2, 0.3)?;
    panda.set_angle(&mut state, h.panda_joint4, -1.8)?;
    panda.set_angle(&mut state, h.panda_joint6, 1.5)?;
    Ok(state)
}

/// With all joints at zero the elbow is beyond its limit, as the file has it.
#[test]
fn a_start_beyond_a_limit_is_refused_by_its_joint() {
    let panda = Panda::default();
    let run = panda
        .simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=0.1, every(0.1), |_| ());
    let fault = run.expect_err("beyond").fault;
    let is_told = matches!(
        fault,
        Fault::Assembly(AssemblyFault::BeyondLimit { joint: "panda_joint4", limit, .. }) if (limit + 0.0698).abs() < 1e-15
    );
    assert!(is_told, "{fault}");
}

/// The arm falls into its stops. The fingers, of which one mimics the other, are opened and shut,
/// and stop together.
#[test]
fn a_falling_arm_stays_within_the_limits_of_its_file() -> Result<(), Box<dyn std::error::Error>> {
    let panda = Panda::default();
    let h = Panda::HANDLES;
    let limits = Panda::POSITION_LIMITS;
    let mut touched = [false; 9];
    let report = panda
        .simulation(StandardLagrange, DormandPrince::default())
        .initial_state(start(&panda)?)
        .every_period(0.4, |sample, inputs| {
            let is_opened = (5.0 * sample.time() + 0.5).rem_euclid(4.0) < 1.0;
            inputs.panda_finger_joint1_force = if is_opened { 2.0 } else { -2.0 };
        })
        .run(0.0..=2.0, every(0.01), |sample| {
            let angles = [
                h.panda_joint1,
                h.panda_joint2,
                h.panda_joint3,
                h.panda_joint4,
                h.panda_joint5,
                h.panda_joint6,
                h.panda_joint7,
            ];
            let turned = angles.map(|joint| sample.angle(joint));
            let fingers = [h.panda_finger_joint1, h.panda_finger_joint2];
            let moved = fingers.map(|joint| sample.displacement(joint));
            let positions = turned.iter().chain(&moved).zip(limits).enumerate();
            for (place, (&position, [lower, upper])) in positions {
                let name = Panda::JOINT_NAMES[place];
                assert!(position > lower - 1e-8, "{name}: {position} {lower}");
                assert!(position < upper + 1e-8, "{name}: {position} {upper}");
                let gap = (position - lower).min(upper - position);
                touched[place] |= sample.time() > 0.0 && gap.abs() < 1e-8;
            }
            assert!((moved[0] - moved[1]).abs() < 1e-9, "{moved:?}");
        })?;
    // The shoulder, and both fingers.
    assert!(touched[1] && touched[7] && touched[8], "{touched:?}");
    assert_eq!(report.time, 2.0);
    Ok(())
}
