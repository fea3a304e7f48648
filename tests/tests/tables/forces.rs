//! Laws of forces from tables, beside the same laws as expressions: a cubic is its own spline.

use holonom::prelude::*;
use holonom::sensitivity::SensitivityExt;
use holonom::spline::uniform_knots;

/// `-3 a - a^3 / 2` (N m).
const MOMENT: Spline<5> = Spline::clamped(
    uniform_knots(-2.0, 2.0),
    [10.0, 3.5, 0.0, -3.5, -10.0],
    [-9.0, -9.0],
);

/// `40 - 120 d + 80 d^3` (J).
const ENERGY: Spline<4> = Spline::clamped(
    [0.0, 0.5, 1.0, 1.5],
    [40.0, -10.0, 0.0, 130.0],
    [-120.0, 420.0],
);

holonom::force! {
    /// Any potential of the distance of two points.
    force Well(i, j; head: Point, tail: Point, energy: Law(length)) {
        potential energy(length(j.tail - i.head));
    }
}

/// Three pendulums with one spring: as an expression, from a constant, from the table of the
/// parameter.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Pendulums {
    #[param]
    share: f64,
    #[param]
    table: Spline<5>,
    #[body(
        mass = 1.0, inertia = [0.1, 0.1, 0.02], position = [0.0, 0.0, -0.5],
        angular_velocity = [6.0, 0.0, 0.0], velocity = [0.0, 3.0, 0.0]
    )]
    written: Body,
    #[body(
        mass = 1.0, inertia = [0.1, 0.1, 0.02], position = [0.0, 0.0, -0.5],
        angular_velocity = [6.0, 0.0, 0.0], velocity = [0.0, 3.0, 0.0]
    )]
    constant: Body,
    #[body(
        mass = 1.0, inertia = [0.1, 0.1, 0.02], position = [0.0, 0.0, -0.5],
        angular_velocity = [6.0, 0.0, 0.0], velocity = [0.0, 3.0, 0.0]
    )]
    given: Body,
    #[joint(between = [ground, written], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    first: Revolute,
    #[joint(between = [ground, constant], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    second: Revolute,
    #[joint(between = [ground, given], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    third: Revolute,
    #[force(
        between = [ground, written], axis = [1.0, 0.0, 0.0],
        moment = share * (-3.0 * angle - 0.5 * angle * angle * angle) - 0.1 * rate
    )]
    by_expression: TorsionalActuator,
    #[force(
        between = [ground, constant], axis = [1.0, 0.0, 0.0],
        moment = share * MOMENT(angle) - 0.1 * rate
    )]
    by_constant: TorsionalActuator,
    #[force(
        between = [ground, given], axis = [1.0, 0.0, 0.0],
        moment = share * table(angle) - 0.1 * rate
    )]
    by_table: TorsionalActuator,
}

/// In s.
const STEP: f64 = 2e-3;

#[test]
fn a_table_moves_as_the_expression_does() {
    let pendulums = Pendulums::new(1.25, MOMENT).expect("a spline");
    let handles = Pendulums::HANDLES;
    let mut turned = 0.0_f64;
    let mut observe = |sample: &Sample<'_, f64, Pendulums>| {
        let written = sample.angle(handles.first);
        for joint in [handles.second, handles.third] {
            assert!((sample.angle(joint) - written).abs() < 1e-12);
        }
        turned = turned.max(written.abs());
    };
    let simulation = Simulation::new(&pendulums, StandardLagrange, Rk4::every(STEP));
    simulation
        .clone()
        .run(0.0..=3.0, every(0.1), &mut observe)
        .expect("it swings");
    simulation
        .joint_coordinates()
        .run(0.0..=3.0, every(0.1), &mut observe)
        .expect("it swings");
    // Over knots, and within the table.
    assert!(turned > 1.05 && turned < 2.0, "{turned}");
}

#[test]
fn derivatives_of_runs_pass_through_a_table() {
    let pendulums = Pendulums::new(1.25, MOMENT).expect("a spline");
    let handles = Pendulums::HANDLES;
    let mut last = [f64::NAN; 3];
    pendulums
        .sensitivities([handles.share])
        .expect("a parameter")
        .simulation(StandardLagrange, Rk4::every(STEP))
        .run(0.0..=1.0, every(1.0), |sample| {
            last = [handles.first, handles.second, handles.third].map(|joint| {
                let [by_share] = sample.angle(joint).derivatives();
                by_share
            });
        })
        .expect("it swings");
    assert!(last[0].abs() > 1e-2, "{last:?}");
    assert!(
        last.iter().all(|found| (found - last[0]).abs() < 1e-11),
        "{last:?}"
    );
}

/// Two beads on a line, in wells of one energy.
#[derive(Mechanism)]
struct Beads {
    #[body(mass = 2.0, position = [0.0, 0.0, 0.4])]
    written: Particle,
    #[body(mass = 2.0, position = [0.0, 0.0, 0.4])]
    read: Particle,
    #[joint(between = [ground, written], point = [0.0, 0.0, 0.4], axis = [0.0, 0.0, 1.0])]
    line: PointOnLine,
    #[joint(between = [ground, read], point = [0.0, 0.0, 0.4], axis = [0.0, 0.0, 1.0])]
    other: PointOnLine,
    #[force(
        between = [ground, written], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 0.4],
        energy = 40.0 - 120.0 * length + 80.0 * length * length * length
    )]
    by_expression: Well,
    #[force(
        between = [ground, read], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 0.4],
        energy = ENERGY(length)
    )]
    by_table: Well,
}

#[test]
fn a_potential_from_a_table_keeps_its_energy() {
    let handles = Beads::HANDLES;
    let mut start = None;
    Simulation::new(&Beads::default(), StandardLagrange, Rk4::every(STEP))
        .run(0.0..=2.0, every(0.05), |sample| {
            let [written, read] =
                [handles.written, handles.read].map(|bead| sample.pose(bead).position.z);
            assert!((written - read).abs() < 1e-11, "{written}, {read}");
            let energy: f64 = sample.energy();
            let first = *start.get_or_insert(energy);
            assert!((energy - first).abs() < 1e-5, "{energy}, {first}");
        })
        .expect("both swing");
    assert!(start.expect("it ran").abs() > 1.0);
}

/// A record that ends at rest, and is held from there on.
const RECORD: Spline<4> =
    Spline::clamped([0.0, 0.5, 1.0, 1.5], [0.0, 0.4, 0.6, 0.5], [0.0, 0.0]).held();

#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Turned {
    #[body(mass = 1.0, inertia = [0.3, 0.3, 0.3])]
    wheel: Body,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [ground, wheel], axis = [0.0, 0.0, 1.0], motion = RECORD(time))]
    motor: AngleDriver,
}

#[test]
fn a_run_follows_a_record_past_its_end() {
    let handles = Turned::HANDLES;
    let tolerance = Tolerance {
        relative: 1e-9,
        absolute: 1e-9,
    };
    // At the end of the record the acceleration jumps to zero: steps end at the knots.
    Simulation::new(
        &Turned::default(),
        StandardLagrange,
        DormandPrince::new(tolerance),
    )
    .breaks(RECORD.knots())
    .run(0.0..=2.0, every(0.25), |sample| {
        let (time, angle): (f64, f64) = (sample.time(), sample.angle(handles.bearing));
        assert!((angle - RECORD.value(time)).abs() < 1e-6, "{time}: {angle}");
        let effort = sample.driving_effort(handles.motor).expect("of a driver");
        let expected = 0.3 * RECORD.curvature(time);
        // At the end of the record the second derivative jumps to zero.
        assert!(
            time == 1.5 || (effort - expected).abs() < 1e-9,
            "{time}: {effort}"
        );
    })
    .expect("it is driven");
}
