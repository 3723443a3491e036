//! One window: its views, anchors, truth and tiles; everything that all variants share.

use super::truths::{PIXEL_SAMPLES, Truths};
use crate::error::CliError;
use crate::suite::Sampling;
use crate::views::{past_of, view_of};
use glam::Vec3;
use std::time::Instant;
use umbrage_frame::{Agreement, AgreementLimits, Anchors, Image, View};
use umbrage_metrics::{Coverage, PanelTruth, Region, TILE_PX, Tiling, counted};
use umbrage_reference::{Cache, Finder, PrimaryHits};
use umbrage_scene::{AreaLight, CameraPath, PathFrame, Scene};
use umbrage_shadows::{LightMap, Renderer};

/// What a window is made from.
pub(crate) struct Request<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) path: &'a CameraPath,
    pub(crate) first: u32,
    /// Numbers from a frame to the next.
    pub(crate) step: u32,
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
    /// At pixels alone, with truth as good as at anchors: frames of another engine.
    Elsewhere,
}

/// A window, ready for its variants.
pub(crate) struct Window {
    pub(crate) scene: String,
    pub(crate) path: String,
    pub(crate) first: u32,
    /// Numbers from a frame to the next.
    pub(super) step: u32,
    /// View and light of each frame.
    pub(crate) frames: Vec<(View, AreaLight)>,
    /// Per frame, the views of those before it, newest first, also from before the window.
    pub(super) pasts: Vec<Vec<View>>,
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
    pub(super) coverage: Coverage,
    pub(super) truth_secs: Option<f64>,
    pub(super) notes: Vec<String>,
}

/// What a scorecard says about a window.
pub(crate) struct Facts {
    pub(crate) scene: String,
    pub(crate) path: String,
    pub(crate) first: u32,
    pub(crate) frames: u32,
    /// Numbers from a frame to the next.
    pub(crate) step: u32,
    pub(crate) title: String,
    pub(crate) coverage: Coverage,
    pub(crate) tiles: usize,
    /// Hash over the cameras and the light of every frame.
    pub(crate) views: String,
    pub(crate) truth_secs: Option<f64>,
    pub(crate) notes: Vec<String>,
}

impl Window {
    /// Finds anchors, truth, agreement and tiles.
    pub(crate) fn new(
        request: &Request<'_>,
        (finder, cache, mut renderer): (&mut Finder<'_>, &Cache, Option<&mut Renderer<'_>>),
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
            let limits = AgreementLimits::default();
            let Some(renderer) = renderer.as_deref_mut() else {
                // Nobody else's surfaces are known: an anchor counts where truth sees it.
                let own = anchors.agreement(&tracer.primary(view).gbuffer, limits);
                agreements.push(own.clone());
                witnesses.push(Agreement { same: vec![true; own.same.len()], outside: 0, other_surface: 0 });
                continue;
            };
            let raster = renderer.gbuffer(view, light)?;
            agreements.push(anchors.agreement(&raster, limits));
            // What truth itself sees in this very frame; the middle one has been traced.
            witnesses.push(match index == frames.len() / 2 {
                true => anchors.agreement(&raster, limits),
                false => Anchors::of(&tracer.primary(view).gbuffer).agreement(&raster, limits),
            });
        }
        let (counts, coverage) = counted(&anchors, &facing, &agreements, &witnesses)?;
        let tiling = Tiling::new(&anchors, &truth, &counts, TILE_PX)?;
        let of = |wanted: fn(Region) -> bool| -> Vec<usize> {
            (0..anchors.len()).filter(|&p| wanted(tiling.regions[p])).collect()
        };
        let read = match request.readings {
            Readings::Anchored => None,
            // The pixel reading is scored in the penumbra alone.
            Readings::Both => Some((of(|r| r == Region::Penumbra), PIXEL_SAMPLES)),
            Readings::Elsewhere => Some((of(|r| r != Region::LeftOut), sampling.samples)),
        };
        let pixel_truth = read
            .filter(|_| frames.len() > 1)
            .map(|(wanted, samples)| truths.at_pixels(&frames, (&anchors, &truth, &wanted), samples))
            .transpose()?;
        let Truths { computed, mut notes, key, .. } = truths;
        notes.extend(renderer.and_then(|r| outside_map_note(&anchors, &r.light_map(&middle_light))));
        Ok(Self {
            scene: request.scene.name.clone(),
            path: request.path.name.clone(),
            first: request.first,
            step: request.step,
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

    /// Leaves more points out: those of a picture that says nothing there.
    pub(super) fn leave_out(&mut self, is_out: &[bool]) -> Result<(), CliError> {
        let counts: Vec<bool> = (0..self.anchors.len()).map(|p| self.is_counted(p) && !is_out[p]).collect();
        self.tiling = Tiling::new(&self.anchors, &self.truth, &counts, TILE_PX)?;
        self.coverage.counted = counts.iter().filter(|&&c| c).count();
        Ok(())
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
            step: self.step,
            title: path.title.clone(),
            coverage: self.coverage,
            tiles: self.tiling.tiles.iter().filter(|t| !t.penumbra.is_empty()).count(),
            views: self.views_hash(),
            truth_secs: self.truth_secs,
            notes: self.notes.clone(),
        }
    }
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
