#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub struct Faulty {
    #[body(mass = -7.02, inertia = [0.5855265, 0.0010530, 0.5855265])]
    rod: Body,
    #[body(mass = 1.0, frei)]
    bead: Particle,
    #[joint(between = [ground, rot], point = [0.0, 0.0, 0.0])]
    pivot: Revolute,
    count: u32,
}
