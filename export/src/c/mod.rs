//! Programs in C99, which are C++, CUDA and HIP as well.

mod body;
mod branches;
mod header;
mod rollout;
mod source;
mod support;

use std::fs;
use std::path::Path;

use holonom::Mechanism;
use holonom::mechanism::TracedCoordinates;

use crate::error::ExportError;
use crate::export::{CONSTANTS, Export};
use crate::number::Precision;
use crate::program::{Argument, Function, Kind, Program, Struct};
use crate::tape::Operation;

pub use rollout::Rollout;

/// A program in C: the text of its two files.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Source {
    /// The name of the program, with which every name in it begins.
    pub name: String,
    /// The header, `name.h`.
    pub header: String,
    /// The functions, `name.c`.
    pub source: String,
}

impl Source {
    /// Writes both files into a folder, which is made where it is not there.
    ///
    /// # Errors
    /// [`ExportError::File`].
    pub fn write(&self, folder: impl AsRef<Path>) -> Result<(), ExportError> {
        let folder = folder.as_ref();
        fs::create_dir_all(folder).map_err(|error| ExportError::of_file(folder, &error))?;
        write_file(&folder.join(format!("{}.h", self.name)), &self.header)?;
        write_file(&folder.join(format!("{}.c", self.name)), &self.source)
    }
}

/// Writes a file; an error has its path.
fn write_file(path: &Path, text: &str) -> Result<(), ExportError> {
    fs::write(path, text).map_err(|error| ExportError::of_file(path, &error))
}

impl<M: Mechanism, P: Precision, C: TracedCoordinates<M>> Export<M, P, C> {
    /// The program in C.
    ///
    /// # Errors
    /// What was wrong with the mechanism or with one of its functions.
    pub fn c(self) -> Result<Source, ExportError> {
        let (text, export) = self.laid_out()?;
        Ok(text.source(export))
    }

    /// The program with the constants that any function reads, and what is asked while it is
    /// written.
    fn laid_out(self) -> Result<(Text, Self), ExportError> {
        let mut export = self.checked()?;
        let text = Text {
            name: export.name.clone(),
            upper: export.name.to_uppercase(),
            constants: used_constants(&export.program),
            has_pivot: export.has_pivot,
            least_pivot: export.least_pivot,
            is_single: P::IS_SINGLE,
            has_time: M::REPORT.time.is_anywhere(),
            has_branches: export.has_branches,
            mechanism: M::REPORT.name,
        };
        let constants = text.constants.iter().flatten().count();
        let members = &mut export.program.structs[CONSTANTS].members;
        match members.first_mut() {
            Some(values) if constants > 0 => values.length = Some(constants),
            _ => members.clear(),
        }
        Ok((text, export))
    }

    /// Writes `name.h` and `name.c` into a folder.
    ///
    /// # Errors
    /// What was wrong with the mechanism or with one of its functions, and what keeps a file from
    /// being written.
    pub fn write_c(self, folder: impl AsRef<Path>) -> Result<(), ExportError> {
        self.c()?.write(folder)
    }
}

/// What is asked while a program is written.
struct Text {
    name: String,
    upper: String,
    /// The places of those constants that any function reads.
    constants: Vec<Option<usize>>,
    has_pivot: bool,
    least_pivot: f64,
    is_single: bool,
    /// Whether the time itself stands in the equations.
    has_time: bool,
    has_branches: bool,
    mechanism: &'static str,
}

impl Text {
    /// The two files.
    fn source<M: Mechanism, P: Precision, C: TracedCoordinates<M>>(
        &self,
        export: Export<M, P, C>,
    ) -> Source {
        Source {
            header: header::header(self, &export),
            source: source::source(self, &export),
            name: export.name,
        }
    }

    /// A type or a function of the program.
    fn named(&self, name: &str) -> String {
        format!("{}_{name}", self.name)
    }

    fn real(&self) -> String {
        self.named("real")
    }

    /// How each number of a struct is written behind the struct.
    fn paths(&self, program: &Program, place: usize) -> Vec<Option<String>> {
        if place == CONSTANTS {
            let path = |place: usize| format!("value[{place}]");
            return self.constants.iter().map(|place| place.map(path)).collect();
        }
        program.structs[place]
            .paths()
            .into_iter()
            .map(Some)
            .collect()
    }

    /// The arguments of a function as it declares them: structs without members are left out, and
    /// one that is read and written stands there once.
    fn declared(&self, program: &Program, arguments: &[Argument]) -> String {
        let mut declared = Vec::new();
        for argument in arguments {
            let Kind::Struct(place) = argument.kind else {
                declared.push(format!("{} {}", self.real(), argument.name));
                continue;
            };
            let of = &program.structs[place];
            if of.members.is_empty() {
                continue;
            }
            let is_twice = arguments
                .iter()
                .filter(|other| other.name == argument.name)
                .count()
                > 1;
            if is_twice && argument.is_output {
                continue;
            }
            let (kind, name) = (self.named(of.name), argument.name);
            let restrict = format!("{}_RESTRICT", self.upper);
            declared.push(if argument.is_output || is_twice {
                format!("{kind} *{restrict} {name}")
            } else {
                format!("const {kind} *{restrict} {name}")
            });
        }
        if declared.is_empty() {
            declared.push("void".to_owned());
        }
        declared.join(", ")
    }
}

/// The constants that are read by any function but that which computes them all, with new places.
pub(crate) fn used_constants(program: &Program) -> Vec<Option<usize>> {
    let constants = program.structs.get(CONSTANTS);
    let count = constants.map_or(0, Struct::numbers);
    let mut used = vec![false; count];
    for function in program
        .functions
        .iter()
        .filter(|function| function.name != "prepare")
    {
        let Some(first) = first_constant(program, function) else {
            continue;
        };
        let (needed, _) = function.tape.needed(function.given());
        let operations = function.tape.operations().iter().zip(needed);
        for (operation, _) in operations.filter(|(_, needed)| *needed) {
            if let Operation::Argument(place) = operation
                && let Some(used) = (*place as usize)
                    .checked_sub(first)
                    .and_then(|place| used.get_mut(place))
            {
                *used = true;
            }
        }
    }
    let mut next = 0;
    let place = |used: bool| {
        used.then(|| {
            next += 1;
            next - 1
        })
    };
    used.into_iter().map(place).collect()
}

/// Where the constants that a function is given begin among its numbers.
fn first_constant(program: &Program, function: &Function) -> Option<usize> {
    let firsts = program.firsts(&function.arguments);
    let mut arguments = function.arguments.iter().zip(firsts);
    arguments
        .find_map(|(argument, first)| first.filter(|_| argument.kind == Kind::Struct(CONSTANTS)))
}
