//! Which events are found, and in which order.

use holonom::prelude::*;

use super::{Ball, GRAVITY, Two, height};

fn fall(height: f64) -> f64 {
    (2.0 * height / GRAVITY).sqrt()
}

#[test]
fn events_of_one_step_are_handled_in_their_order() {
    let (two, h) = (Two::default(), Two::HANDLES);
    let log = core::cell::RefCell::new(Vec::new());
    let note = |event: &mut holonom::run::Event<'_, f64, Two>| {
        log.borrow_mut().push((event.name(), event.time()));
    };
    two.simulation(StandardLagrange, Rk4::every(1.0))
        .on(
            "high",
            Crossing::Falling,
            |s| s.pose(h.high).position.z,
            note,
        )
        .on("low", Crossing::Falling, |s| s.pose(h.low).position.z, note)
        .on(
            "half",
            Crossing::Either,
            |s| s.pose(h.high).position.z - 1.0,
            note,
        )
        .on("up", Crossing::Rising, |s| s.pose(h.high).position.z, note)
        .run(0.0..=1.0, every(1.0), |_| ())
        .expect("they fall");
    let log = log.into_inner();
    let names: Vec<_> = log.iter().map(|(name, _)| *name).collect();
    // `half` and `low` are at one time: in the order in which they were given, or of their digits.
    assert_eq!(names.len(), 3, "{names:?}");
    assert!(names[..2].contains(&"low") && names[..2].contains(&"half"));
    assert_eq!(names[2], "high");
    for ((_, time), wanted) in log.iter().zip([fall(1.0), fall(1.0), fall(2.0)]) {
        assert!((time - wanted).abs() < 1e-13, "{log:?}");
    }
}

#[test]
fn events_at_one_time_are_all_handled_whatever_the_first_one_does() {
    for swapped in [false, true] {
        let (two, h) = (Two::default(), Two::HANDLES);
        let mut start = two.described_state().expect("described");
        two.set_displacement(&mut start, h.b, -1.0).expect("free");
        let (one, other) = if swapped { (h.a, h.b) } else { (h.b, h.a) };
        let level = |sample: &Sample<'_, f64, Two>, joint| {
            sample.displacement(joint) + if joint == h.a { 1.0 } else { 2.0 }
        };
        let counts = core::cell::Cell::new([0, 0]);
        let report = two
            .simulation(StandardLagrange, DormandPrince::default())
            .initial_state(start)
            .on(
                "one",
                Crossing::Falling,
                |s| level(s, one),
                |event| {
                    let [a, b] = counts.get();
                    counts.set([a + 1, b]);
                    event.set_displacement_rate(one, -event.displacement_rate(one))
                },
            )
            .on(
                "other",
                Crossing::Falling,
                |s| level(s, other),
                |event| {
                    let [a, b] = counts.get();
                    counts.set([a, b + 1]);
                    event.set_displacement_rate(other, -event.displacement_rate(other))
                },
            )
            .run(0.0..=10.0, every(0.1), |sample| {
                let [a, b] = [h.a, h.b].map(|joint| level(sample, joint));
                assert!((a - b).abs() < 1e-6 && a > -1e-9, "{a} {b}");
            })
            .expect("they bounce");
        assert_eq!(counts.get(), [11, 11]);
        assert!(report.warnings().is_empty(), "{}", report.warnings());
    }
}

/// Instants that differ in their last digits, of events whose handlers move the mechanism.
#[test]
fn events_that_follow_each_other_in_the_last_digits_fire_once_and_in_order() {
    let (ball, rail) = (Ball::default(), Ball::HANDLES.rail);
    for (begin, spacing) in [(1e6, 1e-10), (1.7e9, 3e-7), (0.0, 1e-16)] {
        for number in 1..=24 {
            let first: f64 = begin + 0.37;
            let second = first + spacing * f64::from(number);
            let log = core::cell::RefCell::new(Vec::new());
            let handled = |event: &mut holonom::run::Event<'_, f64, Ball>| {
                log.borrow_mut().push((event.name(), event.time()));
                event.set_displacement_rate(rail, 1.0)
            };
            ball.simulation(StandardLagrange, DormandPrince::default())
                .on("second", Crossing::Rising, |s| s.time() - second, handled)
                .on("first", Crossing::Rising, |s| s.time() - first, handled)
                .run(begin..=begin + 0.5, every(0.5), |_| ())
                .expect("it flies");
            let log = log.into_inner();
            assert_eq!(log.len(), 2, "{begin} {number}: {log:?}");
            let is_same = first == second;
            assert!(is_same || log[0].0 == "first", "{begin} {number}: {log:?}");
            for (name, time) in log {
                let wanted = if name == "first" { first } else { second };
                let digits = (time - wanted).abs() / (wanted.next_up() - wanted);
                assert!(
                    digits <= 16.0,
                    "{begin} {number}: {name} is off by {digits}"
                );
            }
        }
    }
}

#[test]
fn an_event_at_the_end_of_a_step_or_of_the_run_is_found_once() {
    let ball = Ball::default();
    for (step, end) in [(0.25, 1.0), (0.1, 0.7), (0.125, 0.5), (0.5, 0.5)] {
        for crossing in [Crossing::Rising, Crossing::Either] {
            let mut times = Vec::new();
            let report = ball
                .simulation(StandardLagrange, Rk4::every(step))
                .on(
                    "half",
                    crossing,
                    |s| s.time() - 0.5,
                    |e| times.push(e.time()),
                )
                .run(0.0..=end, every_step(), |_| ())
                .expect("it falls");
            assert_eq!(times, [0.5], "{step}");
            assert_eq!(report.time, end);
        }
    }
}

#[test]
fn an_event_at_the_start_does_not_fire() {
    let (ball, rail) = (Ball::default(), Ball::HANDLES.rail);
    let mut start = ball.described_state().expect("described");
    ball.set_displacement(&mut start, rail, -1.0 - 1e-16)
        .expect("free");
    ball.set_displacement_rate(&mut start, rail, 2.0)
        .expect("free");
    for crossing in [Crossing::Rising, Crossing::Falling, Crossing::Either] {
        let mut times = Vec::new();
        ball.simulation(StandardLagrange, DormandPrince::default())
            .initial_state(start)
            .on("floor", crossing, height, |event| times.push(event.time()))
            .run(0.0..=1.0, every(1.0), |_| ())
            .expect("it flies");
        let wanted: &[f64] = if crossing == Crossing::Rising {
            &[]
        } else {
            &[4.0 / GRAVITY]
        };
        assert_eq!(times.len(), wanted.len(), "{crossing:?} {times:?}");
        for (time, wanted) in times.iter().zip(wanted) {
            assert!((time - wanted).abs() < 1e-12);
        }
    }
}

#[test]
fn a_reading_that_touches_zero_within_a_step_does_not_cross_it() {
    let ball = Ball::default();
    let touch = |size: f64| {
        let mut found = 0;
        ball.simulation(StandardLagrange, Rk4::every(0.3))
            .on(
                "touch",
                Crossing::Either,
                |s| size - (s.time() - 0.4321).powi(2),
                |_| found += 1,
            )
            .run(0.0..=0.9, every(1.0), |_| ())
            .expect("it falls");
        found
    };
    assert_eq!(touch(-1e-9), 0);
    // Two zeros within less than a sixth of a step are missed, further apart they are found.
    assert_eq!(touch(1e-9), 0);
    assert_eq!(touch(1e-2), 2);
}

#[test]
fn reports_come_in_the_order_of_time_and_at_events() {
    let (ball, rail) = (Ball::default(), Ball::HANDLES.rail);
    let mut times: Vec<f64> = Vec::new();
    let mut twice = 0;
    ball.simulation(StandardLagrange, DormandPrince::default())
        .on("floor", Crossing::Falling, height, |event| {
            event.set_displacement_rate(rail, -event.displacement_rate(rail))
        })
        .on("quarter", Crossing::Rising, |s| s.time() - 0.25, |_| ())
        .run(0.0..=1.0, every(0.125), |sample| {
            if let Some(&last) = times.last() {
                assert!(last <= sample.time());
                twice += usize::from(last == sample.time());
            }
            times.push(sample.time());
        })
        .expect("it bounces");
    // Nine reports, and two at the impact.
    assert_eq!((times.len(), twice), (11, 1), "{times:?}");
}
