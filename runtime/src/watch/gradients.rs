//! How long the gradients of the equations were over a run.

use super::singular::Approach;
use crate::array::Array;
use crate::mechanism::Mechanism;
use crate::report::Block;
use crate::rotation::{read, write};
use crate::scalar::{Real, Scalar};
use crate::view::square;

/// The squares of the lengths of the rows of `D`, of a vector equation together: a radian counts as the length of the mechanism.
///
/// Where a gradient vanishes, its equation leaves open which way a motion goes on, as where equations depend on each other. A relative pivot does not tell of that: it is compared with what
/// the row is without the others, and that vanishes as well.
pub(super) struct Gradients<S: Scalar, M: Mechanism> {
    largest: M::Multipliers<S>,
    least: M::Multipliers<S>,
    /// When they were least (s).
    time: M::Multipliers<S>,
    /// The least fall of all rows.
    approach: Approach<S>,
    /// Radians of motion at the last look; `None` before the first.
    looked: Option<S>,
}

/// The gradient that was shortest beside its largest.
pub(super) struct Shortest<S> {
    /// The row of `Phi`.
    pub(super) row: usize,
    /// The square of its length over the square of the largest of the same row.
    pub(super) fall: S,
    /// When (s).
    pub(super) time: S,
}

impl<S: Scalar, M: Mechanism> Clone for Gradients<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Scalar, M: Mechanism> Copy for Gradients<S, M> {}

impl<S: Real, M: Mechanism> Gradients<S, M> {
    pub(super) fn none() -> Self {
        let mut least = M::Multipliers::<S>::zeros();
        least.as_mut_slice().fill(S::constant(f64::INFINITY));
        Self {
            largest: M::Multipliers::<S>::zeros(),
            least,
            time: M::Multipliers::<S>::zeros(),
            approach: Approach::new(),
            looked: None,
        }
    }

    /// Whether it is time to look, after so many radians of motion: whether one may have vanished since the last look, which costs as much as the equations themselves.
    #[inline]
    pub(super) fn are_due(&self, travel: S) -> bool {
        let may_have_vanished = match (self.looked, self.approach.last()) {
            (Some(looked), Some(fall)) => {
                self.approach.may_pass(travel - looked, [fall, S::zero()])
            }
            _ => true,
        };
        M::REPORT.equations > 0 && may_have_vanished
    }

    /// Looks at a state, after so many radians of motion, by what [`Self::measure`] returned for it.
    pub(super) fn look(&mut self, time: S, fall: S, travel: S) {
        let motion = travel - self.looked.unwrap_or(travel);
        self.looked = Some(travel);
        self.approach.step(time, fall, motion.max(S::zero()));
    }

    /// Takes the gradients at a state of a mechanism of some length (m); returns the least fall of one from its largest so far, in squares.
    #[inline(never)]
    pub(super) fn measure(
        &mut self,
        constants: &M::Constants<S>,
        (time, state): (S, &M::State<S>),
        length: S,
    ) -> S {
        let squares = squares::<S, M>(constants, time, state, length);
        let rows = self.largest.as_mut_slice().iter_mut();
        let rows = rows.zip(self.least.as_mut_slice());
        let rows = rows.zip(self.time.as_mut_slice());
        let mut fall = S::one();
        for (((largest, least), at), &square) in rows.zip(squares.as_slice()) {
            *largest = largest.max(square);
            if square < *least {
                (*least, *at) = (square, time);
            }
            fall = fall.min(fallen(square, *largest));
        }
        fall
    }

    /// The course of the least fall.
    pub(super) fn approach(&self) -> &Approach<S> {
        &self.approach
    }

    /// The shortest of the run, at a look or between two. Its largest may have come later: only the end of a run tells of a gradient that grew from the start.
    pub(super) fn shortest(&self) -> Option<Shortest<S>> {
        let rows = self.least.as_slice().iter().zip(self.largest.as_slice());
        let rows = rows.zip(self.time.as_slice()).enumerate();
        let rows = rows.map(|(row, ((&least, &largest), &time))| Shortest {
            row,
            fall: fallen(least, largest),
            time,
        });
        let met = rows.reduce(|a, b| if b.fall < a.fall { b } else { a })?;
        Some(match self.approach.least() {
            Some(between) if between.pivot < met.fall => Shortest {
                fall: between.pivot,
                time: between.time,
                ..met
            },
            _ => met,
        })
    }
}

/// A square over the largest of its row. A row that never had a gradient has not lost it.
fn fallen<S: Real>(square: S, largest: S) -> S {
    if largest > S::zero() {
        square.quotient(largest)
    } else {
        S::one()
    }
}

/// The squares of all rows, those of a vector equation together.
fn squares<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    length: S,
) -> M::Multipliers<S> {
    let jacobian = M::jacobian(constants, time, state);
    let mut squares = M::Multipliers::<S>::zeros();
    let elements = squares.as_mut_slice();
    let metre = length.reciprocal();
    add_blocks(M::REPORT.blocks, jacobian.as_slice(), metre, elements);
    for &first in M::VECTOR_ROWS {
        let [a, b, c] = read(elements, first);
        write(elements, first, [a + b + c; 3]);
    }
    squares
}

fn add_blocks<S: Real>(blocks: &[Block], jacobian: &[S], metre: S, squares: &mut [S]) {
    for block in blocks {
        let values = jacobian.get(block.offset..).unwrap_or(&[]);
        let rows = squares.iter_mut().skip(block.row).take(block.rows);
        for (sum, row) in rows.zip(values.chunks(block.columns.max(1))) {
            let (force, moment) = row.split_at_checked(3).unwrap_or((row, &[]));
            *sum = *sum + square(force) + square(moment) * (metre * metre);
        }
    }
}
