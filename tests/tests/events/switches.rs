//! Laws that jump, by events: right where closures step over the jump.

use core::f64::consts::TAU;

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::{Adams, AdamsBashforthMoulton4, Bdf, DormandPrince853, RadauIIA, Runs};

use super::{Slider, tight};

fn slider() -> Slider {
    Slider::new(0.0).expect("acceptable")
}

/// By how much `x'' = -sign x` is off after ten periods.
fn bang_bang<I, C>(integrator: I) -> f64
where
    C: Coordinates<Slider>,
    I: Runs<Problem<Slider, StandardLagrange, f64, C>>,
{
    let (mut slider, h) = (slider(), Slider::HANDLES);
    slider.push = -1.0;
    let end = 40.0 * 2.0_f64.sqrt();
    let place = |sample: &Sample<'_, f64, Slider>| sample.pose(h.slider).position.x;
    let report = Simulation::new(&slider, StandardLagrange, integrator)
        .coordinates::<C>()
        .on("sign", Crossing::Either, place, |event| {
            let velocity = event.displacement_rate(h.rail);
            event.inputs_mut().push = -velocity.signum();
        })
        .run(0.0..=end, every(0.5), |_| ())
        .expect("it swings");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    (Slider::pose(&report.state, h.slider).position.x - 1.0).abs()
}

#[test]
fn a_force_by_the_sign_of_the_place_is_right_after_ten_periods() {
    let errors = [
        bang_bang::<_, Relative>(Rk4::every(1e-2)),
        bang_bang::<_, Absolute>(Rk4::every(1e-2)),
        bang_bang::<_, Relative>(DormandPrince::default()),
        bang_bang::<_, Absolute>(DormandPrince::default()),
        bang_bang::<_, Relative>(DormandPrince853::default()),
        bang_bang::<_, Relative>(Adams::new(tight())),
        bang_bang::<_, Relative>(AdamsBashforthMoulton4::every(1e-2)),
        bang_bang::<_, Relative>(RadauIIA::default()),
        bang_bang::<_, Relative>(Bdf::new(tight())),
    ];
    for (index, error) in errors.iter().enumerate() {
        assert!(*error < 1e-8, "{index}: {errors:?}");
    }
}

/// By how much a square wave of 10 N and 5 Hz is off after 5 s.
fn square_wave<I, C>(integrator: I, periodic: bool) -> f64
where
    C: Coordinates<Slider>,
    I: Runs<Problem<Slider, StandardLagrange, f64, C>>,
{
    let (mut slider, h) = (slider(), Slider::HANDLES);
    slider.push = 10.0;
    let simulation = Simulation::new(&slider, StandardLagrange, integrator).coordinates::<C>();
    let report = if periodic {
        let mut sign = -1.0;
        simulation
            .every_period(0.1, |_, inputs| {
                sign = -sign;
                inputs.push = 10.0 * sign;
            })
            .run(0.0..=5.0, every(0.05), |_| ())
    } else {
        let wave = |sample: &Sample<'_, f64, Slider>| (5.0 * TAU * sample.time()).sin();
        simulation
            .on("wave", Crossing::Either, wave, |event| {
                let push = -event.inputs_mut().push;
                event.inputs_mut().push = push;
            })
            .run(0.0..=5.0, every(0.05), |_| ())
    };
    let report = report.expect("it moves");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    // In each of 25 periods 10 m/s^2 over 0.1 s forth and back.
    let wanted = 1.0 + 25.0 * 10.0 * 0.1 * 0.1;
    (Slider::pose(&report.state, h.slider).position.x - wanted).abs()
}

#[test]
fn a_square_wave_is_right_by_events_and_by_a_period() {
    for periodic in [false, true] {
        let errors = [
            square_wave::<_, Relative>(DormandPrince::default(), periodic),
            square_wave::<_, Absolute>(DormandPrince::default(), periodic),
            square_wave::<_, Relative>(RadauIIA::default(), periodic),
            square_wave::<_, Relative>(Rk4::every(1e-2), periodic),
            square_wave::<_, Relative>(Rk4::every(3e-3), periodic),
            square_wave::<_, Relative>(Adams::new(tight()), periodic),
        ];
        for error in errors {
            assert!(error < 1e-8, "{periodic}: {errors:?}");
        }
    }
}

#[test]
fn a_closure_may_read_what_a_handler_sets() {
    let (slider, h) = (slider(), Slider::HANDLES);
    let side = core::cell::Cell::new(-1.0);
    let report = slider
        .simulation(StandardLagrange, DormandPrince::default())
        .forces(|_, _, loads| loads.force_between(h.rail, side.get()))
        .on(
            "sign",
            Crossing::Either,
            |sample| sample.pose(h.slider).position.x,
            |_| side.set(-side.get()),
        )
        .run(0.0..=40.0 * 2.0_f64.sqrt(), every(0.5), |_| ())
        .expect("it swings");
    let error = Slider::pose(&report.state, h.slider).position.x - 1.0;
    assert!(error.abs() < 1e-8, "{error:e}");
}

#[test]
fn a_pulse_of_inputs_is_met_to_its_digits() {
    // A pulse of 0.1 ms within 10 s, which steps of half a second would pass over.
    let (slider, h) = (slider(), Slider::HANDLES);
    let report = slider
        .simulation(StandardLagrange, DormandPrince::default())
        .on(
            "on",
            Crossing::Rising,
            |s| s.time() - 5.0,
            |e| e.inputs_mut().push = 1e4,
        )
        .on(
            "off",
            Crossing::Rising,
            |s| s.time() - 5.0001,
            |e| e.inputs_mut().push = 0.0,
        )
        .run(0.0..=10.0, every(5.0), |_| ())
        .expect("it moves");
    let speed = Slider::velocity(&report.state, h.slider).x;
    assert!((speed - 1.0).abs() < 1e-9, "{speed}");
}
