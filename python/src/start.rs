//! Where a run begins.

use holonom::error::{AnalysisFault, Fault};
use holonom::joints::{Prismatic, Revolute};
use holonom::measure::Viewed as _;
use holonom::mechanism::{StateHandle, ValueHandle};
use holonom::{JointHandle, Mechanism, MechanismExt as _};

use crate::described::coordinates;
use crate::described::motions;
use crate::exposed::{Analysed, Exposed, SpaceOf, Valued};

/// Positions (rad, m) and rates (rad/s, m/s) by the names of coordinates or joints; the others are
/// as described.
#[derive(Clone, Debug, Default)]
pub struct Start {
    pub(crate) positions: Vec<(String, f64)>,
    pub(crate) rates: Vec<(String, f64)>,
}

/// By how much a joint may be off from where a start has it (rad, m and their rates).
const OFF: f64 = 1e-9;

/// The equations of motion in the coordinates of a class, at a time (s), with its inputs.
pub(crate) fn space<E: Analysed<N>, const N: usize>(
    valued: &Valued<E::Mechanism>,
    time: f64,
) -> Result<SpaceOf<E, N>, Fault> {
    use holonom::independent::IndependentExt as _;

    let mut space = valued.mechanism.coordinates(motions::<E, N>())?;
    space.set_time(time);
    space.set_inputs(&valued.inputs()?)?;
    // The user's own states are what they start with.
    for state in E::Mechanism::REPORT.states {
        let value = valued.numbers[state.value];
        space.set_value(ValueHandle::new(state.value), value)?;
    }
    Ok(space)
}

/// The bodies at a start in the coordinates of a class. In loops the other joints follow, on the
/// branch of the described state.
///
/// # Errors
/// As [`IndependentCoordinates::state`](holonom::independent::IndependentCoordinates::state).
pub fn in_coordinates<E: Analysed<N>, const N: usize>(
    valued: &Valued<E::Mechanism>,
    time: f64,
    start: &Start,
) -> Result<<E::Mechanism as Mechanism>::State<f64>, Fault> {
    let mechanism = &valued.mechanism;
    let mut bodies = mechanism.described_state::<f64>()?;
    mechanism.assemble(time, &mut bodies)?;
    if !(start.positions.is_empty() && start.rates.is_empty()) {
        let space = space::<E, N>(valued, time)?;
        let described = space.of_bodies(&bodies);
        let mut positions = space.positions(&described)?;
        let mut rates = space.rates(&described);
        let names = coordinates::<E>();
        for (numbers, given) in [
            (&mut positions, &start.positions),
            (&mut rates, &start.rates),
        ] {
            for (number, of) in numbers.iter_mut().zip(&names) {
                if let Some((_, value)) = given.iter().find(|(name, _)| *name == of.name) {
                    *number = *value;
                }
            }
        }
        bodies = space.bodies(&space.state(positions, rates)?);
    }
    put_states(valued, &mut bodies);
    Ok(bodies)
}

/// The bodies at a start by the angles and displacements of joints.
///
/// # Errors
/// As [`MechanismExt::set_angle`](holonom::MechanismExt::set_angle) and
/// [`MechanismExt::assemble`](holonom::MechanismExt::assemble);
/// [`AnalysisFault::NotIndependent`] where a loop does not let a joint be as it was asked for.
pub fn by_joints<E: Exposed>(
    valued: &Valued<E::Mechanism>,
    time: f64,
    start: &Start,
) -> Result<<E::Mechanism as Mechanism>::State<f64>, Fault> {
    let mechanism = &valued.mechanism;
    let mut bodies = mechanism.described_state::<f64>()?;
    let joints = E::Mechanism::REPORT.joints;
    let place = |name: &str| joints.iter().position(|joint| joint.name == name);
    // The type of a joint does not matter: what it has is in the report.
    let angle = JointHandle::<E::Mechanism, Revolute>::new;
    let length = JointHandle::<E::Mechanism, Prismatic>::new;
    for (name, value) in &start.positions {
        match place(name) {
            Some(at) if joints[at].has_angle => {
                mechanism.set_angle(&mut bodies, angle(at), *value)?
            }
            Some(at) => mechanism.set_displacement(&mut bodies, length(at), *value)?,
            None => {}
        }
    }
    for (name, value) in &start.rates {
        match place(name) {
            Some(at) if joints[at].has_angle => {
                mechanism.set_angle_rate(&mut bodies, angle(at), *value)?;
            }
            Some(at) => mechanism.set_displacement_rate(&mut bodies, length(at), *value)?,
            None => {}
        }
    }
    mechanism.assemble(time, &mut bodies)?;
    let view = mechanism.view(time, &bodies)?;
    for (given, is_rate) in [(&start.positions, false), (&start.rates, true)] {
        for (name, wanted) in given {
            let Some(at) = place(name) else { continue };
            let found = match (joints[at].has_angle, is_rate) {
                (true, false) => view.angle(angle(at)),
                (true, true) => view.angle_rate(angle(at)),
                (false, false) => view.displacement(length(at)),
                (false, true) => view.displacement_rate(length(at)),
            };
            let off = (found - wanted).abs();
            if off.is_nan() || off > OFF * wanted.abs().max(1.0) {
                let joint = joints[at].name;
                return Err(AnalysisFault::NotIndependent { joint }.into());
            }
        }
    }
    put_states(valued, &mut bodies);
    Ok(bodies)
}

/// The user's own states begin as the class has them.
fn put_states<M: Mechanism>(valued: &Valued<M>, bodies: &mut M::State<f64>) {
    for (place, state) in M::REPORT.states.iter().enumerate() {
        let value = valued.numbers[state.value];
        M::set_state_value(bodies, StateHandle::new(place), value);
    }
}
