#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub struct HeavyTop {
    #[body(
        mass = 15.0,
        inertia = [0.234375, 0.46875, 0.234375],
        position = [0.0, 1.0, 0.0],
        angular_velocity = [0.0, 150.0, -4.61538]
    )]
    top: Body,
    #[joint(between = [ground, top], point = [0.0, 0.0, 0.0])]
    tip: Spherical,
}
