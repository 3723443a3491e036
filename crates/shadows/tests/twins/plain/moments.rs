//! Moments of depth: variance and exponential shadow maps, T23 to T30. Chains start from the levels
//! that the pipeline wrote, boxes of the table from the shadow map itself.

use super::{Plain, Shadowed, Spot, placed, tables, vogel};
use umbrage_frame::Image;
use umbrage_shadows::Calibration;

/// What f32 may add to a variance: a dozen roundings of 2^-25 of squares of at most 1/16 (depth
/// counts from the middle of what there is). It decides where a variance is as small.
const VARIANCE_ROUNDING: f64 = 2.4e-8;

/// Depths as moments have them: 0 in the middle of what there is, in units of the far plane's
/// distance.
struct Moments<'a> {
    plain: &'a Plain<'a>,
    name: &'a str,
    middle: f64,
    far: f64,
    nearest: f64,
}

/// What a variant of this family may say; `None` for any other name.
pub(crate) fn shade(plain: &Plain<'_>, name: &str, spot: &Spot) -> Option<Vec<f64>> {
    if name != "esm" && !name.starts_with("vsm") {
        return None;
    }
    let Some(s) = plain.shadowed(spot) else { return Some(vec![1.0]) };
    if !s.uv.iter().all(|c| (0.0..1.0).contains(c)) {
        return Some(vec![1.0]);
    }
    let (nearest, far) = (plain.light.nearest.value, plain.light.far);
    let moments = Moments { plain, name, middle: 0.5 * (nearest + far), far, nearest };
    Some(match name {
        "esm" => vec![moments.exponential(&s)],
        "vsm-listing" => moments.listing(&s, -0.001),
        "vsm-soft" => moments.listing(&s, 0.001),
        "vsm" | "vsm-filtered" | "vsm-lbr" | "vsm-mips" | "vsm-sat" => {
            let fixed = 2.0 * plain.fixed(s.depth) * plain.side();
            let bounds = moments.bounds(moments.over(s.uv, fixed), moments.counted(&s));
            let reduced = |p: f64| if name == "vsm-lbr" { ((p - 0.2) / 0.8).max(0.0) } else { p };
            bounds.map(reduced).into()
        }
        _ => moments.search(&s).into_iter().flat_map(|b| moments.filtered(&s, b, spot)).collect(),
    })
}

impl Moments<'_> {
    fn unit(&self, depth: f64) -> f64 {
        (depth - self.middle) / self.far
    }

    /// The receiver's own depth, less the bias.
    fn counted(&self, s: &Shadowed) -> f64 {
        self.unit(self.plain.reference(s, s.uv))
    }

    /// Moments over a square of so many texels, as the variant takes them.
    fn over(&self, uv: [f64; 2], width: f64) -> [f64; 2] {
        let place = uv.map(|c| c * self.plain.side());
        match self.name {
            "vsm" | "vsm-listing" | "vsm-soft" => {
                let map = self.plain.channel("shadow-map", 0, 0);
                [1, 2].map(|power| lerped(map, place, |depth| self.unit(depth).powi(power)))
            }
            "vsm-filtered" | "vsm-lbr" => [0, 1].map(|m| {
                lerped(self.plain.channel("moments-filtered", 0, m), place.map(|c| 0.25 * c), |v| v)
            }),
            "vsm-sat" | "vsm-search-sat" => self.box_mean(place, width.clamp(1.0, self.widest())),
            _ => [0, 1].map(|m| self.trilinear("moments-mips", m, (place, width))),
        }
    }

    /// Between the levels whose texels are so many of the map's wide.
    fn trilinear(&self, label: &str, channel: usize, (place, width): ([f64; 2], f64)) -> f64 {
        let coarsest = self.plain.levels(label) - 1;
        let lod = width.max(1.0).log2().min(f64::from(coarsest));
        let at = |level: u32| {
            let image = self.plain.channel(label, level.min(coarsest), channel);
            lerped(image, place.map(|c| c / f64::from(1u32 << level.min(coarsest))), |v| v)
        };
        let (level, part) = (lod.floor() as u32, lod - lod.floor());
        at(level) * (1.0 - part) + at(level + 1) * part
    }

    /// The mean over a box between texels, by the area that it shares with each, inside the map.
    fn box_mean(&self, middle: [f64; 2], width: f64) -> [f64; 2] {
        let map = self.plain.channel("shadow-map", 0, 0);
        let low = middle.map(|c| (c - 0.5 * width).max(0.0));
        let high = middle.map(|c| (c + 0.5 * width).min(self.plain.side()));
        let share = |k: usize, t: u32| (high[k].min(f64::from(t) + 1.0) - low[k].max(f64::from(t))).max(0.0);
        let texels = |k: usize| low[k] as u32..high[k].ceil() as u32;
        let (mut sums, mut area) = ([0.0; 2], 0.0);
        for y in texels(1) {
            for x in texels(0) {
                let (weight, u) = (share(0, x) * share(1, y), self.unit(f64::from(*map.at(x, y))));
                sums = [sums[0] + weight * u, sums[1] + weight * u * u];
                area += weight;
            }
        }
        sums.map(|sum| sum / area)
    }

    /// Texels of the widest kernel or search that a table is made for; at most 128.
    fn widest(&self) -> f64 {
        let radius = match self.plain.calibration {
            Calibration::AsPrinted => 0.002,
            Calibration::LightMatched => self.plain.search(self.far),
        };
        (2.0 * radius * self.plain.side()).ceil().clamp(1.0, 128.0)
    }

    /// Variance that a table's fixed point may feign: two and a half steps, depth spanning -1 to 1.
    /// As many bits, 22 at most, as keep the widest box's sum, and a texel round it, below 2^31.
    fn table_noise(&self) -> f64 {
        if !self.name.ends_with("-sat") {
            return 0.0;
        }
        let bits = (31.0 - (2.0 * (self.widest() + 2.0).log2()).ceil()).min(22.0);
        let half_range = 0.5 * (self.far - self.nearest) / self.far;
        2.5 * half_range.powi(2) / bits.exp2()
    }

    /// The variance, and what rounding may make of it.
    fn variances(&self, [mean, square]: [f64; 2]) -> [f64; 3] {
        let noise = VARIANCE_ROUNDING + self.table_noise();
        [0.0, noise, -noise].map(|error| square - mean * mean + error)
    }

    fn least_variance(&self) -> f64 {
        let constant = match self.plain.calibration {
            Calibration::AsPrinted => 1e-6,
            Calibration::LightMatched => 1e-8,
        };
        self.table_noise().max(constant)
    }

    /// Chebyshev's bound on the share at or beyond `z`.
    fn bounds(&self, m: [f64; 2], z: f64) -> [f64; 3] {
        self.variances(m).map(|variance| {
            let variance = variance.max(self.least_variance());
            if z < m[0] { 1.0 } else { variance / (variance + (z - m[0]).powi(2)) }
        })
    }

    /// The fourth document's function: smoothstep(z - .02, z, m1) or linstep(.2, 1, p).
    fn listing(&self, s: &Shadowed, floor: f64) -> Vec<f64> {
        let (m, z) = (self.over(s.uv, 1.0), self.counted(s));
        let t = ((m[0] - (z - 0.02)) / 0.02).clamp(0.0, 1.0);
        let soft = t * t * (3.0 - 2.0 * t);
        let hard = |variance: f64| {
            let p = variance.max(floor) / (variance.max(floor) + (z - m[0]).powi(2));
            if p.is_finite() { ((p - 0.2) / 0.8).clamp(0.0, 1.0) } else { 0.0 }
        };
        self.variances(m).map(|variance| soft.max(hard(variance))).into()
    }

    /// Blockers' depths in metres; `None` where the bound exceeds .99. The search's half-width is the
    /// largest kernel's radius, half of that in the listing.
    fn search(&self, s: &Shadowed) -> Vec<Option<f64>> {
        let scale = if self.name == "vsm-poisson-listing" { 0.5 } else { 1.0 };
        let width = 2.0 * scale * self.plain.search(s.depth) * self.plain.side();
        let (m, z) = (self.over(s.uv, width), self.counted(s));
        let blocker = |p: f64| {
            let b = self.middle + self.far * (m[0] - p * z) / (1.0 - p);
            (p <= 0.99).then_some(b.max(self.nearest))
        };
        self.bounds(m, z).map(blocker).into()
    }

    fn filtered(&self, s: &Shadowed, blocker: Option<f64>, spot: &Spot) -> Vec<f64> {
        let plain = self.plain;
        let radius = match blocker {
            Some(b) => plain.kernel(s.depth, b),
            None if self.name == "vsm-poisson-listing" => plain.search(s.depth),
            None => return vec![1.0],
        };
        let width = 2.0 * radius * plain.side();
        match self.name {
            "vsm-search-pcf" => {
                let kernel = placed(&vogel(16), radius, plain.angle(spot.place));
                vec![plain.mean(&kernel, |o| plain.bilinear(s, o))]
            }
            "vsm-poisson-listing" => {
                // Sixteen taps, all at the centre.
                let m = self.over(s.uv, width * tap_share());
                self.bounds(m, self.counted(s)).into()
            }
            "vsm-poisson" | "vsm-poisson-lod0" => {
                let share = if self.name == "vsm-poisson" { tap_share() } else { 0.0 };
                let taps = placed(&tables::poisson(16), radius, plain.angle(spot.place));
                self.bounds(self.about_plane(s, &taps, width * share), 0.0).into()
            }
            _ => self.bounds(self.over(s.uv, width), self.counted(s)).into(),
        }
    }

    /// Mean moments of taps about the receiver's plane at each: E(u - z) and E(u - z)^2.
    fn about_plane(&self, s: &Shadowed, taps: &[[f64; 2]], width: f64) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for offset in taps {
            let uv = [0, 1].map(|k| s.uv[k] + offset[k]);
            let (m, z) = (self.over(uv, width), self.unit(self.plain.reference(s, uv)));
            sums = [sums[0] + m[0] - z, sums[1] + m[1] - 2.0 * z * m[0] + z * z];
        }
        sums.map(|sum| sum / taps.len() as f64)
    }

    /// E exp(c u) exp(-c z), c = 80 over depths from the light (as printed) or from the nearest
    /// geometry to the far plane; stored relative to the far plane.
    fn exponential(&self, s: &Shadowed) -> f64 {
        let first = if self.plain.calibration == Calibration::AsPrinted { 0.0 } else { self.nearest };
        let c = 80.0 / (self.far - first);
        let place = s.uv.map(|c| c * self.plain.side());
        let width = 2.0 * self.plain.fixed(s.depth) * self.plain.side();
        let mean = self.trilinear("exponential-mips", 0, (place, width));
        (mean * (c * (self.far - self.plain.reference(s, s.uv))).exp()).min(1.0)
    }
}

/// Half the least distance of two of the sixteen taps: the third document's `poissonRadius`.
fn tap_share() -> f64 {
    let taps = tables::poisson(16);
    let apart = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let pairs = taps.iter().enumerate().flat_map(|(k, a)| taps[..k].iter().map(move |b| apart(a, b)));
    0.5 * pairs.fold(f64::INFINITY, f64::min)
}

/// A bilinear mean of a function of texels, clamped at the border.
fn lerped(image: &Image<f32>, place: [f64; 2], of: impl Fn(f64) -> f64) -> f64 {
    let last = [image.width(), image.height()].map(|c| i64::from(c) - 1);
    let corner = place.map(|c| c - 0.5);
    let at = |dx: i64, dy: i64| {
        let [x, y] = [(0, dx), (1, dy)].map(|(k, d)| (corner[k].floor() as i64 + d).clamp(0, last[k]) as u32);
        of(f64::from(*image.at(x, y)))
    };
    let [wx, wy] = corner.map(|c| c - c.floor());
    (at(0, 0) * (1.0 - wx) + at(1, 0) * wx) * (1.0 - wy) + (at(0, 1) * (1.0 - wx) + at(1, 1) * wx) * wy
}
