//! Four-bars whose loops stay parallelograms: closed forms in elliptic functions.

use holonom::nalgebra::Vector3;
use holonom::{Mechanism, Real, View};
use holonom_study::elliptic::{jacobi, quarter_period};

use super::problem;
use crate::FourBar;
#[cfg(feature = "four-bars")]
use crate::{DoubleFourBar, QuintupleFourBar};

/// The top left pin of a row of `n` windows: place (m) and velocity (m/s) at a time.
///
/// All loops stay parallelograms: `J theta'' = P g sin(theta)` from 0 at 1 rad/s, clockwise from
/// the vertical, with `J = (n + 1) / 3 + n` and `P = (n + 1) / 2 + n`. Turned by half, this is a
/// pendulum that goes round: `phi / 2 = am(w t / 2 | m)` from its lowest point with the rate `w`,
/// `w^2 = 1 + 4 P g / J`, `m = (w^2 - 1) / w^2`.
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

#[cfg(feature = "four-bars")]
problem! {
    /// A02 with two windows for ten seconds.
    DoubleParallelogram: DoubleFourBar = "double-four-bar", "The double four-bar of IFToMM's library (A02, N = 2), 10 s, against its closed form";
    0 to 10.0 s every 0.1 s, time scale 1.0 s;
    "place and velocity" ("m, m/s");
    view => upper_end(view, DoubleFourBar::HANDLES.left);
    time => Some(pin(2.0, time).into());
}

#[cfg(feature = "four-bars")]
problem! {
    /// A02 with five windows for ten seconds.
    QuintupleParallelogram: QuintupleFourBar = "quintuple-four-bar", "Five four-bars in a row (A02, N = 5), 10 s, against their closed form";
    0 to 10.0 s every 0.1 s, time scale 1.0 s;
    "place and velocity" ("m, m/s");
    view => upper_end(view, QuintupleFourBar::HANDLES.rods[0]);
    time => Some(pin(5.0, time).into());
}
