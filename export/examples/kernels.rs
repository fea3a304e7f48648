//! Writes rollouts of a UR5 and of a four-bar by their joints, in both precisions, into a folder:
//! what `.ci/ptx` compiles for a GPU.

use holonom::mechanism::{Relative, TracedCoordinates};
use holonom::prelude::*;
use holonom_export::{Double, Export, ExportError, Precision, Single};
use holonom_models::{FourBar, Ur5};

fn write<P: Precision, M: Mechanism>(
    mechanism: &M,
    name: &str,
    folder: &str,
) -> Result<(), ExportError>
where
    Relative: TracedCoordinates<M>,
{
    let export = Export::<M, P, Relative>::new(mechanism, StandardLagrange);
    export.named(name).step(Rk4).write_cuda(folder)
}

fn main() -> Result<(), ExportError> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".to_owned());
    let (arm, bars) = (Ur5::default(), FourBar::default());
    write::<Double, _>(&arm, "ur5_double", &folder)?;
    write::<Single, _>(&arm, "ur5_float", &folder)?;
    write::<Double, _>(&bars, "four_bar_double", &folder)?;
    write::<Single, _>(&bars, "four_bar_float", &folder)
}
