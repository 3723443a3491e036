//! Filters of one size, and contact hardening on discs: T2 to T12.

use super::{Plain, Shadowed, Spot, fetched, placed, tables, vogel};
use umbrage_shadows::Calibration;

/// What a variant of this family may say; `None` for any other name.
pub(crate) fn shade(plain: &Plain<'_>, name: &str, spot: &Spot) -> Option<Vec<f64>> {
    if name.starts_with("pcss") && !name.ends_with("-cube") {
        return Some(pcss(plain, name, spot));
    }
    if !name.ends_with("-hash") {
        return Some(vec![one(plain, name, spot)?]);
    }
    // `hash13` magnifies the rounding of a position beyond a turn: any angle is right here, and a
    // test of its own compares the hash.
    let taps = if name.contains("-8-") { 8 } else { 16 };
    let Some(s) = plain.shadowed(spot) else { return Some(vec![1.0]) };
    let radius = plain.fixed(s.depth);
    let turned = |k: u32| placed(&tables::poisson(taps), radius, f64::from(k) * 0.26);
    Some((0..24).map(|k| plain.mean(&turned(k), |o| plain.nearest(&s, o))).collect())
}

fn one(plain: &Plain<'_>, name: &str, spot: &Spot) -> Option<f64> {
    let lit = |s: Option<Shadowed>, f: &dyn Fn(&Shadowed) -> f64| s.map_or(1.0, |s| f(&s));
    let s = plain.shadowed(spot);
    let still = 0.0;
    let fixed = |points: Vec<[f64; 2]>, angle: f64, is_point: bool| {
        lit(s, &|s| {
            let kernel = placed(&points, plain.fixed(s.depth), angle);
            plain.mean(&kernel, |o| if is_point { plain.nearest(s, o) } else { plain.bilinear(s, o) })
        })
    };
    let ign = plain.angle(spot.place);
    Some(match name {
        "lerp" => lit(s, &|s| plain.bilinear(s, [0.0; 2])),
        "lerp-listing" => lit(s, &|s| lerp_listing(plain, s)),
        "pcf-grid-3" => grid(plain, s, 3, false),
        "pcf-grid-5" => grid(plain, s, 5, false),
        "pcf-grid-3-lerp" => grid(plain, s, 3, true),
        "pcf-poisson-16" => fixed(tables::poisson(16), still, true),
        "pcf-poisson-64" => fixed(tables::poisson(64), still, true),
        "pcf-poisson-16-ign" => fixed(tables::poisson(16), ign, true),
        "pcf-vogel-16-white" => fixed(vogel(16), plain.white_angle(spot.place), false),
        "pcf-vogel-32-ign" => fixed(vogel(32), ign, false),
        "pcf-vogel-16-point-ign" => fixed(vogel(16), ign, true),
        "pcf-vogel-64-point-ign" => fixed(vogel(64), ign, true),
        "pcf-blue-16" => fixed(tables::blue(16), still, false),
        "pcf-blue-16-ign" => fixed(tables::blue(16), ign, false),
        "pcf-blue-32-ign" => fixed(tables::blue(32), ign, false),
        "pcf-spiral-8-ign" => fixed(tables::spiral(), ign, false),
        "chss-16" => lit(s, &|s| chss(plain, s, (16, ign), &|z, b| plain.kernel(z, b))),
        "chss-squared" | "chss-linear" | "chss-plane" | "chss-distance" => {
            let law = tables::law(name, plain.light, plain.calibration);
            lit(s, &|s| chss(plain, s, (32, ign), &|z, b| law(z, b).min(cap(plain, name, z))))
        }
        "chss-min-sharp" | "chss-min-listing" => lit(s, &|s| {
            let label = if name.ends_with("sharp") { "min-map" } else { "min-map-blurred" };
            let minimum = plain.channel(label, 0, 0);
            let b = fetched(minimum, s.uv.map(|c| c * f64::from(minimum.width()))).min(s.depth);
            plain.mean(&placed(&vogel(16), plain.kernel(s.depth, b), ign), |o| plain.bilinear(s, o))
        }),
        _ if name.starts_with("chss-mask") => lit(s, &|s| {
            let label = if name.contains("-raw-") { "penumbra-mask" } else { "penumbra-mask-blurred" };
            let radius = fetched(plain.channel(label, 0, 0), spot.place.map(|c| c / 4.0));
            let texels = radius * plain.side();
            // One tap below half a texel, four below one, eight below two.
            let taps = match name {
                "chss-mask-few-taps" if texels < 0.5 => 1,
                "chss-mask-few-taps" if texels < 1.0 => 4,
                "chss-mask-few-taps" if texels < 2.0 => 8,
                _ => 16,
            };
            let radius = if taps == 1 { 0.0 } else { radius };
            plain.mean(&placed(&vogel(taps), radius, ign), |o| plain.bilinear(s, o))
        }),
        _ => return None,
    })
}

/// The second document's code at any angle of its hash: 16 taps of its table find blockers, 32
/// filter; without a blocker all is lit.
fn pcss(plain: &Plain<'_>, name: &str, spot: &Spot) -> Vec<f64> {
    let Some(s) = plain.shadowed(spot) else { return vec![1.0] };
    let at = |k: u32| {
        let angle = f64::from(k) * 0.26;
        let search = placed(&tables::poisson(16), plain.search(s.depth), angle);
        let pairs: Vec<(f64, f64)> = search.iter().filter_map(|&o| plain.pair(&s, o)).collect();
        let counts = |p: &&(f64, f64)| name == "pcss-text" || p.0 < p.1;
        let depths: Vec<f64> = pairs.iter().filter(counts).map(|p| p.0).collect();
        if depths.is_empty() {
            return 1.0;
        }
        let b = depths.iter().sum::<f64>() / depths.len() as f64;
        let radius = match name {
            "pcss-listing" => tables::law(name, plain.light, plain.calibration)(s.depth, b).max(0.0),
            // As printed: the document's own linear law.
            _ if plain.calibration == Calibration::AsPrinted => {
                tables::law("chss-linear", plain.light, plain.calibration)(s.depth, b).max(0.0)
            }
            _ => plain.kernel(s.depth, b),
        };
        plain.mean(&placed(&tables::poisson(32), radius, angle), |o| plain.nearest(&s, o))
    };
    (0..24).map(at).collect()
}

/// Where the document ends kernels at the search radius.
fn cap(plain: &Plain<'_>, name: &str, z: f64) -> f64 {
    if matches!(name, "chss-squared" | "chss-distance") { plain.search(z) } else { f64::INFINITY }
}

/// Blocker search and filter, one angle for both.
pub(super) fn chss(
    plain: &Plain<'_>,
    s: &Shadowed,
    (taps, angle): (u32, f64),
    law: &dyn Fn(f64, f64) -> f64,
) -> f64 {
    let blocker = plain.mean_blocker(s, &placed(&vogel(taps), plain.search(s.depth), angle));
    let radius = blocker.map_or(0.0, |b| law(s.depth, b));
    plain.mean(&placed(&vogel(16), radius, angle), |o| plain.bilinear(s, o))
}

/// A texel between taps as printed; light-matched the fixed radius is the grid's half-side.
fn grid(plain: &Plain<'_>, s: Option<Shadowed>, side: i32, interpolated: bool) -> f64 {
    let Some(s) = s else { return 1.0 };
    let half = f64::from(side / 2);
    let step = match plain.calibration {
        Calibration::AsPrinted => 1.0 / plain.side(),
        Calibration::LightMatched => plain.fixed(s.depth) / half,
    };
    let offset = |k: i32| [f64::from(k % side) - half, f64::from(k / side) - half].map(|c| c * step);
    let kernel: Vec<[f64; 2]> = (0..side * side).map(offset).collect();
    plain.mean(&kernel, |o| if interpolated { plain.bilinear(&s, o) } else { plain.nearest(&s, o) })
}

/// The fourth document's `texture2DShadowLerp`: base floor(t + .5), an edge of texels, of which the
/// nearest sampler takes the upper one.
fn lerp_listing(plain: &Plain<'_>, s: &Shadowed) -> f64 {
    let t = s.uv.map(|c| c * plain.side() + 0.5);
    let lit = |dx: f64, dy: f64| {
        let texel = [t[0].floor() + dx, t[1].floor() + dy];
        if texel.iter().any(|&c| c < 0.0 || c >= plain.side()) {
            return 1.0;
        }
        let (depth, reference) = plain.texel(s, texel);
        f64::from(u8::from(reference <= depth))
    };
    let part = t.map(|c| c - c.floor());
    let column = |dx: f64| lit(dx, 0.0) * (1.0 - part[1]) + lit(dx, 1.0) * part[1];
    column(0.0) * (1.0 - part[0]) + column(1.0) * part[0]
}
