//! T20: a square grid of 11 taps a side, split into rows at pixels and columns of them.

use super::{Plain, Spot};
use crate::support::still_life;
use crate::twins::approx::{Approx, Approx3};
use glam::{DVec2, DVec3};
use umbrage_shadows::Bias;

const SIDE: i32 = 11;

/// A pixel whose surface lies farther from the receiver's plane, over the receiver's depth, sees
/// another one.
const OTHER_SURFACE: f64 = 0.005;

/// What the variant says; `None` for any other name.
pub(crate) fn shade(plain: &Plain<'_>, name: &str, spot: &Spot) -> Option<Vec<f64>> {
    (name == "sssm").then(|| vec![last(plain, spot)])
}

fn last(plain: &Plain<'_>, spot: &Spot) -> f64 {
    let at = |label: &str, [x, y]: [u32; 2]| f64::from(*plain.channel(label, 0, 0).at(x, y));
    let Some(own) = neighbour(plain, spot, 0.0) else {
        return plain.shadowed(spot).map_or(1.0, |s| plain.bilinear(&s, [0.0; 2]));
    };
    let half = at("sssm-radius", own);
    let column = offsets(half).filter_map(|v| neighbour(plain, spot, v));
    let rows: Vec<f64> = column.map(|pixel| at("sssm-filter-rows", pixel)).collect();
    rows.iter().sum::<f64>() / rows.len() as f64
}

/// A row of the search: sum and number of the blockers.
pub(crate) fn searched(plain: &Plain<'_>, spot: &Spot) -> [f64; 2] {
    let Some(s) = plain.shadowed(spot) else { return [0.0; 2] };
    let pairs = offsets(plain.search(s.depth)).filter_map(|u| plain.pair(&s, [u, 0.0]));
    let before: Vec<f64> = pairs.filter(|p| p.0 < p.1).map(|p| p.0).collect();
    [before.iter().sum(), before.len() as f64]
}

/// The kernel's half-length from a column of the search's rows.
pub(crate) fn radius(plain: &Plain<'_>, spot: &Spot) -> f64 {
    let Some(s) = plain.shadowed(spot) else { return 0.0 };
    let column = offsets(plain.search(s.depth)).filter_map(|v| neighbour(plain, spot, v));
    let part =
        |channel: usize, [x, y]: [u32; 2]| f64::from(*plain.channel("sssm-search-rows", 0, channel).at(x, y));
    let (sum, count) = column.fold((0.0, 0.0), |t, pixel| (t.0 + part(0, pixel), t.1 + part(1, pixel)));
    if count > 0.0 { plain.kernel(s.depth, sum / count) } else { 0.0 }
}

/// A row of the filter, as long as the pixel's own kernel.
pub(crate) fn filtered(plain: &Plain<'_>, spot: &Spot) -> f64 {
    let Some(s) = plain.shadowed(spot) else { return 1.0 };
    let [x, y] = spot.place.map(|c| c as u32);
    let half = f64::from(*plain.channel("sssm-radius", 0, 0).at(x, y));
    let kernel: Vec<[f64; 2]> = offsets(half).map(|u| [u, 0.0]).collect();
    plain.mean(&kernel, |o| plain.bilinear(&s, o))
}

fn offsets(half: f64) -> impl Iterator<Item = f64> {
    (0..SIDE).map(move |k| f64::from(k - SIDE / 2) / f64::from(SIDE / 2) * half)
}

/// The pixel that sees the receiver's plane where the map is `v` map widths farther down.
fn neighbour(plain: &Plain<'_>, spot: &Spot, v: f64) -> Option<[u32; 2]> {
    let view = still_life::view_of(&still_life::camera());
    let wanted = on_plane(plain, spot, v)?;
    let clip = view.clip_from_world.as_dmat4() * wanted.extend(1.0);
    let size = [view.width, view.height].map(f64::from);
    let place = [(clip.x / clip.w * 0.5 + 0.5) * size[0], (0.5 - clip.y / clip.w * 0.5) * size[1]];
    if clip.w <= 0.0 || (0..2).any(|c| place[c] < 0.0 || place[c] >= size[c]) {
        return None;
    }
    let pixel = place.map(|c| c as u32);
    let depth = f64::from(*plain.channel("camera-depth", 0, 0).at(pixel[0], pixel[1]));
    let tan = (0.5 * f64::from(view.yfov_radians)).tan();
    let ndc = [0, 1].map(|c| (f64::from(pixel[c]) + 0.5) / size[c] * 2.0 - 1.0);
    let camera = DVec3::new(ndc[0] * tan * size[0] / size[1], -ndc[1] * tan, -1.0) * depth;
    let there = view.camera_from_world.as_dmat4().inverse().transform_point3(camera);
    let own = (view.clip_from_world.as_dmat4() * spot.position.extend(1.0)).w;
    let apart = spot.normal.dot(there - spot.position).abs();
    (depth > 0.0 && apart <= OTHER_SURFACE * own).then_some(pixel)
}

/// The point of the receiver's plane whose place in the map is `v` farther down: Newton's method
/// over the plane, from the projection alone.
fn on_plane(plain: &Plain<'_>, spot: &Spot, v: f64) -> Option<DVec3> {
    let exact = |p: DVec3| Approx3(p.to_array().map(Approx::exact));
    let flush = Bias { normal_offset_texels: 0.0, ..plain.bias };
    let place = |p: DVec3| {
        let point = plain.light.point((exact(p), exact(spot.normal)), &flush)?;
        Some(DVec2::from(point.uv.map(|c| c.value)))
    };
    let [a, b] =
        [spot.normal.any_orthonormal_vector(), spot.normal.cross(spot.normal.any_orthonormal_vector())];
    let target = place(spot.position)? + DVec2::new(0.0, v);
    let mut p = spot.position;
    for _ in 0..6 {
        const STEP: f64 = 1e-5;
        let here = place(p)?;
        let slopes = [a, b].map(|axis| place(p + axis * STEP).map(|q| (q - here) / STEP));
        let jacobian = glam::DMat2::from_cols(slopes[0]?, slopes[1]?);
        if jacobian.determinant().abs() < 1e-6 {
            return None;
        }
        let step = jacobian.inverse() * (target - here);
        p += a * step.x + b * step.y;
    }
    Some(p)
}
