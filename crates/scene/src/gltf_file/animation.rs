//! Where a camera of a glTF file is at a time: the nodes above it, each with its animation.
//!
//! glTF 2.0, section 3.11 and appendix C (interpolation). Scales of nodes move a camera that hangs
//! below them; the camera itself stays unscaled.

use super::accessor::Buffers;
use crate::hermite::hermite;
use glam::{DAffine3, DMat3, DQuat, DVec3, DVec4};
use gltf::Document;
use gltf::accessor::Dimensions;
use gltf::animation::{Interpolation, Property};
use gltf::scene::Transform;

/// A camera's nodes from the root down.
#[derive(Clone, Debug)]
pub(crate) struct CameraTrack {
    /// The scene file's scale, up axis and translation.
    pub(crate) world_from_file: DAffine3,
    pub(super) chain: Vec<NodeTrack>,
}

/// A node's transform over time.
#[derive(Clone, Debug)]
pub(super) struct NodeTrack {
    at_rest: Transform,
    translation: Option<Channel>,
    rotation: Option<Channel>,
    scale: Option<Channel>,
}

/// One animated property.
#[derive(Clone, Debug)]
struct Channel {
    times: Vec<f64>,
    /// One per time; with cubic splines three: slope before, value, slope after.
    values: Vec<DVec4>,
    interpolation: Interpolation,
    is_rotation: bool,
}

impl CameraTrack {
    /// Until the last keyframe; 0 for a camera that stands still.
    pub(crate) fn duration_secs(&self) -> f64 {
        let channels = self.chain.iter().flat_map(|node| [&node.translation, &node.rotation, &node.scale]);
        channels.flatten().filter_map(|channel| channel.times.last().copied()).fold(0.0, f64::max)
    }

    /// Camera to world: rotation and translation.
    pub(crate) fn pose(&self, secs: f64) -> DAffine3 {
        let node = self.chain.iter().fold(self.world_from_file, |world, node| world * node.at(secs));
        let back = node.matrix3.z_axis.normalize_or(DVec3::Z);
        let right = node.matrix3.y_axis.cross(back).try_normalize();
        let right = right.unwrap_or_else(|| back.any_orthonormal_vector());
        let rotation = DMat3::from_cols(right, back.cross(right), back);
        DAffine3::from_mat3_translation(rotation, node.translation)
    }
}

impl NodeTrack {
    /// Of the node with this index; for each property the first animation that has it counts.
    pub(super) fn read(document: &Document, node: &gltf::Node, buffers: &Buffers) -> Result<Self, String> {
        let mut track = Self { at_rest: node.transform(), translation: None, rotation: None, scale: None };
        for channel in document.animations().flat_map(|animation| animation.channels()) {
            let target = channel.target();
            if target.node().index() != node.index() {
                continue;
            }
            let (place, is_rotation) = match target.property() {
                Property::Translation => (&mut track.translation, false),
                Property::Rotation => (&mut track.rotation, true),
                Property::Scale => (&mut track.scale, false),
                Property::MorphTargetWeights => continue,
            };
            if place.is_none() {
                *place = Some(Channel::read(&channel.sampler(), is_rotation, buffers)?);
            }
        }
        Ok(track)
    }

    fn at(&self, secs: f64) -> DAffine3 {
        let [translation, rotation, scale] = match &self.at_rest {
            // A matrix cannot be animated; a file that does so gets the matrix.
            Transform::Matrix { .. } => return transform_of(&self.at_rest),
            Transform::Decomposed { translation: t, rotation: r, scale: s } => [
                DVec3::from(t.map(f64::from)).extend(0.0),
                DVec4::from(r.map(f64::from)),
                DVec3::from(s.map(f64::from)).extend(0.0),
            ],
        };
        let now = |channel: &Option<Channel>, rest: DVec4| channel.as_ref().map_or(rest, |c| c.at(secs));
        DAffine3::from_scale_rotation_translation(
            now(&self.scale, scale).truncate(),
            quaternion(now(&self.rotation, rotation)),
            now(&self.translation, translation).truncate(),
        )
    }
}

/// A node's own transform, at rest.
pub(super) fn transform_of(transform: &Transform) -> DAffine3 {
    match *transform {
        Transform::Matrix { matrix } => {
            let column = |c: usize| DVec3::new(matrix[c][0].into(), matrix[c][1].into(), matrix[c][2].into());
            let linear = DMat3::from_cols(column(0), column(1), column(2));
            DAffine3::from_mat3_translation(linear, column(3))
        }
        Transform::Decomposed { translation, rotation, scale } => DAffine3::from_scale_rotation_translation(
            DVec3::from(scale.map(f64::from)),
            quaternion(DVec4::from(rotation.map(f64::from))),
            DVec3::from(translation.map(f64::from)),
        ),
    }
}

/// x, y, z, w of any length.
fn quaternion(value: DVec4) -> DQuat {
    value.try_normalize().map_or(DQuat::IDENTITY, DQuat::from_vec4)
}

impl Channel {
    fn read(
        sampler: &gltf::animation::Sampler,
        is_rotation: bool,
        buffers: &Buffers,
    ) -> Result<Self, String> {
        let times = buffers.numbers(&sampler.input(), Dimensions::Scalar)?;
        let dimensions = if is_rotation { Dimensions::Vec4 } else { Dimensions::Vec3 };
        let numbers = buffers.numbers(&sampler.output(), dimensions)?;
        let vector = |v: &[f64]| DVec4::new(v[0], v[1], v[2], v.get(3).copied().unwrap_or(0.0));
        let values: Vec<DVec4> = numbers.chunks_exact(dimensions.multiplicity()).map(vector).collect();
        let interpolation = sampler.interpolation();
        let per_time = if interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        let in_order = times.windows(2).all(|pair| pair[0] < pair[1]);
        let finite = times.iter().all(|t| t.is_finite()) && values.iter().all(|v| v.is_finite());
        if times.is_empty() || !in_order || !finite || values.len() != times.len() * per_time {
            return Err("an animation's times or values do not fit together".to_owned());
        }
        Ok(Self { times, values, interpolation, is_rotation })
    }

    /// Before the first and after the last keyframe the value stands.
    fn at(&self, secs: f64) -> DVec4 {
        let next = self.times.partition_point(|&time| time <= secs);
        if next == 0 || next == self.times.len() {
            return self.key(next.saturating_sub(1));
        }
        let k = next - 1;
        let span = self.times[next] - self.times[k];
        let part = (secs - self.times[k]) / span;
        match self.interpolation {
            Interpolation::Step => self.key(k),
            Interpolation::Linear if self.is_rotation => {
                DVec4::from(quaternion(self.key(k)).slerp(quaternion(self.key(next)), part))
            }
            Interpolation::Linear => self.key(k).lerp(self.key(next), part),
            Interpolation::CubicSpline => {
                let slopes = [self.values[3 * k + 2] * span, self.values[3 * next] * span];
                hermite([self.key(k), slopes[0], self.key(next), slopes[1]], part)
            }
        }
    }

    /// The value at a keyframe.
    fn key(&self, k: usize) -> DVec4 {
        match self.interpolation {
            Interpolation::CubicSpline => self.values[3 * k + 1],
            _ => self.values[k],
        }
    }
}
