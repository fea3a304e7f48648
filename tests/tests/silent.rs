//! What a user would not see: springs that pass their anchor, steps that are too long, closures
//! with a memory, what the elements of a joint state are.

#[path = "silent/closures.rs"]
mod closures;
#[path = "silent/kept.rs"]
mod kept;
#[path = "silent/moments.rs"]
mod moments;
#[path = "silent/report.rs"]
mod report;
#[path = "silent/springs.rs"]
mod springs;

use holonom_fixtures as _;
