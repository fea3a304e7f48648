//! Equations that hold upside down as well: assembly goes to the side that is meant, and a start on
//! the other one is refused.

use holonom::error::AssemblyFault;
use holonom::joints::{
    ConstantVelocity, Cylindrical, Fixed, Parallel1, Planar, Prismatic, Revolute, RevoluteRevolute,
    Screw,
};
use holonom::nalgebra::Quaternion;
use holonom::prelude::*;
use holonom::{BodyHandle, Warning};

holonom::joint! {
    /// Two axes that are parallel and point the same way.
    pub joint Aligned(i, j; axis: Axis) {
        dot(i.axis.normals(), j.axis);
        require dot(i.axis, j.axis) > 0;
    }
}

holonom::joint! {
    /// Two axes that are parallel, either way.
    pub joint InLine(i, j; axis: Axis) {
        dot(i.axis.normals(), j.axis);
    }
}

macro_rules! held {
    ($($name:ident: $joint:ident { $($attribute:tt)* })*) => {$(
        #[derive(Mechanism)]
        struct $name {
            #[body(mass = 1.0, inertia = [0.1, 0.12, 0.15], position = [1.0, 0.0, 0.0])]
            body: Body,
            #[joint(between = [ground, body], $($attribute)*)]
            joint: $joint,
        }
    )*};
}

held! {
    Welded: Fixed { point = [0.5, 0.0, 0.0] }
    Hinged: Revolute { point = [0.5, 0.0, 0.0], axis = [0.0, 0.0, 1.0] }
    Sliding: Prismatic { point = [0.5, 0.0, 0.0], axis = [1.0, 0.0, 0.0] }
    Sleeved: Cylindrical { point = [0.5, 0.0, 0.0], axis = [1.0, 0.0, 0.0] }
    Flat: Planar { point = [0.5, 0.0, 0.0], normal = [0.0, 0.0, 1.0] }
    Screwed: Screw { point = [0.5, 0.0, 0.0], axis = [1.0, 0.0, 0.0], pitch = 0.01 }
    Linked: RevoluteRevolute { first = [0.5, 0.0, 0.0], second = [0.7, 0.0, 0.0], axis = [0.0, 0.0, 1.0] }
    Coupled: ConstantVelocity { point = [0.5, 0.0, 0.0], axis_i = [1.0, 0.0, 0.0], axis_j = [1.0, 0.0, 0.0] }
    Kept: Parallel1 { axis_i = [0.0, 0.0, 1.0], axis_j = [0.0, 0.0, 1.0] }
    Opposed: Parallel1 { axis_i = [0.0, 0.0, 1.0], axis_j = [0.0, 0.0, -1.0] }
    OwnAligned: Aligned { axis = [0.0, 0.0, 1.0] }
    OwnInLine: InLine { axis = [0.0, 0.0, 1.0] }
}

fn turned(axis: [f64; 3], degrees: f64) -> Quaternion<f64> {
    let (sine, cosine) = (0.5 * degrees.to_radians()).sin_cos();
    let [x, y, z] = axis;
    let size = (x * x + y * y + z * z).sqrt();
    Quaternion::new(cosine, x * sine / size, y * sine / size, z * sine / size)
}

/// Where the joint says its side is, after an assembly from turned positions of the body; the least
/// of all.
fn side<M: MechanismExt + Default>(body: BodyHandle<M>) -> f64 {
    let kind = M::REPORT.joints[0].kind;
    let mechanism = M::default();
    let constants = mechanism.constants::<f64>().expect("literals");
    let mut least = f64::INFINITY;
    for axis in [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.6, 0.0, 0.8],
        [1.0, 1.0, 1.0],
        [-0.3, 0.5, 0.2],
    ] {
        for degrees in [20.0, 80.0, 91.0, 100.0, 130.0, 150.0, 170.0, 180.0] {
            let mut state = mechanism.described_state::<f64>().expect("literals");
            let mut pose = M::pose(&state, body);
            pose.orientation = turned(axis, degrees);
            M::set_pose(&mut state, body, pose);
            let found = mechanism.assemble(0.0, &mut state);
            let found =
                found.unwrap_or_else(|fault| panic!("{kind}, {axis:?}, {degrees}: {fault}"));
            assert!(found.violation_after < 1e-20, "{kind}, {axis:?}, {degrees}");
            least = least.min(M::joint_side(&constants, &state, 0));
        }
    }
    least
}

#[test]
fn assembly_goes_to_the_side_that_is_meant() {
    for (name, side) in [
        ("Fixed", side(Welded::HANDLES.body)),
        ("Revolute", side(Hinged::HANDLES.body)),
        ("Prismatic", side(Sliding::HANDLES.body)),
        ("Cylindrical", side(Sleeved::HANDLES.body)),
        ("Planar", side(Flat::HANDLES.body)),
        ("Screw", side(Screwed::HANDLES.body)),
        ("RevoluteRevolute", side(Linked::HANDLES.body)),
        ("Parallel1", side(Kept::HANDLES.body)),
        ("Parallel1, opposite", side(Opposed::HANDLES.body)),
        ("own", side(OwnAligned::HANDLES.body)),
    ] {
        assert!((side - 1.0).abs() < 1e-9, "{name}: {side}");
    }
    // Shafts at an angle are less than straight.
    assert!(side(Coupled::HANDLES.body) > 0.0);
    // A joint that says nothing has no side.
    assert_eq!(side(OwnInLine::HANDLES.body), 1.0);
}

/// A run from the body turned by half a turn about y.
fn upside_down<M: MechanismExt + Default>(
    body: BodyHandle<M>,
    accept: bool,
) -> Result<RunReport<f64, M>, Fault> {
    let mechanism = M::default();
    let mut state = mechanism.described_state::<f64>().expect("literals");
    let mut pose = M::pose(&state, body);
    pose.orientation = turned([0.0, 1.0, 0.0], 180.0);
    M::set_pose(&mut state, body, pose);
    let mut run =
        Simulation::new(&mechanism, StandardLagrange, Rk4::every(0.01)).initial_state(state);
    if accept {
        run = run.inconsistent_start();
    }
    run.run(0.0..=0.1, every(0.1), |_| ControlFlow::Continue(()))
        .map_err(|error| error.fault)
}

#[test]
fn a_start_upside_down_is_refused_by_name_or_warned_of() {
    let fault = upside_down(OwnAligned::HANDLES.body, false).expect_err("upside down");
    assert_eq!(
        fault,
        Fault::Assembly(AssemblyFault::WrongSide { joint: "joint" })
    );
    assert!(
        fault
            .to_string()
            .starts_with("joint `joint` is upside down")
    );
    let report = upside_down(OwnAligned::HANDLES.body, true).expect("it runs");
    let mut warnings = report.warnings().into_iter();
    assert!(warnings.any(|warning| matches!(warning, Warning::WrongSide { joint: "joint", .. })));
    let report = upside_down(OwnInLine::HANDLES.body, false).expect("either way is meant");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

/// A hinge with axes that are given body by body, and point opposite ways as described.
#[derive(Mechanism)]
struct Turned {
    #[body(mass = 1.0, inertia = [0.1, 0.12, 0.15], position = [1.0, 0.0, 0.0])]
    body: Body,
    #[joint(
        between = [ground, body], point = [0.5, 0.0, 0.0], axis = local([0.0, 0.0, 1.0], [0.0, 0.0, -1.0])
    )]
    hinge: Revolute,
}

#[test]
fn what_is_described_upside_down_is_turned_over() {
    let mechanism = Turned::default();
    let constants = mechanism.constants::<f64>().expect("literals");
    let mut state = mechanism.described_state::<f64>().expect("literals");
    assert!(Turned::joint_side(&constants, &state, 0) < -0.99);
    let correction = mechanism.assemble(0.0, &mut state).expect("it is turned");
    assert!(Turned::joint_side(&constants, &state, 0) > 0.99);
    assert!(correction.violation_after < 1e-20);
    let moved = correction.moved.expect("of an assembly");
    assert_eq!((moved.body, moved.joint), ("body", Some("hinge")));
}

/// An arm with a tool that is welded on.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Arm {
    #[body(mass = 1.0, inertia = [0.1, 0.01, 0.1], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.12, 0.15], position = [0.3, 1.0, 0.0])]
    tool: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [rod, tool], point = [0.0, 1.0, 0.0])]
    weld: Fixed,
}

#[test]
fn both_descriptions_go_one_way_from_a_tool_that_is_described_beyond_a_right_angle() {
    let arm = Arm::default();
    let handles = Arm::HANDLES;
    let mut state = arm.described_state::<f64>().expect("literals");
    let mut pose = Arm::pose(&state, handles.tool);
    pose.orientation = turned([0.0, 0.0, 1.0], 100.0);
    Arm::set_pose(&mut state, handles.tool, pose);
    let run = Simulation::new(&arm, StandardLagrange, Rk4::every(0.001))
        .initial_state(state)
        .assembled();
    let end = |report: RunReport<f64, Arm>| Arm::pose(&report.state, handles.tool).position;
    let on = |_: &Sample<'_, f64, Arm>| ControlFlow::Continue(());
    let bodies = end(run.run(0.0..=0.5, every(0.5), on).expect("assembled"));
    let joints = end(run
        .joint_coordinates()
        .run(0.0..=0.5, every(0.5), on)
        .expect("assembled"));
    assert!((bodies - joints).norm() < 1e-6, "{bodies} {joints}");
    // The tool is held as described, 0.3 m beside the end of the rod.
    assert!((bodies.x - 0.3).abs() < 1e-9);
}
