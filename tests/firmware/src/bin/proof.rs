//! Everything that a loop of a controller calls, in all formulations, by all methods of a fixed
//! step. It links only if nothing of it can panic.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use core::hint::black_box;

use holonom::prelude::*;
use holonom::{
    Heun, Kutta3, Midpoint, Scalar, SemiImplicitEuler,
    integrate::DormandPrince5,
    mechanism::{Absolute, Relative},
    run::Steps,
};
use holonom_firmware::Number;
use holonom_firmware::trials::{
    PendulumByBodies, PendulumByJoints, Swing, SwingByBodies, SwingByJoints, Ur5ByJoints, run,
};
use panic_never as _;

/// Steps and read-outs of a four-bar by its bodies.
fn by_bodies<F, K>(formulation: F, scheme: K) -> Result<(), Fault>
where
    F: Formulation<Number>,
    K: Steps<Problem<Swing, F, Number, Absolute>>,
{
    let plant = Swing::default();
    let mut stepper = Stepper::new(&plant, formulation, scheme)?;
    let mut state = plant.described_state()?;
    for _ in 0..10 {
        stepper.update(&plant)?;
        stepper.step(&mut state, Number::constant(1e-3))?;
        stepper
            .clone()
            .step(&mut { state }, Number::constant(1e-3))?;
    }
    let view = stepper.view(&state);
    black_box((
        view.energy(),
        view.violation(),
        view.angle(Swing::HANDLES.foot),
    ));
    Ok(())
}

/// The same by its joints.
fn by_joints<F, K>(formulation: F, scheme: K) -> Result<(), Fault>
where
    F: Formulation<Number>,
    K: Steps<Problem<Swing, F, Number, Relative>>,
{
    let plant = Swing::default();
    let mut stepper = Stepper::<Problem<Swing, _, Number>, _>::new(&plant, formulation, scheme)?
        .joint_coordinates();
    let mut state = stepper.initial_state()?;
    for _ in 0..10 {
        stepper.update(&plant)?;
        stepper.step(&mut state, Number::constant(1e-3))?;
        stepper
            .clone()
            .step(&mut { state }, Number::constant(1e-3))?;
    }
    let bodies = stepper.bodies(&state);
    let view = stepper.view(&bodies);
    black_box((
        view.energy(),
        view.violation(),
        view.angle(Swing::HANDLES.foot),
    ));
    Ok(())
}

fn formulations<K>(scheme: K) -> Result<(), Fault>
where
    K: Moves<StandardLagrange>
        + Moves<Baumgarte<Number>>
        + Moves<Penalty<Number>>
        + Moves<AugmentedLagrangian<Number>>,
{
    by_bodies(StandardLagrange, scheme)?;
    by_bodies(Baumgarte::default(), scheme)?;
    by_bodies(Penalty::default(), scheme)?;
    by_bodies(AugmentedLagrangian::default(), scheme)?;
    by_joints(StandardLagrange, scheme)?;
    by_joints(Baumgarte::default(), scheme)?;
    by_joints(Penalty::default(), scheme)?;
    by_joints(AugmentedLagrangian::default(), scheme)
}

/// Methods that take steps of the four-bar in both coordinates.
trait Moves<F: Formulation<Number>>:
    Steps<Problem<Swing, F, Number, Absolute>> + Steps<Problem<Swing, F, Number, Relative>>
{
}

impl<F: Formulation<Number>, K> Moves<F> for K where
    K: Steps<Problem<Swing, F, Number, Absolute>> + Steps<Problem<Swing, F, Number, Relative>>
{
}

fn all() -> Result<(), Fault> {
    formulations(Rk4)?;
    formulations(DormandPrince5)?;
    by_bodies(Baumgarte::default(), SemiImplicitEuler)?;
    by_joints(Baumgarte::default(), SemiImplicitEuler)?;
    by_bodies(Baumgarte::default(), Midpoint)?;
    by_joints(Baumgarte::default(), Midpoint)?;
    by_bodies(Baumgarte::default(), Heun)?;
    by_joints(Baumgarte::default(), Heun)?;
    by_bodies(Baumgarte::default(), Kutta3)?;
    by_joints(Baumgarte::default(), Kutta3)?;
    black_box(run::<Number, PendulumByBodies<_>>()?);
    black_box(run::<Number, PendulumByJoints<_>>()?);
    black_box(run::<Number, SwingByBodies<_>>()?);
    black_box(run::<Number, SwingByJoints<_>>()?);
    black_box(run::<Number, Ur5ByJoints<_>>()?);
    Ok(())
}

#[holonom_firmware::entry]
fn main() -> ! {
    holonom_firmware::main(|| all().is_ok())
}
