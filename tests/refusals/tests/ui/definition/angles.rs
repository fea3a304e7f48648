//! Joints with two angles that are not those of their two turns.

holonom::joint! {
    pub joint Silent(i, j; point: Point, first: Axis, second: Axis) {
        j.point - i.point;
        dot(i.first, j.second);
        angle about first, second;
    }
}

holonom::joint! {
    pub joint Crossed(i, j; point: Point, first: Axis, second: Axis) {
        j.point - i.point;
        dot(i.first, j.second);
        motion turn first at point, turn second at point;
        angle about second, first;
    }
}

holonom::joint! {
    pub joint Twice(i, j; point: Point, first: Axis, second: Axis) {
        j.point - i.point;
        dot(i.first, j.second);
        motion turn first at point, turn second at point;
        angle about first, second;
        angle about first;
        angle about first, second, first;
    }
}

holonom::joint! {
    pub joint Unknown(i, j; point: Point, first: Axis, second: Axis) {
        j.point - i.point;
        dot(i.first, j.second);
        motion turn first at point, turn second at point;
        angle about first, secnd;
    }
}

fn main() {}
