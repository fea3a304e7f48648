//! The direct correction: onto the constraints by the pseudo-inverse of the Jacobian, once.

use crate::constraints::newton::{Depth, Iterate, compliant, part};
use crate::constraints::projection::{Correction, EXCUSED, in_turn};
use crate::constraints::self_stress::self_stressed;
use crate::error::Fault;
use crate::error::setting::positive;
use crate::formulation::{add, combine};
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::blocks::add_product;
use crate::mechanism::kernels::{Compliant, Mechanism};
use crate::mechanism::orientations::check_state;
use crate::mechanism::report::BodyKind;
use crate::state::vector::Array;

/// The correction of a state onto the constraints by the Moore-Penrose pseudo-inverse of the
/// Jacobian, applied once: first positions, then velocities at the corrected positions,
///
/// ```text
/// dq = -D_q^T (D_q D_q^T)^-1 Phi        dv = -D^T (D D^T)^-1 Phi'
/// ```
///
/// (Marques, Souto and Flores, *On the constraints violation in forward dynamics of multibody
/// systems*, Multibody System Dynamics 39 (2017), 385-419). Masses do not weigh: that is the
/// difference to [`Projection`](crate::Projection).
///
/// **The metric.** `dq` is the least `|dr|^2 + |dp|^2` of all bodies with `Phi + D_q dq = 0`, where
/// the constraints that keep every `p` at length 1 are among the equations: then `dp` is a virtual
/// rotation `dw` (rad) with `|dp| = |dw| / 2`, so that what is least is the sum of
/// `|dr|^2 + |dw|^2 / 4` with `D (dr, dw) = -Phi`. `r` moves by `dr` and `p` by the finite rotation
/// of `dw`, which keeps its length and is `dp` to second order. Velocities are `(r', w)`, and what
/// is least is the sum of `|dr'|^2 + |dw|^2`. Metres and radians count alike in these sums: in
/// other units of length the correction is another one. That of [`Projection`](crate::Projection)
/// is the same in any units.
///
/// **One application** leaves of the positions what is of second order in the violation; that
/// stays, the next step goes on with it. Where it is beyond the tolerance, the stabilisation says
/// so, and a run has it among its warnings ([`Warning::Unconverged`](crate::Warning::Unconverged));
/// beyond `sqrt(tolerance)` it is refused.
///
/// **How it is computed.** A movement that satisfies `D d = -Phi` comes from the factorised saddle
/// system, as for [`Projection`](crate::Projection); conjugate gradients, of which the same factors
/// are the preconditioner, lead to the least one among these (Gould, Hribar and Nocedal, *On the
/// solution of equality constrained quadratic programming problems arising in optimization*, SIAM
/// J. Sci. Comput. 23 (2001), 1376-1395, algorithm 6.2): exactly in as many iterations as there are
/// degrees of freedom, here until the movement is the least to `sqrt(EPSILON)`, or as near as
/// round-off lets it come, at least to a hundredth. The compliances of the system are a part of
/// each row, at most `sqrt(EPSILON)` and at least `64 EPSILON`, so that equations may be redundant:
/// a violation that they agree on is corrected. Near singular configurations nearly dependent
/// equations are held back where they would ask for long movements that lessen nothing; what is
/// then left is kept under the conditions of [`Projection`](crate::Projection) and else refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectCorrection<S> {
    /// The largest `|Phi|` and `|Phi'|` that count as corrected, in sizes of their rows, see
    /// [`Projection`](crate::Projection).
    pub tolerance: S,
}

/// A tolerance of 1e-8, at least `1000 EPSILON`: what one application leaves of a violation of
/// 1e-4.
impl<S: Real> Default for DirectCorrection<S> {
    fn default() -> Self {
        Self {
            tolerance: S::constant(1e-8).max(S::constant(1e3) * S::EPSILON),
        }
    }
}

/// What the square of a virtual rotation (rad) counts among the positions: `|dp|^2 = |dw|^2 / 4`.
const TURN: f64 = 0.25;

/// A movement whose distance from the least one is bounded by this part of its length counts as
/// that: round-off may keep it from coming nearer.
const FAR: f64 = 1e-2;

/// How often a movement is solved for again, at most, with what compliances have left of its
/// equations: a row whose stiffness beside the others is that of its compliance is then satisfied
/// but for a sixty-fourth.
const REFINED: usize = 6;

impl<S: Real> DirectCorrection<S> {
    /// Corrects positions, then velocities, each by one application; Euler parameters come out at
    /// length 1. What is left beyond the tolerance is [`Correction::residual`].
    ///
    /// # Errors
    /// [`Fault::NotConverged`] where an application does not lessen a violation beyond the
    /// tolerance, unless that is nearly a state of self-stress, or leaves more than
    /// `sqrt(tolerance)` of it, or where the least movement is not found (masses that differ by
    /// more than digits allow); [`Fault::StateNotFinite`], [`Fault::ZeroOrientation`], or
    /// [`Fault::Setting`] for a tolerance that is not finite and positive. The state is then as
    /// before.
    #[inline(never)]
    pub fn correct<M: Mechanism>(
        &self,
        constants: &M::Constants<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Result<Correction<S>, Fault> {
        positive("tolerance of the direct correction", self.tolerance)?;
        let positions = |given| {
            self.applied(
                constants,
                given,
                S::constant(TURN),
                |from: &Iterate<S, M>, step| from.moved(constants, step),
            )
        };
        let velocities = |given| {
            let (last, left) =
                self.applied(constants, given, S::one(), |from: &Iterate<S, M>, step| {
                    from.accelerated(constants, step)
                })?;
            check_state::<S, M>(&last.state)?;
            Ok((last, left))
        };
        in_turn::<S, M>(constants, time, state, positions, velocities)
    }

    /// The state after one application, and what it left beyond the tolerance, in sizes of its row.
    fn applied<M: Mechanism>(
        &self,
        constants: &M::Constants<S>,
        given: Iterate<S, M>,
        turn: S,
        moved: impl Fn(&Iterate<S, M>, &M::Velocities<S>) -> Iterate<S, M>,
    ) -> Result<(Iterate<S, M>, S), Fault> {
        if given.sizes.reached(&given.violation) {
            return Ok((given, S::zero()));
        }
        let within = |last: &Iterate<S, M>, part| last.sizes.within(&last.violation, part);
        let left = |last: Iterate<S, M>| {
            let (_, rest) = last.sizes.worst(&last.violation, self.tolerance);
            let beyond = !within(&last, self.tolerance);
            (last, if beyond { rest } else { S::zero() })
        };
        let limit = self.tolerance.sqrt().min(S::constant(EXCUSED));
        // Nearly dependent rows are followed first, and held back where that lessens nothing.
        for depth in [Depth::Dependent, Depth::Independent] {
            let step = least_movement(constants, &given, (self.tolerance, depth), turn);
            let Some(step) = step else {
                continue;
            };
            let next = moved(&given, &step);
            let helped = given.helped_by(&next) && within(&next, limit);
            if helped || within(&next, self.tolerance) {
                return Ok(left(next));
            }
        }
        let multipliers = given.rows.multipliers(&given.violation);
        let is_kept = within(&given, self.tolerance)
            || within(&given, limit)
                && self_stressed::<S, M>(constants, given.rows.time, &given.state, &multipliers);
        if is_kept {
            return Ok(left(given));
        }
        let (row, rest) = given.sizes.worst(&given.violation, self.tolerance);
        let residual = given.violation.as_slice().get(row);
        Err(Fault::NotConverged {
            iterations: 1,
            residual: residual.map_or(rest, |phi| phi.abs()).to_f64(),
            joint: M::REPORT.joint_of(row),
            alpha: None,
        })
    }
}

/// The saddle system at a state, factorised.
struct System<'a, S: Scalar, M: Mechanism> {
    constants: &'a M::Constants<S>,
    coefficients: M::Coefficients<S>,
    factors: M::Factors<S>,
    jacobian: M::Jacobian<S>,
    mass: M::Velocities<S>,
}

impl<'a, S: Real, M: Mechanism> System<'a, S, M> {
    fn at(constants: &'a M::Constants<S>, given: &Iterate<S, M>, part: S) -> Self {
        let (coefficients, factors) = compliant::<S, M>(constants, &given.rows, &given.state, part);
        Self {
            constants,
            coefficients,
            factors,
            jacobian: M::jacobian(constants, given.rows.time, &given.state),
            mass: M::mass(constants),
        }
    }

    fn solve(&self, upper: &M::Velocities<S>, lower: &M::Multipliers<S>) -> M::Velocities<S> {
        let (constants, coefficients) = (self.constants, &self.coefficients);
        M::solve::<S, Compliant>(constants, coefficients, &self.factors, upper, lower).0
    }

    /// Takes a movement to `D d = -violation`: what compliances leave of a row that is stiff
    /// against them, or hardly, but not of one that is nearly dependent.
    fn satisfy(&self, violation: &M::Multipliers<S>, step: &mut M::Velocities<S>) {
        for _ in 0..REFINED {
            let mut lower = *violation;
            add_product(
                M::REPORT.blocks,
                self.jacobian.as_slice(),
                step.as_slice(),
                lower.as_mut_slice(),
            );
            lower.as_mut_slice().iter_mut().for_each(|x| *x = -*x);
            let more = self.solve(&Array::zeros(), &lower);
            add(step.as_mut_slice(), S::one(), more.as_slice());
            let change = weighted(&more, &self.mass);
            if change <= S::EPSILON * S::EPSILON * weighted(step, &self.mass) {
                break;
            }
        }
    }

    /// The `a` of `M a + D^T v = r`, `D a = 0`: again, for the sake of the compliances.
    fn projected(&self, residual: &M::Velocities<S>) -> M::Velocities<S> {
        let nothing = Array::zeros();
        let mut projected = self.solve(residual, &nothing);
        let mut length = weighted(&projected, &self.mass);
        for _ in 1..REFINED {
            projected = self.solve(&product(&self.mass, &projected), &nothing);
            let left = weighted(&projected, &self.mass);
            // Nothing is taken any more.
            if length - left <= S::EPSILON * length {
                break;
            }
            length = left;
        }
        projected
    }
}

/// The `d` with `D d = -violation` and the least sum of `|d_r|^2 + turn |d_w|^2`; `None` where it
/// is not found, or not finite.
///
/// In the place of a residual `r` stands `M a` of the `a` that it is projected to: what of it is a
/// load of constraints does not count.
fn least_movement<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    given: &Iterate<S, M>,
    (tolerance, depth): (S, Depth),
    turn: S,
) -> Option<M::Velocities<S>> {
    let rest = given.sizes.measure(&given.violation, tolerance);
    // Rows that depend on each other where the constraints hold have a stiffness of the square of
    // the violation beside them: less than this.
    let damping = rest.sqrt().min(S::one());
    let system = System::<S, M>::at(constants, given, part(rest, depth, damping));
    let mass = &system.mass;
    let metric = metric::<S, M>(turn);
    let heaviest = heaviest(mass.as_slice(), metric.as_slice());
    let mut step = M::Velocities::<S>::zeros();
    system.satisfy(&given.violation, &mut step);
    let mut gradient = system.projected(&product(&metric, &step));
    let mut direction = M::Velocities::<S>::zeros();
    let mut length = weighted(&gradient, mass);
    let mut conjugate = S::zero();
    let (mut best, mut least) = (step, S::constant(f64::INFINITY));
    // Exact arithmetic needs no more iterations than there are degrees of freedom.
    for _ in 0..8 + 4 * step.as_slice().len() {
        // What is left of the movement to the least one is no longer than this.
        let rest = (heaviest * length).quotient(weighted(&step, &metric));
        if rest < least || length == S::zero() {
            (best, least) = (step, rest);
        }
        if rest <= S::EPSILON || length == S::zero() {
            break;
        }
        combine(direction.as_mut_slice(), conjugate, gradient.as_slice());
        let forward = length.quotient(weighted(&direction, &metric));
        if !forward.is_finite() {
            break;
        }
        add(step.as_mut_slice(), -forward, direction.as_slice());
        let mut residual = product(mass, &gradient);
        let change = product(&metric, &direction);
        add(residual.as_mut_slice(), -forward, change.as_slice());
        gradient = system.projected(&residual);
        let next = weighted(&gradient, mass);
        conjugate = next.quotient(length);
        length = next;
    }
    let is_found = least <= S::constant(FAR * FAR) || length == S::zero();
    system.satisfy(&given.violation, &mut best);
    is_found.then_some(best)
}

/// What the square of an element of a movement counts: 1 of a translation, `turn` of a rotation.
fn metric<S: Real, M: Mechanism>(turn: S) -> M::Velocities<S> {
    let mut metric = M::Velocities::<S>::zeros();
    let elements = metric.as_mut_slice();
    elements.fill(S::one());
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let rotation = elements.iter_mut().skip(body.velocity + 3);
            rotation.take(3).for_each(|element| *element = turn);
        }
    }
    metric
}

/// The largest mass (or inertia) over the metric.
fn heaviest<S: Real>(mass: &[S], metric: &[S]) -> S {
    let pairs = mass.iter().zip(metric);
    pairs.fold(S::zero(), |most, (&mass, &metric)| {
        most.max(mass.quotient(metric))
    })
}

/// Element by element.
fn product<S: Real, X: Array<S>>(weights: &X, vector: &X) -> X {
    let mut product = *vector;
    let elements = product.as_mut_slice().iter_mut();
    elements
        .zip(weights.as_slice())
        .for_each(|(x, &weight)| *x = *x * weight);
    product
}

/// `sum of weight x^2`.
fn weighted<S: Real, X: Array<S>>(vector: &X, weights: &X) -> S {
    let pairs = vector.as_slice().iter().zip(weights.as_slice());
    pairs.fold(S::zero(), |sum, (&x, &weight)| (x * x).fused(weight, sum))
}
