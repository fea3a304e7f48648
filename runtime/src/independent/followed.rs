//! The way to coordinates where assembly finds none: near a configuration in which the chosen
//! coordinates do not determine the others.
//!
//! Assembly corrects all bodies at once, and close to such a configuration it cannot tell branches
//! apart. Here the chosen coordinates go their way exactly, and the others go straight on: by the
//! rates that they have beside the chosen ones, then back onto the constraints.

use nalgebra::SVector;

use super::balance::longest;
use super::partition::write_rates;
use super::{Equations, IndependentCoordinates};
use crate::error::{AnalysisFault, AssemblyFault, Fault};
use crate::math::scalar::Real;
use crate::mechanism::joint_rates::JointRates;
use crate::mechanism::relative::rates_of_motion;
use crate::state::vector::Vector as _;

/// Steps on the way, at most.
const STEPS: usize = 60;

/// A step (rad, or lengths of the mechanism), at most; and its share of the least pivot, which is
/// about how far the configuration is in which it vanishes.
const STEP: [f64; 2] = [0.1, 0.5];

/// A rest of the way of up to this many steps is gone in one.
const LAST: f64 = 1.5;

/// How far a step may be corrected, as a part of it: the other branch is further.
const OFF: f64 = 0.25;

/// Halvings of a step.
const HALVINGS: usize = 6;

impl<M: JointRates, const N: usize, S: Real> IndependentCoordinates<M, N, S> {
    /// The state with these coordinates on the way from another one.
    pub(super) fn followed(
        &self,
        from: &M::JointState<S>,
        wanted: &SVector<S, N>,
    ) -> Result<M::JointState<S>, Fault> {
        let Equations {
            constants, time, ..
        } = &self.equations;
        let scales = self
            .equations
            .places
            .map(|place| self.equations.scale(place));
        let mut state = *from;
        for _ in 0..STEPS {
            let left = self.left(&state, wanted)?;
            let widest = longest(&left, &scales).to_f64();
            let partition = self.equations.partition(&state)?;
            let weakest = partition.standing.weakest;
            let share = weakest.map_or(1.0, |weakest| weakest.share);
            let [longest, of_share] = STEP;
            let step = longest.min(of_share * share);
            let is_last = widest <= LAST * step;
            let mut part = if is_last { 1.0 } else { step / widest };
            let mut next = None;
            for _ in 0..HALVINGS {
                let way = left.map(|way| way * S::constant(part));
                let mut slope = state;
                write_rates::<M, N, S>(&partition, &way, false, &mut slope);
                let slope = rates_of_motion::<S, M>(constants, *time, &slope);
                let there = self.closed_by(state.plus([(S::one(), &slope)]));
                // What round-off moves is no other branch.
                let least = S::EPSILON.sqrt().to_f64();
                next = there
                    .ok()
                    .filter(|(_, off)| *off <= OFF * (part * widest) + least);
                if next.is_some() {
                    break;
                }
                part *= 0.5;
            }
            let Some((there, _)) = next else {
                return Err(Fault::Analysis(AnalysisFault::NotDetermined {
                    joint: weakest
                        .map_or("", |weakest| M::JOINT_REPORT.mover_of_rate(weakest.column)),
                }));
            };
            state = there;
            if is_last && part >= 1.0 {
                return Ok(state);
            }
        }
        Err(Fault::Assembly(AssemblyFault::WayEnds {
            joint: Some(self.joint(0)),
            share: 0.0,
        }))
    }
}
