//! A moving picture without a program in it: an SVG whose lines are animated, for a README or a
//! page of documentation.

use std::fmt::Write as _;

use holonom::nalgebra::{Rotation3, Vector3};

use crate::page::{Element, Marker};
use crate::subject::{Subject, colour, colour_of};

/// Width of a picture, and what stays free on each side.
const WIDTH: f64 = 640.0;
const MARGIN: f64 = 36.0;
/// Frames that are drawn: a browser draws straight lines between them.
const FRAMES: usize = 120;
/// Places that a trace is drawn through, at most.
const WAY: usize = 500;
/// Below this part of the size, points lie in one plane.
const SAME: f64 = 1e-3;

impl Subject<'_> {
    /// The picture.
    pub(crate) fn svg(&self) -> String {
        let frames = self.frames();
        let sheet = Sheet::new(self, &frames);
        let (first, last) = (frames[0], frames[frames.len() - 1]);
        let duration = self.times[last] - self.times[first];
        // What is over at once, or lasts for minutes, is shown in six seconds.
        let shown = if (1.0..=20.0).contains(&duration) {
            duration
        } else {
            6.0
        };
        let mut pen = Pen {
            sheet: &sheet,
            text: String::new(),
            duration: shown,
        };
        for trace in self.traces {
            // In more frames than what moves: a line does not bend between them.
            let way = (0..self.times.len()).step_by(1 + self.times.len() / WAY);
            let way = way.map(|frame| self.place(frame, trace.body, trace.at));
            pen.trace(&way.collect::<Vec<_>>(), colour_of(trace));
        }
        for (marker, element) in self.feet() {
            let at = self.place(first, None, marker.at);
            pen.foot(at, &format!("{}: {}", element.name, element.kind));
        }
        for body in 0..self.bodies {
            for [from, to] in self.bars(body) {
                let ends = frames
                    .iter()
                    .map(|&frame| [from, to].map(|at| self.place(frame, Some(body), at.into())));
                pen.bar(&ends.collect::<Vec<_>>(), colour(body));
            }
        }
        for (marker, _) in self.named_by_joints() {
            if marker.place == 0 && marker.kind == "point" {
                let way = frames
                    .iter()
                    .map(|&frame| self.place(frame, marker.body, marker.at));
                pen.pin(&way.collect::<Vec<_>>());
            }
        }
        for trace in self.traces {
            let way = frames
                .iter()
                .map(|&frame| self.place(frame, trace.body, trace.at));
            pen.dot(&way.collect::<Vec<_>>(), colour_of(trace));
        }
        let (width, height) = (WIDTH, sheet.height);
        let title = self.title.replace('&', "&amp;").replace('<', "&lt;");
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height:.0}\" width=\"{width}\" \
             height=\"{height:.0}\" role=\"img\">\n<title>{title}</title>\n<style>\
             .pin{{fill:#fff;stroke:#39414f;stroke-width:2.5}}.foot{{fill:#8a93a3}}\
             @media(prefers-color-scheme:dark){{.pin{{fill:#1c212b;stroke:#d5dbe6}}}}</style>\n{}</svg>\n",
            pen.text
        )
    }

    /// The frames that are drawn.
    fn frames(&self) -> Vec<usize> {
        let last = self.times.len() - 1;
        let count = FRAMES.min(last).max(1);
        (0..=count).map(|k| k * last / count).collect()
    }

    fn named_by_joints(&self) -> impl Iterator<Item = (&Marker, &Element)> {
        let named = self.markers.iter();
        let named = named.map(|marker| (marker, &self.elements[marker.element]));
        named.filter(|(_, element)| element.of == "joint")
    }
}

/// From places to the paper.
struct Sheet {
    turn: Rotation3<f64>,
    scale: f64,
    left: f64,
    top: f64,
    height: f64,
}

impl Sheet {
    fn new(subject: &Subject<'_>, frames: &[usize]) -> Self {
        let places = frames.iter().flat_map(|&frame| subject.all_places(frame));
        let places: Vec<_> = places.collect();
        let turn = direction(&places, subject.gravity.into());
        let turned: Vec<_> = places.iter().map(|place| turn * place).collect();
        let bounds = |axis: usize| {
            let along = turned.iter().map(|place| place[axis]);
            (
                along.clone().fold(f64::INFINITY, f64::min),
                along.fold(f64::NEG_INFINITY, f64::max),
            )
        };
        let ((left, right), (low, top)) = (bounds(0), bounds(1));
        let inner = WIDTH - 2.0 * MARGIN;
        // Not higher than it is wide.
        let scale = inner / (right - left).max(top - low).max(f64::MIN_POSITIVE);
        Self {
            turn,
            scale,
            left: left - ((inner / scale) - (right - left)) / 2.0,
            top,
            height: scale * (top - low) + 2.0 * MARGIN,
        }
    }

    fn at(&self, place: &Vector3<f64>) -> [f64; 2] {
        let turned = self.turn * place;
        [
            MARGIN + self.scale * (turned.x - self.left),
            MARGIN + self.scale * (self.top - turned.y),
        ]
    }
}

/// Turns the way of looking to z and up to y: at a plane motion along its normal, else from a
/// corner.
fn direction(places: &[Vector3<f64>], gravity: Vector3<f64>) -> Rotation3<f64> {
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let thickness = |axis: &Vector3<f64>| {
        let along = places.iter().map(|place| place.dot(axis));
        let low = along.clone().fold(f64::INFINITY, f64::min);
        along.fold(f64::NEG_INFINITY, f64::max) - low
    };
    let extents = axes.map(|axis| thickness(&axis));
    let size = extents.iter().fold(0.0, |most: f64, x| most.max(*x));
    let flat = (0..3)
        .rev()
        .find(|&k| extents[k] <= SAME * size)
        .map(|k| axes[k]);
    let up = gravity.try_normalize(0.0).map(|down| -down);
    let up = up.unwrap_or(if flat == Some(axes[2]) {
        axes[1]
    } else {
        axes[2]
    });
    let aside = if up.x.abs() < 0.9 { axes[0] } else { axes[1] };
    let corner = 0.55 * up + 0.55 * aside + aside.cross(&up);
    let towards = flat
        .filter(|normal| normal.dot(&up).abs() < 0.9)
        .unwrap_or(corner);
    Rotation3::face_towards(&towards, &up).inverse()
}

struct Pen<'a> {
    sheet: &'a Sheet,
    text: String,
    duration: f64,
}

impl Pen<'_> {
    /// Values of an attribute over the frames, where it changes.
    fn animate(&self, name: &str, values: impl Iterator<Item = f64> + Clone) -> String {
        let mut rest = values.clone();
        let first = rest.next().unwrap_or_default();
        if rest.all(|value| (value - first).abs() < 0.05) {
            return String::new();
        }
        let list: Vec<String> = values.map(|value| format!("{value:.1}")).collect();
        let (list, duration) = (list.join(";"), self.duration);
        format!(
            "<animate attributeName=\"{name}\" values=\"{list}\" dur=\"{duration:.2}s\" repeatCount=\"indefinite\"/>"
        )
    }

    fn bar(&mut self, ends: &[[Vector3<f64>; 2]], colour: &str) {
        let ends: Vec<_> = ends
            .iter()
            .map(|ends| ends.each_ref().map(|end| self.sheet.at(end)))
            .collect();
        let [[x1, y1], [x2, y2]] = ends[0];
        let moves =
            [("x1", 0, 0), ("y1", 0, 1), ("x2", 1, 0), ("y2", 1, 1)].map(|(name, end, axis)| {
                self.animate(name, ends.iter().map(move |ends| ends[end][axis]))
            });
        let _ = writeln!(
            self.text,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{colour}\" stroke-width=\"11\" \
             stroke-linecap=\"round\">{}</line>",
            moves.concat()
        );
    }

    fn circle(&mut self, way: &[Vector3<f64>], radius: f64, look: &str) {
        let way: Vec<_> = way.iter().map(|place| self.sheet.at(place)).collect();
        let [x, y] = way[0];
        let moves = [("cx", 0), ("cy", 1)]
            .map(|(name, axis)| self.animate(name, way.iter().map(move |at| at[axis])));
        let _ = writeln!(
            self.text,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" {look}>{}</circle>",
            moves.concat()
        );
    }

    fn pin(&mut self, way: &[Vector3<f64>]) {
        self.circle(way, 4.5, "class=\"pin\"");
    }

    fn dot(&mut self, way: &[Vector3<f64>], colour: &str) {
        self.circle(way, 3.5, &format!("fill=\"{colour}\" stroke=\"#fff\""));
    }

    fn trace(&mut self, way: &[Vector3<f64>], colour: &str) {
        let places = way.iter().map(|place| self.sheet.at(place));
        let list: Vec<String> = places.map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let list = list.join(" ");
        let _ = writeln!(
            self.text,
            "<polyline points=\"{list}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.5\" stroke-opacity=\"0.55\"/>"
        );
    }

    /// The ground below a joint.
    fn foot(&mut self, at: Vector3<f64>, name: &str) {
        let [x, y] = self.sheet.at(&at);
        let name = name.replace('<', "&lt;");
        let (left, right, low) = (x - 13.0, x + 13.0, y + 20.0);
        let _ = writeln!(
            self.text,
            "<path class=\"foot\" d=\"M{x:.1},{y:.1}L{left:.1},{low:.1}H{right:.1}Z\"><title>{name}</title></path>"
        );
    }
}
