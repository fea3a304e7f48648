//! The program compiled for WebAssembly, by the cargo that started it.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fs};

use crate::error::LiveError;

const TARGET: &str = "wasm32-unknown-unknown";
/// The first bytes of a module: its name and version.
const HEAD: &[u8] = b"\0asm\x01\0\0\0";
/// A function of the border.
const EXPORTED: &[u8] = b"holonom_advance";

/// Which target of a package a program is, and in which profile it was compiled.
#[derive(Debug, PartialEq, Eq)]
struct Origin {
    /// `--bin` or `--example`.
    kind: &'static str,
    name: String,
    profile: String,
}

impl Origin {
    /// From the path of the program, `target/release/examples/arm`.
    fn of(program: &Path) -> Option<Self> {
        let name = program.file_stem()?.to_str()?.to_owned();
        let mut folder = program.parent()?;
        let is_example = folder.ends_with("examples");
        if is_example {
            folder = folder.parent()?;
        }
        let profile = match folder.file_name()?.to_str()? {
            "debug" => "dev",
            other => other,
        };
        Some(Self {
            kind: if is_example { "--example" } else { "--bin" },
            name,
            profile: profile.to_owned(),
        })
    }
}

/// Compiles this program for WebAssembly, and reads the module.
pub(crate) fn built() -> Result<Vec<u8>, LiveError> {
    let manifest = env::var_os("CARGO_MANIFEST_DIR").ok_or(LiveError::NotByCargo)?;
    let program = env::current_exe().ok();
    let origin = program.as_deref().and_then(Origin::of);
    let origin = origin.ok_or(LiveError::NotByCargo)?;
    let cargo = env::var_os("CARGO").unwrap_or("cargo".into());
    let mut command = Command::new(cargo);
    command
        .args(["build", "--target", TARGET, "--profile", &origin.profile])
        .args([origin.kind, &origin.name])
        .arg("--manifest-path")
        .arg(Path::new(&manifest).join("Cargo.toml"))
        .arg("--message-format=json-render-diagnostics")
        // Those of the machine that compiles.
        .env_remove("RUSTFLAGS")
        .stderr(Stdio::inherit());
    let words = [command.get_program()]
        .into_iter()
        .chain(command.get_args());
    let words: Vec<_> = words.map(|word| word.to_string_lossy()).collect();
    let words = words.join(" ");
    let failed = |reason: Option<String>| LiveError::Build {
        command: words.clone(),
        reason,
    };
    let output = command.output();
    let output = output.map_err(|error| failed(Some(error.to_string())))?;
    if !output.status.success() {
        return Err(failed(None));
    }
    let messages = String::from_utf8_lossy(&output.stdout);
    let file = artifact(&messages, &origin.name);
    let file = file.ok_or_else(|| failed(Some("it names no module".to_owned())))?;
    fs::read(&file).map_err(|error| failed(Some(format!("{}: {error}", file.display()))))
}

/// The module among the messages of cargo, one a line.
fn artifact(messages: &str, name: &str) -> Option<PathBuf> {
    let ending = format!("{name}.wasm\"");
    let mut lines = messages.lines().rev();
    let line = lines.find(|line| line.contains("compiler-artifact") && line.contains(&ending))?;
    let (before, _) = line.split_once(&ending)?;
    let (_, folder) = before.rsplit_once('"')?;
    let folder = folder.replace("\\\\", "\\");
    Some(PathBuf::from(format!("{folder}{name}.wasm")))
}

/// The module without names and debug information; `None` where it is none of this crate.
pub(crate) fn stripped(module: &[u8]) -> Option<Vec<u8>> {
    let mut left = module.strip_prefix(HEAD)?;
    let mut kept = HEAD.to_vec();
    while let [kind, rest @ ..] = left {
        let (length, rest) = number(rest)?;
        let section = rest.get(..length)?;
        let all = left.len() - rest.len() + length;
        // Custom sections have the number 0.
        if *kind != 0 {
            kept.extend(&left[..all]);
        }
        left = &rest[section.len()..];
    }
    let is_ours = kept.windows(EXPORTED.len()).any(|part| part == EXPORTED);
    is_ours.then_some(kept)
}

/// A number of variable length (LEB128), and what is behind it.
fn number(bytes: &[u8]) -> Option<(usize, &[u8])> {
    let mut value = 0_usize;
    for (place, &byte) in bytes.iter().take(5).enumerate() {
        value |= usize::from(byte & 0x7f) << (7 * place);
        if byte < 0x80 {
            return Some((value, &bytes[place + 1..]));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use super::{HEAD, Origin, artifact, stripped};

    fn section(kind: u8, content: &[u8]) -> Vec<u8> {
        let length = content.len();
        // In two bytes, as linkers leave room.
        let length = [(length & 0x7f) as u8 | 0x80, (length >> 7) as u8];
        [&[kind], &length[..], content].concat()
    }

    #[test]
    fn sections_but_custom_ones_are_kept() {
        let exports = section(7, &[b"holonom_advance", &[1; 200][..]].concat());
        let names = section(0, &[b'n'; 300]);
        let module = [HEAD, &names, &exports, &names].concat();
        assert_eq!(stripped(&module), Some([HEAD, &exports].concat()));
        assert_eq!(
            stripped(&[HEAD, &names].concat()),
            None,
            "of another program"
        );
        assert_eq!(stripped(&module[..module.len() - 1]), None, "cut off");
        assert_eq!(stripped(b"no module"), None);
    }

    #[test]
    fn a_program_is_found_by_its_path() {
        let origin = |path: &str| Origin::of(Path::new(path)).expect("a path");
        let wanted = |kind, profile: &str| Origin {
            kind,
            name: "arm".into(),
            profile: profile.into(),
        };
        assert_eq!(origin("t/debug/arm"), wanted("--bin", "dev"));
        assert_eq!(
            origin("t/release/examples/arm"),
            wanted("--example", "release")
        );
        assert_eq!(
            origin("t/x86_64-linux/fast/arm.exe"),
            wanted("--bin", "fast")
        );
    }

    #[test]
    fn the_module_is_found_among_the_messages() {
        let messages = concat!(
            r#"{"reason":"compiler-artifact","filenames":["/t/deps/libx.rlib"],"executable":null}"#,
            "\n",
            r#"{"reason":"compiler-artifact","filenames":["/t/wasm32/arm.wasm"],"executable":"/t/wasm32/arm.wasm"}"#,
            "\n",
            r#"{"reason":"build-finished","success":true}"#,
        );
        assert_eq!(
            artifact(messages, "arm"),
            Some(PathBuf::from("/t/wasm32/arm.wasm"))
        );
        let windows = messages.replace("/t/wasm32/", r"C:\\t\\");
        assert_eq!(
            artifact(&windows, "arm"),
            Some(PathBuf::from(r"C:\t\arm.wasm"))
        );
        assert_eq!(artifact(messages, "leg"), None);
    }
}
