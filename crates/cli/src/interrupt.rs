//! Ctrl-C: the work in hand is finished, what is cached stays valid, and the user is told how to
//! take up again.

use crate::error::CliError;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// Listens from now on; a second Ctrl-C ends the program at once (every file is renamed into
/// place, so that nothing half-written stays).
pub(crate) fn install() {
    let listening = ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::SeqCst) {
            std::process::exit(130);
        }
        eprintln!("\nstopping after the work in hand; Ctrl-C again stops at once");
    });
    // Without a handler Ctrl-C still ends the program, and the cache is still valid.
    drop(listening);
}

/// An error once the user has asked to stop.
pub(crate) fn check(cache: &Path) -> Result<(), CliError> {
    if ASKED.load(Ordering::SeqCst) { Err(CliError::Interrupted { cache: cache.into() }) } else { Ok(()) }
}
