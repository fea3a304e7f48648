//! Named points: where they are drawn, and their traces, in all that a film writes.

mod reading;

use std::error::Error;

use holonom::nalgebra::Vector3;
use holonom::prelude::*;
use holonom_film::{Film, Sketch};
use roxmltree::Document;

use crate::reading::Page;

/// A finger with a named tip.
#[derive(Assembly)]
struct Finger {
    #[port]
    palm: Body,
    #[param(like = 0.3)]
    length: f64,
    #[body(mass = 0.1, inertia = [0.001, 0.002, 0.003], position = [0.5, 0.1, 0.1], orientation = rpy(0.1, 0.2, 0.3))]
    bone: Body,
    #[joint(between = [palm, bone], point = [0.4, 0.1, 0.0], axis = [0.0, 1.0, 0.0])]
    knuckle: Revolute,
    #[point(on = bone, at = [0.4 + length, 0.1, 0.1])]
    tip: Point,
}

/// A hand that swings about z, with two fingers.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Hand {
    #[body(mass = 0.5, inertia = [[0.02, 0.001, 0.0], [0.001, 0.03, 0.002], [0.0, 0.002, 0.04]], position = [0.2, 0.0, 0.0], angular_velocity = [0.0, 0.0, 3.0], velocity = [0.0, 0.6, 0.0])]
    palm: Body,
    #[joint(between = [ground, palm], point = wall, axis = [0.0, 0.0, 1.0])]
    wrist: Revolute,
    #[point(on = ground, at = [0.0, 0.0, 0.0])]
    wall: Point,
    #[part(palm = palm)]
    right: Finger,
    #[part(palm = palm, mirror = y)]
    left: Finger,
}

type Result<T = ()> = std::result::Result<T, Box<dyn Error>>;

/// The film of a run with three traces, and where a tip was.
fn filmed() -> Result<(Film<Hand>, Vec<Vector3<f64>>)> {
    let (hand, h) = (
        Hand::new(Finger::new(0.25), Finger::new(0.2))?,
        Hand::HANDLES,
    );
    let (mut film, mut tips) = (Film::new(), Vec::new());
    film.trace(h.left.tip);
    film.trace(h.palm);
    film.trace(h.wall);
    Simulation::new(&hand, StandardLagrange, DormandPrince::default())
        .assembled()
        .run(0.0..=0.5, every(0.05), |sample| {
            film.record(sample);
            tips.push(sample.position(h.left.tip));
        })?;
    Ok((film, tips))
}

#[test]
fn a_mark_moves_as_its_point() -> Result {
    let (film, tips) = filmed()?;
    let page = Page::new(&film.html()?);
    let points = page.list("points");
    let names: Vec<&str> = points
        .iter()
        .filter_map(|point| point["name"].as_str())
        .collect();
    assert_eq!(names, ["wall", "right.tip", "left.tip"]);
    assert!(points[0]["body"].is_null());
    assert_eq!(page.frames(), tips.len());
    for (frame, tip) in tips.iter().enumerate() {
        let (_, drawn) = page.global(frame, &points[2], "at");
        assert!((drawn - tip).norm() < 1e-6, "{frame}: {drawn} {tip}");
    }
    assert!((tips[0] - tips[tips.len() - 1]).norm() > 0.1);
    Ok(())
}

/// What is traced has the name of its field; a point on the ground has no way.
#[test]
fn a_trace_has_the_name_of_its_point() -> Result {
    let (film, tips) = filmed()?;
    let page = Page::new(&film.html()?);
    let [tip, palm] = page.list("traces") else {
        panic!("two traces: {}", page.data["traces"]);
    };
    assert_eq!(
        (&tip["name"], &palm["name"]),
        (&"left.tip".into(), &"palm".into())
    );
    for (frame, at) in tips.iter().enumerate() {
        let (_, drawn) = page.global(frame, tip, "at");
        assert!((drawn - at).norm() < 1e-6, "{frame}: {drawn} {at}");
    }
    assert_eq!(palm["at"], serde_json::json!([0.0, 0.0, 0.0]));
    let svg = film.svg()?;
    let ways = Document::parse(&svg)?;
    assert_eq!(
        ways.descendants()
            .filter(|n| n.has_tag_name("polyline"))
            .count(),
        2
    );
    Ok(())
}

#[test]
fn a_sketch_names_its_points() -> Result {
    let hand = Hand::new(Finger::new(0.25), Finger::new(0.2))?;
    let sketch = hand.sketch()?;
    let document = Document::parse(&sketch)?;
    let marks = document
        .descendants()
        .filter(|node| node.attribute("class") == Some("point"));
    let named = marks.filter_map(|mark| mark.first_element_child()?.text());
    // Four views.
    assert_eq!(named.filter(|name| *name == "left.tip").count(), 4);
    let mut texts = document
        .descendants()
        .filter(|node| node.has_tag_name("text"));
    assert!(
        texts.any(|text| text.text() == Some("left.tip")),
        "a row of the table"
    );
    Ok(())
}

/// Empty nodes, to which a camera or a light may be bound.
#[test]
fn a_gltf_file_has_points_as_nodes() -> Result {
    let (film, tips) = filmed()?;
    let gltf::Gltf { document, .. } = gltf::Gltf::from_slice(film.gltf()?.as_bytes())?;
    let node = |name: &str| document.nodes().find(|node| node.name() == Some(name));
    let bone = node("left.bone").expect("a body");
    let children: Vec<_> = bone.children().collect();
    let [tip] = &children[..] else {
        panic!("one point on the bone: {}", children.len());
    };
    assert_eq!((tip.name(), tip.mesh().is_none()), (Some("left.tip"), true));
    let page = Page::new(&film.html()?);
    let (at, _, _) = tip.transform().decomposed();
    let mut drawn = page.list("points")[2].clone();
    drawn["at"] = serde_json::json!(at);
    assert!((page.global(0, &drawn, "at").1 - tips[0]).norm() < 1e-6);
    assert!(node("palm").expect("a body").children().next().is_none());
    let whole = document
        .default_scene()
        .expect("a scene")
        .nodes()
        .next()
        .expect("all");
    assert!(whole.children().any(|node| node.name() == Some("wall")));
    Ok(())
}
