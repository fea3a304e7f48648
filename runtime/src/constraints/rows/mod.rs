//! What the rows of `Phi` and `Phi'` are measured by, so that metres, square metres and radians
//! mean the same.

mod sizes;
mod stiffness;

pub(crate) use sizes::Sizes;
pub(crate) use stiffness::{compliances_at, evened, stiffness_at, yield_velocities};

use stiffness::{compliances, felt, stiffness, yields};

use crate::constraints::extent::{centre, extent};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::norm;
use crate::math::vec3::{read, write};
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::{Block, BodyKind};
use crate::state::vector::{Array, StateParts};

/// The rows of `D` at one time and configuration, and what they are about. All sizes are the same
/// wherever the mechanism stands, but for those of round-off.
pub(crate) struct Rows<S: Scalar, M: Mechanism> {
    /// The largest part of a row that belongs to the translation of one body, and to the rotation
    /// of one.
    translation: M::Multipliers<S>,
    rotation: M::Multipliers<S>,
    /// The length (m) of a row: see [`Rows::at`].
    length: M::Multipliers<S>,
    /// The largest distance (m) from the origin among centres of mass and points on the ground of
    /// the row's joint.
    distance: M::Multipliers<S>,
    /// What counted turns add to the terms of a row.
    counted: M::Multipliers<S>,
    /// `Phi_t`.
    drift: M::Multipliers<S>,
    /// The diagonal of `D M^-1 D^T`, the same for the rows of a vector equation.
    pub(crate) stiffness: M::Multipliers<S>,
    /// The largest distance (m) of a centre of mass, or of a joint's point on the ground, from the
    /// first centre of mass.
    extent: S,
    pub(crate) time: S,
}

copied!([S: Scalar, M: Mechanism] Rows<S, M>);

/// The sizes of one row.
#[derive(Clone, Copy)]
struct Size<S> {
    natural: S,
    /// The sum of the sizes of its terms.
    terms: S,
    whole: S,
}

/// The largest speed (m/s) and angular speed (rad/s) of the bodies of a mechanism, each with the
/// other over its extent.
#[derive(Clone, Copy)]
pub(crate) struct Speeds<S> {
    translation: S,
    rotation: S,
}

impl<S: Real> Speeds<S> {
    /// Those of a state, of a mechanism of an extent (m).
    fn of<M: Mechanism>(state: &M::State<S>, extent: S) -> Self {
        let velocities = state.velocities().as_slice();
        let (mut translation, mut rotation) = (S::zero(), S::zero());
        for body in M::REPORT.bodies {
            translation = translation.max(norm(&read::<S, 3>(velocities, body.velocity)));
            if body.kind == BodyKind::Rigid {
                rotation = rotation.max(norm(&read::<S, 3>(velocities, body.velocity + 3)));
            }
        }
        let turning = if extent > S::zero() {
            rotation.max(translation.quotient(extent))
        } else {
            rotation
        };
        Self {
            translation: translation.max(rotation * extent),
            rotation: turning,
        }
    }

    /// Those of a state.
    pub(crate) fn at<M: Mechanism>(constants: &M::Constants<S>, state: &M::State<S>) -> Self {
        Self::of::<M>(state, extent::<S, M>(constants, state))
    }

    /// How long a motion of a part of the extent of the mechanism, or of so many radians, takes;
    /// `None` at rest.
    pub(crate) fn time_for(self, part: S) -> Option<S> {
        (self.rotation > S::zero()).then(|| part.quotient(self.rotation))
    }
}

/// How many times what its terms resolve a row can be brought to: the terms of a row are some
/// dozens, and each comes from a few operations that round by half an `EPSILON`.
const REACHED: f64 = 4.0;

/// A movement of less than this part of the shortest length, or of so many radians, changes sizes
/// and compliances by about as much: no more than it matters to either.
const LITTLE: f64 = 1e-4;

impl<S: Real, M: Mechanism> Rows<S, M> {
    /// The rows at a time and configuration.
    ///
    /// The length of a row is the longest arm of its joint, from a centre of mass to the point of
    /// the joint there; where all vanish, the extent of the mechanism. A row that is not linear in
    /// the positions has a radius of curvature, which takes the place of a longer arm: for the
    /// distance of two points this distance.
    pub(crate) fn at(constants: &M::Constants<S>, time: S, state: &M::State<S>) -> Self {
        let zeros = M::Multipliers::<S>::zeros;
        let mut rows = Self {
            translation: zeros(),
            rotation: zeros(),
            length: zeros(),
            distance: zeros(),
            counted: counted::<S, M>(constants, time, state),
            drift: if const { M::REPORT.time.constraints } {
                M::constraint_rates(constants, time, &moving::<S, M>(state, |_| S::zero()))
            } else {
                zeros()
            },
            stiffness: zeros(),
            extent: extent::<S, M>(constants, state),
            time,
        };
        rows.take_jacobian(constants, state);
        rows.take_joints(constants, state);
        // What is known to be absent is not compiled.
        if const { M::REPORT.curved } {
            rows.take_curvature(constants, state);
        }
        rows
    }

    /// Norms of the rows of `D`, body by body, and their stiffness.
    fn take_jacobian(&mut self, constants: &M::Constants<S>, state: &M::State<S>) {
        let jacobian = M::jacobian(constants, self.time, state);
        take_norms(
            jacobian.as_slice(),
            self.translation.as_mut_slice(),
            self.rotation.as_mut_slice(),
            M::REPORT.blocks,
        );
        self.stiffness = stiffness::<S, M>(&jacobian, &yields::<S, M>(constants), M::REPORT.blocks);
    }

    /// Whether a movement is so small that the rows are as good as those of the state that is
    /// reached.
    pub(crate) fn are_kept_by(&self, step: &M::Velocities<S>) -> bool {
        let angle = S::constant(LITTLE);
        let lengths = self.length.as_slice().iter().copied();
        let length = angle * lengths.fold(self.extent, S::min);
        let within = |first: usize, limit: S| {
            let elements = step.as_slice().iter().skip(first).take(3);
            elements.into_iter().all(|x| x.abs() <= limit)
        };
        M::REPORT.bodies.iter().all(|body| {
            within(body.velocity, length)
                && (body.kind == BodyKind::Particle || within(body.velocity + 3, angle))
        })
    }

    /// Arms of the joints, and how far from the origin they are.
    fn take_joints(&mut self, constants: &M::Constants<S>, state: &M::State<S>) {
        let short = self.extent * S::EPSILON.sqrt();
        for (index, joint) in M::REPORT.joints.iter().enumerate() {
            let (mut arm, mut distance) = (S::zero(), S::zero());
            for (place, body) in joint.bodies.iter().enumerate() {
                let point = norm(&M::joint_point(constants, index, place));
                match body {
                    Some(body) => {
                        arm = arm.max(point);
                        distance = distance.max(norm(&centre::<S, M>(state, *body)) + point);
                    }
                    None => distance = distance.max(point),
                }
            }
            let length = if arm > short { arm } else { self.extent };
            // A mechanism that is one point only has no other length than its place.
            let length = if length > S::zero() { length } else { distance };
            let lengths = self.length.as_mut_slice().iter_mut();
            let distances = self.distance.as_mut_slice().iter_mut();
            let rows = lengths.zip(distances).skip(joint.row).take(joint.rows);
            rows.for_each(|row| (*row.0, *row.1) = (length, distance));
        }
    }

    /// Radii of curvature, from what `gamma` is for velocities without rotation.
    fn take_curvature(&mut self, constants: &M::Constants<S>, state: &M::State<S>) {
        let short = self.extent * S::EPSILON.sqrt();
        let gamma = |speed: &dyn Fn(usize) -> S| {
            M::gamma(constants, self.time, &moving::<S, M>(state, speed))
        };
        let (rest, motion) = (gamma(&|_| S::zero()), gamma(&fraction));
        let second = motion.as_slice().iter().zip(rest.as_slice());
        let lengths = self.length.as_mut_slice().iter_mut();
        let rows = lengths.zip(self.translation.as_slice()).zip(second);
        for ((length, &translation), (&motion, &rest)) in rows {
            let curvature = (motion - rest).abs();
            // Never beyond what a mechanism of this extent resolves.
            if curvature * *length > translation {
                *length = length.min(translation.quotient(curvature).max(short));
            }
        }
    }

    /// The sizes of `Phi`.
    pub(crate) fn positions(&self) -> Sizes<S, M> {
        self.sizes(|row| {
            let Row {
                translation,
                rotation,
                length,
                distance,
                counted,
                drift,
            } = row;
            let natural = (translation * length).max(rotation);
            let terms = translation * (distance + length) + rotation;
            Size {
                natural,
                terms: terms + counted + drift * self.time.abs(),
                whole: natural,
            }
        })
    }

    /// The sizes of `Phi'`. The speeds are those of the bodies of a row; round-off comes from all
    /// that stand in one system with it.
    pub(crate) fn velocities(&self, state: &M::State<S>, before: Speeds<S>) -> Sizes<S, M> {
        let own = self.own_speeds(state);
        let all = self.speeds(state);
        let (fastest, turning) = (
            all.translation.max(before.translation),
            all.rotation.max(before.rotation),
        );
        let mut own = own.as_slice().iter();
        let sizes = self.sizes(|row| {
            let own = own.next().copied().unwrap_or(S::zero());
            // The digits of places that an entry of `D` lacks.
            let lost = if row.length > S::zero() {
                S::one() + row.distance.quotient(row.length)
            } else {
                S::one()
            };
            let terms = row.translation * fastest + row.rotation * turning;
            Size {
                natural: own + row.drift,
                terms: terms * lost + row.drift,
                whole: terms + row.drift,
            }
        });
        Sizes {
            vanishing: self.rates(S::smallest().sqrt().quotient(S::EPSILON)),
            ..sizes
        }
    }

    /// What a speed (m/s) of a body, or as many rad/s, makes of each row.
    fn rates(&self, speed: S) -> M::Multipliers<S> {
        let mut rates = self.translation;
        let rows = rates.as_mut_slice().iter_mut();
        rows.zip(self.rotation.as_slice())
            .for_each(|(rate, &rotation)| *rate = speed * rate.max(rotation));
        rates
    }

    fn sizes(&self, mut size: impl FnMut(Row<S>) -> Size<S>) -> Sizes<S, M> {
        let mut sizes: Sizes<S, M> = Sizes {
            natural: M::Multipliers::<S>::zeros(),
            resolution: M::Multipliers::<S>::zeros(),
            whole: M::Multipliers::<S>::zeros(),
            vanishing: M::Multipliers::<S>::zeros(),
        };
        let rows = sizes.natural.as_mut_slice().iter_mut();
        let rows = rows.zip(sizes.resolution.as_mut_slice());
        let rows = rows.zip(sizes.whole.as_mut_slice());
        for (place, ((natural, resolution), whole)) in rows.enumerate() {
            let at = |values: &M::Multipliers<S>| {
                let value = values.as_slice().get(place).copied();
                value.unwrap_or(S::zero())
            };
            let size = size(Row {
                translation: at(&self.translation),
                rotation: at(&self.rotation),
                length: at(&self.length),
                distance: at(&self.distance),
                counted: at(&self.counted),
                drift: at(&self.drift).abs(),
            });
            (*natural, *resolution) = (size.natural, S::EPSILON * size.terms);
            *whole = size.whole;
        }
        sizes
    }

    /// The largest speeds of a state.
    pub(crate) fn speeds(&self, state: &M::State<S>) -> Speeds<S> {
        Speeds::of::<M>(state, self.extent)
    }

    /// The norm of a violation in the metric of the mass, row by row: what a correction lessens,
    /// also where it cannot take the whole violation away. What the terms of a row do not resolve
    /// does not count.
    pub(crate) fn norm(&self, sizes: &Sizes<S, M>, violation: &M::Multipliers<S>) -> S {
        let rows = sizes.rows(violation).zip(self.stiffness.as_slice());
        let sum = rows.fold(
            S::zero(),
            |sum, ((violation, _, resolution, _), &stiffness)| {
                let counts = violation - S::constant(REACHED) * resolution;
                let counts = counts.max(S::zero());
                counts.fused(counts.quotient(felt(stiffness)), sum)
            },
        );
        sum.sqrt()
    }

    /// For each row, the most that the velocities of one of its bodies add to it.
    fn own_speeds(&self, state: &M::State<S>) -> M::Multipliers<S> {
        let velocities = state.velocities().as_slice();
        let mut own = M::Multipliers::<S>::zeros();
        for block in M::REPORT.blocks {
            let translation = norm(&read::<S, 3>(velocities, block.column));
            let rotation = match block.columns {
                6 => norm(&read::<S, 3>(velocities, block.column + 3)),
                _ => S::zero(),
            };
            let parts = self.translation.as_slice().iter();
            let parts = parts.zip(self.rotation.as_slice()).skip(block.row);
            let rows = own.as_mut_slice().iter_mut().skip(block.row);
            for (own, (&force, &moment)) in rows.zip(parts).take(block.rows) {
                *own = own.max(force * translation + moment * rotation);
            }
        }
        own
    }

    /// Multipliers in proportion to those that a correction leaves with a violation: its
    /// compliances are as the stiffnesses.
    pub(crate) fn multipliers(&self, violation: &M::Multipliers<S>) -> M::Multipliers<S> {
        let mut multipliers = *violation;
        let rows = multipliers.as_mut_slice().iter_mut();
        rows.zip(self.stiffness.as_slice())
            .for_each(|(row, &stiffness)| *row = row.quotient(felt(stiffness)));
        multipliers
    }

    /// The square of what one metre is in the unit of each row, by the largest part of its
    /// gradient: 1 for most, `(2 l)^2` for the difference of squares of a length `l`, and
    /// `1 / radian^2` for a row of rotations alone, whose radian counts as so many metres. A row
    /// that vanishes counts as it is.
    pub(crate) fn units(&self, radian: S) -> M::Multipliers<S> {
        let mut units = M::Multipliers::<S>::zeros();
        let elements = units.as_mut_slice().iter_mut().zip(self.row_units());
        elements.for_each(|(unit, (size, is_length))| {
            let metre = if is_length {
                size
            } else {
                size.quotient(radian)
            };
            *unit = metre * metre;
        });
        evened::<S, M>(&mut units);
        units
    }

    /// What one metre or one radian is in the unit of each row, and whether it is metres that the
    /// row speaks of.
    pub(crate) fn row_units(&self) -> impl Iterator<Item = (S, bool)> + '_ {
        let parts = self.translation.as_slice().iter();
        let parts = parts
            .zip(self.rotation.as_slice())
            .zip(self.length.as_slice());
        parts.map(|((&translation, &rotation), &length)| {
            // A row of translations alone may have no length to go by.
            let is_length = translation * length > S::EPSILON.sqrt() * rotation
                || (translation > S::zero() && rotation == S::zero());
            let part = if is_length { translation } else { rotation };
            let size = if part > S::zero() { part } else { S::one() };
            (size, is_length)
        })
    }

    /// The shortest length (m) of the rows that act on a body; `None` without rows.
    pub(crate) fn length_of(&self, body: usize) -> Option<S> {
        let own = M::REPORT.blocks.iter().filter(|block| block.body == body);
        let lengths = own.flat_map(|block| {
            let lengths = self.length.as_slice().iter();
            lengths.skip(block.row).take(block.rows).copied()
        });
        lengths.filter(|&length| length > S::zero()).reduce(S::min)
    }

    /// The least mass (kg) that a row feels, where a radian counts as so many metres; `None`
    /// without rows.
    pub(crate) fn lightest(&self, radian: S) -> Option<S> {
        let units = self.units(radian);
        let rows = units.as_slice().iter().zip(self.stiffness.as_slice());
        let rows = rows.filter(|&(_, &stiffness)| stiffness > S::zero());
        let masses = rows.map(|(&unit, &stiffness)| unit.quotient(stiffness));
        masses.reduce(S::min)
    }

    /// The largest of the rates (1/s) at which laws of time move a row, over the size of its joint.
    pub(crate) fn driven(&self) -> S {
        let sizes = self.positions();
        let rates = sizes.rows(&self.drift).map(|(drift, natural, ..)| {
            if drift == S::zero() {
                drift
            } else {
                drift.quotient(natural)
            }
        });
        rates.fold(S::zero(), S::max)
    }

    /// What each row yields to a unit load by the body of it that yields least.
    pub(crate) fn yields_of_heaviest(
        &self,
        constants: &M::Constants<S>,
        state: &M::State<S>,
    ) -> M::Multipliers<S> {
        let jacobian = M::jacobian(constants, self.time, state);
        let yields = yields::<S, M>(constants);
        let mut least = self.stiffness;
        for block in M::REPORT.blocks {
            let own = stiffness::<S, M>(&jacobian, &yields, core::slice::from_ref(block));
            let rows = least.as_mut_slice().iter_mut().zip(own.as_slice());
            rows.filter(|(_, own)| **own > S::zero())
                .for_each(|(least, &own)| *least = least.min(own));
        }
        least
    }

    /// Compliances of the rows: a part of what each yields to a unit load; any positive number for
    /// a row that vanishes.
    pub(crate) fn compliances(&self, part: S) -> M::Multipliers<S> {
        compliances::<S, M>(self.stiffness, part)
    }
}

/// The norms of the rows of `D` by translation and by rotation, of the body where they are largest.
fn take_norms<S: Real>(
    jacobian: &[S],
    translations: &mut [S],
    rotations: &mut [S],
    blocks: &[Block],
) {
    for block in blocks {
        let values = jacobian.get(block.offset..).unwrap_or(&[]);
        let rows = translations.iter_mut().zip(rotations.iter_mut());
        let rows = rows.skip(block.row).take(block.rows);
        for ((translation, rotation), row) in rows.zip(values.chunks(block.columns.max(1))) {
            let (force, moment) = row.split_at_checked(3).unwrap_or((row, &[]));
            *translation = translation.max(norm(force));
            *rotation = rotation.max(norm(moment));
        }
    }
}

/// One row of [`Rows`].
struct Row<S> {
    translation: S,
    rotation: S,
    length: S,
    distance: S,
    counted: S,
    drift: S,
}

/// What counted turns add to the terms of the rows that they stand in: found by one more turn of
/// each counter that is beyond a radian.
fn counted<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
) -> M::Multipliers<S> {
    let mut counted = M::Multipliers::<S>::zeros();
    let first = M::REPORT.coordinates;
    let turn = S::constant(core::f64::consts::TAU);
    for place in first..first + M::REPORT.auxiliaries {
        let Some(&angle) = state.coordinates().as_slice().get(place) else {
            break;
        };
        // A smaller angle is no larger a term than the gradient of the row.
        if angle.abs() <= S::one() {
            continue;
        }
        let mut turned = *state;
        let counters = turned.coordinates_mut().as_mut_slice();
        counters
            .iter_mut()
            .skip(place)
            .take(1)
            .for_each(|counter| *counter = angle + turn);
        let (now, then) = (
            M::constraints(constants, time, state),
            M::constraints(constants, time, &turned),
        );
        let pairs = now.as_slice().iter().zip(then.as_slice());
        for (counted, (&now, &then)) in counted.as_mut_slice().iter_mut().zip(pairs) {
            *counted = ((then - now).quotient(turn) * angle).abs().max(*counted);
        }
    }
    counted
}

/// The state with other velocities: translations at some speed by their place, no rotation.
pub(crate) fn moving<S: Scalar, M: Mechanism>(
    state: &M::State<S>,
    speed: impl Fn(usize) -> S,
) -> M::State<S> {
    let mut moving = M::State::from_parts(*state.coordinates(), Array::zeros());
    let velocities = moving.velocities_mut().as_mut_slice();
    for body in M::REPORT.bodies {
        let place = body.velocity;
        let speeds = [speed(place), speed(place + 1), speed(place + 2)];
        write(velocities, place, speeds);
    }
    moving
}

/// Components that no mechanism is made of, from -1/2 to 1/2: the fractions of multiples of the
/// golden section.
pub(crate) fn fraction<S: Scalar>(place: usize) -> S {
    S::constant((place + 1) as f64 * 0.618_033_988_749_895 % 1.0 - 0.5)
}
