//! Friction at its capacity, several of them in a row or at one place, and stops that are touched.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::{InteractionMode as Mode, Plane};

use super::{GRAVITY, tight};

/// A block of 2 kg on one of 1 kg, both along x; a force pulls the upper one.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Stack {
    #[input]
    pull: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    lower: Body,
    #[body(mass = 2.0, inertia = [0.1, 0.1, 0.1])]
    upper: Body,
    #[joint(between = [ground, lower], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    floor: Prismatic,
    #[joint(between = [lower, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    between: Prismatic,
    #[force(between = [ground, upper], point = [0.0, 0.0, 0.0], force = [pull, 0.0, 0.0])]
    rope: PointForce,
}

/// Speeds after a second, with capacities at the floor and between the blocks.
fn pulled<C: Coordinates<Stack>>(pull: f64, capacities: [f64; 2], is_reversed: bool) -> [f64; 2] {
    let (mut stack, h) = (Stack::default(), Stack::HANDLES);
    stack.pull = pull;
    let mut frictions = [
        Interaction::friction(h.floor.displacement(), capacities[0]),
        Interaction::friction(h.between.displacement(), capacities[1]),
    ];
    if is_reversed {
        frictions.reverse();
    }
    let report = stack
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions(frictions)
        .run(0.0..=1.0, every(1.0), |_| ())
        .expect("it is pulled");
    [h.lower, h.upper].map(|body| Stack::velocity(&report.state, body).x)
}

fn slides(pull: f64, capacities: [f64; 2], wanted: [f64; 2]) {
    for found in [
        pulled::<Relative>(pull, capacities, false),
        pulled::<Absolute>(pull, capacities, false),
        pulled::<Relative>(pull, capacities, true),
        pulled::<Absolute>(pull, capacities, true),
    ] {
        for (x, y) in found.iter().zip(&wanted) {
            let error = (x - y).abs();
            assert!(error < 1e-10, "{pull} {capacities:?}: {found:?} {wanted:?}");
        }
    }
}

#[test]
fn two_blocks_stick_and_slide_one_on_the_other() {
    for (pull, capacities, wanted) in [
        // Nothing moves; the upper one alone; both together; both, one faster.
        (2.0, [5.0, 3.0], [0.0, 0.0]),
        (4.0, [5.0, 3.0], [0.0, 0.5]),
        (4.0, [3.0, 10.0], [1.0 / 3.0, 1.0 / 3.0]),
        (12.0, [3.0, 5.0], [2.0, 3.5]),
        (-12.0, [3.0, 5.0], [-2.0, -3.5]),
        // At a capacity it holds.
        (3.0, [5.0, 3.0], [0.0, 0.0]),
        (5.0, [5.0, 9.0], [0.0, 0.0]),
        (3.0, [3.0, 3.0], [0.0, 0.0]),
        // Without friction at the floor.
        (6.0, [0.0, 9.0], [2.0, 2.0]),
    ] {
        slides(pull, capacities, wanted);
    }
}

#[test]
fn what_slides_at_its_bound_without_acceleration_is_held() {
    slides(4.0, [0.0, 0.0], [0.0, 2.0]);
    slides(3.5, [3.0, 3.0], [0.0, 0.25]);
    slides(3.0001, [3.0, 3.0], [0.0, 0.00005]);
    slides(-4.0, [0.0, 0.0], [0.0, -2.0]);
}

/// A ball of 1 kg on a vertical rail.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Ball {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], velocity = [0.0, 0.0, 2.0])]
    ball: Body,
    #[joint(between = [ground, ball], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    rail: Prismatic,
}

/// Two frictions on one joint add, and one stop at which the ball turns by itself does nothing.
#[test]
fn frictions_add_and_a_touch_is_no_impact() {
    let (ball, h) = (Ball::default(), Ball::HANDLES);
    let rail = h.rail.displacement();
    // It stops after 2 / (g + 7) s, and 7 N do not hold it.
    let up = 2.0 / (GRAVITY + 7.0);
    let report = ball
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .interactions([
            Interaction::friction(rail, 4.0),
            Interaction::friction(rail, 3.0),
        ])
        .run(0.0..=1.0, every(1.0), |_| ())
        .expect("it rises and falls");
    let found = Ball::velocity(&report.state, h.ball).z;
    let wanted = -(GRAVITY - 7.0) * (1.0 - up);
    assert!((found - wanted).abs() < 1e-11, "{found} {wanted}");
    // 12 N do.
    let frictions = [7.0, 5.0].map(|capacity| Interaction::friction(rail, capacity));
    let [first, second] = Interaction::handles(&frictions);
    let mut efforts = [0.0; 2];
    ball.simulation(StandardLagrange, DormandPrince::new(tight()))
        .interactions(frictions)
        .run(0.0..=1.0, every(1.0), |sample| -> Result<(), Fault> {
            efforts = [sample.effort(first)?, sample.effort(second)?];
            assert!(sample.time() == 0.0 || sample.displacement_rate(h.rail).abs() < 1e-14);
            Ok(())
        })
        .expect("it rises and stays");
    let sum = efforts[0] + efforts[1];
    assert!((sum - GRAVITY).abs() < 1e-12, "{efforts:?}");
    assert!(efforts[0] <= 7.0 && efforts[1] <= 5.0, "{efforts:?}");
    // The top of the throw, and as near to it as rounding allows on either side.
    for beyond in [-1e-6, -1e-13, 0.0, 1e-13, 1e-6] {
        let top = 2.0 / GRAVITY + beyond;
        let report = ball
            .simulation(StandardLagrange, DormandPrince::new(tight()))
            .interactions([Interaction::limits(rail, [f64::NEG_INFINITY, top]).restitution(1.0)])
            .run(0.0..=0.5, every(0.5), |sample| {
                assert!(sample.displacement(h.rail) < top + 1e-12);
            })
            .expect("it falls");
        let found = Ball::velocity(&report.state, h.ball).z;
        // Without loss it falls as it rose, sooner where the stop is below the top.
        let touches = (-2.0 * GRAVITY * beyond.min(0.0)).sqrt();
        let wanted = 2.0 - GRAVITY * 0.5 - 2.0 * touches;
        // A touch within the last digits may be none.
        let bound = if beyond.abs() < 1e-9 { 4e-6 } else { 1e-9 };
        assert!(
            (found - wanted).abs() < bound,
            "{beyond:e}: {found} {wanted}"
        );
    }
}

/// The observer sees both sides of a change of modes, whatever it asks for.
#[test]
fn a_change_of_modes_is_reported_before_and_after() {
    let (ball, h) = (Ball::default(), Ball::HANDLES);
    let frictions = [Interaction::friction(h.rail.displacement(), 20.0)];
    let [friction] = Interaction::handles(&frictions);
    let mut reports = Vec::new();
    ball.simulation(StandardLagrange, DormandPrince::new(tight()))
        .interactions(frictions)
        .run(0.0..=0.5, every(0.5), |sample| -> Result<(), Fault> {
            reports.push((
                sample.time(),
                sample.mode(friction)?,
                sample.effort(friction)?,
            ));
            Ok(())
        })
        .expect("it rises and stays");
    let stop = 2.0 / (GRAVITY + 20.0);
    let wanted = [
        (0.0, Mode::SlidingUp, -20.0),
        (stop, Mode::SlidingUp, -20.0),
        (stop, Mode::Sticking, GRAVITY),
        (0.5, Mode::Sticking, GRAVITY),
    ];
    assert_eq!(reports.len(), wanted.len(), "{reports:?}");
    for (found, wanted) in reports.iter().zip(&wanted) {
        assert!((found.0 - wanted.0).abs() < 1e-12, "{reports:?}");
        assert_eq!(found.1, wanted.1, "{reports:?}");
        assert!((found.2 - wanted.2).abs() < 1e-11, "{reports:?}");
    }
    assert_eq!(reports[1].0, reports[2].0);
}

/// A table of 4 kg on four legs, of which three would do, that falls level on the floor.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Table {
    #[body(mass = 4.0, inertia = [0.5, 0.7, 1.0], position = [0.1, 0.05, 1.0], free)]
    table: Body,
    #[point(on = table, at = [-0.5, -0.4, 0.5])]
    a: Point,
    #[point(on = table, at = [0.5, -0.4, 0.5])]
    b: Point,
    #[point(on = table, at = [0.5, 0.4, 0.5])]
    c: Point,
    #[point(on = table, at = [-0.5, 0.4, 0.5])]
    d: Point,
}

#[test]
fn a_table_stands_on_four_legs() {
    let (table, h) = (Table::default(), Table::HANDLES);
    let floor = Plane::on_ground([0.0; 3], [0.0, 0.0, 1.0]);
    let legs = [h.a, h.b, h.c, h.d].map(|leg| Interaction::contact(leg, floor));
    let handles = Interaction::handles(&legs);
    let mut efforts = [0.0; 4];
    let report = table
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .interactions(legs)
        .run(0.0..=2.0, every(0.1), |sample| -> Result<(), Fault> {
            for (leg, effort) in handles.into_iter().zip(&mut efforts) {
                *effort = sample.effort(leg)?;
            }
            Ok(())
        })
        .expect("it falls");
    // The legs bear the weight and both its moments: which of them do is not determined.
    let [a, b, c, d] = efforts;
    let weight = 4.0 * GRAVITY;
    assert!((a + b + c + d - weight).abs() < 1e-10, "{efforts:?}");
    assert!((0.5 * (b + c - a - d) - 0.1 * weight).abs() < 1e-10);
    assert!((0.4 * (c + d - a - b) - 0.05 * weight).abs() < 1e-10);
    assert!(efforts.iter().all(|effort| *effort >= 0.0));
    let height: f64 = Table::pose(&report.state, h.table).position.z;
    assert!((height - 0.5).abs() < 1e-10);
}
