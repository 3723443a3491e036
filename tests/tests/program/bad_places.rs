//! Disks that are read-only or full, and machines without a graphics adapter.

use std::path::Path;
use umbrage_tests::{Ran, empty_folder, files_below, folder_with_scene, run, umbrage};

const SMALL: &str = "evaluate scene.toml --variant hard --size 64x36 --frames 2 --seeds 2 --samples 16 --map 64 --cache cache";

fn evaluate(folder: &Path, flags: &str) -> Ran {
    run(&mut umbrage(folder, &format!("{SMALL} {flags}")))
}

#[test]
fn folders_that_are_files() {
    let folder = folder_with_scene();
    std::fs::write(folder.path().join("file"), "mine").expect("written");
    evaluate(folder.path(), "--out file").ended_with(4).says("file");
    evaluate(folder.path(), "--out file/deeper").ended_with(4).says("file/deeper");
    let line = SMALL.replace("--cache cache", "--cache file --out run");
    run(&mut umbrage(folder.path(), &line)).ended_with(4).says("file").says("cache");
    let render = "render scene.toml --variant hard --size 8x8 --map 16 --out file";
    run(&mut umbrage(folder.path(), render)).ended_with(4).says("file");
    let reference = "reference scene.toml --size 8x8 --samples 1 --out file/truth.exr";
    run(&mut umbrage(folder.path(), reference)).ended_with(4).says("file/truth.exr");
    assert_eq!(std::fs::read(folder.path().join("file")).expect("read"), b"mine", "nothing was overwritten");
}

#[test]
fn no_adapter_says_how_to_install_one() {
    let folder = folder_with_scene();
    for command in [&format!("{SMALL} --out run"), "render scene.toml --variant hard --out frames"] {
        // The loader's two names for "only these drivers".
        let mut command = umbrage(folder.path(), command);
        command.env("VK_DRIVER_FILES", "/nonexistent.json").env("VK_ICD_FILENAMES", "/nonexistent.json");
        run(&mut command)
            .ended_with(4)
            .says("no graphics adapter")
            .says("apt-get install mesa-vulkan-drivers");
    }
    assert!(!folder.path().join("run").exists(), "found out before a run is begun");
}

#[test]
fn an_unknown_adapter_names_those_that_exist() {
    let folder = folder_with_scene();
    let listed = run(&mut umbrage(folder.path(), "list adapters --json")).ended_with(0).stdout;
    let listed: serde_json::Value = serde_json::from_str(&listed).expect("JSON");
    let name = listed[0]["adapter"].as_str().expect("an adapter: install mesa-vulkan-drivers").to_string();
    let ran = evaluate(folder.path(), "--out run --adapter Voodoo2").ended_with(4);
    ran.says("no graphics adapter named \"Voodoo2\"").says(&name);
    // Any part of a name is enough, in any case.
    let part: String = name.split_whitespace().next().expect("a word").to_uppercase();
    evaluate(folder.path(), &format!("--out run --adapter {part}")).ended_with(0).says(&name);
}

#[cfg(target_os = "linux")]
mod unix {
    use super::*;
    use std::os::unix::fs::{MetadataExt as _, PermissionsExt as _};
    use std::os::unix::process::CommandExt as _;
    use std::process::{Command, Stdio};

    fn set_mode(path: &Path, mode: u32) {
        std::fs::set_permissions(path, std::fs::Permissions::from_mode(mode)).expect("permissions");
    }

    /// Runs the program as somebody whom permissions bind: they do not bind root, so root hands it
    /// to nobody (65534).
    fn run_bound(folder: &Path, line: &str) -> Ran {
        let program = folder.join("umbrage-copy");
        std::fs::copy(umbrage_tests::program(), &program).expect("copied");
        set_mode(&program, 0o755);
        set_mode(folder, 0o755);
        let runtime = folder.join("runtime");
        std::fs::create_dir_all(&runtime).expect("made");
        set_mode(&runtime, 0o777);
        let mut command = Command::new(program);
        command.args(line.split_whitespace()).current_dir(folder);
        command.env("XDG_RUNTIME_DIR", &runtime).env("HOME", &runtime);
        if std::fs::metadata("/proc/self").expect("procfs").uid() == 0 {
            command.uid(65534);
        }
        run(&mut command)
    }

    #[test]
    fn a_read_only_output_folder() {
        let folder = folder_with_scene();
        for (name, mode) in [("locked", 0o555), ("open", 0o777)] {
            std::fs::create_dir(folder.path().join(name)).expect("made");
            set_mode(&folder.path().join(name), mode);
        }
        let line = SMALL.replace("--cache cache", "--cache open/cache --out locked/run");
        run_bound(folder.path(), &line).ended_with(4).says("locked/run").says("Permission denied");
        let render = "render scene.toml --variant hard --size 8x8 --map 16 --out locked/frames";
        run_bound(folder.path(), render).ended_with(4).says("locked/frames").says("Permission denied");
        let reference = "reference scene.toml --size 8x8 --samples 1 --out locked/truth.exr";
        run_bound(folder.path(), reference).ended_with(4).says("locked/truth.exr").says("Permission denied");
        assert!(files_below(&folder.path().join("locked")).is_empty(), "nothing is left behind");
        set_mode(&folder.path().join("locked"), 0o755);
    }

    /// A cache that takes nothing costs time, never a result; the user is told.
    #[test]
    fn a_cache_that_takes_nothing() {
        let folder = folder_with_scene();
        let open = folder.path().join("open");
        std::fs::create_dir(&open).expect("made");
        set_mode(&open, 0o777);
        for locked in ["open/cache/truth/tmp", "open/cache/units"] {
            std::fs::create_dir_all(folder.path().join(locked)).expect("made");
            set_mode(&folder.path().join(locked), 0o555);
        }
        let line = SMALL.replace("--cache cache", "--cache open/cache --out open/run");
        run_bound(folder.path(), &line).ended_with(0).says("could not be cached").says("Permission denied");
        evaluate(folder.path(), "--out other").ended_with(0);
        let scores = |run: &str| std::fs::read(folder.path().join(run).join("scores.csv")).expect("scores");
        assert_eq!(scores("open/run"), scores("other"), "the cache does not change a score");
    }

    /// A file may hold no more than `blocks` of 512 bytes: the same failing writes as on a full disk,
    /// for anybody, on any file system. The signal that comes with them is ignored.
    fn run_limited(folder: &Path, blocks: u32, line: &str) -> Ran {
        let program = umbrage_tests::program();
        let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec {} {line}", program.display());
        let mut shell = Command::new("sh");
        run(shell.args(["-c", &script]).current_dir(folder).env("XDG_RUNTIME_DIR", folder))
    }

    #[test]
    fn a_full_disk() {
        let folder = folder_with_scene();
        // Nothing at all, a small picture, the pictures but not the page.
        for blocks in [0, 2, 16, 100] {
            let ran = run_limited(folder.path(), blocks, &format!("{SMALL} --out run")).ended_with(4);
            ran.says("run/").says("File too large");
            let halves: Vec<_> = files_below(folder.path())
                .into_iter()
                .filter(|path| path.to_string_lossy().ends_with(".tmp"))
                .collect();
            assert!(halves.is_empty(), "{blocks} blocks: half files are left: {halves:?}");
        }
        for line in [
            "render scene.toml --variant hard --size 64x36 --map 64 --out frames",
            "reference scene.toml --size 64x36 --samples 16 --out truth.exr",
        ] {
            run_limited(folder.path(), 1, line).ended_with(4).says(".exr").says("File too large");
        }
        // What was cached before the disk was full is whole, and serves.
        evaluate(folder.path(), "--out run").ended_with(0);
    }

    #[test]
    fn a_full_disk_under_standard_output() {
        let folder = empty_folder();
        let full = || Stdio::from(std::fs::File::create("/dev/full").expect("/dev/full"));
        for line in ["list metrics", "list metrics --json"] {
            let child = umbrage(folder.path(), line).stdout(full()).stderr(Stdio::piped()).spawn();
            let output = child.expect("started").wait_with_output().expect("ended");
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            let ran = Ran { code: output.status.code(), stdout: String::new(), stderr: said };
            ran.ended_with(4).says("standard output").says("No space left");
        }
    }
}
