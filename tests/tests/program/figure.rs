//! Figures of runs, from outside: a user's technique, another program's frames, videos where there is ffmpeg.

use std::path::Path;
use std::process::Command;
use tempfile::TempDir;
use umbrage_tests::{Ran, folder_with_scene, run, umbrage};

/// A penumbra of the user's own, noisy so that something moves.
const MINE: &str = "//! name = \"mine\"
//! title = \"mine\"
//! filter_taps = 16
fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    return filter_disc(s, fixed_radius_uv(s.depth), TAU * pattern(r.place, r.position));
}
";

/// A run of three frames with the user's technique and a built-in.
fn run_with_mine() -> TempDir {
    let folder = folder_with_scene();
    std::fs::write(folder.path().join("mine.wgsl"), MINE).expect("written");
    let line = "evaluate scene.toml --size 64x36 --frames 3 --seeds 2 --samples 16 --map 256 --reference-on cpu --cache cache \
                --out run --technique mine.wgsl --variant hard/light-matched";
    run(&mut umbrage(folder.path(), line)).ended_with(0);
    folder
}

fn figure(folder: &Path, more: &str) -> Ran {
    run(&mut umbrage(folder, &format!("figure run --out figures {more}")))
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join("figures").join(name)).expect("written")
}

/// A stored run needs no technique beside it; what the run does not have is a matter of usage.
#[test]
fn a_users_technique_is_found_in_its_run_by_name() {
    let folder = run_with_mine();
    std::fs::remove_file(folder.path().join("mine.wgsl")).expect("no longer needed");
    for name in ["mine", "mine/light-matched"] {
        figure(folder.path(), &format!("--variant {name} --variant hard --crop 8,4,16,8")).ended_with(0);
        assert!(
            read(folder.path(), "captions.txt").contains("truth; mine (light-matched); hard (light-matched)")
        );
        assert!(read(folder.path(), "scores.tex").contains("\nmine & "));
        assert!(folder.path().join("figures/swimming.pdf").is_file());
    }
    figure(folder.path(), "--variant theirs")
        .ended_with(2)
        .says("there is: hard/light-matched, mine/light-matched");
    figure(folder.path(), "--crop 60,0,8,8").ended_with(2).says("60,0,8,8").says("64x36 pixels");
    figure(folder.path(), "--scene elsewhere").ended_with(2).says("no such scene");
}

/// Frames of another program, with names that mean something to a shell, to LaTeX and to XML.
#[test]
fn frames_from_elsewhere_have_figures_too() {
    let folder = folder_with_scene();
    let line = "reference scene.toml --frames 3 --size 64x36 --samples 16 --only-v --reference-on cpu --out truth.exr";
    run(&mut umbrage(folder.path(), line)).ended_with(0);
    let line = "score --scene scene.toml --path P1 --samples 16 --reference-on cpu --cache cache --out run --channel reference.V";
    let mut score = umbrage(folder.path(), line);
    score.args(["--frames", "[a] & <b>%$x=truth.####.exr", "--frames", "\u{4e2d} \u{3bb}=truth.####.exr"]);
    run(&mut score).ended_with(0);
    figure(folder.path(), "").ended_with(0);
    let tex = read(folder.path(), "scores.tex");
    assert!(tex.contains("\n{}[a] \\& \\textless{}b\\textgreater{}\\%\\$x & "), "{tex}");
    let mut named = umbrage(folder.path(), "figure run --out figures --variant");
    run(named.arg("\u{4e2d} \u{3bb}")).ended_with(0);
    assert!(read(folder.path(), "scores.csv").contains("\n\u{4e2d} \u{3bb},"));
    assert!(read(folder.path(), "captions.txt").contains("truth; \u{4e2d} \u{3bb} (from elsewhere)"));
}

/// With ffmpeg, both animations are videos of as many frames, marked as illustrations; without it, that is said, and
/// everything else is there. The machine decides which of the two the first part sees.
#[test]
fn videos_are_made_where_there_is_ffmpeg_and_missed_where_there_is_not() {
    let folder = run_with_mine();
    let has_ffmpeg = Command::new("ffprobe").arg("-version").output().is_ok();
    let ran = figure(folder.path(), "--variant mine").ended_with(0);
    let file = |name: &str| folder.path().join("figures").join(name);
    for name in ["path-follow", "path-camera"] {
        assert!(file(&format!("{name}.png")).is_file());
        assert_eq!(file(&format!("{name}.mp4")).is_file(), has_ffmpeg, "{name}: {}", ran.stderr);
        if has_ffmpeg {
            let (frames, tags) = probed(&file(&format!("{name}.mp4")));
            assert_eq!(frames, "3", "{name}");
            assert!(tags.contains("illustration only"), "{tags}");
        }
    }
    assert_eq!(ran.stdout.matches("an illustration, not data").count(), if has_ffmpeg { 2 } else { 0 });

    let nowhere = |path: &Path| {
        let mut command = umbrage(folder.path(), "figure run --out figures --variant mine");
        run(command.env("PATH", path)).ended_with(0)
    };
    let empty = folder.path().join("empty");
    std::fs::create_dir(&empty).expect("made");
    let ran = nowhere(&empty).says("there is no ffmpeg on the PATH");
    assert_eq!(ran.stderr.matches("ffmpeg").count(), 1, "said once: {}", ran.stderr);
    assert!(file("path-follow.png").is_file() && file("captions.txt").is_file());
    assert!(!file("path-follow.mp4").exists(), "a video of an earlier run does not pass for this one's");
    assert!(!file("path-camera.mp4").exists());
    broken_ffmpeg_is_named(&empty, nowhere);
}

/// One that is there and fails: its own words.
#[cfg(unix)]
fn broken_ffmpeg_is_named(folder: &Path, figure: impl Fn(&Path) -> Ran) {
    use std::os::unix::fs::PermissionsExt as _;
    let fake = folder.join("ffmpeg");
    std::fs::write(&fake, "#!/bin/sh\necho 'Unknown encoder' >&2\nexit 1\n").expect("written");
    std::fs::set_permissions(&fake, std::fs::Permissions::from_mode(0o755)).expect("executable");
    figure(folder).says("ffmpeg: Unknown encoder");
}

#[cfg(not(unix))]
fn broken_ffmpeg_is_named(_: &Path, _: impl Fn(&Path) -> Ran) {}

/// Frames that come out of a decoder, and the file's tags.
fn probed(video: &Path) -> (String, String) {
    let ask = |entries: &str| {
        let more = ["-v", "error", "-count_frames", "-of", "default=nokey=1:noprint_wrappers=1"];
        let output = Command::new("ffprobe").args(more).args(["-show_entries", entries]).arg(video).output();
        String::from_utf8_lossy(&output.expect("ffprobe").stdout).trim().to_string()
    };
    (ask("stream=nb_read_frames"), ask("format_tags=comment"))
}
