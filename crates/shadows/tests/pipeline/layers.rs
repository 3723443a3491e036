//! Peeled layers against a brute-force ray cast: each is the nearest surface behind the one before.

use crate::depth::{Caster, ROUNDING_WORLD, SNAP_PX};
use crate::pyramids::level;
use crate::support::edited::{Edit, with_edit};
use crate::support::{self, still_life, variant_id};
use std::panic::{AssertUnwindSafe, catch_unwind};
use umbrage_scene::AreaLight;
use umbrage_shadows::{Calibration, Renderer, Seeding, VariantId};

const LAYERS: [&str; 4] = ["shadow-map", "shadow-layer-2", "shadow-layer-3", "shadow-layer-4"];

/// What is no farther than this behind a layer belongs to it (the shader's constant, and its docs').
const GAP_WORLD: f64 = 0.001;

const TEXELS: u32 = 256;

/// Every 7th texel in both directions; returns how many hold a surface, by layer.
fn check(variant: VariantId, light: &AreaLight) -> [usize; 3] {
    let scene = still_life::scene();
    let view = still_life::view_of(&still_life::camera());
    let (far, dumps) = {
        let mut gpu = support::gpu();
        let mut renderer = Renderer::new(&mut gpu, &scene, TEXELS).expect("fits");
        let far = f64::from(renderer.light_map(light).far);
        (far, renderer.dump(variant, (&view, light), (Seeding::Frozen, [0, 0])).expect("runs").1)
    };
    let caster = Caster::of_light(&scene, light);
    let mut filled = [0; 3];
    for (y, x) in (0..TEXELS).step_by(7).flat_map(|y| (0..TEXELS).step_by(7).map(move |x| (y, x))) {
        // Rasterisers move vertices by up to half of 1/256 pixel.
        let offsets = [(0.0, 0.0), (1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
        let rays = offsets.map(|(dx, dy)| {
            let place = [(x, dx), (y, dy)].map(|(c, d)| f64::from(c) + 0.5 + d * SNAP_PX);
            caster.cast_all(&scene, place.map(|c| c / f64::from(TEXELS)))
        });
        let depth = |k: usize| f64::from(*level(&dumps, LAYERS[k], 0)[0].at(x, y));
        for k in 1..4 {
            // Behind the layer before by the gap, give or take what its depth is known to.
            let behind = |slack: f64| {
                rays.iter().map(move |hits| {
                    let next = hits.iter().filter(|&&d| d > depth(k - 1) + GAP_WORLD + slack);
                    next.copied().fold(far, f64::min)
                })
            };
            let slack = 2.0 * ROUNDING_WORLD;
            let low = behind(-slack).fold(far, f64::min) - slack;
            let high = behind(slack).fold(0.0, f64::max) + slack;
            let found = depth(k);
            assert!(
                (low..=high).contains(&found),
                "{} ({x}, {y}): {found} is not in {low}..{high}",
                LAYERS[k]
            );
            filled[k - 1] += usize::from(found < far);
        }
    }
    filled
}

#[test]
fn layers_are_the_next_surfaces_along_the_ray() {
    for light in [still_life::sun(), still_life::sphere()] {
        let filled = check(variant_id("chss-layers-4", Calibration::LightMatched), &light);
        // Deeper layers are rarer; without any in the last, nothing was tested.
        assert!(filled[0] > filled[1] && filled[1] > filled[2] && filled[2] > 10, "{filled:?}");
    }
}

#[test]
fn errors_in_the_peeling_show() {
    let plants = [
        ("+ LAYER_GAP_WORLD", "+ 10.0 * LAYER_GAP_WORLD"),
        ("vec2<u32>(in.clip.xy)", "vec2<u32>(in.clip.yx)"),
        ("in.depth <= textureLoad", "in.depth < 0.9 * textureLoad"),
    ];
    for (from, to) in plants {
        let edit = Edit { fragment: "raster_peel", from, to };
        let variant = with_edit(variant_id("chss-layers-4", Calibration::LightMatched), edit);
        let noticed = catch_unwind(AssertUnwindSafe(|| check(variant, &still_life::sun()))).is_err();
        assert!(noticed, "{from} was not noticed");
    }
}
