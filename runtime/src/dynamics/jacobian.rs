//! The Jacobian of the rates, by kernels over forward numbers.

use super::{Dynamics, as_read, coordinate_rates, stabilised, straight};
use crate::formulation::Formulation;
use crate::forward::{Forward, Lifted, by_forward_numbers, lifted, with_differences};
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::kernels::{Mechanism, Orientation, Stabilisation};
use crate::state::vector::{Array, StateParts, Vector};

impl<S, M, F, P, A> Dynamics<S, M, F, P, A>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    P: Orientation,
    A: AppliedForces<S, M>,
{
    /// Writes the columns of the Jacobian, and says how many there were. `None` where a derivative
    /// is not finite.
    pub(super) fn differentiated(
        &self,
        time: S,
        state: &M::State<S>,
        columns: &mut <M::State<S> as Vector<S>>::Each<M::State<S>>,
    ) -> Option<usize> {
        let constants: &M::Constants<Lifted<S>> = &lifted(&self.constants);
        let coefficients: &M::Coefficients<Lifted<S>> = &lifted(&self.coefficients);
        let at = Forward::fixed(time);
        let zeros = M::State::from_parts(Array::zeros(), Array::zeros());
        if !A::PRESENT {
            let multipliers = &mut Array::zeros();
            return by_forward_numbers(state, &zeros, columns, |state, rates, _| {
                let prepared = (constants, coefficients);
                straight::<Lifted<S>, M, F::Terms, P>(prepared, at, state, rates, multipliers);
            });
        }
        let Stabilisation { rate, position, .. } = self.stabilisation;
        let gains = [rate, position].map(Forward::fixed);
        let applied = |state: &M::State<S>| self.applied(time, &Self::read(state));
        let here = applied(state);
        by_forward_numbers(state, &zeros, columns, |lifted, rates, taken| {
            let read = &as_read::<_, M, P>(lifted);
            let (factors, _) = M::factor::<_, F::Terms>(constants, coefficients, at, read);
            let mut upper = M::forces(constants, at, read);
            let law: M::Velocities<Lifted<S>> = with_differences(state, taken, &here, applied);
            let forces = upper.as_mut_slice().iter_mut().zip(law.as_slice());
            forces.for_each(|(force, &more)| *force = *force + more);
            let lower = stabilised::<_, M, F::Terms>(constants, gains, at, read);
            let solution =
                M::solve::<_, F::Terms>(constants, coefficients, &factors, &upper, &lower);
            *rates.coordinates_mut() = coordinate_rates::<_, M, P>(constants, lifted, read);
            *rates.velocities_mut() = solution.0;
        })
    }
}
