//! Massless links.

use holonom_assembler::joints::Joint;

use super::Entry;
use crate::freedom;

pub(super) fn entries() -> Vec<Entry> {
    vec![
        entry! {
            1 Distance { head = head, tail = tail },
            |s, b, d| Joint::distance(s, b, d.head, d.tail, None),
            |p, d| freedom::distance(p, [d.head, d.tail]),
        },
        entry! {
            1 Distance { head = head, tail = tail, length = number },
            |s, b, d| Joint::distance(s, b, d.head, d.tail, Some(d.number)),
            |p, d| freedom::distance(p, [d.head, d.tail]),
        },
        entry! {
            2 RevoluteSpherical { hinge = head, axis = a, ball = tail },
            |s, b, d| Joint::revolute_spherical(s, b, d.head, d.a, d.tail),
            |p, d| freedom::revolute_spherical(p, [d.head, d.a, d.tail]),
        },
        entry! {
            4 RevoluteRevolute { first = head, second = tail, axis = a },
            |s, b, d| Joint::revolute_revolute(s, b, d.head, d.tail, d.a),
            |p, d| freedom::revolute_revolute(p, [d.head, d.tail, d.a]),
        },
    ]
}
