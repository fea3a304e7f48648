//! What a derive costs a user's build: small crates, compiled with cargo's defaults.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use holonom_study::StudyError;
use holonom_study::compare::record::Compiled;
use holonom_study::files::write_atomically;

/// A crate to build.
struct Crate {
    name: &'static str,
    scene: Scene,
    /// Described by joints as well as by bodies, and moved by joints.
    by_joints: bool,
    /// Whether a debug build is measured beside the release build.
    in_debug: bool,
}

const CRATES: [Crate; 10] = [
    Crate::both("pendulum", Scene::Chain(1), false),
    Crate::both("pendulum-joints", Scene::Chain(1), true),
    Crate::both("chain-8", Scene::Chain(8), false),
    Crate::both("chain-8-joints", Scene::Chain(8), true),
    Crate::both("chain-20", Scene::Chain(20), false),
    Crate::both("chain-20-joints", Scene::Chain(20), true),
    Crate::release("chain-64", Scene::Chain(64), false),
    Crate::release("chain-64-joints", Scene::Chain(64), true),
    Crate::release("four-bars-40", Scene::FourBars(40), false),
    Crate::release("four-bars-40-joints", Scene::FourBars(40), true),
];

impl Crate {
    /// Measured in a debug and in a release build.
    const fn both(name: &'static str, scene: Scene, by_joints: bool) -> Self {
        Self {
            name,
            scene,
            by_joints,
            in_debug: true,
        }
    }

    /// Measured in a release build alone.
    const fn release(name: &'static str, scene: Scene, by_joints: bool) -> Self {
        Self {
            name,
            scene,
            by_joints,
            in_debug: false,
        }
    }
}

/// What is described in a crate.
#[derive(Clone, Copy, Debug)]
enum Scene {
    /// Rods on parallel hinges one behind the other.
    Chain(usize),
    /// Four-bar windows side by side, as in the scenes that are timed.
    FourBars(usize),
}

impl Scene {
    fn size(self) -> usize {
        match self {
            Self::Chain(size) | Self::FourBars(size) => size,
        }
    }
}

/// How many builds [`compile`] measures.
pub const BUILDS: usize = {
    let (mut builds, mut place) = (0, 0);
    while place < CRATES.len() {
        builds += if CRATES[place].in_debug { 2 } else { 1 };
        place += 1;
    }
    builds
};

/// Writes the crates into a directory and builds each alone, its dependencies being there already,
/// in a debug and in a release build.
///
/// `done` is called with the builds that are measured.
///
/// # Errors
/// [`StudyError`] where a file cannot be written or a build fails.
pub fn compile(directory: &Path, mut done: impl FnMut(usize)) -> Result<Vec<Compiled>, StudyError> {
    let mut measured = Vec::new();
    for profile in ["debug", "release"] {
        let crates = CRATES
            .iter()
            .filter(|one| one.in_debug || profile == "release");
        for &Crate {
            name,
            scene,
            by_joints,
            ..
        } in crates
        {
            let folder = write_crate(directory, name, scene, by_joints)?;
            // The first build compiles what it depends on.
            cargo(&folder, &in_profile(&["build"], profile))?;
            cargo(&folder, &in_profile(&["clean", "--package", name], profile))?;
            let (start, processor) = (Instant::now(), processor_seconds());
            cargo(&folder, &in_profile(&["build"], profile))?;
            let seconds = start.elapsed().as_secs_f64();
            let spent = processor_seconds().zip(processor);
            measured.push(Compiled {
                name: name.into(),
                n: scene.size(),
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

fn in_profile<'a>(arguments: &[&'a str], profile: &str) -> Vec<&'a str> {
    let mut all = arguments.to_vec();
    if profile == "release" {
        all.push("--release");
    }
    all
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

/// The time (s) that processors spent for all processes that this one has waited for, and for those
/// that they have; where the system tells.
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
    scene: Scene,
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
        program(scene, by_joints).as_bytes(),
    )?;
    Ok(folder)
}

/// A mechanism, and a thousand steps of it.
fn program(scene: Scene, by_joints: bool) -> String {
    let coordinates = if by_joints {
        ", coordinates = \"joints\""
    } else {
        ""
    };
    let described = match scene {
        Scene::Chain(links) => chain(links, coordinates),
        Scene::FourBars(windows) => four_bars(windows, coordinates),
    };
    let steps = if by_joints {
        "    let mut dynamics = holonom::dynamics::Dynamics::<Problem<_, _>>::new(&Scene::default(), StandardLagrange)?.joint_coordinates();\n    \
         let mut state = dynamics.initial_state()?;\n    \
         for step in 0..1000 {\n        holonom::integrate::OneStep::step(&Rk4, &mut dynamics, 1e-3 * f64::from(step), &mut state, 1e-3)?;\n    }\n    \
         println!(\"{:?}\", dynamics.bodies(&state));\n"
    } else {
        "    let scene = Scene::default();\n    let mut stepper = scene.stepper(StandardLagrange, Rk4)?;\n    \
         let mut state = scene.described_state()?;\n    \
         for _ in 0..1000 {\n        stepper.step(&mut state, 1e-3)?;\n    }\n    println!(\"{state:?}\");\n"
    };
    format!(
        "use holonom::joints::Revolute;\nuse holonom::prelude::*;\n\n#[derive(Mechanism)]\n{described}\n\
         fn main() -> Result<(), Fault> {{\n{steps}    Ok(())\n}}\n"
    )
}

/// Rods of 1 m and 1 kg on parallel hinges one behind the other.
fn chain(links: usize, coordinates: &str) -> String {
    format!(
        "#[mechanism(gravity = [0.0, 0.0, -9.81]{coordinates})]
struct Scene {{
    #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, k + 0.5, 0.0])]
    rods: [Body; {links}],
    #[joint(between = [if k == 0 {{ ground }} else {{ rods[k - 1] }}, rods[k]], point = [0.0, k, 0.0], axis = [1.0, 0.0, 0.0])]
    hinges: [Revolute; {links}],
}}
"
    )
}

/// Upright rods of 1 m and 1 kg on the ground, each joined to the next by one of the same kind at
/// the top.
fn four_bars(windows: usize, coordinates: &str) -> String {
    let rods = windows + 1;
    let body = "mass = 1.0, inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0]";
    let axis = "axis = [0.0, 0.0, 1.0]";
    format!(
        "#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = \"drop\"{coordinates})]
struct Scene {{
    #[body({body}, position = [k, 0.5, 0.0], velocity = [0.5, 0.0, 0.0], angular_velocity = [0.0, 0.0, -1.0])]
    rods: [Body; {rods}],
    #[joint(between = [ground, rods[k]], point = [k, 0.0, 0.0], {axis})]
    feet: [Revolute; {rods}],
    #[body({body}, position = [k + 0.5, 1.0, 0.0], velocity = [1.0, 0.0, 0.0])]
    tops: [Body; {windows}],
    #[joint(between = [rods[k], tops[k]], point = [k, 1.0, 0.0], {axis})]
    left: [Revolute; {windows}],
    #[joint(between = [tops[k], rods[k + 1]], point = [k + 1, 1.0, 0.0], {axis})]
    right: [Revolute; {windows}],
}}
"
    )
}

#[cfg(test)]
mod tests {
    use super::{BUILDS, CRATES, Scene, processor_seconds, program};

    #[test]
    fn programs_are_as_long_as_they_are_named() {
        let text = program(Scene::Chain(3), true);
        assert!(text.contains("rods: [Body; 3]") && text.contains("coordinates = \"joints\""));
        let text = program(Scene::FourBars(40), false);
        assert!(text.contains("rods: [Body; 41]") && text.contains("tops: [Body; 40]"));
        assert!(!text.contains("coordinates"));
    }

    #[test]
    fn every_build_is_counted() {
        let debug = CRATES.iter().filter(|one| one.in_debug).count();
        assert_eq!(BUILDS, CRATES.len() + debug);
    }

    #[test]
    fn the_time_of_processes_is_known_where_the_system_tells() {
        assert_eq!(processor_seconds().is_some(), cfg!(target_os = "linux"));
    }
}
