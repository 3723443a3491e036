//! Standard output. A reader that has seen enough (`| head`) is no failure; a full disk is.

use crate::error::CliError;
use std::io::{ErrorKind, Write as _};

/// Prints a line, or several.
pub(crate) fn print(text: &str) -> Result<(), CliError> {
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{text}").and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(CliError::file("standard output")(error)),
        _ => Ok(()),
    }
}
