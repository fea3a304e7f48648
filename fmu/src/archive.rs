//! The archive that a unit is.

use std::io::{Seek, Write};

use zip::write::{SimpleFileOptions, ZipWriter};

use crate::error::FmuError;

/// A file by its path.
pub(crate) type Entry = (String, Vec<u8>);

/// Files, written one behind the other; the same bytes for the same files.
pub(crate) fn write(
    to: impl Write + Seek,
    files: impl IntoIterator<Item = Entry>,
) -> Result<(), FmuError> {
    let mut archive = ZipWriter::new(to);
    for (path, bytes) in files {
        archive.start_file(path, SimpleFileOptions::default())?;
        archive.write_all(&bytes)?;
    }
    archive.finish()?.flush()?;
    Ok(())
}
