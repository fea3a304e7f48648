//! D03: the slider-crank of 150 rad/s.

use holonom::prelude::*;
use holonom_models::SliderCrank;

use super::{angle_about_z, at_times, change_of_energy, difference};

/// At 0.1 s and 0.2 s: angle (rad) and rate (rad/s) of the crank, angle of the rod (rad), position
/// of the slider (m). By two integrations of a minimal model that agree to 2e-13.
const MOTION: [[f64; 4]; 2] = [
    [
        9.140_152_416_941_7,
        144.406_332_089_064,
        -0.140_864_435_419_951,
        0.156_124_739_498_742,
    ],
    [
        18.394_450_982_997_4,
        97.139_411_423_584_3,
        0.221_587_194_684_333,
        0.435_945_134_012_305,
    ],
];

fn turns<F: Formulation<f64>>(method: F) {
    /// rad and m; a rate of 150 rad/s to as many digits.
    const ASKED: f64 = 1e-9;
    let handles = SliderCrank::HANDLES;
    at_times(
        &SliderCrank::default(),
        method,
        0.1,
        &[0.1, 0.2],
        |place, sample| {
            let [crank, rate, rod, slider] = MOTION[place];
            let crank = difference(sample.angle(handles.bearing), crank).abs();
            let rate = (sample.angle_rate(handles.bearing) - rate).abs();
            let rod = difference(angle_about_z(sample, handles.rod), rod).abs();
            let slider = (sample.pose(handles.slider).position.x - slider).abs();
            println!("{crank:e} rad, {rate:e} rad/s, rod {rod:e} rad, slider {slider:e} m");
            assert!(crank <= ASKED && rod <= ASKED && slider <= ASKED && rate <= 150.0 * ASKED);
        },
    );
}

#[test]
fn it_turns_as_its_reference() {
    turns(StandardLagrange);
    turns(Baumgarte::default());
    turns(AugmentedLagrangian::default());
}

#[test]
fn the_energy_stays() {
    /// Of 7.5 J.
    const ASKED: f64 = 7.5e-9;
    const FIRST: f64 = 7.495_548_75;
    let model = SliderCrank::default();
    assert!(change_of_energy(&model, StandardLagrange, 0.2, FIRST) <= ASKED);
    assert!(change_of_energy(&model, Baumgarte::default(), 0.2, FIRST) <= ASKED);
    assert!(change_of_energy(&model, AugmentedLagrangian::default(), 0.2, FIRST) <= ASKED);
}
