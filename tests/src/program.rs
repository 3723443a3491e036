//! Running the program.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The program that cargo built, beside this test's own executable.
///
/// # Panics
/// When it is not there: `cargo test` of this package alone does not build it.
pub fn program() -> PathBuf {
    let test = std::env::current_exe().expect("a test has a file");
    let deps = test.parent().expect("in a folder");
    let path = deps.with_file_name(format!("umbrage{}", std::env::consts::EXE_SUFFIX));
    assert!(path.exists(), "{} is missing: run `cargo build -p umbrage` first", path.display());
    path
}

/// A command of the program, run in `folder`; `line` is split at spaces.
///
/// # Panics
/// As [`program`].
pub fn umbrage(folder: &Path, line: &str) -> Command {
    let mut command = Command::new(program());
    command.args(line.split_whitespace()).current_dir(folder);
    // Mesa complains on standard error where a desktop's runtime folder is missing.
    command.env("XDG_RUNTIME_DIR", folder);
    command
}

/// What a command did.
#[derive(Clone, Debug)]
pub struct Ran {
    /// Exit code; none when a signal ended it.
    pub code: Option<i32>,
    /// All of standard output.
    pub stdout: String,
    /// All of standard error.
    pub stderr: String,
}

/// Runs a command to its end.
///
/// # Panics
/// When it cannot be started.
pub fn run(command: &mut Command) -> Ran {
    let output = command.output().expect("the program starts");
    Ran {
        code: output.status.code(),
        stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
        stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}

impl Ran {
    /// Checks the exit code, and that nothing panicked on the way.
    ///
    /// # Panics
    /// When it is another; with everything that was said.
    #[track_caller]
    pub fn ended_with(self, code: i32) -> Self {
        assert!(!self.stderr.contains("panicked"), "a panic:\n{}", self.stderr);
        assert_eq!(self.code, Some(code), "exit code; it said:\n{}\n{}", self.stderr, self.stdout);
        self
    }

    /// Checks that standard error holds some words.
    ///
    /// # Panics
    /// When it does not; with everything that was said.
    #[track_caller]
    pub fn says(self, words: &str) -> Self {
        assert!(self.stderr.contains(words), "no \"{words}\" in:\n{}", self.stderr);
        self
    }
}

/// Every file below a folder, in order of names; none where there is no such folder.
pub fn files_below(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    let below = |path: PathBuf| if path.is_dir() { files_below(&path) } else { vec![path] };
    paths.into_iter().flat_map(below).collect()
}
