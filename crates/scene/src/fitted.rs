//! A scene file for a model that came without one: sun, shadow region and paths from its shape.
//!
//! Lengths are fractions of the model's size, because a file does not say its unit. The camera
//! starts above a floor with a free view if there is such a place inside the model (a hall, a
//! street); else it looks at the model from outside.

use crate::SceneError;
use crate::model::Model;
use crate::rays::{Hit, Soup};
use crate::spec::{GeometrySpec, LightSpec, Motion, PathSpec, SceneFile, ShadowRegionSpec};
use glam::{DQuat, DVec3};
use std::path::Path;

/// A level place to start from.
#[derive(Clone, Copy, Debug)]
struct Start {
    eye: DVec3,
    /// Level unit vector.
    forward: DVec3,
    /// How far the camera may go.
    free: f64,
    /// Of the eye above the floor.
    height: f64,
}

pub(crate) fn file_for(model: &Model, path: &Path) -> Result<SceneFile, SceneError> {
    let soup = Soup::from(model);
    let bounds = model.bounds().ok_or(SceneError::NoTriangles { path: path.to_owned() })?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let mut paths = fitted_paths(best_start(&soup, bounds));
    for camera in &model.cameras {
        let taken = paths.iter().any(|path| path.name == camera.name);
        let name = if taken { format!("camera {}", camera.name) } else { camera.name.clone() };
        paths.push(plain_path(&name, Motion::Gltf { camera: camera.name.clone() }));
    }
    Ok(SceneFile {
        title: format!("{stem}, with a sun and paths fitted to its size"),
        geometry: GeometrySpec::file(path),
        shadow_region: Some(ShadowRegionSpec::fitted(bounds)),
        lights: vec![LightSpec::Sun {
            angular_diameter_degrees: 2.0,
            elevation_degrees: Some(50.0),
            azimuth_degrees: Some(30.0),
            direction_to_light: None,
        }],
        scored_light: 0,
        paths,
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

/// Two seconds each: P1 towards what is seen, P4 low over the floor.
fn fitted_paths(start: Start) -> Vec<PathSpec> {
    let Start { eye, forward, free, height } = start;
    let short = |value: f64| round(value, free);
    let place = |at: DVec3| at.to_array().map(short);
    // A gentle look down, to the floor rather than the sky.
    let target = eye + forward * free - DVec3::Y * (0.1 * free);
    let metres_per_second = short(0.35 * free / 2.0);
    let oblique = Motion::Oblique {
        eye: place(eye - DVec3::Y * (0.3 * height)),
        heading_degrees: forward.z.atan2(forward.x).to_degrees(),
        end_height_world: short(eye.y - 0.7 * height),
        start_pitch_degrees: -8.0,
        end_pitch_degrees: -3.0,
        metres_per_second,
    };
    let dolly = Motion::Dolly { eye: place(eye), target: place(target), metres_per_second };
    vec![plain_path("P1", dolly), plain_path("P4", oblique)]
}

/// Low places before high ones, and far ones before near ones; the best view among those that are
/// alike in both.
fn best_start(soup: &Soup, bounds: (DVec3, DVec3)) -> Start {
    let best_at = |(up, away): (f64, f64)| {
        let views = candidates(bounds, up, away).filter_map(|from| view_from(soup, bounds, from));
        views.max_by(|(a, _), (b, _)| a.total_cmp(b))
    };
    let places = [0.3, 0.6].into_iter().flat_map(|up| [0.35, 0.25, 0.15].map(|away| (up, away)));
    let best = places.into_iter().find_map(best_at);
    best.map_or_else(|| outside(bounds), |(_, start)| start)
}

/// Places at this part of the height, this part of the size away from the middle, and the way back
/// across it.
fn candidates((lo, hi): (DVec3, DVec3), up: f64, away: f64) -> impl Iterator<Item = (DVec3, DVec3)> {
    let (centre, extent) = (0.5 * (lo + hi), hi - lo);
    let level = DVec3::new(centre.x, lo.y + up * extent.y, centre.z);
    let ways = [DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z];
    ways.into_iter().flat_map(move |forward| {
        [0.0, -0.25, 0.25].map(|aside| {
            let across = DVec3::new(forward.z, 0.0, forward.x).abs();
            (level + (across * aside - forward * away) * extent, forward)
        })
    })
}

/// What a camera above the floor below `from` sees: how much of it is worth seeing, and the start.
/// `None` where there is no floor or no free view, or inside a solid. Files often turn some of their
/// faces the wrong way round, so a minority of backs is nothing to worry about.
fn view_from(soup: &Soup, (lo, hi): (DVec3, DVec3), (from, forward): (DVec3, DVec3)) -> Option<(f64, Start)> {
    let extent = hi - lo;
    let size = extent.x.max(extent.z);
    let floor = soup.cast(from, DVec3::NEG_Y)?;
    let height = (0.12 * extent.y).max(0.03 * size).min(0.8 * floor.distance);
    let eye = from - DVec3::Y * (floor.distance - height);
    let free = soup.cast(eye, forward).map_or(size, |hit| hit.distance.min(size));
    if free < 0.2 * size || soup.is_inside_solid(eye) {
        return None;
    }
    let seen: Vec<Hit> = (-2..=2)
        .flat_map(|side| [-0.3, 0.0, 0.2].map(|up| (f64::from(side) * 0.4, up)))
        .filter_map(|(side, up)| soup.cast(eye, DQuat::from_rotation_y(side) * forward + DVec3::Y * up))
        .collect();
    let worth: f64 = seen.iter().map(|hit| (hit.distance / size).min(1.0)).sum();
    let fronts = seen.iter().filter(|hit| hit.front).count();
    let good = fronts >= 8 && seen.iter().all(|hit| hit.distance > 0.02 * size);
    good.then_some((worth, Start { eye, forward, free, height }))
}

/// From in front of the longer side, high enough to see the top.
fn outside((lo, hi): (DVec3, DVec3)) -> Start {
    let (centre, extent) = (0.5 * (lo + hi), hi - lo);
    let forward = if extent.x > extent.z { DVec3::NEG_Z } else { DVec3::NEG_X };
    let diagonal = extent.length();
    let height = 0.5 * extent.y + 0.12 * diagonal;
    let eye = centre - forward * (1.2 * diagonal) + DVec3::Y * (height - 0.5 * extent.y);
    Start { eye, forward, free: 1.2 * diagonal, height }
}

fn plain_path(name: &str, motion: Motion) -> PathSpec {
    PathSpec {
        name: name.to_owned(),
        title: None,
        frames: None,
        frames_per_second: 60.0,
        yfov_degrees: 60.0,
        motion,
    }
}

/// To a thousandth of the size, or finer: short numbers, which a person will edit.
fn round(value: f64, size: f64) -> f64 {
    // Clamped so that even a model of no size gives a finite factor.
    let digits = (3.0 - size.log10().floor()).clamp(-12.0, 12.0);
    let factor = 10f64.powf(digits);
    // Dividing by a whole power of ten gives the double that is nearest to the decimal number.
    if digits < 0.0 { value } else { (value * factor).round() / factor }
}
