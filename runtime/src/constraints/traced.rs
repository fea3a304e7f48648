//! A projection with a fixed number of iterations, over numbers that cannot be compared.
//!
//! What programs that trace kernels ask for. [`Projection`](crate::Projection) halves steps and
//! chooses compliances by the numbers that it finds. This is Newton's method without either, on
//! rigid constraints in the metric of the mass, so it needs a start near a configuration that is
//! not singular.

use crate::math::scalar::Scalar;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::traced::{AtTime, TracedCoordinates};
use crate::state::vector::{Array, MovingState, Vector as _};

/// What a projection leaves.
#[derive(Clone, Copy, Debug)]
pub struct Projected<S> {
    /// The largest `|Phi|` of an equation that is solved, in the units of its row.
    pub violation: S,
    /// The largest `|Phi'|`.
    pub velocity_violation: S,
    /// The least relative pivot of all systems.
    pub pivot: S,
}

/// `Phi` and `Phi'` of the equations that are solved in these coordinates.
type Violations<S, M, C> = [<C as Coordinates<M>>::Multipliers<S>; 2];

fn violations<S: Scalar, M: Mechanism, C: TracedCoordinates<M>>(
    at: &AtTime<'_, S, M, C>,
    state: &C::State<S>,
) -> Option<Violations<S, M, C>> {
    let bodies = C::bodies_by_selection(at.own, state);
    let all = [
        M::constraints(at.absolute, at.time, &bodies),
        M::constraint_rates(at.absolute, at.time, &bodies),
    ];
    let mut solved = [C::Multipliers::<S>::zeros(); 2];
    for (solved, all) in solved.iter_mut().zip(&all) {
        for (row, place) in solved.as_mut_slice().iter_mut().enumerate() {
            *place = *all.as_slice().get(C::row_of_all(row)?)?;
        }
    }
    Some(solved)
}

fn largest<S: Scalar>(numbers: &[S]) -> S {
    let sizes = numbers.iter().map(|number| number.abs());
    sizes.fold(S::zero(), |most, size| most.select(size, size, most))
}

/// Corrects positions by so many steps of Newton's method, then velocities by two. `None` where an
/// equation of these coordinates is none of the bodies, so that its violation is not known.
pub fn projected<S: Scalar, M: Mechanism, C: TracedCoordinates<M>>(
    at: &AtTime<'_, S, M, C>,
    state: &mut C::State<S>,
    iterations: usize,
) -> Option<Projected<S>> {
    let mut least = S::one();
    let mut correction = |state: &C::State<S>, violation: &C::Multipliers<S>| {
        let mut lower = *violation;
        lower.as_mut_slice().iter_mut().for_each(|row| *row = -*row);
        let prepared = (at.own, at.coefficients);
        let (step, pivot) = C::moved_by(prepared, at.time, state, &Array::zeros(), &lower);
        least = least.min(pivot);
        step
    };
    for _ in 0..iterations {
        let [violation, _] = violations(at, state)?;
        let step = correction(state, &violation);
        let way = C::way(at.own, at.time, state, &step);
        *state = state.plus([(S::one(), &way)]);
        C::brought_to_normal_form(at.absolute, at.own, state);
    }
    for _ in 0..2 {
        let [_, violation] = violations(at, state)?;
        let step = correction(state, &violation);
        let velocities = state.rates_slice_mut().iter_mut();
        velocities
            .zip(step.as_slice())
            .for_each(|(velocity, &step)| *velocity = *velocity + step);
    }
    let [violation, rates] = violations(at, state)?;
    Some(Projected {
        violation: largest(violation.as_slice()),
        velocity_violation: largest(rates.as_slice()),
        pivot: least,
    })
}
