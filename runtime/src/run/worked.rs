//! The work of forces over a step, of which its ends do not tell: where the power jumps within it,
//! turns as fast as the direction of a force does, or is the first after a jump.
//!
//! The power along the interpolant of the method is summed by Simpson's rule, over halves and
//! halves of halves, as far as two rules disagree (Lyness, *Notes on the Adaptive Simpson
//! Quadrature Routine*, J. ACM 16, 1969).

use crate::dynamics::equations::Exchanged;
use crate::math::quaternion::{conjugate, product};
use crate::math::scalar::Real;
use crate::math::vec3::{cross, minus, norm, over, plus, read, times, write};
use crate::mechanism::at::At;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::monitor::{Monitor, Work};
use crate::state::vector::{Array, StateParts};
use crate::stepping::marching::Marching;

/// How often a step is halved at the most.
const FINEST: usize = 8;

/// The rotation (rad) of a body in a step from which on its way is not compared with velocities:
/// Simpson's rule misses a part of some 1e-6 of it.
const TURNED_FAR: f64 = 0.3;

/// What is left of the error of Simpson's rule by halves, over their difference.
const BY_HALVES: f64 = 1.0 / 15.0;

/// The power (W) at the end of the last step, or at an event within it, where bodies stand so, and
/// the work since the end of the one before where it is asked for. Before the end is corrected. And
/// how many evaluations that has taken.
#[inline]
pub(super) fn worked<S: Real, M: Mechanism>(
    monitor: &Monitor<S, M>,
    march: &mut dyn Marching<S, M>,
    At { time: end, bodies }: At<S, &M::State<S>>,
    is_event: bool,
    near: &M::State<S>,
) -> (Exchanged<S>, usize) {
    let stagger = monitor.stagger(end);
    let at_end = |march: &dyn Marching<S, M>| {
        if is_event {
            march.power_at_event(stagger, (end, bodies))
        } else {
            march.power_at_end(stagger, bodies)
        }
    };
    let power = at_end(march);
    let asked = power.filter(|_| stagger.is_none());
    let asked = asked.and_then(|power| Some((power, monitor.asks_for_work(end, power)?)));
    let Some((last, (first, precision))) = asked else {
        return ((power, None), 0);
    };
    let before = march.counts().evaluations;
    let equations = march.equations();
    let (seen, iterations) = (equations.seen(), equations.iterations());
    let mut step = Worked {
        near,
        is_fixed: march.estimate().is_none(),
        march,
    };
    let span = [(monitor.time(), first), (end, last)];
    let work = step.over(span, precision);
    let equations = march.equations_mut();
    equations.recall(seen);
    equations.recall_iterations(iterations);
    // A friction by load keeps what it was asked last.
    let power = if work.is_some() && march.settings().interacts {
        at_end(march)
    } else {
        power
    };
    let looks = march.counts().evaluations.saturating_sub(before);
    ((power, work), looks)
}

/// A step whose work is looked for.
struct Worked<'w, S: Real, M: Mechanism> {
    march: &'w mut (dyn Marching<S, M> + 'w),
    near: &'w M::State<S>,
    /// Whether nothing controls the steps.
    is_fixed: bool,
}

/// A part of a step: its ends, its middle, and its work (J) by Simpson's rule.
#[derive(Clone, Copy)]
struct Part<S> {
    ends: [(S, S); 2],
    middle: (S, S),
    work: S,
}

impl<S: Real> Part<S> {
    fn of(ends: [(S, S); 2], middle: (S, S)) -> Self {
        let [(start, first), (end, last)] = ends;
        let sum = S::constant(4.0).fused(middle.1, first + last);
        Self {
            ends,
            middle,
            work: (end - start) * sum * S::constant(1.0 / 6.0),
        }
    }

    /// The work (J) whatever its sign, by the trapezoids.
    fn turnover(&self) -> S {
        let [(start, first), (end, last)] = self.ends;
        let sum = first.abs() + last.abs() + self.middle.1.abs() + self.middle.1.abs();
        S::constant(0.25) * (end - start) * sum
    }
}

impl<S: Real, M: Mechanism> Worked<'_, S, M> {
    /// Time and power in the middle of two others; `None` where there is no telling.
    #[inline(never)]
    fn between(&mut self, [(start, _), (end, _)]: [(S, S); 2]) -> Option<(S, S)> {
        let time = S::constant(0.5) * (start + end);
        Some((time, self.march.power_within(time, self.near)?))
    }

    #[inline(never)]
    fn over(&mut self, ends: [(S, S); 2], precision: S) -> Option<Work<S>> {
        let middle = self.between(ends)?;
        let mut work = self.parts(Part::of(ends, middle), precision, 0)?;
        if self.is_fixed {
            work.done = work.done + self.by_lag(ends.map(|(time, _)| time))?;
        }
        Some(work)
    }

    /// The work (J) over what places change by in a step and velocities do not tell: the errors of
    /// a step in both are of one size, and the potential that forces have goes by places.
    /// Velocities of a cubic are told by three of them.
    #[inline(never)]
    fn by_lag(&mut self, [start, end]: [S; 2]) -> Option<S> {
        let half = S::constant(0.5) * (end - start);
        let times = [start, start + half, end];
        let mut nodes = [*self.near; 3];
        for (node, time) in nodes.iter_mut().zip(times) {
            *node = self.march.at(time, self.near).ok()?;
        }
        // By joints a step may be some turns, of which velocities here and there tell nothing.
        if turns_far::<S, M>(&nodes, end - start) {
            return Some(S::zero());
        }
        let lag = lag::<S, M>(&nodes, end - start);
        let equations = self.march.equations();
        let mut sum = S::zero();
        for ((node, time), weight) in nodes.iter_mut().zip(times).zip([1.0, 4.0, 1.0]) {
            let before = equations.power_of_forces(time, node);
            let velocities = node.velocities_mut().as_mut_slice().iter_mut();
            velocities
                .zip(lag.as_slice())
                .for_each(|(velocity, &lag)| *velocity = *velocity + lag);
            let after = equations.power_of_forces(time, node);
            sum = S::constant(weight).fused(after - before, sum);
        }
        Some((end - start) * S::constant(1.0 / 6.0) * sum)
    }

    fn parts(&mut self, part: Part<S>, precision: S, depth: usize) -> Option<Work<S>> {
        let [start, end] = part.ends;
        let halves = [[start, part.middle], [part.middle, end]];
        let [before, after] = halves;
        let before = Part::of(before, self.between(before)?);
        let after = Part::of(after, self.between(after)?);
        let done = before.work + after.work;
        let difference = done - part.work;
        let is_smooth = S::constant(BY_HALVES) * difference.abs() <= precision;
        if is_smooth || depth == FINEST {
            // Where it is not smooth, the rule says nothing of what is left.
            let left = S::constant(BY_HALVES) * difference;
            return Some(Work {
                done: if is_smooth { done + left } else { done },
                unsure: if is_smooth { left } else { difference }.abs(),
                turnover: before.turnover() + after.turnover(),
            });
        }
        let half = S::constant(0.5) * precision;
        let before = self.parts(before, half, depth + 1)?;
        let after = self.parts(after, half, depth + 1)?;
        Some(Work {
            done: before.done + after.done,
            unsure: before.unsure + after.unsure,
            turnover: before.turnover + after.turnover,
        })
    }
}

/// Whether a body turns so far in a step (s) that Simpson's rule misses more of its way than a
/// method does.
fn turns_far<S: Real, M: Mechanism>(nodes: &[M::State<S>; 3], step: S) -> bool {
    let rigid = M::REPORT.bodies.iter();
    let mut rigid = rigid.filter(|body| body.kind == BodyKind::Rigid);
    rigid.any(|body| {
        let is_fast = |node: &M::State<S>| {
            let spin: [S; 3] = read(node.velocities().as_slice(), body.velocity + 3);
            let is_slow = norm(&spin) * step < S::constant(TURNED_FAR);
            !is_slow
        };
        nodes.iter().any(is_fast)
    })
}

/// What mean velocities over a step (s), from its start over its middle to its end, lack of the
/// way.
///
/// Of a rotation `p' = 1/2 p w` the way is `h w + h^2 / 12 w0 x w1`, up to a power of the step that
/// is higher by two (Magnus; Iserles and others, *Lie-group methods*, Acta Numerica 9, 2000).
fn lag<S: Real, M: Mechanism>(nodes: &[M::State<S>; 3], step: S) -> M::Velocities<S> {
    let mut lag = M::Velocities::<S>::zeros();
    let [first, middle, last] = nodes;
    let velocity = |node: &M::State<S>, place| read::<S, 3>(node.velocities().as_slice(), place);
    let mut put = |place: usize, way: [S; 3]| {
        let [a, b, c] = [
            velocity(first, place),
            velocity(middle, place),
            velocity(last, place),
        ];
        let sum = plus(&plus(&a, &c), &times(&b, S::constant(4.0)));
        let mean = times(&sum, S::constant(1.0 / 6.0));
        let lack = minus(&over(&way, step), &mean);
        write(lag.as_mut_slice(), place, lack);
    };
    for body in M::REPORT.bodies {
        let from = read(first.coordinates().as_slice(), body.coordinate);
        let to = read(last.coordinates().as_slice(), body.coordinate);
        put(body.velocity, minus(&to, &from));
        if body.kind == BodyKind::Rigid {
            let place = body.velocity + 3;
            let (w0, w1) = (velocity(first, place), velocity(last, place));
            let bend = times(&cross(&w0, &w1), S::constant(1.0 / 12.0) * step * step);
            let p = read(first.coordinates().as_slice(), body.coordinate + 3);
            let q = read(last.coordinates().as_slice(), body.coordinate + 3);
            put(place, minus(&rotation(&p, &q), &bend));
        }
    }
    lag
}

/// The rotation vector (rad, body axes) from one orientation to another.
fn rotation<S: Real>(from: &[S; 4], to: &[S; 4]) -> [S; 3] {
    let [e0, e1, e2, e3] = product(&conjugate(from), to);
    let e = [e1, e2, e3];
    let sine = norm(&e);
    let factor = if sine > S::zero() {
        S::constant(2.0) * sine.atan2(e0).quotient(sine)
    } else {
        S::constant(2.0)
    };
    times(&e, factor)
}

/// Begins to watch an integration: shows the monitor its start.
pub(super) fn begin_to_watch<S: Real, M: Mechanism>(
    monitor: &mut Monitor<S, M>,
    march: &mut dyn Marching<S, M>,
    bodies: &M::State<S>,
) {
    let time = march.time();
    let power = march.power_at_end(monitor.stagger(time), bodies);
    let equations = march.equations_mut();
    equations.monitor(monitor, At { time, bodies }, None, (power, None));
}
