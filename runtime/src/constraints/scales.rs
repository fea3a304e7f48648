//! The mass, the length and the time of a scene, from which coefficients and tolerances follow.

use crate::constraints::extent::extent;
use crate::constraints::newton::compliant;
use crate::constraints::rows::Rows;
use crate::error::setting::positive;
use crate::error::{Fault, NotFinite, StartFault, StepFault};
use crate::math::scalar::Real;
use crate::math::vec3::norm;
use crate::math::vec3::read;
use crate::mechanism::kernels::{Compliant, Mechanism};
use crate::mechanism::orientations::{check_state, with_unit_orientations};
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// What a scene is measured by: its mass, its length and its time, as its bodies stand and move and
/// are pulled at one instant.
///
/// Coefficients of formulations and absolute tolerances have units, and no number of them suits a
/// watch and a crane. [`Baumgarte::of`](crate::Baumgarte::of), [`Penalty::of`](crate::Penalty::of),
/// [`AugmentedLagrangian::of`](crate::AugmentedLagrangian::of) and
/// [`Tolerance::of`](crate::Tolerance::of) make them of these; a mechanism with all masses, lengths
/// and times in other proportions gets coefficients in these proportions. Any of the fields may be
/// set where more is known of a motion than its start tells, and given to `with_scales` of the
/// four.
///
/// ```
/// use holonom::prelude::*;
/// use holonom::constraints::Scales;
///
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81])]
/// struct Rod {
///     #[body(mass = 7.0, inertia = [0.6, 0.001, 0.6], position = [0.0, 0.5, 0.0])]
///     rod: Body,
///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
///     pivot: Revolute,
/// }
///
/// let scales: Scales<f64> = Scales::of(&Rod::default())?;
/// assert_eq!((scales.mass, scales.length), (7.0, 0.5));
/// assert!((scales.time - (0.5_f64 / 9.81).sqrt()).abs() < 1e-15); // 0.23 s
/// # Ok::<(), Fault>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales<S> {
    /// The mass (kg) that the constraints may have to carry: of all bodies that a joint is about,
    /// or of all where there are no joints.
    pub mass: S,
    /// The least mass (kg) that a constraint feels, `1 / (D M^-1 D^T)_ii` with the row in metres,
    /// and over the square of [`Scales::length`] for one in radians. `mass` over it is the ratio of
    /// masses; equal to `mass` without constraints.
    pub lightest: S,
    /// The length (m): the largest distance of a centre of mass, or of a joint's point, from the
    /// centre of mass of the first body, of a joint's point from the centre of mass of its body, or
    /// the largest radius of gyration. One metre for particles that have no length to go by.
    pub length: S,
    /// The time (s) in which something turns by a radian or goes the length: by the velocities, the
    /// accelerations that forces and constraints give, the drivers, or in free fall of all bodies
    /// together under the forces on them, whichever is the shortest. Free fall counts where the
    /// scene stands in equilibrium too; the stiffness of a spring counts only as far as the spring
    /// pulls.
    ///
    /// One second where nothing moves, nothing is driven and no force acts.
    pub time: S,
}

/// What counts as an acceleration, over what the forces would do without constraints: less may be
/// what the compliance of the solution leaves, a part `sqrt(EPSILON)`.
const COUNTS: f64 = 4.0;

/// What is below so many `EPSILON` of the forces that it is the sum of is their round-off.
const CANCELS: f64 = 64.0;

impl<S: Real> Scales<S> {
    /// The scales of the mechanism as its attributes describe it, at the time zero.
    ///
    /// It costs a few evaluations: for the beginning of a run, not for every step.
    ///
    /// # Errors
    /// [`Fault::Parameter`]; a described state, forces or drivers that are not finite
    /// ([`StepFault::StateNotFinite`], [`StepFault::ZeroOrientation`],
    /// [`StepFault::RatesNotFinite`]); [`StartFault::Setting`] for a scale that the number type
    /// does not hold.
    pub fn of<M: Mechanism>(mechanism: &M) -> Result<Self, Fault> {
        let constants = constants(mechanism)?;
        let state = M::initial_state(&constants);
        Self::found::<M>(&constants, S::zero(), &state)
    }

    /// The scales in another state, or at another time (s): where a run does not start as the
    /// attributes describe.
    ///
    /// # Errors
    /// As [`Scales::of`].
    pub fn at<M: Mechanism>(mechanism: &M, time: S, state: &M::State<S>) -> Result<Self, Fault> {
        Self::found::<M>(&constants(mechanism)?, time, state)
    }

    fn found<M: Mechanism>(
        constants: &M::Constants<S>,
        time: S,
        state: &M::State<S>,
    ) -> Result<Self, Fault> {
        check_state::<S, M>(state)?;
        let mut state = with_unit_orientations::<S, M>(state);
        M::rewrap(constants, &mut state);
        let length = length::<S, M>(constants, &state);
        let mass = mass::<S, M>(constants);
        let rows = Rows::<S, M>::at(constants, time, &state);
        let rate = rate::<S, M>(constants, &rows, &state, length)?;
        let time = if rate > S::zero() {
            rate.reciprocal()
        } else {
            S::one()
        };
        let lightest = rows.lightest(length).unwrap_or(mass);
        Ok(Self {
            mass: positive("mass of the scene", mass)?,
            lightest: positive("least mass of the scene", lightest)?,
            length: squarable("length of the scene", length, length)?,
            time: squarable("time of the scene", time, S::one().max(time.reciprocal()))?,
        })
    }
}

/// A scale, if what is squared of it keeps its digits.
fn squarable<S: Real>(name: &'static str, value: S, root: S) -> Result<S, Fault> {
    let square = root * root;
    if value.is_finite() && square.is_finite() && square >= S::smallest() {
        Ok(value)
    } else {
        let value = value.to_f64();
        Err(Fault::Start(StartFault::Setting { name, value }))
    }
}

fn constants<S: Real, M: Mechanism>(mechanism: &M) -> Result<M::Constants<S>, Fault> {
    let mut parameters = mechanism.parameters()?;
    M::put_inputs(&mechanism.inputs(), &mut parameters)?;
    Ok(M::prepare(&parameters))
}

/// The mass of all bodies that a joint is about, or of all.
fn mass<S: Real, M: Mechanism>(constants: &M::Constants<S>) -> S {
    let mass = M::metric(constants);
    let held = |body: usize| M::REPORT.blocks.iter().any(|block| block.body == body);
    let all = M::REPORT.blocks.is_empty();
    let bodies = M::REPORT.bodies.iter().enumerate();
    let masses = bodies.filter(|(body, _)| all || held(*body));
    masses.fold(S::zero(), |sum, (_, body)| {
        let [own]: [S; 1] = read(mass.as_slice(), body.velocity);
        sum + own
    })
}

/// The extent of the mechanism, or the largest radius of gyration.
fn length<S: Real, M: Mechanism>(constants: &M::Constants<S>, state: &M::State<S>) -> S {
    let mass = M::metric(constants);
    let mut length = extent::<S, M>(constants, state);
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let [own, _, _, x, y, z]: [S; 6] = read(mass.as_slice(), body.velocity);
            length = length.max(x.max(y).max(z).quotient(own).sqrt());
        }
    }
    if length == S::zero() {
        S::one()
    } else {
        length
    }
}

/// The largest of the rates (1/s) at which something turns or goes a length.
fn rate<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    rows: &Rows<S, M>,
    state: &M::State<S>,
    length: S,
) -> Result<S, Fault> {
    let turning = |velocities: &M::Velocities<S>| turning::<S, M>(velocities, length);
    let forces = resolved::<S, M>(constants, rows.time, state);
    let mass = M::metric(constants);
    let mut free = forces;
    let places = free.as_mut_slice().iter_mut().zip(mass.as_slice());
    places.for_each(|(force, &mass)| *force = force.quotient(mass));
    let (coefficients, factors) = compliant::<S, M>(constants, rows, state, S::EPSILON.sqrt());
    let gamma = M::gamma(constants, rows.time, state);
    let (accelerations, _) =
        M::solve::<S, Compliant>(constants, &coefficients, &factors, &forces, &gamma);
    let counts = S::constant(COUNTS) * S::EPSILON.sqrt() * turning(&free);
    let accelerated = turning(&accelerations);
    // NaN stays.
    let accelerated = if accelerated <= counts {
        S::zero()
    } else {
        accelerated
    };
    let squared = accelerated.max(falling::<S, M>(&forces, &mass).quotient(length));
    let rate = squared.sqrt();
    let rate = rate.max(turning(state.velocities())).max(rows.driven());
    if rate.is_finite() {
        Ok(rate)
    } else {
        let origin = NotFinite::Unknown;
        Err(Fault::Step(StepFault::RatesNotFinite { origin }))
    }
}

/// The forces on the bodies, without what is but the round-off of forces that cancel.
fn resolved<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
) -> M::Velocities<S> {
    let mut forces = M::forces(constants, time, state);
    let mut whole = M::Velocities::<S>::zeros();
    for (index, force) in M::REPORT.forces.iter().enumerate() {
        for (place, body) in force.bodies.iter().enumerate() {
            let Some(body) = body.and_then(|body| M::REPORT.bodies.get(body)) else {
                continue;
            };
            let load = M::force_load(constants, time, state, index, place);
            let columns = match body.kind {
                BodyKind::Rigid => 6,
                BodyKind::Particle => 3,
            };
            let places = whole.as_mut_slice().iter_mut().skip(body.velocity);
            for (sum, part) in places.zip(load).take(columns) {
                *sum = *sum + part.abs();
            }
        }
    }
    let places = forces.as_mut_slice().iter_mut().zip(whole.as_slice());
    for (force, &whole) in places {
        if force.abs() < S::constant(CANCELS) * S::EPSILON * whole {
            *force = S::zero();
        }
    }
    forces
}

/// The largest angular velocity of a body, or velocity over the length; of accelerations likewise.
fn turning<S: Real, M: Mechanism>(velocities: &M::Velocities<S>, length: S) -> S {
    let velocities = velocities.as_slice();
    let mut turning = S::zero();
    for body in M::REPORT.bodies {
        let linear = norm(&read::<S, 3>(velocities, body.velocity));
        turning = turning.max(linear.quotient(length));
        if body.kind == BodyKind::Rigid {
            turning = turning.max(norm(&read::<S, 3>(velocities, body.velocity + 3)));
        }
    }
    turning
}

/// The acceleration (m/s^2) of the centre of mass of all bodies, without constraints: of gravity,
/// what gravity is; forces between bodies cancel.
fn falling<S: Real, M: Mechanism>(forces: &M::Velocities<S>, mass: &M::Velocities<S>) -> S {
    let (mut sum, mut whole) = ([S::zero(); 3], S::zero());
    for body in M::REPORT.bodies {
        let force: [S; 3] = read(forces.as_slice(), body.velocity);
        let [own]: [S; 1] = read(mass.as_slice(), body.velocity);
        sum.iter_mut()
            .zip(force)
            .for_each(|(sum, force)| *sum = *sum + force);
        whole = whole + own;
    }
    norm(&sum).quotient(whole)
}
