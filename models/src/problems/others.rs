//! Springs, spin, and masses that differ.

use holonom::{Mechanism as _, Real};

use super::{at, problem};
use crate::{FlyballGovernor, HeavyChain, HeavyTop, VariableLengthPendulum};

problem! {
    /// A05 for ten seconds.
    Governor: FlyballGovernor = "governor", "The stiff flyball governor (A05), 10 s, against integrations in minimal coordinates";
    0 to 10.0 s every 0.5 s, time scale 1.0 s;
    "height" ("m");
    view => [view.pose(FlyballGovernor::HANDLES.slider).position.z.to_f64()];
    time => at(time, &[
        (0.5, [0.743_249_424_786_323]),
        (1.0, [0.501_420_922_379_569]),
        (2.0, [0.505_909_294_296_706]),
        (5.0, [0.535_563_103_721_642]),
        (10.0, [0.619_622_917_061_363]),
    ]);
}

problem! {
    /// C01 for two seconds.
    Top: HeavyTop = "heavy-top", "The heavy top of 150 rad/s (C01), 2 s, against integrations in minimal coordinates";
    0 to 2.0 s every 0.1 s, time scale 0.04 s;
    "place" ("m");
    view => {
        let place: [S; 3] = view.pose(HeavyTop::HANDLES.top).position.into();
        place.map(Real::to_f64)
    };
    time => at(time, &[
        (1.0, [0.173_343_964_098_322, 0.640_088_592_070_459, -0.748_490_791_133_685]),
        (2.0, [-0.150_416_822_745_869, -0.724_165_591_636_978, -0.673_022_269_560_291]),
    ]);
}

problem! {
    /// D02 for five seconds.
    Slide: VariableLengthPendulum = "variable-length", "The variable-length pendulum of Nikravesh (D02), 5 s, against integrations of two coordinates";
    0 to 5.0 s every 0.1 s, time scale 1.0 s;
    "angle and length" ("rad, m");
    view => {
        let place = view.pose(VariableLengthPendulum::HANDLES.slider).position;
        let (x, y) = (place.x.to_f64(), place.y.to_f64());
        [x.atan2(-y), x.hypot(y)]
    };
    time => at(time, &[
        (1.0, [-0.620_930_373_712_414, 1.386_132_682_098_74]),
        (2.0, [0.473_624_078_239_525, 1.235_812_833_845_29]),
        (5.0, [0.176_570_726_587_059, 1.260_603_355_127_01]),
    ]);
}

problem! {
    /// E02 for one second.
    Chain: HeavyChain = "heavy-chain", "A bob of 1000 kg on a chain of grams (E02), 1 s, against two formulations in angles";
    0 to 1.0 s every 0.1 s, time scale 1.0 s;
    "place" ("m");
    view => {
        let place = view.pose(HeavyChain::HANDLES.bob).position;
        [place.x.to_f64(), place.y.to_f64()]
    };
    time => at(time, &[(1.0, [-0.853_381_808_861_284, -0.521_286_378_397_134])]);
}
