//! Whether a surface encloses nothing twice, and nothing less than once: how often it turns around
//! points beside it, once or not at all.
//!
//! That is looked at on both sides of some triangles, all over the surface. Surfaces that touch
//! pass. So does what overlaps by less than a hundredth of a triangle, or far from these places.

use std::f64::consts::TAU;

use super::bulk::determinant;
use super::surface::{Point, Surface, Triangle};

/// Solid angles, at most: unoptimised code computes a million in some second.
const ANGLES: usize = 1_200_000;

/// Places on the surface by number, and as many by area, at least and at most.
const PLACES: [usize; 2] = [8, 256];

/// How far from the surface, in edges of a triangle.
const BESIDE: f64 = 0.01;

/// Of how often a surface turns around a point on it, nothing can be said.
const UNSURE: f64 = 0.2;

/// Whether the surface turns once or not at all around points beside it.
pub(super) fn judge(surface: &Surface) -> Result<(), String> {
    let triangles: Vec<Triangle> = surface.triangles().collect();
    for (place, shares) in places(&triangles) {
        let triangle = &triangles[place];
        for side in [-BESIDE, BESIDE] {
            let at = beside(triangle, shares, side);
            let turns = turns(&triangles, at);
            let often = turns.round();
            if (turns - often).abs() > UNSURE || (0.0..=1.0).contains(&often) {
                continue;
            }
            let what = if often > 1.0 {
                "solids that overlap, which would count twice"
            } else {
                "a piece that is inside out"
            };
            return Err(format!("has {what}, as at {at:?}"));
        }
    }
    Ok(())
}

/// Triangles and shares of their corners: half of them by number, half by area.
fn places(triangles: &[Triangle]) -> Vec<(usize, Point)> {
    let [least, most] = PLACES;
    let count = (ANGLES / 4 / triangles.len().max(1)).clamp(least, most);
    let areas: Vec<f64> = triangles
        .iter()
        .map(|triangle| norm(doubled(triangle)))
        .collect();
    let area: f64 = areas.iter().sum();
    let mut places = Vec::new();
    let (mut large, mut below) = (0, areas.first().copied().unwrap_or(0.0));
    for number in 0..count {
        // The golden ratio, and what it is in two dimensions, spread evenly.
        let part = |step: f64| (0.5 + step * number as f64).fract();
        let share = (number as f64 + 0.5) / count as f64;
        let (mut u, mut v) = (part(0.754_877_666_246_693), part(0.569_840_290_998_053));
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        let shares = [1.0 - u - v, u, v];
        places.push(((share * triangles.len() as f64) as usize, shares));
        while below < share * area && large + 1 < triangles.len() {
            large += 1;
            below += areas[large];
        }
        places.push((large, shares));
    }
    places.retain(|&(place, _)| areas[place] > 0.0);
    places
}

/// A point beside a triangle, by shares of its corners; outwards where `side` is positive.
fn beside(triangle: &Triangle, shares: Point, side: f64) -> Point {
    let normal = doubled(triangle);
    let far = side / norm(normal).sqrt();
    [0, 1, 2].map(|k| {
        let on_it: f64 = (0..3)
            .map(|corner| shares[corner] * triangle[corner][k])
            .sum();
        on_it + far * normal[k]
    })
}

/// How often triangles turn around a point, by their solid angles: A. van Oosterom, J. Strackee,
/// IEEE Trans. Biomed. Eng. 30 (1983) 125-126.
fn turns(triangles: &[Triangle], point: Point) -> f64 {
    let angles = triangles.iter().map(|corners| {
        let [a, b, c] = corners.map(|corner| from(point, corner));
        let [x, y, z] = [norm(a), norm(b), norm(c)];
        let below = x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y;
        determinant(a, b, c).atan2(below)
    });
    angles.sum::<f64>() / TAU
}

/// The normal of a triangle, of the length of twice its area.
fn doubled([a, b, c]: &Triangle) -> Point {
    let (u, v) = (from(*a, *b), from(*a, *c));
    [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ]
}

fn from(origin: Point, point: Point) -> Point {
    [0, 1, 2].map(|k| point[k] - origin[k])
}

fn norm(v: Point) -> f64 {
    dot(v, v).sqrt()
}

fn dot(a: Point, b: Point) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}
