//! What holds a mechanism where it is to be: inputs, parameters and rates as unknowns.

use nalgebra::SVector;

use super::balance::{Reached, longest, not_converged, row_sizes, solved, square};
use super::choice::Chosen;
use super::directions::chosen;
use super::equilibrium::{HALVINGS, STEPS};
use super::varied::{Adjusted, Varied};
use super::{IndependentCoordinates, Linearised};
use crate::error::{AnalysisFault, Fault};
use crate::math::scalar::Real;
use crate::mechanism::joint_rates::{HasInverse, HasMassMatrix};

/// The mechanism as a quantity has it: equations and rates.
pub(super) type Set<M, const N: usize, S> = (IndependentCoordinates<M, N, S>, SVector<S, N>);

/// A trim with its quantities set, and what is left of the accelerations.
pub(super) type Trial<M, const N: usize, S> = (Set<M, N, S>, Reached<M, N, S>);

impl<M, const N: usize, S> IndependentCoordinates<M, N, S>
where
    M: HasInverse + HasMassMatrix,
    S: Real,
{
    /// The equilibrium with some coordinates held where they are in `guess`: the state, and as many
    /// quantities that hold it there, in their order. The other coordinates are found as by
    /// [`IndependentCoordinates::equilibrium`].
    ///
    /// What is sought is a parameter or an input by its handle, or a rate by [`Varied::rate`]. The
    /// equations themselves stay: set what was found by [`IndependentCoordinates::set_value`].
    ///
    /// By Newton's method on exact derivatives, from the present values. Its steps are at most a
    /// radian or a length of the mechanism, and are halved until the efforts that are not balanced
    /// become smaller.
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// /// A rod on a hinge, and a motor there.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, inverse])]
    /// struct Lever {
    ///     #[input]
    ///     moment: f64,
    ///     #[body(mass = 2.0, inertia = [0.2, 0.2, 0.2], position = [0.0, 0.5, 0.0])]
    ///     rod: Body,
    ///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    ///     hinge: Revolute,
    ///     #[force(between = [ground, rod], axis = [1.0, 0.0, 0.0], moment = moment)]
    ///     motor: TorsionalActuator,
    /// }
    ///
    /// let (lever, h) = (Lever::default(), Lever::HANDLES);
    /// let space = lever.coordinates([h.hinge])?;
    /// let raised = space.state([0.7], [0.0])?;
    /// let (_, [moment]) = space.trim(&raised, [h.hinge], [h.moment])?;
    /// assert!((moment - 9.81 * 0.7_f64.cos()).abs() < 1e-13); // m g l cos(angle)
    /// # Ok::<(), Fault>(())
    /// ```
    ///
    /// # Errors
    /// - [`AnalysisFault::NotChosen`], [`AnalysisFault::ChosenTwice`]: no coordinate is held, or
    ///   one twice.
    /// - [`Fault::Parameter`]: it would be held by a parameter that no mechanism can have, such as
    ///   a negative mass.
    /// - [`AnalysisFault::NoEffect`]: a quantity that moves nothing which the other unknowns do
    ///   not.
    /// - [`StepFault::NotConverged`](crate::error::StepFault::NotConverged) with the largest
    ///   acceleration that is left (rad/s^2, m/s^2).
    /// - What [`IndependentCoordinates::equilibrium`] refuses.
    pub fn trim<const K: usize>(
        &self,
        guess: &M::JointState<S>,
        held: impl Chosen<M, K>,
        sought: [impl Into<Varied<M>>; K],
    ) -> Result<(M::JointState<S>, [S; K]), Fault> {
        let places = &self.equations.places;
        let mut numbers = [0; K];
        for (place, held) in held.places()?.into_iter().enumerate() {
            let number = chosen(&places[..], held)?;
            if numbers.iter().take(place).any(|&known| known == number) {
                return Err(AnalysisFault::ChosenTwice { joint: held.1 }.into());
            }
            numbers[place] = number;
        }
        let sought: [Varied<M>; K] = sought.map(Into::into);
        let mut adjusted = [Adjusted::Value(0); K];
        for (adjusted, sought) in adjusted.iter_mut().zip(&sought) {
            *adjusted = sought.adjusted(&places[..])?;
        }
        let tolerance = S::EPSILON.powf(0.75);
        let mut set = (*self, self.rates(guess));
        let mut here = (*guess, self.accelerations(guess)?);
        for taken in 0..STEPS {
            let ((space, rates), (state, left)) = (&set, &here);
            // Of efforts: those of inputs do not depend on how far from balance they are.
            let linear = space.efforts_by(state, &adjusted)?;
            let efforts = -space.bias(state)?;
            let values = adjusted.map(|of| space.present(of, rates));
            let mut scales = space.scales();
            let noise = space.noise(state, &linear.by_positions, &scales)?;
            let sizes = sizes(&linear, &scales, &noise);
            let floor = with_values(noise, &linear, &values);
            let mut matrix = linear.by_positions;
            for (place, &number) in numbers.iter().enumerate() {
                let column = linear.by_values.column(place);
                scales[number] = unit(column.iter(), &sizes).max(values[place].abs());
                matrix.set_column(number, &column);
            }
            let right: [S; N] = (-efforts).into();
            let found = solved(&matrix, [right], &scales, &sizes);
            let ([way], [unexplained]) = (found.ways, found.unexplained);
            let without = numbers.iter().position(|&number| !found.has_pivot[number]);
            let no_effect = without.map(|place| AnalysisFault::NoEffect {
                unknown: sought[place].name(),
            });
            // What is held stays; in its place are the steps of the quantities.
            let steps = numbers.map(|number| way[number]);
            let mut free = way;
            numbers.iter().for_each(|&number| free[number] = S::zero());
            let trial = |share: S| {
                trial(&set, state, &free.map(|way| way * share), |place| {
                    let (of, value) = (adjusted.get(place)?, values.get(place)?);
                    Some((*of, steps.get(place)?.fused(share, *value)))
                })
            };
            let mut explained = unexplained.iter().zip(floor);
            if longest(&way, &scales) <= tolerance
                && explained.all(|(off, floor)| off.abs() <= floor)
            {
                no_effect.map_or(Ok(()), Err)?;
                let (set, (state, _)) = trial(S::one()).unwrap_or((set, here));
                return held_by((set, state), &linear, &adjusted);
            }
            let before = square(&efforts, &sizes);
            let mut share = Real::max(longest(&free, &scales), S::one()).reciprocal();
            let mut next = None;
            for _ in 0..HALVINGS {
                let bound = before * (S::one() - share * S::constant(1e-4));
                next = trial(share).filter(|((space, _), (there, _))| {
                    let efforts = space.bias(there);
                    efforts.is_ok_and(|efforts| square(&efforts, &sizes) < bound)
                });
                if next.is_some() {
                    break;
                }
                share = share * S::constant(0.5);
            }
            // Of a way that round-off has led, nothing becomes smaller.
            let mut balanced = efforts.iter().zip(floor);
            if next.is_none() && balanced.all(|(left, floor)| left.abs() <= floor) {
                no_effect.map_or(Ok(()), Err)?;
                return held_by((set, here.0), &linear, &adjusted);
            }
            let Some(next) = next else {
                // What no mechanism can have is the cause where it is sought.
                for (place, &of) in adjusted.iter().enumerate() {
                    let value = steps[place] + values[place];
                    let (mut space, mut rates) = set;
                    space.adjust(of, value, &mut rates)?;
                }
                space.steady(state, &linear.by_positions, rates)?;
                return Err(no_effect.map_or_else(|| not_converged(taken, left), Fault::from));
            };
            (set, here) = next;
        }
        Err(not_converged(STEPS, &here.1))
    }
}

/// A state that was found, with what holds it there.
fn held_by<M, const N: usize, const K: usize, S>(
    ((space, rates), state): (Set<M, N, S>, M::JointState<S>),
    linear: &Linearised<N, K, 0, S>,
    adjusted: &[Adjusted; K],
) -> Result<(M::JointState<S>, [S; K]), Fault>
where
    M: HasInverse + HasMassMatrix,
    S: Real,
{
    space.off_jumps(&state)?;
    let state = space.steady(&state, &linear.by_positions, &rates)?;
    let state = space.within_limits(state)?;
    Ok((state, adjusted.map(|of| space.present(of, &rates))))
}

/// The state a way from another one, with quantities set.
pub(super) fn trial<M, const N: usize, S>(
    &(mut space, mut rates): &Set<M, N, S>,
    state: &M::JointState<S>,
    way: &[S; N],
    quantity: impl Fn(usize) -> Option<(Adjusted, S)>,
) -> Option<Trial<M, N, S>>
where
    M: HasInverse + HasMassMatrix,
    S: Real,
{
    for (of, value) in (0..).map_while(quantity) {
        space.adjust(of, value, &mut rates).ok()?;
    }
    let there = space.reached(state, way, &rates)?;
    Some(((space, rates), there))
}

/// How much each acceleration changes over a radian, or over a length of the mechanism; by a unit
/// of the values where it does not depend on positions, but for round-off.
pub(super) fn sizes<S: Real, const N: usize, const K: usize>(
    linear: &Linearised<N, K, 0, S>,
    scales: &[S; N],
    noise: &[S; N],
) -> [S; N] {
    let mut sizes = row_sizes(&linear.by_positions, scales);
    let rows = linear.by_values.row_iter().zip(noise);
    for (size, (row, &noise)) in sizes.iter_mut().zip(rows) {
        if *size <= noise {
            *size = row.iter().fold(S::zero(), |sum, entry| sum + entry.abs());
        }
    }
    sizes
}

/// The step of a value that does as much as a radian, or a length of the mechanism.
pub(super) fn unit<'a, S: Real>(column: impl Iterator<Item = &'a S>, sizes: &[S]) -> S {
    let shares = column.zip(sizes).filter(|(_, size)| **size > S::zero());
    let most = shares.fold(S::zero(), |most: S, (entry, &size)| {
        Real::max(most, entry.abs().quotient(size))
    });
    if most > S::zero() {
        most.reciprocal()
    } else {
        S::one()
    }
}

/// What round-off leaves of accelerations, with the share of values.
pub(super) fn with_values<S: Real, const N: usize, const K: usize>(
    mut floor: [S; N],
    linear: &Linearised<N, K, 0, S>,
    values: &[S; K],
) -> [S; N] {
    for (floor, row) in floor.iter_mut().zip(linear.by_values.row_iter()) {
        let parts = row.iter().zip(values);
        let sum = parts.fold(S::zero(), |sum, (entry, &value)| {
            (*entry * value).abs() + sum
        });
        *floor = *floor + sum * S::EPSILON * S::constant(100.0);
    }
    floor
}
