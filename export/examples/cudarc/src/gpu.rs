//! A rollout on a GPU: compiled by NVRTC, launched by the driver, both through `cudarc`.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use cudarc::driver::{
    CudaContext, CudaFunction, CudaStream, DriverError, LaunchConfig, PushKernelArg, sys,
};
use cudarc::nvrtc::{self, CompileError, CompileOptions};

use crate::Number;

/// Threads of a block.
const BLOCK: u32 = 128;

/// Parameters, inputs or results that are not given: an address.
const NONE: u64 = 0;

/// The steps of a rollout.
#[derive(Clone, Copy)]
pub(crate) struct Plan {
    pub(crate) steps: usize,
    /// The step (s).
    pub(crate) dt: Number,
    /// States are recorded after so many steps; 0: never.
    pub(crate) every: usize,
}

/// What became of the worlds. A state is the numbers of the struct in C, in their order.
pub(crate) struct Rolled {
    /// The last state of each.
    pub(crate) ends: Vec<Vec<Number>>,
    /// The recorded states of each.
    pub(crate) results: Vec<Vec<Vec<Number>>>,
    pub(crate) taken: Vec<usize>,
    pub(crate) statuses: Vec<i32>,
    /// What the kernel took.
    pub(crate) nanoseconds: f64,
}

/// A GPU with a rollout.
pub(crate) struct Gpu {
    pub(crate) name: String,
    stream: Arc<CudaStream>,
    init: CudaFunction,
    rollout: CudaFunction,
}

/// Whether the libraries are there: `cudarc` panics where one of them is not.
pub(crate) fn is_there() -> Result<(), &'static str> {
    // SAFETY: the libraries are those of NVIDIA, whose initialisers run where they are loaded.
    let [driver, compiler] = unsafe { [sys::is_culib_present(), nvrtc::sys::is_culib_present()] };
    match (driver, compiler) {
        (true, true) => Ok(()),
        (false, _) => Err("no driver of NVIDIA was found (libcuda): this example needs a GPU"),
        (true, false) => Err("NVRTC was not found (libnvrtc): it is a part of the CUDA toolkit"),
    }
}

impl Gpu {
    /// Compiles `name_rollout.cu` of a folder for the first GPU.
    pub(crate) fn new(folder: &Path, name: &str) -> Result<Self, Box<dyn Error>> {
        let context = CudaContext::new(0)?;
        let (major, minor) = context.compute_capability()?;
        let path = folder.join(format!("{name}_rollout.cu"));
        let options = CompileOptions {
            include_paths: vec![folder.to_string_lossy().into_owned()],
            options: vec![format!("--gpu-architecture=compute_{major}{minor}")],
            name: Some(path.to_string_lossy().into_owned()),
            ..CompileOptions::default()
        };
        let compiled = nvrtc::compile_ptx_with_opts(fs::read_to_string(&path)?, options);
        let module = context.load_module(compiled.map_err(said)?)?;
        Ok(Self {
            name: context.name()?,
            stream: context.default_stream(),
            init: module.load_function(&format!("{name}_rollout_init"))?,
            rollout: module.load_function(&format!("{name}_rollout"))?,
        })
    }

    /// The start of the export, which has so many numbers.
    pub(crate) fn start(&self, numbers: usize) -> Result<Vec<Number>, DriverError> {
        let worlds = 1_usize;
        let mut states = self.stream.alloc_zeros::<Number>(numbers * worlds)?;
        let mut launch = self.stream.launch_builder(&self.init);
        launch.arg(&worlds).arg(&mut states);
        // SAFETY: the arguments are those of `ur5_rollout_init`, in their order, and the array has
        // the numbers of all worlds.
        unsafe { launch.launch(blocks(worlds)) }?;
        self.stream.clone_dtoh(&states)
    }

    /// Rolls out worlds from their states, at least one, with the inputs of the export.
    pub(crate) fn rollout(
        &self,
        starts: &[Vec<Number>],
        plan: &Plan,
    ) -> Result<Rolled, DriverError> {
        let (worlds, numbers) = (starts.len(), starts[0].len());
        let Plan { steps, dt, every } = *plan;
        // Number `k` of world `w` is at `[k * worlds + w]`.
        let across: Vec<Number> = (0..numbers)
            .flat_map(|k| starts.iter().map(move |start| start[k]))
            .collect();
        let records = steps.checked_div(every).unwrap_or(0);
        let stream = &self.stream;
        let mut states = stream.clone_htod(&across)?;
        // An array has at least one number; without records none of it is written.
        let mut results = stream.alloc_zeros::<Number>((records * across.len()).max(1))?;
        let mut taken = stream.alloc_zeros::<usize>(worlds)?;
        let mut statuses = stream.alloc_zeros::<i32>(worlds)?;
        let mut launch = stream.launch_builder(&self.rollout);
        launch.arg(&worlds).arg(&steps).arg(&dt);
        // Parameters, inputs, and for how many steps a set of inputs is held.
        launch.arg(&NONE).arg(&NONE).arg(&NONE);
        launch.arg(&mut states).arg(&every).arg(&mut results);
        launch.arg(&mut taken).arg(&mut statuses);
        launch.record_kernel_launch(sys::CUevent_flags::CU_EVENT_DEFAULT);
        // SAFETY: the arguments are those of `ur5_rollout`, in their order: `size_t` is `usize` on
        // both sides, `ur5_real` is `Number`. The arrays have the lengths that the head of
        // `ur5_rollout.cu` names.
        let events = unsafe { launch.launch(blocks(worlds)) }?;
        let milliseconds = match events {
            Some((begin, end)) => begin.elapsed_ms(&end)?,
            None => f32::NAN,
        };
        let (ends, results) = (stream.clone_dtoh(&states)?, stream.clone_dtoh(&results)?);
        let of_world = |all: &[Number], world: usize| {
            let numbers = all.chunks_exact(worlds).map(|number| number[world]);
            numbers.collect::<Vec<_>>()
        };
        let recorded = |world| {
            let records = results[..records * across.len()].chunks_exact(across.len());
            records.map(|record| of_world(record, world)).collect()
        };
        Ok(Rolled {
            ends: (0..worlds).map(|world| of_world(&ends, world)).collect(),
            results: (0..worlds).map(recorded).collect(),
            taken: stream.clone_dtoh(&taken)?,
            statuses: stream.clone_dtoh(&statuses)?,
            nanoseconds: 1e6 * f64::from(milliseconds),
        })
    }
}

/// A thread for each world.
fn blocks(worlds: usize) -> LaunchConfig {
    let blocks = worlds.div_ceil(BLOCK as usize);
    LaunchConfig {
        grid_dim: (u32::try_from(blocks).unwrap_or(u32::MAX), 1, 1),
        block_dim: (BLOCK, 1, 1),
        shared_mem_bytes: 0,
    }
}

/// What a compiler says, as it says it.
fn said(error: CompileError) -> Box<dyn Error> {
    match error {
        CompileError::CompileError { log, .. } => log.to_string_lossy().into(),
        error => error.into(),
    }
}
