//! Where a file is that a URDF names.

use std::path::{Path, PathBuf};

/// The file, or what was looked for. A package is a folder of its name in one of `folders`, or in a
/// folder that the URDF is in.
pub(super) fn find(named: &str, urdf: &Path, folders: &[PathBuf]) -> Result<PathBuf, String> {
    let within = urdf.parent().unwrap_or(Path::new(""));
    let packaged = ["package://", "model://"];
    let packaged = packaged
        .iter()
        .find_map(|scheme| named.strip_prefix(scheme));
    let Some(packaged) = packaged else {
        let file = within.join(named.strip_prefix("file://").unwrap_or(named));
        return if file.is_file() {
            Ok(file)
        } else {
            Err("there is no such file".into())
        };
    };
    let (package, rest) = packaged.split_once('/').unwrap_or((packaged, ""));
    // From the root of a file system on, wherever the URDF is named from.
    let whole = within.canonicalize().unwrap_or_else(|_| within.into());
    let around = whole.ancestors();
    let looked = folders.iter().map(PathBuf::as_path).chain(around);
    let candidates = looked.flat_map(|folder| {
        let is_package = folder.file_name().is_some_and(|name| name == package);
        let own = is_package.then(|| folder.join(rest));
        [own, Some(folder.join(packaged))]
    });
    let found = candidates.flatten().find(|file| file.is_file());
    found.ok_or_else(|| {
        format!(
            "there is no folder `{package}` with it around the URDF file; \
             `UrdfMeshes::package_folder` takes the folder that has `{package}`"
        )
    })
}
