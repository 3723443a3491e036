//! Names that mean something to one of the formats, and runs that are not our own variants'.

use crate::fixture::{self, Device};
use crate::{pdf, request};
use std::collections::BTreeSet;
use umbrage_frame::read_exr;
use umbrage_report::{Calibration, FigureRequest, Scorecard, write_figures};

const HOSTILE: [&str; 4] = ["</text><script>x</script>", "[a]--b\\input{c}%\n\n&", "a b", "a_b"];

fn renamed(folder: &std::path::Path, change: impl Fn(&mut Scorecard)) {
    fixture::write(folder, Device::Gpu, (64, 36)).expect("stored");
    let mut card = fixture::scorecard(Device::Gpu, (64, 36));
    change(&mut card);
    card.save(&folder.join("scorecard.json")).expect("stored");
}

#[test]
fn names_are_text_in_every_format() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    renamed(folder.path(), |card| {
        for (variant, name) in HOSTILE.iter().enumerate() {
            card.variants[variant].name = (*name).into();
        }
        card.windows[0].scene = "hall\u{1b}[2J\n".into();
    });
    let out = folder.path().join("figures");
    let asked = FigureRequest { variants: HOSTILE.map(String::from).to_vec(), ..request() };
    write_figures(folder.path(), &asked, &out).expect("figures");
    let read = |name: &str| std::fs::read_to_string(out.join(name)).expect("text");

    let layers = read_exr(&out.join("crop-0.exr")).expect("an EXR file");
    let names: BTreeSet<&str> = layers.iter().map(|l| l.0.as_str()).collect();
    assert_eq!((layers.len(), names.len()), (5, 5), "{names:?}");

    for name in ["cost.svg", "swimming.svg"] {
        let text = read(name);
        let svg = roxmltree::Document::parse(&text).expect("XML");
        assert!(!svg.descendants().any(|e| e.has_tag_name("script")), "{name}");
    }
    let sheet = pdf::read(&std::fs::read(out.join("cost.pdf")).expect("written"));
    assert!(sheet.texts.iter().any(|t| t == HOSTILE[0]), "{:?}", sheet.texts);

    let tex = read("scores.tex");
    assert!(tex.contains("\n{}[a]-{}-b\\textbackslash{}input\\{c\\}\\%  \\& & "), "{tex}");
    assert_eq!(tex.lines().filter(|l| l.ends_with("\\\\")).count(), 5, "a head and four rows:\n{tex}");
    assert!(read("scores.csv").contains("\n\"[a]--b\\input{c}%\n\n&\","), "quoted");
    let captions = read("captions.txt");
    assert!(!captions.contains('\u{1b}') && captions.lines().count() == 2, "{captions}");
}

/// Those of another program, and those of a run that has nothing light-matched.
#[test]
fn a_name_is_found_whatever_its_calibration() {
    for calibration in [Calibration::Elsewhere, Calibration::AsPrinted] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        renamed(folder.path(), |card| {
            for (place, variant) in card.variants.iter_mut().enumerate() {
                variant.name = format!("{}-{place}", variant.name);
                variant.calibration = calibration;
            }
        });
        let out = folder.path().join("figures");
        for variants in [vec![], vec!["chss-4".to_string()]] {
            let asked = FigureRequest { variants, ..request() };
            write_figures(folder.path(), &asked, &out).expect("figures");
            let csv = std::fs::read_to_string(out.join("scores.csv")).expect("written");
            assert!(csv.lines().any(|l| l.starts_with("chss-4")), "{csv}");
        }
    }
}
