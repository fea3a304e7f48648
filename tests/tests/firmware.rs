//! What the firmware computes, computed here: the references that it is compared with on a
//! controller (`tests/firmware/run`).

#[allow(unreachable_pub, reason = "the firmware is a crate of its own")]
#[path = "../firmware/src/modes.rs"]
mod modes;
#[allow(unreachable_pub, reason = "the firmware is a crate of its own")]
#[path = "../firmware/src/reference.rs"]
mod reference;
#[allow(unreachable_pub, reason = "the firmware is a crate of its own")]
#[path = "../firmware/src/regulator.rs"]
mod regulator;
#[allow(
    dead_code,
    unreachable_pub,
    reason = "the firmware counts evaluations, and is a crate of its own"
)]
#[path = "../firmware/src/trials.rs"]
mod trials;

use holonom::Real;
use reference::{
    FOUR_BAR_BY_BODIES, FOUR_BAR_BY_JOINTS, PENDULUM_BY_BODIES, PENDULUM_BY_JOINTS, UR5_BY_JOINTS,
};
use trials::{
    PendulumByBodies, PendulumByJoints, Plant, SwingByBodies, SwingByJoints, Trial, Ur5ByJoints,
    run,
};

/// How far the readings are from the reference: angle (rad), and force relative to its size.
fn off<S: Real, T: Trial<S>>([angle, force]: [f64; 2]) -> [f64; 2] {
    let [read_angle, read_force] = run::<S, T>().expect("regular").map(Real::to_f64);
    let off = [
        (read_angle - angle).abs(),
        ((read_force - force) / force).abs(),
    ];
    let (name, description) = (T::Plant::NAME, T::DESCRIPTION);
    println!("{name}, {description}: {read_angle:?} {read_force:?}, off by {off:?}");
    off
}

fn below([angle, force]: [f64; 2], bound: f64) {
    assert!(angle < bound && force < bound);
}

/// Digits differ where a processor fuses multiplications and additions.
#[test]
fn references() {
    below(off::<f64, PendulumByBodies<_>>(PENDULUM_BY_BODIES), 1e-12);
    below(off::<f64, PendulumByJoints<_>>(PENDULUM_BY_JOINTS), 1e-12);
    below(off::<f64, SwingByBodies<_>>(FOUR_BAR_BY_BODIES), 1e-12);
    below(off::<f64, SwingByJoints<_>>(FOUR_BAR_BY_JOINTS), 1e-12);
    below(off::<f64, Ur5ByJoints<_>>(UR5_BY_JOINTS), 1e-12);
}

/// Both err by their steps of 1 ms.
#[test]
fn bodies_move_like_joints() {
    below(off::<f64, PendulumByBodies<_>>(PENDULUM_BY_JOINTS), 1e-6);
    below(off::<f64, SwingByBodies<_>>(FOUR_BAR_BY_JOINTS), 1e-6);
}

#[test]
fn single_precision() {
    below(off::<f32, PendulumByBodies<_>>(PENDULUM_BY_BODIES), 1e-3);
    below(off::<f32, PendulumByJoints<_>>(PENDULUM_BY_JOINTS), 1e-3);
    below(off::<f32, SwingByBodies<_>>(FOUR_BAR_BY_BODIES), 1e-3);
    below(off::<f32, SwingByJoints<_>>(FOUR_BAR_BY_JOINTS), 1e-3);
    below(off::<f32, Ur5ByJoints<_>>(UR5_BY_JOINTS), 1e-3);
}

/// Stops, friction, a clutch, events, a state and a table against their closed forms. Steps of 1 ms
/// are exact where accelerations are constant; the motor has come to its speed.
#[test]
fn modes_of_a_loop() {
    let [double, single] = [
        modes::worst::<f64>().expect("regular"),
        f64::from(modes::worst::<f32>().expect("regular")),
    ];
    println!("off by {double:e} in f64, {single:e} in f32");
    assert!(double < 1e-9 && single < 1e-4);
    let switching = modes::sprung::<f64>().expect("regular");
    println!("off by {switching:e} where a law switches");
    assert!(switching.abs() < 1e-6);
}

/// The page of the guide shows the files of `tests/firmware/balancer`, which `tests/firmware/run`
/// builds and runs.
#[test]
fn the_guide_shows_what_runs() {
    let here = env!("CARGO_MANIFEST_DIR");
    let read = |path: &str| std::fs::read_to_string(format!("{here}/{path}")).expect("a file");
    let page = read("../runtime/src/guide/embedded.md");
    // There, the repository is a folder beside the crate.
    let beside = |manifest: String| {
        let within = "{ path = \"../../../runtime\",";
        assert!(manifest.contains(within));
        manifest
            .replace(within, "{ path = \"../holonom/runtime\",")
            .replace("\n[workspace]\n", "")
    };
    for (file, kind) in [
        ("Cargo.toml", "toml"),
        (".cargo/config.toml", "toml"),
        ("memory.x", "text"),
        ("build.rs", "text"),
        ("src/main.rs", "text"),
    ] {
        let mut text = read(&format!("firmware/balancer/{file}"));
        if file == "Cargo.toml" {
            text = beside(text);
        }
        let block = format!("```{kind}\n{}\n```", text.trim_end());
        assert!(page.contains(&block), "the guide shows another `{file}`");
    }
    let printed = read("firmware/balancer/expected");
    let first: Vec<&str> = printed.lines().take(4).collect();
    assert!(page.contains(&format!("```text\n{}\n```", first.join("\n"))));
}

/// The gain of the regulator on the controller is that of its struct, and balances here as well.
#[test]
fn the_regulator_has_the_gain_of_its_struct() -> Result<(), holonom::Fault> {
    use holonom::independent::{discrete_lqr, to_discrete};
    use holonom::prelude::*;
    use nalgebra::{Matrix1, Matrix4, Vector4};
    use regulator::{CartPole, GAIN, PERIOD};

    let (cart_pole, h) = (CartPole::default(), CartPole::HANDLES);
    let space = cart_pole.coordinates((h.rail, h.pin))?;
    let upright = space.state([0.0, 0.0], [0.0, 0.0])?;
    let linear = space.linearise(&upright, [h.push], |_| [])?;
    let (a, b) = to_discrete(&linear.a(), &linear.b(), PERIOD);
    let q = Matrix4::from_diagonal(&Vector4::new(10.0, 100.0, 1.0, 1.0));
    let gain = discrete_lqr(&a, &b, &q, &Matrix1::new(0.1)).expect("it can be controlled");
    for (found, written) in gain.iter().zip(GAIN) {
        assert!((found - written).abs() < 1e-7, "{gain}");
    }
    assert!(regulator::balance::<f64>()?.iter().all(|x| x.abs() < 1e-2));
    assert!(regulator::balance::<f32>()?.iter().all(|x| x.abs() < 1e-2));
    assert!(regulator::everything::<f64>()? < 1e-12);
    Ok(())
}
