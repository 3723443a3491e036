//! `umbrage report`: pages from a stored run, at any time.

use super::evaluate::layout;
use crate::args::ReportArgs;
use crate::error::CliError;
use crate::output::print;
use umbrage_report::write_report;

pub(crate) fn run(args: &ReportArgs) -> Result<(), CliError> {
    let written = write_report(&args.run, layout(args.report))?;
    for warning in &written.warnings {
        eprintln!("warning: {warning}");
    }
    print(&written.index.display().to_string())
}
