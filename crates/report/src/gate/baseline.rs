//! What a later run is compared with: sums per cluster of tiles, not pictures, small enough to commit.

use super::margins::Margins;
use crate::error::{ReportError, write_whole};
use crate::{AdapterCard, Provenance};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use umbrage_metrics::SumTable;

/// The version of baseline files that this crate writes, and the only one that it reads.
pub const BASELINE_VERSION: u32 = 1;

/// Name of the sums in the folder of a run.
pub const SUMS: &str = "sums.json";

/// The sums of a run that a paired comparison needs. `sums.json` in a run's folder; a baseline once it is
/// accepted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Baseline {
    /// [`BASELINE_VERSION`].
    pub baseline_version: u32,
    /// BLAKE3 of the file with this field empty and without white space: an edited file is refused.
    pub checksum: String,
    /// What was run, on what.
    pub provenance: Provenance,
    /// What is too small to matter, as the suite says.
    pub margins: Margins,
    /// Names of the variants: `chss-mask/light-matched`.
    pub variants: Vec<String>,
    /// The scored windows.
    pub windows: Vec<BaselineWindow>,
    /// The sums of each variant in each window.
    pub sums: Vec<BaselineSums>,
}

/// A window by its content.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct BaselineWindow {
    /// Name of the scene.
    pub scene: String,
    /// Name of the camera path.
    pub path: String,
    /// Index on the path of the window's first frame.
    pub first_frame: u32,
    /// Frames in the window, T.
    pub frames: u32,
    /// Numbers from a frame to the next: above 1 where another program's frames skip some.
    #[serde(default = "crate::card::one", skip_serializing_if = "crate::card::is_one")]
    pub step: u32,
    /// Hash over the cameras and the light of every frame.
    pub views: String,
    /// Column and row of each cluster of 2x2 tiles, in the order of the sums.
    pub clusters: Vec<[u32; 2]>,
}

/// A variant in a window: rows of sums, one a cluster, to seven significant digits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BaselineSums {
    /// Index into `windows`.
    pub window: usize,
    /// Index into `variants`.
    pub variant: usize,
    /// What the cells are made of.
    pub cells: Vec<Vec<f64>>,
    /// What the width of the penumbra is made of.
    pub profile: Vec<Vec<f64>>,
    /// What the noise of means over 4x4 px is made of.
    pub blocks: Vec<Vec<f64>>,
    /// Of each gated score in order: variance over pattern seeds and its degrees of freedom; empty where there
    /// were two seeds, which cannot tell.
    pub spread: Vec<Option<[f64; 2]>>,
    /// What each frame adds to the motion, over the whole window.
    pub per_frame: Vec<f64>,
}

impl Baseline {
    /// Where a baseline of this name lies for an adapter: baselines of different adapters never mix.
    pub fn path(folder: &Path, name: &str, adapter: &AdapterCard) -> PathBuf {
        folder.join(format!("{name}.{}.json", adapter_class(adapter)))
    }

    /// Rounds, signs and writes.
    ///
    /// # Errors
    /// A number that is not finite, or a file that cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), ReportError> {
        let mut signed = self.clone();
        signed.round();
        signed.check(path)?;
        signed.checksum = signed.sum()?;
        write_whole(path, text(&signed)?.as_bytes())
    }

    /// Reads a baseline, or the sums of a run.
    ///
    /// # Errors
    /// A file that is missing, no baseline, of another version, or edited by hand.
    pub fn load(path: &Path) -> Result<Self, ReportError> {
        let text = std::fs::read_to_string(path).map_err(ReportError::at(path))?;
        let refuse = |reason: String| ReportError::Baseline { path: path.into(), reason };
        let any: serde_json::Value =
            serde_json::from_str(&text).map_err(|e| refuse(format!("not JSON: {e}")))?;
        match any.get("baseline_version").and_then(serde_json::Value::as_u64) {
            Some(version) if version == u64::from(BASELINE_VERSION) => {}
            Some(version) => {
                return Err(refuse(format!(
                    "baseline_version {version}, but this program reads version {BASELINE_VERSION}; \
                     make the baseline again with `--save-baseline`, or use the release that wrote it"
                )));
            }
            None => return Err(refuse("no baseline_version: not a baseline".into())),
        }
        let baseline: Self =
            serde_json::from_str(&text).map_err(|e| refuse(format!("not a baseline: {e}")))?;
        if baseline.checksum != baseline.sum()? {
            return Err(refuse(
                "its checksum does not fit: the file was edited or damaged; restore it, or make it again with \
                 `--save-baseline`"
                    .into(),
            ));
        }
        baseline.check(path)?;
        Ok(baseline)
    }

    /// Rounds all sums to seven digits, as files hold them: an unchanged build then differs by nothing.
    pub fn round(&mut self) {
        for sums in &mut self.sums {
            let rows = sums
                .cells
                .iter_mut()
                .chain(&mut sums.profile)
                .chain(&mut sums.blocks)
                .chain(std::iter::once(&mut sums.per_frame));
            rows.flatten()
                .chain(sums.spread.iter_mut().flatten().flatten())
                .for_each(|v| *v = seven_digits(*v));
        }
    }

    /// Whether there is nothing in it that a later run could be compared with.
    pub fn is_empty(&self) -> bool {
        self.windows.is_empty() || self.sums.is_empty()
    }

    fn sum(&self) -> Result<String, ReportError> {
        let unsigned = Self { checksum: String::new(), ..self.clone() };
        let text = serde_json::to_string(&unsigned).map_err(|e| ReportError::Contradiction(e.to_string()))?;
        Ok(blake3::hash(text.as_bytes()).to_hex().to_string())
    }

    fn check(&self, path: &Path) -> Result<(), ReportError> {
        let refuse = |reason: &str| Err(ReportError::Baseline { path: path.into(), reason: reason.into() });
        for sums in &self.sums {
            let (Some(window), Some(name)) = (self.windows.get(sums.window), self.variants.get(sums.variant))
            else {
                return refuse("sums of a window or variant that there is not");
            };
            if [sums.cells.len(), sums.profile.len(), sums.blocks.len()] != [window.clusters.len(); 3] {
                return refuse("sums of other clusters than the window's");
            }
            if sums
                .cells
                .iter()
                .chain(&sums.profile)
                .chain(&sums.blocks)
                .flatten()
                .chain(&sums.per_frame)
                .chain(sums.spread.iter().flatten().flatten())
                .any(|v| !v.is_finite())
            {
                let place = format!("{}, {}, {name}", window.scene, window.path);
                return Err(ReportError::NotFinite { place, metric: "a sum".into() });
            }
        }
        Ok(())
    }

    /// The sums of a variant in a window.
    pub(super) fn sums_of(&self, window: usize, variant: usize) -> Option<&BaselineSums> {
        self.sums.iter().find(|s| s.window == window && s.variant == variant)
    }
}

impl BaselineSums {
    /// One of its tables.
    pub(crate) fn table(rows: &[Vec<f64>], window: &BaselineWindow) -> SumTable {
        let row = |([c, r], sums): (&[u32; 2], &Vec<f64>)| (*c, *r, sums.clone());
        SumTable { rows: window.clusters.iter().zip(rows).map(row).collect() }
    }
}

/// Software drivers of one name are one class whatever their version; so are GPUs.
pub(super) fn adapter_class(adapter: &AdapterCard) -> String {
    let name: String = if adapter.is_cpu {
        // llvmpipe's name holds its vector width and LLVM's version.
        adapter.name.split([' ', '(']).next().unwrap_or("software").into()
    } else {
        adapter.name.clone()
    };
    let safe = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    let name: String = format!("{} {name}", adapter.backend).chars().map(safe).take(60).collect();
    name.trim_matches('-').into()
}

fn seven_digits(value: f64) -> f64 {
    format!("{value:.6e}").parse().unwrap_or(value)
}

/// One row of sums a line: a diff shows what changed.
fn text(baseline: &Baseline) -> Result<String, ReportError> {
    let broken = |e: serde_json::Error| ReportError::Contradiction(e.to_string());
    let mut head = serde_json::to_value(baseline).map_err(broken)?;
    let sums =
        baseline.sums.iter().map(serde_json::to_string).collect::<Result<Vec<_>, _>>().map_err(broken)?;
    let mark = "@sums@";
    head["sums"] = mark.into();
    let head = serde_json::to_string_pretty(&head).map_err(broken)?;
    Ok(head.replacen(&format!("\"{mark}\""), &format!("[\n    {}\n  ]", sums.join(",\n    ")), 1) + "\n")
}
