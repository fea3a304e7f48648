//! A motion that is run backwards comes to where it began, by a method that is symmetric.

use holonom::{
    Heun, ImplicitMidpoint,
    dynamics::{Dynamics, Problem},
    integrate::OneStep,
    mechanism::{Absolute, Relative},
    state::Array,
    state::MovingState,
};
use holonom::{StateParts, integrate::System};

use super::mechanisms::{Floating, Linkage};
use super::*;

/// A second of motion there, and one back.
fn there_and_back<Y: System<f64>>(
    system: &mut Y,
    scheme: impl OneStep<f64, Y>,
    state: &mut Y::State,
    reverse: impl Fn(&mut Y::State),
) {
    const STEPS: u32 = 256;
    for _ in 0..2 {
        for step in 0..STEPS {
            let time = f64::from(step) / f64::from(STEPS);
            let outcome = scheme.step(system, time, state, 1.0 / f64::from(STEPS));
            outcome.expect("regular");
        }
        reverse(state);
    }
}

/// How far a motion there and back ends from where it began, by bodies and by joints: places (m)
/// and velocities (m/s, rad/s).
fn return_errors<M: JointCoordinates, K>(
    mechanism: &M,
    bodies: &[BodyHandle<M>],
    start: M::State<f64>,
    scheme: K,
) -> [f64; 2]
where
    K: OneStep<f64, Dynamics<Problem<M, StandardLagrange, f64, Absolute>>>
        + OneStep<f64, Dynamics<Problem<M, StandardLagrange, f64, Relative>>>,
{
    let negative = |velocities: &mut [f64]| {
        for velocity in velocities {
            *velocity = -*velocity;
        }
    };
    let mut dynamics = Dynamics::new(mechanism, StandardLagrange)
        .expect("sound")
        .absolute_coordinates();
    let mut state = start;
    there_and_back(
        &mut dynamics,
        scheme,
        &mut state,
        |state: &mut M::State<f64>| {
            negative(state.velocities_mut().as_mut_slice());
        },
    );
    let mut joints = Dynamics::new(mechanism, StandardLagrange)
        .expect("sound")
        .joint_coordinates();
    let mut joint_state = joints.state_of(&start).expect("consistent");
    there_and_back(
        &mut joints,
        scheme,
        &mut joint_state,
        |state: &mut M::JointState<f64>| {
            negative(state.rates_slice_mut());
        },
    );
    [state, joints.bodies(&joint_state)].map(|state| {
        let velocities = state.velocities().as_slice().iter();
        let velocities = velocities.zip(start.velocities().as_slice());
        let velocities = velocities.map(|(a, b)| (a - b).abs());
        let ends = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
        let (now, then) = (dynamics.view(0.0, &state), dynamics.view(0.0, &start));
        let points = bodies.iter().flat_map(|&body| ends.map(|end| (body, end)));
        let places =
            points.map(|(body, end)| (now.point(body, end) - then.point(body, end)).norm());
        velocities.chain(places).fold(0.0, f64::max)
    })
}

fn returns<M: JointCoordinates>(mechanism: &M, bodies: &[BodyHandle<M>], start: M::State<f64>) {
    let symmetric = return_errors(mechanism, bodies, start, ImplicitMidpoint);
    let explicit = return_errors(mechanism, bodies, start, Heun);
    println!("{symmetric:?} {explicit:?}");
    // Five hundred steps, whose round-off a motion like this spreads by some hundred; an iteration
    // ends at round-off.
    assert!(
        symmetric.iter().all(|&error| error < 1e-10),
        "{symmetric:?}"
    );
    // Of the same order, and it does not come back.
    assert!(explicit.iter().all(|&error| error > 1e-6), "{explicit:?}");
}

proptest! {
    #![proptest_config(cases(12))]

    #[test]
    fn a_linkage_that_is_run_backwards_comes_back(data in data()) {
        let linkage = Linkage::new(data.heavy, data.arm, data.lean, data.stiffness).expect("fine");
        let handles = Linkage::HANDLES;
        let bodies = [handles.upper, handles.lower, handles.tip];
        returns(&linkage, &bodies, start(&linkage, &bodies, &data));
    }

    #[test]
    fn a_floating_mechanism_that_is_run_backwards_comes_back(data in data()) {
        let floating = Floating::new(data.heavy, data.arm, data.lean, data.stiffness).expect("fine");
        let handles = Floating::HANDLES;
        let bodies = [handles.hub, handles.wheel, handles.limb, handles.tail];
        returns(&floating, &bodies, start(&floating, &bodies, &data));
    }
}
