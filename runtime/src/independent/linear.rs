//! Linearisation about a state, by numbers that carry derivatives: exact to round-off.

use core::array::from_fn;

use nalgebra::SMatrix;

use super::IndependentCoordinates;
use super::derived::Derived;
use super::determined::Needs;
use super::directions::{Along, vary};
use super::elimination::at;
use super::equations::{Factors, not_finite};
use super::linearised::Linearised;
use super::partition::{Partition, joint_rates};
use super::readings::Moving;
use super::varied::Adjusted;
use crate::error::{Fault, LeavesOut};
use crate::forward::{Forward, Lifted, lifted};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{cross, read};
use crate::measure::view::View;
use crate::mechanism::handle::ValueHandle;
use crate::mechanism::joint_kernels::Freedom;
use crate::mechanism::joint_rates::{HasInverse, HasMassMatrix, JointRates};
use crate::mechanism::kernels::bodies_alone;
use crate::state::vector::{Array, StateParts, Vector as _};

/// The directions that one evaluation takes, as many as [`Lifted`] numbers have.
const LANES: usize = 4;

/// What changes.
#[derive(Clone, Copy)]
enum Outcome {
    /// Without efforts.
    Accelerations,
    /// Those that are not balanced, `-h`, without accelerations.
    Efforts,
}

/// Which columns a direction belongs to.
#[derive(Clone, Copy)]
enum Part {
    Positions,
    Rates,
    Values,
}

/// A column of a part, and the direction that it belongs to.
type Column = (Part, usize, Along);

/// The columns of coordinates and of their rates.
fn coordinates<const N: usize>() -> impl Iterator<Item = Column> {
    let positions = (0..N).map(|number| (Part::Positions, number, Along::Position(number)));
    let rates = (0..N).map(|number| (Part::Rates, number, Along::Rate(number)));
    positions.chain(rates)
}

/// Efforts and readings along directions.
type Slopes<S, const N: usize, const P: usize> = ([Lifted<S>; N], [Lifted<S>; P]);

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
    /// As [`IndependentCoordinates::mass`];
    /// [`StepFault::RatesNotFinite`](crate::error::StepFault::RatesNotFinite) where there is no
    /// derivative; [`AnalysisFault::OnSwitch`](crate::error::AnalysisFault::OnSwitch) where a law
    /// switches in this state, and its sides differ. Off its switch a law is that of the side where
    /// it is.
    pub fn linearise<const K: usize, const P: usize>(
        &self,
        state: &M::JointState<S>,
        values: [ValueHandle<M>; K],
        read: impl Fn(&View<'_, Lifted<S>, M>) -> [Lifted<S>; P],
    ) -> Result<Linearised<N, K, P, S>, Fault> {
        let values = values.map(|value| Adjusted::Value(value.index()));
        self.off_bends(state, &values)?;
        self.slopes(state, &values, Outcome::Accelerations, read)
    }

    /// The same by parameters, inputs and rates.
    pub(super) fn linearise_by<const K: usize>(
        &self,
        state: &M::JointState<S>,
        values: &[Adjusted; K],
    ) -> Result<Linearised<N, K, 0, S>, Fault> {
        self.slopes(state, values, Outcome::Accelerations, |_| [])
    }

    /// How the efforts that are not balanced, `-h`, change with coordinates, rates and quantities,
    /// in the place of accelerations. The inverse of the mass matrix is left at zero.
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
        bodies_alone::<M>(LeavesOut::Linearisation)?;
        let mut linear = Linearised::<N, K, P, S>::zeros();
        let derived = match outcome {
            Outcome::Accelerations => Derived::of(&self.equations, state),
            Outcome::Efforts => None,
        };
        let is_known = |along| matches!(&derived, Some(derived) if derived.has(along));
        let mut missing = values.iter().filter(|&&value| !is_known(value.into()));
        let is_complete = derived.is_some() && missing.next().is_none();
        let is_tree = M::JOINT_REPORT.closing.is_empty();
        let mut motions = M::JOINT_REPORT.motions.iter();
        let has_balls = motions.any(|motion| motion.freedom == Freedom::Ball);
        if let Some(derived) = derived.as_ref().filter(|_| is_tree) {
            derived.write(values, None, &mut linear);
            if P == 0 && is_complete && !has_balls {
                return finite(linear);
            }
        }
        let partition = self.known(state, Needs::Derivatives)?;
        if has_balls {
            linear.rates_by_positions = self.turned_rates(state, &partition);
        }
        // With `M a = -h`, `M da = -(d(M) a + dh)`: what changes the efforts of these
        // accelerations.
        let equations = &self.equations;
        let following = (!is_tree).then_some(&partition);
        if let Some(derived) = derived.as_ref().filter(|_| !is_tree) {
            derived.write(values, following, &mut linear);
        }
        let mut accelerations = [S::zero(); N];
        let mass = match outcome {
            Outcome::Accelerations if !is_complete => {
                let bias = equations.inverse_with(following, state, &accelerations);
                let mass = Factors::of(equations.mass_with(following, state));
                accelerations = mass.solve(bias.map(|bias| -bias));
                Some(mass)
            }
            _ => None,
        };
        let constants = lifted(&self.constants);
        if let Some(derived) = derived.as_ref().filter(|_| P > 0) {
            let moving = Moving::new(self, state, derived, following);
            self.read_along_coordinates(&moving, &constants, &read, &mut linear);
        }
        let values = values.iter().enumerate();
        let values = values.map(|(number, &value)| (Part::Values, number, value.into()));
        let has_readings = |part| P == 0 || derived.is_some() && !matches!(part, Part::Values);
        let columns = coordinates::<N>().chain(values);
        let mut columns =
            columns.filter(|&(part, _, along)| !has_readings(part) || !is_known(along));
        loop {
            let columns: [_; LANES] = from_fn(|_| columns.next());
            let [Some(_), ..] = columns else { break };
            let directions = columns.map(|column| column.map(|(.., direction)| direction));
            let moving = (state, &accelerations);
            let mut directed = directions.iter().flatten();
            let wanted = directed.any(|&along| !is_known(along)).then_some(outcome);
            let (efforts, readings) = self.along(
                moving,
                (&partition, &constants),
                (&directions, wanted),
                &read,
            )?;
            let mut outcomes = efforts.map(|effort| effort.derivatives().map(|slope| -slope));
            if let Some(mass) = &mass {
                mass.solve_each(&mut outcomes);
            }
            if P > 0 {
                linear.put_readings(&columns, &readings);
            }
            for (lane, (part, column, along)) in columns.into_iter().flatten().enumerate() {
                if is_known(along) {
                    continue;
                }
                match part {
                    Part::Positions => put(&mut linear.by_positions, column, &outcomes, lane),
                    Part::Rates => put(&mut linear.by_rates, column, &outcomes, lane),
                    Part::Values => put(&mut linear.by_values, column, &outcomes, lane),
                }
            }
        }
        if let (Some(mass), None) = (&mass, &derived) {
            let one = |row: usize, column: usize| S::constant(f64::from(u8::from(row == column)));
            let mut inverse = from_fn(|row| from_fn(|column| one(row, column)));
            mass.solve_each::<N>(&mut inverse);
            for column in 0..N {
                put(&mut linear.by_efforts, column, &inverse, column);
            }
        }
        finite(linear)
    }

    /// Readings along coordinates and rates, with the motions of the bodies by the kernel.
    fn read_along_coordinates<const K: usize, const P: usize>(
        &self,
        moving: &Moving<'_, M, N, S>,
        constants: &M::Constants<Lifted<S>>,
        read: impl Fn(&View<'_, Lifted<S>, M>) -> [Lifted<S>; P],
        linear: &mut Linearised<N, K, P, S>,
    ) {
        let time = Forward::fixed(self.equations.time);
        let mut columns = coordinates::<N>();
        loop {
            let columns: [_; LANES] = from_fn(|_| columns.next());
            let [Some(_), ..] = columns else { break };
            let directions = columns.map(|column| column.map(|(.., along)| along));
            let bodies = moving.along(&directions);
            let readings = read(&View::new(constants, time, &bodies));
            linear.put_readings(&columns, &readings);
        }
    }

    /// What rates of balls change by with positions, see [`turned`].
    fn turned_rates(
        &self,
        state: &M::JointState<S>,
        partition: &Partition<M, N, S>,
    ) -> SMatrix<S, N, N> {
        let rates = joint_rates::<M, S>(state);
        SMatrix::from_fn(|row, column| {
            let place = self.equations.places.get(row).copied().unwrap_or(0);
            let column = partition.columns.get(column);
            column.map_or(S::zero(), |column| turned::<M, S>(place, &rates, column))
        })
    }

    /// The efforts of accelerations, where they are wanted, and readings, along some directions.
    fn along<const P: usize>(
        &self,
        (state, accelerations): (&M::JointState<S>, &[S; N]),
        (partition, constants): (&Partition<M, N, S>, &M::Constants<Lifted<S>>),
        (directions, wanted): (&[Option<Along>; LANES], Option<Outcome>),
        read: &impl Fn(&View<'_, Lifted<S>, M>) -> [Lifted<S>; P],
    ) -> Result<Slopes<S, N, P>, Fault> {
        let is_still = M::JOINT_REPORT.closing.is_empty() && directions.iter().all(is_input::<M>);
        if wanted.is_none() && is_still {
            return Ok((
                [Forward::zero(); N],
                self.still((state, constants), directions, read),
            ));
        }
        let there = self.state_along(state, partition, directions)?;
        let mut efforts = [Forward::zero(); N];
        if wanted.is_some() {
            let following = there.equations.following(&there.state)?;
            let accelerations = accelerations.map(Forward::fixed);
            let following = following.as_ref();
            efforts = there
                .equations
                .inverse_with(following, &there.state, &accelerations);
        }
        if P == 0 {
            return Ok((efforts, [Forward::zero(); P]));
        }
        let bodies = self.bodies_along(state, &there);
        let time = there.equations.time;
        if there.is_varied {
            let constants = M::prepare(&there.parameters);
            return Ok((efforts, read(&View::new(&constants, time, &bodies))));
        }
        Ok((efforts, read(&View::new(constants, time, &bodies))))
    }

    /// Readings along inputs, which move no body of a tree.
    fn still<const P: usize>(
        &self,
        (state, constants): (&M::JointState<S>, &M::Constants<Lifted<S>>),
        directions: &[Option<Along>; LANES],
        read: &impl Fn(&View<'_, Lifted<S>, M>) -> [Lifted<S>; P],
    ) -> [Lifted<S>; P] {
        let mut parameters: M::Parameters<Lifted<S>> = lifted(&self.parameters);
        for (lane, direction) in directions.iter().enumerate() {
            if let Some(Along::Value(place)) = *direction {
                vary(parameters.as_mut_slice().get_mut(place), lane);
            }
        }
        let mut constants = *constants;
        M::take_inputs(&parameters, &mut constants);
        let bodies = self.bodies(state);
        let mut still = M::State::<Lifted<S>>::from_parts(
            lifted(bodies.coordinates()),
            lifted(bodies.velocities()),
        );
        let counted = still.turns_mut().iter_mut().zip(bodies.turns());
        counted.for_each(|(place, &number)| *place = Forward::fixed(number));
        let time = Forward::fixed(self.equations.time);
        read(&View::new(&constants, time, &still))
    }
}

impl<const N: usize, const K: usize, const P: usize, S: Real> Linearised<N, K, P, S> {
    /// Writes the readings along some directions as their columns.
    fn put_readings(&mut self, columns: &[Option<Column>; LANES], readings: &[Lifted<S>; P]) {
        let readings = readings.map(|reading| reading.derivatives());
        for (lane, column) in columns.iter().enumerate() {
            match *column {
                Some((Part::Positions, column, _)) => {
                    put(&mut self.readings_by_positions, column, &readings, lane);
                }
                Some((Part::Rates, column, _)) => {
                    put(&mut self.readings_by_rates, column, &readings, lane);
                }
                Some((Part::Values, column, _)) => {
                    put(&mut self.readings_by_values, column, &readings, lane);
                }
                None => {}
            }
        }
    }
}

/// Whether a direction is that of an input, or of nothing.
fn is_input<M: JointRates>(direction: &Option<Along>) -> bool {
    match *direction {
        Some(Along::Value(place)) => M::REPORT
            .values
            .get(place)
            .is_some_and(|value| value.is_input),
        Some(_) => false,
        None => true,
    }
}

/// What is finite all over.
fn finite<const N: usize, const K: usize, const P: usize, S: Real>(
    linear: Linearised<N, K, P, S>,
) -> Result<Linearised<N, K, P, S>, Fault> {
    if linear.is_finite() {
        Ok(linear)
    } else {
        Err(not_finite())
    }
}

/// Writes what the rows have in a lane as a column, without a place where it could panic.
pub(super) fn put<S: Scalar, const R: usize, const C: usize, const K: usize>(
    matrix: &mut SMatrix<S, R, C>,
    column: usize,
    rows: &[[S; K]; R],
    lane: usize,
) {
    if let Some(entries) = matrix.as_mut_slice().chunks_mut(R.max(1)).nth(column) {
        for (entry, row) in entries.iter_mut().zip(rows) {
            *entry = at(row, lane);
        }
    }
}

/// What a rotation at these rates does to the rate of a turn along a ball's axes, which is that of
/// no coordinate: `-w x` the turn. Zero of other rates.
pub(super) fn turned<M: JointRates, S: Scalar>(
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
