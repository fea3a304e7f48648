//! Reactions: equal and opposite, and with the weight what moves the bodies.

use holonom::error::ReadingFault;
use holonom::joints::{Revolute, Spherical};
use holonom::prelude::*;
use holonom::{StateParts, Wrench, dynamics::Dynamics};
use nalgebra::Vector3;

/// Two rods: a hinge, then a ball; the axis along no coordinate.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Pair {
    #[body(
        mass = 2.0,
        inertia = [0.2, 0.1, 0.2],
        position = [0.0, 0.5, 0.1],
        angular_velocity = [1.0, 0.5, -0.3]
    )]
    upper: Body,
    #[body(
        mass = 1.0,
        inertia = [0.1, 0.05, 0.1],
        position = [0.2, 1.4, 0.0],
        orientation = rotation([0.0, 0.0, 1.0], deg(-20.0)),
        angular_velocity = [-2.0, 0.0, 1.0]
    )]
    lower: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.2, 0.4])]
    hinge: Revolute,
    #[joint(between = [upper, lower], point = [0.0, 1.0, 0.1])]
    ball: Spherical,
}

/// Round-off of forces of 100 N.
const ROUND_OFF: f64 = 1e-11;

#[track_caller]
fn opposite(a: &Wrench<f64>, b: &Wrench<f64>) {
    assert!((a.force + b.force).amax() <= ROUND_OFF, "{a:?} {b:?}");
    // At one point: on the constraints the joint's points coincide.
    assert!((a.point - b.point).amax() <= ROUND_OFF, "{a:?} {b:?}");
    assert!((a.moment + b.moment).amax() <= ROUND_OFF, "{a:?} {b:?}");
    assert!(a.force.norm() > 1.0, "nothing acts");
}

fn equal_and_opposite<F: Formulation<f64>>(method: F) {
    let pair = Pair::default();
    let handles = Pair::HANDLES;
    let mut moments = 0.0_f64;
    Simulation::new(&pair, method, Rk4::every(1e-3))
        .assembled()
        .projection(Projection::default())
        .run(0.0..=0.5, every(0.05), |sample| {
            let on = |body| sample.reaction(handles.ball, body).expect("solvable");
            opposite(&on(handles.upper), &on(handles.lower));
            assert!(
                on(handles.lower).moment.amax() <= ROUND_OFF,
                "a ball turns freely"
            );
            let on = |place| {
                sample
                    .reaction_on_place(handles.hinge, place)
                    .expect("solvable")
            };
            opposite(&on(0), &on(1));
            let hinge = sample
                .reaction(handles.hinge, handles.upper)
                .expect("solvable");
            assert_eq!(hinge, on(1));
            let axis = Vector3::new(1.0, 0.2, 0.4).normalize();
            assert!(
                hinge.moment.dot(&axis).abs() <= ROUND_OFF,
                "a hinge turns freely"
            );
            moments = moments.max(hinge.moment.norm());
            ControlFlow::Continue(())
        })
        .expect("solvable");
    assert!(moments > 0.1, "the hinge transmits a moment");
}

#[test]
fn reactions_are_equal_and_opposite() {
    equal_and_opposite(StandardLagrange);
    equal_and_opposite(Baumgarte::default());
    equal_and_opposite(Penalty::default());
    equal_and_opposite(AugmentedLagrangian::default());
}

#[test]
fn reactions_and_weight_move_the_bodies() {
    let pair = Pair::default();
    let handles = Pair::HANDLES;
    let mut state = pair.described_state::<f64>().expect("described");
    pair.assemble(0.0, &mut state).expect("assembles");
    let dynamics = Dynamics::<Problem<Pair, _>>::new(&pair, StandardLagrange).expect("acceptable");
    let (evaluation, _) = dynamics.evaluate(0.0, &state).expect("solvable");
    let view = dynamics.view(0.0, &state);
    let mut rates = state;
    *rates.velocities_mut() = *evaluation.rates.velocities();
    let gravity = Vector3::new(0.0, 0.0, -9.81);
    let on = |body| {
        let hinge = view.reaction(&evaluation.multipliers, handles.hinge, body);
        let ball = view.reaction(&evaluation.multipliers, handles.ball, body);
        let centre = view.pose(body).position;
        let about_centre = |wrench: Wrench<f64>| {
            let moment = wrench.moment + (wrench.point - centre).cross(&wrench.force);
            (wrench.force, moment)
        };
        // The hinge holds the upper body only.
        let ball = about_centre(ball.expect("of both bodies"));
        let hinge = hinge.map_or((Vector3::zeros(), Vector3::zeros()), about_centre);
        (hinge.0 + ball.0, hinge.1 + ball.1)
    };
    for (body, mass, inertia) in [
        (handles.upper, 2.0, Vector3::new(0.2, 0.1, 0.2)),
        (handles.lower, 1.0, Vector3::new(0.1, 0.05, 0.1)),
    ] {
        let (force, moment) = on(body);
        let newton = mass * (Pair::velocity(&rates, body) - gravity) - force;
        assert!(newton.amax() <= ROUND_OFF, "{newton}");
        let w = view.angular_velocity(body);
        let spin_rate = Pair::angular_velocity(&rates, body);
        let p = view.pose(body).orientation;
        let attitude = nalgebra::UnitQuaternion::new_normalize(p);
        let euler = attitude.inverse() * moment
            - inertia.component_mul(&spin_rate)
            - w.cross(&inertia.component_mul(&w));
        assert!(euler.amax() <= ROUND_OFF, "{euler}");
    }
}

#[test]
fn a_joint_has_no_reaction_on_a_body_that_is_not_its_own() {
    let pair = Pair::default();
    let handles = Pair::HANDLES;
    let state = pair.described_state::<f64>().expect("described");
    let dynamics =
        Dynamics::<Problem<Pair, _>>::new(&pair, Penalty::default()).expect("acceptable");
    let (evaluation, _) = dynamics.evaluate(0.0, &state).expect("solvable");
    let view = dynamics.view(0.0, &state);
    let refused = view.reaction(&evaluation.multipliers, handles.hinge, handles.lower);
    assert_eq!(
        refused,
        Err(ReadingFault::NotBetween {
            element: "hinge",
            body: "lower"
        })
    );
}
