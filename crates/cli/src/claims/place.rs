//! Where something is measured: a scene, a path, and what differs from the scene's own settings.

use super::registry::Overrides;
use crate::error::CliError;
use std::path::Path;
use umbrage_scene::{AreaLight, Scene};

/// A scene and path with its settings. Numbers are kept as text of their exact value, so that places
/// can be compared and ordered.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Place {
    pub(crate) scene: String,
    /// Angular diameter of the sun, degrees.
    sun_degrees: Option<String>,
    /// Radius of a light that has a place, metres.
    light_radius: Option<String>,
    /// Side of what the map covers, metres.
    region_width: Option<String>,
    /// Side of the map in texels.
    pub(crate) map: Option<u32>,
    pub(crate) path: String,
}

impl Place {
    pub(crate) fn new((scene, path): (String, String), layers: &[&Overrides]) -> Self {
        let mut place =
            Self { scene, path, map: None, sun_degrees: None, light_radius: None, region_width: None };
        for over in layers {
            let text = |v: Option<f64>| v.map(|v| v.to_string());
            place.path = over.path.clone().unwrap_or(place.path);
            place.map = over.map.or(place.map);
            place.sun_degrees = text(over.sun_degrees).or(place.sun_degrees);
            place.light_radius = text(over.light_radius).or(place.light_radius);
            place.region_width = text(over.region_width).or(place.region_width);
        }
        place
    }

    /// "edge-ladder P1, map 64²".
    pub(crate) fn label(&self) -> String {
        let settings = [
            self.map.map(|m| format!("map {m}²")),
            self.sun_degrees.as_ref().map(|d| format!("sun {d}°")),
            self.light_radius.as_ref().map(|r| format!("light {r} m")),
            self.region_width.as_ref().map(|w| format!("map {w} m wide")),
        ];
        let mut label = format!("{} {}", self.scene, self.path);
        settings.into_iter().flatten().for_each(|s| label += &format!(", {s}"));
        label
    }

    /// What windows must share to see the same tiles: the camera's way through the scene.
    pub(crate) fn ground(&self) -> (&str, &str) {
        (&self.scene, &self.path)
    }

    /// What windows must share to be rendered by one renderer.
    pub(crate) fn stage(&self) -> (&str, [&Option<String>; 3], Option<u32>) {
        (&self.scene, [&self.sun_degrees, &self.light_radius, &self.region_width], self.map)
    }

    /// The scene with its light and its map as they are here.
    pub(crate) fn build(&self) -> Result<Scene, CliError> {
        let (mut scene, _) = crate::scenes::find_scene(Path::new(&self.scene))?;
        let number = |text: &Option<String>| text.as_ref().and_then(|t| t.parse::<f32>().ok());
        if let Some(width) = number(&self.region_width) {
            scene.shadow_region.width_world = width;
        }
        let lights = scene.lights.iter_mut();
        let moved = scene.paths.iter_mut().flat_map(|p| &mut p.frames).map(|f| &mut f.light);
        for light in lights.chain(moved) {
            resize(light, number(&self.sun_degrees), number(&self.light_radius));
        }
        Ok(scene)
    }
}

fn resize(light: &mut AreaLight, sun_degrees: Option<f32>, radius: Option<f32>) {
    match light {
        AreaLight::Sun { angular_diameter_radians, .. } => {
            *angular_diameter_radians = sun_degrees.map_or(*angular_diameter_radians, f32::to_radians);
        }
        AreaLight::Disk { radius_world, .. } | AreaLight::Sphere { radius_world, .. } => {
            *radius_world = radius.unwrap_or(*radius_world);
        }
        AreaLight::Rect { .. } => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn later_layers_win_and_the_label_says_what_differs() {
        let first = Overrides { map: Some(64), sun_degrees: Some(0.1), ..Overrides::default() };
        let second = Overrides { map: Some(128), path: Some("P4".into()), ..Overrides::default() };
        let place = Place::new(("edge-ladder".into(), "P1".into()), &[&first, &second]);
        assert_eq!(place.label(), "edge-ladder P4, map 128², sun 0.1°");
        let scene = place.build().expect("a standard scene");
        let sun = scene.lights[0].angular_diameter_radians().expect("a sun");
        assert_eq!(sun, 0.1f32.to_radians());
        assert!(
            scene
                .paths
                .iter()
                .flat_map(|p| &p.frames)
                .all(|f| f.light.angular_diameter_radians() == Some(sun))
        );
    }
}
