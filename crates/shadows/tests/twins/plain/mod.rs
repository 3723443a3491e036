//! Plain twins: the formulas in f64, without bounds. What rounding may do is found by asking the
//! twin again for receivers that are moved a little; the adapter's answer must lie within the band
//! of those answers.

pub(crate) mod cube;
pub(crate) mod deep;
pub(crate) mod discs;
pub(crate) mod fewer;
pub(crate) mod moments;
pub(crate) mod separable;
pub(crate) mod tables;

use super::approx::{Approx, Approx3};
use super::light::{Law, Light, Point};
use super::pattern::Pattern;
use super::screen::Receiver;
use umbrage_frame::{Image, View};
use umbrage_shadows::{Bias, Calibration, Dump};

/// What a last pass may read.
pub(crate) struct Plain<'a> {
    pub(crate) light: &'a Light,
    pub(crate) calibration: Calibration,
    pub(crate) bias: Bias,
    pub(crate) pattern: Pattern,
    /// Of this frame and those before it.
    pub(crate) views: Vec<View>,
    /// Every target that the pipeline wrote before it.
    pub(crate) dumps: &'a [Dump],
}

/// A receiver in plain numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub(crate) position: glam::DVec3,
    pub(crate) normal: glam::DVec3,
    /// Pixels of the frame.
    pub(crate) place: [f64; 2],
}

/// A receiver in the map.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shadowed {
    /// 0 to 1.
    pub(crate) uv: [f64; 2],
    pub(crate) depth: f64,
    point: Point,
}

impl Spot {
    pub(crate) fn of(receiver: &Receiver) -> Self {
        let vector = |v: Approx3| glam::DVec3::from_array(v.0.map(|c| c.value));
        Self {
            position: vector(receiver.position),
            normal: vector(receiver.normal),
            place: receiver.place.map(|c| c.value),
        }
    }

    /// The receiver itself, then moved along every axis and on the screen.
    pub(crate) fn jittered(&self) -> Vec<Self> {
        let moved = |step: glam::DVec3| Self { position: self.position + step, ..*self };
        let axes = [glam::DVec3::X, glam::DVec3::Y, glam::DVec3::Z];
        let steps = axes.into_iter().flat_map(|axis| [axis * POSITION_STEP, -axis * POSITION_STEP]);
        let mut all = vec![*self];
        all.extend(steps.map(moved));
        for k in 0..2 {
            for step in [PLACE_STEP, -PLACE_STEP] {
                let mut place = self.place;
                place[k] += step;
                all.push(Self { place, ..*self });
            }
        }
        all
    }
}

/// A position is known to about 2e-5 m (see `gpu_against_cpu::variants`), twice over; in the tests'
/// map a texel is 16 mm.
const POSITION_STEP: f64 = 4e-5;
/// Pixel centres are exact; an anchor's place passes through a matrix product and a quotient.
const PLACE_STEP: f64 = 1e-4;

impl Plain<'_> {
    /// A target's channel, by label and level.
    pub(crate) fn channel(&self, label: &str, level: u32, channel: usize) -> &Image<f32> {
        let found = self.dumps.iter().find(|d| d.label == label && d.level == level);
        &found.unwrap_or_else(|| panic!("no target {label}, level {level}")).channels[channel]
    }

    /// Levels of a target.
    pub(crate) fn levels(&self, label: &str) -> u32 {
        self.dumps.iter().filter(|d| d.label == label).count() as u32
    }

    pub(crate) fn law(&self) -> Law<'_> {
        Law { light: self.light, calibration: self.calibration }
    }

    /// The receiver moved by the normal offset, in the map; `None` behind a local light.
    pub(crate) fn shadowed(&self, spot: &Spot) -> Option<Shadowed> {
        let exact = |v: glam::DVec3| Approx3(v.to_array().map(Approx::exact));
        let point = self.light.point((exact(spot.position), exact(spot.normal)), &self.bias)?;
        let uv = point.uv.map(|c| c.value);
        Some(Shadowed { uv, depth: point.depth.value, point })
    }

    /// Texels of the map's side.
    pub(crate) fn side(&self) -> f64 {
        f64::from(self.light.texels)
    }

    /// What a place in the map (0 to 1) is compared with.
    pub(crate) fn reference(&self, s: &Shadowed, uv: [f64; 2]) -> f64 {
        self.light.reference(&s.point, uv.map(Approx::exact), &self.bias).value
    }

    /// Depth of a texel of the shadow map (of the border's outside), and the reference there.
    pub(crate) fn texel(&self, s: &Shadowed, texel: [f64; 2]) -> (f64, f64) {
        let map = self.channel("shadow-map", 0, 0);
        let [x, y] = texel.map(|c| c.clamp(0.0, self.side() - 1.0) as u32);
        let centre = texel.map(|c| (c + 0.5) / self.side());
        (f64::from(*map.at(x, y)), self.reference(s, centre))
    }

    /// Depth and reference at the texel in which a tap lies; `None` outside the map.
    pub(crate) fn pair(&self, s: &Shadowed, offset: [f64; 2]) -> Option<(f64, f64)> {
        let uv = [0, 1].map(|k| s.uv[k] + offset[k]);
        let inside = uv.iter().all(|c| (0.0..1.0).contains(c));
        inside.then(|| self.texel(s, uv.map(|c| (c * self.side()).floor())))
    }

    /// One comparison; outside the map everything is lit.
    pub(crate) fn nearest(&self, s: &Shadowed, offset: [f64; 2]) -> f64 {
        self.pair(s, offset).map_or(1.0, |(depth, reference)| f64::from(u8::from(reference <= depth)))
    }

    /// Four comparisons, weighted by the tap's place between the texels' centres.
    pub(crate) fn bilinear(&self, s: &Shadowed, offset: [f64; 2]) -> f64 {
        let uv = [0, 1].map(|k| s.uv[k] + offset[k]);
        if !uv.iter().all(|c| (0.0..1.0).contains(c)) {
            return 1.0;
        }
        let place = uv.map(|c| c * self.side() - 0.5);
        let (base, part) = (place.map(f64::floor), place.map(|c| c - c.floor()));
        let lit = |dx: f64, dy: f64| {
            let (depth, reference) = self.texel(s, [base[0] + dx, base[1] + dy]);
            f64::from(u8::from(reference <= depth))
        };
        let row = |dy: f64| lit(0.0, dy) * (1.0 - part[0]) + lit(1.0, dy) * part[0];
        row(0.0) * (1.0 - part[1]) + row(1.0) * part[1]
    }

    /// The mean of a tap over a kernel of map widths.
    pub(crate) fn mean(&self, kernel: &[[f64; 2]], tap: impl Fn([f64; 2]) -> f64) -> f64 {
        kernel.iter().map(|&offset| tap(offset)).sum::<f64>() / kernel.len() as f64
    }

    /// Listing 3: the mean depth of the taps that lie before the receiver.
    pub(crate) fn mean_blocker(&self, s: &Shadowed, kernel: &[[f64; 2]]) -> Option<f64> {
        let pairs = kernel.iter().filter_map(|&offset| self.pair(s, offset));
        let before: Vec<f64> = pairs.filter(|(depth, reference)| depth < reference).map(|p| p.0).collect();
        (!before.is_empty()).then(|| before.iter().sum::<f64>() / before.len() as f64)
    }

    /// The pattern's angle at a place.
    pub(crate) fn angle(&self, place: [f64; 2]) -> f64 {
        std::f64::consts::TAU * self.pattern.turns(place.map(|c| c.floor().max(0.0) as u32)).value
    }

    /// The same of white noise.
    pub(crate) fn white_angle(&self, place: [f64; 2]) -> f64 {
        std::f64::consts::TAU * self.pattern.white_turns(place.map(|c| c.floor().max(0.0) as u32))
    }

    /// The same of the noise with y times 4.
    pub(crate) fn tall_angle(&self, place: [f64; 2]) -> f64 {
        std::f64::consts::TAU * self.pattern.tall_turns(place.map(|c| c.floor().max(0.0) as u32)).value
    }

    /// Radii in map widths: of the search, of a kernel for a blocker, and without one.
    pub(crate) fn search(&self, z: f64) -> f64 {
        self.law().search(Approx::exact(z)).value
    }

    /// See [`Plain::search`].
    pub(crate) fn kernel(&self, z: f64, b: f64) -> f64 {
        self.law().kernel(Approx::exact(z), Approx::exact(b)).value
    }

    /// See [`Plain::search`].
    pub(crate) fn fixed(&self, z: f64) -> f64 {
        self.law().fixed(Approx::exact(z)).value
    }
}

/// What a variant may say of a receiver: one number, or several where a rounding decides. Each family
/// has a file; a variant without a twin fails the tests.
pub(crate) fn shade(plain: &Plain<'_>, name: &str, spot: &Spot) -> Vec<f64> {
    let families = [discs::shade, cube::shade, deep::shade, fewer::shade, moments::shade, separable::shade];
    let found = families.iter().find_map(|family| family(plain, name, spot));
    found.unwrap_or_else(|| panic!("{name} has no twin: write one"))
}

/// A bilinear fetch at a place in texels (centres at +0.5), clamped at the border.
pub(crate) fn fetched(image: &Image<f32>, place: [f64; 2]) -> f64 {
    super::screen::fetched(image, place.map(Approx::exact)).value
}

/// A kernel of radius 1, scaled and turned.
pub(crate) fn placed(points: &[[f64; 2]], radius: f64, angle: f64) -> Vec<[f64; 2]> {
    let (sin, cos) = angle.sin_cos();
    let place = |p: &[f64; 2]| [radius * (p[0] * cos - p[1] * sin), radius * (p[0] * sin + p[1] * cos)];
    points.iter().map(place).collect()
}

/// Vogel's disc of radius 1 (first document, listing 1).
pub(crate) fn vogel(count: u32) -> Vec<[f64; 2]> {
    let point = |i: u32| {
        let radius = ((f64::from(i) + 0.5) / f64::from(count)).sqrt();
        let (sin, cos) = (2.4 * f64::from(i)).sin_cos();
        [radius * cos, radius * sin]
    };
    (0..count).map(point).collect()
}
