//! A ball on a turntable: slip that begins while its direction turns, and slip that only turns.

use holonom::prelude::*;
use holonom::run::{InteractionMode, Plane};

const GRAVITY: f64 = 9.81;

/// A ball of 10 g, which touches by its centre, 1 m from the axis of a table.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Turntable {
    /// The rate (rad/s) of the table at the start, and how fast that grows (rad/s^2).
    #[param]
    rate: f64,
    #[param]
    faster: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    table: Body,
    #[joint(between = [ground, table], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    axle: Revolute,
    #[joint(
        between = [ground, table], axis = [0.0, 0.0, 1.0],
        motion = rate * time + 0.5 * faster * time * time
    )]
    motor: AngleDriver,
    #[body(free, mass = 0.01, inertia = [1e-6, 1e-6, 1e-6], position = [1.0, 0.0, 0.0])]
    ball: Body,
}

/// Where a point of the table's friction is at a time, by steps with an implicit law of friction.
fn stepped(faster: f64, friction: f64, end: f64, steps: u32) -> [f64; 2] {
    let step = end / f64::from(steps);
    let ([mut x, mut y], [mut vx, mut vy]) = ([1.0, 0.0], [0.0, 0.0]);
    for number in 1..=steps {
        let rate = faster * step * f64::from(number);
        let ([mut next_x, mut next_y], mut again) = ([vx, vy], 0);
        while again < 3 {
            let place = [
                x + 0.5 * step * (vx + next_x),
                y + 0.5 * step * (vy + next_y),
            ];
            let under = [-rate * place[1], rate * place[0]];
            let slip = [vx - under[0], vy - under[1]];
            let kept = (1.0 - friction * GRAVITY * step / slip[0].hypot(slip[1])).max(0.0);
            [next_x, next_y] = [under[0] + kept * slip[0], under[1] + kept * slip[1]];
            again += 1;
        }
        (x, y) = (
            x + 0.5 * step * (vx + next_x),
            y + 0.5 * step * (vy + next_y),
        );
        (vx, vy) = (next_x, next_y);
    }
    [x, y]
}

/// It sticks until the table would have to bear `mu g`, which its way round asks for together with
/// its getting faster.
#[test]
fn slip_begins_while_its_direction_turns() {
    let (faster, friction, end): (f64, f64, f64) = (1.0, 0.3, 2.2);
    let table = Turntable::new(0.0, faster).expect("it turns");
    let h = Turntable::HANDLES;
    let plane = Plane::on(h.table, [0.0; 3], [0.0, 0.0, 1.0]);
    let contact = Interaction::contact(h.ball, plane).with_friction(friction);
    let [_, along, _] = Interaction::handles(&contact);
    let begins = ((friction * GRAVITY).powi(2) - faster * faster).powf(0.25) / faster;
    let [coarse, fine] = [100_000, 200_000].map(|steps| stepped(faster, friction, end, steps));
    let tolerance = Tolerance {
        relative: 1e-9,
        absolute: 1e-10,
    };
    let mut found = None;
    let report = table
        .simulation(StandardLagrange, DormandPrince::new(tolerance))
        .interactions(contact)
        .run(0.0..=end, every(0.1), |sample| {
            if found.is_none() && sample.mode(along) == Ok(InteractionMode::Slipping) {
                found = Some(sample.time());
            }
        })
        .expect("it slips");
    let found = found.expect("it slips");
    assert!((found - begins).abs() < 1e-9, "{found} {begins}");
    let place = table
        .view(end, &report.state)
        .expect("a view")
        .position(h.ball);
    let wanted = [0, 1].map(|k| 2.0 * fine[k] - coarse[k]);
    assert!((place.x - wanted[0]).abs() < 1e-6, "{place} {wanted:?}");
    assert!((place.y - wanted[1]).abs() < 1e-6, "{place} {wanted:?}");
}

/// In the axes of a table of 100 rad/s slip turns by more than a right angle in a step.
#[test]
fn slip_that_turns_is_no_reversal() {
    let table = Turntable::new(100.0, 0.0).expect("it turns");
    let h = Turntable::HANDLES;
    let plane = Plane::on(h.table, [0.0; 3], [0.0, 0.0, 1.0]);
    let mut start = table.described_state().expect("it is described");
    table
        .set_angle_rate(&mut start, h.axle, 100.0)
        .expect("it turns");
    for step in [1e-3, 2e-2, 3e-2] {
        let contact = Interaction::contact(h.ball, plane).with_friction(0.02);
        let report = table
            .simulation(StandardLagrange, Rk4::every(step))
            .initial_state(start)
            .interactions(contact)
            .run(0.0..=0.3, every(0.3), |_| ())
            .expect("it slips");
        let view = table.view(0.3, &report.state).expect("a view");
        let speed = view.velocity(h.ball).norm();
        assert!(
            (speed - 0.02 * GRAVITY * 0.3).abs() < 1e-5,
            "{step}: {speed}"
        );
    }
}
