//! A graphics adapter, or the software one.

use crate::steps::{Outcome, cargo, run};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The Debian packages of Mesa's software Vulkan.
const PACKAGES: [&str; 2] = ["mesa-vulkan-drivers", "libvulkan1"];

/// Where cargo put the program.
pub(crate) fn program(profile: &str) -> Result<PathBuf, String> {
    let output = Command::new(cargo())
        .args(["metadata", "--format-version", "1", "--no-deps"])
        .output()
        .map_err(|e| format!("cargo metadata: {e}"))?;
    let metadata: serde_json::Value =
        serde_json::from_slice(&output.stdout).map_err(|e| format!("cargo metadata: {e}"))?;
    let target = metadata["target_directory"].as_str().ok_or("cargo metadata names no target directory")?;
    Ok(Path::new(target).join(profile).join(format!("umbrage{}", std::env::consts::EXE_SUFFIX)))
}

/// Installs the software driver when the program finds no adapter.
pub(crate) fn ensure(program: &Path) -> Outcome {
    if has_adapter(program)? {
        return Ok(());
    }
    eprintln!("no graphics adapter found: installing Mesa's software Vulkan ({})", PACKAGES.join(" "));
    install(&PACKAGES)?;
    if has_adapter(program)? {
        return Ok(());
    }
    Err("still no graphics adapter after installing the software driver; `umbrage list adapters` shows what is there".into())
}

fn has_adapter(program: &Path) -> Result<bool, String> {
    let mut command = Command::new(program);
    let output = quiet(command.args(["list", "adapters", "--json"]))
        .output()
        .map_err(|e| format!("{}: {e}", program.display()))?;
    let listed: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
    Ok(listed.as_array().is_some_and(|a| !a.is_empty()))
}

/// Installs Debian packages, or says how.
pub(crate) fn install(packages: &[&str]) -> Outcome {
    let root = Command::new("id").arg("-u").output().is_ok_and(|o| o.stdout.starts_with(b"0\n"));
    let by_hand =
        || format!("install them by hand and run this again: apt-get install {}", packages.join(" "));
    let mut install = vec!["apt-get", "install", "-y", "--no-install-recommends"];
    install.extend(packages);
    for step in [vec!["apt-get", "update", "-q"], install] {
        let step = if root { step } else { [vec!["sudo"], step].concat() };
        run(step[0], &step[1..]).map_err(|e| format!("{e}\n{}", by_hand()))?;
    }
    Ok(())
}

/// Mesa complains on standard error where a desktop's runtime folder is missing.
pub(crate) fn quiet(command: &mut Command) -> &mut Command {
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        command.env("XDG_RUNTIME_DIR", std::env::temp_dir());
    }
    command
}
