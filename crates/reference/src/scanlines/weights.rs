//! Irradiance from the samples of a receiver.

use super::eight::Eight;
use super::frame::{Frame, Turn};
use super::lines::{Lines, REPLICATES};
use crate::aim::Aim;
use crate::irradiance::Emitter;
use glam::{DVec3, Vec3};

/// Sums of the weights of the visible samples and of all, per the emitter's size.
///
/// In f32 where one sample is concerned: the sums are f64, and a weight's error of 2^-22 of itself is
/// far below theirs.
#[inline(always)]
pub(crate) fn sums(
    lines: &Lines,
    (frame, turn): (&Frame, &Turn),
    aim: &Aim,
    (emitter, normal): (&Emitter, DVec3),
) -> [f64; 2] {
    // In lengths of the axis, so that squares neither vanish nor overflow.
    let length = aim.axis.length();
    let [axis, u, v] = [aim.axis, aim.u, aim.v].map(|a| (a / length).as_vec3());
    let normal = normal.as_vec3();
    let flat = emitter.flat.map(|f| f.as_vec3());
    let tan = frame.cone.map_or(0.0, |cone| cone.tan);
    let sin = frame.cone.map_or(0.0, |cone| cone.sin);
    let step = Eight::all(2.0 / lines.per_row);
    let count = lines.per_row as u32;
    let (mut visible, mut all) = (0.0f64, 0.0f64);
    for row in &lines.rows {
        let (mut seen, mut every) = (Eight::all(0.0), Eight::all(0.0));
        for i in 0..count {
            let along = (row.shift + Eight::all(i as f32)) * step - Eight::all(1.0);
            let along = if frame.cone.is_some() {
                let s = along * Eight::all(sin);
                let rest = (Eight::all(1.0) - s * s).max(Eight::all(0.0)).sqrt();
                s / (row.cos * rest * Eight::all(tan))
            } else {
                along
            };
            let x = along * Eight::all(turn.xx) + row.y * Eight::all(turn.xy);
            let y = along * Eight::all(turn.yx) + row.y * Eight::all(turn.yy);
            let direction = [
                Eight::all(axis.x) + x * Eight::all(u.x) + y * Eight::all(v.x),
                Eight::all(axis.y) + x * Eight::all(u.y) + y * Eight::all(v.y),
                Eight::all(axis.z) + x * Eight::all(u.z) + y * Eight::all(v.z),
            ];
            let square =
                direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2];
            let shorten = Eight::all(1.0) / square.max(Eight::all(f32::MIN_POSITIVE)).sqrt();
            let mut weight = match normal == Vec3::ZERO {
                true => Eight::all(1.0),
                false => (dot(normal, &direction) * shorten).max(Eight::all(0.0)),
            };
            if let Some(flat) = flat {
                weight = weight * dot(flat, &direction).abs() * shorten * shorten * shorten;
            }
            let (mut open, mut inside) = ([0.0f32; REPLICATES], [0.0f32; REPLICATES]);
            for k in 0..REPLICATES {
                inside[k] = (row.inside[k] >> i & 1) as f32;
                open[k] = ((row.inside[k] & !row.hidden[k]) >> i & 1) as f32;
            }
            every = every + weight * Eight(inside);
            seen = seen + weight * Eight(open);
        }
        for k in 0..REPLICATES {
            all += f64::from(every.0[k]);
            visible += f64::from(seen.0[k]);
        }
    }
    // A flat light's weight is per square of the distance.
    let scale = if flat.is_some() { 1.0 / (length * length) } else { 1.0 };
    [visible * scale, all * scale]
}

#[inline(always)]
fn dot(a: Vec3, b: &[Eight; 3]) -> Eight {
    Eight::all(a.x) * b[0] + Eight::all(a.y) * b[1] + Eight::all(a.z) * b[2]
}
