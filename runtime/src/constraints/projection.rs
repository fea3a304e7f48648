//! Correction of positions and velocities onto the constraints.

use crate::constraints::newton::{Depth, Iterate};
use crate::constraints::self_stress::{passing, self_stressed};
use crate::error::setting::positive;
use crate::error::step::counted;
use crate::error::{Fault, StepFault};
use crate::math::scalar::Real;
use crate::math::vec3::square;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::{check_state, with_unit_orientations};
use crate::state::vector::Array;

/// The correction of a state onto the constraints, by the least movement in the metric of the mass.
///
/// Positions by Newton's method: the displacement `d` (m, and rad along body axes) of least
/// `d^T M d` with `D d = -Phi` comes from the saddle system of the dynamics,
///
/// ```text
/// [ M   D^T ] [ d      ]   [  0   ]
/// [ D   -E  ] [ lambda ] = [ -Phi ]
/// ```
///
/// then `r + d` and a finite rotation of `p`, which keeps length 1; angles that count turns follow;
/// a step that does not lessen `Phi` is halved. Velocities by the same system with `-Phi'`. The
/// compliances `E` are a part of the diagonal of `D M^-1 D^T`, row by row: the part is that of the
/// violation in sizes of its row, at most `sqrt(EPSILON)` and at least `64 EPSILON`. They keep the
/// system solvable where equations are redundant or the configuration is singular, and do not limit
/// the accuracy, because the corrections are repeated as long as they help.
///
/// **The size of a row** is what its violation is compared with: its joint's own length, the
/// longest arm from a centre of mass to the joint's point (the distance of the points of a
/// [`Distance`](crate::joints::Distance); the extent of the mechanism where all arms vanish), in
/// the units of the row, and one radian for a row of directions. So a violation counts the same for
/// a mechanism of any size, at any place and in any units. Far from the origin, or after many
/// turns, the terms of a row resolve less than that: there a row counts as corrected where its
/// terms resolve nothing more, if they resolve two digits at least.
///
/// **Near singular configurations** equations are nearly dependent, and along the multipliers whose
/// loads `D^T lambda` cancel, a state of self-stress, a violation can be lessened by long movements
/// only, or not at all. A run on its way through may keep such a violation, up to `sqrt(tolerance)`
/// in place of `tolerance`, where its loads cancel to a hundredth on every body; a few steps later
/// the equations are independent again and it is corrected. [`Correction::residual`] tells.
/// [`Projection::correct`] and everything that looks for a configuration (`assemble`,
/// [`KinematicAnalysis`](crate::KinematicAnalysis)) keep none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection<S> {
    /// The largest `|Phi|` and `|Phi'|` that count as corrected, in sizes of their rows; of a row
    /// of `Phi'` this is what the velocities of one of its bodies add to it. The iteration goes on
    /// below it as long as it helps.
    pub tolerance: S,
    /// How many steps of Newton's method may be done.
    pub max_iterations: usize,
}

/// A tolerance of 1e-10, at least `1000 EPSILON`, and 50 iterations.
impl<S: Real> Default for Projection<S> {
    fn default() -> Self {
        let tolerance = S::constant(1e-10).max(S::constant(1e3) * S::EPSILON);
        Self {
            tolerance,
            max_iterations: 50,
        }
    }
}

/// What a correction did.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Correction<S> {
    /// Steps of Newton's method for the positions.
    pub iterations: usize,
    /// `Phi^T Phi` before, as given.
    pub violation_before: S,
    /// `Phi^T Phi` after.
    pub violation_after: S,
    /// `Phi'^T Phi'` before, as given.
    pub velocity_violation_before: S,
    /// `Phi'^T Phi'` after.
    pub velocity_violation_after: S,
    /// The largest `|Phi|` or `|Phi'|` beyond the tolerance that was kept as nearly a state of
    /// self-stress, in sizes of its row; zero where all is within. A run may keep some,
    /// [`Projection::correct`] keeps none.
    pub residual: S,
    /// How far an assembly moved; `None` of a correction of another kind.
    pub moved: Option<Moved<S>>,
}

/// How far an assembly moved a state, see
/// [`MechanismExt::assemble`](crate::MechanismExt::assemble): the body that stands furthest, in
/// radians or lengths of the mechanism, from where it stood in the state that was given.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Moved<S> {
    /// The body's field.
    pub body: &'static str,
    /// The field of the joint that carries it in the spanning tree, else of the first joint that
    /// speaks of it; `None` where none does.
    pub joint: Option<&'static str>,
    /// Its rotation (rad).
    pub angle: S,
    /// The movement of its centre of mass (m).
    pub length: S,
    /// The steps by which a branch was followed; zero where the state was near enough to be
    /// corrected at once.
    pub steps: usize,
    /// The joint of a singular configuration that was passed on the way, or nearly: another branch
    /// begins there.
    pub passed: Option<&'static str>,
}

/// The largest violation that a state on its way may keep, in sizes of its row, however coarse the
/// tolerance is.
const EXCUSED: f64 = 1e-2;

impl<S: Real> Projection<S> {
    /// Corrects positions, then velocities; Euler parameters come out at length 1.
    ///
    /// # Errors
    /// [`StepFault::NotConverged`] with the `|Phi|` or `|Phi'|` left that is largest in sizes of
    /// its row and its joint, [`StepFault::StateNotFinite`], [`StepFault::ZeroOrientation`], or
    /// [`StartFault::Setting`](crate::error::StartFault::Setting) for a tolerance that is not
    /// finite and positive; the state is then as before.
    pub fn correct<M: Mechanism>(
        &self,
        constants: &M::Constants<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Result<Correction<S>, Fault> {
        self.correct_by::<M>(Measure::Whole, constants, time, state)
    }

    /// [`Projection::correct`] for a state on its way, which may keep a violation that is nearly a
    /// state of self-stress. Not part of a step: its stack would be that of every step.
    #[inline(never)]
    pub(crate) fn correct_in_motion<M: Mechanism>(
        &self,
        constants: &M::Constants<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Result<Correction<S>, Fault> {
        self.correct_by::<M>(Measure::Correctable, constants, time, state)
    }

    /// Corrects velocities alone, of a state on its way; what was kept beyond the tolerance.
    #[inline(never)]
    pub(crate) fn correct_velocities<M: Mechanism>(
        &self,
        constants: &M::Constants<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Result<S, Fault> {
        positive("tolerance of the projection", self.tolerance)?;
        check_state::<S, M>(state)?;
        let mut given = with_unit_orientations::<S, M>(state);
        M::rewrap(constants, &mut given);
        let given = Iterate::<S, M>::positions(constants, time, &given).velocities(constants);
        let limits = (self.tolerance, self.max_iterations);
        let measure = Measure::Correctable;
        let (velocities, residual) =
            self.corrected(measure, constants, given, |given, depth| {
                given.velocities_corrected(constants, limits, depth)
            })?;
        *state = velocities.state;
        Ok(residual)
    }

    fn correct_by<M: Mechanism>(
        &self,
        measure: Measure,
        constants: &M::Constants<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Result<Correction<S>, Fault> {
        positive("tolerance of the projection", self.tolerance)?;
        let limits = (self.tolerance, self.max_iterations);
        let positions = |given| {
            self.corrected(measure, constants, given, |given: Iterate<S, M>, depth| {
                given.positions_corrected(constants, limits, depth)
            })
        };
        let velocities = |given| {
            self.corrected(measure, constants, given, |given: Iterate<S, M>, depth| {
                given.velocities_corrected(constants, limits, depth)
            })
        };
        in_turn::<S, M>(constants, time, state, positions, velocities)
    }

    /// The last iterate, and the violation that is left, in sizes of its row.
    fn corrected<M: Mechanism>(
        &self,
        measure: Measure,
        constants: &M::Constants<S>,
        given: Iterate<S, M>,
        iterate: impl Fn(Iterate<S, M>, Depth) -> Iterate<S, M>,
    ) -> Result<(Iterate<S, M>, S), Fault> {
        let within = |last: &Iterate<S, M>| last.sizes.within(&last.violation, self.tolerance);
        if matches!(measure, Measure::Whole) {
            let last = iterate(given, Depth::Dependent);
            return if within(&last) {
                Ok((last, S::zero()))
            } else {
                Err(self.fault(&last))
            };
        }
        let last = iterate(given, Depth::Independent);
        if within(&last) {
            return Ok((last, S::zero()));
        }
        let multipliers = last.rows.multipliers(&last.violation);
        let limit = self.tolerance.sqrt().min(S::constant(EXCUSED));
        let (time, state) = (last.rows.time, &last.state);
        let excusable = last.sizes.within(&last.violation, limit)
            && self_stressed::<S, M>(constants, time, state, &multipliers);
        let residual = |last: Iterate<S, M>| {
            let (_, rest) = last.sizes.worst(&last.violation, self.tolerance);
            Ok((last, rest))
        };
        if excusable && passing::<S, M>(constants, time, state, &multipliers) {
            return residual(last);
        }
        // Rows that stay nearly dependent may take long movements; on the way through a singular
        // configuration these were none that correct anything.
        let far = iterate(last, Depth::Persistent);
        if within(&far) {
            Ok((far, S::zero()))
        } else if excusable {
            residual(last)
        } else {
            Err(self.fault(&last))
        }
    }

    fn fault<M: Mechanism>(&self, last: &Iterate<S, M>) -> Fault {
        let (row, rest) = last.sizes.worst(&last.violation, self.tolerance);
        let residual = last.violation.as_slice().get(row);
        Fault::Step(StepFault::NotConverged {
            iterations: counted(last.iterations),
            residual: residual.map_or(rest, |phi| phi.abs()).to_f64(),
            joint: M::REPORT.joint_of(row),
            alpha: None,
        })
    }
}

/// Corrects positions, then velocities, by functions that return what they left as well; the state
/// is as before where one fails.
fn in_turn<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &mut M::State<S>,
    positions: impl FnOnce(Iterate<S, M>) -> Result<(Iterate<S, M>, S), Fault>,
    velocities: impl FnOnce(Iterate<S, M>) -> Result<(Iterate<S, M>, S), Fault>,
) -> Result<Correction<S>, Fault> {
    check_state::<S, M>(state)?;
    let phi = |state: &M::State<S>| M::constraints(constants, time, state);
    let phi_rate = |state: &M::State<S>| M::constraint_rates(constants, time, state);
    let (position_before, velocity_before) = (phi(state), phi_rate(state));
    let mut given = with_unit_orientations::<S, M>(state);
    M::rewrap(constants, &mut given);
    let given = Iterate::<S, M>::positions(constants, time, &given);
    let (placed, left) = positions(given)?;
    let iterations = placed.iterations;
    let (moving, rates_left) = velocities(placed.velocities(constants))?;
    *state = moving.state;
    Ok(Correction {
        iterations,
        violation_before: square(position_before.as_slice()),
        violation_after: square(phi(state).as_slice()),
        velocity_violation_before: square(velocity_before.as_slice()),
        velocity_violation_after: square(phi_rate(state).as_slice()),
        residual: left.max(rates_left),
        moved: None,
    })
}

/// Which violation counts.
#[derive(Clone, Copy)]
enum Measure {
    /// All of it.
    Whole,
    /// Not what is nearly a state of self-stress.
    Correctable,
}
