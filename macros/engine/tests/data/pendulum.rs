#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub struct Pendulum {
    #[body(mass = 7.02, inertia = [0.5855265, 0.0010530, 0.5855265], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
}
