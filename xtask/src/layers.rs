//! The dependency invariants of ARCHITECTURE.md, over `cargo metadata`.

use crate::steps::{Outcome, cargo};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

/// What each crate may use of the workspace. `scene` and `frame` are leaves; `reference` and
/// `shadows` never see each other; `metrics` knows no scene; `report` never renders.
const ALLOWED: [(&str, &[&str]); 10] = [
    ("umbrage-scene", &[]),
    ("umbrage-frame", &[]),
    ("umbrage-device", &[]),
    ("umbrage-reference", &["umbrage-scene", "umbrage-frame", "umbrage-device"]),
    ("umbrage-shadows", &["umbrage-scene", "umbrage-frame", "umbrage-device"]),
    ("umbrage-metrics", &["umbrage-frame"]),
    ("umbrage-report", &["umbrage-frame", "umbrage-metrics"]),
    (
        "umbrage",
        &[
            "umbrage-scene",
            "umbrage-frame",
            "umbrage-reference",
            "umbrage-shadows",
            "umbrage-metrics",
            "umbrage-report",
        ],
    ),
    ("xtask", &[]),
    ("umbrage-tests", &[]),
];

/// Libraries that only these crates may name.
const OWNED: [(&str, &[&str]); 8] = [
    ("wgpu", &["umbrage-device", "umbrage-shadows", "umbrage-reference"]),
    ("naga", &["umbrage-shadows"]),
    ("obvhs", &["umbrage-reference"]),
    ("tobj", &["umbrage-scene"]),
    ("gltf", &["umbrage-scene"]),
    ("exr", &["umbrage-frame"]),
    ("maud", &["umbrage-report"]),
    ("indicatif", &["umbrage"]),
];

/// Crates of which only `src/gpu/` knows wgpu.
const WGPU_IN_ITS_MODULE: [&str; 2] = ["shadows", "reference"];

/// Names that say nothing.
const VAGUE: [&str; 4] = ["core", "common", "utils", "util"];

/// Checks every crate of the workspace; test-only dependencies are free.
pub(crate) fn check() -> Outcome {
    let output = Command::new(cargo())
        .args(["metadata", "--format-version", "1", "--no-deps"])
        .output()
        .map_err(|e| format!("cargo metadata: {e}"))?;
    let metadata: Value =
        serde_json::from_slice(&output.stdout).map_err(|e| format!("cargo metadata: {e}"))?;
    let mut offences = offences(&dependencies(&metadata));
    let root = metadata["workspace_root"].as_str().unwrap_or(".");
    for name in WGPU_IN_ITS_MODULE {
        wgpu_outside_its_module(&Path::new(root).join("crates").join(name).join("src"), &mut offences)?;
    }
    if offences.is_empty() {
        println!("layers: every crate uses only what it may");
        return Ok(());
    }
    Err(format!("layers:\n  {}", offences.join("\n  ")))
}

/// Crate -> the names of its ordinary dependencies.
fn dependencies(metadata: &Value) -> BTreeMap<String, BTreeSet<String>> {
    let packages = metadata["packages"].as_array().cloned().unwrap_or_default();
    let ordinary = |package: &Value| {
        let all = package["dependencies"].as_array().cloned().unwrap_or_default();
        let names = all.iter().filter(|d| d["kind"].is_null()).filter_map(|d| d["name"].as_str());
        names.map(str::to_string).collect()
    };
    packages.iter().map(|p| (p["name"].as_str().unwrap_or_default().to_string(), ordinary(p))).collect()
}

/// Only `src/gpu/` knows wgpu.
fn wgpu_outside_its_module(folder: &Path, offences: &mut Vec<String>) -> Outcome {
    let failed = |e: std::io::Error| format!("{}: {e}", folder.display());
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.is_dir() {
            if path.file_name().is_none_or(|n| n != "gpu") {
                wgpu_outside_its_module(&path, offences)?;
            }
        } else if path.extension().is_some_and(|e| e == "rs")
            && std::fs::read_to_string(&path).map_err(failed)?.contains("wgpu::")
        {
            offences.push(format!("{}: only src/gpu/ may name wgpu", path.display()));
        }
    }
    Ok(())
}

fn offences(crates: &BTreeMap<String, BTreeSet<String>>) -> Vec<String> {
    let mut offences = Vec::new();
    for (name, uses) in crates {
        let Some((_, allowed)) = ALLOWED.iter().find(|(known, _)| known == name) else {
            offences.push(format!(
                "{name} is not in the list of layers: say what it may use (xtask/src/layers.rs)"
            ));
            continue;
        };
        let ours = uses.iter().filter(|u| crates.contains_key(*u));
        offences.extend(
            ours.filter(|u| !allowed.contains(&u.as_str())).map(|u| format!("{name} must not use {u}")),
        );
        for (library, owners) in OWNED {
            if uses.contains(library) && !owners.contains(&name.as_str()) {
                offences.push(format!("{name} must not use {library}: only {} does", owners.join(", ")));
            }
        }
        let stem = name.trim_start_matches("umbrage-");
        if VAGUE.contains(&stem) {
            offences.push(format!("{name}: a name that says nothing"));
        }
    }
    offences
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crates(list: &[(&str, &[&str])]) -> BTreeMap<String, BTreeSet<String>> {
        let names = |l: &[&str]| l.iter().map(|s| (*s).to_string()).collect();
        list.iter().map(|(name, uses)| ((*name).to_string(), names(uses))).collect()
    }

    #[test]
    fn the_witnesses_never_see_each_other() {
        let found =
            offences(&crates(&[("umbrage-reference", &["umbrage-shadows"]), ("umbrage-shadows", &[])]));
        assert_eq!(found, ["umbrage-reference must not use umbrage-shadows"]);
    }

    #[test]
    fn libraries_stay_with_their_owner() {
        let found = offences(&crates(&[("umbrage-metrics", &["wgpu"]), ("umbrage-shadows", &["wgpu"])]));
        assert_eq!(
            found,
            [
                "umbrage-metrics must not use wgpu: only umbrage-device, umbrage-shadows, umbrage-reference does"
            ]
        );
    }

    #[test]
    fn a_new_crate_must_state_its_place() {
        assert_eq!(offences(&crates(&[("umbrage-utils", &[])])).len(), 1);
    }
}
