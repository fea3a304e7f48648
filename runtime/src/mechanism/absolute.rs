//! Absolute coordinates, by the kernels of a mechanism.

use crate::error::StepFault;
use crate::math::quaternion::scale_near_unit_length;
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{read, write};
use crate::mechanism::coordinates::{
    Absolute, AbsoluteEquations, ByAllRows, Coordinates, EquationsIn, First, Prepared, RightSide,
};
use crate::mechanism::kernels::{Mechanism, Orientation, Pivot, Stabilisation, Terms};
use crate::mechanism::orientations::{
    bring_to_unit_length, check_state, norm_drift, scale_euler_rates, with_unit_orientations,
};
use crate::mechanism::report::BodyKind;
use crate::state::sealed::Sealed;
use crate::state::vector::{Array, MovingState, StateParts, Vector};

impl<P> Sealed for Absolute<P> {}

impl<M: Mechanism, P: Orientation> Coordinates<M> for Absolute<P> {
    type State<S: Scalar> = M::State<S>;
    type Velocities<S: Scalar> = M::Velocities<S>;
    type Multipliers<S: Scalar> = M::Multipliers<S>;
    type Constants<S: Scalar> = M::Constants<S>;
    type Coefficients<S: Scalar> = M::Coefficients<S>;
    type Factors<S: Scalar> = M::Factors<S>;
    type Own<S: Scalar> = ();
    type Orientation = P;

    const IS_RELATIVE: bool = false;
    const HAS_PIVOTS: bool = M::REPORT.equations > 0;
    const HAS_LINEAR_PIVOTS: bool = false;

    #[inline(always)]
    fn equations<'e, S: Scalar>(
        absolute: &'e AbsoluteEquations<S, M>,
        (): &'e (),
    ) -> &'e EquationsIn<S, M, Self> {
        absolute
    }

    fn own<S: Scalar>(
        _parameters: &M::Parameters<S>,
        _stabilisation: &Stabilisation<S>,
        _absolute: &AbsoluteEquations<S, M>,
    ) {
        const {
            assert!(
                M::WITHOUT_INERTIA.is_empty(),
                "a body is `as_given` with a mass or a moment of inertia that is not positive: the mechanism moves by its joints alone"
            );
        }
    }

    #[inline(always)]
    fn take_inputs<S: Scalar>(_parameters: &M::Parameters<S>, (): &mut ()) {}

    fn differentiated<S: Real, T: Terms>(
        constants: &M::Constants<S>,
        coefficients: &M::Coefficients<S>,
        time: S,
        state: &M::State<S>,
        columns: &mut <M::State<S> as Vector<S>>::Each<M::State<S>>,
    ) -> bool {
        if const { !M::HAS_RATE_COLUMNS || P::NORMALISED_RATES } {
            return false;
        }
        M::rate_columns::<S, T>(constants, coefficients, time, state, |number, column| {
            columns[number] = column;
        });
        true
    }

    #[inline(always)]
    fn evaluate_into<S: Scalar, T: Terms>(
        constants: &M::Constants<S>,
        coefficients: &M::Coefficients<S>,
        time: S,
        state: &M::State<S>,
        rates: &mut M::State<S>,
        multipliers: &mut M::Multipliers<S>,
    ) -> Pivot<S> {
        let pivot =
            M::evaluate_into::<S, T>(constants, coefficients, time, state, rates, multipliers);
        if P::NORMALISED_RATES {
            scale_euler_rates::<S, M>(rates.coordinates_mut(), state, |length| length.reciprocal());
        }
        pivot
    }

    #[inline(always)]
    fn begin<S: Scalar, T: Terms, R>(
        prepared: Prepared<'_, S, M, Self>,
        time: S,
        state: &M::State<S>,
        rates: &mut M::State<S>,
        law: Option<impl FnOnce(&M::State<S>, &mut M::Velocities<S>)>,
        then: impl FnOnce(&First<'_, S, M, Self>, &mut M::State<S>) -> R,
    ) -> R {
        let Prepared {
            constants,
            coefficients,
            gains,
        } = prepared;
        // In the place of the rates, which are as long: the stack of a controller is short.
        *rates = with_unit_orientations::<S, M>(state);
        let read = &*rates;
        let (factors, pivot) = M::factor::<S, T>(constants, coefficients, time, read);
        let mut upper = M::forces(constants, time, read);
        if let Some(law) = law {
            law(read, &mut upper);
        }
        let lower = stabilised::<S, M, T>(constants, gains, time, read);
        let (accelerations, multipliers) =
            M::solve::<S, T>(constants, coefficients, &factors, &upper, &lower);
        let first = First {
            factors: &factors,
            right: (&upper, &lower),
            pivot,
            accelerations: &accelerations,
            multipliers: &multipliers,
        };
        then(&first, rates)
    }

    #[inline(always)]
    fn as_read<'s, S: Scalar>(_state: &'s M::State<S>, rates: &'s M::State<S>) -> &'s M::State<S> {
        rates
    }

    #[inline(always)]
    fn solve_after<S: Scalar, T: Terms>(
        (constants, coefficients): (&M::Constants<S>, &M::Coefficients<S>),
        factors: &M::Factors<S>,
        (upper, lower): RightSide<'_, S, M, Self>,
        yielded: &M::Multipliers<S>,
    ) -> (M::Velocities<S>, M::Multipliers<S>) {
        let mut lower = *lower;
        let rows = lower.as_mut_slice().iter_mut().zip(yielded.as_slice());
        rows.for_each(|(row, &yielded)| *row = *row - yielded);
        M::solve::<S, T>(constants, coefficients, factors, upper, &lower)
    }

    fn solve_loads<S: Scalar, T: Terms, R>(
        (constants, coefficients): (&M::Constants<S>, &M::Coefficients<S>),
        factors: &M::Factors<S>,
        loads: &M::Velocities<S>,
        then: impl FnOnce(RightSide<'_, S, M, Self>, (M::Velocities<S>, M::Multipliers<S>)) -> R,
    ) -> R {
        let lower = Array::zeros();
        let solution = M::solve::<S, T>(constants, coefficients, factors, loads, &lower);
        then((loads, &lower), solution)
    }

    #[inline(always)]
    fn finish<S: Scalar>(
        constants: &M::Constants<S>,
        time: S,
        state: &M::State<S>,
        rates: &mut M::State<S>,
        accelerations: &M::Velocities<S>,
    ) {
        *rates.coordinates_mut() = coordinate_rates::<S, M, P>(constants, time, (state, rates));
        *rates.velocities_mut() = *accelerations;
    }

    fn way<S: Scalar>(
        constants: &M::Constants<S>,
        _time: S,
        state: &M::State<S>,
        velocities: &M::Velocities<S>,
    ) -> M::State<S> {
        let mut read = with_unit_orientations::<S, M>(state);
        *read.velocities_mut() = *velocities;
        let rates = rates_of_motion::<S, M, P>(constants, (state, &read));
        M::State::from_parts(rates, Array::zeros())
    }

    #[inline]
    fn with_new_velocities<S: Scalar>(
        constants: &M::Constants<S>,
        time: S,
        state: &M::State<S>,
        step: S,
        rates: &mut M::State<S>,
    ) {
        let mut end = with_unit_orientations::<S, M>(state);
        let velocities = end.rates_slice_mut().iter_mut();
        for (velocity, &rate) in velocities.zip(rates.rates_slice()) {
            *velocity = rate.fused(step, *velocity);
        }
        *rates.coordinates_mut() = coordinate_rates::<S, M, P>(constants, time, (state, &end));
    }

    #[inline]
    fn normalise<S: Real>(
        absolute: &AbsoluteEquations<S, M>,
        _constants: &M::Constants<S>,
        state: &mut M::State<S>,
        rates: Option<&mut M::State<S>>,
    ) -> Option<S> {
        let norm_drift = if P::NORMALISED_RATES {
            norm_drift::<S, M>(state)
        } else {
            bring_to_unit_length::<S, M>(state, rates)
        };
        M::rewrap(&absolute.constants, state);
        Some(norm_drift)
    }

    #[inline(always)]
    fn normalise_near<S: Scalar>(state: &mut M::State<S>) -> bool {
        if M::REPORT.auxiliaries > 0 {
            return false;
        }
        let mut unit = *state;
        for body in M::REPORT.bodies {
            if body.kind == BodyKind::Rigid && !P::NORMALISED_RATES {
                let coordinates = unit.coordinates_mut().as_mut_slice();
                if scale_near_unit_length(coordinates, body.coordinate + 3).is_none() {
                    return false;
                }
            }
        }
        *state = unit;
        true
    }

    #[inline(always)]
    fn with_bodies<S: Real, R>(
        _constants: &M::Constants<S>,
        state: &M::State<S>,
        then: impl FnOnce(&M::State<S>) -> R,
    ) -> R {
        then(state)
    }

    #[inline(always)]
    fn bodies<S: Real>(_constants: &M::Constants<S>, state: &M::State<S>) -> M::State<S> {
        *state
    }

    #[inline(always)]
    fn bodies_near<S: Real>(
        _constants: &M::Constants<S>,
        state: &M::State<S>,
        _near: &M::State<S>,
    ) -> M::State<S> {
        *state
    }

    #[inline(always)]
    fn of_bodies<S: Real>(_constants: &M::Constants<S>, bodies: &M::State<S>) -> M::State<S> {
        *bodies
    }

    fn of_bodies_near<S: Real>(
        _constants: &M::Constants<S>,
        bodies: &M::State<S>,
        near: &M::State<S>,
    ) -> M::State<S> {
        with_nearer_signs::<S, M>(*bodies, near)
    }

    fn check<S: Real>(state: &M::State<S>) -> Result<(), StepFault> {
        check_state::<S, M>(state)
    }

    fn body_of_velocity(place: usize) -> Option<&'static str> {
        let mut bodies = M::REPORT.bodies.iter().rev();
        bodies
            .find(|body| body.velocity <= place)
            .map(|body| body.name)
    }

    fn joint_of_row(row: usize) -> Option<&'static str> {
        M::REPORT.joint_of(row)
    }

    fn row_of_all(row: usize) -> Option<usize> {
        Some(row)
    }

    fn keeps_equations(_joint: &str) -> bool {
        true
    }

    #[inline(always)]
    fn by_all_rows<'s, S: Scalar>(
        constants: &'s M::Constants<S>,
        state: &'s M::State<S>,
        (upper, lower): RightSide<'s, S, M, Self>,
        accelerations: &'s M::Velocities<S>,
        multipliers: &'s M::Multipliers<S>,
    ) -> Option<ByAllRows<'s, S, M>> {
        Some(ByAllRows {
            constants,
            state,
            upper,
            lower,
            accelerations,
            multipliers,
        })
    }
}

/// The rates of the coordinates of a state, from the state as the kernels read it.
#[inline]
fn coordinate_rates<S: Scalar, M: Mechanism, P: Orientation>(
    constants: &M::Constants<S>,
    time: S,
    (state, read): (&M::State<S>, &M::State<S>),
) -> <M::State<S> as StateParts<S>>::Coordinates {
    let mut rates = rates_of_motion::<S, M, P>(constants, (state, read));
    M::state_rates_into(constants, time, read, &mut rates);
    rates
}

/// The same by the velocities alone: zeros for the user's own states.
#[inline]
fn rates_of_motion<S: Scalar, M: Mechanism, P: Orientation>(
    constants: &M::Constants<S>,
    (state, read): (&M::State<S>, &M::State<S>),
) -> <M::State<S> as StateParts<S>>::Coordinates {
    let mut rates = M::coordinate_rates(constants, read);
    if !P::NORMALISED_RATES {
        scale_euler_rates::<S, M>(&mut rates, state, |length| length);
    }
    rates
}

/// `gamma* = gamma - r Phi' - p Phi` with the gains `r` and `p`, where the terms have them.
pub(crate) fn stabilised<S: Scalar, M: Mechanism, T: Terms>(
    constants: &M::Constants<S>,
    [rate, position]: [S; 2],
    time: S,
    state: &M::State<S>,
) -> M::Multipliers<S> {
    let mut gamma = M::gamma(constants, time, state);
    if T::STABILISED {
        let phi = M::constraints(constants, time, state);
        let phi_rate = M::constraint_rates(constants, time, state);
        let terms = phi.as_slice().iter().zip(phi_rate.as_slice());
        for (gamma, (&phi, &phi_rate)) in gamma.as_mut_slice().iter_mut().zip(terms) {
            *gamma = *gamma - (rate * phi_rate + position * phi);
        }
    }
    gamma
}

/// Euler parameters with the sign that is nearer to others.
#[inline]
pub(super) fn nearer_sign<S: Real>(p: [S; 4], near: &[S; 4]) -> [S; 4] {
    let terms = p.iter().zip(near);
    let alike = terms.fold(S::zero(), |sum, (&p, &q)| p.fused(q, sum));
    if alike < S::zero() {
        p.map(|element| -element)
    } else {
        p
    }
}

/// Gives the Euler parameters at a place the sign of those of another state.
pub(super) fn take_nearer_sign<S: Real>(coordinates: &mut [S], near: &[S], place: usize) {
    let p = nearer_sign(read(coordinates, place), &read(near, place));
    write(coordinates, place, p);
}

/// Bodies with those signs of Euler parameters that are nearer to those of another state.
fn with_nearer_signs<S: Real, M: Mechanism>(
    mut bodies: M::State<S>,
    near: &M::State<S>,
) -> M::State<S> {
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let place = body.coordinate + 3;
            let coordinates = bodies.coordinates_mut().as_mut_slice();
            take_nearer_sign(coordinates, near.coordinates().as_slice(), place);
        }
    }
    bodies
}
