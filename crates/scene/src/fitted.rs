//! A scene file for a model that came without one.

use crate::SceneError;
use crate::model::Model;
use crate::spec::{GeometrySpec, LightSpec, Motion, PathSpec, SceneFile, ShadowRegionSpec};
use glam::DVec3;
use std::path::Path;

pub(crate) fn file_for(model: &Model, path: &Path) -> Result<SceneFile, SceneError> {
    let bounds = model.bounds().ok_or(SceneError::NoTriangles { path: path.to_owned() })?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    Ok(SceneFile {
        title: format!("{stem}, with a light and paths fitted to its size"),
        geometry: GeometrySpec::file(path),
        shadow_region: Some(ShadowRegionSpec::fitted(bounds)),
        lights: vec![LightSpec::Sun {
            angular_diameter_degrees: 2.0,
            elevation_degrees: Some(50.0),
            azimuth_degrees: Some(30.0),
            direction_to_light: None,
        }],
        paths: paths_for(model, bounds),
    })
}

impl ShadowRegionSpec {
    /// Wide enough for the bounds from any side. The reference gap is a third of their height (of
    /// their width for something flat): where blockers hang is not known.
    pub(crate) fn fitted((lo, hi): (DVec3, DVec3)) -> Self {
        let extent = hi - lo;
        let height = extent.y.max(0.1 * extent.max_element());
        // Above zero even for a single point, so that a degenerate model gets its own message.
        let at_least = |size: f64| size.max(1e-3);
        Self {
            centre: (0.5 * (lo + hi)).to_array(),
            width_world: at_least(extent.length()),
            reference_gap_world: at_least(height / 3.0),
        }
    }
}

fn paths_for(model: &Model, bounds: (DVec3, DVec3)) -> Vec<PathSpec> {
    let _ = bounds;
    let of_camera = |name: &String| path(name.clone(), Motion::Gltf { camera: name.clone() });
    model.cameras.iter().map(|camera| of_camera(&camera.name)).collect()
}

fn path(name: String, motion: Motion) -> PathSpec {
    PathSpec { name, title: None, frames: None, frames_per_second: 60.0, yfov_degrees: 60.0, motion }
}
