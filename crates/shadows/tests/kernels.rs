//! What scorecards say about kernels must be what the passes are given.

mod support;

use support::edited::all_variants;
use support::variant_id;
use umbrage_shadows::Calibration::{AsPrinted, LightMatched};
use umbrage_shadows::{Kernels, Pass, VariantId};

/// The constants of all passes of a variant.
fn constants(id: VariantId, texels: u32) -> Vec<(&'static str, f64)> {
    let recording = support::recording_of(id, texels);
    let of_pass = |pass: &Pass| match pass {
        Pass::Raster(raster) => raster.constants.clone(),
        Pass::Compute(compute) => compute.constants.clone(),
    };
    recording.passes.iter().flat_map(of_pass).collect()
}

fn value(all: &[(&str, f64)], name: &str) -> f64 {
    all.iter().find(|constant| constant.0 == name).unwrap_or_else(|| panic!("no {name}")).1
}

/// All of it in one text.
fn text(kernels: &Kernels) -> String {
    [&kernels.search_radius, &kernels.kernel, &kernels.cap, &kernels.radius_convention]
        .map(String::as_str)
        .join(" | ")
}

#[test]
fn every_variant_describes_its_own_search_kernel_cap_and_convention() {
    for id in all_variants() {
        let kernels = id.kernels();
        let parts = [&kernels.search_radius, &kernels.kernel, &kernels.cap, &kernels.radius_convention];
        assert!(parts.iter().all(|part| !part.is_empty()), "{}", id.name());
        // A search is spoken of exactly where a pass makes one.
        let all = constants(id, 256);
        let searches =
            all.iter().any(|c| ["SEARCH_TAPS", "SEARCH_CELLS", "SEARCH_SCALE", "SHRINK"].contains(&c.0));
        assert_eq!(kernels.search_radius != "none", searches, "{}", id.name());
    }
}

#[test]
fn the_constants_of_the_passes_are_the_ones_described() {
    for calibration in [AsPrinted, LightMatched] {
        let described =
            |name| (variant_id(name, calibration).kernels(), constants(variant_id(name, calibration), 2048));
        let (chss, all) = described("chss");
        assert_eq!(chss.search_radius, format!("{} x {:.1}", chss.cap, value(&all, "SEARCH_SCALE")));
        let (mask, all) = described("chss-mask");
        assert_eq!(mask.search_radius, format!("{} x {}", mask.cap, value(&all, "SEARCH_SCALE")));
        let step = value(&all, "MASK_STEP");
        assert!(mask.kernel.contains(&format!("once per {step}x{step} pixels")), "{}", mask.kernel);
        let levels = value(&all, "MASK_LEVELS");
        let stored = if levels > 0.0 { format!("1/{levels} of the cap") } else { "in floats".into() };
        assert!(mask.kernel.contains(&stored), "{}", mask.kernel);
        let (min, all) = described("chss-min");
        let shrink = value(&all, "SHRINK");
        assert!(min.search_radius.contains(&format!("reduced by {shrink}")), "{}", min.search_radius);
        let (grid, all) = described("pcf-grid-11");
        let (side, fixed) = (value(&all, "GRID_SIDE"), value(&all, "GRID_STEP_TEXELS") > 0.0);
        let texels = format!("{side}x{side} texels of the map, side {} texels", side - 1.0);
        assert_eq!(grid.kernel == texels, fixed, "{}", grid.kernel);
    }
}

/// The formula of the region, read out of the words, gives the radius that the pass has.
#[test]
fn the_minimums_region_is_the_one_described() {
    let id = variant_id("chss-min", AsPrinted);
    let search = id.kernels().search_radius;
    let words = "half-width ceil(r x the map's texels / 4) reduced texels, at least 2 and at most 64, r = 0.002 map widths";
    assert!(search.contains(words), "{search}");
    for texels in [256u32, 2048, 8192] {
        let radius = (0.002f32 * texels as f32 / 4.0).ceil().clamp(2.0, 64.0);
        assert_eq!(value(&constants(id, texels), "RADIUS"), f64::from(radius), "{texels}");
    }
}

/// The first document's radius is a constant of some pass exactly where the words speak of it.
#[test]
fn the_printed_radius_appears_as_printed_and_only_there() {
    for id in all_variants() {
        let kernels = text(&id.kernels());
        let all = constants(id, 256);
        let of = |name: &str| all.iter().find(|c| c.0 == name).map_or(0.0, |c| c.1);
        let radius = of("FILTER_RADIUS_UV").max(of("LAW_SEARCH_UV"));
        if id.calibration == LightMatched {
            assert_eq!(radius, 0.0, "{}", id.name());
        } else if kernels.contains("0.002 map widths") {
            assert_eq!(radius, 0.002, "{}: {kernels}", id.name());
        }
        let cone = kernels.contains("the light's cone");
        assert!(id.calibration == LightMatched || !cone, "{}: {kernels}", id.name());
        assert!(id.calibration == AsPrinted || !kernels.contains("0.002"), "{}: {kernels}", id.name());
    }
}
