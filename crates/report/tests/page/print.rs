//! The page on paper.

use crate::{SIZE, browser::Browser, fixture, fixture::Device};
use serde_json::json;
use umbrage_report::{Layout, write_report};

/// A4 lying, less its margins of 12 mm, at 96 pixels an inch: (297 - 24) / 25.4 * 96.
const PAPER_PX: u32 = 1032;

#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn paper_has_the_tables_and_a_crop_each_and_cuts_nothing_off() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fixture::write(folder.path(), Device::Gpu, SIZE).expect("stored");
    let written = write_report(folder.path(), Layout::SingleFile).expect("reported");
    let mut browser = Browser::open(&written.index, (PAPER_PX, 700));
    browser.call("Emulation.setEmulatedMedia", json!({ "media": "print" }));
    browser.settle();
    let gone = "['#viewer', 'nav', '.controls'].every(s => !document.querySelector(s)?.checkVisibility())";
    assert_eq!(browser.eval(gone), true, "what needs a pointer is not printed");
    assert_eq!(browser.eval("document.querySelector('#table table').checkVisibility()"), true);
    let crops = "[...document.querySelectorAll('.variant-row')].filter(r => r.checkVisibility()).map(r => [...r.querySelectorAll('figure')].filter(f => f.checkVisibility()).length)";
    let crops = browser.eval(crops);
    let crops = crops.as_array().expect("a list");
    assert!(!crops.is_empty() && crops.iter().all(|n| *n == 1), "one crop each: {crops:?}");
    // Half a pixel for rounding; what scrolls on a screen would be cut off on paper.
    let beyond = format!(
        "[...document.querySelectorAll('header *, main *')].filter(e => e.checkVisibility() && e.getBoundingClientRect().right > {PAPER_PX}.5) \
         .map(e => e.tagName + '.' + (e.className.baseVal ?? e.className)).slice(0, 5)"
    );
    assert_eq!(browser.eval(&beyond), json!([]), "beyond the right edge");
    let scrolled = "[...document.querySelectorAll('main *')].filter(e => e.checkVisibility() && getComputedStyle(e).overflowX !== 'visible' && !e.closest('svg') && e.scrollWidth > e.clientWidth + 1) \
         .map(e => e.tagName + '.' + e.className).slice(0, 5)";
    assert_eq!(browser.eval(scrolled), json!([]), "cut off inside");
}
