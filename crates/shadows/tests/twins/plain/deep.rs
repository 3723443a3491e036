//! Other searches and other maps: T11e, T17 to T19, T21, T22.

use super::{Plain, Shadowed, Spot, placed, vogel};
use umbrage_frame::Image;

/// What a variant of this family may say; `None` for any other name.
pub(crate) fn shade(plain: &Plain<'_>, name: &str, spot: &Spot) -> Option<Vec<f64>> {
    let twin: fn(&Plain<'_>, &Shadowed, f64) -> f64 = match name {
        "chss-early-out" => early_out,
        "chss-minmax" => minmax,
        "chss-mips" => mips,
        "chs" => chs,
        "chss-layers-2" => |p, s, a| layers(p, s, (2, a)),
        "chss-layers-4" => |p, s, a| layers(p, s, (4, a)),
        "backprojection" => backprojected,
        "backprojection-bits" => bits,
        _ => return None,
    };
    let value = plain.shadowed(spot).map_or(1.0, |s| twin(plain, &s, plain.angle(spot.place)));
    Some(vec![value])
}

fn filtered(plain: &Plain<'_>, s: &Shadowed, (radius, angle): (f64, f64)) -> f64 {
    plain.mean(&placed(&vogel(16), radius, angle), |o| plain.bilinear(s, o))
}

/// Offsets of the search's 32 taps.
fn search(plain: &Plain<'_>, s: &Shadowed, angle: f64) -> Vec<[f64; 2]> {
    placed(&vogel(32), plain.search(s.depth), angle)
}

/// T19 changes no pixel: it is `chss`.
fn minmax(plain: &Plain<'_>, s: &Shadowed, angle: f64) -> f64 {
    let blocker = plain.mean_blocker(s, &search(plain, s, angle));
    filtered(plain, s, (blocker.map_or(0.0, |b| plain.kernel(s.depth, b)), angle))
}

/// T11e: none of the taps, or all of them, decide; less than half a texel is one tap.
fn early_out(plain: &Plain<'_>, s: &Shadowed, angle: f64) -> f64 {
    let taps = search(plain, s, angle);
    let pairs = taps.iter().filter_map(|&o| plain.pair(s, o));
    let before: Vec<f64> = pairs.filter(|p| p.0 < p.1).map(|p| p.0).collect();
    if before.is_empty() || before.len() == taps.len() {
        return f64::from(u8::from(before.is_empty()));
    }
    let radius = plain.kernel(s.depth, before.iter().sum::<f64>() / before.len() as f64);
    if radius * plain.side() < 0.5 {
        plain.bilinear(s, [0.0; 2])
    } else {
        filtered(plain, s, (radius, angle))
    }
}

/// The map (level 0), or the level whose texels are 2^level of the map's wide.
fn level<'a>(plain: &'a Plain<'_>, level: u32) -> &'a Image<f32> {
    match level {
        0 => plain.channel("shadow-map", 0, 0),
        _ => plain.channel("mean-depth", level - 1, 0),
    }
}

/// Depth of a level's texel (of the border's outside), and the reference at its centre.
fn level_texel(plain: &Plain<'_>, s: &Shadowed, (k, texel): (u32, [f64; 2])) -> (f64, f64) {
    let map = level(plain, k);
    let side = [map.width(), map.height()];
    let [x, y] = [0, 1].map(|c| texel[c].clamp(0.0, f64::from(side[c]) - 1.0) as u32);
    let width = f64::from(1u32 << k) / plain.side();
    (f64::from(*map.at(x, y)), plain.reference(s, texel.map(|c| (c + 0.5) * width)))
}

fn is_inside(uv: [f64; 2]) -> bool {
    uv.iter().all(|c| (0.0..1.0).contains(c))
}

/// T17: a tap's level is floor(log2(distance / 4 texels)), 0 to 2.
fn mips(plain: &Plain<'_>, s: &Shadowed, angle: f64) -> f64 {
    let of = |o: [f64; 2]| {
        let k = (o[0].hypot(o[1]) * plain.side() / 4.0).log2().floor().clamp(0.0, 2.0) as u32;
        (k, [0, 1].map(|c| s.uv[c] + o[c]), f64::from(1u32 << k) / plain.side())
    };
    let pairs = search(plain, s, angle).into_iter().filter_map(|o| {
        let (k, uv, width) = of(o);
        is_inside(uv).then(|| level_texel(plain, s, (k, uv.map(|c| (c / width).floor()))))
    });
    let before: Vec<f64> = pairs.filter(|p| p.0 < p.1).map(|p| p.0).collect();
    let mean = before.iter().sum::<f64>() / before.len() as f64;
    let radius = if before.is_empty() { 0.0 } else { plain.kernel(s.depth, mean) };
    plain.mean(&placed(&vogel(16), radius, angle), |o| {
        let (k, uv, width) = of(o);
        if !is_inside(uv) {
            return 1.0;
        }
        let place = uv.map(|c| c / width - 0.5);
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
        let lit = corners.map(|d| {
            let texel = [0, 1].map(|c| place[c].floor() + d[c]);
            let weight = [0, 1].map(|c| 1.0 - (place[c] - texel[c]).abs());
            let (depth, reference) = level_texel(plain, s, (k, texel));
            if reference <= depth { weight[0] * weight[1] } else { 0.0 }
        });
        lit.iter().sum()
    })
}

/// T18: a disc of no more than 3.5 texels' radius on the finest level that has it so; texels weigh
/// what a border as soft as a texel leaves of them.
fn chs(plain: &Plain<'_>, s: &Shadowed, _: f64) -> f64 {
    let texels = |radius: f64| {
        let coarsest = plain.levels("mean-depth");
        let width = |k: u32| f64::from(1u32 << k) / plain.side();
        let k = (0..coarsest).find(|&k| radius <= 3.5 * width(k)).unwrap_or(coarsest);
        let (width, reach) = (width(k), (radius / width(k)).max(0.5) + 0.5);
        let place = s.uv.map(|c| c / width);
        let centre = place.map(f64::floor);
        let all = (-4..=4).flat_map(|y| (-4..=4).map(move |x| [f64::from(x), f64::from(y)]));
        let weighed = all.filter_map(|d| {
            let texel = [0, 1].map(|c| centre[c] + d[c]);
            let apart = (texel[0] + 0.5 - place[0]).hypot(texel[1] + 0.5 - place[1]);
            let weight = (reach - apart).clamp(0.0, 1.0);
            let inside = is_inside(texel.map(|c| (c + 0.5) * width));
            (weight > 0.0).then(|| (weight, inside.then(|| level_texel(plain, s, (k, texel)))))
        });
        weighed.collect::<Vec<_>>()
    };
    let (mut sum, mut total) = (0.0, 0.0);
    for (weight, pair) in texels(plain.search(s.depth)) {
        if let Some((depth, reference)) = pair
            && depth < reference
        {
            (sum, total) = (sum + weight * depth, total + weight);
        }
    }
    let radius = if total > 0.0 { plain.kernel(s.depth, sum / total) } else { 0.0 };
    let (mut lit, mut total) = (0.0, 0.0);
    for (weight, pair) in texels(radius) {
        total += weight;
        lit += if pair.is_none_or(|(depth, reference)| reference <= depth) { weight } else { 0.0 };
    }
    lit / total
}

/// T22: of each tap the deepest blocker; the filter as ever.
fn layers(plain: &Plain<'_>, s: &Shadowed, (count, angle): (u32, f64)) -> f64 {
    let deeper = ["shadow-layer-2", "shadow-layer-3", "shadow-layer-4"];
    let (mut sum, mut found) = (0.0, 0.0);
    for o in search(plain, s, angle) {
        let Some((first, reference)) = plain.pair(s, o) else { continue };
        let [x, y] = [0, 1].map(|c| ((s.uv[c] + o[c]) * plain.side()).floor() as u32);
        let others =
            deeper.iter().take(count as usize - 1).map(|l| f64::from(*plain.channel(l, 0, 0).at(x, y)));
        let before = std::iter::once(first).chain(others).filter(|&d| d < reference);
        if let Some(deepest) = before.reduce(f64::max) {
            (sum, found) = (sum + deepest, found + 1.0);
        }
    }
    let radius = if found > 0.0 { plain.kernel(s.depth, sum / found) } else { 0.0 };
    filtered(plain, s, (radius, angle))
}

/// T21: the rectangles of the light's unit disc that cells of the map hide.
fn patches(plain: &Plain<'_>, s: &Shadowed) -> Vec<[[f64; 2]; 2]> {
    let radius = plain.search(s.depth);
    let stride = (2.0 * radius * plain.side() / 15.0).ceil().max(1.0);
    let range = |c: usize| {
        let at = |edge: f64| (edge * plain.side() / stride).floor() as i64;
        at(s.uv[c] - radius)..=at(s.uv[c] + radius)
    };
    let cells = range(1).flat_map(|y| range(0).map(move |x| [x as f64, y as f64]));
    let hidden = cells.filter_map(|cell| {
        let texel = cell.map(|c| c * stride + (stride / 2.0).floor());
        if !is_inside(texel.map(|c| (c + 0.5) / plain.side())) {
            return None;
        }
        let (depth, reference) = plain.texel(s, texel);
        let cone = plain.kernel(s.depth, depth).max(1e-9);
        let edge = |d: f64| [0, 1].map(|c| ((cell[c] + d) * stride / plain.side() - s.uv[c]) / cone);
        (depth < reference).then(|| [edge(0.0), edge(1.0)])
    });
    hidden.collect()
}

/// The disc's area by strips: no closed form.
fn backprojected(plain: &Plain<'_>, s: &Shadowed, _: f64) -> f64 {
    const STRIPS: u32 = 400;
    let in_disc = |[low, high]: [[f64; 2]; 2]| {
        let (from, to) = (low[0].max(-1.0), high[0].min(1.0));
        let step = (to - from) / f64::from(STRIPS);
        let strip = |k: u32| {
            let x = from + (f64::from(k) + 0.5) * step;
            let half = (1.0 - x * x).max(0.0).sqrt();
            (high[1].min(half) - low[1].max(-half)).max(0.0) * step
        };
        if step > 0.0 { (0..STRIPS).map(strip).sum::<f64>() } else { 0.0 }
    };
    let hidden: f64 = patches(plain, s).into_iter().map(in_disc).sum();
    1.0 - (hidden / std::f64::consts::PI).min(1.0)
}

/// 64 places of Vogel's disc on the light, each seen or not.
fn bits(plain: &Plain<'_>, s: &Shadowed, _: f64) -> f64 {
    let patches = patches(plain, s);
    let hides = |p: &[f64; 2], [low, high]: &[[f64; 2]; 2]| (0..2).all(|c| low[c] <= p[c] && p[c] < high[c]);
    let seen = vogel(64).into_iter().filter(|p| !patches.iter().any(|patch| hides(p, patch))).count();
    seen as f64 / 64.0
}
