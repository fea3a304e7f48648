//! Gears and racks, on a carrier.

use holonom_assembler::joints::Joint;

use super::Entry;

pub(super) fn entries() -> Vec<Entry> {
    vec![
        entry! {
            1 Gear { axis_i = a, axis_j = b, ratio = number },
            |s, b, d| Joint::gear(s, b, d.a, d.b, d.number),
        },
        entry! {
            1 RackAndPinion { axis = a, hub = tail, point = head, slide = b, radius = number },
            |s, b, d| Joint::rack_and_pinion(s, b, d.a, [d.tail, d.head], d.b, d.number),
        },
    ]
}
