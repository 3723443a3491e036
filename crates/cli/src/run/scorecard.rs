//! From what was measured to the scorecard.

use super::Scored;
use super::cost::{CostOf, pooled};
use crate::error::CliError;
use crate::suite::Plan;
use std::collections::BTreeMap;
use umbrage_metrics::{
    Bootstrap, Comparisons, METRICS, Quantity, Score, TileTable, cells, compare_all, edge_crawl,
    swimming_per_frame,
};
use umbrage_report::{
    Calibration, Cost, Measured, MetricCard, OverallCard, PairedCard, Provenance, ResultCard, SCHEMA_VERSION,
    Scorecard, SettingsCard, VariantCard, WindowCard,
};
use umbrage_shadows::{ConstantBias, Gpu, ReceiverPlane, VariantId};

/// Metrics whose groups and pairs are shown.
const COMPARED: [Quantity; 4] = [Quantity::Error, Quantity::Banding, Quantity::Swimming, Quantity::Noise];

/// What was scored.
pub(super) struct Subjects {
    /// In the order of each window's measurements.
    pub(super) cards: Vec<VariantCard>,
    /// Of each, or why there is none.
    pub(super) costs: Vec<(Option<Cost>, Option<String>)>,
}

impl Subjects {
    /// The variants of a plan.
    pub(super) fn of(plan: &Plan, costs: &[CostOf], gpu: &Gpu) -> Self {
        let adapter = gpu.description();
        let note = || adapter.is_software().then(|| "not a cost: software adapter".to_string());
        Self {
            cards: plan.variants.iter().map(|&v| variant_card(v, plan)).collect(),
            costs: plan.variants.iter().map(|&v| (pooled(costs, v, &adapter.name), note())).collect(),
        }
    }
}

/// Everything, in the report's words.
pub(super) fn assemble(
    provenance: Provenance,
    subjects: Subjects,
    scored: &[Scored],
    bootstrap: &Bootstrap,
) -> Result<Scorecard, CliError> {
    let usable = comparable(scored);
    let mut card = Scorecard {
        schema_version: SCHEMA_VERSION,
        provenance,
        metrics: METRICS.iter().map(MetricCard::from).collect(),
        windows: Vec::new(),
        variants: subjects.cards,
        results: Vec::new(),
        overall: Vec::new(),
        paired: Vec::new(),
    };
    for (index, entry) in scored.iter().enumerate() {
        let comparisons = compare(&[entry], bootstrap)?;
        let mut results = window_results(index, entry, bootstrap)?;
        for (result, groups) in results.iter_mut().zip(groups(&comparisons, entry.variants.len())) {
            result.groups = groups;
        }
        let mut window = window_card(entry, &results);
        if !usable.iter().any(|u| std::ptr::eq(*u, entry)) && !entry.variants.is_empty() {
            window.notes.push("not part of the pooled scores: too few frames, or nothing counted".into());
        }
        card.windows.push(window);
        card.results.extend(results);
        card.paired.extend(pairs(&comparisons, Some(index)));
    }
    let comparisons = compare(&usable, bootstrap)?;
    card.overall = overall(&usable, subjects.costs, bootstrap)?;
    for (overall, groups) in card.overall.iter_mut().zip(groups(&comparisons, card.variants.len())) {
        overall.groups = groups;
    }
    card.paired.extend(pairs(&comparisons, None));
    Ok(card)
}

/// Windows that can be pooled: scored, and of one T (the largest), for M grows with T.
fn comparable(scored: &[Scored]) -> Vec<&Scored> {
    let has_scores = |s: &&Scored| !s.variants.is_empty() && s.window.coverage.counted > 0;
    let frames = scored.iter().filter(has_scores).map(|s| s.window.frames).max();
    scored.iter().filter(has_scores).filter(|s| Some(s.window.frames) == frames).collect()
}

/// Every two variants in each compared quantity.
fn compare(scored: &[&Scored], bootstrap: &Bootstrap) -> Result<Vec<(Quantity, Comparisons)>, CliError> {
    let tables = tables(scored);
    if tables.is_empty() {
        return Ok(Vec::new());
    }
    let all = |quantity| Ok((quantity, compare_all(&tables, quantity, bootstrap)?));
    COMPARED.into_iter().map(all).collect()
}

/// The letters of each variant, by metric id.
fn groups(comparisons: &[(Quantity, Comparisons)], variants: usize) -> Vec<BTreeMap<String, String>> {
    let of = |variant: usize| {
        let letters = comparisons.iter().map(|(q, c)| (q.id().to_string(), c.letters[variant].clone()));
        letters.collect()
    };
    (0..variants).map(of).collect()
}

/// Paired differences between every two variants.
fn pairs(comparisons: &[(Quantity, Comparisons)], window: Option<usize>) -> Vec<PairedCard> {
    let card = |quantity: Quantity, &(a, b, difference, resolved): &(usize, usize, Score, bool)| PairedCard {
        a,
        b,
        window,
        metric: quantity.id().into(),
        difference,
        resolved,
    };
    comparisons.iter().flat_map(|(q, c)| c.pairs.iter().map(move |pair| card(*q, pair))).collect()
}

fn variant_card(id: VariantId, plan: &Plan) -> VariantCard {
    let info = id.info();
    let bias = id.calibration.default_bias();
    let kernels = id.kernels();
    let passes = id.passes(&plan.jobs[0].scene);
    let mut more = BTreeMap::from([("kernel".into(), kernels.kernel), ("passes".into(), passes.join(", "))]);
    more.extend(id.variant.technique.settings());
    VariantCard {
        name: id.variant.name.into(),
        technique: id.variant.name.into(),
        calibration: match id.calibration {
            umbrage_shadows::Calibration::AsPrinted => Calibration::AsPrinted,
            umbrage_shadows::Calibration::LightMatched => Calibration::LightMatched,
        },
        taps: info.taps,
        passes: passes.len() as u32,
        settings: SettingsCard {
            bias_constant: match bias.constant {
                ConstantBias::World(metres) => format!("{metres} m"),
                ConstantBias::PerDistance(part) => format!("{part} of the light's distance"),
            },
            bias_normal_offset: format!("{} texels", bias.normal_offset_texels),
            bias_receiver_plane: match bias.receiver_plane {
                ReceiverPlane::Off => "off".into(),
                ReceiverPlane::On { max_slope } => format!("at texel centres, slope up to {max_slope}"),
            },
            search_radius: kernels.search_radius,
            kernel_cap: kernels.cap,
            radius_convention: kernels.radius_convention,
            outside_the_map: "lit".into(),
            more,
        },
        source: info.document.into(),
        sentence: info.title.into(),
    }
}

fn window_results(window: usize, entry: &Scored, bootstrap: &Bootstrap) -> Result<Vec<ResultCard>, CliError> {
    let mut results = Vec::new();
    for (variant, measured) in entry.variants.iter().enumerate() {
        let numbers = &measured.numbers;
        let mut scores = scores(&[&numbers.anchored], numbers.pixels.as_ref().map(|p| vec![p]), bootstrap)?;
        scores.extend(numbers.extras.iter().map(|(id, &m)| (id.clone(), Measured::from(m))));
        let per_frame_swimming = swimming_per_frame(&numbers.anchored, bootstrap)?;
        let noise_spectrum = numbers.noise_spectrum.clone();
        let groups = BTreeMap::new();
        results.push(ResultCard { window, variant, scores, per_frame_swimming, noise_spectrum, groups });
    }
    Ok(results)
}

/// Every pooled quantity, and edge crawl where both readings were made.
fn scores(
    anchored: &[&TileTable],
    pixels: Option<Vec<&TileTable>>,
    bootstrap: &Bootstrap,
) -> Result<BTreeMap<String, Measured>, CliError> {
    let pooled = cells(anchored, bootstrap)?;
    let mut scores: BTreeMap<String, Measured> =
        pooled.iter().map(|(quantity, m)| (quantity.id().to_string(), Measured::from(m))).collect();
    let crawl = match pixels {
        Some(pixels) => Measured::from(edge_crawl(&pixels, anchored, bootstrap)?),
        None => Measured::no(umbrage_metrics::Missing::OneFrame.to_string()),
    };
    scores.insert("edge_crawl".into(), crawl);
    Ok(scores)
}

/// Per variant, the tables of its windows.
fn tables<'a>(scored: &[&'a Scored]) -> Vec<Vec<&'a TileTable>> {
    let variants = scored.first().map_or(0, |s| s.variants.len());
    (0..variants).map(|v| scored.iter().map(|s| &s.variants[v].numbers.anchored).collect()).collect()
}

fn window_card(entry: &Scored, results: &[ResultCard]) -> WindowCard {
    let facts = &entry.window;
    let noise = results.first().and_then(|r| r.scores.get("reference_noise")?.score());
    WindowCard {
        scene: facts.scene.clone(),
        path: facts.path.clone(),
        first_frame: facts.first,
        frames: facts.frames,
        step: facts.step,
        speed: facts.title.clone(),
        anchors: facts.coverage.counted as u64,
        tiles: facts.tiles as u64,
        coverage: facts.coverage.share(),
        picture: facts.coverage.counted as f64 / facts.coverage.pixels.max(1) as f64,
        disagreement: facts.coverage.disagreement(),
        occluded: facts.coverage.occlusion(),
        reference_noise: noise.map_or(0.0, |s| s.value),
        truth_secs: facts.truth_secs,
        notes: facts.notes.clone(),
    }
}

fn overall(
    usable: &[&Scored],
    costs: Vec<(Option<Cost>, Option<String>)>,
    bootstrap: &Bootstrap,
) -> Result<Vec<OverallCard>, CliError> {
    if usable.is_empty() {
        return Ok(Vec::new());
    }
    let anchored = tables(usable);
    let mut cards = Vec::new();
    for (index, (cost, cost_note)) in costs.into_iter().enumerate() {
        let pixels: Option<Vec<&TileTable>> =
            usable.iter().map(|s| s.variants[index].numbers.pixels.as_ref()).collect();
        let mut scores = scores(&anchored[index], pixels, bootstrap)?;
        scores.extend(mean_extras(usable, index));
        cards.push(OverallCard { variant: index, scores, groups: BTreeMap::new(), cost, cost_note });
    }
    Ok(cards)
}

/// What explains the scores, averaged over the windows that have it; intervals of independent
/// windows add in quadrature.
fn mean_extras(usable: &[&Scored], variant: usize) -> BTreeMap<String, Measured> {
    let mut found: BTreeMap<&str, Vec<Score>> = BTreeMap::new();
    for (id, measurement) in usable.iter().flat_map(|s| &s.variants[variant].numbers.extras) {
        found.entry(id).or_default().extend(measurement.score());
    }
    let mean = |scores: &[Score]| {
        let n = scores.len() as f64;
        let value = scores.iter().map(|s| s.value).sum::<f64>() / n;
        let half = |side: fn(&Score) -> f64| scores.iter().map(|s| side(s).powi(2)).sum::<f64>().sqrt() / n;
        Score { value, low: value - half(|s| s.value - s.low), high: value + half(|s| s.high - s.value) }
    };
    let card = |(id, scores): (&str, Vec<Score>)| {
        let measured =
            if scores.is_empty() { Measured::no("in no window") } else { Measured::Score(mean(&scores)) };
        (id.to_string(), measured)
    };
    found.into_iter().map(card).collect()
}
