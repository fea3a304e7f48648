//! Newton's method for positions and velocities on the constraints.

use crate::constraints::retract::displaced;
use crate::constraints::rows::{Rows, Sizes, Speeds, fraction, yield_velocities};
use crate::math::scalar::{Real, Scalar};
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::{Compliant, Mechanism, Stabilisation};
use crate::state::vector::{Array, StateParts};

/// How often a step is halved: the square of a step this much shorter is below the digits of single
/// precision.
const HALVINGS: usize = 12;

/// A violation that is not lessened to this part of what it was is no longer being corrected, but
/// at its round-off or at a limit.
const HELPS: f64 = 0.9;

/// What compliances are lessened by where those of the violation hold nearly dependent rows back
/// from any correction.
const RELAXED: f64 = 1e-2;

/// What keeps a motion free: a row of the stiffness `s`, relative to its own, leaves
/// `(e / (s + e))^8` of an energy after four projections with the relative compliance `e`. This is
/// what `s = 5 e` leaves, where a row has all but vanished; a motion that no row forbids keeps its
/// share of the trial motion, about one over the number of velocities.
pub(crate) const FREE: f64 = 1e-6;

/// How far dependence among the rows is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Depth {
    /// Compliances of `sqrt(EPSILON)`: rows that depend on each other to the fourth root of it are
    /// left as they are.
    Independent,
    /// Compliances that vanish with the violation.
    Dependent,
    /// And that are lessened further where they hold back any correction: for rows that stay nearly
    /// dependent wherever it leads.
    Persistent,
}

/// Coefficients and factors of a saddle system.
type Factorised<S, M> = (
    <M as Mechanism>::Coefficients<S>,
    <M as Mechanism>::Factors<S>,
);

/// A state under way, what violates it, and what that is compared with.
pub(crate) struct Iterate<S: Scalar, M: Mechanism> {
    pub(crate) state: M::State<S>,
    pub(crate) rows: Rows<S, M>,
    /// `Phi`, or `Phi'`.
    pub(crate) violation: M::Multipliers<S>,
    pub(crate) sizes: Sizes<S, M>,
    /// Steps of Newton's method that helped.
    pub(crate) iterations: usize,
    /// The speeds as they were given.
    before: Speeds<S>,
}

copied!([S: Scalar, M: Mechanism] Iterate<S, M>);

impl<S: Real, M: Mechanism> Iterate<S, M> {
    /// Positions to be corrected.
    pub(crate) fn positions(constants: &M::Constants<S>, time: S, state: &M::State<S>) -> Self {
        let rows = Rows::at(constants, time, state);
        Self {
            state: *state,
            violation: M::constraints(constants, time, state),
            sizes: rows.positions(),
            iterations: 0,
            before: rows.speeds(state),
            rows,
        }
    }

    /// Velocities to be corrected, at the same positions.
    pub(crate) fn velocities(self, constants: &M::Constants<S>) -> Self {
        let before = self.rows.speeds(&self.state);
        Self {
            violation: M::constraint_rates(constants, self.rows.time, &self.state),
            sizes: self.rows.velocities(&self.state, before),
            iterations: 0,
            before,
            ..self
        }
    }

    /// The positions after Newton's method. Rows and sizes are those of the state that is reached:
    /// far from it, joints have other lengths.
    pub(crate) fn positions_corrected(
        mut self,
        constants: &M::Constants<S>,
        (tolerance, max_iterations): (S, usize),
        depth: Depth,
    ) -> Self {
        let mut damping = S::one();
        while self.iterations < max_iterations && !self.sizes.reached(&self.violation) {
            let rest = self.sizes.measure(&self.violation, tolerance);
            let part = part(rest, depth, damping);
            let step = self.correction(constants, part);
            let (next, helped) = match self.descend(constants, &step) {
                Some(next) => (next, true),
                None if depth == Depth::Persistent && part > least() => {
                    damping = damping * S::constant(RELAXED);
                    continue;
                }
                // What can be corrected beside a violation that cannot.
                None => {
                    let step = self.correction(constants, S::EPSILON.sqrt());
                    let next = self.displaced(constants, &step, S::one());
                    if !(rest > tolerance && self.lessened(&self.sizes, &next.1, S::one())) {
                        break;
                    }
                    (next, false)
                }
            };
            (self.state, self.violation) = next;
            if !self.rows.are_kept_by(&step) {
                self.rows = Rows::at(constants, self.rows.time, &self.state);
                self.sizes = self.rows.positions();
            }
            if !helped {
                break;
            }
            self.iterations += 1;
        }
        self
    }

    /// The velocities after Newton's method, which corrects them in one step but for compliances
    /// and round-off.
    pub(crate) fn velocities_corrected(
        mut self,
        constants: &M::Constants<S>,
        (tolerance, max_iterations): (S, usize),
        depth: Depth,
    ) -> Self {
        let mut damping = S::one();
        let mut factorised: Option<(S, Factorised<S, M>)> = None;
        while self.iterations < max_iterations && !self.sizes.reached(&self.violation) {
            let rest = self.sizes.measure(&self.violation, tolerance);
            let part = part(rest, depth, damping);
            // Positions stay, and so does the system, unless another part is asked for.
            let system = match &factorised {
                Some((of, system)) if *of == part => system,
                _ => &factorised.insert((part, self.system(constants, part))).1,
            };
            let step = self.solved(constants, system);
            let state = self.accelerated(&step);
            let violation = M::constraint_rates(constants, self.rows.time, &state);
            // Sizes are by the speeds that are reached: those before may have been zero, or
            // anything.
            let sizes = self.rows.velocities(&state, self.before);
            let helped = self.lessened(&sizes, &violation, S::constant(HELPS));
            // What can be corrected beside a violation that cannot.
            let beyond = || sizes.measure(&self.violation, tolerance) > tolerance;
            if helped || beyond() && self.lessened(&sizes, &violation, S::one()) {
                (self.state, self.violation, self.sizes) = (state, violation, sizes);
            }
            if helped {
                self.iterations += 1;
            } else if depth == Depth::Persistent && part > least() {
                damping = damping * S::constant(RELAXED);
            } else {
                break;
            }
        }
        self
    }

    /// The state with its velocities changed by a step.
    fn accelerated(&self, step: &M::Velocities<S>) -> M::State<S> {
        let mut state = self.state;
        let velocities = state.velocities_mut().as_mut_slice();
        for (velocity, &step) in velocities.iter_mut().zip(step.as_slice()) {
            *velocity = *velocity + step;
        }
        state
    }

    /// The `d` of least `d^T M d` with `D d = -violation`, with compliances that are a part of what
    /// each row yields by itself.
    fn correction(&self, constants: &M::Constants<S>, part: S) -> M::Velocities<S> {
        let mut compliances = self.rows.compliances(part);
        yield_velocities::<S, M>(&mut compliances);
        let yielding = (part, &compliances);
        self.solved(
            constants,
            &factorised(constants, &self.rows, &self.state, yielding),
        )
    }

    fn system(&self, constants: &M::Constants<S>, part: S) -> Factorised<S, M> {
        compliant::<S, M>(constants, &self.rows, &self.state, part)
    }

    /// The same with a system that is known.
    fn solved(
        &self,
        constants: &M::Constants<S>,
        (coefficients, factors): &Factorised<S, M>,
    ) -> M::Velocities<S> {
        let mut lower = self.violation;
        for element in lower.as_mut_slice() {
            *element = -*element;
        }
        let upper = M::Velocities::<S>::zeros();
        M::solve::<S, Compliant>(constants, coefficients, factors, &upper, &lower).0
    }

    /// The state moved by a step, or by the first of its halves that lessens the violation, and
    /// `Phi` there.
    fn descend(
        &self,
        constants: &M::Constants<S>,
        step: &M::Velocities<S>,
    ) -> Option<(M::State<S>, M::Multipliers<S>)> {
        let mut factor = S::one();
        for _ in 0..HALVINGS {
            let next = self.displaced(constants, step, factor);
            if self.lessened(&self.sizes, &next.1, S::constant(HELPS)) {
                return Some(next);
            }
            factor = factor * S::constant(0.5);
        }
        None
    }

    /// Whether a violation is less than a part of what it was.
    fn lessened(&self, sizes: &Sizes<S, M>, new: &M::Multipliers<S>, part: S) -> bool {
        self.rows.norm(sizes, new) < part * self.rows.norm(sizes, &self.violation)
    }

    /// The state moved by a part of a step, and `Phi` there.
    fn displaced(
        &self,
        constants: &M::Constants<S>,
        step: &M::Velocities<S>,
        factor: S,
    ) -> (M::State<S>, M::Multipliers<S>) {
        let moved = displaced::<S, M>(constants, &self.state, step, factor);
        let phi = M::constraints(constants, self.rows.time, &moved);
        (moved, phi)
    }
}

/// Leaves of motions what moves along the constraints of a state as they stand at a time: the
/// nearest ones, by kinetic energy, with `D u = 0`.
pub(crate) fn free_parts<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    (time, state): (S, &M::State<S>),
    motions: &mut [M::Velocities<S>],
) {
    let rows = Rows::at(constants, time, state);
    let part = part(S::zero(), Depth::Dependent, S::one());
    let (coefficients, factors) = compliant::<S, M>(constants, &rows, state, part);
    let mass = M::metric(constants);
    for motion in motions {
        let places = motion.as_mut_slice().iter_mut().zip(mass.as_slice());
        places.for_each(|(u, &mass)| *u = *u * mass);
        let lower = M::Multipliers::<S>::zeros();
        *motion = M::solve::<S, Compliant>(constants, &coefficients, &factors, motion, &lower).0;
    }
}

/// How much of a trial motion the constraints leave free: the share of its energy that stays when
/// it is projected onto the motions with `D u = 0`. Zero where the constraints determine the
/// velocities, about one over the number of velocities for one degree of freedom.
pub(crate) fn free_share<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
) -> S {
    let rows = Rows::at(constants, time, state);
    let (coefficients, factors) = compliant::<S, M>(constants, &rows, state, S::EPSILON.sqrt());
    let mass = M::metric(constants);
    let energy = |motion: &M::Velocities<S>| {
        let places = motion.as_slice().iter().zip(mass.as_slice());
        places.fold(S::zero(), |sum, (&u, &m)| (u * u).fused(m, sum))
    };
    let mut motion = M::Velocities::<S>::zeros();
    let places = motion.as_mut_slice().iter_mut().zip(mass.as_slice());
    for (place, (u, &mass)) in places.enumerate() {
        *u = fraction::<S>(place).quotient(mass.sqrt());
    }
    let before = energy(&motion);
    // A projection with a compliance leaves e / (s + e) of a motion of stiffness s: four of them
    // tell a stiff row from none.
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

/// The part of what each row yields by itself that its compliance is, for a violation of some norm
/// in sizes of its rows.
///
/// It is that of the violation, so that nearly dependent rows are held back from long movements
/// while it is large, and no longer when it is small (Levenberg and Marquardt's method, which
/// converges quadratically at a singular configuration too: Yamashita and Fukushima, *On the rate
/// of convergence of the Levenberg-Marquardt method*, Computing Suppl. 15 (2001), 239-249); less by
/// a factor `damping` where that does not help. At most `sqrt(EPSILON)`, to correct what is
/// independent in few iterations.
pub(crate) fn part<S: Real>(rest: S, depth: Depth, damping: S) -> S {
    let most = S::EPSILON.sqrt();
    match depth {
        Depth::Independent => most,
        Depth::Dependent | Depth::Persistent => (rest.min(most) * damping).max(least()),
    }
}

/// The least part: above the round-off of a pivot of dependent rows.
fn least<S: Real>() -> S {
    S::constant(64.0) * S::EPSILON
}

/// The saddle system with compliances that are a part of what each row yields by itself,
/// factorised.
pub(crate) fn compliant<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    rows: &Rows<S, M>,
    state: &M::State<S>,
    part: S,
) -> Factorised<S, M> {
    factorised(constants, rows, state, (part, &rows.compliances(part)))
}

/// The same with a part of what each row yields by the heaviest of its bodies: so a light body
/// carries a heavy one. What round-off resolves of the whole row is the least. For positions.
pub(crate) fn compliant_by_heaviest<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    rows: &Rows<S, M>,
    state: &M::State<S>,
    part: S,
) -> Factorised<S, M> {
    let mut compliances = rows.compliances(least());
    let heaviest = rows.yields_of_heaviest(constants, state);
    let pairs = compliances.as_mut_slice().iter_mut();
    for (compliance, &heaviest) in pairs.zip(heaviest.as_slice()) {
        *compliance = compliance.max(part * heaviest);
    }
    yield_velocities::<S, M>(&mut compliances);
    factorised(constants, rows, state, (part, &compliances))
}

fn factorised<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    rows: &Rows<S, M>,
    state: &M::State<S>,
    (part, compliances): (S, &M::Multipliers<S>),
) -> Factorised<S, M> {
    let stabilisation = Stabilisation {
        rate: S::zero(),
        position: S::zero(),
        compliance: part,
    };
    let coefficients = M::coefficients_by_row(constants, &stabilisation, compliances);
    let (factors, _) = M::factor::<S, Compliant>(constants, &coefficients, rows.time, state);
    (coefficients, factors)
}
