//! From a [`PathSpec`] to the camera and the light of every frame.
//!
//! Poses are computed in f64 and rounded once; a view that does not turn keeps the same rotation
//! bits in every frame.

mod animated;
mod keyframes;
mod motions;
#[cfg(test)]
mod tests;

use crate::model::Model;
use crate::spec::{Motion, PathSpec};
use crate::{AreaLight, Camera, CameraPath, PathFrame, SceneError};
use glam::{DAffine3, DVec3};
use std::path::Path;

/// More frames than anyone scores; a guard against a typing mistake.
const MOST_FRAMES: u32 = 100_000;
const DEFAULT_FRAMES: u32 = 120;

/// What a path needs to know of its scene.
pub(crate) struct Surroundings<'a> {
    /// The scene's or model's file, for messages and relative paths.
    pub(crate) file: &'a Path,
    pub(crate) model: &'a Model,
    /// Subtracted from every coordinate.
    pub(crate) origin: DVec3,
    /// Smallest and largest coordinates, before `origin` is subtracted.
    pub(crate) bounds: (DVec3, DVec3),
    pub(crate) light: AreaLight,
}

/// Camera to world, and how far the light has turned about which vertical axis.
#[derive(Clone, Copy, Debug)]
struct Pose {
    world_from_camera: DAffine3,
    light_turn: Option<LightTurn>,
}

#[derive(Clone, Copy, Debug)]
struct LightTurn {
    radians: f64,
    about: DVec3,
}

impl Pose {
    /// The light stays.
    fn of(world_from_camera: DAffine3) -> Self {
        Self { world_from_camera, light_turn: None }
    }
}

/// A path's poses over time.
struct Track<'a> {
    /// Of the frame with this number.
    pose: Box<dyn Fn(u32) -> Pose + 'a>,
    /// How many frames it has of itself.
    frames: u32,
    yfov_radians: f64,
    title: String,
}

pub(crate) fn resolve(spec: &PathSpec, scene: &Surroundings) -> Result<CameraPath, SceneError> {
    let wrong = |message: String| SceneError::value(scene.file, format!("path '{}': {message}", spec.name));
    check_rates(spec).map_err(wrong)?;
    let track = match &spec.motion {
        Motion::Keyframes { file, keyframes, interpolation } => {
            let list = keyframes::collect(file.as_deref(), keyframes, *interpolation, scene.file)?;
            keyframes::track(list, spec).map_err(wrong)?
        }
        Motion::Gltf { camera } => animated::track(camera, spec, scene.model)?,
        motion => motions::track(motion, spec).map_err(wrong)?,
    };
    let frames = spec.frames.unwrap_or(track.frames);
    if !(1..=MOST_FRAMES).contains(&frames) {
        return Err(wrong(format!("frames must be 1 to {MOST_FRAMES}, is {frames}")));
    }
    let poses: Vec<Pose> = (0..frames).map(|frame| (track.pose)(frame)).collect();
    if let Some(frame) = poses.iter().position(|pose| !pose.world_from_camera.is_finite()) {
        return Err(wrong(format!("the camera is nowhere in frame {frame}")));
    }
    let lens = Lens::fitted(&poses, track.yfov_radians, scene.bounds);
    let frame = |(index, pose): (usize, &Pose)| PathFrame {
        camera: lens.camera(pose, scene.origin),
        light: turned(scene.light, pose.light_turn, scene.origin),
        time_secs: (index as f64 / spec.frames_per_second) as f32,
    };
    Ok(CameraPath {
        name: spec.name.clone(),
        title: spec.title.clone().unwrap_or(track.title),
        frames_per_second: spec.frames_per_second as f32,
        frames: poses.iter().enumerate().map(frame).collect(),
    })
}

fn check_rates(spec: &PathSpec) -> Result<(), String> {
    if !(spec.frames_per_second.is_finite() && spec.frames_per_second > 0.0) {
        return Err(format!("frames_per_second must be above 0, is {}", spec.frames_per_second));
    }
    if !(spec.yfov_degrees > 0.0 && spec.yfov_degrees < 180.0) {
        return Err(format!("yfov_degrees must be above 0 and below 180, is {}", spec.yfov_degrees));
    }
    Ok(())
}

/// The same for all frames of a path, so that depth means the same in all of them.
struct Lens {
    yfov_radians: f64,
    near_world: f64,
    far_world: f64,
}

impl Lens {
    /// Far: beyond every corner of the bounds from every eye. Near: a thousandth of the bounds'
    /// diagonal, 1 to 10 cm; surfaces nearer than that are not seen.
    fn fitted(poses: &[Pose], yfov_radians: f64, (lo, hi): (DVec3, DVec3)) -> Self {
        let farthest = |pose: &Pose| {
            let eye = pose.world_from_camera.translation;
            (eye - lo).abs().max((hi - eye).abs()).length()
        };
        let near_world = (1e-3 * (hi - lo).length()).clamp(0.01, 0.1);
        // 1 % beyond, and never inside near, so that rounding clips no corner.
        let far_world = poses.iter().map(farthest).fold(2.0 * near_world, f64::max) * 1.01;
        Self { yfov_radians, near_world, far_world }
    }

    fn camera(&self, pose: &Pose, origin: DVec3) -> Camera {
        let moved = DAffine3::from_translation(-origin) * pose.world_from_camera;
        Camera {
            world_from_camera: glam::DMat4::from(moved).as_mat4(),
            yfov_radians: self.yfov_radians as f32,
            near_world: self.near_world as f32,
            far_world: self.far_world as f32,
        }
    }
}

/// The light turned about a vertical axis, from +x towards +z.
fn turned(light: AreaLight, turn: Option<LightTurn>, origin: DVec3) -> AreaLight {
    let Some(turn) = turn else { return light };
    // Positive angles about +y turn +z towards +x.
    let rotation = glam::DQuat::from_rotation_y(-turn.radians);
    let axis = turn.about - origin;
    let vector = |v: glam::Vec3| (rotation * v.as_dvec3()).as_vec3();
    let place = |p: glam::Vec3| (rotation * (p.as_dvec3() - axis) + axis).as_vec3();
    match light {
        AreaLight::Sun { direction_to_light, angular_diameter_radians } => AreaLight::Sun {
            direction_to_light: vector(direction_to_light).normalize(),
            angular_diameter_radians,
        },
        AreaLight::Disk { centre, normal, radius_world } => {
            AreaLight::Disk { centre: place(centre), normal: vector(normal).normalize(), radius_world }
        }
        AreaLight::Rect { centre, half_u, half_v } => {
            AreaLight::Rect { centre: place(centre), half_u: vector(half_u), half_v: vector(half_v) }
        }
        AreaLight::Sphere { centre, radius_world } => {
            AreaLight::Sphere { centre: place(centre), radius_world }
        }
    }
}
