//! The classical Runge-Kutta method.

use super::{
    ErrorModel, Look, NoStages, OneStep, Scheme, Slopes, StepStart, System, Tableau, room_for,
};
use crate::error::Fault;
use crate::math::scalar::Scalar;
use crate::state::vector::Vector;

/// The classical Runge-Kutta method of order 4: four evaluations a step, no estimate of the error.
///
/// Kutta 1901; Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, table
/// II.1.2. Output within a step is by the cubic through states and slopes at both ends.
///
/// A step of Euler parameters at a constant angular velocity `w` multiplies `|p|^2` by
/// `1 - z^6/72 + z^8/576` with `z = |w| h / 2`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rk4;

impl<S: Scalar> Scheme<S> for Rk4 {
    type Stages<X: Vector<S>> = NoStages;

    fn stages<X: Vector<S>>(&self, _like: &X) -> NoStages {
        NoStages
    }

    fn tableau(&self) -> Option<Tableau> {
        Some(Tableau {
            stages: &[&[(0, 0.5)], &[(1, 0.5)], &[(2, 1.0)]],
            result: &[
                (0, 1.0 / 6.0),
                (1, 1.0 / 3.0),
                (2, 1.0 / 3.0),
                (3, 1.0 / 6.0),
            ],
        })
    }

    /// For short steps the ratio of `z^5 / 60`, by which an angle is off after a step of twice `z`,
    /// and `z^6 / 144`, by which `|p|` is.
    fn error_model(&self) -> ErrorModel {
        ErrorModel {
            angle_error_of_short_steps: 2.4,
            ..Default::default()
        }
    }
}

impl<S: Scalar, Y: System<S>> OneStep<S, Y> for Rk4 {
    #[inline]
    fn advanced<L: Look<S, Y::State>>(
        &self,
        system: &mut Slopes<'_, Y, L>,
        start: StepStart<'_, S, Y::State>,
        step: S,
        _stages: &mut NoStages,
    ) -> Result<Y::State, Fault> {
        let StepStart {
            time,
            state,
            slope: first,
        } = start;
        let half = S::constant(0.5) * step;
        let sixth = S::constant(1.0 / 6.0) * step;
        let third = sixth + sixth;
        if Y::State::PLUS_IS_COSTLY {
            let (mut second, mut penultimate) = (room_for(state), room_for(state));
            let mut last = room_for(state);
            if !S::IS_WIDE {
                let [midway, end] = state.plus_once_and_twice(half, first);
                system.stage(time + half, &midway, &mut second)?;
                let at = state.plus_beside(&midway, (half, first), [(half, &second)]);
                system.stage(time + half, &at, &mut penultimate)?;
                let at = state.plus_beside(&end, (step, first), [(step, &penultimate)]);
                system.stage(time + step, &at, &mut last)?;
                let terms = [
                    (sixth, first),
                    (third, &second),
                    (third, &penultimate),
                    (sixth, &last),
                ];
                return Ok(state.plus_beside(&end, (step, first), terms));
            }
            // States of such numbers are large: each is written where it belongs.
            let (mut at, mut midway, mut end) = (room_for(state), room_for(state), room_for(state));
            midway.set_plus_once_and_twice(&mut end, state, (half, first));
            system.stage(time + half, &midway, &mut second)?;
            at.set_plus_beside((state, &midway), (half, first), [(half, &second)]);
            system.stage(time + half, &at, &mut penultimate)?;
            at.set_plus_beside((state, &end), (step, first), [(step, &penultimate)]);
            system.stage(time + step, &at, &mut last)?;
            let terms = [
                (sixth, first),
                (third, &second),
                (third, &penultimate),
                (sixth, &last),
            ];
            at.set_plus_beside((state, &end), (step, first), terms);
            return Ok(at);
        }
        let mut slope = room_for(state);
        let mut next = state.plus([(sixth, first)]);
        let mut at = state.plus([(half, first)]);
        system.stage(time + half, &at, &mut slope)?;
        next = next.plus([(third, &slope)]);
        at = state.plus([(half, &slope)]);
        system.stage(time + half, &at, &mut slope)?;
        next = next.plus([(third, &slope)]);
        at = state.plus([(step, &slope)]);
        system.stage(time + step, &at, &mut slope)?;
        Ok(next.plus([(sixth, &slope)]))
    }
}
