//! What every source keeps to.
//!
//! No test looks at a clock: what a machine does beside it would decide. Bounds are counts; speed
//! is measured by the benches. No comment is wider than 100 columns: the formatter does not see it.

#![forbid(unsafe_code)]

mod lengths;
mod links;
mod shrinking;

use std::fs;
use std::path::{Path, PathBuf};

/// How time is asked for, split so that this file does not hold it.
const ASKED: [[&str; 2]; 3] = [
    ["Instant", "::now"],
    ["SystemTime", "::now"],
    [".elap", "sed("],
];

/// All Rust sources beneath a folder, but what was built.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("readable").path();
        let name = path.file_name().expect("has one").to_string_lossy();
        if path.is_dir() {
            if name != "target" && !name.starts_with('.') {
                sources(&path, found);
            }
        } else if name.ends_with(".rs") {
            found.push(path);
        }
    }
}

/// The words by which a text asks for the time.
fn asks(text: &str) -> impl Iterator<Item = String> + '_ {
    let words = ASKED.iter().map(|word| word.concat());
    words.filter(|word| text.contains(word))
}

#[test]
fn no_test_looks_at_a_clock() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    let root = root.expect("the workspace");
    let (mut all, mut tests) = (Vec::new(), 0);
    sources(root, &mut all);
    let mut faults = Vec::new();
    for path in all {
        let text = fs::read_to_string(&path).expect("readable");
        let relative = path.strip_prefix(root).expect("beneath it");
        let is_of_tests = relative
            .components()
            .any(|part| part.as_os_str() == "tests");
        // Of a program that measures, what tests it.
        let tested = text.find("#[cfg(test)]").map(|start| &text[start..]);
        if let Some(text) = if is_of_tests { Some(&*text) } else { tested } {
            tests += 1;
            faults.extend(asks(text).map(|word| format!("{}: {word}", relative.display())));
        }
    }
    assert!(tests > 200, "only {tests} files with tests were found");
    assert!(faults.is_empty(), "{faults:#?}");
}

#[test]
fn a_clock_is_recognised() {
    let text = ["let start = std::time::Instant", "::now();"].concat();
    assert_eq!(asks(&text).count(), 1);
    assert_eq!(asks("an instant").count(), 0);
}

/// Characters of a line.
const COLUMNS: usize = 100;

#[test]
fn no_comment_is_wider_than_a_hundred_columns() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    let root = root.expect("the workspace");
    let mut all = Vec::new();
    sources(root, &mut all);
    let (mut wide, mut seen) = (Vec::new(), 0);
    for path in all {
        let text = fs::read_to_string(&path).expect("readable");
        for (place, line) in text.lines().enumerate() {
            let comment = line.trim_start().strip_prefix("//");
            seen += usize::from(comment.is_some());
            // A row of a table is one line.
            let is_row =
                |comment: &str| comment.trim_start_matches(['/', '!', ' ']).starts_with('|');
            if line.chars().count() > COLUMNS && comment.is_some_and(|comment| !is_row(comment)) {
                wide.push(format!("{}:{}", path.display(), place + 1));
            }
        }
    }
    assert!(seen > 10_000, "they were found: {seen}");
    assert!(wide.is_empty(), "wider than {COLUMNS} columns: {wide:#?}");
}
