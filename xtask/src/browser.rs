//! A headless browser for the tests of the page.

use crate::adapter::install;
use crate::steps::Outcome;
use std::process::{Command, Stdio};

/// What the tests look for when `UMBRAGE_BROWSER` names nothing.
const NAMES: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// Installs Chromium when no browser is found.
pub(crate) fn ensure() -> Outcome {
    let runs = |name: &str| {
        let probe = Command::new(name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
        probe.is_ok_and(|status| status.success())
    };
    let named = std::env::var("UMBRAGE_BROWSER").is_ok_and(|name| runs(&name));
    if named || NAMES.into_iter().any(runs) {
        return Ok(());
    }
    eprintln!("no browser found: installing Chromium (or name one in UMBRAGE_BROWSER)");
    // A page without a font has no text to lay out.
    install(&["chromium", "fonts-dejavu-core"])
}
