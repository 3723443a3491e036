//! The page in a browser: what is clicked and pressed shows what it should. Run by `cargo xtask page`,
//! which installs a browser where there is none; the tests themselves fail without one.

mod browser;
#[path = "../fixture/mod.rs"]
mod fixture;
mod gate;
mod layers;
mod print;

use browser::Browser;
use fixture::{Device, scorecard};
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use umbrage_frame::{Image, read_exr};
use umbrage_report::{Layout, write_report};

const SIZE: (u32, u32) = (160, 90);
const SCREEN: (u32, u32) = (1400, 1000);
const HOSTILE: &str =
    "</script><script>globalThis.broken = 1</script><img src=x onerror='globalThis.broken=1'>\"'";
/// In the fixture: light-matched `chss`, the fifth of the table.
const CHSS: usize = 4;

fn page(layout: Layout) -> (TempDir, Browser) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fixture::write(folder.path(), Device::Software, SIZE).expect("stored");
    let written = write_report(folder.path(), layout).expect("reported");
    let browser = viewer(&written.index);
    (folder, browser)
}

/// Opens a page at its viewer, and waits until its first window is whole.
fn viewer(index: &Path) -> Browser {
    let mut browser = Browser::open(index, SCREEN);
    browser.eval("document.documentElement.style.scrollBehavior = 'auto', document.querySelector('.stage').scrollIntoView({ block: 'center' })");
    browser.wait("document.querySelector('.stage').dataset.ready === 'true'");
    browser.eval("document.querySelector('.stage').focus({ preventScroll: true })");
    browser
}

fn picture(run: &Path, name: &str, layer: &str) -> Image<f32> {
    let path: PathBuf = run.join("pictures").join(name);
    let layers = read_exr(&path).expect("stored");
    layers.into_iter().find(|l| l.0 == layer).expect("a layer").1
}

/// Where a pixel's centre lies on the screen, in a stage that shows the whole picture.
fn on_screen(browser: &mut Browser, x: u32, y: u32) -> [f64; 2] {
    let place = browser.eval(&format!(
        "(() => {{ const b = document.querySelector('.stage canvas').getBoundingClientRect(); \
         const z = Number(document.querySelector('.stage').dataset.zoom); \
         return [b.left + b.width / 2 + ({x} + 0.5 - {} / 2) * z, b.top + b.height / 2 + ({y} + 0.5 - {} / 2) * z]; }})()",
        SIZE.0, SIZE.1
    ));
    [place[0].as_f64().expect("x"), place[1].as_f64().expect("y")]
}

/// The grey of the pixel whose centre is at a place of the screen: its lower right corner, where neither border nor number is.
fn grey_at(browser: &mut Browser, [x, y]: [f64; 2]) -> f64 {
    let value = browser.eval(&format!(
        "(() => {{ const c = document.querySelector('.stage canvas'), b = c.getBoundingClientRect(); \
         return c.getContext('2d').getImageData({x} + 3.2 - b.left, {y} + 3.2 - b.top, 1, 1).data[0]; }})()"
    ));
    value.as_f64().expect("a grey")
}

/// A level of 8 bits; half a step of rounding, and one of the browser's own.
fn same_grey(drawn: f64, value: f32) -> bool {
    (drawn - 255.0 * f64::from(value)).abs() <= 1.5
}

/// A pixel in part of the picture where the two differ by much.
fn different(a: &Image<f32>, b: &Image<f32>, columns: std::ops::Range<u32>) -> (u32, u32) {
    let places = (0..SIZE.1).flat_map(|y| columns.clone().map(move |x| (x, y)));
    let far = |&(x, y): &(u32, u32)| (a.at(x, y) - b.at(x, y)).abs();
    let all = places.filter(|p| far(p).is_finite());
    all.max_by(|p, q| far(p).total_cmp(&far(q))).expect("a pixel that is seen in both")
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn slider_flip_and_sides_show_the_right_picture_in_the_right_place() {
    let (run, mut browser) = page(Layout::SingleFile);
    let truth = picture(run.path(), "window-00-truth.exr", "reference.V");
    let hard = picture(run.path(), "window-00-variant-00.exr", "visibility.V");
    browser.key("1");
    let (left, right) = (different(&truth, &hard, 10..70), different(&truth, &hard, 90..150));
    for ((x, y), of) in [(left, &truth), (right, &hard)] {
        let place = on_screen(&mut browser, x, y);
        let drawn = grey_at(&mut browser, place);
        assert!(same_grey(drawn, *of.at(x, y)), "slider at {x}, {y}: {drawn} for {}", of.at(x, y));
    }
    let place = on_screen(&mut browser, left.0, left.1);
    browser.key_down("f");
    assert!(same_grey(grey_at(&mut browser, place), *hard.at(left.0, left.1)), "flip, held");
    browser.key_up("f");
    assert!(same_grey(grey_at(&mut browser, place), *truth.at(left.0, left.1)), "flip, let go");
    browser.point([place[0] + 40.0, place[1]]);
    assert!(same_grey(grey_at(&mut browser, place), *hard.at(left.0, left.1)), "flip, pointed at");
    browser.point([2.0, 2.0]);
    browser.key("b");
    assert_eq!(browser.eval("document.querySelector('.tag.left').textContent"), "Truth");
    assert_eq!(
        browser.eval("document.querySelector('.tag.right').textContent"),
        "hard, light-matched: shadow"
    );
    browser.key("d");
    let says = browser.eval("document.querySelector('.tag.left').textContent");
    assert_eq!(says, "hard, light-matched: shadow, minus Truth");
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn the_inspector_says_what_the_files_say() {
    let (run, mut browser) = page(Layout::SingleFile);
    let truth = picture(run.path(), "window-00-truth.exr", "reference.V");
    let depth = picture(run.path(), "window-00-truth.exr", "depth.Z");
    let file = "window-00-variant-04.exr";
    let [mask, error, swim] =
        ["visibility.V", "error.V", "swim.V"].map(|layer| picture(run.path(), file, layer));
    browser.wait("document.querySelectorAll('.inspector').length === 1");
    let value = |browser: &mut Browser, selector: &str| -> f32 {
        let text = browser.eval(&format!("document.querySelector(\"{selector}\")?.dataset.value ?? 'none'"));
        text.as_str().expect("text").parse().unwrap_or(f32::NAN)
    };
    for (x, y) in [different(&truth, &mask, 10..70), different(&truth, &mask, 90..150), (80, 60)] {
        let place = on_screen(&mut browser, x, y);
        browser.point(place);
        browser.wait(&format!("document.querySelector('.inspector tr[data-variant=\"{CHSS}\"] td[data-layer=swim]')?.dataset.value > -1"));
        assert_eq!(
            value(&mut browser, ".inspector dd[data-layer=truth]"),
            *truth.at(x, y),
            "truth at {x}, {y}"
        );
        let row = format!(".inspector tr[data-variant='{CHSS}']");
        assert_eq!(value(&mut browser, &format!("{row} td[data-layer=shadow]")), *mask.at(x, y));
        // Below 6e-5 a half float has fewer bits than a file: its step there is 2^-24.
        assert!(
            (value(&mut browser, &format!("{row} td[data-layer=swim]")) - swim.at(x, y)).abs()
                <= 2f32.powi(-24)
        );
        // The page takes the difference of two half floats, each within 2^-12 below 1.
        assert!(
            (value(&mut browser, &format!("{row} td[data-layer=error]")) - error.at(x, y)).abs()
                <= 2f32.powi(-11)
        );
        let shown = value(&mut browser, ".inspector dd[data-layer='depth, m']");
        assert!(
            (shown - depth.at(x, y)).abs() <= depth.at(x, y) * 2f32.powi(-11),
            "depth, half of a unit in the last place"
        );
    }
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn every_key_does_what_the_help_says() {
    let (_run, mut browser) = page(Layout::SingleFile);
    let text =
        |browser: &mut Browser, what: &str| browser.eval(what).as_str().unwrap_or_default().to_string();
    browser.key("3");
    assert_eq!(text(&mut browser, "document.querySelector('select.right').value"), "v2-shadow");
    browser.key("x");
    assert_eq!(text(&mut browser, "document.querySelector('select.left').value"), "v2-shadow");
    browser.key("r");
    assert_eq!(text(&mut browser, "document.querySelector('select.left').value"), "truth");
    for (key, mode) in [("d", "difference"), ("b", "side"), ("s", "slider")] {
        browser.key(key);
        assert_eq!(text(&mut browser, "document.querySelector('.stage').dataset.mode"), mode);
    }
    browser.key("e");
    assert_eq!(text(&mut browser, "document.querySelector('.exposure-value').textContent"), "+0.5");
    browser.key("E");
    assert_eq!(text(&mut browser, "document.querySelector('.exposure-value').textContent"), "0");
    browser.key("g");
    assert_eq!(text(&mut browser, "document.querySelector('[data-do=tiles]').ariaPressed"), "true");
    let before: f64 =
        text(&mut browser, "document.querySelector('.stage').dataset.zoom").parse().expect("a number");
    browser.key("+");
    let after: f64 =
        text(&mut browser, "document.querySelector('.stage').dataset.zoom").parse().expect("a number");
    assert!((after - 2.0 * before).abs() < 0.01);
    browser.key("0");
    browser.key("ArrowRight");
    let first = text(&mut browser, "document.querySelector('.inspector dd').textContent");
    browser.key("ArrowRight");
    assert_ne!(
        first,
        text(&mut browser, "document.querySelector('.inspector dd').textContent"),
        "the cursor moves"
    );
    browser.key("p");
    assert_eq!(text(&mut browser, "document.querySelector('[data-do=follow]').ariaPressed"), "true");
    browser.key("?");
    assert_eq!(browser.eval("document.querySelector('.help').open"), true);
    browser.key("Escape");
    assert_eq!(browser.eval("document.querySelector('.help').open"), false);
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn every_frame_is_shown_by_steps_and_by_playing() {
    let (run, mut browser) = page(Layout::SingleFile);
    let frames: Vec<Image<f32>> = (0..16)
        .map(|t| picture(run.path(), "window-00-variant-04-frames.exr", &format!("t{t:04}.V")))
        .collect();
    let (x, y) = different(&frames[0], &frames[5], 20..140);
    let place = on_screen(&mut browser, x, y);
    browser.point(place);
    browser.key("p");
    browser.wait("document.querySelector('.point svg path') !== null");
    let cell = format!(
        "document.querySelector(\".inspector tr[data-variant='{CHSS}'] td[data-layer=shadow]\").dataset.value"
    );
    let mut seen = std::collections::BTreeSet::new();
    for _ in 0..16 {
        browser.key(".");
        let frame: usize = browser
            .eval("document.querySelector('.stage').dataset.frame")
            .as_str()
            .expect("text")
            .parse()
            .expect("a frame");
        let shown: f32 = browser.eval(&cell).as_str().expect("text").parse().expect("a number");
        // One file holds frames in steps of 1/512.
        assert!((shown - frames[frame].at(x, y)).abs() <= 1.0 / 1024.0 + 1e-6, "frame {frame}");
        seen.insert(frame);
    }
    assert_eq!(seen.len(), 16);
    browser.eval("globalThis.seen = new Set(); new MutationObserver(() => seen.add(document.querySelector('.stage').dataset.frame)).observe(document.querySelector('.stage'), { attributes: true }); document.querySelector('.speed').value = '10'");
    browser.key(" ");
    browser.wait("seen.size === 16");
    browser.key(" ");
    assert_eq!(browser.eval("document.querySelector('[data-do=play]').textContent"), "Play");
    browser.key("m");
    browser.key(".");
    browser.wait("document.querySelector('.stage').dataset.ready === 'true'");
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn a_number_says_where_it_comes_from() {
    let (_run, mut browser) = page(Layout::SingleFile);
    browser.eval("document.querySelector('#table td[data-metric=error] button').click()");
    assert_eq!(browser.eval("document.querySelector('#trace').open"), true);
    let command = browser.eval("document.querySelector('#trace .command').textContent");
    assert!(
        command.as_str().is_some_and(|c| c.starts_with("umbrage evaluate standard --size")
            && c.ends_with("--variant hard/light-matched")),
        "{command}"
    );
    browser.eval(
        "[...document.querySelectorAll('#trace button')].find(b => b.textContent.startsWith('Look')).click()",
    );
    browser.wait("document.querySelector('.stage').dataset.mode === 'side'");
    assert_eq!(browser.eval("document.querySelector('select.right').value"), "v0-error");
    // Scores beside the table say it too.
    browser.eval("document.querySelector('#window-0 table.further td[data-metric] button').click()");
    assert_eq!(browser.eval("document.querySelector('#trace').open"), true);
    let command = browser.eval("document.querySelector('#trace .command').textContent");
    assert!(command.as_str().is_some_and(|c| c.contains("--path") && c.contains("--variant")), "{command}");
    browser.eval("document.querySelector('#trace').close()");
    // A plot that was scrubbed before it was copied into the viewer brings no second cursor.
    browser.key(".");
    browser.eval(
        "document.querySelector('#table td[data-metric=swimming] button').click(), \
         [...document.querySelectorAll('#trace button')].find(b => b.textContent.startsWith('Look')).click()",
    );
    assert_eq!(browser.eval("document.querySelectorAll('.viewer .swimming .now').length"), 1);
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn hostile_names_run_nothing_and_nothing_is_fetched() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fixture::write(folder.path(), Device::Software, SIZE).expect("stored");
    let mut card = scorecard(Device::Software, SIZE);
    card.windows[0].scene = HOSTILE.into();
    card.windows[0].path = HOSTILE.into();
    card.variants[0].name = HOSTILE.into();
    card.provenance.command = HOSTILE.into();
    card.provenance.suite = HOSTILE.into();
    card.metrics[0].definition = HOSTILE.into();
    card.save(&folder.path().join("scorecard.json")).expect("stored");
    let written = write_report(folder.path(), Layout::SingleFile).expect("reported");
    let mut browser = viewer(&written.index);
    browser.eval("document.querySelector('#table td[data-metric=error] button').click()");
    browser.eval("document.querySelector('#trace').close()");
    for key in ["1", "d", ".", "p"] {
        browser.key(key);
    }
    assert_eq!(browser.eval("globalThis.broken === undefined"), true);
    let shown = browser.eval("document.querySelector('select.where').options[0].text");
    assert!(shown.as_str().is_some_and(|s| s.starts_with("</script>")), "{shown}");
    assert_eq!(browser.requests(), [format!("file://{}", written.index.display())]);
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn planes_beside_the_page_are_read_from_a_disk() {
    let (run, mut browser) = page(Layout::Folder);
    browser.key("b");
    let as_printed = "document.querySelector('select.right').value = 'v11-swim', document.querySelector('select.right').dispatchEvent(new Event('change'))";
    browser.eval(as_printed);
    browser.settle();
    browser.wait("document.querySelector('.stage').dataset.ready === 'true'");
    for url in browser.requests() {
        let file = url.strip_prefix("file://").expect("from the disk alone");
        assert!(Path::new(file).starts_with(run.path()), "{url}");
    }
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn long_names_fit_a_narrow_screen() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fixture::write(folder.path(), Device::Software, SIZE).expect("stored");
    let mut card = scorecard(Device::Software, SIZE);
    let long = "a_scene_whose_name_has_no_end_".repeat(6);
    card.windows[0].scene = long.clone();
    card.windows[0].path = long.clone();
    card.provenance.suite = long.clone();
    card.provenance.scenes[0].name = long;
    card.variants[4].name = "a-variant-whose-name-has-no-end-".repeat(4);
    card.save(&folder.path().join("scorecard.json")).expect("stored");
    let written = write_report(folder.path(), Layout::SingleFile).expect("reported");
    let mut browser = Browser::open(&written.index, (390, 844));
    browser.eval("document.querySelectorAll('details').forEach(d => d.open = true)");
    // What is wider than the screen scrolls inside itself; the page does not.
    let wide = browser.eval(
        "[...document.querySelectorAll('main *, header *')].filter(e => e.getBoundingClientRect().right > innerWidth + 1 && !e.closest('.wide, .strip-row, pre, select, dialog')).slice(0, 5).map(e => e.outerHTML.slice(0, 90)).join('\\n')",
    );
    assert_eq!(wide, "");
    assert_eq!(browser.eval("document.documentElement.scrollWidth"), 390);
}
