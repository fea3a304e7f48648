//! Functions of definitions with the wrong arguments.

holonom::joint! {
    pub joint Functions(i, j; point: Point, axis: Axis, length: Length) {
        sin(i.axis);
        sqrt(length, length);
        exp();
        smooth_step(dot(i.axis.normals(), j.axis));
        smoothstep(length);
        angle(i, j);
        angle(i, j, i.axis);
        angle(i, j, point);
        angle(i, k, axes);
        angle(i, i, axis);
        fixed(i.axis, j);
        fixed(j, length);
        fixed(j, [time, 0.0, 0.0]);
        initial(i.axis);
        initial(length * time);
        initial(angle(i, j, axis), 1.0);
        rate(length);
        atan2(length);
        atan2(i.axis, length);
        dot(i.axis, j.axis) - asin(2.0);
        dot(i.axis, j.axis) - acos(0.5 - 2.0);
    }
}

holonom::force! {
    pub force Velocities(i, j; point: Point) {
        let w = angular_velocity(i, j);
        moment angular_velocity(i) on j;
        moment angular_velocity(j, j) on j;
        moment angular_velocity(i, k) on j;
        moment rate(w) on j;
        potential squared(w);
        1.0 along rate(squared(w));
        1.0 along dot(w, j.point - i.point);
        force fixed(j, w) at j.point;
    }
}

fn main() {}
