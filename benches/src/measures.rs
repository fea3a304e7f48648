//! The studies beside chapter 15: built where they are asked for, and run.

use std::error::Error;
use std::ffi::OsString;
use std::io::{BufRead as _, BufReader, IsTerminal as _};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::time::Duration;

use clap::Args;
use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};

/// What is handed to a study. Its own `--help` is among that.
#[derive(Debug, Args)]
#[command(
    disable_help_flag = true,
    override_usage = "study [STUDY] [--large | --huge] [OPTIONS]"
)]
pub struct Arguments {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    all: Vec<OsString>,
}

/// A study of the program `study-measures`.
#[derive(Debug)]
pub struct Measures {
    /// Its name there.
    name: &'static str,
    /// The feature that has it.
    feature: &'static str,
    /// What the build took (s of processor time) where only chapter 15 was built, with few
    /// mechanisms and with many; where it was measured.
    seconds: [Option<u64>; 2],
}

/// `study compare`.
pub const COMPARE: Measures = Measures {
    name: "compare",
    feature: "compare",
    seconds: [Some(81), Some(1070)],
};
/// `study arms`.
pub const ARMS: Measures = Measures {
    name: "arms",
    feature: "arms",
    seconds: [Some(140), Some(140)],
};
/// `study estimate`.
pub const ESTIMATE: Measures = Measures {
    name: "estimate",
    feature: "estimate",
    seconds: [None, None],
};
/// `study trade`.
pub const TRADE: Measures = Measures {
    name: "trade",
    feature: "trade",
    seconds: [Some(260), None],
};
/// `study recommend`.
pub const RECOMMEND: Measures = Measures {
    name: "recommend",
    ..TRADE
};
/// `study extremes`.
pub const EXTREMES: Measures = Measures {
    name: "extremes",
    feature: "extremes",
    seconds: [Some(136), Some(577)],
};
/// `study ensemble`.
pub const ENSEMBLE: Measures = Measures {
    name: "ensemble",
    feature: "ensemble",
    seconds: [None, None],
};
/// `study show`.
pub const SHOW: Measures = Measures {
    name: "show",
    feature: "show",
    seconds: [None, None],
};

/// Whose seconds these are.
const MACHINE: &str = "an AMD EPYC (Zen 5)";

/// How many mechanisms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Extent {
    Few,
    Large,
    Huge,
}

impl Measures {
    /// Builds the study, unless it was built before, and runs it; how it ended.
    ///
    /// # Errors
    /// What cargo says where it cannot be built, or the operating system where it cannot be run.
    pub fn run(&self, arguments: &Arguments) -> Result<ExitCode, Box<dyn Error>> {
        let (extent, arguments) = extent(&arguments.all);
        let program = self.build(extent)?;
        let status = Command::new(program)
            .arg(self.name)
            .args(arguments)
            .status()?;
        Ok(match status.code() {
            Some(0) => ExitCode::SUCCESS,
            Some(code) => ExitCode::from(u8::try_from(code).unwrap_or(1)),
            None => ExitCode::FAILURE,
        })
    }

    /// Where the program is, once it is there. It lies beside this one, built with the same profile
    /// and the same flags.
    fn build(&self, extent: Extent) -> Result<PathBuf, Box<dyn Error>> {
        let this = std::env::current_exe()?;
        let folder = this.parent().ok_or("this program lies in no folder")?;
        let mut command = self.command(folder, extent)?;
        let shown = shown(&command);
        let mut cargo = command.stderr(Stdio::piped()).spawn()?;
        let messages = cargo.stderr.take().ok_or("cargo says nothing")?;
        let mut said = Vec::new();
        let mut bar: Option<ProgressBar> = None;
        for line in BufReader::new(messages).lines() {
            let line = line?;
            if let Some(what) = line.trim_start().strip_prefix("Compiling ") {
                let bar = match &bar {
                    Some(bar) => bar,
                    None => bar.insert(self.announce(extent, &shown)?),
                };
                let name = what.split(' ').next().unwrap_or(what);
                bar.set_message(name.to_owned());
            }
            if !std::io::stderr().is_terminal() {
                eprintln!("{line}");
            }
            said.push(line);
        }
        if let Some(bar) = bar {
            bar.finish_and_clear();
        }
        if !cargo.wait()?.success() {
            let said = said.join("\n");
            return Err(format!("`{shown}` fails:\n{said}").into());
        }
        Ok(folder.join(format!("study-measures{}", std::env::consts::EXE_SUFFIX)))
    }

    fn command(&self, folder: &Path, extent: Extent) -> Result<Command, Box<dyn Error>> {
        let target = folder
            .parent()
            .ok_or("this program lies in no target folder")?;
        let profile = folder.file_name().ok_or("this program lies in no folder")?;
        let profile = if profile == "debug" {
            "dev".into()
        } else {
            profile.to_owned()
        };
        let features = match extent {
            Extent::Few => self.feature.to_owned(),
            Extent::Large => format!("{},large", self.feature),
            Extent::Huge => format!("{},huge", self.feature),
        };
        // As `cargo run --bin study` there: what it built is built with the same features.
        let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
        let workspace = workspace.ok_or("the benches lie in no workspace")?;
        let mut command = Command::new(std::env::var_os("CARGO").unwrap_or("cargo".into()));
        command
            .args(["build", "--manifest-path"])
            .arg(workspace.join("Cargo.toml"))
            .arg("--profile")
            .arg(profile)
            .args([
                "--features",
                &features,
                "--bin",
                "study-measures",
                "--target-dir",
            ])
            .arg(target);
        Ok(command)
    }

    /// Says what is built and how long that takes, and shows how long it still does.
    fn announce(&self, extent: Extent, command: &str) -> Result<ProgressBar, Box<dyn Error>> {
        let seconds =
            self.seconds[usize::from(extent != Extent::Few)].filter(|_| extent != Extent::Huge);
        eprintln!("study: `{}` is built first, with {command}", self.name);
        match seconds {
            Some(seconds) => eprintln!(
                "study: that took {seconds} s of the processors of {MACHINE}, of which it keeps two busy"
            ),
            None => eprintln!("study: that takes minutes"),
        }
        let processors = std::thread::available_parallelism()
            .map_or(1, usize::from)
            .min(2);
        let expected = seconds.map(|seconds| Duration::from_secs(seconds / processors as u64));
        let left = move |state: &ProgressState, text: &mut dyn std::fmt::Write| {
            let left = expected.map(|expected| expected.saturating_sub(state.elapsed()));
            // Nobody to tell where it cannot be written.
            let _ = match left {
                None => Ok(()),
                Some(Duration::ZERO) => write!(text, ", longer than expected"),
                Some(left) => write!(text, ", about {} left", HumanDuration(left)),
            };
        };
        let style = ProgressStyle::with_template("{spinner} compiling {msg}: {elapsed}{left}")?;
        let bar = ProgressBar::new_spinner().with_style(style.with_key("left", left));
        bar.enable_steady_tick(Duration::from_millis(200));
        Ok(bar)
    }
}

/// How many mechanisms are asked for, here or by the features that this was built with; and the
/// arguments that are the study's own.
fn extent(all: &[OsString]) -> (Extent, impl Iterator<Item = &OsString>) {
    let has = |flag: &str| all.iter().any(|argument| argument == flag);
    let extent = if cfg!(feature = "huge") || has("--huge") {
        Extent::Huge
    } else if cfg!(feature = "large") || has("--large") {
        Extent::Large
    } else {
        Extent::Few
    };
    let own = |argument: &&OsString| !["--large", "--huge"].iter().any(|flag| argument == flag);
    (extent, all.iter().filter(own))
}

/// A command as one types it.
fn shown(command: &Command) -> String {
    let words = std::iter::once("cargo".into())
        .chain(command.get_args().map(|word| word.to_string_lossy()));
    words.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::{Extent, TRADE, extent, shown};
    use std::ffi::OsString;
    use std::path::Path;

    #[test]
    fn the_build_is_that_of_the_study_beside_this_program() {
        let all = ["--large", "--problem", "all", "--help"].map(OsString::from);
        let (extent, own) = extent(&all);
        assert_eq!(own.collect::<Vec<_>>(), ["--problem", "all", "--help"]);
        // The tests may be built with `huge`.
        assert_ne!(extent, Extent::Few);
        let command = |folder| shown(&TRADE.command(Path::new(folder), Extent::Large).unwrap());
        let built = command("some/native/release");
        for part in [
            "cargo build",
            "--profile release",
            "--features trade,large",
            "--bin study-measures",
            "--target-dir some/native",
        ] {
            assert!(built.contains(part), "{built}");
        }
        assert!(command("target/debug").contains("--profile dev"));
    }
}
