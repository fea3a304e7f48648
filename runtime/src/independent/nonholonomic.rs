//! Mechanisms with equations of velocities, in chosen coordinates and chosen speeds.
//!
//! There are more coordinates than speeds (Kane and Levinson 1985, chapter 2: generalized
//! coordinates and generalized speeds). Speeds give the rates of all joints by all equations, as in
//! `partition.rs`. Coordinates give displacements of all joints by the equations of positions.

use core::array::from_fn;
use core::fmt;

use nalgebra::{SMatrix, SVector};

use super::choice::{Chosen, distinct};
use super::determined::Needs;
use super::directions::{Along, StateAlong, add, displaced, vary};
use super::equations::finite_matrix;
use super::linear::{put, turned};
use super::partition::{Partition, joint_rates, write_rates};
use super::places::Places;
use super::{Equations, IndependentCoordinates, degrees_of_freedom};
use crate::error::{Fault, LeavesOut, ParameterError};
use crate::forward::{Forward, Lifted, lifted};
use crate::math::scalar::{Real, Scalar};
use crate::math::without_bounds::copied;
use crate::measure::view::View;
use crate::mechanism::handle::ValueHandle;
use crate::mechanism::joint_rates::{HasInverse, HasMassMatrix, JointRates};
use crate::mechanism::kernels::bodies_alone;
use crate::state::vector::Array;

/// The directions that one evaluation takes.
const LANES: usize = 4;

/// Rates of coordinates, those of speeds, and readings along directions.
struct Outcome<N, const Q: usize, const R: usize, const P: usize> {
    moving: [N; Q],
    accelerated: [N; R],
    readings: [N; P],
}

/// The equations of motion of a mechanism with equations of velocities, in `Q` chosen coordinates
/// and `N` chosen speeds, by [`NonholonomicExt::nonholonomic`].
///
/// States come from a run or from bodies ([`NonholonomicCoordinates::of_bodies`]). They have to
/// satisfy the equations.
pub struct NonholonomicCoordinates<M: JointRates, const Q: usize, const N: usize, S: Scalar = f64> {
    speeds: IndependentCoordinates<M, N, S>,
    coordinates: Equations<M, Q, S>,
}

copied! {
    [M: JointRates, const Q: usize, const N: usize, S: Scalar] NonholonomicCoordinates<M, Q, N, S>;
}

impl<M: JointRates, const Q: usize, const N: usize, S: Scalar> fmt::Debug
    for NonholonomicCoordinates<M, Q, N, S>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("NonholonomicCoordinates")
            .field("coordinates", &*self.coordinates.places)
            .field("speeds", &*self.speeds.equations.places)
            .finish_non_exhaustive()
    }
}

/// Coordinates and speeds by handle, by a method of the mechanism.
pub trait NonholonomicExt: JointRates {
    /// The equations of motion in these coordinates and speeds, at time zero.
    ///
    /// Handles stand for motions as in
    /// [`coordinates`](super::IndependentExt::coordinates). There are as many speeds as degrees of
    /// freedom ([`Report::degrees_of_freedom`](crate::Report)), and as many more coordinates as
    /// there are equations of velocities.
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// use holonom::independent::NonholonomicExt;
    ///
    /// holonom::joint! {
    ///     /// Stays in the plane, and stands on an edge that does not move sideways.
    ///     joint Runner(i, j; point: Point, normal: Axis, side: Axis) {
    ///         dot(i.normal.normals(), j.normal);
    ///         dot(i.normal, j.point - i.point);
    ///         dot(j.side, rate(j.point));
    ///     }
    /// }
    ///
    /// /// Chaplygin's sleigh: its edge stands 0.3 m behind the centre of mass.
    /// #[derive(Mechanism)]
    /// #[mechanism(coordinates = "joints", kernels = [mass, inverse])]
    /// struct Sleigh {
    ///     #[body(mass = 2.0, inertia = [1.0, 1.0, 0.3], velocity = [0.7, 0.0, 0.0])]
    ///     sleigh: Body,
    ///     #[joint(
    ///         between = [ground, sleigh], point = [-0.3, 0.0, 0.0],
    ///         normal = [0.0, 0.0, 1.0], side = [0.0, 1.0, 0.0]
    ///     )]
    ///     runner: Runner,
    /// }
    ///
    /// let (sleigh, h) = (Sleigh::default(), Sleigh::HANDLES);
    /// // A body without a joint that carries it: three displacements and three turns.
    /// let free = |number| Motion::free(h.sleigh, number);
    /// let space = sleigh.nonholonomic([free(0), free(1), free(5)], [free(0), free(5)])?;
    /// let state = space.of_bodies(&sleigh.described_state()?);
    /// let linear = space.linearise(&state, [], |view| [view.velocity(h.sleigh).y])?;
    /// // Its edge behind, it goes straight on: `w' = -m a u w / (J + m a^2)`.
    /// let damping = 2.0 * 0.3 * 0.7 / (0.3 + 2.0 * 0.3 * 0.3);
    /// assert!((linear.by_speeds[(1, 1)] + damping).abs() < 1e-12);
    /// // The centre of mass goes aside as the sleigh is turned.
    /// assert!((linear.rates_by_coordinates[(1, 2)] - 0.7).abs() < 1e-12);
    /// // Its velocity aside by the three coordinates and the two speeds.
    /// let c = linear.c::<5>();
    /// assert!((c[(0, 2)] - 0.7).abs() < 1e-12 && (c[(0, 4)] - 0.3).abs() < 1e-12);
    /// # Ok::<(), Fault>(())
    /// ```
    ///
    /// # Errors
    /// As [`coordinates`](super::IndependentExt::coordinates).
    fn nonholonomic<const Q: usize, const N: usize>(
        &self,
        coordinates: impl Chosen<Self, Q>,
        speeds: impl Chosen<Self, N>,
    ) -> Result<NonholonomicCoordinates<Self, Q, N>, Fault> {
        let freedom = degrees_of_freedom::<Self>();
        let parameters = self.parameters()?;
        let constants = Self::prepare(&parameters);
        let coordinates = distinct(coordinates, freedom + Self::REPORT.velocity_rows.len())?;
        let speeds = Places::of::<Self>(distinct(speeds, freedom)?);
        let given = (&parameters, &constants);
        let coordinates = Equations {
            leaves_velocities: true,
            ..Equations::prepared(given, Places::of::<Self>(coordinates), 0.0)
        };
        Ok(NonholonomicCoordinates {
            coordinates,
            speeds: IndependentCoordinates {
                equations: Equations::prepared(given, speeds, 0.0),
                constants,
                parameters,
                described: None,
                passes_limits: false,
            },
        })
    }
}

impl<M: JointRates> NonholonomicExt for M {}

impl<M: JointRates, const Q: usize, const N: usize, S: Real> NonholonomicCoordinates<M, Q, N, S> {
    /// Takes drivers and laws at another time (s).
    pub const fn set_time(&mut self, time: S) {
        self.speeds.set_time(time);
        self.coordinates.time = time;
    }

    /// Sets the inputs of the mechanism, with which its described forces act.
    ///
    /// # Errors
    /// As [`IndependentCoordinates::set_inputs`].
    pub fn set_inputs(&mut self, inputs: &M::Inputs<S>) -> Result<(), ParameterError> {
        self.speeds.set_inputs(inputs)?;
        self.coordinates.constants = self.speeds.equations.constants;
        Ok(())
    }

    /// The state in which bodies stand and move so.
    #[must_use]
    pub fn of_bodies(&self, bodies: &M::State<S>) -> M::JointState<S> {
        self.speeds.of_bodies(bodies)
    }

    /// How the bodies stand and move in a state.
    #[must_use]
    pub fn bodies(&self, state: &M::JointState<S>) -> M::State<S> {
        self.speeds.bodies(state)
    }

    /// The speeds (rad/s, m/s) at a state.
    #[must_use]
    pub fn speeds(&self, state: &M::JointState<S>) -> SVector<S, N> {
        self.speeds.rates(state)
    }

    /// The rates of the coordinates (rad/s, m/s) at a state.
    #[must_use]
    pub fn coordinate_rates(&self, state: &M::JointState<S>) -> SVector<S, Q> {
        let rates = joint_rates::<M, S>(state);
        SVector::from(self.coordinates.places.take(rates.as_slice()))
    }

    /// The mass matrix of the speeds, as [`IndependentCoordinates::mass`].
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`].
    pub fn mass(&self, state: &M::JointState<S>) -> Result<SMatrix<S, N, N>, Fault>
    where
        M: HasMassMatrix,
    {
        self.speeds.mass(state)
    }

    /// The efforts along the speeds for these rates of them, as
    /// [`IndependentCoordinates::inverse`].
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`].
    pub fn inverse(
        &self,
        state: &M::JointState<S>,
        accelerations: impl Into<SVector<S, N>>,
    ) -> Result<SVector<S, N>, Fault>
    where
        M: HasInverse,
    {
        self.speeds.inverse(state, accelerations)
    }
}

impl<M, const Q: usize, const N: usize, S> NonholonomicCoordinates<M, Q, N, S>
where
    M: HasInverse + HasMassMatrix,
    S: Real,
{
    /// The rates of the speeds under these efforts along them, as
    /// [`IndependentCoordinates::forward`].
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`].
    pub fn forward(
        &self,
        state: &M::JointState<S>,
        efforts: impl Into<SVector<S, N>>,
    ) -> Result<SVector<S, N>, Fault> {
        self.speeds.forward(state, efforts)
    }

    /// The equations of motion and some readings, linear about a state that moves. The rates of
    /// coordinates and of speeds, and the readings, change with coordinates, speeds and the
    /// `values`, parameters or inputs by handle. What is not chosen follows.
    ///
    /// `read` takes what is wanted from a view, over numbers that carry derivatives; `|_| []` where
    /// nothing is.
    ///
    /// # Errors
    /// As [`IndependentCoordinates::linearise`].
    pub fn linearise<const K: usize, const P: usize>(
        &self,
        state: &M::JointState<S>,
        values: [ValueHandle<M>; K],
        read: impl Fn(&View<'_, Lifted<S>, M>) -> [Lifted<S>; P],
    ) -> Result<LinearMotion<Q, N, K, P, S>, Fault> {
        bodies_alone::<M>(LeavesOut::Linearisation)?;
        self.speeds.known(state, Needs::Derivatives)?;
        let ways = self.coordinates.partition(state)?;
        let mut linear = LinearMotion::zeros();
        let rates = joint_rates::<M, S>(state);
        let positions = (0..Q).map(|number| (Part::Coordinates, number, Along::Position(number)));
        let speeds = (0..N).map(|number| (Part::Speeds, number, Along::Rate(number)));
        let values = values.iter().enumerate();
        let values =
            values.map(|(number, value)| (Part::Values, number, Along::Value(value.index())));
        let mut columns = positions.chain(speeds).chain(values);
        loop {
            let columns: [_; LANES] = from_fn(|_| columns.next());
            let [Some(_), ..] = columns else { break };
            let directions = columns.map(|column| column.map(|(.., along)| along));
            let outcome = self.along(state, &ways, &directions, &read)?;
            let slopes = Outcome {
                moving: slopes(&outcome.moving),
                accelerated: slopes(&outcome.accelerated),
                readings: slopes(&outcome.readings),
            };
            for (lane, (part, column, _)) in columns.into_iter().flatten().enumerate() {
                linear.put(part, column, &slopes, lane);
            }
        }
        for (column, way) in ways.columns.iter().enumerate() {
            // Small turns of balls are carried round.
            for (row, &place) in self.coordinates.places.iter().enumerate() {
                let entry = &mut linear.rates_by_coordinates[(row, column)];
                *entry = *entry + turned::<M, S>(place, &rates, way);
            }
        }
        linear.finite()
    }

    /// Rates of the coordinates and of the speeds, and readings, along some directions.
    fn along<const P: usize>(
        &self,
        state: &M::JointState<S>,
        ways_of: &Partition<M, Q, S>,
        directions: &[Option<Along>; LANES],
        read: &impl Fn(&View<'_, Lifted<S>, M>) -> [Lifted<S>; P],
    ) -> Result<Outcome<Lifted<S>, Q, N, P>, Fault> {
        let mut equations = self.speeds.equations.lifted::<LANES>();
        let mut parameters: M::Parameters<Lifted<S>> = lifted(&self.speeds.parameters);
        let mut ways = M::JointVelocities::<Lifted<S>>::zeros();
        let mut speeds = self.speeds.rates_of(state).map(Forward::fixed);
        let mut is_varied = false;
        for (lane, direction) in directions.iter().enumerate() {
            match *direction {
                Some(Along::Position(column)) => {
                    let way = ways_of.columns.get(column).into_iter();
                    let way = way.flat_map(|way| way.as_slice().iter());
                    for (number, &slope) in ways.as_mut_slice().iter_mut().zip(way) {
                        add(number, lane, slope);
                    }
                }
                Some(Along::Rate(column)) => vary(speeds.get_mut(column), lane),
                Some(Along::Value(place)) => {
                    is_varied = true;
                    vary(parameters.as_mut_slice().get_mut(place), lane);
                }
                None => {}
            }
        }
        let time = equations.time;
        if is_varied {
            equations.constants = M::prepare_joints(&parameters);
            // What closes a loop again that a parameter opens.
            let coordinates = Equations {
                constants: equations.constants,
                ..self.coordinates.lifted::<LANES>()
            };
            let here = displaced::<M, S, LANES>((&equations.constants, time), state, &ways);
            let closing = coordinates.partition(&here)?.closing;
            for (way, number) in ways.as_mut_slice().iter_mut().zip(closing.as_slice()) {
                *way = *way + Forward::new(S::zero(), number.derivatives());
            }
        }
        let mut there = displaced::<M, S, LANES>((&equations.constants, time), state, &ways);
        let following = equations.partition(&there)?;
        write_rates::<M, N, Lifted<S>>(&following, &speeds, true, &mut there);
        // Rates have changed what accelerations are without the chosen ones.
        let following = equations.partition(&there)?;
        let rates = joint_rates::<M, Lifted<S>>(&there);
        let none = [Forward::zero(); N];
        let mut outcome = Outcome {
            moving: self.coordinates.places.take(rates.as_slice()),
            accelerated: equations.forward_with(Some(&following), &there, &none),
            readings: [Forward::zero(); P],
        };
        if P > 0 {
            let constants = if is_varied {
                M::prepare(&parameters)
            } else {
                lifted(&self.speeds.constants)
            };
            let there = StateAlong {
                parameters,
                is_varied,
                equations,
                state: there,
            };
            let bodies = self.speeds.bodies_along(state, &there);
            outcome.readings = read(&View::new(&constants, time, &bodies));
        }
        Ok(outcome)
    }
}

/// Which columns a direction belongs to.
#[derive(Clone, Copy)]
enum Part {
    Coordinates,
    Speeds,
    Values,
}

/// The derivatives of some numbers, row by row.
fn slopes<S: Scalar, const R: usize>(numbers: &[Lifted<S>; R]) -> [[S; LANES]; R] {
    numbers.each_ref().map(|number| number.derivatives())
}

/// The equations of motion and `P` readings, linear about a motion, in `Q` coordinates, `N` speeds
/// and `K` values: by [`NonholonomicCoordinates::linearise`].
///
/// In first order, with `x = (coordinates, speeds)`, all deviations from the state that it was
/// linearised about:
///
/// ```text
/// x' = A x + B u
/// y  = C x + D u
/// ```
///
/// Of a ball and of a free body the coordinates are a small turn (rad) along the axes of its rates.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LinearMotion<const Q: usize, const N: usize, const K: usize, const P: usize, S = f64> {
    /// Rates of coordinates by coordinates.
    pub rates_by_coordinates: SMatrix<S, Q, Q>,
    /// Rates of coordinates by speeds.
    pub rates_by_speeds: SMatrix<S, Q, N>,
    /// Rates of coordinates by values.
    pub rates_by_values: SMatrix<S, Q, K>,
    /// Rates of speeds by coordinates.
    pub by_coordinates: SMatrix<S, N, Q>,
    /// Rates of speeds by speeds.
    pub by_speeds: SMatrix<S, N, N>,
    /// Rates of speeds by values.
    pub by_values: SMatrix<S, N, K>,
    /// Readings by coordinates.
    pub readings_by_coordinates: SMatrix<S, P, Q>,
    /// Readings by speeds.
    pub readings_by_speeds: SMatrix<S, P, N>,
    /// Readings by values: `D`.
    pub readings_by_values: SMatrix<S, P, K>,
}

impl<const Q: usize, const N: usize, const K: usize, const P: usize, S: Real>
    LinearMotion<Q, N, K, P, S>
{
    fn zeros() -> Self {
        Self {
            rates_by_coordinates: SMatrix::from_element(S::zero()),
            rates_by_speeds: SMatrix::from_element(S::zero()),
            rates_by_values: SMatrix::from_element(S::zero()),
            by_coordinates: SMatrix::from_element(S::zero()),
            by_speeds: SMatrix::from_element(S::zero()),
            by_values: SMatrix::from_element(S::zero()),
            readings_by_coordinates: SMatrix::from_element(S::zero()),
            readings_by_speeds: SMatrix::from_element(S::zero()),
            readings_by_values: SMatrix::from_element(S::zero()),
        }
    }

    fn put(
        &mut self,
        part: Part,
        column: usize,
        slopes: &Outcome<[S; LANES], Q, N, P>,
        lane: usize,
    ) {
        let (moving, accelerated, readings) =
            (&slopes.moving, &slopes.accelerated, &slopes.readings);
        match part {
            Part::Coordinates => {
                put(&mut self.rates_by_coordinates, column, moving, lane);
                put(&mut self.by_coordinates, column, accelerated, lane);
                put(&mut self.readings_by_coordinates, column, readings, lane);
            }
            Part::Speeds => {
                put(&mut self.rates_by_speeds, column, moving, lane);
                put(&mut self.by_speeds, column, accelerated, lane);
                put(&mut self.readings_by_speeds, column, readings, lane);
            }
            Part::Values => {
                put(&mut self.rates_by_values, column, moving, lane);
                put(&mut self.by_values, column, accelerated, lane);
                put(&mut self.readings_by_values, column, readings, lane);
            }
        }
    }

    /// What is finite all over.
    fn finite(self) -> Result<Self, Fault> {
        finite_matrix(self.rates_by_coordinates)?;
        finite_matrix(self.rates_by_speeds)?;
        finite_matrix(self.rates_by_values)?;
        finite_matrix(self.by_coordinates)?;
        finite_matrix(self.by_speeds)?;
        finite_matrix(self.by_values)?;
        finite_matrix(self.readings_by_coordinates)?;
        finite_matrix(self.readings_by_speeds)?;
        finite_matrix(self.readings_by_values)?;
        Ok(self)
    }

    /// `A`, for `X = Q + N`; another `X` does not compile.
    #[must_use]
    pub fn a<const X: usize>(&self) -> SMatrix<S, X, X> {
        const { assert!(X == Q + N, "a state has the coordinates and the speeds") };
        SMatrix::from_fn(|row, column| match (row < Q, column < Q) {
            (true, true) => self.rates_by_coordinates[(row, column)],
            (true, false) => self.rates_by_speeds[(row, column - Q)],
            (false, true) => self.by_coordinates[(row - Q, column)],
            (false, false) => self.by_speeds[(row - Q, column - Q)],
        })
    }

    /// `B`, for `X = Q + N`.
    #[must_use]
    pub fn b<const X: usize>(&self) -> SMatrix<S, X, K> {
        const { assert!(X == Q + N, "a state has the coordinates and the speeds") };
        SMatrix::from_fn(|row, column| {
            if row < Q {
                self.rates_by_values[(row, column)]
            } else {
                self.by_values[(row - Q, column)]
            }
        })
    }

    /// `C`, for `X = Q + N`.
    #[must_use]
    pub fn c<const X: usize>(&self) -> SMatrix<S, P, X> {
        const { assert!(X == Q + N, "a state has the coordinates and the speeds") };
        SMatrix::from_fn(|row, column| {
            if column < Q {
                self.readings_by_coordinates[(row, column)]
            } else {
                self.readings_by_speeds[(row, column - Q)]
            }
        })
    }

    /// `D`.
    #[must_use]
    pub const fn d(&self) -> SMatrix<S, P, K> {
        self.readings_by_values
    }
}
