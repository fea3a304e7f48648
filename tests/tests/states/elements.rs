//! Elements whose inner number is a state: filters, a Maxwell element, controllers, chains.

use std::f64::consts::PI;

use holonom::prelude::*;

use crate::tight;

/// A time constant (s).
const LAG: f64 = 0.2;

/// Filters beside a body that rests.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Filters {
    #[state(rate = (sin(10.0 * time) - wave) / LAG)]
    wave: f64,
    #[state(rate = smooth_step((time - 1.0) / 0.01) - 2.0 * edge, start = 0.5)]
    edge: f64,
    // Each follows the one before.
    #[state(rate = (if k == 0 { 1.0 } else { chain[k - 1] } - chain[k]) / LAG, start = [0.0, 0.0, 0.0])]
    chain: [f64; 3],
    // A cycle: an oscillator.
    #[state(rate = 3.0 * y, start = 1.0)]
    x: f64,
    #[state(rate = -3.0 * x)]
    y: f64,
    #[body(free, mass = 1.0)]
    stone: Particle,
}

#[test]
fn filters_follow_their_closed_forms() {
    let filters = Filters::default();
    let h = Filters::HANDLES;
    let mut see = |sample: &Sample<'_, f64, Filters>| {
        let t = sample.time();
        let read = |of| sample.state_value(of);
        // x' = (sin(w t) - x) / T from zero.
        let w = 10.0;
        let size = 1.0 + (w * LAG).powi(2);
        let wave = ((w * t).sin() - w * LAG * (w * t).cos() + w * LAG * (-t / LAG).exp()) / size;
        assert!((read(h.wave) - wave).abs() < 1e-10, "wave at {t}");
        // Stages of one time constant after a step.
        let x = t / LAG;
        let mut term = (-x).exp();
        let mut left = 1.0;
        for (stage, of) in h.chain.into_iter().enumerate() {
            left -= term;
            term *= x / (stage + 1) as f64;
            assert!((read(of) - left).abs() < 1e-10, "stage {stage} at {t}");
        }
        assert!((read(h.x) - (3.0 * t).cos()).abs() < 1e-9);
        assert!((read(h.y) + (3.0 * t).sin()).abs() < 1e-9);
        // The step of 10 ms comes after a rest in which nothing moves it but its own decay.
        if t < 1.0 {
            assert!((read(h.edge) - 0.5 * (-2.0 * t).exp()).abs() < 1e-10);
        } else if t > 1.02 {
            // The integral of exp(2 s) times the smooth step from s = 0 to 1, over 0.01 s, by
            // Simpson's rule.
            let step = |s: f64| s * s * s * (s * (6.0 * s - 15.0) + 10.0);
            let weight = |place: usize| match (place, place % 2) {
                (0 | 1000, _) => 1.0,
                (_, 1) => 4.0,
                _ => 2.0,
            };
            let sum = (0..=1000).map(|place| {
                let s = place as f64 / 1000.0;
                weight(place) * (2.0 * (1.0 + 0.01 * s)).exp() * step(s)
            });
            let begun = sum.sum::<f64>() * 0.01 / 3000.0;
            let rest = ((2.0 * t).exp() - 2.02_f64.exp()) / 2.0;
            let edge = (0.5 + begun + rest) * (-2.0 * t).exp();
            assert!((read(h.edge) - edge).abs() < 1e-9, "edge at {t}");
        }
    };
    for by_joints in [false, true] {
        let run = filters.simulation(StandardLagrange, tight());
        let result = if by_joints {
            run.joint_coordinates()
                .run(0.0..=2.0, every(0.05), &mut see)
        } else {
            run.absolute_coordinates()
                .run(0.0..=2.0, every(0.05), &mut see)
        };
        result.expect("it runs");
    }
    assert_eq!(Filters::REPORT.time.breaks, [1.0, 1.01]);
    assert_eq!(h.chain[1].name(), "chain[1]");
}

const MASS: f64 = 2.0;
const STIFFNESS: f64 = 300.0;
const DAMPING: f64 = 25.0;

/// A spring and a damper in a row (Maxwell) hold a mass to a wall at the origin. The force is the
/// same in both, positive where they pull: `f' = k (x' - f / c)`.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Maxwell {
    #[state(rate = STIFFNESS * (element.rate - pull / DAMPING), start = 4.0)]
    pull: f64,
    #[body(mass = MASS, position = [1.0, 0.0, 0.0], velocity = [0.5, 0.0, 0.0])]
    load: Particle,
    #[joint(between = [ground, load], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    wire: PointOnLine,
    #[force(between = [ground, load], head = [0.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0], force = -pull)]
    element: Actuator,
}

#[test]
fn a_spring_and_a_damper_in_a_row() {
    // m v' = -f, f' = k v - k / c f: a damped oscillation of v.
    let (v0, f0) = (0.5, 4.0);
    let decay = STIFFNESS / DAMPING / 2.0;
    let w = (STIFFNESS / MASS - decay * decay).sqrt();
    let mechanism = Maxwell::default();
    let h = Maxwell::HANDLES;
    let mut see = |sample: &Sample<'_, f64, Maxwell>| {
        let t = sample.time();
        let slope = (-f0 / MASS + decay * v0) / w;
        let (c, s, e) = ((w * t).cos(), (w * t).sin(), (-decay * t).exp());
        let v = e * (v0 * c + slope * s);
        let f = -MASS * e * ((slope * w - decay * v0) * c - (v0 * w + decay * slope) * s);
        // The end of the spring moves by f / k, that of the damper by the impulse over c.
        let x = 1.0 + (f - f0) / STIFFNESS - MASS / DAMPING * (v - v0);
        assert!((sample.velocity(h.load).x - v).abs() < 1e-10);
        assert!((sample.state_value(h.pull) - f).abs() < 1e-9);
        assert!((sample.pose(h.load).position.x - x).abs() < 1e-10);
    };
    let reports = [
        mechanism
            .simulation(StandardLagrange, tight())
            .absolute_coordinates()
            .run(0.0..=1.0, every(0.05), &mut see)
            .expect("it runs by bodies"),
        mechanism
            .simulation(StandardLagrange, tight())
            .joint_coordinates()
            .run(0.0..=1.0, every(0.05), &mut see)
            .expect("it runs by joints"),
    ];
    for report in reports {
        assert!(report.warnings().is_empty(), "{:?}", report.warnings());
    }
}

/// The target of the arms below (rad).
const TARGET: f64 = 0.5;

/// An arm whose controller sums its error in a state.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Summing {
    #[state(rate = TARGET - hinge.angle)]
    integral: f64,
    #[body(mass = 1.0, inertia = [0.083, 0.001, 0.083], position = [0.0, 0.5, 0.0])]
    link: Body,
    #[joint(between = [ground, link], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[force(
        between = [ground, link], axis = [1.0, 0.0, 0.0],
        moment = 30.0 * (TARGET - angle) + 40.0 * integral - 6.0 * rate
    )]
    motor: TorsionalActuator,
}

/// The same arm for a controller in the program.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Sampled {
    #[input]
    integral: f64,
    #[body(mass = 1.0, inertia = [0.083, 0.001, 0.083], position = [0.0, 0.5, 0.0])]
    link: Body,
    #[joint(between = [ground, link], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[force(
        between = [ground, link], axis = [1.0, 0.0, 0.0],
        moment = 30.0 * (TARGET - angle) + 40.0 * integral - 6.0 * rate
    )]
    motor: TorsionalActuator,
}

#[test]
fn a_controllers_sum_is_the_limit_of_short_periods() {
    const END: f64 = 1.0;
    let mut limit = 0.0;
    Summing::default()
        .simulation(StandardLagrange, tight())
        .run(0.0..=END, every(END), |sample| {
            limit = sample.angle(Summing::HANDLES.hinge);
        })
        .expect("it runs");
    let ends = [0.01, 0.005, 0.0025].map(|period| {
        let (mut sum, mut end) = (0.0, 0.0);
        Sampled::default()
            .simulation(StandardLagrange, tight())
            .every_period(period, |sample, inputs| {
                // The input of this period is the sum of the errors before.
                inputs.integral = sum;
                sum += period * (TARGET - sample.angle(Sampled::HANDLES.hinge));
            })
            .run(0.0..=END, every(END), |sample| {
                end = sample.angle(Sampled::HANDLES.hinge);
            })
            .expect("it runs");
        end - limit
    });
    // Of first order in the period, so that twice the finer less the coarser is of the second.
    let extrapolated = [2.0 * ends[1] - ends[0], 2.0 * ends[2] - ends[1]];
    assert!(ends[0].abs() > 1e-4, "{ends:?}");
    assert!((ends[0] / ends[1] - 2.0).abs() < 0.1, "{ends:?}");
    assert!(
        (extrapolated[0] / extrapolated[1] - 4.0).abs() < 0.8,
        "{extrapolated:?}"
    );
    assert!(extrapolated[1].abs() < 1e-5, "{extrapolated:?}");
}

/// A wheel that turns evenly, and a slide on a screw of two motions.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Readings {
    #[state(rate = axle.angle)]
    turned: f64,
    #[state(rate = rail.displacement * rail.rate)]
    half_square: f64,
    #[state(rate = sleeve.angle_rate + 10.0 * sleeve.displacement_rate + sleeve.displacement)]
    mixed: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2], angular_velocity = [0.0, 0.0, 10.0])]
    wheel: Body,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    axle: Revolute,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2], position = [0.0, 1.0, 0.0], velocity = [2.0, 0.0, 0.0])]
    car: Body,
    #[joint(between = [ground, car], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[body(
        mass = 1.0, inertia = [0.1, 0.1, 0.2], position = [0.0, 3.0, 0.0],
        velocity = [0.0, 0.0, 0.5], angular_velocity = [0.0, 0.0, 3.0]
    )]
    ring: Body,
    #[joint(between = [ground, ring], point = [0.0, 3.0, 0.0], axis = [0.0, 0.0, 1.0])]
    sleeve: Cylindrical,
}

#[test]
fn joints_are_read_over_any_number_of_turns() {
    let mechanism = Readings::default();
    let h = Readings::HANDLES;
    let mut see = |sample: &Sample<'_, f64, Readings>| {
        let t = sample.time();
        // Nearly five turns.
        assert!((sample.angle(h.axle) - 10.0 * t).abs() < 1e-9);
        assert!((sample.state_value(h.turned) - 5.0 * t * t).abs() < 1e-8);
        assert!((sample.state_value(h.half_square) - 2.0 * t * t).abs() < 1e-9);
        let mixed = 8.0 * t + 0.25 * t * t;
        assert!((sample.state_value(h.mixed) - mixed).abs() < 1e-9);
    };
    mechanism
        .simulation(StandardLagrange, tight())
        .absolute_coordinates()
        .run(0.0..=3.0, every(0.1), &mut see)
        .expect("it runs by bodies");
    mechanism
        .simulation(StandardLagrange, tight())
        .joint_coordinates()
        .run(0.0..=3.0, every(0.1), &mut see)
        .expect("it runs by joints");
    // Only the angle that is read counts turns.
    assert_eq!(Readings::REPORT.auxiliaries, 1);
}

holonom::force! {
    /// A spring whose rest length is a law, with a damper that feels how fast that changes.
    pub force Drawn(i, j; head: Point, tail: Point, rest: Law(), damping: Number) {
        let d = length(j.tail - i.head);
        potential 50.0 * (d - rest()) * (d - rest());
        -damping * (rate(d) - rate(rest())) along d;
    }
}

/// A load that follows the rest length of a spring, which moves as a wave.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Crane {
    #[state(rate = 0.3 * cos(2.0 * time), start = 1.0)]
    rope: f64,
    #[body(mass = 2.0, position = [1.0, 0.0, 0.0])]
    load: Particle,
    #[joint(between = [ground, load], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    wire: PointOnLine,
    #[force(
        between = [ground, load], head = [0.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0],
        rest = rope, damping = 5.0
    )]
    spring: Drawn,
}

#[test]
fn potentials_and_rates_of_laws_know_states() {
    // m z'' + c z' + k z = -m r'' for the difference z from the rest length r, r'' = -0.6 sin 2t.
    let (m, c, k, w) = (2.0, 5.0, 100.0, 2.0);
    let (size, push) = (f64::powi(k - m * w * w, 2) + f64::powi(c * w, 2), 0.6 * m);
    let (sine, cosine) = (push * (k - m * w * w) / size, -push * c * w / size);
    let decay = c / (2.0 * m);
    let own = f64::sqrt(k / m - decay * decay);
    // It begins at rest on the rest length, which moves at 0.3 m/s.
    let (a, b) = (-cosine, (-0.3 - w * sine - decay * cosine) / own);
    let mechanism = Crane::default();
    let h = Crane::HANDLES;
    let mut see = |sample: &Sample<'_, f64, Crane>| {
        let t = sample.time();
        let rest = 1.0 + 0.15 * (w * t).sin();
        let free = (-decay * t).exp() * (a * (own * t).cos() + b * (own * t).sin());
        let x = rest + free + sine * (w * t).sin() + cosine * (w * t).cos();
        assert!((sample.state_value(h.rope) - rest).abs() < 1e-10);
        assert!((sample.pose(h.load).position.x - x).abs() < 1e-10, "at {t}");
    };
    let by_bodies = mechanism
        .simulation(StandardLagrange, tight())
        .absolute_coordinates()
        .run(0.0..=2.0 * PI, every(0.1), &mut see)
        .expect("it runs by bodies");
    let by_joints = mechanism
        .simulation(StandardLagrange, tight())
        .joint_coordinates()
        .run(0.0..=2.0 * PI, every(0.1), &mut see)
        .expect("it runs by joints");
    // The potential changes with the state alone, which the balance of energy accounts for.
    assert!(
        by_bodies.warnings().is_empty(),
        "{:?}",
        by_bodies.warnings()
    );
    assert!(
        by_joints.warnings().is_empty(),
        "{:?}",
        by_joints.warnings()
    );
}
