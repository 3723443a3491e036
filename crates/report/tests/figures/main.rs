//! Figures of a stored run.

mod animation;
#[path = "../fixture/mod.rs"]
mod fixture;
mod names;
mod pdf;

use fixture::Device;
use umbrage_frame::read_exr;
use umbrage_report::{FigureRequest, write_figures};

fn request() -> FigureRequest {
    let crops = vec![[10, 12, 16, 8]];
    FigureRequest {
        scene: None,
        path: None,
        variants: vec!["chss".into(), "hard/as-printed".into()],
        crops,
        times: 2,
    }
}

#[test]
fn a_run_becomes_crops_plots_tables_and_animations() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fixture::write(folder.path(), Device::Gpu, (64, 36)).expect("stored");
    let out = folder.path().join("figures");
    let written = write_figures(folder.path(), &request(), &out).expect("figures");
    let names: Vec<_> = written.iter().filter_map(|p| p.file_name()?.to_str()).collect();
    for name in [
        "crops.png",
        "crop-0.exr",
        "cost.svg",
        "cost.pdf",
        "swimming.svg",
        "swimming.pdf",
        "scores.tex",
        "scores.csv",
        "path-follow.png",
    ] {
        assert!(names.contains(&name) && out.join(name).is_file(), "{name} in {names:?}");
    }
    let inset = read_exr(&out.join("crop-0.exr")).expect("an EXR file");
    let whole = read_exr(&folder.path().join("pictures/window-00-variant-04.exr")).expect("stored");
    let layer = |layers: &[umbrage_frame::Layer], name: &str| {
        layers.iter().find(|l| l.0 == name).expect("there").1.clone()
    };
    let (inset, whole) = (layer(&inset, "chss-light-matched.V"), layer(&whole, "visibility.V"));
    assert_eq!((inset.width(), inset.height()), (16, 8));
    assert_eq!(inset.at(3, 2), whole.at(13, 14));
    let sheet = image::open(out.join("crops.png")).expect("a picture");
    // Three panels of 64x36 twice as large, 8 px between them; insets of 16x8 in a panel's width below.
    assert_eq!((sheet.width(), sheet.height()), (3 * 128 + 2 * 8, 72 + 8 + 64));
    let animated = std::fs::read(out.join("path-follow.png")).expect("written");
    let control = animated.windows(4).position(|w| w == b"acTL").expect("an animation") + 4;
    assert_eq!(animated[control..control + 4], 16u32.to_be_bytes(), "frames; as printed ones have them too");
    let tex = std::fs::read_to_string(out.join("scores.tex")).expect("written");
    assert!(tex.contains("\nchss & ") && tex.contains("\nhard (as printed) & "), "{tex}");
    let svg = std::fs::read_to_string(out.join("swimming.svg")).expect("written");
    assert!(svg.starts_with("<svg xmlns=") && svg.trim_end().ends_with("</svg>"));
    // Plots too are of the chosen ones alone.
    assert!(
        svg.contains(">chss, light-matched</text>")
            || svg.contains(">chss (light-matched)</text>")
            || svg.contains(">chss</text>"),
        "{svg}"
    );
    assert!(!svg.contains("pcf"), "{svg}");
}

#[test]
fn what_a_run_does_not_have_is_said() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fixture::write(folder.path(), Device::Software, (64, 36)).expect("stored");
    let out = folder.path().join("figures");
    let none = FigureRequest { variants: vec!["nothing".into()], ..request() };
    let message = write_figures(folder.path(), &none, &out).expect_err("no such variant").to_string();
    assert!(message.contains("no pictures of \"nothing\""), "{message}");
    let still = FigureRequest { scene: Some("d1-edge-ladder".into()), ..request() };
    write_figures(folder.path(), &still, &out).expect("a still has figures too");
    let captions = std::fs::read_to_string(out.join("captions.txt")).expect("written");
    assert!(captions.contains("No frames are stored"), "{captions}");
}

/// The two files of a plot say the same: every piece of text, and as many shapes.
#[test]
fn a_plot_as_pdf_has_what_its_svg_has() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fixture::write(folder.path(), Device::Gpu, (64, 36)).expect("stored");
    let out = folder.path().join("figures");
    write_figures(folder.path(), &request(), &out).expect("figures");
    for name in ["cost", "swimming"] {
        let text = std::fs::read_to_string(out.join(format!("{name}.svg"))).expect("written");
        let svg = roxmltree::Document::parse(&text).expect("XML");
        let sheet = pdf::read(&std::fs::read(out.join(format!("{name}.pdf"))).expect("written"));
        let elements = |name: &'static str| svg.descendants().filter(move |e| e.has_tag_name(name));
        // A label is written twice: its outline lies under its letters.
        let twice = |label: bool| if label { 2 } else { 1 };
        let texts: Vec<&str> = elements("text")
            .flat_map(|e| vec![e.text().unwrap_or_default(); twice(e.attribute("class") == Some("label"))])
            .collect();
        assert_eq!(sheet.texts, texts);
        assert!(texts.contains(&"chss (light-matched)"), "names beside the plot: {texts:?}");
        let shapes: usize =
            ["line", "path", "polygon", "circle"].map(|name| elements(name).count()).iter().sum();
        let painted = |o: &&String| ["S", "f", "B"].contains(&o.as_str());
        assert_eq!(sheet.operators.iter().filter(painted).count(), shapes);
    }
}

#[test]
fn a_crop_outside_the_picture_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fixture::write(folder.path(), Device::Software, (64, 36)).expect("stored");
    let out = folder.path().join("figures");
    // Beyond it, over its right edge by a pixel, and beyond what an edge can be added to.
    for crop in [[64, 0, 1, 1], [49, 12, 16, 8], [u32::MAX, 0, 2, 2]] {
        let asked = FigureRequest { crops: vec![[0, 0, 8, 8], crop], ..request() };
        let message = write_figures(folder.path(), &asked, &out).expect_err("refused").to_string();
        let [x, y, w, h] = crop;
        assert!(message.contains(&format!("{x},{y},{w},{h}")) && message.contains("64x36"), "{message}");
        assert!(!out.exists(), "nothing is written before");
    }
    let whole = FigureRequest { crops: vec![[0, 0, 64, 36]], ..request() };
    write_figures(folder.path(), &whole, &out).expect("all of it is inside");
}

#[test]
fn a_figure_that_no_machine_holds_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fixture::write(folder.path(), Device::Software, (64, 36)).expect("stored");
    let out = folder.path().join("figures");
    // An inset as wide as its panel of 1024, of a pixel by 36, is 36,864 high; eight of them stand in a row.
    let tall = FigureRequest { variants: vec![], crops: vec![[0, 0, 1, 36]], times: 16, ..request() };
    let many = FigureRequest { crops: vec![[0, 0, 8, 8]; 20], times: 1, ..request() };
    for (asked, words) in [(tall, "is too large"), (many, "20 insets do not fit")] {
        let message = write_figures(folder.path(), &asked, &out).expect_err("refused").to_string();
        assert!(message.contains(words), "{message}");
    }
}
