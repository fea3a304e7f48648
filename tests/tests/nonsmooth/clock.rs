//! Andronov's clock: dry friction, an energy at every beat, and a dog that holds the wheel.

use core::cell::RefCell;

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode as Mode;
use holonom_models::Clock;

use super::{reference, tight};

/// What a run saw: times of beats, teeth, and the angles at which the pendulum turned back.
struct Seen {
    beats: Vec<f64>,
    teeth: usize,
    turns: Vec<f64>,
}

fn runs<C: Coordinates<Clock>>(start: StateOf<Clock>, end: f64) -> Seen {
    let (clock, h) = (Clock::default(), Clock::HANDLES);
    let [_, dog] = Clock::interaction_handles();
    let (beats, teeth, turns) = (RefCell::default(), RefCell::default(), RefCell::default());
    let beats: RefCell<Vec<f64>> = beats;
    let turns: RefCell<Vec<f64>> = turns;
    let teeth: RefCell<usize> = teeth;
    clock
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start)
        .interactions(Clock::interactions())
        .on(
            "beat",
            Crossing::Rising,
            |sample| sample.angle(h.pivot),
            |event| {
                beats.borrow_mut().push(event.time());
                Clock::beat(event)
            },
        )
        .on(
            "tooth",
            Crossing::Either,
            |sample| Clock::tooth(sample.angle(h.arbor)),
            |event| {
                *teeth.borrow_mut() += 1;
                Clock::lock(event)
            },
        )
        .on(
            "turn",
            Crossing::Either,
            |sample| sample.angle_rate(h.pivot),
            |event| turns.borrow_mut().push(event.angle(h.pivot)),
        )
        .run(0.0..=end, every(0.05), |sample| -> Result<(), Fault> {
            if sample.mode(dog)? == Mode::Sticking {
                assert!(sample.angle_rate(h.arbor).abs() < 1e-12);
                assert!(Clock::tooth(sample.angle(h.arbor)).abs() < 1e-9);
            }
            Ok(())
        })
        .expect("it goes");
    Seen {
        beats: beats.into_inner(),
        teeth: teeth.into_inner(),
        turns: turns.into_inner(),
    }
}

fn keeps_its_swing<C: Coordinates<Clock>>() {
    let (clock, h) = (Clock::default(), Clock::HANDLES);
    let [after, before, period] = reference::CLOCK;
    let mut start = clock.described_state().expect("described");
    clock
        .set_angle(&mut start, h.pivot, after)
        .and_then(|()| clock.set_angle_rate(&mut start, h.pivot, 0.0))
        .expect("it carries");
    let seen = runs::<C>(start, 10.6 * period);
    // A quarter of a period and more goes by before the first beat.
    assert!(seen.beats.len() >= 10, "{:?}", seen.beats);
    for pair in seen.beats.windows(2) {
        let error = pair[1] - pair[0] - period;
        assert!(error.abs() < 1e-9, "{error:e}");
    }
    assert_eq!(seen.teeth, seen.beats.len());
    for (number, turn) in seen.turns.iter().enumerate() {
        let wanted = if turn.is_sign_positive() {
            after
        } else {
            -before
        };
        assert!((turn - wanted).abs() < 1e-9, "{number}: {turn} {wanted}");
    }
    assert!(seen.turns.len() >= 20);
}

#[test]
fn a_clock_keeps_its_swing() {
    keeps_its_swing::<Relative>();
    keeps_its_swing::<Absolute>();
}

/// The amplitude at which a potential with friction is reached, by bisection.
fn reaches(potential: impl Fn(f64) -> f64, energy: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if potential(middle) < energy {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// From another start every swing follows the balance of energy towards the limit cycle.
#[test]
fn a_clock_comes_to_its_swing() {
    let (clock, h) = (Clock::default(), Clock::HANDLES);
    let start = clock.described_state().expect("described");
    let view = clock.view(0.0, &start).expect("a state");
    let arm = -view.pose(h.pendulum).position.z;
    let kinetic = view.kinetic_energy();
    // The pendulum's mass is not read, but made of its shapes.
    let mass = 7800.0 * core::f64::consts::PI * (0.005_f64.powi(2) * 0.88 + 0.12 * 0.12 * 0.02);
    let uphill = |angle: f64| {
        let height = mass * 9.81 * arm * (1.0 - angle.cos());
        height + Clock::FRICTION * angle
    };
    let mut energy = kinetic;
    let [limit, ..] = reference::CLOCK;
    let mut last = f64::INFINITY;
    let seen = runs::<Relative>(start, 40.0);
    assert!(seen.turns.len() > 38);
    for pair in seen.turns.chunks_exact(2) {
        let after = reaches(uphill, energy);
        let before = reaches(uphill, uphill(after) - 2.0 * Clock::FRICTION * after);
        assert!((pair[0] - after).abs() < 1e-9, "{} {after}", pair[0]);
        assert!((pair[1] + before).abs() < 1e-9, "{} {before}", pair[1]);
        energy = uphill(before) - 2.0 * Clock::FRICTION * before + Clock::GAIN;
        assert!(limit < after && after < last);
        last = after;
    }
}
