//! Symbols of joints: where they are, and that gears mesh.

mod reading;

use std::error::Error;
use std::f64::consts::TAU;

use holonom::nalgebra::Vector3;
use holonom::prelude::*;
use holonom_film::Film;
use holonom_models::SqueezingMechanism;
use serde_json::Value;

use crate::reading::{Page, vector};

/// How far a direction is beyond a tooth of a wheel, in teeth, about an axis.
fn phase(
    page: &Page,
    frame: usize,
    wheel: &Value,
    towards: Vector3<f64>,
    axis: Vector3<f64>,
) -> f64 {
    let (tooth, _) = page.global(frame, wheel, "tooth");
    let sine = tooth.cross(&towards).dot(&axis);
    sine.atan2(tooth.dot(&towards)) * wheel["teeth"].as_f64().expect("a number") / TAU
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// The distance to the next whole number.
fn off(teeth: f64) -> f64 {
    (teeth - teeth.round()).abs()
}

/// A crank with a hand on a universal joint, as it is described and elsewhere.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Hand {
    #[body(
        mass = 1.0,
        inertia = [[0.02, 0.001, 0.0], [0.001, 0.03, 0.002], [0.0, 0.002, 0.04]],
        position = [0.2, 0.0, 0.0],
        orientation = rpy(0.1, 0.2, 0.3),
    )]
    crank: Body,
    #[body(mass = 0.5, inertia = [0.01, 0.02, 0.01], position = [0.5, 0.1, 0.0])]
    hand: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    foot: Revolute,
    #[joint(between = [crank, hand], point = [0.4, 0.0, 0.0], axis_i = [0.0, 1.0, 0.0], axis_j = [0.0, 0.0, 1.0])]
    wrist: Universal,
    #[force(between = [ground, crank], axis = [0.0, 1.0, 0.0], stiffness = 2.0)]
    spring: TorsionalSpringDamper,
}

#[test]
fn points_and_axes_are_those_of_the_bodies_whatever_the_first_frame_is()
-> Result<(), Box<dyn Error>> {
    let hand = Hand::default();
    let filmed = |first: f64| -> Result<Page, Box<dyn Error>> {
        let mut film = Film::new();
        hand.simulation(StandardLagrange, DormandPrince::default())
            .projection(Projection::default())
            .run(0.0..=1.0, every(0.05), |sample| {
                if sample.time() >= first {
                    film.record(sample);
                }
            })?;
        Ok(Page::new(&film.html()?))
    };
    let (whole, part) = (filmed(0.0)?, filmed(0.5)?);
    assert!(part.frames() < whole.frames());
    let markers = || whole.list("markers").iter().zip(part.list("markers"));
    assert!(markers().count() > 8);
    for (expected, found) in markers() {
        for key in ["element", "place", "body", "name", "kind"] {
            assert_eq!(expected[key], found[key]);
        }
        let apart = (vector(&expected["at"]) - vector(&found["at"])).norm();
        assert!(apart < 1e-6, "{expected} {found}");
    }
    // The spring has no point: it is where the hinge is.
    let anchor = part
        .list("markers")
        .iter()
        .find(|marker| marker["kind"] == "anchor");
    let anchor = anchor.expect("of the spring");
    assert_eq!(
        (&anchor["element"], vector(&anchor["at"])),
        (&2.into(), Vector3::zeros())
    );
    Ok(())
}

/// The axes of a hinge meet in every frame, also if the first one is in the middle of a run.
#[test]
fn hinges_stay_closed_from_any_first_frame() -> Result<(), Box<dyn Error>> {
    let mut film = Film::new();
    Simulation::new(
        &SqueezingMechanism::default(),
        StandardLagrange,
        DormandPrince::default(),
    )
    .run(0.0..=0.03, every(0.003), |sample| {
        if sample.time() > 0.01 {
            film.record(sample);
        }
    })?;
    let page = Page::new(&film.html()?);
    for (index, element) in page.list("elements").iter().enumerate() {
        if element["kind"] != "Revolute" {
            continue;
        }
        let own = |kind: &'static str| {
            let markers = page.list("markers").iter();
            let own =
                markers.filter(move |marker| marker["element"] == index && marker["kind"] == kind);
            own.collect::<Vec<_>>()
        };
        let ([a, b], [c, d]) = (&own("point")[..], &own("axis")[..]) else {
            panic!("{element}");
        };
        for frame in 0..page.frames() {
            let apart = page.global(frame, a, "at").1 - page.global(frame, b, "at").1;
            let askew = page.global(frame, c, "at").0 - page.global(frame, d, "at").0;
            assert!(
                apart.norm().max(askew.norm()) < 1e-6,
                "{element}: {apart} {askew}"
            );
        }
    }
    Ok(())
}

/// A sun of 24 teeth drives a carrier; its planet of 18 teeth runs inside a fixed ring of 60.
#[derive(Mechanism)]
struct Planetary {
    #[body(mass = 1.0, inertia = [0.001, 0.001, 0.002])]
    sun: Body,
    #[body(mass = 1.0, inertia = [0.01, 0.01, 0.02])]
    carrier: Body,
    #[body(mass = 0.5, inertia = [0.001, 0.001, 0.001], position = [0.042, 0.0, 0.0])]
    planet: Body,
    #[joint(between = [ground, sun], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    input: Revolute,
    #[joint(between = [ground, carrier], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    output: Revolute,
    #[joint(between = [carrier, planet], point = [0.042, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    #[joint(between = [sun, planet, carrier], axis_i = [0.0, 0.0, 1.0], axis_j = [0.0, 0.0, 1.0], ratio = -24.0 / 18.0)]
    outside: Gear,
    #[joint(between = [planet, ground, carrier], axis_i = [0.0, 0.0, 1.0], axis_j = [0.0, 0.0, 1.0], ratio = 18.0 / 60.0)]
    inside: Gear,
    #[joint(between = [ground, sun], axis = [0.0, 0.0, 1.0], motion = 7.0 * time)]
    motor: AngleDriver,
}

/// Wheels are as large as the ratios say, and a tooth meets a gap in every frame.
#[test]
fn gears_mesh_in_every_frame() -> Result<(), Box<dyn Error>> {
    let mut film = Film::new();
    KinematicAnalysis::new(&Planetary::default(), StandardLagrange).run(
        0.0..=2.0,
        every(0.1),
        // Not from the start: nothing of it is remembered.
        |sample| {
            if sample.time() > 0.35 {
                film.record(sample);
            }
        },
    )?;
    let page = Page::new(&film.html()?);
    let [sun, planet, ring] = page.list("wheels") else {
        panic!("three wheels: {:?}", page.list("wheels"));
    };
    for (wheel, radius, is_ring) in [
        (sun, 0.024, false),
        (planet, 0.018, false),
        (ring, 0.06, true),
    ] {
        assert!((number(&wheel["radius"]) - radius).abs() < 1e-6, "{wheel}");
        assert_eq!(wheel["isRing"], is_ring);
    }
    // The planet is one wheel of two pairs.
    assert_eq!(planet["elements"], serde_json::json!([3, 4]));
    let teeth = [sun, planet, ring].map(|wheel| number(&wheel["teeth"]));
    assert_eq!(3.0 * teeth[0], 4.0 * teeth[1]);
    assert_eq!(3.0 * teeth[2], 10.0 * teeth[1]);
    for frame in 0..page.frames() {
        let centre = |wheel| page.global(frame, wheel, "centre").1;
        let axis = Vector3::z();
        let out = (centre(planet) - centre(sun)).normalize();
        let meshes = phase(&page, frame, sun, out, axis) + phase(&page, frame, planet, -out, axis);
        assert!(
            off(meshes - 0.5) < 1e-3,
            "sun and planet, {frame}: {meshes}"
        );
        let meshes = phase(&page, frame, ring, out, axis) - phase(&page, frame, planet, out, axis);
        assert!(
            off(meshes - 0.5) < 1e-3,
            "planet and ring, {frame}: {meshes}"
        );
    }
    Ok(())
}

/// A pinion on a rack below it, and a pair of bevel gears. The pinion is not balanced.
#[derive(Mechanism)]
struct Workshop {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.02, 0.03, 0.0])]
    pinion: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, -0.1, 0.0])]
    rack: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.4, 0.0, -0.3])]
    shaft: Body,
    #[joint(between = [ground, pinion], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [ground, rack], point = [0.0, -0.1, 0.0], axis = [1.0, 0.0, 0.0])]
    guide: Prismatic,
    #[joint(between = [ground, shaft], point = [0.4, 0.0, -0.3], axis = [1.0, 0.0, 0.0])]
    seat: Revolute,
    #[joint(between = [pinion, rack, ground], axis = [0.0, 0.0, 1.0], hub = [0.0, 0.0, 0.0], point = [0.0, -0.1, 0.0], slide = [1.0, 0.0, 0.0], radius = 0.1)]
    teeth: RackAndPinion,
    #[joint(between = [pinion, shaft, ground], axis_i = [0.0, 0.0, 1.0], axis_j = [1.0, 0.0, 0.0], ratio = 0.75)]
    bevel: Gear,
    #[joint(between = [ground, pinion], axis = [0.0, 0.0, 1.0], motion = 2.0 * time)]
    motor: AngleDriver,
}

#[test]
fn a_rack_is_met_by_its_pinion_and_cones_have_one_apex() -> Result<(), Box<dyn Error>> {
    let mut film = Film::new();
    KinematicAnalysis::new(&Workshop::default(), StandardLagrange).run(
        0.0..=3.0,
        every(0.1),
        |sample| film.record(sample),
    )?;
    let page = Page::new(&film.html()?);
    let ([pinion, first, second], [rack]) = (page.list("wheels"), page.list("racks")) else {
        panic!("{:?}", page.list("wheels"));
    };
    assert!((number(&pinion["radius"]) - 0.1).abs() < 1e-6, "{pinion}");
    let pitch = number(&rack["pitch"]);
    for frame in 0..page.frames() {
        let hub = page.global(frame, pinion, "centre").1;
        let (along, tips) = (
            page.global(frame, rack, "along").0,
            page.global(frame, rack, "tips").0,
        );
        let from = page.global(frame, rack, "at").1;
        assert!(((hub - from).dot(&tips) - 0.1).abs() < 1e-6);
        // Where they meet, teeth of one are gaps of the other, which go the same way.
        let on_rack = (hub - from).dot(&along) / pitch;
        let axis = -tips.cross(&along).normalize();
        let on_pinion = phase(&page, frame, pinion, -tips, axis);
        let meshes = on_rack - on_pinion;
        assert!(off(meshes - 0.5) < 1e-3, "{frame}: {on_rack} {on_pinion}");
        let [low, high] = [0, 1].map(|end| number(&rack["teeth"][end]));
        assert!(low < on_rack - 2.0 && on_rack + 2.0 < high, "{rack}");
    }
    // `sin a / sin b = 0.75` of right angles, from an apex at (0, 0, -0.3).
    let ratio = number(&first["radius"]) / number(&second["radius"]);
    assert!((ratio - 0.75).abs() < 1e-6, "{ratio}");
    let apex = Vector3::new(0.0, 0.0, -0.3);
    let length = |wheel: &Value| {
        let far = (page.global(0, wheel, "centre").1 - apex).norm();
        far.hypot(number(&wheel["radius"]))
    };
    assert!((length(first) - length(second)).abs() < 1e-6);
    Ok(())
}
