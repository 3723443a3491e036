//! `umbrage`: scores real-time soft shadows against path-traced truth.
//!
//! Arguments become a typed plan, the plan is run, the run becomes a report. Only this crate reads
//! the environment, the clock and the terminal.
#![expect(clippy::print_stderr, reason = "this is the program that talks to people")]

mod args;
mod claims;
mod clock;
mod commands;
mod error;
mod interrupt;
mod output;
mod own;
mod progress;
mod run;
mod scenes;
mod shell;
mod suite;
mod views;

use clap::Parser as _;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = args::Arguments::parse();
    interrupt::install();
    match commands::dispatch(&arguments) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: {error}");
            if let Some(help) = error.help() {
                eprintln!("  help: {help}");
            }
            ExitCode::from(error.exit_code())
        }
    }
}
