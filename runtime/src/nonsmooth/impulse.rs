//! An impulse along one quantity, for an event of the user's own.

use crate::constraints::newton::compliant;
use crate::constraints::rows::Rows;
use crate::error::{Fault, ModeFault, StartFault};
use crate::formulation::add;
use crate::math::scalar::Real;
use crate::mechanism::kernels::{Compliant, Mechanism, have_equations};
use crate::mechanism::orientations::with_unit_orientations;
use crate::nonsmooth::quantity::{JointQuantity, Quantity};
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::status::Impact;
use crate::state::vector::{Array, StateParts};

/// Corrections, of which each leaves half of the digits of what the one before has left.
const CORRECTIONS: usize = 3;

/// The part of its compliance without constraints below which a quantity has no freedom.
const NO_FREEDOM: f64 = 1e-9;

/// The state after an impulse that turns the rate of a quantity back, and the impulse.
///
/// In absolute coordinates, with a compliance of half the digits: so redundant equations do no
/// harm.
pub(crate) fn impact<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    quantity: JointQuantity<M>,
    restitution: S,
) -> Result<(M::State<S>, Impact<S>), Fault> {
    have_equations::<M>()?;
    let quantity = Quantity::<S>::Joint(quantity.reading);
    let joint = quantity.name::<M>();
    let is_coefficient = restitution >= S::zero() && restitution <= S::one();
    if !is_coefficient {
        return Err(Fault::Start(StartFault::InteractionSetting {
            joint,
            setting: "restitution",
            value: restitution.to_f64(),
        }));
    }
    let read = &with_unit_orientations::<S, M>(state);
    let scene = Scene::<S, M> {
        constants,
        time,
        bodies: read,
    };
    let mut loads = M::Velocities::<S>::zeros();
    quantity.add_effort(&scene, S::one(), &mut loads);
    let column = column::<S, M>(constants, time, read, &loads);
    let dot = |a: &M::Velocities<S>, b: &M::Velocities<S>| {
        let pairs = a.as_slice().iter().zip(b.as_slice());
        pairs.fold(S::zero(), |sum, (&a, &b)| a.fused(b, sum))
    };
    let mut free = loads;
    for (load, &mass) in free
        .as_mut_slice()
        .iter_mut()
        .zip(M::mass::<S>(constants).as_slice())
    {
        *load = load.quotient(mass);
    }
    let (compliance, free) = (dot(&loads, &column), dot(&loads, &free));
    let moves = compliance > S::constant(NO_FREEDOM) * free;
    if !moves {
        return Err(Fault::Mode(ModeFault::NoMode {
            joint,
            time: time.to_f64(),
        }));
    }
    let before = quantity.rate(&scene);
    let change = -(S::one() + restitution) * before;
    let impulse = change.quotient(compliance);
    let mut next = *state;
    let velocities = next.velocities_mut().as_mut_slice();
    add(velocities, impulse, column.as_slice());
    let after = before + change;
    let half = S::constant(0.5);
    let impact = Impact {
        time,
        impulse,
        rates: [before, after],
        lost_energy: -half * impulse * (before + after),
    };
    Ok((next, impact))
}

/// What loads do to velocities, with the constraints kept.
fn column<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    loads: &M::Velocities<S>,
) -> M::Velocities<S> {
    let rows = Rows::<S, M>::at(constants, time, state);
    let (coefficients, factors) = compliant::<S, M>(constants, &rows, state, S::EPSILON.sqrt());
    let solve = |loads: &M::Velocities<S>, lower: &M::Multipliers<S>| {
        M::solve::<S, Compliant>(constants, &coefficients, &factors, loads, lower).0
    };
    let opening = |velocities: &M::Velocities<S>| {
        let moving = M::State::from_parts(*state.coordinates(), *velocities);
        M::constraint_rates(constants, time, &moving)
    };
    let by_time = opening(&Array::zeros());
    let mut column = solve(loads, &Array::zeros());
    // What the compliance has let open is closed again.
    for _ in 0..CORRECTIONS {
        let mut lower = opening(&column);
        for (rate, &by_time) in lower.as_mut_slice().iter_mut().zip(by_time.as_slice()) {
            *rate = by_time - *rate;
        }
        let correction = solve(&Array::zeros(), &lower);
        add(column.as_mut_slice(), S::one(), correction.as_slice());
    }
    column
}
