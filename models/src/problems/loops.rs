//! Closed loops.

use holonom::nalgebra::Vector3;
use holonom::{Mechanism, Real, View};
use holonom_study::elliptic::{jacobi, quarter_period};

use super::{at, problem};
use crate::{Bricard, DoubleFourBar, FourBar, QuintupleFourBar, SliderCrank, SqueezingMechanism};

/// The top left pin of a row of `n` windows: place (m) and velocity (m/s) at a time.
///
/// All loops stay parallelograms: `J theta'' = P g sin(theta)` from 0 at 1 rad/s, clockwise from the vertical, with `J = (n + 1) / 3 + n` and `P = (n + 1) / 2 + n`.
/// Turned by half, this is a pendulum that goes round: `phi / 2 = am(w t / 2 | m)` from its lowest point with the rate `w`, `w^2 = 1 + 4 P g / J`, `m = (w^2 - 1) / w^2`.
fn pin(n: f64, time: f64) -> [f64; 4] {
    let lift = 4.0 * ((n + 1.0) / 2.0 + n) * 9.81 / ((n + 1.0) / 3.0 + n);
    let fastest = (1.0 + lift).sqrt();
    let parameter = lift / (1.0 + lift);
    let j = jacobi(0.5 * fastest * time - quarter_period(parameter), parameter);
    let (sine, cosine) = (-2.0 * j.sn * j.cn, 2.0 * j.sn * j.sn - 1.0);
    let rate = fastest * j.dn;
    [sine, cosine, rate * cosine, -rate * sine]
}

/// Place and velocity of the upper end of a rod.
fn upper_end<S: Real, M: Mechanism>(
    view: &View<'_, S, M>,
    rod: holonom::BodyHandle<M>,
) -> [f64; 4] {
    let end = Vector3::from(FourBar::TOP.map(S::constant));
    let (place, velocity) = (view.point(rod, end), view.point_velocity(rod, end));
    [place.x, place.y, velocity.x, velocity.y].map(Real::to_f64)
}

problem! {
    /// A02 with one window for ten seconds.
    Parallelogram: FourBar = "four-bar", "The four-bar of IFToMM's library (A02, N = 1), 10 s, against its closed form";
    0 to 10.0 s every 0.1 s, time scale 1.0 s;
    "place and velocity" ("m, m/s");
    view => upper_end(view, FourBar::HANDLES.left);
    time => Some(pin(1.0, time).into());
}

problem! {
    /// A02 with two windows for ten seconds.
    DoubleParallelogram: DoubleFourBar = "double-four-bar", "The double four-bar of IFToMM's library (A02, N = 2), 10 s, against its closed form";
    0 to 10.0 s every 0.1 s, time scale 1.0 s;
    "place and velocity" ("m, m/s");
    view => upper_end(view, DoubleFourBar::HANDLES.left);
    time => Some(pin(2.0, time).into());
}

problem! {
    /// A02 with five windows for ten seconds.
    QuintupleParallelogram: QuintupleFourBar = "quintuple-four-bar", "Five four-bars in a row (A02, N = 5), 10 s, against their closed form";
    0 to 10.0 s every 0.1 s, time scale 1.0 s;
    "place and velocity" ("m, m/s");
    view => upper_end(view, QuintupleFourBar::HANDLES.rods[0]);
    time => Some(pin(5.0, time).into());
}

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
