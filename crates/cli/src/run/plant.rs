//! Faults put in on purpose, to measure how often the gate finds them.

use crate::args::Plant;
use umbrage_frame::Anchors;
use umbrage_scene::AreaLight;
use umbrage_shadows::LightMap;

/// How much narrower a narrow penumbra is.
const NARROWER: f32 = 0.98;

/// The light that variants are told.
pub(super) fn light(plant: Option<Plant>, light: &AreaLight) -> AreaLight {
    if plant != Some(Plant::NarrowPenumbra) {
        return *light;
    }
    match *light {
        AreaLight::Sun { direction_to_light, angular_diameter_radians } => AreaLight::Sun {
            direction_to_light,
            angular_diameter_radians: NARROWER * angular_diameter_radians,
        },
        AreaLight::Disk { centre, normal, radius_world } => {
            AreaLight::Disk { centre, normal, radius_world: NARROWER * radius_world }
        }
        AreaLight::Rect { centre, half_u, half_v } => {
            AreaLight::Rect { centre, half_u: NARROWER * half_u, half_v: NARROWER * half_v }
        }
        AreaLight::Sphere { centre, radius_world } => {
            AreaLight::Sphere { centre, radius_world: NARROWER * radius_world }
        }
    }
}

/// The points that variants are asked about: under a sun, half a texel off along the map's rows.
pub(super) fn anchors(plant: Option<Plant>, anchors: &Anchors, map: &LightMap) -> Anchors {
    let mut moved = anchors.clone();
    if plant == Some(Plant::HalfTexel) {
        let step = map.light_from_world.row(0).truncate() * (0.5 / (map.texels as f32 * map.scale));
        moved.position.iter_mut().for_each(|p| *p += step);
    }
    moved
}
