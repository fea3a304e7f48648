//! How long the gradients of the equations were over a run.
//!
//! A look costs the Jacobian, and is due where a gradient may have vanished since the last one:
//! seldom, where gradients have not changed over some turns. Such looks are not part of a run's
//! count. Only it finds a shaft on a `ConstantVelocity` joint that comes to point against the
//! other: `tests/tests/sweeps/gradients.rs`.
//!
//! A pivot is compared with its own row, so it does not tell where the row itself vanishes. Lengths
//! of gradients are followed for that. Translational and rotational parts must vanish together,
//! since arms may grow; of a vector equation, what its rows span counts.

use super::record::{MonitoredStep, RunFacts};
use super::singular::Approach;
use super::warning::Warning;
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::square;
use crate::math::vec3::{read, write};
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::Block;
use crate::state::vector::Array;

/// The shortest gradient of an equation over a run.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ShortestGradient<S> {
    /// Its length over its largest, by translations or by rotations, whichever is left more of; of
    /// a vector equation of all its rows, or what one has beside the others.
    pub relative: S,
    /// The joint's field.
    pub joint: &'static str,
    /// When (s).
    pub time: S,
}

/// Squares of the lengths of the rows of `D`: of what acts on translations (m), and of what acts on
/// rotations (rad).
///
/// Of a vector equation, whose rows say nothing one by one, the places of its rows hold the sum of
/// the squares, and what is left of the second and third where one row, or two, are combinations of
/// the others.
type Lengths<S, M> = [<M as Mechanism>::Multipliers<S>; 2];

/// Where a gradient vanishes, its equation leaves open which way a motion goes on, as where
/// equations depend on each other.
pub(super) struct Gradients<S: Scalar, M: Mechanism> {
    first: Lengths<S, M>,
    largest: Lengths<S, M>,
    /// The shortest beside its largest so far.
    shortest: Option<Shortest<S>>,
    /// The least fall of all rows.
    approach: Approach<S>,
    /// Radians of motion at the last look; `None` before the first.
    looked: Option<S>,
    /// One of rows that are solved, zero of those that hold by themselves.
    is_solved: M::Multipliers<S>,
    /// Whether there are rows that are solved.
    are_there: bool,
}

/// How many times as often as that gradients are looked at: how fast one falls is known from looks
/// before.
const OFTEN: f64 = 4.0;

/// The gradient that was shortest beside its largest.
#[derive(Clone, Copy)]
pub(super) struct Shortest<S> {
    /// The row of `Phi`.
    pub(super) row: usize,
    /// The square of its length over the square of the largest of the same row.
    pub(super) fall: S,
    /// When (s).
    pub(super) time: S,
}

copied!([S: Scalar, M: Mechanism] Gradients<S, M>);

impl<S: Real, M: Mechanism> Gradients<S, M> {
    pub(super) fn none() -> Self {
        let mut all = M::Multipliers::<S>::zeros();
        all.as_mut_slice().fill(S::one());
        Self {
            first: [Array::zeros(); 2],
            largest: [Array::zeros(); 2],
            shortest: None,
            approach: Approach::new(),
            looked: None,
            is_solved: all,
            are_there: M::REPORT.equations > 0,
        }
    }

    /// Of those joints alone that keep equations.
    pub(super) fn of_joints(mut self, keeps_equations: fn(&str) -> bool) -> Self {
        let rows = self.is_solved.as_mut_slice();
        self.are_there = false;
        for joint in M::REPORT.joints {
            let is_solved = keeps_equations(joint.name);
            self.are_there |= is_solved && joint.rows > 0;
            let one = if is_solved { S::one() } else { S::zero() };
            for row in rows.iter_mut().skip(joint.row).take(joint.rows) {
                *row = one;
            }
        }
        self
    }

    #[inline]
    pub(super) fn step(&mut self, step: &MonitoredStep<'_, S, M>) {
        let travel = step.motion.travel;
        if self.are_due(travel) {
            let fall = self.measure(step.constants, (step.end, step.state));
            self.look(step.end, fall, travel);
        }
    }

    /// Whether it is time to look, after so many radians of motion: whether one may have vanished
    /// since the last look, which costs as much as the equations themselves.
    #[inline]
    fn are_due(&self, travel: S) -> bool {
        self.are_there
            && self.looked.is_none_or(|looked| {
                let motion = S::constant(OFTEN) * (travel - looked);
                self.approach.may_come_to_pass(motion)
            })
    }

    /// Looks at a state, after so many radians of motion, by what [`Self::measure`] returned for
    /// it.
    pub(super) fn look(&mut self, time: S, fall: S, travel: S) {
        let motion = travel - self.looked.unwrap_or(travel);
        self.looked = Some(travel);
        self.approach.step(time, fall, motion.max(S::zero()));
    }

    /// Looks at a state within a step, whose motion is told of later.
    pub(super) fn look_within(&mut self, time: S, fall: S) {
        self.approach.step(time, fall, S::zero());
    }

    /// All motion up to here was looked into.
    pub(super) fn is_known_until(&mut self, travel: S) {
        self.looked = Some(travel);
    }

    /// Takes the gradients at a state; returns the least fall of one from its largest so far, in
    /// squares.
    #[inline(never)]
    pub(super) fn measure(
        &mut self,
        constants: &M::Constants<S>,
        (time, state): (S, &M::State<S>),
    ) -> S {
        if !self.are_there {
            return S::one();
        }
        let lengths = self.lengths(constants, time, state);
        if self.shortest.is_none() {
            self.first = lengths;
        }
        for (largest, lengths) in self.largest.iter_mut().zip(&lengths) {
            let places = largest.as_mut_slice().iter_mut();
            places
                .zip(lengths.as_slice())
                .for_each(|(largest, &length)| *largest = largest.max(length));
        }
        let Some(shortest) = shortest::<S, M>(&lengths, &self.largest, time) else {
            return S::one();
        };
        if self.shortest.is_none_or(|known| shortest.fall < known.fall) {
            self.shortest = Some(shortest);
        }
        shortest.fall
    }

    /// Of the rows that are solved; zero of others.
    fn lengths(&self, constants: &M::Constants<S>, time: S, state: &M::State<S>) -> Lengths<S, M> {
        let jacobian = M::jacobian(constants, time, state);
        let jacobian = jacobian.as_slice();
        let is_solved = |row: usize| {
            let one = self.is_solved.as_slice().get(row);
            one.is_some_and(|&one| one > S::zero())
        };
        let mut lengths: Lengths<S, M> = [Array::zeros(); 2];
        let [translations, rotations] = &mut lengths;
        for block in M::REPORT.blocks {
            if !is_solved(block.row) {
                continue;
            }
            let squares = translations.as_mut_slice().iter_mut();
            let squares = squares.zip(rotations.as_mut_slice()).skip(block.row);
            for (row, (translation, rotation)) in squares.take(block.rows).enumerate() {
                let [force, moment] = parts(jacobian, block, row);
                *translation = *translation + square(&force);
                *rotation = *rotation + square(&moment);
            }
        }
        for &first in M::VECTOR_ROWS {
            if !is_solved(first) {
                continue;
            }
            let products = products(M::REPORT.blocks, jacobian, first);
            for (lengths, products) in lengths.iter_mut().zip(products) {
                write(lengths.as_mut_slice(), first, independent(products));
            }
        }
        lengths
    }

    /// The history of the least fall.
    pub(super) fn approach(&self) -> &Approach<S> {
        &self.approach
    }

    /// The shortest of the run, met or found between two looks, or at its start, whatever came
    /// later; `None` without rows.
    pub(super) fn shortest(&self, start: S) -> Option<Shortest<S>> {
        let mut least = self.shortest?;
        if let Some(between) = self.approach.least()
            && between.pivot < least.fall
        {
            (least.fall, least.time) = (between.pivot, between.time);
        }
        let first = shortest::<S, M>(&self.first, &self.largest, start)?;
        Some(if first.fall < least.fall {
            first
        } else {
            least
        })
    }

    /// The same with the joint; `None` without equations.
    pub(super) fn shortest_by_joint(&self, start: S) -> Option<ShortestGradient<S>> {
        let shortest = self.shortest(start)?;
        Some(ShortestGradient {
            relative: shortest.fall.sqrt(),
            joint: M::REPORT.joint_of(shortest.row)?,
            time: shortest.time,
        })
    }

    /// Gradients count by their squares, as pivots do.
    pub(super) fn verdict(&self, run: &RunFacts<S>) -> Option<Warning> {
        let shortest = self.shortest_by_joint(run.start)?;
        let fall = shortest.relative * shortest.relative;
        self.approach
            .is_near(fall, run.open)
            .then(|| Warning::Vanishing {
                joint: shortest.joint,
                length: shortest.relative.to_f64(),
                time: shortest.time.to_f64(),
            })
    }
}

/// The gradient that is shortest beside its largest.
fn shortest<S: Real, M: Mechanism>(
    [translation, rotation]: &Lengths<S, M>,
    [farthest, widest]: &Lengths<S, M>,
    time: S,
) -> Option<Shortest<S>> {
    let translations = translation.as_slice().iter().zip(farthest.as_slice());
    let rotations = rotation.as_slice().iter().zip(widest.as_slice());
    let falls = translations.zip(rotations).map(|(a, b)| {
        let left =
            |(&square, &largest): (&S, &S)| (largest > S::zero()).then(|| square.quotient(largest));
        // A row that never had a gradient has not lost it.
        match (left(a), left(b)) {
            (Some(a), Some(b)) => a.max(b),
            (a, b) => a.or(b).unwrap_or(S::one()),
        }
    });
    let rows = falls
        .enumerate()
        .map(|(row, fall)| Shortest { row, fall, time });
    rows.reduce(|a, b| if b.fall < a.fall { b } else { a })
}

/// What a row of a block makes of translations and of rotations.
fn parts<S: Real>(jacobian: &[S], block: &Block, row: usize) -> [[S; 3]; 2] {
    let place = block.offset + row * block.columns;
    let moment = if block.columns > 3 {
        read(jacobian, place + 3)
    } else {
        [S::zero(); 3]
    };
    [read(jacobian, place), moment]
}

/// The scalar products of the three rows of a vector equation, by translations and by rotations:
/// 11, 22, 33, 12, 23, 31.
fn products<S: Real>(blocks: &[Block], jacobian: &[S], first: usize) -> [[S; 6]; 2] {
    let mut products = [[S::zero(); 6]; 2];
    let own = |block: &&Block| block.row <= first && first + 3 <= block.row + block.rows;
    for block in blocks.iter().filter(own) {
        let [a, b, c] = [0, 1, 2].map(|k| parts(jacobian, block, first - block.row + k));
        for (part, products) in products.iter_mut().enumerate() {
            let of = |row: &[[S; 3]; 2]| row.get(part).copied().unwrap_or([S::zero(); 3]);
            let rows = [of(&a), of(&b), of(&c)];
            let [a, b, c] = &rows;
            let pairs = [(a, a), (b, b), (c, c), (a, b), (b, c), (c, a)];
            for (product, (x, y)) in products.iter_mut().zip(pairs) {
                let terms = x.iter().zip(y);
                *product = terms.fold(*product, |sum, (&x, &y)| x.fused(y, sum));
            }
        }
    }
    products
}

/// Of three rows with these products: the sum of the squares, and what the areas and the volume
/// that they span are over it and over the areas. Zero where that is round-off.
fn independent<S: Real>([a, b, c, ab, bc, ca]: [S; 6]) -> [S; 3] {
    let round_off = S::constant(64.0) * S::EPSILON;
    let sum = a + b + c;
    let areas = (a * b - ab * ab) + (b * c - bc * bc) + (c * a - ca * ca);
    let volume = a * (b * c - bc * bc) - ab * (ab * c - bc * ca) + ca * (ab * bc - b * ca);
    let mut left = [sum, S::zero(), S::zero()];
    if areas > round_off * sum * sum {
        left[1] = areas.quotient(sum);
        if volume > round_off * areas * sum {
            left[2] = volume.quotient(areas);
        }
    }
    left
}
