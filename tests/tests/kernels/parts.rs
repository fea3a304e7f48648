//! Evaluations of bodies that are put together from their parts, where a mechanism is described by
//! its joints, against the fused ones of the same mechanism.

use holonom::forces::TorsionalSpringDamper;
use holonom::joints::{PointOnLine, Revolute, Screw, Spherical};
use holonom::prelude::*;
use holonom::{
    Mechanism, StateParts,
    mechanism::{Compliant, Plain, Stabilisation, Stabilised, Terms},
    state::Array,
};
use holonom_assembler::accuracy::assert_close;

macro_rules! described {
    ($name:ident $coordinates:literal) => {
        /// A loop of four bars that a point on a line closes, a nut with a particle on it, whose
        /// turns are counted, and a spring.
        #[derive(Debug, Mechanism)]
        #[mechanism(gravity = [0.3, -9.81, 0.2], coordinates = $coordinates)]
        struct $name {
            #[param]
            length: f64,
            #[body(mass = 1.0, inertia = [0.1, 0.02, 0.1], position = [0.0, 0.5, 0.0], angular_velocity = [0.0, 0.0, 1.0])]
            crank: Body,
            #[body(mass = 2.0, inertia = [0.3, 0.2, 0.5], position = [0.5 * length, 1.0, 0.0])]
            coupler: Body,
            #[body(mass = 1.5, inertia = [0.1, 0.02, 0.1], position = [length, 0.5, 0.0])]
            rocker: Body,
            #[body(mass = 0.5, inertia = [0.01, 0.02, 0.03], position = [0.0, 0.0, 1.0])]
            nut: Body,
            #[body(mass = 0.2, position = [0.1, 0.0, 1.0])]
            bob: Particle,
            #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
            a: Revolute,
            #[joint(between = [crank, coupler], point = [0.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
            b: Revolute,
            #[joint(between = [ground, rocker], point = [length, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
            c: Revolute,
            #[joint(between = [coupler, rocker], point = [length, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
            d: PointOnLine,
            #[joint(between = [ground, nut], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], pitch = 0.05)]
            thread: Screw,
            #[joint(between = [nut, bob], point = [0.1, 0.0, 1.0])]
            ring: Spherical,
            #[force(between = [ground, crank], axis = [0.0, 0.0, 1.0], stiffness = 3.0, damping = 0.1)]
            spring: TorsionalSpringDamper,
        }
    };
}

described!(Fused "both");
described!(Together "joints");

/// Coordinates and velocities off the constraints, Euler parameters off length 1.
fn state<M: Mechanism>(constants: &M::Constants<f64>, seed: f64) -> M::State<f64> {
    let mut state = M::initial_state(constants);
    let noise = |place: usize| 0.2 * ((place as f64 + seed) * 12.9898).sin();
    let coordinates = state.coordinates_mut().as_mut_slice().iter_mut();
    coordinates
        .enumerate()
        .for_each(|(place, x)| *x += noise(place));
    let velocities = state.velocities_mut().as_mut_slice().iter_mut();
    velocities
        .enumerate()
        .for_each(|(place, x)| *x += 5.0 * noise(place + 100));
    state
}

/// Rates of coordinates and velocities, multipliers, and the smallest pivot.
fn evaluated<M: Mechanism, T: Terms>(mechanism: &M, seed: f64) -> [Vec<f64>; 4] {
    let stabilisation = Stabilisation {
        rate: 2.5,
        position: 7.0,
        compliance: 1e-3,
    };
    let constants = mechanism.constants::<f64>().expect("acceptable");
    let coefficients = M::coefficients(&constants, &stabilisation);
    let state = state::<M>(&constants, seed);
    let found = M::evaluate::<f64, T>(&constants, &coefficients, 0.7, &state);
    [
        found.rates.coordinates().as_slice().to_vec(),
        found.rates.velocities().as_slice().to_vec(),
        found.multipliers.as_slice().to_vec(),
        vec![found.pivot.relative],
    ]
}

fn agree<T: Terms>() {
    let fused = Fused::new(1.2).expect("acceptable");
    let together = Together::new(1.2).expect("acceptable");
    for seed in [0.0, 1.0, 2.0, 3.0] {
        let [wanted, found] = [
            evaluated::<Fused, T>(&fused, seed),
            evaluated::<Together, T>(&together, seed),
        ];
        for (place, what) in ["coordinates", "accelerations", "multipliers"]
            .into_iter()
            .enumerate()
        {
            assert!(wanted[place].iter().all(|x| x.is_finite()));
            assert_close(what, &found[place], &wanted[place], 1e-11);
        }
        assert!(found[3][0] > 1e-6 && wanted[3][0] > 1e-6);
    }
}

#[test]
fn evaluations_from_parts_are_those_that_are_fused() {
    agree::<Plain>();
    agree::<Stabilised>();
    agree::<Compliant>();
}

#[test]
fn a_mechanism_of_joints_runs_by_its_bodies() {
    let ode45 = DormandPrince::new(Tolerance {
        relative: 1e-10,
        absolute: 1e-11,
    });
    let [fused, together] = [
        end(&Fused::new(1.2).expect("acceptable"), ode45),
        end(&Together::new(1.2).expect("acceptable"), ode45),
    ];
    assert_close("the state after a second", &together, &fused, 1e-9);
    // What is fused is reported, what is not is not.
    assert!(Fused::REPORT.operations("evaluate standard").is_some());
    assert!(Together::REPORT.operations("evaluate standard").is_none());
}

fn end<M: Mechanism>(mechanism: &M, integrator: DormandPrince<f64>) -> Vec<f64> {
    let report = Simulation::new(mechanism, Baumgarte::default(), integrator)
        .assembled()
        .run(0.0..=1.0, every(1.0), |_| ControlFlow::Continue(()))
        .expect("a run");
    assert!(report.warnings().is_empty());
    report.state.coordinates().as_slice().to_vec()
}
