//! Lists the public names of a crate, one a line, from the JSON of rustdoc: items, fields, methods
//! and what a trait asks for. Of an implementation of a trait there is one line.

#![forbid(unsafe_code)]

use std::collections::BTreeSet;
use std::error::Error;
use std::path::PathBuf;
use std::{env, fs};

use serde_json::Value;

/// The most names at the root that a user meets in the first list of the documentation.
const AT_ROOT: usize = 60;

/// An implementation of it follows from that of `PartialEq`.
const SILENT: &str = "core::marker::StructuralPartialEq";

fn main() -> Result<(), Box<dyn Error>> {
    let path: PathBuf = env::args_os().nth(1).ok_or("a file of rustdoc")?.into();
    let mut json: Value = serde_json::from_slice(&fs::read(&path)?)?;
    let items = json["index"].as_object_mut().ok_or("no index of items")?;
    for item in items.values_mut() {
        let Some(implementation) = item.pointer_mut("/inner/impl") else {
            continue;
        };
        // What it consists of is said by its trait.
        if implementation["trait"].is_object() {
            implementation["items"] = Value::Array(Vec::new());
        }
    }
    let short = path.with_extension("short.json");
    fs::write(&short, serde_json::to_vec(&json)?)?;
    let api = public_api::Builder::from_rustdoc_json(&short)
        .omit_blanket_impls(true)
        .omit_auto_trait_impls(true)
        .build()?;
    let lines: Vec<String> = api.items().map(ToString::to_string).collect();
    let mut seen = BTreeSet::new();
    for line in &lines {
        if !line.contains(SILENT) && !is_part_of_prelude(line) && seen.insert(line) {
            println!("{line}");
        }
    }
    let names: BTreeSet<&str> = seen.iter().filter_map(|line| name_at_root(line)).collect();
    if names.len() > AT_ROOT {
        return Err(format!("{} names at the root: {names:?}", names.len()).into());
    }
    Ok(())
}

/// The name that a line puts at the root of the crate, beside its modules.
fn name_at_root(line: &str) -> Option<&str> {
    let (declared, path) = line.split_once("holonom::")?;
    let is_item = declared.contains("pub ") && !declared.ends_with("mod ");
    let end = path.find(|c: char| !c.is_alphanumeric() && c != '_');
    let (name, rest) = path.split_at(end.unwrap_or(path.len()));
    (is_item && !rest.starts_with("::")).then_some(name)
}

/// Whether a line is about a part of what the prelude names: it is listed where that is at home.
fn is_part_of_prelude(line: &str) -> bool {
    let mut words = line.split("holonom::prelude::").skip(1);
    words.next().is_some_and(|word| {
        let name = word.trim_start_matches(|c: char| c.is_alphanumeric() || c == '_');
        name.starts_with("::")
    })
}
