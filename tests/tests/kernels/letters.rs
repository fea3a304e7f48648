//! Mechanisms whose names are those that generic parameters usually have.

use holonom::forces::SpringDamper;
use holonom::joints::Revolute;
use holonom::prelude::*;

/// The same mechanism under a name, with a number that is found through its type.
macro_rules! pendulum {
    ($name:ident) => {
        #[derive(Debug, Mechanism)]
        #[mechanism(gravity = [0.0, 0.0, -9.81])]
        struct $name {
            #[param]
            length: f64,
            #[body(mass = $name::MASS, inertia = [0.2, 0.01, 0.2], position = [0.0, 0.5 * length, 0.0])]
            rod: Body,
            #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
            hinge: Revolute,
            #[force(
                between = [ground, rod], head = [0.0, 0.0, 2.0], tail = [0.0, 0.5 * length, 0.0], stiffness = 30.0,
                free_length = 1.5, damping = 1.0
            )]
            spring: SpringDamper,
        }

        impl $name {
            const MASS: f64 = 2.5;
        }
    };
}

pendulum!(S);
pendulum!(T);
pendulum!(P);
pendulum!(Pendulum);

/// The angle after one second.
macro_rules! swung {
    ($name:ident) => {{
        let pendulum = $name::new(0.8).expect("sound");
        let mut angle = f64::NAN;
        Simulation::new(&pendulum, StandardLagrange, Rk4::every(0.01))
            .run(0.0..=1.0, every(0.5), |sample| {
                angle = sample.angle($name::HANDLES.hinge);
                ControlFlow::Continue(())
            })
            .expect("runs");
        angle
    }};
}

#[test]
fn a_mechanism_may_have_the_name_of_a_generic_parameter() {
    let wanted = swung!(Pendulum);
    assert!(wanted.abs() > 0.1, "it moves: {wanted}");
    assert_eq!([swung!(S), swung!(T), swung!(P)], [wanted; 3]);
}
