//! The picture of the rooms in ARCHITECTURE: which uses which.
//!
//! A mark in the row of a room is an arrow to the room of the column. All marks lie below the
//! diagonal, because a room uses only those above it.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::RUNTIME;
use crate::graph::Sources;

/// Draw it anew: `HOLONOM_DRAW=1 cargo test -p holonom-tests --test rooms`.
const WRITE: &str = "HOLONOM_DRAW";

/// Where it lies in the workspace.
const FILE: &str = "docs/rooms.svg";

/// The passes of the engine, which `macros/engine/tests/arrows.rs` holds.
const ENGINE: [&str; 11] = [
    "model",
    "diag",
    "syntax",
    "wire",
    "check",
    "symbolic",
    "rank",
    "passes",
    "plan",
    "coordinates",
    "emit",
];

/// The size of a mark with its place, of the names, and of the title (pixels).
const CELL: usize = 22;
const NAMES: usize = 96;
const TOP: usize = 112;

const HEAD: &str = concat!(
    r##"<style>text{font:12px sans-serif;fill:#222}.t{font-size:14px;font-weight:bold}"##,
    r##".n{text-anchor:end}.l{fill:#eef2f6}.d{fill:#b8c4d0}.u{fill:#2f6690}.w{fill:#c0392b}"##,
    r##"</style><rect width="100%" height="100%" fill="#fff"/>"##
);

/// Which rooms use which.
fn arrows(folder: &str, of_heads: bool) -> BTreeSet<[String; 2]> {
    let graph = Sources::of(folder).graph(of_heads);
    let arrows = graph.into_iter().flat_map(|(file, used)| {
        let from = file[0].clone();
        used.into_iter()
            .map(move |other| [from.clone(), other[0].clone()])
    });
    arrows.filter(|[from, to]| from != to).collect()
}

/// A square.
fn square(x: usize, y: usize, class: &str, title: &str) -> String {
    let size = CELL - 4;
    format!(
        r#"<rect x="{x}" y="{y}" width="{size}" height="{size}" class="{class}">{title}</rect>"#
    )
}

/// One matrix, from `left` on.
fn matrix(title: &str, folder: &str, rooms: &[&str], left: usize) -> String {
    let arrows = arrows(folder, folder.starts_with("macros"));
    let place = |k: usize| (left + NAMES + CELL * k, TOP + CELL * k);
    let mut svg = format!(r#"<text x="{left}" y="22" class="t">{title}</text>"#);
    for (row, room) in rooms.iter().enumerate() {
        let (x, y) = place(row);
        let (end, middle) = (left + NAMES - 8, y + CELL / 2 + 2);
        svg += &format!(r#"<text x="{end}" y="{middle}" class="n">{room}</text>"#);
        let (bottom, middle) = (TOP - 6, x + CELL / 2 + 2);
        svg +=
            &format!(r#"<text transform="translate({middle} {bottom}) rotate(-60)">{room}</text>"#);
        for (column, other) in rooms.iter().enumerate() {
            let is_arrow = arrows.contains(&[(*room).to_owned(), (*other).to_owned()]);
            let class = match (is_arrow, column < row) {
                _ if column == row => "d",
                (true, true) => "u",
                (true, false) => "w",
                (false, true) => "l",
                (false, false) => continue,
            };
            let title = if is_arrow {
                format!("<title>{room} uses {other}</title>")
            } else {
                String::new()
            };
            svg += &square(place(column).0, y, class, &title);
        }
    }
    svg
}

fn drawn() -> String {
    let second = NAMES + CELL * RUNTIME.len() + 60;
    let width = second + NAMES + CELL * ENGINE.len() + 60;
    let height = TOP + CELL * RUNTIME.len() + 8;
    let head =
        format!(r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}">"#);
    let runtime = matrix("Rooms of the run time", "runtime/src", &RUNTIME, 8);
    let engine = matrix("Passes of the engine", "macros/engine/src", &ENGINE, second);
    [&head, HEAD, &runtime, &engine, "</svg>\n"].concat()
}

#[test]
fn the_picture_is_what_the_code_gives() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    let path = root.expect("the workspace").join(FILE);
    let drawn = drawn();
    if std::env::var_os(WRITE).is_some() {
        fs::write(&path, &drawn).expect("the folder is there");
    }
    let kept = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        kept == drawn,
        "{FILE} is not what the code gives; set {WRITE}=1"
    );
    let marks = |class: &str| drawn.matches(&format!(r#"class="{class}""#)).count();
    assert!(marks("u") > 100, "arrows: {}", marks("u"));
    assert_eq!(marks("w"), 0, "no mark lies above the diagonal");
}
