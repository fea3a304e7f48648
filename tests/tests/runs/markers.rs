//! Markers stand where the attributes put them, and gravity is told apart from forces.

use holonom::dynamics::Dynamics;
use holonom::forces::SpringDamper;
use holonom::joints::Revolute;
use holonom::mechanism::{ElementPlace, MarkerKind};
use holonom::nalgebra::Vector3;
use holonom::prelude::*;

/// A rod askew on a hinge, its length a parameter, with a spring to the ground. The principal axes
/// of the rod are not its own axes.
#[derive(Mechanism)]
#[mechanism(gravity = [1.0, -2.0, -9.0])]
struct Askew {
    #[param(like = 0.8)]
    length: f64,
    #[body(
        mass = 3.0,
        inertia = [[2.0, 0.3, 0.1], [0.3, 1.5, 0.2], [0.1, 0.2, 1.0]],
        position = [0.1, 0.4, 0.2],
        orientation = rotation([1.0, 2.0, 2.0], deg(40.0))
    )]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, length, 0.3], axis = [0.0, 3.0, 4.0])]
    hinge: Revolute,
    #[force(
        between = [ground, rod],
        head = [1.0, 0.0, 0.0],
        tail = [0.2, 0.5, 0.6],
        stiffness = 700.0,
        damping = 3.0,
        free_length = 0.1
    )]
    spring: SpringDamper,
}

#[test]
fn markers_stand_where_the_attributes_put_them() -> Result<(), Box<dyn std::error::Error>> {
    let askew = Askew::new(0.8)?;
    let dynamics = Dynamics::new(&askew, StandardLagrange)?;
    let state = Askew::initial_state(dynamics.constants());
    let view = dynamics.view(0.0, &state);
    let (axis, point) = (Vector3::new(0.0, 0.6, 0.8), Vector3::new(0.0, 0.8, 0.3));
    let (head, tail) = (Vector3::new(1.0, 0.0, 0.0), Vector3::new(0.2, 0.5, 0.6));
    let mut count = [0; 2];
    for (place, marker) in Askew::REPORT.markers.iter().enumerate() {
        let (expected, kind) = match marker.name {
            "point" => (point, MarkerKind::Point),
            "axis" => (axis, MarkerKind::Axis),
            "head" => (head, MarkerKind::Point),
            "tail" => (tail, MarkerKind::Point),
            other => panic!("a marker `{other}`"),
        };
        assert!((view.marker(place) - expected).norm() < 1e-14, "{marker:?}");
        assert_eq!(marker.kind, kind);
        assert_eq!(marker.body, [None, Some(0)][marker.place]);
        match marker.of {
            ElementPlace::Joint(joint) => assert_eq!(joint, 0),
            ElementPlace::Force(force) => assert_eq!(force, 0),
        }
        count[usize::from(matches!(marker.of, ElementPlace::Force(_)))] += 1;
    }
    assert_eq!(count, [4, 2]); // each end of the spring on its own body
    assert_eq!(view.marker(Askew::REPORT.markers.len()), Vector3::zeros());
    assert!((view.gravity() - Vector3::new(1.0, -2.0, -9.0)).norm() < 1e-12);
    Ok(())
}
