//! A scene file and its model become a [`Scene`]: checked, recentred, rounded to f32.
//!
//! All coordinates stay in f64 until `origin` is subtracted: a vertex is rounded once, relative to
//! the scene's centre.

use crate::model::{Model, Object};
use crate::paths::{Surroundings, resolve};
use crate::spec::{LightSpec, SceneFile, ShadowRegionSpec};
use crate::{AreaLight, CameraPath, Geometry, Material, Scene, SceneError, ShadowRegion, notes};
use glam::{DVec3, Vec3};
use std::path::Path;

/// A scene farther than this from its file's origin, and farther than its own size, is recentred.
/// At 100 m one f32 step is 8 micrometres.
const FAR_WORLD: f64 = 100.0;

/// Triangles of at most this doubled area (m2) are dropped: a square of a micrometre. Below, the
/// squared length of an f32 cross product approaches the smallest f32 and normals become NaN.
const DEGENERATE_AREA: f32 = 1e-12;

pub(crate) fn assemble(
    name: &str,
    file: &SceneFile,
    mut model: Model,
    path: &Path,
) -> Result<Scene, SceneError> {
    let mut notes = std::mem::take(&mut model.notes);
    model.check(path)?;
    let bounds = model.bounds().ok_or(SceneError::NoTriangles { path: path.to_owned() })?;
    let origin = origin_for(bounds);
    let textured = model.materials.iter().any(|m| m.mask.is_some() || m.texture.is_some());
    let (mut geometry, dropped) = geometry_from(&model.objects, origin);
    if !textured {
        geometry.uvs = Vec::new();
    }
    if geometry.triangles.is_empty() {
        return Err(SceneError::NoTriangles { path: path.to_owned() });
    }
    if dropped > 0 {
        notes.push(format!("{dropped} degenerate triangles dropped"));
    }
    if origin != DVec3::ZERO {
        notes.push(format!(
            "recentred: the file's ({}, {}, {}) is now the origin",
            origin.x, origin.y, origin.z
        ));
    }
    let lights = lights_from(&file.lights, origin, path)?;
    let scored = file.scored_light;
    let Some(&light) = lights.get(scored) else {
        let count = lights.len();
        return Err(SceneError::value(
            path,
            format!("there is no light {}: lights 1 to {count}", scored + 1),
        ));
    };
    let surroundings = Surroundings { file: path, model: &model, origin, bounds, light };
    let paths = paths_from(file, &surroundings)?;
    let shadow_region = region_from(file.shadow_region, bounds, origin, path)?;
    let mut scene = Scene {
        name: name.to_owned(),
        title: file.title.clone(),
        geometry,
        materials: materials_from(model.materials, &mut notes),
        lights,
        paths,
        shadow_region,
        origin,
        notes,
    };
    let more = notes::about(&scene, scored);
    scene.notes.extend(more);
    scene.lights[..=scored].rotate_right(1);
    Ok(scene)
}

/// What to subtract: whole metres, so that lights and cameras keep round numbers.
fn origin_for((lo, hi): (DVec3, DVec3)) -> DVec3 {
    let centre = 0.5 * (lo + hi);
    let extent = (hi - lo).max_element();
    if centre.length() > FAR_WORLD && centre.length() > extent { centre.round() } else { DVec3::ZERO }
}

/// Rounded to f32, joined, without unused vertices; and how many triangles had no area.
fn geometry_from(objects: &[Object], origin: DVec3) -> (Geometry, usize) {
    let mut geometry = Geometry::default();
    let mut dropped = 0;
    for object in objects {
        let mut placed = vec![None; object.positions.len()];
        for (triangle, corners) in object.triangles.iter().enumerate() {
            let at = corners.map(|v| (object.positions[v as usize] - origin).as_vec3());
            if is_degenerate(at) {
                dropped += 1;
                continue;
            }
            geometry.triangles.push([0, 1, 2].map(|k| {
                *placed[corners[k] as usize].get_or_insert_with(|| {
                    geometry.positions.push(at[k]);
                    geometry.positions.len() as u32 - 1
                })
            }));
            geometry.material.push(object.material);
            geometry.uvs.push(object.uvs.get(triangle).copied().unwrap_or_default());
        }
    }
    (geometry, dropped)
}

/// Negated, so that an overflow to NaN counts as degenerate too.
fn is_degenerate([a, b, c]: [Vec3; 3]) -> bool {
    let area = (b - a).cross(c - a).length();
    !(area > DEGENERATE_AREA && area.is_finite())
}

fn lights_from(specs: &[LightSpec], origin: DVec3, path: &Path) -> Result<Vec<AreaLight>, SceneError> {
    if specs.is_empty() {
        return Err(SceneError::value(path, "a scene needs at least one [[light]]"));
    }
    let resolve = |(i, spec): (usize, &LightSpec)| {
        spec.resolve(origin).map_err(|message| SceneError::value(path, format!("light {}: {message}", i + 1)))
    };
    specs.iter().enumerate().map(resolve).collect()
}

fn paths_from(file: &SceneFile, scene: &Surroundings) -> Result<Vec<CameraPath>, SceneError> {
    if file.paths.is_empty() {
        return Err(SceneError::value(scene.file, "a scene needs at least one [[path]]"));
    }
    for (i, path) in file.paths.iter().enumerate() {
        if file.paths[..i].iter().any(|earlier| earlier.name == path.name) {
            return Err(SceneError::value(scene.file, format!("two paths are called '{}'", path.name)));
        }
    }
    file.paths.iter().map(|path| resolve(path, scene)).collect()
}

fn region_from(
    spec: Option<ShadowRegionSpec>,
    bounds: (DVec3, DVec3),
    origin: DVec3,
    path: &Path,
) -> Result<ShadowRegion, SceneError> {
    let spec = spec.unwrap_or_else(|| ShadowRegionSpec::fitted(bounds));
    let sizes = [spec.width_world, spec.reference_gap_world];
    if !(sizes.iter().all(|&size| size > 0.0 && size.is_finite()) && DVec3::from(spec.centre).is_finite()) {
        return Err(SceneError::value(
            path,
            "shadow_region: width and gap must be above 0, all numbers finite",
        ));
    }
    Ok(ShadowRegion {
        centre: (DVec3::from(spec.centre) - origin).as_vec3(),
        width_world: spec.width_world as f32,
        reference_gap_world: spec.reference_gap_world as f32,
    })
}

/// Reflectances forced into 0 to 1, and never an empty list.
fn materials_from(mut materials: Vec<Material>, notes: &mut Vec<String>) -> Vec<Material> {
    for material in &mut materials {
        let allowed = material.albedo.map(|c| if c.is_nan() { 0.5 } else { c.clamp(0.0, 1.0) });
        if allowed != material.albedo {
            notes.push(format!(
                "material '{}': colour {} brought into 0 to 1",
                material.name, material.albedo
            ));
            material.albedo = allowed;
        }
    }
    if materials.is_empty() {
        materials.push(Material::grey());
    }
    materials
}
