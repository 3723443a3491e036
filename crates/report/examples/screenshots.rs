//! Pictures of a run's page for the README: `screenshots RUN FOLDER`. `cargo xtask screenshots` calls it.
//!
//! Makes the run's page again and drives it in a headless browser as the page's own tests do.
#![expect(clippy::print_stdout, reason = "a program that talks to people")]

#[expect(dead_code, reason = "pictures need less of a browser than tests do")]
#[path = "../tests/page/browser.rs"]
mod browser;

use browser::Browser;
use serde_json::json;
use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};
use umbrage_frame::{Image, read_exr};
use umbrage_report::{Calibration, Layout, Scorecard, Surface, write_report};

type Outcome<T> = Result<T, Box<dyn Error>>;

const SCREEN: (u32, u32) = (1400, 1100);
/// What is shown: a variant that swims in a place that has everything.
const SHOWN: (&str, &str, &str) = ("colonnade", "P4", "chss-mask");
/// Above and below what is shown, in pixels.
const MARGIN: f64 = 6.0;
/// What a README can bear, in bytes.
const LARGEST: usize = 200_000;

fn main() -> Outcome<()> {
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [run, out] = arguments.as_slice() else { return Err("screenshots RUN FOLDER".into()) };
    std::fs::create_dir_all(out)?;
    let shown = Shown::of(run)?;
    let page = write_report(run, Layout::SingleFile)?.index.canonicalize()?;
    let mut browser = Browser::open(&page, SCREEN);
    let light = json!({ "features": [{ "name": "prefers-color-scheme", "value": "light" }] });
    browser.call("Emulation.setEmulatedMedia", light);
    browser.eval("document.documentElement.style.scrollBehavior = 'auto'");

    // From the name of the suite to the light-matched rows of the table.
    keep(
        &mut browser,
        ("header", "#table tbody.variant:nth-of-type(5), #table tbody:nth-of-type(5)"),
        &out.join("page.png"),
    )?;
    shown.look(&mut browser);
    keep(&mut browser, (".viewer", ".viewer .looks"), &out.join("page-viewer.png"))?;
    shown.follow(&mut browser);
    keep(&mut browser, (".viewer .transport", ".viewer .findings"), &out.join("page-time.png"))
}

/// A window, a variant, and the point of its penumbrae that swims most.
struct Shown {
    window: usize,
    variant: usize,
    point: (u32, u32),
    size: (u32, u32),
}

impl Shown {
    /// The first of each where the run has no such scene, path or variant.
    fn of(run: &Path) -> Outcome<Self> {
        let card = Scorecard::load(&run.join("scorecard.json"))?;
        let (scene, path, name) = SHOWN;
        let window =
            card.windows.iter().position(|w| w.scene == scene && w.path.starts_with(path)).unwrap_or(0);
        let is_it =
            |v: &umbrage_report::VariantCard| v.name == name && v.calibration != Calibration::AsPrinted;
        let variant = card.variants.iter().position(is_it).unwrap_or(0);
        let plane = |file: String, layer: &str| -> Outcome<Image<f32>> {
            let layers = read_exr(&run.join("pictures").join(file))?;
            Ok(layers.into_iter().find(|l| l.0 == layer).ok_or_else(|| format!("no layer {layer}"))?.1)
        };
        let swim = plane(format!("window-{window:02}-variant-{variant:02}.exr"), "swim.V")?;
        let region = plane(format!("window-{window:02}-truth.exr"), "region.V")?;
        let size = (swim.width(), swim.height());
        // Not at the edge, where the view cannot be centred.
        let places =
            (size.1 / 4..3 * size.1 / 4).flat_map(|y| (size.0 / 4..3 * size.0 / 4).map(move |x| (x, y)));
        let inside =
            places.filter(|&(x, y)| *region.at(x, y) == Surface::PENUMBRA && swim.at(x, y).is_finite());
        let point = inside.max_by(|a, b| swim.at(a.0, a.1).total_cmp(swim.at(b.0, b.1)));
        Ok(Self { window, variant, point: point.ok_or("no penumbra in the middle of the picture")?, size })
    }

    /// Truth to the left of the slider, the variant to the right; the cursor on the point.
    fn look(&self, browser: &mut Browser) {
        // The viewer starts when it comes into sight.
        browser.eval("document.querySelector('.stage').scrollIntoView({ block: 'center' })");
        browser.wait("document.querySelector('.stage').dataset.ready === 'true'");
        choose(browser, "select.where", &self.window.to_string());
        choose(browser, "select.left", "truth");
        choose(browser, "select.right", &format!("v{}-shadow", self.variant));
        browser.wait("document.querySelector('.stage').dataset.ready === 'true'");
        browser.eval("document.querySelector('.stage').focus({ preventScroll: true })");
        self.point_at(browser);
    }

    fn point_at(&self, browser: &mut Browser) {
        let ((x, y), (width, height)) = (self.point, self.size);
        let place = browser.eval(&format!(
            "(() => {{ const b = document.querySelector('.stage canvas').getBoundingClientRect(), z = Number(document.querySelector('.stage').dataset.zoom); \
             return [b.left + b.width / 2 + ({x} + 0.5 - {width} / 2) * z, b.top + b.height / 2 + ({y} + 0.5 - {height} / 2) * z]; }})()"
        ));
        browser.point([place[0].as_f64().unwrap_or_default(), place[1].as_f64().unwrap_or_default()]);
        browser.settle();
    }

    /// The point pinned, a frame shown from its own camera.
    fn follow(&self, browser: &mut Browser) {
        // A picture of more than the screen moves the page under the pointer.
        browser.eval("document.querySelector('.stage').scrollIntoView({ block: 'center' })");
        browser.point([2.0, 2.0]);
        self.point_at(browser);
        browser.key("p");
        browser.wait("document.querySelector('.point svg path') !== null");
        browser.key(".");
        browser.wait("document.querySelector('.stage').dataset.ready === 'true'");
    }
}

fn choose(browser: &mut Browser, select: &str, value: &str) {
    browser.eval(&format!(
        "(() => {{ const s = document.querySelector('{select}'); s.value = '{value}'; s.dispatchEvent(new Event('change', {{ bubbles: true }})); }})()"
    ));
    browser.settle();
}

/// A picture of the page from the top of one element to the end of another.
fn keep(browser: &mut Browser, (from, to): (&str, &str), file: &Path) -> Outcome<()> {
    browser.settle();
    let ends = browser.eval(&format!(
        "(() => {{ const at = (s) => document.querySelector(s).getBoundingClientRect(); return [at('{from}').top + scrollY, at('{to}').bottom + scrollY]; }})()"
    ));
    let [top, bottom] = [0, 1].map(|i| ends[i].as_f64().unwrap_or_default());
    let top = (top - MARGIN).max(0.0);
    let clip = json!({ "x": 0, "y": top, "width": SCREEN.0, "height": bottom + MARGIN - top, "scale": 1 });
    let shot = browser.call(
        "Page.captureScreenshot",
        json!({ "format": "png", "clip": clip, "captureBeyondViewport": true }),
    );
    let bytes = small(&base64::decode(shot["data"].as_str().unwrap_or_default())?)?;
    if bytes.len() > LARGEST {
        return Err(
            format!("{} would have {} bytes, more than {LARGEST}", file.display(), bytes.len()).into()
        );
    }
    std::fs::write(file, &bytes)?;
    println!("{} ({} KB)", file.display(), bytes.len().div_ceil(1000));
    Ok(())
}

/// The same picture with 256 colours, each chosen where those before it are furthest from most pixels: the few
/// pixels of a marker keep their hue beside the many between a letter and its paper.
fn small(file: &[u8]) -> Outcome<Vec<u8>> {
    let picture = image::load_from_memory(file)?.to_rgb8();
    let mut counts: BTreeMap<[u8; 3], u64> = BTreeMap::new();
    picture.pixels().for_each(|p| *counts.entry(p.0).or_default() += 1);
    let far = |a: [u8; 3], b: [u8; 3]| (0..3).map(|i| u64::from(a[i].abs_diff(b[i])).pow(2)).sum::<u64>();
    // Of each colour: how often, how far from the nearest in the palette, and which that is.
    let mut colours: Vec<([u8; 3], u64, u64, u8)> =
        counts.into_iter().map(|(c, n)| (c, n, u64::MAX >> 32, 0)).collect();
    let mut palette: Vec<[u8; 3]> = Vec::new();
    while let Some(worst) =
        colours.iter().max_by_key(|c| c.1 * c.2).filter(|c| c.2 > 0 && palette.len() < 256)
    {
        let (chosen, place) = (worst.0, palette.len() as u8);
        palette.push(chosen);
        for colour in &mut colours {
            let distance = far(colour.0, chosen);
            if distance < colour.2 {
                (colour.2, colour.3) = (distance, place);
            }
        }
    }
    let places: BTreeMap<[u8; 3], u8> = colours.iter().map(|c| (c.0, c.3)).collect();
    let indices: Vec<u8> = picture.pixels().map(|p| places[&p.0]).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.width(), picture.height());
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette.concat());
    encoder.set_compression(png::Compression::High);
    encoder.write_header()?.write_image_data(&indices)?;
    Ok(bytes)
}
