//! Rasterised depth, of the light and of the camera, against a brute-force ray cast in f64.

use crate::support::edited::{Edit, with_edit};
use crate::support::{self, still_life, variant_id};
use glam::{DVec3, Vec3};
use std::panic::{AssertUnwindSafe, catch_unwind};
use umbrage_frame::{Image, View};
use umbrage_scene::{AlphaMask, AreaLight, Camera, Scene, Wrap};
use umbrage_shadows::{Calibration, Dump, Pass, Renderer, Seeding, VARIANTS, VariantId};

/// Rays through places of a picture (in texels), such that the ray's parameter is linear depth.
pub(crate) struct Caster {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    /// Half the picture's width and height: metres (parallel rays), or metres at depth 1.
    half: [f64; 2],
    parallel: bool,
    /// Depth that a depth buffer cannot tell apart, metres at a depth.
    resolution: fn(f64, f64) -> f64,
    near: f64,
}

/// Half an ulp of f32.
const U: f64 = 1.0 / (1u64 << 24) as f64;

impl Caster {
    pub(crate) fn of_light(scene: &Scene, light: &AreaLight) -> Self {
        let region = scene.shadow_region;
        let (centre, half) = (region.centre.as_dvec3(), 0.5 * f64::from(region.width_world));
        let parallel = light.centre().is_none();
        let towards = match light.centre() {
            Some(place) => (place.as_dvec3() - centre).normalize(),
            None => light.direction_from(region.centre).as_dvec3(),
        };
        let right = DVec3::Y.cross(towards).normalize();
        // A sun's eye stands one map width away, or a little above everything.
        let height = |p: &Vec3| (p.as_dvec3() - centre).dot(towards);
        let highest = scene.geometry.positions.iter().map(height).fold(0.0, f64::max);
        let distance = (2.0 * half).max(highest * 1.01 + 0.01);
        let eye = light.centre().map_or(centre + towards * distance, Vec3::as_dvec3);
        let at_one = if parallel { half } else { half / (eye - centre).length() };
        let near = if parallel { 0.0 } else { 1e-3 * (eye - centre).length() };
        let (up, forward) = (towards.cross(right), -towards);
        Self { eye, right, up, forward, half: [at_one; 2], parallel, resolution: resolution(parallel), near }
    }

    fn of_camera(camera: &Camera, view: &View) -> Self {
        let axis = |k: usize| camera.world_from_camera.col(k).truncate().as_dvec3();
        let tan = (0.5 * f64::from(camera.yfov_radians)).tan();
        let half = [tan * f64::from(view.width) / f64::from(view.height), tan];
        let near = f64::from(camera.near_world);
        let (eye, right, up, forward) = (camera.eye().as_dvec3(), axis(0), axis(1), -axis(2));
        Self { eye, right, up, forward, half, parallel: false, resolution: resolution(false), near }
    }

    /// Depth of the first surface, and of the last one that a depth buffer may take for it.
    fn cast(&self, scene: &Scene, place: [f64; 2]) -> Option<(f64, f64)> {
        let hits = self.cast_all(scene, place);
        let first = hits.iter().copied().reduce(f64::min)?;
        let same = first + (self.resolution)(first, self.near);
        Some((first, hits.into_iter().filter(|&depth| depth <= same).fold(first, f64::max)))
    }

    /// Depths of all surfaces along the ray, in no order.
    pub(crate) fn cast_all(&self, scene: &Scene, [u, v]: [f64; 2]) -> Vec<f64> {
        let aside =
            self.right * ((2.0 * u - 1.0) * self.half[0]) + self.up * ((1.0 - 2.0 * v) * self.half[1]);
        let (origin, direction) =
            if self.parallel { (self.eye + aside, self.forward) } else { (self.eye, self.forward + aside) };
        let triangles = 0..scene.geometry.triangles.len();
        let hit = |t| {
            let (depth, along) = intersect(origin, direction, scene.geometry.corners(t).map(Vec3::as_dvec3))?;
            is_there(scene, t, along).then_some(depth)
        };
        triangles.filter_map(hit).filter(|&depth| depth > self.near).collect()
    }
}

/// Depth buffers hold z / far for parallel rays and about 1 - near / z for others, to an ulp or two.
fn resolution(parallel: bool) -> fn(f64, f64) -> f64 {
    if parallel { |_, _| 100.0 * 4.0 * U } else { |z, near| 4.0 * U * z * z / near }
}

/// Whether a triangle is there, so far along its first and second sides.
fn is_there(scene: &Scene, triangle: usize, [along_ab, along_ac]: [f64; 2]) -> bool {
    let material = &scene.materials[scene.geometry.material[triangle] as usize];
    material.mask.as_ref().is_none_or(|mask| {
        let [a, b, c] = scene.geometry.uvs[triangle].map(|uv| uv.as_dvec2());
        mask.is_opaque(a + along_ab * (b - a) + along_ac * (c - a))
    })
}

/// Where a ray meets a triangle, from either side, and how far along its sides (Möller and Trumbore 1997).
fn intersect(origin: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> Option<(f64, [f64; 2])> {
    let (ab, ac) = (b - a, c - a);
    let p = direction.cross(ac);
    let determinant = ab.dot(p);
    if determinant == 0.0 {
        return None;
    }
    let from = origin - a;
    let (u, q) = (from.dot(p) / determinant, from.cross(ab));
    let v = direction.dot(q) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| (ac.dot(q) / determinant, [u, v]))
}

/// Rasterisers move vertices to a grid of 1/256 pixel, an edge by half of that, and attributes may
/// move along: depth is that of a point less than this away.
pub(crate) const SNAP_PX: f64 = 1.0 / 256.0;

/// Coordinates of up to 50 m pass a matrix and an interpolation: some 20 roundings.
pub(crate) const ROUNDING_WORLD: f64 = 20.0 * U * 50.0;

/// Compares `samples` random pixels; returns how many lie on a silhouette.
fn compare(depths: &Image<f32>, scene: &Scene, (caster, far): (&Caster, f64), samples: u32) -> usize {
    let mut silhouettes = 0;
    let mut state = 12345u64;
    for _ in 0..samples {
        // Knuth's generator: any fixed scatter will do.
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let (x, y) = ((state >> 33) as u32 % depths.width(), (state >> 13) as u32 % depths.height());
        let place = |dx: f64, dy: f64| {
            let centre = [f64::from(x) + 0.5 + dx * SNAP_PX, f64::from(y) + 0.5 + dy * SNAP_PX];
            [centre[0] / f64::from(depths.width()), centre[1] / f64::from(depths.height())]
        };
        let corners = [(0.0, 0.0), (1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
        let rays = corners.map(|(dx, dy)| caster.cast(scene, place(dx, dy)).unwrap_or((far, far)));
        let low = rays.iter().map(|r| r.0).fold(f64::INFINITY, f64::min) - ROUNDING_WORLD;
        let high = rays.iter().map(|r| r.1).fold(0.0, f64::max) + ROUNDING_WORLD;
        let depth = f64::from(*depths.at(x, y));
        assert!((low..=high).contains(&depth), "({x}, {y}): {depth} is not in {low}..{high}");
        silhouettes += usize::from(high - low > 0.05);
    }
    silhouettes
}

/// At most this share lies within 1/256 pixel of a silhouette, or on a surface seen edge-on.
const SILHOUETTE_SHARE: f64 = 0.02;

/// The targets of a variant, its own map's far plane first.
fn targets(scene: &Scene, light: &AreaLight, variant: VariantId) -> (f64, Vec<Dump>) {
    let view = still_life::view_of(&still_life::camera());
    let mut gpu = support::gpu();
    let mut renderer = Renderer::new(&mut gpu, scene, 512).expect("fits");
    let far = f64::from(renderer.light_map(light).far);
    let dumped = renderer.dump(variant, (&view, light), (Seeding::Frozen, [0, 0]));
    (far, dumped.expect("runs").1)
}

fn hard() -> VariantId {
    variant_id("hard", Calibration::LightMatched)
}

fn check(scene: &Scene, light: AreaLight, (variant, samples): (VariantId, u32)) {
    let (far, dumps) = targets(scene, &light, variant);
    let target = |label| &dumps.iter().find(|d| d.label == label).expect("dumped").channels[0];
    let camera = still_life::camera();
    let view = still_life::view_of(&camera);
    let casters = [
        (target("shadow-map"), Caster::of_light(scene, &light), far),
        // Where nothing is seen, the target holds 0.
        (target("camera-depth"), Caster::of_camera(&camera, &view), 0.0),
    ];
    for (depths, caster, nothing) in casters {
        let silhouettes = compare(depths, scene, (&caster, nothing), samples);
        let share = silhouettes as f64 / f64::from(samples);
        assert!(share <= SILHOUETTE_SHARE, "{share} of the pixels lie on silhouettes");
    }
}

#[test]
fn shadow_map_and_camera_depth_equal_a_ray_cast() {
    let scene = still_life::scene();
    for light in [still_life::sun(), still_life::sphere(), still_life::disk()] {
        check(&scene, light, (hard(), 4000));
    }
}

/// Cut-out surfaces are there for the rays and for the raster at the same texels of their masks, but for
/// those whose edges a rasteriser's grid moves.
#[test]
fn cut_out_surfaces_equal_a_ray_cast() {
    for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
        let scene = still_life::leafy(still_life::leaf(wrap));
        for light in [still_life::sun(), still_life::sphere()] {
            check(&scene, light, (hard(), 4000));
        }
    }
}

/// Cut-out triangles are drawn in the passes that there are; whole scenes have no shader for them.
#[test]
fn masks_add_no_pass() {
    let mut gpu = support::gpu();
    let view = still_life::view_of(&still_life::camera());
    let scenes = [still_life::scene(), still_life::leafy(still_life::leaf(Wrap::Repeat))];
    for variant in VARIANTS {
        let id = variant_id(variant.name, Calibration::LightMatched);
        let light = still_life::light_for(id);
        let [whole, cut] = scenes.each_ref().map(|scene| {
            let mut renderer = Renderer::new(&mut gpu, scene, 64).expect("fits");
            renderer.recording(id, (&view, &light), (Seeding::Frozen, [0, 0])).expect("fits").passes
        });
        let labels = |passes: &[Pass]| passes.iter().map(Pass::label).collect::<Vec<_>>();
        assert_eq!(labels(&whole), labels(&cut), "{}", variant.name);
        for (whole, cut) in whole.iter().zip(&cut) {
            if let (Pass::Raster(whole), Pass::Raster(cut)) = (whole, cut) {
                assert!(whole.cut.is_empty() && !cut.cut.is_empty(), "{}", whole.label);
                assert_eq!(whole.shader, cut.shader);
            }
        }
    }
}

/// All there is as no mask, none there as no triangle: in every target of variants that peel layers and
/// draw cubes.
#[test]
fn masks_of_one_bit_change_nothing_or_everything() {
    let whole = still_life::scene();
    let mask = |there: bool| AlphaMask::new([3, 2], [Wrap::Repeat; 2], |_, _| there);
    let mut bare = whole.clone();
    let kept = bare.geometry.triangles.len() - 2 - 3 * 12;
    bare.geometry.triangles.truncate(kept);
    bare.geometry.material.truncate(kept);
    let cube = |id: &VariantId| id.name().starts_with("pcf-cube");
    let peels = |id: &VariantId| id.name().starts_with("chss-layers");
    let every = VARIANTS.iter().map(|v| variant_id(v.name, Calibration::LightMatched));
    let chosen: Vec<VariantId> = every.filter(|id| cube(id) || peels(id)).collect();
    assert!(chosen.iter().any(cube) && chosen.iter().any(peels), "{:?}", chosen.len());
    for id in chosen {
        let light = still_life::light_for(id);
        for (scene, there) in [(&whole, true), (&bare, false)] {
            let (_, expected) = targets(scene, &light, id);
            // The same light map: its depths are those of the surfaces, there or not.
            let mut cut = still_life::leafy(mask(there));
            if !there {
                cut.geometry.positions.clone_from(&scene.geometry.positions);
            }
            let (_, found) = targets(&cut, &light, id);
            for (a, b) in expected.iter().zip(&found) {
                assert_eq!(a.label, b.label);
                let same = a.channels.iter().zip(&b.channels).all(|(a, b)| a.pixels() == b.pixels());
                assert!(same, "{}, {there}: {}", id.name(), a.label);
            }
        }
    }
}

#[test]
fn shadow_map_of_a_standard_scene_equals_a_ray_cast() {
    let scene = Scene::builtin("colonnade").expect("built in");
    check(&scene, scene.lights[0], (hard(), 600));
}

#[test]
fn the_ray_cast_notices_planted_errors() {
    let scene = still_life::scene();
    let moved = |by: &'static str| Edit {
        fragment: "raster_shadow",
        from: "globals.light_clip_from_world * world",
        to: by,
    };
    let plants = [
        // A tenth of a texel of 512: 2 / 5120 in clip space (under a sun w is 1).
        moved("globals.light_clip_from_world * world + vec4(0.00039, 0.0, 0.0, 0.0)"),
        moved("(globals.light_clip_from_world * world) * vec4(1.0, -1.0, 1.0, 1.0)"),
        Edit { fragment: "raster_shadow", from: "return in.depth", to: "return in.depth + 0.0005" },
        Edit {
            fragment: "raster_camera",
            from: "clip, position, normal, clip.w",
            to: "clip, position, normal, clip.z",
        },
    ];
    for edit in plants {
        let variant = with_edit(variant_id("chss-mask", Calibration::LightMatched), edit);
        let checked = || check(&scene, still_life::sun(), (variant, 4000));
        let noticed = catch_unwind(AssertUnwindSafe(checked)).is_err();
        assert!(noticed, "{edit:?} was not noticed");
    }
}
