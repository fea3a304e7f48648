//! Loops that start values open: an error when initialisation ends, with the joint.

use crate::driven::ran;
use crate::unit::{Unit, variable};
use holonom::mechanism::Relative;
use holonom::prelude::*;
use holonom_fmu::Fmu;
use holonom_models::FourBar;

/// The largest of some numbers.
fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// What is said of a variable that is changed: a text around a number.
fn said(unit: &Unit, name: &str, changes: [f64; 2], around: [&str; 2]) -> f64 {
    let document = unit.description();
    let reference = variable(&document, name).attribute("valueReference");
    let mut arguments = vec![reference.expect("a number").to_owned()];
    arguments.extend(changes.map(|change| format!("{change:?}")));
    let driver = ("opened.c", include_str!("opened.c"));
    let (_, logged) = ran(unit, "opened_bars", driver, &arguments);
    let lines: Vec<&str> = logged.lines().collect();
    let [first, second] = lines[..] else {
        panic!("{logged}")
    };
    assert_eq!(first, second);
    let number = first.split_once(around[0]).and_then(|(_, rest)| {
        let (number, _) = rest.split_once(around[1])?;
        number.parse().ok()
    });
    number.unwrap_or_else(|| panic!("{logged}"))
}

#[test]
fn a_start_with_an_open_loop_is_refused() {
    let bars = FourBar::default();
    let unit = Fmu::<FourBar, Relative>::new(&bars, Baumgarte::default());
    let unit = Unit::of(
        unit.named("opened_bars").without_binary(),
        "opened_bars.fmu",
    );
    let foot = FourBar::HANDLES.left_foot;
    let constants = bars.constants::<f64>().expect("described");

    // The coupler goes along with the left link. What is accepted is small beside a metre.
    let mut bodies = bars.described_state::<f64>().expect("described");
    bars.set_angle(&mut bodies, foot, 0.1).expect("it turns");
    let open = largest(FourBar::constraints(&constants, 0.0, &bodies).as_slice());
    let around = [
        "3 logStatusError: joint `right_pin` is open by ",
        " m at the start",
    ];
    let found = said(&unit, "left_foot_angle", [0.1, 1e-5], around);
    assert!((found - open).abs() < 1e-2 * open, "{found} for {open}");

    let mut bodies = bars.described_state::<f64>().expect("described");
    let rate = -1.0 + 0.5;
    let set = bars.set_angle_rate(&mut bodies, foot, rate);
    set.expect("it turns");
    let opens = largest(FourBar::constraint_rates(&constants, 0.0, &bodies).as_slice());
    let around = [
        "the bodies of joint `right_pin` move against it at ",
        " m/s",
    ];
    let found = said(&unit, "left_foot_rate", [0.5, 1e-5], around);
    assert!((found - opens).abs() < 1e-2 * opens, "{found} for {opens}");
}
