#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub struct DoublePendulum {
    #[body(mass = 7.02, inertia = [0.5855265, 0.0010530, 0.5855265], position = [0.0, 0.5, 0.0])]
    upper: Body,
    #[body(mass = 7.02, inertia = [0.5855265, 0.0010530, 0.5855265], position = [0.0, 1.5, 0.0])]
    lower: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [upper, lower], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
}
