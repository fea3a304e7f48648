//! Several mechanisms in one evaluation: every lane is, bit for bit, what a stepper for it alone
//! gives, also where it fails.

#![forbid(unsafe_code)]

use core::array::from_fn;

use holonom::error::{StartFault, StepFault};
use holonom::lanes::{Ensemble, LaneEquations, Lanes};
use holonom::mechanism::{Absolute, Coordinates, Relative, Terms};
use holonom::prelude::*;
use holonom::run::Steps;
use holonom::{
    Heun, Kutta3, Midpoint, Real, Scalar, SemiImplicitEuler, SimulationError,
    dynamics::Dynamics,
    integrate::{BogackiShampine3, DormandPrince5, DormandPrince8, OneStep},
};
use holonom::{Pose, nalgebra::Quaternion};
use holonom_models::FourBar;

/// An arm with a motor on a hinge, and a bob on a ball joint at its end.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Arm {
    #[param]
    length: f64,
    #[param]
    mass: f64,
    #[input]
    torque: f64,
    #[body(
        mass = mass,
        inertia = [mass * length * length / 12.0, 1e-3, mass * length * length / 12.0],
        position = [0.0, 0.5 * length, 0.0]
    )]
    arm: Body,
    #[body(mass = 0.4, inertia = [2e-3, 3e-3, 4e-3], position = [0.0, length, -0.2])]
    bob: Body,
    #[joint(between = [ground, arm], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [arm, bob], point = [0.0, length, 0.0])]
    ball: Spherical,
    #[force(
        between = [ground, arm],
        axis = [1.0, 0.0, 0.0],
        moment = torque + 0.5 * sin(3.0 * time) - 0.1 * rate
    )]
    motor: TorsionalActuator,
}

/// A nut that falls along a thread, which counts turns.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Nut {
    #[param]
    pitch: f64,
    #[body(mass = 0.3, inertia = [1e-4, 1e-4, 2e-4], position = [0.0, 0.0, 0.0])]
    nut: Body,
    #[joint(
        between = [ground, nut],
        point = [0.0, 0.0, 0.0],
        axis = [0.0, 0.0, 1.0],
        pitch = pitch
    )]
    thread: Screw,
}

fn arms<const L: usize>() -> [Arm; L] {
    from_fn(|k| Arm::new(0.6 + 0.1 * k as f64, 2.0 - 0.1 * k as f64).expect("positive numbers"))
}

/// Described starts with another rate of the arm in each lane: the fastest turns by 1.1 rad a step.
fn thrown<T: Real, const L: usize>(arms: &[Arm; L]) -> [StateOf<Arm, T>; L] {
    from_fn(|k| {
        let mut state = arms[k].described_state().expect("a sound start");
        let rate = T::constant([0.0, 0.5, 3.0, 1.5, 20.0, 60.0, 110.0, 0.1][k % 8]);
        let hinge = Arm::HANDLES.hinge;
        arms[k]
            .set_angle_rate(&mut state, hinge, rate)
            .expect("a free rate");
        state
    })
}

fn torques<T: Real>(step: usize, lane: usize) -> InputsOf<Arm, T> {
    InputsOf::<Arm, T> {
        torque: T::constant(0.1 * lane as f64 - 0.02 * step as f64),
    }
}

/// Steps an ensemble and a stepper for every lane, and compares them after every step; a step of
/// all lanes needs the same schemes as one alone. Returns how the ensemble ends.
fn compared<T, M, F, K, C, const L: usize>(
    mechanisms: &[M; L],
    (formulation, scheme): (F, K),
    starts: &[M::State<T>; L],
    inputs: impl Fn(usize, usize) -> M::Inputs<T>,
    (steps, dt): (usize, f64),
) -> Ensemble<Problem<M, F, T, C>, K, L>
where
    T: Real,
    M: Mechanism,
    F: Formulation<T>,
    F::Terms: Terms,
    C: Coordinates<M>,
    K: Steps<Problem<M, F, T, C>>
        + OneStep<T, Dynamics<Problem<M, F, T, C>>>
        + OneStep<Lanes<T, L>, LaneEquations<Problem<M, F, T, C>, L>>,
{
    let dt = T::constant(dt);
    let ensemble = Ensemble::new(mechanisms, formulation, scheme).expect("sound mechanisms");
    let mut ensemble = ensemble.coordinates::<C>().starting_at(T::constant(0.25));
    ensemble.start(starts);
    let mut alone: Vec<_> = mechanisms
        .iter()
        .zip(starts)
        .map(|(mechanism, start)| {
            let stepper = Stepper::new(mechanism, formulation, scheme).expect("sound");
            let stepper = stepper.coordinates::<C>().starting_at(T::constant(0.25));
            let state = stepper.state_of(start).expect("a sound start");
            (stepper, state, None)
        })
        .collect();
    for step in 0..steps {
        ensemble
            .step_with(&from_fn(|lane| inputs(step, lane)), dt)
            .expect("a sound step");
        for (lane, (stepper, state, fault)) in alone.iter_mut().enumerate() {
            if fault.is_some() {
                continue;
            }
            *fault = stepper
                .step_with(state, &inputs(step, lane), dt)
                .err()
                .map(|fault| (stepper.time().to_f64(), fault));
        }
        for (lane, (state, (_, known, fault))) in ensemble.states().iter().zip(&alone).enumerate() {
            assert_eq!(state, known, "lane {lane} after step {step}");
            let stopped = ensemble.stopped()[lane].map(|stopped| (stopped.time, stopped.fault));
            assert_eq!(stopped, *fault, "lane {lane} after step {step}");
        }
    }
    ensemble.each(|lane, view| {
        let (stepper, state, fault) = &alone[lane];
        assert!(fault.is_none());
        let bodies = stepper.bodies(state);
        assert_eq!(view.energy(), stepper.view(&bodies).energy());
    });
    ensemble
}

/// Arms in both coordinates.
fn arms_agree<T: Real, const L: usize>(steps: usize) {
    let arms = arms::<L>();
    let starts = thrown::<T, L>(&arms);
    let run = (steps, 0.01);
    let method = (StandardLagrange, Rk4);
    let joints = compared::<T, _, _, _, Relative, L>(&arms, method, &starts, torques, run);
    let bodies = compared::<T, _, _, _, Absolute, L>(&arms, method, &starts, torques, run);
    // The fast ones may leave the range of numbers, as they do alone.
    assert!(joints.stopped()[..4].iter().all(Option::is_none));
    assert!(bodies.stopped()[..4].iter().all(Option::is_none));
}

#[test]
fn lanes_are_steppers_bit_for_bit() {
    arms_agree::<f64, 4>(60);
    arms_agree::<f64, 8>(60);
}

#[test]
fn lanes_of_single_precision_are_steppers_bit_for_bit() {
    arms_agree::<f32, 8>(40);
    arms_agree::<f32, 16>(40);
}

/// Each explicit scheme in joint coordinates, beside [`Rk4`].
#[test]
fn every_explicit_scheme_takes_lanes() {
    let arms = arms::<4>();
    let starts = thrown::<f64, 4>(&arms);
    macro_rules! schemes {
        ($($scheme:expr),*) => {$(
            let method = (StandardLagrange, $scheme);
            compared::<f64, _, _, _, Relative, 4>(&arms, method, &starts, torques, (10, 0.01));
        )*};
    }
    schemes!(
        SemiImplicitEuler,
        Midpoint,
        Heun,
        Kutta3,
        BogackiShampine3,
        DormandPrince5,
        DormandPrince8
    );
}

/// A four-bar whose upright links stand at an angle (rad) from the vertical, clockwise, and turn at
/// a rate (rad/s).
fn parallelogram(bars: &FourBar, angle: f64, rate: f64) -> StateOf<FourBar> {
    let mut state = bars.described_state().expect("a sound start");
    let handles = FourBar::HANDLES;
    let (sine, cosine) = angle.sin_cos();
    let upright = Quaternion::new((0.5 * angle).cos(), 0.0, 0.0, -(0.5 * angle).sin());
    for (body, foot, part, orientation, spin) in [
        (handles.left, 0.0, 0.5, upright, -rate),
        (handles.right, 1.0, 0.5, upright, -rate),
        (handles.coupler, 0.5, 1.0, Quaternion::identity(), 0.0),
    ] {
        let pose = Pose {
            position: [foot + part * sine, part * cosine, 0.0].into(),
            orientation,
        };
        FourBar::set_pose(&mut state, body, pose);
        let velocity = [part * rate * cosine, -part * rate * sine, 0.0];
        FourBar::set_velocity(&mut state, body, velocity.into());
        FourBar::set_angular_velocity(&mut state, body, [0.0, 0.0, spin].into());
    }
    state
}

/// Loops of different starts: one in line, where equations depend on each other.
#[test]
fn a_lane_at_a_singular_start_stops_and_the_others_go_on() {
    let bars = [FourBar::default(); 4];
    let in_line = std::f64::consts::FRAC_PI_2;
    let starts = [(0.0, 1.0), (0.4, -0.3), (in_line, 1.0), (-0.2, 0.0)]
        .map(|(angle, rate)| parallelogram(&bars[0], angle, rate));
    let inputs = |_, _| ();
    let run = (30, 0.01);
    let ends_by_name = |stopped: &Option<SimulationError<_>>| {
        matches!(
            stopped,
            Some(SimulationError {
                time: 0.25,
                fault: Fault::Step(StepFault::Singular { .. }),
                ..
            })
        )
    };
    let method = (StandardLagrange, Rk4);
    let joints = compared::<f64, _, _, _, Relative, 4>(&bars, method, &starts, inputs, run);
    let stopped = joints
        .stopped()
        .each_ref()
        .map(|stopped| ends_by_name(&stopped.map(unstated)));
    assert_eq!(stopped, [false, false, true, false]);
    let method = (Baumgarte::default(), Rk4);
    let bodies = compared::<f64, _, _, _, Absolute, 4>(&bars, method, &starts, inputs, run);
    let stopped = bodies
        .stopped()
        .each_ref()
        .map(|stopped| ends_by_name(&stopped.map(unstated)));
    assert_eq!(stopped, [false, false, true, false]);
    assert_eq!([joints.going(), bodies.going()], [3, 3]);
    // A penalty has a solution there.
    let method = (Penalty::default(), Rk4);
    let yielding = compared::<f64, _, _, _, Relative, 4>(&bars, method, &starts, inputs, run);
    assert_eq!(yielding.going(), 4);
}

/// The same without the state.
fn unstated<X>(stopped: SimulationError<X>) -> SimulationError<()> {
    SimulationError {
        time: stopped.time,
        fault: stopped.fault,
        state: (),
    }
}

/// A torque beyond the range of numbers, in one lane after some steps: that lane alone stops, with
/// its last good state, and starts anew.
#[test]
fn a_lane_whose_numbers_overflow_stops_and_can_start_again() {
    let arms = arms::<4>();
    let starts = thrown::<f64, 4>(&arms);
    let burst = |step: usize, lane: usize| {
        let mut inputs = torques(step, lane);
        if step >= 5 + lane && lane % 2 == 1 {
            inputs.torque = 1e300;
        }
        inputs
    };
    let method = (StandardLagrange, Rk4);
    let run = (20, 0.01);
    let mut joints = compared::<f64, _, _, _, Relative, 4>(&arms, method, &starts, burst, run);
    let bodies = compared::<f64, _, _, _, Absolute, 4>(&arms, method, &starts, burst, run);
    assert_eq!([joints.going(), bodies.going()], [2, 2]);
    joints.start(&starts);
    assert_eq!(joints.going(), 4);
    // All of them.
    let all = |_, _| InputsOf::<Arm> { torque: f64::MAX };
    let none = compared::<f64, _, _, _, Relative, 4>(&arms, method, &starts, all, run);
    assert_eq!((none.going(), none.time()), (0, 0.25));
}

/// Turns that are counted are put right lane by lane.
#[test]
fn counted_turns_agree() {
    let nuts: [Nut; 4] = from_fn(|k| Nut::new(0.02 + 0.03 * k as f64).expect("a pitch"));
    let starts: [StateOf<Nut>; 4] = from_fn(|k| nuts[k].described_state().expect("a sound start"));
    let method = (StandardLagrange, Rk4);
    let (run, inputs) = ((80, 0.02), |_, _| ());
    compared::<f64, _, _, _, Relative, 4>(&nuts, method, &starts, inputs, run);
    compared::<f64, _, _, _, Absolute, 4>(&nuts, method, &starts, inputs, run);
}

/// What an ensemble refuses as a whole, and a start that it refuses in one lane.
#[test]
fn settings_are_refused_and_starts_stop_their_lane() {
    let mut arms = arms::<4>();
    let mut ensemble =
        Ensemble::<Problem<_, _>, _, 4>::new(&arms, StandardLagrange, Rk4).expect("sound");
    assert!(matches!(
        ensemble.step(-1.0),
        Err(Fault::Start(StartFault::Setting { .. }))
    ));
    let mut starts = thrown::<f64, 4>(&arms);
    let handle = Arm::HANDLES.arm;
    Arm::set_velocity(&mut starts[2], handle, [f64::NAN; 3].into());
    ensemble.start(&starts);
    assert!(ensemble.stopped()[2].is_some() && ensemble.going() == 3);
    ensemble.step(0.01).expect("three go on");
    let torques = from_fn(|_| InputsOf::<Arm> { torque: f64::NAN });
    assert!(ensemble.set_inputs(&torques).is_err());
    arms[1].mass = -1.0;
    assert!(matches!(ensemble.update(&arms), Err(Fault::Parameter(_))));
    ensemble.step(0.01).expect("with the former ones");
    assert_eq!(ensemble.going(), 3);
}

/// Operations of single numbers, side by side.
#[test]
fn every_operation_is_that_of_its_lanes() {
    fn holds<T: Real>() {
        let numbers = [-2.5, -0.0, 0.3, 1e-3, 7.0, f64::NAN, f64::INFINITY, 0.95].map(T::constant);
        let others = [1.0, 2.0, f64::NAN, 0.4, -3.0, 0.1, -1.0, 0.95].map(T::constant);
        let (x, y) = (Lanes::new(numbers), Lanes::new(others));
        let bits = |value: T| (value.to_f64().is_nan(), value.to_f64().to_bits());
        let same = |lanes: Lanes<T, 8>, of: &dyn Fn(T, T) -> T| {
            for lane in 0..8 {
                let (found, known) = (lanes.to_array()[lane], of(numbers[lane], others[lane]));
                let equal = bits(found) == bits(known) || bits(found).0 && bits(known).0;
                assert!(equal, "lane {lane}: {found:?}, not {known:?}");
            }
        };
        same(x + y, &|x, y| x + y);
        same(x - y, &|x, y| x - y);
        same(x * y, &|x, y| x * y);
        same(-x, &|x, _| -x);
        same(x.reciprocal(), &|x, _| x.reciprocal());
        same(x.sqrt(), &|x, _| x.sqrt());
        same(x.fused(y, x), &|x, y| x.fused(y, x));
        same(x.abs(), &|x, _| x.abs());
        same(x.min(y), &|x, y| x.min(y));
        same(x.select(y, x, -y), &|x, y| x.select(y, x, -y));
        same(x.sin(), &|x, _| x.sin());
        same(x.cos(), &|x, _| x.cos());
        same(x.exp(), &|x, _| x.exp());
        same(x.atan2(y), &|x, y| x.atan2(y));
        same(x.round(), &|x, _| x.round());
        let small = x * Lanes::constant(0.1);
        for (angles, factor) in [(x, 1.0), (small, 0.1)] {
            for part in 0..2 {
                let [turn] = Scalar::sines_and_versines(&[angles]);
                same(turn[part], &|x, _| {
                    let [turn] = T::sines_and_versines(&[x * T::constant(factor)]);
                    turn[part]
                });
            }
        }
    }
    holds::<f64>();
    holds::<f32>();
}

/// A fan on a motor whose current is a state of its own, against a moment from a table.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Fan {
    #[param]
    drag: Spline<4>,
    #[input(order = 2)]
    voltage: Setpoint,
    #[state(rate = (voltage - 2.0 * current - 0.5 * shaft.rate) / 0.02)]
    current: f64,
    #[body(mass = 1.0, inertia = [1e-3, 1e-3, 1e-3])]
    rotor: Body,
    #[joint(between = [ground, rotor], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
    #[force(between = [ground, rotor], axis = [0.0, 0.0, 1.0], moment = 0.5 * current - drag(rate))]
    motor: TorsionalActuator,
}

/// Every lane reads another part of another table.
#[test]
fn states_and_tables_take_lanes() {
    let fans: [Fan; 4] = from_fn(|lane| {
        let most = 0.2 * (lane + 1) as f64;
        let drag = Spline::natural([0.0, 3.0, 9.0, 20.0], [0.0, 0.1, 0.4, most]);
        Fan::new(drag).expect("sound")
    });
    let starts = from_fn(|lane| {
        let mut state = fans[lane].described_state().expect("a sound start");
        let rate = 4.0 * lane as f64;
        fans[lane]
            .set_angle_rate(&mut state, Fan::HANDLES.shaft, rate)
            .expect("a free rate");
        Fan::set_state_value(&mut state, Fan::HANDLES.current, 0.3 * lane as f64);
        state
    });
    let voltages = |step, lane| InputsOf::<Fan> {
        voltage: Setpoint::at_rest(0.1 * step as f64 + lane as f64),
    };
    let run = (60, 1e-3);
    let method = (StandardLagrange, Rk4);
    compared::<f64, _, _, _, Relative, 4>(&fans, method, &starts, voltages, run);
    compared::<f64, _, _, _, Absolute, 4>(&fans, method, &starts, voltages, run);
}
