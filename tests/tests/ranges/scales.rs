//! One mechanism from a micrometre to a kilometre, from a milligram to a kilotonne, at the origin
//! and 1000 km from it, with the defaults of every formulation: its motion is the same in
//! proportion, or the run refuses, or its report warns of it.

use holonom::Warning;
use holonom::joints::{Distance, PointOnLine, Prismatic, Revolute};
use holonom::prelude::*;
use nalgebra::Vector3;

use holonom_tests::is_exhaustive;

/// A rod on a hinge.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Rod {
    #[body(
        mass = mass,
        inertia = [mass * size * size / 12.0, mass * size * size / 1000.0, mass * size * size / 12.0],
        position = [offset, 0.5 * size, offset]
    )]
    body: Body,
    #[joint(between = [ground, body], point = [offset, 0.0, offset], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[param]
    size: f64,
    #[param]
    mass: f64,
    #[param]
    offset: f64,
}

/// A particle on a massless link.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Bob {
    #[body(mass = mass, position = [offset, size, offset], velocity = [0.0, 0.0, 0.0])]
    body: Particle,
    #[joint(between = [ground, body], head = [offset, 0.0, offset], tail = [offset, size, offset])]
    link: Distance,
    #[param]
    size: f64,
    #[param]
    mass: f64,
    #[param]
    offset: f64,
}

/// A slider-crank that falls from the horizontal side of its crank.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0])]
struct SliderCrank {
    #[body(
        mass = mass,
        inertia = [0.1 * mass * size * size, 0.1 * mass * size * size, 0.1 * mass * size * size],
        position = [offset + 0.12 * size, offset + 0.16 * size, 0.0]
    )]
    body: Body,
    #[body(
        mass = mass,
        inertia = [0.1 * mass * size * size, 0.1 * mass * size * size, 0.1 * mass * size * size],
        position = [offset + 0.64 * size, offset + 0.16 * size, 0.0]
    )]
    rod: Body,
    #[body(
        mass = 2.0 * mass,
        inertia = [0.1 * mass * size * size, 0.1 * mass * size * size, 0.1 * mass * size * size],
        position = [offset + 1.04 * size, offset, 0.0]
    )]
    slider: Body,
    #[joint(between = [ground, body], point = [offset, offset, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [body, rod], point = [offset + 0.24 * size, offset + 0.32 * size, 0.0], axis = [0.0, 0.0, 1.0])]
    crank_pin: Revolute,
    #[joint(between = [ground, slider], point = [offset + 1.04 * size, offset, 0.0], axis = [1.0, 0.0, 0.0])]
    guide: Prismatic,
    #[joint(between = [slider, rod], point = [offset + 1.04 * size, offset, 0.0], axis = [0.0, 0.0, 1.0])]
    slider_pin: PointOnLine,
    #[param]
    size: f64,
    #[param]
    mass: f64,
    #[param]
    offset: f64,
}

/// What all of them have.
trait Scaled: Mechanism {
    fn scaled(scale: Scale) -> Self;
    /// The centre of mass of one body (m).
    fn place(sample: &Sample<'_, f64, Self>) -> Vector3<f64>;
}

macro_rules! scaled {
    ($($mechanism:ident)*) => {$(
        impl Scaled for $mechanism {
            fn scaled(Scale { size, mass, offset }: Scale) -> Self {
                Self::new(size, mass, offset).expect("acceptable")
            }

            fn place(sample: &Sample<'_, f64, Self>) -> Vector3<f64> {
                sample.pose(Self::HANDLES.body).position
            }
        }
    )*};
}

scaled! { Rod Bob SliderCrank }

#[derive(Clone, Copy, Debug, PartialEq)]
struct Scale {
    size: f64,
    mass: f64,
    offset: f64,
}

const UNIT: Scale = Scale {
    size: 1.0,
    mass: 1.0,
    offset: 0.0,
};

/// The displacement of the body over 2.2 times the square root of the size in metres, in sizes, and
/// whether it has a warning; `None` where it is refused.
fn displacement<M: Scaled, F: Formulation<f64>>(
    scale: Scale,
    method: F,
    tolerance: Tolerance<f64>,
    projected: bool,
) -> Option<(Vector3<f64>, holonom::Warnings)> {
    let mechanism = M::scaled(scale);
    let duration = 2.2 * scale.size.sqrt();
    let mut simulation =
        Simulation::new(&mechanism, method, DormandPrince::new(tolerance)).assembled();
    if projected {
        simulation = simulation.projection(Projection::default());
    }
    let (mut start, mut end) = (Vector3::zeros(), Vector3::zeros());
    let outcome = simulation.run(0.0..=duration, every(duration), |sample| {
        let place = M::place(sample);
        if sample.time() == 0.0 {
            start = place;
        }
        end = place;
        ControlFlow::Continue(())
    });
    match outcome {
        Ok(report) => Some(((end - start) / scale.size, report.warnings())),
        Err(error) => {
            println!("    {scale:?} {method:?}, projected: {projected}: {error}");
            None
        }
    }
}

/// A result that is right is right to a hundredth.
const RIGHT: f64 = 1e-2;

fn sweep<M: Scaled, F: Formulation<f64>>(method: F, judge: Vector3<f64>) {
    let (mut right, mut warned, mut refused) = (0, 0, 0);
    let sizes = [1e-6, 1.0, 1e3, 1e-3];
    let masses = [1e-6, 1.0, 1e6, 1e-3, 1e3];
    let (sizes, masses) = if is_exhaustive() {
        (&sizes[..], &masses[..])
    } else {
        (&sizes[..3], &masses[..3])
    };
    for offset in [0.0, 1e6] {
        for &size in sizes {
            for &mass in masses {
                for projected in [false, true] {
                    let scale = Scale { size, mass, offset };
                    let tolerance = Tolerance::default();
                    let Some((found, warnings)) =
                        displacement::<M, F>(scale, method, tolerance, projected)
                    else {
                        refused += 1;
                        continue;
                    };
                    let error = (found - judge).norm();
                    if error <= RIGHT {
                        right += 1;
                    }
                    if !warnings.is_empty() {
                        warned += 1;
                    }
                    // The default goes with the size.
                    let mut all = warnings.into_iter();
                    let coarse = |warning| matches!(warning, Warning::CoarseTolerance { .. });
                    assert!(!all.any(coarse), "{scale:?} {method:?}: {warnings}");
                    assert!(
                        error <= RIGHT || !warnings.is_empty(),
                        "{scale:?} {method:?}, projected: {projected}: off by {error:e} of the size without a word"
                    );
                    // Where everything suits, there are no warnings.
                    let ordinary = (1e-3..=1e3).contains(&size)
                        && (1e-3..=1.0).contains(&mass)
                        && offset == 0.0;
                    assert!(
                        !ordinary || error <= RIGHT,
                        "{scale:?} {method:?}, projected: {projected}: off by {error:e}: {warnings}"
                    );
                }
            }
        }
    }
    println!("{method:?}: {right} right, {warned} warned of, {refused} refused");
}

fn all<M: Scaled>() {
    let tight = Tolerance {
        relative: 1e-12,
        absolute: 1e-14,
    };
    let (judge, _) = displacement::<M, _>(UNIT, StandardLagrange, tight, true).expect("regular");
    println!("{}: {judge:?}", M::REPORT.name);
    sweep::<M, _>(StandardLagrange, judge);
    sweep::<M, _>(Baumgarte::default(), judge);
    sweep::<M, _>(Penalty::default(), judge);
    sweep::<M, _>(AugmentedLagrangian::default(), judge);
}

#[test]
fn a_rod_of_any_size() {
    all::<Rod>();
}

#[test]
fn a_bob_of_any_size() {
    all::<Bob>();
}

#[test]
fn a_slider_crank_of_any_size() {
    all::<SliderCrank>();
}
