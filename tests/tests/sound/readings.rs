//! What cannot be read is refused: no zeros for a body that has nothing to do with a joint or a
//! force.

use holonom::error::ReadingFault;
use holonom::forces::{PointForce, SpringDamper};
use holonom::joints::{AngleDriver, Revolute};
use holonom::prelude::*;

/// Two rods on hinges of their own, a spring at the first; a second motor that says what the first
/// says already.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], redundant = "drop")]
struct Rods {
    #[body(mass = 2.0, inertia = [0.2, 0.01, 0.2], position = [0.0, 0.5, 0.0])]
    left: Body,
    #[body(mass = 2.0, inertia = [0.2, 0.01, 0.2], position = [1.0, 0.5, 0.0])]
    right: Body,
    #[joint(between = [ground, left], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    left_hinge: Revolute,
    #[joint(between = [ground, right], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    right_hinge: Revolute,
    #[joint(between = [ground, left], axis = [1.0, 0.0, 0.0], motion = 0.5 * time * time)]
    motor: AngleDriver,
    #[joint(between = [ground, left], axis = [1.0, 0.0, 0.0], motion = 0.5 * time * time)]
    twin: AngleDriver,
    #[force(between = [ground, left], head = [0.0, 0.0, 1.0], tail = [0.0, 1.0, 0.0], stiffness = 100.0, free_length = 1.0)]
    spring: SpringDamper,
    #[force(between = [left, right], point = [1.0, 1.0, 0.0], force = [0.0, 0.0, 5.0])]
    push: PointForce,
}

#[test]
fn a_body_that_has_nothing_to_do_with_it_is_refused() {
    let handles = Rods::HANDLES;
    let report = Simulation::new(&Rods::default(), StandardLagrange, Rk4::every(0.01))
        .run(0.0_f64..=0.1, every(0.1), |sample| {
            let fault = sample
                .reaction(handles.left_hinge, handles.right)
                .expect_err("another rod");
            assert_eq!(
                fault,
                Fault::Reading(ReadingFault::NotBetween {
                    element: "left_hinge",
                    body: "right"
                })
            );
            assert_eq!(
                fault.to_string(),
                "`right` is not among the bodies of `left_hinge`"
            );
            let fault = sample
                .load(handles.spring, handles.right)
                .expect_err("another rod");
            assert_eq!(
                fault.to_string(),
                "`right` is not among the bodies of `spring`"
            );
            let fault = sample
                .reaction_on_place(handles.left_hinge, 2)
                .expect_err("of two");
            assert_eq!(
                fault,
                Fault::Reading(ReadingFault::NoSuchPlace {
                    joint: "left_hinge",
                    place: 2,
                    places: 2
                })
            );
            // What is right stays: a force in the axes of a body exerts nothing on that body.
            let own = sample.load(handles.push, handles.left).expect("between");
            assert_eq!(own.force.norm() + own.moment.norm(), 0.0);
            let other = sample.load(handles.push, handles.right).expect("between");
            assert!((other.force.norm() - 5.0).abs() < 1e-12);
            assert!(
                sample
                    .reaction(handles.left_hinge, handles.left)
                    .expect("of the hinge")
                    .force
                    .norm()
                    > 1.0
            );
            ControlFlow::Continue(())
        })
        .expect("regular");
    assert!(!report.stopped);
}

#[test]
fn the_effort_of_an_equation_that_was_left_out_is_refused() {
    let handles = Rods::HANDLES;
    let mut seen = 0;
    Simulation::new(&Rods::default(), StandardLagrange, Rk4::every(0.01))
        .run(0.0_f64..=0.1, every(0.1), |sample| {
            let effort = sample.driving_effort(handles.motor).expect("it is kept");
            assert!(effort.abs() > 1.0);
            let fault = sample
                .driving_effort(handles.twin)
                .expect_err("its equation follows from that of the other motor");
            assert_eq!(fault, Fault::Reading(ReadingFault::NoEffort { joint: "twin" }));
            assert_eq!(
                fault.to_string(),
                "the equation of driver `twin` was left out as redundant: other joints carry its effort"
            );
            seen += 1;
            ControlFlow::Continue(())
        })
        .expect("regular");
    assert_eq!(seen, 2);
}
