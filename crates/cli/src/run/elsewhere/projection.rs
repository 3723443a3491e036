//! Do the cameras fit the frames? Asked before anything is scored: a wrong camera looks like a wrong shadow.
//!
//! What the frames show at a grid of pixels (depth where there is a channel of it, the shadow itself otherwise)
//! is compared with what truth shows from the cameras as given, and from cameras with each of the usual
//! mistakes. The cameras are refused where a mistake explains the frames clearly better than no mistake, or
//! where nothing does. Blind spot: a mistake that changes no pixel by more than the frames' own error.

use super::guesses::Guess;
use crate::error::CliError;
use crate::views::view_from;
use umbrage_frame::{Image, View};
use umbrage_reference::{Tracer, TruthSettings};
use umbrage_scene::{AreaLight, Camera};

/// What a frame shows.
pub(super) struct Shown {
    /// Its place in the list of cameras.
    pub(super) place: usize,
    pub(super) mask: Image<f32>,
    pub(super) depth: Option<Image<f32>>,
}

/// Most of the points of a frame that are compared: a tenth of a percent of them is several.
const POINTS: u32 = 6000;
/// Depths differ by so much of themselves: half floats round by 5e-4 of them. A field of view wrong by 1 % moves
/// a pixel at a picture's edge by 1 % of half its width, and the depth of a floor there by about as much.
const SAME_DEPTH: f32 = 2e-3;
/// Most of the points that may differ in depth (as for truth and raster, decision 0003): silhouettes make
/// far less.
const DEPTH_LIMIT: f64 = 0.02;
/// Below this nothing is wrong, whatever fits better: silhouettes.
const DEPTH_FINE: f64 = 2e-3;
/// A mistake explains frames better where it leaves less than this part of what is unexplained.
const BETTER: f64 = 0.6;
/// Shadows that are less alike than this (1 - correlation) do not show this scene.
const SHADOW_LIMIT: f64 = 0.7;
/// With cameras that are right, a shadow less alike than this is another light's.
const LIGHT_LIMIT: f64 = 0.5;
/// A correlation below -.3: lit and dark are exchanged.
const INVERTED: f64 = 1.3;
/// Below this nothing is wrong: the best real-time shadows leave about .01 on the standard scenes.
const SHADOW_FINE: f64 = 2e-3;
/// Fewer than this part of the points on a lit side of a surface say nothing.
const FEW: usize = 20;
/// A shadow that differs by less from point to point is none.
const VARIES: f32 = 0.02;
/// Farther is the sky, whatever number an engine writes for it.
const SKY: f32 = 1e9;

/// How well a guess explains the frames: a part that is not explained, from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Unexplained {
    part: f64,
    by_depth: bool,
}

/// What the check came to, in words.
pub(super) fn check(
    tracer: &Tracer,
    (light, size): (&AreaLight, (u32, u32)),
    shown: &[Shown],
    (given, guesses): (&[Camera], &[Guess]),
) -> Result<String, CliError> {
    let by_depth = shown.iter().all(|s| s.depth.as_ref().is_some_and(holds_depth));
    let asked = Asked { tracer, light, size, shown, by_depth };
    let own = Guess::none(given);
    let words = check_cameras(&asked, &own, guesses)?;
    if by_depth {
        // Depth knows nothing about the light.
        check_light(&Asked { by_depth: false, ..asked }, &own)?;
    }
    Ok(words)
}

fn check_cameras(asked: &Asked<'_>, own: &Guess, guesses: &[Guess]) -> Result<String, CliError> {
    let Some(as_given) = asked.unexplained(own, 0) else {
        return Ok(
            "the cameras could not be checked: nothing in the frames changes from point to point".into()
        );
    };
    let (fine, limit, what) = match as_given.by_depth {
        true => (DEPTH_FINE, DEPTH_LIMIT, "of the points have another depth"),
        false => (SHADOW_FINE, SHADOW_LIMIT, "short of truth's shadow (1 - correlation)"),
    };
    let said = |u: Unexplained| format!("{:.2} % {what}", 100.0 * u.part);
    if !as_given.by_depth && as_given.part > INVERTED {
        return Err(CliError::Projection(
            "the shadow is dark where truth is lit\n  help: 1 is fully lit, 0 is umbra: write 1 - v".into(),
        ));
    }
    if as_given.part <= fine {
        return Ok(format!("the cameras fit the frames: {}", said(as_given)));
    }
    // Each against no mistake in the same frames: one that shifts frames has none for the last.
    let tried = guesses.iter().filter_map(|g| {
        let none = if g.offset == 0 { as_given } else { asked.unexplained(own, g.offset)? };
        let found = asked.unexplained(g, g.offset)?;
        (found.part < BETTER * none.part && none.part > fine).then_some((g, found))
    });
    let best = tried.min_by(|a, b| a.1.part.total_cmp(&b.1.part));
    // A mistake may be named by its kind, and its amount be off: of depth, a field of view that is .2 % from the one
    // that was tried leaves many of a floor's points elsewhere. A shadow that is hardly explained names nothing.
    if let Some((guess, found)) = best
        && (as_given.by_depth || found.part < limit)
    {
        let message = format!("{}; {}, only {:.2} %", said(as_given), guess.words, 100.0 * found.part);
        return Err(CliError::Projection(format!("{message}\n  help: {}", guess.cure)));
    }
    if as_given.part > limit && as_given.by_depth && asked.holds_buffer_depth() {
        return Err(CliError::Projection(format!(
            "{}; all depths lie between 0 and 1\n  help: a depth buffer's values are no metres: write linear depth, or leave \
             the channel out",
            said(as_given)
        )));
    }
    if as_given.part > limit {
        return Err(CliError::Projection(format!(
            "{}, and no usual mistake explains it\n  help: check scene, light, scale and frame numbers; \
             --no-projection-check scores them all the same",
            said(as_given)
        )));
    }
    Ok(format!("the cameras fit the frames: {}, and no usual mistake explains more", said(as_given)))
}

struct Asked<'a> {
    tracer: &'a Tracer,
    light: &'a AreaLight,
    size: (u32, u32),
    shown: &'a [Shown],
    by_depth: bool,
}

/// Whether a picture of depth has any: some programs write an empty channel.
fn holds_depth(depth: &Image<f32>) -> bool {
    let seen = depth.pixels().iter().filter(|&&d| d > 0.0 && d < SKY).count();
    seen * FEW > depth.pixels().len()
}

/// Refuses a light whose shadow the frames do not show.
fn check_light(asked: &Asked<'_>, own: &Guess) -> Result<(), CliError> {
    match asked.unexplained(own, 0) {
        Some(shadow) if shadow.part > LIGHT_LIMIT => Err(CliError::Projection(format!(
            "the shadow in the frames is not this light's: {:.0} % short of truth's (1 - correlation)\n  \
             help: check --light: its direction or place is in the scene file's axes (y up); 1 is fully lit",
            100.0 * shadow.part
        ))),
        _ => Ok(()),
    }
}

impl Asked<'_> {
    /// Whether the frames show anything at all.
    fn varies(&self, grid: &[u32]) -> bool {
        let values = self.shown.iter().flat_map(|s| grid.iter().map(|&p| s.mask.pixels()[p as usize]));
        let (low, high) =
            values.filter(|v| v.is_finite()).fold((f32::MAX, f32::MIN), |(l, h), v| (l.min(v), h.max(v)));
        high - low > VARIES
    }

    /// Whether depths may be what a projection makes of them.
    fn holds_buffer_depth(&self) -> bool {
        let depths = self.shown.iter().filter_map(|s| s.depth.as_ref());
        depths.flat_map(|d| d.pixels()).all(|v| (0.0..=1.0).contains(v))
    }

    /// None where the frames are the same everywhere.
    fn unexplained(&self, guess: &Guess, offset: isize) -> Option<Unexplained> {
        let (width, height) = self.size;
        let step = ((f64::from(width) * f64::from(height) / f64::from(POINTS)).sqrt().ceil() as u32).max(1);
        let grid: Vec<u32> = (step / 2..height)
            .step_by(step as usize)
            .flat_map(|y| (step / 2..width).step_by(step as usize).map(move |x| y * width + x))
            .collect();
        let by_depth = self.by_depth;
        let (mut differ, mut all) = (0usize, 0usize);
        let mut pairs: Vec<[f64; 2]> = Vec::new();
        for shown in self.shown {
            let place = shown.place.checked_add_signed(guess.offset);
            let Some(camera) = place.and_then(|p| guess.cameras.get(p)) else { continue };
            if shown.place.checked_add_signed(offset).is_none_or(|p| p >= guess.cameras.len()) {
                continue;
            }
            let view = view_from(camera, self.size);
            let seen = |pixel: u32| guess.flipped(pixel, self.size);
            let (depths, points) = self.tracer.primary_some(&view, &grid);
            if let Some(depth) = shown.depth.as_ref().filter(|_| by_depth) {
                for (&pixel, &truth) in grid.iter().zip(&depths) {
                    let here = depth.pixels()[seen(pixel) as usize] * guess.depth_unit;
                    differ += usize::from(!same_depth(here, truth, &view, pixel));
                    all += 1;
                }
                continue;
            }
            let settings = TruthSettings { samples: 32, basis_samples: 0, ..TruthSettings::default() };
            let truth = self.tracer.truth(&points, self.light, &settings);
            let hits = grid.iter().zip(&depths).filter(|(_, d)| d.is_finite()).map(|(&p, _)| p);
            for ((pixel, &v), &facing) in hits.zip(&truth.mean).zip(&truth.facing) {
                let here = shown.mask.pixels()[seen(pixel) as usize];
                if facing && here.is_finite() {
                    pairs.push([f64::from(here), f64::from(v)]);
                }
            }
        }
        match by_depth {
            true if all == 0 => None,
            true => Some(Unexplained { part: differ as f64 / all as f64, by_depth }),
            false if !self.varies(&grid) => None,
            // What sees nothing explains nothing, and of a few points anything is true by chance.
            false if pairs.len() < grid.len() * self.shown.len() / FEW => {
                Some(Unexplained { part: 1.0, by_depth })
            }
            false => Some(Unexplained { part: 1.0 - correlation(&pairs).unwrap_or(0.0), by_depth }),
        }
    }
}

/// Linear depth, or the distance from the eye that some programs write.
fn same_depth(here: f32, truth: f32, view: &View, pixel: u32) -> bool {
    let nothing = |d: f32| !(d > 0.0 && d < SKY);
    if nothing(here) || nothing(truth) {
        return nothing(here) && nothing(truth);
    }
    let px = glam::Vec2::new((pixel % view.width) as f32 + 0.5, (pixel / view.width) as f32 + 0.5);
    let forward = -view.camera_from_world.row(2).truncate();
    let distance = truth / view.direction(px).dot(forward).max(1e-3);
    (here - truth).abs() <= SAME_DEPTH * truth || (here - distance).abs() <= SAME_DEPTH * distance
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
