//! Writes random mechanisms of the engine's tests as Rust.
#![allow(dead_code, reason = "the tests use more of it")]

#[path = "../../../macros/engine/tests/mechanisms/apart.rs"]
mod apart;
#[path = "../../../macros/engine/tests/common/mod.rs"]
mod common;
#[path = "../../../macros/engine/tests/mechanisms/elements.rs"]
mod elements;
#[path = "../../../macros/engine/tests/mechanisms/generator.rs"]
mod generator;
#[path = "../../../macros/engine/tests/mechanisms/library.rs"]
mod library;
#[path = "../../../macros/engine/tests/common/pose.rs"]
mod pose;
#[path = "../../../macros/engine/tests/common/reading.rs"]
mod reading;
#[path = "../../../macros/engine/tests/common/writing.rs"]
mod writing;

/// What the generator writes.
mod text {
    use holonom_engine::model::ElementKind;

    pub(crate) struct Text {
        pub(crate) item: String,
        pub(crate) definitions: Vec<(String, ElementKind, String)>,
    }
}

use std::path::Path;

use apart::Mechanism;
use common::{checked, tokens};
use generator::Generator;

fn setting(name: &str, default: u64) -> u64 {
    println!("cargo::rerun-if-env-changed={name}");
    let given = std::env::var(name).ok();
    given.map_or(default, |text| text.parse().expect("a number"))
}

/// Why the engine refuses a mechanism.
fn refusal(mechanism: &Mechanism) -> Option<String> {
    let text = mechanism.text();
    let find = |name: &str| {
        let own = text.definitions.iter().find(|(known, ..)| known == name);
        let found = own.map(|(_, kind, text)| (*kind, text.clone()));
        let found = found.or_else(|| library::definition(name));
        found.map(|(kind, text)| (kind, tokens(&text)))
    };
    checked(&tokens(&text.item), find).err()
}

/// The mechanism of a seed, in joint coordinates if it can be described by them, or why the engine
/// refuses it.
fn accepted(seed: u64) -> Result<(Mechanism, bool), String> {
    let mut mechanism = Generator::new(seed, &[]).mechanism();
    let mut why = String::new();
    for wish in ["drop", "keep"] {
        mechanism.redundant(Some(wish));
        let mut by_joints = mechanism.clone();
        let coordinates = ("coordinates".to_owned(), "\"joints\"".to_owned());
        by_joints.attributes.push(coordinates);
        if refusal(&by_joints).is_none() {
            return Ok((by_joints, true));
        }
        match refusal(&mechanism) {
            None => return Ok((mechanism, false)),
            Some(refusal) => why = refusal,
        }
    }
    Err(why)
}

/// A module with a mechanism and the joints and forces that it uses.
fn module(seed: u64, mechanism: &Mechanism) -> String {
    let text = mechanism.text();
    let definitions = text.definitions.iter().map(|(_, kind, text)| {
        let word = kind.word();
        format!("holonom::{word}! {{ /// Random.\n{word} {text} }}\n")
    });
    let fields = mechanism.fields.iter();
    let values = fields.filter(|field| field.word == "param");
    let values: Vec<String> = values.map(|field| format!("{:?}", field.value)).collect();
    let made = if values.is_empty() {
        "Random::default()".to_owned()
    } else {
        format!("Random::new({})?", values.join(", "))
    };
    let definitions: String = definitions.collect();
    let text = format!(
        "pub mod m{seed} {{\nuse holonom::prelude::*;\n{definitions}#[derive(Mechanism)]\n{}\npub fn made() -> Result<Random, Fault> {{ Ok({made}) }}\n}}\n",
        text.item
    );
    // Macros of all modules have one scope.
    text.replace("Own", &format!("Own{seed}N"))
}

fn main() {
    let wanted = setting("HOLONOM_MECHANISMS", 40);
    let first = setting("HOLONOM_SEED", 0);
    let (mut modules, mut calls) = (String::new(), String::new());
    for seed in first..first + wanted {
        match accepted(seed) {
            Ok((mechanism, by_joints)) => {
                modules += &module(seed, &mechanism);
                // Each coordinates have each formulation in a third of the mechanisms.
                let mut formulations = [
                    "StandardLagrange",
                    "Baumgarte::default()",
                    "Penalty::new(1e4, 10.0, 1.0)",
                ];
                formulations.rotate_left((seed % 3) as usize);
                let [one, other, _] = formulations;
                let mut call = |coordinates, formulation| {
                    calls += &format!(
                        "compared::<_, _, {coordinates}>(tally, {seed}, m{seed}::made, {formulation});\n"
                    );
                };
                call("Absolute", one);
                if by_joints {
                    call("Relative", other);
                }
            }
            Err(why) => calls += &format!("tally.refused({seed}, \"engine\", {why:?});\n"),
        }
    }
    let folder = std::env::var("OUT_DIR").expect("there is a folder");
    let text = format!("{modules}\nfn all(tally: &mut Tally) {{\n{calls}}}\n");
    std::fs::write(Path::new(&folder).join("mechanisms.rs"), text).expect("a file is written");
    println!("cargo::rustc-env=CARGO_TARGET_TMPDIR={folder}");
}
