//! Places for the symbols of joints and forces that name no point.

use crate::page::Marker;
use crate::subject::Subject;

/// An anchor of each of them on its first body: where a joint of the same two bodies has the same
/// axis, else at a centre of mass. A motor so sits on its hinge.
pub(crate) fn anchors(subject: &Subject<'_>) -> Vec<Marker> {
    let without_point = (0..subject.elements.len()).filter(|&element| {
        let mut own = subject.markers.iter();
        !own.any(|marker| marker.element == element && marker.kind == "point")
    });
    without_point
        .flat_map(|element| of(subject, element))
        .collect()
}

fn of(subject: &Subject<'_>, element: usize) -> Vec<Marker> {
    let bodies = subject.elements[element].bodies;
    let anchor = |place: usize, at: [f64; 3]| Marker {
        element,
        place,
        body: bodies[place],
        name: "anchor",
        kind: "anchor",
        at,
    };
    let own = || subject.markers.iter().filter(|own| own.element == element);
    if let (Some(axis), &[first, second]) = (own().find(|own| own.kind == "axis"), bodies) {
        let axis = subject.direction(0, axis.body, axis.at);
        if let Some(hinge) = subject.hinge([first, second], axis) {
            return vec![anchor(0, hinge.at)];
        }
    }
    // Of a relation between directions, one on each body.
    let moving = (0..bodies.len()).filter(|&place| bodies[place].is_some());
    let places = moving.filter(|&place| own().any(|own| own.place == place));
    places.map(|place| anchor(place, [0.0; 3])).collect()
}
