//! The rod of chapter 15: its angle, and the closed form at some instants.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use holonom::prelude::*;
use holonom::{JointHandle, Real, Runs, View, mechanism::HasAngle};
use holonom_models::RodPendulum;

/// Motion at an instant: `phi` (rad) is counted from the downward vertical.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Swing {
    pub(crate) time: f64,
    pub(crate) angle: f64,
    pub(crate) rate: f64,
}

/// The closed form in elliptic functions, to the last digit: `I phi'' = -m g d sin(phi)` from
/// `phi = pi / 2` at rest, `I = 2.3405265` kg m^2, `m = 7.02` kg, `d = 0.5` m, `g = 9.81` m/s^2.
pub(crate) const SWINGS: [Swing; 3] = [
    Swing {
        time: 1.0,
        angle: -1.562_676_795_263_082_5,
        rate: 0.488_775_443_886_885_43,
    },
    Swing {
        time: 5.0,
        angle: -1.368_085_820_598_437_2,
        rate: 2.433_857_865_939_373_7,
    },
    Swing {
        time: 10.0,
        angle: 0.776_118_948_971_797_9,
        rate: -4.582_317_240_185_013,
    },
];

/// `phi`, in `-pi..=pi`: the angle of the hinge is zero in the horizontal.
pub(crate) fn angle<S: Real, M: Mechanism, J: HasAngle>(
    view: &View<'_, S, M>,
    hinge: JointHandle<M, J>,
) -> f64 {
    let angle = view.angle(hinge).to_f64() + FRAC_PI_2;
    if angle > PI { angle - TAU } else { angle }
}

/// `phi` and `phi'` at the end of a run from 0 to `end`.
pub(crate) fn final_swing<F: Formulation<f64>, I: Runs<Problem<RodPendulum, F>>>(
    method: F,
    integrator: I,
    end: f64,
) -> [f64; 2] {
    let rod = RodPendulum::default();
    let report = Simulation::new(&rod, method, integrator)
        .run(0.0..=end, every(end), |_| ControlFlow::Continue(()))
        .expect("solvable");
    let constants = rod.constants().expect("acceptable");
    let view = View::new(&constants, report.time, &report.state);
    let pivot = RodPendulum::HANDLES.pivot;
    [angle(&view, pivot), view.angle_rate(pivot)]
}
