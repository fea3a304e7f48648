//! The Jacobian of the rates in joint coordinates, by kernels over forward numbers.

use super::{JointDynamics, add};
use crate::formulation::Formulation;
use crate::forward::{Forward, Lifted, by_forward_numbers, lifted, with_differences};
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::joint_kernels::{JointCoordinates, JointParts};
use crate::state::vector::{Array, Vector};

impl<S, M, F, A> JointDynamics<S, M, F, A>
where
    S: Real,
    M: JointCoordinates,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
{
    /// Writes the columns of the Jacobian, and says how many there were. `None` where a derivative
    /// is not finite.
    pub(super) fn differentiated(
        &self,
        time: S,
        state: &M::JointState<S>,
        columns: &mut <M::JointState<S> as Vector<S>>::Each<M::JointState<S>>,
    ) -> Option<usize> {
        let constants: &M::JointConstants<Lifted<S>> = &lifted(&self.constants);
        let coefficients: &M::JointCoefficients<Lifted<S>> = &lifted(&self.coefficients);
        let at = Forward::fixed(time);
        let applied = |state: &M::JointState<S>| self.bodies.applied(time, &self.bodies(state));
        let here = if A::PRESENT {
            applied(state)
        } else {
            Array::zeros()
        };
        let zeros = M::JointState::zeros();
        by_forward_numbers(state, &zeros, columns, |lifted, rates, taken| {
            M::joint_rates_into::<_, F::Terms>(constants, coefficients, at, lifted, rates);
            if A::PRESENT {
                let factors = M::factor_joints::<_, F::Terms>(constants, coefficients, at, lifted);
                let law = with_differences(state, taken, &here, applied);
                let (further, _) = M::solve_joints::<_, F::Terms>(
                    constants,
                    coefficients,
                    &factors,
                    &law,
                    &Array::zeros(),
                );
                add(rates.rates_slice_mut(), further.as_slice());
            }
        })
    }
}
