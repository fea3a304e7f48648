//! Programs in C, compiled and run.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use holonom::Real;
use holonom::state::Vector;
use holonom_export::Source;
use rand::RngExt as _;
use rand_chacha::ChaCha8Rng;

/// Warnings that a program in C must not have.
const STRICT: &[&str] = &[
    "-Wall",
    "-Wextra",
    "-Wconversion",
    "-Wdouble-promotion",
    "-pedantic",
    "-Werror",
    "-ffp-contract=off",
    "-O1",
];

/// A number as a program reads and writes it.
pub(crate) trait Number: Real {
    /// Its bytes.
    fn bytes(self) -> Vec<u8>;
    /// The numbers of some bytes.
    fn of_bytes(bytes: &[u8]) -> Vec<Self>;
    /// Whether two are the same to the last bit.
    fn same_bits(self, other: Self) -> bool;
}

macro_rules! number {
    ($float:ty, $size:expr) => {
        impl Number for $float {
            fn bytes(self) -> Vec<u8> {
                self.to_ne_bytes().to_vec()
            }

            fn of_bytes(bytes: &[u8]) -> Vec<Self> {
                let (numbers, _) = bytes.as_chunks::<$size>();
                numbers
                    .iter()
                    .map(|bytes| <$float>::from_ne_bytes(*bytes))
                    .collect()
            }

            fn same_bits(self, other: Self) -> bool {
                self.to_bits() == other.to_bits()
            }
        }
    };
}
number!(f64, 8);
number!(f32, 4);

/// The folder of a program.
fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// A program that was compiled.
pub(crate) struct Program(PathBuf);

/// What a program is compiled as.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Language {
    C,
    Cpp,
}

impl Program {
    /// Compiles a program with the function `main`.
    pub(crate) fn compiled(source: &Source, main: &str) -> Self {
        let folder = folder(&source.name);
        source.write(&folder).expect("files are written");
        let own = folder.join(format!("{}.c", source.name));
        Self::built(&folder, main, &[own], Language::C)
    }

    /// Compiles a function `main` that includes everything else, which is written into a folder.
    pub(crate) fn included(
        name: &str,
        files: impl FnOnce(&Path),
        main: &str,
        language: Language,
    ) -> Self {
        let folder = folder(&format!("{name}_{language:?}"));
        files(&folder);
        Self::built(&folder, main, &[], language)
    }

    fn built(folder: &Path, main: &str, others: &[PathBuf], language: Language) -> Self {
        let main_path = folder.join("main.c");
        fs::write(&main_path, main).expect("a file is written");
        let path = folder.join("program");
        let (variable, usual, options) = match language {
            Language::C => ("CC", "cc", &["-std=c99"][..]),
            Language::Cpp => ("CXX", "c++", &["-std=c++11", "-xc++"][..]),
        };
        let compiler = std::env::var(variable).unwrap_or_else(|_| usual.to_owned());
        let done = Command::new(&compiler)
            .args(options)
            .args(STRICT)
            .arg("-o")
            .arg(&path)
            .args(others)
            .arg(&main_path)
            .arg("-lm")
            .output()
            .expect("there is a compiler of C");
        assert!(
            done.status.success(),
            "{compiler}: {}",
            String::from_utf8_lossy(&done.stderr)
        );
        Self(path)
    }

    /// What it prints.
    pub(crate) fn printed(&self) -> String {
        let output = Command::new(&self.0).output().expect("it runs");
        assert!(output.status.success());
        String::from_utf8_lossy(&output.stdout).into_owned()
    }

    /// What it writes when it is given these numbers.
    pub(crate) fn run<S: Number>(&self, numbers: &[S]) -> Vec<S> {
        let mut child = Command::new(&self.0)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("it runs");
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.bytes()).collect();
        let mut input = child.stdin.take().expect("it has an input");
        let writing = std::thread::spawn(move || input.write_all(&bytes));
        let output = child.wait_with_output().expect("it ends");
        writing.join().expect("no panic").expect("it reads all");
        assert!(output.status.success());
        S::of_bytes(&output.stdout)
    }
}

/// Takes a step from every state that it reads; writes the status and the state.
pub(crate) fn steps(source: &Source) -> String {
    let n = &source.name;
    let has_constants = source.header.contains(&format!("}} {n}_constants;"));
    let [mut prepare, mut handed] = [String::new(), String::new()];
    if has_constants {
        prepare = format!("    {n}_constants constants;\n");
        handed = "&constants, ".to_owned();
        let mut arguments = Vec::new();
        for name in ["parameters", "inputs"] {
            if source.header.contains(&format!("}} {n}_{name};")) {
                prepare += &format!("    {n}_{name} {name};\n    {n}_default_{name}(&{name});\n");
                arguments.push(format!("&{name}"));
            }
        }
        arguments.push("&constants".to_owned());
        prepare += &format!("    {n}_prepare({});\n", arguments.join(", "));
    }
    format!(
        "\
#include \"{n}.h\"
#include <stdio.h>

int main(void)
{{
    {n}_state state;
    {n}_real dt;
    {n}_init(&state);
{prepare}    while (fread(&dt, sizeof dt, 1, stdin) == 1 && fread(&state, sizeof state, 1, stdin) == 1) {{
        {n}_real status = ({n}_real){n}_step({handed}&state, dt);
        fwrite(&status, sizeof status, 1, stdout);
        fwrite(&state, sizeof state, 1, stdout);
    }}
    return 0;
}}
"
    )
}

/// A state at random: angles anywhere, other coordinates near a state, rates of some size.
pub(crate) fn random_state<S: Real, X: Vector<S> + Copy>(start: &X, random: &mut ChaCha8Rng) -> X {
    let mut state = *start;
    let coordinates = start.coordinate_count();
    let mut place = 0;
    while place < start.length() {
        if place + 1 < coordinates && !start.is_independent(place + 1) {
            let angle: f64 = random.random_range(-3.0..3.0);
            state.set_element(place, S::constant(angle.cos()));
            state.set_element(place + 1, S::constant(angle.sin()));
            place += 2;
            continue;
        }
        let size = if place < coordinates { 0.1 } else { 4.0 };
        let by = S::constant(size * random.random_range(-1.0..1.0));
        state.set_element(place, start.element(place) + by);
        place += 1;
    }
    state
}
