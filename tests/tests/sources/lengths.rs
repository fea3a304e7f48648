//! Files and functions stay short enough to be read at once.
//!
//! A file has at most six hundred lines, a function at most one hundred. Those that are longer are
//! named here with their length, which may only shrink.

use std::fs;
use std::path::{Path, PathBuf};

/// The sources that are held to it.
const FOLDERS: [&str; 12] = [
    "macros/src",
    "macros/engine/src",
    "runtime/src",
    "film/src",
    "export/src",
    "fmu/src",
    "python/src",
    "live/src",
    "live/border/src",
    "urdf/src",
    "urdf/macros/src",
    "models/src",
];

const FILE: usize = 600;
const FUNCTION: usize = 100;

/// Functions that are longer: file, name, lines.
const LONG: [(&str, &str, usize); 10] = [
    ("macros/engine/src/check/joints.rs", "check", 169),
    ("macros/engine/src/check/mechanism.rs", "described", 170),
    ("macros/engine/src/coordinates/links.rs", "carry", 137),
    ("macros/engine/src/emit/assembly.rs", "emit", 105),
    ("macros/engine/src/emit/inputs.rs", "inputs_of", 113),
    ("macros/engine/src/emit/report.rs", "report", 124),
    ("macros/engine/src/rank/mod.rs", "judged", 129),
    ("macros/engine/src/symbolic/scene.rs", "on", 158),
    ("runtime/src/independent/partition.rs", "eliminated", 105),
    ("runtime/src/monitor/warning.rs", "fmt", 171),
];

/// Files that are longer.
const LONG_FILES: [(&str, usize); 0] = [];

/// All sources, by their path from the workspace.
pub(super) fn sources() -> Vec<(String, String)> {
    fn gather(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("readable").path();
            if path.is_dir() {
                gather(&path, found);
            } else if path.extension().is_some_and(|kind| kind == "rs") {
                found.push(path);
            }
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    let root = root.expect("the workspace");
    let mut paths = Vec::new();
    for folder in FOLDERS {
        gather(&root.join(folder), &mut paths);
    }
    paths.sort();
    let read = |path: PathBuf| {
        let name = path.strip_prefix(root).expect("beneath it");
        let text = fs::read_to_string(&path).expect("readable");
        (name.to_string_lossy().into_owned(), text)
    };
    paths.into_iter().map(read).collect()
}

/// The functions of a formatted source with a body of more than one line, by name, with how many
/// lines they have. A body ends with the first brace that stands as far left as `fn`.
fn functions(text: &str) -> Vec<(&str, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let indent = |line: &str| line.len() - line.trim_start().len();
    let length = |first: usize| {
        let line = lines[first];
        let name = name(line)?;
        for (place, end) in lines.iter().enumerate().skip(first) {
            if indent(end) == indent(line) && end.trim_end().ends_with(';') {
                return None;
            }
            if indent(end) == indent(line) && end.trim() == "}" {
                return Some((name, place - first + 1));
            }
        }
        None
    };
    (0..lines.len()).filter_map(length).collect()
}

/// The name of a function that begins in this line.
fn name(line: &str) -> Option<&str> {
    let (before, name) = line.trim_start().split_once("fn ")?;
    let is_modifier = |word: &str| ["const", "async", "unsafe"].contains(&word);
    let is_public = |word: &str| word.starts_with("pub");
    let mut words = before.split_whitespace();
    let is_declared = words.all(|word| is_modifier(word) || is_public(word));
    let end = name.find(|c: char| !c.is_alphanumeric() && c != '_')?;
    (is_declared && end > 0).then_some(&name[..end])
}

#[test]
fn functions_have_at_most_a_hundred_lines() {
    let (mut long, mut seen) = (Vec::new(), 0);
    for (path, text) in &sources() {
        for (name, lines) in functions(text) {
            seen += 1;
            if lines > FUNCTION {
                long.push((format!("{path}: {name}"), lines));
            }
        }
    }
    assert!(seen > 4000, "they were found: {seen}");
    let known = LONG.map(|(path, name, lines)| (format!("{path}: {name}"), lines));
    assert_known(&long, &known, "functions of more than a hundred lines");
}

#[test]
fn files_have_at_most_six_hundred_lines() {
    let sources = sources().into_iter();
    let lines = sources.map(|(path, text)| (path, text.lines().count()));
    let long: Vec<_> = lines.filter(|(_, lines)| *lines > FILE).collect();
    let known = LONG_FILES.map(|(path, lines)| (path.to_owned(), lines));
    assert_known(&long, &known, "files of more than six hundred lines");
}

/// What there is too much of is known and did not grow, and what is known is still there.
pub(super) fn assert_known(found: &[(String, usize)], known: &[(String, usize)], what: &str) {
    let is_known = |(name, count): &&(String, usize)| {
        let mut known = known.iter();
        known.any(|known| known.0 == *name && *count <= known.1)
    };
    let new: Vec<_> = found.iter().filter(|found| !is_known(found)).collect();
    assert!(new.is_empty(), "{what}: {new:#?}");
    let is_mended = |known: &&(String, usize)| found.iter().all(|found| found.0 != known.0);
    let mended: Vec<_> = known.iter().filter(is_mended).collect();
    assert!(
        mended.is_empty(),
        "no more {what}, so take it off the list: {mended:#?}"
    );
}

#[test]
fn a_function_is_counted_from_its_name_to_its_brace() {
    let text = "impl A {\n    pub const fn one(\n        self,\n    ) -> u8 {\n        1\n    }\n\n    \
                fn none(self);\n}\n\npub(crate) fn two() {\n    {\n    }\n}\n";
    assert_eq!(functions(text), [("one", 5), ("two", 4)]);
}
