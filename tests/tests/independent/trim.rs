//! Inputs, parameters and rates that hold a mechanism, against closed forms.

use holonom::error::{AnalysisFault, StepFault};
use holonom::independent::Varied;
use holonom::prelude::*;
use holonom_models::{CartPole, Panda, SliderCrank};

use super::continuation::{Governor, Press, load};

/// The torques that hold a robot are those of inverse dynamics.
#[test]
fn torques_of_a_robot() -> Result<(), Fault> {
    let (panda, h) = (Panda::default(), Panda::HANDLES);
    let joints = [
        h.joint_1, h.joint_2, h.joint_3, h.joint_4, h.joint_5, h.joint_6, h.joint_7,
    ];
    let torques = [
        h.joint_1_torque,
        h.joint_2_torque,
        h.joint_3_torque,
        h.joint_4_torque,
        h.joint_5_torque,
        h.joint_6_torque,
        h.joint_7_torque,
    ];
    let mut space = panda.coordinates(joints)?;
    let state = space.state([0.3, -0.8, 0.4, 1.1, -0.7, 2.0, 0.5], [0.0; 7])?;
    let wanted = space.bias(&state)?;
    let (held, found) = space.trim(&state, joints, torques)?;
    for (place, torque) in torques.into_iter().enumerate() {
        assert!((found[place] - wanted[place]).abs() < 1e-12, "{found:?}");
        space.set_value(torque, found[place])?;
        assert_eq!(space.value(torque), found[place]);
    }
    assert!(space.forward(&held, [0.0; 7])?.amax() < 1e-9);
    // Four are free: the arm hangs by its upper joints, which are held.
    let (held, found) = space.trim(&state, [h.joint_2, h.joint_4], [torques[1], torques[3]])?;
    let positions = space.positions(&held)?;
    assert!((positions[1] + 0.8).abs() < 1e-14 && (positions[3] - 1.1).abs() < 1e-14);
    space.set_value(torques[1], found[0])?;
    space.set_value(torques[3], found[1])?;
    assert!(space.forward(&held, [0.0; 7])?.amax() < 1e-8);
    Ok(())
}

/// By an input, and by a length that moves everything else of the loop.
#[test]
fn a_loop_is_held() -> Result<(), Fault> {
    let h = Press::HANDLES;
    let press = Press::new(0.3)?;
    let space = press.coordinates([h.bearing])?;
    for angle in [0.2, 1.0, 2.5, -1.0] {
        let guess = space.state([angle], [0.0])?;
        let (state, [found]) = space.trim(&guess, [h.bearing], [h.load])?;
        let wanted = load(0.3, angle);
        assert!(
            (found / wanted - 1.0).abs() < 1e-12,
            "{angle}: {found}, {wanted}"
        );
        assert!((space.positions(&state)?[0] - angle).abs() < 1e-15);
    }
    let mut space = space;
    space.set_value(h.load, load(0.2, 1.0))?;
    let guess = space.state([1.0], [0.0])?;
    let (state, [length]) = space.trim(&guess, [h.bearing], [h.crank_length])?;
    assert!((length - 0.2).abs() < 1e-13, "{length}");
    assert!((space.positions(&state)?[0] - 1.0).abs() < 1e-14);
    // The state is one of the mechanism with this length.
    let mut other = Press::new(0.2)?.coordinates([h.bearing])?;
    other.set_value(h.load, load(0.2, 1.0))?;
    assert!(other.forward(&state, [0.0])?.amax() < 1e-9);
    let x = Press::new(length)?
        .view(0.0, &other.bodies(&state))?
        .position(h.slider)
        .x;
    let wanted = 0.2 * 1.0_f64.cos() + (0.25 - (0.2 * 1.0_f64.sin()).powi(2)).sqrt();
    assert!((x - wanted).abs() < 1e-13, "{x}, {wanted}");
    Ok(())
}

/// The speed at which the ball is at a height of `g / w^2`.
#[test]
fn the_speed_of_a_governor() -> Result<(), Fault> {
    let (governor, h) = (Governor::default(), Governor::HANDLES);
    let space = governor.coordinates((h.bearing, h.hinge))?;
    for angle in [-0.4, 0.1, 0.6] {
        let guess = space.state([0.3, angle], [3.0, 0.0])?;
        let sought = [Varied::rate(h.bearing)?];
        let (state, [speed]) = space.trim(&guess, [h.hinge], sought)?;
        let below = 0.5 * (0.3_f64.atan2(0.4) - angle).sin();
        assert!(
            (speed - (9.81 / below).sqrt()).abs() < 1e-12,
            "{angle}: {speed}"
        );
        assert_eq!(space.rates(&state)[0], speed);
    }
    Ok(())
}

#[test]
fn what_does_not_balance_is_refused_by_name() -> Result<(), Fault> {
    let (cart, h) = (CartPole::default(), CartPole::HANDLES);
    let space = cart.coordinates((h.rail, h.hinge))?;
    // Upright, 0.1 rad from the description, nothing has to push.
    let upright = space.state([0.2, -0.1], [0.0, 0.0])?;
    let (_, [push]) = space.trim(&upright, [h.hinge], [h.push])?;
    assert!(push.abs() < 1e-13);
    // Tilted, a push that holds the pole drives the cart away.
    let tilted = space.state([0.2, 0.3], [0.0, 0.0])?;
    let found = space.trim(&tilted, [h.hinge], [h.push]);
    assert!(
        matches!(found, Err(Fault::Step(StepFault::NotConverged { .. }))),
        "{found:?}"
    );
    // A rate of nothing that turns fast.
    let found = space.trim(&upright, [h.hinge], [Varied::rate(h.rail)?]);
    assert_eq!(
        found.err(),
        Some(Fault::Analysis(AnalysisFault::NoEffect { unknown: "rail" }))
    );
    let found = space.trim(&upright, (h.rail, h.hinge), [h.push; 2]);
    assert_eq!(
        found.err(),
        Some(Fault::Analysis(AnalysisFault::NoEffect { unknown: "push" }))
    );
    let found = space.trim(&upright, [h.hinge, h.hinge], [h.push; 2]);
    assert_eq!(
        found.err(),
        Some(Fault::Analysis(AnalysisFault::ChosenTwice {
            joint: "hinge"
        }))
    );
    let nowhere = space.state([0.2, -0.1], [0.0, 1.0])?;
    let found = space.trim(&nowhere, [h.rail], [h.push]);
    assert_eq!(
        found.err(),
        Some(Fault::Analysis(AnalysisFault::NotSteady { joint: "hinge" }))
    );
    let (crank, h) = (SliderCrank::default(), SliderCrank::HANDLES);
    let space = crank.coordinates([h.bearing])?;
    let state = space.state([0.5], [0.0])?;
    let found = space.trim(&state, [h.guide], [Varied::rate(h.bearing)?]);
    assert_eq!(
        found.err(),
        Some(Fault::Analysis(AnalysisFault::NotChosen { joint: "guide" }))
    );
    Ok(())
}

/// A number that is none is refused by name, and the former one stays.
#[test]
fn values_are_finite() -> Result<(), Fault> {
    let h = Press::HANDLES;
    let press = Press::new(0.3)?;
    let mut space = press.coordinates([h.bearing])?;
    space.set_value(h.load, 4.0)?;
    let fault = space.set_value(h.load, f64::NAN).err();
    assert_eq!(
        fault.map(|fault| fault.to_string()).as_deref(),
        Some("`value` of `load` must be finite")
    );
    assert_eq!(space.value(h.load), 4.0);
    Ok(())
}
