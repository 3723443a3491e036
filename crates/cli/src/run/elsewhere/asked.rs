//! How much of what frames show is not explained by cameras and a light.

use super::frames::Mask;
use super::guesses::Guess;
use crate::views::view_from;
use umbrage_frame::{Image, View};
use umbrage_reference::{Tracer, TruthSettings};
use umbrage_scene::AreaLight;

/// What a frame shows.
pub(super) struct Shown {
    /// Its place in the list of cameras.
    pub(super) place: usize,
    pub(super) mask: Mask,
}

/// Depths differ by so much of themselves: half floats round by 5e-4 of them. A field of view wrong by 1 % moves
/// a pixel at a picture's edge by 1 % of half its width, and the depth of a floor there by about as much.
const SAME_DEPTH: f32 = 2e-3;
/// Fewer than this part of the points on a lit side of a surface say nothing.
const FEW: usize = 20;
/// A shadow that differs by less from point to point is none.
const VARIES: f32 = 0.02;
/// Farther is the sky, whatever number an engine writes for it.
const SKY: f32 = 1e9;

/// How well a guess explains the frames: a part that is not explained, from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unexplained {
    pub(super) part: f64,
    pub(super) by_depth: bool,
    /// A part that falls smoothly towards the right camera: of depth the mean difference of logarithms.
    pub(super) smooth: f64,
}

#[derive(Clone, Copy)]
pub(super) struct Asked<'a> {
    pub(super) tracer: &'a Tracer,
    /// Of each frame that is shown: a light may move.
    pub(super) lights: &'a [AreaLight],
    pub(super) size: (u32, u32),
    pub(super) shown: &'a [Shown],
    pub(super) by_depth: bool,
    /// Most of the points of a frame that are compared.
    pub(super) points: u32,
}

/// Whether a picture of depth has any: some programs write an empty channel.
pub(super) fn holds_depth(depth: &Image<f32>) -> bool {
    let seen = depth.pixels().iter().filter(|&&d| d > 0.0 && d < SKY).count();
    seen * FEW > depth.pixels().len()
}

impl Asked<'_> {
    /// Whether the frames show anything at all.
    fn varies(&self, grid: &[u32]) -> bool {
        let values = self.shown.iter().flat_map(|s| grid.iter().map(|&p| s.mask.image.pixels()[p as usize]));
        let (low, high) =
            values.filter(|v| v.is_finite()).fold((f32::MAX, f32::MIN), |(l, h), v| (l.min(v), h.max(v)));
        high - low > VARIES
    }

    /// Whether depths may be what a projection makes of them.
    pub(super) fn holds_buffer_depth(&self) -> bool {
        let depths = self.shown.iter().filter_map(|s| s.mask.depth.as_ref());
        depths.flat_map(|d| d.pixels()).all(|v| (0.0..=1.0).contains(v))
    }

    /// None where the frames are the same everywhere.
    pub(super) fn unexplained(&self, guess: &Guess, offset: isize) -> Option<Unexplained> {
        let (width, height) = self.size;
        let step =
            ((f64::from(width) * f64::from(height) / f64::from(self.points)).sqrt().ceil() as u32).max(1);
        let grid: Vec<u32> = (step / 2..height)
            .step_by(step as usize)
            .flat_map(|y| (step / 2..width).step_by(step as usize).map(move |x| y * width + x))
            .collect();
        let by_depth = self.by_depth;
        let (mut differ, mut apart, mut all) = (0usize, 0.0f64, 0usize);
        let mut pairs: Vec<[f64; 2]> = Vec::new();
        for (shown, light) in self.shown.iter().zip(self.lights) {
            let place = shown.place.checked_add_signed(guess.offset);
            let Some(camera) = place.and_then(|p| guess.cameras.get(p)) else { continue };
            if shown.place.checked_add_signed(offset).is_none_or(|p| p >= guess.cameras.len()) {
                continue;
            }
            let view = view_from(camera, self.size);
            let seen = |pixel: u32| guess.flipped(pixel, self.size);
            let (depths, points) = self.tracer.primary_some(&view, &grid);
            if let Some(depth) = shown.mask.depth.as_ref().filter(|_| by_depth) {
                for (&pixel, &truth) in grid.iter().zip(&depths) {
                    let here = depth.pixels()[seen(pixel) as usize] * guess.depth_unit;
                    let off = depth_apart(here, truth, &view, pixel);
                    differ += usize::from(off > SAME_DEPTH);
                    apart += f64::from(off.min(1.0));
                    all += 1;
                }
                continue;
            }
            let settings = TruthSettings { samples: 32, basis_samples: 0, ..TruthSettings::default() };
            let truth = self.tracer.truth(&points, light, &settings);
            let hits = grid.iter().zip(&depths).filter(|(_, d)| d.is_finite()).map(|(&p, _)| p);
            for ((pixel, &v), &facing) in hits.zip(&truth.mean).zip(&truth.facing) {
                let here = shown.mask.image.pixels()[seen(pixel) as usize];
                if facing && here.is_finite() {
                    pairs.push([f64::from(here), f64::from(v)]);
                }
            }
        }
        match by_depth {
            true if all == 0 => None,
            true => {
                let n = all as f64;
                Some(Unexplained { part: differ as f64 / n, by_depth, smooth: apart / n })
            }
            false if !self.varies(&grid) => None,
            // What sees nothing explains nothing, and of a few points anything is true by chance.
            false if pairs.len() < grid.len() * self.shown.len() / FEW => {
                Some(Unexplained { part: 1.0, by_depth, smooth: 1.0 })
            }
            false => {
                let part = 1.0 - correlation(&pairs).unwrap_or(0.0);
                Some(Unexplained { part, by_depth, smooth: part })
            }
        }
    }
}

/// How far apart two depths are, as part of them; the file's may be linear depth, or the distance from the eye
/// that some programs write.
fn depth_apart(here: f32, truth: f32, view: &View, pixel: u32) -> f32 {
    let nothing = |d: f32| !(d > 0.0 && d < SKY);
    if nothing(here) || nothing(truth) {
        return if nothing(here) && nothing(truth) { 0.0 } else { f32::INFINITY };
    }
    let px = glam::Vec2::new((pixel % view.width) as f32 + 0.5, (pixel / view.width) as f32 + 0.5);
    let forward = -view.camera_from_world.row(2).truncate();
    let distance = truth / view.direction(px).dot(forward).max(1e-3);
    (here / truth).ln().abs().min((here / distance).ln().abs())
}

/// Pearson's; none where one of the two does not vary.
fn correlation(pairs: &[[f64; 2]]) -> Option<f64> {
    let n = pairs.len() as f64;
    let mean = [0, 1].map(|k| pairs.iter().map(|p| p[k]).sum::<f64>() / n.max(1.0));
    let product = |a: usize, b: usize| pairs.iter().map(|p| (p[a] - mean[a]) * (p[b] - mean[b])).sum::<f64>();
    let spread = product(0, 0) * product(1, 1);
    // A thousandth of the points in shadow.
    (pairs.len() > 1 && product(1, 1) > 1e-3 * n && product(0, 0) > 1e-6 * n)
        .then(|| product(0, 1) / spread.sqrt())
}
