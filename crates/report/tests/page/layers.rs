//! The layers of the viewer, what stands on and under them, and how they are reached.

use super::browser::Browser;
use super::{CHSS, SIZE, on_screen, page, picture};
use umbrage_frame::Image;
use umbrage_report::Layout;

fn text(browser: &mut Browser, selector: &str) -> String {
    let found = browser.eval(&format!("document.querySelector({selector:?})?.textContent ?? 'nothing'"));
    found.as_str().unwrap_or_default().to_string()
}

fn choose(browser: &mut Browser, slot: &str, layer: &str) {
    browser.eval(&format!(
        "(s => {{ s.value = {layer:?}; s.dispatchEvent(new Event('change')); }})(document.querySelector('select.{slot}'))"
    ));
    browser.settle();
    browser.wait("document.querySelector('.stage').dataset.ready === 'true'");
}

fn value(browser: &mut Browser, selector: &str) -> f32 {
    let found = browser.eval(&format!("document.querySelector({selector:?})?.dataset.value ?? 'none'"));
    found.as_str().expect("text").parse().unwrap_or(f32::NAN)
}

/// Where a plane has a number, in row order.
fn numbers(plane: &Image<f32>) -> impl Iterator<Item = (u32, u32, f32)> {
    let places = (0..plane.height()).flat_map(|y| (0..plane.width()).map(move |x| (x, y)));
    places.map(|(x, y)| (x, y, *plane.at(x, y))).filter(|p| p.2.is_finite())
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn every_cell_is_a_map_with_one_range_for_all_variants() {
    let (run, mut browser) = page(Layout::SingleFile);
    let kinds = ["mse", "banding", "swimming", "smooth_static", "structured_static", "smooth_moving"];
    for kind in kinds.into_iter().chain(["structured_moving", "noise"]) {
        choose(&mut browser, "right", &format!("v{CHSS}-{kind}"));
        let legend = text(&mut browser, ".legends > :last-child");
        assert!(legend.contains("visibility, root, by tile"), "{kind}: {legend}");
        assert!(text(&mut browser, ".captions p:last-child").contains("of each tile"), "{kind}");
        choose(&mut browser, "right", &format!("v3-{kind}"));
        assert_eq!(legend, text(&mut browser, ".legends > :last-child"), "one range, {kind}");
    }
    // The inspector's tile is the stored one: a root in a half float, squared again.
    let noise = picture(run.path(), "window-00-variant-04-tiles.exr", "noise.V");
    let (column, row, stored) = numbers(&noise).max_by(|a, b| a.2.total_cmp(&b.2)).expect("a tile");
    let place = on_screen(&mut browser, (32 * column + 16).min(SIZE.0 - 8), (32 * row + 16).min(SIZE.1 - 4));
    browser.point(place);
    let cell = format!(".tile-scores tr[data-variant='{CHSS}'] td[data-layer=tile-noise]");
    let shown = value(&mut browser, &cell);
    assert!((shown - stored).abs() <= stored * 2f32.powi(-9), "{shown} {stored}");
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn beside_a_page_cells_are_maps_of_pixels() {
    let (_run, mut browser) = page(Layout::Folder);
    choose(&mut browser, "right", &format!("v{CHSS}-noise"));
    let legend = text(&mut browser, ".legends > :last-child");
    assert!(legend.contains("visibility, root") && !legend.contains("by tile"), "{legend}");
    assert!(text(&mut browser, ".captions p:last-child").contains("at each point"));
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn the_inspector_has_the_penumbra_s_width_or_says_why_not() {
    let (run, mut browser) = page(Layout::SingleFile);
    let width = picture(run.path(), "window-00-truth.exr", "width.V");
    let region = picture(run.path(), "window-00-truth.exr", "region.V");
    let (x, y, metres) = numbers(&width).nth(400).expect("a penumbra");
    let place = on_screen(&mut browser, x, y);
    browser.point(place);
    browser.wait("document.querySelector(\".inspector dd[data-layer='penumbra width, m']\") !== null");
    assert_eq!(value(&mut browser, ".inspector dd[data-layer='penumbra width, m']"), metres);
    let lit = numbers(&region).find(|p| p.2 == 3.0).expect("a lit pixel");
    let place = on_screen(&mut browser, lit.0, lit.1);
    browser.point(place);
    let says = text(&mut browser, ".inspector dd[data-layer='penumbra width, m']");
    assert_eq!(says, "– (only a penumbra has a width)");
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn a_pinned_point_stays_in_the_middle_and_the_inspector_goes_on() {
    let (_run, mut browser) = page(Layout::SingleFile);
    let place = on_screen(&mut browser, 60, 50);
    browser.point(place);
    browser.key("p");
    browser.key("m");
    browser.point([2.0, 2.0]);
    assert_eq!(text(&mut browser, ".inspector h3"), "At the pinned point");
    for _ in 0..4 {
        browser.key(".");
        browser.wait("document.querySelector('.stage').dataset.ready === 'true'");
        assert!(text(&mut browser, ".inspector dd").contains("60, 50"));
        // Its ring is amber; no grey is. Four pixels of a zoom of eight is its least radius.
        let amber = browser.eval(
            "(() => { const c = document.querySelector('.stage canvas'), z = Number(document.querySelector('.stage').dataset.zoom); \
             const r = Math.max(7, Math.min(z / 2, 22)), at = (a) => [...c.getContext('2d').getImageData(Math.round(c.width / 2 + r * Math.cos(a)), Math.round(c.height / 2 + r * Math.sin(a)), 1, 1).data]; \
             return [0.8, 2.3, 3.9, 5.5].filter(a => { const [red, , blue] = at(a); return red > blue + 60; }).length; })()",
        );
        assert!(amber.as_f64().is_some_and(|n| n >= 3.0), "{amber} of 4 places on the ring");
    }
    let other = browser.eval(
        "(() => { const b = document.querySelector('.stage').getBoundingClientRect(); return [b.left + b.width / 2 + 200, b.top + b.height / 2 + 60]; })()",
    );
    browser.point([other[0].as_f64().expect("x"), other[1].as_f64().expect("y")]);
    assert_eq!(text(&mut browser, ".inspector h3"), "At this pixel");
    assert!(!text(&mut browser, ".inspector dd").contains("60, 50"));
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn pixels_have_numbers_from_eight_times_on_and_say_in_what_steps() {
    let (_run, mut browser) = page(Layout::SingleFile);
    let says = |browser: &mut Browser| text(browser, ".legends > :first-child");
    // The whole picture fits at a little more than eight times: one digit has room.
    let zoom =
        browser.eval("Number(document.querySelector('.stage').dataset.zoom)").as_f64().expect("a zoom");
    assert!((8.0..9.0).contains(&zoom), "{zoom}");
    assert!(
        says(&mut browser).ends_with("numbers in steps of 0.1; + is 10 or more"),
        "{}",
        says(&mut browser)
    );
    browser.key("-");
    assert!(!says(&mut browser).contains("numbers"), "below eight times there are none");
    for _ in 0..3 {
        browser.key("+");
    }
    assert!(!says(&mut browser).contains("numbers"), ".42 fits as it is");
    browser.key("-");
    choose(&mut browser, "left", &format!("v{CHSS}-error"));
    let error = says(&mut browser);
    assert!(error.contains("numbers without sign, in steps of"), "{error}");
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn unlike_layers_have_no_difference_and_the_mask_names_its_parts() {
    let (_run, mut browser) = page(Layout::SingleFile);
    choose(&mut browser, "right", "depth");
    browser.key("d");
    assert!(
        text(&mut browser, ".refusal").starts_with("No difference: “Depth” and “Truth” are not of one kind.")
    );
    assert_eq!(browser.eval("document.querySelector('.refusal').hidden"), false);
    choose(&mut browser, "right", &format!("v{CHSS}-shadow"));
    assert_eq!(browser.eval("document.querySelector('.refusal').hidden"), true);
    // Two maps of one kind have one, whatever the kind.
    choose(&mut browser, "left", &format!("v{CHSS}-noise"));
    assert_eq!(browser.eval("document.querySelector('.refusal').hidden"), false);
    choose(&mut browser, "right", "v3-noise");
    assert_eq!(browser.eval("document.querySelector('.refusal').hidden"), true);
    browser.key("s");
    choose(&mut browser, "left", "region");
    let legend = text(&mut browser, ".legends > :first-child");
    assert_eq!(legend, "penumbra mask: left outumbrapenumbralit");
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn a_file_says_which_frames_it_leaves_out() {
    let (run, mut browser) = page(Layout::SingleFile);
    choose(&mut browser, "right", "v11-shadow");
    browser.key(".");
    let tag = text(&mut browser, ".tag.right");
    assert!(tag.contains("no frames stored in this file: --report dir keeps them"), "{tag}");
    assert!(!text(&mut browser, ".tag.left").contains("no frames"), "the truth stands still");
    assert!(text(&mut browser, ".transport .note").contains("in steps of 1/512"));
    drop(browser);
    let written = umbrage_report::write_report(run.path(), Layout::Folder).expect("reported");
    let mut browser = super::viewer(&written.index);
    choose(&mut browser, "right", "v11-shadow");
    browser.key(".");
    assert!(!text(&mut browser, ".tag.right").contains("no frames"));
    assert!(!text(&mut browser, ".transport .note").contains("1/512"));
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn every_variant_has_a_key() {
    let (_run, mut browser) = page(Layout::SingleFile);
    let right = |browser: &mut Browser| browser.eval("document.querySelector('select.right').value");
    browser.key("9");
    assert_eq!(right(&mut browser), "v8-shadow");
    for (digit, written, variant) in [(0, ")", 9), (1, "!", 10), (4, "$", 13)] {
        browser.shifted(digit, written);
        assert_eq!(right(&mut browser), format!("v{variant}-shadow"), "shift and {digit}");
    }
    // A layout that writes plus there means plus.
    let zoom = "Number(document.querySelector('.stage').dataset.zoom)";
    let before = browser.eval(zoom).as_f64().expect("a zoom");
    browser.shifted(1, "+");
    assert!(browser.eval(zoom).as_f64().is_some_and(|now| now > 1.9 * before));
}

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn a_ratio_is_what_its_label_says() {
    let (_run, mut browser) = page(Layout::SingleFile);
    let relative = |browser: &mut Browser, to: &str| {
        browser.eval(&format!("(s => {{ s.value = {to:?}; s.dispatchEvent(new Event('change')); }})(document.querySelector('.relative'))"));
        let cell = "#table tbody[data-variant='4'] td[data-metric=error] button";
        let label = browser.eval(&format!("document.querySelector(\"{cell}\").ariaLabel"));
        (text(browser, cell), label.as_str().unwrap_or_default().to_string())
    };
    let (absolute, label) = relative(&mut browser, "");
    assert!(label.contains(&format!("of chss: {absolute}. Where")), "{label}");
    let (ratio, label) = relative(&mut browser, "0");
    assert!(
        ratio.starts_with("× ") && label.contains(&format!("of chss: {ratio} of hard. Where")),
        "{label}"
    );
    let (again, label) = relative(&mut browser, "");
    assert!(again == absolute && label.contains(&format!("of chss: {absolute}. Where")), "{label}");
}
