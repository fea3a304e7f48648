//! Accelerations and multipliers against a dense solution.

use holonom_engine::plan::kernels::PivotCheck;
use holonom_engine::plan::system::Terms;

use crate::comparison::{Comparison, difference};
use crate::dense::{Factors, size};
use crate::inputs::{Coefficients, Inputs, in_axes};
use crate::reference::{Equations, State};

/// Of solutions, times the condition number.
pub(crate) const TOLERANCE: f64 = 1e-13;
/// Systems beyond this are not compared.
const CONDITION: f64 = 1e10;
/// In systems of a condition below `SOUND`, no relative pivot is below `SMALL`.
pub(crate) const SOUND: f64 = 1e5;
pub(crate) const SMALL: f64 = 1e-9;

/// A saddle system at a state, and the size of what is lost by round-off in its solution.
pub(crate) struct System {
    factors: Factors,
    inverse: f64,
    norm: f64,
    /// The largest number on the way to the equations.
    scale: f64,
}

impl System {
    /// `None` where it is nearly singular.
    pub(crate) fn new(equations: &Equations, compliance: f64) -> Option<Self> {
        Self::of(equations, equations.saddle(compliance))
    }

    /// The system of a given matrix.
    pub(crate) fn of(equations: &Equations, matrix: Vec<Vec<f64>>) -> Option<Self> {
        let norm = size(&matrix);
        let factors = Factors::new(matrix)?;
        let inverse = factors.size_of_inverse();
        (inverse * norm < CONDITION).then_some(Self {
            factors,
            inverse,
            norm,
            scale: equations.scale,
        })
    }

    pub(crate) fn condition(&self) -> f64 {
        self.inverse * self.norm
    }

    /// The solution, and what its round-off is compared with.
    pub(crate) fn solve(&self, right: &[f64]) -> (Vec<f64>, f64) {
        self.solve_with(right, (0.0, 0.0))
    }

    /// The same with gains of `Phi'` and `Phi` in the right-hand side, by which their round-off
    /// counts.
    pub(crate) fn solve_with(&self, right: &[f64], gains: (f64, f64)) -> (Vec<f64>, f64) {
        let solution = self.factors.solve(right);
        let largest = |values: &[f64]| values.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        // Right-hand sides are differences of larger numbers.
        let right = largest(right).max(self.scale * (1.0 + gains.0 + gains.1));
        let round_off = self.inverse * (self.norm * largest(&solution) + right);
        (solution, round_off)
    }
}

/// The smallest relative pivot.
pub(crate) fn smallest(pivots: &[f64], checks: &[PivotCheck]) -> f64 {
    let relative = pivots.iter().zip(checks);
    let relative = relative.filter(|(_, check)| matches!(check, PivotCheck::Relative(_)));
    relative.fold(1.0, |least: f64, (pivot, _)| match pivot.abs() {
        // Nothing over nothing.
        pivot if pivot.is_nan() => 0.0,
        pivot => least.min(pivot),
    })
}

/// By how much solutions with a compliance may be worse off the constraints.
fn slack(terms: Terms, equations: &Equations, coefficients: Coefficients) -> f64 {
    match terms {
        Terms::Compliant if !equations.hold() => coefficients.compliance.recip(),
        _ => 1.0,
    }
}

impl Comparison<'_> {
    /// Compares a solution. Off the constraints a pivot may be round-off but for the compliance,
    /// and `slack` is what that loses.
    fn solution(
        &mut self,
        what: &str,
        found: &[f64],
        (wanted, round_off): &(Vec<f64>, f64),
        slack: f64,
    ) -> Result<(), String> {
        let velocities = self.model.layout().velocities;
        if found.len() != wanted.len() {
            return Err(format!(
                "{what}: {} numbers for {}",
                found.len(),
                wanted.len()
            ));
        }
        let mut own = in_axes(self.model, &found[..velocities], false);
        own.extend(&found[velocities..]);
        let relative = difference(&own, wanted) / round_off;
        if relative <= TOLERANCE {
            self.statistics.worst = self.statistics.worst.max(relative);
            self.statistics.solutions += 1;
            Ok(())
        } else if relative <= slack * TOLERANCE {
            self.statistics.told += 1;
            Ok(())
        } else {
            Err(format!(
                "{what}: {own:?}\nwanted: {wanted:?}\ndifference over condition {relative:e}, {:e}",
                round_off
            ))
        }
    }

    /// Accelerations and multipliers.
    pub(crate) fn solutions(
        &mut self,
        state: &State,
        stretched: &State,
        equations: &Equations,
        coefficients: Coefficients,
    ) -> Result<(), String> {
        let (model, described) = (self.model, self.described);
        let inputs =
            |state: &State| Inputs::new(model, described, state, &equations.angles, coefficients);
        let (unit, inputs) = (inputs(state), inputs(stretched));
        let rows = equations.phi.len();
        let rigid = System::new(equations, 0.0);
        let soft = System::new(equations, coefficients.compliance);
        self.statistics.singular += usize::from(rigid.is_none());
        let right = |gains: (f64, f64)| {
            let lower = (0..rows).map(|k| {
                equations.gamma[k] - gains.0 * equations.rate[k] - gains.1 * equations.phi[k]
            });
            let mut right = equations.forces.clone();
            right.extend(lower);
            right
        };
        let solved = Terms::ALL.map(|terms| {
            let system = if terms == Terms::Compliant {
                &soft
            } else {
                &rigid
            };
            let gains = coefficients.gains(terms);
            let solve = |system: &System| system.solve_with(&right(gains), gains);
            (terms, system.as_ref().map(solve))
        });
        let wanted = |terms: Terms| {
            let mut solved = solved.iter();
            solved
                .find(|(known, _)| *known == terms)
                .and_then(|(_, solution)| solution.as_ref())
        };
        let evaluations = self.kernels.iter().flat_map(|kernels| &kernels.evaluations);
        let evaluations = evaluations.map(|evaluation| ("chosen", evaluation));
        let others = self.others.iter().map(|evaluation| ("other", evaluation));
        let layout = model.layout();
        let coordinates = layout.coordinates + layout.auxiliaries;
        let mut found = Vec::new();
        for (plan, evaluation) in evaluations.chain(others) {
            let values = inputs.of(&evaluation.kernel);
            let (rates, rest) = values.split_at(coordinates);
            let (solution, pivots) = rest.split_at(layout.velocities + rows);
            let what = format!("{plan} plan, {:?}, pivots {pivots:?}", evaluation.terms);
            let pivot = smallest(pivots, &evaluation.checks);
            found.push((
                what,
                evaluation.terms,
                rates.to_vec(),
                solution.to_vec(),
                pivot,
            ));
        }
        let mut is_told = false;
        let is_off = !equations.hold();
        for (what, terms, rates, solution, pivot) in found {
            let of_coordinates = self.coordinate_rates(stretched, equations);
            let names = format!("q', {what}");
            self.within(&names, &rates, &of_coordinates, equations.scale)?;
            if let Some((wanted, round_off)) = wanted(terms) {
                let sound = rigid
                    .as_ref()
                    .is_some_and(|system| system.condition() < SOUND);
                if sound && pivot < SMALL {
                    // Of a combination of rows that acts on one of two bodies only, or turns with
                    // none of them, which no joint has: it vanishes with the violations.
                    if !is_off {
                        return Err(format!(
                            "{what}: a pivot of {pivot:e} in a system that is not singular"
                        ));
                    }
                    is_told = true;
                }
                if pivot < SMALL {
                    // The kernel says so, and what it makes of it is of no use.
                    continue;
                }
                // What a small pivot loses is told by the kernel.
                self.solution(
                    &what,
                    &solution,
                    &(wanted.clone(), round_off / pivot.min(1.0)),
                    slack(terms, equations, coefficients),
                )?;
            }
        }
        self.statistics.told += usize::from(is_told);
        self.solvers(
            unit,
            equations,
            &right(coefficients.gains(Terms::Stabilised)),
            [rigid.as_ref(), soft.as_ref()],
        )
    }

    /// `factor` and `solve`, and the iteration of the augmented Lagrangian on top.
    fn solvers(
        &mut self,
        mut inputs: Inputs,
        equations: &Equations,
        right: &[f64],
        [rigid, soft]: [Option<&System>; 2],
    ) -> Result<(), String> {
        let (velocities, rows) = (equations.forces.len(), equations.phi.len());
        let (upper, lower) = right.split_at(velocities);
        inputs.upper = in_axes(self.model, upper, true);
        inputs.lower = lower.to_vec();
        let mut found = Vec::new();
        let solvers = self.kernels.iter().flat_map(|kernels| &kernels.solvers);
        for solver in solvers {
            let system = if solver.terms == Terms::Compliant {
                soft
            } else {
                rigid
            };
            if let Some(system) = system {
                let values = inputs.values(&solver.arena, &solver.solution);
                let pivots = inputs.values(&solver.arena, &solver.pivots);
                let pivot = smallest(&pivots, &solver.checks);
                if pivot < SMALL {
                    continue;
                }
                let (wanted, round_off) = system.solve(right);
                found.push((solver.terms, values, (wanted, round_off / pivot)));
            }
        }
        for (terms, values, wanted) in found {
            let slack = slack(terms, equations, inputs.coefficients);
            self.solution(&format!("solver, {terms:?}"), &values, &wanted, slack)?;
        }
        let kernels = self.kernels.as_ref();
        let mut solvers = kernels.iter().flat_map(|kernels| &kernels.solvers);
        let compliant = solvers.find(|solver| solver.terms == Terms::Compliant);
        let (Some(rigid), Some(soft), Some(compliant)) = (rigid, soft, compliant) else {
            return Ok(());
        };
        let compliance = inputs.coefficients.compliance;
        let mut multipliers = vec![0.0; rows];
        let mut values = Vec::new();
        let mut change = f64::INFINITY;
        for _ in 0..200 {
            inputs.lower = (0..rows)
                .map(|k| lower[k] - compliance * multipliers[k])
                .collect();
            values = inputs.values(&compliant.arena, &compliant.solution);
            let next = values[velocities..].to_vec();
            let size = next.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
            change = difference(&next, &multipliers) / size;
            multipliers = next;
            if change < 1e-15 {
                break;
            }
        }
        if change > 1e-14 {
            // Slow where rows are soft: what it would become is not known yet.
            return Ok(());
        }
        let (wanted, round_off) = rigid.solve(right);
        let (_, soft_round_off) = soft.solve(right);
        let round_off = round_off.max(soft_round_off) * (1.0 + compliance * soft.inverse);
        let slack = slack(Terms::Compliant, equations, inputs.coefficients);
        self.solution("augmented Lagrangian", &values, &(wanted, round_off), slack)
    }
}
