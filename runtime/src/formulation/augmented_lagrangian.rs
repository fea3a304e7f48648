//! The augmented Lagrangian formulation.

use super::{Formulation, Saddle, Solution, faster_decay, inconsistency, penalty};
use crate::constraints::rows::stiffness_at;
use crate::constraints::self_stress::{passing, self_stressed};
use crate::error::setting::positive;
use crate::error::step::counted;
use crate::error::{Fault, NotFinite, StartFault, StepFault};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::square;
use crate::mechanism::coordinates::{ByAllRows, Coordinates};
use crate::mechanism::kernels::{Compliant, Mechanism, Stabilisation};
use crate::state::vector::Array;

/// The augmented Lagrangian formulation: the penalty with multipliers iterated until its bias is
/// gone.
///
/// One factorisation serves all iterations. They start from `lambda = 0` at every evaluation, so
/// that the rates are a function of time and state alone, and end when the accelerations change by
/// no more than `tolerance (1 + |u'|)`, Euclidean norms over all velocities; the multipliers
/// themselves have no limit where equations are redundant. Bayo, Garcia de Jalon and Serna 1988
/// (see [`Penalty`](super::Penalty)); Flores 2015, chapter 14.
///
/// Up to which `alpha` it holds: see [`Penalty`](super::Penalty).
///
/// **Near singular configurations.** With `e = 1 / alpha`, a plain iteration leaves `e / (e + s)`
/// of the bias, `s` the eigenvalues of `D M^-1 D^T`: it is fast for independent equations,
/// unnecessary for exactly dependent ones (`s = 0`, no bias), and slow between, where equations are
/// nearly dependent: where the change of the multipliers is nearly a state of self-stress,
/// multipliers whose loads on every body cancel to a hundredth. Where a mechanism passes a singular
/// configuration, the iterate after `max_iterations` is taken then, if its accelerations meet every
/// equation to a hundredth of the terms of the equation: in these directions the formulation is a
/// penalty with the compliance `e / max_iterations`. Where equations stay nearly dependent as the
/// mechanism moves, the iteration goes on by conjugate gradients, which take about one solution for
/// each such `s`, up to `max_iterations` more.
/// [`Iterations::unconverged`](crate::dynamics::Iterations::unconverged) counts evaluations that
/// end before their tolerance. Where the loads do not cancel, slow convergence is
/// [`StepFault::NotConverged`]: `alpha` is too small for the masses.
///
/// In joint coordinates it iterates on the equations that remain, by the rates of their velocities.
/// A change of the multipliers that loads the motions of the joints to a hundredth of what it loads
/// free bodies is a state of self-stress there, and the iterate is taken. Else it goes on by
/// conjugate gradients wherever `max_iterations` do not do.
///
/// A mechanism that passes a singular configuration with a violation `Phi` moves as one of other
/// lengths would, which need not be the way of the perfect one: it may leave that where `Phi`, in
/// lengths of the mechanism, is not small against this compliance times the masses. A run closes
/// its joints there after every step, as a [`Projection`](crate::Projection) does it. So it stays
/// on its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AugmentedLagrangian<S> {
    /// `alpha`, positive: kg for a constraint in metres, kg m^2 for one in radians; for others see
    /// [`Penalty`](super::Penalty).
    pub alpha: S,
    /// `omega` (rad/s), positive: the frequency of the violation.
    pub omega: S,
    /// `mu`, positive: the damping ratio of the violation, 1 for critical damping.
    pub mu: S,
    /// How many metres a radian counts as, positive: a constraint in radians has `alpha radian^2`.
    /// `None` is one metre.
    pub radian: Option<S>,
    /// The change of the accelerations, relative to `1 + |u'|`, that ends the iteration; positive.
    pub tolerance: S,
    /// How often the system may be solved in one evaluation; at least 2. Near singular
    /// configurations it is solved as often.
    pub max_iterations: usize,
    /// Whether it is always solved as often, see [`AugmentedLagrangian::exactly`].
    pub is_exact: bool,
}

/// The least tolerance that is given by default, in `EPSILON`.
const LEAST: f64 = 64.0;

/// The largest `|D u' - gamma*|` of an evaluation that did not converge, relative to the terms of
/// its row; and the largest change by the last of an exact number of solutions, relative to the
/// accelerations.
const ACCEPTED: f64 = 1e-2;

impl<S: Real> AugmentedLagrangian<S> {
    /// The formulation with its three coefficients, a tolerance of 1e-10 (at least `64 EPSILON` of
    /// the number type) and at most 20 iterations.
    #[must_use]
    pub fn new(alpha: S, omega: S, mu: S) -> Self {
        let tolerance = S::constant(1e-10).max(S::constant(LEAST) * S::EPSILON);
        Self {
            alpha,
            omega,
            mu,
            radian: None,
            tolerance,
            max_iterations: 20,
            is_exact: false,
        }
    }

    /// The same with a number of solutions that does not depend on data, for a step whose cost is
    /// known in advance; at least 2.
    ///
    /// The tolerance is not looked at then: a part `(e / (e + s))^(solutions - 1)` of the bias of
    /// the penalty is left, see above.
    /// [`Dynamics::inconsistency`](crate::dynamics::Dynamics::inconsistency) says how much that is
    /// at a state. Where the last solution still changes the accelerations by more than a
    /// hundredth, the evaluation is refused, [`StepFault::NotConverged`]: `alpha` is too small for
    /// the masses.
    #[must_use]
    pub fn exactly(self, solutions: usize) -> Self {
        Self {
            max_iterations: solutions,
            is_exact: true,
            ..self
        }
    }
}

/// `alpha = 1e7`, `omega = 10 rad/s`, `mu = 1`, as in Flores 2015, chapter 15: for a pendulum of a
/// metre and some kilograms. [`AugmentedLagrangian::of`] is for any mechanism.
impl<S: Real> Default for AugmentedLagrangian<S> {
    fn default() -> Self {
        Self::new(S::constant(1e7), S::constant(10.0), S::one())
    }
}

impl<S: Real> Formulation<S> for AugmentedLagrangian<S> {
    type Terms = Compliant;

    const ITERATED: bool = true;

    fn decay_rate(&self) -> Option<S> {
        Some(faster_decay(self.omega * self.mu, self.omega))
    }

    fn stabilisation(&self) -> Result<Stabilisation<S>, Fault> {
        positive("tolerance of the augmented Lagrangian", self.tolerance)?;
        if self.max_iterations < 2 {
            let name =
                "solutions of the augmented Lagrangian beyond the first (max_iterations - 1)";
            return Err(Fault::Start(StartFault::Setting {
                name,
                value: self.max_iterations as f64 - 1.0,
            }));
        }
        penalty::checked(self.radian)?;
        penalty::stabilisation(self.alpha, self.omega, self.mu)
    }

    // Of a bias that is left, one more solution leaves next to nothing.
    fn companion(&self) -> Self {
        let least = S::constant(LEAST) * S::EPSILON;
        let finer = (self.tolerance * S::constant(1.0 / 16.0)).max(least);
        Self {
            tolerance: finer.min(self.tolerance),
            max_iterations: self.max_iterations.saturating_add(1),
            ..*self
        }
    }

    fn radian(&self) -> S {
        self.radian.unwrap_or(S::one())
    }

    // Apart from the other way, which takes more stack.
    fn refine<M: Mechanism, C: Coordinates<M>>(
        &self,
        saddle: &Saddle<'_, S, M, C, Compliant>,
        solution: &mut Solution<S, M, C>,
    ) -> Result<(), Fault> {
        if solution.multipliers.as_slice().is_empty() {
            return Ok(());
        }
        if self.is_exact {
            self.as_often(saddle, solution)
        } else {
            self.until_small(saddle, solution)
        }
    }
}

impl<S: Real> AugmentedLagrangian<S> {
    /// An exact number of solutions.
    #[inline(never)]
    fn as_often<M: Mechanism, C: Coordinates<M>>(
        &self,
        saddle: &Saddle<'_, S, M, C, Compliant>,
        last: &mut Solution<S, M, C>,
    ) -> Result<(), Fault> {
        let mut before = last.accelerations;
        for _ in 1..self.max_iterations {
            before = last.accelerations;
            saddle.solve_again(last);
        }
        last.iterations = self.max_iterations;
        let size = square(last.accelerations.as_slice()).sqrt();
        let change = norm_of_difference(&last.accelerations, &before);
        if change > S::constant(ACCEPTED) * (S::one() + size) {
            return Err(self.not_converged(self.max_iterations, change, None));
        }
        Ok(())
    }

    /// Solves until the accelerations change no more, or as often as it may: then by how much the
    /// last solution changed them.
    #[inline(always)]
    fn iterate<M: Mechanism, C: Coordinates<M>>(
        &self,
        saddle: &Saddle<'_, S, M, C, Compliant>,
        last: &mut Solution<S, M, C>,
        next: &mut Solution<S, M, C>,
    ) -> Result<Option<S>, Fault> {
        let mut change = S::zero();
        for iterations in 2..=self.max_iterations {
            *last = *next;
            saddle.solve_again(next);
            next.iterations = iterations;
            change = norm_of_difference(&next.accelerations, &last.accelerations);
            if self.small(change, next) {
                return Ok(None);
            }
            if !change.is_finite() {
                let origin = NotFinite::Unknown;
                return Err(Fault::Step(StepFault::RatesNotFinite { origin }));
            }
        }
        Ok(Some(change))
    }

    /// As many solutions as it takes.
    #[inline(never)]
    fn until_small<M: Mechanism, C: Coordinates<M>>(
        &self,
        saddle: &Saddle<'_, S, M, C, Compliant>,
        next: &mut Solution<S, M, C>,
    ) -> Result<(), Fault> {
        let mut last = *next;
        let Some(change) = self.iterate(saddle, &mut last, next)? else {
            return Ok(());
        };
        // With the rows of all joints a state of self-stress can be told from masses that are too
        // large; of the rows that remain in joint coordinates, by what they load free bodies.
        let multipliers = difference_of(&next.multipliers, &last.multipliers);
        if let Some(rows) = saddle.by_all_rows(&next.accelerations, &multipliers) {
            let (worst, acceptance) = acceptance(saddle.time, &rows);
            match acceptance {
                Acceptance::None => {
                    let joint = M::REPORT.joint_of(worst);
                    return Err(self.not_converged(self.max_iterations, change, joint));
                }
                Acceptance::Passing => {
                    next.unconverged = true;
                    return Ok(());
                }
                Acceptance::Lasting => next.unconverged = true,
            }
        } else if self.loads_no_motion(saddle, next, &multipliers, || {
            let at = |bodies: &_| stiffness_at::<S, M>(saddle.absolute, saddle.time, bodies);
            let all = C::with_bodies(saddle.constants, saddle.state, at);
            of_free_bodies::<S, M, C>(|row| all.as_slice().get(C::row_of_all(row)?).copied())
        }) {
            next.unconverged = true;
            return Ok(());
        }
        self.by_conjugate_gradients(saddle, next, saddle.yielded(&multipliers))
    }

    /// Whether a change of the multipliers loads the motions that joints leave free to a hundredth
    /// of what it loads free bodies, while the accelerations meet the equations: it is nearly a
    /// state of self-stress. To iterate further would follow the violation at hand, which bends the
    /// motion onto another branch.
    #[cold]
    #[inline(never)]
    fn loads_no_motion<M: Mechanism, C: Coordinates<M>>(
        &self,
        saddle: &Saddle<'_, S, M, C, Compliant>,
        solution: &Solution<S, M, C>,
        change: &C::Multipliers<S>,
        own: impl FnOnce() -> C::Multipliers<S>,
    ) -> bool {
        let mut further = *solution;
        saddle.solve_again(&mut further);
        let next = difference_of(&further.multipliers, &solution.multipliers);
        let size = S::one() + square(further.accelerations.as_slice()).sqrt();
        // With `D u' - gamma* = E z` before and `E z'` after it, `S z' = E (z - z')`.
        let mut stiffness = S::zero();
        let rows = next.as_slice().iter().zip(change.as_slice());
        for ((&next, &change), &compliance) in rows.zip(saddle.compliances.as_slice()) {
            stiffness = (next * compliance).fused(change - next, stiffness);
            let unit = (compliance * self.alpha).sqrt();
            if compliance * next.abs() > S::constant(ACCEPTED) * unit * size {
                return false;
            }
        }
        let of_bodies = weighted(next.as_slice(), own().as_slice());
        stiffness <= S::constant(ACCEPTED * ACCEPTED) * of_bodies
    }

    /// A solution on the way through a singular configuration: as often as it takes, at most
    /// `max_iterations` times.
    ///
    /// # Errors
    /// [`StepFault::NotConverged`] where what still changes is no state of self-stress that the
    /// motion leaves.
    pub(super) fn straight_on<M: Mechanism, C: Coordinates<M>>(
        &self,
        saddle: &Saddle<'_, S, M, C, Compliant>,
        next: &mut Solution<S, M, C>,
    ) -> Result<(), Fault> {
        let mut last = *next;
        let Some(change) = self.iterate(saddle, &mut last, next)? else {
            return Ok(());
        };
        let multipliers = difference_of(&next.multipliers, &last.multipliers);
        let is_passing = match saddle.by_all_rows(&next.accelerations, &multipliers) {
            Some(rows) => matches!(acceptance(saddle.time, &rows).1, Acceptance::Passing),
            // Compliances are stiffnesses over `alpha` here.
            None => self.loads_no_motion(saddle, next, &multipliers, || {
                let compliances = saddle.compliances.as_slice();
                of_free_bodies::<S, M, C>(|row| {
                    C::row_of_all(row)?;
                    compliances
                        .get(row)
                        .map(|&compliance| self.alpha * compliance)
                })
            }),
        };
        if is_passing {
            Ok(())
        } else {
            Err(self.not_converged(self.max_iterations, change, None))
        }
    }

    #[cold]
    fn not_converged(&self, iterations: usize, change: S, joint: Option<&'static str>) -> Fault {
        Fault::Step(StepFault::NotConverged {
            iterations: counted(iterations),
            residual: change.to_f64(),
            joint,
            alpha: Some(self.alpha.to_f64()),
        })
    }

    /// Whether a change of the accelerations ends the iteration.
    fn small<M: Mechanism, C: Coordinates<M>>(
        &self,
        change: S,
        solution: &Solution<S, M, C>,
    ) -> bool {
        let size = square(solution.accelerations.as_slice()).sqrt();
        change <= self.tolerance * (S::one() + size)
    }

    /// A solution where equations stay nearly dependent: as often solved again, at most. The best
    /// one where that is not enough and it is unconverged.
    #[cold]
    #[inline(never)]
    fn by_conjugate_gradients<M: Mechanism, C: Coordinates<M>>(
        &self,
        saddle: &Saddle<'_, S, M, C, Compliant>,
        solution: &mut Solution<S, M, C>,
        missing: C::Multipliers<S>,
    ) -> Result<(), Fault> {
        let mut best = *solution;
        let (mut least, mut size) = (None, S::zero());
        let mut last = *solution;
        let mut descent = Conjugate::<S, M, C>::from(missing);
        for iterations in 1..=self.max_iterations {
            let mut next = last;
            saddle.solve_again(&mut next);
            next.iterations = self.max_iterations + iterations;
            let accelerations = difference_of(&next.accelerations, &last.accelerations);
            let multipliers = difference_of(&next.multipliers, &last.multipliers);
            size = square(accelerations.as_slice()).sqrt();
            if self.small(size, &next) {
                *solution = next;
                return Ok(());
            }
            if !size.is_finite() && !solution.unconverged {
                let origin = NotFinite::Unknown;
                return Err(Fault::Step(StepFault::RatesNotFinite { origin }));
            }
            if least.is_none_or(|least| size < least) {
                (best, least) = (next, Some(size));
            }
            descent.advance(saddle, &mut last, &accelerations, &multipliers);
        }
        if solution.unconverged {
            *solution = best;
            return Ok(());
        }
        let joint = C::joint_of_row(largest(descent.missing.as_slice()));
        Err(self.not_converged(2 * self.max_iterations, size, joint))
    }
}

/// The stiffness of free bodies row by row, as the rows of the solution have it: of those that the
/// equations in absolute coordinates leave out there is none.
fn of_free_bodies<S: Real, M: Mechanism, C: Coordinates<M>>(
    of_row: impl Fn(usize) -> Option<S>,
) -> C::Multipliers<S> {
    let mut own = C::Multipliers::<S>::zeros();
    for (place, stiffness) in own.as_mut_slice().iter_mut().enumerate() {
        *stiffness = of_row(place).unwrap_or(S::zero());
    }
    own
}

/// Why an iteration may end before its tolerance.
enum Acceptance {
    None,
    /// The state is on its way through a singular configuration.
    Passing,
    /// Equations stay nearly dependent.
    Lasting,
}

/// Whether multipliers change by what is nearly a state of self-stress, and the row whose
/// accelerations are farthest from what it asks for.
#[cold]
fn acceptance<S: Real, M: Mechanism>(time: S, rows: &ByAllRows<'_, S, M>) -> (usize, Acceptance) {
    let ByAllRows {
        constants,
        state,
        upper,
        lower,
        accelerations,
        multipliers: change,
    } = *rows;
    // A row whose own terms all but vanish, as across a motion in a plane, is met beside others.
    let beside = S::constant(ACCEPTED) * square(accelerations.as_slice()).sqrt();
    let (worst, missing) = inconsistency::<S, M>(
        constants,
        (time, state),
        (accelerations, beside),
        upper,
        lower,
    );
    let acceptance = if missing > S::constant(ACCEPTED)
        || !self_stressed::<S, M>(constants, time, state, change)
    {
        Acceptance::None
    } else if passing::<S, M>(constants, time, state, change) {
        Acceptance::Passing
    } else {
        Acceptance::Lasting
    };
    (worst, acceptance)
}

/// The iterates as conjugate gradients, preconditioned by the factorised system.
///
/// The multipliers `lambda` that the constraints ask for solve `S lambda = b` with
/// `S = D M^-1 D^T`. A solution after `lambda` changes them by `z = (S + E)^-1 r` with the residual
/// `r = b - S lambda`, which is `D u' - gamma*` at `lambda`, and the accelerations by
/// `w = -M^-1 D^T z`. In absolute coordinates `z^T S z = w^T M w`. In others the mass matrix stays
/// in the kernels: what is missing after a solution is `E z`, so that `S z = r - E z`. Where `S` is
/// large against `E`, a step is `z`, as without it; a few nearly dependent equations take an
/// iteration each.
struct Conjugate<S: Scalar, M: Mechanism, C: Coordinates<M>> {
    /// `r`.
    missing: C::Multipliers<S>,
    /// The last direction, of accelerations and multipliers.
    direction: (C::Velocities<S>, C::Multipliers<S>),
    /// `S` times the direction.
    answered: C::Multipliers<S>,
    /// `z^T (S + E) z` of the last step; zero before the first.
    length: S,
}

impl<S: Real, M: Mechanism, C: Coordinates<M>> Conjugate<S, M, C> {
    fn from(missing: C::Multipliers<S>) -> Self {
        Self {
            missing,
            direction: (Array::zeros(), Array::zeros()),
            answered: Array::zeros(),
            length: S::zero(),
        }
    }

    /// Moves a solution on, from what solving the system after it would change.
    fn advance(
        &mut self,
        saddle: &Saddle<'_, S, M, C, Compliant>,
        last: &mut Solution<S, M, C>,
        accelerations: &C::Velocities<S>,
        multipliers: &C::Multipliers<S>,
    ) {
        let left = saddle.yielded(multipliers);
        let mut answer = self.missing;
        add(answer.as_mut_slice(), -S::one(), left.as_slice());
        let before = self.length;
        let kinetic = |w: &C::Velocities<S>| {
            let rows = saddle.by_all_rows(w, multipliers)?;
            let mass = M::metric(rows.constants);
            Some(weighted(rows.accelerations.as_slice(), mass.as_slice()))
        };
        self.length = match kinetic(accelerations) {
            Some(kinetic) => {
                let compliances = saddle.compliances.as_slice();
                kinetic + weighted(multipliers.as_slice(), compliances)
            }
            None => product(self.missing.as_slice(), multipliers.as_slice()),
        };
        let conjugate = if before > S::zero() {
            self.length.quotient(before)
        } else {
            S::zero()
        };
        let (along, across) = (&mut self.direction.0, &mut self.direction.1);
        combine(along.as_mut_slice(), conjugate, accelerations.as_slice());
        combine(across.as_mut_slice(), conjugate, multipliers.as_slice());
        combine(self.answered.as_mut_slice(), conjugate, answer.as_slice());
        let stiffness =
            kinetic(along).unwrap_or_else(|| product(across.as_slice(), self.answered.as_slice()));
        let step = self.length.quotient(stiffness);
        let step = if step.is_finite() { step } else { S::one() };
        add(last.accelerations.as_mut_slice(), step, along.as_slice());
        add(last.multipliers.as_mut_slice(), step, across.as_slice());
        add(self.missing.as_mut_slice(), -step, self.answered.as_slice());
    }
}

/// The place of the largest element.
fn largest<S: Real>(elements: &[S]) -> usize {
    let mut largest = (0, S::zero());
    for (place, element) in elements.iter().enumerate() {
        if element.abs() > largest.1 {
            largest = (place, element.abs());
        }
    }
    largest.0
}

/// `sum of weight x^2`.
fn weighted<S: Real>(vector: &[S], weights: &[S]) -> S {
    let pairs = vector.iter().zip(weights);
    pairs.fold(S::zero(), |sum, (&x, &weight)| (x * x).fused(weight, sum))
}

/// `x . y`.
fn product<S: Real>(x: &[S], y: &[S]) -> S {
    let pairs = x.iter().zip(y);
    pairs.fold(S::zero(), |sum, (&x, &y)| x.fused(y, sum))
}

/// `x = factor x + y`.
fn combine<S: Real>(x: &mut [S], factor: S, y: &[S]) {
    x.iter_mut()
        .zip(y)
        .for_each(|(x, &y)| *x = x.fused(factor, y));
}

/// `x = x + factor y`.
pub(crate) fn add<S: Scalar>(x: &mut [S], factor: S, y: &[S]) {
    x.iter_mut()
        .zip(y)
        .for_each(|(x, &y)| *x = factor.fused(y, *x));
}

fn norm_of_difference<S: Real, X: Array<S>>(new: &X, old: &X) -> S {
    square(difference_of(new, old).as_slice()).sqrt()
}

fn difference_of<S: Real, X: Array<S>>(new: &X, old: &X) -> X {
    let mut difference = *new;
    add(difference.as_mut_slice(), -S::one(), old.as_slice());
    difference
}
