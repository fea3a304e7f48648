//! A wrong definition is reported where it stands: its users add nothing.
#![deny(warnings)]

use holonom::prelude::*;

holonom::force! {
    /// Misspelt.
    force Spring(i, j; head: Point, tail: Point, stiffness: Number, damping: Number = 0.0) {
        let d = length(j.tail - i.head);
        potential 0.5 * stifness * d * d;
        -damping * rate(d) along d;
    }
}

holonom::joint! {
    /// Misspelt as well.
    joint Servo(i, j; axis: Axis, motion: Law) {
        displacement angle(i, j, axis);
        angle about axis;
        drive angle(i, j, axs) to motion();
    }
}

#[derive(Mechanism)]
struct Machine {
    #[param]
    stiffness: f64,
    #[input]
    torque: f64,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = 2.0 * time)]
    servo: Servo,
    #[force(between = [ground, rod], head = [0.0, 0.0, 1.0], tail = [0.0, 0.0, 0.0], stiffness = stiffness)]
    spring: Spring,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut machine = Machine::new(3.0)?;
    machine.torque = 1.0;
    let method = Baumgarte { alpha: 5.0, beta: 5.0 };
    Simulation::new(&machine, method, Rk4::every(1e-3)).run(0.0..=1.0, every(0.1), |sample| {
        println!("{}", sample.angle(Machine::HANDLES.servo));
        println!("{}", sample.displacement(Machine::HANDLES.servo));
        println!("{:?}", sample.driving_effort(Machine::HANDLES.servo));
        println!("{:?}", Machine::HANDLES.spring);
        ControlFlow::Continue(())
    })?;
    Ok(())
}
