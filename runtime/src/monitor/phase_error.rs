//! By how much coordinates lag behind, with a method of low order whose energy does not tell.
//!
//! It costs two evaluations in every fourth step of a method of order 2, and nothing with others.
//! Only it finds the phase error of an oscillation: `tests/tests/sound/phase_error.rs`. Estimates:
//! `docs/decisions/012-phase-of-order-2.md`.

use super::limits::{self, above};
use super::motion::MotionMeasure;
use super::record::{MonitoredStep, RunFacts};
use super::warning::Warning;
use crate::integrate::ErrorModel;
use crate::math::quaternion::{conjugate, product};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::square;
use crate::math::vec3::{minus, read, times, write};
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::{BodyInfo, BodyKind};
use crate::state::vector::{Array, StateParts};

/// Of how many steps one is judged.
const EVERY: usize = 4;

/// The square of a velocity over the largest before, from which on a body begins to move, and under
/// which it rests.
const STARTS: f64 = 1e6;
const RESTS: f64 = 1e-6;

/// What part of the farthest motion counts as none.
const HARDLY: f64 = 1e-2;

/// What steps miss, body by body, in radians and in lengths of the body.
///
/// What a step misses along the motion, over its velocity, is a time. It adds up with its sign, so
/// that neither the noise of a fast vibration nor what an oscillation takes back counts; weighted
/// by the squares of the velocities, it is that of the motion proper. Times the velocity it is what
/// a body is off by. Translations and rotations count by themselves: a fast spin would hide what an
/// axis does.
pub(super) struct PhaseError<S: Scalar, M: Mechanism> {
    /// Of each translation and each rotation the sums of what was missed along the velocity, and of
    /// the squares of velocities, and what it is off by at the worst.
    sums: M::Velocities<S>,
    /// How far each was from where it began, in how many steps it moved, and the square of its
    /// largest velocity.
    tracks: M::Velocities<S>,
    first: M::State<S>,
    /// The sums of what bodies missed at the most, whatever its direction: of coordinates, and of
    /// velocities (1/s).
    missed: [S; 2],
    /// How the errors of the method grow.
    model: ErrorModel,
    /// The last rate of motion (rad/s), and sums over the steps of the third powers of what was
    /// turned (rad), and of what the rate changed by.
    rate: S,
    cubes: [S; 2],
    /// The largest change of the rate of a body (rad/s), for methods whose velocities are ahead.
    changed: S,
    /// How many of their steps passed over an instant at which a force turns round.
    passed: usize,
}

copied!([S: Scalar, M: Mechanism] PhaseError<S, M>);

impl<S: Real, M: Mechanism> PhaseError<S, M> {
    pub(super) fn none(start: &M::State<S>) -> Self {
        Self {
            sums: M::Velocities::<S>::zeros(),
            tracks: M::Velocities::<S>::zeros(),
            first: *start,
            missed: [S::zero(); 2],
            model: ErrorModel::default(),
            rate: S::zero(),
            cubes: [S::zero(); 2],
            changed: S::zero(),
            passed: 0,
        }
    }

    /// Of a run with a method whose errors grow like that.
    pub(super) fn over(mut self, model: ErrorModel) -> Self {
        self.model = model;
        self
    }

    /// By what part of a step velocities are ahead of coordinates; `None` where they are not.
    #[inline]
    pub(super) fn stagger(&self) -> Option<S> {
        let lead = self.model.stagger;
        (lead > 0.0).then(|| S::constant(lead))
    }

    #[inline]
    pub(super) fn step(&mut self, measure: &MotionMeasure<S, M>, step: &MonitoredStep<'_, S, M>) {
        let (rate, turned) = (step.motion.rate, step.motion.turned);
        let change = if step.index > 0 {
            (rate - self.rate).abs()
        } else {
            S::zero()
        };
        for (sum, x) in self.cubes.iter_mut().zip([turned, change]) {
            *sum = (x * x).fused(x, *sum);
        }
        self.rate = rate;
        if self.model.stagger > 0.0 {
            self.changed = self.changed.max(measure.change(step.state));
        }
    }

    /// Counts a step over an instant at which a force turns round.
    pub(super) fn passes_over(&mut self) {
        self.passed += 1;
    }

    /// Whether the step after so many is to be judged.
    pub(super) fn is_due(steps: usize) -> bool {
        steps % EVERY == 1
    }

    /// What a step has missed of the coordinates (m, rad) and of the velocities (m/s, rad/s),
    /// beside a rule of higher order.
    pub(super) fn missed_by([end, better]: [&M::State<S>; 2]) -> [M::Velocities<S>; 2] {
        let mut missed = M::Velocities::<S>::zeros();
        let mut slower = *end.velocities();
        let (from, to) = (better.coordinates(), end.coordinates());
        for info in M::REPORT.bodies {
            let from = read(from.as_slice(), info.coordinate);
            let to = read(to.as_slice(), info.coordinate);
            write(missed.as_mut_slice(), info.velocity, minus(&to, &from));
            if info.kind == BodyKind::Rigid {
                let turn = rotation::<S, M>(info.coordinate, [better, end]);
                write(missed.as_mut_slice(), info.velocity + 3, turn);
            }
        }
        let should = better.velocities().as_slice();
        let pairs = slower.as_mut_slice().iter_mut().zip(should);
        pairs.for_each(|(is, &should)| *is = *is - should);
        [missed, slower]
    }

    /// Takes what a step that has led to a state has missed of coordinates and of velocities, and
    /// the velocities there.
    pub(super) fn judge(
        &mut self,
        measure: &MotionMeasure<S, M>,
        end: &M::State<S>,
        motions: &[M::Velocities<S>; 3],
    ) {
        let first = self.first;
        let [missed, slower, velocities] = motions;
        let (missed, slower) = (missed.as_slice(), slower.as_slice());
        let velocities = velocities.as_slice();
        let mut most = [S::zero(); 2];
        for (body, info) in M::REPORT.bodies.iter().enumerate() {
            let part = S::one().quotient(measure.length_of(body));
            let size = |elements: &[S], place| square(&read::<S, 3>(elements, place)).sqrt();
            let from = read(first.coordinates().as_slice(), info.coordinate);
            let to = read(end.coordinates().as_slice(), info.coordinate);
            let motion = Motion {
                missed: times(&read(missed, info.velocity), part),
                way: times(&minus(&to, &from), part),
                velocity: times(&read(velocities, info.velocity), part),
            };
            self.add(info.velocity, &motion);
            let off = |elements| size(elements, info.velocity) * part;
            most = larger(most, [off(missed), off(slower)]);
            if info.kind == BodyKind::Rigid {
                let place = info.velocity + 3;
                let motion = Motion {
                    missed: read(missed, place),
                    way: rotation::<S, M>(info.coordinate, [&first, end]),
                    velocity: read(velocities, place),
                };
                self.add(place, &motion);
                most = larger(most, [size(missed, place), size(slower, place)]);
            }
        }
        for (sum, most) in self.missed.iter_mut().zip(most) {
            *sum = most.fused(S::constant(EVERY as f64), *sum);
        }
    }

    /// What all steps have missed, whatever its direction: of coordinates, and of velocities beside
    /// the fastest. Nothing of what a method does exactly.
    fn missed(&self, fastest: S) -> S {
        let [coordinates, velocities] = self.missed;
        if velocities > S::zero() {
            coordinates.max(velocities.quotient(fastest))
        } else {
            coordinates
        }
    }

    fn add(&mut self, place: usize, motion: &Motion<S>) {
        let here = square(&motion.velocity);
        let [mut along, mut speeds, mut worst]: [S; 3] = read(self.sums.as_slice(), place);
        let [way, mut moving, fastest]: [S; 3] = read(self.tracks.as_slice(), place);
        if here > S::constant(STARTS) * fastest {
            // What was before is rest.
            (along, speeds, moving) = (S::zero(), S::zero(), S::zero());
        }
        let fastest = fastest.max(here);
        if here > S::constant(RESTS) * fastest {
            moving = moving + S::constant(EVERY as f64);
        }
        let terms = motion.missed.iter().zip(&motion.velocity);
        along = terms.fold(along, |sum, (&x, &v)| x.fused(v, sum));
        speeds = speeds + here;
        if speeds > S::zero() {
            let lag = along.abs().quotient(speeds) * moving;
            worst = worst.max(lag * here.sqrt());
        }
        let way = square(&motion.way).sqrt().max(way);
        write(self.sums.as_mut_slice(), place, [along, speeds, worst]);
        let track = [way, moving, fastest];
        write(self.tracks.as_mut_slice(), place, track);
    }

    /// What a body is off by, at the worst (rad), or over what it has moved by where that is less
    /// than a radian.
    pub(super) fn worst(&self) -> S {
        let farthest = M::REPORT.bodies.iter().fold(S::zero(), |farthest, body| {
            let [way, _] = self.of(body);
            farthest.max(way)
        });
        // What hardly moves beside the others is vibration of what holds it.
        let least = S::constant(HARDLY) * farthest.min(S::one());
        M::REPORT.bodies.iter().fold(S::zero(), |worst, body| {
            let [way, off] = self.of(body);
            let moved = way.min(S::one()).max(least);
            if moved > S::zero() {
                worst.max(off.quotient(moved))
            } else {
                worst
            }
        })
    }

    /// How far from where it began a body was, and what it is off by.
    fn of(&self, body: &BodyInfo) -> [S; 2] {
        let parts: &[usize] = match body.kind {
            BodyKind::Rigid => &[0, 3],
            BodyKind::Particle => &[0],
        };
        let mut largest = [S::zero(); 2];
        for part in parts {
            let place = body.velocity + part;
            let [_, _, off]: [S; 3] = read(self.sums.as_slice(), place);
            let [way] = read(self.tracks.as_slice(), place);
            largest = larger(largest, [way, off]);
        }
        largest
    }

    /// Of methods whose energy does not tell.
    pub(super) fn verdict(&self, run: &RunFacts<S>) -> Option<Warning> {
        if run.rests {
            return None;
        }
        let mut shift = self.worst();
        if !above(shift, limits::PHASE) {
            let silent = self.silent_shift(run.fastest);
            shift = shift.max(silent.min(self.missed(run.fastest)));
        }
        // What is off at the worst is known as it dies out.
        let lives = run.lives * run.fed;
        let shift = shift.quotient(lives.max(S::one()));
        let led = self.led_shift(run.longest).max(self.passed_shift(run));
        let shift = shift.max(led) * run.part_of_vibrations;
        let shift = shift.max(self.shift_of_orbits(run));
        above(shift, limits::PHASE).then(|| Warning::LongSteps {
            shift: shift.to_f64(),
        })
    }

    /// A rate that changes by a part `x` of the largest in a step is that of an oscillation of `x`
    /// radians a step.
    fn silent_shift(&self, fastest: S) -> S {
        let [turned, changed] = self.cubes;
        let fastest = fastest * fastest * fastest;
        let phase_error = S::constant(self.model.phase_error);
        if phase_error > S::zero() && fastest > S::zero() {
            phase_error * turned.max(changed.quotient(fastest))
        } else {
            S::zero()
        }
    }

    /// What goes round something is late by twice what it misses across its way.
    fn shift_of_orbits(&self, run: &RunFacts<S>) -> S {
        S::constant(2.0) * self.missed(run.fastest) * run.part_that_goes_round
    }

    /// Where velocities are ahead of coordinates by a part of a step, coordinates are off by what a
    /// rate changes by over so much time.
    fn led_shift(&self, longest: S) -> S {
        S::constant(self.model.stagger) * longest * self.changed
    }

    /// Where such steps pass over instants at which a force turns round, each changes the speed by
    /// up to the part that a step is of the time between two, one way or the other. What a motion
    /// has gained shifts its phase from then on.
    fn passed_shift(&self, run: &RunFacts<S>) -> S {
        if self.model.stagger <= 0.0 || self.passed == 0 {
            return S::zero();
        }
        let passed = S::constant(self.passed as f64);
        let part = (passed * run.longest).quotient(run.duration);
        passed.sqrt() * part * run.travel
    }
}

fn larger<S: Real>([a, b]: [S; 2], [x, y]: [S; 2]) -> [S; 2] {
    [a.max(x), b.max(y)]
}

/// A translation or a rotation, in lengths or radians.
struct Motion<S> {
    missed: [S; 3],
    /// From where it began; a chord where that is far.
    way: [S; 3],
    velocity: [S; 3],
}

/// The rotation (rad, body axes) from one orientation to another that is near; a chord where it is
/// not.
fn rotation<S: Real, M: Mechanism>(place: usize, states: [&M::State<S>; 2]) -> [S; 3] {
    let orientation = |x: &M::State<S>| read::<S, 4>(x.coordinates().as_slice(), place + 3);
    let [p, q] = states;
    let [e0, e1, e2, e3] = product(&conjugate(&orientation(p)), &orientation(q));
    let two = S::constant(if e0 < S::zero() { -2.0 } else { 2.0 });
    [two * e1, two * e2, two * e3]
}
