//! The rod of chapter 15: a closed form in elliptic functions.

use core::f64::consts::FRAC_PI_2;

use holonom::Mechanism as _;
use holonom_study::pendulum::{RigidPendulum, from_vertical};

use super::problem;
use crate::RodPendulum;

problem! {
    /// D01: the rod of chapter 15 for ten seconds.
    Pendulum: RodPendulum = "pendulum", "The rod of chapter 15 (D01), 10 s, against its closed form";
    0 to 10.0 s every 0.5 s, time scale 1.933_552_342_311_354_3 s;
    "angle" ("rad");
    view => {
        let angle = view.angle(RodPendulum::HANDLES.pivot);
        [from_vertical(holonom::Real::to_f64(angle), FRAC_PI_2)]
    };
    time => Some([RigidPendulum::CHAPTER_15.at(time).angle].into());
    inlined true;
}
