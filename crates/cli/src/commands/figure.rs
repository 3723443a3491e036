//! `umbrage figure`: pictures, plots and tables for a paper, from a stored run.

use crate::args::FigureArgs;
use crate::error::CliError;
use crate::output::print;
use std::path::Path;
use std::process::{Command, Stdio};
use umbrage_report::{FigureRequest, write_figures};

pub(crate) fn run(args: &FigureArgs) -> Result<(), CliError> {
    let request = FigureRequest {
        scene: args.scene.clone(),
        path: args.path.clone(),
        variants: args.variants.clone(),
        crops: args.crops.clone(),
        times: args.times,
    };
    for file in write_figures(&args.run, &request, &args.out)? {
        print(&file.display().to_string())?;
        let animated = file.file_stem().is_some_and(|s| s.to_string_lossy().starts_with("path-"));
        if animated && let Some(video) = video(&file) {
            print(&format!("{video} (lossy: an illustration, not data)"))?;
        }
    }
    Ok(())
}

/// The same as a video, where ffmpeg is at hand.
fn video(file: &Path) -> Option<String> {
    let to = file.with_extension("mp4");
    let even = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white";
    let made = Command::new("ffmpeg")
        .args(["-y", "-loglevel", "error", "-i"])
        .arg(file)
        .args(["-vf", even, "-pix_fmt", "yuv420p", "-metadata", "comment=illustration only: lossy"])
        .arg(&to)
        .stdin(Stdio::null())
        .status();
    made.is_ok_and(|s| s.success()).then(|| to.display().to_string())
}
