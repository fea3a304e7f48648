//! Whether a state is one to compute by: it satisfies the constraints, and the chosen rates
//! determine all others.
//!
//! Near a dead point or a change point the pivots of the other rates vanish, and at a change point
//! those that the positions follow from vanish with them. A pivot `p` leaves positions known to
//! `e / p` only, where `Phi` is known to `e`; rates to `e / p^2`, accelerations to `e / p^3`, and
//! their derivatives to `e / p^4`. No limit of `p` alone tells what is lost: it depends on how the
//! configuration is left. So what is computed is compared with what it is where the joints stand as
//! far off as `Phi` cannot tell.

use super::elimination::{Pivot, at};
use super::partition::{Partition, Standing, joint_rates, put_velocities, write_rates};
use super::places::Places;
use super::{Equations, IndependentCoordinates};
use crate::constraints::row_units::characteristic_length;
use crate::constraints::rows::Rows;
use crate::error::{AnalysisFault, Fault, Quantity};
use crate::math::scalar::Real;
use crate::mechanism::joint_rates::JointRates;
use crate::mechanism::relative::{bodies_of, rates_of_motion};
use crate::state::vector::{Array, Vector as _};

/// A violation, over the size of its row, that counts as an inexact number of a description: four
/// digits, as at the start of a run.
const INEXACT: f64 = 1e-4;

/// How many times what the terms of a row resolve its violation may be.
const RESOLVED: f64 = 4.0;

/// How many times a violation may make itself felt in what is computed.
const FELT: f64 = 100.0;

/// What an estimate by the pivot alone may be wrong by.
const ROUGH: f64 = 0.1;

/// What is computed from a partition.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Needs {
    /// Rates, masses, weights.
    Rates,
    /// Accelerations and what they take.
    Accelerations,
    /// How these change with coordinates and values.
    Derivatives,
}

/// The part of a rate, an acceleration or a derivative that may be lost: five of eight digits stay.
fn bound<S: Real>() -> f64 {
    let root = S::EPSILON.sqrt().sqrt();
    (root * root.sqrt()).to_f64()
}

impl<M: JointRates, const N: usize, S: Real> Equations<M, N, S> {
    /// What the kernels take at parameters, with the sizes of the rows that close loops.
    pub(super) fn prepared(
        (parameters, prepared): (&M::Parameters<S>, &M::Constants<S>),
        places: Places<N>,
        time: S,
    ) -> Self {
        let described = M::initial_state(prepared);
        let constants = M::prepare_joints(parameters);
        let mut equations = Self {
            length: characteristic_length::<S, M>(prepared, &described),
            constants,
            places,
            time,
            sizes: M::ClosingMultipliers::zeros(),
            resolved: 0.0,
            leaves_velocities: false,
        };
        if M::JOINT_REPORT.closing.is_empty() {
            return equations;
        }
        let natural = Rows::<S, M>::at(prepared, time, &described).positions();
        let standing = M::joint_state(&constants, &described);
        let (jacobian, _) = M::closing_rows(&constants, time, &standing);
        let width = M::JointVelocities::<S>::zeros().as_slice().len().max(1);
        let rows = jacobian.as_slice().chunks(width).enumerate();
        let mut sizes = equations.sizes;
        for (size, (row, entries)) in sizes.as_mut_slice().iter_mut().zip(rows) {
            let known = M::JOINT_REPORT.rows.get(row).copied().flatten();
            let known = known.and_then(|row| natural.of_row(row));
            let (known, resolution) = known.unwrap_or((S::zero(), S::zero()));
            let entries = entries.iter().enumerate();
            *size = entries.fold(known, |most, (place, &entry)| {
                Real::max(most, (entry * equations.scale(place)).abs())
            });
            let share = resolution.to_f64() / size.to_f64();
            equations.resolved = share.max(equations.resolved).max(S::EPSILON.to_f64());
        }
        equations.sizes = sizes;
        equations
    }

    /// Whether `Phi` is no larger than what its terms resolve.
    pub(super) fn is_resolved(&self, standing: &Standing) -> bool {
        standing.open.0 <= RESOLVED * self.resolved
    }
}

impl<M: JointRates, const N: usize, S: Real> IndependentCoordinates<M, N, S> {
    /// How what is not chosen follows, at a state to compute by; `None` in a tree, where everything
    /// is chosen.
    #[inline]
    pub(super) fn determined(
        &self,
        state: &M::JointState<S>,
        needs: Needs,
    ) -> Result<Option<Partition<M, N, S>>, Fault> {
        if M::JOINT_REPORT.closing.is_empty() {
            return Ok(None);
        }
        self.known(state, needs).map(Some)
    }

    /// The same, also of a tree.
    ///
    /// # Errors
    /// [`AnalysisFault::NotAssembled`], [`AnalysisFault::NotDetermined`],
    /// [`AnalysisFault::NotIndependent`].
    pub(super) fn known(
        &self,
        state: &M::JointState<S>,
        needs: Needs,
    ) -> Result<Partition<M, N, S>, Fault> {
        let partition = self.equations.partition(state)?;
        if M::JOINT_REPORT.closing.is_empty() {
            return Ok(partition);
        }
        let standing = &partition.standing;
        let (open, row) = standing.open;
        if open > INEXACT {
            self.check_open(state, row)?;
        }
        let (opening, row) = standing.opening;
        if needs > Needs::Rates && opening > INEXACT * self.fastest(state) {
            return Err(self.not_assembled(state, row, true));
        }
        if let Some(weakest) = standing.weakest {
            let square = weakest.share * weakest.share;
            let left = match needs {
                Needs::Rates => square,
                Needs::Accelerations => square * weakest.share,
                Needs::Derivatives => square * square,
            };
            let unknown = RESOLVED * self.equations.resolved + open;
            let is_plain = unknown <= ROUGH * bound::<S>() * left;
            if !is_plain && !self.is_exact(state, (weakest, unknown, open), needs) {
                return Err(Fault::Analysis(AnalysisFault::NotDetermined {
                    joint: M::JOINT_REPORT.mover_of_rate(weakest.column),
                }));
            }
        }
        Ok(partition)
    }

    /// The largest rate (rad/s, or lengths of the mechanism a second).
    fn fastest(&self, state: &M::JointState<S>) -> f64 {
        let rates = joint_rates::<M, S>(state);
        self.largest(&rates)
    }

    /// The largest of some rates or accelerations, in radians or lengths of the mechanism.
    fn largest(&self, rates: &M::JointVelocities<S>) -> f64 {
        let rates = rates.as_slice().iter().enumerate();
        rates.fold(0.0, |most, (place, rate)| {
            let rate = rate.quotient(self.equations.scale(place)).to_f64();
            rate.abs().max(most)
        })
    }

    /// Whether a row is no more open than its terms resolve.
    #[cold]
    fn check_open(&self, state: &M::JointState<S>, row: usize) -> Result<(), Fault> {
        let Equations {
            constants, time, ..
        } = &self.equations;
        let (_, [_, _, values]) = M::closing_rows(constants, *time, state);
        let bodies = bodies_of::<S, M>(constants, state);
        let sizes = Rows::<S, M>::at(&self.constants, *time, &bodies).positions();
        let known = M::JOINT_REPORT.rows.get(row).copied().flatten();
        let known = known.and_then(|row| sizes.of_row(row));
        let (_, resolution) = known.unwrap_or((S::zero(), S::zero()));
        let violation = at(values.as_slice(), row).abs();
        let size = at(self.equations.sizes.as_slice(), row);
        let resolved = S::constant(8.0 * RESOLVED) * resolution;
        if violation <= S::constant(INEXACT) * size + resolved {
            return Ok(());
        }
        Err(self.not_assembled(state, row, false))
    }

    #[cold]
    fn not_assembled(&self, state: &M::JointState<S>, row: usize, of_rates: bool) -> Fault {
        let Equations {
            constants, time, ..
        } = &self.equations;
        let (_, [_, rates, values]) = M::closing_rows(constants, *time, state);
        let bodies = bodies_of::<S, M>(constants, state);
        let rows = Rows::<S, M>::at(&self.constants, *time, &bodies);
        let known = M::JOINT_REPORT.rows.get(row).copied().flatten();
        let unit = known.and_then(|row| rows.row_units().nth(row));
        let (unit, is_length) = unit.unwrap_or((S::one(), true));
        let (violated, quantity) = match (of_rates, is_length) {
            (false, true) => (values, Quantity::Length),
            (false, false) => (values, Quantity::Angle),
            (true, true) => (rates, Quantity::Speed),
            (true, false) => (rates, Quantity::AngularVelocity),
        };
        Fault::Analysis(AnalysisFault::NotAssembled {
            joint: M::JOINT_REPORT.closing.get(row).copied().unwrap_or(""),
            quantity,
            violation: at(violated.as_slice(), row).abs().quotient(unit).to_f64(),
        })
    }

    /// Whether what is computed does not depend on what `Phi` leaves unknown: it is compared with
    /// what it is where the joints stand off by that, on either side.
    #[cold]
    fn is_exact(
        &self,
        state: &M::JointState<S>,
        (weakest, unknown, open): (Pivot, f64, f64),
        needs: Needs,
    ) -> bool {
        let mut bound = bound::<S>().max(FELT * open);
        if needs == Needs::Derivatives {
            bound *= weakest.share.min(1.0);
        }
        let equations = &self.equations;
        let size = at(equations.sizes.as_slice(), weakest.row);
        let by = size * S::constant(unknown);
        let Ok(loose) = equations.eliminated(state, Some((weakest.row, by))) else {
            return false;
        };
        let rates = self.rates_of(state);
        // With the rates that the chosen ones have there.
        let moving = |mut there: M::JointState<S>| {
            let partition = equations.partition(&there).ok()?;
            write_rates::<M, N, S>(&partition, &rates, true, &mut there);
            equations.partition(&there).ok()
        };
        let Some(here) = moving(*state) else {
            return false;
        };
        let mut slope = *state;
        put_velocities::<M, S>(&loose.closing, &mut slope);
        let slope = rates_of_motion::<S, M>(&equations.constants, equations.time, &slope);
        let fastest = self.fastest(state);
        [-S::one(), S::one()].into_iter().all(|way| {
            let there = moving(state.plus([(way, &slope)]));
            there.is_some_and(|there| {
                let columns = here.columns.iter().zip(&there.columns);
                let (mut off, mut most) = (0.0_f64, 0.0_f64);
                for ((here, there), &place) in columns.zip(equations.places.iter()) {
                    let unit = equations.scale(place).to_f64();
                    off = off.max(unit * self.largest(&difference::<M, S>(here, there)));
                    most = most.max(unit * self.largest(here));
                }
                let [drift, bias] = [(&here.drift, &there.drift), (&here.bias, &there.bias)].map(
                    |(here, there)| {
                        let off = self.largest(&difference::<M, S>(here, there));
                        (off, self.largest(here))
                    },
                );
                // At a change point itself nothing else tells that columns are zero over zero.
                let volumes =
                    [&here, &there].map(|at| at.standing.weakest.map_or(1.0, |w| w.volume));
                (volumes[1] - volumes[0]).abs() <= bound * volumes[0]
                    && off <= bound * most
                    && drift.0 <= bound * drift.1.max(fastest)
                    && (needs == Needs::Rates || bias.0 <= bound * bias.1.max(fastest * fastest))
            })
        })
    }
}

fn difference<M: JointRates, S: Real>(
    a: &M::JointVelocities<S>,
    b: &M::JointVelocities<S>,
) -> M::JointVelocities<S> {
    let mut difference = *a;
    let places = difference.as_mut_slice().iter_mut().zip(b.as_slice());
    places.for_each(|(place, &b)| *place = *place - b);
    difference
}
