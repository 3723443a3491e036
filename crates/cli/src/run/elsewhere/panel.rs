//! What frames say at the pixels that anchors fall into.

use super::Frames;
use super::frames::Subject;
use crate::error::CliError;
use crate::run::measure::{Measured, reduced};
use crate::run::window::Window;
use crate::run::{extras, pictures};
use umbrage_frame::{Image, NumberedFiles};
use umbrage_metrics::Panel;

/// A mean motion below this many pixels between frames leaves a hard shadow's picture as it was.
const MOVES: f32 = 1.0;

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
    let mut last: Vec<blake3::Hash> = Vec::new();
    for (frame, &number) in numbers.iter().enumerate() {
        let pixels = window.anchors.pixels_in(&window.frames[frame].0);
        let mut hashes = Vec::new();
        for take in &subject.takes {
            let mask = frames.mask(take, number)?.image;
            let value = |pixel: &Option<u32>| {
                // What is not counted may be anything.
                pixel.map(|p| mask.pixels()[p as usize]).filter(|v| v.is_finite()).unwrap_or(0.0)
            };
            panel.values.extend(pixels.iter().map(value));
            hashes.push(hash(&mask));
            if frame == window.middle() && shown.is_none() {
                shown = Some(mask);
            }
        }
        check_repeated(window, (frame, numbers), (subject, &last, &hashes))?;
        last = hashes;
    }
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

/// Two frames that are one picture, while the camera moves, or two takes that are one.
fn check_repeated(
    window: &Window,
    (frame, numbers): (usize, &[u32]),
    (subject, last, hashes): (&Subject, &[blake3::Hash], &[blake3::Hash]),
) -> Result<(), CliError> {
    let refuse = |take: usize, message: String| {
        Err(CliError::Frame { path: subject.takes[take].pattern.clone().into(), message })
    };
    if let Some(take) = (1..hashes.len()).find(|&t| hashes[..t].contains(&hashes[t])) {
        let message = format!(
            "frame {} is the same picture as in another take: takes must differ in noise",
            numbers[frame]
        );
        return refuse(take, message);
    }
    let repeated = hashes.iter().zip(last).position(|(now, before)| now == before);
    match repeated {
        Some(take) if motion(window, frame) > MOVES => refuse(
            take,
            format!(
                "frames {} and {} are the same picture, but the camera moves by {:.1} px between them",
                numbers[frame - 1],
                numbers[frame],
                motion(window, frame)
            ),
        ),
        _ => Ok(()),
    }
}

/// Mean motion of the anchors from the frame before, in pixels.
fn motion(window: &Window, frame: usize) -> f32 {
    let (before, now) = (&window.frames[frame - 1].0, &window.frames[frame].0);
    let moved = |&p: &glam::Vec3| Some(before.project(p)?.distance(now.project(p)?));
    let all: Vec<f32> = window.anchors.position.iter().filter_map(moved).collect();
    all.iter().sum::<f32>() / all.len().max(1) as f32
}

fn hash(mask: &Image<f32>) -> blake3::Hash {
    let mut hasher = blake3::Hasher::new();
    mask.pixels().iter().for_each(|v| {
        hasher.update(&v.to_bits().to_le_bytes());
    });
    hasher.finalize()
}
