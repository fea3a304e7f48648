//! What of a mechanism does not change in a run: bodies, joints and forces, markers, shapes.

use holonom::mechanism::PointHandle;
use holonom::mechanism::{BodyKind, ElementPlace, MarkerKind, ShapeKind};
use holonom::nalgebra::{Quaternion, UnitQuaternion, Vector3};
use holonom::{BodyHandle, Mechanism, Real, View};

use crate::page::{Arrow, Body, Element, Marker, Point, Shape};

/// Position and orientation of a body in double precision.
pub(crate) fn placement<S: Real, M: Mechanism>(
    view: &View<'_, S, M>,
    body: usize,
) -> (Vector3<f64>, Quaternion<f64>) {
    let pose = view.pose(BodyHandle::<M>::new(body));
    let [i, j, k, w] = pose.orientation.coords.into();
    let [w, i, j, k] = [w, i, j, k].map(Real::to_f64);
    (pose.position.map(Real::to_f64), Quaternion::new(w, i, j, k))
}

/// Points and directions in the axes of their bodies: the same in whatever state they are read.
pub(crate) fn markers<S: Real, M: Mechanism>(view: &View<'_, S, M>) -> Vec<Marker> {
    let markers = M::REPORT.markers.iter().enumerate();
    let on_bodies = markers.map(|(index, marker)| {
        let at = view.marker(index).map(Real::to_f64);
        let at = on_body(view, marker.body, at, marker.kind == MarkerKind::Point);
        Marker {
            element: match marker.of {
                ElementPlace::Joint(joint) => joint,
                ElementPlace::Force(force) => M::REPORT.joints.len() + force,
            },
            place: marker.place,
            body: marker.body,
            name: marker.name,
            kind: match marker.kind {
                MarkerKind::Point => "point",
                MarkerKind::Axis => "axis",
                // Drawn as an arrow, as a direction of any kind.
                _ => "vector",
            },
            at: at.into(),
        }
    });
    on_bodies.collect()
}

/// A point or direction (global) in the axes of a body, a point from the centre of mass.
fn on_body<S: Real, M: Mechanism>(
    view: &View<'_, S, M>,
    body: Option<usize>,
    at: Vector3<f64>,
    is_point: bool,
) -> Vector3<f64> {
    let Some(body) = body else { return at };
    let (position, orientation) = placement(view, body);
    let origin = if is_point { position } else { Vector3::zeros() };
    UnitQuaternion::new_normalize(orientation).inverse() * (at - origin)
}

/// Named points of the description.
pub(crate) fn points<S: Real, M: Mechanism>(view: &View<'_, S, M>) -> Vec<Point> {
    let points = M::REPORT.points.iter().enumerate();
    let named = points.map(|(index, point)| {
        let at = view.position(PointHandle::<M>::new(index));
        let at = on_body(view, point.body, at.map(Real::to_f64), true);
        Point {
            name: point.name.into(),
            body: point.body,
            at: at.into(),
        }
    });
    named.collect()
}

/// Meshes but holes, with their places in the report.
pub(crate) fn meshes<M: Mechanism>()
-> impl Iterator<Item = (usize, &'static holonom::mechanism::Shape)> {
    let shapes = M::REPORT.shapes.iter().enumerate();
    shapes.filter(|(_, shape)| shape.kind == ShapeKind::Mesh && !shape.is_hole)
}

/// Shapes but holes and meshes.
pub(crate) fn shapes<S: Real, M: Mechanism>(view: &View<'_, S, M>) -> Vec<Shape> {
    let shapes = M::REPORT.shapes.iter().enumerate();
    let solid = shapes.filter(|(_, shape)| !shape.is_hole && shape.kind != ShapeKind::Mesh);
    let drawn = solid.map(|(index, shape)| Shape {
        body: shape.body,
        kind: match shape.kind {
            ShapeKind::Cylinder => "cylinder",
            ShapeKind::Tube => "tube",
            ShapeKind::Cone => "cone",
            ShapeKind::Block => "block",
            _ => "ball",
        },
        sizes: view.shape(index).map(Real::to_f64),
        centre: shape.centre,
        axes: shape.axes,
    });
    drawn.collect()
}

/// Where reactions are recorded: on the last body of a joint that is not the ground.
pub(crate) fn arrows<M: Mechanism>() -> Vec<Arrow> {
    let joints = M::REPORT.joints.iter().enumerate();
    let with_point = joints.filter(|(_, joint)| joint.has_point && joint.rows > 0);
    let arrows = with_point.filter_map(|(index, joint)| {
        let place = joint.bodies.iter().rposition(Option::is_some)?;
        let marker = M::REPORT.markers.iter().position(|marker| {
            marker.of == ElementPlace::Joint(index)
                && (marker.place, marker.kind) == (place, MarkerKind::Point)
        });
        Some(Arrow {
            joint: index,
            place,
            marker,
        })
    });
    arrows.collect()
}

pub(crate) fn bodies<M: Mechanism>() -> Vec<Body> {
    let bodies = M::REPORT.bodies.iter();
    bodies
        .map(|body| Body {
            name: body.name,
            particle: body.kind == BodyKind::Particle,
        })
        .collect()
}

/// Joints, then forces.
pub(crate) fn elements<M: Mechanism>() -> Vec<Element> {
    let joints = M::REPORT.joints.iter().map(|joint| Element {
        name: joint.name,
        kind: joint.kind,
        of: "joint",
        bodies: joint.bodies,
    });
    let forces = M::REPORT.forces.iter().map(|force| Element {
        name: force.name,
        kind: force.kind,
        of: "force",
        bodies: force.bodies,
    });
    joints.chain(forces).collect()
}
