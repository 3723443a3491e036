//! Twin of what happens in pixels: receivers from depth, filters of a target, bilinear fetches.

use super::approx::{Approx, Approx3, U};
use umbrage_frame::{Image, View};

/// A point that is shaded, and where it is seen (pixels).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Receiver {
    pub(crate) position: Approx3,
    pub(crate) normal: Approx3,
    pub(crate) place: [Approx; 2],
}

/// The surface at a pixel centre, from linear depth and normal; `None` where nothing is seen.
pub(crate) fn surface(
    view: &View,
    (depths, normals): (&Image<f32>, &[Image<f32>]),
    [x, y]: [u32; 2],
) -> Option<Receiver> {
    let depth = Approx::from(*depths.at(x, y));
    if depth.value <= 0.0 {
        return None;
    }
    let place = [x, y].map(|c| Approx::exact(f64::from(c) + 0.5));
    let (width, height) = (Approx::exact(view.width.into()), Approx::exact(view.height.into()));
    let tan = Approx::library(f64::from(0.5 * view.yfov_radians).tan());
    let (one, two) = (Approx::exact(1.0), Approx::exact(2.0));
    let right = (place[0] / width * two - one) * (tan * width / height) * depth;
    let up = (one - place[1] / height * two) * tan * depth;
    // The pose passes through a matrix inversion by cofactors: about 20 roundings.
    let entry = |value: f64, scale: f64| Approx { value, error: 20.0 * U * scale };
    let pose = view.camera_from_world.as_dmat4().inverse();
    let reach = pose.w_axis.truncate().abs().element_sum();
    let axis = |k: usize| Approx3(pose.col(k).truncate().to_array().map(|c| entry(c, 1.0)));
    let eye = Approx3(pose.w_axis.truncate().to_array().map(|c| entry(c, reach)));
    let position = axis(0).times(right).plus(axis(1).times(up)).plus(axis(2).times(-depth)).plus(eye);
    let normal = Approx3(std::array::from_fn(|k| Approx::from(*normals[k].at(x, y)))).normalized();
    Some(Receiver { position, normal, place })
}

/// The point that an anchor stands for, and where a view sees it.
pub(crate) fn anchor(view: &View, position: glam::Vec3, normal: glam::Vec3) -> Receiver {
    let rows = view.clip_from_world.transpose();
    let p = position.extend(1.0).to_array().map(Approx::from);
    let clip = |row: glam::Vec4| {
        let terms: [Approx; 4] = std::array::from_fn(|k| Approx::from(row[k]) * p[k]);
        super::approx::sum(&terms)
    };
    let (x, y, w) = (clip(rows.x_axis), clip(rows.y_axis), clip(rows.w_axis));
    let half = Approx::exact(0.5);
    let size = [view.width, view.height].map(|c| Approx::exact(c.into()));
    let place = [(x / w * half + half) * size[0], (half - y / w * half) * size[1]];
    Receiver { position: Approx3::from_vec(position), normal: Approx3::from_vec(normal), place }
}

/// A symmetric blur in two dimensions at once, clamped at the border; `weights` at distance 0, 1...
pub(crate) fn blurred(source: &Image<f32>, weights: &[Approx], [x, y]: [u32; 2]) -> Approx {
    let reach = weights.len() as i64 - 1;
    let weight = |k: i64| weights[k.unsigned_abs() as usize];
    let mut total = Approx::exact(0.0);
    for dy in -reach..=reach {
        for dx in -reach..=reach {
            let value = f64::from(clamped(source, [i64::from(x) + dx, i64::from(y) + dy]));
            let product = weight(dx).value * weight(dy).value * value.abs();
            let relative = weight(dx).error / weight(dx).value + weight(dy).error / weight(dy).value;
            total.value += weight(dx).value * weight(dy).value * value;
            // Each axis: a product and up to seven sums, every term through both.
            total.error += product * (relative + 16.0 * U);
        }
    }
    total
}

/// The smallest value of a rectangle of texels, both corners included and clamped at the border.
pub(crate) fn smallest(source: &Image<f32>, low: [i64; 2], high: [i64; 2]) -> f32 {
    let all = (low[1]..=high[1]).flat_map(|y| (low[0]..=high[0]).map(move |x| [x, y]));
    all.map(|texel| clamped(source, texel)).fold(f32::INFINITY, f32::min)
}

/// A bilinear fetch at a place in texels (centres at +0.5), clamped at the border.
pub(crate) fn fetched(source: &Image<f32>, place: [Approx; 2]) -> Approx {
    // Piecewise bilinear: over a box the extremes lie on its corners or where it meets cell edges.
    let stops = place.map(|c| {
        let (low, high) = (c.low() - 0.5, c.high() - 0.5);
        let edges = (low.ceil() as i64..=high.floor() as i64).map(|edge| edge as f64);
        [low, high].into_iter().chain(edges).collect::<Vec<_>>()
    });
    let middle = bilinear(source, place.map(|c| c.value - 0.5));
    let all = stops[1].iter().flat_map(|&y| stops[0].iter().map(move |&x| bilinear(source, [x, y])));
    let spread = all.map(|value| (value - middle).abs()).fold(0.0, f64::max);
    // Three mixes, each two products and two sums of values no larger than the corners'.
    Approx { value: middle, error: spread + 12.0 * U * middle.abs().max(middle.abs() + spread) }
}

fn bilinear(source: &Image<f32>, [x, y]: [f64; 2]) -> f64 {
    let (column, row) = (x.floor() as i64, y.floor() as i64);
    let (wx, wy) = (x - x.floor(), y - y.floor());
    let at = |dx, dy| f64::from(clamped(source, [column + dx, row + dy]));
    (at(0, 0) * (1.0 - wx) + at(1, 0) * wx) * (1.0 - wy) + (at(0, 1) * (1.0 - wx) + at(1, 1) * wx) * wy
}

fn clamped(source: &Image<f32>, [x, y]: [i64; 2]) -> f32 {
    let last = [source.width(), source.height()].map(|c| i64::from(c) - 1);
    *source.at(x.clamp(0, last[0]) as u32, y.clamp(0, last[1]) as u32)
}
