//! Stops, a law that switches, a state of the user's own and a controller in one run.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::{DormandPrince853, RadauIIA, Runs};

/// A block of 1 kg on a level rail between two stops, pushed by 10 N for 0.1 s; the way that it
/// goes, and the time for which it is beyond 0.3 m.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Shuttle {
    #[input]
    wind: f64,
    #[state(rate = abs(rail.rate))]
    way: f64,
    #[state(rate = if rail.displacement > 0.3 { 1.0 } else { 0.0 })]
    beyond: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    block: Body,
    #[joint(
        between = [ground, block], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0],
        limits = [-0.2, 0.55], restitution = 0.5
    )]
    rail: Prismatic,
    #[force(
        between = [ground, block], head = [-5.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0],
        force = if time > 0.2 && time < 0.3 { 10.0 } else { 0.0 }
    )]
    push: Actuator,
    #[force(
        between = [ground, block], head = [-5.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0],
        force = wind
    )]
    breeze: Actuator,
}

/// At the end of 3.3 s: 0.05 m at 1 m/s up to 0.3 s, the upper stop at 0.8 s, the lower at 2.3 s.
fn crossed<C: Coordinates<Shuttle>>(method: impl Runs<Problem<Shuttle, StandardLagrange, f64, C>>) {
    let (shuttle, h) = (Shuttle::default(), Shuttle::HANDLES);
    let mut calls = 0;
    let mut end = [0.0; 4];
    let run = Simulation::new(&shuttle, StandardLagrange, method)
        .coordinates::<C>()
        .every_period(0.25, |_, inputs| {
            calls += 1;
            inputs.wind = 0.0;
        })
        .run(0.0..=3.3, every(1.1), |sample| {
            end = [
                sample.displacement(h.rail),
                sample.displacement_rate(h.rail),
                sample.state_value(h.way),
                sample.state_value(h.beyond),
            ];
        });
    let report = run.expect("it runs");
    assert!(calls >= 13, "{calls}");
    // From 0.55 s to 0.8 s at 1 m/s, and back at half of it for 0.5 s.
    for (found, wanted) in end.into_iter().zip([0.05, 0.25, 1.55, 0.75]) {
        assert!((found - wanted).abs() < 1e-9, "{end:?}");
    }
    assert!(report.time == 3.3);
}

#[test]
fn stops_and_laws_that_switch_do_not_disturb_each_other() {
    crossed::<Relative>(DormandPrince::default());
    crossed::<Absolute>(DormandPrince::default());
    crossed::<Relative>(Rk4::every(0.07));
    crossed::<Absolute>(Rk4::every(0.07));
    crossed::<Relative>(DormandPrince853::default());
    crossed::<Relative>(RadauIIA::default());
}
