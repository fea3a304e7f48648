//! A pen that draws solids, axes and arrows in space onto a page, as SVG.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

use holonom::nalgebra::Vector3;

pub(crate) type V = Vector3<f64>;

/// From x, towards y: the direction from which one looks, in degrees, and how high it is.
const AZIMUTH: f64 = 33.0;
const ELEVATION: f64 = 24.0;

pub(crate) fn v(x: f64, y: f64, z: f64) -> V {
    V::new(x, y, z)
}

/// Whose solid it is.
#[derive(Clone, Copy)]
pub(crate) enum Of {
    I,
    J,
    K,
}

impl Of {
    fn letter(self) -> char {
        match self {
            Self::I => 'i',
            Self::J => 'j',
            Self::K => 'k',
        }
    }
}

#[derive(Default)]
pub(crate) struct Pen {
    pub(crate) text: String,
}

fn towards_viewer() -> V {
    let (az, el) = (AZIMUTH.to_radians(), ELEVATION.to_radians());
    v(el.cos() * az.cos(), el.cos() * az.sin(), el.sin())
}

fn at(place: V) -> [f64; 2] {
    let (az, el) = (AZIMUTH.to_radians(), ELEVATION.to_radians());
    let right = v(-az.sin(), az.cos(), 0.0);
    let up = v(-el.sin() * az.cos(), -el.sin() * az.sin(), el.cos());
    [place.dot(&right), -place.dot(&up)]
}

fn path(places: &[[f64; 2]]) -> String {
    let mut text = String::from("M");
    for [x, y] in places {
        let _ = write!(text, "{:.0},{:.0} ", 10.0 * x, 10.0 * y);
    }
    text.truncate(text.len() - 1);
    text
}

/// Two unit vectors across a direction, right-handed with it.
fn frame(axis: V) -> (V, V, V) {
    let w = axis.normalize();
    let other = if w.z.abs() < 0.9 { V::z() } else { V::x() };
    let u = other.cross(&w).normalize();
    (u, w.cross(&u), w)
}

fn circle(centre: V, axis: V, radius: f64) -> Vec<V> {
    let (u, w, _) = frame(axis);
    let steps = 20;
    let angle = |step: i32| TAU * f64::from(step) / f64::from(steps);
    let on =
        (0..steps).map(|step| centre + radius * (angle(step).cos() * u + angle(step).sin() * w));
    on.collect()
}

/// The corners of the smallest convex polygon (Andrew's monotone chain).
fn hull(mut places: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    places.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let half = |places: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut kept: Vec<[f64; 2]> = Vec::new();
        for place in places {
            while let [.., a, b] = kept[..] {
                let turn = (b[0] - a[0]) * (place[1] - a[1]) - (b[1] - a[1]) * (place[0] - a[0]);
                if turn > 0.0 {
                    break;
                }
                kept.pop();
            }
            kept.push(place);
        }
        kept.pop();
        kept
    };
    let lower = half(&mut places.iter().copied());
    let upper = half(&mut places.iter().rev().copied());
    [lower, upper].concat()
}

impl Pen {
    fn fill(&mut self, class: &str, places: &[[f64; 2]]) {
        let _ = write!(
            self.text,
            "<path class=\"{class}\" d=\"{}z\"/>",
            path(places)
        );
    }

    /// A box about a centre, its half sizes along x, y, z.
    pub(crate) fn block(&mut self, of: Of, centre: V, half: V) {
        for (axis, shade) in [(2, 1), (1, 2), (0, 3)] {
            let (k, l) = ((axis + 1) % 3, (axis + 2) % 3);
            let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(a, b)| {
                // All axes point towards the viewer.
                let mut off = V::zeros();
                (off[axis], off[k], off[l]) = (half[axis], a * half[k], b * half[l]);
                at(centre + off)
            });
            self.fill(&format!("{}{shade}", of.letter()), &corners);
        }
    }

    /// A cylinder.
    pub(crate) fn cylinder(&mut self, of: Of, from: V, to: V, radius: f64) {
        let axis = to - from;
        let (near, far) = if axis.dot(&towards_viewer()) > 0.0 {
            (to, from)
        } else {
            (from, to)
        };
        let cap: Vec<_> = circle(near, axis, radius).into_iter().map(at).collect();
        let back = circle(far, axis, radius).into_iter().map(at);
        let side = hull(cap.iter().copied().chain(back).collect());
        self.fill(&format!("{}2", of.letter()), &side);
        self.fill(&format!("{}1", of.letter()), &cap);
    }

    /// Rings on a cylinder, as of a thread.
    pub(crate) fn thread(&mut self, from: V, to: V, radius: f64, turns: i32) {
        let axis = to - from;
        for turn in 1..turns {
            let centre = from + axis * (f64::from(turn) / f64::from(turns));
            let (u, w, _) = frame(axis);
            let seen = |angle: f64| radius * (angle.cos() * u + angle.sin() * w);
            let steps = (0..48).map(|step| seen(TAU * f64::from(step) / 48.0));
            let mut front: Vec<V> = steps
                .filter(|off| off.dot(&towards_viewer()) > 0.0)
                .collect();
            front.sort_by(|a, b| at(*a)[1].total_cmp(&at(*b)[1]));
            let front: Vec<_> = front
                .into_iter()
                .step_by(4)
                .map(|off| at(centre + off))
                .collect();
            let _ = write!(self.text, "<path class=\"h\" d=\"{}\"/>", path(&front));
        }
    }

    pub(crate) fn ball(&mut self, of: Of, centre: V, radius: f64) {
        let [x, y] = at(centre).map(|x| 10.0 * x);
        let (letter, r) = (of.letter(), 10.0 * radius);
        let _ = write!(
            self.text,
            "<circle class=\"{letter}1\" cx=\"{x:.0}\" cy=\"{y:.0}\" r=\"{r:.0}\"/>"
        );
    }

    /// A toothed wheel about an axis, as thick as twice `half`.
    pub(crate) fn wheel(
        &mut self,
        of: Of,
        centre: V,
        axis: V,
        radius: f64,
        teeth: i32,
        first: f64,
    ) {
        let (u, w, n) = frame(axis);
        let mut edge = Vec::new();
        for tooth in 0..teeth {
            for (side, up) in [(-0.34, -1.0), (-0.14, 1.0), (0.14, 1.0), (0.34, -1.0)] {
                let angle = TAU * (f64::from(tooth) + side + first) / f64::from(teeth);
                let far = radius + up * 1.8 * radius / f64::from(teeth);
                edge.push(centre + far * (angle.cos() * u + angle.sin() * w));
            }
        }
        self.plate(of, n, &edge);
    }

    /// A plate of a thickness of 8 across an axis, by its edge.
    pub(crate) fn plate(&mut self, of: Of, axis: V, edge: &[V]) {
        let off = 4.0 * axis * axis.dot(&towards_viewer()).signum();
        let front: Vec<_> = edge.iter().map(|place| at(place + off)).collect();
        let back: Vec<_> = edge.iter().map(|place| at(place - off)).collect();
        self.fill(
            &format!("{}2", of.letter()),
            &hull([front.clone(), back].concat()),
        );
        self.fill(&format!("{}1", of.letter()), &front);
    }

    /// A point that is written.
    pub(crate) fn dot(&mut self, place: V) {
        let [x, y] = at(place).map(|x| 10.0 * x);
        let _ = write!(
            self.text,
            "<circle class=\"p\" cx=\"{x:.0}\" cy=\"{y:.0}\" r=\"30\"/>"
        );
    }

    /// A thin line.
    pub(crate) fn line(&mut self, from: V, to: V) {
        let _ = write!(
            self.text,
            "<path class=\"l\" d=\"{}\"/>",
            path(&[at(from), at(to)])
        );
    }

    fn head(&mut self, class: &str, tip: [f64; 2], way: [f64; 2]) {
        let long = way[0].hypot(way[1]);
        let [x, y] = way.map(|x| x / long);
        let side = |s: f64| [tip[0] - 8.0 * x - s * y, tip[1] - 8.0 * y + s * x];
        self.fill(class, &[tip, side(3.4), side(-3.4)]);
    }

    /// An axis that is written: dashes with a head.
    pub(crate) fn axis(&mut self, from: V, to: V) {
        let [a, b] = [at(from), at(to)];
        let _ = write!(self.text, "<path class=\"a\" d=\"{}\"/>", path(&[a, b]));
        self.head("p", b, [b[0] - a[0], b[1] - a[1]]);
    }

    /// What a positive displacement is.
    pub(crate) fn way(&mut self, from: V, to: V) {
        let [a, b] = [at(from), at(to)];
        let _ = write!(self.text, "<path class=\"g\" d=\"{}\"/>", path(&[a, b]));
        self.head("q", b, [b[0] - a[0], b[1] - a[1]]);
    }

    /// What a positive angle is: right-handed about an axis, in degrees from a direction across it.
    pub(crate) fn turn(&mut self, centre: V, axis: V, from: V, [start, end]: [f64; 2]) {
        let (n, u) = (axis.normalize(), from);
        let on = |angle: f64| {
            let angle = angle * PI / 180.0;
            at(centre + angle.cos() * u + angle.sin() * n.cross(&u))
        };
        let steps = 10;
        let places: Vec<_> = (0..=steps)
            .map(|step| on(start + (end - start) * f64::from(step) / f64::from(steps)))
            .collect();
        let _ = write!(self.text, "<path class=\"g\" d=\"{}\"/>", path(&places));
        // The head is as long as the last steps of the arc.
        let [tip, before] = [on(end), on(end - 9.0 * (end - start).signum())];
        self.head("q", tip, [tip[0] - before[0], tip[1] - before[1]]);
    }

    /// A word beside a place, to the right or to the left of it.
    pub(crate) fn word(&mut self, class: &str, place: V, [x, y]: [f64; 2], word: &str) {
        let [a, b] = at(place);
        let (x, y) = (10.0 * (a + x), 10.0 * (b + y));
        let _ = write!(
            self.text,
            "<text class=\"{class}\" x=\"{x:.0}\" y=\"{y:.0}\">{word}</text>"
        );
    }
}
