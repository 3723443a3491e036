//! The motions that are given by a formula, P0 to P6 of the suite among them.

use super::{DEFAULT_FRAMES, LightTurn, Pose, Track};
use crate::spec::{Motion, PathSpec};
use glam::{DAffine3, DMat3, DVec3};

/// The pose of each frame.
type PoseOf = Box<dyn Fn(u32) -> Pose>;

pub(super) fn track(motion: &Motion, spec: &PathSpec) -> Result<Track<'static>, String> {
    let pose = match *motion {
        Motion::Still { eye, target } => sliding(view(eye, target)?, DVec3::ZERO),
        Motion::Dolly { eye, target, metres_per_second } => {
            let view = view(eye, target)?;
            sliding(view, view.matrix3.z_axis * (-metres_per_second / spec.frames_per_second))
        }
        Motion::Strafe { eye, target, metres_per_second } => {
            let view = view(eye, target)?;
            sliding(view, view.matrix3.x_axis * (metres_per_second / spec.frames_per_second))
        }
        Motion::Creep { eye, target, px_per_frame, reference_height_px } => {
            let view = view(eye, target)?;
            let tan = (0.5 * spec.yfov_degrees.to_radians()).tan();
            let px_world = 2.0 * tan * distance(eye, target) / reference_height_px;
            sliding(view, view.matrix3.x_axis * (px_per_frame * px_world))
        }
        Motion::LightSweep { eye, target, degrees_per_frame } => {
            light_sweep(view(eye, target)?, target.into(), degrees_per_frame.to_radians())
        }
        Motion::Orbit { target, radius_world, .. } if !(radius_world > 0.0 && finite(&target)) => {
            return Err("an orbit needs a finite target and a radius_world above 0".to_owned());
        }
        Motion::Orbit { .. } => orbit(motion, spec.frames_per_second),
        Motion::Oblique { .. } => oblique(motion, spec),
        Motion::Keyframes { .. } | Motion::Gltf { .. } => {
            return Err("poses are given, not computed".to_owned());
        }
    };
    let yfov_radians = spec.yfov_degrees.to_radians();
    Ok(Track { pose, frames: DEFAULT_FRAMES, yfov_radians, title: title(motion) })
}

fn title(motion: &Motion) -> String {
    match motion {
        Motion::Still { .. } => "camera and light stand still".to_owned(),
        Motion::Dolly { metres_per_second, .. } => {
            format!("dolly, {metres_per_second} m/s towards the target")
        }
        Motion::Orbit { degrees_per_second, .. } => {
            format!("orbit, {degrees_per_second} degrees/s round the target")
        }
        Motion::Strafe { metres_per_second, .. } => format!("strafe, {metres_per_second} m/s to the right"),
        Motion::Oblique { metres_per_second, .. } => format!("low over the floor at {metres_per_second} m/s"),
        Motion::Creep { px_per_frame, reference_height_px, .. } => {
            format!("creep, {px_per_frame} px a frame in a picture {reference_height_px} px high")
        }
        Motion::LightSweep { degrees_per_frame, .. } => {
            format!("the light turns by {degrees_per_frame} degrees a frame")
        }
        Motion::Keyframes { .. } => "along keyframes".to_owned(),
        Motion::Gltf { camera } => format!("the file's camera '{camera}'"),
    }
}

/// A view that does not turn and moves by the same step every frame.
fn sliding(view: DAffine3, step: DVec3) -> PoseOf {
    Box::new(move |frame| {
        let eye = view.translation + step * f64::from(frame);
        Pose::of(DAffine3::from_mat3_translation(view.matrix3, eye))
    })
}

fn light_sweep(view: DAffine3, about: DVec3, step_radians: f64) -> PoseOf {
    Box::new(move |frame| {
        let turn = LightTurn { radians: step_radians * f64::from(frame), about };
        Pose { world_from_camera: view, light_turn: Some(turn) }
    })
}

fn orbit(motion: &Motion, fps: f64) -> PoseOf {
    let &Motion::Orbit { target, radius_world, pitch_degrees, azimuth_degrees, degrees_per_second } = motion
    else {
        return Box::new(|_| Pose::of(DAffine3::NAN));
    };
    let target = DVec3::from(target);
    Box::new(move |frame| {
        let azimuth = azimuth_degrees + degrees_per_second * f64::from(frame) / fps;
        let outwards = aimed(azimuth.to_radians(), -pitch_degrees.to_radians());
        Pose::of(look_at(target + outwards * radius_world, target))
    })
}

/// Height and pitch reach their last values in the last frame.
fn oblique(motion: &Motion, spec: &PathSpec) -> PoseOf {
    let &Motion::Oblique {
        eye,
        heading_degrees,
        end_height_world,
        start_pitch_degrees,
        end_pitch_degrees,
        metres_per_second,
    } = motion
    else {
        return Box::new(|_| Pose::of(DAffine3::NAN));
    };
    let steps = f64::from(spec.frames.unwrap_or(DEFAULT_FRAMES).saturating_sub(1).max(1));
    let heading = heading_degrees.to_radians();
    let step = aimed(heading, 0.0) * (metres_per_second / spec.frames_per_second);
    let start = DVec3::from(eye);
    Box::new(move |frame| {
        let part = f64::from(frame) / steps;
        let mix = |from: f64, to: f64| from + (to - from) * part;
        let mut eye = start + step * f64::from(frame);
        eye.y = mix(start.y, end_height_world);
        let pitch = mix(start_pitch_degrees, end_pitch_degrees).to_radians();
        Pose::of(look_at(eye, eye + aimed(heading, pitch)))
    })
}

/// A view without a roll: [`crate::Camera::look_at`] in f64.
pub(super) fn look_at(eye: DVec3, target: DVec3) -> DAffine3 {
    let back = (eye - target).normalize_or(DVec3::Z);
    let up = if back.y.abs() > 0.9999 { DVec3::NEG_Z } else { DVec3::Y };
    let right = up.cross(back).normalize();
    DAffine3::from_mat3_translation(DMat3::from_cols(right, back.cross(right), back), eye)
}

fn view(eye: [f64; 3], target: [f64; 3]) -> Result<DAffine3, String> {
    if !(finite(&eye) && finite(&target)) {
        return Err("eye and target must be finite".to_owned());
    }
    if eye == target {
        return Err("eye and target must differ".to_owned());
    }
    Ok(look_at(eye.into(), target.into()))
}

/// Unit vector at this azimuth (from +x towards +z) and pitch.
fn aimed(azimuth_radians: f64, pitch_radians: f64) -> DVec3 {
    let ((up, level), (z, x)) = (pitch_radians.sin_cos(), azimuth_radians.sin_cos());
    DVec3::new(level * x, up, level * z)
}

fn distance(eye: [f64; 3], target: [f64; 3]) -> f64 {
    DVec3::from(eye).distance(target.into())
}

fn finite(place: &[f64; 3]) -> bool {
    place.iter().all(|component| component.is_finite())
}
