//! Numbers of claims whose answers are known.

mod support;

use support::{Picture, Random, slats};
use umbrage_metrics::{
    Bootstrap, Member, PooledNumber, SumTable, against_sums, block_sums, compare_jointly, point_maps,
    true_widths, width_sums, window_tiles,
};

const PICTURE: Picture = Picture { width: 192, height: 128 };

fn value(number: PooledNumber, table: &SumTable) -> f64 {
    let member = Member { number, windows: vec![(0, table)] };
    compare_jointly(&[member], <[f64]>::to_vec, &Bootstrap::default()).expect("compared")[0].value
}

#[test]
fn means_of_4x4_px_lose_white_noise_and_keep_bias() {
    let truth = PICTURE.truth(slats(24.0, 32.0), 0.0, 1);
    let tiling = PICTURE.tiling(&truth);
    let g = slats(24.0, 32.0);
    let mut random = Random(7);
    let (bias, deviation) = (0.03, 0.1);
    let panel = PICTURE.panel(4, 4, |_, _, x, y| g(x, y) + bias + deviation * random.normal());
    let blocks = block_sums(&panel, &truth, &tiling).expect("sums");
    let cells = window_tiles(&panel, &truth, &tiling).expect("sums").sum_table();
    let noise = value(PooledNumber::BlockNoise, &blocks);
    let pixel_noise = value(PooledNumber::named("noise").expect("known"), &cells);
    // Blocks hold 8 to 16 points: between an 8th and a 16th of the variance is left. A mean that was
    // not taken leaves all of it.
    assert!((1.0 / 16.5..1.0 / 8.0).contains(&(noise / pixel_noise)), "{}", noise / pixel_noise);
    let error = value(PooledNumber::BlockError, &blocks);
    // Thousands of blocks: the square is off by less than a tenth.
    assert!((error * error / (bias * bias + noise) - 1.0).abs() < 0.1, "{error}");
}

#[test]
fn a_kernel_of_one_width_does_not_grow_and_the_truth_does() {
    // Edges along y whose penumbra widens from top to bottom.
    let edge = |width: f64, x: f64| {
        let u = ((x.rem_euclid(64.0) - 32.0).abs() - 16.0) / (0.5 * width);
        let u = u.clamp(-1.0, 1.0);
        0.5 + (u * (1.0 - u * u).sqrt() + u.asin()) / std::f64::consts::PI
    };
    let truth = PICTURE.truth(|x, y| edge(6.0 + y / 8.0, x), 0.0, 1);
    let tiling = PICTURE.tiling(&truth);
    let growth = |v: &dyn Fn(f64, f64) -> f64| {
        let panel = PICTURE.panel(2, 1, |_, _, x, y| v(x, y));
        let maps = point_maps(&panel, &truth, &tiling).expect("maps");
        let sums = width_sums((&panel, &maps), &truth, &PICTURE.anchors(), &tiling).expect("sums");
        value(PooledNumber::WidthGrowth, &sums)
    };
    let right = growth(&|x, y| edge(6.0 + y / 8.0, x));
    // The same points give both widths: the exponent is 1 to rounding.
    assert!((right - 1.0).abs() < 1e-9, "{right}");
    let fixed = growth(&|x, _| edge(14.0, x));
    // Widths are whole pixels, 8 to 18 of them: a twentieth each.
    assert!(fixed.abs() < 0.15, "{fixed}");
}

#[test]
fn a_straight_edge_has_its_width_in_metres_and_flat_places_have_none() {
    let width = 14.0;
    let g = |x: f64, _: f64| {
        let u = ((x.rem_euclid(64.0) - 32.0).abs() - 16.0) / (0.5 * width);
        let u = u.clamp(-1.0, 1.0);
        0.5 + (u * (1.0 - u * u).sqrt() + u.asin()) / std::f64::consts::PI
    };
    let truth = PICTURE.truth(g, 0.0, 1);
    let tiling = PICTURE.tiling(&truth);
    let widths = true_widths(&truth, &PICTURE.anchors(), &tiling).expect("widths");
    // The profile is at 10 and 90 % where u = -+0.687. A block of 16 pixels, each a metre, ends in the middle of an
    // edge: half of the width is 4 or 5 whole pixels, the width 8 or 10. Twice the width would be 19.
    let true_width = 0.687 * width;
    let told: Vec<f64> = widths.iter().filter(|w| w.is_finite()).map(|&w| f64::from(w)).collect();
    assert!(told.len() > 1000 && told.iter().all(|w| (w - true_width).abs() < 2.0), "{told:?}");
    // Over both halves of many edges that evens out, to a tenth.
    let mean = told.iter().sum::<f64>() / told.len() as f64;
    assert!((mean / true_width - 1.0).abs() < 0.1, "{mean} for {true_width}");
    let lit = (0..widths.len()).filter(|&p| tiling.regions[p] != umbrage_metrics::Region::Penumbra);
    assert!(lit.into_iter().all(|p| widths[p].is_nan()));
}

#[test]
fn the_same_values_do_not_differ_and_one_bit_does() {
    let truth = PICTURE.truth(slats(24.0, 32.0), 0.0, 1);
    let tiling = PICTURE.tiling(&truth);
    let panel = PICTURE.panel(2, 2, |t, s, x, y| Random::hash(&[t as u64, s as u64, x as u64, y as u64]));
    let mut other = panel.clone();
    let same = against_sums(&panel, &other, &tiling).expect("sums");
    assert_eq!(value(PooledNumber::Differing, &same), 0.0);
    assert_eq!(value(PooledNumber::Departure, &same), 0.0);
    other.values[5] = f32::from_bits(other.values[5].to_bits() ^ 1);
    let one = against_sums(&panel, &other, &tiling).expect("sums");
    assert!(value(PooledNumber::Differing, &one) > 0.0);
}
