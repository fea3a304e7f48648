//! Rates that are not finite say where that began.

use holonom::error::StepFault;
use holonom::forces::SpringDamper;
use holonom::joints::{AngleDriver, PointOnLine, Revolute};
use holonom::prelude::*;
use holonom::{Runs, error::NotFinite, measure::ForceLaw, mechanism::Absolute};

/// A bead on a wire, and a spring that has no length where the bead passes its end.
#[derive(Mechanism)]
struct Bead {
    #[body(mass = 1.0, position = [1.0, 0.0, 0.0], velocity = [-1.0, 0.0, 0.0])]
    bead: Particle,
    #[body(mass = 2.0, inertia = [0.2, 0.1, 0.2], position = [3.0, 0.0, 0.0])]
    other: Body,
    #[joint(between = [ground, bead], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    wire: PointOnLine,
    #[joint(between = [ground, other], point = [3.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[force(between = [ground, other], head = [0.0, 1.0, 0.0], tail = [3.0, 1.0, 0.0], stiffness = 1.0, free_length = 1.0)]
    sound_one: SpringDamper,
    #[force(between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0], stiffness = 1.0, free_length = 1.0)]
    spring: SpringDamper,
}

/// A motor whose law ends after half a second.
#[derive(Mechanism)]
struct Wild {
    #[body(mass = 2.0, inertia = [0.2, 0.01, 0.2], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = sqrt(0.505 - time))]
    motor: AngleDriver,
}

type Law = fn(f64, &<Bead as Mechanism>::State<f64>, &mut Loads<'_, f64, Bead>);

fn law(time: f64, _: &<Bead as Mechanism>::State<f64>, loads: &mut Loads<'_, f64, Bead>) {
    loads.force(Bead::HANDLES.bead, [0.1, 0.0, 0.0]);
    let moment = if time < 0.05 { 0.0 } else { f64::NAN };
    loads.moment(Bead::HANDLES.other, [moment, 0.0, 0.0]);
}

fn origin<F, I>(method: F, integrator: I, closure: bool) -> NotFinite
where
    F: Formulation<f64>,
    I: Runs<Problem<Bead, F>> + Runs<Problem<Bead, F, f64, Absolute, ForceLaw<Law>>>,
{
    let bead = Bead::default();
    let handles = Bead::HANDLES;
    let mut state = bead.described_state().expect("described");
    if !closure {
        let mut pose = Bead::pose(&state, handles.bead);
        pose.position.x = 0.0;
        Bead::set_pose(&mut state, handles.bead, pose);
        // What moves leaves the length of zero on its way.
        Bead::set_velocity(&mut state, handles.bead, [0.0; 3].into());
    }
    let simulation = Simulation::new(&bead, method, integrator).initial_state(state);
    let error = if closure {
        simulation
            .forces(law as Law)
            .run(0.0..=0.2, every(0.1), |_| ControlFlow::Continue(()))
    } else {
        simulation.run(0.0..=0.2, every(0.1), |_| ControlFlow::Continue(()))
    }
    .expect_err("not finite");
    println!("{error}");
    let Fault::Step(StepFault::RatesNotFinite { origin }) = error.fault else {
        panic!("{error}");
    };
    origin
}

#[test]
fn a_spring_without_a_length_is_named() {
    let spring = NotFinite::Force("spring");
    assert_eq!(origin(StandardLagrange, Rk4::every(0.01), false), spring);
    assert_eq!(
        origin(Baumgarte::default(), DormandPrince::default(), false),
        spring
    );
    assert_eq!(origin(Penalty::default(), Rk4::every(0.01), false), spring);
    let augmented = AugmentedLagrangian::default();
    assert_eq!(origin(augmented, Rk4::every(0.01), false), spring);
}

#[test]
fn a_closure_that_returns_nan_is_named_with_its_body() {
    let closure = NotFinite::Closure("other");
    assert_eq!(origin(StandardLagrange, Rk4::every(0.01), true), closure);
    assert_eq!(
        origin(Penalty::default(), DormandPrince::default(), true),
        closure
    );
    let augmented = AugmentedLagrangian::default();
    assert_eq!(origin(augmented, Rk4::every(0.01), true), closure);
}

#[test]
fn a_law_that_ends_is_named() {
    let wild = Wild::default();
    let error = Simulation::new(&wild, Baumgarte::default(), Rk4::every(0.01))
        .assembled()
        .run(0.0..=3.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect_err("no law");
    println!("{error}");
    let origin = NotFinite::Joint("motor");
    assert_eq!(
        error.fault,
        Fault::Step(StepFault::RatesNotFinite { origin })
    );
}
