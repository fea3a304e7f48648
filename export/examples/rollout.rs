//! Writes a UR5 and its rollout into a folder: `ur5.h`, `ur5.c` and `ur5_rollout.cu`, which
//! `rollout.py` beside this file runs on a GPU.

use holonom::mechanism::Relative;
use holonom::prelude::*;
use holonom_export::{Export, ExportError, Single};
use holonom_models::Ur5;

fn main() -> Result<(), ExportError> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".to_owned());
    let export = Export::<_, Single, Relative>::new(&Ur5::default(), StandardLagrange);
    export.step(Rk4).write_cuda(folder)
}
