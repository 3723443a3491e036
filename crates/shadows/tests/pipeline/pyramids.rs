//! Pyramids of the shadow map and its deeper layers, against brute force.

use crate::support::edited::{Edit, with_edit};
use crate::support::{self, still_life, variant_id};
use std::panic::{AssertUnwindSafe, catch_unwind};
use umbrage_frame::Image;
use umbrage_scene::AreaLight;
use umbrage_shadows::{Calibration, Dump, Renderer, Seeding, VariantId};

/// Sides of maps: odd at the first halving, at the second, at none.
const MAPS: [u32; 3] = [501, 250, 256];

/// The targets of a variant's frame.
pub(crate) fn dumps(variant: VariantId, light: &AreaLight, texels: u32) -> Vec<Dump> {
    let scene = still_life::scene();
    let view = still_life::view_of(&still_life::camera());
    let mut gpu = support::gpu();
    let mut renderer = Renderer::new(&mut gpu, &scene, texels).expect("fits");
    renderer.dump(variant, (&view, light), (Seeding::Fresh, [0, 0])).expect("runs").1
}

pub(crate) fn level<'a>(dumps: &'a [Dump], label: &str, level: u32) -> &'a [Image<f32>] {
    let found = dumps.iter().find(|d| d.label == label && d.level == level);
    &found.unwrap_or_else(|| panic!("no level {level} of {label}")).channels
}

/// The map's texels that belong to a texel of a level: 2^(level + 1) a side, and for the last one
/// all that is left over.
fn block(map: &Image<f32>, (level, last): (u32, bool), start: u32) -> std::ops::Range<u32> {
    let side = 2u32 << level;
    start * side..if last { map.width() } else { (start + 1) * side }
}

fn check_min_max(variant: VariantId, texels: u32) {
    let dumps = dumps(variant, &still_life::sun(), texels);
    let map = &level(&dumps, "shadow-map", 0)[0];
    let levels = dumps.iter().filter(|d| d.label == "min-max").count() as u32;
    assert_eq!(levels, (texels / 2).ilog2() + 1);
    for k in 0..levels {
        let [least, largest] = level(&dumps, "min-max", k) else { panic!("two channels") };
        let side = least.width();
        assert_eq!(side, (texels >> (k + 1)).max(1));
        for (y, x) in (0..side).flat_map(|y| (0..side).map(move |x| (y, x))) {
            let rows = block(map, (k, y + 1 == side), y);
            let columns = block(map, (k, x + 1 == side), x);
            let all = rows.flat_map(|v| columns.clone().map(move |u| *map.at(u, v)));
            let (low, high) = all.fold((f32::MAX, f32::MIN), |(l, h), d| (l.min(d), h.max(d)));
            // Exact: neither rounds.
            assert_eq!((*least.at(x, y), *largest.at(x, y)), (low, high), "level {k}, {x} {y}");
        }
    }
}

fn check_means(variant: VariantId, texels: u32) {
    let dumps = dumps(variant, &still_life::sphere(), texels);
    let map = &level(&dumps, "shadow-map", 0)[0];
    let levels = dumps.iter().filter(|d| d.label == "mean-depth").count() as u32;
    for k in 0..levels {
        let means = &level(&dumps, "mean-depth", k)[0];
        for (y, x) in (0..means.height()).flat_map(|y| (0..means.width()).map(move |x| (y, x))) {
            let (rows, columns) = (block(map, (k, false), y), block(map, (k, false), x));
            let all = rows.flat_map(|v| columns.clone().map(move |u| f64::from(*map.at(u, v))));
            let mean = all.sum::<f64>() / f64::from(4u32 << (2 * k));
            // Three roundings a level, each at most 2^-24 of a sum that the mean's quarter bounds.
            let limit = 3.0 * f64::from(k + 1) * mean / f64::from(1u32 << 24);
            let found = f64::from(*means.at(x, y));
            assert!((found - mean).abs() <= limit, "level {k}, {x} {y}: {found}, not {mean}");
        }
    }
}

#[test]
fn least_and_largest_depths_are_those_of_the_texels_below() {
    let minmax = variant_id("chss-minmax", Calibration::LightMatched);
    MAPS.into_iter().for_each(|texels| check_min_max(minmax, texels));
}

#[test]
fn mean_depths_are_those_of_the_texels_below() {
    for name in ["chs", "chss-mips"] {
        MAPS.into_iter().for_each(|texels| check_means(variant_id(name, Calibration::LightMatched), texels));
    }
}

#[test]
fn errors_in_the_pyramids_show() {
    type Check = fn(VariantId, u32);
    let plants: [(&str, Edit, Check); 4] = [
        ("chss-minmax", edit("min_max_level", "id.xy == size - 1u", "id.xy > size"), check_min_max),
        ("chss-minmax", edit("min_max_level", "max(range.y, pair.y)", "max(range.y, pair.x)"), check_min_max),
        ("chs", edit("mean_level", "0.25 *", "0.2501 *"), check_means),
        ("chs", edit("mean_level", "vec2(second.x, first.y)", "vec2(first.x, second.y)"), check_means),
    ];
    for (name, edit, check) in plants {
        let variant = with_edit(variant_id(name, Calibration::LightMatched), edit);
        let noticed = catch_unwind(AssertUnwindSafe(|| check(variant, MAPS[0]))).is_err();
        assert!(noticed, "{edit:?} was not noticed");
    }
}

fn edit(fragment: &'static str, from: &'static str, to: &'static str) -> Edit {
    Edit { fragment, from, to }
}
