//! Regions, coverage, leaks, tails and maps.

mod support;

use support::{Picture, Random, slats};
use umbrage_frame::Agreement;
use umbrage_metrics::{
    Bootstrap, Measurement, MetricsError, Missing, Quantity, Region, Tail, Tiling, cells, counted, grain,
    paired, percentile, point_maps, profiles, window_grain, window_profiles, window_tails, window_tiles,
    worst_tile,
};

const PICTURE: Picture = Picture { width: 128, height: 64 };

/// Dark left of 40, a ramp up to 72, lit right of it.
fn edge(x: f64, _: f64) -> f64 {
    ((x - 39.5) / 32.0).clamp(0.0, 1.0)
}

#[test]
fn the_penumbra_grows_by_one_pixel_and_leaves_no_gap() {
    let truth = PICTURE.truth(edge, 0.0, 1);
    let mut counts = vec![true; PICTURE.points()];
    counts[50] = false;
    let tiling = Tiling::new(&PICTURE.anchors(), &truth, &counts, 32).expect("a tiling");
    // 0 < g < 1 from column 40 (g = 1/64) to 71 (63/64); one more on each side.
    for (column, region) in [
        (0, Region::Umbra),
        (38, Region::Umbra),
        (39, Region::Penumbra),
        (72, Region::Penumbra),
        (73, Region::Lit),
        (50, Region::LeftOut),
    ] {
        assert_eq!(tiling.regions[column], region, "column {column}");
    }
    let all: usize = tiling.tiles.iter().map(|t| t.points().count()).sum();
    assert_eq!(all, PICTURE.points() - 1);
    assert_eq!(tiling.tiles.len(), 8);
    assert!(matches!(Tiling::new(&PICTURE.anchors(), &truth, &counts, 0), Err(MetricsError::Zero(_))));
}

#[test]
fn leaks_and_false_shadows_are_means_of_their_regions() {
    let truth = PICTURE.truth(edge, 0.0, 1);
    let tiling = PICTURE.tiling(&truth);
    let panel = PICTURE.panel(2, 2, |_, _, x, y| {
        if x < 20.0 {
            0.25
        } else if x >= 100.0 {
            0.5
        } else {
            edge(x, y)
        }
    });
    let table = window_tiles(&panel, &truth, &tiling).expect("a table");
    let cells = cells(&[&table], &Bootstrap::default()).expect("cells");
    let value = |q| cells.get(q).value().expect("measured");
    // Umbra: columns 0..39, 20 of them at 0.25; lit: columns 73..128, 28 of them at 0.5.
    assert!((value(Quantity::LightLeak) - 0.25 * 20.0 / 39.0).abs() < 1e-12);
    assert!((value(Quantity::FalseShadow) - 0.5 * 28.0 / 55.0).abs() < 1e-12);
    assert_eq!(value(Quantity::OutsideShare), 1.0, "the penumbra itself is right");
    let maps = point_maps(&panel, &truth, &tiling).expect("maps");
    let tails = window_tails(&maps, &tiling);
    let p99 = |tail| percentile(&[&tails], tail, 0.99, &Bootstrap::default()).value();
    assert_eq!([p99(Tail::LightLeak), p99(Tail::FalseShadow)], [Some(0.25), Some(0.5)]);
}

#[test]
fn a_picture_without_shadow_says_so() {
    let truth = PICTURE.truth(|_, _| 1.0, 0.0, 1);
    let tiling = PICTURE.tiling(&truth);
    let panel = PICTURE.panel(2, 1, |_, _, _, _| 1.0);
    let table = window_tiles(&panel, &truth, &tiling).expect("a table");
    let cells = cells(&[&table], &Bootstrap::default()).expect("cells");
    assert_eq!(cells.get(Quantity::Error), Measurement::NotMeasured(Missing::NoPenumbra));
    assert_eq!(cells.get(Quantity::LightLeak), Measurement::NotMeasured(Missing::NoUmbra));
    assert_eq!(cells.get(Quantity::FalseShadow).value(), Some(0.0));
    assert_eq!(worst_tile(&[&table]).expect("tables"), None);
}

#[test]
fn a_window_without_counted_points_is_no_panic() {
    let truth = PICTURE.truth(edge, 0.0, 1);
    let tiling =
        Tiling::new(&PICTURE.anchors(), &truth, &vec![false; PICTURE.points()], 32).expect("a tiling");
    let panel = PICTURE.panel(2, 2, |_, _, x, y| edge(x, y));
    let table = window_tiles(&panel, &truth, &tiling).expect("a table");
    let bootstrap = Bootstrap::default();
    let cells = cells(&[&table], &bootstrap).expect("cells");
    assert!(cells.iter().all(|(_, measurement)| measurement.score().is_none()));
    let shape = window_profiles(&panel, &truth, &PICTURE.anchors(), &tiling).expect("a table");
    assert_eq!(profiles(&[&shape], &bootstrap).width_ratio, Measurement::NotMeasured(Missing::NoPenumbra));
    let noise = window_grain(&panel, &tiling).expect("a table");
    assert_eq!(grain(&[&noise], &bootstrap).lag1, Measurement::NotMeasured(Missing::NoPenumbra));
    let tails = window_tails(&point_maps(&panel, &truth, &tiling).expect("maps"), &tiling);
    let p95 = percentile(&[&tails], Tail::Error, 0.95, &bootstrap);
    assert_eq!(p95, Measurement::NotMeasured(Missing::NoPenumbra));
    let difference = paired(&[&table], &[&table], Quantity::Mse, &bootstrap).expect("a difference");
    assert_eq!(difference, Measurement::NotMeasured(Missing::NoPenumbra));
}

#[test]
fn the_share_outside_counts_tiles_without_penumbra() {
    let truth = PICTURE.truth(edge, 0.0, 1);
    let tiling = PICTURE.tiling(&truth);
    let panel = PICTURE.panel(2, 1, |_, _, x, y| edge(x, y) + 0.125);
    let table = window_tiles(&panel, &truth, &tiling).expect("a table");
    let cells = cells(&[&table], &Bootstrap::default()).expect("cells");
    let share = cells.get(Quantity::OutsideShare).value().expect("measured");
    // 34 of 128 columns are penumbra (39 to 72), all are wrong by the same.
    assert!((share - 94.0 / 128.0).abs() < 1e-6, "{share}");
}

#[test]
fn percentiles_and_the_worst_tile_find_a_hot_spot() {
    let g = slats(20.0, 40.0);
    let truth = PICTURE.truth(&g, 0.0, 1);
    let tiling = PICTURE.tiling(&truth);
    let hot = |x: f64, y: f64| (64.0..96.0).contains(&x) && y >= 32.0;
    let panel = PICTURE.panel(2, 1, |_, _, x, y| g(x, y) + if hot(x, y) { 0.5 } else { 0.125 });
    let table = window_tiles(&panel, &truth, &tiling).expect("a table");
    let worst = worst_tile(&[&table]).expect("tables").expect("a tile");
    assert_eq!((worst.column, worst.row), (2, 1));
    // f32 rounding of v.
    assert!((worst.error - 0.5).abs() < 1e-6);
    let maps = point_maps(&panel, &truth, &tiling).expect("maps");
    let tails = window_tails(&maps, &tiling);
    let at = |fraction| {
        percentile(&[&tails], Tail::Error, fraction, &Bootstrap::default()).value().expect("measured")
    };
    // An eighth of the points is hot.
    assert!((at(0.95) - 0.5).abs() < 1e-6 && (at(0.5) - 0.125).abs() < 1e-6);
}

#[test]
fn maps_add_up_to_the_cells() {
    let g = slats(20.0, 40.0);
    let truth = PICTURE.truth(&g, 0.01, 1);
    let tiling = PICTURE.tiling(&truth);
    let mut random = Random(6);
    let panel = PICTURE.panel(4, 3, |t, _, x, y| 0.9 * g(x, y) + 0.01 * t as f64 + 0.1 * random.normal());
    let table = window_tiles(&panel, &truth, &tiling).expect("a table");
    let maps = point_maps(&panel, &truth, &tiling).expect("maps");
    let sum = |map: &[f32]| map.iter().filter(|v| !v.is_nan()).map(|&v| f64::from(v)).sum::<f64>();
    let tiles = |of: &dyn Fn(&umbrage_metrics::TileRow) -> f64| table.tiles.iter().map(of).sum::<f64>();
    for (map, cell) in [
        (&maps.smooth_static, tiles(&|t| t.smooth.fixed)),
        (&maps.smooth_moving, tiles(&|t| t.smooth.moving)),
        (&maps.structured_static, tiles(&|t| t.structured.fixed)),
        (&maps.structured_moving, tiles(&|t| t.structured.moving)),
    ] {
        // Each of 8192 points is rounded to f32: 6e-8 of its size, below 0.1.
        assert!((sum(map) - cell).abs() < 1e-4, "{} {cell}", sum(map));
    }
    assert!(maps.swim.iter().all(|v| *v >= 0.0));
}

#[test]
fn an_anchor_counts_when_every_frame_agrees() {
    let picture = Picture { width: 4, height: 1 };
    let agreement =
        |same: [bool; 4], outside, other_surface| Agreement { same: same.to_vec(), outside, other_surface };
    let agreements = [agreement([true, true, false, true], 0, 1), agreement([true, true, true, false], 1, 0)];
    let witnesses = [agreement([true; 4], 0, 0), agreement([true, true, true, false], 0, 1)];
    let (counts, coverage) =
        counted(&picture.anchors(), &[true, false, true, true], &agreements, &witnesses).expect("counts");
    assert_eq!(counts, [true, false, false, false]);
    assert_eq!((coverage.pixels, coverage.facing, coverage.counted), (4, 3, 1));
    assert!((coverage.share() - 1.0 / 3.0).abs() < 1e-15);
    assert!((coverage.picture() - 1.0 / 4.0).abs() < 1e-15);
    assert!((coverage.occlusion() - 1.0 / 7.0).abs() < 1e-15, "one of 4 + 3 anchors inside");
    assert!((coverage.disagreement() - 1.0 / 8.0).abs() < 1e-15, "one of the 4 + 4 that truth sees");
    assert!(counted(&picture.anchors(), &[true], &agreements, &witnesses).is_err());
}
