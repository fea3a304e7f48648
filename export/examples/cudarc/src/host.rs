//! The same arms by Rust.

use holonom::dynamics::{State, WithCoordinates};
use holonom::mechanism::Relative;
use holonom::prelude::*;
use holonom::state::Vector as _;
use holonom_models::Ur5;

use crate::Number;
use crate::gpu::Plan;

type Arm = WithCoordinates<Problem<Ur5, StandardLagrange, Number>, Relative>;

/// The numbers in front of those that a step moves: the time, and what its last digits leave over.
const TIMES: usize = 2;

/// A stepper at time zero, and the described configuration.
pub(crate) struct Host {
    stepper: Stepper<Arm, Rk4>,
    described: State<Arm>,
}

impl Host {
    pub(crate) fn new() -> Result<Self, Fault> {
        let arm = Ur5::default();
        let stepper = Stepper::<Problem<_, _, Number>, _>::new(&arm, StandardLagrange, Rk4)?;
        let stepper = stepper.joint_coordinates();
        let described = stepper.initial_state()?;
        Ok(Self { stepper, described })
    }

    /// The numbers of a start with these rates (rad/s), as the struct in C has them.
    pub(crate) fn start(&self, rates: [Number; 6]) -> Vec<Number> {
        let mut state = self.described;
        state.velocities_slice_mut().copy_from_slice(&rates);
        numbers(0.0, &state)
    }

    /// The state of some numbers.
    fn state(&self, numbers: &[Number]) -> State<Arm> {
        let mut state = self.described;
        for (place, number) in numbers[TIMES..].iter().enumerate() {
            state.set_element(place, *number);
        }
        state
    }

    /// The recorded states of a run from a start.
    pub(crate) fn run(&self, start: &[Number], plan: &Plan) -> Result<Vec<Vec<Number>>, Fault> {
        let (mut stepper, mut state) = (self.stepper.clone(), self.state(start));
        let mut records = Vec::new();
        for step in 1..=plan.steps {
            stepper.step(&mut state, plan.dt)?;
            if step.is_multiple_of(plan.every) {
                records.push(numbers(stepper.time(), &state));
            }
        }
        Ok(records)
    }

    /// The angle of the elbow (rad) in states that follow each other: a state counts no turns, so
    /// each is within half a turn of the one before.
    pub(crate) fn elbow(&self, states: &[Vec<Number>]) -> Vec<Number> {
        let mut before = 0.0;
        let angle = |numbers: &Vec<Number>| {
            let bodies = self.stepper.bodies(&self.state(numbers));
            let angle = self.stepper.view(&bodies).angle(Ur5::HANDLES.elbow);
            let turned = angle - before;
            before += turned.sin().atan2(turned.cos());
            before
        };
        states.iter().map(angle).collect()
    }
}

/// A state as the struct in C has it.
fn numbers(time: Number, state: &State<Arm>) -> Vec<Number> {
    let mut numbers = vec![time, 0.0];
    state.for_each(|number| numbers.push(number));
    numbers
}

/// The largest difference of any number of two lists of states, NaN where one is NaN. What the
/// last digits of a time leave over is left out.
pub(crate) fn difference(these: &[Vec<Number>], those: &[Vec<Number>]) -> Result<Number, String> {
    let lengths = [these, those].map(|states| states.iter().map(Vec::len).collect::<Vec<_>>());
    if lengths[0] != lengths[1] {
        return Err("there are not as many states, or numbers, as in Rust".to_owned());
    }
    let pairs = these
        .iter()
        .zip(those)
        .flat_map(|(a, b)| a.iter().zip(b).enumerate());
    let kept = pairs.filter(|(place, _)| *place != 1);
    let differences = kept.map(|(_, (a, b))| (a - b).abs());
    Ok(differences.fold(0.0, |most, next| {
        if next > most || next.is_nan() {
            next
        } else {
            most
        }
    }))
}
