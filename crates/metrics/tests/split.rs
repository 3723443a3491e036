//! What the split into smooth and structured does with the two errors it was made for.

mod support;

use support::Picture;
use umbrage_metrics::{Bootstrap, Quantity, cells, window_tiles};

const PICTURE: Picture = Picture { width: 192, height: 128 };

/// The share of the error between two edges that lands in the smooth row.
fn smooth_share(truth: impl Fn(f64, f64) -> f64, variant: impl Fn(f64, f64) -> f64) -> f64 {
    let truth = PICTURE.truth(truth, 0.0, 1);
    let panel = PICTURE.panel(1, 1, |_, _, x, y| variant(x, y));
    let table = window_tiles(&panel, &truth, &PICTURE.tiling(&truth)).expect("a table");
    let cells = cells(&[&table], &Bootstrap::default()).expect("cells");
    let value = |quantity| cells.get(quantity).value().expect("measured");
    value(Quantity::SmoothStatic) / value(Quantity::Mse)
}

/// The shadow of a half-plane under a disc of light: share of the disc in sight.
fn disc_edge(width: f64) -> impl Fn(f64, f64) -> f64 {
    move |x, y| {
        let t = ((x + 0.3819 * y - 110.0) / (0.5 * width)).clamp(-1.0, 1.0);
        0.5 + (t * (1.0 - t * t).sqrt() + t.asin()) / std::f64::consts::PI
    }
}

#[test]
fn a_wrong_width_is_smooth_at_every_width_in_pixels() {
    // METRICS: .99 or more at any width (model): what is left is the fourth power of g.
    for width in [6.0, 12.0, 30.0] {
        let share = smooth_share(disc_edge(width), disc_edge(0.8 * width));
        assert!(share > 0.99, "{width} px: {share}");
    }
}

#[test]
fn bands_are_mostly_structured() {
    let g = disc_edge(30.0);
    let bands = |x: f64, y: f64| ((g(x, y) * 16.0).floor() + 0.5) / 16.0;
    let share = smooth_share(&g, bands);
    // METRICS: .28 to .36 of fixed Vogel-16 bands leak, part of it a truly wrong profile; a
    // quantiser has none of that.
    assert!(share < 0.3, "{share}");
}
