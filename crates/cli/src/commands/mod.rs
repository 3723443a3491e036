//! One file a command.

mod claims;
mod evaluate;
mod gate;
mod list;
mod reference;
mod render;
mod report;

use crate::args::{Arguments, Command, GpuArgs};
use crate::error::CliError;
use std::process::ExitCode;
use umbrage_shadows::{AdapterChoice, Gpu};

/// Runs the command that was asked for.
pub(crate) fn dispatch(arguments: &Arguments) -> Result<ExitCode, CliError> {
    match &arguments.command {
        Command::Evaluate(args) => evaluate::run(args),
        Command::Compare(args) => gate::compare_runs(args),
        Command::Accept(args) => gate::accept(args),
        Command::Claims(args) => claims::run(args),
        Command::Reference(args) => reference::run(args),
        Command::Render(args) => render::run(args),
        Command::Report(args) => report::run(args),
        Command::List(args) => list::run(args),
    }
    .map(|()| ExitCode::SUCCESS)
}

/// The adapter that the flags (or wgpu's own variables) name.
fn open_gpu(wanted: &GpuArgs) -> Result<Gpu, CliError> {
    let choice = AdapterChoice { name: wanted.adapter.clone(), backend: wanted.backend.clone() };
    Ok(Gpu::new(&choice)?)
}
