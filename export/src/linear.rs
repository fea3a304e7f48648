//! Derivatives of the rates of a mechanism.

use holonom::Mechanism;
use holonom::mechanism::TracedCoordinates;

use crate::derivative::Direction;
use crate::export::{Export, INPUTS, PARAMETERS, STATE, TIMES, outputs, structure, written};
use crate::number::Precision;
use crate::program::{Function, Member, Struct};
use crate::tape::{Operation, Place, Tape, Unary, traced};

/// A direction in which something changes: its name, and the arguments that change with it.
struct Column {
    name: String,
    seeds: Vec<(usize, Seed)>,
}

/// What an argument changes by.
enum Seed {
    One,
    /// Another argument.
    Argument(usize),
    /// Less another argument.
    Less(usize),
}

impl<M: Mechanism, P: Precision, C: TracedCoordinates<M>> Export<M, P, C> {
    /// The rates of a state with their exact derivatives: by angles (rad) and other coordinates, by
    /// velocities, by inputs and by parameters. At a law that switches, they are those of the side
    /// that holds.
    ///
    /// The function takes parameters and inputs in the place of constants, for the sake of the
    /// derivatives by them. The header has a name for every row and every column.
    #[must_use]
    pub fn derivatives(self) -> Self {
        let Some(kernel) = self.program.function("evaluate") else {
            return self;
        };
        let kernel = self.program.functions[kernel].clone();
        let rows: Vec<Place> = kernel.outputs.iter().map(|output| output.place).collect();
        self.derived(
            "derivatives",
            "Derivatives of the rates of a state, at its time.",
            ("jacobian", "Derivatives of the rates of a state: a row for each number of a slope, in their order."),
            &[(kernel, rows)],
        )
    }

    /// The exact derivatives of the readings that were named before, in the same columns.
    #[must_use]
    pub fn reading_derivatives(self) -> Self {
        let rows = |of: &Function| (of.clone(), of.returned.into_iter().collect());
        let kernels: Vec<_> = self.readings().map(rows).collect();
        if kernels.is_empty() {
            return self;
        }
        self.derived(
            "reading_derivatives",
            "Derivatives of the readings of a state, at its time.",
            (
                "sensitivities",
                "Derivatives of the readings of a state: a row for each of them, in their order.",
            ),
            &kernels,
        )
    }

    /// Adds a function that gives derivatives of numbers of some functions, row by row.
    fn derived(
        mut self,
        name: &str,
        about: &str,
        (structure_name, about_structure): (&'static str, &str),
        kernels: &[(Function, Vec<Place>)],
    ) -> Self {
        if self.program.function("prepare").is_none() {
            // The mechanism was refused.
            return self;
        }
        let columns = self.columns();
        let (mut tape, rows) = self.spliced(kernels);
        let operations = tape.operations().len();
        let mut derivatives = vec![Vec::new(); rows.len()];
        for column in &columns {
            let seeds = self.seeds(&mut tape, column);
            let direction = Direction::along(&mut tape, &seeds, operations);
            for (row, list) in rows.iter().zip(&mut derivatives) {
                list.push(direction.change(*row));
            }
        }
        let zero = tape.number(0.0);
        let entries = derivatives
            .into_iter()
            .flatten()
            .map(|entry| entry.unwrap_or(zero));
        let entries: Vec<Place> = entries.collect();
        let jacobian = self.program.structs.len();
        let names: Vec<String> = columns.into_iter().map(|column| column.name).collect();
        self.program.structs.push(Struct {
            name: structure_name,
            about: format!("{about_structure} Columns: {}.", names.join(", ")),
            members: vec![Member::array("value", "row by row", entries.len())],
        });
        self.add(Function {
            name: name.to_owned(),
            about: about.to_owned(),
            arguments: vec![
                structure("parameters", PARAMETERS),
                structure("inputs", INPUTS),
                structure("state", STATE),
                written(structure_name, jacobian),
            ],
            outputs: outputs(3, entries.into_iter()).collect(),
            tape,
            returned: None,
            is_public: true,
            is_checked: false,
            guard: None,
        });
        self
    }

    /// How many parameters and inputs there are.
    fn given(&self) -> usize {
        self.values
            .iter()
            .flatten()
            .map(|value| value.places.len())
            .sum()
    }

    /// The directions, by arguments of the spliced function.
    fn columns(&self) -> Vec<Column> {
        let first = self.given() + TIMES;
        let mut columns = Vec::new();
        let mut elements = self.elements.iter().enumerate().peekable();
        while let Some((place, element)) = elements.next() {
            let is_pair = elements
                .next_if(|(_, next)| next.of_slope.is_none())
                .is_some();
            let (name, at) = (&element.of_state.name, first + place);
            columns.push(if is_pair {
                Column {
                    name: format!("{}_angle", name.strip_suffix("_cos").unwrap_or(name)),
                    seeds: vec![(at, Seed::Less(at + 1)), (at + 1, Seed::Argument(at))],
                }
            } else {
                Column {
                    name: name.clone(),
                    seeds: vec![(at, Seed::One)],
                }
            });
        }
        let [parameters, inputs] = &self.values;
        let mut next = 0;
        let mut of_values = Vec::new();
        for value in parameters.iter().chain(inputs) {
            for (k, _) in value.places.iter().enumerate() {
                let name = value.member.name.clone();
                let is_array = value.member.length.is_some();
                of_values.push(Column {
                    name: if is_array {
                        format!("{name}[{k}]")
                    } else {
                        name
                    },
                    seeds: vec![(next, Seed::One)],
                });
                next += 1;
            }
        }
        columns.extend(of_values);
        columns
    }

    fn seeds(&self, tape: &mut Tape, column: &Column) -> Vec<(Place, Place)> {
        let at = |tape: &mut Tape, place: usize| {
            tape.intern(Operation::Argument(
                u32::try_from(place).unwrap_or(u32::MAX),
            ))
        };
        let seeds = column.seeds.iter().map(|(of, seed)| {
            let change = match seed {
                Seed::One => tape.number(1.0),
                Seed::Argument(place) => at(tape, *place),
                Seed::Less(place) => {
                    let place = at(tape, *place);
                    tape.put(Operation::Unary(Unary::Negation, place))
                }
            };
            (at(tape, *of), change)
        });
        seeds.collect()
    }

    /// Kernels with the computation of their constants in front of them, over parameters, inputs
    /// and the state; and their numbers there.
    fn spliced(&self, kernels: &[(Function, Vec<Place>)]) -> (Tape, Vec<Place>) {
        let prepare = self
            .program
            .function("prepare")
            .map(|place| &self.program.functions[place]);
        let (count, constants) = (self.given(), self.before_state());
        let (mut tape, ()) = traced(P::IS_SINGLE, || ());
        let state = TIMES + self.elements.len();
        for argument in 0..count + state {
            let place = Operation::Argument(u32::try_from(argument).unwrap_or(u32::MAX));
            tape.intern(place);
        }
        let mut given: Vec<Option<Place>> = vec![None; constants];
        if let Some(prepare) = prepare {
            let copies = copied(&mut tape, &prepare.tape, |argument| {
                Place::try_from(argument).unwrap_or(Place::MAX)
            });
            for output in &prepare.outputs {
                given[output.number] = Some(copies[output.place as usize]);
            }
        }
        let zero = tape.number(0.0);
        let mut rows = Vec::new();
        for (kernel, numbers) in kernels {
            let copies = copied(&mut tape, &kernel.tape, |argument| {
                match argument.checked_sub(constants) {
                    None => given[argument].unwrap_or(zero),
                    Some(place) => Place::try_from(count + place).unwrap_or(Place::MAX),
                }
            });
            rows.extend(numbers.iter().map(|&place| copies[place as usize]));
        }
        (tape, rows)
    }
}

/// Writes what stands on one tape on another one, with other arguments; where everything is there.
fn copied(to: &mut Tape, from: &Tape, argument: impl Fn(usize) -> Place) -> Vec<Place> {
    let mut copies: Vec<Place> = Vec::with_capacity(from.operations().len());
    for operation in from.operations() {
        let at = |place: Place| copies[place as usize];
        let place = match *operation {
            Operation::Argument(place) => argument(place as usize),
            Operation::Constant(_) | Operation::Result { .. } => to.put(*operation),
            Operation::Unary(function, of) => to.put(Operation::Unary(function, at(of))),
            Operation::Binary(function, of) => to.put(Operation::Binary(function, of.map(at))),
            Operation::Fused(of) => to.put(Operation::Fused(of.map(at))),
            Operation::Select(of) => to.put(Operation::Select(of.map(at))),
        };
        copies.push(place);
    }
    copies
}
