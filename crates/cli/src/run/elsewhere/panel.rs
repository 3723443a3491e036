//! What frames say at the pixels that anchors fall into.

use super::Frames;
use super::frames::Subject;
use crate::error::CliError;
use crate::run::measure::{Measured, reduced};
use crate::run::window::Window;
use crate::run::{extras, pictures};
use umbrage_frame::{Image, NumberedFiles};
use umbrage_metrics::{Panel, Region};

/// A mean motion below this many pixels between frames leaves a hard shadow's picture as it was.
const MOVES: f32 = 1.0;
/// A soft shadow's picture changes somewhere with any motion that can be seen: over a penumbra of ten pixels a twentieth of one is
/// .005, more than a step of 8 bits.
const MOVES_SOFT: f32 = 0.05;
/// Pixels of half shadow that make a picture soft.
const SOFT: usize = 100;
/// Fully lit points are lit: a median farther from 1 is another scale, of a ratio another exposure. Steps of 8 bits near white are
/// .009 of light through sRGB's curve, so that twice as much is no rounding.
const LIT_NOTED: f32 = 0.02;
/// A seventh of a stop: pictures of one exposure have a ratio of 1 where nothing is hidden. A mask is never refused for it: acne may
/// darken what is lit, which is a score's to tell.
const LIT_REFUSED: f32 = 0.1;
/// Fewer lit points say nothing.
const FEWEST_LIT: usize = 100;
/// An integer format that shows fewer levels between umbra and light makes bands that are seen.
const FEW_LEVELS: usize = 32;

/// Takes the points out of the window where a ratio of pictures says nothing (no light to be in shadow of).
pub(super) fn leave_out_the_undefined(
    window: &mut Window,
    (frames, numbers): (&Frames, &[u32]),
) -> Result<(), CliError> {
    if frames.unshadowed.is_none() {
        return Ok(());
    }
    let mut is_out = vec![false; window.anchors.len()];
    let takes: Vec<&NumberedFiles> = frames.subjects.iter().filter_map(|s| s.takes.first()).collect();
    for (frame, &number) in numbers.iter().enumerate() {
        let pixels = window.anchors.pixels_in(&window.frames[frame].0);
        // Without shadows all subjects have the same light.
        for take in takes.iter().take(1) {
            let mask = frames.mask(take, number)?.image;
            for (out, pixel) in is_out.iter_mut().zip(&pixels) {
                *out |= pixel.is_some_and(|p| !mask.pixels()[p as usize].is_finite());
            }
        }
    }
    let lost = (0..is_out.len()).filter(|&p| is_out[p] && window.is_counted(p)).count();
    if lost > 0 {
        window.notes.push(format!("{lost} points are left out: without shadows they have no light"));
    }
    window.leave_out(&is_out)
}

/// Reads a subject's frames and reduces them.
pub(super) fn measure(
    window: &mut Window,
    (frames, numbers): (&Frames, &[u32]),
    subject: &Subject,
) -> Result<Measured, CliError> {
    let points = window.anchors.len();
    let (count, seeds) = (numbers.len(), subject.takes.len());
    let mut panel =
        Panel { points, frames: count, seeds, values: Vec::with_capacity(points * count * seeds) };
    let mut shown = None;
    let mut before: Vec<Hashes> = Vec::new();
    for (frame, &number) in numbers.iter().enumerate() {
        let pixels = window.anchors.pixels_in(&window.frames[frame].0);
        let (mut hashes, mut is_soft) = (Vec::new(), false);
        for take in &subject.takes {
            let mask = frames.mask(take, number)?.image;
            let value = |pixel: &Option<u32>| {
                // What is not counted may be anything.
                pixel.map(|p| mask.pixels()[p as usize]).filter(|v| v.is_finite()).unwrap_or(0.0)
            };
            panel.values.extend(pixels.iter().map(value));
            hashes.push(hash(&mask));
            is_soft |= mask.pixels().iter().filter(|v| (0.02..0.98).contains(*v)).count() >= SOFT;
            if frame == window.middle() && shown.is_none() {
                shown = Some(mask);
            }
        }
        let moves = if is_soft { MOVES_SOFT } else { MOVES };
        check_repeated(window, (frame, numbers, moves), (subject, &before, &hashes))?;
        before.push(hashes);
    }
    check_lit(window, (frames, numbers), (subject, &panel))?;
    let truth = window.pixel_truth.as_ref().unwrap_or(&window.truth);
    let middle = window.middle();
    let sharp = (panel.frame(middle), window.truth.frame(middle));
    let (mut numbers, maps) = reduced(window, &panel, (truth, (&sharp.0, &sharp.1)))?;
    if seeds == 1 && !frames.deterministic {
        // How much one take varies nobody knows: a gate must not take it for nothing.
        numbers.spread = None;
    }
    // A window has at least one frame.
    let shown = shown.unwrap_or_else(|| Image::filled(frames.size.0, frames.size.1, 0.0));
    let shown = shown.map(|v| if v.is_finite() { *v } else { 0.0 });
    numbers.extras.extend(extras::of_picture(window, &shown));
    if let Some(note) = few_levels(frames, &shown) {
        window.notes.push(format!("{}: {note}", subject.name));
    }
    let floor = frames.quantisation(panel.values.iter().copied());
    if let Some(floor) = floor {
        window.notes.push(format!(
            "{}: {} bits make an error of {floor:.2e} by themselves; banding and swimming of that size are the format's",
            subject.name,
            frames.bits.unwrap_or_default()
        ));
    }
    let mut pictures = pictures::variant(window, shown, &maps);
    pictures.series = pictures::series_of(window, &panel);
    Ok(Measured { numbers, pictures })
}

/// Hashes of a frame's takes; none of a picture that is the same everywhere.
type Hashes = Vec<Option<blake3::Hash>>;

/// Two frames of a window that are one picture, while the camera moves, or two takes that are one.
fn check_repeated(
    window: &Window,
    (frame, numbers, moves): (usize, &[u32], f32),
    (subject, before, hashes): (&Subject, &[Hashes], &Hashes),
) -> Result<(), CliError> {
    let refuse = |take: usize, message: String| {
        Err(CliError::Frame { path: subject.takes[take].pattern.clone().into(), message })
    };
    if let Some(take) = (1..hashes.len()).find(|&t| hashes[t].is_some() && hashes[..t].contains(&hashes[t])) {
        let message = format!(
            "frame {} is the same picture as in another take: takes must differ in noise",
            numbers[frame]
        );
        return refuse(take, message);
    }
    for (earlier, others) in before.iter().enumerate() {
        let same = hashes.iter().zip(others).position(|(now, then)| now.is_some() && now == then);
        let Some(take) = same else { continue };
        let motion = motion(window, (earlier, frame));
        if motion > moves {
            let message = format!(
                "frames {} and {} are the same picture, but the camera moves by {motion:.2} px between them: write each frame \
                 anew",
                numbers[earlier], numbers[frame]
            );
            return refuse(take, message);
        }
    }
    Ok(())
}

/// Mean motion of the anchors between two frames, in pixels.
fn motion(window: &Window, (before, now): (usize, usize)) -> f32 {
    let (before, now) = (&window.frames[before].0, &window.frames[now].0);
    let moved = |&p: &glam::Vec3| Some(before.project(p)?.distance(now.project(p)?));
    let all: Vec<f32> = window.anchors.position.iter().filter_map(moved).collect();
    all.iter().sum::<f32>() / all.len().max(1) as f32
}

/// What truth says is fully lit shows the scale of a mask, and of a ratio whether its pictures are of one exposure.
fn check_lit(
    window: &mut Window,
    (frames, numbers): (&Frames, &[u32]),
    (subject, panel): (&Subject, &Panel),
) -> Result<(), CliError> {
    let lit = (0..panel.points).filter(|&p| window.tiling.regions[p] == Region::Lit);
    let all = lit.flat_map(|p| (0..panel.frames).map(move |f| f * panel.points * panel.seeds + p));
    let mut values: Vec<f32> = all.filter_map(|i| panel.values.get(i).copied()).collect();
    if values.len() < FEWEST_LIT {
        return Ok(());
    }
    values.sort_unstable_by(f32::total_cmp);
    let median = values[values.len() / 2];
    if (median - 1.0).abs() <= LIT_NOTED {
        return Ok(());
    }
    let ratio = frames.unshadowed.is_some();
    let cause = if ratio {
        "--unshadowed or --ambient of another exposure or frame"
    } else {
        "a mask of another scale"
    };
    let message = format!(
        "frames {} to {}: points that are fully lit have a median of {median:.3}, not 1: {cause}?",
        numbers[0],
        numbers[numbers.len() - 1]
    );
    if ratio && (median - 1.0).abs() > LIT_REFUSED {
        return Err(CliError::Frame { path: subject.takes[0].pattern.clone().into(), message });
    }
    window.notes.push(format!("{}: {message}", subject.name));
    Ok(())
}

/// Of an integer format, how few levels a penumbra has.
fn few_levels(frames: &Frames, shown: &Image<f32>) -> Option<String> {
    frames.bits?;
    let between = shown.pixels().iter().filter(|v| (0.01..0.99).contains(*v));
    let levels: std::collections::BTreeSet<u32> = between.map(|v| v.to_bits()).collect();
    (!levels.is_empty() && levels.len() < FEW_LEVELS)
        .then(|| format!("only {} levels between umbra and light: its bands are the format's", levels.len()))
}

/// Nothing of a picture that is the same everywhere: it may be right in every frame.
fn hash(mask: &Image<f32>) -> Option<blake3::Hash> {
    let first = mask.pixels().first()?;
    if mask.pixels().iter().all(|v| v == first) {
        return None;
    }
    let mut hasher = blake3::Hasher::new();
    mask.pixels().iter().for_each(|v| {
        hasher.update(&v.to_bits().to_le_bytes());
    });
    Some(hasher.finalize())
}
