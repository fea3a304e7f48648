//! Constraints between two vectors.

use holonom_assembler::joints::Joint;

use super::Entry;
use crate::freedom;

pub(super) fn entries() -> Vec<Entry> {
    vec![
        entry! {
            1 Perpendicular1 { axis_i = a, axis_j = arm },
            |s, b, d| Joint::perpendicular1(s, b, d.a, d.arm()),
            |p, d| freedom::perpendicular1(p, [d.a, d.arm()]),
        },
        entry! {
            1 Perpendicular2 { axis = a, head = head, tail = across },
            |s, b, d| Joint::perpendicular2(s, b, d.a, d.head, d.across()),
            |p, d| freedom::perpendicular2(p, [d.a, d.head, d.across()]),
        },
        entry! {
            2 Parallel1 { axis_i = a, axis_j = b },
            |s, b, d| Joint::parallel1(s, b, d.a, d.b),
            |p, d| freedom::parallel1(p, [d.a, d.b]),
        },
        entry! {
            2 Parallel2 { axis = a, head = head, tail = beyond },
            |s, b, d| Joint::parallel2(s, b, d.a, d.head, d.beyond()),
            |p, d| freedom::parallel2(p, [d.a, d.head, d.beyond()]),
        },
    ]
}
