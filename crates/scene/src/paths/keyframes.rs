//! Eye and target through given poses.

use super::motions::look_at;
use super::{Pose, Track};
use crate::SceneError;
use crate::hermite::hermite;
use crate::spec::{Interpolation, Keyframe, KeyframeList, PathSpec, keyframes_from};
use glam::DVec3;
use std::path::Path;

/// The poses, inline or from a file beside `scene_file`.
pub(super) fn collect(
    file: Option<&Path>,
    inline: &[Keyframe],
    interpolation: Interpolation,
    scene_file: &Path,
) -> Result<KeyframeList, SceneError> {
    let Some(file) = file else {
        return Ok(KeyframeList { keyframes: inline.to_vec(), interpolation });
    };
    if !inline.is_empty() {
        return Err(SceneError::value(scene_file, "a path has either a file or inline keyframes"));
    }
    let path = scene_file.parent().unwrap_or(Path::new("")).join(file);
    let source =
        std::fs::read_to_string(&path).map_err(|source| SceneError::Read { path: path.clone(), source })?;
    keyframes_from(&source, &path)
}

pub(super) fn track(list: KeyframeList, spec: &PathSpec) -> Result<Track<'static>, String> {
    check(&list.keyframes)?;
    let fps = spec.frames_per_second;
    let (first, last) = match list.keyframes.as_slice() {
        [first, .., last] => (first.time_secs, last.time_secs),
        _ => (0.0, 0.0),
    };
    // The small surplus admits a duration that rounds to just below a whole number of frames.
    let frames = (((last - first) * fps + 1e-6).floor() as u32).saturating_add(1);
    let title = format!("along {} keyframes", list.keyframes.len());
    let pose = Box::new(move |frame: u32| {
        let (eye, target) = at(&list, first + f64::from(frame) / fps);
        Pose::of(look_at(eye, target))
    });
    Ok(Track { pose, frames, yfov_radians: spec.yfov_degrees.to_radians(), title })
}

fn check(keyframes: &[Keyframe]) -> Result<(), String> {
    if keyframes.is_empty() {
        return Err("needs at least one keyframe".to_owned());
    }
    for (i, key) in keyframes.iter().enumerate() {
        let numbers = key.eye.iter().chain(&key.target).chain([&key.time_secs]);
        if !numbers.copied().all(f64::is_finite) {
            return Err(format!("keyframe {i} has a number that is not finite"));
        }
        if key.eye == key.target {
            return Err(format!("eye and target of keyframe {i} must differ"));
        }
    }
    let late = keyframes.windows(2).position(|pair| pair[1].time_secs <= pair[0].time_secs);
    late.map_or(Ok(()), |i| Err(format!("keyframe {} is not later than the one before", i + 1)))
}

/// Eye and target at a time; before the first and after the last keyframe they stand still.
fn at(list: &KeyframeList, secs: f64) -> (DVec3, DVec3) {
    let keys = &list.keyframes;
    let next = keys.partition_point(|key| key.time_secs <= secs);
    if next == 0 || next == keys.len() {
        let key = keys[next.saturating_sub(1)];
        return (key.eye.into(), key.target.into());
    }
    let blend = |of: fn(&Keyframe) -> [f64; 3]| segment(list, next - 1, secs, of);
    (blend(|key| key.eye), blend(|key| key.target))
}

/// Between keyframes `i` and `i + 1`.
fn segment(list: &KeyframeList, i: usize, secs: f64, of: fn(&Keyframe) -> [f64; 3]) -> DVec3 {
    let keys = &list.keyframes;
    let value = |k: usize| DVec3::from(of(&keys[k]));
    let span = keys[i + 1].time_secs - keys[i].time_secs;
    let part = (secs - keys[i].time_secs) / span;
    if list.interpolation == Interpolation::Linear {
        return value(i).lerp(value(i + 1), part);
    }
    // The slope at a keyframe is that of the chord between its neighbours (one-sided at the ends).
    let slope = |k: usize| {
        let (before, after) = (k.saturating_sub(1), (k + 1).min(keys.len() - 1));
        (value(after) - value(before)) / (keys[after].time_secs - keys[before].time_secs)
    };
    hermite([value(i), slope(i) * span, value(i + 1), slope(i + 1) * span], part)
}
