//! A motion that can be asked at any time.
//!
//! A piece is a step, or what of it lies before an event. It holds the bodies at Chebyshev points
//! of its time, each as a report would show them. The polynomial through them is the motion (Berrut
//! and Trefethen, *Barycentric Lagrange Interpolation*, SIAM Review 46 (2004), 501-517).
//!
//! So it needs to know of no method. Interpolants are polynomials up to degree 13, or shorter
//! steps. Bodies are functions of joint coordinates. `record.rs` takes as many points as the motion
//! in a step needs.

mod record;

use core::fmt::{self, Debug};
use core::ops::RangeInclusive;
use std::vec::Vec;

use crate::error::ReadingFault;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::with_unit_orientations;
use crate::state::vector::{MovingState as _, Vector as _};

/// The most intervals between the points of a piece; others are this number halved.
const FINEST: usize = 16;

/// `(1 - cos(j pi / 16)) / 2`: the points of a piece from 0 to 1.
const POINTS: [f64; FINEST + 1] = [
    0.0,
    0.009_607_359_798_384_776,
    0.038_060_233_744_356_624,
    0.084_265_193_848_727_38,
    0.146_446_609_406_726_24,
    0.222_214_883_490_198_88,
    0.308_658_283_817_455_14,
    0.402_454_838_991_935_85,
    0.5,
    0.597_545_161_008_064_1,
    0.691_341_716_182_544_9,
    0.777_785_116_509_801_1,
    0.853_553_390_593_273_7,
    0.915_734_806_151_272_7,
    0.961_939_766_255_643_4,
    0.990_392_640_201_615_2,
    1.0,
];

/// A step, or what of it lies before an event.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece<S> {
    start: S,
    end: S,
    /// The place of its first point, and the intervals between its points. Before the first one is
    /// the state at the start: some interpolants lead back to another one, by their error.
    first: usize,
    intervals: usize,
}

/// The motion of a run, which can be asked at any time of its interval: what
/// [`Simulation::trajectory`](crate::Simulation::trajectory) records.
///
/// Between the ends of steps it is the dense output of the method, to 1e-11 of the elements of the
/// state: what a report at that time would have shown. Its error is that of the method's
/// interpolant. [`RadauIIA`](crate::RadauIIA) solves for each of these states, so it is theirs to
/// what this iteration leaves. At the ends of steps it is the state of the run. At the time of an
/// event it has both states, the one that was found and the one with which the run went on.
///
/// ```
/// use holonom::prelude::*;
/// use holonom::run::Trajectory;
///
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
/// struct Rod {
///     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
///     rod: Body,
///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
///     hinge: Revolute,
/// }
///
/// let rod = Rod::default();
/// let mut motion = Trajectory::new();
/// rod.simulation(StandardLagrange, DormandPrince::default())
///     .trajectory(&mut motion)
///     .run(0.0..=3.0, every(1.0), |_| ())?;
/// let state = motion.at(1.234)?;
/// println!("{} rad", rod.view(1.234, &state)?.angle(Rod::HANDLES.hinge));
/// assert!(motion.at(3.1).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Trajectory<M: Mechanism, S: Real = f64> {
    pieces: Vec<Piece<S>>,
    points: Vec<M::State<S>>,
}

impl<M: Mechanism, S: Real> Trajectory<M, S> {
    /// A trajectory without a motion yet.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            pieces: Vec::new(),
            points: Vec::new(),
        }
    }

    /// The interval (s) that it knows; `None` before a run.
    #[must_use]
    pub fn interval(&self) -> Option<RangeInclusive<S>> {
        let (first, last) = (self.pieces.first()?, self.pieces.last()?);
        Some(first.start..=last.end)
    }

    /// How many states it holds.
    #[must_use]
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether it knows no motion.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// The ends (s) of steps, with those of the interval; the time of an event is one.
    pub fn ends(&self) -> impl Iterator<Item = S> {
        let first = self.pieces.first().map(|piece| piece.start);
        let ends = self.pieces.iter().map(|piece| piece.end);
        first.into_iter().chain(ends)
    }

    /// The state at a time (s); at the time of an event the one with which the run went on.
    ///
    /// # Errors
    /// [`ReadingFault::OutsideTrajectory`].
    pub fn at(&self, time: S) -> Result<M::State<S>, ReadingFault> {
        let place = self.pieces.partition_point(|piece| piece.start <= time);
        self.within(place.checked_sub(1), time)
    }

    /// The same from before: at the time of an event the state that was found.
    ///
    /// # Errors
    /// [`ReadingFault::OutsideTrajectory`].
    pub fn before(&self, time: S) -> Result<M::State<S>, ReadingFault> {
        let place = self.pieces.partition_point(|piece| piece.end < time);
        self.within(Some(place), time)
    }

    /// The state in a piece, which must be there and hold the time.
    fn within(&self, place: Option<usize>, time: S) -> Result<M::State<S>, ReadingFault> {
        let piece = place.and_then(|place| self.pieces.get(place));
        let piece = piece.filter(|piece| piece.start <= time && time <= piece.end);
        let state = piece.and_then(|piece| {
            let points = self
                .points
                .get(piece.first..=piece.first + piece.intervals)?;
            if time == piece.end {
                return points.last().copied();
            }
            if time == piece.start {
                return self.points.get(piece.first.checked_sub(1)?).copied();
            }
            let part = (time - piece.start).quotient(piece.end - piece.start);
            Some(interpolated::<S, M>(points, part))
        });
        state.ok_or_else(|| {
            let (first, last) = (self.pieces.first(), self.pieces.last());
            ReadingFault::OutsideTrajectory {
                time: time.to_f64(),
                start: first.map_or(f64::NAN, |piece| piece.start.to_f64()),
                end: last.map_or(f64::NAN, |piece| piece.end.to_f64()),
            }
        })
    }

    /// Forgets what it knows from a time on, and all if it does not lead there.
    fn go_on_from(&mut self, time: S) {
        while self.pieces.last().is_some_and(|piece| piece.end > time) {
            self.pieces.pop();
        }
        if self.pieces.last().is_none_or(|piece| piece.end != time) {
            self.pieces.clear();
        }
        let last = self.pieces.last();
        let known = last.map_or(0, |piece| piece.first + piece.intervals + 1);
        self.points.truncate(known);
    }

    /// Adds a piece of the state at its start and its points.
    fn add(
        &mut self,
        (start, end): (S, S),
        from: &M::State<S>,
        points: impl Iterator<Item = M::State<S>>,
    ) {
        if self.points.last() != Some(from) {
            self.points.push(*from);
        }
        let first = self.points.len();
        self.points.extend(points);
        let intervals = (self.points.len() - first).saturating_sub(1);
        self.pieces.push(Piece {
            start,
            end,
            first,
            intervals,
        });
    }

    /// Puts the state at the end of the last piece right, to the last bit.
    fn end_with(&mut self, state: &M::State<S>) {
        if let Some(last) = self.points.last_mut() {
            *last = *state;
        }
    }
}

/// The polynomial through the points of a piece, at a part of it, with orientations of length 1.
fn interpolated<S: Real, M: Mechanism>(points: &[M::State<S>], part: S) -> M::State<S> {
    let intervals = points.len().saturating_sub(1).max(1);
    let half = S::constant(0.5);
    let (mut sum, mut weights) = (M::State::<S>::zeros(), S::zero());
    let places = POINTS.iter().step_by(FINEST / intervals);
    for (place, (point, &at)) in points.iter().zip(places).enumerate() {
        let distance = part - S::constant(at);
        if distance == S::zero() {
            return *point;
        }
        let sign = if place % 2 == 0 { S::one() } else { -S::one() };
        let is_end = place == 0 || place == intervals;
        let weight = if is_end { half * sign } else { sign };
        let weight = weight.quotient(distance);
        sum = sum.zip(point, |sum, x| x.fused(weight, sum));
        for (sum, &angle) in sum.turns_mut().iter_mut().zip(point.turns()) {
            *sum = angle.fused(weight, *sum);
        }
        weights = weights + weight;
    }
    let mut state = sum.zip(&sum, |x, _| x.quotient(weights));
    for angle in state.turns_mut() {
        *angle = angle.quotient(weights);
    }
    with_unit_orientations::<S, M>(&state)
}

impl<M: Mechanism, S: Real> Default for Trajectory<M, S> {
    fn default() -> Self {
        Self::new()
    }
}

impl<M: Mechanism, S: Real> Clone for Trajectory<M, S> {
    fn clone(&self) -> Self {
        Self {
            pieces: self.pieces.clone(),
            points: self.points.clone(),
        }
    }
}

/// The mechanism, the interval and how much is held.
impl<M: Mechanism, S: Real> Debug for Trajectory<M, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Trajectory")
            .field("mechanism", &M::REPORT.name)
            .field("interval", &self.interval())
            .field("pieces", &self.pieces.len())
            .field("states", &self.points.len())
            .finish()
    }
}

/// A trajectory that a run records, see
/// [`Simulation::trajectory`](crate::Simulation::trajectory).
#[derive(Debug)]
pub struct Recorded<'t, M: Mechanism, S: Real>(pub(crate) &'t mut Trajectory<M, S>);
