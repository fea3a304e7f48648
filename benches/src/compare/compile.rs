//! What a derive costs a user's build: small crates, compiled with cargo's defaults.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use holonom_study::StudyError;
use holonom_study::compare::record::Compiled;
use holonom_study::files::write_atomically;

/// The crates: name, links of the chain, whether it is described by joints as well.
const CRATES: [(&str, usize, bool); 6] = [
    ("pendulum", 1, false),
    ("pendulum-joints", 1, true),
    ("chain-8", 8, false),
    ("chain-8-joints", 8, true),
    ("chain-20", 20, false),
    ("chain-20-joints", 20, true),
];

/// How many builds [`compile`] measures.
pub const BUILDS: usize = 2 * CRATES.len();

/// Writes the crates into a directory and builds each alone, its dependencies being there already, in a debug and in a release build.
///
/// `done` is called with the builds that are measured.
///
/// # Errors
/// [`StudyError`] where a file cannot be written or a build fails.
pub fn compile(directory: &Path, mut done: impl FnMut(usize)) -> Result<Vec<Compiled>, StudyError> {
    let mut measured = Vec::new();
    for profile in ["debug", "release"] {
        for (name, links, by_joints) in CRATES {
            let folder = write_crate(directory, name, links, by_joints)?;
            // The first build compiles what it depends on.
            cargo(&folder, &build(profile))?;
            cargo(&folder, &["clean", "--package", name])?;
            let (start, processor) = (Instant::now(), processor_seconds());
            cargo(&folder, &build(profile))?;
            let seconds = start.elapsed().as_secs_f64();
            let spent = processor_seconds().zip(processor);
            measured.push(Compiled {
                name: name.into(),
                n: links,
                coordinates: if by_joints { "joints" } else { "bodies" }.into(),
                profile: profile.into(),
                seconds,
                processor_seconds: spent.map(|(after, before)| after - before),
            });
            done(measured.len());
        }
    }
    Ok(measured)
}

fn build(profile: &str) -> Vec<&'static str> {
    match profile {
        "release" => vec!["build", "--release"],
        _ => vec!["build"],
    }
}

/// Runs cargo as a user would, without what this program was built with.
fn cargo(folder: &Path, arguments: &[&str]) -> Result<(), StudyError> {
    let fault = |reason: String| StudyError::Run {
        name: format!("cargo {} in {}", arguments.join(" "), folder.display()),
        reason,
    };
    let mut command = Command::new("cargo");
    command
        .args(arguments)
        .args(["--quiet", "--target-dir", "../target"]);
    command.current_dir(folder).stdin(Stdio::null());
    for variable in ["RUSTFLAGS", "CARGO_ENCODED_RUSTFLAGS", "CARGO_TARGET_DIR"] {
        command.env_remove(variable);
    }
    let output = command.output().map_err(|error| fault(error.to_string()))?;
    if output.status.success() {
        Ok(())
    } else {
        Err(fault(String::from_utf8_lossy(&output.stderr).into_owned()))
    }
}

/// The time (s) that processors spent for all processes that this one has waited for, and for those that they have; where the system tells.
fn processor_seconds() -> Option<f64> {
    /// Of a second; the same on all processors that Linux runs on.
    const TICKS: f64 = 100.0;
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    // Behind the name, which stands in brackets and may hold anything: state, and then numbers.
    let (_, numbers) = text.rsplit_once(')')?;
    let mut fields = numbers.split_whitespace().skip(13);
    let mut ticks = || fields.next()?.parse::<f64>().ok();
    Some((ticks()? + ticks()?) / TICKS)
}

fn write_crate(
    directory: &Path,
    name: &str,
    links: usize,
    by_joints: bool,
) -> Result<PathBuf, StudyError> {
    let runtime = Path::new(env!("CARGO_MANIFEST_DIR")).join("../runtime");
    let folder = directory.join(name);
    // A workspace of its own, wherever the directory is.
    let manifest = format!(
        "[package]\nname = {name:?}\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[dependencies]\nholonom = {{ path = {runtime:?} }}\n\n[workspace]\n"
    );
    write_atomically(&folder.join("Cargo.toml"), manifest.as_bytes())?;
    write_atomically(
        &folder.join("src/main.rs"),
        program(links, by_joints).as_bytes(),
    )?;
    Ok(folder)
}

/// A chain of rods on parallel hinges, and a thousand steps of it.
fn program(links: usize, by_joints: bool) -> String {
    let coordinates = if by_joints {
        ", coordinates = \"joints\""
    } else {
        ""
    };
    let mut text = format!(
        "use holonom::joints::Revolute;\nuse holonom::prelude::*;\n\n#[derive(Mechanism)]\n#[mechanism(gravity = [0.0, 0.0, -9.81]{coordinates})]\nstruct Chain {{\n"
    );
    for link in 0..links {
        let before = match link.checked_sub(1) {
            Some(before) => format!("rod_{before}"),
            None => "ground".into(),
        };
        let (head, centre) = (link as f64, link as f64 + 0.5);
        let _ = write!(
            text,
            "    #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, {centre:?}, 0.0])]\n    rod_{link}: Body,\n    \
             #[joint(between = [{before}, rod_{link}], point = [0.0, {head:?}, 0.0], axis = [1.0, 0.0, 0.0])]\n    hinge_{link}: Revolute,\n"
        );
    }
    text.push_str("}\n\nfn main() -> Result<(), Fault> {\n");
    text.push_str(if by_joints {
        "    let mut dynamics = holonom::JointDynamics::<f64, _, _>::new(&Chain::default(), StandardLagrange)?;\n    \
         let mut state = dynamics.initial_state()?;\n    \
         for step in 0..1000 {\n        holonom::Scheme::step(&Rk4, &mut dynamics, 1e-3 * f64::from(step), &mut state, 1e-3)?;\n    }\n    \
         println!(\"{:?}\", dynamics.bodies(&state));\n"
    } else {
        "    let chain = Chain::default();\n    let mut stepper = Stepper::<f64, _, _, _>::new(&chain, StandardLagrange, Rk4)?;\n    \
         let mut state = chain.described_state()?;\n    \
         for _ in 0..1000 {\n        stepper.step(&mut state, 1e-3)?;\n    }\n    println!(\"{state:?}\");\n"
    });
    text.push_str("    Ok(())\n}\n");
    text
}

#[cfg(test)]
mod tests {
    use super::{processor_seconds, program};

    #[test]
    fn programs_have_as_many_links() {
        let text = program(3, true);
        assert_eq!(text.matches(": Body,").count(), 3);
        assert!(text.contains("between = [rod_1, rod_2], point = [0.0, 2.0, 0.0]"));
        assert!(
            text.contains("coordinates = \"joints\"") && !program(3, false).contains("coordinates")
        );
    }

    #[test]
    fn the_time_of_processes_is_known_where_the_system_tells() {
        assert_eq!(processor_seconds().is_some(), cfg!(target_os = "linux"));
    }
}
