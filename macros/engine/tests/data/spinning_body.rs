pub struct SpinningBody {
    #[body(mass = 1.0, inertia = [1.0, 2.0, 2.5], angular_velocity = [0.0, 3.0, 0.01], free)]
    body: Body,
}
