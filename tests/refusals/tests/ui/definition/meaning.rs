//! Expressions of the right shape that mean nothing.

holonom::joint! {
    /// No motion changes them.
    pub joint Still(i, j; axis: Axis, size: Length, motion: Law) {
        size - 2.0;
        time * size;
        initial(dot(i.axis, j.axis)) - size;
        motion() - size;
        [size, 1.0, 0.0];
        drive size to motion();
    }
}

holonom::force! {
    pub force Idle(i, j; stiffness: Number) {
        potential stiffness;
        stiffness along stiffness * time;
    }
}

holonom::joint! {
    /// Numbers without a value.
    pub joint Numbers(i, j; axis: Axis) {
        let d = dot(i.axis, j.axis);
        d / 0.0;
        d / (1.0 - 1.0);
        i.axis / sin(0);
        d - sqrt(-1.0);
        d - exp(1000.0);
        d - 1e30 * 1e30;
    }
}

holonom::joint! {
    /// Defaults that speak of what is not known yet.
    pub joint Circle(i, j; point: Point, first: Length = second, second: Length = 2.0 * first, itself: Number = itself) {
        j.point - i.point;
        dot(i.point, j.point) - first * second * itself;
    }
}

holonom::joint! {
    /// What cannot be read has a name all the same.
    pub joint Named(i, j; axis: Axis) {
        let d = dot(i.axis, +);
        let e = ;
        d;
        d * e;
    }
}

holonom::joint! {
    /// 2^20 terms.
    pub joint Explosion(i, j; axis: Axis) {
        let a = dot(i.axis, j.axis);
        let b = a * a * a * a;
        let c = b * b * b * b;
        let d = c * c * c * c;
        let e = d * d * d * d;
        let f = e * e * e * e;
        let g = f * f * f * f;
        let h = g * g * g * g;
        let k = h * h * h * h;
        k - 1.0;
    }
}

fn main() {}
