//! Accelerations by handle, against differences of the velocities by handle and a closed form.

use nalgebra::Vector3;

use super::rod::{GRAVITY, PIVOT, ROD, Rod, rod};
use crate::measure::{OwnedView, Viewed as _};
use crate::state::State;
use crate::*;

const STEP: f64 = 1e-5;

/// A state as it moves off the constraints, at any accelerations.
fn at(shift: f64) -> (State<f64, 7, 6>, State<f64, 7, 6>) {
    let accelerations = [0.3, -0.7, 1.1, 2.0, -3.0, 4.0];
    let state: State<f64, 7, 6> = State::from_parts(
        [1.0, 2.0, 3.0, 0.5, 0.5, -0.5, 0.5],
        [0.1, 0.2, 0.3, 4.0, 5.0, 6.0],
    );
    let constants = rod().constants().unwrap();
    let rates = State::from_parts(Rod::coordinate_rates(&constants, &state), accelerations);
    let mut moved = state;
    for (place, rate) in moved.coordinates_mut().iter_mut().zip(rates.coordinates()) {
        *place += shift * rate;
    }
    for (place, rate) in moved.velocities_mut().iter_mut().zip(rates.velocities()) {
        *place += shift * rate;
    }
    (moved, rates)
}

/// The rate of a reading, by a central difference.
fn rate<const N: usize>(read: impl Fn(&OwnedView<'_, f64, Rod>) -> [f64; N]) -> [f64; N] {
    let [before, after] = [-STEP, STEP].map(|shift| {
        let (state, _) = at(shift);
        read(&rod().view(0.0, &state).unwrap())
    });
    core::array::from_fn(|k| (after[k] - before[k]) / (2.0 * STEP))
}

fn near<const N: usize>(found: [f64; N], expected: [f64; N]) {
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-7, "{found} for {expected}");
    }
}

#[test]
fn accelerations_are_the_rates_of_what_is_read() {
    let (state, rates) = at(0.0);
    let rod = rod();
    let view = rod.view(0.0, &state).unwrap();
    let point = Vector3::new(0.3, -0.4, 0.5);
    near(
        view.acceleration(&rates, ROD).into(),
        rate(|view| view.velocity(ROD).into()),
    );
    near(
        view.angular_acceleration(&rates, ROD).into(),
        rate(|view| view.angular_velocity(ROD).into()),
    );
    near(
        view.angular_acceleration_global(&rates, ROD).into(),
        rate(|view| view.angular_velocity_global(ROD).into()),
    );
    near(
        view.point_acceleration(&rates, ROD, point).into(),
        rate(|view| view.point_velocity(ROD, point).into()),
    );
    near(
        [view.angle_acceleration(&rates, PIVOT)],
        rate(|view| [view.angle_rate(PIVOT)]),
    );
}

#[test]
fn a_pendulum_accelerates_as_its_weight_has_it() {
    let rod = rod();
    let inertia = 0.5855265 + rod.mass * 0.25;
    Simulation::new(&rod, StandardLagrange, Rk4::every(0.001))
        .run(0.0..=1.0, every(0.1), |sample| -> Result<(), Fault> {
            let expected = -rod.mass * GRAVITY * 0.5 * sample.angle(PIVOT).cos() / inertia;
            let found = sample.angle_acceleration(PIVOT)?;
            assert!((found - expected).abs() < 1e-9, "{found} for {expected}");
            assert!((sample.angular_acceleration(ROD)?.x - expected).abs() < 1e-9);
            assert!((sample.angular_acceleration_global(ROD)?.x - expected).abs() < 1e-9);
            // The hinge is at rest, half a metre up the user's z axis.
            let hinge = sample.point_acceleration(ROD, Vector3::new(0.0, 0.0, 0.5))?;
            assert!(hinge.norm() < 1e-6, "{hinge}");
            assert_eq!(sample.acceleration(ROD)?.x, 0.0);
            Ok(())
        })
        .unwrap();
}
