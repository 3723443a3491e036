//! `umbrage figure`: pictures, plots and tables for a paper, from a stored run.

use crate::args::FigureArgs;
use crate::error::CliError;
use crate::output::print;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
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
    let files = write_figures(&args.run, &request, &args.out)?;
    files.iter().try_for_each(|file| print(&file.display().to_string()))?;
    let is_animated = |file: &&PathBuf| {
        file.extension().is_some_and(|e| e == "png")
            && file.file_stem().is_some_and(|s| s.to_string_lossy().starts_with("path-"))
    };
    let animated: Vec<&PathBuf> = files.iter().filter(is_animated).collect();
    // Videos of an earlier run must not pass for this one's.
    for file in &animated {
        let _ = std::fs::remove_file(file.with_extension("mp4"));
    }
    for file in animated {
        match video(file) {
            Ok(video) => print(&format!("{} (lossy: an illustration, not data)", video.display()))?,
            Err(NoVideo::NoProgram) => {
                eprintln!(
                    "note: there is no ffmpeg on the PATH: the animations are APNG, and not MP4 as well"
                );
                break;
            }
            Err(NoVideo::Failed(reason)) => eprintln!("note: no MP4 of {}: ffmpeg: {reason}", file.display()),
        }
    }
    Ok(())
}

enum NoVideo {
    NoProgram,
    Failed(String),
}

/// The same as a video.
fn video(file: &Path) -> Result<PathBuf, NoVideo> {
    let to = file.with_extension("mp4");
    // Its colours have half the resolution, which has to be whole; players know no other kind.
    let even = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white";
    let made = Command::new("ffmpeg")
        .args(["-y", "-loglevel", "error", "-i"])
        .arg(file)
        .args(["-vf", even, "-pix_fmt", "yuv420p", "-movflags", "+faststart"])
        .args([
            "-metadata",
            "title=Illustration: lossy, not data",
            "-metadata",
            "comment=illustration only: lossy",
        ])
        .arg(&to)
        .stdin(Stdio::null())
        .output();
    match made {
        Ok(output) if output.status.success() => Ok(to),
        Ok(output) => {
            // Half a video must not pass for a whole one.
            let _ = std::fs::remove_file(&to);
            let said = String::from_utf8_lossy(&output.stderr);
            let last = said.lines().rfind(|line| !line.trim().is_empty()).unwrap_or("it failed");
            Err(NoVideo::Failed(last.trim().to_string()))
        }
        Err(e) if e.kind() == ErrorKind::NotFound => Err(NoVideo::NoProgram),
        Err(e) => Err(NoVideo::Failed(e.to_string())),
    }
}
