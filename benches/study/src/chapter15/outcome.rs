//! What one formulation did, and what follows from it by itself.

use std::ops::Range;

use holonom::dynamics::Iterations;

use super::Method;
use crate::pendulum::{RigidPendulum, Swing, polar_parts, wrapped};
use crate::statistics::largest;
use crate::timing::Timing;

/// The pendulum at a reporting time, as integrated: Euler parameters are not scaled back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    /// Time (s).
    pub time: f64,
    /// Angle from the downward vertical (rad), from the Euler parameters.
    pub angle: f64,
    /// Kinetic and potential energy (J).
    pub energy: f64,
    /// `Phi^T Phi`: three rows in m, two scalar products of unit vectors.
    pub violation: f64,
    /// The force of the pivot on the rod (N, global axes).
    pub force: [f64; 3],
}

/// The prices of one formulation, all measured in turn.
#[derive(Clone, Debug, PartialEq)]
pub struct Prices {
    /// The generated kernels.
    pub generated: Timing,
    /// The run-time assembler, same formulation and integrator: one or more forms.
    pub assembler: Vec<Timing>,
    /// Forms with matrices of static size, where there are any.
    pub static_matrices: Vec<Timing>,
}

impl Prices {
    /// The assembler's cheapest form; `None` where there is none.
    #[must_use]
    pub fn cheapest_assembler(&self) -> Option<&Timing> {
        self.assembler
            .iter()
            .min_by(|a, b| a.time.median.total_cmp(&b.time.median))
    }

    /// All prices, that of the generated kernels first.
    pub fn all(&self) -> impl Iterator<Item = &Timing> {
        std::iter::once(&self.generated)
            .chain(&self.static_matrices)
            .chain(&self.assembler)
    }
}

/// What one formulation did.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Which formulation.
    pub method: Method,
    /// Evaluations of the equations of motion.
    pub evaluations: u64,
    /// Steps that were accepted.
    pub accepted: u64,
    /// Steps that were rejected.
    pub rejected: u64,
    /// How often the augmented Lagrangian solved its system; zero for other formulations.
    pub iterations: Iterations,
    /// The pendulum at the reporting times, the start among them.
    pub instants: Vec<Instant>,
    /// What an evaluation costs.
    pub prices: Prices,
}

impl Outcome {
    /// A quantity over time.
    pub fn over_time(&self, quantity: impl Fn(&Instant) -> f64) -> Vec<(f64, f64)> {
        self.instants
            .iter()
            .map(|instant| (instant.time, quantity(instant)))
            .collect()
    }

    /// The quantity at the last reporting time; NaN where there is none.
    fn last(&self, quantity: impl Fn(&Instant) -> f64) -> f64 {
        self.instants.last().map_or(f64::NAN, quantity)
    }

    /// The angle less that of the closed form (rad) at the last reporting time.
    #[must_use]
    pub fn final_angle_error(&self) -> f64 {
        self.last(Instant::angle_error)
    }

    /// `Phi^T Phi` at the last reporting time.
    #[must_use]
    pub fn final_violation(&self) -> f64 {
        self.last(|instant| instant.violation)
    }

    /// The largest `Phi^T Phi` at the reporting times in a range of times (s).
    #[must_use]
    pub fn largest_violation(&self, times: Range<f64>) -> f64 {
        let within = self
            .instants
            .iter()
            .filter(|instant| times.contains(&instant.time));
        largest(within.map(|instant| instant.violation))
    }

    /// The largest difference of the energy from that at the start (J), at the reporting times.
    #[must_use]
    pub fn energy_drift(&self) -> f64 {
        let start = self.start_energy();
        largest(self.instants.iter().map(|instant| instant.energy - start))
    }

    /// The energy at the start (J); NaN where nothing was reported.
    #[must_use]
    pub fn start_energy(&self) -> f64 {
        self.instants
            .first()
            .map_or(f64::NAN, |instant| instant.energy)
    }

    /// The largest errors of radial and transverse reaction (N) at the reporting times.
    #[must_use]
    pub fn largest_reaction_errors(&self) -> (f64, f64) {
        let errors = |part: fn((f64, f64)) -> f64| {
            largest(
                self.instants
                    .iter()
                    .map(|instant| part(instant.reaction_errors())),
            )
        };
        (errors(|e| e.0), errors(|e| e.1))
    }

    /// The time of an evaluation (ns) through the assembler's cheapest form; NaN where there is
    /// none.
    #[must_use]
    pub fn assembler_time(&self) -> f64 {
        self.prices
            .cheapest_assembler()
            .map_or(f64::NAN, |price| price.time.median)
    }

    /// The time of the whole run (s), by the median of the time per evaluation.
    #[must_use]
    pub fn run_time(&self) -> f64 {
        self.evaluations as f64 * self.prices.generated.time.median * 1e-9
    }
}

impl Instant {
    /// The closed form at this time.
    #[must_use]
    pub fn exact(&self) -> Swing {
        RigidPendulum::CHAPTER_15.at(self.time)
    }

    /// The angle less that of the closed form (rad).
    #[must_use]
    pub fn angle_error(&self) -> f64 {
        wrapped(self.angle - self.exact().angle)
    }

    /// Radial and transverse part of the reaction (N), along the rod as computed.
    #[must_use]
    pub fn reaction(&self) -> (f64, f64) {
        polar_parts(self.force, self.angle)
    }

    /// Radial and transverse reaction less those of the closed form (N).
    #[must_use]
    pub fn reaction_errors(&self) -> (f64, f64) {
        let (exact, (radial, transverse)) = (self.exact(), self.reaction());
        (radial - exact.radial, transverse - exact.transverse)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::{Instant, Outcome, Prices};
    use crate::chapter15::Method;
    use crate::pendulum::RigidPendulum;
    use crate::statistics::Quartiles;
    use crate::timing::Timing;
    use holonom::dynamics::Iterations;

    /// An outcome that follows the closed form but for an angle that runs ahead and a violation
    /// that grows.
    pub(crate) fn made_up(method: Method) -> Outcome {
        let instants = (0..=500).map(|step| {
            let time = 0.02 * f64::from(step);
            let exact = RigidPendulum::CHAPTER_15.at(time);
            let (sine, cosine) = exact.angle.sin_cos();
            Instant {
                time,
                angle: exact.angle + 1e-7 * time,
                energy: -1e-6 * time,
                violation: 1e-14 * time * time,
                force: [
                    0.0,
                    exact.transverse * cosine - exact.radial * sine,
                    exact.transverse * sine + exact.radial * cosine,
                ],
            }
        });
        let price = |name: &str, median: f64| Timing {
            name: name.into(),
            time: Quartiles {
                least: 0.8 * median,
                lower: 0.9 * median,
                median,
                upper: 1.1 * median,
                count: 41,
            },
            evaluations: 1765,
            share: 1.0,
        };
        let mut iterations = Iterations::default();
        if method == Method::AugmentedLagrangian {
            (iterations.total, iterations.largest) = (3530, 3);
        }
        let standard = method == Method::Standard;
        Outcome {
            method,
            evaluations: 1765,
            accepted: 290,
            rejected: 4,
            iterations,
            instants: instants.collect(),
            prices: Prices {
                generated: price("generated", 50.0),
                assembler: vec![
                    price("whole matrix", 2500.0),
                    price("Schur complement", 2000.0),
                ],
                static_matrices: standard
                    .then(|| price("static", 250.0))
                    .into_iter()
                    .collect(),
            },
        }
    }

    #[test]
    fn errors_are_those_that_were_made() {
        let outcome = made_up(Method::Standard);
        assert!((outcome.final_angle_error() - 1e-6).abs() < 1e-13);
        assert!((outcome.final_violation() - 1e-12).abs() < 1e-25);
        assert!((outcome.energy_drift() - 1e-5).abs() < 1e-18);
        assert_eq!(outcome.assembler_time(), 2000.0);
        assert!((outcome.run_time() - 88.25e-6).abs() < 1e-15);
        // The reaction is exact, the direction of the rod is off by the error of the angle.
        let (radial, transverse) = outcome.largest_reaction_errors();
        assert!(radial < 20.0 * 1e-6 && transverse < 180.0 * 1e-6);
    }

    #[test]
    fn violation_by_time() {
        let outcome = made_up(Method::Standard);
        let first = outcome.largest_violation(0.0..1.0);
        let last = outcome.largest_violation(9.0..f64::INFINITY);
        assert!((first / 1e-14 - 0.98 * 0.98).abs() < 1e-9);
        assert!((last / 1e-14 - 100.0).abs() < 1e-9);
    }

    #[test]
    fn nothing_reported_is_not_a_number() {
        let outcome = Outcome {
            instants: vec![],
            ..made_up(Method::Penalty)
        };
        assert!(outcome.final_angle_error().is_nan() && outcome.final_violation().is_nan());
        assert!(outcome.start_energy().is_nan());
    }

    #[test]
    fn nan_is_not_lost_among_good_numbers() {
        let mut outcome = made_up(Method::Penalty);
        outcome.instants[100].violation = f64::NAN;
        assert!(outcome.largest_violation(0.0..f64::INFINITY).is_nan());
    }
}
