//! Derivatives along coordinates, rates and values of a mechanism, given by name.

use core::fmt;
use core::marker::PhantomData;

use super::choice::Coordinate;
use super::determined::Needs;
use super::partition::{Partition, put_velocities, write_rates};
use super::points::moved;
use super::{Equations, IndependentCoordinates};
use crate::error::{AnalysisFault, Fault};
use crate::forward::{Forward, lifted};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::read;
use crate::math::without_bounds::copied;
use crate::mechanism::handle::ValueHandle;
use crate::mechanism::joint_kernels::JointParts as _;
use crate::mechanism::joint_rates::JointRates;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::relative::{bodies_by, bodies_of, rates_of_motion};
use crate::state::vector::{Array as _, StateParts, Vector as _};

/// What derivatives are taken by: a parameter or an input, or a chosen coordinate or its rate at
/// the start.
pub struct Direction<M> {
    named: Named,
    mechanism: PhantomData<fn() -> M>,
}

#[derive(Clone, Copy, Debug)]
enum Named {
    Value(usize),
    Position(Place),
    Rate(Place),
}

/// The place of a rate and the name of its joint.
type Place = Result<(usize, &'static str), Fault>;

impl<M> Direction<M> {
    const fn new(named: Named) -> Self {
        Self {
            named,
            mechanism: PhantomData,
        }
    }

    /// By a parameter or an input, in its unit.
    #[must_use]
    pub const fn value(value: ValueHandle<M>) -> Self {
        Self::new(Named::Value(value.index()))
    }

    /// By a chosen coordinate (rad, m) at the start. Of a ball that is a small turn along the axes
    /// of its rates.
    #[must_use]
    pub fn position(coordinate: impl Coordinate<M>) -> Self {
        Self::new(Named::Position(coordinate.place()))
    }

    /// By the rate of a chosen coordinate (rad/s, m/s) at the start.
    #[must_use]
    pub fn rate(coordinate: impl Coordinate<M>) -> Self {
        Self::new(Named::Rate(coordinate.place()))
    }

    /// The same by numbers, among chosen places.
    fn among(&self, places: &[usize]) -> Result<Along, Fault> {
        let column = |place: Place| chosen(places, place?);
        Ok(match self.named {
            Named::Value(place) => Along::Value(place),
            Named::Position(place) => Along::Position(column(place)?),
            Named::Rate(place) => Along::Rate(column(place)?),
        })
    }
}

copied!([M] Direction<M>);

impl<M> fmt::Debug for Direction<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Direction").field(&self.named).finish()
    }
}

impl<M> From<ValueHandle<M>> for Direction<M> {
    fn from(value: ValueHandle<M>) -> Self {
        Self::value(value)
    }
}

/// The number of a coordinate among the chosen ones.
pub(super) fn chosen(
    places: &[usize],
    (place, joint): (usize, &'static str),
) -> Result<usize, Fault> {
    let number = places.iter().position(|&known| known == place);
    number.ok_or(Fault::Analysis(AnalysisFault::NotChosen { joint }))
}

/// What changes along a direction, by the number of a chosen coordinate or the place of a value.
#[derive(Clone, Copy)]
pub(crate) enum Along {
    Position(usize),
    Rate(usize),
    Value(usize),
}

/// Parameters and bodies along directions.
type Start<M, const K: usize, S> = (
    <M as Mechanism>::Parameters<Forward<S, K>>,
    <M as Mechanism>::State<Forward<S, K>>,
);

/// A state along directions, and the bodies in it.
type Standing<M, const N: usize, const K: usize, S> = (
    StateAlong<M, N, K, S>,
    <M as Mechanism>::State<Forward<S, K>>,
);

/// A state along directions, and what the kernels take there.
pub(crate) struct StateAlong<M: JointRates, const N: usize, const K: usize, S: Scalar> {
    pub(crate) parameters: M::Parameters<Forward<S, K>>,
    /// Whether a parameter or an input varies.
    pub(super) is_varied: bool,
    pub(super) equations: Equations<M, N, Forward<S, K>>,
    pub(crate) state: M::JointState<Forward<S, K>>,
}

impl<M: JointRates, const N: usize, S: Real> IndependentCoordinates<M, N, S> {
    /// A state along some directions; what is not chosen follows.
    pub(super) fn state_along<const K: usize>(
        &self,
        state: &M::JointState<S>,
        partition: &Partition<M, N, S>,
        directions: &[Option<Along>; K],
    ) -> Result<StateAlong<M, N, K, S>, Fault> {
        let mut equations = self.equations.lifted::<K>();
        let mut parameters: M::Parameters<Forward<S, K>> = lifted(&self.parameters);
        let mut ways = M::JointVelocities::<Forward<S, K>>::zeros();
        let rates: [S; N] = self.rates(state).into();
        let mut rates_along = rates.map(Forward::fixed);
        let (mut is_varied, mut is_moved) = (false, false);
        for (lane, direction) in directions.iter().enumerate() {
            match *direction {
                Some(Along::Position(column)) => {
                    is_moved = true;
                    let way = partition.columns.get(column).into_iter();
                    let way = way.flat_map(|way| way.as_slice().iter());
                    for (number, &slope) in ways.as_mut_slice().iter_mut().zip(way) {
                        add(number, lane, slope);
                    }
                }
                Some(Along::Rate(column)) => vary(rates_along.get_mut(column), lane),
                Some(Along::Value(place)) => {
                    is_varied = true;
                    vary(parameters.as_mut_slice().get_mut(place), lane);
                }
                None => {}
            }
        }
        let here = |equations: &Equations<M, N, Forward<S, K>>, ways: &_| {
            displaced::<M, S, K>((&equations.constants, equations.time), state, ways)
        };
        if is_varied {
            equations.constants = M::prepare_joints(&parameters);
            if !M::JOINT_REPORT.closing.is_empty() {
                // What closes a loop again that a parameter opens.
                let closing = equations.partition(&here(&equations, &ways))?.closing;
                is_moved = true;
                for (way, number) in ways.as_mut_slice().iter_mut().zip(closing.as_slice()) {
                    *way = *way + Forward::new(S::zero(), number.derivatives());
                }
            }
        }
        let mut there = if is_moved {
            here(&equations, &ways)
        } else {
            moved::<M, S, K>(state, |_| [S::zero(); K])
        };
        // The start of a state of the user's own is its value here.
        for (lane, direction) in directions.iter().enumerate() {
            let is_varied =
                |value| matches!(direction, Some(Along::Value(place)) if *place == value);
            for info in M::JOINT_REPORT.states {
                if is_varied(info.value) {
                    vary(there.rest_slice_mut().get_mut(info.coordinate), lane);
                }
            }
        }
        if let Some(dependent) = equations.following(&there)? {
            write_rates::<M, N, Forward<S, K>>(&dependent, &rates_along, true, &mut there);
        } else {
            let mut all = M::JointVelocities::zeros();
            equations.places.put(&rates_along, all.as_mut_slice());
            put_velocities::<M, Forward<S, K>>(&all, &mut there);
        }
        Ok(StateAlong {
            parameters,
            is_varied,
            equations,
            state: there,
        })
    }

    /// A state along directions by number, with the bodies there.
    pub(crate) fn standing_along<const K: usize>(
        &self,
        state: &M::JointState<S>,
        directions: &[Option<Along>; K],
    ) -> Result<Standing<M, N, K, S>, Fault> {
        let there = self.standing_state(state, directions)?;
        let bodies = self.bodies_along(state, &there);
        Ok((there, bodies))
    }

    /// A state along directions by number.
    pub(crate) fn standing_state<const K: usize>(
        &self,
        state: &M::JointState<S>,
        directions: &[Option<Along>; K],
    ) -> Result<StateAlong<M, N, K, S>, Fault> {
        let partition = self.known(state, Needs::Accelerations)?;
        self.state_along(state, &partition, directions)
    }

    /// Parameters and bodies of a state along some directions.
    pub(crate) fn start_along<const K: usize>(
        &self,
        state: &M::JointState<S>,
        directions: &[Direction<M>; K],
    ) -> Result<Start<M, K, S>, Fault> {
        let mut along = [None; K];
        for (along, direction) in along.iter_mut().zip(directions) {
            *along = Some(direction.among(&*self.equations.places)?);
        }
        let (there, bodies) = self.standing_along(state, &along)?;
        Ok((there.parameters, bodies))
    }

    /// The bodies of a state along directions.
    pub(crate) fn bodies_along<const K: usize>(
        &self,
        here: &M::JointState<S>,
        there: &StateAlong<M, N, K, S>,
    ) -> M::State<Forward<S, K>> {
        let known = bodies_of::<S, M>(&self.equations.constants, here);
        let motions = M::body_motions(&there.equations.constants, &there.state);
        bodies_by::<Forward<S, K>, M>(&motions, |place, rows| {
            orientation_along(&read(known.coordinates().as_slice(), place), rows)
        })
    }
}

/// A state displaced along directions, by what that is to the joints.
pub(super) fn displaced<M: JointRates, S: Real, const K: usize>(
    (constants, time): (&M::JointConstants<Forward<S, K>>, Forward<S, K>),
    state: &M::JointState<S>,
    ways: &M::JointVelocities<Forward<S, K>>,
) -> M::JointState<Forward<S, K>> {
    // The rates of coordinates are linear in velocities, and these begin at zero.
    let mut turned = moved::<M, S, K>(state, |_| [S::zero(); K]);
    put_velocities::<M, Forward<S, K>>(ways, &mut turned);
    let slope = rates_of_motion::<Forward<S, K>, M>(constants, time, &turned);
    moved::<M, S, K>(state, |place| slope.element(place).derivatives())
}

/// Lets a number vary along a direction, beside those along which it does.
pub(crate) fn vary<S: Scalar, const K: usize>(number: Option<&mut Forward<S, K>>, lane: usize) {
    if let Some(number) = number {
        add(number, lane, S::one());
    }
}

/// Adds to the derivative along a direction.
pub(super) fn add<S: Scalar, const K: usize>(number: &mut Forward<S, K>, lane: usize, slope: S) {
    if let Some(place) = number.derivative_mut(lane) {
        *place = *place + slope;
    }
}

/// Euler parameters along directions, by those and the rotation matrix: with `R' = R w~` the rate
/// of `p` is `p (0, w) / 2`.
fn orientation_along<S: Scalar, const K: usize>(
    &[a, b, c, d]: &[S; 4],
    rows: &[[Forward<S, K>; 3]; 3],
) -> [Forward<S, K>; 4] {
    let half = S::constant(0.5);
    // `(R^T R')` of row `k` and column `l`, halved.
    let turn = |k: usize, l: usize| -> [S; K] {
        let mut sum = [S::zero(); K];
        for row in rows {
            let (value, slopes) = (half * row[k].value(), row[l].derivatives());
            for (sum, slope) in sum.iter_mut().zip(slopes) {
                *sum = value.fused(slope, *sum);
            }
        }
        sum
    };
    let [x, y, z] = [turn(2, 1), turn(0, 2), turn(1, 0)];
    let number = |value: S, [p, q, r]: [S; 3]| {
        let slope = |lane: usize| p.fused(x[lane], q.fused(y[lane], r * z[lane]));
        Forward::new(value, core::array::from_fn(slope))
    };
    [
        number(a, [-b, -c, -d]),
        number(b, [a, -d, c]),
        number(c, [d, a, -b]),
        number(d, [-c, b, a]),
    ]
}
