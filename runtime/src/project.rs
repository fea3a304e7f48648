//! Correction of positions and velocities onto the constraints.

use crate::array::{Array, StateParts};
use crate::displace::displaced;
use crate::error::Fault;
use crate::integrate::positive;
use crate::mechanism::{Compliant, Mechanism, Stabilisation};
use crate::rotation::{check_state, with_unit_orientations};
use crate::scalar::{Real, Scalar};
use crate::self_stress::self_stressed;
use crate::view::square;

/// The correction of a state onto the constraints, by the least movement in the metric of the mass.
///
/// Positions by Newton's method: the displacement `d` (m, and rad along body axes) of least `d^T M d` with `D d = -Phi` comes from
/// the saddle system of the dynamics,
///
/// ```text
/// [ M   D^T ] [ d      ]   [  0   ]
/// [ D  -e I ] [ lambda ] = [ -Phi ]
/// ```
///
/// then `r + d` and a finite rotation of `p`, which keeps length 1; angles that count turns follow; a step that does not lessen `Phi` is halved. Velocities by the
/// same system with `-Phi'`. The compliance `e` is small against the diagonal of `D M^-1 D^T`: `sqrt(EPSILON)` of its
/// least element, at least `16 EPSILON` of its largest. It keeps the system solvable where equations are redundant or the configuration is
/// singular, and does not limit the accuracy, because the corrections are repeated as long as they help.
///
/// **Near singular configurations** equations are nearly dependent, and along the multipliers whose loads `D^T lambda` cancel, a
/// state of self-stress, a violation can be lessened by long movements only, or not at all. A run on its way through may keep such
/// a violation, up to `sqrt(tolerance)` in place of `tolerance`, where its loads cancel to a hundredth on every body; a
/// few steps later the equations are independent again and it is corrected. [`Projection::correct`] and everything that
/// looks for a configuration (`assemble`, [`KinematicAnalysis`](crate::KinematicAnalysis)) keep none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection<S> {
    /// The largest `|Phi|` and `|Phi'|` that count as corrected, times `1 + |q|^2 + |a|` and `1 + |u|` (largest
    /// elements, SI units; `a` the angles that count turns). The iteration goes on below it as long as it helps.
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
}

impl<S: Real> Projection<S> {
    /// Corrects positions, then velocities; Euler parameters come out at length 1.
    ///
    /// # Errors
    /// [`Fault::NotConverged`] with the largest `|Phi|` or `|Phi'|` left and its joint, [`Fault::StateNotFinite`], [`Fault::ZeroOrientation`], or [`Fault::Setting`] for a
    /// tolerance that is not finite and positive; the state is then as before.
    pub fn correct<M: Mechanism>(
        &self,
        constants: &M::Constants<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Result<Correction<S>, Fault> {
        self.correct_by::<M>(Measure::Whole, constants, time, state)
    }

    /// [`Projection::correct`] for a state on its way, which may keep a violation that is nearly a state of self-stress.
    pub(crate) fn correct_in_motion<M: Mechanism>(
        &self,
        constants: &M::Constants<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Result<Correction<S>, Fault> {
        self.correct_by::<M>(Measure::Correctable, constants, time, state)
    }

    fn correct_by<M: Mechanism>(
        &self,
        measure: Measure,
        constants: &M::Constants<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Result<Correction<S>, Fault> {
        positive("tolerance of the projection", self.tolerance)?;
        check_state::<S, M>(state)?;
        let phi = |state: &M::State<S>| M::constraints(constants, time, state);
        let phi_rate = |state: &M::State<S>| M::constraint_rates(constants, time, state);
        let (position_before, velocity_before) = (phi(state), phi_rate(state));
        let mut corrected = with_unit_orientations::<S, M>(state);
        M::recount(constants, &mut corrected);
        let positions = self.correct_positions::<M>(constants, time, &mut corrected);
        self.verdict::<M>(measure, constants, time, &corrected, &positions)?;
        let velocities = self.correct_velocities::<M>(constants, time, &mut corrected);
        self.verdict::<M>(measure, constants, time, &corrected, &velocities)?;
        *state = corrected;
        Ok(Correction {
            iterations: positions.iterations,
            violation_before: square(position_before.as_slice()),
            violation_after: square(phi(state).as_slice()),
            velocity_violation_before: square(velocity_before.as_slice()),
            velocity_violation_after: square(phi_rate(state).as_slice()),
        })
    }

    fn correct_positions<M: Mechanism>(
        &self,
        constants: &M::Constants<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Outcome<S, M> {
        let coordinates = state.coordinates().as_slice();
        let (bodies, auxiliaries) = coordinates
            .split_at_checked(M::REPORT.coordinates)
            .unwrap_or((coordinates, &[]));
        let size = largest(bodies);
        let scale = size.fused(size, S::one() + largest(auxiliaries));
        let round_off = S::constant(4.0) * S::EPSILON * scale;
        let mut phi = M::constraints(constants, time, state);
        let mut rest = largest(phi.as_slice());
        let mut iterations = 0;
        while iterations < self.max_iterations && rest > round_off {
            let step = correction::<S, M>(constants, time, state, &phi);
            if let Some((moved, moved_phi)) = descend::<S, M>(constants, time, state, &step, rest) {
                iterations += 1;
                *state = moved;
                phi = moved_phi;
                rest = largest(phi.as_slice());
                continue;
            }
            // What can be corrected beside a violation that cannot.
            let moved = displaced::<S, M>(constants, state, &step, S::one());
            let moved_phi = M::constraints(constants, time, &moved);
            if rest > self.tolerance * scale
                && square(moved_phi.as_slice()) < square(phi.as_slice())
            {
                *state = moved;
                phi = moved_phi;
                rest = largest(phi.as_slice());
            }
            break;
        }
        Outcome {
            violation: phi,
            rest,
            scale,
            iterations,
        }
    }

    fn correct_velocities<M: Mechanism>(
        &self,
        constants: &M::Constants<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Outcome<S, M> {
        let scale = S::one() + largest(state.velocities().as_slice());
        let round_off = S::constant(4.0) * S::EPSILON * scale;
        let mut phi_rate = M::constraint_rates(constants, time, state);
        let mut rest = largest(phi_rate.as_slice());
        let mut iterations = 0;
        while iterations < self.max_iterations && rest > round_off {
            let step = correction::<S, M>(constants, time, state, &phi_rate);
            let mut moved = *state;
            let velocities = moved.velocities_mut().as_mut_slice();
            for (velocity, &step) in velocities.iter_mut().zip(step.as_slice()) {
                *velocity = *velocity + step;
            }
            let moved_rate = M::constraint_rates(constants, time, &moved);
            let moved_rest = largest(moved_rate.as_slice());
            let helped = less(moved_rest, rest);
            // What can be corrected beside a violation that cannot.
            let beside = rest > self.tolerance * scale
                && square(moved_rate.as_slice()) < square(phi_rate.as_slice());
            if helped || beside {
                *state = moved;
                phi_rate = moved_rate;
                rest = moved_rest;
            }
            if !helped {
                break;
            }
            iterations += 1;
        }
        Outcome {
            violation: phi_rate,
            rest,
            scale,
            iterations,
        }
    }

    fn verdict<M: Mechanism>(
        &self,
        measure: Measure,
        constants: &M::Constants<S>,
        time: S,
        state: &M::State<S>,
        outcome: &Outcome<S, M>,
    ) -> Result<(), Fault> {
        let Outcome {
            violation,
            rest,
            scale,
            iterations,
        } = outcome;
        let corrected = *rest <= self.tolerance * *scale;
        let excused = || {
            *rest <= self.tolerance.sqrt() * *scale
                && self_stressed::<S, M>(constants, time, state, violation)
        };
        if corrected || (matches!(measure, Measure::Correctable) && excused()) {
            return Ok(());
        }
        Err(Fault::NotConverged {
            iterations: *iterations,
            residual: rest.to_f64(),
            joint: M::REPORT.joint_of(row_of_largest(violation.as_slice())),
            alpha: None,
        })
    }
}

/// What follows every step of a run: the correction if there is one, else the counters alone. Counters and orientations carry errors of
/// their own, which must not grow apart over any number of turns.
pub(crate) fn settle<S: Real, M: Mechanism>(
    projection: Option<Projection<S>>,
    constants: &M::Constants<S>,
    time: S,
    state: &mut M::State<S>,
) -> Result<(), Fault> {
    match projection {
        Some(projection) => projection
            .correct_in_motion::<M>(constants, time, state)
            .map(|_| ()),
        None => {
            M::recount(constants, state);
            Ok(())
        }
    }
}

/// Which violation counts.
#[derive(Clone, Copy)]
enum Measure {
    /// All of it.
    Whole,
    /// Not what is nearly a state of self-stress.
    Correctable,
}

/// What an iteration left.
struct Outcome<S: Scalar, M: Mechanism> {
    violation: M::Multipliers<S>,
    /// Its largest element.
    rest: S,
    /// What this is compared with.
    scale: S,
    iterations: usize,
}

/// The `d` of least `d^T M d` with `D d = -violation`.
fn correction<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    violation: &M::Multipliers<S>,
) -> M::Velocities<S> {
    let (coefficients, factors) = compliant::<S, M>(constants, time, state);
    let mut lower = *violation;
    for element in lower.as_mut_slice() {
        *element = -*element;
    }
    let upper = M::Velocities::<S>::zeros();
    M::solve::<S, Compliant>(constants, &coefficients, &factors, &upper, &lower).0
}

/// How much of a trial motion the constraints leave free: the share of its energy that stays when it is projected onto the
/// motions with `D u = 0`. Zero where the constraints determine the velocities, about one over the number of velocities for
/// one degree of freedom.
pub(crate) fn free_share<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
) -> S {
    let (coefficients, factors) = compliant::<S, M>(constants, time, state);
    let mass = M::mass(constants);
    let energy = |motion: &M::Velocities<S>| {
        let places = motion.as_slice().iter().zip(mass.as_slice());
        places.fold(S::zero(), |sum, (&u, &m)| (u * u).fused(m, sum))
    };
    let mut motion = M::Velocities::<S>::zeros();
    let places = motion.as_mut_slice().iter_mut().zip(mass.as_slice());
    for (place, (u, &mass)) in places.enumerate() {
        // Components that no mechanism is made of: the fractions of multiples of the golden section.
        let fraction = (place + 1) as f64 * 0.618_033_988_749_895 % 1.0 - 0.5;
        *u = S::constant(fraction).quotient(mass.sqrt());
    }
    let before = energy(&motion);
    // A projection with a compliance leaves e / (s + e) of a motion of stiffness s: four of them tell a stiff row from none.
    for _ in 0..4 {
        let places = motion.as_mut_slice().iter_mut().zip(mass.as_slice());
        places.for_each(|(u, &mass)| *u = *u * mass);
        let lower = M::Multipliers::<S>::zeros();
        motion = M::solve::<S, Compliant>(constants, &coefficients, &factors, &motion, &lower).0;
    }
    if before > S::zero() {
        energy(&motion).quotient(before)
    } else {
        before
    }
}

/// The saddle system with a small compliance, factorised.
fn compliant<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
) -> (M::Coefficients<S>, M::Factors<S>) {
    let compliance = compliance::<S, M>(constants, time, state);
    let stabilisation = Stabilisation {
        rate: S::zero(),
        position: S::zero(),
        compliance,
    };
    let coefficients = M::coefficients(constants, &stabilisation);
    let (factors, _) = M::factor::<S, Compliant>(constants, &coefficients, time, state);
    (coefficients, factors)
}

/// `e`: `sqrt(EPSILON)` of the least positive element on the diagonal of `D M^-1 D^T`, at least `16 EPSILON` of the
/// largest.
fn compliance<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
) -> S {
    let jacobian = M::jacobian(constants, time, state);
    let mass = M::mass(constants);
    let mut diagonal = M::Multipliers::<S>::zeros();
    for block in M::REPORT.blocks {
        let values = jacobian.as_slice().get(block.offset..).unwrap_or(&[]);
        let rows = diagonal
            .as_mut_slice()
            .iter_mut()
            .skip(block.row)
            .take(block.rows);
        for (sum, row) in rows.zip(values.chunks(block.columns.max(1))) {
            for (&value, &mass) in row.iter().zip(mass.as_slice().iter().skip(block.column)) {
                *sum = *sum + (value * value).quotient(mass);
            }
        }
    }
    let mut least = None;
    let mut greatest = S::zero();
    for &element in diagonal
        .as_slice()
        .iter()
        .filter(|&&element| element > S::zero())
    {
        least = Some(least.map_or(element, |least: S| least.min(element)));
        greatest = greatest.max(element);
    }
    let least = least.unwrap_or(S::one()) * S::EPSILON.sqrt();
    least.max(S::constant(16.0) * S::EPSILON * greatest)
}

/// The state moved by a step, or by the first of its halves that lessens the violation, and `Phi` there.
fn descend<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    step: &M::Velocities<S>,
    rest: S,
) -> Option<(M::State<S>, M::Multipliers<S>)> {
    let mut factor = S::one();
    for _ in 0..12 {
        let moved = displaced::<S, M>(constants, state, step, factor);
        let phi = M::constraints(constants, time, &moved);
        if less(largest(phi.as_slice()), rest) {
            return Some((moved, phi));
        }
        factor = factor * S::constant(0.5);
    }
    None
}

/// The largest absolute value; NaN if an element is NaN.
fn largest<S: Real>(elements: &[S]) -> S {
    elements
        .iter()
        .fold(S::zero(), |largest, element| largest.max(element.abs()))
}

/// The row of the largest absolute value; of the first NaN if there is one.
pub(crate) fn row_of_largest<S: Real>(elements: &[S]) -> usize {
    let mut largest = (0, S::zero());
    for (row, element) in elements.iter().enumerate() {
        let size = element.abs();
        if size.to_f64().is_nan() {
            return row;
        }
        if size > largest.1 {
            largest = (row, size);
        }
    }
    largest.0
}

/// Whether a violation became less by more than round-off would.
fn less<S: Real>(new: S, old: S) -> bool {
    new < S::constant(0.9) * old
}
