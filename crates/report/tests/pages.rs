//! The pages of a stored run.

mod fixture;

use fixture::{Device, scorecard};
use std::collections::BTreeSet;
use std::path::Path;
use tempfile::TempDir;
use umbrage_metrics::Score;
use umbrage_report::{Layout, Measured, RunWriter, Scorecard, Written, write_report};

const SIZE: (u32, u32) = (64, 36);
const HOSTILE: &str = "<script>alert(1)</script>&\"'";

fn made(device: Device, layout: Layout) -> (TempDir, Written) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fixture::write(folder.path(), device, SIZE).expect("stored");
    let written = write_report(folder.path(), layout).expect("reported");
    (folder, written)
}

fn pages_of(card: &Scorecard) -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    RunWriter::create(folder.path()).expect("made").finish(card).expect("stored");
    write_report(folder.path(), Layout::SingleFile).expect("reported");
    folder
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).expect(name)
}

#[test]
fn a_run_becomes_four_files_and_the_same_ones_again() {
    let (folder, written) = made(Device::Gpu, Layout::SingleFile);
    assert_eq!(written.files.len(), 4);
    assert!(written.warnings.is_empty(), "{:?}", written.warnings);
    let before = read(folder.path(), "index.html");
    assert_eq!(before.len(), written.index_bytes);
    write_report(folder.path(), Layout::SingleFile).expect("again");
    assert!(before == read(folder.path(), "index.html"));
    assert!(read(folder.path(), "summary.md").len() < 1 << 20);
}

#[test]
fn the_page_loads_nothing_and_has_no_inline_handler() {
    let (folder, _) = made(Device::Gpu, Layout::SingleFile);
    let html = read(folder.path(), "index.html");
    for part in ["http://", "https://", "<link", "<iframe", "@import", "javascript:"] {
        assert!(!html.contains(part), "{part}");
    }
    for tag in html.split('<').filter_map(|t| t.split('>').next()) {
        let handler = tag.split_whitespace().skip(1).any(|a| a.starts_with("on") && a.contains('='));
        assert!(!handler, "<{tag}>");
    }
    for source in html.split(" src=\"").skip(1) {
        assert!(source.starts_with("data:image/png;base64,"));
    }
    assert!(html.contains("default-src &#39;none&#39;") || html.contains("default-src 'none'"));
}

#[test]
fn links_lead_somewhere_and_ids_are_unique() {
    let (folder, _) = made(Device::Gpu, Layout::SingleFile);
    let html = read(folder.path(), "index.html");
    let value = |t: &str| t.split('"').next().unwrap_or_default().to_string();
    let ids: Vec<String> = html.split(" id=\"").skip(1).map(value).collect();
    let unique: BTreeSet<&String> = ids.iter().collect();
    assert_eq!(ids.len(), unique.len(), "an id occurs twice");
    for link in html.split("href=\"#").skip(1).map(value) {
        assert!(unique.contains(&link), "#{link}");
    }
}

#[test]
fn hostile_names_are_shown_and_not_obeyed() {
    let mut card = scorecard(Device::Gpu, SIZE);
    card.windows[0].scene = HOSTILE.into();
    card.windows[0].path = HOSTILE.into();
    card.provenance.suite = HOSTILE.into();
    card.provenance.command = HOSTILE.into();
    card.provenance.adapter.name = HOSTILE.into();
    card.provenance.scenes[0].name = HOSTILE.into();
    card.variants[0].name = HOSTILE.into();
    card.variants[0].technique = HOSTILE.into();
    card.metrics[0].definition = HOSTILE.into();
    card.results[0].scores.insert("flip".into(), Measured::no(HOSTILE));
    let folder = pages_of(&card);
    for name in ["index.html", "summary.md", "junit.xml"] {
        let text = read(folder.path(), name);
        assert!(!text.contains("<script>alert"), "{name}");
        assert!(text.contains("&lt;script&gt;alert(1)&lt;/script&gt;&amp;"), "{name}");
    }
    let html = read(folder.path(), "index.html");
    let markup = html.split("<script").next().expect("the page before its data");
    assert!(!markup.contains("\"'\""), "a quote must not end an attribute");
}

#[test]
fn the_table_of_scores_parses_back() {
    let mut card = scorecard(Device::Gpu, SIZE);
    card.windows[0].scene = "a, \"b\"\nc".into();
    let folder = pages_of(&card);
    let rows = parse_csv(&read(folder.path(), "scores.csv"));
    assert_eq!(
        rows[0].join(","),
        "scene,path,window,variant,calibration,metric,value,low,high,unit,measured,reason"
    );
    assert!(rows.iter().all(|r| r.len() == 12));
    let expected: usize = card.results.iter().map(|r| r.scores.len()).sum::<usize>()
        + card.overall.iter().map(|o| o.scores.len() + 2).sum::<usize>();
    assert_eq!(rows.len(), expected + 1);
    let row = rows.iter().find(|r| r[0] == "a, \"b\"\nc" && r[5] == "error").expect("the first window");
    let score = card.results[0].scores["error"].score().expect("measured");
    assert_eq!(row[6].parse::<f64>().expect("a number"), score.value, "to the last bit");
    let still = rows.iter().find(|r| r[2] == "2" && r[5] == "swimming").expect("the still");
    assert_eq!(still[6..], ["", "", "", "visibility squared", "false", "one frame only"]);
}

/// RFC 4180, for the test: quoted fields, doubled quotes, line breaks inside quotes.
fn parse_csv(text: &str) -> Vec<Vec<String>> {
    let (mut rows, mut row, mut field, mut quoted) = (Vec::new(), Vec::new(), String::new(), false);
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            '"' if quoted && chars.peek() == Some(&'"') => field.push(chars.next().expect("peeked")),
            '"' => quoted = !quoted,
            ',' if !quoted => row.push(std::mem::take(&mut field)),
            '\n' if !quoted => {
                row.push(std::mem::take(&mut field));
                rows.push(std::mem::take(&mut row));
            }
            c => field.push(c),
        }
    }
    rows
}

#[test]
fn junit_counts_what_was_not_measured() {
    let mut card = scorecard(Device::Gpu, SIZE);
    card.results[3].scores.insert("error".into(), Measured::no("no penumbra in this view"));
    card.results.pop();
    let xml = read(pages_of(&card).path(), "junit.xml");
    assert!(xml.contains("tests=\"42\" failures=\"0\" errors=\"0\" skipped=\"2\""), "{xml}");
    assert!(xml.contains("<skipped message=\"not measured: no penumbra in this view\"/>"));
    assert_eq!(xml.matches("<testcase").count(), 42);
}

#[test]
fn empty_states_speak() {
    let mut card = scorecard(Device::Software, SIZE);
    card.windows[1].anchors = 0;
    card.results.retain(|r| r.window != 1);
    let folder = pages_of(&card);
    let html = read(folder.path(), "index.html");
    let expected = [
        "not measured: one frame only",
        "No anchors agreed in this view: check the camera.",
        "No plot: not a cost: software adapter.",
        "No pictures were stored for this window.",
        "not measured",
    ];
    for words in expected {
        assert!(html.contains(words), "{words}");
    }
    assert!(!html.contains("GPU time, ms a frame"), "no cost plot from a software adapter");
}

#[test]
fn nothing_at_all_is_still_a_page() {
    let mut card = scorecard(Device::Software, SIZE);
    card.windows.clear();
    card.variants.clear();
    card.results.clear();
    card.overall.clear();
    card.paired.clear();
    card.metrics.clear();
    let html = read(pages_of(&card).path(), "index.html");
    assert!(html.contains("Nothing was scored"));
    let shown = html.split("<script>").next().expect("the page before its script");
    assert!(!shown.contains("NaN") && !shown.contains(">inf"));
}

#[test]
fn pictures_can_lie_beside_the_page() {
    let (folder, written) = made(Device::Gpu, Layout::Folder);
    let html = read(folder.path(), "index.html");
    assert!(written.index_bytes < 1_000_000);
    let mut count = 0;
    for source in html.split(" src=\"").skip(1).map(|s| s.split('"').next().unwrap_or_default()) {
        assert!(folder.path().join(source).is_file(), "{source}");
        count += 1;
    }
    // Three windows of truth, view, and 14 variants with a shadow and an error; two with swimming.
    assert_eq!(count, 3 * (2 + 14 * 2) + 2 * 14);
}

#[test]
fn a_run_without_a_scorecard_is_an_error_that_names_it() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let message = write_report(folder.path(), Layout::SingleFile).expect_err("nothing there").to_string();
    assert!(message.contains("scorecard.json"), "{message}");
}

#[test]
fn a_large_summary_is_cut_before_a_step_summary_would_be() {
    let mut card = scorecard(Device::Gpu, SIZE);
    let long = "x".repeat(40_000);
    for variant in &mut card.variants {
        variant.name = long.clone();
        variant.name.push_str(&variant.sentence);
    }
    let text = read(pages_of(&card).path(), "summary.md");
    assert!(text.len() < 1 << 20, "{} bytes", text.len());
}

#[test]
fn a_window_says_what_share_of_its_picture_counts() {
    let html = read(pages_of(&scorecard(Device::Gpu, SIZE)).path(), "index.html");
    let said = "80.5\u{a0}% of the picture scored, 94.7\u{a0}% of the points that face the light";
    assert_eq!(html.matches(said).count(), 3);
    // The still has one frame: nothing moves in front of anything.
    assert_eq!(html.matches("1.20\u{a0}% hidden in some frame").count(), 2);
    assert!(html.contains("80.5\u{a0}% of the pictures: 94.7\u{a0}% of the points that face the light"));
}

#[test]
fn the_filter_finds_names_calibrations_documents_and_sentences() {
    let html = read(pages_of(&scorecard(Device::Gpu, SIZE)).path(), "index.html");
    let words = "data-words=\"hard light-matched S0, section 2 One comparison a pixel: no penumbra at all.\"";
    assert!(html.contains(words));
}

#[test]
fn a_ratio_shows_its_ends_where_half_a_width_would_mislead() {
    let mut card = scorecard(Device::Gpu, SIZE);
    let wide = Score { value: 1.12, low: 1.016, high: 3.33 };
    card.overall[0].scores.insert("width_ratio".into(), wide.into());
    let folder = pages_of(&card);
    assert!(read(folder.path(), "index.html").contains("<span class=\"half\">[1.02 to 3.3]</span>"));
    let summary = read(folder.path(), "summary.md");
    assert!(summary.contains("1.02 to 3.3") && !summary.contains("1.1 ± 1.2"), "{summary}");
}

#[test]
fn frames_from_elsewhere_claim_no_settings_that_nobody_knows() {
    let mut card = scorecard(Device::Software, SIZE);
    for variant in &mut card.variants {
        variant.calibration = umbrage_report::Calibration::Elsewhere;
        variant.settings = umbrage_report::SettingsCard::default();
    }
    for overall in &mut card.overall {
        overall.cost_note = Some("no cost: rendered elsewhere".into());
        overall.scores.insert("noise".into(), Measured::no("one take: noise is in the other cells"));
    }
    card.provenance.adapter.device_type = umbrage_report::AdapterCard::ELSEWHERE.into();
    (card.provenance.shadow_map_texels, card.provenance.seeds) = (0, 1);
    card.provenance.truth.samples_per_half = 0;
    let html = read(pages_of(&card).path(), "index.html");
    let shown = html.split("<script").next().expect("the page before its data");
    for wrong in
        ["0 × 0 texels", "<dd></dd>", "no cost: no cost", "measured: no cost", "2 × 0 samples", "1 seeds"]
    {
        assert!(!shown.contains(wrong), "{wrong}");
    }
    for right in [
        "unknown: rendered elsewhere",
        "S = 1 take",
        "holds the noise of its one take",
        "No plot: rendered elsewhere.",
    ] {
        assert!(shown.contains(right), "{right}");
    }
}
