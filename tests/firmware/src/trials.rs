//! What is run, here and on the host: each mechanism at 1 kHz, by its bodies and by its joints,
//! over any type of numbers.

use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom::{
    JointCoordinates, Real, View,
    mechanism::{Absolute, Relative},
};

// Not by the crate of the models, which has many more to compile.
#[path = "../../../models/src/rod_pendulum.rs"]
mod rod_pendulum;
#[path = "../../../models/src/ur5.rs"]
mod ur5;

pub use rod_pendulum::RodPendulum;
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

/// A mechanism in a loop of a controller, and what is read of it.
pub trait Plant: JointCoordinates + Default {
    /// What it is called.
    const NAME: &'static str;
    /// Periods of 1 ms that the reference is given after.
    const PERIODS: u32;

    /// What actuators are told for the period of a number.
    fn told<S: Real>(_number: u32) -> Self::Inputs<S> {
        Self::Inputs::default()
    }

    /// An angle (rad), and a component of a reaction (N).
    fn read<S: Real>(
        view: &View<'_, S, Self>,
        multipliers: &Self::Multipliers<S>,
    ) -> Result<[S; 2], Fault>;
}

impl Plant for RodPendulum {
    const NAME: &'static str = "pendulum";
    const PERIODS: u32 = 10_000;

    fn read<S: Real>(
        view: &View<'_, S, Self>,
        multipliers: &Self::Multipliers<S>,
    ) -> Result<[S; 2], Fault> {
        let on = Self::HANDLES;
        let wrench = view.reaction(multipliers, on.pivot, on.rod)?;
        Ok([view.angle(on.pivot), wrench.force.z])
    }
}

impl Plant for Swing {
    const NAME: &'static str = "four-bar";
    const PERIODS: u32 = 10_000;

    fn read<S: Real>(
        view: &View<'_, S, Self>,
        multipliers: &Self::Multipliers<S>,
    ) -> Result<[S; 2], Fault> {
        let on = Self::HANDLES;
        let wrench = view.reaction(multipliers, on.foot, on.left)?;
        Ok([view.angle(on.foot), wrench.force.y])
    }
}

impl Plant for Ur5 {
    const NAME: &'static str = "UR5";
    const PERIODS: u32 = 200;

    /// About what holds the arm out, and a shake.
    fn told<S: Real>(number: u32) -> Self::Inputs<S> {
        let shake = S::constant(if number % 50 < 25 { 0.5 } else { -0.5 });
        Self::Inputs {
            pan_torque: S::constant(4.0) * shake,
            lift_torque: S::constant(-50.0) - S::constant(10.0) * shake,
            elbow_torque: S::constant(-12.0),
            wrist_1_torque: S::constant(0.5) * shake,
            ..Default::default()
        }
    }

    fn read<S: Real>(
        view: &View<'_, S, Self>,
        multipliers: &Self::Multipliers<S>,
    ) -> Result<[S; 2], Fault> {
        let on = Self::HANDLES;
        let wrench = view.reaction(multipliers, on.elbow, on.forearm)?;
        Ok([view.angle(on.elbow), wrench.force.z])
    }
}

/// A formulation with the coefficients that it is tried with.
pub trait Tried<S: Real>: Formulation<S> {
    /// What it is called.
    const NAME: &'static str;

    /// With these coefficients.
    fn tried() -> Self;
}

impl<S: Real> Tried<S> for StandardLagrange {
    const NAME: &'static str = "StandardLagrange";

    fn tried() -> Self {
        Self
    }
}

impl<S: Real> Tried<S> for Baumgarte<S> {
    const NAME: &'static str = "Baumgarte";

    fn tried() -> Self {
        Self::new(S::constant(20.0), S::constant(20.0))
    }
}

impl<S: Real> Tried<S> for Penalty<S> {
    const NAME: &'static str = "Penalty";

    fn tried() -> Self {
        Self::default()
    }
}

impl<S: Real> Tried<S> for AugmentedLagrangian<S> {
    const NAME: &'static str = "AugmentedLagrangian, 3 solutions";

    fn tried() -> Self {
        Self::default().exactly(3)
    }
}

/// A mechanism, described in one of two ways, in one formulation.
pub trait Trial<S: Real>: Sized {
    /// The mechanism.
    type Plant: Plant;
    /// The formulation.
    type Formulation: Tried<S>;
    /// What is stepped.
    type State: Copy;
    /// What the mechanism is described by.
    const DESCRIPTION: &'static str;

    /// The mechanism as it is described.
    fn new() -> Result<(Self, Self::State), Fault>;

    /// Inputs for the period of this number, and a step (s).
    fn tick(&mut self, state: &mut Self::State, number: u32, step: S) -> Result<(), Fault>;

    /// The right-hand side alone.
    fn evaluate(&self, state: &Self::State) -> Result<(), Fault>;

    /// What is read of the mechanism.
    fn read(&self, state: &Self::State) -> Result<[S; 2], Fault>;
}

/// All periods, and what is read at the end.
pub fn run<S: Real, T: Trial<S>>() -> Result<[S; 2], Fault> {
    let (mut trial, mut state) = T::new()?;
    for number in 0..T::Plant::PERIODS {
        trial.tick(&mut state, number, S::constant(PERIOD))?;
    }
    trial.read(&state)
}

/// One millisecond.
pub const PERIOD: f64 = 1e-3;

/// By its bodies.
pub struct ByBodies<S: Real, M: Plant, F: Tried<S>> {
    stepper: Stepper<Problem<M, F, S, Absolute>, Rk4>,
}

impl<S: Real, M: Plant, F: Tried<S>> Trial<S> for ByBodies<S, M, F> {
    type Plant = M;
    type Formulation = F;
    type State = M::State<S>;
    const DESCRIPTION: &'static str = "bodies";

    fn new() -> Result<(Self, Self::State), Fault> {
        let plant = M::default();
        let stepper = Stepper::new(&plant, F::tried(), Rk4)?.absolute_coordinates();
        let state = plant.described_state()?;
        Ok((Self { stepper }, state))
    }

    #[inline(never)]
    fn tick(&mut self, state: &mut Self::State, number: u32, step: S) -> Result<(), Fault> {
        self.stepper.step_with(state, &M::told(number), step)
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
        let multipliers = self.stepper.multipliers(state)?;
        M::read(&self.stepper.view(state), &multipliers)
    }
}

/// By its joints.
pub struct ByJoints<S: Real, M: Plant, F: Tried<S>> {
    stepper: Stepper<Problem<M, F, S, Relative>, Rk4>,
}

impl<S: Real, M: Plant, F: Tried<S>> Trial<S> for ByJoints<S, M, F> {
    type Plant = M;
    type Formulation = F;
    type State = M::JointState<S>;
    const DESCRIPTION: &'static str = "joints";

    fn new() -> Result<(Self, Self::State), Fault> {
        let stepper = Stepper::new(&M::default(), F::tried(), Rk4)?.joint_coordinates();
        let state = stepper.initial_state()?;
        Ok((Self { stepper }, state))
    }

    #[inline(never)]
    fn tick(&mut self, state: &mut Self::State, number: u32, step: S) -> Result<(), Fault> {
        self.stepper.step_with(state, &M::told(number), step)
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
        let bodies = self.stepper.bodies(state);
        let multipliers = self.stepper.multipliers(&bodies)?;
        M::read(&self.stepper.view(&bodies), &multipliers)
    }
}

/// The pendulum by its bodies, as it is checked.
pub type PendulumByBodies<S> = ByBodies<S, RodPendulum, Baumgarte<S>>;
/// The pendulum by its joints. No equations remain, and all formulations are the same.
pub type PendulumByJoints<S> = ByJoints<S, RodPendulum, StandardLagrange>;
/// The four-bar by its bodies, as it is checked.
pub type SwingByBodies<S> = ByBodies<S, Swing, Baumgarte<S>>;
/// The four-bar by its joints, as it is checked.
pub type SwingByJoints<S> = ByJoints<S, Swing, Baumgarte<S>>;
/// The UR5 by its joints. No equations remain.
pub type Ur5ByJoints<S> = ByJoints<S, Ur5, StandardLagrange>;
