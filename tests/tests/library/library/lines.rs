//! Joints along lines and planes.

use holonom_assembler::joints::Joint;

use super::Entry;
use crate::freedom;

pub(super) fn entries() -> Vec<Entry> {
    vec![
        entry! {
            5 Prismatic { point = head, axis = a },
            |s, b, d| Joint::prismatic(s, b, d.head, d.a),
            |p, d| freedom::prismatic(p, [d.head, d.a]),
        },
        entry! {
            3 Planar { point = head, normal = a },
            |s, b, d| Joint::planar(s, b, d.head, d.a),
            |p, d| freedom::planar(p, [d.head, d.a]),
        },
        entry! {
            2 PointOnLine { point = head, axis = a },
            |s, b, d| Joint::point_on_line(s, b, d.head, d.a),
            |p, d| freedom::point_on_line(p, [d.head, d.a]),
        },
        entry! {
            1 PointOnPlane { point = head, normal = a },
            |s, b, d| Joint::point_on_plane(s, b, d.head, d.a),
            |p, d| freedom::point_on_plane(p, [d.head, d.a]),
        },
    ]
}
