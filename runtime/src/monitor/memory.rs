//! How long a motion remembers its errors.
//!
//! A vibration that dampers take energy from, and a force or a motor feeds, forgets what it was: so
//! its errors do not add up over the whole run, but over the time in which its amplitude falls by
//! `e`. Dampers take the part of the power that is the same where all velocities are reversed. What
//! goes on in one direction, as a rotor with friction, keeps the errors of its place, if no driver
//! says where it is. A circle of translations counts as a vibration.
//!
//! It costs the power of the forces, twice, with every look at the energies. Without it right runs
//! of damped vibrations have warnings after some hundred radians: `tests/tests/alarms.rs`.

use super::motion::MotionMeasure;
use super::record::{Look, MonitoredStep};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{minus, read, square, write};
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// What dampers took from a motion, and whether it returns.
pub(super) struct Memory<S: Scalar, M: Mechanism> {
    start: S,
    /// The time (s) of the last look.
    time: S,
    /// The work (J) that dampers took, positive, and their power (W) then.
    taken: S,
    power: S,
    /// The work (J) that was fed, as far as forces and drivers tell, and its power (W) then.
    given: [S; 2],
    /// The integral of the kinetic energy (J s), the last one and the least one.
    action: S,
    kinetic: S,
    least: S,
    /// Of each translation (m) and each rotation (rad) the sum of the way, as a vector.
    ways: M::Velocities<S>,
    /// Of each the length of the way.
    lengths: M::Velocities<S>,
    /// The least and the largest components of the place (m) of each body.
    places: [M::Velocities<S>; 2],
}

copied!([S: Scalar, M: Mechanism] Memory<S, M>);

/// The part of a way that is made good, above which a body goes on.
const GOES_ON: f64 = 0.5;

/// The part of the longest way (rad) below which a way says nothing.
const SHORT: f64 = 0.1;

impl<S: Real, M: Mechanism> Memory<S, M> {
    /// Of a motion that forgets nothing, with its kinetic energy (J) at the start.
    pub(super) fn whole(start: S, state: &M::State<S>, kinetic: S) -> Self {
        let mut places = M::Velocities::<S>::zeros();
        for body in M::REPORT.bodies {
            let place: [S; 3] = read(state.coordinates().as_slice(), body.coordinate);
            write(places.as_mut_slice(), body.velocity, place);
        }
        Self {
            start,
            time: start,
            taken: S::zero(),
            power: S::zero(),
            given: [S::zero(); 2],
            action: S::zero(),
            kinetic,
            least: kinetic,
            ways: M::Velocities::<S>::zeros(),
            lengths: M::Velocities::<S>::zeros(),
            places: [places; 2],
        }
    }

    #[inline]
    pub(super) fn step(&mut self, step: &MonitoredStep<'_, S, M>) {
        if let Some(look) = step.look {
            self.look(step.constants, (step.end, step.state), look, step.power);
        }
    }

    /// Looks at forces and velocities in a state with its energies, and the power (W) of all
    /// forces and drivers there, if it is known.
    #[inline(never)]
    pub(super) fn look(
        &mut self,
        constants: &M::Constants<S>,
        (time, state): (S, &M::State<S>),
        look: &Look<S, M>,
        all: Option<S>,
    ) {
        let kinetic = look.kinetic;
        if M::REPORT.forces.is_empty() {
            return;
        }
        let mut reversed = *state;
        for velocity in reversed.velocities_mut().as_mut_slice() {
            *velocity = -*velocity;
        }
        let forth = M::power(constants, time, state);
        let back = M::power(constants, time, &reversed);
        let power = S::constant(-0.5) * (forth + back);
        let step = time - self.time;
        let half = S::constant(0.5) * step;
        self.taken = half.fused(power + self.power, self.taken);
        // What is not taken by dampers is fed, or taken in turn.
        let feeds = all.map_or(S::zero(), |all| (all + power).max(S::zero()));
        let [given, before] = self.given;
        self.given = [half.fused(feeds + before, given), feeds];
        self.action = half.fused(kinetic + self.kinetic, self.action);
        self.least = self.least.min(kinetic);
        (self.time, self.power, self.kinetic) = (time, power, kinetic);
        self.add_ways(state, step);
    }

    fn add_ways(&mut self, state: &M::State<S>, step: S) {
        let velocities = state.velocities().as_slice();
        let mut add = |place: usize| {
            let velocity: [S; 3] = read(velocities, place);
            let way: [S; 3] = read(self.ways.as_slice(), place);
            let [x, y, z] = way;
            let [u, v, w] = velocity.map(|x| x * step);
            let way = [x + u, y + v, z + w];
            write(self.ways.as_mut_slice(), place, way);
            let [length] = read(self.lengths.as_slice(), place);
            let length = square(&velocity).sqrt().fused(step, length);
            write(self.lengths.as_mut_slice(), place, [length]);
        };
        for body in M::REPORT.bodies {
            add(body.velocity);
            if body.kind == BodyKind::Rigid {
                add(body.velocity + 3);
            }
            let place: [S; 3] = read(state.coordinates().as_slice(), body.coordinate);
            let [low, high] = &mut self.places;
            let elements = low.as_mut_slice().iter_mut().zip(high.as_mut_slice());
            for ((low, high), x) in elements.skip(body.velocity).zip(place) {
                (*low, *high) = (low.min(x), high.max(x));
            }
        }
    }

    /// Whether a body goes on in one direction, so that nothing brings it back to where it would
    /// be.
    fn goes_on(&self, measure: &MotionMeasure<S, M>) -> bool {
        if M::REPORT.time.constraints {
            return false;
        }
        let way = |place: usize, length: S| {
            let [path] = read(self.lengths.as_slice(), place);
            let made_good = square(&read::<S, 3>(self.ways.as_slice(), place)).sqrt();
            [path.quotient(length), made_good.quotient(length)]
        };
        let ways = |index: usize| {
            let body = M::REPORT.bodies.get(index);
            let place = body.map_or(0, |body| body.velocity);
            let is_rigid = body.is_some_and(|body| body.kind == BodyKind::Rigid);
            let rotation = if is_rigid {
                way(place + 3, S::one())
            } else {
                [S::zero(); 2]
            };
            [way(place, measure.length_of(index)), rotation]
        };
        let all = || (0..M::REPORT.bodies.len()).flat_map(ways);
        let longest = all().fold(S::zero(), |longest, [path, _]| longest.max(path));
        all().any(|[path, made_good]| {
            path > S::constant(SHORT) * longest && made_good > S::constant(GOES_ON) * path
        })
    }

    /// The part of the radians of motion by lengths of bodies that vibrations of more than a length
    /// leave of them: a vibration of many lengths has the radians of one of one length.
    pub(super) fn part_of_vibrations(&self, measure: &MotionMeasure<S, M>) -> S {
        let [mut by_lengths, mut by_ways] = [S::zero(); 2];
        let mut take = |place: usize, length: S| {
            let [path] = read(self.lengths.as_slice(), place);
            let [low, high] = &self.places;
            let low: [S; 3] = read(low.as_slice(), place);
            let high: [S; 3] = read(high.as_slice(), place);
            by_lengths = by_lengths.max(path.quotient(length));
            let amplitude = S::constant(0.5) * square(&minus(&high, &low)).sqrt();
            by_ways = by_ways.max(path.quotient(length.max(amplitude)));
        };
        for (index, body) in M::REPORT.bodies.iter().enumerate() {
            take(body.velocity, measure.length_of(index));
            if body.kind == BodyKind::Rigid {
                take(body.velocity + 3, S::one());
            }
        }
        let part = by_ways.quotient(by_lengths);
        if part < S::one() && !self.goes_on(measure) {
            part
        } else {
            S::one()
        }
    }

    /// How often the motion has forgotten what it was: by how many powers of `e` its amplitude
    /// would have fallen, with the mean energy that is in it. At least one.
    ///
    /// That of a vibration is twice its kinetic energy.
    pub(super) fn lives(&self, measure: &MotionMeasure<S, M>) -> S {
        let mean = self.action.quotient(self.time - self.start);
        let energy = S::constant(2.0) * (mean - self.least);
        let lives = (S::constant(0.5) * self.taken).quotient(energy);
        if lives > S::one()
            && lives.plain().is_finite()
            && energy > S::zero()
            && !self.goes_on(measure)
        {
            lives
        } else {
            S::one()
        }
    }

    /// The part of what dampers took that was fed to the motion, which has gained so much energy
    /// (J): zero of a vibration that dies out, whose errors die out with it.
    ///
    /// Steps that do not follow a damper let it take more than there was. Then what was fed tells.
    pub(super) fn fed(&self, gained: S) -> S {
        // Looks are sixteen steps apart, so that what dampers took of a start may be seen twice.
        let mut fed = self.taken + gained + gained;
        if !M::REPORT.time.potential {
            let [given, _] = self.given;
            fed = fed.min(given + given);
        }
        let part = fed.quotient(self.taken);
        if part > S::zero() {
            part.min(S::one())
        } else {
            S::zero()
        }
    }
}
