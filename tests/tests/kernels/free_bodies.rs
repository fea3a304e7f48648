//! Bodies without joints: no equations, and motions with a closed form.

use holonom::prelude::*;
use holonom::{StateParts, mechanism::BodyKind};
use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies;
use holonom_assembler::states::{Spread, generator, random_state};
use nalgebra::Vector3;

use crate::comparison::{DOUBLE, distance};
use crate::mechanisms::rotation_of;
use crate::scene::{Scene, constants, flat, state};
use crate::solutions::evaluated;

/// A body and a point mass in the air.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.5, -9.81])]
struct Thrown {
    #[body(
        free,
        mass = 2.0,
        inertia = [0.2, 0.3, 0.45],
        position = [0.0, 1.0, 2.0],
        velocity = [1.0, 0.0, 3.0],
        angular_velocity = [0.0, 0.0, 4.0]
    )]
    block: Body,
    #[body(free, mass = 0.3, position = [1.0, -1.0, 0.5], velocity = [-2.0, 1.0, 5.0])]
    stone: Particle,
}

impl Scene for Thrown {
    fn assembler() -> Assembler {
        let mut scene = Assembler::new([0.0, 0.5, -9.81]);
        scene.add_body(
            bodies::Body::rigid(2.0, [0.2, 0.3, 0.45], [0.0, 1.0, 2.0])
                .with_velocity([1.0, 0.0, 3.0], [0.0, 0.0, 4.0]),
        );
        scene.add_body(
            bodies::Body::particle(0.3, [1.0, -1.0, 0.5]).with_velocity([-2.0, 1.0, 5.0], [0.0; 3]),
        );
        scene
    }
}

#[test]
fn a_report_of_free_bodies_has_no_equations() {
    let report = Thrown::REPORT;
    assert_eq!(
        (report.coordinates, report.velocities, report.equations),
        (10, 9, 0)
    );
    assert_eq!(report.degrees_of_freedom, 9);
    assert!(report.blocks.is_empty());
    let kinds: Vec<BodyKind> = report.bodies.iter().map(|body| body.kind).collect();
    assert_eq!(kinds, [BodyKind::Rigid, BodyKind::Particle]);
}

#[test]
fn free_bodies_obey_newton_and_euler() {
    let scene = Thrown::assembler();
    let constants = constants::<f64, Thrown>();
    let mut rng = generator(20);
    for _ in 0..1000 {
        let x = random_state(&scene, Spread::default(), &mut rng);
        let x = x.as_slice();
        let state = state::<f64, Thrown>(x);
        let reference = scene.forces(x).component_div(&scene.mass());
        let terms = holonom_assembler::saddle::Coefficients::default();
        let (fused, rates) = evaluated::<f64, Thrown, holonom::mechanism::Plain>(terms, x);
        assert!(distance(&fused, reference.as_slice(), 0.0) <= DOUBLE);
        assert!(distance(&rates, scene.coordinate_rates(x).as_slice(), 0.0) <= DOUBLE);
        let kinetic = Thrown::kinetic_energy(&constants, &state);
        assert!(distance(&[kinetic], &[scene.kinetic_energy(x)], 0.0) <= DOUBLE);
        let potential = Thrown::potential_energy(&constants, 0.0, &state);
        assert!(distance(&[potential], &[scene.potential_energy(x)], 1.0) <= DOUBLE);
    }
}

/// Under every formulation the same: there is nothing to constrain.
fn fly<F: Formulation<f64>>(method: F) {
    /// Round-off of 1000 steps over 2 s; the fourth-order method is exact for a parabola.
    const ROUND_OFF: f64 = 1e-12;
    /// The spin about a principal axis is turned by RK4 with the phase error `z^5 / 120` a step,
    /// `z = w h / 2`.
    const PHASE: f64 = 1e-10;
    let thrown = Thrown::default();
    let (block, stone) = (Thrown::HANDLES.block, Thrown::HANDLES.stone);
    let report = Simulation::new(&thrown, method, Rk4::every(2e-3))
        .run(0.0..=2.0, every(0.25), |sample| {
            let t = sample.time();
            let fallen = 0.5 * t * t * Vector3::new(0.0, 0.5, -9.81);
            let expected = Vector3::new(1.0, -1.0, 0.5) + t * Vector3::new(-2.0, 1.0, 5.0);
            let error = sample.pose(stone).position - (expected + fallen);
            assert!(error.amax() < ROUND_OFF, "stone at {t}: {error}");
            let expected = Vector3::new(0.0, 1.0, 2.0) + t * Vector3::new(1.0, 0.0, 3.0);
            let error = sample.pose(block).position - (expected + fallen);
            assert!(error.amax() < ROUND_OFF, "block at {t}: {error}");
            let spin = sample.angular_velocity(block) - Vector3::new(0.0, 0.0, 4.0);
            assert!(spin.amax() < ROUND_OFF);
            let p = sample.pose(block).orientation;
            let turn = rotation_of([p.w, p.i, p.j, p.k]).inverse()
                * nalgebra::UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 4.0 * t);
            assert!(turn.angle() < PHASE, "turn at {t}: {}", turn.angle());
            ControlFlow::Continue(())
        })
        .expect("nothing can fail");
    assert_eq!(report.worst_violation, 0.0);
}

#[test]
fn free_bodies_fly_on_parabolas() {
    fly(StandardLagrange);
    fly(Baumgarte::default());
    fly(Penalty::default());
    fly(AugmentedLagrangian::default());
}

#[test]
fn there_is_nothing_to_correct() {
    let mut state = Thrown::default()
        .described_state::<f64>()
        .expect("described");
    let before = flat::<f64, Thrown>(&state);
    state.velocities_mut()[0] += 0.5;
    let correction = Thrown::default()
        .assemble(0.0, &mut state)
        .expect("corrects");
    state.velocities_mut()[0] -= 0.5;
    assert_eq!(flat::<f64, Thrown>(&state), before);
    assert_eq!(
        (correction.iterations, correction.violation_after),
        (0, 0.0)
    );
}
