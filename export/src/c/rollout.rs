//! Rollouts: many worlds of a mechanism at once, one a thread of a GPU.

use std::fmt::Write as _;
use std::path::Path;

use holonom::Mechanism;
use holonom::mechanism::TracedCoordinates;

use super::{Source, Text, write_file};
use crate::error::ExportError;
use crate::export::{CONSTANTS, Export, INPUTS, PARAMETERS, STATE};
use crate::number::Precision;
use crate::program::{Program, Struct};

/// A program in C and its rollout in CUDA, which is HIP, C++ and C99 as well.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Rollout {
    /// The program.
    pub program: Source,
    /// The rollout, `name_rollout.cu`, which includes the program.
    pub rollout: String,
}

impl Rollout {
    /// Writes all three files into a folder, which is made where it is not there.
    ///
    /// # Errors
    /// [`ExportError::File`].
    pub fn write(&self, folder: impl AsRef<Path>) -> Result<(), ExportError> {
        let folder = folder.as_ref();
        self.program.write(folder)?;
        let path = folder.join(format!("{}_rollout.cu", self.program.name));
        write_file(&path, &self.rollout)
    }
}

impl<M: Mechanism, P: Precision, C: TracedCoordinates<M>> Export<M, P, C> {
    /// The program in C, and a rollout of many worlds for GPUs: one world a thread, each with its
    /// own start, parameters and inputs.
    ///
    /// Number `k` of world `w` is at `[k * worlds + w]`. The head of the file says what the kernel
    /// `name_rollout` is given and how a feedback is written. Compiled as C or C++, the same file
    /// takes the worlds one after the other, with the same numbers.
    ///
    /// # Errors
    /// As [`c`](Export::c); [`ExportError::Step`] without a [`step`](Export::step).
    pub fn cuda(self) -> Result<Rollout, ExportError> {
        let (text, export) = self.laid_out()?;
        let functions = &export.program.functions;
        if export.program.function("step").is_none() {
            return Err(ExportError::Step);
        }
        // Names of the rollout begin with this word.
        if let Some(taken) = functions.iter().find(|of| of.name.starts_with("rollout")) {
            let name = taken.name.clone();
            return Err(ExportError::Name { name });
        }
        let rollout = written(&text, &export.program);
        let program = text.source(export);
        Ok(Rollout { program, rollout })
    }

    /// Writes `name.h`, `name.c` and `name_rollout.cu` into a folder.
    ///
    /// # Errors
    /// As [`cuda`](Export::cuda), and what keeps a file from being written.
    pub fn write_cuda(self, folder: impl AsRef<Path>) -> Result<(), ExportError> {
        self.cuda()?.write(folder)
    }
}

/// The file, with marks: `@` is the name of the program, `%` the same in upper case. A line with a
/// letter and a bar in front is there only for mechanisms with parameters (`P`), inputs (`I`),
/// constants (`K`) or joints that may be open (`O`); with a small letter only for those without
/// parameters or inputs.
const TEMPLATE: &str = include_str!("rollout.cu");

fn written(text: &Text, program: &Program) -> String {
    let has = |place: usize| !program.structs[place].members.is_empty();
    // What is given changes nothing where no constant follows from it.
    let [parameters, inputs] = [PARAMETERS, INPUTS].map(|place| has(place) && has(CONSTANTS));
    let has_openings = program.function("check_joints").is_some();
    let is_kept = |mark: char| match mark {
        'P' => parameters,
        'p' => !parameters,
        'I' => inputs,
        'i' => !inputs,
        'O' => has_openings,
        _ => has(CONSTANTS),
    };
    let kept = |line: &'static str| match line.split_once("| ") {
        Some((mark, rest)) if mark.len() == 1 => mark.chars().all(is_kept).then_some(rest),
        _ => Some(line),
    };
    let lines = TEMPLATE.lines().filter_map(kept);
    let written: String = lines.flat_map(|line| [line, "\n"]).collect();
    let structs = [STATE, PARAMETERS, INPUTS].map(|place| &program.structs[place]);
    let sizes = structs.map(size).concat();
    let read = [(STATE, true), (PARAMETERS, parameters), (INPUTS, inputs)];
    let read = read.into_iter().filter(|(_, is_read)| *is_read);
    let mut moves: String = read.map(|(of, _)| load(&program.structs[of])).collect();
    moves += &store(&program.structs[STATE]);
    let mut prepared = String::new();
    for (is_given, name) in [(parameters, "parameters"), (inputs, "inputs")] {
        if is_given {
            let _ = write!(prepared, "&own_{name}, ");
        }
    }
    let stepped = if has(CONSTANTS) { "&constants, " } else { "" };
    let filled = [
        ("SIZES\n", sizes.as_str()),
        ("MOVES\n", &moves),
        ("PREPARED", &prepared),
        ("STEPPED", stepped),
        ("MECHANISM", text.mechanism),
        ("VERSION", env!("CARGO_PKG_VERSION")),
        ("@", &text.name),
        ("%", &text.upper),
    ];
    let fill = |written: String, (mark, with): (&str, &str)| written.replace(mark, with);
    filled.into_iter().fold(written, fill)
}

/// How many numbers a struct has, as a constant of the file.
fn size(of: &Struct) -> String {
    let (name, numbers) = (of.name.to_uppercase(), of.numbers());
    format!("#define %_ROLLOUT_{name} {numbers}\n")
}

/// The function that reads a struct of a world.
fn load(of: &Struct) -> String {
    let line = |path: &str, at: &str| format!("x->{path} = {at};");
    moved(of, "load", ["", "const "], line)
}

/// The function that writes a struct of a world.
fn store(of: &Struct) -> String {
    let line = |path: &str, at: &str| format!("{at} = x->{path};");
    moved(of, "store", ["const ", ""], line)
}

fn moved(
    of: &Struct,
    verb: &str,
    [of_struct, of_all]: [&str; 2],
    line: impl Fn(&str, &str) -> String,
) -> String {
    let (name, mut lines) = (of.name, String::new());
    for (number, path) in of.paths().iter().enumerate() {
        let at = format!("all[{number} * worlds + world]");
        let _ = writeln!(lines, "    {}", line(path, &at));
    }
    format!(
        "\
static %_FUNCTION void @_rollout_{verb}_{name}(
    {of_struct}@_{name} *x, {of_all}@_real *all, size_t worlds, size_t world)
{{
{lines}}}

"
    )
}
