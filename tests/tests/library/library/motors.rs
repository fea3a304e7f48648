//! Drivers.

use holonom_assembler::joints::Joint;
use holonom_assembler::laws::Motion;

use super::Entry;
use crate::data::Data;
use crate::freedom;

/// The words `sine` and, with the distance of head and tail, `stretch`.
fn motion(data: &Data, offset: f64) -> Motion {
    Motion::sine(offset, 0.3, data.number, 0.0)
}

pub(super) fn entries() -> Vec<Entry> {
    vec![
        entry! {
            1 AngleDriver { axis = a, motion = sine },
            |s, b, d| Joint::angle_driver(s, b, d.a, motion(d, 0.0)),
            |p, d| freedom::angle_driver(p, [d.a]),
        },
        entry! {
            1 DistanceDriver { head = head, tail = tail, motion = stretch },
            |s, b, d| Joint::distance_driver(s, b, d.head, d.tail, motion(d, d.reach())),
            |p, d| freedom::distance(p, [d.head, d.tail]),
        },
        entry! {
            1 DisplacementDriver { point = head, axis = a, motion = sine },
            |s, b, d| Joint::displacement_driver(s, b, d.head, d.a, motion(d, 0.0)),
            |p, d| freedom::point_on_plane(p, [d.head, d.a]),
        },
        entry! {
            3 OrientationDriver { axis = a, motion = sine },
            |s, b, d| Joint::orientation_driver(s, b, d.a, motion(d, 0.0)),
            |p, d| freedom::orientation_driver(p, [d.a]),
        },
    ]
}
