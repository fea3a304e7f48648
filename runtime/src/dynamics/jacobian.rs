//! The Jacobian of the rates, by a kernel of its own or by kernels over forward numbers.

use super::{Dynamics, Solvable};
use crate::formulation::Formulation;
use crate::forward::{Forward, Lifted, by_forward_numbers, lifted, with_differences};
use crate::math::scalar::Real;
use crate::mechanism::coordinates::{Coordinates, Prepared};
use crate::mechanism::kernels::{Mechanism, Stabilisation};
use crate::mechanism::orientations::with_unit_orientations;
use crate::state::vector::{Array, MovingState, Vector};

impl<P, S: Real, M: Mechanism, F: Formulation<S>, A, C: Coordinates<M>> Dynamics<P>
where
    P: Solvable<Number = S, Mechanism = M, Formulation = F, Forces = A, Coordinates = C>,
{
    /// Writes the columns of the Jacobian, and says how many there were. `None` where a derivative
    /// is not finite.
    pub(super) fn differentiated(
        &self,
        time: S,
        state: &C::State<S>,
        columns: &mut <C::State<S> as Vector<S>>::Each<C::State<S>>,
    ) -> Option<usize> {
        let equations = self.evaluator().equations;
        let (constants, coefficients) = (&equations.constants, &equations.coefficients);
        if !A::PRESENT
            && C::differentiated::<S, F::Terms>(constants, coefficients, time, state, columns)
        {
            let independent = (0..state.length()).filter(|&index| state.is_independent(index));
            let mut columns = independent.clone().map(|index| &columns[index]);
            return columns.all(Vector::is_finite).then(|| independent.count());
        }
        let constants: &C::Constants<Lifted<S>> = &lifted(&equations.constants);
        let coefficients: &C::Coefficients<Lifted<S>> = &lifted(&equations.coefficients);
        let at = Forward::fixed(time);
        let zeros = C::State::zeros();
        if !A::PRESENT {
            let multipliers = &mut Array::zeros();
            return by_forward_numbers(state, &zeros, columns, |state, rates, _| {
                C::rates_into::<Lifted<S>, F::Terms>(
                    constants,
                    coefficients,
                    at,
                    state,
                    rates,
                    multipliers,
                );
            });
        }
        let Stabilisation { rate, position, .. } = self.stabilisation;
        let gains = [rate, position].map(Forward::fixed);
        let applied = |state: &C::State<S>| {
            let bodies = self.bodies(state);
            self.applied(time, &with_unit_orientations::<S, M>(&bodies))
        };
        let here = applied(state);
        by_forward_numbers(state, &zeros, columns, |lifted, rates, taken| {
            let prepared = Prepared {
                constants,
                coefficients,
                gains,
            };
            let law = |_: &C::State<Lifted<S>>, forces: &mut M::Velocities<Lifted<S>>| {
                let law: M::Velocities<Lifted<S>> = with_differences(state, taken, &here, applied);
                let forces = forces.as_mut_slice().iter_mut().zip(law.as_slice());
                forces.for_each(|(force, &more)| *force = *force + more);
            };
            C::begin::<Lifted<S>, F::Terms, ()>(
                prepared,
                at,
                lifted,
                rates,
                Some(law),
                |first, rates| C::finish(constants, at, lifted, rates, first.accelerations),
            );
        })
    }
}
