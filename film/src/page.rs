//! The data of a page, as the viewer reads it (`viewer/src/data.js`).

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::{Serialize, Serializer};

/// Everything that a page shows.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
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
#[derive(Clone, Debug, Serialize)]
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
#[derive(Serialize)]
pub(crate) struct Other<'a> {
    pub(crate) title: &'a str,
    pub(crate) times: &'a [f64],
    pub(crate) poses: Floats<'a>,
}

/// A mesh on a body (`None` is the ground), in its axes.
#[derive(Clone, Debug, Serialize)]
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
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
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
#[derive(Clone, Debug, Serialize)]
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

#[derive(Clone, Debug, Serialize)]
pub(crate) struct Body {
    pub(crate) name: &'static str,
    pub(crate) particle: bool,
}

/// A joint or a force.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Element {
    pub(crate) name: &'static str,
    pub(crate) kind: &'static str,
    #[serde(rename = "type")]
    pub(crate) of: &'static str,
    pub(crate) bodies: &'static [Option<usize>],
}

/// A point or direction in the user's axes of its body, a point from the centre of mass. Where a
/// joint or force names no point, an anchor says where its symbol is.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Marker {
    pub(crate) element: usize,
    pub(crate) place: usize,
    pub(crate) body: Option<usize>,
    pub(crate) name: &'static str,
    pub(crate) kind: &'static str,
    pub(crate) at: [f64; 3],
}

/// A reaction of a joint on the body at a place of its `between`.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Arrow {
    pub(crate) joint: usize,
    pub(crate) place: usize,
    /// Its point of this body in the report: a link between two points acts at each end.
    #[serde(skip)]
    pub(crate) marker: Option<usize>,
}

/// A point of a body (`None` is the ground) that has a name: a point of the description, or one
/// whose way is drawn.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Point {
    pub(crate) name: String,
    pub(crate) body: Option<usize>,
    /// From the centre of mass along the user's body axes, on the ground from the origin (m).
    pub(crate) at: [f64; 3],
}

#[derive(Serialize)]
pub(crate) struct Reading<'a> {
    pub(crate) name: &'a str,
    pub(crate) unit: &'a str,
    pub(crate) values: Floats<'a>,
}

/// A warning of the run, and when.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Remark {
    pub(crate) text: String,
    pub(crate) time: Option<f64>,
}

/// Numbers in single precision, little-endian, in base 64.
pub(crate) struct Floats<'a>(pub(crate) &'a [f32]);

impl Serialize for Floats<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let bytes: Vec<u8> = self.0.iter().flat_map(|x| x.to_le_bytes()).collect();
        serializer.serialize_str(&STANDARD.encode(bytes))
    }
}

/// Whole numbers of 16 bits, little-endian, in base 64.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shorts(pub(crate) Vec<u16>);

impl Serialize for Shorts {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let bytes: Vec<u8> = self.0.iter().flat_map(|x| x.to_le_bytes()).collect();
        serializer.serialize_str(&STANDARD.encode(bytes))
    }
}
