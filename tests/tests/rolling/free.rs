//! A disc and a ball that roll, against closed forms.

use holonom::Pose;
use holonom::nalgebra::{Rotation3, UnitQuaternion, Vector3};
use holonom::prelude::*;

/// A disc of the same thickness everywhere.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
pub(crate) struct Disc {
    #[param]
    mass: f64,
    #[param]
    radius: f64,
    /// The radius of the section of its tyre (m).
    #[param]
    crown: f64,
    #[body(
        mass = mass,
        inertia = [0.25 * mass * radius * radius, 0.5 * mass * radius * radius, 0.25 * mass * radius * radius],
        position = [0.0, 0.0, radius]
    )]
    disc: Body,
    #[joint(
        between = [ground, disc], center = [0.0, 0.0, radius], axle = [0.0, 1.0, 0.0], point = [0.0, 0.0, 0.0],
        normal = [0.0, 0.0, 1.0], radius = radius, crown = crown
    )]
    contact: RollingWheel,
}

/// A disc of 2 kg and 0.2 m.
pub(crate) fn disc(crown: f64) -> Disc {
    Disc::new(2.0, 0.2, crown).expect("a disc")
}

pub(crate) const GRAVITY: f64 = 9.81;

/// The disc in a steady circle: leant by an angle from upright, its plane turning about the
/// vertical at a rate; and the radius of the circle of its centre.
///
/// With `u` the direction from the contact to the centre and `a` the axle, the angular momentum
/// `A W cos(lean) u + C w a` is carried round by `W`, and the force on the contact is
/// `m (W V h + g k)`: `W cos(lean) (A W sin(lean) - C w) = m r (W r w cos(lean) + g sin(lean))`.
pub(crate) fn steady(of: &Disc, lean: f64, turn: f64) -> (StateOf<Disc>, f64) {
    let (m, r, g) = (of.mass, of.radius, GRAVITY);
    let (of_diameter, of_axle) = (0.25 * m * r * r, 0.5 * m * r * r);
    let (sine, cosine) = lean.sin_cos();
    let spin = (of_diameter * turn * turn * cosine * sine - m * g * r * sine)
        / (turn * cosine * (of_axle + m * r * r));
    let (along, up) = (Vector3::y(), Vector3::z());
    let axle = cosine * along + sine * up;
    let upward = cosine * up - sine * along;
    let mut state: StateOf<Disc> = of.described_state().expect("as described");
    let turned = Rotation3::rotation_between(&along, &axle).expect("no half turn");
    let disc = Disc::HANDLES.disc;
    let position = r * upward;
    let orientation = UnitQuaternion::from_rotation_matrix(&turned).into_inner();
    Disc::set_pose(
        &mut state,
        disc,
        Pose {
            position,
            orientation,
        },
    );
    let spins = spin * axle + turn * cosine * upward;
    Disc::set_angular_velocity_global(&mut state, disc, spins);
    Disc::set_velocity(&mut state, disc, spins.cross(&position));
    (state, r * (spin / turn).abs())
}

#[test]
fn a_disc_rolls_in_a_steady_circle() {
    let h = Disc::HANDLES;
    let disc = disc(0.0);
    for (lean, turn) in [
        (0.3, 2.0),
        (0.8, -3.0),
        (-0.2, 1.5),
        (1.3, 6.0),
        // Nearly flat, where a coin rings.
        (core::f64::consts::FRAC_PI_2 - 2e-4, 1010.0),
        (0.5, 1e4),
    ] {
        let (state, circle) = steady(&disc, lean, turn);
        let period = core::f64::consts::TAU / turn.abs();
        let mut places = Vec::new();
        let mut observe = |sample: &Sample<'_, f64, Disc>| {
            let pose = sample.pose(h.disc);
            let axle = UnitQuaternion::new_unchecked(pose.orientation) * Vector3::y();
            assert!(
                (axle.z - lean.sin()).abs() < 1e-9,
                "{lean} {turn}: {}",
                axle.z
            );
            places.push(pose.position);
        };
        let simulation = || {
            Simulation::new(&disc, StandardLagrange, Rk4::every(period / 4000.0))
                .initial_state(state)
        };
        let times = every(period / 4.0);
        simulation()
            .absolute_coordinates()
            .run(0.0..=period, times, &mut observe)
            .expect("a run");
        simulation()
            .joint_coordinates()
            .run(0.0..=period, times, &mut observe)
            .expect("a run");
        for places in places.chunks(5) {
            let [first, quarter, half, .., last] = places else {
                panic!("five places, {}", places.len())
            };
            assert!((last - first).norm() < 1e-9);
            assert!(((half - first).norm() - 2.0 * circle).abs() < 1e-9);
            assert!(((quarter - first).norm() - 2.0_f64.sqrt() * circle).abs() < 1e-9);
        }
    }
}

/// A tyre of any section changes where the wheel touches, and not what is lost.
#[test]
fn a_leaning_wheel_keeps_its_energy() {
    for crown in [0.0, 0.05, 0.2] {
        let disc = disc(crown);
        let h = Disc::HANDLES;
        let mut state: StateOf<Disc> = disc.described_state().expect("as described");
        let spin = Vector3::new(0.4, 5.0, 0.3);
        Disc::set_angular_velocity_global(&mut state, h.disc, spin);
        Disc::set_velocity(&mut state, h.disc, spin.cross(&Vector3::new(0.0, 0.0, 0.2)));
        let mut first = None;
        let simulation = Simulation::new(&disc, StandardLagrange, Rk4::every(1e-3));
        let mut simulation = simulation.initial_state(state).assembled();
        simulation = simulation.absolute_coordinates();
        let report = simulation
            .run(0.0..=2.0, every(0.1), |sample| {
                let energy = *first.get_or_insert(sample.energy());
                assert!((sample.energy() - energy).abs() < 1e-9 * energy);
                // Not the thin disc leans by its tyre.
                assert!(sample.pose(h.disc).position.z > 0.15);
            })
            .expect("a run");
        assert!(report.warnings().is_empty(), "{}", report.warnings());
    }
}

#[test]
fn a_disc_that_falls_flat_is_a_fault() {
    let (disc, h) = (disc(0.0), Disc::HANDLES);
    let (mut state, _) = steady(&disc, 1.2, 1.0);
    Disc::set_velocity(&mut state, h.disc, Vector3::zeros());
    Disc::set_angular_velocity_global(&mut state, h.disc, Vector3::zeros());
    let run = Simulation::new(&disc, StandardLagrange, DormandPrince::default())
        .initial_state(state)
        .run(0.0..=1.0, every(0.1), |_| {});
    let fault = run.expect_err("it lies flat after a tenth of a second");
    assert!(fault.time < 0.5, "{fault}");
}

/// A ball on a table that turns.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
pub(crate) struct Table {
    /// Its rate (rad/s).
    #[param]
    rate: f64,
    #[body(mass = 5.0, inertia = [1.0, 1.0, 1.0])]
    table: Body,
    #[body(
        mass = 0.7, inertia = [0.4 * 0.7 * 0.05 * 0.05, 0.4 * 0.7 * 0.05 * 0.05, 0.4 * 0.7 * 0.05 * 0.05],
        position = [0.3, 0.1, 0.05], velocity = [0.2, 0.4, 0.0], angular_velocity = [0.0, 0.0, 2.0]
    )]
    ball: Body,
    #[joint(between = [ground, table], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [ground, table], axis = [0.0, 0.0, 1.0], motion = rate * time)]
    motor: AngleDriver,
    #[joint(
        between = [table, ball], center = [0.3, 0.1, 0.05], point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0],
        radius = 0.05
    )]
    contact: RollingBall,
}

/// The velocity of a ball without hollows turns at 2/7 of the speed of the table (Milne 1948,
/// section 287), wherever it is; about the vertical it spins as before.
#[test]
fn a_ball_on_a_turning_table_runs_in_circles() {
    let h = Table::HANDLES;
    for rate in [0.0, 3.0, -7.0] {
        let table = Table::new(rate).expect("a table");
        let mut first: Option<(Vector3<f64>, Vector3<f64>)> = None;
        let mut observe = |sample: &Sample<'_, f64, Table>| {
            let (place, velocity) = (sample.pose(h.ball).position, sample.velocity(h.ball));
            let (from, before) = *first.get_or_insert((place, velocity));
            let turn = 2.0 / 7.0 * rate;
            let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), turn * sample.time());
            let expected = turned * before;
            assert!(
                (velocity - expected).norm() < 1e-10,
                "{velocity} for {expected}"
            );
            if rate != 0.0 {
                // About the centre of the circle.
                let arm = Vector3::z().cross(&before) / turn;
                let expected = from + arm - turned * arm;
                assert!((place - expected).norm() < 1e-10, "{place} for {expected}");
            }
            let spin = sample.angular_velocity_global(h.ball).z;
            assert!((spin - 2.0).abs() < 1e-9, "{rate} {} {spin}", sample.time());
        };
        let simulation =
            || Simulation::new(&table, StandardLagrange, Rk4::every(2.5e-4)).assembled();
        simulation()
            .absolute_coordinates()
            .run(0.0..=1.5, every(0.5), &mut observe)
            .expect("a run");
        simulation()
            .joint_coordinates()
            .run(0.0..=1.5, every(0.5), &mut observe)
            .expect("a run");
    }
}

holonom::joint! {
    /// A belt: the rate of a displacement follows a law, and a rack rolls on a pinion.
    pub(crate) joint Belt(i, j; point: Point, axis: Axis, speed: Law) {
        drive rate(dot(i.axis, j.point - i.point)) to speed();
    }
}

holonom::joint! {
    /// What a rack is, by its rates.
    pub(crate) joint RollingRack(i, j, k; axis: Axis, slide: Axis, point: Point, radius: Length) {
        rate(dot(k.slide, j.point - k.point)) - radius * rate(angle(k, i, axis));
    }
}

/// A drum of 0.05 kg m^2 and 0.1 m, from which a block of 3 kg sinks; and a block on a belt.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
pub(crate) struct Drum {
    #[body(mass = 1.0, inertia = [0.05, 0.05, 0.05])]
    drum: Body,
    #[body(mass = 3.0, inertia = [0.01, 0.01, 0.01], position = [0.0, 0.1, -0.5])]
    block: Body,
    #[body(mass = 2.0, inertia = [0.01, 0.01, 0.01], position = [1.0, 0.0, 0.0])]
    carried: Body,
    #[joint(between = [ground, drum], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    bearing: Revolute,
    #[joint(between = [ground, block], point = [0.0, 0.1, -0.5], axis = [0.0, 0.0, 1.0])]
    shaft: Prismatic,
    #[joint(
        between = [drum, block, ground], axis = [1.0, 0.0, 0.0], slide = [0.0, 0.0, 1.0], point = [0.0, 0.1, -0.5],
        radius = 0.1
    )]
    rope: RollingRack,
    #[joint(between = [ground, carried], point = [1.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    rail: Prismatic,
    #[joint(between = [ground, carried], point = [1.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0], speed = 0.3 * time * time)]
    belt: Belt,
}

/// Rows whose integral exists give the motion of the integral: `a = -g m / (m + J / r^2)` of the
/// block, `0.1 t^3` of what is on the belt, which takes `m 0.6 t`.
#[test]
fn rates_that_have_an_integral_move_as_it_does() {
    let h = Drum::HANDLES;
    let drum = Drum::default();
    let acceleration = -9.81 * 3.0 / (3.0 + 0.05 / 0.01);
    let observe = |sample: &Sample<'_, f64, Drum>| -> Result<(), Fault> {
        let time = sample.time();
        let fallen = 0.5 * acceleration * time * time;
        assert!((sample.displacement(h.shaft) - fallen).abs() < 1e-11);
        let off = sample.angle(h.bearing) - fallen / 0.1;
        let turns = off / core::f64::consts::TAU;
        assert!((turns - turns.round()).abs() < 1e-10, "{turns}");
        assert!((sample.displacement(h.rail) - 0.1 * time.powi(3)).abs() < 1e-10);
        let effort = sample.driving_effort(h.belt)?;
        assert!((effort - 2.0 * 0.6 * time).abs() < 1e-9, "{effort}");
        Ok(())
    };
    let simulation = || Simulation::new(&drum, StandardLagrange, Rk4::every(5e-4)).assembled();
    simulation()
        .absolute_coordinates()
        .run(0.0..=1.0, every(0.25), observe)
        .expect("a run");
    simulation()
        .joint_coordinates()
        .run(0.0..=1.0, every(0.25), observe)
        .expect("a run");
}
