//! Starts at a switch, and laws that slide along one.

use holonom::error::ModeFault;
use holonom::mechanism::{Absolute, Relative};
use holonom::prelude::*;
use holonom::{Bdf, RadauIIA};

use super::{run, tight};

/// Dry friction as a law, on a slider that a force pulls.
#[derive(Mechanism)]
#[mechanism(coordinates = "both", kernels = [mass, inverse])]
pub(super) struct Dry {
    #[param]
    speed: f64,
    #[param]
    pull: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], velocity = [speed, 0.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, slider], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[force(
        between = [ground, slider], head = [-90.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0],
        force = pull - 0.5 * sign(rate)
    )]
    friction: Actuator,
}

pub(super) fn dry(speed: f64, pull: f64) -> Dry {
    Dry::new(speed, pull).expect("acceptable")
}

/// The fault of a run and its time.
fn fault<M: Mechanism>(mechanism: &M) -> (Fault, f64) {
    let simulation = mechanism.simulation(StandardLagrange, DormandPrince::default());
    let error = simulation
        .run(0.0..=4.0, every(0.1), |_| ())
        .expect_err("it slides");
    (error.fault, error.time)
}

#[test]
fn friction_that_must_hold_is_refused_by_name() {
    for (speed, pull, stop) in [
        (0.0, 0.2, 0.0),
        (0.0, -0.2, 0.0),
        // It stops after v / (0.5 - pull).
        (1.0, 0.1, 2.5),
        (-1.0, 0.1, 1.0 / 0.6),
    ] {
        let (fault, time) = fault(&dry(speed, pull));
        let Fault::Mode(ModeFault::SlidingLaw {
            law, expression, ..
        }) = fault
        else {
            panic!("{fault}");
        };
        assert_eq!((law, expression), ("friction", "rate"));
        assert!((time - stop).abs() < 1e-6, "{time} and {stop}");
        assert!(fault.to_string().contains("`Interaction::friction`"));
    }
    for error in [
        dry(1.0, 0.1)
            .simulation(StandardLagrange, Rk4::every(1e-2))
            .run(0.0..=4.0, every(0.1), |_| ()),
        dry(1.0, 0.1)
            .simulation(StandardLagrange, RadauIIA::default())
            .run(0.0..=4.0, every(0.1), |_| ()),
        dry(1.0, 0.1)
            .simulation(StandardLagrange, Bdf::new(tight()))
            .absolute_coordinates()
            .run(0.0..=4.0, every(0.1), |_| ()),
    ] {
        let fault = error.expect_err("it slides").fault;
        assert!(
            matches!(fault, Fault::Mode(ModeFault::SlidingLaw { .. })),
            "{fault}"
        );
    }
}

#[test]
fn friction_that_is_overcome_is_right_from_rest_on() {
    for (speed, pull) in [(0.0, 0.8), (0.0, -0.8), (-1.0, 0.8), (1.0, -2.0)] {
        let (mechanism, h) = (dry(speed, pull), Dry::HANDLES);
        // Against the motion until it turns back.
        let first = if speed == 0.0 {
            0.0
        } else {
            pull + 0.5 * pull.signum()
        };
        let turn = if speed == 0.0 { 0.0 } else { -speed / first };
        let place = 0.5 * speed * turn;
        let rest = pull - 0.5 * pull.signum();
        let mut see = |sample: &Sample<'_, f64, Dry>| {
            let t = sample.time();
            let wanted = if t < turn {
                speed * t + 0.5 * first * t * t
            } else {
                place + 0.5 * rest * (t - turn) * (t - turn)
            };
            let x = sample.pose(h.slider).position.x;
            assert!((x - wanted).abs() < 1e-10, "{x} and {wanted} at {t}");
        };
        run::<_, _, Relative>(
            &mechanism,
            DormandPrince::default(),
            4.0,
            every(0.1),
            &mut see,
        );
        run::<_, _, Absolute>(&mechanism, Rk4::every(0.01), 4.0, every(0.1), &mut see);
    }
}

#[test]
fn what_nothing_moves_rests_at_its_switch() {
    let (mechanism, h) = (dry(0.0, 0.0), Dry::HANDLES);
    let mut see = |sample: &Sample<'_, f64, Dry>| {
        assert_eq!(sample.pose(h.slider).position.x, 0.0);
        assert_eq!(sample.power(), 0.0);
    };
    run::<_, _, Relative>(
        &mechanism,
        DormandPrince::default(),
        4.0,
        every(0.1),
        &mut see,
    );
    run::<_, _, Absolute>(&mechanism, Rk4::every(0.01), 4.0, every(0.1), &mut see);
}

/// A slider that rests until it is pulled: by more than its friction at once, by as much as that
/// slowly.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Pulled {
    #[param]
    most: f64,
    #[param]
    duration: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    slider: Body,
    #[joint(between = [ground, slider], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[force(
        between = [ground, slider], head = [-90.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0],
        force = -0.5 * sign(rate) + if time < 1.0 { 0.0 } else {
            most * min(1.0, (time - 1.0) / duration)
        }
    )]
    both: Actuator,
}

#[test]
fn a_rest_ends_where_something_pulls() {
    let at_once = Pulled::new(0.8, 1e-3).expect("acceptable");
    let (fault, time) = fault(&at_once);
    // Up to half a newton it would stick.
    assert!(
        matches!(fault, Fault::Mode(ModeFault::SlidingLaw { .. })),
        "{fault}"
    );
    assert!((time - 1.0).abs() < 1e-3, "{time}");
}

/// A mass on a spring, and how long it was beyond a place, by laws that rest at zero elsewhere.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Counted {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], velocity = [1.0, 0.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, slider], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[force(
        between = [ground, slider], head = [-90.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0],
        force = 90.0 - length
    )]
    spring: Actuator,
    #[state(rate = sign(max(0.0, rail.displacement - 0.5)))]
    beyond: f64,
    #[state(rate = if max(rail.displacement, 0.5) > 0.5 { 1.0 } else { 0.0 })]
    same: f64,
    #[state(rate = max(0.0, rail.displacement - 0.5))]
    area: f64,
}

#[test]
fn a_law_is_continuous_at_its_switch_where_both_sides_agree() {
    let of = |switches: &[holonom::mechanism::Switch]| {
        let flags = switches.iter().map(|switch| switch.is_continuous);
        flags.collect::<Vec<_>>()
    };
    // What `sign` and `if` read jumps, be it through `max`.
    assert!(
        of(Counted::SWITCHES)
            .iter()
            .all(|is_continuous| !is_continuous)
    );
    assert!(of(Dry::SWITCHES) == [false] && of(Unstable::SWITCHES) == [false]);
}

#[test]
fn laws_that_come_to_rest_at_zero_have_the_value_there() {
    use core::f64::consts::{PI, TAU};
    let (mechanism, h) = (Counted::default(), Counted::HANDLES);
    // sin t > 1/2 from pi / 6 to 5 pi / 6 of every turn.
    let mut see = |sample: &Sample<'_, f64, Counted>| {
        let turns = (sample.time() / TAU).floor();
        let phase = (sample.time() - turns * TAU).clamp(PI / 6.0, 5.0 * PI / 6.0);
        let time = turns * 2.0 * PI / 3.0 + phase - PI / 6.0;
        let size = |phase: f64| -phase.cos() - 0.5 * phase;
        let area = turns * (size(5.0 * PI / 6.0) - size(PI / 6.0)) + size(phase) - size(PI / 6.0);
        for (of, wanted) in [(h.beyond, time), (h.same, time), (h.area, area)] {
            let found = sample.state_value(of);
            assert!(
                (found - wanted).abs() < 1e-8,
                "{found} and {wanted} at {}",
                sample.time()
            );
        }
    };
    let method = DormandPrince::new(tight());
    run::<_, _, Relative>(&mechanism, method, 20.0, every(0.1), &mut see);
    run::<_, _, Absolute>(&mechanism, method, 20.0, every(0.1), &mut see);
}

/// Away from zero on either side.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Unstable {
    #[param]
    push: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    slider: Body,
    #[joint(between = [ground, slider], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[force(
        between = [ground, slider], head = [-90.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0],
        force = sign(length - 90.0) + push
    )]
    motor: Actuator,
}

#[test]
fn a_start_at_a_switch_takes_the_side_that_the_motion_takes() {
    for push in [0.1, -0.1, 3.0, 0.0] {
        let mechanism = Unstable::new(push).expect("acceptable");
        let force = push + if push == 0.0 { 0.0 } else { push.signum() };
        let report = run::<_, _, Relative>(&mechanism, Rk4::every(0.01), 2.0, every(2.0), |_| ());
        let x = Unstable::pose(&report.state, Unstable::HANDLES.slider)
            .position
            .x;
        assert!((x - 2.0 * force).abs() < 1e-10, "{x} with {push}");
    }
}
