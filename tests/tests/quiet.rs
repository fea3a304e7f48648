//! What stands still: no warning, and every method converges. Relative measures
//! have a floor by round-off of what they are made of.

use holonom::forces::SpringDamper;
use holonom::joints::{PointOnLine, Prismatic, Revolute};
use holonom::prelude::*;
use holonom::{Formulation, ImplicitMidpoint, JointCoordinates, Midpoint, RadauIIA, Real};
use holonom_fixtures as _;
use holonom_tests::RunsBoth;

/// A rod that hangs still, from a hinge whose axis is not a coordinate axis.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Hanging {
    #[body(mass = 1.3, inertia = [0.083, 0.083, 0.001], position = [0.3, 0.1, -0.5])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.3, 0.1, 0.0], axis = [0.6, 0.8, 0.0])]
    hinge: Revolute,
}

/// A rod of 1 kg that hangs from a cart of 1 g.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct HeavyRod {
    #[body(mass = 0.001, inertia = [0.00001, 0.00001, 0.00001])]
    cart: Body,
    #[body(mass = 1.0, inertia = [0.083, 0.083, 0.001], position = [0.0, 0.0, -0.5])]
    rod: Body,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    rail: Prismatic,
    #[joint(between = [cart, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pin: Revolute,
}

/// A mass that its spring carries: 1275.3 N/m times 10 mm is its weight.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct OnSpring {
    #[body(mass = 1.3, position = [0.0, 0.0, -0.7])]
    mass: Particle,
    #[joint(between = [ground, mass], point = [0.0, 0.0, -0.7], axis = [0.0, 0.0, 1.0])]
    line: PointOnLine,
    #[force(
        between = [ground, mass], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, -0.7],
        stiffness = 1275.3, free_length = 0.69
    )]
    spring: SpringDamper,
}

/// What a run of 2 s says, in both descriptions.
fn said<S, M, F, I>(mechanism: &M, formulation: F, integrator: &I) -> [String; 2]
where
    S: Real,
    M: JointCoordinates,
    F: Formulation<S>,
    I: RunsBoth<M, F, S>,
{
    let end = S::constant(2.0);
    let simulation = || Simulation::<Problem<M, _, S>, _>::new(mechanism, formulation, *integrator);
    let run = [
        simulation()
            .absolute_coordinates()
            .run(S::zero()..=end, every(end), |_| ControlFlow::Continue(())),
        simulation()
            .joint_coordinates()
            .run(S::zero()..=end, every(end), |_| ControlFlow::Continue(())),
    ];
    run.map(|run| match run {
        Ok(report) => report.warnings().to_string(),
        Err(error) => error.to_string(),
    })
}

/// All ways to run what stands still.
fn stands_still<S: Real, M: JointCoordinates>(mechanism: &M, tolerance: f64) {
    let tolerance = S::constant(tolerance);
    let tolerance = Tolerance {
        relative: tolerance,
        absolute: tolerance,
    };
    let [short, long] = [0.0005, 0.005].map(S::constant);
    let adaptive = DormandPrince::new(tolerance);
    let nothing = ["no warnings", "no warnings"];
    let name = M::REPORT.name;
    let lagrange = StandardLagrange;
    assert_eq!(said(mechanism, lagrange, &adaptive), nothing, "{name}");
    assert_eq!(
        said(mechanism, lagrange, &RadauIIA::new(tolerance)),
        nothing,
        "{name}"
    );
    assert_eq!(
        said(mechanism, lagrange, &Rk4::every(short)),
        nothing,
        "{name}"
    );
    for step in [short, long] {
        assert_eq!(
            said(mechanism, lagrange, &ImplicitMidpoint::every(step)),
            nothing,
            "{name}"
        );
    }
    let penalty = Penalty::default();
    assert_eq!(said(mechanism, penalty, &adaptive), nothing, "{name}");
    assert_eq!(
        said(mechanism, penalty, &Rk4::every(short)),
        nothing,
        "{name}"
    );
    let augmented = AugmentedLagrangian::default();
    assert_eq!(
        said(mechanism, augmented, &Rk4::every(short)),
        nothing,
        "{name}"
    );
}

#[test]
fn what_stands_still_is_not_warned_of() {
    stands_still::<f64, _>(&Hanging::default(), 1e-4);
    stands_still::<f64, _>(&HeavyRod::default(), 1e-6);
    stands_still::<f64, _>(&OnSpring::default(), 1e-4);
}

#[test]
fn nor_in_single_precision() {
    stands_still::<f32, _>(&Hanging::default(), 1e-4);
    stands_still::<f32, _>(&OnSpring::default(), 1e-4);
}

/// A motion that is small is judged all the same: a swing of 20 micrometres, with steps of a third
/// of a radian.
#[test]
fn what_hardly_moves_is_warned_of() {
    let hanging = Hanging::default();
    let mut start = hanging.described_state().expect("parameters");
    hanging
        .set_angle(&mut start, Hanging::HANDLES.hinge, 4e-5)
        .expect("it carries the rod");
    let rk2 = Midpoint::every(0.09_f64);
    let said = Simulation::new(&hanging, StandardLagrange, rk2)
        .initial_state(start)
        .joint_coordinates()
        .run(0.0..=10.0, every(1.0), |_| ControlFlow::Continue(()));
    let warnings = said.expect("it runs").warnings().to_string();
    assert!(warnings.contains("the energy changed"), "{warnings}");
}
