//! `scores.csv`: tidy, one row per scene, path, variant and metric.

use super::escape::csv;
use crate::{Measured, Scorecard};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Pooled rows have the scene and the path `(all)` and no window. What was not measured has empty
/// numbers, `measured` false, and its reason. Numbers are printed to the last bit.
pub(crate) fn scores_csv(card: &Scorecard) -> String {
    let mut text =
        String::from("scene,path,window,variant,calibration,metric,value,low,high,unit,measured,reason\n");
    for result in &card.results {
        let (Some(window), Some(subject)) = (card.windows.get(result.window), subject(card, result.variant))
        else {
            continue;
        };
        let place = format!("{},{},{},{subject}", csv(&window.scene), csv(&window.path), result.window);
        rows(&mut text, card, &place, &result.scores);
    }
    for overall in &card.overall {
        let Some(subject) = subject(card, overall.variant) else { continue };
        let place = format!("(all),(all),,{subject}");
        rows(&mut text, card, &place, &overall.scores);
        for (metric, ms) in overall
            .cost
            .iter()
            .flat_map(|c| [("gpu_ms_median", c.frame_ms_median), ("gpu_ms_p95", c.frame_ms_p95)])
        {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{place},{metric},{ms},,,ms,true,");
        }
    }
    text
}

fn subject(card: &Scorecard, variant: usize) -> Option<String> {
    let v = card.variants.get(variant)?;
    Some(format!("{},{}", csv(&v.name), csv(v.calibration.id())))
}

fn rows(text: &mut String, card: &Scorecard, place: &str, scores: &BTreeMap<String, Measured>) {
    for (id, measured) in scores {
        let unit = csv(card.metric(id).map_or("", |m| &m.unit));
        let id = csv(id);
        let _ = match measured {
            Measured::Score(s) => {
                writeln!(text, "{place},{id},{},{},{},{unit},true,", s.value, s.low, s.high)
            }
            Measured::NotMeasured { not_measured } => {
                writeln!(text, "{place},{id},,,,{unit},false,{}", csv(not_measured))
            }
        };
    }
}
