//! What a cost reads at an instant. It is made where it is read: of most instants a cost reads the
//! controls alone.

use core::cell::{Cell, OnceCell};
use core::fmt::{self, Debug};
use core::ops::Deref;

use super::LANES;
use crate::error::Fault;
use crate::forward::{Forward, Lifted};
use crate::independent::{IndependentCoordinates, StateAlong, Whole, vary};
use crate::math::scalar::Real;
use crate::measure::view::View;
use crate::mechanism::handle::ValueHandle;
use crate::mechanism::joint_rates::JointRates;
use crate::mechanism::kernels::Mechanism;

/// What a cost may read: a [`View`], over numbers that carry derivatives.
///
/// The coordinates and rates that were chosen, and the controls, cost next to nothing. What the
/// view reads is of the bodies, which are put where they are for every four directions.
pub struct Instant<'a, M: JointRates, const U: usize, S: Real = f64> {
    number: usize,
    controls: Option<[Lifted<S>; U]>,
    standing: &'a dyn Standing<M, S>,
    view: OnceCell<View<'a, Lifted<S>, M>>,
}

impl<M: JointRates, const U: usize, S: Real> Instant<'_, M, U, S> {
    /// How many steps were taken before.
    #[must_use]
    pub const fn number(&self) -> usize {
        self.number
    }

    /// The controls of the step that begins here; `None` at the end.
    #[must_use]
    pub const fn controls(&self) -> Option<[Lifted<S>; U]> {
        self.controls
    }

    /// The chosen coordinates (rad, m), in their order. The gradient ends with
    /// [`AnalysisFault::NoPosition`](crate::error::AnalysisFault::NoPosition) where one is a turn
    /// of a ball.
    #[must_use]
    pub fn positions(&self) -> &[Lifted<S>] {
        self.standing.positions()
    }

    /// The rates of the chosen coordinates (rad/s, m/s), in their order.
    #[must_use]
    pub fn rates(&self) -> &[Lifted<S>] {
        self.standing.rates()
    }

    /// Whether no step begins here.
    #[must_use]
    pub const fn is_end(&self) -> bool {
        self.controls.is_none()
    }
}

impl<'a, M: JointRates, const U: usize, S: Real> Deref for Instant<'a, M, U, S> {
    type Target = View<'a, Lifted<S>, M>;

    fn deref(&self) -> &Self::Target {
        self.view.get_or_init(|| self.standing.view())
    }
}

impl<M: JointRates, const U: usize, S: Real> Debug for Instant<'_, M, U, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Instant")
            .field("number", &self.number)
            .finish_non_exhaustive()
    }
}

/// How a mechanism stands at an instant, along some directions.
pub(super) trait Standing<M: JointRates, S: Real> {
    fn view(&self) -> View<'_, Lifted<S>, M>;
    fn positions(&self) -> &[Lifted<S>];
    fn rates(&self) -> &[Lifted<S>];
}

/// The bodies, and what a view takes beside them.
type Bodies<M, S> = (
    <M as Mechanism>::Constants<Lifted<S>>,
    <M as Mechanism>::State<Lifted<S>>,
);

/// The chosen coordinates at an instant, whatever the directions.
pub(super) type Positions<const N: usize, S> = OnceCell<Result<[S; N], Fault>>;

/// How a mechanism stands at an instant, made when it is asked for.
pub(super) struct Lazy<'a, M: JointRates, const N: usize, S: Real> {
    space: &'a IndependentCoordinates<M, N, S>,
    state: &'a M::JointState<S>,
    positions: &'a Positions<N, S>,
    directions: &'a [Option<Whole>; LANES],
    there: OnceCell<StateAlong<M, N, LANES, S>>,
    bodies: OnceCell<Bodies<M, S>>,
    numbers: [OnceCell<[Lifted<S>; N]>; 2],
    /// Why something that was read is not known.
    fault: Cell<Option<Fault>>,
}

impl<'a, M: JointRates, const N: usize, S: Real> Lazy<'a, M, N, S> {
    pub(super) fn new(
        space: &'a IndependentCoordinates<M, N, S>,
        (state, positions): (&'a M::JointState<S>, &'a Positions<N, S>),
        directions: &'a [Option<Whole>; LANES],
    ) -> Self {
        Self {
            space,
            state,
            positions,
            directions,
            there: OnceCell::new(),
            bodies: OnceCell::new(),
            numbers: [const { OnceCell::new() }; 2],
            fault: Cell::new(None),
        }
    }

    /// The state along the directions.
    pub(super) fn there(&self) -> &StateAlong<M, N, LANES, S> {
        let there = || self.space.whole_along(self.state, self.directions);
        self.there.get_or_init(there)
    }

    pub(super) const fn space(&self) -> &'a IndependentCoordinates<M, N, S> {
        self.space
    }

    /// Whether anything of the state was read.
    pub(super) fn was_read(&self) -> bool {
        self.bodies.get().is_some() || self.numbers.iter().any(|numbers| numbers.get().is_some())
    }

    /// What a cost is here.
    pub(super) fn cost<const U: usize>(
        &self,
        (number, is_end): (usize, bool),
        held: &[ValueHandle<M>; U],
        cost: &impl Fn(&Instant<'_, M, U, S>) -> Lifted<S>,
    ) -> Result<Lifted<S>, Fault> {
        let found = cost(&Instant {
            number,
            controls: (!is_end).then(|| held.map(|input| self.value(input))),
            standing: self,
            view: OnceCell::new(),
        });
        self.fault.get().map_or(Ok(found), Err)
    }

    /// A value along the directions.
    fn value(&self, value: ValueHandle<M>) -> Lifted<S> {
        let mut number = Forward::fixed(self.space.parameter(value.index()));
        for (lane, direction) in self.directions.iter().enumerate() {
            if matches!(direction, Some(Whole::Value(place)) if *place == value.index()) {
                vary(Some(&mut number), lane);
            }
        }
        number
    }

    /// Keeps the first fault.
    fn known<T>(&self, outcome: Result<T, Fault>) -> Option<T> {
        outcome
            .map_err(|fault| self.fault.set(self.fault.get().or(Some(fault))))
            .ok()
    }

    fn bodies(&self) -> Bodies<M, S> {
        let there = self.there();
        let bodies = self.space.bodies_along(self.state, there);
        (M::prepare(&there.parameters), bodies)
    }

    /// Chosen numbers along the directions that are theirs.
    fn chosen(&self, numbers: [S; N], place: impl Fn(Whole) -> Option<usize>) -> [Lifted<S>; N] {
        let mut numbers = numbers.map(Forward::fixed);
        for (lane, direction) in self.directions.iter().enumerate() {
            let place = direction.and_then(&place);
            if let Some(column) = place.and_then(|place| self.space.column_of(place)) {
                vary(numbers.get_mut(column), lane);
            }
        }
        numbers
    }
}

impl<M: JointRates, const N: usize, S: Real> Standing<M, S> for Lazy<'_, M, N, S> {
    fn view(&self) -> View<'_, Lifted<S>, M> {
        let (constants, bodies) = self.bodies.get_or_init(|| self.bodies());
        View::new(constants, Forward::fixed(self.space.time()), bodies)
    }

    fn positions(&self) -> &[Lifted<S>] {
        self.numbers[0].get_or_init(|| {
            let positions = self.positions;
            let positions = positions.get_or_init(|| self.space.positions_of(self.state));
            let positions = self.known(*positions);
            self.chosen(positions.unwrap_or([S::zero(); N]), |along| match along {
                Whole::Position(place) => Some(place),
                _ => None,
            })
        })
    }

    fn rates(&self) -> &[Lifted<S>] {
        self.numbers[1].get_or_init(|| {
            self.chosen(self.space.rates_of(self.state), |along| match along {
                Whole::Rate(place) => Some(place),
                _ => None,
            })
        })
    }
}
