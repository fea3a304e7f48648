//! Files that are there whole or not at all.

use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use crate::error::StudyError;

/// Writes a file in one go: into a temporary neighbour first, then renamed over `path`. A reader
/// sees the old contents or the new, never a part. Missing directories are made.
///
/// # Errors
/// [`StudyError::Write`] with the path at fault; the temporary file is gone then.
pub fn write_atomically(path: &Path, contents: &[u8]) -> Result<(), StudyError> {
    let at = |path: &Path| {
        let path = path.to_path_buf();
        move |source: io::Error| StudyError::Write { path, source }
    };
    if let Some(directory) = path.parent().filter(|d| !d.as_os_str().is_empty()) {
        fs::create_dir_all(directory).map_err(at(directory))?;
    }
    let temporary = neighbour(path);
    let written = File::create(&temporary)
        .and_then(|mut file| file.write_all(contents).and_then(|()| file.sync_all()));
    written
        .and_then(|()| fs::rename(&temporary, path))
        .map_err(|error| {
            // Best effort: the first error is the one to report.
            let _ = fs::remove_file(&temporary);
            at(path)(error)
        })
}

/// A name beside `path` that no other process uses.
fn neighbour(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(format!(".{}.partial", std::process::id()));
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::write_atomically;
    use std::fs;

    fn scratch(name: &str) -> std::path::PathBuf {
        let directory = std::env::temp_dir().join(format!("holonom-study-{}", std::process::id()));
        directory.join(name)
    }

    #[test]
    fn directories_are_made_and_contents_replaced() {
        let path = scratch("files/deep/one.txt");
        write_atomically(&path, b"first").unwrap();
        write_atomically(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        let left = fs::read_dir(path.parent().unwrap()).unwrap().count();
        assert_eq!(left, 1, "a temporary file was left behind");
    }

    #[test]
    fn an_error_names_the_path() {
        let blocker = scratch("blocker");
        write_atomically(&blocker, b"a file, no directory").unwrap();
        let error = write_atomically(&blocker.join("below.txt"), b"").unwrap_err();
        assert!(error.to_string().contains("blocker"), "{error}");
    }

    #[test]
    fn a_directory_in_the_way_is_an_error_and_leaves_nothing() {
        let path = scratch("occupied/target");
        fs::create_dir_all(&path).unwrap();
        assert!(write_atomically(&path, b"x").is_err());
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
    }
}
