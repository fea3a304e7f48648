//! Values with which what was decided does not hold.

use holonom::joints::{AngleDriver, Distance, PointOnPlane, Revolute};
use holonom::prelude::*;
use holonom::{ParameterError, Stepper, error::ParameterFault};

/// A four-bar whose last hinge may lean and whose coupler may stand out of the plane.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "joints")]
struct Leaning {
    #[param(like = [0.25, 0.9, 0.6, 0.9])]
    lengths: [f64; 4],
    #[param(like = 0.0)]
    lean: f64,
    #[param(like = 0.0)]
    height: f64,
    #[param]
    mass: f64,
    #[input]
    wind: f64,
    #[body(mass = mass, inertia = [0.0026, 1e-5, 0.0026], position = [0.0, 0.5 * lengths[0], 0.0])]
    crank: Body,
    #[body(mass = 1.6, inertia = [1e-5, 0.0853, 0.0853], position = [0.5 * lengths[1], lengths[0], 0.0])]
    coupler: Body,
    #[body(mass = 1.2, inertia = [0.036, 1e-5, 0.036], position = [lengths[3], 0.5 * lengths[2], 0.0])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    o: Revolute,
    #[joint(between = [crank, coupler], point = [0.0, lengths[0], 0.0], axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(
        between = [coupler, rocker],
        point = local([0.5 * lengths[1], 0.0, height], [0.0, 0.5 * lengths[2], 0.0]),
        axis = [0.0, 0.0, 1.0]
    )]
    b: Revolute,
    #[joint(between = [ground, rocker], point = [lengths[3], 0.0, 0.0], axis = [lean, 0.0, 1.0])]
    c: Revolute,
}

const LENGTHS: [f64; 4] = [0.25, 0.9, 0.6, 0.9];

fn leaning(lengths: [f64; 4], lean: f64, height: f64) -> Result<Leaning, ParameterError> {
    Leaning::new(lengths, lean, height, 0.5)
}

#[test]
fn what_makes_the_loop_spatial_is_refused() {
    assert!(leaning(LENGTHS, 0.0, 0.0).is_ok());
    for lean in [1.0, -0.1, 1e-3, 1e-5] {
        let error = leaning(LENGTHS, lean, 0.0).err().expect("it leans");
        assert_eq!(error.field, "lean", "{lean}: {error}");
        assert!(!joint(&error).is_empty(), "{error}");
    }
    for height in [0.3, -0.01, 1e-5] {
        let error = leaning(LENGTHS, 0.0, height).err().expect("it stands out");
        assert_eq!(error.field, "height", "{height}: {error}");
        assert!(!joint(&error).is_empty(), "{error}");
    }
    // Round-off is no angle.
    assert!(leaning(LENGTHS, 1e-16, -1e-15).is_ok());
}

/// The joint that an error names.
fn joint(error: &ParameterError) -> &'static str {
    match error.fault {
        ParameterFault::NotAssembled { joint }
        | ParameterFault::Dependent { joint }
        | ParameterFault::Independent { joint } => joint,
        _ => "",
    }
}

#[test]
fn what_cannot_be_assembled_is_refused_by_its_name() {
    for (place, length) in [
        (0, 3.0),
        (1, 0.04),
        (1, 4.0),
        (2, 5.0),
        (3, 2.0),
        (3, 1e6),
        (3, 1e30),
    ] {
        let mut lengths = LENGTHS;
        lengths[place] = length;
        let error = leaning(lengths, 0.0, 0.0).err().expect("out of reach");
        assert_eq!(error.field, format!("lengths[{place}]"), "{error}");
        assert!(
            matches!(error.fault, ParameterFault::NotAssembled { .. }),
            "{error}"
        );
        assert!(!joint(&error).is_empty(), "{error}");
        let text = error.to_string();
        assert!(
            text.contains("cannot be assembled") && text.contains(error.field),
            "{text}"
        );
    }
    // No length alone would mend it: the one that is farthest from what it is like.
    let error = leaning([0.25, 0.3, 0.2, 5.0], 0.0, 0.0)
        .err()
        .expect("out of reach");
    assert_eq!(error.field, "lengths[3]");
}

#[test]
fn what_is_refused_without_likes_is_refused_first() {
    let error = Leaning::new(LENGTHS, 0.0, 0.0, -0.5)
        .err()
        .expect("a negative mass");
    assert_eq!(
        (error.field, error.fault),
        ("crank", ParameterFault::NotPositive)
    );
    for value in [f64::NAN, f64::INFINITY] {
        let error = leaning([0.25, value, 0.6, 0.9], 0.0, 0.0)
            .err()
            .expect("no number");
        assert_eq!(
            (error.field, error.fault),
            ("lengths[1]", ParameterFault::NotFinite)
        );
    }
}

#[test]
fn a_field_that_was_changed_is_looked_at_again() -> Result<(), Fault> {
    let mut linkage = leaning(LENGTHS, 0.0, 0.0)?;
    let mut state = linkage.described_state::<f64>()?;
    linkage.assemble(0.0, &mut state)?;
    let mut stepper = Stepper::new(&linkage, StandardLagrange, Rk4)?.absolute_coordinates();
    stepper.step(&mut state, 1e-3)?;
    // Inputs and masses are no business of the constraints.
    linkage.wind = 1.0;
    linkage.mass = 0.7;
    stepper.update(&linkage)?;
    linkage.lean = 0.2;
    let refused = stepper.update(&linkage);
    assert!(matches!(
        refused,
        Err(Fault::Parameter(ParameterError { field: "lean", .. }))
    ));
    assert!(linkage.stepper(StandardLagrange, Rk4).is_err());
    // The former parameters stay.
    stepper.step(&mut state, 1e-3)?;
    linkage.lean = 0.0;
    linkage.lengths[3] = 0.905;
    stepper.update(&linkage)
}

/// A parallelogram with two motors, which have to agree.
#[derive(Mechanism)]
#[mechanism(redundant = "drop")]
struct Motors {
    #[param(like = [1.0, 1.0])]
    speeds: [f64; 2],
    #[param(like = 0.5)]
    crank: f64,
    #[body(mass = 1.0, inertia = [0.02, 1e-3, 0.02], position = [0.0, 0.25, 0.0])]
    left: Body,
    #[body(mass = 1.0, inertia = [1e-3, 0.1, 0.1], position = [0.5, 0.5, 0.0])]
    bar: Body,
    #[body(mass = 1.0, inertia = [0.02, 1e-3, 0.02], position = [1.0, 0.25, 0.0])]
    right: Body,
    #[joint(between = [ground, left], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    o: Revolute,
    #[joint(between = [left, bar], point = local([0.0, crank - 0.25, 0.0], [-0.5, 0.0, 0.0]), axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(between = [bar, right], point = [1.0, 0.5, 0.0], axis = [0.0, 0.0, 1.0])]
    b: Revolute,
    #[joint(between = [ground, right], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    c: Revolute,
    #[joint(between = [ground, left], axis = [0.0, 0.0, 1.0], motion = speeds[0] * time)]
    first: AngleDriver,
    #[joint(between = [ground, right], axis = [0.0, 0.0, 1.0], motion = speeds[1] * time)]
    second: AngleDriver,
}

#[test]
fn motors_that_part_later_are_refused() {
    assert_eq!(Motors::REPORT.degrees_of_freedom, 0);
    assert!(Motors::new([2.0, 2.0], 0.5).is_ok());
    assert!(Motors::new([-0.3, -0.3], 0.5).is_ok());
    let error = Motors::new([1.0, 1.01], 0.5).err().expect("they part");
    assert_eq!(error.field, "speeds[1]");
    assert!(!joint(&error).is_empty(), "{error}");
    // No parallelogram any more.
    let error = Motors::new([1.0, 1.0], 0.45).err().expect("they part");
    assert_eq!(error.field, "crank", "{error}");
}

/// A parallelogram of bars between particles, all in one line: singular where it is described, and
/// regular elsewhere.
#[derive(Mechanism)]
struct Flat {
    #[param(like = 1.0)]
    coupler: f64,
    #[body(mass = 1.0, position = [0.5, 0.0, 0.0])]
    b: Particle,
    #[body(mass = 1.0, position = [1.5, 0.0, 0.0])]
    c: Particle,
    #[joint(between = [ground, b], point = [0.5, 0.0, 0.0], normal = [0.0, 0.0, 1.0])]
    plane_b: PointOnPlane,
    #[joint(between = [ground, c], point = [1.5, 0.0, 0.0], normal = [0.0, 0.0, 1.0])]
    plane_c: PointOnPlane,
    #[joint(between = [ground, b], head = [0.0, 0.0, 0.0], tail = [0.5, 0.0, 0.0])]
    crank: Distance,
    #[joint(between = [b, c], head = [0.5, 0.0, 0.0], tail = [1.5, 0.0, 0.0], length = coupler)]
    rod: Distance,
    #[joint(between = [ground, c], head = [1.0, 0.0, 0.0], tail = [1.5, 0.0, 0.0])]
    rocker: Distance,
}

#[test]
fn a_start_that_is_singular_as_it_is_like_may_be_singular() {
    const { assert!(Flat::REPORT.rank.starts_singular()) };
    assert!(Flat::new(1.0).is_ok());
    assert!(Flat::new(0.9).is_ok());
    let error = Flat::new(2.5).err().expect("out of reach");
    assert_eq!(error.field, "coupler");
}
