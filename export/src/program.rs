//! A program: functions over structs of numbers, in no language yet.

use crate::tape::{Place, Tape};

/// A struct whose members are numbers.
#[derive(Clone, Debug)]
pub(crate) struct Struct {
    /// Its name, without that of the program.
    pub(crate) name: &'static str,
    /// What it is, in a sentence.
    pub(crate) about: String,
    pub(crate) members: Vec<Member>,
}

/// A member of a struct: a number or an array of numbers.
#[derive(Clone, Debug)]
pub(crate) struct Member {
    pub(crate) name: String,
    /// What it is, with its unit.
    pub(crate) about: String,
    /// How many numbers an array has.
    pub(crate) length: Option<usize>,
}

impl Member {
    pub(crate) fn number(name: impl Into<String>, about: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            about: about.into(),
            length: None,
        }
    }

    pub(crate) fn array(name: impl Into<String>, about: impl Into<String>, length: usize) -> Self {
        Self {
            length: Some(length),
            ..Self::number(name, about)
        }
    }
}

impl Struct {
    /// How many numbers it has.
    pub(crate) fn numbers(&self) -> usize {
        let lengths = self.members.iter().map(|member| member.length.unwrap_or(1));
        lengths.sum()
    }

    /// How each of its numbers is written behind the struct and a dot.
    pub(crate) fn paths(&self) -> Vec<String> {
        let paths = self.members.iter().flat_map(|member| match member.length {
            None => vec![member.name.clone()],
            Some(length) => (0..length)
                .map(|k| format!("{}[{k}]", member.name))
                .collect(),
        });
        paths.collect()
    }
}

/// What an argument is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Number,
    /// A struct, by its place.
    Struct(usize),
}

/// An argument of a function.
#[derive(Clone, Debug)]
pub(crate) struct Argument {
    pub(crate) name: &'static str,
    pub(crate) kind: Kind,
    pub(crate) is_output: bool,
}

/// A number that a function writes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Output {
    /// The place of the argument.
    pub(crate) argument: usize,
    /// The place of the number in its struct.
    pub(crate) number: usize,
    pub(crate) place: Place,
}

/// A function that was traced.
#[derive(Clone, Debug)]
pub(crate) struct Function {
    /// Its name, without that of the program.
    pub(crate) name: String,
    /// What it does, in sentences.
    pub(crate) about: String,
    pub(crate) arguments: Vec<Argument>,
    pub(crate) tape: Tape,
    pub(crate) outputs: Vec<Output>,
    /// The number that it returns.
    pub(crate) returned: Option<Place>,
    /// Whether users of the program call it.
    pub(crate) is_public: bool,
    /// Whether it returns a status, and writes nothing where its numbers are not finite or where
    /// the number that it would return, the least relative pivot, vanishes.
    pub(crate) is_checked: bool,
    /// A number that has to be zero or positive, else it writes nothing.
    pub(crate) guard: Option<(Place, Guard)>,
}

/// What a number says that must not be negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Guard {
    /// That no limit is passed.
    Limits,
    /// That an iteration has converged.
    Converged,
    /// That no joint is open.
    Closed,
}

impl Guard {
    /// The status where it is negative, without the name of the program.
    pub(crate) fn status(self) -> &'static str {
        match self {
            Self::Limits => "LIMIT",
            Self::Converged => "NOT_CONVERGED",
            Self::Closed => "OPEN",
        }
    }
}

impl Function {
    /// Everything that it gives.
    pub(crate) fn given(&self) -> impl Iterator<Item = Place> + '_ {
        let outputs = self.outputs.iter().map(|output| output.place);
        let guard = self.guard.map(|(place, _)| place);
        let conditions = self.returned.into_iter().chain(guard);
        conditions.chain(outputs)
    }

    /// How many additions, multiplications and functions of numbers one call takes, without those
    /// of the functions that it calls.
    pub(crate) fn operations(&self) -> usize {
        let (needed, _) = self.tape.needed(self.given());
        let operations = self.tape.operations().iter().zip(needed);
        let needed = operations.filter_map(|(operation, needed)| needed.then_some(operation));
        needed.map(|operation| operation.cost()).sum()
    }
}

/// Structs and functions, of which those that are called stand before those that call them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Program {
    pub(crate) structs: Vec<Struct>,
    pub(crate) functions: Vec<Function>,
}

impl Program {
    /// How many numbers an argument has.
    pub(crate) fn numbers(&self, argument: &Argument) -> usize {
        match argument.kind {
            Kind::Number => 1,
            Kind::Struct(place) => self.structs[place].numbers(),
        }
    }

    /// The first numbers of the arguments that a function is given, by the places of these; `None`
    /// for one that it writes.
    pub(crate) fn firsts(&self, arguments: &[Argument]) -> Vec<Option<usize>> {
        let mut next = 0;
        let first = |argument: &Argument| {
            if argument.is_output {
                return None;
            }
            let first = next;
            next += self.numbers(argument);
            Some(first)
        };
        arguments.iter().map(first).collect()
    }

    pub(crate) fn function(&self, name: &str) -> Option<usize> {
        self.functions
            .iter()
            .position(|function| function.name == name)
    }
}
