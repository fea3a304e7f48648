//! A01: the planar simple pendulum against its closed form.

use holonom::prelude::*;
use holonom_models::SimplePendulum;
use holonom_tests::is_exhaustive;
use nalgebra::Vector3;

use super::{at_times, change_of_energy, difference_after};

/// `sin(phi/2) = sin(phi0/2) cd(w0 t)` from `phi0 = -pi/2`, `w0 = sqrt(9.81)` 1/s: `x`, `y` (m),
/// `x'`, `y'` (m/s), to the last digit.
const MOTION: [(f64, [f64; 4]); 2] = [
    (
        9.99,
        [
            -0.316_436_469_913_032_3,
            -0.948_613_704_575_776_5,
            4.092_451_991_494_021,
            -1.365_151_120_240_304_7,
        ],
    ),
    (
        10.0,
        [
            -0.275_087_462_576_116_9,
            -0.961_419_205_099_125_1,
            4.175_598_100_951_729,
            -1.194_749_054_560_480_7,
        ],
    ),
];

/// The same after many periods of 2.3678 s: `x`, `y`.
const LATER: [(f64, [f64; 2]); 2] = [
    (1000.0, [0.683_230_188_552_314_9, -0.730_203_060_422_762_3]),
    (2000.0, [0.814_603_068_589_032_2, -0.580_018_827_836_935_5]),
];

fn swings<F: Formulation<f64>>(method: F) {
    /// m, m/s.
    const ASKED: f64 = 1e-9;
    let handles = SimplePendulum::HANDLES;
    let times = MOTION.map(|(time, _)| time);
    at_times(
        &SimplePendulum::default(),
        method,
        0.01,
        &times,
        |place, sample| {
            let [x, y, vx, vy] = MOTION[place].1;
            let error = sample.pose(handles.bob).position - Vector3::new(x, y, 0.0);
            let rate = sample.velocity(handles.bob) - Vector3::new(vx, vy, 0.0);
            println!("{:e} m, {:e} m/s", error.norm(), rate.norm());
            assert!(error.norm() <= ASKED && rate.norm() <= 5.0 * ASKED);
        },
    );
}

#[test]
fn it_swings_as_its_closed_form() {
    swings(StandardLagrange);
    swings(Baumgarte::default());
    swings(AugmentedLagrangian::default());
}

#[test]
fn it_returns_after_a_period() {
    // m, m/s; at rest, the acceleration is 9.81 m/s^2.
    assert!(difference_after(&SimplePendulum::default(), SimplePendulum::PERIOD) <= 1e-9);
}

#[test]
fn the_energy_stays() {
    /// Of the 9.81 J that go to and fro; the library asks for 5e-5 J.
    const ASKED: f64 = 1e-8;
    let model = SimplePendulum::default();
    assert!(change_of_energy(&model, StandardLagrange, 10.0, 0.0) <= ASKED);
    assert!(change_of_energy(&model, Baumgarte::default(), 10.0, 0.0) <= ASKED);
    assert!(change_of_energy(&model, AugmentedLagrangian::default(), 10.0, 0.0) <= ASKED);
}

#[test]
fn it_is_where_it_should_be_after_long_runs() {
    /// "High precision" of the sheet of 2005.
    const ASKED: f64 = 1e-3;
    let handles = SimplePendulum::HANDLES;
    let model = SimplePendulum::default();
    let times = LATER.map(|(time, _)| time);
    let times = &times[..if is_exhaustive() { times.len() } else { 1 }];
    at_times(
        &model,
        Baumgarte::default(),
        1000.0,
        times,
        |place, sample| {
            let [x, y] = LATER[place].1;
            let error = sample.pose(handles.bob).position - Vector3::new(x, y, 0.0);
            println!("{:e} m at {} s", error.norm(), sample.time());
            assert!(error.norm() <= ASKED);
        },
    );
}
