//! One file a command.

mod claims;
mod evaluate;
mod figure;
mod gate;
mod list;
mod reference;
mod render;
mod report;
mod score;

use crate::args::{Arguments, Command, GpuArgs, ReferenceOn};
use crate::error::CliError;
use std::process::ExitCode;
use umbrage_reference::{DeviceError, ReferenceError, TruthGpu};
use umbrage_scene::Scene;
use umbrage_shadows::{AdapterChoice, Gpu};

/// Runs the command that was asked for.
pub(crate) fn dispatch(arguments: &Arguments) -> Result<ExitCode, CliError> {
    match &arguments.command {
        Command::Evaluate(args) => evaluate::run(args),
        Command::Score(args) => score::run(args),
        Command::Compare(args) => gate::compare_runs(args),
        Command::Accept(args) => gate::accept(args),
        Command::Claims(args) => claims::run(args),
        Command::Reference(args) => reference::run(args),
        Command::Render(args) => render::run(args),
        Command::Report(args) => report::run(args),
        Command::Figure(args) => figure::run(args),
        Command::List(args) => list::run(args),
    }
    .map(|()| ExitCode::SUCCESS)
}

/// The adapter that the flags (or wgpu's own variables) name.
fn open_gpu(wanted: &GpuArgs) -> Result<Gpu, CliError> {
    Ok(Gpu::new(&choice(wanted))?)
}

/// The device that finds truth, if one does; says which. Separate from the pipeline's: the witnesses
/// share nothing but the card.
fn open_truth_gpu(on: ReferenceOn, wanted: &GpuArgs) -> Result<Option<TruthGpu>, CliError> {
    if on == ReferenceOn::Cpu {
        return Ok(None);
    }
    let gpu = match (on, TruthGpu::open(&choice(wanted))) {
        (ReferenceOn::Auto, Ok(gpu)) => Some(gpu).filter(|gpu| !gpu.description().is_software()),
        // Whether what was asked for exists is not the machine's to say.
        (ReferenceOn::Auto, Err(ReferenceError::Device(error @ DeviceError::UnknownBackend { .. }))) => {
            return Err(ReferenceError::Device(error).into());
        }
        (ReferenceOn::Auto, Err(error)) => {
            eprintln!("truth on: CPU (no GPU for it: {error})");
            None
        }
        (_, opened) => Some(opened?),
    };
    if let Some(adapter) = gpu.as_ref().map(TruthGpu::description) {
        let note = if adapter.is_software() { "software: slower than --reference-on cpu" } else { "GPU" };
        eprintln!("truth on: {} ({note})", adapter.name);
    }
    Ok(gpu)
}

/// The GPU's kernels know no masks: `auto` takes the CPU for such a scene, `gpu` is refused.
fn check_masks<'a>(on: ReferenceOn, scenes: impl IntoIterator<Item = &'a Scene>) -> Result<(), CliError> {
    let cut_out = scenes.into_iter().find(|scene| on == ReferenceOn::Gpu && scene.has_masks());
    cut_out.map_or(Ok(()), |scene| {
        Err(CliError::Usage(format!(
            "--reference-on gpu: {} has cut-out materials, which the GPU's truth does not know\n  \
             help: take --reference-on auto or cpu",
            scene.name
        )))
    })
}

fn choice(wanted: &GpuArgs) -> AdapterChoice {
    AdapterChoice { name: wanted.adapter.clone(), backend: wanted.backend.clone() }
}
