//! What is left out of redundant equations follows from the rest: in position, in velocity, in
//! acceleration.

use holonom_engine::rank::TOLERANCE as RESOLVED;

use crate::comparison::Comparison;
use crate::reference::{Equations, State};
use crate::solutions::System;

/// Of what follows from other equations, times the condition number.
const TOLERANCE: f64 = 1e-12;
/// Equations that hold by less than this in the reference configuration hold.
const HOLDS: f64 = 1e-9;
/// Systems beyond this say nothing about equations that are left out.
const CONDITION: f64 = 1e6;

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}

impl Comparison<'_> {
    /// Where the reference configuration satisfies the equations: with velocities that satisfy the
    /// rest of them, those that are left out are satisfied by velocities and accelerations too.
    pub(crate) fn left_out(&self, state: &State) -> Result<(), String> {
        if !self.dropped.contains(&true) {
            return Ok(());
        }
        let Some((satisfied, condition)) = self.satisfying(state) else {
            return Ok(());
        };
        let Some(all) = Equations::new(self.described, &satisfied) else {
            return Ok(());
        };
        let Some(kept) = Equations::new(self.described, &satisfied) else {
            return Ok(());
        };
        let kept = kept.without(&self.dropped);
        let Some(system) = System::new(&kept, 0.0) else {
            return Ok(());
        };
        let mut right = kept.forces.clone();
        right.extend(&kept.gamma);
        let (solution, _) = system.solve(&right);
        let accelerations = &solution[..kept.forces.len()];
        // The engine takes rows for dependent that stand out from each other by less than it
        // resolves, so that numbers of six digits may be given.
        let tolerance = (TOLERANCE * condition).max(10.0 * RESOLVED);
        let bound = tolerance * (all.scale + largest(accelerations));
        for (row, gradient) in all.gradients.iter().enumerate() {
            let found: f64 = gradient.iter().zip(accelerations).map(|(d, a)| d * a).sum();
            let rest = found - all.gamma[row];
            let worst = all.rate[row].abs().max(rest.abs());
            // Not a number is not within.
            let holds = worst <= bound;
            if self.dropped[row] && !holds {
                return Err(format!(
                    "row {row}, which is left out, is violated: velocity {:e}, acceleration {rest:e}\nat {satisfied:?}",
                    all.rate[row]
                ));
            }
        }
        Ok(())
    }

    /// The state with velocities that satisfy the equations that are kept, and the condition of the
    /// system.
    fn satisfying(&self, state: &State) -> Option<(State, f64)> {
        let all = Equations::new(self.described, state)?;
        if largest(&all.phi) > HOLDS {
            return None;
        }
        let kept = all.without(&self.dropped);
        let system = System::new(&kept, 0.0)?;
        let mut right = vec![0.0; kept.forces.len()];
        right.extend(kept.rate.iter().map(|rate| -rate));
        let (change, _) = system.solve(&right);
        let mut satisfied = state.clone();
        let mut change = change.into_iter();
        for ((v, w), body) in satisfied.rates.iter_mut().zip(&self.described.bodies) {
            v.iter_mut()
                .for_each(|v| *v += change.next().unwrap_or(f64::NAN));
            if body.inertia.is_some() {
                w.iter_mut()
                    .for_each(|w| *w += change.next().unwrap_or(f64::NAN));
            }
        }
        let condition = system.condition();
        (condition < CONDITION).then_some((satisfied, condition))
    }
}
