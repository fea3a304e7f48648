//! A force leaves no motions.

holonom::force! {
    /// What a joint says.
    pub force Moved(i, j; point: Point, axis: Axis, size: Number) {
        potential size * squared(j.point - i.point);
        motion turn axis at point;
    }
}

fn main() {
    let _ = Moved;
}
