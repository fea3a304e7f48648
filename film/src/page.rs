//! The data of a page, as the viewer reads it (`viewer/src/data.js`).

use crate::json::object;
pub(crate) use crate::json::{Floats, Shorts};

/// Everything that a page shows.
pub(crate) struct Page<'a> {
    pub(crate) title: &'a str,
    pub(crate) bodies: &'a [Body],
    pub(crate) elements: &'a [Element],
    pub(crate) markers: &'a [Marker],
    pub(crate) points: &'a [Point],
    pub(crate) shapes: &'a [Shape],
    pub(crate) meshes: &'a [Mesh],
    pub(crate) wheels: &'a [Wheel],
    pub(crate) racks: &'a [Rack],
    /// Gravity (m/s^2), which points down.
    pub(crate) gravity: [f64; 3],
    pub(crate) times: &'a [f64],
    /// Seven numbers a body and frame: position (m) and Euler parameters, the scalar first.
    pub(crate) poses: Floats<'a>,
    pub(crate) ghost: Option<Other<'a>>,
    /// Six numbers an arrow and frame: point (m) and force (N).
    pub(crate) loads: Floats<'a>,
    pub(crate) arrows: &'a [Arrow],
    pub(crate) show_arrows: bool,
    pub(crate) traces: &'a [Point],
    pub(crate) readings: Vec<Reading<'a>>,
    pub(crate) warnings: &'a [Remark],
}

/// A solid on a body, its length along its x axis.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    pub(crate) body: usize,
    pub(crate) kind: &'static str,
    /// As the mechanism lists them (m).
    pub(crate) sizes: [f64; 3],
    /// From the centre of mass (m, body axes).
    pub(crate) centre: [f64; 3],
    /// Euler parameters, the scalar first.
    pub(crate) axes: [f64; 4],
}

/// Another run of the same mechanism.
pub(crate) struct Other<'a> {
    pub(crate) title: &'a str,
    pub(crate) times: &'a [f64],
    pub(crate) poses: Floats<'a>,
}

/// A mesh on a body (`None` is the ground), in its axes.
#[derive(Clone, Debug)]
pub(crate) struct Mesh {
    pub(crate) body: Option<usize>,
    /// Such as `#4c8eda`; that of the body without one.
    pub(crate) colour: Option<String>,
    /// Its box (m, from the centre of mass).
    pub(crate) low: [f32; 3],
    pub(crate) high: [f32; 3],
    /// Three numbers a corner: parts of the box, in steps of 1/65535.
    pub(crate) corners: Shorts,
    /// Three corners a triangle, anticlockwise from outside.
    pub(crate) faces: Shorts,
}

/// A toothed wheel on a body (`None` is the ground), in its axes.
#[derive(Clone, Debug)]
pub(crate) struct Wheel {
    /// The joints that it belongs to.
    pub(crate) elements: Vec<usize>,
    pub(crate) body: Option<usize>,
    /// From the centre of mass (m).
    pub(crate) centre: [f64; 3],
    pub(crate) axis: [f64; 3],
    /// Towards the middle of a tooth.
    pub(crate) tooth: [f64; 3],
    /// Of the pitch circle (m).
    pub(crate) radius: f64,
    pub(crate) teeth: u32,
    /// Whether its teeth point inwards.
    pub(crate) is_ring: bool,
}

/// A rack on a body, in its axes.
#[derive(Clone, Debug)]
pub(crate) struct Rack {
    pub(crate) element: usize,
    pub(crate) body: Option<usize>,
    /// The middle of a tooth on the pitch line (m, from the centre of mass).
    pub(crate) at: [f64; 3],
    pub(crate) along: [f64; 3],
    /// Where its teeth point.
    pub(crate) tips: [f64; 3],
    /// From tooth to tooth (m).
    pub(crate) pitch: f64,
    /// The first and the last tooth, counted from that one.
    pub(crate) teeth: [i32; 2],
}

#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub(crate) name: &'static str,
    pub(crate) particle: bool,
}

/// A joint or a force.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    pub(crate) name: &'static str,
    pub(crate) kind: &'static str,
    pub(crate) of: &'static str,
    pub(crate) bodies: &'static [Option<usize>],
}

/// A point or direction in the user's axes of its body, a point from the centre of mass. Where a
/// joint or force names no point, an anchor says where its symbol is.
#[derive(Clone, Debug)]
pub(crate) struct Marker {
    pub(crate) element: usize,
    pub(crate) place: usize,
    pub(crate) body: Option<usize>,
    pub(crate) name: &'static str,
    pub(crate) kind: &'static str,
    pub(crate) at: [f64; 3],
}

/// A reaction of a joint on the body at a place of its `between`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arrow {
    pub(crate) joint: usize,
    pub(crate) place: usize,
    /// Its point of this body in the report: a link between two points acts at each end.
    pub(crate) marker: Option<usize>,
}

/// A point of a body (`None` is the ground) that has a name: a point of the description, or one
/// whose way is drawn.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    pub(crate) name: String,
    pub(crate) body: Option<usize>,
    /// From the centre of mass along the user's body axes, on the ground from the origin (m).
    pub(crate) at: [f64; 3],
}

pub(crate) struct Reading<'a> {
    pub(crate) name: &'a str,
    pub(crate) unit: &'a str,
    pub(crate) values: Floats<'a>,
}

/// A warning of the run, and when.
#[derive(Clone, Debug)]
pub(crate) struct Remark {
    pub(crate) text: String,
    pub(crate) time: Option<f64>,
}

object! { Page<'_> {
    "title": title,
    "bodies": bodies,
    "elements": elements,
    "markers": markers,
    "points": points,
    "shapes": shapes,
    "meshes": meshes,
    "wheels": wheels,
    "racks": racks,
    "gravity": gravity,
    "times": times,
    "poses": poses,
    "ghost": ghost,
    "loads": loads,
    "arrows": arrows,
    "showArrows": show_arrows,
    "traces": traces,
    "readings": readings,
    "warnings": warnings,
} }

object! { Shape {
    "body": body,
    "kind": kind,
    "sizes": sizes,
    "centre": centre,
    "axes": axes,
} }

object! { Other<'_> {
    "title": title,
    "times": times,
    "poses": poses,
} }

object! { Mesh {
    "body": body,
    "colour": colour,
    "low": low,
    "high": high,
    "corners": corners,
    "faces": faces,
} }

object! { Wheel {
    "elements": elements,
    "body": body,
    "centre": centre,
    "axis": axis,
    "tooth": tooth,
    "radius": radius,
    "teeth": teeth,
    "isRing": is_ring,
} }

object! { Rack {
    "element": element,
    "body": body,
    "at": at,
    "along": along,
    "tips": tips,
    "pitch": pitch,
    "teeth": teeth,
} }

object! { Body {
    "name": name,
    "particle": particle,
} }

object! { Element {
    "name": name,
    "kind": kind,
    "type": of,
    "bodies": bodies,
} }

object! { Marker {
    "element": element,
    "place": place,
    "body": body,
    "name": name,
    "kind": kind,
    "at": at,
} }

object! { Arrow {
    "joint": joint,
    "place": place,
} }

object! { Point {
    "name": name,
    "body": body,
    "at": at,
} }

object! { Reading<'_> {
    "name": name,
    "unit": unit,
    "values": values,
} }

object! { Remark {
    "text": text,
    "time": time,
} }
