//! The way from a state to one that satisfies the constraints and has what was set: followed in
//! short steps.
//!
//! A homotopy: at a share `s` of the way, `Phi(q, t) = (1 - s) Phi(q0, t)`, and the bodies that
//! were set are `s` of their motions away from where they were. At `s = 0` that is the start,
//! whether it satisfies the constraints or not.

use super::set::Set;
use crate::constraints::apart::reach;
use crate::constraints::frames::{axes_of, carrier_of, centre_of, hanging_point};
use crate::constraints::newton::compliant_by_heaviest;
use crate::constraints::retract::displaced;
use crate::constraints::rows::Rows;
use crate::error::{AssemblyFault, Fault};
use crate::math::quaternion::{rotate, rotate_back};
use crate::math::scalar::Real;
use crate::math::vec3::{cross, minus, over, read, write};
use crate::mechanism::kernels::{Compliant, Mechanism, Pivot, Plain, Stabilisation};
use crate::mechanism::report::BodyKind;
use crate::mechanism::turns;
use crate::monitor::Passage;
use crate::state::vector::{Array, StateParts};

/// The largest turn (rad), or movement in lengths of the mechanism, of a step.
const TURN: f64 = 0.2;

/// What the corrections of a step may be of it, and besides: its way is curved by no more.
const CURVED: [f64; 2] = [0.25, 0.005];

/// A correction that is less ends a step: the next one goes on from there, and the end is
/// corrected to round-off.
const SMALL: f64 = 1e-5;

/// Corrections of a step.
const CORRECTIONS: usize = 6;

/// How often a step is halved: a way that does not go on from there has come to a limit.
const HALVINGS: i32 = 24;

/// Steps of a way: some hundred turns.
const STEPS: usize = 5000;

/// How often a motion is projected onto what the constraints leave free: each time compliances
/// leave less of what they forbid, and the masses of the bodies matter less.
const PROJECTIONS: usize = 3;

/// What the last projection keeps of the work of a load on a motion that joints forbid: the limit
/// between forbidden and free.
const FORBIDDEN: f64 = 0.1;

/// Motions that are set together and can be told apart.
const SEARCHES: usize = 12;

/// What a motion may miss (rad, or lengths of the mechanism) of what was set and count as there.
const MISSED: f64 = 1e-5;

pub(super) struct Way<'a, S: Real, M: Mechanism> {
    constants: &'a M::Constants<S>,
    time: S,
    length: S,
    set: &'a Set<S, M>,
    state: M::State<S>,
    /// `Phi` at the start.
    before: M::Multipliers<S>,
    passage: Passage<S, M>,
    coefficients: M::Coefficients<S>,
    iterations: usize,
}

/// Where a way led.
pub(super) struct End<S: Real, M: Mechanism> {
    pub(super) state: M::State<S>,
    pub(super) steps: usize,
    pub(super) iterations: usize,
    /// The joint of a singular configuration that was passed.
    pub(super) passed: Option<&'static str>,
}

impl<'a, S: Real, M: Mechanism> Way<'a, S, M> {
    pub(super) fn new(
        constants: &'a M::Constants<S>,
        time: S,
        length: S,
        start: &M::State<S>,
        set: &'a Set<S, M>,
    ) -> Self {
        let mut start = *start;
        *start.velocities_mut() = Array::zeros();
        let rigid = Stabilisation {
            rate: S::zero(),
            position: S::zero(),
            compliance: S::zero(),
        };
        Self {
            constants,
            time,
            length,
            set,
            state: start,
            before: M::constraints(constants, time, &start),
            passage: Passage::from(S::zero()),
            coefficients: M::coefficients(constants, &rigid),
            iterations: 0,
        }
    }

    pub(super) fn go(mut self) -> Result<End<S, M>, Fault> {
        let one = S::one();
        let (mut share, mut step) = (S::zero(), one);
        let least = S::constant(2.0).powf(-f64::from(HALVINGS));
        if self.holds() {
            let size = self.set.size(self.length);
            step = one.min(S::constant(TURN).quotient(size));
        }
        let least = least * step;
        let state = self.state;
        self.pass(share, &state, S::zero());
        let mut steps = 0;
        // Whether the constraints let what was set move at all: else it contradicts them, or
        // itself, and the way ends where both are met best.
        let mut is_free = None;
        while share < one {
            let to = if one - share <= step * S::constant(1.5) {
                one
            } else {
                share + step
            };
            match self.step(to) {
                Some((next, motion)) => {
                    if is_free.is_none() {
                        is_free = Some(self.missed(&next, to) < S::constant(0.1) * motion);
                    }
                    if is_free == Some(true) && self.is_lost(&next, to) {
                        return Err(self.ends(share));
                    }
                    self.state = next;
                    self.pass(to, &next, motion);
                    let faster = S::constant(0.7 * TURN) * (to - share);
                    step = (step + step).min(faster.quotient(motion));
                    if !step.is_finite() {
                        step = one;
                    }
                    share = to;
                    steps += 1;
                }
                None if step > least => step = step.min(to - share) * S::constant(0.5),
                None => return Err(self.ends(share)),
            }
            if steps > STEPS {
                return Err(self.ends(share));
            }
        }
        if is_free == Some(true) || self.set.has_held {
            self.close();
        }
        let missed = self.missed(&self.state, one);
        let may_be_free = is_free == Some(true) || self.set.may_be_free() || self.set.has_held;
        if may_be_free && self.set.is_clean() && missed > S::constant(MISSED) {
            let gone = if is_free == Some(true) {
                share
            } else {
                S::zero()
            };
            return Err(self.ends(gone));
        }
        Ok(End {
            state: self.state,
            steps,
            iterations: self.iterations,
            passed: self.passage.passed(),
        })
    }

    /// Goes on to the last digits at the end of the way, where what was set is kept: a correction
    /// by the least movement in the metric of the mass would move the lightest body of all.
    fn close(&mut self) {
        let mut last = S::constant(SMALL).max(S::EPSILON.sqrt());
        for _ in 0..CORRECTIONS {
            let step = self.newton_step(&self.state, S::one());
            let size = reach::<S, M>(&step, self.length).size;
            let helps = size < S::constant(0.5) * last;
            if !helps {
                break;
            }
            self.iterations += 1;
            self.state = displaced::<S, M>(self.constants, &self.state, &step, S::one());
            last = size;
        }
    }

    /// What is missed of what was set (rad, or lengths of the mechanism).
    fn missed(&self, state: &M::State<S>, share: S) -> S {
        if !self.holds() {
            return S::zero();
        }
        let left = self.set.left(self.constants, state, share, self.length);
        reach::<S, M>(&left, S::one()).size
    }

    /// Whether a motion that was free has come to a limit.
    fn is_lost(&self, state: &M::State<S>, share: S) -> bool {
        /// What it may be behind (rad, or lengths of the mechanism): a tenth of a step.
        const BEHIND: f64 = 0.02;
        self.set.is_clean() && self.missed(state, share) > S::constant(BEHIND)
    }

    fn holds(&self) -> bool {
        self.set.is_part()
    }

    /// Shows a state to the monitor.
    fn pass(&mut self, share: S, state: &M::State<S>, motion: S) {
        let pivot = self.pivot(state);
        let at = (share, state);
        self.passage.step(self.constants, at, pivot, motion);
    }

    fn pivot(&self, state: &M::State<S>) -> Option<Pivot<S>> {
        if M::REPORT.keeps_redundant() {
            return None;
        }
        let (constants, coefficients) = (self.constants, &self.coefficients);
        Some(M::factor::<S, Plain>(constants, coefficients, self.time, state).1)
    }

    /// Why the way does not go on.
    #[cold]
    fn ends(&self, share: S) -> Fault {
        /// A pivot that has lost this part of its largest size.
        const NEARLY_VANISHED: f64 = 1e-2;
        let distance = self.passage.distance();
        let pivot = self.pivot(&self.state);
        let is_singular = distance * distance < S::constant(NEARLY_VANISHED);
        let joint = pivot.filter(|_| is_singular);
        let joint = joint.map(|pivot| pivot.joint.to_f64() as usize);
        let set = (0..M::REPORT.bodies.len()).find(|&body| self.holds() && self.set.holds(body));
        let carrier = set.and_then(|body| M::REPORT.carriers.get(body));
        let joint = joint.or_else(|| carrier.and_then(|carrier| carrier.joint));
        let info = joint.and_then(|joint| M::REPORT.joints.get(joint));
        Fault::Assembly(AssemblyFault::WayEnds {
            joint: info.map(|info| info.name),
            share: share.to_f64(),
        })
    }

    /// The state at a later share of the way, and how far it led; `None` where the step is too
    /// long.
    fn step(&mut self, to: S) -> Option<(M::State<S>, S)> {
        let mut state = self.state;
        let turn = S::constant(TURN);
        let (mut first, mut sum, mut last) = (None, S::zero(), S::zero());
        for _ in 0..CORRECTIONS {
            let step = self.newton_step(&state, to);
            let size = reach::<S, M>(&step, self.length).size;
            self.iterations += 1;
            let Some(motion) = first else {
                let is_short = size <= turn;
                if !is_short {
                    return None;
                }
                (first, last) = (Some(size), size);
                state = displaced::<S, M>(self.constants, &state, &step, S::one());
                continue;
            };
            sum = sum + size;
            let [part, besides] = CURVED.map(S::constant);
            let is_straight = sum <= part * motion + besides;
            let small = S::constant(SMALL).max(S::constant(64.0) * S::EPSILON);
            let is_small = size <= small;
            // Newton's method converges: corrections become less.
            if !is_straight || !is_small && size > S::constant(0.5) * last {
                return None;
            }
            state = displaced::<S, M>(self.constants, &state, &step, S::one());
            if is_small {
                turns::count::<S, M>(self.constants, &self.state, S::zero(), &mut state);
                return Some((state, motion));
            }
            last = size;
        }
        None
    }

    /// The step of Newton's method to a share of the way: what the constraints ask, by the least
    /// movement, and on top of it what was set, as far as they let it.
    fn newton_step(&self, state: &M::State<S>, share: S) -> M::Velocities<S> {
        let constants = self.constants;
        let rows = Rows::<S, M>::at(constants, self.time, state);
        let (coefficients, factors) =
            compliant_by_heaviest::<S, M>(constants, &rows, state, S::EPSILON.sqrt());
        let mut lower = M::constraints(constants, self.time, state);
        let left = S::one() - share;
        let places = lower.as_mut_slice().iter_mut();
        for (lower, &before) in places.zip(self.before.as_slice()) {
            *lower = left * before - *lower;
        }
        let none = M::Velocities::<S>::zeros();
        let mut step =
            M::solve::<S, Compliant>(constants, &coefficients, &factors, &none, &lower).0;
        if !self.holds() {
            return step;
        }
        let level = M::Multipliers::<S>::zeros();
        let mass = M::metric(constants);
        // What a load moves over what the constraints leave free, and its work there by the last
        // projection and by the one before.
        let free = |load: &M::Velocities<S>| {
            let mut momentum = *load;
            let mut motion = none;
            let mut works = [S::zero(); 2];
            for _ in 0..PROJECTIONS {
                let way = M::solve::<S, Compliant>;
                motion = way(constants, &coefficients, &factors, &momentum, &level).0;
                works = [product(load, &motion), works[0]];
                momentum = motion;
                let places = momentum.as_mut_slice().iter_mut().zip(mass.as_slice());
                places.for_each(|(place, &mass)| *place = *place * mass);
            }
            (motion, works)
        };
        // Conjugate gradients for the least squares of what is left, over what the constraints
        // leave free.
        let mut left = self.set.left(constants, state, share, self.length);
        add(&mut left, &self.relative(state, &step), -S::one());
        let load = self.load(state, &left);
        let (mut descent, [mut decrease, mut before]) = free(&load);
        let mut way = descent;
        for _ in 0..SEARCHES {
            let is_free = decrease > S::constant(FORBIDDEN) * before;
            if !is_free {
                break;
            }
            let moved = self.relative(state, &way);
            let factor = decrease.quotient(product(&moved, &moved));
            if !factor.is_finite() {
                break;
            }
            add(&mut step, &way, factor);
            add(&mut left, &moved, -factor);
            let load = self.load(state, &left);
            let works;
            (descent, works) = free(&load);
            let conjugate = works[0].quotient(decrease);
            [decrease, before] = works;
            let mut new = descent;
            add(&mut new, &way, conjugate);
            way = new;
            if product(&left, &left) <= S::EPSILON * S::EPSILON {
                break;
            }
        }
        step
    }

    /// How bodies that were set move against what carries them, in the units of [`Set::left`].
    fn relative(&self, state: &M::State<S>, step: &M::Velocities<S>) -> M::Velocities<S> {
        let mut relative = M::Velocities::<S>::zeros();
        for (body, info) in M::REPORT.bodies.iter().enumerate() {
            if !self.set.holds(body) {
                continue;
            }
            let point = hanging_point::<S, M>(self.constants, state, body);
            let carrier = carrier_of::<M>(body);
            let own = velocity_at::<S, M>(state, step, Some(body), &point);
            let base = velocity_at::<S, M>(state, step, carrier, &point);
            let slide = over(&minus(&own.0, &base.0), self.length);
            write(relative.as_mut_slice(), info.velocity, slide);
            if info.kind == BodyKind::Rigid {
                let turn = minus(&own.1, &base.1);
                write(relative.as_mut_slice(), info.velocity + 3, turn);
            }
        }
        relative
    }

    /// The transpose of [`Way::relative`].
    fn load(&self, state: &M::State<S>, left: &M::Velocities<S>) -> M::Velocities<S> {
        let mut load = M::Velocities::<S>::zeros();
        for (body, info) in M::REPORT.bodies.iter().enumerate() {
            if !self.set.holds(body) {
                continue;
            }
            let point = hanging_point::<S, M>(self.constants, state, body);
            let force = read::<S, 3>(left.as_slice(), info.velocity);
            let force = over(&force, self.length);
            let moment = match info.kind {
                BodyKind::Rigid => read::<S, 3>(left.as_slice(), info.velocity + 3),
                BodyKind::Particle => [S::zero(); 3],
            };
            for (body, sign) in [(Some(body), S::one()), (carrier_of::<M>(body), -S::one())] {
                add_load::<S, M>(&mut load, state, body, &point, [force, moment], sign);
            }
        }
        load
    }
}

/// Velocity of a point that moves with a body, and its angular velocity: global axes.
fn velocity_at<S: Real, M: Mechanism>(
    state: &M::State<S>,
    step: &M::Velocities<S>,
    body: Option<usize>,
    point: &[S; 3],
) -> ([S; 3], [S; 3]) {
    let zero = [S::zero(); 3];
    let Some(info) = body.and_then(|body| M::REPORT.bodies.get(body)) else {
        return (zero, zero);
    };
    let spin = match info.kind {
        BodyKind::Rigid => rotate(
            &axes_of::<S, M>(state, body),
            &read(step.as_slice(), info.velocity + 3),
        ),
        BodyKind::Particle => zero,
    };
    let [x, y, z] = read(step.as_slice(), info.velocity);
    let [a, b, c] = cross(&spin, &minus(point, &centre_of::<S, M>(state, body)));
    ([x + a, y + b, z + c], spin)
}

/// Adds a force at a point and a moment (global axes), times a sign, to the load of a body.
fn add_load<S: Real, M: Mechanism>(
    load: &mut M::Velocities<S>,
    state: &M::State<S>,
    body: Option<usize>,
    point: &[S; 3],
    [force, moment]: [[S; 3]; 2],
    sign: S,
) {
    let Some(info) = body.and_then(|body| M::REPORT.bodies.get(body)) else {
        return;
    };
    let slice = load.as_mut_slice();
    let accumulate = |slice: &mut [S], place: usize, add: [S; 3]| {
        let [x, y, z] = read(slice, place);
        let [a, b, c] = add;
        write(slice, place, [x + sign * a, y + sign * b, z + sign * c]);
    };
    accumulate(slice, info.velocity, force);
    if info.kind == BodyKind::Rigid {
        let arm = minus(point, &centre_of::<S, M>(state, body));
        let [a, b, c] = cross(&arm, &force);
        let [x, y, z] = moment;
        let whole = [x + a, y + b, z + c];
        let own = rotate_back(&axes_of::<S, M>(state, body), &whole);
        accumulate(slice, info.velocity + 3, own);
    }
}

/// `to + factor a`.
fn add<S: Real, A: Array<S>>(to: &mut A, a: &A, factor: S) {
    let places = to.as_mut_slice().iter_mut().zip(a.as_slice());
    places.for_each(|(to, &a)| *to = a.fused(factor, *to));
}

/// `a . b`.
fn product<S: Real, A: Array<S>>(a: &A, b: &A) -> S {
    let pairs = a.as_slice().iter().zip(b.as_slice());
    pairs.fold(S::zero(), |sum, (&a, &b)| a.fused(b, sum))
}
