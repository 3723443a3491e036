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
