//! Equations that nearly depend on each other, wherever the mechanism moves.

use holonom::joints::PointOnPlane;
use holonom::prelude::*;

/// A particle on two planes through the x axis at a small angle to each other: it falls along their
/// line, which slopes at 45 degrees.
#[derive(Mechanism)]
#[mechanism(gravity = [-7.0, 0.0, -7.0])]
struct Wedge {
    #[param]
    angle: f64,
    #[body(mass = 1.0, position = [0.0, 0.0, 0.0])]
    bead: Particle,
    #[joint(between = [ground, bead], point = [0.0, 0.0, 0.0], normal = [0.0, 0.6, 0.8])]
    first: PointOnPlane,
    #[joint(
        between = [ground, bead],
        point = [0.0, 0.0, 0.0],
        normal = [0.0, 0.6 * cos(angle) + 0.8 * sin(angle), 0.8 * cos(angle) - 0.6 * sin(angle)]
    )]
    second: PointOnPlane,
}

/// How far the bead is from the line after 1 s, in the planes' common plane, and how often
/// something was unconverged.
fn strayed<F: Formulation<f64>>(method: F, angle: f64, projected: bool) -> (f64, usize) {
    let wedge = Wedge::new(angle).expect("acceptable");
    let mut simulation = Simulation::new(&wedge, method, Rk4::every(1e-3));
    if projected {
        simulation = simulation.projection(Projection::default());
    }
    let report = simulation
        .run(0.0..=1.0, every(1.0), |_| ControlFlow::Continue(()))
        .expect("solvable");
    let [x, y, z] = *report.state.coordinates();
    assert!((x + 3.5).abs() < 1e-9, "{x}");
    (y.hypot(z), report.iterations.unconverged)
}

#[test]
fn a_bead_stays_on_two_planes_at_a_small_angle() {
    for angle in [1e-2, 1e-3, 1e-4, 1e-5] {
        for projected in [false, true] {
            let (augmented, unconverged) =
                strayed(AugmentedLagrangian::default(), angle, projected);
            println!("{angle}, {projected}: {augmented:e} m, {unconverged} unconverged");
            assert!(augmented < 1e-4, "{angle}: {augmented:e} m");
        }
        let (standard, _) = strayed(StandardLagrange, angle, true);
        println!("{angle}, standard: {standard:e} m");
        assert!(standard < 1e-4, "{angle}: {standard:e} m");
    }
}

/// A penalty is biased there, but with corrections the bead does not stray by what is not told.
#[test]
fn a_corrected_penalty_stays_on_two_planes() {
    for angle in [1e-3, 1e-4, 1e-5] {
        let (penalty, _) = strayed(Penalty::default(), angle, true);
        println!("{angle}, penalty: {penalty:e} m");
        assert!(penalty < 1e-3, "{angle}: {penalty:e} m");
    }
}
