//! Joints between shafts.

use holonom_assembler::joints::Joint;

use super::Entry;
use crate::freedom;

pub(super) fn entries() -> Vec<Entry> {
    vec![
        entry! {
            4 Universal { point = head, axis_i = a, axis_j = arm },
            |s, b, d| Joint::universal(s, b, d.head, d.a, d.arm()),
            |p, d| freedom::universal(p, [d.head, d.a, d.arm()]),
        },
        entry! {
            4 Cylindrical { point = head, axis = a },
            |s, b, d| Joint::cylindrical(s, b, d.head, d.a),
            |p, d| freedom::cylindrical(p, [d.head, d.a]),
        },
        entry! {
            4 ConstantVelocity { point = head, axis_i = a, axis_j = b },
            |s, b, d| Joint::constant_velocity(s, b, d.head, d.a, d.b),
            |p, d| freedom::constant_velocity(p, [d.head, d.a, d.b]),
        },
        entry! {
            5 Screw { point = head, axis = a, pitch = number },
            |s, b, d| Joint::screw(s, b, d.head, d.a, d.number),
            |p, d| freedom::screw(p, [d.head, d.a], d.number),
        },
    ]
}
