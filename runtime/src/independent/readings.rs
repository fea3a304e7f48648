//! Bodies along chosen coordinates and rates, for readings: by the kernel that
//! `kernels = [derivatives]` asks for.

use super::IndependentCoordinates;
use super::derived::Derived;
use super::directions::Along;
use super::partition::Partition;
use crate::forward::{Forward, lifted};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::read;
use crate::mechanism::joint_rates::JointRates;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts, Vector as _};

/// The bodies at a state, what their motions change by, and how rates follow where loops close.
pub(super) struct Moving<'d, M: JointRates, const N: usize, S: Scalar> {
    numbers: M::MotionsAlong<S>,
    bodies: M::State<S>,
    derived: &'d Derived<M, N, S>,
    following: Option<&'d Partition<M, N, S>>,
}

impl<'d, M: JointRates, const N: usize, S: Real> Moving<'d, M, N, S> {
    pub(super) fn new(
        space: &IndependentCoordinates<M, N, S>,
        state: &M::JointState<S>,
        derived: &'d Derived<M, N, S>,
        following: Option<&'d Partition<M, N, S>>,
    ) -> Self {
        let equations = &space.equations;
        Self {
            numbers: M::motions_along(&equations.constants, equations.time, state),
            bodies: space.bodies(state),
            derived,
            following,
        }
    }

    /// The bodies along some directions, none of which is a value.
    pub(super) fn along<const K: usize>(
        &self,
        directions: &[Option<Along>; K],
    ) -> M::State<Forward<S, K>> {
        let here = &self.bodies;
        let mut there = M::State::<Forward<S, K>>::from_parts(
            lifted(here.coordinates()),
            lifted(here.velocities()),
        );
        let counted = there.turns_mut().iter_mut().zip(here.turns());
        counted.for_each(|(place, &number)| *place = Forward::fixed(number));
        for (lane, direction) in directions.iter().enumerate() {
            let Some(direction) = *direction else {
                continue;
            };
            let [displacement, rates] = self.derived.changes(self.following, direction);
            let [displaced, changed] = self.changes(&displacement, &rates);
            self.count(&displacement, lane, &mut there);
            self.put([displaced.as_slice(), changed.as_slice()], lane, &mut there);
        }
        there
    }

    /// How bodies are displaced, and what their velocities change by, where positions and rates of
    /// the joints change like this.
    fn changes(
        &self,
        displacement: &M::JointVelocities<S>,
        rates: &M::JointVelocities<S>,
    ) -> [M::Velocities<S>; 2] {
        let [mut displaced, mut changed] = [M::Velocities::<S>::zeros(); 2];
        let (height, count) = (displaced.as_slice().len(), rates.as_slice().len());
        let pairs = displacement.as_slice().iter().zip(rates.as_slice());
        for (place, (&displacement, &rate)) in pairs.enumerate() {
            let along_rate = self.block(height * place, height);
            if rate != S::zero() {
                add(changed.as_mut_slice(), rate, along_rate);
            }
            if displacement != S::zero() {
                let along_position = self.block(height * (count + place), height);
                add(displaced.as_mut_slice(), displacement, along_rate);
                add(changed.as_mut_slice(), displacement, along_position);
            }
        }
        [displaced, changed]
    }

    /// Writes what the auxiliary variables change by along a displacement.
    fn count<const K: usize>(
        &self,
        displacement: &M::JointVelocities<S>,
        lane: usize,
        there: &mut M::State<Forward<S, K>>,
    ) {
        let (count, counters) = (displacement.as_slice().len(), M::REPORT.auxiliaries);
        let first = 2 * count * there.velocities().as_slice().len();
        let counted = there.coordinates_mut().as_mut_slice();
        for (place, &displacement) in displacement.as_slice().iter().enumerate() {
            let changes = self.block(first + counters * place, counters);
            let counted = counted.iter_mut().skip(M::REPORT.coordinates);
            for (counted, &change) in counted.zip(changes) {
                if let Some(slope) = counted.derivative_mut(lane) {
                    *slope = change.fused(displacement, *slope);
                }
            }
        }
    }

    /// Writes displacements and changes of velocities as derivatives.
    fn put<const K: usize>(
        &self,
        [displaced, changed]: [&[S]; 2],
        lane: usize,
        there: &mut M::State<Forward<S, K>>,
    ) {
        let write = |numbers: &mut [Forward<S, K>], first: usize, slopes: &[S]| {
            for (number, &slope) in numbers.iter_mut().skip(first).zip(slopes) {
                if let Some(place) = number.derivative_mut(lane) {
                    *place = slope;
                }
            }
        };
        write(there.velocities_mut().as_mut_slice(), 0, changed);
        let here = self.bodies.coordinates().as_slice();
        let coordinates = there.coordinates_mut().as_mut_slice();
        for body in M::REPORT.bodies {
            let moved: [S; 3] = read(displaced, body.velocity);
            write(coordinates, body.coordinate, &moved);
            if body.kind == BodyKind::Rigid {
                let turned = turned(
                    read(here, body.coordinate + 3),
                    read(displaced, body.velocity + 3),
                );
                write(coordinates, body.coordinate + 3, &turned);
            }
        }
    }

    fn block(&self, first: usize, length: usize) -> &[S] {
        let numbers = self.numbers.as_slice();
        numbers.get(first..first + length).unwrap_or(&[])
    }
}

/// What Euler parameters change by with a small turn in principal axes: `p (0, w) / 2`.
fn turned<S: Scalar>([a, b, c, d]: [S; 4], turn: [S; 3]) -> [S; 4] {
    let [x, y, z] = turn.map(|component| component * S::constant(0.5));
    [
        -(b.fused(x, c.fused(y, d * z))),
        a.fused(x, c.fused(z, -(d * y))),
        a.fused(y, d.fused(x, -(b * z))),
        a.fused(z, b.fused(y, -(c * x))),
    ]
}

/// Adds a number times others.
fn add<S: Scalar>(sum: &mut [S], factor: S, more: &[S]) {
    let places = sum.iter_mut().zip(more);
    places.for_each(|(place, &more)| *place = more.fused(factor, *place));
}
