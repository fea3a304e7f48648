//! Numbers of joints beside what is drawn: a pin where the joint is, and its number where little is
//! in the way.

use std::f64::consts::TAU;
use std::fmt::Write as _;

/// Height of a label, and the radius of a pin.
const HEIGHT: f64 = 15.0;
const PIN: f64 = 3.2;
/// From a pin to the middle of a label, the nearer way first.
const FAR: [f64; 2] = [17.0, 27.0];
/// Directions that are tried.
const WAYS: usize = 12;
/// Half the width of a bar, and how far apart the places on it are that are looked at.
const THICK: f64 = 3.5;
const STEP: f64 = 3.0;

/// What is in the way of labels: places of the drawing.
#[derive(Default)]
pub(crate) struct Obstacles(Vec<[f64; 2]>);

impl Obstacles {
    pub(crate) fn line(&mut self, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
        let steps = ((x2 - x1).hypot(y2 - y1) / STEP).ceil().clamp(1.0, 1000.0);
        for step in 0..=steps as usize {
            let part = step as f64 / steps;
            self.point([x1 + part * (x2 - x1), y1 + part * (y2 - y1)]);
        }
    }

    pub(crate) fn point(&mut self, at: [f64; 2]) {
        self.0.push(at);
    }
}

/// The middle and half the sizes of a label.
type Rectangle = ([f64; 2], [f64; 2]);

/// What a label at a place would hide, and how far it is out of the panel.
fn cost(
    (middle, half): Rectangle,
    obstacles: &Obstacles,
    placed: &[Rectangle],
    [left, top, right, bottom]: [f64; 4],
) -> f64 {
    let covers = |at: &&[f64; 2]| (0..2).all(|k| (at[k] - middle[k]).abs() < half[k] + THICK);
    let hidden = obstacles.0.iter().filter(covers).count();
    let meets = |(other, size): &&Rectangle| {
        (0..2).all(|k| (other[k] - middle[k]).abs() < half[k] + size[k] + 1.0)
    };
    let met = placed.iter().filter(meets).count();
    let out = (left - middle[0] + half[0])
        .max(middle[0] + half[0] - right)
        .max(top - middle[1] + half[1])
        .max(middle[1] + half[1] - bottom)
        .max(0.0);
    hidden as f64 + 30.0 * met as f64 + 10.0 * out
}

/// Draws pins with their numbers into a panel (left, top, right, bottom).
pub(crate) fn draw(
    text: &mut String,
    labels: &[([f64; 2], String)],
    mut obstacles: Obstacles,
    panel: [f64; 4],
) {
    for (place, _) in labels {
        obstacles.point(*place);
    }
    let mut placed: Vec<Rectangle> = Vec::new();
    for ([x, y], number) in labels {
        let half = [4.0 + 2.9 * number.chars().count() as f64, 0.5 * HEIGHT];
        let tries = FAR
            .iter()
            .flat_map(|far| (0..WAYS).map(move |way| (*far, way)));
        let places = tries.map(|(far, way)| {
            // The first way is up and to the right.
            let (sine, cosine) = (TAU * (way as f64 / WAYS as f64 + 0.125)).sin_cos();
            let far = far + (half[0] - half[1]) * cosine.abs();
            ([x + far * cosine, y - far * sine], half)
        });
        let costs = places.map(|place| (cost(place, &obstacles, &placed, panel), place));
        let best = costs.reduce(|best, next| if next.0 < best.0 { next } else { best });
        let Some((_, (middle, half))) = best else {
            continue;
        };
        placed.push((middle, half));
        let [mx, my] = middle;
        let (left, over, wide, base) = (mx - half[0], my - half[1], 2.0 * half[0], my + 3.5);
        let _ = write!(
            text,
            "<g><line class=\"lead\" x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{mx:.1}\" y2=\"{my:.1}\"/>\
             <circle class=\"pin\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{PIN}\"/>\
             <rect class=\"label\" x=\"{left:.1}\" y=\"{over:.1}\" width=\"{wide:.1}\" height=\"{HEIGHT}\" rx=\"7.5\"/>\
             <text class=\"number\" x=\"{mx:.1}\" y=\"{base:.1}\">{number}</text></g>"
        );
    }
}
