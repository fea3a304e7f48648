//! Forces from a closure, beside those of the description.

use holonom::Loads;
use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom_assembler::accuracy::assert_close;
use holonom_models::RodPendulum;

use crate::flat::flat;

/// The rod of chapter 15 without gravity.
#[derive(Debug, Mechanism)]
struct Weightless {
    #[body(mass = 7.02, inertia = [0.5855265, 0.0010530, 0.5855265], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
}

const WEIGHT: f64 = 7.02 * -9.81;

/// Round-off of 1000 steps, magnified by the motion.
const ROUND_OFF: f64 = 1e-11;

fn pushed<F, G>(method: F, law: G) -> Vec<f64>
where
    F: Formulation<f64>,
    G: Fn(f64, &<Weightless as Mechanism>::State<f64>, &mut Loads<'_, f64, Weightless>),
{
    let report = Simulation::new(&Weightless::default(), method, Rk4::every(1e-3))
        .forces(law)
        .run(0.0..=1.0, every(1.0), |_| ControlFlow::Continue(()))
        .expect("solvable");
    flat::<f64, Weightless>(&report.state)
}

fn fallen<F: Formulation<f64>>(method: F) -> Vec<f64> {
    let report = Simulation::new(&RodPendulum::default(), method, Rk4::every(1e-3))
        .run(0.0..=1.0, every(1.0), |_| ControlFlow::Continue(()))
        .expect("solvable");
    flat::<f64, RodPendulum>(&report.state)
}

fn weight<F: Formulation<f64>>(method: F) {
    let rod = Weightless::HANDLES.rod;
    let reference = fallen(method);
    let force = [0.0, 0.0, WEIGHT];
    let at_the_centre = pushed(method, |_, _, loads| loads.force(rod, force));
    assert_close("force", &at_the_centre, &reference, ROUND_OFF);
    // Half at either end.
    let at_the_ends = pushed(method, |_, _, loads| {
        for end in [-0.5, 0.5] {
            loads.force_at(rod, [0.0, end, 0.0], force.map(|component| 0.5 * component));
        }
    });
    assert_close("force at points", &at_the_ends, &reference, ROUND_OFF);
    // Off the centre, and the moment that brings it back; in global axes, then in body axes.
    let moment = [-0.3 * WEIGHT, 0.0, 0.0];
    let global = pushed(method, |_, state, loads| {
        let arm = Weightless::point(state, rod, nalgebra::Vector3::new(0.0, 0.3, 0.0))
            - Weightless::pose(state, rod).position;
        loads.force_at(rod, [0.0, 0.3, 0.0], force);
        loads.moment(rod, [-arm.y * WEIGHT, arm.x * WEIGHT, 0.0]);
    });
    assert_close("moment", &global, &reference, ROUND_OFF);
    let in_body_axes = pushed(method, |_, state, loads| {
        let [y, z] = {
            let arm = Weightless::point(state, rod, nalgebra::Vector3::new(0.0, 0.3, 0.0))
                - Weightless::pose(state, rod).position;
            [arm.y, arm.z]
        };
        loads.force_at(rod, [0.0, 0.3, 0.0], force);
        // About x, which the rod shares with the global axes; its length tells y from z.
        let about_x = moment[0] * y / y.hypot(z);
        loads.moment_in_body_axes(rod, [about_x, 0.0, 0.0]);
    });
    assert_close("moment in body axes", &in_body_axes, &reference, ROUND_OFF);
}

#[test]
fn a_force_equals_gravity() {
    weight(StandardLagrange);
    weight(Baumgarte::default());
    weight(Penalty::default());
    weight(AugmentedLagrangian::default());
}

#[test]
fn a_force_may_depend_on_time_and_state() {
    // A motor with friction: I w' = M sin(t) - c w about the hinge, I = 2.3405265, without gravity.
    const FRICTION: f64 = 1.3;
    const MOTOR: f64 = 4.0;
    const INERTIA: f64 = 2.3405265;
    let rod = Weightless::HANDLES.rod;
    let reached = pushed(StandardLagrange, |time, state, loads| {
        let w = Weightless::angular_velocity(state, rod).x;
        loads.moment(rod, [MOTOR * time.sin() - FRICTION * w, 0.0, 0.0]);
    });
    // w = k (c sin t - cos t + e^(-c t)) with c = FRICTION / I, k = M / I / (1 + c^2).
    let c: f64 = FRICTION / INERTIA;
    let (sine, cosine) = 1_f64.sin_cos();
    let expected = MOTOR / INERTIA / (1.0 + c * c) * (c * sine - cosine + (-c).exp());
    assert!(
        (reached[10] - expected).abs() <= ROUND_OFF,
        "{} {expected}",
        reached[10]
    );
}

#[test]
fn no_force_is_no_change() {
    /// Fused, and in parts: two orders of the same operations.
    const TWO_ORDERS: f64 = 1e-13;
    let parts = pushed(Baumgarte::default(), |_, _, _| {});
    let report = Simulation::new(
        &Weightless::default(),
        Baumgarte::default(),
        Rk4::every(1e-3),
    )
    .run(0.0..=1.0, every(1.0), |_| ControlFlow::Continue(()))
    .expect("solvable");
    assert_close(
        "fused",
        &flat::<f64, Weightless>(&report.state),
        &parts,
        TWO_ORDERS,
    );
}
