//! Warnings of right runs, and silence of wrong ones, of forced and driven motions with all methods
//! in both coordinates.

#![forbid(unsafe_code)]

use holonom::forces::{Actuator, SpringDamper, TorsionalActuator};
use holonom::joints::{AngleDriver, DisplacementDriver, Prismatic, Revolute};
use holonom::prelude::*;
use holonom::{DormandPrince853, JointCoordinates, StateParts, state::Array};
use holonom_fixtures as _;
use holonom_study::trade::{Family, IntegratorSetting};
use holonom_tests::RunsBoth;

/// A cart on a spring of 1 N/m with a damper, pushed to and fro: 1 rad/s by itself.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Oscillator {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    cart: Body,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    track: Prismatic,
    #[force(
        between = [ground, cart],
        head = [-10.0, 0.0, 0.0],
        tail = [0.0, 0.0, 0.0],
        stiffness = 1.0,
        damping = damping,
        free_length = 10.0
    )]
    spring: SpringDamper,
    #[force(
        between = [ground, cart],
        head = [-10.0, 0.0, 0.0],
        tail = [0.0, 0.0, 0.0],
        force = cos(frequency * time)
    )]
    push: Actuator,
    #[param]
    damping: f64,
    #[param]
    frequency: f64,
}

/// A table that a motor turns, with a block on a spring along a radius.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Turntable {
    #[body(mass = 2.0, inertia = [0.1, 0.1, 0.2], angular_velocity = [0.0, 0.0, 3.0])]
    table: Body,
    #[body(
        mass = 1.0,
        inertia = [0.01, 0.01, 0.01],
        position = [0.5, 0.0, 0.0],
        velocity = [0.0, 1.5, 0.0],
        angular_velocity = [0.0, 0.0, 3.0]
    )]
    block: Body,
    #[joint(between = [ground, table], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
    #[joint(between = [ground, table], axis = [0.0, 0.0, 1.0], motion = 3.0 * time)]
    motor: AngleDriver,
    #[joint(between = [table, block], point = [0.5, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    guide: Prismatic,
    #[force(
        between = [table, block],
        head = [0.0, 0.0, 0.0],
        tail = [0.5, 0.0, 0.0],
        stiffness = 40.0,
        damping = 0.4,
        free_length = 0.5
    )]
    spring: SpringDamper,
}

/// A rod that hangs from a hinge which a motor shakes.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Shaken {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], velocity = [0.0, 0.5, 0.0])]
    cart: Body,
    #[body(
        mass = 1.0,
        inertia = [0.0833, 0.0833, 0.001],
        position = [0.0, 0.0, -0.5],
        velocity = [0.0, 0.5, 0.0]
    )]
    rod: Body,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    rail: Prismatic,
    #[joint(
        between = [ground, cart],
        point = [0.0, 0.0, 0.0],
        axis = [0.0, 1.0, 0.0],
        motion = 0.1 * sin(5.0 * time)
    )]
    motor: DisplacementDriver,
    #[joint(between = [cart, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[force(between = [cart, rod], axis = [1.0, 0.0, 0.0], moment = -0.3 * rate)]
    friction: TorsionalActuator,
}

/// A rod that stands upright because its hinge is shaken along it.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Upright {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], velocity = [0.0, 0.0, 5.0])]
    cart: Body,
    #[body(
        mass = 1.0,
        inertia = [0.0833, 0.0833, 0.001],
        position = [0.0, 0.5 * sin(0.2), 0.5 * cos(0.2)],
        velocity = [0.0, 0.0, 5.0]
    )]
    rod: Body,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    rail: Prismatic,
    #[joint(
        between = [ground, cart],
        point = [0.0, 0.0, 0.0],
        axis = [0.0, 0.0, 1.0],
        motion = 0.1 * sin(50.0 * time)
    )]
    motor: DisplacementDriver,
    #[joint(between = [cart, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[force(between = [cart, rod], axis = [1.0, 0.0, 0.0], moment = -0.5 * rate)]
    friction: TorsionalActuator,
}

/// A rod that a moment swings, with friction.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Swung {
    #[body(mass = 1.0, inertia = [0.0833, 0.0833, 0.001], position = [0.0, 0.0, -0.5])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[force(
        between = [ground, rod],
        axis = [1.0, 0.0, 0.0],
        moment = 1.5 * sin(2.0 * time) - 0.3 * rate
    )]
    drive: TorsionalActuator,
}

/// How often states are compared.
const REPORTS: usize = 64;

/// Positions and rotations of bodies at the reporting times.
type History = Vec<Vec<f64>>;

/// A motion over some time (s).
struct Scene<'a, M> {
    name: &'a str,
    mechanism: &'a M,
    end: f64,
    /// The rate (rad/s) that steps must follow.
    rate: f64,
}

impl<M: JointCoordinates> Scene<'_, M> {
    fn run(
        &self,
        integrator: impl RunsBoth<M, StandardLagrange>,
        is_relative: bool,
    ) -> Result<(History, String), String> {
        let mut history = History::new();
        let observe = |sample: &Sample<'_, f64, M>| {
            history.push(sample.state().coordinates().as_slice().to_vec());
            ControlFlow::Continue(())
        };
        let (span, reports) = (0.0..=self.end, every(self.end / REPORTS as f64));
        let simulation = Simulation::new(self.mechanism, StandardLagrange, integrator);
        let report = if is_relative {
            simulation.joint_coordinates().run(span, reports, observe)
        } else {
            // The violation of positions would be what is wrong, else.
            simulation
                .absolute_coordinates()
                .projection(Projection::default())
                .run(span, reports, observe)
        };
        let report = report.map_err(|error| error.to_string())?;
        Ok((history, report.warnings().to_string()))
    }

    /// The largest error of a body, over how far it moves: a radian at the most.
    fn error(&self, history: &History, truth: &History) -> f64 {
        let mut worst = 0.0_f64;
        for body in M::REPORT.bodies {
            let parts = [(body.coordinate, 3), (body.coordinate + 3, 4)];
            for (part, (place, count)) in parts.into_iter().enumerate() {
                let distance = |a: &[f64], b: &[f64]| {
                    let square = |sign: f64| {
                        let pairs = a.iter().zip(b).skip(place).take(count);
                        pairs.map(|(a, b)| (a - sign * b).powi(2)).sum::<f64>()
                    };
                    if part == 0 {
                        square(1.0).sqrt()
                    } else {
                        2.0 * square(1.0).min(square(-1.0)).sqrt()
                    }
                };
                let moved = truth.iter().map(|state| distance(state, &truth[0]));
                let moved = moved.fold(0.0, f64::max);
                let moved = if part == 0 { moved } else { moved.min(1.0) };
                let off = history.iter().zip(truth).map(|(a, b)| distance(a, b));
                let off = off.fold(0.0, f64::max);
                if moved > 1e-3 {
                    worst = worst.max(off / moved);
                }
            }
        }
        worst
    }
}

/// What came of all runs.
#[derive(Debug, Default)]
struct Counts {
    right: usize,
    alarms: usize,
    wrong: usize,
    silent: usize,
    failed: usize,
}

/// Methods with their steps, times the rate of a motion, or their tolerances.
const WAYS: [(Family, f64); 16] = [
    (Family::SemiImplicitEuler, 0.005),
    (Family::Midpoint, 0.1),
    (Family::Midpoint, 0.02),
    (Family::Heun, 0.04),
    (Family::ImplicitMidpoint, 0.04),
    (Family::GeneralizedAlpha, 0.03),
    (Family::Kutta3, 0.05),
    (Family::Rk4, 0.1),
    (Family::AdamsBashforthMoulton4, 0.05),
    (Family::BogackiShampine, 1e-4),
    (Family::DormandPrince, 1e-3),
    (Family::DormandPrince, 1e-6),
    (Family::DormandPrince853, 1e-6),
    (Family::Adams, 1e-5),
    (Family::Bdf, 1e-4),
    (Family::RadauIIA, 1e-4),
];

/// Coarse ones, of which warnings are no alarms, whatever comes out.
const COARSE: [(Family, f64); 5] = [
    (Family::Heun, 0.2),
    (Family::Rk4, 0.5),
    (Family::BogackiShampine, 3e-3),
    (Family::Adams, 1e-3),
    (Family::Bdf, 1e-3),
];

fn all_ways<M: JointCoordinates>(scene: &Scene<'_, M>, counts: &mut Counts) {
    let exact = DormandPrince853::new(Tolerance {
        relative: 1e-12,
        absolute: 1e-14,
    });
    let (truth, _) = scene.run(exact, true).expect("it runs");
    for (place, (family, setting)) in WAYS.into_iter().chain(COARSE).enumerate() {
        let is_coarse = place >= WAYS.len();
        let step_or_tolerance = if family.is_adaptive() {
            setting
        } else {
            setting / scene.rate
        };
        let integrator = IntegratorSetting {
            family,
            step_or_tolerance,
        };
        for is_relative in [false, true] {
            if is_relative && family == Family::GeneralizedAlpha {
                continue;
            }
            let coordinates = if is_relative { "relative" } else { "absolute" };
            let name = format!("{} {} {setting:e} {coordinates}", scene.name, family.key());
            let (history, said) = match scene.run(integrator, is_relative) {
                Ok(run) => run,
                Err(error) => {
                    println!("{name}: {error}");
                    counts.failed += 1;
                    continue;
                }
            };
            let error = scene.error(&history, &truth);
            let is_quiet = said == "no warnings";
            if error < 1e-2 {
                counts.right += usize::from(!is_coarse);
                counts.alarms += usize::from(!is_quiet && !is_coarse);
            } else {
                counts.wrong += 1;
                counts.silent += usize::from(is_quiet);
            }
            if (error < 1e-2) != is_quiet || said.contains("may add up") {
                println!("{name}: off by {error:.1e}; {said}");
            }
        }
    }
}

#[test]
fn right_runs_of_forced_motions_are_quiet() {
    let mut counts = Counts::default();
    let mut oscillation = |name, damping, frequency, end| {
        let mechanism = &Oscillator::new(damping, frequency).expect("acceptable");
        let rate = frequency.max(1.0);
        all_ways(
            &Scene {
                name,
                mechanism,
                end,
                rate,
            },
            &mut counts,
        );
    };
    oscillation("below resonance", 0.2, 0.7, 150.0);
    oscillation("resonance", 0.2, 1.0, 150.0);
    oscillation("above resonance", 0.6, 2.5, 120.0);
    oscillation("undamped", 0.0, 0.7, 150.0);
    macro_rules! scenes {
        ($($name:literal: $mechanism:ty, $end:literal s, $rate:literal;)*) => {$({
            let mechanism = &<$mechanism>::default();
            all_ways(&Scene { name: $name, mechanism, end: $end, rate: $rate }, &mut counts);
        })*};
    }
    scenes! {
        "turntable": Turntable, 30.0 s, 6.0;
        "shaken": Shaken, 30.0 s, 5.0;
        "upright": Upright, 5.0 s, 50.0;
        "swung": Swung, 30.0 s, 5.0;
    }
    println!("{counts:?}");
    assert!(counts.right >= 230 && counts.failed == 0, "{counts:?}");
    assert!(20 * counts.alarms <= counts.right, "{counts:?}");
    assert!(counts.silent <= 5, "{counts:?}");
}
