//! The table of scores for a paper: LaTeX with booktabs, and the same as CSV.

use super::Chosen;
use super::tex::escaped;
use crate::numbers::{Power, with_interval};
use crate::{Calibration, VariantCard};
use std::fmt::Write as _;
use umbrage_metrics::Score;

const COLUMNS: [(&str, &str); 9] = [
    ("error", "ERROR"),
    ("swimming", "SWIMMING"),
    ("smooth_static", "smooth static"),
    ("structured_static", "structured static"),
    ("smooth_moving", "smooth moving"),
    ("structured_moving", "structured moving"),
    ("noise", "noise"),
    ("width_ratio", "width"),
    ("flip", "FLIP"),
];

fn score(chosen: &Chosen, v: usize, id: &str) -> Option<Score> {
    chosen.card.overall_of(v)?.scores.get(id)?.score()
}

/// Pooled over all windows; needs `\usepackage{booktabs}`.
pub(super) fn latex(chosen: &Chosen) -> String {
    let power =
        |id: &str| Power::of(chosen.variants.iter().filter_map(|&v| score(chosen, v, id)).map(|s| s.value));
    let mut text = String::from(
        "% needs \\usepackage{booktabs}; a ? stands for a letter that LaTeX may not have: scores.csv has it\n\\begin{tabular}{l",
    );
    text += &"r".repeat(COLUMNS.len());
    text += "}\n\\toprule\nvariant";
    for (id, name) in COLUMNS {
        let exponent = power(id).exponent();
        let unit = if exponent == 0 { String::new() } else { format!(" $\\times 10^{{{exponent}}}$") };
        // Writing to a string cannot fail.
        let _ = write!(text, " & {name}{unit}");
    }
    text += " \\\\\n\\midrule\n";
    for &v in &chosen.variants {
        text += &escaped(&name(&chosen.card.variants[v]));
        for (id, _) in COLUMNS {
            let cell = score(chosen, v, id).map_or("--".into(), |s| {
                let (value, interval) = with_interval(s, chosen.card.goal(id), power(id));
                escaped(&interval.map_or(value.clone(), |i| format!("{value} {i}")))
            });
            let _ = write!(text, " & {cell}");
        }
        text += " \\\\\n";
    }
    text + "\\bottomrule\n\\end{tabular}\n"
}

/// One row a variant: value, lower and upper end of each score, to the last bit.
pub(super) fn csv(chosen: &Chosen) -> String {
    let mut text = String::from("variant");
    for (id, _) in COLUMNS {
        let _ = write!(text, ",{id},{id}_low,{id}_high");
    }
    for &v in &chosen.variants {
        let _ = write!(text, "\n{}", crate::tables::csv_field(&name(&chosen.card.variants[v])));
        for (id, _) in COLUMNS {
            let _ = match score(chosen, v, id) {
                Some(s) => write!(text, ",{},{},{}", s.value, s.low, s.high),
                None => write!(text, ",,,"),
            };
        }
    }
    text + "\n"
}

fn name(v: &VariantCard) -> String {
    if v.calibration == Calibration::AsPrinted { format!("{} (as printed)", v.name) } else { v.name.clone() }
}
