//! Rooms are folders of `src`, and read one way; circles of files are few, small, and named here.

#![forbid(unsafe_code)]

mod graph;
mod methods;
mod picture;

use std::collections::BTreeSet;

use graph::{Graph, Sources, circles};

/// The rooms of the run time, each behind those that it may use.
const RUNTIME: [&str; 18] = [
    "math",
    "error",
    "state",
    "forward",
    "mechanism",
    "constraints",
    "integrate",
    "formulation",
    "monitor",
    "assembly",
    "nonsmooth",
    "measure",
    "independent",
    "dynamics",
    "stepping",
    "run",
    "sensitivity",
    "lanes",
];

/// What lies beside the rooms: interfaces, and the language's own tables.
const BESIDE: [&str; 5] = ["lib", "private", "joints", "forces", "guide"];

/// The circles of files in the engine. They may only shrink.
const ENGINE_CIRCLES: [&[&str]; 2] = [
    &["coordinates/align", "coordinates/links"],
    &[
        "coordinates/candidates",
        "coordinates/handover",
        "coordinates/system",
    ],
];

/// The circles of files in the run time.
const RUNTIME_CIRCLES: [&[&str]; 2] = [
    &["math/scalar", "math/versine"],
    &["mechanism/coordinates", "mechanism/kernels"],
];

/// Those of the run time where calls of methods of one type count.
const RUNTIME_METHODS: [&[&str]; 8] = [
    &["dynamics/evaluate", "dynamics/faults"],
    &[
        "independent",
        "independent/balance",
        "independent/determined",
        "independent/equations",
        "independent/followed",
        "independent/partition",
        "independent/states",
    ],
    &["independent/linear", "independent/switched"],
    &["math/scalar", "math/versine"],
    &["measure/acceleration", "measure/points"],
    &["mechanism/coordinates", "mechanism/kernels"],
    &["run/events/stepper_modes", "run/stepper"],
    &["run/kinematics/across", "run/kinematics/motion"],
];

/// Those of the engine where calls of methods of one type count.
const ENGINE_METHODS: [&[&str]; 8] = [
    &["check/bodies/leading", "check/bodies/rotation"],
    &["check/expression", "check/functions"],
    &[
        "check/joints",
        "check/laws",
        "check/limits",
        "check/switches",
    ],
    &["coordinates/align", "coordinates/links"],
    &[
        "coordinates/candidates",
        "coordinates/handover",
        "coordinates/reference",
        "coordinates/system",
    ],
    &[
        "emit/construction",
        "emit/coordinates",
        "emit/inputs",
        "emit/likes",
        "emit/mechanism",
        "emit/parameters",
        "emit/separations",
        "emit/states",
        "emit/switches",
    ],
    &["model/counted", "model/mechanism"],
    &[
        "symbolic/rotation",
        "symbolic/vector",
        "symbolic/vector/turns",
    ],
];

/// The circles of files of `urdf`.
const URDF_CIRCLES: [&[&str]; 2] = [
    &["describe", "robot"],
    &["document", "mechanism", "visuals"],
];

#[test]
fn rooms_of_the_run_time_read_one_way() {
    let graph = Sources::of("runtime/src").graph(false);
    let place = |room: &str| {
        let place = RUNTIME.iter().position(|known| *known == room);
        place.unwrap_or_else(|| panic!("the room `{room}` has no place in the order"))
    };
    let mut arrows = 0;
    for (file, used) in &graph {
        if BESIDE.contains(&file[0].as_str()) {
            continue;
        }
        for other in used {
            assert_ne!(
                other,
                &["lib"],
                "`{}` names something by the root, which is for users",
                file.join("/")
            );
            if file[0] != other[0] && !BESIDE.contains(&other[0].as_str()) {
                arrows += 1;
                assert!(
                    place(&other[0]) < place(&file[0]),
                    "`{}` uses `{}`, which comes after it",
                    file.join("/"),
                    other.join("/")
                );
            }
        }
    }
    assert!(arrows > 200, "they were found: {arrows}");
}

#[test]
fn circles_of_files_do_not_grow() {
    // Heads of rooms of the run time re-export what users name, and hold the traits of their files.
    for (folder, known, of_heads) in [
        ("runtime/src", &RUNTIME_CIRCLES[..], false),
        ("macros/engine/src", &ENGINE_CIRCLES[..], true),
        ("urdf/src", &URDF_CIRCLES[..], true),
    ] {
        assert_circles(folder, &Sources::of(folder).graph(of_heads), known);
    }
}

#[test]
fn circles_of_files_through_methods_of_one_type_do_not_grow() {
    for (folder, known, of_heads) in [
        ("runtime/src", &RUNTIME_METHODS[..], false),
        ("macros/engine/src", &ENGINE_METHODS[..], true),
        ("urdf/src", &URDF_CIRCLES[..], true),
    ] {
        let sources = Sources::of(folder);
        let mut graph = sources.graph(of_heads);
        methods::add(&sources, &mut graph);
        assert_circles(folder, &graph, known);
    }
}

/// Every circle is a known one, or a part of it; every known one is still there.
fn assert_circles(folder: &str, graph: &Graph, known: &[&[&str]]) {
    let circles: BTreeSet<Vec<String>> = circles(graph)
        .iter()
        .map(|circle| circle.iter().map(|file| file.join("/")).collect())
        .collect();
    let is_part = |circle: &[String], of: &[&str]| circle.iter().all(|f| of.contains(&f.as_str()));
    let new: Vec<_> = circles
        .iter()
        .filter(|circle| !known.iter().any(|known| is_part(circle, known)))
        .collect();
    assert!(new.is_empty(), "{folder}: circles of {new:#?}");
    for known in known {
        let is_there = circles
            .iter()
            .any(|circle| circle.len() == known.len() && is_part(circle, known));
        assert!(
            is_there,
            "{folder}: a circle is smaller now, so shorten the list: {known:?}"
        );
    }
}
