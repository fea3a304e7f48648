//! Joints about a point.

use holonom_assembler::joints::Joint;

use super::Entry;
use crate::freedom;

pub(super) fn entries() -> Vec<Entry> {
    vec![
        entry! {
            3 Spherical { point = head },
            |s, b, d| Joint::spherical(s, b, d.head),
            |p, d| freedom::spherical(p, [d.head]),
        },
        entry! {
            5 Revolute { point = head, axis = a },
            |s, b, d| Joint::revolute(s, b, d.head, d.a),
            |p, d| freedom::revolute(p, [d.head, d.a]),
        },
        entry! {
            6 Fixed { point = head },
            |s, b, d| Joint::fixed(s, b, d.head),
            |p, d| freedom::fixed(p, [d.head]),
        },
    ]
}
