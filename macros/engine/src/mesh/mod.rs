//! Surfaces of triangles: read from files, judged, and integrated over what they enclose. Of syntax
//! it knows nothing.
//!
//! - `read.rs`: files; `surface.rs`: whether they enclose anything; `overlap.rs`: whether they
//!   enclose it once; `bulk.rs`: volume, centre and second moments.

mod bulk;
mod overlap;
mod read;
mod surface;

use std::path::Path;

pub use self::bulk::Bulk;

/// What the surface in a file encloses, in the coordinates of the file. Else why it encloses
/// nothing of which that could be said.
///
/// # Errors
/// A sentence without a subject, as in "has no triangles".
pub fn enclosed(file: &Path) -> Result<Bulk, String> {
    of_triangles(&read::triangles(file)?)
}

/// The same of triangles, three corners each, seen anticlockwise from outside.
///
/// # Errors
/// As those of [`enclosed`].
pub fn of_triangles(triangles: &[[[f64; 3]; 3]]) -> Result<Bulk, String> {
    let surface = surface::Surface::new(triangles)?;
    let bulk = Bulk::new(&surface);
    let numbers = bulk.tensor.iter().flatten().chain(&bulk.centre);
    if !bulk.volume.is_normal() || numbers.into_iter().any(|number| !number.is_finite()) {
        return Err("encloses no volume that is a number".into());
    }
    if bulk.volume < 0.0 {
        let message = "is inside out: the corners of its triangles are seen clockwise from outside";
        return Err(message.into());
    }
    overlap::judge(&surface)?;
    Ok(bulk)
}
