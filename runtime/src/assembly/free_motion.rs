//! The motion that a joint leaves free, as its axis, its direction and its point.
//!
//! They are read from the joint itself: its readings are linear in the velocities, and its rows
//! tell whether it leaves the motion free.

use crate::assembly::subtree::{Subtree, Twist, moving, orientation_of, plus};
use crate::constraints::extent::farthest;
use crate::error::Fault;
use crate::math::quaternion::rotate;
use crate::math::scalar::Real;
use crate::math::vec3::{read, square, write};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::Block;
use crate::state::vector::{Array, StateParts};

/// A row may change by so much of what its terms would make of it, if a motion is one that the
/// joint leaves free.
pub(super) const FREE: f64 = 1e-3;

impl<S: Real, M: Mechanism> Subtree<'_, S, M> {
    /// What a reading of velocities is per unit of the carried body's, from a place of these on.
    fn gradient(&self, offset: usize, rate: impl Fn(&M::State<S>) -> S) -> [S; 3] {
        let mut state = self.state;
        *state.velocities_mut() = Array::zeros();
        let at_rest = rate(&state);
        let body = M::REPORT.bodies.get(self.body);
        let first = body.map_or(usize::MAX, |body| body.velocity + offset);
        let along = |k| {
            let mut state = state;
            write(
                state.velocities_mut().as_mut_slice(),
                first.saturating_add(k),
                [S::one()],
            );
            rate(&state) - at_rest
        };
        [along(0), along(1), along(2)]
    }

    /// A turn about the joint's axis, by one radian of its angle; of a screw with its translation.
    pub(super) fn axis(&self) -> Result<Twist<S>, Fault> {
        let rate = |state: &M::State<S>| M::joint_angle(self.constants, state, self.joint).rate;
        let axis = self.gradient(3, rate);
        let length = square(&axis).sqrt();
        if length <= S::zero() {
            return Err(self.holds());
        }
        let axis = axis.map(|x| x.quotient(length));
        let p = orientation_of::<S, M>(&self.state, Some(self.body));
        let turn = rotate(&p, &axis);
        match self.centre(&[turn]) {
            Ok(point) => Ok(Twist {
                turn,
                point,
                slide: [S::zero(); 3],
            }),
            Err(fault) => self.screw(&turn).ok_or(fault),
        }
    }

    /// A translation along the joint's direction, by one metre of its displacement; of a screw with
    /// its turn.
    pub(super) fn direction(&self) -> Result<Twist<S>, Fault> {
        let rate = |state: &M::State<S>| {
            M::joint_displacement(self.constants, S::zero(), state, self.joint).rate
        };
        let slide = self.gradient(0, rate);
        let length = square(&slide);
        let twist = Twist {
            turn: [S::zero(); 3],
            point: [S::zero(); 3],
            slide: slide.map(|x| x.quotient(length)),
        };
        if length > S::zero() && self.is_free(&twist) {
            return Ok(twist);
        }
        let screw = self.screw(&slide.map(|x| x.quotient(length.sqrt())));
        let screw = screw.ok_or_else(|| self.holds())?;
        let advance = dot(&screw.slide, &slide);
        if advance.abs() > S::zero() {
            Ok(screw.scaled(advance.reciprocal()))
        } else {
            Err(self.holds())
        }
    }

    /// A turn about an axis with the translation along it that the rows demand; `None` where they
    /// leave none free.
    fn screw(&self, axis: &[S; 3]) -> Option<Twist<S>> {
        let zero = [S::zero(); 3];
        let mut points = self.points();
        points.find_map(|point| {
            let twist = |turn, slide| Twist { turn, point, slide };
            let turning = self.along_rows(&twist(*axis, zero));
            let sliding = self.along_rows(&twist(zero, *axis));
            let size = |along: S| along.abs();
            let rows = turning.map(|x| x.0).zip(sliding.map(|x| x.0));
            // Of all rows, the one that the translation changes most.
            let best = rows.fold((S::zero(), S::zero()), |best, row| {
                if size(row.1) > size(best.1) {
                    row
                } else {
                    best
                }
            });
            let (turned, slid) = best;
            let advance = -turned.quotient(slid);
            let screw = twist(*axis, axis.map(|x| x * advance));
            (size(slid) > S::zero() && self.is_free(&screw)).then_some(screw)
        })
    }

    /// The point of the joint about which it leaves turns free: that on the carried body or, where
    /// the body slides on it, that on the other one.
    pub(super) fn centre(&self, turns: &[[S; 3]]) -> Result<[S; 3], Fault> {
        let mut points = self.points();
        let centre = points.find(|&point| {
            let about = |&turn: &[S; 3]| Twist {
                turn,
                point,
                slide: [S::zero(); 3],
            };
            turns.iter().all(|turn| self.is_free(&about(turn)))
        });
        centre.ok_or_else(|| self.holds())
    }

    /// The point of the joint on the carried body, then that on the other one.
    fn points(&self) -> impl Iterator<Item = [S; 3]> + '_ {
        let places = self.info.bodies.iter().enumerate();
        let own = |body: &Option<usize>| *body == Some(self.body);
        let sorted = places
            .clone()
            .filter(move |(_, body)| own(body))
            .chain(places.filter(move |(_, body)| !own(body)));
        sorted.map(|(place, &body)| {
            let arm = M::joint_point(self.constants, self.joint, place);
            let at = moving::<S, M>(&self.state, body).position;
            let arm = rotate(&orientation_of::<S, M>(&self.state, body), &arm);
            plus(&at, &arm)
        })
    }

    /// Whether the rows of the joint let its bodies move so.
    fn is_free(&self, twist: &Twist<S>) -> bool {
        let mut rows = self.along_rows(twist);
        rows.all(|(along, size)| along.abs() <= S::constant(FREE) * size)
    }

    /// What a motion changes of every row of the joint, and the sum of the sizes of its terms.
    fn along_rows(&self, twist: &Twist<S>) -> impl Iterator<Item = (S, S)> + use<S, M> {
        let mut state = self.state;
        *state.velocities_mut() = Array::zeros();
        self.add_to(&mut state, twist);
        let jacobian = M::jacobian(self.constants, S::zero(), &self.state);
        let arm = self.round_off_of_arms();
        let (first, rows) = (self.info.row, self.info.rows);
        (first..first + rows).map(move |row| {
            let velocities = state.velocities().as_slice();
            let (mut sum, mut size) = (S::zero(), S::zero());
            let own = |block: &&Block| (block.row..block.row + block.rows).contains(&row);
            for block in M::REPORT.blocks.iter().filter(own) {
                let start = block.offset + (row - block.row) * block.columns;
                let part = |slice: &[S], place: usize, is_there: bool| -> [S; 3] {
                    if is_there {
                        read(slice, place)
                    } else {
                        [S::zero(); 3]
                    }
                };
                let turns = block.columns > 3;
                let force = part(jacobian.as_slice(), start, true);
                let moment = part(jacobian.as_slice(), start + 3, turns);
                let slide = part(velocities, block.column, true);
                let turn = part(velocities, block.column + 3, turns);
                sum = sum + dot(&force, &slide) + dot(&moment, &turn);
                let (force, moment) = (square(&force).sqrt(), square(&moment).sqrt());
                let (slide, turn) = (square(&slide).sqrt(), square(&turn).sqrt());
                size = size + force * (slide + arm * turn) + moment * turn;
            }
            (sum, size)
        })
    }

    /// What arms lose by round-off, generously: a row may take a motion that far from the joint for
    /// one that it forbids.
    fn round_off_of_arms(&self) -> S {
        let places = 0..self.info.bodies.len();
        let points = places.map(|place| M::joint_point(self.constants, self.joint, place));
        let arms = points.map(|point| square(&point).sqrt());
        let positions = self.state.coordinates().as_slice();
        let extent = arms.fold(farthest(M::REPORT.bodies, positions), S::max);
        S::EPSILON.sqrt() * extent
    }
}

fn dot<S: Real>(a: &[S; 3], b: &[S; 3]) -> S {
    let pairs = a.iter().zip(b);
    pairs.fold(S::zero(), |sum, (&a, &b)| a.fused(b, sum))
}
