//! Handlers at given times, against the free fall of a ball between kicks.

use std::cell::RefCell;

use holonom::error::{Fault, StartFault};
use holonom::prelude::*;
use holonom::run::{Leads, Reached};
use holonom::{Adams, Bdf, Runs};

use super::{Ball, GRAVITY, tight};

const END: f64 = 1.5;
const TIMES: [f64; 6] = [-1.0, 0.0, 0.5, 1.2, END, 9.0];
/// Those in the interval.
const KICKS: [f64; 4] = [0.0, 0.5, 1.2, END];
const SPEED: f64 = 1.0;

/// The height at the end.
fn exact() -> f64 {
    let lengths = KICKS.windows(2).map(|kicks| kicks[1] - kicks[0]);
    let rises = lengths.map(|length| length * (SPEED - 0.5 * GRAVITY * length));
    1.0 + rises.sum::<f64>()
}

/// A ball that is kicked: as a whole, from each of its checkpoints, led by a caller.
fn is_kicked<I>(integrator: I, accuracy: f64)
where
    I: Runs<Problem<Ball, StandardLagrange>> + Leads<Problem<Ball, StandardLagrange>>,
{
    let (ball, h) = (Ball::default(), Ball::HANDLES);
    let calls = RefCell::new(Vec::new());
    let kick = |event: &mut holonom::run::Event<'_, f64, Ball>| {
        assert_eq!(event.name(), "kick");
        calls.borrow_mut().push(event.time());
        event.set_displacement_rate(h.rail, SPEED)
    };
    let simulation = || {
        let simulation = ball.simulation(StandardLagrange, integrator);
        simulation.at("kick", TIMES, kick)
    };
    let (mut kept, mut shown) = (Vec::new(), Vec::new());
    let whole = simulation()
        .checkpoints(1, |checkpoint| {
            kept.push((checkpoint.clone(), calls.borrow().len()));
        })
        .run(0.0..=END, every_step(), |sample| shown.push(sample.time()))
        .expect("it is kicked");
    assert_eq!(calls.take(), KICKS);
    // Before and behind each kick but the first.
    let seen = KICKS.map(|kick| shown.iter().filter(|time| **time == kick).count());
    assert_eq!(seen, [1, 2, 2, 2]);
    let place = Ball::pose(&whole.state, h.ball).position.z;
    assert!((place - exact()).abs() < accuracy, "{place} {}", exact());
    let view = ball.view(END, &whole.state).expect("sound parameters");
    let speed = view.displacement_rate(h.rail);
    assert!((speed - SPEED).abs() < 1e-15, "{speed}");
    assert!(kept.len() > KICKS.len());
    for (checkpoint, before) in &kept {
        let resumed = simulation().resume(checkpoint, |_| ()).expect("it goes on");
        assert_eq!(resumed, whole);
        assert_eq!(calls.take(), KICKS[*before..]);
    }
    let mut run = simulation().begin(0.0..=END).expect("it begins");
    let mut events = vec![run.time()];
    loop {
        match run.advance().expect("it is kicked") {
            Reached::Event("kick") => events.push(run.time()),
            Reached::End => break,
            _ => (),
        }
    }
    assert_eq!(run.state(), &whole.state);
    assert_eq!((events, calls.take()), (KICKS.to_vec(), KICKS.to_vec()));
}

#[test]
fn a_handler_is_called_once_at_each_of_its_times() {
    is_kicked(DormandPrince::default(), 1e-12);
    is_kicked(Rk4::every(0.03), 1e-12);
    is_kicked(Adams::new(tight()), 1e-9);
    is_kicked(Bdf::new(tight()), 1e-6);
    let ball = Ball::default();
    for (times, first) in [
        ([0.5, 0.5], 0.5),
        ([0.5, 0.2], 0.2),
        ([f64::INFINITY, 1.0], f64::INFINITY),
    ] {
        let error = ball
            .simulation(StandardLagrange, DormandPrince::default())
            .at("kick", times, |_| ())
            .run(0.0..=END, every(0.1), |_| ())
            .expect_err("no such times");
        let refused = StartFault::Times {
            name: "kick",
            time: first,
        };
        assert_eq!(error.fault, Fault::Start(refused));
    }
}
