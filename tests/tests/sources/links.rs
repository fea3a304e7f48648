//! Links between Markdown files lead to a file, and to a heading in it.
//!
//! Links in the guide are those of rustdoc, which checks them itself.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The Markdown files of the repository, but what was built.
fn pages(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("readable").path();
        let name = path.file_name().expect("has one").to_string_lossy();
        if path.is_dir() {
            if !["target", "node_modules", "guide"].contains(&&*name) && !name.starts_with('.') {
                pages(&path, found);
            }
        } else if name.ends_with(".md") {
            found.push(path);
        }
    }
}

/// The text without blocks of code and code in lines.
fn prose(text: &str) -> String {
    let parts = text.split("```").step_by(2);
    let lines = parts.flat_map(|part| part.split('`').step_by(2));
    lines.collect()
}

/// The targets of `[text](target)`.
fn targets(text: &str) -> Vec<String> {
    let prose = prose(text);
    let rest = prose.split("](").skip(1);
    let target = |rest: &str| rest.split([')', ' ']).next().map(str::to_owned);
    rest.filter_map(target).collect()
}

/// The anchors of the headings, as GitHub makes them.
fn anchors(text: &str) -> BTreeSet<String> {
    let parts = text.split("\n```").step_by(2);
    let headings = parts.flat_map(|part| part.lines().filter(|line| line.starts_with('#')));
    let anchor = |line: &str| {
        let words = line.trim_start_matches('#').trim().to_lowercase();
        let kept = |c: &char| c.is_alphanumeric() || "-_ ".contains(*c);
        words
            .chars()
            .filter(kept)
            .collect::<String>()
            .replace(' ', "-")
    };
    headings.map(anchor).collect()
}

#[test]
fn links_between_pages_lead_somewhere() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    let root = root.expect("the workspace");
    let (mut found, mut broken, mut seen) = (Vec::new(), Vec::new(), 0);
    pages(root, &mut found);
    for page in found {
        let text = fs::read_to_string(&page).expect("readable");
        for target in targets(&text) {
            if target.contains("://") || target.starts_with("mailto:") {
                continue;
            }
            seen += 1;
            let (file, anchor) = target.split_once('#').unwrap_or((&target, ""));
            let file = match file {
                "" => page.clone(),
                file => page.parent().expect("a folder").join(file),
            };
            let is_there = file.exists()
                && (anchor.is_empty()
                    || fs::read_to_string(&file).is_ok_and(|text| anchors(&text).contains(anchor)));
            if !is_there {
                broken.push(format!("{}: {target}", page.display()));
            }
        }
    }
    assert!(seen > 50, "they were found: {seen}");
    assert!(broken.is_empty(), "they lead nowhere: {broken:#?}");
}

#[test]
fn a_link_and_a_heading_are_recognised() {
    let text =
        "# A `page`, of one\n[here](other.md#a-b) `[not](this.md)`\n```\n# nor [this](x.md)\n```\n";
    assert_eq!(targets(text), ["other.md#a-b"]);
    assert_eq!(anchors(text), BTreeSet::from(["a-page-of-one".to_owned()]));
}
