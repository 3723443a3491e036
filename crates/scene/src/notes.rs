//! What is suspicious about a scene but not wrong: said, never refused.

use crate::rays::Soup;
use crate::{AreaLight, Scene};

/// Sentences for people, about a scene whose lights stand in the file's order.
pub(crate) fn about(scene: &Scene, scored_light: usize) -> Vec<String> {
    let soup = Soup::from(&scene.geometry);
    let mut notes = Vec::new();
    if scene.lights.len() > 1 {
        let (count, scored) = (scene.lights.len(), scored_light + 1);
        notes.push(format!("{count} lights: number {scored} is scored; --light chooses"));
    }
    for (i, light) in scene.lights.iter().enumerate() {
        notes.extend(about_light(light, scene, &soup).map(|what| format!("light {} {what}", i + 1)));
    }
    for path in &scene.paths {
        let eye = path.frames[0].camera.eye();
        if soup.is_inside_solid(eye.as_dvec3()) {
            notes.push(format!("path '{}' starts inside a solid", path.name));
        }
    }
    notes
}

fn about_light(light: &AreaLight, scene: &Scene, soup: &Soup) -> Option<&'static str> {
    let lowest = scene.geometry.bounds().0.y;
    match light.centre() {
        None if light.direction_from(glam::Vec3::ZERO).y <= 0.0 => {
            Some("stands below the horizon: it reaches surfaces only from below")
        }
        Some(centre) if centre.y < lowest => {
            Some("lies below every surface: it reaches them only from below")
        }
        Some(centre) if soup.is_inside_solid(centre.as_dvec3()) => Some("lies inside a solid"),
        _ => None,
    }
}
