//! Branches: assembly and kinematic analysis stay on the one that was described, and joints on the
//! side that is meant.

mod analysis;
mod assembly;
mod linkages;
mod sides;

use holonom_fixtures as _;
