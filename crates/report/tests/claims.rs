//! The claims page and table, from a made-up card.

use std::collections::BTreeMap;
use std::path::Path;
use umbrage_frame::Image;
use umbrage_metrics::Score;
use umbrage_report::{
    AdapterCard, ClaimCard, ClaimPart, ClaimsCard, ClaimsProvenance, Crop, CropPanel, DocumentTime,
    EffectKind, Outcome, ReportError, Verdict, publish_claims, write_claims,
};

const HOSTILE: &str = "<script>alert(1)</script>&\"'|";

fn part(outcome: Outcome) -> ClaimPart {
    ClaimPart {
        says: HOSTILE.into(),
        number: "error".into(),
        a: HOSTILE.into(),
        b: "chss".into(),
        places: vec![HOSTILE.into()],
        expect: "below".into(),
        margin: 0.05,
        margin_reason: Some(HOSTILE.into()),
        effect_kind: EffectKind::Ratio,
        effect: Some(Score { value: -0.231, low: -0.25, high: -0.21 }),
        value_a: Some(Score::exact(0.01)),
        value_b: Some(Score::exact(0.013)),
        outcome,
        reason: None,
        seeds: 4,
        frames: 16,
        tiles: 212,
        per_place: vec![],
    }
}

fn card() -> ClaimsCard {
    let claim = |id: &str, verdict, outcome| ClaimCard {
        id: id.into(),
        document: "first".into(),
        statement: HOSTILE.into(),
        note: Some(HOSTILE.into()),
        verdict,
        parts: vec![part(outcome)],
        crop: None,
        crop_caption: None,
    };
    let adapter = AdapterCard {
        name: HOSTILE.into(),
        driver: "d".into(),
        backend: "vulkan".into(),
        device_type: "software".into(),
        is_cpu: true,
    };
    ClaimsCard {
        schema_version: 1,
        provenance: ClaimsProvenance {
            tool_version: "0".into(),
            date: "2026-01-01T00:00:00Z".into(),
            command: format!("umbrage claims {HOSTILE}"),
            adapter,
            width: 320,
            height: 180,
            frames: 16,
            seeds: 4,
            samples_per_half: 512,
            shadow_map_texels: 2048,
            costs: None,
            notes: vec![HOSTILE.into()],
        },
        claims: vec![
            claim("C7", Verdict::Fails, Outcome::Fails),
            claim("C12", Verdict::NeedsGpu, Outcome::NeedsGpu),
        ],
        times: vec![DocumentTime {
            what: HOSTILE.into(),
            document_ms: 1.72,
            document_ratio: 2.05,
            ours: "chss".into(),
            ratio: None,
        }],
    }
}

fn crop() -> Crop {
    let panel = |label: &str| CropPanel {
        label: label.into(),
        plane: Image::from_fn(96, 54, |x, y| if y == 0 { f32::NAN } else { x as f32 / 96.0 }),
    };
    Crop { panels: vec![panel("truth"), panel(HOSTILE)], caption: "somewhere".into() }
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).expect(name)
}

#[test]
fn the_page_shows_every_verdict_and_loads_nothing() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let crops = BTreeMap::from([("C7".to_string(), crop())]);
    let mut card = card();
    write_claims(folder.path(), &mut card, &crops).expect("written");
    let html = read(folder.path(), "index.html");
    assert!(html.contains("Fails") && html.contains("Needs a GPU") && html.contains("needs a GPU"));
    assert!(html.contains("−23.1\u{a0}% [−25.0 to −21.0]"), "effect and interval");
    assert!(html.contains("4 seeds, 16 frames, 212 tiles"));
    assert!(html.contains("&lt;script&gt;alert(1)") && !html.contains("<script"));
    for part in ["http://", "https://", "<link", "<iframe", "@import", "javascript:"] {
        assert!(!html.contains(part), "{part}");
    }
    for source in html.split(" src=\"").skip(1) {
        assert!(source.starts_with("data:image/png;base64,"));
    }
    assert_eq!(card.claims[0].crop.as_deref(), Some("claims/C07.png"));
    let png = image::open(folder.path().join("claims/C07.png")).expect("a picture");
    assert_eq!((png.width(), png.height()), (2 * 96 * 3 + 6, 54 * 3), "two crops, magnified three times");
}

#[test]
fn the_table_is_escaped_and_published_as_it_is() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = folder.path().join("run");
    std::fs::create_dir_all(&run).expect("made");
    write_claims(&run, &mut card(), &BTreeMap::from([("C7".to_string(), crop())])).expect("written");
    let text = read(&run, "claims.md");
    assert!(text.contains("Fails **1**") && text.contains("| [C7](#c7) |"));
    assert!(text.contains("(1 of 1 parts not measured)"));
    // A command stands as it is, in a fence; everywhere else text is escaped.
    let outside: String = text.split("```").step_by(2).collect();
    assert!(!outside.contains("<script") && outside.contains("\\|"), "{text}");
    publish_claims(&run, &folder.path().join("reports")).expect("published");
    assert_eq!(read(folder.path(), "reports/claims.md"), text);
    assert!(folder.path().join("reports/claims/C07.png").exists());
    let back: ClaimsCard = serde_json::from_str(&read(&run, "claims.json")).expect("read back");
    assert_eq!(back.claims[1].verdict, Verdict::NeedsGpu);
}

#[test]
fn nan_is_never_written() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut card = card();
    card.claims[0].parts[0].effect = Some(Score::exact(f64::NAN));
    let error = write_claims(folder.path(), &mut card, &BTreeMap::new()).expect_err("refused");
    assert!(matches!(error, ReportError::NotFinite { .. }), "{error}");
    assert!(!folder.path().join("claims.json").exists());
}
