//! Closed loops.

use holonom::nalgebra::Vector3;
use holonom::{Mechanism as _, Real};

use super::{at, problem};
use crate::{Bricard, SliderCrank, SqueezingMechanism};

problem! {
    /// A03 for thirty milliseconds.
    Squeezer: SqueezingMechanism = "squeezer", "Andrews' squeezing mechanism (A03), 30 ms, against integrations in minimal coordinates";
    0 to 0.03 s every 0.003 s, time scale 0.005 s;
    "angles" ("rad") angles;
    view => {
        let h = SqueezingMechanism::HANDLES;
        let hinges = [h.o, h.f, h.b, h.g, h.a_upper, h.h, h.a_lower];
        let mut angles = hinges.map(|hinge| view.angle(hinge).to_f64());
        for (angle, start) in angles.iter_mut().zip(SqueezingMechanism::START) {
            *angle += start;
        }
        angles
    };
    time => at(time, &[(0.03, [
        15.810_771_195_154,
        -15.756_371_058_412_2,
        0.040_822_240_119_637_6,
        -0.534_730_116_342_09,
        0.524_409_965_879_953,
        0.534_730_116_342_091,
        1.048_080_741_041_94,
    ])]);
}

problem! {
    /// A04 for ten seconds.
    Ring: Bricard = "bricard", "Bricard's mechanism (A04), 10 s, against a model of one angle";
    0 to 10.0 s every 0.1 s, time scale 4.991_711_513_687_5 s;
    "place" ("m");
    view => {
        let corner = Vector3::from(Bricard::P3.map(S::constant));
        let place: [S; 3] = view.point(Bricard::HANDLES.second, corner).into();
        place.map(Real::to_f64)
    };
    time => at(time, &[
        (1.0, [0.274_481_319_264_393, -0.886_707_938_734_639, -0.462_330_002_687_439]),
        (2.0, [-0.778_135_373_033_498, -0.980_352_683_443_289, -0.197_252_670_617_009]),
        (5.0, [0.999_932_742_302_104, -0.999_999_997_738_353, -6.725_543_609_713_49e-5]),
        (10.0, [0.999_730_987_303_765, -0.999_999_963_825_817, -0.000_268_976_512_319_361]),
    ]);
}

problem! {
    /// D03 for two tenths of a second.
    Crank: SliderCrank = "slider-crank", "A slider-crank of 150 rad/s (D03), 0.2 s, against integrations of a minimal model";
    0 to 0.2 s every 0.01 s, time scale 0.04 s;
    "angle and place" ("rad, m") angles;
    view => {
        let h = SliderCrank::HANDLES;
        [view.angle(h.bearing).to_f64(), view.pose(h.slider).position.x.to_f64()]
    };
    time => at(time, &[
        (0.1, [9.140_152_416_941_7, 0.156_124_739_498_742]),
        (0.2, [18.394_450_982_997_4, 0.435_945_134_012_305]),
    ]);
}
