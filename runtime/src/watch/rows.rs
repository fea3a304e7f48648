//! What the rows of `Phi` mean: lengths or angles, and how large the mechanism is.

use crate::access;
use crate::array::{Array, StateParts};
use crate::handle::BodyHandle;
use crate::mechanism::Mechanism;
use crate::report::BodyKind;
use crate::rotation::{minus, read, rotate};
use crate::scalar::{Real, Scalar};
use crate::view::square;

/// The factors by which rows of `Phi` become lengths (m) or angles (rad): one over the size of their gradients.
pub(crate) struct Rows<S: Scalar, M: Mechanism> {
    factors: M::Multipliers<S>,
    /// One where a row speaks of a length, zero where of an angle.
    lengths: M::Multipliers<S>,
}

impl<S: Scalar, M: Mechanism> Clone for Rows<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Scalar, M: Mechanism> Copy for Rows<S, M> {}

impl<S: Real, M: Mechanism> Rows<S, M> {
    /// By the Jacobian at a state: a row whose gradient knows translations is a length, others are angles.
    pub(crate) fn at(constants: &M::Constants<S>, time: S, state: &M::State<S>) -> Self {
        let jacobian = M::jacobian(constants, time, state);
        let mut translation = M::Multipliers::<S>::zeros();
        let mut rotation = M::Multipliers::<S>::zeros();
        for block in M::REPORT.blocks {
            let values = jacobian.as_slice().get(block.offset..).unwrap_or(&[]);
            let rows = values.chunks(block.columns.max(1)).take(block.rows);
            let sums = translation.as_mut_slice().iter_mut();
            let sums = sums.zip(rotation.as_mut_slice()).skip(block.row);
            for (row, (along, about)) in rows.zip(sums) {
                let (linear, angular) = row.split_at_checked(3).unwrap_or((row, &[]));
                *along = along.max(square(linear).sqrt());
                *about = about.max(square(angular).sqrt());
            }
        }
        let mut rows = Self {
            factors: translation,
            lengths: M::Multipliers::<S>::zeros(),
        };
        let factors = rows.factors.as_mut_slice().iter_mut();
        let places = factors.zip(rows.lengths.as_mut_slice());
        for ((factor, length), &about) in places.zip(rotation.as_slice()) {
            // What is left of a gradient of one kind where it is of the other is round-off.
            let is_length = *factor > S::constant(8.0) * S::EPSILON * about;
            *length = if is_length { S::one() } else { S::zero() };
            let size = if is_length { *factor } else { about };
            *factor = if size > S::zero() {
                size.reciprocal()
            } else {
                S::one()
            };
        }
        rows
    }

    pub(crate) fn factors(&self) -> &[S] {
        self.factors.as_slice()
    }

    pub(crate) fn is_length(&self, row: usize) -> bool {
        let length = self.lengths.as_slice().get(row);
        length.is_some_and(|&length| length > S::zero())
    }
}

/// The length of a mechanism (m): of the box around its centres of mass and the points of its joints, or its largest radius of gyration; 1 where
/// there is neither.
pub(crate) fn extent<S: Real, M: Mechanism>(constants: &M::Constants<S>, state: &M::State<S>) -> S {
    let mut corners: Option<[[S; 3]; 2]> = None;
    let mut add = |point: [S; 3]| {
        let [low, high] = corners.unwrap_or([point; 2]);
        let bound = |pick: fn(S, S) -> S, old: [S; 3]| {
            let [a, b, c] = old;
            let [x, y, z] = point;
            [pick(a, x), pick(b, y), pick(c, z)]
        };
        corners = Some([bound(S::min, low), bound(S::max, high)]);
    };
    let place = |body: usize, arm: [S; 3]| {
        let handle = BodyHandle::<M>::new(body);
        let centre: [S; 3] = access::position(state, handle);
        let arm = match handle.orientation() {
            Some((_, place)) => rotate(&read(state.coordinates().as_slice(), place), &arm),
            None => arm,
        };
        minus(&centre, &arm.map(|x| -x))
    };
    for body in 0..M::REPORT.bodies.len() {
        add(place(body, [S::zero(); 3]));
    }
    let joints = M::REPORT.joints.iter().enumerate();
    for (joint, info) in joints.filter(|(_, info)| info.has_point) {
        for (at, body) in info.bodies.iter().enumerate() {
            let point = M::joint_point(constants, joint, at);
            match body {
                Some(body) => add(place(*body, point)),
                None => add(point),
            }
        }
    }
    let mut length = corners.map_or(S::zero(), |[low, high]| square(&minus(&high, &low)).sqrt());
    let mass = M::mass(constants);
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let [m, _, _, a, b, c] = read(mass.as_slice(), body.velocity);
            length = length.max(a.max(b).max(c).quotient(m).sqrt());
        }
    }
    if length > S::zero() && length.is_finite() {
        length
    } else {
        S::one()
    }
}
