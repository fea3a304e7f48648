//! What goes wrong on the way: an error with time and place, the last good state, no panic.

use holonom::error::StepFault;
use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom::{Fault, StateParts, dynamics::Dynamics, error::NotFinite};
use holonom_models::RodPendulum;

use crate::flat::flat;

holonom::joint! {
    /// A massless rod between two points.
    pub joint Rod(i, j; head: Point, tail: Point, length: Length) {
        squared(j.tail - i.head) - length * length;
    }
}

/// A door on two hinges: 10 equations, 5 of them independent.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.66, -1.70], redundant = "keep")]
struct Door {
    #[body(mass = 20.0, inertia = [6.669, 1.069, 7.733], position = [0.4, 1.0, 0.0])]
    leaf: Body,
    #[joint(between = [ground, leaf], point = [0.0, 0.25, 0.0], axis = [0.0, 1.0, 0.0])]
    lower: Revolute,
    #[joint(between = [ground, leaf], point = [0.0, 1.75, 0.0], axis = [0.0, 1.0, 0.0])]
    upper: Revolute,
}

/// A bead between two rods: where they are in line, their rows depend on each other.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Bead {
    #[body(mass = 0.1, position = [0.0, 0.0, -0.5])]
    bead: Particle,
    #[joint(between = [ground, bead], head = [-1.0, 0.0, 0.0], tail = [0.0, 0.0, -0.5], length = sqrt(1.25))]
    left: Rod,
    #[joint(between = [ground, bead], head = [1.0, 0.0, 0.0], tail = [0.0, 0.0, -0.5], length = sqrt(1.25))]
    right: Rod,
}

/// A point mass in the air.
#[derive(Debug, Mechanism)]
struct Free {
    #[body(free, mass = 1.0, velocity = [1.0, 0.0, 0.0])]
    stone: Particle,
}

/// The number of a state with this many elements that is replaced.
fn broken(rod: &RodPendulum, place: usize, value: f64) -> <RodPendulum as Mechanism>::State<f64> {
    let mut state = rod.described_state().expect("described");
    if place < 7 {
        state.coordinates_mut()[place] = value;
    } else {
        state.velocities_mut()[place - 7] = value;
    }
    state
}

#[test]
fn a_state_that_is_not_finite_is_refused() {
    let rod = RodPendulum::default();
    for place in 0..13 {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let state = broken(&rod, place, value);
            let error = Simulation::new(&rod, StandardLagrange, DormandPrince::default())
                .initial_state(state)
                .run(2.0..=3.0, every(0.1), |_| -> () {
                    panic!("it must not begin")
                })
                .expect_err("not finite");
            assert_eq!(
                (error.time, error.fault),
                (2.0, Fault::Step(StepFault::StateNotFinite))
            );
            assert_eq!(
                error.to_string(),
                "at 2 s: the state holds a number that is not finite"
            );
            let mut stepper = Stepper::new(&rod, Penalty::default(), Rk4).expect("acceptable");
            let mut stepped = state;
            assert_eq!(
                stepper.step(&mut stepped, 0.1),
                Err(Fault::Step(StepFault::StateNotFinite))
            );
            assert_eq!(stepper.time(), 0.0);
            let mut assembled = state;
            assert_eq!(
                rod.assemble(0.0, &mut assembled),
                Err(Fault::Step(StepFault::StateNotFinite))
            );
        }
    }
}

#[test]
fn an_orientation_without_length_names_its_body() {
    let rod = RodPendulum::default();
    for size in [0.0, 1e-170] {
        let mut state = rod.described_state().expect("described");
        let pose = holonom::Pose {
            position: [0.0, 0.1, 0.2].into(),
            orientation: nalgebra::Quaternion::new(0.0, size, size, 0.0),
        };
        RodPendulum::set_pose(&mut state, RodPendulum::HANDLES.rod, pose);
        let state: holonom::state::State<f64, 7, 6, 2> = state;
        assert!(state.coordinates().iter().all(|q| q.is_finite()));
        let refused = Fault::Step(StepFault::ZeroOrientation { body: "rod" });
        let error = Simulation::new(&rod, Penalty::default(), DormandPrince::default())
            .initial_state(state)
            .run(2.0..=3.0, every(0.1), |_| -> () {
                panic!("it must not begin")
            })
            .expect_err("no orientation");
        assert_eq!(
            error.to_string(),
            "at 2 s: the Euler parameters of body `rod` have no length"
        );
        let mut stepper = Stepper::new(&rod, Penalty::default(), Rk4).expect("acceptable");
        let mut stepped = state;
        assert_eq!(stepper.step(&mut stepped, 0.1), Err(refused));
        assert_eq!(
            stepper.dynamics().evaluate(0.0, &state).err(),
            Some(refused)
        );
        assert_eq!(rod.assemble(0.0, &mut stepped), Err(refused));
        assert_eq!(stepped, state);
    }
}

#[test]
fn a_singular_system_names_a_joint() {
    let door = Door::default();
    for with_forces in [false, true] {
        let simulation = Simulation::new(&door, StandardLagrange, Rk4::every(0.01));
        let error = if with_forces {
            simulation
                .forces(|_, _, loads| loads.force(Door::HANDLES.leaf, [0.0, 0.0, 1.0]))
                .run(0.0..=1.0, every(0.1), |_| ControlFlow::Continue(()))
        } else {
            simulation.run(0.0..=1.0, every(0.1), |_| ControlFlow::Continue(()))
        }
        .expect_err("5 of 10 equations are redundant");
        let Fault::Step(StepFault::Singular {
            joint,
            name,
            relative_pivot,
        }) = error.fault
        else {
            panic!("{error}");
        };
        assert_eq!(name, Door::REPORT.joints[joint].name);
        assert!(["lower", "upper"].contains(&name));
        assert!(relative_pivot.abs() < 1e-13);
        assert!(error.to_string().contains(name), "{error}");
        assert_eq!(error.time, 0.0);
        assert_eq!(error.state, door.described_state().expect("described"));
    }
    let error = Simulation::new(&door, Baumgarte::default(), DormandPrince::default())
        .run(0.0..=1.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect_err("5 of 10 equations are redundant");
    assert!(
        matches!(error.fault, Fault::Step(StepFault::Singular { .. })),
        "{error}"
    );
}

#[test]
fn with_a_compliance_redundant_equations_are_solved() {
    let door = Door::default();
    let swing = |reached: &mut f64| {
        Simulation::new(&door, Penalty::default(), DormandPrince::default())
            .run(0.0..=1.0, every(0.1), |sample| {
                *reached = sample.angle(Door::HANDLES.lower);
                assert!((sample.angle(Door::HANDLES.upper) - *reached).abs() < 1e-9);
                ControlFlow::Continue(())
            })
            .expect("solvable")
    };
    let mut reached = 0.0;
    let report = swing(&mut reached);
    assert!(report.worst_violation < 1e-9, "{}", report.worst_violation);
    // By hand: I w' = -m g_z x cos(angle) about +y, from the horizontal part of gravity.
    assert!(reached > 0.5, "{reached}");
    Simulation::new(
        &door,
        AugmentedLagrangian::default(),
        DormandPrince::default(),
    )
    .run(0.0..=1.0, every(0.1), |_| ControlFlow::Continue(()))
    .expect("solvable");
}

/// A parallelogram of spatial hinges: three rows depend on the others.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "keep")]
struct Parallelogram {
    #[body(mass = 1.0, inertia = [0.08, 0.001, 0.08], position = [0.0, 0.5, 0.0])]
    left: Body,
    #[body(mass = 1.0, inertia = [0.001, 0.08, 0.08], position = [0.5, 1.0, 0.0])]
    top: Body,
    #[body(mass = 1.0, inertia = [0.08, 0.001, 0.08], position = [1.0, 0.5, 0.0])]
    right: Body,
    #[joint(between = [ground, left], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(between = [left, top], point = [0.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    b: Revolute,
    #[joint(between = [top, right], point = [1.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    c: Revolute,
    #[joint(between = [ground, right], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    d: Revolute,
}

/// The same in an oblique plane: what cancels leaves round-off behind.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], redundant = "keep")]
struct ObliqueParallelogram {
    #[body(mass = 1.0, inertia = [0.08, 0.06, 0.03], position = [0.0, 0.0, 0.5])]
    left: Body,
    #[body(mass = 1.3, inertia = [0.05, 0.06, 0.07], position = [0.3, 0.4, 1.0])]
    top: Body,
    #[body(mass = 0.9, inertia = [0.08, 0.06, 0.03], position = [0.6, 0.8, 0.5])]
    right: Body,
    #[joint(between = [ground, left], point = [0.0, 0.0, 0.0], axis = [0.8, -0.6, 0.0])]
    a: Revolute,
    #[joint(between = [left, top], point = [0.0, 0.0, 1.0], axis = [0.8, -0.6, 0.0])]
    b: Revolute,
    #[joint(between = [top, right], point = [0.6, 0.8, 1.0], axis = [0.8, -0.6, 0.0])]
    c: Revolute,
    #[joint(between = [ground, right], point = [0.6, 0.8, 0.0], axis = [0.8, -0.6, 0.0])]
    d: Revolute,
}

fn names_a_joint<M: Mechanism + Default>() {
    let error = Simulation::new(&M::default(), StandardLagrange, Rk4::every(0.01))
        .run(0.0..=1.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect_err("3 of 20 equations are redundant");
    assert!(
        matches!(
            error.fault,
            Fault::Step(StepFault::Singular {
                name: "a" | "b" | "c" | "d",
                ..
            })
        ),
        "{error}"
    );
    assert_eq!(error.time, 0.0);
}

#[test]
fn a_redundant_loop_names_a_joint() {
    names_a_joint::<Parallelogram>();
    names_a_joint::<ObliqueParallelogram>();
}

#[test]
fn a_singular_configuration_is_told_where_it_is_met() {
    let model = Bead::default();
    let mut stepper = Stepper::new(&model, StandardLagrange, Rk4).expect("acceptable");
    let mut state = model.described_state().expect("described");
    stepper
        .step(&mut state, 0.01)
        .expect("the rods make an angle");
    // Between the ends of the rods, in line with both.
    Bead::set_pose(
        &mut state,
        Bead::HANDLES.bead,
        holonom::Pose {
            position: [0.0, 0.0, 0.0].into(),
            orientation: nalgebra::Quaternion::identity(),
        },
    );
    let before = state;
    let fault = stepper.step(&mut state, 0.01).expect_err("in line");
    assert!(
        matches!(
            fault,
            Fault::Step(StepFault::Singular {
                name: "left" | "right",
                ..
            })
        ),
        "{fault}"
    );
    assert_eq!((stepper.time(), state), (0.01, before));
    let mut stepper = Stepper::new(&model, Penalty::default(), Rk4).expect("acceptable");
    stepper
        .step(&mut state, 0.01)
        .expect("solvable with a compliance");
}

#[test]
fn a_step_size_that_vanishes_ends_the_run_with_the_last_good_state() {
    let free = Free::default();
    let stone = Free::HANDLES.stone;
    // v' = v^2 from v = 1: v = 1 / (1 - t), gone at 1 s.
    let mut last = (f64::NAN, Vec::new());
    let error = Simulation::new(&free, StandardLagrange, DormandPrince::default())
        .forces(|_, state, loads| {
            let v = Free::velocity(state, stone).x;
            loads.force(stone, [v * v, 0.0, 0.0]);
        })
        .run(0.0..=2.0, every_step(), |sample| {
            last = (sample.time(), flat::<f64, Free>(sample.state()));
            ControlFlow::Continue(())
        })
        .expect_err("the motion ends at 1 s");
    assert!(
        matches!(error.fault, Fault::Step(StepFault::SizeUnderflow { step, joint: None, .. }) if step < 1e-14),
        "{error}"
    );
    // The step control of 1e-6 does not know the end better.
    assert!((error.time - 1.0).abs() < 1e-4, "{error}");
    assert_eq!((error.time, flat::<f64, Free>(&error.state)), last);
    assert!(last.1.iter().all(|number| number.is_finite()));
    assert!(last.1[3] > 1e4);
}

#[test]
fn rates_that_are_not_finite_end_the_run_with_the_last_good_state() {
    let free = Free::default();
    let stone = Free::HANDLES.stone;
    let law = |time: f64, _: &_, loads: &mut holonom::Loads<'_, f64, Free>| {
        let force = if time > 0.4 { f64::NAN } else { 0.0 };
        loads.force(stone, [0.0, force, 0.0]);
    };
    let mut last = f64::NAN;
    let error = Simulation::new(&free, StandardLagrange, Rk4::every(0.125))
        .forces(law)
        .run(0.0..=1.0, every_step(), |sample| {
            last = sample.time();
            ControlFlow::Continue(())
        })
        .expect_err("not a number");
    let origin = NotFinite::Closure("stone");
    assert_eq!(
        (error.fault, error.time, last),
        (
            Fault::Step(StepFault::RatesNotFinite { origin }),
            0.375,
            0.375
        )
    );
    assert_eq!(error.state.velocities(), &[1.0, 0.0, 0.0]);
    // A step control goes as near as it can.
    let error = Simulation::new(&free, StandardLagrange, DormandPrince::default())
        .forces(law)
        .run(0.0..=1.0, every_step(), |_| ControlFlow::Continue(()))
        .expect_err("not a number");
    assert_eq!(
        error.fault,
        Fault::Step(StepFault::RatesNotFinite { origin })
    );
    assert!((error.time - 0.4).abs() < 1e-13, "{error}");
    assert!((error.state.coordinates()[0] - error.time).abs() < 1e-13);
}

#[test]
fn an_iteration_that_does_not_converge_is_reported() {
    let rod = RodPendulum::default();
    // So soft that two solutions are not enough.
    let hasty = AugmentedLagrangian {
        alpha: 1.0,
        tolerance: 1e-12,
        max_iterations: 2,
        ..AugmentedLagrangian::default()
    };
    let error = Simulation::new(&rod, hasty, Rk4::every(0.01))
        .run(1.0..=2.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect_err("two iterations are not enough");
    assert!(
        matches!(error.fault, Fault::Step(StepFault::NotConverged { iterations: 2, residual, joint: Some("pivot"), alpha: Some(1.0) }) if residual > 0.0),
        "{error}"
    );
    assert_eq!(error.time, 1.0);
    assert_eq!(error.state, rod.described_state().expect("described"));
    let patient = AugmentedLagrangian {
        max_iterations: 2000,
        ..hasty
    };
    let dynamics = Dynamics::<Problem<RodPendulum, _>>::new(&rod, patient).expect("acceptable");
    let state = rod.described_state().expect("described");
    let (_, iterations) = dynamics.evaluate(0.0, &state).expect("converges");
    assert!(iterations > 2);
}

#[test]
fn what_cannot_be_assembled_is_left_as_it_was() {
    // Two rods of 1.118 m hold the bead; moved so far out that neither end can be reached, it is
    // pulled back; with one hinge in two places no position is right.
    let parted = Parted::default();
    let mut state = parted.described_state::<f64>().expect("described");
    let before = state;
    let fault = parted.assemble(0.0, &mut state).expect_err("impossible");
    assert!(
        matches!(
            fault,
            Fault::Step(StepFault::NotConverged { residual, joint: Some("here" | "there"), .. }) if residual > 0.1
        ),
        "{fault}"
    );
    assert_eq!(state, before);
    let error = Simulation::new(&parted, Penalty::default(), Rk4::every(0.1))
        .assembled()
        .run(0.0..=1.0, every(0.1), |_| -> () {
            panic!("it must not begin")
        })
        .expect_err("impossible");
    assert!(
        matches!(error.fault, Fault::Step(StepFault::NotConverged { .. })),
        "{error}"
    );
    assert_eq!((error.time, error.state), (0.0, before));
}

#[test]
fn no_convergence_names_the_joint_that_is_violated_most() {
    let model = Bead::default();
    let constants = model.constants().expect("acceptable");
    let described = model.described_state::<f64>().expect("described");
    let untouched = Projection {
        max_iterations: 0,
        ..Projection::default()
    };
    for (x, joint) in [(-1.0, "right"), (1.0, "left")] {
        // Below the other end of the rod that is not violated.
        let mut state = described;
        *state.coordinates_mut() = [x, 0.0, -1.25_f64.sqrt()];
        let fault = untouched.correct::<Bead>(&constants, 0.0, &mut state);
        let Err(Fault::Step(StepFault::NotConverged {
            iterations: 0,
            residual,
            joint: Some(name),
            alpha: None,
        })) = fault
        else {
            panic!("{fault:?}");
        };
        assert_eq!(name, joint);
        assert!((residual - 4.0).abs() < 1e-12, "{residual}");
        // Along the other rod's circle.
        let mut state = described;
        *state.velocities_mut() = [-0.5 * x, 0.0, 1.0];
        let fault = untouched.correct::<Bead>(&constants, 0.0, &mut state);
        assert!(
            matches!(fault, Err(Fault::Step(StepFault::NotConverged { joint: Some(name), .. })) if name == joint),
            "{fault:?}"
        );
    }
}

/// A point of a body that is to be in two places, 1 m apart.
#[derive(Debug, Mechanism)]
struct Parted {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    block: Body,
    #[joint(between = [ground, block], point = local([0.0, 0.0, 0.0], [0.1, 0.0, 0.0]))]
    here: holonom::joints::Spherical,
    #[joint(between = [ground, block], point = local([1.0, 0.0, 0.0], [0.1, 0.0, 0.0]))]
    there: holonom::joints::Spherical,
}
