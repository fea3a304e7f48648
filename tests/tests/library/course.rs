//! Mechanisms in motion: one integrator for all of them.

use core::ops::ControlFlow;

use holonom::error::StepFault;
use holonom::{
    DormandPrince, Fault, StateParts, Tolerance,
    error::NotFinite,
    integrate::{Advance as _, Integration, Integrator, System, TimeSpan},
    state::{State, Vector},
};

use crate::kernels::Kernels;

const TOLERANCE: Tolerance<f64> = Tolerance {
    relative: 1e-11,
    absolute: 1e-13,
};

/// Three bodies, their angles, and an integral; what a mechanism does not need stays zero.
type Padded = State<f64, 28, 18>;

/// A mechanism as a system that an integrator moves, and the integral of its power (J).
struct Moving<'a>(&'a dyn Kernels);

impl Moving<'_> {
    fn pad(&self, x: &[f64], work: f64) -> Padded {
        let report = self.0.report();
        let (mut coordinates, mut velocities) = ([0.0; 28], [0.0; 18]);
        let (q, u) = x.split_at(report.coordinates + report.auxiliaries);
        coordinates[..q.len()].copy_from_slice(q);
        coordinates[27] = work;
        velocities[..u.len()].copy_from_slice(u);
        State::from_parts(coordinates, velocities)
    }

    fn unpad(&self, state: &Padded) -> (Vec<f64>, f64) {
        let report = self.0.report();
        let q = report.coordinates + report.auxiliaries;
        let parts = [
            &state.coordinates()[..q],
            &state.velocities()[..report.velocities],
        ];
        (parts.concat(), state.coordinates()[27])
    }
}

impl System<f64> for Moving<'_> {
    type State = Padded;

    fn rates(&mut self, time: f64, state: &Padded) -> Result<Padded, Fault> {
        let (x, _) = self.unpad(state);
        let found = self.0.evaluate(time, &x);
        let padded = self.pad(&found.rates, self.0.books(time, &x).power);
        let mut sound = true;
        padded.for_each(|rate| sound &= rate.is_finite());
        if sound {
            Ok(padded)
        } else {
            Err(Fault::Step(StepFault::RatesNotFinite {
                origin: NotFinite::Unknown,
            }))
        }
    }
}

/// Moves a state from a time to a later one by Dormand and Prince's method and shows every step:
/// time (s), `x`, work (J); until `show` has seen enough.
pub(crate) fn run(
    kernels: &dyn Kernels,
    [start, end]: [f64; 2],
    x: &[f64],
    mut show: impl FnMut(f64, &[f64], f64) -> ControlFlow<()>,
) {
    let mut system = Moving(kernels);
    let span = TimeSpan {
        start,
        end,
        first_output: end,
    };
    let state = system.pad(x, 0.0);
    let mut integration = DormandPrince::new(TOLERANCE)
        .start(&mut system, span, state)
        .expect("rates");
    let mut flow = show(start, x, 0.0);
    while flow.is_continue() && integration.time() < end {
        integration.advance(&mut system).expect("a step");
        let (mut x, work) = system.unpad(integration.state());
        kernels.rewrap(&mut x);
        let state = system.pad(&x, work);
        integration.replace(state);
        flow = show(integration.time(), &x, work);
    }
}
