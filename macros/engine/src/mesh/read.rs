//! Files of triangles, by the ending of their name: STL as text or bytes, OBJ.
//!
//! Of both only corners and faces matter here, with all their digits and over all solids of a file.
//! The readers that there are serve pictures: they read single precision, end behind the first
//! solid of a text, and refuse files for their colours. And nothing more is compiled.

use std::path::Path;

use super::surface::{Point, Triangle};

/// The triangles of a file, in its coordinates.
pub(super) fn triangles(file: &Path) -> Result<Vec<Triangle>, String> {
    let bytes = std::fs::read(file).map_err(|error| format!("cannot be read: {error}"))?;
    let ending = file.extension().unwrap_or_default().to_string_lossy();
    match &*ending.to_ascii_lowercase() {
        "stl" => stl(&bytes),
        "obj" => obj(&text(&bytes)),
        _ => Err("is neither an STL (.stl) nor an OBJ file (.obj)".into()),
    }
}

/// Names and comments may be in any alphabet.
fn text(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    text.trim_start_matches('\u{feff}').into()
}

/// Bytes before the triangles of a binary file, and of each triangle.
const HEAD: usize = 84;
const TRIANGLE: usize = 50;

/// The title of some binary files begins with the word that text files begin with.
fn stl(bytes: &[u8]) -> Result<Vec<Triangle>, String> {
    let count = match bytes.get(HEAD - 4..HEAD) {
        Some(&[a, b, c, d]) => Some(u32::from_le_bytes([a, b, c, d]) as usize),
        _ => None,
    };
    let behind = |count: usize| {
        let length = HEAD.checked_add(count.checked_mul(TRIANGLE)?)?;
        bytes.len().checked_sub(length)
    };
    let left = count.and_then(behind);
    let words = text(bytes);
    let mut first = words.split_whitespace();
    let begins = first
        .next()
        .is_some_and(|word| word.eq_ignore_ascii_case("solid"));
    match left {
        Some(0) => Ok(binary(bytes)),
        _ if begins => of_text(&words),
        // Some programs fill up the last block.
        Some(left) if left < TRIANGLE => Ok(binary(bytes)),
        _ => Err(format!(
            "is no STL file: it does not begin with `solid`, and has {} bytes, not those of {} triangles",
            bytes.len(),
            count.unwrap_or(0)
        )),
    }
}

fn binary(bytes: &[u8]) -> Vec<Triangle> {
    let triangles = bytes.get(HEAD..).unwrap_or_default().chunks_exact(TRIANGLE);
    let number = |bytes: &[u8]| match *bytes {
        [a, b, c, d] => f64::from(f32::from_le_bytes([a, b, c, d])),
        _ => f64::NAN,
    };
    // Behind the normal.
    let corners = triangles.map(|triangle| {
        [0, 1, 2].map(|corner| {
            [0, 1, 2]
                .map(|k| 12 * (corner + 1) + 4 * k)
                .map(|at| number(&triangle[at..at + 4]))
        })
    });
    corners.collect()
}

fn of_text(text: &str) -> Result<Vec<Triangle>, String> {
    let mut triangles = Vec::new();
    let mut corners: Vec<Point> = Vec::new();
    for (line, words) in text.split(['\n', '\r']).enumerate() {
        let mut words = words.split_whitespace();
        let Some(first) = words.next() else { continue };
        match &*first.to_ascii_lowercase() {
            "vertex" => corners.push(point(words).ok_or_else(|| at_line(line, "three numbers"))?),
            "endloop" => {
                let found = std::mem::take(&mut corners);
                let triangle = found.try_into();
                triangles.push(triangle.map_err(|_| at_line(line, "three corners before this"))?);
            }
            _ => {}
        }
    }
    if corners.is_empty() {
        Ok(triangles)
    } else {
        Err("ends within a triangle".into())
    }
}

/// Polygons become fans.
fn obj(text: &str) -> Result<Vec<Triangle>, String> {
    let whole = text.replace("\\\r\n", " ").replace("\\\n", " ");
    let mut points: Vec<Point> = Vec::new();
    let mut triangles = Vec::new();
    for (line, words) in whole.split(['\n', '\r']).enumerate() {
        let words = words.split('#').next().unwrap_or_default();
        let mut words = words.split_whitespace();
        match words.next() {
            Some("v") => points.push(point(words).ok_or_else(|| at_line(line, "three numbers"))?),
            Some("f") => {
                let corners: Option<Vec<Point>> = words.map(|word| corner(word, &points)).collect();
                let corners = corners.ok_or_else(|| at_line(line, "corners that are there"))?;
                let [first, ref others @ ..] = corners[..] else {
                    continue;
                };
                let pairs = others.windows(2);
                triangles.extend(pairs.map(|pair| [first, pair[0], pair[1]]));
            }
            _ => {}
        }
    }
    Ok(triangles)
}

/// A corner by its number, counted from 1, or from the end where it is negative; textures and
/// normals stand behind it.
fn corner(word: &str, points: &[Point]) -> Option<Point> {
    let number: i64 = word.split('/').next()?.parse().ok()?;
    let place = if number < 0 {
        points.len().checked_sub(usize::try_from(-number).ok()?)?
    } else {
        usize::try_from(number).ok()?.checked_sub(1)?
    };
    points.get(place).copied()
}

fn point<'w>(mut words: impl Iterator<Item = &'w str>) -> Option<Point> {
    let mut number = || words.next()?.parse().ok();
    Some([number()?, number()?, number()?])
}

fn at_line(line: usize, expected: &str) -> String {
    format!("cannot be read: expected {expected} in line {}", line + 1)
}
