//! A drawing of the reference configuration: views along the axes and from a corner, joints by
//! number, named points, and a table of them.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use holonom::nalgebra::{Rotation3, Vector3};

use crate::gears::Gearing;
use crate::labels::{self, Obstacles};
use crate::page::{Element, Marker, Wheel};
use crate::subject::{GROUND, Subject, colour, colour_of};

/// Width of the drawing, of which a view takes a half, or all.
const WIDTH: f64 = 720.0;
/// Width of a view that stands alone.
const ALONE: f64 = 480.0;
/// What stays free around a view.
const MARGIN: f64 = 34.0;
/// A line of the table.
const LINE: f64 = 19.0;
/// The largest height of a view over its width.
const TALLEST: f64 = 0.75;

/// Joints that are drawn as a line between two points.
const LINKS: [&str; 6] = [
    "Distance",
    "DistanceDriver",
    "RevoluteSpherical",
    "RevoluteRevolute",
    "Perpendicular2",
    "Parallel2",
];

/// A view: its title, and a rotation that turns what looks at it to z and what is up to y.
struct View {
    title: String,
    turn: Rotation3<f64>,
}

/// The drawing.
pub(crate) fn sketch(
    subject: &Subject<'_>,
    gearing: &Gearing,
    anchors: &[Marker],
    names: &[&str],
) -> String {
    let circles: Vec<_> = gearing
        .wheels
        .iter()
        .map(|wheel| circle(subject, wheel))
        .collect();
    let mut places = subject.all_places(0);
    places.extend(circles.iter().flat_map(|(_, circle)| circle));
    let (low, high) = places.iter().fold(
        (
            Vector3::repeat(f64::INFINITY),
            Vector3::repeat(f64::NEG_INFINITY),
        ),
        |(low, high), place| (low.inf(place), high.sup(place)),
    );
    let extent = high - low;
    let size = extent.max().max(f64::MIN_POSITIVE);
    let flat = (0..3)
        .rev()
        .find(|&k| extent[k] <= 1e-3 * size && subject.is_plane(k));
    let views = views(flat, subject.gravity.into());
    let wide = if views.len() == 1 { ALONE } else { WIDTH / 2.0 };
    let mut text = String::new();
    let mut top = 0.0;
    for row in views.chunks(2) {
        let scale = row
            .iter()
            .map(|view| scale(view, &places, wide))
            .fold(f64::INFINITY, f64::min);
        let mut height: f64 = 0.0;
        for (place, view) in row.iter().enumerate() {
            let left = wide * place as f64;
            height = height.max(panel(
                &mut text,
                (subject, &circles, anchors),
                view,
                &places,
                [left, top, wide, scale],
            ));
        }
        top += height;
    }
    top = table(&mut text, subject, names, top + 8.0);
    let title = escaped(subject.title);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {top:.0}\" width=\"100%\" \
         style=\"max-width:{WIDTH}px\" role=\"img\"><title>{title} in its reference configuration</title><style>\
         .holonom-sketch text{{font:12px sans-serif;fill:currentColor}}.holonom-sketch .view{{font-size:11px;opacity:.7}}\
         .holonom-sketch .head{{font-weight:600}}.holonom-sketch .axis{{stroke:currentColor;stroke-width:1.2;stroke-dasharray:5 3}}\
         .holonom-sketch .pin,.holonom-sketch .label{{fill:#fff;stroke:#39414f;stroke-width:1.2}}.holonom-sketch .lead{{stroke:currentColor;stroke-width:1}}\
         .holonom-sketch .number{{font-size:10px;fill:#222;text-anchor:middle}}\
         .holonom-sketch .foot{{fill:#8a93a3}}.holonom-sketch .force{{stroke:#8a93a3;stroke-width:2.5;stroke-dasharray:2 3}}\
         .holonom-sketch .centre{{fill:none;stroke:currentColor;stroke-width:1.2}}</style>\
         <g class=\"holonom-sketch\">{text}</g></svg>\n"
    )
}

/// Along the normal of a plane mechanism; of others along all axes and from a corner.
fn views(flat: Option<usize>, gravity: Vector3<f64>) -> Vec<View> {
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let up = gravity.try_normalize(0.0).map(|down| -down);
    let up = up.unwrap_or(if flat == Some(2) { axes[1] } else { axes[2] });
    let vertical = (0..3).max_by(|&k, &l| up[k].abs().total_cmp(&up[l].abs()));
    let vertical = vertical.unwrap_or(2);
    let up = axes[vertical] * up[vertical].signum();
    let name = |direction: &Vector3<f64>| {
        let k = (0..3).max_by(|&k, &l| direction[k].abs().total_cmp(&direction[l].abs()));
        let k = k.unwrap_or(0);
        let sign = if direction[k] < 0.0 { "−" } else { "" };
        format!("{sign}{}", ["x", "y", "z"][k])
    };
    let view = |towards: Vector3<f64>, up: Vector3<f64>| View {
        title: format!("{} right, {} up", name(&up.cross(&towards)), name(&up)),
        turn: Rotation3::face_towards(&towards, &up).inverse(),
    };
    if let Some(normal) = flat.filter(|&k| k != vertical) {
        // Right-handed, with what is horizontal to the right.
        let along = axes[3 - normal - vertical];
        return vec![view(along.cross(&up), up)];
    }
    let [a, b] = [axes[(vertical + 1) % 3], axes[(vertical + 2) % 3]];
    if flat == Some(vertical) {
        return vec![view(up, b)];
    }
    let corner = 0.5 * up + 0.6 * a - b;
    vec![
        view(-b, up),
        view(a, up),
        view(up, b),
        View {
            title: "from a corner".into(),
            turn: Rotation3::face_towards(&corner, &up).inverse(),
        },
    ]
}

fn bounds(view: &View, places: &[Vector3<f64>]) -> [f64; 4] {
    let turned = places.iter().map(|place| view.turn * place);
    turned.fold(
        [
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::INFINITY,
            f64::NEG_INFINITY,
        ],
        |[left, right, low, high], at| {
            [
                left.min(at.x),
                right.max(at.x),
                low.min(at.y),
                high.max(at.y),
            ]
        },
    )
}

fn scale(view: &View, places: &[Vector3<f64>], wide: f64) -> f64 {
    let [left, right, low, high] = bounds(view, places);
    let room = wide - 2.0 * MARGIN;
    let across = room / (right - left).max(f64::MIN_POSITIVE);
    let upright = room * TALLEST / (high - low).max(f64::MIN_POSITIVE);
    across.min(upright).min(1e12)
}

/// Draws a view; returns its height.
fn panel(
    text: &mut String,
    (subject, circles, anchors): (&Subject<'_>, &[Circle], &[Marker]),
    view: &View,
    places: &[Vector3<f64>],
    [left, top, wide, scale]: [f64; 4],
) -> f64 {
    let [least, most, low, high] = bounds(view, places);
    let height = scale * (high - low) + 2.0 * MARGIN;
    let start = left + (wide - scale * (most - least)) / 2.0;
    let at = |place: Vector3<f64>| {
        let turned = view.turn * place;
        [
            start + scale * (turned.x - least),
            top + MARGIN + scale * (high - turned.y),
        ]
    };
    let (x, y) = (left + 8.0, top + 14.0);
    let _ = write!(
        text,
        "<text class=\"view\" x=\"{x:.1}\" y=\"{y:.1}\">{}</text>",
        view.title
    );
    let mut obstacles = Obstacles::default();
    for (marker, _) in subject.feet() {
        let [x, y] = at(subject.place(0, None, marker.at));
        let (a, b, c) = (x - 10.0, x + 10.0, y + 15.0);
        let _ = write!(
            text,
            "<path class=\"foot\" d=\"M{x:.1},{y:.1}L{a:.1},{c:.1}H{b:.1}Z\"/>"
        );
    }
    bodies(text, subject, at, &mut obstacles);
    for (body, circle) in circles {
        for place in circle {
            obstacles.point(at(*place));
        }
        let places = circle.iter().map(|place| at(*place));
        let places: Vec<String> = places.map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let (places, colour) = (places.join(" "), body.map_or(GROUND, colour));
        let _ = write!(
            text,
            "<polygon points=\"{places}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"3\" stroke-dasharray=\"3 2\"/>"
        );
    }
    let is_line = |element: &Element| element.of == "force" || LINKS.contains(&element.kind);
    for line in (0..subject.elements.len()).filter(|&k| is_line(&subject.elements[k])) {
        let mut ends = subject.markers.iter();
        let mut ends = ends
            .by_ref()
            .filter(|marker| marker.element == line && marker.kind == "point");
        if let (Some(from), Some(to)) = (ends.next(), ends.next_back()) {
            let [x1, y1] = at(subject.place(0, from.body, from.at));
            let [x2, y2] = at(subject.place(0, to.body, to.at));
            obstacles.line([x1, y1], [x2, y2]);
            let _ = write!(
                text,
                "<line class=\"force\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>"
            );
        }
    }
    for point in subject.points {
        let [x, y] = at(subject.place(0, point.body, point.at));
        let (name, colour) = (escaped(&point.name), colour_of(point));
        let _ = write!(
            text,
            "<path class=\"point\" d=\"{}\" fill=\"{colour}\" stroke=\"#fff\"><title>{name}</title></path>",
            diamond([x, y])
        );
        obstacles.point([x, y]);
    }
    let labels = joints(text, (subject, anchors), at, scale, &mut obstacles);
    let within = [left, top, left + wide, top + height];
    labels::draw(text, &labels, obstacles, within);
    height
}

/// Bars and centres of mass.
fn bodies(
    text: &mut String,
    subject: &Subject<'_>,
    at: impl Fn(Vector3<f64>) -> [f64; 2],
    obstacles: &mut Obstacles,
) {
    for body in 0..subject.bodies {
        let bars = subject.bars(body);
        if bars.is_empty() {
            let ([x, y], colour) = (at(subject.place(0, Some(body), [0.0; 3])), colour(body));
            let _ = write!(
                text,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"11\" fill=\"{colour}\"/>"
            );
        }
        for [from, to] in bars {
            let [x1, y1] = at(subject.place(0, Some(body), from.into()));
            let [x2, y2] = at(subject.place(0, Some(body), to.into()));
            let colour = colour(body);
            obstacles.line([x1, y1], [x2, y2]);
            let _ = write!(
                text,
                "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{colour}\" stroke-width=\"7\" stroke-linecap=\"round\"/>"
            );
        }
        let [x, y] = at(subject.place(0, Some(body), [0.0; 3]));
        let (a, b, c, d) = (x - 4.0, x + 4.0, y - 4.0, y + 4.0);
        let _ = write!(
            text,
            "<path class=\"centre\" d=\"M{a:.1},{y:.1}H{b:.1}M{x:.1},{c:.1}V{d:.1}\"/>"
        );
    }
}

/// Axes of joints; where their numbers belong. Joints that are drawn at one place share a label.
fn joints(
    text: &mut String,
    (subject, anchors): (&Subject<'_>, &[Marker]),
    at: impl Fn(Vector3<f64>) -> [f64; 2],
    scale: f64,
    obstacles: &mut Obstacles,
) -> Vec<([f64; 2], String)> {
    let joints: Vec<&Element> = subject
        .elements
        .iter()
        .filter(|e| e.of == "joint")
        .collect();
    let mut labels: Vec<([f64; 2], Vec<usize>)> = Vec::new();
    for joint in 0..joints.len() {
        let own = |kind: &str| {
            let mut markers = subject.markers.iter().chain(anchors);
            let found = markers.find(|marker| marker.element == joint && marker.kind == kind);
            found.map(|marker| (marker.body, marker.at))
        };
        let Some((body, point)) = own("point").or_else(|| own("anchor")) else {
            continue;
        };
        let point = subject.place(0, body, point);
        if let Some((body, axis)) = own("axis") {
            let axis = subject.place(0, body, axis) - subject.place(0, body, [0.0; 3]);
            let along = axis * (22.0 / scale);
            let ([x1, y1], [x2, y2]) = (at(point - along), at(point + along));
            obstacles.line([x1, y1], [x2, y2]);
            let _ = write!(
                text,
                "<line class=\"axis\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>"
            );
        }
        let place = at(point);
        let near = |known: &[f64; 2]| (known[0] - place[0]).hypot(known[1] - place[1]) < 9.0;
        match labels.iter_mut().find(|(known, _)| near(known)) {
            Some((_, several)) => several.push(joint + 1),
            None => labels.push((place, vec![joint + 1])),
        }
    }
    let labels = labels.into_iter().map(|(place, several)| {
        let numbers: Vec<String> = several.iter().map(ToString::to_string).collect();
        (place, numbers.join(", "))
    });
    labels.collect()
}

/// The body of a wheel, and places around its pitch circle.
type Circle = (Option<usize>, Vec<Vector3<f64>>);

fn circle(subject: &Subject<'_>, wheel: &Wheel) -> Circle {
    let centre = subject.place(0, wheel.body, wheel.centre);
    let axis = subject.direction(0, wheel.body, wheel.axis);
    let first = wheel.radius * subject.direction(0, wheel.body, wheel.tooth);
    let around = (0..72).map(|step| {
        let (sine, cosine) = (TAU * f64::from(step) / 72.0).sin_cos();
        centre + cosine * first + sine * axis.cross(&first)
    });
    (wheel.body, around.collect())
}

/// Bodies by colour, joints and forces by number, named points; returns where it ends.
fn table(text: &mut String, subject: &Subject<'_>, names: &[&str], top: f64) -> f64 {
    let mut y = top;
    let mut x = 12.0;
    for (body, name) in names.iter().enumerate() {
        let wide = 34.0 + 7.2 * name.chars().count() as f64;
        if x + wide > WIDTH {
            (x, y) = (12.0, y + LINE);
        }
        let (over, after, base, colour) = (y + 2.0, x + 18.0, y + 12.0, colour(body));
        let _ = write!(
            text,
            "<rect x=\"{x:.1}\" y=\"{over:.1}\" width=\"12\" height=\"12\" rx=\"3\" fill=\"{colour}\"/>\
             <text x=\"{after:.1}\" y=\"{base:.1}\">{}</text>",
            escaped(name)
        );
        x += wide;
    }
    y += 1.6 * LINE;
    let name = |body: &Option<usize>| body.map_or("ground", |body| names[body]);
    for (number, element) in subject.elements.iter().enumerate() {
        let number = match element.of {
            "joint" => (number + 1).to_string(),
            _ => "force".into(),
        };
        let bodies: Vec<&str> = element.bodies.iter().map(name).collect();
        let base = y + 12.0;
        let cells = [
            (12.0, number),
            (64.0, element.name.into()),
            (250.0, element.kind.into()),
            (430.0, bodies.join(", ")),
        ];
        for (x, cell) in cells {
            let _ = write!(
                text,
                "<text x=\"{x}\" y=\"{base:.1}\">{}</text>",
                escaped(&cell)
            );
        }
        y += LINE;
    }
    for point in subject.points {
        let (mark, base, colour) = (diamond([18.0, y + 8.0]), y + 12.0, colour_of(point));
        let (place, on) = (escaped(&point.name), escaped(name(&point.body)));
        let _ = write!(
            text,
            "<path class=\"point\" d=\"{mark}\" fill=\"{colour}\" stroke=\"#fff\"/>\
             <text x=\"64\" y=\"{base:.1}\">{place}</text><text x=\"250\" y=\"{base:.1}\">Point</text>\
             <text x=\"430\" y=\"{base:.1}\">{on}</text>"
        );
        y += LINE;
    }
    y + 8.0
}

/// The mark of a named point.
fn diamond([x, y]: [f64; 2]) -> String {
    format!("M{:.1},{y:.1}l6,-6l6,6l-6,6Z", x - 6.0)
}

/// Of HTML, and of Markdown, in which it may stand.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('[', "&#91;").replace('_', "&#95;")
}
