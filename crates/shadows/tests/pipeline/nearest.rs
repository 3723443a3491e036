//! Where blockers begin: the depth to which searches and kernels open their cones.

use crate::support::{self, still_life, variant_id};
use glam::{Mat4, Quat, Vec3};
use umbrage_scene::{AreaLight, Geometry, Scene};
use umbrage_shadows::{Calibration, LightMap, Renderer, Seeding};

const TEXELS: u32 = 512;

/// The least depth in the rendered map.
fn least_depth(scene: &Scene, light: &AreaLight) -> f32 {
    let view = still_life::view_of(&still_life::camera());
    let variant = variant_id("hard", Calibration::LightMatched);
    let mut gpu = support::gpu();
    let mut renderer = Renderer::new(&mut gpu, scene, TEXELS).expect("fits");
    let (_, dumps) = renderer.dump(variant, (&view, light), (Seeding::Frozen, [0, 0])).expect("runs");
    let map = dumps.iter().find(|dump| dump.label == "shadow-map").expect("dumped");
    map.channels[0].pixels().iter().copied().fold(f32::INFINITY, f32::min)
}

/// A floor whose corners all lie outside of the lamp's map, with or without a board across the map
/// that also reaches beyond it.
fn room(board: Option<Vec3>) -> Scene {
    let mut geometry: Geometry = still_life::plane(20.0, Quat::IDENTITY);
    if let Some(centre) = board {
        still_life::block(&mut geometry, Vec3::new(0.4, 0.02, 12.0), Mat4::from_translation(centre));
    }
    still_life::of_geometry(geometry)
}

/// A sun's searches open to what stands over its map, never to less.
#[test]
fn a_sun_searches_up_to_everything_in_its_map() {
    let sun = still_life::sun();
    for scene in [room(None), room(Some(Vec3::new(0.2, 1.2, 0.0))), still_life::scene()] {
        let (begin, least) = (LightMap::new(&scene, &sun, TEXELS).nearest_blocker, least_depth(&scene, &sun));
        // Places of up to 20 m pass a matrix: some 20 roundings of f32.
        assert!(begin <= least + 3e-5, "{begin} of {least}");
    }
}

#[test]
fn a_mast_outside_of_a_suns_map_moves_its_eye_and_not_its_searches() {
    let sun = still_life::sun();
    let with_block = |size: Vec3, place: Vec3| {
        let mut geometry = still_life::plane(3.0, Quat::IDENTITY);
        still_life::block(&mut geometry, size, Mat4::from_translation(place));
        LightMap::new(&still_life::of_geometry(geometry), &sun, TEXELS)
    };
    // How far above the region's centre searches begin; the eye's distance of some 25 m is rounded.
    let height = |map: LightMap| map.eye_distance - map.nearest_blocker;
    let low = with_block(Vec3::splat(0.1), Vec3::new(0.0, 0.05, 0.0));
    let mast = with_block(Vec3::new(0.2, 30.0, 0.2), Vec3::new(30.0, 15.0, 30.0));
    let within = with_block(Vec3::new(0.2, 30.0, 0.2), Vec3::new(0.0, 15.0, 0.0));
    assert!((height(mast) - height(low)).abs() < 1e-5, "{} and {}", height(mast), height(low));
    assert!(height(within) > 20.0, "the same mast in the map: {}", height(within));
    // Nothing is clipped: the mast's top lies before the eye, its foot before the far plane.
    for (y, map) in [(0.0, mast), (30.0, mast), (30.0, within)] {
        let (x, z) = if map == mast { (30.1, 29.9) } else { (0.1, -0.1) };
        let depth = -map.light_from_world.transform_point3(Vec3::new(x, y, z)).z;
        assert!(depth > 0.0 && depth < map.far, "{depth} of {}", map.far);
    }
}

#[test]
fn blockers_begin_at_the_nearest_surface_of_the_map_also_where_no_vertex_is_seen() {
    let lamps = [still_life::sphere(), still_life::disk()];
    let scenes = [room(None), room(Some(Vec3::new(0.2, 1.2, 0.0))), still_life::scene()];
    for (light, scene) in lamps.iter().flat_map(|l| scenes.iter().map(move |s| (l, s))) {
        let begin = LightMap::new(scene, light, TEXELS).nearest_blocker;
        let least = least_depth(scene, light);
        // Texel centres see a little less than the surface's nearest point: here no surface that
        // is nearest leans by more than 5 texels of depth per texel, and a thin one is met within 2.
        let texel = least / (0.5 * TEXELS as f32);
        assert!(begin <= least + 1e-5 && begin >= least - 10.0 * texel, "{begin} of {least}, {light:?}");
    }
}
