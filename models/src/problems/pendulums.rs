//! Pendulums: closed forms in elliptic functions.

use core::f64::consts::FRAC_PI_2;

use holonom::Mechanism as _;
use holonom_study::pendulum::{RigidPendulum, from_vertical};

use super::problem;
use crate::{Door, SimplePendulum};

problem! {
    /// A01: the simple pendulum for two thousand seconds.
    LongPendulum: SimplePendulum = "long-pendulum", "The simple pendulum of IFToMM's library (A01), 2000 s, against its closed form";
    0 to 2000.0 s every 10.0 s, time scale 2.367_841_947_576_237_4 s;
    "place" ("m");
    view => {
        let place = view.pose(SimplePendulum::HANDLES.bob).position;
        [holonom::Real::to_f64(place.x), holonom::Real::to_f64(place.y)]
    };
    time => {
        const MOTION: RigidPendulum = RigidPendulum {
            mass: 1.0,
            inertia: 1.0,
            distance: 1.0,
            gravity: 9.81,
            amplitude: -FRAC_PI_2,
        };
        let (sine, cosine) = MOTION.at(time).angle.sin_cos();
        Some([sine, -cosine].into())
    };
    inlined true;
}

problem! {
    /// E04: the door for ten seconds.
    Leaf: Door = "door", "A door on two hinges (E04), 10 s, against its closed form";
    0 to 10.0 s every 0.1 s, time scale 4.150_999_046_733_716 s;
    "angle" ("rad");
    view => {
        let angle = view.angle(Door::HANDLES.lower_hinge);
        [from_vertical(holonom::Real::to_f64(angle), FRAC_PI_2)]
    };
    time => {
        // `phi'' = -w0^2 sin(phi)`, w0^2 = 3.19 1/s^2.
        const MOTION: RigidPendulum = RigidPendulum {
            mass: 1.0,
            inertia: 1.0,
            distance: 1.0,
            gravity: 3.192_046_139_124_147_5,
            amplitude: FRAC_PI_2,
        };
        Some([MOTION.at(time).angle].into())
    };
}
