//! A mechanism as a system whose rates are calls of the function that gives them.

use std::fmt;

use holonom::Fault;
use holonom::integrate::{SecondOrder, System};
use holonom::mechanism::TracedCoordinates;
use holonom::state::{MovingState as _, Vector as _};
use holonom::{Mechanism, Scalar};

use crate::number::{Precision, Traced};
use crate::tape::{Call, with};

/// The state of a mechanism over traced numbers.
pub(crate) type StateOf<P, M, C> = <C as holonom::mechanism::Coordinates<M>>::State<Traced<P>>;

/// What depends on parameters, over traced numbers.
pub(crate) type ConstantsOf<P, M, C> =
    <C as holonom::mechanism::Coordinates<M>>::Constants<Traced<P>>;

/// The numbers of a state.
pub(crate) fn numbers<P: Precision, X: holonom::state::Vector<Traced<P>>>(
    state: &X,
) -> Vec<Traced<P>> {
    let mut numbers = Vec::new();
    state.for_each(|number| numbers.push(number));
    numbers
}

/// A state of these numbers; zero where there are none.
pub(crate) fn state_of<P: Precision, M: Mechanism, C: TracedCoordinates<M>>(
    mut number: impl FnMut(usize) -> Option<Traced<P>>,
) -> StateOf<P, M, C> {
    let mut state = StateOf::<P, M, C>::zeros();
    for place in 0..state.length() {
        if let Some(number) = number(place) {
            state.set_element(place, number);
        }
    }
    state
}

/// A mechanism whose rates are given by another function of the program: what a method moves that
/// [`Export::step`](crate::Export::step) takes.
pub struct Called<'a, P: Precision, M: Mechanism, C: TracedCoordinates<M>> {
    /// The place of that function.
    pub(crate) function: usize,
    /// The constants, for what is no call.
    pub(crate) own: &'a ConstantsOf<P, M, C>,
    /// Those in absolute coordinates.
    pub(crate) absolute: &'a M::Constants<Traced<P>>,
    /// Which numbers of a slope it gives, in their order.
    pub(crate) gives: &'a [bool],
    /// Whether it gives a pivot, before everything else.
    pub(crate) has_pivot: bool,
    /// The least of the pivots so far.
    pub(crate) pivot: Option<Traced<P>>,
}

impl<P: Precision, M: Mechanism, C: TracedCoordinates<M>> fmt::Debug for Called<'_, P, M, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Called").finish_non_exhaustive()
    }
}

impl<P: Precision, M: Mechanism, C: TracedCoordinates<M>> System<Traced<P>>
    for Called<'_, P, M, C>
{
    type State = StateOf<P, M, C>;

    fn rates(&mut self, time: Traced<P>, state: &Self::State) -> Result<Self::State, Fault> {
        let mut rates = Self::State::zeros();
        self.stage(time, state, &mut rates)?;
        Ok(rates)
    }

    fn stage(
        &mut self,
        time: Traced<P>,
        state: &Self::State,
        rates: &mut Self::State,
    ) -> Result<(), Fault> {
        // The time, and of its rest nothing is read.
        let mut given = vec![time.place(), Traced::<P>::zero().place()];
        given.extend(numbers(state).into_iter().map(Traced::place));
        let count = self.gives.iter().filter(|gives| **gives).count();
        let call = Call {
            function: self.function,
            given,
        };
        let results = with(|tape| tape.call(call, usize::from(self.has_pivot) + count));
        let mut results = results.into_iter().map(Traced::at);
        if self.has_pivot
            && let Some(pivot) = results.next()
        {
            let least = self.pivot.map_or(pivot, |least| least.min(pivot));
            self.pivot = Some(least);
        }
        for (place, &gives) in self.gives.iter().enumerate() {
            let number = if gives { results.next() } else { None };
            rates.set_element(place, number.unwrap_or_else(Scalar::zero));
        }
        Ok(())
    }

    fn renormalise(&mut self, state: &mut Self::State, _rates: Option<&mut Self::State>) {
        C::brought_to_normal_form(self.absolute, self.own, state);
    }
}

impl<P: Precision, M: Mechanism, C: TracedCoordinates<M>> SecondOrder<Traced<P>>
    for Called<'_, P, M, C>
{
    fn with_new_velocities(
        &mut self,
        time: Traced<P>,
        state: &Self::State,
        step: Traced<P>,
        rates: &mut Self::State,
    ) {
        C::with_new_velocities(self.own, time, state, step, rates);
    }
}
