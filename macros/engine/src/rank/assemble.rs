//! The way back onto the constraints.

use super::dense::norm;
use super::motion::{Configuration, Constraints};
use super::normal::solve_normal;
use super::sparse::transposed;

/// Violations up to this, over the size of the row's gradient, are round-off.
pub(super) const ASSEMBLED: f64 = 1e-9;
/// A violation this small that a step does not make ten times smaller is left as it is: it is
/// round-off, or the constraints touch each other only, and nearer to the point of contact their
/// rows could not be told apart.
const FINE: f64 = 1e-12;
const STEPS: usize = 50;
const ATTEMPTS: usize = 12;

impl Constraints {
    /// A configuration near the given one that satisfies the constraints (Levenberg and Marquardt:
    /// steps of least length where the gradients are independent, and no worse where they are not).
    pub(super) fn assembled(&self, from: &Configuration) -> Option<Configuration> {
        self.assembled_of(from, None)
    }

    /// The same for some of the rows; `None` for all.
    pub(super) fn assembled_of(
        &self,
        from: &Configuration,
        rows: Option<&[usize]>,
    ) -> Option<Configuration> {
        const BOUND: f64 = 0.5;
        let mut at = from.clone();
        let violations_at = |at: &Configuration| {
            let all = self.violations(at)?;
            Some(chosen(all, rows))
        };
        let mut violations = violations_at(&at)?;
        let mut size = norm(&violations);
        let mut caution = 1.0;
        for _ in 0..STEPS {
            if size == 0.0 {
                break;
            }
            let mut gradients = self.gradients(&at)?;
            for (row, size) in gradients.iter_mut().zip(&self.sizes) {
                let factor = size.map_or(0.0, f64::recip);
                row.scale(factor);
            }
            let gradients = chosen(gradients, rows);
            let mut next = None;
            for _ in 0..ATTEMPTS {
                let damping = (caution * size * size).max(1e-14);
                if let Some(y) = solve_normal(&gradients, &violations, damping) {
                    let step = transposed(&gradients, &y, self.velocities());
                    let factor = -(BOUND / norm(&step)).min(1.0);
                    let step: Vec<f64> = step.iter().map(|x| factor * x).collect();
                    let reached = self.moved(&at, &step);
                    let violations = violations_at(&reached)?;
                    let reduced = norm(&violations);
                    if reduced < size {
                        next = Some((reached, violations, reduced));
                        break;
                    }
                }
                if size <= FINE {
                    break;
                }
                caution *= 10.0;
            }
            let Some((reached, reached_violations, reduced)) = next else {
                break;
            };
            let is_done = reduced <= FINE && reduced > 0.1 * size;
            (at, violations, size) = (reached, reached_violations, reduced);
            caution = (0.1 * caution).max(1.0);
            if is_done {
                break;
            }
        }
        self.rewrap(&mut at);
        (size <= ASSEMBLED).then_some(at)
    }
}

/// What belongs to some of the rows, `None` for all.
fn chosen<T: Clone>(all: Vec<T>, rows: Option<&[usize]>) -> Vec<T> {
    match rows {
        Some(rows) => rows.iter().map(|&row| all[row].clone()).collect(),
        None => all,
    }
}
