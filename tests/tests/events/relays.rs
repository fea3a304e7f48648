//! Relays with hysteresis.

use std::cell::RefCell;

use holonom::error::StartFault;
use holonom::prelude::*;
use holonom::run::Checkpoint;
use holonom::{Adams, Runs};

use super::{Slider, tight};

fn slider() -> Slider {
    Slider::new(1.0).expect("a slider")
}

fn moving(rate: f64) -> StateOf<Slider> {
    let slider = slider();
    let mut state = slider.described_state().expect("it is described");
    slider
        .set_displacement_rate(&mut state, Slider::HANDLES.rail, rate)
        .expect("it is free");
    state
}

/// With `v' = 3 - v` below and `v' = -v` above, a rate rises from 1 to 2 and falls to 1 within `ln
/// 2` each. The times and sides that the handler is told.
fn switches<I>(integrator: I, start: f64, end: f64) -> Vec<(f64, bool)>
where
    I: Runs<Problem<Slider, StandardLagrange>>,
{
    let (slider, rail) = (slider(), Slider::HANDLES.rail);
    let mut told = Vec::new();
    slider
        .simulation(StandardLagrange, integrator)
        .initial_state(moving(start))
        .relay(
            "throttle",
            [1.0, 2.0],
            |sample| sample.displacement_rate(rail),
            |event, is_high| {
                told.push((event.time(), is_high));
                event.inputs_mut().push = if is_high { 0.0 } else { 3.0 };
            },
        )
        .run(0.0..=end, every(0.05), |sample| {
            let rate = sample.displacement_rate(rail);
            assert!(rate < f64::max(2.0, start) + 1e-6, "{rate}");
            assert!(rate > f64::min(1.0, start) - 1e-6, "{rate}");
        })
        .expect("it runs");
    told
}

#[test]
fn a_relay_switches_at_each_threshold_in_turn() {
    let two = f64::ln(2.0);
    for (start, first, is_high) in [
        (0.0, f64::ln(3.0), false),
        (1.5, f64::ln(1.5), false),
        (1.0, two, false),
        (2.0, two, true),
        (8.0, 3.0 * two, true),
        (-3.0, f64::ln(6.0), false),
    ] {
        let close = |told: &[(f64, bool)], bound: f64| {
            assert_eq!(told[0], (0.0, is_high), "{start}");
            assert!(told.len() > 5, "{start}: {told:?}");
            for (count, &(time, is_high)) in told.iter().enumerate().skip(1) {
                let wanted = first + (count - 1) as f64 * two;
                assert!(
                    (time - wanted).abs() < bound,
                    "{start} {count}: {time} {wanted}"
                );
                assert_ne!(is_high, told[count - 1].1);
            }
        };
        close(&switches(DormandPrince::new(tight()), start, 6.0), 1e-9);
        close(&switches(Rk4::every(0.01), start, 6.0), 1e-6);
        close(&switches(Adams::new(tight()), start, 6.0), 1e-8);
    }
}

/// A handler kicks the slider past the threshold that is next: the relay follows at that instant.
#[test]
fn a_relay_follows_what_a_handler_sets() {
    let (slider, rail) = (slider(), Slider::HANDLES.rail);
    let told = RefCell::new(Vec::new());
    let report = slider
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .on(
            "kick",
            Crossing::Rising,
            |sample| sample.time() - 0.2,
            |event| event.set_displacement_rate(rail, 4.0),
        )
        .on(
            "stop",
            Crossing::Rising,
            |sample| sample.time() - 0.5,
            |event| event.set_displacement_rate(rail, 0.5),
        )
        .relay(
            "throttle",
            [1.0, 2.0],
            |sample| sample.displacement_rate(rail),
            |event, is_high| {
                told.borrow_mut().push((event.time(), is_high));
                event.inputs_mut().push = if is_high { 0.0 } else { 3.0 };
            },
        )
        .run(0.0..=0.7, every(0.05), |_| ())
        .expect("it runs");
    let told = told.into_inner();
    let wanted = [(0.0, false), (0.2, true), (0.5, false)];
    assert_eq!(told.len(), wanted.len(), "{told:?}");
    for (found, wanted) in told.iter().zip(wanted) {
        assert!(
            (found.0 - wanted.0).abs() < 1e-12 && found.1 == wanted.1,
            "{told:?}"
        );
    }
    let view = slider.view(0.7, &report.state).expect("a view");
    let wanted = 3.0 - 2.5 * f64::exp(-0.2);
    assert!((view.displacement_rate(rail) - wanted).abs() < 1e-10);
}

/// A run that its caller leads, and kicks.
#[test]
fn a_relay_follows_a_change_of_a_led_run() {
    let (slider, rail) = (slider(), Slider::HANDLES.rail);
    let told = RefCell::new(Vec::new());
    let mut run = slider
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .relay(
            "throttle",
            [1.0, 2.0],
            |sample| sample.displacement_rate(rail),
            |event, is_high| {
                told.borrow_mut().push(is_high);
                event.inputs_mut().push = if is_high { 0.0 } else { 3.0 };
            },
        )
        .begin(0.0..=9.0)
        .expect("it begins");
    run.advance_to(0.2).expect("it advances");
    run.change(|event| event.set_displacement_rate(rail, 4.0))
        .expect("it is changed");
    assert_eq!(*told.borrow(), [false, true]);
    run.advance_to(0.2 + f64::ln(4.0) - 1e-9)
        .expect("it advances");
    assert_eq!(told.borrow().len(), 2);
    run.advance_to(0.2 + f64::ln(4.0) + 1e-9)
        .expect("it advances");
    assert_eq!(*told.borrow(), [false, true, false]);
}

/// From every checkpoint on it is the same to the last bit, and the handler is not told again.
#[test]
fn a_relay_goes_on() {
    let (slider, rail) = (slider(), Slider::HANDLES.rail);
    let run = |from: Option<&Checkpoint<Slider>>, thresholds: [f64; 2]| {
        let (mut told, mut kept) = (Vec::new(), Vec::new());
        let mut simulation = slider
            .simulation(StandardLagrange, DormandPrince::default())
            .relay(
                "throttle",
                thresholds,
                |sample| sample.displacement_rate(rail),
                |event, is_high| {
                    told.push((event.time(), is_high));
                    event.inputs_mut().push = if is_high { 0.0 } else { 3.0 };
                },
            )
            .checkpoints(1, |checkpoint| kept.push(checkpoint.clone()));
        let report = match from {
            None => simulation.run(0.0..=5.0, every(0.1), |_| ()),
            Some(checkpoint) => simulation.resume(checkpoint, |_| ()),
        };
        (report, told, kept)
    };
    let (report, told, kept) = run(None, [1.0, 2.0]);
    let report = report.expect("it runs");
    assert!(told.len() > 5 && kept.len() > 10);
    for (place, checkpoint) in kept.iter().enumerate().rev().skip(1) {
        let (resumed, tail, rest) = run(Some(checkpoint), [1.0, 2.0]);
        assert_eq!(resumed.expect("it goes on"), report);
        assert!(told.ends_with(&tail) && tail.len() < told.len());
        assert!(rest[..] == kept[place + 1..]);
    }
    // Others are another run.
    assert!(run(Some(&kept[3]), [1.0, 2.5]).0.is_err());
}

#[test]
fn thresholds_that_are_none_are_refused() {
    for (thresholds, value) in [
        ([2.0, 1.0], -1.0),
        ([1.0, 1.0], 0.0),
        ([0.0, f64::INFINITY], f64::INFINITY),
    ] {
        let slider = slider();
        let run = slider
            .simulation(StandardLagrange, DormandPrince::default())
            .relay("throttle", thresholds, |sample| sample.time(), |_, _| ())
            .run(0.0..=1.0, every(0.1), |_| ());
        let fault = run.expect_err("it is refused").fault;
        let wanted = Fault::Start(StartFault::Setting {
            name: "upper less lower threshold of a relay",
            value,
        });
        assert_eq!(fault, wanted);
    }
    let slider = slider();
    let run = slider
        .simulation(StandardLagrange, DormandPrince::default())
        .relay("throttle", [0.0, 1.0], |_| f64::NAN, |_, _| ())
        .run(0.0..=1.0, every(0.1), |_| ());
    let told = run.expect_err("it is no number").fault.to_string();
    assert!(told.contains("throttle"), "{told}");
}

/// A handler that stops the run does so from the start on.
#[test]
fn a_relay_stops_a_run() {
    let slider = slider();
    let report = slider
        .simulation(StandardLagrange, DormandPrince::default())
        .relay(
            "clock",
            [0.0, 0.5],
            |sample| sample.time(),
            |_, is_late| {
                if is_late {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            },
        )
        .run(0.0..=1.0, every(0.1), |_| ())
        .expect("it stops");
    assert!(report.stopped && (report.time - 0.5).abs() < 1e-12);
}
