//! Whether what was decided at the typical values of parameters holds for other values.
//!
//! The macro finds the rank and the redundant equations at the typical values. Here the mechanism
//! is assembled with the given ones. Its equations must be independent at the start. Each equation
//! that was left out must hold, and its gradient must be a combination of those of the others: at
//! the start, and at configurations that motions within the constraints lead to.

use crate::constraints::extent::extent;
use crate::constraints::projection::Projection;
use crate::constraints::retract::displaced;
use crate::dynamics::vanishes;
use crate::error::{Fault, ParameterError, ParameterFault, StepFault};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::norm;
use crate::mechanism::kernels::{Mechanism, Plain, Stabilisation};
use crate::state::vector::{Array, StateParts};

/// The typical value of a parameter, for generated code.
#[derive(Clone, Copy, Debug)]
pub struct Like {
    /// Its place among the run-time values.
    pub place: usize,
    /// Its field.
    pub field: &'static str,
    /// Its typical value.
    pub value: f64,
}

/// What is left of a gradient beside those that it follows from, over its length, and a violation
/// over the size of its row, that count as none: as at expansion.
const FOLLOWS: f64 = 1e-7;
/// Configurations that motions lead to, besides the start.
const MOTIONS: usize = 3;
/// The size of a motion: in radians, and in extents of the mechanism.
const MOTION: f64 = 0.2;
/// How often a motion that does not lead back onto the constraints is halved.
const HALVINGS: usize = 4;
/// How many motions of the described state are tried where it does not lead onto the constraints.
const SHAKES: u8 = 4;
/// The least part of the way from the typical values to the given ones.
const LEAST_STEP: f64 = 1.0 / 256.0;
/// Times (s) at which a mechanism with drivers is looked at.
const TIMES: [f64; 4] = [1e-3, 1e-2, 1e-1, 1.0];

/// [`Mechanism::check_likes`]: checks given values, unless they are those that were accepted
/// before.
///
/// # Errors
/// A parameter with which something does not hold.
pub fn check_likes<S, M, const N: usize>(
    since: Option<&[S; N]>,
    given: &[f64; N],
    likes: &[Like],
) -> Result<(), ParameterError>
where
    S: Real,
    M: Mechanism<Parameters<f64> = [f64; N]>,
{
    let value = |like: &Like| given.get(like.place).copied().unwrap_or(like.value);
    let is_known = |like: &Like| {
        let before = since.and_then(|since| since.get(like.place));
        before.is_some_and(|before| *before == S::constant(value(like)))
    };
    if likes.iter().all(is_known) || likes.iter().all(|like| value(like) == like.value) {
        return Ok(());
    }
    holds::<M, N>(given, likes).map_err(|fault| ParameterError {
        field: blamed::<M, N>(given, likes),
        attribute: "value",
        fault,
    })
}

/// The first parameter that would mend it if it were what it is like, else the one that is farthest
/// from that.
#[cold]
fn blamed<M, const N: usize>(given: &[f64; N], likes: &[Like]) -> &'static str
where
    M: Mechanism<Parameters<f64> = [f64; N]>,
{
    let mut farthest = ("", -1.0);
    for like in likes {
        let mut mended = *given;
        let Some(value) = mended.get_mut(like.place) else {
            continue;
        };
        let distance = (*value - like.value).abs() / value.abs().max(like.value.abs());
        if *value == like.value {
            continue;
        }
        *value = like.value;
        if holds::<M, N>(&mended, likes).is_ok() {
            return like.field;
        }
        if distance > farthest.1 {
            farthest = (like.field, distance);
        }
    }
    farthest.0
}

/// Whether all that was decided holds.
fn holds<M, const N: usize>(given: &[f64; N], likes: &[Like]) -> Result<(), ParameterFault>
where
    M: Mechanism<Parameters<f64> = [f64; N]>,
{
    let constants = M::prepare(given);
    let start = assembled::<M, N>(&constants, given, likes)?;
    if M::REPORT.keeps_redundant() {
        return Ok(());
    }
    let mut look = Look::<M>::at(&constants, start);
    if !M::REPORT.rank.starts_singular() {
        look.is_regular()?;
    }
    look.what_was_left_out()?;
    for _ in 0..MOTIONS {
        if !look.goes_on() {
            break;
        }
        look.what_was_left_out()?;
    }
    if const { M::REPORT.time.constraints } {
        look = Look::at(&constants, start);
        for time in TIMES {
            if !look.goes_on_to(time) {
                break;
            }
            look.what_was_left_out()?;
        }
    }
    Ok(())
}

/// A state on the constraints: from the described one, by continuation from the typical values, or
/// from near the described one, which may be singular.
fn assembled<M, const N: usize>(
    constants: &M::Constants<f64>,
    given: &[f64; N],
    likes: &[Like],
) -> Result<M::State<f64>, ParameterFault>
where
    M: Mechanism<Parameters<f64> = [f64; N]>,
{
    let described = at_rest::<M>(constants);
    let fault = match put_together::<M>(constants, described) {
        Ok(state) => return Ok(state),
        Err(fault) => fault,
    };
    continued::<M, N>(given, likes)
        .or_else(|| shaken::<M>(constants, described))
        .ok_or_else(|| not_assembled::<M>(constants, fault))
}

/// A state with the given values, by steps from the typical ones.
#[cold]
fn continued<M, const N: usize>(given: &[f64; N], likes: &[Like]) -> Option<M::State<f64>>
where
    M: Mechanism<Parameters<f64> = [f64; N]>,
{
    let between = |part: f64| {
        let mut values = *given;
        for like in likes {
            if let Some(value) = values.get_mut(like.place) {
                *value = like.value + part * (*value - like.value);
            }
        }
        M::prepare(&values)
    };
    let typical = between(0.0);
    let mut state = put_together::<M>(&typical, at_rest::<M>(&typical)).ok()?;
    let (mut reached, mut step) = (0.0, 0.25);
    while reached < 1.0 {
        let next = 1.0_f64.min(reached + step);
        match put_together::<M>(&between(next), state) {
            Ok(found) => (state, reached, step) = (found, next, 2.0 * step),
            Err(_) if step > LEAST_STEP => step *= 0.5,
            Err(_) => return None,
        }
    }
    Some(state)
}

/// A state from random motions of the described one.
#[cold]
fn shaken<M: Mechanism>(
    constants: &M::Constants<f64>,
    described: M::State<f64>,
) -> Option<M::State<f64>> {
    let length = extent::<f64, M>(constants, &described);
    let mut random = Random::new();
    let mut motions = (1..=SHAKES).map(|shake| {
        let mut motion = M::Velocities::<f64>::zeros();
        let elements = motion.as_mut_slice().iter_mut();
        elements.for_each(|element| *element = random.number());
        scale_translations::<M>(&mut motion, length);
        let factor = MOTION * f64::from(shake);
        displaced::<f64, M>(constants, &described, &motion, factor)
    });
    motions.find_map(|moved| put_together::<M>(constants, moved).ok())
}

/// The described state without velocities.
fn at_rest<M: Mechanism>(constants: &M::Constants<f64>) -> M::State<f64> {
    let mut state = M::initial_state(constants);
    *state.velocities_mut() = Array::zeros();
    state
}

fn put_together<M: Mechanism>(
    constants: &M::Constants<f64>,
    mut state: M::State<f64>,
) -> Result<M::State<f64>, Fault> {
    Projection::default().correct::<M>(constants, 0.0, &mut state)?;
    Ok(state)
}

/// Why, with the joint that stays open, or whose equations are not finite.
fn not_assembled<M: Mechanism>(constants: &M::Constants<f64>, fault: Fault) -> ParameterFault {
    let named = match fault {
        Fault::Step(StepFault::NotConverged { joint, .. }) => joint,
        Fault::Step(StepFault::Singular { name, .. }) => Some(name),
        _ => None,
    };
    let joint = named.or_else(|| {
        let phi = M::constraints(constants, 0.0, &at_rest::<M>(constants));
        let row = phi.as_slice().iter().position(|phi| !phi.is_finite())?;
        M::REPORT.joint_of(row)
    });
    ParameterFault::NotAssembled {
        joint: joint.unwrap_or_default(),
    }
}

/// A configuration on the constraints, with what is known there.
struct Look<'a, M: Mechanism> {
    constants: &'a M::Constants<f64>,
    coefficients: M::Coefficients<f64>,
    time: f64,
    state: M::State<f64>,
    factors: M::Factors<f64>,
    /// The joint whose pivot vanishes.
    singular: Option<usize>,
    random: Random,
}

impl<'a, M: Mechanism> Look<'a, M> {
    fn at(constants: &'a M::Constants<f64>, state: M::State<f64>) -> Self {
        let rigid = Stabilisation {
            rate: 0.0,
            position: 0.0,
            compliance: 0.0,
        };
        let coefficients = M::coefficients(constants, &rigid);
        let (factors, singular) = factors::<M>(constants, &coefficients, 0.0, &state);
        Self {
            constants,
            coefficients,
            time: 0.0,
            state,
            factors,
            singular,
            random: Random::new(),
        }
    }

    /// Whether the equations are independent.
    fn is_regular(&self) -> Result<(), ParameterFault> {
        match self.singular {
            None => Ok(()),
            Some(joint) => Err(ParameterFault::Dependent {
                joint: name::<M>(joint),
            }),
        }
    }

    /// Whether every equation that was left out follows from the others.
    fn what_was_left_out(&self) -> Result<(), ParameterFault> {
        let length = extent::<f64, M>(self.constants, &self.state);
        let least = (length * length).min(1.0);
        let left_out = M::REPORT.redundant.iter().filter(|row| row.dropped);
        for (number, row) in left_out.enumerate() {
            let found = M::left_out(self.constants, self.time, &self.state, number);
            let Some((violation, gradient)) = found else {
                continue;
            };
            let mut sizes = gradient;
            scale_translations::<M>(&mut sizes, length);
            let size = norm(sizes.as_slice()).max(least);
            let holds = violation.abs() <= FOLLOWS * size;
            if !(holds && self.share_beside(&gradient) <= FOLLOWS) {
                return Err(ParameterFault::Independent {
                    joint: name::<M>(row.joint),
                });
            }
        }
        Ok(())
    }

    /// What is left of a gradient beside those of the equations, over what it is, in the metric of
    /// the mass; nothing where these depend on each other.
    fn share_beside(&self, gradient: &M::Velocities<f64>) -> f64 {
        if self.singular.is_some() {
            return 0.0;
        }
        let rest = self.free(gradient);
        let (mut left, mut whole) = (0.0, 0.0);
        let mass = M::metric(self.constants);
        let elements = rest.as_slice().iter().zip(gradient.as_slice());
        for ((rest, gradient), mass) in elements.zip(mass.as_slice()) {
            left += mass * rest * rest;
            whole += gradient * gradient / mass;
        }
        if whole > 0.0 {
            Scalar::sqrt(left / whole)
        } else {
            0.0
        }
    }

    /// The accelerations by forces and moments, as the equations let them be.
    fn free(&self, forces: &M::Velocities<f64>) -> M::Velocities<f64> {
        let still = M::Multipliers::<f64>::zeros();
        let (constants, coefficients) = (self.constants, &self.coefficients);
        M::solve::<f64, Plain>(constants, coefficients, &self.factors, forces, &still).0
    }

    /// Goes on along a random motion that the equations leave free; `false` where there is none, or
    /// none that leads back onto them.
    fn goes_on(&mut self) -> bool {
        let length = extent::<f64, M>(self.constants, &self.state);
        let mut motion = M::metric(self.constants);
        for element in motion.as_mut_slice() {
            *element *= self.random.number();
        }
        if self.singular.is_none() {
            motion = self.free(&motion);
        }
        let mut sizes = motion;
        scale_translations::<M>(&mut sizes, length.recip());
        let most = sizes.as_slice().iter();
        let most = most.fold(0.0_f64, |most, size| most.max(size.abs()));
        let mut factor = MOTION / most;
        if !factor.is_finite() {
            return false;
        }
        for _ in 0..=HALVINGS {
            let moved = displaced::<f64, M>(self.constants, &self.state, &motion, factor);
            if self.takes(self.time, moved) {
                return true;
            }
            factor *= 0.5;
        }
        false
    }

    /// Goes on with what is driven.
    fn goes_on_to(&mut self, time: f64) -> bool {
        let duration = time - self.time;
        let velocities = *self.state.velocities();
        let moved = displaced::<f64, M>(self.constants, &self.state, &velocities, duration);
        self.takes(time, moved)
    }

    /// Puts a state onto the constraints and looks there, if that succeeds.
    fn takes(&mut self, time: f64, mut state: M::State<f64>) -> bool {
        let corrected = Projection::default().correct::<M>(self.constants, time, &mut state);
        if corrected.is_err() {
            return false;
        }
        let coefficients = &self.coefficients;
        (self.factors, self.singular) = factors::<M>(self.constants, coefficients, time, &state);
        (self.time, self.state) = (time, state);
        true
    }
}

/// Numbers without a pattern, the same for every mechanism (Marsaglia's xorshift).
struct Random(u64);

impl Random {
    const fn new() -> Self {
        Self(0x9e37_79b9_7f4a_7c15)
    }

    /// Between -1 and 1.
    fn number(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// The factors at a state, and the joint whose pivot vanishes.
fn factors<M: Mechanism>(
    constants: &M::Constants<f64>,
    coefficients: &M::Coefficients<f64>,
    time: f64,
    state: &M::State<f64>,
) -> (M::Factors<f64>, Option<usize>) {
    let (factors, pivot) = M::factor::<f64, Plain>(constants, coefficients, time, state);
    let is_sound = pivot.relative.is_finite() && !vanishes::<f64, Plain>(pivot.relative);
    (factors, (!is_sound).then_some(pivot.joint as usize))
}

/// Multiplies what belongs to translations.
fn scale_translations<M: Mechanism>(velocities: &mut M::Velocities<f64>, factor: f64) {
    for body in M::REPORT.bodies {
        let own = velocities.as_mut_slice().iter_mut().skip(body.velocity);
        own.take(3).for_each(|x| *x *= factor);
    }
}

/// The field of a joint.
fn name<M: Mechanism>(joint: usize) -> &'static str {
    M::REPORT.joints.get(joint).map_or("", |joint| joint.name)
}
