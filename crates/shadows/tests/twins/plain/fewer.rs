//! Techniques that shade fewer pixels than the frame has: T14 to T16, and the blur in screen space,
//! T30. Their last passes start from the targets that the pipeline wrote.

use super::{Plain, Spot, discs, fetched, placed, vogel};
use glam::{DVec3, DVec4};
use umbrage_frame::{Image, View};
use umbrage_shadows::Calibration;

/// What a variant of this family may say; `None` for any other name.
pub(crate) fn shade(plain: &Plain<'_>, name: &str, spot: &Spot) -> Option<Vec<f64>> {
    let pixel = spot.place.map(|c| c.floor() as i64);
    Some(match name {
        "whole-chss" => vec![at(plain.channel("lit-whole", 0, 0), pixel)],
        "checker-chss-16bit" => vec![checker(plain, spot, half_float)],
        _ if name.starts_with("checker-") => vec![checker(plain, spot, |z| z)],
        "half-chss" => vec![smaller(plain, spot, 0.5, |_| 1.0)],
        "half-chss-bilateral" => vec![smaller(plain, spot, 0.5, |p| coarse_weight(plain, spot, p))],
        "three-quarter-chss" => vec![smaller(plain, spot, 0.75, |p| coarse_weight(plain, spot, p))],
        "temporal-checker" => vec![temporal(plain, spot)],
        "temporal-mask" => {
            let radius = fetched(plain.channel("penumbra-mask-blurred", 0, 0), spot.place);
            let kernel = placed(&vogel(16), radius, plain.angle(spot.place));
            vec![plain.shadowed(spot).map_or(1.0, |s| plain.mean(&kernel, |o| plain.bilinear(&s, o)))]
        }
        "screen-blur" => vec![columns(plain, spot)],
        _ => return None,
    })
}

/// Contact hardening at a pixel, turned by this angle: what a texel of a target holds.
pub(crate) fn contact_hardening(plain: &Plain<'_>, spot: &Spot, angle: f64) -> f64 {
    let law = |z, b| plain.kernel(z, b);
    plain.shadowed(spot).map_or(1.0, |s| discs::chss(plain, &s, (32, angle), &law))
}

/// Search radius of the mask over that of the filter (first document, 2.2).
const MASK_SEARCH: f64 = 1.2;

/// The mask at a pixel, before it is stored: a radius over the largest; 0 without a blocker.
pub(crate) fn mask_share(plain: &Plain<'_>, spot: &Spot) -> f64 {
    let Some(s) = plain.shadowed(spot) else { return 0.0 };
    let search = placed(&vogel(32), MASK_SEARCH * plain.search(s.depth), plain.angle(spot.place));
    plain.mean_blocker(&s, &search).map_or(0.0, |b| plain.kernel(s.depth, b)) / plain.search(s.depth)
}

fn at(image: &Image<f32>, [x, y]: [i64; 2]) -> f64 {
    f64::from(*image.at(x as u32, y as u32))
}

fn is_inside(view: &View, [x, y]: [i64; 2]) -> bool {
    (0..i64::from(view.width)).contains(&x) && (0..i64::from(view.height)).contains(&y)
}

/// The nearest half float: eleven bits.
fn half_float(z: f64) -> f64 {
    if z <= 0.0 {
        return 0.0;
    }
    let ulp = 2f64.powi(z.log2().floor() as i32 - 10);
    (z / ulp).round_ties_even() * ulp
}

/// Depth along the viewing direction.
fn depth_in(view: &View, position: DVec3) -> f64 {
    -view.camera_from_world.as_dmat4().transform_point3(position).z
}

/// The point that a view sees at a pixel's centre, at a depth.
fn seen_at(view: &View, pixel: [i64; 2], depth: f64) -> DVec3 {
    let up = f64::from(0.5 * view.yfov_radians).tan();
    let size = [view.width, view.height].map(f64::from);
    let [x, y] = [0, 1].map(|k| (pixel[k] as f64 + 0.5) / size[k] * 2.0 - 1.0);
    let ray = DVec3::new(x * up * size[0] / size[1], -y * up, -1.0);
    view.camera_from_world.as_dmat4().inverse().transform_point3(ray * depth)
}

/// The weight of a difference.
fn of_apart(apart: f64) -> f64 {
    1.0 / (0.001 + apart)
}

/// How far a neighbour speaks for a receiver. As printed: the demo's difference of depths, in 1/500 of
/// the light's distance. Otherwise the distance of the two in space over depth. 0 for the sky.
fn weight(plain: &Plain<'_>, spot: &Spot, pixel: [i64; 2], kept: &dyn Fn(f64) -> f64) -> f64 {
    let view = &plain.views[0];
    let depth = kept(at(plain.channel("camera-depth", 0, 0), pixel));
    let own = depth_in(view, spot.position);
    let eye = view.camera_from_world.as_dmat4().inverse().w_axis.truncate();
    let moved = eye + (spot.position - eye) * (kept(own) / own);
    of_apart(match plain.calibration {
        _ if depth <= 0.0 => f64::INFINITY,
        Calibration::AsPrinted => (depth - kept(own)).abs() / (plain.light.eye_distance.value / 500.0),
        Calibration::LightMatched => seen_at(view, pixel, depth).distance(moved) / own,
    })
}

/// The same from the distance to the receiver's plane.
fn plane_weight(plain: &Plain<'_>, spot: &Spot, pixel: [i64; 2]) -> f64 {
    let (view, depth) = (&plain.views[0], at(plain.channel("camera-depth", 0, 0), pixel));
    let apart = spot.normal.dot(seen_at(view, pixel, depth) - spot.position).abs();
    of_apart(if depth > 0.0 { apart / depth_in(view, spot.position) } else { f64::INFINITY })
}

/// That of a texel of a smaller target.
fn coarse_weight(plain: &Plain<'_>, spot: &Spot, pixel: [i64; 2]) -> f64 {
    match plain.calibration {
        Calibration::AsPrinted => weight(plain, spot, pixel, &|z| z),
        Calibration::LightMatched => plane_weight(plain, spot, pixel),
    }
}

/// A pixel that was left out: the weighted mean of its neighbours; as printed 0 below a sum of 1.
fn fill(plain: &Plain<'_>, spot: &Spot, pixel: [i64; 2], kept: &dyn Fn(f64) -> f64) -> f64 {
    let [x, y] = pixel;
    let beside = [[x - 1, y], [x + 1, y], [x, y - 1], [x, y + 1]];
    let inside: Vec<_> = beside.into_iter().filter(|&p| is_inside(&plain.views[0], p)).collect();
    let lit = |p: &[i64; 2]| at(plain.channel("lit-checker", 0, 0), [p[0].div_euclid(2), p[1]]);
    let weights: Vec<f64> = inside.iter().map(|&p| weight(plain, spot, p, kept)).collect();
    let sum: f64 = weights.iter().sum();
    if plain.calibration == Calibration::AsPrinted && sum < 1.0 {
        return 0.0;
    }
    if sum == 0.0 {
        return inside.iter().map(lit).sum::<f64>() / inside.len() as f64;
    }
    inside.iter().zip(&weights).map(|(p, w)| w * lit(p)).sum::<f64>() / sum
}

fn checker(plain: &Plain<'_>, spot: &Spot, kept: impl Fn(f64) -> f64) -> f64 {
    let pixel = spot.place.map(|c| c.floor() as i64);
    match (pixel[0] + pixel[1]).rem_euclid(2) {
        0 => at(plain.channel("lit-checker", 0, 0), [pixel[0] / 2, pixel[1]]),
        _ => fill(plain, spot, pixel, &kept),
    }
}

/// The pixel nearest to the centre of a texel of a target of this scale: of two the later.
pub(crate) fn nearest_pixel(view: &View, scale: f64, texel: [i64; 2]) -> [i64; 2] {
    let last = [view.width, view.height].map(|side| i64::from(side) - 1);
    // Scales are quarters: exact in floats but for the quotient.
    [0, 1].map(|k| (((texel[k] as f64 + 0.5) / scale + 1e-9).floor() as i64).min(last[k]))
}

/// Bilinear in a smaller target, each texel times what its pixel says for the receiver.
fn smaller(plain: &Plain<'_>, spot: &Spot, scale: f64, speaks: impl Fn([i64; 2]) -> f64) -> f64 {
    let image = plain.channel("lit-low", 0, 0);
    let last = [image.width(), image.height()].map(|side| i64::from(side) - 1);
    let corner = spot.place.map(|c| c * scale - 0.5);
    let (mut sum, mut total, mut simple) = (0.0, 0.0, 0.0);
    for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
        let offset = [f64::from(dx), f64::from(dy)];
        let share = |k: usize| 1.0 - (corner[k] - corner[k].floor() - offset[k]).abs();
        let share = share(0) * share(1);
        let texel = [0, 1].map(|k| ((corner[k].floor() + offset[k]) as i64).clamp(0, last[k]));
        let lit = at(image, texel);
        let weight = share * speaks(nearest_pixel(&plain.views[0], scale, texel));
        sum += weight * lit;
        total += weight;
        simple += share * lit;
    }
    if total > 0.0 { sum / total } else { simple }
}

/// The checkerboard that flips: odd frames compute odd pixels of even rows.
fn temporal(plain: &Plain<'_>, spot: &Spot) -> f64 {
    let pixel = spot.place.map(|c| c.floor() as i64);
    let parity = i64::from(plain.pattern.frame % 2);
    if (pixel[0] + pixel[1] + parity).rem_euclid(2) == 0 {
        return at(plain.channel("lit-checker", 0, 0), [pixel[0] / 2, pixel[1]]);
    }
    let (lit, weight) = before(plain, spot, 1 - parity);
    if weight < 0.5 { fill(plain, spot, pixel, &|z| z) } else { lit / weight }
}

/// Value times weight, and weight, of the computed pixels of the frame before round a receiver: they
/// are the corners of a square that stands on its tip, in which weights are bilinear.
fn before(plain: &Plain<'_>, spot: &Spot, parity: i64) -> (f64, f64) {
    let view = &plain.views[1];
    let clip: DVec4 = view.clip_from_world.as_dmat4() * spot.position.extend(1.0);
    let size = [view.width, view.height].map(f64::from);
    let place = [(clip.x / clip.w * 0.5 + 0.5) * size[0], (0.5 - clip.y / clip.w * 0.5) * size[1]];
    let middle = place.map(|c| c.floor() as i64);
    let (mut sum, mut total) = (0.0, 0.0);
    for (dx, dy) in (-2..=2).flat_map(|dy| (-2..=2).map(move |dx| (dx, dy))) {
        let pixel = [middle[0] + dx, middle[1] + dy];
        let away = [0, 1].map(|k| place[k] - pixel[k] as f64 - 0.5);
        // A tent along each diagonal, as wide as computed pixels are apart.
        let tent = |along: f64| (1.0 - along.abs() / 2.0).max(0.0);
        let share = tent(away[0] + away[1]) * tent(away[0] - away[1]);
        let is_computed = (pixel[0] + pixel[1] + parity).rem_euclid(2) == 0;
        if clip.w <= 0.0 || share == 0.0 || !is_computed || !is_inside(view, pixel) {
            continue;
        }
        let depth = at(plain.channel("earlier-1-depth", 0, 0), pixel);
        let apart = spot.normal.dot(seen_at(view, pixel, depth) - spot.position).abs();
        if depth > 0.0 && apart <= 0.01 * depth {
            let lit = at(plain.channel("earlier-1-lit-checker", 0, 0), [pixel[0] / 2, pixel[1]]);
            sum += share * lit;
            total += share;
        }
    }
    (sum, total)
}

/// The radius of a penumbra's kernel as the camera sees it, pixels: metres at the receiver over the
/// size of a pixel there.
pub(crate) fn radius_pixels(plain: &Plain<'_>, spot: &Spot, angle: f64) -> f64 {
    let Some(s) = plain.shadowed(spot) else { return 0.0 };
    let search = placed(&vogel(32), plain.search(s.depth), angle);
    let Some(blocker) = plain.mean_blocker(&s, &search) else { return 0.0 };
    let view = &plain.views[0];
    let widens = if plain.light.is_sun { 1.0 } else { s.depth };
    let metres = plain.kernel(s.depth, blocker) * widens / plain.light.scale.value;
    let pixel = 2.0 * f64::from(0.5 * view.yfov_radians).tan() * depth_in(view, spot.position)
        / f64::from(view.height);
    (metres / pixel).min(32.0)
}

/// A disc's chord over its diameter at a distance from its centre, in radii.
fn chord(distance: f64) -> f64 {
    (1.0 - distance * distance).max(0.0).sqrt()
}

/// The first axis of the blur in screen space, at a pixel.
pub(crate) fn row(plain: &Plain<'_>, spot: &Spot) -> f64 {
    let [x, y] = spot.place.map(|c| c.floor() as i64);
    let radius = at(plain.channel("lit-hard", 0, 1), [x, y]).max(1.0);
    let taps = (-32..=32).map(|dx| ([x + dx, y], chord(dx as f64 / radius)));
    blurred(plain, spot, ("lit-hard", &taps.collect::<Vec<_>>()))
}

/// The second: columns that a receiver lies between share it.
fn columns(plain: &Plain<'_>, spot: &Spot) -> f64 {
    let pixel = spot.place.map(|c| c.floor() as i64);
    let radius = at(plain.channel("lit-hard", 0, 1), pixel).max(1.0);
    let taps = (-33..=33).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy))).map(|(dx, dy)| {
        let tap = [pixel[0] + dx, pixel[1] + dy];
        let away = [0, 1].map(|k| tap[k] as f64 + 0.5 - spot.place[k]);
        (tap, (1.0 - away[0].abs()).max(0.0) * chord(away[1] / radius))
    });
    blurred(plain, spot, ("lit-rows", &taps.collect::<Vec<_>>()))
}

/// The mean of taps, each times what its pixel says for the receiver's plane.
fn blurred(plain: &Plain<'_>, spot: &Spot, (label, taps): (&str, &[([i64; 2], f64)])) -> f64 {
    let image = plain.channel(label, 0, 0);
    let inside = taps.iter().filter(|(p, share)| *share > 0.0 && is_inside(&plain.views[0], *p));
    let (mut sum, mut total) = (0.0, 0.0);
    for &(pixel, share) in inside {
        let weight = share * plane_weight(plain, spot, pixel);
        sum += weight * at(image, pixel);
        total += weight;
    }
    sum / total
}
