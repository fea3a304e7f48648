#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub struct SphericalPendulum {
    #[body(mass = 1.0, position = [0.0, 0.6, -0.8])]
    bob: Particle,
    #[joint(between = [ground, bob], head = [0.0, 0.0, 0.0], tail = [0.0, 0.6, -0.8], length = 1.0)]
    string: Rod,
}
