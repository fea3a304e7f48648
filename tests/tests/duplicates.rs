//! No twelve equal lines stand twice: what is the same is shared.

#![forbid(unsafe_code)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// As many equal lines are a copy.
const LINES: usize = 12;

/// Files of the run time that have lines in common. They may only become fewer.
const RUNTIME: [[&str; 2]; 2] = [
    ["integrate/implicit_midpoint.rs", "integrate/rk2.rs"],
    ["integrate/rk2.rs", "integrate/rk2.rs"],
];

/// A line that counts, trimmed, and its number in the file.
type Line = (String, usize);

/// Equal lines at two places.
struct Copy {
    files: [String; 2],
    /// First and last line in each.
    lines: [[usize; 2]; 2],
}

/// The lines of a text that count: no blank ones, no comments, none of brackets alone, no imports.
fn counted(text: &str) -> Vec<Line> {
    let mut counted = Vec::new();
    let mut is_import = false;
    for (place, line) in text.lines().enumerate() {
        let line = line.trim();
        is_import |= ["use ", "pub use ", "pub(crate) use ", "pub(super) use "]
            .iter()
            .any(|word| line.starts_with(word));
        let is_bracket = |c: char| "()[]{}<>,;|&?. ".contains(c);
        if !is_import && !line.starts_with("//") && !line.chars().all(is_bracket) {
            counted.push((line.to_owned(), place + 1));
        }
        is_import &= !line.ends_with(';');
    }
    counted
}

/// The copies among some files, each as long as it is.
fn copies(files: &[(String, Vec<Line>)]) -> Vec<Copy> {
    let mut places: BTreeMap<Vec<&str>, Vec<[usize; 2]>> = BTreeMap::new();
    let mut equal: BTreeSet<[[usize; 2]; 2]> = BTreeSet::new();
    for (file, (_, lines)) in files.iter().enumerate() {
        for (place, window) in lines.windows(LINES).enumerate() {
            let window = window.iter().map(|(line, _)| line.as_str()).collect();
            let known = places.entry(window).or_default();
            // Lines that repeat themselves are no copy of themselves.
            let is_apart = |known: &&[usize; 2]| known[0] != file || known[1] + LINES <= place;
            equal.extend(
                known
                    .iter()
                    .filter(is_apart)
                    .map(|known| [*known, [file, place]]),
            );
            known.push([file, place]);
        }
    }
    let moved = |pair: &[[usize; 2]; 2], by: usize| pair.map(|[file, place]| [file, place + by]);
    let is_first = |pair: &&[[usize; 2]; 2]| {
        let before = pair.map(|[file, place]| place.checked_sub(1).map(|place| [file, place]));
        !matches!(before, [Some(one), Some(other)] if equal.contains(&[one, other]))
    };
    let copy = |pair: &[[usize; 2]; 2]| {
        let more = (1..).take_while(|by| equal.contains(&moved(pair, *by)));
        let length = LINES + more.count();
        Copy {
            files: pair.map(|[file, _]| files[file].0.clone()),
            lines: pair.map(|[file, place]| {
                [place, place + length - 1].map(|place| files[file].1[place].1)
            }),
        }
    };
    equal.iter().filter(is_first).map(copy).collect()
}

/// The sources beneath a folder, but tests, each with the lines that count.
fn sources(folder: &str) -> Vec<(String, Vec<Line>)> {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    let root = workspace.expect("tests lie in the workspace").join(folder);
    let mut paths = Vec::new();
    files(&root, &mut paths);
    paths.sort();
    let lines = |path: PathBuf| {
        let name = path.strip_prefix(&root).expect("it lies there");
        let text = fs::read_to_string(&path).expect("it can be read");
        (name.to_string_lossy().into_owned(), counted(&text))
    };
    paths.into_iter().map(lines).collect()
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("it can be read") {
        let path = entry.expect("it can be read").path();
        if path.file_stem().is_some_and(|stem| stem == "tests") {
            continue;
        }
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|kind| kind == "rs") {
            found.push(path);
        }
    }
}

/// Whether two files are known to have lines in common.
fn is_known(known: &[[&str; 2]], [one, other]: &[String; 2]) -> bool {
    let is = |pair: &[&str; 2]| *pair == [one, other] || *pair == [other, one];
    known.iter().any(is)
}

#[test]
fn no_twelve_lines_stand_twice() {
    let (mut found, mut seen) = (Vec::new(), 0);
    for (folder, known) in [
        ("macros/engine/src", &[][..]),
        ("runtime/src", &RUNTIME[..]),
    ] {
        let sources = sources(folder);
        seen += sources.iter().map(|(_, lines)| lines.len()).sum::<usize>();
        for Copy { files, lines } in copies(&sources) {
            if !is_known(known, &files) {
                let [one, other] = [0, 1].map(|k| {
                    let [first, last] = lines[k];
                    format!("{}:{first}-{last}", files[k])
                });
                found.push(format!("{folder}: {one} is {other}"));
            }
        }
    }
    assert!(seen > 20_000, "they were found: {seen}");
    assert!(found.is_empty(), "share what is the same: {found:#?}");
}

#[test]
fn a_copy_is_found() {
    let text = |lines: std::ops::Range<usize>| {
        let lines = lines.map(|k| format!("    line({k});\n\n    // {k}\n    }}\n"));
        lines.collect::<String>()
    };
    let files = |texts: &[String]| -> Vec<(String, Vec<Line>)> {
        let file = |text: &String| ("a.rs".to_owned(), counted(text));
        texts.iter().map(file).collect()
    };
    let found = copies(&files(&[text(0..30), text(10..23)]));
    let lines: Vec<_> = found.iter().map(|copy| copy.lines).collect();
    assert_eq!(lines, [[[41, 89], [1, 49]]]);
    assert!(copies(&files(&[text(0..30), text(19..40)])).is_empty());
    let twice = text(0..12) + &text(0..12);
    assert_eq!(copies(&files(&[twice])).len(), 1);
    let repeated = "again();\n".repeat(2 * LINES - 1);
    assert!(copies(&files(&[repeated])).is_empty());
    assert_eq!(
        counted("use a::{\n    b,\n};\nc();\n"),
        [("c();".to_owned(), 4)]
    );
}
