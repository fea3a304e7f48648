//! A04: Bricard's mechanism.

use holonom::prelude::*;
use holonom_models::Bricard;
use nalgebra::Vector3;

use super::{at_times, change_of_energy, difference_after};

/// `P3` (m) at 1, 2, 5 and 10 s: by two integrations of the reduced model (one angle) that agree to
/// 2e-13.
const TIMES: [f64; 4] = [1.0, 2.0, 5.0, 10.0];
const P3: [[f64; 3]; 4] = [
    [
        0.274_481_319_264_393,
        -0.886_707_938_734_639,
        -0.462_330_002_687_439,
    ],
    [
        -0.778_135_373_033_498,
        -0.980_352_683_443_289,
        -0.197_252_670_617_009,
    ],
    [
        0.999_932_742_302_104,
        -0.999_999_997_738_353,
        -6.725_543_609_713_49e-5,
    ],
    [
        0.999_730_987_303_765,
        -0.999_999_963_825_817,
        -0.000_268_976_512_319_361,
    ],
];

fn moves<F: Formulation<f64>>(method: F, asked: f64) {
    let second = Bricard::HANDLES.second;
    at_times(&Bricard::default(), method, 1.0, &TIMES, |place, sample| {
        let end = sample.point(second, Bricard::P3.into());
        let error = (end - Vector3::from(P3[place])).norm();
        println!("{error:e} m at {} s", sample.time());
        assert!(error <= asked);
    });
}

#[test]
fn it_moves_as_its_reference() {
    /// m.
    const ASKED: f64 = 1e-10;
    moves(StandardLagrange, ASKED);
    moves(Baumgarte::default(), ASKED);
    moves(AugmentedLagrangian::default(), ASKED);
}

#[test]
fn it_returns_after_a_period() {
    // m, rad, m/s, rad/s; at rest, the accelerations are about 2 rad/s^2.
    assert!(difference_after(&Bricard::default(), Bricard::PERIOD) <= 1e-10);
}

#[test]
fn the_energy_stays() {
    /// J, of 4.6 J that go to and fro.
    const ASKED: f64 = 1e-10;
    const FIRST: f64 = -29.43;
    let model = Bricard::default();
    assert!(change_of_energy(&model, StandardLagrange, 10.0, FIRST) <= ASKED);
    assert!(change_of_energy(&model, Baumgarte::default(), 10.0, FIRST) <= ASKED);
}
