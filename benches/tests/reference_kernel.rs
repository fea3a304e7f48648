//! The pendulum written by hand against the generated one, and its operations.

use holonom::{
    Mechanism, Scalar as _, StandardLagrange, StateParts as _,
    dynamics::{Dynamics, Problem},
};
use holonom_benches::baselines::START;
use holonom_benches::reference_kernel::{State, evaluate};
use holonom_models::RodPendulum;
use holonom_study::counted::{Counted, counted};

/// States with Euler parameters of length 1 on the constraints and off them by tenths, with a seed.
fn states() -> Vec<State<f64>> {
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let mut states = vec![START];
    for spread in [1e-3, 0.1] {
        for _ in 0..50 {
            let angle: f64 = 3.0 * random();
            let rate = 5.0 * random();
            let (sine, cosine) = angle.sin_cos();
            let (half_sine, half_cosine) = (0.5 * angle).sin_cos();
            let mut x = [0.0; 13];
            x[1..5].copy_from_slice(&[0.5 * cosine, 0.5 * sine, half_cosine, half_sine]);
            x[8..11].copy_from_slice(&[-0.5 * rate * sine, 0.5 * rate * cosine, rate]);
            x.iter_mut()
                .for_each(|element| *element += spread * random());
            let length = x[3..7].iter().map(|e| e * e).sum::<f64>().sqrt();
            x[3..7].iter_mut().for_each(|e| *e /= length);
            states.push(x);
        }
    }
    states
}

#[test]
fn it_computes_what_the_generated_pendulum_does() {
    let dynamics =
        Dynamics::<Problem<RodPendulum, _>>::new(&RodPendulum::default(), StandardLagrange)
            .unwrap();
    for x in states() {
        let mut state = RodPendulum::initial_state(dynamics.constants());
        state
            .coordinates_mut()
            .as_mut_slice()
            .copy_from_slice(&x[..7]);
        state
            .velocities_mut()
            .as_mut_slice()
            .copy_from_slice(&x[7..]);
        let (evaluation, _) = dynamics.evaluate(0.0, &state).unwrap();
        let (rates, multipliers) = evaluate(&x);
        let generated = [
            evaluation.rates.coordinates().as_slice(),
            evaluation.rates.velocities().as_slice(),
        ]
        .concat();
        // Round-off in moments about the rod is divided by an inertia 556 times smaller than the
        // other.
        let scale = 556.0 * generated.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        for (place, (a, b)) in rates.iter().zip(&generated).enumerate() {
            assert!(
                (a - b).abs() < 1e-13 * scale,
                "rate {place}: {a} and {b} at {x:?}"
            );
        }
        // The rows of the hinge's point have one sign in both.
        let force = &evaluation.multipliers.as_slice()[..3];
        let scale = force.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        for (a, b) in multipliers.iter().zip(force) {
            assert!(
                (a - b).abs() < 1e-12 * scale,
                "{multipliers:?} and {force:?}"
            );
        }
    }
}

#[test]
fn its_operations_are_those_of_its_kind() {
    let state = START.map(Counted::constant);
    let (operations, _) = counted(|| evaluate(&state));
    assert_eq!(operations.total(), 279, "{operations:?}");
    assert_eq!((operations.divisions, operations.square_roots), (5, 0));
}
