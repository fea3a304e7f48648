//! Inputs over the number type of a run: the same motion to the last digit as by way of the
//! mechanism, in both descriptions.

use holonom::forces::{PointForce, TorsionalActuator};
use holonom::joints::{Distance, Revolute};
use holonom::prelude::*;
use holonom::{Real, error::ParameterFault};

/// Two rods and a bar between ground and their end: motors with a gain, a thrust of three numbers,
/// a weight that changes.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.3 * lean, 0.0, -9.81 - lean], coordinates = "both")]
struct Crane {
    #[param]
    gain: f64,
    #[input]
    currents: [f64; 2],
    #[input]
    lean: f64,
    #[param]
    damping: f64,
    #[input]
    thrust: f64,
    #[body(mass = 1.0, inertia = [0.09, 0.01, 0.09], position = [0.0, 0.5, 0.0])]
    boom: Body,
    #[body(mass = 0.5, inertia = [0.04, 0.005, 0.04], position = [0.0, 1.3, 0.0])]
    jib: Body,
    #[joint(between = [ground, boom], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    foot: Revolute,
    #[joint(between = [boom, jib], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    knee: Revolute,
    #[joint(between = [ground, jib], head = [0.0, 1.0, 1.5], tail = [0.0, 1.6, 0.0])]
    stay: Distance,
    #[force(between = [ground, boom], axis = [1.0, 0.0, 0.0], moment = gain * currents[0] - damping * rate)]
    lift: TorsionalActuator,
    #[force(between = [boom, jib], axis = [1.0, 0.0, 0.0], moment = 0.5 * currents[1] / gain)]
    bend: TorsionalActuator,
    #[force(between = [ground, jib], point = [0.0, 1.6, 0.0], force = [0.0, 2.0 * thrust, 0.0])]
    wind: PointForce,
}

type Inputs<S> = <Crane as Mechanism>::Inputs<S>;

/// Inputs of a period.
fn inputs<S: Real>(number: u32) -> Inputs<S> {
    let shake = f64::from(number % 7) - 3.0;
    Inputs {
        currents: [1.0 + 0.1 * shake, -0.25 * shake].map(S::constant),
        lean: S::constant(0.125 * shake),
        thrust: S::constant(0.5 - 0.25 * shake),
    }
}

/// The same in the mechanism.
fn put(crane: &mut Crane, number: u32) {
    let Inputs {
        currents,
        lean,
        thrust,
    } = inputs::<f64>(number);
    crane.currents = currents;
    crane.lean = lean;
    crane.thrust = thrust;
}

fn crane() -> Crane {
    Crane::new(2.0, 0.05).expect("acceptable")
}

/// Both ways for a hundred periods.
fn agree<S: Real, F: Formulation<S>>(formulation: F) {
    let mut crane = crane();
    let step = S::constant(1e-3);
    let mut by_struct = Stepper::new(&crane, formulation, Rk4).expect("acceptable");
    let mut by_inputs = Stepper::new(&crane, formulation, Rk4).expect("acceptable");
    let mut joints_by_struct = Stepper::<Problem<Crane, _, S>, _>::new(&crane, formulation, Rk4)
        .expect("acceptable")
        .joint_coordinates();
    let mut joints_by_inputs = Stepper::<Problem<Crane, _, S>, _>::new(&crane, formulation, Rk4)
        .expect("acceptable")
        .joint_coordinates();
    let mut states = [crane.described_state().expect("acceptable"); 2];
    let mut joint_states = [joints_by_struct.initial_state().expect("consistent"); 2];
    for number in 0..100 {
        put(&mut crane, number);
        assert_eq!(crane.inputs::<S>(), inputs::<S>(number));
        by_struct.update(&crane).expect("acceptable");
        by_struct.step(&mut states[0], step).expect("regular");
        joints_by_struct.update(&crane).expect("acceptable");
        joints_by_struct
            .step(&mut joint_states[0], step)
            .expect("regular");
        let inputs = inputs::<S>(number);
        by_inputs
            .step_with(&mut states[1], &inputs, step)
            .expect("regular");
        joints_by_inputs
            .step_with(&mut joint_states[1], &inputs, step)
            .expect("regular");
    }
    // In `f32` an expression of inputs is rounded once more where it is computed in `f64` first:
    // here it is not, as all of them are computed in the run's type.
    assert_eq!(states[0], states[1]);
    assert_eq!(joint_states[0], joint_states[1]);
    let [start, end] = [crane.described_state::<S>().expect("acceptable"), states[1]];
    assert!(start != end, "it moves");
    let angle = |stepper: &Stepper<Problem<Crane, F, S>, Rk4>, state| {
        stepper.view(state).angle(Crane::HANDLES.foot).to_f64()
    };
    let bodies = joints_by_inputs.bodies(&joint_states[1]);
    let apart = angle(&by_inputs, &end) - angle(&by_inputs, &bodies);
    assert!(apart.abs() < 1e-5, "{apart:e}");
}

#[test]
fn inputs_by_themselves_are_inputs_of_the_mechanism() {
    agree::<f64, _>(StandardLagrange);
    agree::<f64, _>(Baumgarte::default());
    agree::<f64, _>(AugmentedLagrangian::default());
    agree::<f32, _>(Baumgarte::new(20.0, 20.0));
}

#[test]
fn an_input_that_is_no_number_is_refused_by_its_name() {
    let crane = crane();
    let mut stepper = Stepper::new(&crane, StandardLagrange, Rk4).expect("acceptable");
    let mut state = crane.described_state::<f64>().expect("acceptable");
    let good = inputs(3);
    stepper.step_with(&mut state, &good, 1e-3).expect("regular");
    let mut other = Stepper::new(&crane, StandardLagrange, Rk4)
        .expect("acceptable")
        .starting_at(stepper.time());
    other.set_inputs(&good).expect("acceptable");
    let (mut copy, before, time) = (state, state, stepper.time());
    let bad = Inputs {
        currents: [0.0, f64::NAN],
        ..inputs(4)
    };
    let fault = stepper.step_with(&mut state, &bad, 1e-3).expect_err("NaN");
    let Fault::Parameter(error) = fault else {
        panic!("{fault:?}")
    };
    assert_eq!(
        (error.field, error.fault),
        ("currents[1]", ParameterFault::NotFinite)
    );
    assert_eq!((state, stepper.time()), (before, time));
    // The former inputs stay.
    stepper.step(&mut state, 1e-3).expect("regular");
    other.step(&mut copy, 1e-3).expect("regular");
    assert_eq!(state, copy);
}

#[test]
fn parameters_stay_what_they_are() {
    let mut crane = crane();
    let mut stepper = crane.stepper(StandardLagrange, Rk4).expect("fine");
    stepper.set_inputs(&inputs(2)).expect("acceptable");
    // What the mechanism says counts again when it is taken.
    crane.gain = 4.0;
    stepper.update(&crane).expect("acceptable");
    let mut fresh = Stepper::new(&crane, StandardLagrange, Rk4).expect("fine");
    let mut states = [crane.described_state().expect("acceptable"); 2];
    stepper.set_inputs(&inputs(1)).expect("acceptable");
    stepper.step(&mut states[0], 1e-3).expect("regular");
    fresh
        .step_with(&mut states[1], &inputs(1), 1e-3)
        .expect("regular");
    assert_eq!(states[0], states[1]);
}

/// What `f64` holds and `f32` does not is no number of a run in `f32`.
#[test]
fn an_input_beyond_the_range_of_the_run_is_refused() {
    let mut crane = crane();
    crane.thrust = 1e300;
    assert!(crane.stepper(StandardLagrange, Rk4).is_ok());
    let fault = Stepper::<Problem<_, _, f32>, _>::new(&crane, StandardLagrange, Rk4).err();
    let Some(Fault::Parameter(error)) = fault else {
        panic!("{fault:?}")
    };
    assert_eq!(
        (error.field, error.fault),
        ("thrust", ParameterFault::NotFinite)
    );
}
