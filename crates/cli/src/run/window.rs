//! One window: its views, anchors, truth and tiles; everything that all variants share.

use crate::error::CliError;
use crate::suite::Sampling;
use crate::views::{past_of, view_of};
use glam::Vec3;
use std::time::Instant;
use umbrage_frame::{AgreementLimits, Anchors, Image, View};
use umbrage_metrics::{Coverage, PanelTruth, Region, TILE_PX, Tiling, counted};
use umbrage_reference::{Cache, Finder, GroundTruth, Points, PrimaryHits, Reached, Source, TruthSettings};
use umbrage_scene::{AreaLight, CameraPath, PathFrame, Scene};
use umbrage_shadows::{LightMap, Renderer};

/// What a window is made from.
pub(crate) struct Request<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) path: &'a CameraPath,
    pub(crate) first: u32,
    pub(crate) frames: &'a [PathFrame],
    pub(crate) readings: Readings,
}

/// What a window has to be ready for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Readings {
    /// At anchors alone: no truth of each frame's own pixels.
    Anchored,
    /// At anchors and at pixels, for edge crawl.
    Both,
}

/// A window, ready for its variants.
pub(crate) struct Window {
    pub(crate) scene: String,
    pub(crate) path: String,
    pub(crate) first: u32,
    /// View and light of each frame.
    pub(crate) frames: Vec<(View, AreaLight)>,
    /// Per frame, the views of those before it, newest first, also from before the window.
    pasts: Vec<Vec<View>>,
    pub(crate) anchors: Anchors,
    /// At the anchors.
    pub(crate) truth: PanelTruth,
    /// At the pixels that penumbra anchors fall into, frame by frame; none for a window of one frame, or when nobody asked.
    pub(crate) pixel_truth: Option<PanelTruth>,
    pub(crate) tiling: Tiling,
    /// Of everything that truth depends on.
    pub(crate) truth_key: String,
    /// Reflectance and cosine to the light per pixel of the middle frame.
    pub(crate) shading: Image<Vec3>,
    coverage: Coverage,
    truth_secs: Option<f64>,
    notes: Vec<String>,
}

/// What a scorecard says about a window.
pub(crate) struct Facts {
    pub(crate) scene: String,
    pub(crate) path: String,
    pub(crate) first: u32,
    pub(crate) frames: u32,
    pub(crate) title: String,
    pub(crate) coverage: Coverage,
    pub(crate) tiles: usize,
    /// Hash over the cameras and the light of every frame.
    pub(crate) views: String,
    pub(crate) truth_secs: Option<f64>,
    pub(crate) notes: Vec<String>,
}

/// Truth of the pixel reading: unbiased at any number of samples, and only used for the difference
/// between the two readings.
pub(crate) const PIXEL_SAMPLES: u32 = 64;

/// Sun discs smaller than a sample could resolve are exact anyway; these seeds keep the estimates
/// of anchors and pixels apart.
const ANCHOR_SEED: u64 = 1;
const PIXEL_SEED: u64 = 2;

impl Window {
    /// Finds anchors, truth, agreement and tiles.
    pub(crate) fn new(
        request: &Request<'_>,
        (finder, cache, renderer): (&mut Finder<'_>, &Cache, &mut Renderer<'_>),
        sampling: &Sampling,
    ) -> Result<Self, CliError> {
        let started = Instant::now();
        let frames: Vec<(View, AreaLight)> =
            request.frames.iter().map(|f| (view_of(f, sampling.size), f.light)).collect();
        let numbers = request.first..request.first + frames.len() as u32;
        let pasts = numbers.map(|number| past_of(request.path, number, sampling.size)).collect();
        let (middle_view, middle_light) = frames[frames.len() / 2];
        let tracer = finder.tracer();
        let hits = tracer.primary(&middle_view);
        let anchors = Anchors::of(&hits.gbuffer);
        let mut truths = Truths { finder, cache, computed: false, notes: Vec::new(), key: String::new() };
        let (truth, facing) = truths.at_anchors(&hits.points(), &frames, sampling)?;
        let (mut agreements, mut witnesses) = (Vec::new(), Vec::new());
        for (index, (view, light)) in frames.iter().enumerate() {
            let raster = renderer.gbuffer(view, light)?;
            let limits = AgreementLimits::default();
            agreements.push(anchors.agreement(&raster, limits));
            // What truth itself sees in this very frame; the middle one has been traced.
            witnesses.push(match index == frames.len() / 2 {
                true => anchors.agreement(&raster, limits),
                false => Anchors::of(&tracer.primary(view).gbuffer).agreement(&raster, limits),
            });
        }
        let (counts, coverage) = counted(&anchors, &facing, &agreements, &witnesses)?;
        let tiling = Tiling::new(&anchors, &truth, &counts, TILE_PX)?;
        let pixel_truth = match request.readings {
            Readings::Both if frames.len() > 1 => {
                Some(truths.at_pixels(&frames, (&anchors, &truth, &tiling))?)
            }
            _ => None,
        };
        let Truths { computed, mut notes, key, .. } = truths;
        notes.extend(outside_map_note(&anchors, &renderer.light_map(&middle_light)));
        Ok(Self {
            scene: request.scene.name.clone(),
            path: request.path.name.clone(),
            first: request.first,
            shading: shading(request.scene, &hits, &middle_light),
            frames,
            pasts,
            anchors,
            truth,
            pixel_truth,
            tiling,
            truth_key: key,
            coverage,
            truth_secs: computed.then(|| started.elapsed().as_secs_f64()),
            notes,
        })
    }

    /// Share of surfaces on which truth and raster disagree in one and the same frame.
    pub(crate) fn disagreement(&self) -> f64 {
        self.coverage.disagreement()
    }

    /// Keeps the patterns of this window apart from those of others: windows are resampled as
    /// independent.
    pub(crate) fn salt(&self) -> u32 {
        let name = format!("{}/{}", self.scene, self.path);
        name.bytes().fold(0x811c_9dc5, |hash: u32, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193))
    }

    /// Where the camera was in the frames before one of the window, newest first.
    pub(crate) fn past(&self, frame: usize) -> Vec<View> {
        self.pasts[frame].clone()
    }

    /// View and light of the middle frame.
    pub(crate) fn middle_frame(&self) -> (&View, &AreaLight) {
        let (view, light) = &self.frames[self.middle()];
        (view, light)
    }

    /// Index of the middle frame.
    pub(crate) fn middle(&self) -> usize {
        self.frames.len() / 2
    }

    /// Picture size.
    pub(crate) fn size(&self) -> (u32, u32) {
        (self.anchors.view.width, self.anchors.view.height)
    }

    /// The scene lit by the true shadow.
    pub(crate) fn beauty(&self) -> Image<[f32; 3]> {
        let lit = self.spread(|point| self.truth.mean(point) as f32, 0.0);
        self.shaded(&lit)
    }

    /// The scene lit through a mask: a white light over a dim sky, display-linear.
    pub(crate) fn shaded(&self, mask: &Image<f32>) -> Image<[f32; 3]> {
        const SKY: f32 = 0.15;
        let pixels = self.shading.pixels().iter().zip(mask.pixels());
        let (width, height) = self.size();
        let shade = |(surface, v): (&Vec3, &f32)| {
            // The cosine is folded into the length of the colour; see `shading`.
            (*surface * (SKY + (1.0 - SKY) * v.clamp(0.0, 1.0))).to_array()
        };
        Image::from_pixels(width, height, pixels.map(shade).collect())
    }

    /// A value per point as a picture of the middle frame; `elsewhere` where there is no anchor.
    pub(crate) fn spread(&self, value: impl Fn(usize) -> f32, elsewhere: f32) -> Image<f32> {
        let (width, height) = self.size();
        let mut image = Image::filled(width, height, elsewhere);
        for (point, &pixel) in self.anchors.pixel.iter().enumerate() {
            image.pixels_mut()[pixel as usize] = value(point);
        }
        image
    }

    /// Whether a point was scored.
    pub(crate) fn is_counted(&self, point: usize) -> bool {
        self.tiling.regions[point] != Region::LeftOut
    }

    /// For the scorecard.
    fn views_hash(&self) -> String {
        let text: String = self.frames.iter().map(|(view, light)| format!("{view:?} {light:?}\n")).collect();
        blake3::hash(text.as_bytes()).to_hex().chars().take(16).collect()
    }

    pub(crate) fn facts(&self, path: &CameraPath) -> Facts {
        Facts {
            scene: self.scene.clone(),
            path: self.path.clone(),
            first: self.first,
            frames: self.frames.len() as u32,
            title: path.title.clone(),
            coverage: self.coverage,
            tiles: self.tiling.tiles.iter().filter(|t| !t.penumbra.is_empty()).count(),
            views: self.views_hash(),
            truth_secs: self.truth_secs,
            notes: self.notes.clone(),
        }
    }
}

/// Truth at anchors and at pixels, through the cache.
struct Truths<'a, 'b> {
    finder: &'a mut Finder<'b>,
    cache: &'a Cache,
    computed: bool,
    notes: Vec<String>,
    key: String,
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
    fn at_anchors(
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
    /// Points outside the penumbra keep the anchor's own: the pixel reading is not scored there.
    fn at_pixels(
        &mut self,
        frames: &[(View, AreaLight)],
        (anchors, truth, tiling): (&Anchors, &PanelTruth, &Tiling),
    ) -> Result<PanelTruth, CliError> {
        let count = anchors.len();
        let mut halves = [Vec::with_capacity(count * frames.len()), Vec::with_capacity(count * frames.len())];
        let wanted: Vec<usize> = (0..count).filter(|&p| tiling.regions[p] == Region::Penumbra).collect();
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
                samples: PIXEL_SAMPLES,
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

/// Most of the anchors that may lie outside the shadow map, where everything is lit, without a word.
const OUTSIDE_LIMIT: f64 = 0.05;

fn outside_map_note(anchors: &Anchors, map: &LightMap) -> Option<String> {
    let inside = |p: &&Vec3| {
        let clip = map.clip_from_world * p.extend(1.0);
        clip.w > 0.0 && clip.x.abs().max(clip.y.abs()) <= clip.w
    };
    let outside = 1.0 - anchors.position.iter().filter(inside).count() as f64 / anchors.len().max(1) as f64;
    (outside > OUTSIDE_LIMIT && !anchors.is_empty()).then(|| {
        format!(
            "{:.0} % of the points lie outside the shadow map, where variants are lit: see shadow_region",
            100.0 * outside
        )
    })
}

/// Reflectance times the cosine to the light's centre, per pixel; a dim grey where nothing is seen.
fn shading(scene: &Scene, hits: &PrimaryHits, light: &AreaLight) -> Image<Vec3> {
    let gbuffer = &hits.gbuffer;
    let (width, height) = (gbuffer.view.width, gbuffer.view.height);
    let surface = |pixel: usize| {
        if !gbuffer.is_hit(pixel) {
            return Vec3::splat(0.3);
        }
        let (position, normal) = (gbuffer.position.pixels()[pixel], gbuffer.normal.pixels()[pixel]);
        let cosine = normal.dot(light.direction_from(position)).max(0.0);
        scene.albedo_at(hits.triangle.pixels()[pixel] as usize, position) * (0.3 + 0.7 * cosine)
    };
    Image::from_pixels(width, height, (0..(width * height) as usize).map(surface).collect())
}
