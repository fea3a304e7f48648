//! Closures that remember something: found and refused, whatever moves; and the loop that is right
//! for a controller.

use core::cell::Cell;

use holonom::error::StepFault;
use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom::{
    Loads, Runs, Stepper,
    measure::ForceLaw,
    mechanism::{Absolute, Relative},
};

/// An arm of 1 m about x, whose motor takes an input.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Arm {
    #[input]
    torque: f64,
    #[body(mass = 1.0, inertia = [0.083, 0.001, 0.083], position = [0.0, 0.5, 0.0])]
    link: Body,
    #[joint(between = [ground, link], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[force(between = [ground, link], axis = [1.0, 0.0, 0.0], moment = torque)]
    motor: holonom::forces::TorsionalActuator,
}

type Inputs = <Arm as Mechanism>::Inputs<f64>;
type State = <Arm as Mechanism>::State<f64>;

/// What a run of a second says under a law.
fn run<I, L>(integrator: I, law: L, joints: bool) -> Result<State, Fault>
where
    L: Fn(f64, &State, &mut Loads<'_, f64, Arm>),
    I: Runs<Problem<Arm, StandardLagrange, f64, Absolute, ForceLaw<L>>>
        + Runs<Problem<Arm, StandardLagrange, f64, Relative, ForceLaw<L>>>,
{
    let arm = Arm::default();
    let simulation = Simulation::new(&arm, StandardLagrange, integrator).forces(law);
    let nothing = |_: &Sample<'_, f64, Arm>| ControlFlow::Continue(());
    let run = if joints {
        let simulation = simulation.joint_coordinates();
        simulation.run(0.0..=1.0, every(0.1), nothing)
    } else {
        let simulation = simulation.absolute_coordinates();
        simulation.run(0.0..=1.0, every(0.1), nothing)
    };
    run.map(|report| report.state).map_err(|error| error.fault)
}

fn angle(state: &State) -> f64 {
    let constants = Arm::default().constants::<f64>().expect("parameters");
    holonom::View::<f64, Arm>::new(&constants, 0.0, state).angle(Arm::HANDLES.hinge)
}

/// An integral of an error, as a controller that is called once a period would sum it.
#[test]
fn a_closure_with_memory_is_refused() {
    for joints in [false, true] {
        let (last, integral) = (Cell::new(0.0), Cell::new(0.0));
        let law = |time: f64, state: &State, loads: &mut Loads<'_, f64, Arm>| {
            let error = 0.5 - angle(state);
            integral.set(integral.get() + error * (time - last.get()));
            last.set(time);
            loads.moment(
                Arm::HANDLES.link,
                [30.0 * error + 40.0 * integral.get(), 0.0, 0.0],
            );
        };
        let error = run(DormandPrince::default(), law, joints).expect_err("it remembers");
        assert!(
            matches!(
                error,
                Fault::Step(StepFault::TwoAnswers { body: "link", .. })
            ),
            "{error}"
        );
        let said = error.to_string();
        assert!(
            said.contains("the same time") && said.contains("once a period"),
            "{said}"
        );
    }
}

/// A switch that keeps its position between two thresholds: it begins to differ after some steps
/// only.
#[test]
fn hysteresis_and_noise_are_refused() {
    let calls = Cell::new(0_u64);
    let noise = |_: f64, _: &State, loads: &mut Loads<'_, f64, Arm>| {
        let next = calls
            .get()
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        calls.set(next);
        loads.moment(Arm::HANDLES.link, [1e-9 * (next >> 40) as f64, 0.0, 0.0]);
    };
    let error = run(Rk4::every(1e-3), noise, false).expect_err("it is noise");
    assert_eq!(
        error,
        Fault::Step(StepFault::TwoAnswers {
            body: "link",
            time: 0.0
        })
    );
    let late = Cell::new(0.0);
    let filter = |time: f64, _: &State, loads: &mut Loads<'_, f64, Arm>| {
        if time > 0.5 {
            late.set(0.5 * (late.get() + time));
        }
        loads.moment(Arm::HANDLES.link, [late.get(), 0.0, 0.0]);
    };
    let error = run(Rk4::every(1e-3), filter, true).expect_err("it filters");
    assert!(
        matches!(error, Fault::Step(StepFault::TwoAnswers { .. })),
        "{error}"
    );
}

/// Counters, tables and forces that are not finite are no memory of the forces.
#[test]
fn a_closure_that_counts_is_not() {
    let calls = Cell::new(0);
    let law = |time: f64, state: &State, loads: &mut Loads<'_, f64, Arm>| {
        calls.set(calls.get() + 1);
        loads.moment(Arm::HANDLES.link, [time.sin() - angle(state), 0.0, 0.0]);
    };
    for joints in [false, true] {
        run(DormandPrince::default(), law, joints).expect("it remembers nothing that acts");
    }
    assert!(calls.get() > 100);
}

/// A PI controller at 1 kHz, called once a period, by a run a period and by a stepper: both
/// renormalise where it was told.
#[test]
fn a_controller_is_called_once_a_period() {
    const PERIOD: f64 = 1e-3;
    let mut arm = Arm::default();
    let hinge = Arm::HANDLES.hinge;
    let mut integral = 0.0;
    let mut control = |angle: f64, rate: f64| {
        let error = 0.5 - angle;
        integral += error * PERIOD;
        30.0 * error + 40.0 * integral - 6.0 * rate
    };
    let mut state = arm.described_state().expect("parameters");
    for k in 0..4000 {
        let constants = arm.constants().expect("parameters");
        let view = holonom::View::<f64, Arm>::new(&constants, 0.0, &state);
        arm.torque = control(view.angle(hinge), view.angle_rate(hinge));
        let start = PERIOD * f64::from(k);
        state = Simulation::new(&arm, StandardLagrange, DormandPrince::default())
            .initial_state(state)
            .absolute_coordinates()
            .run(start..=start + PERIOD, every_step(), |_| {
                ControlFlow::Continue(())
            })
            .expect("a period")
            .state;
    }
    assert!((angle(&state) - 0.5).abs() < 1e-2, "{}", angle(&state));
    integral = 0.0;
    let mut control = |angle: f64, rate: f64| {
        let error = 0.5 - angle;
        integral += error * PERIOD;
        30.0 * error + 40.0 * integral - 6.0 * rate
    };
    let mut stepper = Stepper::new(&arm, StandardLagrange, Rk4)
        .expect("parameters")
        .absolute_coordinates();
    let mut stepped = arm.described_state().expect("parameters");
    for _ in 0..4000 {
        let view = stepper.view(&stepped);
        let torque = control(view.angle(hinge), view.angle_rate(hinge));
        let inputs = Inputs { torque };
        stepper
            .step_with(&mut stepped, &inputs, PERIOD)
            .expect("a step");
    }
    assert!((angle(&stepped) - angle(&state)).abs() < 1e-6);
}
