//! What of a mechanism does not change in a run: bodies, joints and forces, markers, shapes.

use holonom::mechanism::{BodyKind, ElementPlace, MarkerKind, ShapeKind};
use holonom::nalgebra::{Quaternion, UnitQuaternion, Vector3};
use holonom::{BodyHandle, Mechanism, Real, View};

use crate::page::{Arrow, Body, Element, Marker, Shape};

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
        let mut at = view.marker(index).map(Real::to_f64);
        if let Some(body) = marker.body {
            let (position, orientation) = placement(view, body);
            if marker.kind == MarkerKind::Point {
                at -= position;
            }
            at = UnitQuaternion::new_normalize(orientation).inverse() * at;
        }
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
                MarkerKind::Vector => "vector",
            },
            at: at.into(),
        }
    });
    on_bodies.collect()
}

/// Shapes but holes.
pub(crate) fn shapes<S: Real, M: Mechanism>(view: &View<'_, S, M>) -> Vec<Shape> {
    let shapes = M::REPORT.shapes.iter().enumerate();
    let solid = shapes.filter(|(_, shape)| !shape.is_hole);
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
        Some(Arrow {
            joint: index,
            place,
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
