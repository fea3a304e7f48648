//! Writes a UR5 with its rollout and derivatives into a folder: `ur5.h`, `ur5.c` and
//! `ur5_rollout.cu`, which `rollout.py` beside this file runs on a GPU. Its numbers are `float`, or
//! `double` where that word stands behind the folder.

use holonom::mechanism::Relative;
use holonom::prelude::*;
use holonom_export::{Double, Export, ExportError, Precision, Single};
use holonom_models::Ur5;

fn write<P: Precision>(folder: &str) -> Result<(), ExportError> {
    let export = Export::<_, P, Relative>::new(&Ur5::default(), StandardLagrange);
    export.step(Rk4).joint_derivatives().write_cuda(folder)
}

fn main() -> Result<(), ExportError> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let folder = arguments.first().map_or(".", String::as_str);
    if arguments.get(1).is_some_and(|numbers| numbers == "double") {
        write::<Double>(folder)
    } else {
        write::<Single>(folder)
    }
}
