//! The picture beside a claim: where A and B differ most.

use super::judge::{Judged, Shown};
use super::measurements::Measurements;
use umbrage_frame::Image;
use umbrage_report::{Crop, CropPanel};

/// Size of a crop in pixels.
const SIZE: (u32, u32) = (96, 54);
/// Between tried places: fine enough to centre a crop, coarse enough to be quick.
const STEP: usize = 8;

/// The crop of a claim: that of its first part that has pictures.
pub(crate) fn crops(parts: &[Judged], measured: &Measurements) -> Option<Crop> {
    parts.iter().find_map(|part| {
        let (a, b) = part.shown.as_ref()?;
        crop(&part.card.says, (a, b.as_ref()), measured)
    })
}

fn crop(says: &str, (a, b): (&Shown, Option<&Shown>), measured: &Measurements) -> Option<Crop> {
    let truth = |shown: &Shown| measured.places.get(&shown.0).map(|p| &p.truth);
    let mask = |shown: &Shown| measured.mask(&shown.0, &shown.1);
    let (truth_a, mask_a) = (truth(a)?, mask(a)?);
    // Beside the truth alone, or a B of another view, A's own error says where to look.
    let seen_alike = |b: &&Shown| b.0.ground() == a.0.ground();
    let rival = b.filter(seen_alike).and_then(mask).unwrap_or(truth_a);
    let corner = most_different(truth_a, mask_a, rival)?;
    let place = a.0.label();
    let mut panels =
        vec![panel("truth".into(), truth_a, truth_a, corner), panel(a.1.clone(), mask_a, truth_a, corner)];
    if let Some(b) = b {
        let (truth_b, mask_b) = (truth(b)?, mask(b)?);
        let corner = if seen_alike(&b) { corner } else { most_different(truth_b, mask_b, truth_b)? };
        let elsewhere = b.0 != a.0;
        let label =
            |what: &str| if elsewhere { format!("{what} ({})", b.0.label()) } else { what.to_string() };
        if elsewhere {
            panels.push(panel(label("truth"), truth_b, truth_b, corner));
        }
        panels.push(panel(label(&b.1), mask_b, truth_b, corner));
    }
    let caption = format!("{place}, pixel {} {}, magnified three times: {says}", corner.0, corner.1);
    Some(Crop { panels, caption })
}

/// The corner of the crop with the largest sum of |a - b| over what counts.
fn most_different(truth: &Image<f32>, a: &Image<f32>, b: &Image<f32>) -> Option<(u32, u32)> {
    let (width, height) = (SIZE.0.min(truth.width()), SIZE.1.min(truth.height()));
    let difference = |x: u32, y: u32| match truth.at(x, y).is_nan() {
        true => 0.0,
        false => f64::from((a.at(x, y) - b.at(x, y)).abs()),
    };
    let sum = |&(left, top): &(u32, u32)| -> f64 {
        (top..top + height).flat_map(|y| (left..left + width).map(move |x| difference(x, y))).sum()
    };
    let steps = |end: u32| (0..=end).step_by(STEP);
    let corners =
        steps(truth.height() - height).flat_map(|y| steps(truth.width() - width).map(move |x| (x, y)));
    let scored = corners.map(|corner| (sum(&corner), corner));
    scored.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, corner)| corner)
}

/// A cut-out; hatched where nothing counts.
fn panel(label: String, plane: &Image<f32>, truth: &Image<f32>, (left, top): (u32, u32)) -> CropPanel {
    let (width, height) = (SIZE.0.min(plane.width()), SIZE.1.min(plane.height()));
    let value = |x: u32, y: u32| match truth.at(left + x, top + y).is_nan() {
        true => f32::NAN,
        false => *plane.at(left + x, top + y),
    };
    CropPanel { label, plane: Image::from_fn(width, height, value) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_crop_lies_where_the_two_differ() {
        let truth = Image::filled(320, 180, 1.0);
        let a = truth.clone();
        let b = Image::from_fn(320, 180, |x, y| {
            if (200..210).contains(&x) && (100..110).contains(&y) { 0.0 } else { 1.0 }
        });
        let (x, y) = most_different(&truth, &a, &b).expect("a corner");
        assert!((114..=200).contains(&x) && (56..=100).contains(&y), "{x} {y}");
        let none = Image::filled(320, 180, f32::NAN);
        assert_eq!(
            most_different(&none, &a, &b),
            most_different(&none, &a, &a),
            "what does not count has no say"
        );
    }
}
