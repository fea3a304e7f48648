//! The direct correction: onto the constraints by the pseudo-inverse of the Jacobian, once.

use holonom::error::{StartFault, StepFault};
use holonom::{
    Fault, Mechanism, Real, Report, StateParts,
    mechanism::{BodyInfo, BodyKind},
    run::PostStabilisation,
    state::Array,
};

/// The correction of a state onto the constraints by the Moore-Penrose pseudo-inverse of the
/// Jacobian, applied once: first positions, then velocities at the corrected positions,
///
/// ```text
/// dq = -D_q^T (D_q D_q^T)^-1 Phi        dv = -D^T (D D^T)^-1 Phi'
/// ```
///
/// (Marques, Souto and Flores, *On the constraints violation in forward dynamics of multibody
/// systems*, Multibody System Dynamics 39 (2017), 385-419). Masses do not weigh: that is the
/// difference to [`Projection`](holonom::Projection). It is here to compare with.
///
/// **The metric.** `dq` is the least `|dr|^2 + |dp|^2` of all bodies with `Phi + D_q dq = 0`, where
/// the constraints that keep every `p` at length 1 are among the equations: then `dp` is a virtual
/// rotation `dw` (rad) with `|dp| = |dw| / 2`, so that what is least is the sum of
/// `|dr|^2 + |dw|^2 / 4` with `D (dr, dw) = -Phi`. `r` moves by `dr` and `p` by the finite rotation
/// of `dw`, which keeps its length and is `dp` to second order. Velocities are `(r', w)`, and what
/// is least is the sum of `|dr'|^2 + |dw|^2`. Metres and radians count alike in these sums: in
/// other units of length the correction is another one. That of the projection is the same in any
/// units.
///
/// **One application** leaves of the positions what is of second order in the violation; the next
/// step goes on with it. Where it is beyond the tolerance, a run warns
/// ([`Warning::Unconverged`](holonom::Warning::Unconverged)); beyond `sqrt(tolerance)` it stops.
///
/// **How it is computed.** Rows are made orthogonal, the longest first, in double precision. The
/// sum of their movements is the least one. Rows that depend on those before them, to what the
/// violation or round-off leaves of them, are left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectCorrection<S> {
    /// The largest `|Phi|` and `|Phi'|` that count as corrected. They are relative to what the row
    /// becomes by a rotation of a radian of one body, or by a movement of a body by the extent of
    /// the mechanism.
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

/// The largest violation that is left, relative to its row, however coarse the tolerance is.
const LARGEST: f64 = 1e-2;

/// A step that does not lessen the violation to this part of it has not helped.
const HELPS: f64 = 0.9;

impl<S: Real> DirectCorrection<S> {
    /// Corrects positions, then velocities, each by one application; Euler parameters come out at
    /// length 1. Returns what is left beyond the tolerance, relative to its row, else zero.
    ///
    /// # Errors
    /// [`StepFault::NotConverged`] where more than `sqrt(tolerance)` is left,
    /// [`StepFault::StateNotFinite`], [`StepFault::ZeroOrientation`], or [`StartFault::Setting`]
    /// for a tolerance that is not finite and positive. The state is then as before.
    pub fn correct<M: Mechanism>(
        &self,
        constants: &M::Constants<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Result<f64, Fault> {
        let tolerance = self.tolerance.to_f64();
        if !(tolerance.is_finite() && tolerance > 0.0) {
            return Err(Fault::Start(StartFault::Setting {
                name: "tolerance of the direct correction",
                value: tolerance,
            }));
        }
        let mut given = with_unit_orientations::<S, M>(state)?;
        M::rewrap(constants, &mut given);
        let positions = Linear::positions::<S, M>(constants, time, &given);
        let (placed, left) =
            positions.corrected((tolerance, S::EPSILON.to_f64()), given, |given, step| {
                let placed = moved::<S, M>(constants, given, step);
                let linear = Linear::positions::<S, M>(constants, time, &placed);
                (placed, linear)
            })?;
        let velocities = Linear::velocities::<S, M>(constants, time, &placed);
        let (moving, rates_left) =
            velocities.corrected((tolerance, S::EPSILON.to_f64()), placed, |given, step| {
                let mut moving = *given;
                let places = moving.velocities_mut().as_mut_slice().iter_mut();
                places
                    .zip(step)
                    .for_each(|(u, &step)| *u = *u + S::constant(step));
                let linear = Linear::velocities::<S, M>(constants, time, &moving);
                (moving, linear)
            })?;
        *state = moving;
        Ok(left.max(rates_left))
    }
}

impl<S: Real, M: Mechanism> PostStabilisation<S, M> for DirectCorrection<S> {
    fn stabilise(
        &self,
        constants: &M::Constants<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Result<S, Fault> {
        self.correct::<M>(constants, time, state).map(S::constant)
    }
}

/// The linear equations `D d = -violation` at a state, and what the violation is compared with.
struct Linear {
    report: Report,
    /// The rows of `D`.
    rows: Vec<Vec<f64>>,
    violation: Vec<f64>,
    sizes: Vec<f64>,
    /// What the square of an element of a movement counts.
    metric: Vec<f64>,
}

impl Linear {
    fn positions<S: Real, M: Mechanism>(
        constants: &M::Constants<S>,
        time: S,
        state: &M::State<S>,
    ) -> Self {
        let blocks = numbers(M::jacobian(constants, time, state).as_slice());
        let phi = numbers(M::constraints(constants, time, state).as_slice());
        let coordinates = numbers(state.coordinates().as_slice());
        let extent = extent(&M::REPORT, &coordinates);
        let width = state.velocities().as_slice().len();
        Self::of(
            M::REPORT,
            &blocks,
            phi,
            (extent, 1.0),
            &metric(&M::REPORT, width, TURN),
        )
    }

    fn velocities<S: Real, M: Mechanism>(
        constants: &M::Constants<S>,
        time: S,
        state: &M::State<S>,
    ) -> Self {
        let blocks = numbers(M::jacobian(constants, time, state).as_slice());
        let rates = numbers(M::constraint_rates(constants, time, state).as_slice());
        let extent = extent(&M::REPORT, &numbers(state.coordinates().as_slice()));
        let velocities = numbers(state.velocities().as_slice());
        let rate = rate(&M::REPORT, &velocities, extent);
        let metric = metric(&M::REPORT, velocities.len(), 1.0);
        Self::of(M::REPORT, &blocks, rates, (extent, rate), &metric)
    }

    /// Rows have the size of a movement by the extent, or a turn by a radian, in this unit.
    fn of(
        report: Report,
        blocks: &[f64],
        violation: Vec<f64>,
        (extent, unit): (f64, f64),
        metric: &[f64],
    ) -> Self {
        let mut rows = vec![vec![0.0; metric.len()]; report.equations];
        for block in report.blocks {
            let values = blocks[block.offset..].chunks(block.columns);
            for (row, values) in rows[block.row..].iter_mut().zip(values).take(block.rows) {
                add(&mut row[block.column..], 1.0, values);
            }
        }
        let size = |row: &Vec<f64>| match largest_part(&report, row, extent) {
            0.0 => unit,
            part => part * unit,
        };
        Self {
            sizes: rows.iter().map(size).collect(),
            metric: metric.to_vec(),
            report,
            rows,
            violation,
        }
    }

    /// The state after one application, and what it left beyond the tolerance, relative to its row.
    fn corrected<X: Copy>(
        &self,
        (tolerance, epsilon): (f64, f64),
        given: X,
        step_from: impl Fn(&X, &[f64]) -> (X, Self),
    ) -> Result<(X, f64), Fault> {
        let before = self.worst().1;
        if before <= 8.0 * epsilon {
            return Ok((given, 0.0));
        }
        let limit = tolerance.sqrt().min(LARGEST);
        let beyond = |rest: f64| if rest > tolerance { rest } else { 0.0 };
        // Nearly dependent rows are followed first, as far as the violation lets them be known, and
        // left out where that does not help.
        let followed = before.min(epsilon.sqrt()) * before.min(1.0).sqrt();
        for stiffness in [followed.max(64.0 * epsilon), epsilon.sqrt()] {
            let step = self.least_movement(stiffness.sqrt());
            if !step.iter().all(|x| x.is_finite()) {
                continue;
            }
            let (next, linear) = step_from(&given, &step);
            let rest = linear.worst().1;
            let helped = linear.norm() < HELPS * self.norm() && rest <= limit;
            if helped || rest <= tolerance {
                return Ok((next, beyond(rest)));
            }
        }
        if before <= limit {
            return Ok((given, beyond(before)));
        }
        let (row, _) = self.worst();
        Err(Fault::Step(StepFault::NotConverged {
            iterations: 1,
            residual: self.violation[row].abs(),
            joint: self.joint_of(row),
            alpha: None,
        }))
    }

    fn joint_of(&self, row: usize) -> Option<&'static str> {
        let mut joints = self.report.joints.iter();
        let owner = joints.find(|joint| (joint.row..joint.row + joint.rows).contains(&row));
        owner.map(|joint| joint.name)
    }

    /// The row that is violated most, relative to its size, and by how much.
    fn worst(&self) -> (usize, f64) {
        let parts = self.violation.iter().zip(&self.sizes);
        let parts = parts.map(|(phi, size)| match phi.abs() {
            0.0 => 0.0,
            // Beyond the range of numbers, nothing is within a tolerance.
            phi if phi.is_nan() || !size.is_finite() => f64::INFINITY,
            phi => phi / size,
        });
        let worst = parts.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        worst.unwrap_or((0, 0.0))
    }

    fn norm(&self) -> f64 {
        let parts = self.violation.iter().zip(&self.sizes);
        parts.map(|(phi, size)| (phi / size).powi(2)).sum()
    }

    /// The `d` with `D d = -violation` that is least in the metric, without the rows of which less
    /// than a part is independent of those before them.
    fn least_movement(&self, part: f64) -> Vec<f64> {
        let roots: Vec<f64> = self.metric.iter().map(|x| x.sqrt()).collect();
        let mut left: Vec<(Vec<f64>, f64)> = Vec::new();
        for (row, violation) in self.rows.iter().zip(&self.violation) {
            let scaled: Vec<f64> = row.iter().zip(&roots).map(|(x, root)| x / root).collect();
            let length = dot(&scaled, &scaled).sqrt();
            if length > 0.0 {
                let row = scaled.iter().map(|x| x / length).collect();
                left.push((row, -violation / length));
            }
        }
        let mut movement = vec![0.0; roots.len()];
        while let Some(longest) = longest(&left, part) {
            let (mut unit, mut along) = left.swap_remove(longest);
            let length = dot(&unit, &unit).sqrt();
            unit.iter_mut().for_each(|x| *x /= length);
            along /= length;
            add(&mut movement, along, &unit);
            for (row, value) in &mut left {
                let common = dot(row, &unit);
                add(row, -common, &unit);
                *value -= common * along;
            }
        }
        movement
            .iter()
            .zip(&roots)
            .map(|(x, root)| x / root)
            .collect()
    }
}

/// The place of the longest row, if it is longer than a part of what it was.
fn longest(rows: &[(Vec<f64>, f64)], part: f64) -> Option<usize> {
    let squares = rows.iter().map(|(row, _)| dot(row, row)).enumerate();
    let longest = squares.max_by(|a, b| a.1.total_cmp(&b.1))?;
    (longest.1 > part * part).then_some(longest.0)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn add(sum: &mut [f64], factor: f64, of: &[f64]) {
    sum.iter_mut().zip(of).for_each(|(x, y)| *x += factor * y);
}

fn numbers<S: Real>(elements: &[S]) -> Vec<f64> {
    elements.iter().map(|x| x.to_f64()).collect()
}

fn rigid(report: &Report) -> impl Iterator<Item = &'static BodyInfo> + use<> {
    let bodies = report.bodies.iter();
    bodies.filter(|body| body.kind == BodyKind::Rigid)
}

fn norm(elements: &[f64], first: usize) -> f64 {
    let part = &elements[first..first + 3];
    dot(part, part).sqrt()
}

/// What the square of an element of a movement counts: 1 of a translation, `turn` of a rotation.
fn metric(report: &Report, width: usize, turn: f64) -> Vec<f64> {
    let mut metric = vec![1.0; width];
    for body in rigid(report) {
        metric[body.velocity + 3..body.velocity + 6].fill(turn);
    }
    metric
}

/// What a rotation of a radian of one body adds to a row, or a movement by the extent, whichever is
/// the most.
fn largest_part(report: &Report, row: &[f64], extent: f64) -> f64 {
    let bodies = report.bodies.iter();
    let moved = bodies.map(|body| norm(row, body.velocity) * extent);
    let turned = rigid(report).map(|body| norm(row, body.velocity + 3));
    moved.chain(turned).fold(0.0, f64::max)
}

/// The largest distance (m) of a centre of mass from the first one, or from the origin where there
/// is one alone or all are one.
fn extent(report: &Report, coordinates: &[f64]) -> f64 {
    let centres = report.bodies.iter().map(|body| body.coordinate);
    let from = |origin: &[f64]| {
        let distances = centres.clone().map(|place| {
            let centre = &coordinates[place..place + 3];
            let arm = [0, 1, 2].map(|k| centre[k] - origin[k]);
            norm(&arm, 0)
        });
        distances.fold(0.0, f64::max)
    };
    let first = report.bodies.first().map_or(0, |body| body.coordinate);
    match from(&coordinates[first..first + 3]) {
        0.0 => from(&[0.0; 3]),
        extent => extent,
    }
}

/// The largest rate (1/s) at which a body turns or goes the extent.
fn rate(report: &Report, velocities: &[f64], extent: f64) -> f64 {
    let bodies = report.bodies.iter();
    let moving = bodies.map(|body| norm(velocities, body.velocity) / extent);
    let turning = rigid(report).map(|body| norm(velocities, body.velocity + 3));
    let rates = moving.chain(turning);
    rates.filter(|rate| rate.is_finite()).fold(0.0, f64::max)
}

/// The state with Euler parameters of length 1.
fn with_unit_orientations<S: Real, M: Mechanism>(
    state: &M::State<S>,
) -> Result<M::State<S>, Fault> {
    let mut state = *state;
    let numbers = state
        .coordinates()
        .as_slice()
        .iter()
        .chain(state.velocities().as_slice());
    if !numbers.into_iter().all(|x| x.is_finite()) {
        return Err(Fault::Step(StepFault::StateNotFinite));
    }
    for body in rigid(&M::REPORT) {
        let p = &mut state.coordinates_mut().as_mut_slice()[body.coordinate + 3..][..4];
        let length = p.iter().fold(S::zero(), |sum, &e| sum + e * e).sqrt();
        if length == S::zero() {
            return Err(Fault::Step(StepFault::ZeroOrientation { body: body.name }));
        }
        p.iter_mut().for_each(|e| *e = e.quotient(length));
    }
    Ok(state)
}

/// The state with positions moved by a step: `r` by addition, `p` by a rotation along body axes.
/// Angles that count turns follow.
fn moved<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    state: &M::State<S>,
    step: &[f64],
) -> M::State<S> {
    let mut along = *state;
    let velocities = along.velocities_mut().as_mut_slice().iter_mut();
    velocities.zip(step).for_each(|(u, &x)| *u = S::constant(x));
    let rates = M::coordinate_rates(constants, &along);
    let mut moved = *state;
    let coordinates = moved.coordinates_mut().as_mut_slice();
    for (auxiliary, &rate) in coordinates
        .iter_mut()
        .zip(rates.as_slice())
        .skip(M::REPORT.coordinates)
    {
        *auxiliary = *auxiliary + rate;
    }
    for body in M::REPORT.bodies {
        for k in 0..3 {
            let place = &mut coordinates[body.coordinate + k];
            *place = *place + S::constant(step[body.velocity + k]);
        }
    }
    for body in rigid(&M::REPORT) {
        let turn = [3, 4, 5].map(|k| step[body.velocity + k]);
        let angle = dot(&turn, &turn).sqrt();
        let sine = if angle > 0.0 {
            (0.5 * angle).sin() / angle
        } else {
            0.5
        };
        let [x, y, z] = turn.map(|x| x * sine);
        let w = (0.5 * angle).cos();
        let p = &mut coordinates[body.coordinate + 3..][..4];
        let [a, b, c, d] = [p[0], p[1], p[2], p[3]].map(|e| e.to_f64());
        let turned = [
            a * w - b * x - c * y - d * z,
            a * x + b * w + c * z - d * y,
            a * y + c * w + d * x - b * z,
            a * z + d * w + b * y - c * x,
        ];
        let length = dot(&turned, &turned).sqrt();
        p.iter_mut()
            .zip(turned)
            .for_each(|(p, e)| *p = S::constant(e / length));
    }
    M::rewrap(constants, &mut moved);
    moved
}
