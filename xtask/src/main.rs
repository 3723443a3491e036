//! Automation: `cargo xtask evaluate | test | page | ci | layers | figures | bless`.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "this is a program that talks to people")]

mod adapter;
mod browser;
mod layers;
mod steps;

use std::process::ExitCode;

const USAGE: &str = "cargo xtask COMMAND

  evaluate [ARGS]  build the program, install a software Vulkan driver if there is no adapter, and run
                   `umbrage evaluate ARGS`: renders, scores and writes a report
  test             the same driver check, then all tests
  page             install a headless browser if there is none, and drive the report's page in it
  ci               formatting, lints, layers, duplicate versions, documentation, all tests, the page in a browser,
                   and the gate against the committed baseline of the standard suite
  layers           check the dependency invariants of ARCHITECTURE.md
  figures          render the pictures of README and docs/techniques.md again
  screenshots [RUN] take the README's pictures of a report's page again: of the standard suite, or of a stored run
  bless            renew committed goldens (the scorecard's schema and shape)";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let outcome = match arguments.first().map(String::as_str) {
        Some("evaluate") => steps::evaluate(&arguments[1..]),
        Some("test") => steps::test(),
        Some("page") => steps::page(),
        Some("ci") => steps::ci(),
        Some("layers") => layers::check(),
        Some("figures") => steps::figures(),
        Some("screenshots") => steps::screenshots(&arguments[1..]),
        Some("bless") => steps::bless(),
        _ => Err(format!("usage: {USAGE}")),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            // The program's own exit code was passed on in the message's place by `steps`.
            ExitCode::from(steps::last_exit_code())
        }
    }
}
