//! Near configurations in which the chosen coordinates do not determine the others, and at states
//! that do not satisfy the constraints: what is told is right, and the rest is refused by name.

use core::f64::consts::FRAC_PI_2;

use holonom::error::AnalysisFault;
use holonom::prelude::*;
use holonom::{Real, error::ParameterFault};
use holonom_models::{FourBar, SliderCrank};

use super::continuation::Press;
use super::linear::Linkage;

/// A number that is told, or nothing where it is refused as it should be: by one of the joints that
/// can move.
fn told<T>(number: Result<T, Fault>, joints: &[&str]) -> Option<T> {
    match number {
        Ok(number) => Some(number),
        Err(Fault::Analysis(AnalysisFault::NotDetermined { joint: named })) => {
            assert!(joints.contains(&named), "{named}");
            None
        }
        Err(fault) => panic!("{fault}"),
    }
}

/// How many of four numbers at each distance (rad) from the flat parallelogram are told: the state,
/// the mass, the bias, the linear model. All that are told are right.
fn of_parallelogram<S: Real>(off: f64) -> [usize; 4] {
    let (bar, h) = (FourBar::default(), FourBar::HANDLES);
    let space = bar
        .coordinates_in::<S, 1>([h.left_foot])
        .expect("one freedom");
    let mut counts = [0; 4];
    let angle = FRAC_PI_2 + off;
    let joint = &["left_pin", "right_foot"];
    let state = space.state([S::constant(angle)], [S::one()]);
    let Some(state) = told(state, joint) else {
        return counts;
    };
    counts[0] += 1;
    // Closed form: see the model. A bound of five eighths of the digits, with a margin.
    let margin = 10.0 * S::EPSILON.to_f64().powf(0.375);
    let (mass, moment) = (5.0 / 3.0, 2.0 * 9.81);
    let right = |what: &str, found: S, wanted: f64, size: f64| {
        let error = (found.to_f64() - wanted).abs() / size;
        assert!(error < margin, "{what} at {off:e}: off by {error:e}");
    };
    if let Some(found) = told(space.mass(&state), joint) {
        counts[1] += 1;
        right("mass", found[0], mass, mass);
    }
    if let Some(found) = told(space.bias(&state), joint) {
        counts[2] += 1;
        right("bias", found[0], -moment * angle.sin(), moment);
    }
    if let Some(found) = told(space.linearise(&state, [], |_| []), joint) {
        counts[3] += 1;
        let slope = moment / mass;
        right("slope", found.by_positions[0], slope * angle.cos(), slope);
        right("damping", found.by_rates[0], 0.0, 1.0);
    }
    counts
}

/// At the change point of a parallelogram and on both sides of it.
#[test]
fn beside_a_change_point_all_that_is_told_is_right() {
    for exponent in [1, 2, 3, 5, 8] {
        for side in [-1.0, 1.0] {
            let off = side * 10.0_f64.powi(-exponent);
            let counts = of_parallelogram::<f64>(off);
            match exponent {
                // A tenth and a hundredth of a radian beside it nothing is lost.
                1 | 2 => assert_eq!(counts, [1; 4], "{off:e}"),
                3 => assert!(counts[1] == 1, "{off:e}: {counts:?}"),
                7.. => assert_eq!(counts, [0; 4], "{off:e}"),
                _ => {}
            }
        }
    }
    assert_eq!(of_parallelogram::<f64>(0.0), [0; 4]);
    // The others of few digits are refused from a hundredth of a radian on.
    for off in [0.0, 1e-7, -1e-3] {
        assert_eq!(of_parallelogram::<f32>(off), [0; 4]);
    }
    let _ = of_parallelogram::<f32>(-0.1);
    assert_eq!(of_parallelogram::<f32>(-0.5), [1; 4]);
}

/// At a dead point the slider does not determine the crank, though every position is known.
#[test]
fn beside_a_dead_point_all_that_is_told_is_right() -> Result<(), Fault> {
    let (crank, h) = (SliderCrank::default(), SliderCrank::HANDLES);
    let by_slider = crank.coordinates([h.guide])?;
    let by_crank = crank.coordinates([h.bearing])?;
    for exponent in 1..=12 {
        for side in [-1.0, 1.0] {
            let off = side * 10.0_f64.powi(-exponent);
            let state = by_crank.state([off], [3.0])?;
            let ratio = by_slider.rates(&state)[0] / 3.0;
            let mass = told(by_slider.mass(&state), &["crank_pin"]);
            assert_eq!(mass.is_some(), exponent < 5, "{off:e}");
            if let Some(mass) = mass {
                let error = mass[0] * ratio * ratio / by_crank.mass(&state)?[0] - 1.0;
                assert!(error.abs() < 1e-6, "{off:e}: {error:e}");
            }
            // Without an effort both tell the same acceleration of the crank.
            if let Some(slider) = told(by_slider.forward(&state, [0.0]), &["crank_pin"]) {
                let free = by_crank.forward(&state, [0.0])?;
                let left = by_slider.inverse(&state, slider)?[0] * ratio;
                let of_crank = by_crank.inverse(&state, free)?[0];
                let moment = by_crank.bias(&state)?[0].abs();
                assert!((left - of_crank).abs() < 1e-5 * moment, "{off:e}: {left}");
            }
        }
    }
    Ok(())
}

/// A length is set, and the state is still that of the former one: every face refuses it by joint.
#[test]
fn a_state_of_another_length_is_refused() -> Result<(), Fault> {
    let h = Press::HANDLES;
    let mut space = Press::new(0.3)?.coordinates([h.bearing])?;
    let former = space.state([0.7], [2.0])?;
    space.set_value(h.crank_length, 0.25)?;
    let faults = [
        space.mass(&former).err(),
        space.bias(&former).err(),
        space.inverse(&former, [1.0]).err(),
        space.forward(&former, [1.0]).err(),
        space.linearise(&former, [], |_| []).err(),
        space.with_rates(&former, [1.0]).err(),
        space.equilibrium(&former).err(),
        space.trim(&former, [h.bearing], [h.load]).err(),
    ];
    for fault in faults {
        let Some(Fault::Analysis(AnalysisFault::NotAssembled {
            joint, violation, ..
        })) = fault
        else {
            panic!("{fault:?}");
        };
        assert_eq!(joint, "end");
        assert!((0.01..0.05).contains(&violation), "{violation}");
    }
    let fault = space.mass(&former).err();
    let wanted = "the state does not satisfy the constraints, `state_near` finds one that does";
    assert!(fault.is_some_and(|fault| fault.to_string().ends_with(wanted)));
    let closed = space.state_near(&former, [0.7], [2.0])?;
    let fresh = Press::new(0.25)?.coordinates([h.bearing])?;
    let wanted = fresh.mass(&fresh.state([0.7], [2.0])?)?;
    assert!((space.mass(&closed)? - wanted).amax() < 1e-14);
    // Rates that open the loop matter to accelerations alone.
    let mut opening = closed;
    opening.rates_mut()[1] += 0.1;
    assert!((space.mass(&opening)? - wanted).amax() < 1e-14);
    let fault = space.bias(&opening).err();
    assert!(
        matches!(
            fault,
            Some(Fault::Analysis(AnalysisFault::NotAssembled {
                joint: "end",
                ..
            }))
        ),
        "{fault:?}"
    );
    Ok(())
}

/// A mass below zero is refused where it is set, and where it is found.
#[test]
fn no_mass_is_negative() -> Result<(), Fault> {
    let h = Linkage::HANDLES;
    let mut space = Linkage::new(0.3, 0.8, 1.2)?.coordinates([h.foot])?;
    let is_refused = |fault: Option<Fault>| {
        let Some(Fault::Parameter(fault)) = fault else {
            panic!("{fault:?}");
        };
        assert_eq!((fault.field, fault.attribute), ("crank", "mass"));
        assert_eq!(fault.fault, ParameterFault::NotPositive);
    };
    for mass in [-2.0, 0.0] {
        is_refused(space.set_value(h.crank_mass, mass).err());
        assert_eq!(space.value(h.crank_mass), 1.2);
    }
    // The weights of rod and rocker have a moment that a crank of some mass balances.
    let mut counts = [0; 2];
    for angle in [-0.3, 0.02] {
        let aside = space.state([angle], [0.0])?;
        let moments = [1.0, 2.0].map(|mass| -> Result<f64, Fault> {
            let mut other = space;
            other.set_value(h.crank_mass, mass)?;
            Ok(other.bias(&aside)?[0])
        });
        let [one, two] = [moments[0]?, moments[1]?];
        let balance = 1.0 - one / (two - one);
        let found = space.trim(&aside, [h.foot], [h.crank_mass]);
        if balance > 0.0 {
            counts[0] += 1;
            let (_, [mass]) = found?;
            assert!((mass / balance - 1.0).abs() < 1e-9, "{mass} for {balance}");
        } else {
            counts[1] += 1;
            is_refused(found.err());
        }
    }
    assert_eq!(counts, [1, 1]);
    Ok(())
}
