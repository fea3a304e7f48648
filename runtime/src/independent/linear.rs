//! Linearisation about a state, by numbers that carry derivatives: exact to round-off.

use nalgebra::SMatrix;

use super::elimination::{at, set};
use super::equations::solve;
use super::linearised::Linearised;
use super::partition::{Partition, joint_rates};
use super::points::moved;
use super::states::{put_velocities, write_rates};
use super::varied::Adjusted;
use super::{Equations, IndependentCoordinates};
use crate::error::{Fault, NotFinite};
use crate::forward::{Forward, Lifted, lifted};
use crate::math::quaternion::product;
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{cross, read};
use crate::measure::view::View;
use crate::mechanism::handle::ValueHandle;
use crate::mechanism::joint_kernels::Freedom;
use crate::mechanism::joint_rates::{HasInverse, HasMassMatrix, JointRates};
use crate::mechanism::relative::{bodies_by, bodies_of};
use crate::state::vector::{Array, StateParts};

/// The directions that one evaluation takes, as many as [`Lifted`] numbers have.
const LANES: usize = 4;

/// Accelerations and readings along directions.
type Along<S, const N: usize, const P: usize> = ([Lifted<S>; N], [Lifted<S>; P]);

/// What changes in one direction.
#[derive(Clone, Copy)]
enum Direction {
    Position(usize),
    Rate(usize),
    Value(usize),
}

/// What changes.
#[derive(Clone, Copy)]
enum Outcome {
    Accelerations,
    Efforts,
}

impl<M, const N: usize, S> IndependentCoordinates<M, N, S>
where
    M: HasInverse + HasMassMatrix,
    S: Real,
{
    /// The equations of motion and some readings, linear about a state, which may move: how
    /// accelerations and readings change with coordinates, rates and the `values`, parameters or
    /// inputs by handle. No efforts act but the described forces.
    ///
    /// `read` takes what is wanted from a view, over numbers that carry derivatives; `|_| []` where
    /// nothing is. Where a parameter changes a closed loop, the coordinates that are not chosen
    /// follow.
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// use holonom::nalgebra::Matrix4;
    ///
    /// /// A pendulum on a cart that a force pushes.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, inverse])]
    /// struct Crane {
    ///     #[input]
    ///     push: f64,
    ///     #[body(mass = 2.0, inertia = [1.0, 1.0, 1.0], position = [0.0, 0.0, 0.0])]
    ///     cart: Body,
    ///     #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, -0.5])]
    ///     load: Body,
    ///     #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    ///     rail: Prismatic,
    ///     #[joint(between = [cart, load], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    ///     hinge: Revolute,
    ///     #[force(between = [ground, cart], point = [0.0, 0.0, 0.0], force = [push, 0.0, 0.0])]
    ///     motor: PointForce,
    /// }
    ///
    /// let (crane, h) = (Crane::default(), Crane::HANDLES);
    /// let space = crane.coordinates((h.rail, h.hinge))?;
    /// let rest = space.state([0.0, 0.0], [0.0, 0.0])?;
    /// let linear = space.linearise(&rest, [h.push], |view| [view.position(h.load).x])?;
    /// let a: Matrix4<f64> = linear.a(); // of [displacement, angle, their rates]
    /// // The load swings: (m_c + m) (J + m l^2) - (m l)^2 over what gravity does.
    /// assert!((a[(3, 1)] + 3.0 * 0.5 * 9.81 / (3.0 * 0.35 - 0.25)).abs() < 1e-12);
    /// // It is on the other side of its hinge.
    /// assert!((linear.c::<4>()[(0, 1)] + 0.5).abs() < 1e-12);
    /// # Ok::<(), Fault>(())
    /// ```
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`]; [`Fault::RatesNotFinite`] where there is no derivative.
    pub fn linearise<const K: usize, const P: usize>(
        &self,
        state: &M::JointState<S>,
        values: [ValueHandle<M>; K],
        read: impl Fn(&View<'_, Lifted<S>, M>) -> [Lifted<S>; P],
    ) -> Result<Linearised<N, K, P, S>, Fault> {
        self.linearise_by(state, &values.map(|of| Adjusted::Value(of.index())), read)
    }

    /// The same by parameters, inputs and rates.
    pub(super) fn linearise_by<const K: usize, const P: usize>(
        &self,
        state: &M::JointState<S>,
        values: &[Adjusted; K],
        read: impl Fn(&View<'_, Lifted<S>, M>) -> [Lifted<S>; P],
    ) -> Result<Linearised<N, K, P, S>, Fault> {
        self.slopes(state, values, Outcome::Accelerations, read)
    }

    /// How the efforts that are not balanced, `-h`, change with coordinates, rates and quantities,
    /// in the place of accelerations.
    pub(super) fn efforts_by<const K: usize>(
        &self,
        state: &M::JointState<S>,
        values: &[Adjusted; K],
    ) -> Result<Linearised<N, K, 0, S>, Fault> {
        self.slopes(state, values, Outcome::Efforts, |_| [])
    }

    fn slopes<const K: usize, const P: usize>(
        &self,
        state: &M::JointState<S>,
        values: &[Adjusted; K],
        outcome: Outcome,
        read: impl Fn(&View<'_, Lifted<S>, M>) -> [Lifted<S>; P],
    ) -> Result<Linearised<N, K, P, S>, Fault> {
        let mut linear = Linearised::<N, K, P, S>::zeros();
        let partition = self.equations.partition(state)?;
        let rates = joint_rates::<M, S>(state);
        linear.rates_by_positions = SMatrix::from_fn(|row, column| {
            let place = self.equations.places.get(row).copied().unwrap_or(0);
            let column = partition.columns.get(column);
            column.map_or(S::zero(), |column| turned::<M, S>(place, &rates, column))
        });
        let positions = (0..N).map(Direction::Position);
        let directions = positions.chain((0..N).map(Direction::Rate));
        let mut directions = directions.chain((0..K).map(Direction::Value));
        loop {
            let lanes: [Option<Direction>; LANES] = core::array::from_fn(|_| directions.next());
            let [Some(_), ..] = lanes else { break };
            let (accelerations, readings) =
                self.along(state, &partition, &lanes, (values, outcome), &read)?;
            for (lane, direction) in lanes.into_iter().flatten().enumerate() {
                let slope = |number: &Lifted<S>| {
                    number.derivatives().get(lane).copied().unwrap_or(S::zero())
                };
                let accelerations = accelerations.each_ref().map(slope);
                let readings = readings.each_ref().map(slope);
                match direction {
                    Direction::Position(column) => {
                        put(&mut linear.by_positions, column, accelerations);
                        put(&mut linear.readings_by_positions, column, readings);
                    }
                    Direction::Rate(column) => {
                        put(&mut linear.by_rates, column, accelerations);
                        put(&mut linear.readings_by_rates, column, readings);
                    }
                    Direction::Value(column) => {
                        put(&mut linear.by_values, column, accelerations);
                        put(&mut linear.readings_by_values, column, readings);
                    }
                }
            }
        }
        let mass = self.equations.mass(state)?;
        for column in 0..N {
            let unit = core::array::from_fn(|row| S::constant(f64::from(u8::from(row == column))));
            let accelerations = solve(mass, unit);
            put(&mut linear.by_efforts, column, accelerations);
        }
        if linear.is_finite() {
            Ok(linear)
        } else {
            Err(Fault::RatesNotFinite {
                origin: NotFinite::Unknown,
            })
        }
    }

    /// Accelerations and readings along some directions.
    fn along<const K: usize, const P: usize>(
        &self,
        state: &M::JointState<S>,
        partition: &Partition<M, N, S>,
        lanes: &[Option<Direction>; LANES],
        (values, outcome): (&[Adjusted; K], Outcome),
        read: &impl Fn(&View<'_, Lifted<S>, M>) -> [Lifted<S>; P],
    ) -> Result<Along<S, N, P>, Fault> {
        let mut equations = self.equations.lifted::<LANES>();
        let mut constants: M::Constants<Lifted<S>> = lifted(&self.constants);
        let mut parameters: M::Parameters<Lifted<S>> = lifted(&self.parameters);
        let mut ways = [M::JointVelocities::<S>::zeros(); LANES];
        let rates: [S; N] = self.rates(state).into();
        let mut rates_along = rates.map(Forward::fixed);
        let mut is_varied = false;
        for (lane, direction) in lanes.iter().enumerate() {
            match *direction {
                Some(Direction::Position(column)) => {
                    let way = partition.columns.get(column);
                    if let (Some(place), Some(way)) = (ways.get_mut(lane), way) {
                        *place = *way;
                    }
                }
                Some(Direction::Rate(column)) => vary(rates_along.get_mut(column), lane),
                Some(Direction::Value(number)) => match values.get(number) {
                    Some(&Adjusted::Value(place)) => {
                        is_varied = true;
                        vary(parameters.as_mut_slice().get_mut(place), lane);
                    }
                    Some(&Adjusted::Rate(column)) => vary(rates_along.get_mut(column), lane),
                    None => {}
                },
                None => {}
            }
        }
        let here = |ways: &[M::JointVelocities<S>; LANES]| {
            let slopes = ways.map(|way| {
                let mut turned = *state;
                put_velocities::<M, S>(&way, &mut turned);
                M::joint_coordinate_rates(&self.equations.constants, self.equations.time, &turned)
            });
            moved::<M, S, LANES>(state, &slopes)
        };
        if is_varied {
            constants = M::prepare(&parameters);
            equations.constants = M::prepare_joints(&parameters);
            // What closes a loop again that a parameter opens.
            let closing = equations.partition(&here(&ways))?.closing;
            for (place, number) in closing.as_slice().iter().enumerate() {
                for (way, slope) in ways.iter_mut().zip(number.derivatives()) {
                    let known = at(way.as_slice(), place);
                    set(way, place, known + slope);
                }
            }
        }
        let mut there = here(&ways);
        let dependent = equations.partition(&there)?;
        write_rates::<M, N, Lifted<S>>(&dependent, &rates_along, true, &mut there);
        let none = [Forward::zero(); N];
        let accelerations = match outcome {
            Outcome::Accelerations => equations.forward(&there, &none)?,
            Outcome::Efforts => equations.inverse(&there, &none)?.map(|effort| -effort),
        };
        let bodies = self.bodies_along(&equations, state, &there);
        let view = View::new(&constants, equations.time, &bodies);
        Ok((accelerations, read(&view)))
    }

    /// The bodies of a state along directions.
    fn bodies_along(
        &self,
        equations: &Equations<M, N, Lifted<S>>,
        here: &M::JointState<S>,
        there: &M::JointState<Lifted<S>>,
    ) -> M::State<Lifted<S>> {
        let known = bodies_of::<S, M>(&self.equations.constants, here);
        let motions = M::body_motions(&equations.constants, there);
        bodies_by::<Lifted<S>, M>(&motions, |body, rows| {
            let info = M::REPORT.bodies.get(body);
            let place = info.map_or(usize::MAX, |info| info.coordinate.saturating_add(3));
            orientation_along(&read(known.coordinates().as_slice(), place), rows)
        })
    }
}

/// Lets a number vary along a direction, beside those along which it does.
fn vary<S: Scalar>(number: Option<&mut Lifted<S>>, lane: usize) {
    let Some(number) = number else { return };
    let mut slopes = number.derivatives();
    if let Some(slope) = slopes.get_mut(lane) {
        *slope = *slope + S::one();
    }
    *number = Forward::new(number.value(), slopes);
}

/// Writes a column, without a place where it could panic.
fn put<S, const R: usize, const C: usize>(
    matrix: &mut SMatrix<S, R, C>,
    column: usize,
    values: [S; R],
) {
    for (row, value) in values.into_iter().enumerate() {
        if let Some(entry) = matrix.get_mut((row, column)) {
            *entry = value;
        }
    }
}

/// Euler parameters along directions, by those and the rotation matrix: with `R' = R w~` the rate
/// of `p` is `p (0, w) / 2`.
fn orientation_along<S: Scalar>(p: &[S; 4], rows: &[[Lifted<S>; 3]; 3]) -> [Lifted<S>; 4] {
    let mut slopes = [[S::zero(); LANES]; 4];
    for lane in 0..LANES {
        let slope = |number: &Lifted<S>| number.derivatives().get(lane).copied();
        // `(R^T R')` of row `k` and column `l`.
        let entry = |k: usize, l: usize| {
            rows.iter().fold(S::zero(), |sum, row| {
                let (value, slope) = (row.get(k).map(Forward::value), row.get(l).and_then(slope));
                value.zip(slope).map_or(sum, |(a, b)| a.fused(b, sum))
            })
        };
        let half = S::constant(0.5);
        let w = [(2, 1), (0, 2), (1, 0)].map(|(k, l)| half * entry(k, l));
        let [x, y, z] = w;
        let rate = product(p, &[S::zero(), x, y, z]);
        for (slopes, rate) in slopes.iter_mut().zip(rate) {
            if let Some(place) = slopes.get_mut(lane) {
                *place = rate;
            }
        }
    }
    let mut found = p.map(Forward::fixed);
    for (number, slopes) in found.iter_mut().zip(slopes) {
        *number = Forward::new(number.value(), slopes);
    }
    found
}

/// What a rotation at these rates does to the rate of a turn along a ball's axes, which is that of
/// no coordinate: `-w x` the turn. Zero of other rates.
fn turned<M: JointRates, S: Scalar>(
    place: usize,
    rates: &M::JointVelocities<S>,
    turn: &M::JointVelocities<S>,
) -> S {
    let motion = M::JOINT_REPORT.motion_of_rate(place);
    let Some((_, ball)) = motion.filter(|(_, motion)| motion.freedom == Freedom::Ball) else {
        return S::zero();
    };
    let [w, turn]: [[S; 3]; 2] = [rates, turn].map(|rates| read(rates.as_slice(), ball.velocity));
    let [x, y, z] = cross(&turn, &w);
    match place - ball.velocity {
        0 => x,
        1 => y,
        _ => z,
    }
}
