//! A spatial chain with three frictions by load, whose efforts are compared with the reactions that
//! an observer reads.

use holonom::Wrench;
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::nalgebra::Vector3;
use holonom::prelude::*;
use holonom::run::InteractionMode as Mode;

/// A cart along x, an arm on it about y, and a forearm about an oblique axis.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Crane {
    #[body(mass = 3.0, inertia = [0.1, 0.1, 0.1])]
    cart: Body,
    #[body(mass = 2.0, inertia = [0.06, 0.06, 0.01], position = [0.0, 0.1, -0.3])]
    arm: Body,
    #[body(mass = 1.0, inertia = [0.02, 0.03, 0.01], position = [0.1, 0.1, -0.8])]
    forearm: Body,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[joint(between = [cart, arm], point = [0.0, 0.1, 0.0], axis = [0.0, 1.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [arm, forearm], point = [0.0, 0.1, -0.6], axis = [0.0, 0.6, 0.8])]
    elbow: Revolute,
}

const RAIL: (f64, f64) = (0.12, 0.3);
const SHOULDER: (f64, f64) = (0.45, 0.05);
const ELBOW: (f64, f64, f64) = (0.5, 0.03, 0.04);

fn across(vector: Vector3<f64>, axis: Vector3<f64>) -> Vector3<f64> {
    vector - axis * vector.dot(&axis)
}

/// The sum of two forces across an axis, at both ends, that are equal to a wrench.
fn at_ends(wrench: &Wrench<f64>, axis: Vector3<f64>, half_length: f64) -> f64 {
    let half = across(wrench.force, axis) / 2.0;
    let pair = wrench.moment.cross(&axis) / (2.0 * half_length);
    (half + pair).norm() + (half - pair).norm()
}

/// The capacities by the reactions that are read.
fn capacities(sample: &Sample<'_, f64, Crane>) -> Result<[f64; 3], Fault> {
    let h = Crane::HANDLES;
    let rail = sample.reaction(h.rail, h.cart)?;
    let shoulder = sample.reaction(h.shoulder, h.arm)?;
    let elbow = sample.reaction(h.elbow, h.forearm)?;
    // Fixed on the arm, and turned with it.
    let oblique =
        sample.point(h.arm, Vector3::new(0.0, 0.6, 0.8)) - sample.point(h.arm, Vector3::zeros());
    Ok([
        RAIL.0 * at_ends(&rail, Vector3::x(), RAIL.1),
        SHOULDER.0 * SHOULDER.1 * across(shoulder.force, Vector3::y()).norm(),
        ELBOW.0 * ELBOW.1 * at_ends(&elbow, oblique, ELBOW.2),
    ])
}

/// The last angles, and which modes were seen.
fn swings<C: Coordinates<Crane>>(rates: [f64; 3]) -> ([f64; 3], [[bool; 3]; 3]) {
    let (crane, h) = (Crane::default(), Crane::HANDLES);
    let mut start = crane.described_state().expect("it is described");
    crane
        .set_displacement_rate(&mut start, h.rail, rates[0])
        .expect("it is free");
    crane
        .set_angle_rate(&mut start, h.shoulder, rates[1])
        .expect("it is free");
    crane
        .set_angle_rate(&mut start, h.elbow, rates[2])
        .expect("it is free");
    let mut seen = [[false; 3]; 3];
    let tolerance = Tolerance {
        relative: 1e-10,
        absolute: 1e-10,
    };
    let frictions = [
        Interaction::friction_by_load(h.rail, RAIL.0).guide(RAIL.1),
        Interaction::friction_by_load(h.shoulder, SHOULDER.0).radius(SHOULDER.1),
        Interaction::friction_by_load(h.elbow, ELBOW.0)
            .radius(ELBOW.1)
            .guide(ELBOW.2),
    ];
    let handles = Interaction::handles(&frictions);
    let report = Simulation::new(&crane, StandardLagrange, DormandPrince::new(tolerance))
        .coordinates::<C>()
        .initial_state(start)
        .interactions(frictions)
        .run(0.0..=5.0, every(0.05), |sample| -> Result<(), Fault> {
            let rates = [
                sample.displacement_rate(h.rail),
                sample.angle_rate(h.shoulder),
                sample.angle_rate(h.elbow),
            ];
            for (number, capacity) in capacities(sample)?.into_iter().enumerate() {
                let (mode, effort) = (
                    sample.mode(handles[number])?,
                    sample.effort(handles[number])?,
                );
                let (place, is_right) = match mode {
                    Mode::SlidingUp => (0, (effort + capacity).abs() < 1e-9 * capacity),
                    Mode::SlidingDown => (1, (effort - capacity).abs() < 1e-9 * capacity),
                    _ => (
                        2,
                        effort.abs() < (1.0 + 1e-9) * capacity && rates[number].abs() < 1e-11,
                    ),
                };
                seen[number][place] = true;
                let time = sample.time();
                assert!(
                    is_right,
                    "{time} {number} {mode:?}: {effort} {capacity} {rates:?}"
                );
            }
            Ok(())
        })
        .expect("it swings");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    let view = crane.view(5.0, &report.state).expect("a view");
    let places = [
        view.displacement(h.rail),
        view.angle(h.shoulder),
        view.angle(h.elbow),
    ];
    (places, seen)
}

#[test]
fn efforts_are_those_of_the_reactions_that_are_read() {
    let mut all = [[false; 3]; 3];
    for rates in [[2.0, 3.0, -4.0], [0.0, -5.0, 1.0]] {
        let (joints, seen) = swings::<Relative>(rates);
        for (all, seen) in all.iter_mut().flatten().zip(seen.iter().flatten()) {
            *all |= seen;
        }
        let (bodies, again) = swings::<Absolute>(rates);
        assert_eq!(seen, again, "{rates:?}");
        for (a, b) in joints.iter().zip(&bodies) {
            assert!((a - b).abs() < 1e-7, "{rates:?}: {joints:?} {bodies:?}");
        }
    }
    assert_eq!(all, [[true; 3]; 3]);
}
