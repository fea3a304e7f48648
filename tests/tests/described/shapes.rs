//! Bodies by shapes, whose dimensions are known at run time: they move as those whose numbers were
//! worked out by hand.

use core::f64::consts::PI;

use holonom::View;
use holonom::joints::{Revolute, Spherical};
use holonom::mechanism::ShapeKind;
use holonom::nalgebra::{Quaternion, UnitQuaternion, Vector3};
use holonom::prelude::*;

use crate::descriptions::both;

/// A crane of a round boom and a bar: lengths, thickness, direction and density are parameters.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Drawn {
    #[param(like = 0.7)]
    long: f64,
    #[param(like = 0.03)]
    thin: f64,
    #[param(like = 0.2)]
    fall: f64,
    #[param]
    density: f64,
    #[body(
        shape = cylinder(radius = thin, from = [0.0, 0.0, 0.0], to = [long, 0.0, 0.0]),
        density = density
    )]
    boom: Body,
    #[body(
        shape = bar(width = thin, height = 2.0 * thin, from = [long, 0.0, 0.0], to = [long + 0.5 * fall, 0.0, -fall]),
        mass = 0.8
    )]
    bar: Body,
    #[joint(between = [ground, boom], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    pivot: Revolute,
    #[joint(between = [boom, bar], point = [long, 0.0, 0.0])]
    hook: Spherical,
}

/// The same with the numbers of `LONG` and the others.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Computed {
    #[body(
        mass = MASS,
        inertia = [0.5 * MASS * THIN * THIN, ACROSS, ACROSS],
        position = [0.5 * LONG, 0.0, 0.0]
    )]
    boom: Body,
    #[body(
        mass = 0.8,
        inertia = [0.8 / 12.0 * 5.0 * THIN * THIN, 0.8 / 12.0 * (4.0 * THIN * THIN + REACH), 0.8 / 12.0 * (THIN * THIN + REACH)],
        position = [LONG + 0.25 * FALL, 0.0, -0.5 * FALL],
        // From x to (1, 0, -2): about y by the arc of tangent 2.
        orientation = [1.0, 0.0, 0.618_033_988_749_894_9, 0.0]
    )]
    bar: Body,
    #[joint(between = [ground, boom], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    pivot: Revolute,
    #[joint(between = [boom, bar], point = [LONG, 0.0, 0.0])]
    hook: Spherical,
}

/// A hammer with a hole in its head.
#[derive(Mechanism)]
struct Several {
    #[body(shapes = [
        rod(radius = 0.01, from = [0.0, 0.0, 0.0], to = [0.0, 0.3, 0.0]),
        ball(radius = 0.04, at = [0.0, 0.3, 0.0]),
        ball(radius = 0.02, at = [0.0, 0.3, 0.0], density = -700.0),
    ], density = 700.0, orientation = rpy(0.3, -0.8, 1.9), free)]
    hammer: Body,
}

const LONG: f64 = 0.65;
const THIN: f64 = 0.025;
const FALL: f64 = 0.3;
const MASS: f64 = 700.0 * PI * THIN * THIN * LONG;
const ACROSS: f64 = MASS * (THIN * THIN / 4.0 + LONG * LONG / 12.0);
/// The square of the bar's length.
const REACH: f64 = 1.25 * FALL * FALL;

/// Where both bodies are, how fast, and their energies, at some times.
fn course<M: Mechanism>(mechanism: &M, bodies: [holonom::BodyHandle<M>; 2]) -> Vec<f64> {
    let mut course = Vec::new();
    let simulation = Simulation::new(mechanism, StandardLagrange, Rk4::every(1e-3));
    let report = simulation
        .absolute_coordinates()
        .run(0.0..=1.0, every(0.1), |sample| {
            for body in bodies {
                course.extend(sample.pose(body).position.iter());
                course.extend(sample.velocity(body).iter());
            }
            course.extend([sample.kinetic_energy(), sample.potential_energy()]);
        });
    report.expect("regular");
    course
}

fn drawn() -> Drawn {
    Drawn::new(LONG, THIN, FALL, 700.0).expect("acceptable")
}

#[test]
fn dimensions_that_are_known_at_run_time() {
    let drawn = drawn();
    let [boom, bar] = [Drawn::HANDLES.boom, Drawn::HANDLES.bar];
    let found = course(&drawn, [boom, bar]);
    let [boom, bar] = [Computed::HANDLES.boom, Computed::HANDLES.bar];
    let wanted = course(&Computed::default(), [boom, bar]);
    assert!(found.len() == 11 * 14, "{}", found.len());
    for (found, wanted) in found.iter().zip(&wanted) {
        assert!((found - wanted).abs() < 1e-10, "{found} beside {wanted}");
    }
}

#[test]
fn shapes_by_joints() {
    let (drawn, handles) = (drawn(), Drawn::HANDLES);
    let start = drawn.described_state().expect("described");
    both(&drawn, StandardLagrange, start, 1e-8, |sample| {
        let mut values: Vec<f64> = sample.pose(handles.bar).position.iter().copied().collect();
        values.extend(sample.pose(handles.boom).position.iter());
        values.push(sample.kinetic_energy());
        values
    });
}

/// What is drawn of bodies: sizes as they are given, places from their centres of mass.
#[test]
fn shapes_of_the_report() {
    let [boom, bar] = Drawn::REPORT.shapes else {
        panic!("two shapes: {:?}", Drawn::REPORT.shapes);
    };
    assert_eq!((boom.body, bar.body), (0, 1));
    assert_eq!(
        [boom.kind, bar.kind],
        [ShapeKind::Cylinder, ShapeKind::Block]
    );
    assert_eq!((boom.centre, boom.axes), ([0.0; 3], [1.0, 0.0, 0.0, 0.0]));
    let drawn = drawn();
    let constants = drawn.constants::<f64>().expect("acceptable");
    let state = drawn.described_state::<f64>().expect("described");
    let view = View::<f64, Drawn>::new(&constants, 0.0, &state);
    assert_eq!(view.shape(0), [LONG, THIN, 0.0]);
    let [long, width, height] = view.shape(1);
    assert_eq!([width, height], [THIN, 2.0 * THIN]);
    assert!((long * long - REACH).abs() < 1e-15);
    assert_eq!(view.shape(2), [0.0; 3]);

    // Of one body of several: a ball on a rod of a third of its mass, in turned axes.
    let [rod, ball, hole] = Several::REPORT.shapes else {
        panic!("three shapes: {:?}", Several::REPORT.shapes);
    };
    let several = Several::default();
    let state = several.described_state::<f64>().expect("described");
    let pose = Several::pose(&state, Several::HANDLES.hammer);
    let turn = UnitQuaternion::new_normalize(pose.orientation);
    for (shape, wanted) in [
        (rod, [0.0, 0.15, 0.0]),
        (ball, [0.0, 0.3, 0.0]),
        (hole, [0.0, 0.3, 0.0]),
    ] {
        let centre = pose.position + turn * Vector3::from(shape.centre);
        assert!((centre - Vector3::from(wanted)).norm() < 1e-15, "{centre}");
    }
    let [w, i, j, k] = rod.axes;
    let axes = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k));
    let along = turn * (axes * Vector3::x());
    assert!((along - Vector3::y()).norm() < 1e-15, "{along}");
    assert!(hole.is_hole && !ball.is_hole);
}

/// What a parameter makes impossible is refused by the name of what follows from it.
#[test]
fn a_density_that_is_none() {
    let said = Drawn::new(LONG, THIN, FALL, -1.0).map(|_| ());
    let said = said.expect_err("no body").to_string();
    assert!(said.contains("boom") && said.contains("mass"), "{said}");
}
