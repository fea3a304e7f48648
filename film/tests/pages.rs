//! Pages are read as the viewer reads them: by the data in them.

use std::error::Error;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use holonom::nalgebra::{Quaternion, UnitQuaternion, Vector3};
use holonom::prelude::*;
use holonom_film::{Film, FilmError, Sketch};
use holonom_models::{FourBar, RodPendulum, SqueezingMechanism};
use serde_json::Value;

/// The data of a page.
fn data(page: &str) -> Value {
    let (_, behind) = page
        .split_once("<script type=\"application/json\" id=\"film\">")
        .expect("the page has a place for data");
    let (data, _) = behind.split_once("</script>").expect("it ends");
    serde_json::from_str(data).expect("it is JSON")
}

fn floats(value: &Value) -> Vec<f32> {
    let bytes = STANDARD
        .decode(value.as_str().expect("text"))
        .expect("base 64");
    let numbers = bytes.chunks_exact(4);
    numbers
        .map(|bytes| f32::from_le_bytes(bytes.try_into().expect("four bytes")))
        .collect()
}

fn vector(value: &Value) -> Vector3<f64> {
    let number = |k: usize| value[k].as_f64().expect("a number");
    Vector3::new(number(0), number(1), number(2))
}

/// Markers of one element and name meet where its joint is closed, in every frame: bodies stand
/// where they are drawn.
#[test]
fn both_markers_of_a_hinge_meet_in_every_frame() -> Result<(), Box<dyn Error>> {
    let mut film = Film::new();
    Simulation::new(
        &SqueezingMechanism::default(),
        StandardLagrange,
        DormandPrince::default(),
    )
    .run(0.0..=0.03, every(0.003), |sample| film.record(sample))?;
    let page = data(&film.html()?);
    let bodies = page["bodies"].as_array().expect("bodies").len();
    let poses = floats(&page["poses"]);
    assert_eq!((film.frames(), poses.len()), (11, 11 * 7 * bodies));
    let global = |frame: usize, marker: &Value| {
        let at = vector(&marker["at"]);
        let Some(body) = marker["body"].as_u64() else {
            return at;
        };
        let first = (frame * bodies + body as usize) * 7;
        let [x, y, z, w, i, j, k] = std::array::from_fn(|n| f64::from(poses[first + n]));
        let turn = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k));
        Vector3::new(x, y, z) + turn * at
    };
    let markers = page["markers"].as_array().expect("markers");
    let mut pairs = 0;
    for (index, element) in page["elements"]
        .as_array()
        .expect("elements")
        .iter()
        .enumerate()
    {
        if element["kind"] != "Revolute" {
            continue;
        }
        let points: Vec<_> = markers
            .iter()
            .filter(|marker| marker["element"] == index && marker["kind"] == "point")
            .collect();
        let [first, second] = points[..] else {
            panic!("{element}: {} points", points.len());
        };
        for frame in 0..film.frames() {
            let apart = (global(frame, first) - global(frame, second)).norm();
            assert!(apart < 1e-6, "{element}, frame {frame}: {apart:e} m");
        }
        pairs += 1;
    }
    assert!(pairs > 5, "{pairs} hinges");
    Ok(())
}

/// A mast with a lamp on it; what is bored out of it is not drawn.
#[derive(Mechanism)]
struct Mast {
    #[param(like = 2.0)]
    height: f64,
    #[body(shape = cone(radius = 0.1, from = [0.0, 0.0, 0.0], to = [0.0, 0.0, height]), mass = 3.0, free)]
    mast: Body,
    #[body(shapes = [
        ball(radius = 0.2, at = [0.5, 0.0, 0.0]),
        ball(radius = 0.1, at = [0.5, 0.0, 0.0], density = -100.0),
    ], density = 100.0, free)]
    lamp: Body,
}

#[test]
fn shapes_are_drawn_with_the_sizes_of_the_run() -> Result<(), Box<dyn Error>> {
    let mast = Mast::new(1.5)?;
    let mut film = Film::new();
    Simulation::new(&mast, StandardLagrange, Rk4::every(0.1)).run(
        0.0..=0.1,
        every(0.1),
        |sample| film.record(sample),
    )?;
    let data = data(&film.html()?);
    let shapes = data["shapes"].as_array().expect("shapes");
    let [cone, ball] = &shapes[..] else {
        panic!("two shapes: {shapes:?}");
    };
    assert_eq!(
        (&cone["kind"], &ball["kind"]),
        (&"cone".into(), &"ball".into())
    );
    assert_eq!((&cone["body"], &ball["body"]), (&0.into(), &1.into()));
    let sizes = vector(&cone["sizes"]);
    assert!(
        (sizes - Vector3::new(1.5, 0.1, 0.0)).norm() < 1e-15,
        "{sizes}"
    );
    Ok(())
}

#[test]
fn arrows_are_the_reactions() -> Result<(), Box<dyn Error>> {
    let mut film = Film::new().with_reactions();
    let mut expected = Vec::new();
    let handles = RodPendulum::HANDLES;
    Simulation::new(
        &RodPendulum::default(),
        StandardLagrange,
        DormandPrince::default(),
    )
    .run(0.0..=1.0, every(0.25), |sample| {
        film.record(sample);
        let reaction = sample
            .reaction(handles.pivot, handles.rod)
            .expect("regular");
        expected.extend(reaction.force.iter().map(|&x| x as f32));
    })?;
    let page = data(&film.html()?);
    assert_eq!(page["arrows"].as_array().expect("arrows").len(), 1);
    let loads = floats(&page["loads"]);
    let forces: Vec<f32> = loads
        .chunks(6)
        .flat_map(|load| load[3..].to_vec())
        .collect();
    assert_eq!(forces, expected);
    let gravity = vector(&page["gravity"]);
    assert!(
        (gravity - Vector3::new(0.0, 0.0, -9.81)).norm() < 1e-12,
        "{gravity}"
    );
    Ok(())
}

#[test]
fn readings_have_a_value_for_each_frame_and_warnings_their_time() -> Result<(), Box<dyn Error>> {
    let mut film = Film::new();
    let method = AugmentedLagrangian::default();
    let report = Simulation::new(&FourBar::default(), method, DormandPrince::default())
        .absolute_coordinates()
        .projection(Projection::default())
        .run(0.0..=1.0, every(0.1), |sample| {
            film.record(sample);
            if sample.time() > 0.35 {
                film.reading("energy", "J", sample.energy());
            }
        })?;
    film.warnings(&report.warnings());
    let page = data(&film.html()?);
    let values = floats(&page["readings"][0]["values"]);
    assert_eq!(values.len(), film.frames());
    assert_eq!(values.iter().filter(|value| value.is_nan()).count(), 4);
    let time = page["warnings"][0]["time"].as_f64().expect("it has a time");
    assert!((time - 0.708).abs() < 0.01, "{time}"); // its links lie on one line there
    Ok(())
}

#[test]
fn a_second_run_is_a_ghost_with_its_own_times() -> Result<(), Box<dyn Error>> {
    let run = |title: &str, step: f64| -> Result<_, Box<dyn Error>> {
        let mut film = Film::new().titled(title);
        Simulation::new(&RodPendulum::default(), StandardLagrange, Rk4::every(0.05)).run(
            0.0..=0.2,
            every(step),
            |sample| film.record(sample),
        )?;
        Ok(film)
    };
    let (mut film, other) = (run("coarse", 0.1)?, run("fine", 0.05)?);
    assert!(data(&film.html()?)["ghost"].is_null());
    film.ghost(&other);
    let (page, alone) = (data(&film.html()?), data(&other.html()?));
    assert_eq!(page["ghost"]["title"], "fine");
    assert_eq!(page["ghost"]["times"], alone["times"]);
    assert_eq!(page["ghost"]["poses"], alone["poses"]);
    assert_eq!(page["times"].as_array().map(Vec::len), Some(3));
    film.ghost(&Film::new());
    assert!(data(&film.html()?)["ghost"].is_null());
    Ok(())
}

#[test]
fn a_title_cannot_end_the_data() -> Result<(), Box<dyn Error>> {
    let title = "</script><script>alert(1)</script><!-- \u{2028}";
    let mut film = Film::new().titled(title);
    Simulation::new(&RodPendulum::default(), StandardLagrange, Rk4::every(0.1)).run(
        0.0..=0.1,
        every(0.1),
        |sample| film.record(sample),
    )?;
    assert_eq!(data(&film.html()?)["title"], title);
    Ok(())
}

#[test]
fn a_film_without_frames_is_refused() {
    let film = Film::<RodPendulum>::new();
    let error = film.save("nowhere.html").expect_err("it is empty");
    assert!(matches!(error, FilmError::Empty));
    assert!(error.to_string().contains("film.record(sample)"));
    assert!(!std::path::Path::new("nowhere.html").exists());
}

#[test]
fn what_cannot_be_written_says_why() -> Result<(), Box<dyn Error>> {
    let mut film = Film::new();
    Simulation::new(&RodPendulum::default(), StandardLagrange, Rk4::every(0.1)).run(
        0.0..=0.1,
        every(0.1),
        |sample| film.record(sample),
    )?;
    let error = film
        .save("no/such/folder/film.html")
        .expect_err("no folder");
    assert!(matches!(error, FilmError::Write(_)));
    assert!(error.source().is_some());
    Ok(())
}

/// The force of a massless rod is at the end of the body that is drawn, along the rod.
#[test]
fn the_arrow_of_a_rod_begins_at_its_end() -> Result<(), Box<dyn Error>> {
    #[derive(Mechanism)]
    #[mechanism(gravity = [0.0, 0.0, -9.81])]
    struct Bob {
        #[body(mass = 1.0, position = [1.0, 0.0, 0.0])]
        bob: Particle,
        #[joint(between = [ground, bob], head = [0.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0])]
        rod: Distance,
    }
    let (mut film, mut places) = (Film::new().with_reactions(), Vec::new());
    Simulation::new(&Bob::default(), StandardLagrange, DormandPrince::default()).run(
        0.0..=0.5,
        every(0.1),
        |sample| {
            film.record(sample);
            places.push(sample.position(Bob::HANDLES.bob));
        },
    )?;
    let page = data(&film.html()?);
    let loads = floats(&page["loads"]);
    assert_eq!(loads.len(), 6 * places.len());
    for (load, place) in loads.chunks(6).zip(&places) {
        let [x, y, z, fx, fy, fz] = std::array::from_fn(|k| f64::from(load[k]));
        let (at, force) = (Vector3::new(x, y, z), Vector3::new(fx, fy, fz));
        assert!((at - place).norm() < 1e-6, "{at} {place}");
        assert!(force.cross(place).norm() < 1e-4, "{force}");
    }
    Ok(())
}

/// A view has the poses of a sample and no reactions, of which a frame then holds none.
#[test]
fn a_view_is_a_frame_without_reactions() -> Result<(), Box<dyn Error>> {
    let rod = RodPendulum::default();
    let [mut by_sample, mut by_view] = [(); 2].map(|()| Film::new().with_reactions());
    rod.simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=1.0, every(0.25), |sample| {
            by_sample.record(sample);
            by_view.record_view(sample);
        })?;
    let [of_sample, of_view] = [data(&by_sample.html()?), data(&by_view.html()?)];
    for key in ["times", "poses", "markers", "arrows"] {
        assert_eq!(of_sample[key], of_view[key], "{key}");
    }
    let [some, none] = [&of_sample, &of_view].map(|page| floats(&page["loads"]));
    assert_eq!(some.len(), none.len());
    assert!(some.iter().all(|x| x.is_finite()) && none.iter().all(|x| x.is_nan()));
    Ok(())
}

/// The module of a page that computes is before its data, which stays what it is.
#[test]
fn a_module_is_in_the_page_beside_the_film() -> Result<(), Box<dyn Error>> {
    let mut film = Film::new();
    RodPendulum::default()
        .simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=0.1, every(0.1), |sample| film.record(sample))?;
    let module: Vec<u8> = (0..=255).cycle().take(1000).collect();
    let (page, film) = (film.html_with_module(&module)?, film.html()?);
    let (_, behind) = page
        .split_once("<script type=\"text/plain\" id=\"live\">")
        .expect("a module");
    let (found, _) = behind.split_once("</script>").expect("it ends");
    assert_eq!(STANDARD.decode(found)?, module);
    assert_eq!(data(&page), data(&film));
    assert!(!film.contains("<script type=\"text/plain\""));
    Ok(())
}

/// The picture is well formed, and everything in it moves through the same number of frames.
#[test]
fn a_picture_is_an_animated_drawing() -> Result<(), Box<dyn Error>> {
    let handles = SqueezingMechanism::HANDLES;
    let mut film = Film::new().titled("a < b & c");
    film.trace_point(handles.triangle, "corner", [0.0, 0.01, 0.0]);
    Simulation::new(
        &SqueezingMechanism::default(),
        StandardLagrange,
        DormandPrince::default(),
    )
    .run(0.0..=0.03, every(0.001), |sample| film.record(sample))?;
    let svg = film.svg()?;
    let document = roxmltree::Document::parse(&svg)?;
    let named = |name: &'static str| document.descendants().filter(move |n| n.has_tag_name(name));
    assert_eq!(
        named("title").next().and_then(|n| n.text()),
        Some("a < b & c")
    );
    assert!(
        named("line").count() >= 7,
        "{} lines",
        named("line").count()
    );
    assert_eq!(named("polyline").count(), 1);
    for animated in named("animate") {
        let values = animated.attribute("values").unwrap_or_default().split(';');
        let values: Vec<f64> = values.map(str::parse).collect::<Result<_, _>>()?;
        assert_eq!(values.len(), film.frames());
        assert!(
            values.iter().all(|value| (0.0..=700.0).contains(value)),
            "{values:?}"
        );
    }
    assert!(named("animate").count() > 20);
    Ok(())
}

/// Read by a parser that nobody here wrote.
#[test]
fn a_gltf_file_moves_as_the_run_does() -> Result<(), Box<dyn Error>> {
    let pendulum = RodPendulum::default();
    let (mut film, mut poses) = (Film::new(), Vec::new());
    pendulum
        .simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=1.0, every(0.05), |sample| {
            film.record(sample);
            poses.push((sample.time(), sample.pose(RodPendulum::HANDLES.rod)));
        })?;
    let gltf::Gltf { document, .. } = gltf::Gltf::from_slice(film.gltf()?.as_bytes())?;
    let buffer = document.buffers().next().expect("a buffer");
    let gltf::buffer::Source::Uri(uri) = buffer.source() else {
        panic!("in the file");
    };
    let (_, text) = uri.split_once(',').expect("a data URI");
    let numbers = STANDARD.decode(text)?;
    assert_eq!(numbers.len(), buffer.length());

    let animation = document.animations().next().expect("an animation");
    assert_eq!(animation.channels().count(), 2);
    for channel in animation.channels() {
        assert_eq!(channel.target().node().name(), Some("rod"));
        let reader = channel.reader(|_| Some(&numbers));
        let times: Vec<f32> = reader.read_inputs().expect("times").collect();
        assert_eq!(times.len(), poses.len());
        for (found, (time, _)) in times.iter().zip(&poses) {
            assert!((f64::from(*found) - time).abs() < 1e-6);
        }
        match reader.read_outputs().expect("values") {
            gltf::animation::util::ReadOutputs::Translations(places) => {
                assert_eq!(places.len(), poses.len());
                for (place, (_, pose)) in places.zip(&poses) {
                    let off = Vector3::from(place.map(f64::from)) - pose.position;
                    assert!(off.norm() < 1e-6, "{off}");
                }
            }
            gltf::animation::util::ReadOutputs::Rotations(turns) => {
                let turns: Vec<[f32; 4]> = turns.into_f32().collect();
                assert_eq!(turns.len(), poses.len());
                for ([i, j, k, w], (_, pose)) in turns.into_iter().zip(&poses) {
                    let found = Quaternion::new(w, i, j, k).cast::<f64>();
                    let same = found.dot(&pose.orientation).abs();
                    assert!((same - 1.0).abs() < 1e-6, "{same}");
                }
            }
            _ => panic!("a body is moved and turned"),
        }
    }
    // What is up here is up there.
    let scene = document.default_scene().expect("a scene");
    let whole = scene.nodes().next().expect("all");
    let (_, [i, j, k, w], _) = whole.transform().decomposed();
    let turn = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k)).cast::<f64>();
    let up = turn * Vector3::from([0.0, 0.0, 1.0]);
    assert!((up - Vector3::y()).norm() < 1e-6, "{up}");
    let rod = whole.children().next().expect("the rod");
    let mesh = rod
        .mesh()
        .expect("a surface")
        .primitives()
        .next()
        .expect("one");
    let reader = mesh.reader(|_| Some(&numbers));
    let points: Vec<[f32; 3]> = reader.read_positions().expect("points").collect();
    assert!(points.len().is_multiple_of(3) && !points.is_empty());
    Ok(())
}

/// Distances on the paper are those of the mechanism, on one scale, and joints have their numbers.
#[test]
fn a_sketch_is_to_scale() -> Result<(), Box<dyn Error>> {
    let sketch = Slanted::default().sketch()?;
    let document = roxmltree::Document::parse(&sketch)?;
    // The pin that a number is beside.
    let number = |wanted: &str| {
        let mut texts = document.descendants();
        let text = texts
            .find(|node| node.attribute("class") == Some("number") && node.text() == Some(wanted));
        let beside = text.and_then(|text| text.parent()).expect(wanted);
        let mut pins = beside.children();
        let pin = pins.find(|node| node.has_tag_name("circle")).expect(wanted);
        let [x, y] = ["cx", "cy"].map(|key| pin.attribute(key).expect(key).parse::<f64>());
        Ok::<_, std::num::ParseFloatError>([x?, y?])
    };
    let [[x1, y1], [x2, y2], [x3, y3]] = [number("1")?, number("2")?, number("3")?];
    let scale = (x2 - x1) / 0.3;
    assert!((y1 - y2 - 0.4 * scale).abs() < 0.2, "{y1} {y2} {scale}");
    assert!((x3 - x2 - 0.8 * scale).abs() < 0.2, "{x3} {x2} {scale}");
    assert!((y3 - y2).abs() < 0.2);
    // One view of what is plane, and a row of the table for each joint.
    let texts: Vec<&str> = document
        .descendants()
        .filter_map(|node| node.text())
        .collect();
    assert!(texts.contains(&"x right, z up"), "{texts:?}");
    assert!(
        ["foot", "knee", "wheel"]
            .iter()
            .all(|name| texts.contains(name))
    );
    Ok(())
}

/// Two bars in the plane of x and z, and a ball that ends them.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Slanted {
    #[body(shape = rod(radius = 0.01, from = [0.1, 0.2, 0.0], to = [0.4, 0.2, 0.4]), mass = 1.0)]
    first: Body,
    #[body(shape = rod(radius = 0.01, from = [0.4, 0.2, 0.4], to = [1.2, 0.2, 0.4]), mass = 1.0)]
    second: Body,
    #[body(shape = ball(radius = 0.01, at = [1.2, 0.2, 0.4]), mass = 1.0)]
    third: Body,
    #[joint(between = [ground, first], point = [0.1, 0.2, 0.0], axis = [0.0, 1.0, 0.0])]
    foot: Revolute,
    #[joint(between = [first, second], point = [0.4, 0.2, 0.4], axis = [0.0, 1.0, 0.0])]
    knee: Revolute,
    #[joint(between = [second, third], point = [1.2, 0.2, 0.4], axis = [0.0, 1.0, 0.0])]
    wheel: Revolute,
}

/// What a page weighs beside its data.
#[test]
fn the_page_is_below_700_kilobytes_and_asks_no_network() {
    let page = include_str!("../src/page.html");
    assert!(page.len() < 700_000, "{}", page.len());
    let asks = [
        "src=\"http",
        "href=\"http",
        "@import",
        "fetch(\"http",
        "import(\"http",
    ];
    assert!(asks.iter().all(|ask| !page.contains(ask)));
}
