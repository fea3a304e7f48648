//! The balancer of the guide's page on controllers, as it is counted beside its twin in C.

use holonom::prelude::*;
use holonom::{Real, View};

use crate::trials::{ByJoints, Plant};

/// A wheel on a pendulum; the motor turns the wheel against the pendulum.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub struct Balancer {
    #[input]
    torque: f64,
    #[body(mass = 0.5, inertia = [0.004, 0.004, 1e-4], position = [0.0, 0.0, 0.1])]
    pendulum: Body,
    #[body(mass = 0.2, inertia = [1e-3, 5e-4, 5e-4], position = [0.0, 0.0, 0.2])]
    wheel: Body,
    #[joint(between = [ground, pendulum], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[joint(between = [pendulum, wheel], point = [0.0, 0.0, 0.2], axis = [1.0, 0.0, 0.0])]
    shaft: Revolute,
    #[force(between = [pendulum, wheel], axis = [1.0, 0.0, 0.0], moment = torque)]
    motor: TorsionalActuator,
}

impl Plant for Balancer {
    const NAME: &'static str = "balancer";
    const PERIODS: u32 = 1000;

    /// As `c/main.c` has it.
    fn told<S: Real>(_number: u32) -> Self::Inputs<S> {
        Self::Inputs {
            torque: S::constant(0.01),
        }
    }

    fn read<S: Real>(
        view: &View<'_, S, Self>,
        multipliers: &Self::Multipliers<S>,
    ) -> Result<[S; 2], Fault> {
        let on = Self::HANDLES;
        let wrench = view.reaction(multipliers, on.pivot, on.pendulum)?;
        Ok([view.angle(on.pivot), wrench.force.z])
    }
}

/// The balancer by its joints. No equations remain.
pub type BalancerByJoints<S> = ByJoints<S, Balancer, StandardLagrange>;
