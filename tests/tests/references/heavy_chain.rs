//! E02: the heavy bob on a light chain, a ratio of masses of 1e6.

use holonom::error::StepFault;
use holonom::prelude::*;
use holonom_models::HeavyChain;
use holonom_tests::is_exhaustive;
use nalgebra::Vector3;

use super::{at_times, change_of_energy};

/// The bob at 1 s (m): by two formulations, tensions and angles, that agree to 1e-14.
const BOB: [f64; 3] = [-0.853_381_808_861_284, -0.521_286_378_397_134, 0.0];

fn swings<F: Formulation<f64>>(method: F, asked: f64) {
    let bob = HeavyChain::HANDLES.bob;
    at_times(&HeavyChain::default(), method, 1.0, &[1.0], |_, sample| {
        let error = (sample.pose(bob).position - Vector3::from(BOB)).norm();
        println!("{error:e} m");
        assert!(error <= asked);
    });
}

#[test]
fn the_bob_swings_as_its_reference() {
    /// m.
    const ASKED: f64 = 1e-9;
    swings(StandardLagrange, ASKED);
    if is_exhaustive() {
        swings(Baumgarte::default(), ASKED);
    }
}

#[test]
fn the_bob_swings_with_coefficients_that_follow_from_its_mass() {
    let chain = HeavyChain::default();
    if is_exhaustive() {
        swings(Baumgarte::of(&chain).expect("finite"), 1e-9);
    }
    swings(AugmentedLagrangian::of(&chain).expect("finite"), 1e-9);
    // A millionth of the accelerations, for three radians.
    swings(Penalty::of(&chain).expect("finite"), 1e-5);
}

#[test]
fn a_penalty_too_small_for_the_bob_is_not_accepted() {
    // The tensions of four links carry 1000 kg across masses of 1 g: nearly cancelling
    // accelerations, not forces. The augmented Lagrangian with 100 kg gains a percent of them in an
    // iteration.
    let weak = AugmentedLagrangian::new(100.0, 10.0, 1.0);
    let error = Simulation::new(&HeavyChain::default(), weak, Rk4::every(1e-4))
        .run(0.0..=0.01, every(0.01), |_| ControlFlow::Continue(()))
        .expect_err("far from converged");
    let fault = error.fault;
    assert!(
        matches!(
            fault,
            Fault::Step(StepFault::NotConverged { iterations: 20, .. })
        ),
        "{fault}"
    );
}

#[test]
fn the_energy_stays() {
    /// J, of 4905 J that go to and fro.
    const ASKED: f64 = 4905.0 * 1e-9;
    let model = HeavyChain::default();
    assert!(change_of_energy(&model, StandardLagrange, 1.0, -4_905.007_357_5) <= ASKED);
}
