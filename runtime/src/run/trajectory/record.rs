//! A run that records its motion.

use super::{FINEST, POINTS, Recorded, Trajectory, interpolated};
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::with_unit_orientations;
use crate::mechanism::turns;
use crate::run::events::list::Happening;
use crate::run::observed::Observed;
use crate::state::vector::{MovingState as _, Vector as _};

/// By how much elements may differ from the motion, in units of round-off, relative to those of
/// size 1 and more.
const SAME: f64 = 65_536.0;

/// The intervals that are tried first.
const COARSEST: usize = 4;

impl<S: Real, M: Mechanism> Happening<S, M> for Recorded<'_, M, S> {
    fn records(&self) -> bool {
        true
    }

    fn record(&mut self, visit: &mut dyn FnMut(&mut Trajectory<M, S>)) {
        visit(self.0);
    }
}

/// The points of a step, of which some are known.
type Points<X> = [Option<X>; FINEST + 1];

impl<S: Real, M: Mechanism> Observed<'_, S, M> {
    /// Begins what is recorded at a time (s).
    pub(crate) fn begin_records(&mut self, time: S, is_new: bool) {
        self.each_record(&mut |trajectory| {
            if is_new {
                *trajectory = Trajectory::new();
            }
            trajectory.go_on_from(time);
        });
    }

    /// Records the last step up to a time, of which the bodies are known if it is not its end;
    /// before it is corrected. Whether anything is recorded.
    pub(crate) fn record_within(
        &mut self,
        (end, at_end): (S, Option<&M::State<S>>),
        &At {
            time: start,
            bodies: ref from,
        }: &StateAt<S, M>,
    ) -> Result<bool, Fault> {
        if !self.driver.course.hybrid.records {
            return Ok(false);
        }
        if end <= start {
            return Ok(false);
        }
        let seen = self.driver.march.equations().seen();
        let mut points: Points<M::State<S>> = [None; FINEST + 1];
        let to = match at_end {
            Some(bodies) => *bodies,
            None => self.driver.march.within((start, from), end)?,
        };
        points[FINEST] = Some(self.recorded(end, to)?);
        let look = |run: &mut Self, points: &mut Points<M::State<S>>, intervals: usize| {
            for place in (0..=FINEST).step_by(FINEST / intervals) {
                let Some(point @ None) = points.get_mut(place) else {
                    continue;
                };
                let part = POINTS.get(place).copied().unwrap_or(1.0);
                let time = S::constant(part).fused(end - start, start);
                let bodies = run.driver.march.within((start, from), time)?;
                *point = Some(run.recorded(time, bodies)?);
            }
            Ok::<(), Fault>(())
        };
        let mut intervals = COARSEST;
        look(self, &mut points, intervals)?;
        while intervals < FINEST {
            let finer = 2 * intervals;
            look(self, &mut points, finer)?;
            if is_near::<S, M>(&points, intervals) {
                break;
            }
            intervals = finer;
        }
        self.driver.march.equations_mut().recall(seen);
        self.each_record(&mut |trajectory| {
            let known = points.iter().step_by(FINEST / intervals);
            trajectory.add((start, end), from, known.filter_map(|point| *point));
        });
        Ok(true)
    }

    /// Ends the last step that was recorded with the state with which the run goes on.
    pub(crate) fn record_end(&mut self, At { bodies: state, .. }: &StateAt<S, M>) {
        self.each_record(&mut |trajectory| trajectory.end_with(state));
    }

    /// A state as a report would show it, in its normal form: the end of a step has it, and its
    /// interpolant has not.
    fn recorded(&mut self, time: S, bodies: M::State<S>) -> Result<M::State<S>, Fault> {
        let mut bodies = with_unit_orientations::<S, M>(&bodies);
        let constants = self.driver.march.equations().constants();
        M::rewrap(constants, &mut bodies);
        // Angles as they are there, of which the polynomial is made.
        let counted = bodies;
        turns::count::<S, M>(constants, &counted, S::zero(), &mut bodies);
        match self.driver.stabilisation {
            Some(stabilisation) => self.driver.stabilised(stabilisation, time, bodies),
            None => Ok(bodies),
        }
    }

    fn each_record(&mut self, visit: &mut dyn FnMut(&mut Trajectory<M, S>)) {
        if self.driver.course.hybrid.records {
            let _ = self.driver.list.each(&mut |happening| {
                happening.record(visit);
                Ok(())
            });
        }
    }
}

/// Whether the polynomial through points this far apart goes through those between them.
fn is_near<S: Real, M: Mechanism>(points: &Points<M::State<S>>, intervals: usize) -> bool {
    let stride = FINEST / intervals;
    let mut known = [M::State::<S>::zeros(); FINEST + 1];
    for (to, from) in known.iter_mut().zip(points.iter().step_by(stride)) {
        *to = from.unwrap_or(*to);
    }
    let Some(known) = known.get(..=intervals) else {
        return false;
    };
    let between = points.iter().zip(POINTS).skip(stride / 2).step_by(stride);
    { between }.all(|(point, part)| {
        let Some(point) = point else {
            return false;
        };
        let there = interpolated::<S, M>(known, S::constant(part));
        let point = with_unit_orientations::<S, M>(point);
        let allowed = S::constant(SAME) * S::EPSILON;
        let off = point.weighted_norm(&there, S::one(), [(S::one(), &point), (-S::one(), &there)]);
        off <= allowed
    })
}
