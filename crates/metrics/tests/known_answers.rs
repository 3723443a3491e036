//! Sequences whose cells follow from algebra (METRICS section 4).

mod support;

use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use support::{Picture, Random, ramp, slats};
use umbrage_metrics::{
    Bootstrap, Cells, Measurement, MetricsError, Missing, Panel, PanelTruth, Quantity, TileTable, cells,
    edge_crawl, group_letters, paired, swimming_per_frame, window_tiles,
};

const PICTURE: Picture = Picture { width: 128, height: 96 };

fn table(picture: Picture, panel: &Panel, truth: &PanelTruth) -> TileTable {
    window_tiles(panel, truth, &picture.tiling(truth)).expect("a table")
}

fn scores(table: &TileTable) -> Cells {
    cells(&[table], &Bootstrap { replicates: 200, ..Bootstrap::default() }).expect("cells")
}

fn value(cells: &Cells, quantity: Quantity) -> f64 {
    cells.get(quantity).value().expect("measured")
}

const CELLS: [Quantity; 5] = [
    Quantity::Noise,
    Quantity::SmoothStatic,
    Quantity::SmoothMoving,
    Quantity::StructuredStatic,
    Quantity::StructuredMoving,
];

/// One cell holds `expected` (to `tolerance`), all others less than `rest`.
fn assert_only(cells: &Cells, cell: Quantity, expected: f64, [tolerance, rest]: [f64; 2]) {
    for quantity in CELLS {
        let found = value(cells, quantity);
        let (expected, tolerance) = if quantity == cell { (expected, tolerance) } else { (0.0, rest) };
        assert!((found - expected).abs() <= tolerance, "{quantity:?}: {found:e}, not {expected:e}");
    }
}

#[test]
fn identical_sequences_score_zero() {
    let g = slats(20.0, 40.0);
    let truth = PICTURE.truth(&g, 0.0, 1);
    let cells = scores(&table(PICTURE, &PICTURE.panel(4, 3, |_, _, x, y| g(x, y)), &truth));
    // Exact: v - r is 0 at each point.
    for quantity in CELLS.into_iter().chain([Quantity::Mse, Quantity::Error]) {
        assert_eq!(
            cells.get(quantity),
            Measurement::Measured(umbrage_metrics::Score::exact(0.0)),
            "{quantity:?}"
        );
    }
}

#[test]
fn a_third_estimate_of_truth_scores_zero_within_its_own_noise() {
    let g = slats(20.0, 40.0);
    let truth = PICTURE.truth(&g, 0.02, 1);
    let mut random = Random(99);
    // Frame by frame another estimate: its noise is no seed noise, so it shows as structured, with
    // the variance of one estimate split as (T-1)/T moving and 1/T static.
    let panel = PICTURE.panel(4, 1, |_, _, x, y| g(x, y) + 0.02 * random.normal());
    let cells = scores(&table(PICTURE, &panel, &truth));
    // Standard error of a variance of 4e-4 from 12288 x 4 numbers: 4e-4 * sqrt(2 / 49152) = 2.6e-6;
    // four of them. Catches a reference noise (2e-4) left in any cell.
    assert!((value(&cells, Quantity::Mse) - 4e-4).abs() < 1.1e-5, "{}", value(&cells, Quantity::Mse));
    assert!((value(&cells, Quantity::Swimming) - 3e-4).abs() < 1.1e-5);
    // As seeds instead of frames, it is noise and nothing else.
    let panel = PICTURE.panel(1, 4, |_, _, x, y| g(x, y) + 0.02 * random.normal());
    let cells = scores(&table(PICTURE, &panel, &truth));
    assert!((value(&cells, Quantity::Noise) - 4e-4).abs() < 1.1e-5);
    // (a - d1)(a - d2) with variances 1e-4 (mean of 4 seeds) and 4e-4 deviates by 5.1e-4 for each of
    // the 108 coefficients and 12288 points: 4.3e-7 and 4.6e-6 per point, four of them.
    assert!(value(&cells, Quantity::SmoothStatic).abs() < 1.8e-6);
    assert!(value(&cells, Quantity::StructuredStatic).abs() < 1.9e-5);
    let noise = value(&cells, Quantity::ReferenceNoise);
    // E (r1 - r2)^2 / 4 = 2e-4; relative standard error sqrt(2/12288) = 1.3 %, four of them.
    assert!((noise - 2e-4).abs() < 1.1e-5, "{noise}");
}

#[test]
fn a_smooth_bias_is_smooth_and_static() {
    let g = ramp(PICTURE);
    let truth = PICTURE.truth(&g, 0.0, 1);
    let bias = |g: f64| 0.2 * g * (1.0 - g);
    let cells = scores(&table(PICTURE, &PICTURE.panel(6, 1, |_, _, x, y| g(x, y) + bias(g(x, y))), &truth));
    let expected = (0..128).map(|x| bias((f64::from(x) + 0.5) / 128.0).powi(2)).sum::<f64>() / 128.0;
    // The bias lies in the span of the projection; f32 rounds v to 6e-8, so e^2 to 1e-8 relative.
    assert_only(&cells, Quantity::SmoothStatic, expected, [1e-9, 1e-9]);
}

#[test]
fn static_bands_are_structured_and_static() {
    let g = ramp(PICTURE);
    let truth = PICTURE.truth(&g, 0.0, 1);
    // Period 8 px: 4 waves in each tile of 32 px.
    let band = |x: f64| 0.05 * (TAU * (x + 0.5) / 8.0).sin();
    let cells = scores(&table(PICTURE, &PICTURE.panel(6, 1, |_, _, x, y| g(x, y) + band(x)), &truth));
    // Half the amplitude squared, less what a cubic takes of four sine waves: with P1 and P3 it shares
    // 6 / (4 pi)^2 + 14 (1 - 15 / (4 pi)^2)^2 / (4 pi)^2 = 0.111 of its variance; 32 samples add 0.01.
    let found = value(&cells, Quantity::StructuredStatic);
    assert!((0.88 * 0.00125..=0.00125 + 1e-9).contains(&found), "{found}");
    assert!((value(&cells, Quantity::Mse) - 0.00125).abs() < 1e-8);
    assert!(value(&cells, Quantity::Swimming).abs() < 1e-14 && value(&cells, Quantity::Noise) == 0.0);
}

#[test]
fn crawling_bands_are_structured_and_moving() {
    let g = ramp(PICTURE);
    let truth = PICTURE.truth(&g, 0.0, 1);
    // One period in T frames: at each point the mean over frames is exactly the truth.
    let band = |t: usize, x: f64| 0.05 * (TAU * ((x + 0.5) / 8.0 + t as f64 / 8.0)).sin();
    let cells = scores(&table(PICTURE, &PICTURE.panel(8, 1, |t, _, x, y| g(x, y) + band(t, x)), &truth));
    let found = value(&cells, Quantity::StructuredMoving);
    // As above: the projection takes at most 0.12 of four waves, at any phase.
    assert!((0.88 * 0.00125..=0.00125 + 1e-9).contains(&found), "{found}");
    assert!((value(&cells, Quantity::Swimming) - 0.00125).abs() < 1e-8);
    assert!(value(&cells, Quantity::SmoothStatic).abs() < 1e-12);
    assert!(value(&cells, Quantity::StructuredStatic).abs() < 1e-12);
}

#[test]
fn a_random_k_tap_estimate_is_noise_of_known_size() {
    const TAPS: usize = 8;
    let g = ramp(PICTURE);
    let truth = PICTURE.truth(&g, 0.0, 1);
    let mut random = Random(5);
    let panel = PICTURE
        .panel(6, 4, |_, _, x, y| (0..TAPS).filter(|_| random.unit() < g(x, y)).count() as f64 / TAPS as f64);
    let cells = scores(&table(PICTURE, &panel, &truth));
    // Mean of g(1-g)/K over a ramp is 1/(6K). Its relative standard error is below sqrt(2/221184)
    // = 0.3 % (12288 points x 6 frames x 3 free seeds), four of them.
    let noise = value(&cells, Quantity::Noise);
    assert!((noise * 6.0 * TAPS as f64 - 1.0).abs() < 0.012, "{noise}");
    // Others: products of means of noise, of standard error noise / 24 / sqrt(points) in B and
    // noise / 4 / sqrt(points x frames / 2) in M, 0.021 / 4 / 192 = 2.7e-5 at most, four of them.
    assert_only(&cells, Quantity::Noise, noise, [0.0, 1.1e-4]);
}

#[test]
fn a_quantiser_of_k_levels_errs_by_one_over_12_k_squared() {
    let picture = Picture { width: 512, height: 32 };
    let g = ramp(picture);
    let truth = picture.truth(&g, 0.0, 1);
    for levels in [4.0, 8.0, 16.0] {
        let quantised = |x: f64, y: f64| ((g(x, y) * levels).floor() + 0.5) / levels;
        let cells = scores(&table(picture, &picture.panel(2, 1, |_, _, x, y| quantised(x, y)), &truth));
        let found = value(&cells, Quantity::SmoothStatic) + value(&cells, Quantity::StructuredStatic);
        // 512 pixels sample the saw tooth: the sum over n of them a level is short by 1/n^2 (n >= 32).
        let expected = 1.0 / (12.0 * levels * levels);
        assert!((found / expected - 1.0).abs() < 1.01 / (512.0 / levels).powi(2), "{levels}: {found}");
    }
}

#[test]
fn what_depends_on_the_place_alone_does_not_swim() {
    let g = slats(20.0, 40.0);
    let truth = PICTURE.truth(&g, 0.01, 1);
    let panel = PICTURE.panel(
        16,
        1,
        |_, _, x, y| if g(x, y) > 0.37 { 0.9371 } else { (x * 0.0137 + y * 0.0071).fract() },
    );
    let table = table(PICTURE, &panel, &truth);
    let cells = scores(&table);
    // Values are taken relative to the first frame: the same in all frames is 0, not rounding.
    for quantity in [Quantity::Swimming, Quantity::SmoothMoving, Quantity::StructuredMoving] {
        assert!(value(&cells, quantity).abs() < 1e-30);
    }
    assert_eq!(cells.get(Quantity::VonNeumann), Measurement::NotMeasured(Missing::NothingSwims));
    let series = swimming_per_frame(&table, &Bootstrap::default()).expect("a series");
    assert!(series.len() == 16 && series.iter().all(|s| s.value == 0.0));
}

#[test]
fn drift_and_flicker_of_one_size_differ_in_rhythm() {
    let g = slats(20.0, 40.0);
    let truth = PICTURE.truth(&g, 0.0, 1);
    let amplitude = 0.02;
    let drift = |t: usize| amplitude * 2f64.sqrt() * (TAU * (t as f64 + 0.5) / 32.0 * 1.0).cos();
    let mean = (0..16).map(drift).sum::<f64>() / 16.0;
    let shape = |t: usize, flicker: bool| match (flicker, t % 2) {
        (false, _) => drift(t) - mean,
        (true, 0) => amplitude,
        (true, _) => -amplitude,
    };
    let of = |flicker: bool| {
        scores(&table(PICTURE, &PICTURE.panel(16, 1, |t, _, x, y| g(x, y) + shape(t, flicker)), &truth))
    };
    let (slow, fast) = (of(false), of(true));
    // f32 rounding of v: 6e-8 of 0.02 twice, 1e-5 relative.
    assert!((value(&fast, Quantity::Swimming) / amplitude.powi(2) - 1.0).abs() < 1e-5);
    assert!((value(&fast, Quantity::VonNeumann) - 2.0).abs() < 1e-5);
    let expected = (1..16).map(|t| (drift(t) - drift(t - 1)).powi(2)).sum::<f64>() / 15.0;
    let found = value(&slow, Quantity::VonNeumann);
    assert!((found - expected / (2.0 * value(&slow, Quantity::Swimming))).abs() < 1e-4);
    // A half period in 16 frames: about pi^2 / (2 * 16^2) = 0.02.
    assert!(found < 0.05, "{found}");
}

#[test]
fn fewer_reference_samples_do_not_move_the_bias() {
    let g = slats(24.0, 40.0);
    let picture = Picture { width: 256, height: 256 };
    let panel = picture.panel(2, 1, |_, _, x, y| 0.8 * g(x, y) + 0.02 * (TAU * x / 6.0).sin());
    // Regions from one good basis, so that both runs score the same points.
    let bias = |deviation: f64| {
        let clean = picture.truth(&g, 0.0, 1);
        let noisy = PanelTruth { halves: picture.truth(&g, deviation, 7).halves, ..clean };
        let cells = scores(&table(picture, &panel, &noisy));
        value(&cells, Quantity::SmoothStatic) + value(&cells, Quantity::StructuredStatic)
    };
    // (v - r1)(v - r2) adds noise e (d1 + d2) + d1 d2 of deviation sqrt(2 e^2 + d^2) d per point:
    // 0.05 * sqrt(2 * 0.01 + 0.0025) = 7.5e-3, over 4e4 points 3.8e-5, four of them. A reference
    // noise left in would be 2.5e-3 / 2.
    assert!((bias(0.05) - bias(0.0)).abs() < 1.5e-4);
}

#[test]
fn a_constant_adds_its_square_to_the_smooth_cell() {
    let g = slats(20.0, 40.0);
    let truth = PICTURE.truth(&g, 0.0, 1);
    let error = |x: f64, y: f64| 0.1 * g(x, y).powi(2) + 0.03 * (x * 1.7 + y * 0.9).sin();
    let of = |c: f64| {
        scores(&table(PICTURE, &PICTURE.panel(2, 1, |_, _, x, y| g(x, y) + error(x, y) + c), &truth))
    };
    let (plain, raised) = (of(0.0), of(0.125));
    let tiling = PICTURE.tiling(&truth);
    let points: Vec<u32> = tiling.tiles.iter().flat_map(|t| t.penumbra.clone()).collect();
    let mean = points.iter().map(|&p| PICTURE.place(p as usize)).map(|(x, y)| error(x, y)).sum::<f64>()
        / points.len() as f64;
    let smooth = value(&raised, Quantity::SmoothStatic) - value(&plain, Quantity::SmoothStatic);
    let structured = value(&raised, Quantity::StructuredStatic) - value(&plain, Quantity::StructuredStatic);
    // v is rounded to f32 (6e-8 at most), which moves e * c by 1e-8.
    assert!((smooth - (0.125 * 0.125 + 2.0 * 0.125 * mean)).abs() < 2e-8, "{smooth}");
    assert!(structured.abs() < 2e-8);
}

#[test]
fn one_frame_says_nothing_about_motion() {
    let g = slats(20.0, 40.0);
    let truth = PICTURE.truth(&g, 0.0, 1);
    let table = table(PICTURE, &PICTURE.panel(1, 2, |_, s, x, y| g(x, y) + 0.01 * s as f64), &truth);
    let cells = scores(&table);
    for quantity in
        [Quantity::Swimming, Quantity::SmoothMoving, Quantity::StructuredMoving, Quantity::VonNeumann]
    {
        assert_eq!(cells.get(quantity), Measurement::NotMeasured(Missing::OneFrame), "{quantity:?}");
    }
    assert!(cells.get(Quantity::Banding).score().is_some());
    assert!(swimming_per_frame(&table, &Bootstrap::default()).expect("a series").is_empty());
}

#[test]
fn frames_contribute_what_adds_up_to_swimming() {
    let g = slats(20.0, 40.0);
    let truth = PICTURE.truth(&g, 0.0, 1);
    let mut random = Random(3);
    let panel = PICTURE.panel(5, 3, |t, _, x, y| {
        g(x, y) + 0.01 * (t * t) as f64 * (PI * x / 64.0).sin() + 0.05 * random.normal()
    });
    let table = table(PICTURE, &panel, &truth);
    let series = swimming_per_frame(&table, &Bootstrap::default()).expect("a series");
    let sum: f64 = series.iter().map(|s| s.value).sum();
    let swimming = value(&scores(&table), Quantity::Swimming);
    // Two orders of summation of the same numbers.
    assert!((sum / swimming - 1.0).abs() < 1e-12);
    assert!(series[4].value > series[2].value);
}

#[test]
fn a_truth_that_stands_still_in_every_frame_is_a_still_truth() {
    let g = slats(20.0, 40.0);
    let still = PICTURE.truth(&g, 0.01, 1);
    let frames = 4;
    let moving =
        PanelTruth { frames, halves: still.halves.clone().map(|half| half.repeat(frames)), ..still.clone() };
    let panel = PICTURE.panel(frames, 2, |t, s, x, y| 0.9 * g(x, y) + 0.01 * (t * 2 + s) as f64);
    let tiling = PICTURE.tiling(&still);
    let of = |truth: &PanelTruth| scores(&window_tiles(&panel, truth, &tiling).expect("a table"));
    assert_eq!(of(&still), of(&moving));
}

#[test]
fn a_shadow_that_follows_a_moving_light_does_not_swim() {
    // Exactly representable shifts, so that v - g is exactly the constant bias.
    let g = |t: usize, x: f64| ((x + 2.0 * t as f64) / 256.0).min(1.0);
    let (frames, points) = (4, PICTURE.points());
    let half: Vec<f32> =
        (0..frames).flat_map(|t| (0..points).map(move |p| g(t, PICTURE.place(p).0) as f32)).collect();
    let basis = half[2 * points..3 * points].to_vec();
    let truth = PanelTruth { frames, halves: [half.clone(), half], basis, variance: vec![0.0; points] };
    let cells = scores(&table(PICTURE, &PICTURE.panel(frames, 1, |t, _, x, _| g(t, x) + 0.125), &truth));
    assert_only(&cells, Quantity::SmoothStatic, 0.125 * 0.125, [1e-15, 1e-15]);
}

#[test]
fn differences_of_a_variant_to_itself_are_zero_and_letters_follow() {
    let g = slats(20.0, 40.0);
    let truth = PICTURE.truth(&g, 0.01, 1);
    let mut random = Random(8);
    let mut of = |gain: f64, sway: f64| {
        let panel = PICTURE
            .panel(4, 4, |t, _, x, y| gain * g(x, y) + sway * g(x, y) * t as f64 + 0.05 * random.normal());
        table(PICTURE, &panel, &truth)
    };
    let (a, b, worse) = (of(0.9, 0.0), of(0.9, 0.0), of(0.7, 0.02));
    let bootstrap = Bootstrap { replicates: 400, ..Bootstrap::default() };
    for quantity in Quantity::ALL {
        let own = paired(&[&a], &[&a], quantity, &bootstrap).expect("a difference");
        if let Some(score) = own.score() {
            assert_eq!((score.value, score.low, score.high), (0.0, 0.0, 0.0), "{quantity:?}");
        }
    }
    let crawl = edge_crawl(&[&worse], &[&a], &bootstrap).expect("a difference").score().expect("measured");
    assert!(crawl.low > 0.0);
    let variants = [vec![&worse], vec![&a], vec![&b]];
    let letters = group_letters(&variants, Quantity::Mse, &bootstrap).expect("letters");
    assert_eq!(letters, ["b", "a", "a"]);
}

#[test]
fn windows_pool_to_the_mean_of_their_values() {
    let g = slats(20.0, 40.0);
    let truth = PICTURE.truth(&g, 0.0, 1);
    let of = |c: f64| table(PICTURE, &PICTURE.panel(2, 1, |_, _, x, y| g(x, y) + c), &truth);
    let (a, b) = (of(0.1), of(0.3));
    let both = cells(&[&a, &b], &Bootstrap::default()).expect("cells");
    assert!((value(&both, Quantity::Mse) - 0.05).abs() < 1e-7, "f32 of 0.1 and 0.3");
    let other = TileTable { frames: 3, ..a.clone() };
    assert!(matches!(cells(&[&a, &other], &Bootstrap::default()), Err(MetricsError::Unlike(_))));
}

#[test]
fn the_same_bits_at_any_thread_count() {
    let g = slats(20.0, 40.0);
    let truth = PICTURE.truth(&g, 0.01, 1);
    let mut random = Random(4);
    let panel = PICTURE.panel(4, 2, |_, _, x, y| g(x, y) + 0.05 * random.normal());
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let table = table(PICTURE, &panel, &truth);
            let scores = scores(&table);
            (table, scores)
        })
    };
    assert_eq!(run(1), run(3));
}

#[test]
fn nan_is_refused_where_it_counts_only() {
    let g = slats(20.0, 40.0);
    let truth = PICTURE.truth(&g, 0.0, 1);
    let mut panel = PICTURE.panel(2, 1, |_, _, x, y| g(x, y));
    panel.values[77] = f32::NAN;
    let found = window_tiles(&panel, &truth, &PICTURE.tiling(&truth));
    let expected = MetricsError::NotFinite { what: "the variant", frame: 0, seed: 0, point: 77 };
    assert_eq!(found, Err(expected));
    let mut counted = vec![true; PICTURE.points()];
    counted[77] = false;
    let tiling = umbrage_metrics::Tiling::new(&PICTURE.anchors(), &truth, &counted, 32).expect("a tiling");
    assert!(window_tiles(&panel, &truth, &tiling).is_ok());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// To 1e-12 of the parts' sizes: sums of at most 1e5 products of doubles.
    #[test]
    fn the_cells_add_up(seed in any::<u64>(), frames in 1usize..6, seeds in 1usize..4, moving in any::<bool>()) {
        let picture = Picture { width: 40, height: 36 };
        let mut random = Random(seed);
        let mut truth = picture.truth(slats(12.0, 18.0), 0.05, seed ^ 1);
        if moving {
            truth.frames = frames;
            for half in &mut truth.halves {
                *half = (0..frames * picture.points()).map(|_| random.unit() as f32).collect();
            }
        }
        let panel = picture.panel(frames, seeds, |_, _, _, _| random.unit());
        for tile in table(picture, &panel, &truth).tiles {
            let (smooth, structured) = (tile.smooth, tile.structured);
            let sum = smooth.total() + structured.total();
            let size = [smooth, structured].iter().map(|p| p.noise.abs() + p.moving.abs() + p.fixed.abs()).sum::<f64>();
            prop_assert!((sum - tile.squared).abs() <= 1e-12 * size.max(tile.squared.abs()));
        }
    }
}
