//! Writes a made-up run and its page, to look at the page without a renderer:
//! `cargo run -p umbrage-report --example fixture -- FOLDER [software]`.

#[path = "../tests/fixture/mod.rs"]
mod fixture;

use std::path::PathBuf;
use umbrage_report::{Layout, write_report};

#[expect(clippy::print_stdout, reason = "an example talks to whoever runs it")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().ok_or("usage: fixture FOLDER [software]")?);
    let device = match arguments.next().as_deref() {
        Some("software") => fixture::Device::Software,
        _ => fixture::Device::Gpu,
    };
    fixture::write(&folder, device, (480, 270))?;
    let written = write_report(&folder, Layout::SingleFile)?;
    println!("{}: {} bytes", written.index.display(), written.index_bytes);
    for warning in written.warnings {
        println!("warning: {warning}");
    }
    Ok(())
}
