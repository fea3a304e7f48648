//! What was measured so far, on disk: an interrupted study goes on where it was.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::StudyError;

/// Entries on disk, a line of JSON each behind a line that says under which conditions they were
/// measured.
#[derive(Debug)]
pub struct Journal<T> {
    path: PathBuf,
    file: File,
    entries: Vec<T>,
}

impl<T: Serialize + DeserializeOwned> Journal<T> {
    /// Opens a journal, with the entries that an interrupted study has left there under the same
    /// conditions; those of others are dropped. A line that was not finished counts as not written.
    ///
    /// # Errors
    /// [`StudyError::Write`] where the file cannot be written.
    pub fn open(path: &Path, conditions: &str) -> Result<Self, StudyError> {
        let at = |source: io::Error| StudyError::Write {
            path: path.into(),
            source,
        };
        let left = fs::read_to_string(path).unwrap_or_default();
        let mut lines = left.lines();
        let mut entries = Vec::new();
        if lines.next() == Some(conditions) {
            entries.extend(lines.map_while(|line| serde_json::from_str(line).ok()));
        }
        if let Some(directory) = path.parent().filter(|d| !d.as_os_str().is_empty()) {
            fs::create_dir_all(directory).map_err(at)?;
        }
        // Written anew, so that a line that was cut short does not stand before those to come.
        let mut text = format!("{conditions}\n");
        for entry in &entries {
            text.push_str(&serde_json::to_string(entry)?);
            text.push('\n');
        }
        crate::files::write_atomically(path, text.as_bytes())?;
        let file = OpenOptions::new().append(true).open(path).map_err(at)?;
        Ok(Self {
            path: path.into(),
            file,
            entries,
        })
    }

    /// What there is.
    #[must_use]
    pub fn entries(&self) -> &[T] {
        &self.entries
    }

    /// Adds an entry.
    ///
    /// # Errors
    /// [`StudyError::Write`] where it cannot be written.
    pub fn add(&mut self, entry: T) -> Result<(), StudyError> {
        let mut line = serde_json::to_string(&entry)?;
        line.push('\n');
        let written = self.file.write_all(line.as_bytes());
        written.map_err(|source| StudyError::Write {
            path: self.path.clone(),
            source,
        })?;
        self.entries.push(entry);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Journal;
    use std::fs;

    #[test]
    fn an_interrupted_study_goes_on() {
        let directory =
            std::env::temp_dir().join(format!("holonom-journal-{}", std::process::id()));
        let path = directory.join("a/journal");
        let mut journal = Journal::open(&path, "here").unwrap();
        journal.add(1).unwrap();
        journal.add(2).unwrap();
        drop(journal);
        // Cut in the middle of a line.
        let mut text = fs::read_to_string(&path).unwrap();
        text.push_str("{\"not");
        fs::write(&path, text).unwrap();
        let mut journal = Journal::<u32>::open(&path, "here").unwrap();
        assert_eq!(journal.entries(), [1, 2]);
        journal.add(3).unwrap();
        drop(journal);
        let journal = Journal::<u32>::open(&path, "here").unwrap();
        assert_eq!(journal.entries(), [1, 2, 3]);
        drop(journal);
        let journal = Journal::<u32>::open(&path, "elsewhere").unwrap();
        assert_eq!(journal.entries(), [0; 0]);
        fs::remove_dir_all(&directory).unwrap();
    }
}
