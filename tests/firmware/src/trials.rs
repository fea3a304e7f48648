//! What is run, here and on the host: each mechanism at 1 kHz, by its bodies and by its joints, over any type of numbers.

use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom::{JointCoordinates, JointStepper, Real};

// Not by the crate of the models, which has many more to compile.
#[path = "../../../models/src/rod_pendulum.rs"]
mod rod_pendulum;
#[path = "../../../models/src/ur5.rs"]
mod ur5;

use rod_pendulum::RodPendulum;
use ur5::Ur5;

/// A four-bar of unequal rods that swings under the weight, far from any line of its links.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "both")]
pub struct Swing {
    #[body(mass = 0.6, inertia = [0.018, 0.0004, 0.018], position = [-0.15, -0.25, 0.0])]
    left: Body,
    #[body(mass = 1.0, inertia = [0.001, 0.08, 0.08], position = [0.15, -0.6, 0.0])]
    bar: Body,
    #[body(mass = 0.8, inertia = [0.04, 0.0006, 0.04], position = [0.6, -0.35, 0.0])]
    right: Body,
    #[joint(between = [ground, left], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    foot: Revolute,
    #[joint(between = [left, bar], point = [-0.3, -0.5, 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    #[joint(between = [bar, right], point = [0.6, -0.7, 0.0], axis = [0.0, 0.0, 1.0])]
    other_pin: Revolute,
    #[joint(between = [ground, right], point = [0.6, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    other_foot: Revolute,
}

/// A mechanism in a loop of a controller.
pub trait Trial<S: Real>: Sized {
    /// Mechanism and description.
    const NAME: &'static str;
    /// Periods of 1 ms that the reference is given after.
    const PERIODS: u32;
    /// What is stepped.
    type State: Copy;

    /// The mechanism as it is described.
    fn new() -> Result<(Self, Self::State), Fault>;

    /// Inputs for the period of this number, and a step.
    fn tick(&mut self, state: &mut Self::State, number: u32) -> Result<(), Fault>;

    /// The right-hand side alone.
    fn evaluate(&self, state: &Self::State) -> Result<(), Fault>;

    /// An angle (rad), and a component of a reaction (N).
    fn read(&self, state: &Self::State) -> Result<[S; 2], Fault>;
}

/// All periods, and what is read at the end.
pub fn run<S: Real, T: Trial<S>>() -> Result<[S; 2], Fault> {
    let (mut trial, mut state) = T::new()?;
    for number in 0..T::PERIODS {
        trial.tick(&mut state, number)?;
    }
    trial.read(&state)
}

/// Sets what an actuator is told for the period of a number.
trait Driven {
    /// Whether anything was set.
    fn drive(&mut self, number: u32) -> bool;
}

impl Driven for RodPendulum {
    fn drive(&mut self, _number: u32) -> bool {
        false
    }
}

impl Driven for Swing {
    fn drive(&mut self, _number: u32) -> bool {
        false
    }
}

impl Driven for Ur5 {
    /// About what holds the arm out, and a shake.
    fn drive(&mut self, number: u32) -> bool {
        let shake = f64::from(number % 50) / 50.0 - 0.5;
        self.pan_torque = 4.0 * shake;
        self.lift_torque = -50.0 - 10.0 * shake;
        self.elbow_torque = -12.0;
        self.wrist_1_torque = 0.5 * shake;
        true
    }
}

/// One millisecond.
const PERIOD: f64 = 1e-3;

macro_rules! trial {
    ($trial:ident = $name:literal: $mechanism:ident, $stepper:ident, $formulation:ty = $value:expr, $state:ty,
     $start:expr, $bodies:expr, $evaluate:expr, $joint:ident, $body:ident, $component:ident, $periods:literal) => {
        #[doc = concat!("The ", $name, ".")]
        pub struct $trial<S: Real> {
            plant: $mechanism,
            stepper: $stepper<S, $mechanism, $formulation, Rk4>,
        }

        impl<S: Real> Trial<S> for $trial<S> {
            const NAME: &'static str = $name;
            const PERIODS: u32 = $periods;
            type State = $state;

            fn new() -> Result<(Self, Self::State), Fault> {
                let plant = $mechanism::default();
                let stepper = $stepper::new(&plant, $value, Rk4)?;
                let state = $start(&plant, &stepper)?;
                Ok((Self { plant, stepper }, state))
            }

            #[inline(never)]
            fn tick(&mut self, state: &mut Self::State, number: u32) -> Result<(), Fault> {
                if self.plant.drive(number) {
                    self.stepper.update(&self.plant)?;
                }
                self.stepper.step(state, S::constant(PERIOD))
            }

            #[inline(never)]
            fn evaluate(&self, state: &Self::State) -> Result<(), Fault> {
                let time = self.stepper.time();
                let evaluation = self.stepper.dynamics().evaluate(time, state)?;
                core::hint::black_box(&evaluation);
                Ok(())
            }

            #[inline(never)]
            fn read(&self, state: &Self::State) -> Result<[S; 2], Fault> {
                let bodies = $bodies(&self.stepper, state);
                let (evaluation, _) = $evaluate(&self.stepper, &bodies)?;
                let view = self.stepper.view(&bodies);
                let handles = $mechanism::HANDLES;
                let wrench =
                    view.reaction(&evaluation.multipliers, handles.$joint, handles.$body)?;
                Ok([view.angle(handles.$joint), wrench.force.$component])
            }
        }
    };
}

macro_rules! by_bodies {
    ($trial:ident = $name:literal: $mechanism:ident, $formulation:ty = $value:expr, $($read:tt)*) => {
        trial! {
            $trial = $name: $mechanism, Stepper, $formulation = $value, <$mechanism as Mechanism>::State<S>,
            |plant: &$mechanism, _: &_| plant.described_state(), |_: &_, state: &Self::State| *state,
            |stepper: &Stepper<S, $mechanism, $formulation, Rk4>, bodies: &_| stepper.dynamics().evaluate(stepper.time(), bodies),
            $($read)*
        }
    };
}

macro_rules! by_joints {
    ($trial:ident = $name:literal: $mechanism:ident, $formulation:ty = $value:expr, $($read:tt)*) => {
        trial! {
            $trial = $name: $mechanism, JointStepper, $formulation = $value, <$mechanism as JointCoordinates>::JointState<S>,
            |_: &_, stepper: &JointStepper<S, $mechanism, $formulation, Rk4>| stepper.initial_state(), JointStepper::bodies,
            |stepper: &JointStepper<S, $mechanism, $formulation, Rk4>, bodies: &_| stepper.dynamics().of_bodies().evaluate(stepper.time(), bodies), $($read)*
        }
    };
}

by_bodies! { PendulumByBodies = "pendulum, bodies": RodPendulum, Baumgarte<S> = Baumgarte::new(S::constant(20.0), S::constant(20.0)), pivot, rod, z, 10_000 }
by_joints! { PendulumByJoints = "pendulum, joints": RodPendulum, StandardLagrange = StandardLagrange, pivot, rod, z, 10_000 }
by_bodies! { SwingByBodies = "four-bar, bodies": Swing, Baumgarte<S> = Baumgarte::new(S::constant(20.0), S::constant(20.0)), foot, left, y, 10_000 }
by_joints! { SwingByJoints = "four-bar, joints": Swing, Baumgarte<S> = Baumgarte::new(S::constant(20.0), S::constant(20.0)), foot, left, y, 10_000 }
by_joints! { Ur5ByJoints = "UR5, joints": Ur5, StandardLagrange = StandardLagrange, elbow, forearm, z, 200 }
