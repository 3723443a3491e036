//! The truth of a window, through the cache.

use crate::error::CliError;
use crate::suite::Sampling;
use glam::Vec3;
use umbrage_frame::{Anchors, Image, View};
use umbrage_metrics::PanelTruth;
use umbrage_reference::{Cache, Finder, GroundTruth, Points, Reached, Source, TruthSettings};
use umbrage_scene::AreaLight;

/// Truth of the pixel reading: unbiased at any number of samples, and only used for the difference
/// between the two readings.
pub(crate) const PIXEL_SAMPLES: u32 = 64;

/// Sun discs smaller than a sample could resolve are exact anyway; these seeds keep the estimates
/// of anchors and pixels apart.
const ANCHOR_SEED: u64 = 1;
const PIXEL_SEED: u64 = 2;

/// Truth at anchors and at pixels, through the cache.
pub(super) struct Truths<'a, 'b> {
    pub(super) finder: &'a mut Finder<'b>,
    pub(super) cache: &'a Cache,
    pub(super) computed: bool,
    pub(super) notes: Vec<String>,
    pub(super) key: String,
}

impl Truths<'_, '_> {
    fn get(
        &mut self,
        points: &Points,
        light: &AreaLight,
        settings: TruthSettings,
    ) -> Result<GroundTruth, CliError> {
        let key = self.finder.truth_key(points, light, &settings);
        self.key = format!("{}{key:?}", self.key);
        let (truth, source) = self.cache.try_truth(key, || self.finder.truth(points, light, &settings))?;
        match source {
            Source::Stored => {}
            Source::Computed => self.computed = true,
            Source::Repaired => {
                self.computed = true;
                self.notes.push("a cached truth was damaged and has been computed again".into());
            }
            Source::NotStored(reason) => {
                self.computed = true;
                self.notes
                    .push(format!("truth could not be cached ({reason}): the next run computes it again"));
            }
        }
        Ok(truth)
    }

    /// Truth at the anchors, once, or once a frame where the light moves; and which face the light
    /// in all of them.
    pub(super) fn at_anchors(
        &mut self,
        points: &Points,
        frames: &[(View, AreaLight)],
        sampling: &Sampling,
    ) -> Result<(PanelTruth, Vec<bool>), CliError> {
        let settings = TruthSettings {
            samples: sampling.samples,
            basis_samples: sampling.basis_samples,
            seed: ANCHOR_SEED,
            tolerance: sampling.tolerance,
            ..TruthSettings::default()
        };
        let middle = self.get(points, &frames[frames.len() / 2].1, settings)?;
        if let Some(tolerance) = sampling.tolerance {
            self.notes.push(reached_note(&middle.reached(tolerance), tolerance));
        }
        let mut facing = middle.facing.clone();
        let moves = frames.iter().any(|f| f.1 != frames[0].1);
        let (mut halves, count) = if moves { ([vec![], vec![]], frames.len()) } else { (middle.halves, 1) };
        if moves {
            for (_, light) in frames {
                let truth = self.get(points, light, TruthSettings { basis_samples: 0, ..settings })?;
                let [first, second] = truth.halves;
                halves[0].extend(first);
                halves[1].extend(second);
                facing.iter_mut().zip(&truth.facing).for_each(|(all, &now)| *all &= now);
            }
        }
        Ok((PanelTruth { frames: count, halves, basis: middle.basis, variance: middle.variance }, facing))
    }

    /// Truth at the surface of the pixel that each penumbra anchor falls into, frame by frame.
    /// Other points keep the anchor's own.
    pub(super) fn at_pixels(
        &mut self,
        frames: &[(View, AreaLight)],
        (anchors, truth, wanted): (&Anchors, &PanelTruth, &[usize]),
        samples: u32,
    ) -> Result<PanelTruth, CliError> {
        let count = anchors.len();
        let mut halves = [Vec::with_capacity(count * frames.len()), Vec::with_capacity(count * frames.len())];
        for (frame, (view, light)) in frames.iter().enumerate() {
            let hits = self.finder.tracer().primary(view);
            let pixels = anchors.pixels_in(view);
            let seen: Vec<(usize, usize)> = wanted
                .iter()
                .filter_map(|&point| Some((point, pixels[point]? as usize)))
                .filter(|&(_, pixel)| hits.gbuffer.is_hit(pixel))
                .collect();
            let pick = |image: &Image<Vec3>| seen.iter().map(|&(_, pixel)| image.pixels()[pixel]).collect();
            let points = Points {
                position: pick(&hits.gbuffer.position),
                normal: pick(&hits.gbuffer.normal),
                triangle: seen.iter().map(|&(_, pixel)| hits.triangle.pixels()[pixel]).collect(),
            };
            let settings = TruthSettings {
                samples,
                basis_samples: 0,
                seed: PIXEL_SEED + frame as u64,
                ..TruthSettings::default()
            };
            let at_pixels = self.get(&points, light, settings)?;
            for (half, values) in halves.iter_mut().enumerate() {
                let start = values.len();
                values.extend((0..count).map(|point| truth.half(half, frame, point)));
                for (&(point, _), &value) in seen.iter().zip(&at_pixels.halves[half]) {
                    values[start + point] = value;
                }
            }
        }
        let (basis, variance) = (truth.basis.clone(), truth.variance.clone());
        Ok(PanelTruth { frames: frames.len(), halves, basis, variance })
    }
}

/// What became of the tolerance, at the middle frame's light.
pub(crate) fn reached_note(reached: &Reached, tolerance: f32) -> String {
    format!(
        "truth within {tolerance}: its standard error is {:.5} (RMS), {:.5} at most, above the tolerance at {:.2} % of the \
         points; {:.0} samples a point on average",
        reached.rms,
        reached.worst,
        100.0 * reached.above,
        reached.samples
    )
}
