//! A run against a baseline.

use super::baseline::{Baseline, BaselineSums, BaselineWindow, adapter_class};
use super::card::{GateCard, GateCase, Side};
use super::margins::gated;
use crate::{Provenance, ReportError};
use umbrage_metrics::{
    PooledNumber, Quantity, SeedSpread, SumTable, Trial, gate_table, judge, pooled_reading,
};

/// Why two runs do not compare: every reason, not the first.
pub fn not_comparable(base: &Baseline, run: &Baseline) -> Vec<String> {
    let mut reasons = Vec::new();
    let (b, r) = (&base.provenance, &run.provenance);
    let mut differ = |what: &str, base: String, run: String| {
        if base != run {
            reasons.push(format!("{what}: {base} in the baseline, {run} in the run"));
        }
    };
    differ("adapter", adapter_class(&b.adapter), adapter_class(&r.adapter));
    differ("picture", size(b), size(r));
    differ("frames of a window", b.frames.to_string(), r.frames.to_string());
    differ("seeds", b.seeds.to_string(), r.seeds.to_string());
    differ("side of a tile", b.tile_px.to_string(), r.tile_px.to_string());
    differ("side of the shadow map", b.shadow_map_texels.to_string(), r.shadow_map_texels.to_string());
    differ("samples of truth", b.truth.samples_per_half.to_string(), r.truth.samples_per_half.to_string());
    let tolerance = |t: Option<f32>| t.map_or_else(|| "none".into(), |t| t.to_string());
    differ("tolerance of truth", tolerance(b.truth.tolerance), tolerance(r.truth.tolerance));
    differ("truth", truth_class(&b.truth.method), truth_class(&r.truth.method));
    for scene in &b.scenes {
        if let Some(now) = r.scenes.iter().find(|s| s.name == scene.name) {
            differ(
                &format!("content of scene {}", scene.name),
                short(&scene.content_hash),
                short(&now.content_hash),
            );
        }
    }
    if base.sums.iter().chain(&run.sums).any(|s| s.spread.is_empty()) {
        reasons.push("with fewer than 3 seeds nothing is known about their spread: `--seeds 3` or more (of frames from elsewhere: with fewer than 3 takes; \
                      three, or --deterministic)".into());
    }
    for window in &base.windows {
        let place = format!("{}, {} from frame {}", window.scene, window.path, window.first_frame);
        match run.windows.iter().find(|w| w.same_place(window)) {
            None => reasons.push(format!("{place} is in the baseline and not in the run")),
            Some(now) if now.views != window.views => {
                reasons.push(format!("{place}: cameras or light differ"))
            }
            Some(now) if now.clusters != window.clusters => {
                reasons.push(format!("{place}: other tiles are scored; truth or scene changed"));
            }
            Some(_) => {}
        }
    }
    for variant in base.variants.iter().filter(|v| !run.variants.contains(v)) {
        reasons.push(format!("{variant} is in the baseline and not in the run"));
    }
    reasons
}

/// A driver's version is no other truth: it is said last, in brackets.
fn truth_class(method: &str) -> String {
    method.trim_end().strip_suffix(')').and_then(|m| m.rsplit_once(" (")).map_or(method, |(m, _)| m).into()
}

fn size(p: &Provenance) -> String {
    format!("{}x{}", p.width, p.height)
}

fn short(hash: &str) -> String {
    hash.chars().take(12).collect()
}

impl BaselineWindow {
    fn same_place(&self, other: &Self) -> bool {
        (&self.scene, &self.path, self.first_frame, self.frames, self.step)
            == (&other.scene, &other.path, other.first_frame, other.frames, other.step)
    }
}

/// Share of a window's points that may be scored on one side only, or in another region.
const MOST_LOST: f64 = 0.002;

/// A variant in a window on both sides.
struct Pair<'a> {
    window: &'a BaselineWindow,
    sums: [&'a BaselineSums; 2],
    /// Cells, profile, blocks; base, run.
    tables: [[SumTable; 2]; 3],
}

/// Judges every score of every variant in every window and over all of them. The margins are the run's.
///
/// # Errors
/// Runs that do not compare ([`not_comparable`]), or points that differ.
pub fn compare(base: &Baseline, run: &Baseline) -> Result<GateCard, ReportError> {
    let reasons = not_comparable(base, run);
    if !reasons.is_empty() {
        return Err(ReportError::NotComparable(reasons));
    }
    let mut run = run.clone();
    run.round();
    let mut cases = Vec::new();
    let mut trials = Vec::new();
    let pairs: Vec<Vec<Pair>> =
        base.variants.iter().map(|v| pairs(base, &run, v)).collect::<Result<_, _>>()?;
    for (variant, pairs) in base.variants.iter().zip(&pairs) {
        for (metric, number) in gated() {
            for (index, pair) in pairs.iter().enumerate() {
                let margin = run.margins.of(&pair.window.scene, number);
                let [base, now] = [0, 1].map(|side| pooled_reading(number, &[pair.table(number, side)]));
                trials.push(Trial { number, base, now, margin });
                cases.push((variant, metric, Some(index)));
            }
            if pairs.len() > 1 {
                let all = |side| {
                    let windows: Vec<_> = pairs.iter().map(|p| p.table(number, side)).collect();
                    pooled_reading(number, &windows)
                };
                let margin = run.margins.mean(pairs.iter().map(|p| p.window.scene.as_str()), number);
                trials.push(Trial { number, base: all(0), now: all(1), margin });
                cases.push((variant, metric, None));
            }
        }
    }
    let changes = judge(&trials).map_err(|e| ReportError::NotComparable(vec![e.to_string()]))?;
    if changes.iter().all(Option::is_none) {
        return Err(ReportError::NotComparable(vec!["no score is defined on both sides".into()]));
    }
    let place = |v: &String| base.variants.iter().position(|b| b == v).unwrap_or_default();
    let cases =
        cases.into_iter().zip(changes).zip(&trials).map(|(((variant, metric, index), change), trial)| {
            let pair = index.map(|i| &pairs[place(variant)][i]);
            let cluster = pair.and_then(|p| p.worst_cluster(trial.number)).map(|[c, r]| {
                // A cluster is 2x2 tiles.
                let side = 2 * base.provenance.tile_px;
                let room = |from: u32, whole: u32| side.min(whole.saturating_sub(from));
                let (left, top) = (c * side, r * side);
                [left, top, room(left, run.provenance.width), room(top, run.provenance.height)]
            });
            GateCase {
                scene: pair.map(|p| p.window.scene.clone()),
                path: pair.map(|p| p.window.path.clone()),
                first_frame: pair.map(|p| p.window.first_frame),
                variant: variant.clone(),
                metric: metric.into(),
                // Frames are kept for motion alone.
                worst_frame: pair
                    .filter(|_| trial.number == PooledNumber::Cell(Quantity::Swimming))
                    .and_then(Pair::worst_frame),
                worst_place: cluster,
                change: change.map(Into::into),
                reproduce: None,
                crop: None,
                crop_shows: Vec::new(),
            }
        });
    let cases = cases.collect();
    let new = new_things(base, &run);
    let margins_changed = base.margins.changes(&run.margins);
    let [base, run] = [&base.provenance, &run.provenance].map(Side::from);
    Ok(GateCard { base, run, baseline: String::new(), accept: String::new(), new, margins_changed, cases })
}

fn pairs<'a>(base: &'a Baseline, run: &'a Baseline, variant: &str) -> Result<Vec<Pair<'a>>, ReportError> {
    let lost = || ReportError::NotComparable(vec![format!("{variant}: no sums in the run")]);
    let place = |b: &Baseline| b.variants.iter().position(|v| v == variant);
    let (Some(v), Some(w)) = (place(base), place(run)) else { return Err(lost()) };
    let mut pairs = Vec::new();
    for (i, window) in base.windows.iter().enumerate() {
        let j = run.windows.iter().position(|w| w.same_place(window)).ok_or_else(lost)?;
        // A window that was refused has no sums on either side.
        let sums = match (base.sums_of(i, v), run.sums_of(j, w)) {
            (Some(a), Some(b)) => [a, b],
            (None, _) => continue,
            (Some(_), None) => {
                let reason =
                    format!("{variant} was scored in {}, {} and is not now", window.scene, window.path);
                return Err(ReportError::NotComparable(vec![reason]));
            }
        };
        let table =
            |rows: fn(&BaselineSums) -> &[Vec<f64>]| sums.map(|s| BaselineSums::table(rows(s), window));
        let tables = [table(|s| &s.cells), table(|s| &s.profile), table(|s| &s.blocks)];
        // Penumbra, umbra and lit points: a driver that rounds otherwise may lose a few at silhouettes.
        let counts = |t: &SumTable| [0, 1, 2].map(|k| t.rows.iter().map(|(.., s)| s[k]).sum::<f64>());
        let [before, after] = [0, 1].map(|side| counts(&tables[0][side]));
        let all: f64 = before.iter().sum();
        if std::iter::zip(before, after).any(|(a, b)| (a - b).abs() > MOST_LOST * all) {
            let reason = format!("{}, {}: other points are scored; truth changed", window.scene, window.path);
            return Err(ReportError::NotComparable(vec![reason]));
        }
        pairs.push(Pair { window, sums, tables });
    }
    Ok(pairs)
}

impl Pair<'_> {
    fn table(&self, number: PooledNumber, side: usize) -> (&SumTable, Option<SeedSpread>) {
        let table = &self.tables[gate_table(number)][side];
        let index = gated().position(|(_, n)| n == number);
        let spread = index.and_then(|i| *self.sums[side].spread.get(i)?);
        (table, spread.map(|[variance, freedom]| SeedSpread { variance, freedom }))
    }

    /// The cluster without which the number would be harmed least.
    fn worst_cluster(&self, number: PooledNumber) -> Option<[u32; 2]> {
        let [base, now] = [0, 1].map(|side| self.table(number, side).0);
        let without = |table: &SumTable, skip: usize| -> Option<f64> {
            let rows =
                table.rows.iter().enumerate().filter(|(i, _)| *i != skip).map(|(_, r)| r.clone()).collect();
            number.of(&[&SumTable { rows }])
        };
        let harm = |skip: usize| Some(number.harm(without(base, skip)?, without(now, skip)?));
        let places = base.rows.iter().enumerate().filter_map(|(i, &(c, r, _))| Some((harm(i)?, [c, r])));
        places.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, place)| place)
    }

    /// The frame that adds most to the motion that was not there.
    fn worst_frame(&self) -> Option<u32> {
        let [base, now] = self.sums.map(|s| &s.per_frame);
        let harm = now.iter().zip(base).map(|(n, b)| n - b);
        let worst = harm.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
        (worst.1 > 0.0).then(|| self.window.first_frame + worst.0 as u32 * self.window.step)
    }
}

fn new_things(base: &Baseline, run: &Baseline) -> Vec<String> {
    let variants = run.variants.iter().filter(|v| !base.variants.contains(v)).cloned();
    let windows = run.windows.iter().filter(|w| !base.windows.iter().any(|b| b.same_place(w)));
    variants.chain(windows.map(|w| format!("{}, {} from frame {}", w.scene, w.path, w.first_frame))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_driver_s_version_is_no_other_truth() {
        assert_eq!(truth_class("scanlines, on NVIDIA H100 (580.1)"), "scanlines, on NVIDIA H100");
        assert_eq!(truth_class("scanlines"), "scanlines");
    }
}
