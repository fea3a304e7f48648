//! What pictures are drawn of: points and axes of the mechanism in the frames of a film.

use holonom::nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::page::{Element, Marker, Point};

/// Colours of bodies, those of the viewer.
const COLOURS: [&str; 8] = [
    "#4c8eda", "#e8853d", "#4fae6a", "#c85f8e", "#8e77d6", "#c9a227", "#3aa6a6", "#a8734b",
];
/// Of what stands still.
pub(crate) const GROUND: &str = "#8a93a3";
/// Directions whose cosine is beyond this are one.
const PARALLEL: f64 = 0.999;

/// What a picture is drawn of.
pub(crate) struct Subject<'a> {
    pub(crate) title: &'a str,
    pub(crate) elements: &'a [Element],
    pub(crate) markers: &'a [Marker],
    /// Those of the description.
    pub(crate) points: &'a [Point],
    pub(crate) traces: &'a [Point],
    pub(crate) gravity: [f64; 3],
    pub(crate) bodies: usize,
    pub(crate) times: &'a [f64],
    pub(crate) poses: &'a [f32],
}

impl Subject<'_> {
    /// All points that are drawn, in a frame: those of joints and forces, named ones, traces,
    /// centres of mass.
    pub(crate) fn all_places(&self, frame: usize) -> Vec<Vector3<f64>> {
        let points = self.markers.iter().filter(|marker| marker.kind == "point");
        let points = points.map(|marker| (marker.body, marker.at));
        let named = self.named().map(|point| (point.body, point.at));
        let centres = (0..self.bodies).map(|body| (Some(body), [0.0; 3]));
        let all = points.chain(named).chain(centres);
        all.map(|(body, at)| self.place(frame, body, at)).collect()
    }

    /// Named points and traces.
    fn named(&self) -> impl Iterator<Item = &Point> {
        self.points.iter().chain(self.traces)
    }

    /// The largest extent of the mechanism in the first frame (m); 1 where it is a point.
    pub(crate) fn size(&self) -> f64 {
        let places = self.all_places(0);
        let span = |k: usize| {
            let along = places.iter().map(|place| place[k]);
            let low = along.clone().fold(f64::INFINITY, f64::min);
            along.fold(f64::NEG_INFINITY, f64::max) - low
        };
        let size = span(0).max(span(1)).max(span(2));
        if size > 0.0 { size } else { 1.0 }
    }

    /// Whether all joints turn about an axis, or slide along or across it.
    pub(crate) fn is_plane(&self, axis: usize) -> bool {
        let mut axes = self.markers.iter().filter(|marker| marker.kind == "axis");
        axes.all(|marker| {
            let slides = ["Prismatic", "PointOnLine", "DisplacementDriver"];
            let slides = slides.contains(&self.elements[marker.element].kind);
            let along = self.direction(0, marker.body, marker.at)[axis].abs();
            along > PARALLEL || (slides && along < 1.0 - PARALLEL)
        })
    }

    /// Points on the ground that something stands on: a plane needs no foot.
    pub(crate) fn feet(&self) -> impl Iterator<Item = (&Marker, &Element)> {
        let points = self.markers.iter().filter(|marker| marker.kind == "point");
        let of = points.map(|marker| (marker, &self.elements[marker.element]));
        of.filter(|(marker, element)| {
            let is_plane = ["Planar", "PointOnPlane"].contains(&element.kind);
            marker.body.is_none() && element.of == "joint" && !is_plane
        })
    }

    /// A point of a body (global) in a frame.
    pub(crate) fn place(&self, frame: usize, body: Option<usize>, at: [f64; 3]) -> Vector3<f64> {
        let turned = self.direction(frame, body, at);
        let Some(body) = body else { return turned };
        let first = (frame * self.bodies + body) * 7;
        let number = |k: usize| f64::from(self.poses[first + k]);
        Vector3::new(number(0), number(1), number(2)) + turned
    }

    /// Orientation of a body in a frame.
    fn turn(&self, frame: usize, body: Option<usize>) -> UnitQuaternion<f64> {
        let Some(body) = body else {
            return UnitQuaternion::identity();
        };
        let first = (frame * self.bodies + body) * 7;
        let number = |k: usize| f64::from(self.poses[first + k]);
        UnitQuaternion::new_normalize(Quaternion::new(number(3), number(4), number(5), number(6)))
    }

    /// A direction of a body (global) in a frame.
    pub(crate) fn direction(
        &self,
        frame: usize,
        body: Option<usize>,
        along: [f64; 3],
    ) -> Vector3<f64> {
        self.turn(frame, body) * Vector3::from(along)
    }

    /// A direction of the first frame (global), in the axes of a body.
    pub(crate) fn direction_on(&self, body: Option<usize>, along: Vector3<f64>) -> Vector3<f64> {
        self.turn(0, body).inverse() * along
    }

    /// A point of the first frame (global), from the centre of mass in the axes of a body.
    pub(crate) fn point_on(&self, body: Option<usize>, at: Vector3<f64>) -> Vector3<f64> {
        self.direction_on(body, at - self.place(0, body, [0.0; 3]))
    }

    /// An axis of a joint or force in the first frame (global), on the body at a place.
    pub(crate) fn axis(&self, element: usize, place: usize, name: &str) -> Option<Vector3<f64>> {
        let mut markers = self.markers.iter();
        let found = markers.find(|marker| {
            marker.element == element && marker.place == place && marker.name == name
        });
        found.map(|marker| self.direction(0, marker.body, marker.at))
    }

    /// The point, on the first of two bodies, of a joint between them that has this axis (global,
    /// first frame).
    pub(crate) fn hinge(
        &self,
        [body, other]: [Option<usize>; 2],
        axis: Vector3<f64>,
    ) -> Option<&Marker> {
        let joins = |marker: &&Marker| {
            let element = &self.elements[marker.element];
            element.of == "joint"
                && element.bodies.contains(&body)
                && element.bodies.contains(&other)
                && body != other
        };
        let of_joint = self.markers.iter().filter(joins);
        let mut axes = of_joint.clone().filter(|marker| marker.kind == "axis");
        let hinge = axes.find(|marker| {
            let own = self.direction(0, marker.body, marker.at);
            own.dot(&axis).abs() > PARALLEL && points(self, marker.element, body).is_some()
        })?;
        points(self, hinge.element, body)
    }

    /// The shortest lines that join the points of a body and its centre of mass (Prim).
    pub(crate) fn bars(&self, body: usize) -> Vec<[Vector3<f64>; 2]> {
        let mut places: Vec<Vector3<f64>> = Vec::new();
        let markers = self.markers.iter();
        let markers = markers.filter(|marker| marker.body == Some(body) && marker.kind == "point");
        let markers = markers.map(|marker| marker.at);
        let named = self.named().filter(|point| point.body == Some(body));
        let named = named.map(|point| point.at);
        for place in markers.chain(named).chain([[0.0; 3]]).map(Vector3::from) {
            if places.iter().all(|known| (known - place).norm() > 1e-9) {
                places.push(place);
            }
        }
        let mut joined = vec![places.remove(0)];
        let mut bars = Vec::new();
        while !places.is_empty() {
            let pairs = joined.iter().flat_map(|from| {
                let ends = places.iter().enumerate();
                ends.map(move |(k, to)| ((to - from).norm(), *from, k))
            });
            let nearest = pairs.min_by(|(a, ..), (b, ..)| a.total_cmp(b));
            let Some((_, from, k)) = nearest else { break };
            let to = places.remove(k);
            bars.push([from, to]);
            joined.push(to);
        }
        bars
    }
}

pub(crate) fn colour(body: usize) -> &'static str {
    COLOURS[body % COLOURS.len()]
}

/// The colour of a point's body.
pub(crate) fn colour_of(point: &Point) -> &'static str {
    point.body.map_or(GROUND, colour)
}

/// The first point of an element that is fixed on a body.
fn points<'a>(subject: &'a Subject<'_>, element: usize, body: Option<usize>) -> Option<&'a Marker> {
    let mut markers = subject.markers.iter();
    markers
        .find(|marker| marker.element == element && marker.body == body && marker.kind == "point")
}
