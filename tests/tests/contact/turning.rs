//! Balls on a turntable and across a slope: slip that begins or ends while its direction turns, and
//! slip that only turns.

use holonom::nalgebra::Vector3;
use holonom::prelude::*;
use holonom::run::{InteractionMode, Plane};

use super::balls::{Bowling, GRAVITY, RADIUS, start};

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

    // So do long fixed steps, which are shortened there.
    let fixed = table
        .simulation(StandardLagrange, Rk4::every(1e-2))
        .interactions(contact)
        .run(0.0..=end, every(end), |_| ())
        .expect("it slips");
    let view = table.view(end, &fixed.state).expect("a view");
    let off = (view.position(h.ball) - place).norm();
    assert!(off < 1e-7, "{off:e}");
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

/// Slip `s` of a ball of radius `r` across a slope, with `ds/dt = d - f s/|s|`: along the slope
/// `d = g sin a` drives it, and `f = 7/2 mu g cos a` is against it. With `u = tan` of half the
/// angle from `d` to `s`, and `k = f/d`, time, slip and the way of the slip are powers of `u`.
struct Across {
    drive: f64,
    k: f64,
    start: [f64; 2],
    /// The scale of the slip, and `u` at the start.
    scale: f64,
    from: f64,
}

impl Across {
    fn new(slope: f64, friction: f64, start: [f64; 2]) -> Self {
        let drive = GRAVITY * slope.sin();
        let k = 3.5 * friction / slope.tan();
        let size = start[0].hypot(start[1]);
        let from = (size - start[0]) / start[1];
        let scale = start[1] / from.powf(k);
        Self {
            drive,
            k,
            start,
            scale,
            from,
        }
    }

    /// `(from^n - u^n) / n`.
    fn power(&self, n: f64, u: f64) -> f64 {
        (self.from.powf(n) - u.powf(n)) / n
    }

    fn time(&self, u: f64) -> f64 {
        let k = self.k;
        0.5 * self.scale / self.drive * (self.power(k - 1.0, u) + self.power(k + 1.0, u))
    }

    /// Where it rolls.
    fn end(&self) -> Option<f64> {
        (self.k > 1.0).then(|| self.time(0.0))
    }

    /// The way of the ball (m) until a time (s): `v = v0 + 5/7 d t + 2/7 (s - s0)`.
    fn way(&self, time: f64) -> [f64; 2] {
        let slips = self.end().map_or(time, |end| time.min(end));
        // By its logarithm: slip that goes on comes as near to its drive as powers of ten.
        let (mut low, mut high) = (-600.0, self.from.ln());
        for _ in 0..100 {
            let middle: f64 = 0.5 * (low + high);
            if self.time(middle.exp()) > slips {
                low = middle;
            } else {
                high = middle;
            }
        }
        let ends = slips < time;
        let (k, u) = (2.0 * self.k, if ends { 0.0 } else { high.exp() });
        let factor = self.scale * self.scale / self.drive;
        let slipped = [
            0.25 * factor * (self.power(k - 2.0, u) - self.power(k + 2.0, u)),
            0.5 * factor * (self.power(k - 1.0, u) + self.power(k + 1.0, u)),
        ];
        let driven = [5.0 / 14.0 * self.drive * time * time, 0.0];
        [0, 1].map(|at| {
            let [start, slipped] = [self.start[at], slipped[at]];
            start * time + driven[at] + 2.0 / 7.0 * (slipped - start * time)
        })
    }
}

/// What a run of a ball across a slope has come to: when it rolled first (s), and its way (m).
macro_rules! thrown {
    ($method:expr, $slope:expr, $friction:expr, $start:expr, $end:expr) => {{
        let (bowling, h) = (Bowling::default(), Bowling::HANDLES);
        let (sine, cosine): (f64, f64) = $slope.sin_cos();
        let [down, across] = $start;
        let plane = Plane::on_ground([0.0; 3], [sine, 0.0, cosine]);
        let place = [RADIUS * sine, 0.0, RADIUS * cosine];
        let start = start(place, [down * cosine, across, -down * sine], [0.0; 3]);
        let contact = Interaction::contact(h.ball, plane)
            .radius(RADIUS)
            .with_friction($friction);
        let [_, along, _] = Interaction::handles(&contact);
        let mut rolls = None;
        let report = bowling
            .simulation(StandardLagrange, $method)
            .initial_state(start)
            .interactions(contact)
            .run(0.0..=$end, every_step(), |sample| {
                if rolls.is_none() && sample.mode(along) == Ok(InteractionMode::Sticking) {
                    rolls = Some(sample.time());
                }
            })
            .expect("it slips");
        let view = bowling.view($end, &report.state).expect("a view");
        let way = view.position(h.ball) - Vector3::from(place);
        (rolls, [way.x * cosine - way.z * sine, way.y])
    }};
}

/// Slip that ends while it turns, at fixed steps as well, also where friction hardly holds what
/// drives it; and slip that passes close by zero and goes on.
#[test]
fn slip_across_a_slope_ends_where_its_closed_form_does() {
    for (slope, friction, start, end) in [
        (0.3_f64, 0.2, [0.3, 0.1], 0.2),
        (0.3, 0.1, [0.02, 0.01], 0.2),
        (0.01, 0.3, [0.0, 0.5], 0.1),
        (0.3, 0.08, [-0.2, 0.001], 0.2),
    ] {
        let form = Across::new(slope, friction, start);
        let tolerance = Tolerance {
            relative: 1e-10,
            absolute: 1e-11,
        };
        let controlled = DormandPrince::new(tolerance);
        for (near, (rolls, way)) in [
            (1e-10, thrown!(controlled, slope, friction, start, end)),
            (1e-7, thrown!(Rk4::every(1e-3), slope, friction, start, end)),
        ] {
            let wanted = form.way(end);
            assert_eq!(rolls.is_some(), form.end().is_some(), "{slope} {friction}");
            if let (Some(rolls), Some(end)) = (rolls, form.end()) {
                assert!(
                    (rolls - end).abs() < near,
                    "{slope} {friction}: {rolls} {end}"
                );
            }
            for (way, wanted) in way.into_iter().zip(wanted) {
                assert!(
                    (way - wanted).abs() < near,
                    "{slope} {friction}: {way} {wanted}"
                );
            }
        }
    }
}

/// How many evaluations a ball takes that is thrown at an angle (rad) from the way down a slope and
/// touches that by its centre; its velocity downwards and its speed after 3 s. The tangent of the
/// slope is so many times the coefficient of friction.
fn thrown_on_slope(is_fixed: bool, times: f64, (speed, angle): (f64, f64)) -> (usize, [f64; 2]) {
    let friction = 0.5;
    let (sine, cosine) = (times * friction).atan().sin_cos();
    let plane = Plane::on_ground([0.0, 0.0, RADIUS], [sine, 0.0, cosine]);
    let (along, across) = (speed * angle.cos(), speed * angle.sin());
    let velocity = [along * cosine, across, -along * sine];
    let (ball, h) = (Bowling::default(), Bowling::HANDLES);
    macro_rules! run {
        ($method:expr) => {
            ball.simulation(StandardLagrange, $method)
                .initial_state(start([0.0, 0.0, RADIUS], velocity, [0.0; 3]))
                .interactions(Interaction::contact(h.ball, plane).with_friction(friction))
                .run(0.0..=3.0, every(3.0), |_| ())
        };
    }
    let report = if is_fixed {
        run!(Rk4::every(1e-3))
    } else {
        run!(DormandPrince::new(Tolerance {
            relative: 1e-10,
            absolute: 1e-12,
        }))
    };
    let report = report.unwrap_or_else(|fault| panic!("{times} {speed} {angle}: {fault}"));
    let view = ball.view(3.0, &report.state).expect("a view");
    let velocity = view.velocity(h.ball);
    let down = velocity.x * cosine - velocity.z * sine;
    (report.evaluations, [down, velocity.norm()])
}

/// Where the slope is as steep as friction holds, what drives slip does not change it once they
/// have one direction: `|v| + v_down` stays as it is. A little steeper, what has come to rest slips
/// on at the difference.
#[test]
fn on_a_slope_at_the_angle_of_friction_slip_goes_on_as_it_is() {
    for thrown in [
        (1.0, 1.6),
        (1.0, core::f64::consts::PI - 1e-4),
        (1e-3, 3.1),
        (1e-7, 0.3),
        (1e-9, 2.0),
    ] {
        let (speed, angle) = thrown;
        for is_fixed in [false, true] {
            let (evaluations, [down, size]) = thrown_on_slope(is_fixed, 1.0, thrown);
            let kept = speed * (1.0 + angle.cos());
            let off = (size + down - kept).abs();
            // Fixed steps change slip that turns by half of itself.
            let bound = if is_fixed { 5e-5 } else { 5e-6 };
            assert!(off < bound * speed, "{thrown:?}: {size} {down}");
            assert!(evaluations < 30_000, "{thrown:?}: {evaluations}");
        }
    }
    for times in [1.0 + 1e-5, 1.0 + 1e-7, 1.0 - 1e-7] {
        let (sine, cosine) = (times * 0.5_f64).atan().sin_cos();
        let [driven, held] = [GRAVITY * sine, GRAVITY * 0.5 * cosine];
        let rests = 1e-3 / (driven + held);
        let wanted = (driven - held).max(0.0) * (3.0 - rests);
        let thrown = (1e-3, core::f64::consts::PI);
        for is_fixed in [false, true] {
            let (_, [down, _]) = thrown_on_slope(is_fixed, times, thrown);
            assert!((down - wanted).abs() < 1e-12, "{times}: {down} {wanted}");
        }
    }
}
