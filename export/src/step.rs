//! A step of a method, as a function of the program.

use holonom::integrate::{OneStep, Scheme, Slopes, StepStart, System as _};
use holonom::mechanism::TracedCoordinates;
use holonom::state::MovingState as _;
use holonom::{Fault, Mechanism, Scalar};

use crate::export::{CONSTANTS, Export, STATE, TIMES, argument, outputs, structure, written};
use crate::number::{Precision, Traced};
use crate::program::{Argument, Function, Guard, Kind};
use crate::system::{Called, StateOf, numbers};
use crate::tape::traced;

impl<M: Mechanism, P: Precision, C: TracedCoordinates<M>> Export<M, P, C> {
    /// A step of a method, as a [`Stepper`](holonom::Stepper) takes it: the state is left as
    /// before where the step leads to no finite state, or farther beyond a limit of a joint than
    /// it began. Where a joint leaves its limits and comes back within one step, it is not seen.
    #[must_use]
    pub fn step<K>(mut self, scheme: K) -> Self
    where
        K: for<'a> OneStep<Traced<P>, Called<'a, P, M, C>> + Scheme<Traced<P>>,
    {
        let Some(function) = self.program.function("evaluate") else {
            return self;
        };
        let step_place = self.before_state() + TIMES + self.elements.len();
        let (gives, constants) = (self.gives(), self.before_state());
        let (tape, result) = traced(P::IS_SINGLE, || {
            let (own, _, absolute) = self.constants_from(0);
            let (time, state) = self.state();
            let (rest, dt) = (argument(constants + 1), argument(step_place));
            let mut system = Called::<P, M, C> {
                function,
                own: &own,
                absolute: &absolute,
                gives: &gives,
                has_pivot: self.has_pivot,
                pivot: None,
            };
            let next = advanced(&scheme, &mut system, (time, &state), dt)?;
            let [end, rest] = after(time, rest, dt);
            let mut all = vec![end.place(), rest.place()];
            all.extend(numbers(&next).into_iter().map(Traced::place));
            let guard = (!self.limited.is_empty()).then(|| {
                let [before, after] = [&state, &next].map(|of| C::bodies_by_selection(&own, of));
                self.step_guard(&absolute, [time, end], [&before, &after], dt)
            });
            let guard = guard.flatten().map(Traced::place);
            Ok((system.pivot.map(Traced::place), guard, all))
        });
        let (pivot, guard, next) = match result {
            Ok(result) => result,
            Err(fault) => {
                let fault: Fault = fault;
                self.fault.get_or_insert(fault.into());
                return self;
            }
        };
        self.add(Function {
            name: "step".to_owned(),
            about: "Moves the state by one step of dt (s).".to_owned(),
            arguments: vec![
                structure("constants", CONSTANTS),
                structure("state", STATE),
                Argument {
                    name: "dt",
                    kind: Kind::Number,
                    is_output: false,
                },
                // Read and written.
                written("state", STATE),
            ],
            outputs: outputs(3, next.into_iter()).collect(),
            tape,
            returned: pivot,
            is_public: true,
            is_checked: true,
            guard: guard.map(|place| (place, Guard::Limits)),
        });
        self
    }
}

/// A step from a state, as [`OneStep::step`] takes it.
fn advanced<P: Precision, M: Mechanism, C: TracedCoordinates<M>, K>(
    scheme: &K,
    system: &mut Called<'_, P, M, C>,
    (time, state): (Traced<P>, &StateOf<P, M, C>),
    step: Traced<P>,
) -> Result<StateOf<P, M, C>, Fault>
where
    K: for<'a> OneStep<Traced<P>, Called<'a, P, M, C>>,
{
    let mut slope = StateOf::<P, M, C>::zeros();
    system.stage(time, state, &mut slope)?;
    let start = StepStart {
        time,
        state,
        slope: &slope,
    };
    let mut stages = Scheme::<Traced<P>>::stages(scheme, &slope);
    let mut next = scheme.advanced(&mut Slopes::new(system), start, step, &mut stages)?;
    system.renormalise(&mut next, None);
    Ok(next)
}

/// The time after a step, and what its last digits leave over: Knuth, *The Art of Computer
/// Programming* 2, section 4.2.2, theorem B, as the clock of a [`Stepper`].
fn after<S: Scalar>(time: S, rest: S, step: S) -> [S; 2] {
    let increment = step + rest;
    let sum = time + increment;
    let added = sum - time;
    [sum, (time - (sum - added)) + (increment - added)]
}
