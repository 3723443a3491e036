//! Moments of depth: prefiltered maps against means of the shadow map, the table against means over
//! boxes, the bounds against closed forms.

use crate::case::{Case, MAP_TEXELS, Ran};
use crate::support::edited::probe;
use crate::support::{still_life, variant_id};
use umbrage_frame::Image;
use umbrage_scene::AreaLight;
use umbrage_shadows::{Calibration, LightMap};

/// Rounding of a moment. Depth over the far plane's distance, counted from the middle, is at most a
/// half and comes from three operations on numbers of at most 1: 3 x 2^-24. Its square doubles that;
/// up to ten levels of means add 2^-24 / 4 each. Half a texel's shift moves moments by hundredths.
const ROUNDING: f64 = 8e-7;

/// The same for lookups between texels: a place is known to a few 2^-24 of 500 texels, and from texel
/// to texel moments change by less than 1.
const LOOKUP_ROUNDING: f64 = 1e-4;

pub(crate) fn cases(name: &str) -> Vec<Case> {
    let lights = [still_life::sun(), still_life::sphere()];
    lights.map(|light: AreaLight| Case::new(variant_id(name, Calibration::LightMatched), light)).into()
}

/// How moments count depth: the middle, and the unit.
fn counting(ran: &Ran) -> [f64; 2] {
    let map = LightMap::new(&ran.scene, &ran.case.light, MAP_TEXELS);
    let (near, far) = (f64::from(map.nearest_blocker), f64::from(map.far));
    [0.5 * (near + far), far]
}

/// Mean moments of texels from `low` to `high`, both included, clamped at the border.
fn mean(ran: &Ran, low: [i64; 2], high: [i64; 2]) -> [f64; 2] {
    let (map, [middle, unit]) = (ran.image("shadow-map"), counting(ran));
    let last = i64::from(MAP_TEXELS) - 1;
    let (mut sums, mut count) = ([0.0; 2], 0.0);
    for y in low[1]..=high[1] {
        for x in low[0]..=high[0] {
            let depth = *map.at(x.clamp(0, last) as u32, y.clamp(0, last) as u32);
            let u = (f64::from(depth) - middle) / unit;
            sums[0] += u;
            sums[1] += u * u;
            count += 1.0;
        }
    }
    sums.map(|sum| sum / count)
}

/// Both channels of every `stride`-th texel.
fn compare(images: &[Image<f32>], (what, stride): (&str, usize), expected: impl Fn([i64; 2]) -> [f64; 2]) {
    let width = images[0].width() as usize;
    for index in (0..images[0].pixels().len()).step_by(stride) {
        let texel = [(index % width) as i64, (index / width) as i64];
        let wanted = expected(texel);
        for (channel, wanted) in wanted.into_iter().enumerate() {
            let value = f64::from(images[channel].pixels()[index]);
            let apart = (value - wanted).abs();
            assert!(apart <= ROUNDING, "{what} {texel:?}.{channel}: {value}, {wanted} by brute force");
        }
    }
}

/// Every level of the chain against means of blocks of the shadow map.
pub(crate) fn check_chain(ran: &Ran) {
    let levels: Vec<_> = ran.dumps.iter().filter(|dump| dump.label == "moments-mips").collect();
    // 500 texels are filled up to 512: ten levels.
    assert_eq!(levels.len(), 10);
    for dump in levels {
        let block = 1i64 << dump.level;
        assert_eq!(i64::from(dump.channels[0].width()), 512 / block);
        let stride = if block < 8 { 97 } else { 1 };
        compare(&dump.channels, (&format!("level {}", dump.level), stride), |[x, y]| {
            mean(ran, [x * block, y * block], [(x + 1) * block - 1, (y + 1) * block - 1])
        });
    }
}

#[test]
fn every_level_is_the_mean_of_blocks_of_the_map() {
    cases("vsm-mips").iter().for_each(|case| check_chain(&case.run()));
}

/// 3 x 3 texels of 4 x 4 of the map's. At the border the box repeats whole texels.
pub(crate) fn check_filtered(ran: &Ran) {
    let images = ran.channels("moments-filtered");
    assert_eq!(images[0].width(), 128);
    compare(images, ("filtered", 7), |[x, y]| {
        let mut sums = [0.0; 2];
        for k in 0..9 {
            let [x, y] = [x + k % 3 - 1, y + k / 3 - 1].map(|c| c.clamp(0, 127));
            let four = mean(ran, [4 * x, 4 * y], [4 * x + 3, 4 * y + 3]);
            (0..2).for_each(|m| sums[m] += four[m] / 9.0);
        }
        sums
    });
}

#[test]
fn the_filtered_map_is_a_mean_of_4x4_then_3x3() {
    cases("vsm-filtered").iter().for_each(|case| check_filtered(&case.run()));
}

/// The finest level of an exponential map: exp(c (z - far)), c = 80 over the depths that there are.
/// The exponent is rounded by a few 2^-24 of 80.
#[test]
fn an_exponential_map_holds_its_exponential() {
    for case in cases("esm") {
        let ran = case.run();
        let map = LightMap::new(&ran.scene, &case.light, MAP_TEXELS);
        let (near, far) = (f64::from(map.nearest_blocker), f64::from(map.far));
        let (depths, image) = (ran.image("shadow-map"), ran.image("exponential-mips"));
        for k in 0..MAP_TEXELS {
            let depth = f64::from(*depths.at(k, 3 * k % MAP_TEXELS));
            let wanted = (80.0 * (depth - far) / (far - near)).exp();
            let value = f64::from(*image.at(k, 3 * k % MAP_TEXELS));
            assert!((value / wanted - 1.0).abs() < 1e-4, "{k}: {value}, {wanted} by definition");
        }
    }
}

/// Widths of boxes in texels, by column; rows choose the moment.
const WIDTHS: [f64; 4] = [1.0, 1.7, 5.3, 9.0];
const LOOKUP: &str = "let width = array(1.0, 1.7, 5.3, 9.0)[u32(r.place.x) % 4u]; \
                      let uv = (r.place + vec2(0.3, 0.1)) / vec2<f32>(globals.frame_size); \
                      let m = moments_over(uv, width); return select(m.x, m.y, u32(r.place.y) % 2u == 1u);";

/// The place that the probe of a pixel looks up, in texels of the map.
fn place([x, y]: [u32; 2]) -> [f64; 2] {
    let (width, height) = still_life::SIZE;
    let share = [(f64::from(x) + 0.8) / f64::from(width), (f64::from(y) + 0.6) / f64::from(height)];
    share.map(|c| c * f64::from(MAP_TEXELS))
}

/// Mean moments of a box between texels, cut off at the border, by the area of each texel in it.
fn box_mean(ran: &Ran, middle: [f64; 2], width: f64) -> [f64; 2] {
    let side = f64::from(MAP_TEXELS);
    let low = middle.map(|c| (c - 0.5 * width).max(0.0));
    let high = middle.map(|c| (c + 0.5 * width).min(side));
    let share = |k: usize, texel: i64| (high[k].min(texel as f64 + 1.0) - low[k].max(texel as f64)).max(0.0);
    let range = |k: usize| low[k].floor() as i64..=(high[k].ceil() as i64 - 1);
    let (mut sums, mut area) = ([0.0; 2], 0.0);
    for y in range(1) {
        for x in range(0) {
            let weight = share(0, x) * share(1, y);
            let texel = mean(ran, [x, y], [x, y]);
            (0..2).for_each(|m| sums[m] += weight * texel[m]);
            area += weight;
        }
    }
    sums.map(|sum| sum / area)
}

/// A constant of the run's passes.
fn constant(case: &Case, name: &str) -> f64 {
    let all = crate::case::constants(case);
    all.iter().find(|c| c.0 == name).unwrap_or_else(|| panic!("no {name}")).1
}

/// Values of a probe where a surface is seen, with pixel and moment.
fn probed(ran: &Ran) -> impl Iterator<Item = ([u32; 2], usize, f64)> {
    let all = ran.values.iter().enumerate().map(|(index, &value)| {
        let pixel = [index as u32 % still_life::SIZE.0, index as u32 / still_life::SIZE.0];
        (pixel, pixel[1] as usize % 2, f64::from(value))
    });
    all.filter(|(pixel, ..)| ran.surface(*pixel).is_some())
}

/// The table's lookups against means over boxes. A stored fraction is off by half a step; depth
/// spans -1..1, two steps' worth, and less in units of the far plane's distance. Sums become floats
/// of 24 bits.
pub(crate) fn check_table(case: &Case) {
    let ran = Case { variant: probe(case.variant, LOOKUP), ..case.clone() }.run();
    let [bits, widest] = ["TABLE_BITS", "TABLE_WIDEST"].map(|name| constant(case, name));
    // No box can wrap twice: not even one whose edges cut two more texels.
    assert!((widest + 2.0).powi(2) * bits.exp2() <= 2f64.powi(31), "{bits} bits, {widest} texels");
    let tolerance = (-bits).exp2() + LOOKUP_ROUNDING;
    for (pixel, moment, value) in probed(&ran) {
        let width = WIDTHS[pixel[0] as usize % 4].min(widest);
        let wanted = box_mean(&ran, place(pixel), width)[moment];
        let apart = (value - wanted).abs();
        assert!(apart <= tolerance, "{pixel:?}, width {width}: {value}, {wanted} by brute force");
    }
}

#[test]
fn the_table_gives_means_over_boxes_of_any_width() {
    cases("vsm-sat").iter().for_each(check_table);
}

/// A trilinear tap from the levels that the pipeline wrote.
pub(crate) fn check_trilinear(case: &Case) {
    let ran = Case { variant: probe(case.variant, LOOKUP), ..case.clone() }.run();
    for (pixel, moment, value) in probed(&ran) {
        let lod = WIDTHS[pixel[0] as usize % 4].log2();
        let at = |level: f64| {
            let block = 1i64 << level as i64;
            let corner = place(pixel).map(|c| c / block as f64 - 0.5);
            let weight = corner.map(|c| c - c.floor());
            let texel = |dx: i64, dy: i64| {
                let [x, y] = [corner[0].floor() as i64 + dx, corner[1].floor() as i64 + dy]
                    .map(|c| c.clamp(0, 512 / block - 1) * block);
                mean(&ran, [x, y], [x + block - 1, y + block - 1])[moment]
            };
            let row = |dy| texel(0, dy) * (1.0 - weight[0]) + texel(1, dy) * weight[0];
            row(0) * (1.0 - weight[1]) + row(1) * weight[1]
        };
        let share = lod - lod.floor();
        let wanted = at(lod.floor()) * (1.0 - share) + at(lod.floor() + 1.0) * share;
        let apart = (value - wanted).abs();
        assert!(apart <= LOOKUP_ROUNDING, "{pixel:?}: {value}, {wanted} by brute force");
    }
}

#[test]
fn a_lookup_of_the_chain_is_trilinear() {
    cases("vsm-mips").iter().for_each(check_trilinear);
}

/// Columns choose t = (c - a) / (b - a) of two occluders a < b and a receiver c, rows the share q
/// of a; a = 0, b = 1/8.
const TWO_OCCLUDERS: &str = "let t = 1.0 + 0.125 * (1.0 + floor(r.place.x) % 24.0); \
                             let q = floor(r.place.y) / 64.0; \
                             return upper_bound(vec2(1.0 - q, (1.0 - q) * 0.125) * 0.125, t * 0.125);";

/// Nothing is lit there: what the bound says is light bleeding, at most 1 / (2t - 1)^2, reached
/// where t / (2t - 1) of the texels hold the nearer occluder.
#[test]
fn bleeding_between_two_occluders_has_its_closed_form() {
    let variant = variant_id("vsm-mips", Calibration::LightMatched);
    let ran = Case::new(probe(variant, TWO_OCCLUDERS), still_life::sun()).run();
    let mut reached = 0;
    for (pixel, _, leak) in probed(&ran) {
        let t = 1.0 + 0.125 * f64::from(1 + pixel[0] % 24);
        let q = f64::from(pixel[1]) / 64.0;
        let worst = 1.0 / (2.0 * t - 1.0).powi(2);
        // The variance floor, 1e-8 of squares of at least 1e-3, adds less than 1e-4.
        assert!(leak <= worst + 1e-4, "t {t}, share {q}: {leak} leaks, at most {worst}");
        let best = (t - 1.0) / (2.0 * t - 1.0);
        if (q - best).abs() < 0.01 {
            assert!(leak > 0.98 * worst, "t {t}, share {q}: {leak} of {worst}");
            reached += 1;
        }
        // The document's linstep removes it from t = (1 + sqrt 5) / 2 on.
        let golden = 0.5 * (1.0 + 5f64.sqrt());
        assert!(t < golden || worst <= 0.2 + 1e-12);
    }
    assert!(reached > 20, "only {reached} near the worst share");
}

/// One occluder before a receiver, both parallel to the map: the bound is the lit share itself.
#[test]
fn a_mix_of_receiver_and_occluder_is_bounded_by_its_own_share() {
    let body = "let p = floor(r.place.x) / 96.0; let b = 0.01 * (1.0 + floor(r.place.y)) - 0.5; let z = 0.2; \
                return upper_bound(vec2(p * z + (1.0 - p) * b, p * z * z + (1.0 - p) * b * b), z);";
    let variant = variant_id("vsm-mips", Calibration::LightMatched);
    let ran = Case::new(probe(variant, body), still_life::sun()).run();
    for (pixel, _, bound) in probed(&ran) {
        let share = f64::from(pixel[0]) / 96.0;
        let gap = 0.2 - (0.01 * f64::from(1 + pixel[1]) - 0.5);
        // Moments round by 2^-24, and the floor is 1e-8: both over the square of the gap, 0.16.
        let tolerance = 4e-8 / (gap * gap) / (1.0 - share).max(0.1) + 1e-6;
        assert!((bound - share).abs() <= tolerance, "{pixel:?}: {bound}, share {share}, gap {gap}");
    }
}
