//! The kernels of every joint equal those of the assembler and derivatives by dual numbers, at
//! random times, on the constraints and off them, for random placements of the bodies; and every
//! joint has its number of equations.

use holonom::mechanism::Rank;
use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::Orientation;
use holonom_assembler::dual;
use holonom_assembler::formulation::{Evaluator, Formulation};
use holonom_assembler::scalars::Scalar;
use holonom_assembler::states::generator;
use nalgebra::{DVector, Vector3};

use crate::comparison::{ROUND_OFF, Worst, distance};
use crate::data::{LITERAL, Member};
use crate::kernels::Kernels;
use crate::library::library;
use crate::states::{all, consistent};

/// What residuals, energies and forces are compared with where they are smaller: they are
/// differences of numbers of the size 1 or more (m, m/s, m/s^2, unit vectors).
const UNIT: f64 = 1.0;

/// How many random placements are tried, and states of each kind for each of them.
const PLACEMENTS: u64 = 6;
const STATES: usize = 6;

/// The largest deviations of the kernels.
#[derive(Debug, Default)]
struct Deviations {
    phi: Worst,
    rate: Worst,
    jacobian: Worst,
    gamma: Worst,
    explicit: Worst,
    others: Worst,
    accelerations: Worst,
    multipliers: Worst,
}

impl Deviations {
    /// `Phi`, `Phi'`, `D`, `gamma`, `Phi_t`, `Phi_tt`.
    fn constraints(
        &mut self,
        what: &str,
        kernels: &dyn Kernels,
        scene: &Assembler,
        time: f64,
        x: &[f64],
    ) {
        let q = &x[..scene.coordinates()];
        let [phi, rate, gamma] = kernels.rows(time, x);
        let by_definition = DVector::from_vec(dual::constraints_at(scene, time, q));
        let (dual_rate, dual_gamma) = dual::constraint_rates_and_gamma_at(scene, time, x);
        for (name, computed, references, worst) in [
            (
                "Phi",
                &phi,
                [scene.constraints_at(time, x), by_definition],
                &mut self.phi,
            ),
            (
                "Phi'",
                &rate,
                [scene.constraint_rates_at(time, x), dual_rate],
                &mut self.rate,
            ),
            (
                "gamma",
                &gamma,
                [scene.gamma_at(time, x), dual_gamma],
                &mut self.gamma,
            ),
        ] {
            for reference in references {
                let deviation = distance(computed, reference.as_slice(), UNIT);
                worst.take(&format!("{name} of {what}"), deviation, ROUND_OFF);
            }
        }
        let jacobian = kernels.jacobian(time, x);
        for reference in [scene.jacobian(x), dual::jacobian(scene, x)] {
            let deviation = distance(jacobian.as_slice(), reference.as_slice(), UNIT);
            self.jacobian
                .take(&format!("D of {what}"), deviation, ROUND_OFF);
        }
        // At rest what is left of the rates is due to time alone.
        let mut rest = x.to_vec();
        rest[scene.coordinates()..].fill(0.0);
        let [_, rate, gamma] = kernels.rows(time, &rest);
        let by_duals = dual::time_rates(scene, time, x);
        for (computed, reference) in [(rate, by_duals), (gamma, -scene.time_derivatives(time, 2))] {
            let deviation = distance(&computed, reference.as_slice(), UNIT);
            self.explicit
                .take(&format!("Phi_t of {what}"), deviation, ROUND_OFF);
        }
    }

    /// `g`, `q'`, energies and power.
    fn dynamics(
        &mut self,
        what: &str,
        kernels: &dyn Kernels,
        scene: &Assembler,
        time: f64,
        x: &[f64],
    ) {
        let books = kernels.books(time, x);
        // Heights cancel: what counts is the weight of all bodies at 1 m.
        let mass: f64 = scene.bodies().map(|(body, ..)| body.mass).sum();
        let weight = mass * scene.gravity().norm();
        for (name, computed, reference, floor) in [
            (
                "g",
                kernels.forces(time, x),
                scene.forces_at(time, x).as_slice().to_vec(),
                UNIT,
            ),
            (
                "q'",
                kernels.coordinate_rates(x),
                scene.coordinate_rates(x).as_slice().to_vec(),
                UNIT,
            ),
            (
                "kinetic energy",
                vec![books.kinetic],
                vec![scene.kinetic_energy(x)],
                0.0,
            ),
            (
                "potential energy",
                vec![books.potential],
                vec![scene.potential_energy(x)],
                weight,
            ),
            (
                "power",
                vec![books.power],
                vec![scene.power_at(time, x)],
                UNIT,
            ),
        ] {
            let deviation = distance(&computed, &reference, floor);
            self.others
                .take(&format!("{name} of {what}"), deviation, ROUND_OFF);
        }
    }

    /// `u'` and `lambda`, with Euler parameters normalised in `A` and as they are in `q'`, against
    /// the assembler's dense solution.
    fn solution(
        &mut self,
        what: &str,
        kernels: &dyn Kernels,
        evaluator: &mut Evaluator,
        time: f64,
        x: &[f64],
    ) {
        let found = kernels.evaluate(time, x);
        let mut rates = vec![0.0; x.len()];
        // The pivot of two rows that pair with accelerations is exact on the constraints alone, and
        // so is the solution.
        evaluator.rates(time, x, &mut rates).expect("solvable");
        let first = evaluator.assembler().coordinates();
        let deviation = distance(&found.rates[..first], &rates[..first], UNIT);
        self.others
            .take(&format!("q' of {what}"), deviation, ROUND_OFF);
        let deviation = distance(&found.rates[first..], &rates[first..], UNIT) * found.pivot;
        self.accelerations
            .take(&format!("u' of {what}"), deviation, ROUND_OFF);
        let lambda = evaluator.multipliers();
        let deviation = distance(&found.multipliers, lambda.as_slice(), UNIT) * found.pivot;
        self.multipliers
            .take(&format!("lambda of {what}"), deviation, ROUND_OFF);
    }

    /// Everything, at many states.
    fn all(&mut self, what: &str, kernels: &dyn Kernels, scene: &Assembler, seed: u64) {
        let described = kernels.initial_state();
        let deviation = distance(&described, scene.initial_state().as_slice(), UNIT);
        self.others.take(
            &format!("the initial state of {what}"),
            deviation,
            ROUND_OFF,
        );
        let deviation = distance(&kernels.mass(), scene.mass().as_slice(), 0.0);
        self.others
            .take(&format!("M of {what}"), deviation, ROUND_OFF);
        let normalised = scene.clone().with_orientation(Orientation::Normalised);
        let mut evaluator = Evaluator::new(normalised, Formulation::Standard);
        for (time, x) in all(scene, STATES, seed) {
            let x = x.as_slice();
            self.constraints(what, kernels, scene, time, x);
            self.dynamics(what, kernels, scene, time, x);
            self.solution(what, kernels, &mut evaluator, time, x);
        }
    }
}

#[test]
fn kernels_are_those_of_the_assembler_and_of_duals() {
    let mut rng = generator(101);
    for entry in library() {
        let mut worst = Deviations::default();
        for placement in &entry.placements {
            let what = format!("{} among {:?}", entry.name, placement.members);
            for seed in 0..PLACEMENTS {
                let data = placement.data(&mut rng);
                let kernels = (placement.describe)(&data);
                let (scene, _) = entry.assembler(placement, &data);
                worst.all(&what, &*kernels, &scene, 10 * seed);
            }
        }
        println!("{}: {worst:?}", entry.name);
    }
}

#[test]
fn every_joint_has_its_equations_and_leaves_the_rest() {
    for entry in library() {
        let name = entry.name;
        for placement in &entry.placements {
            let report = (placement.describe)(&LITERAL).report();
            assert_eq!(report.equations, entry.equations, "{name}");
            assert_eq!(report.joints[0].rows, entry.equations, "{name}");
            let rank = match placement.late {
                true => Rank::NotDecided,
                false => Rank::Decided {
                    rank: entry.equations,
                    at_start: entry.equations,
                },
            };
            assert_eq!(report.rank, rank, "{name}");
            assert_eq!(report.redundant, [], "{name}");
            let left = report.velocities.checked_signed_diff(entry.equations);
            assert_eq!(Some(report.degrees_of_freedom), left, "{name}");
        }
    }
}

#[test]
fn angles_and_displacements_read_as_the_assembler_sees_them() {
    let mut rng = generator(102);
    let mut worst = Worst::default();
    for entry in library().iter().filter(|entry| entry.free.is_some()) {
        for placement in &entry.placements {
            let data = placement.data(&mut rng);
            let kernels = (placement.describe)(&data);
            let info = kernels.report().joints[0];
            let (scene, bodies) = entry.assembler(placement, &data);
            let angle = scene.angle([bodies[0], bodies[1]], data.a);
            let point = match placement.members.contains(&Member::Bead) {
                true => data.centre(),
                false => data.head,
            };
            let displacement = match entry.name {
                "DistanceDriver" => Scalar::Length([
                    scene.point(bodies[0], data.head),
                    scene.point(bodies[1], data.tail),
                ]),
                _ => Scalar::Along {
                    axis: scene.vector(bodies[0], Vector3::from(data.a).normalize().into()),
                    points: [scene.point(bodies[0], point), scene.point(bodies[1], point)],
                },
            };
            for (time, x) in consistent(&scene, 10, 50) {
                let x = x.as_slice();
                let at = scene.kinematics_at(time, x);
                let [[turned, rate], found] = kernels.readings(time, x);
                // A driver alone does not keep the axes together, about which an angle is read.
                if info.has_angle && entry.name != "AngleDriver" {
                    // On the constraints both are angles about the same axis.
                    let principal = angle.principal(&at);
                    let expected = [principal.sin(), principal.cos(), angle.rate(&at)];
                    let found = [turned.sin(), turned.cos(), rate];
                    worst.take(
                        &format!("angle of {}", entry.name),
                        distance(&found, &expected, UNIT),
                        ROUND_OFF,
                    );
                }
                if info.has_displacement {
                    let expected = [displacement.value(&at), displacement.rate(&at)];
                    worst.take(
                        &format!("displacement of {}", entry.name),
                        distance(&found, &expected, UNIT),
                        ROUND_OFF,
                    );
                }
            }
        }
    }
    println!("readings: {:e}", worst.0);
}
