//! The shared library of the platform on which a unit is written.

use std::env::{consts, temp_dir, var};
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::{fs, process};

use crate::archive::Entry;
use crate::error::FmuError;

/// With what a compiler such as that of GNU is called.
pub(crate) const OPTIONS: [&str; 5] = [
    "-std=c99",
    "-O2",
    "-fPIC",
    "-fvisibility=hidden",
    // Rounds as Rust does.
    "-ffp-contract=off",
];

/// The platform as the standard names it, such as `x86_64-linux`.
fn platform() -> String {
    let system = match consts::OS {
        "macos" => "darwin",
        other => other,
    };
    format!("{}-{system}", consts::ARCH)
}

/// A folder that is removed with everything in it.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Result<Self, Error> {
        static NUMBER: AtomicUsize = AtomicUsize::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let path = temp_dir().join(format!("holonom-fmu-{}-{number}", process::id()));
        fs::create_dir_all(&path)?;
        Ok(Self(path))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What stays is in a folder for what may be removed.
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// The platform, and the library for it. `None` where there is no compiler of C.
pub(crate) fn compiled(name: &str, files: &[Entry]) -> Result<Option<(String, Vec<u8>)>, FmuError> {
    let folder = Folder::new()?;
    for (file, text) in files {
        fs::write(folder.0.join(file), text)?;
    }
    let library = folder.0.join(format!("{name}{}", consts::DLL_SUFFIX));
    let sources = files.iter().map(|(file, _)| Path::new(file));
    let sources = sources.filter(|file| file.extension().is_some_and(|kind| kind == "c"));
    let compiler = var("CC").unwrap_or_else(|_| "cc".to_owned());
    let mut words = compiler.split_whitespace();
    let mut command = Command::new(words.next().unwrap_or("cc"));
    command.args(words).args(OPTIONS).arg("-shared");
    command.current_dir(&folder.0).args(sources);
    let done = match command.arg("-o").arg(&library).arg("-lm").output() {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        done => done?,
    };
    if !done.status.success() {
        return Err(FmuError::Compiler {
            command: compiler,
            message: String::from_utf8_lossy(&done.stderr).into_owned(),
        });
    }
    Ok(Some((platform(), fs::read(&library)?)))
}
