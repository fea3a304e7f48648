#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub struct Row {
    #[param]
    lengths: [f64; 3],
    #[body(mass = 1.0 + k, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.5 + 1.0 * k, (k % 2)])]
    links: [Body; 3],
    #[joint(
        between = [if k == 0 { ground } else { links[k - 1] }, links[k]],
        point = [0.0, 1.0 * k, 0.0],
        axis = if k < 2 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] }
    )]
    pins: [Revolute; 3],
    #[force(between = [links[k], links[(k + 1) % 3]], head = [0.0, lengths[k], 0.0], tail = [0.0, 0.0, 1.0], stiffness = 2.0 * k, force = -rate / (k + 1))]
    springs: [Damper; 2],
}
