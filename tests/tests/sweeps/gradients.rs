//! Motions through configurations in which an equation vanishes with its gradient: no equation
//! depends on another there, and still more than one way leads on.

use holonom::joints::{ConstantVelocity, PointOnPlane, Prismatic, Revolute};
use holonom::prelude::*;
use holonom::{Heun, JointCoordinates, Rk4, Sample, Warning};
use holonom_tests::RunsBoth;

use holonom_tests::is_exhaustive;

/// A shaft that falls over until it points against the other, and on.
#[derive(Mechanism)]
#[mechanism(coordinates = "both", gravity = [0.3, 0.1, -1.0])]
struct Shaft {
    #[body(
        mass = 1.0,
        inertia = [0.8, 1.0, 0.5],
        position = [0.0, 0.0, 0.3],
        velocity = [0.36, -0.48, 0.0],
        angular_velocity = [1.6, 1.2, 0.0]
    )]
    shaft: Body,
    #[joint(between = [ground, shaft], point = [0.0, 0.0, 0.0], axis_i = [0.0, 0.0, 1.0], axis_j = [0.0, 0.0, 1.0])]
    joint: ConstantVelocity,
}

holonom::joint! {
    /// The point of `j` stays on one of two lines through the corner on `i`, perpendicular to two
    /// axes and to the axis of both.
    pub joint Crossing(i, j; corner: Point, point: Point, axis: Axis, first: Axis, second: Axis) {
        let to = j.point - i.corner;
        dot(i.axis, to);
        dot(i.first, to) * dot(i.second, to);
    }
}

/// A bead on its way to where two wires cross.
#[derive(Mechanism)]
#[mechanism(coordinates = "both", gravity = [0.0, 0.0, 0.0])]
struct Wires {
    #[body(mass = 1.0, position = [-0.5, 0.0, 0.0], velocity = [0.7, 0.0, 0.0])]
    bead: Particle,
    #[joint(
        between = [ground, bead],
        corner = [0.0, 0.0, 0.0],
        point = [-0.5, 0.0, 0.0],
        axis = [0.0, 0.0, 1.0],
        first = [0.6, 0.8, 0.0],
        second = [0.0, 1.0, 0.0]
    )]
    wires: Crossing,
}

/// Whether the report of a run warns that it passed this joint; `None` of a run that ends with an
/// error, which says so as well.
fn is_told<M, F, I>(
    model: &M,
    (method, integrator): (F, I),
    (is_projected, by_joints): (bool, bool),
    (duration, expected): (f64, &str),
) -> Option<bool>
where
    M: JointCoordinates,
    F: Formulation<f64>,
    I: RunsBoth<M, F>,
{
    let mut simulation = Simulation::new(model, method, integrator);
    if is_projected {
        simulation = simulation.projection(Projection::default());
    }
    let seen = |_: &Sample<'_, f64, M>| ControlFlow::Continue(());
    let outcome = if by_joints {
        let simulation = simulation.joint_coordinates();
        simulation.run(0.0..=duration, every(duration), seen)
    } else {
        let simulation = simulation.absolute_coordinates();
        simulation.run(0.0..=duration, every(duration), seen)
    };
    let what =
        format!("{method:?}, {integrator:?}, projected: {is_projected}, by joints: {by_joints}");
    match outcome {
        Ok(report) => {
            println!("{what}: {}", report.warnings());
            // In joint coordinates the pivot of a single row tells as well.
            Some(report.warnings().into_iter().any(|warning| match warning {
                Warning::Vanishing { joint, .. } => joint == expected,
                Warning::NearlySingular { joint, .. } => by_joints && joint == expected,
                _ => false,
            }))
        }
        Err(error) => {
            println!("{what}: {error}");
            None
        }
    }
}

/// In both descriptions, with and without a projection, at tolerances and steps.
fn sweep<M: JointCoordinates, F: Formulation<f64>>(
    model: &M,
    method: F,
    (duration, joint): (f64, &str),
    expected: bool,
) {
    let mut through = 0;
    let mut check = |told: Option<bool>| {
        through += usize::from(told.is_some());
        assert_eq!(told.unwrap_or(true), expected);
    };
    for by_joints in [false, true] {
        for is_projected in [false, true] {
            let how = (is_projected, by_joints);
            let run = (duration, joint);
            for exponent in (4..=11).step_by(if is_exhaustive() { 1 } else { 3 }) {
                let relative = 10.0_f64.powi(-exponent);
                let absolute = 1e-2 * relative;
                let integrator = DormandPrince::new(Tolerance { relative, absolute });
                let integrator = integrator.budget(200_000);
                check(is_told(model, (method, integrator), how, run));
            }
            check(is_told(model, (method, Rk4::every(1e-2)), how, run));
            if is_exhaustive() {
                check(is_told(model, (method, Rk4::every(1e-3)), how, run));
                check(is_told(model, (method, Heun::every(1e-3)), how, run));
            }
        }
    }
    assert!(
        through > 4,
        "most runs end with an error: {through} came through"
    );
}

fn with_every_formulation<M: JointCoordinates>(model: &M, run: (f64, &str), expected: bool) {
    sweep(model, StandardLagrange, run, expected);
    sweep(model, Baumgarte::default(), run, expected);
    sweep(model, Penalty::default(), run, expected);
    sweep(model, AugmentedLagrangian::default(), run, expected);
}

#[test]
fn shafts_against_each_other_are_told() {
    with_every_formulation(&Shaft::default(), (5.0, "joint"), true);
}

/// A third of a turn on, the shafts have not come near to where they point against each other.
#[test]
fn shafts_at_an_angle_are_not_warned_of() {
    with_every_formulation(&Shaft::default(), (1.1, "joint"), false);
}

#[test]
fn a_crossing_of_wires_is_told() {
    with_every_formulation(&Wires::default(), (1.5, "wires"), true);
}

/// The gradient is compared with what it comes to be later.
#[test]
fn a_start_near_the_crossing_is_told() {
    for place in [1e-4, -1e-3] {
        let wires = Wires::default();
        let mut state = wires.described_state().expect("it is consistent");
        let mut pose = Wires::pose(&state, Wires::HANDLES.bead);
        pose.position.x = place;
        Wires::set_pose(&mut state, Wires::HANDLES.bead, pose);
        let simulation = Simulation::new(&wires, StandardLagrange, Rk4::every(0.01));
        let simulation = simulation.initial_state(state);
        let report = simulation.run(0.0..=1.0, every(1.0), |_| ControlFlow::Continue(()));
        let warnings = report.expect("nothing stops it").warnings();
        let is_told = |warning| matches!(warning, Warning::Vanishing { joint: "wires", .. });
        assert!(warnings.into_iter().any(is_told), "{place}: {warnings}");
    }
}

/// A wheel that turns evenly: nothing is singular, however far a step turns it and whatever it
/// makes of Euler parameters.
#[derive(Mechanism)]
#[mechanism(coordinates = "both", gravity = [0.0, 0.0, 0.0])]
struct Wheel {
    #[body(mass = 1.0, inertia = [0.2, 0.2, 0.3], angular_velocity = [0.0, 0.0, 10.0])]
    wheel: Body,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
}

#[test]
fn steps_of_some_radians_pass_nothing_singular() {
    let wheel = Wheel::default();
    for by_joints in [false, true] {
        for step in [0.1, 0.3, 1.0, 10.0] {
            let simulation = Simulation::new(&wheel, StandardLagrange, Rk4::every(step));
            let seen = |_: &Sample<'_, f64, Wheel>| ControlFlow::Continue(());
            let outcome = if by_joints {
                let simulation = simulation.joint_coordinates();
                simulation.run(0.0..=100.0, every(100.0), seen)
            } else {
                simulation.run(0.0..=100.0, every(100.0), seen)
            };
            let report = outcome.expect("nothing stops it");
            println!("{step}: {}", report.warnings());
            let is_false = |warning| {
                matches!(
                    warning,
                    Warning::Vanishing { .. } | Warning::NearlySingular { .. }
                )
            };
            assert!(!report.warnings().into_iter().any(is_false), "{step}");
        }
    }
}

holonom::joint! {
    /// The point of `j` stays on a circle about the centre on `i`, or on a line through the corner,
    /// and that of `k` in its plane: one equation of vectors.
    pub joint CircleOrLine(i, j, k; corner: Point, centre: Point, point: Point, other: Point, axis: Axis, first: Axis) {
        [
            (squared(j.point - i.centre) - initial(squared(j.point - i.centre))) * dot(i.first, j.point - i.corner),
            dot(i.axis, j.point - i.corner),
            dot(i.axis, k.other - i.corner)
        ];
    }
}

/// A bead on its way to where the line crosses the circle, beside one that only slides.
#[derive(Mechanism)]
#[mechanism(coordinates = "both", gravity = [0.0, 0.0, 0.0])]
struct Beads {
    #[body(mass = 1.0, position = [0.6, -0.8, 0.0], velocity = [0.8, 0.6, 0.0])]
    bead: Particle,
    #[body(mass = 1.0, position = [0.0, 2.0, 0.0], velocity = [0.0, 0.3, 0.0])]
    other: Particle,
    #[joint(
        between = [ground, bead, other],
        corner = [1.0, 0.0, 0.0],
        centre = [0.0, 0.0, 0.0],
        point = [0.6, -0.8, 0.0],
        other = [0.0, 2.0, 0.0],
        axis = [0.0, 0.0, 1.0],
        first = [0.6, 0.8, 0.0]
    )]
    track: CircleOrLine,
}

/// One row of a vector equation hides behind the others.
#[test]
fn a_row_of_a_vector_equation_is_told() {
    with_every_formulation(&Beads::default(), (1.5, "track"), true);
}

/// The crossing of wires, and something a hundred metres away.
#[derive(Mechanism)]
#[mechanism(coordinates = "both", gravity = [0.0, 0.0, 0.0])]
struct FarWires {
    #[body(mass = 1.0, position = [-0.5, 0.0, 0.0], velocity = [0.7, 0.0, 0.0])]
    bead: Particle,
    #[body(mass = 1.0, position = [100.0, 0.0, 0.0])]
    far: Particle,
    #[joint(
        between = [ground, bead],
        corner = [0.0, 0.0, 0.0],
        point = [-0.5, 0.0, 0.0],
        axis = [0.0, 0.0, 1.0],
        first = [0.6, 0.8, 0.0],
        second = [0.0, 1.0, 0.0]
    )]
    wires: Crossing,
    #[joint(between = [ground, far], point = [100.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0])]
    plane: PointOnPlane,
}

/// Of a mechanism that is large a small part is monitored as if it were alone.
#[test]
fn something_far_away_hides_nothing() {
    with_every_formulation(&FarWires::default(), (1.5, "wires"), true);
}

/// Two bodies that slide apart on a rail: the arms of its equations grow without end.
#[derive(Mechanism)]
#[mechanism(coordinates = "both", gravity = [0.0, 0.0, 0.0])]
struct Rail {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], velocity = [-1.0, 0.0, 0.0])]
    a: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.2, 0.0, 0.0], velocity = [1.0, 0.0, 0.0])]
    b: Body,
    #[joint(between = [a, b], point = [0.2, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    slide: Prismatic,
}

#[test]
fn arms_that_grow_are_not_warned_of() {
    sweep(&Rail::default(), StandardLagrange, (30.0, "slide"), false);
}
