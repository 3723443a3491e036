//! What a report says of frames from elsewhere.

use super::{Frames, ScorePlan, ScoreSettings};
use crate::args::ScoreArgs;
use crate::run::provenance::{describe_light, hash_of, on};
use crate::run::scorecard::Subjects;
use crate::suite::Sampling;
use std::collections::BTreeMap;
use umbrage_metrics::TILE_PX;
use umbrage_report::{
    AdapterCard, Calibration, Measured, Provenance, SceneCard, Scorecard, SettingsCard, TruthCard,
    VariantCard,
};

/// Of a subject with one take: whether it has noise nobody can tell.
pub(super) const ONE_TAKE: &str = "one take";

pub(super) fn subjects(frames: &Frames) -> Subjects {
    let card = |subject: &super::frames::Subject| VariantCard {
        name: subject.name.clone(),
        technique: subject.name.clone(),
        calibration: Calibration::Elsewhere,
        taps: match subject.takes.len() {
            1 if frames.deterministic => "no randomness".into(),
            1 => ONE_TAKE.into(),
            n => format!("{n} takes"),
        },
        passes: 0,
        settings: SettingsCard {
            more: BTreeMap::from([(
                "frames".to_string(),
                subject.takes.iter().map(|t| file_name(&t.pattern)).collect::<Vec<_>>().join(", "),
            )]),
            ..SettingsCard::default()
        },
        source: "frames of another program".into(),
        sentence: "Frames of another program, read at the pixels that each surface point falls into.".into(),
    };
    let note = Some("no cost: rendered elsewhere".to_string());
    Subjects {
        cards: frames.subjects.iter().map(card).collect(),
        costs: frames.subjects.iter().map(|_| (None, note.clone())).collect(),
    }
}

/// Not where it lies on this machine.
fn file_name(pattern: &str) -> String {
    std::path::Path::new(pattern)
        .file_name()
        .map_or_else(|| pattern.into(), |n| n.to_string_lossy().into_owned())
}

/// No adapter rendered this: baselines of such frames are a class of their own.
pub(crate) fn nobody() -> AdapterCard {
    AdapterCard {
        name: "another program".into(),
        driver: String::new(),
        backend: "frames".into(),
        device_type: AdapterCard::ELSEWHERE.into(),
        is_cpu: true,
    }
}

pub(super) fn provenance(
    plan: &ScorePlan,
    (args, sampling, settings): (&ScoreArgs, &Sampling, &ScoreSettings),
    notes: Vec<String>,
) -> Provenance {
    let light = &plan.path.frames[0].light;
    Provenance {
        suite: plan.name.clone(),
        frames: sampling.window,
        seeds: sampling.seeds,
        truth: TruthCard {
            samples_per_half: sampling.samples,
            basis_samples: sampling.basis_samples,
            tolerance: args.tolerance,
            method: format!(
                "scanlines: every triangle between point and light covers runs of samples on jittered lines{}",
                on(settings.truth_gpu.as_ref())
            ),
        },
        scenes: vec![SceneCard {
            name: plan.scene.name.clone(),
            content_hash: hash_of(&plan.scene),
            light: describe_light(light),
            shadow_map: "unknown: rendered elsewhere".into(),
            notes: plan.scene.notes.clone(),
        }],
        ..without_scene(&plan.frames, settings, notes)
    }
}

pub(super) fn provenance_without_cameras(
    frames: &Frames,
    settings: &ScoreSettings,
    notes: Vec<String>,
) -> Provenance {
    without_scene(frames, settings, notes)
}

fn without_scene(frames: &Frames, settings: &ScoreSettings, notes: Vec<String>) -> Provenance {
    Provenance {
        tool_version: env!("CARGO_PKG_VERSION").into(),
        date: settings.now.rfc3339.clone(),
        command: settings.command.clone(),
        suite: "frames".into(),
        adapter: nobody(),
        width: frames.size.0,
        height: frames.size.1,
        frames: 1,
        seeds: frames.subjects.iter().map(|s| s.takes.len()).max().unwrap_or(1) as u32,
        first_seed: 0,
        tile_px: TILE_PX,
        shadow_map_texels: 0,
        truth: TruthCard {
            samples_per_half: 0,
            basis_samples: 0,
            tolerance: None,
            method: "true frames as given, taken for exact".into(),
        },
        scenes: Vec::new(),
        notes,
    }
}

/// What needs several takes, or anchors, is not claimed.
pub(super) fn relabel(card: &mut Scorecard, single: &[bool]) {
    for metric in card.metrics.iter_mut().filter(|m| m.id == "swimming") {
        metric.name = format!("{} (with edge crawl)", metric.name);
        metric.definition += " Of frames from elsewhere it is read at pixels, so that it includes edge crawl: compare it only \
                              with the same reading.";
    }
    let noise = "one take: noise is in the other cells";
    let crawl = "frames from elsewhere have one reading: their swimming includes edge crawl";
    let results = card.results.iter_mut().map(|r| (r.variant, &mut r.scores));
    let overall = card.overall.iter_mut().map(|o| (o.variant, &mut o.scores));
    for (variant, scores) in results.chain(overall) {
        scores.insert("edge_crawl".into(), Measured::no(crawl));
        if single.get(variant) == Some(&true) {
            scores.insert("noise".into(), Measured::no(noise));
        }
    }
}
