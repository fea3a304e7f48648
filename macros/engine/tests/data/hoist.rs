#[mechanism(gravity = [0.0, 0.0, -9.81], redundant = "keep")]
pub struct Hoist {
    #[param]
    size: f64,
    #[input]
    torque: f64,
    #[state(rate = (torque - heat[k] * time + size * rope.rate * rope.length) / 2.0, start = [0.5, 0.1])]
    heat: [f64; 2],
    #[body(mass = 2.0 * size, inertia = [0.1, 0.2, 0.2 * size * size], position = [0.1, 0.0, size])]
    drum: Body,
    #[body(mass = 3.0, position = [0.0, 0.5, 0.0])]
    load: Particle,
    #[joint(between = [ground, drum], point = [0.1, 0.0, 1.0], axis = [1.0, 0.0, 0.0], pitch = 0.01,
            motion = 0.3 + size * sin(10.0 * time) + smooth_step(time / 2.0))]
    winch: Winch,
    #[force(between = [drum, load], head = [0.1, 0.0, 1.0], tail = local([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]), stiffness = 100.0,
            force = -torque * (length - 0.5) - 3.0 * rate + exp(-time) * heat[1])]
    rope: Damper,
    #[force(between = [ground, drum], point = [0.1, 0.2, 1.0], thrust = [torque, 0.0, deg(30.0)])]
    push: Push,
}
