//! What is suspicious about a scene but not wrong: said, never refused.

use crate::{AreaLight, Scene};

/// Sentences for people.
pub(crate) fn about(scene: &Scene) -> Vec<String> {
    let below = |light: &AreaLight| matches!(light, AreaLight::Sun { direction_to_light, .. } if direction_to_light.y <= 0.0);
    let mut notes = Vec::new();
    for (i, _) in scene.lights.iter().enumerate().filter(|(_, light)| below(light)) {
        notes.push(format!("light {} stands below the horizon: it reaches no surface from above", i + 1));
    }
    notes
}
