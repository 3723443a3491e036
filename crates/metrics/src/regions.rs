//! Penumbra, umbra and lit, from the truth; what was left out, and how much.

use crate::error::expect_length;
use crate::{MetricsError, PanelTruth};
use serde::{Deserialize, Serialize};
use umbrage_frame::{Agreement, Anchors};

/// Where a point of the panel lies in the true shadow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Region {
    /// 1/512 < g < 511/512, and one pixel around.
    Penumbra,
    /// The rest of the points with g at most 1/512.
    Umbra,
    /// The rest: g at least 511/512.
    Lit,
    /// Faces away from the light, or is not the same surface in every frame.
    LeftOut,
}

/// Below this visibility a point is dark, above its complement it is lit: 1 of 512 samples, half of
/// what one sample of the smallest allowed basis (1024) can say.
const EDGE: f32 = 1.0 / 512.0;

/// The region of every point. A point that the light's motion takes from lit to umbra is penumbra.
///
/// # Errors
/// Inputs that are not about the same points, or a truth that is not finite where it counts.
pub(crate) fn regions(
    anchors: &Anchors,
    truth: &PanelTruth,
    counted: &[bool],
) -> Result<Vec<Region>, MetricsError> {
    truth.check(anchors.len())?;
    expect_length("counted points", anchors.len(), counted.len())?;
    let mut raw = Vec::with_capacity(anchors.len());
    for (point, &counts) in counted.iter().enumerate() {
        raw.push(if counts { undilated(truth, point)? } else { Region::LeftOut });
    }
    let near = dilated(anchors, &raw);
    let grown = raw.iter().zip(&anchors.pixel).map(|(&region, &pixel)| {
        let joins = region != Region::LeftOut && near[pixel as usize];
        if joins { Region::Penumbra } else { region }
    });
    Ok(grown.collect())
}

fn undilated(truth: &PanelTruth, point: usize) -> Result<Region, MetricsError> {
    let (mut low, mut high) = (truth.basis[point], truth.basis[point]);
    for frame in 0..truth.frames {
        let [a, b] = [0, 1].map(|half| truth.half(half, frame, point));
        if !(a.is_finite() && b.is_finite() && low.is_finite()) {
            return Err(MetricsError::NotFinite { what: "the truth", frame, seed: 0, point });
        }
        if truth.frames > 1 {
            (low, high) = (low.min(0.5 * (a + b)), high.max(0.5 * (a + b)));
        }
    }
    Ok(if high <= EDGE {
        Region::Umbra
    } else if low >= 1.0 - EDGE {
        Region::Lit
    } else {
        Region::Penumbra
    })
}

/// Which pixels of the middle frame are penumbra or touch it, corners included.
fn dilated(anchors: &Anchors, raw: &[Region]) -> Vec<bool> {
    let (width, height) = (anchors.view.width as usize, anchors.view.height as usize);
    let mut near = vec![false; width * height];
    for (&pixel, _) in anchors.pixel.iter().zip(raw).filter(|&(_, &region)| region == Region::Penumbra) {
        let (x, y) = (pixel as usize % width, pixel as usize / width);
        for row in y.saturating_sub(1)..=(y + 1).min(height - 1) {
            let start = row * width;
            near[start + x.saturating_sub(1)..=start + (x + 1).min(width - 1)].fill(true);
        }
    }
    near
}

/// How much of the picture was scored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Coverage {
    /// Pixels of the middle frame.
    pub pixels: usize,
    /// Anchors: those that see a surface.
    pub anchors: usize,
    /// Anchors that face the light.
    pub facing: usize,
    /// Anchors that face the light and are the same surface in every frame: these count.
    pub counted: usize,
    /// Anchors inside the picture, summed over the frames.
    pub inside: usize,
    /// Of those, the ones hidden behind another surface: parallax, not disagreement.
    pub hidden: usize,
    /// Surfaces that truth's own camera rays hit, summed over the frames.
    pub seen: usize,
    /// Of those, the ones where the raster pipeline sees another surface in the same frame.
    pub disagreeing: usize,
}

impl Coverage {
    /// Counted anchors over the anchors that face the light, 0 to 1 (0 when none does).
    pub fn share(&self) -> f64 {
        self.counted as f64 / self.facing.max(1) as f64
    }

    /// Counted anchors over the pixels of the picture, 0 to 1.
    pub fn picture(&self) -> f64 {
        self.counted as f64 / self.pixels.max(1) as f64
    }

    /// Hidden anchors over the anchors inside the picture, over all frames, 0 to 1.
    pub fn occlusion(&self) -> f64 {
        self.hidden as f64 / self.inside.max(1) as f64
    }

    /// Where the two witnesses see different surfaces in one and the same frame, over what truth
    /// sees, 0 to 1: silhouettes, or a wrong matrix.
    pub fn disagreement(&self) -> f64 {
        self.disagreeing as f64 / self.seen.max(1) as f64
    }
}

/// Which anchors count (they face the light, and every frame's raster sees the same surface), and
/// how many were lost to what. `agreements` are those of the anchors, `witnesses` those of each
/// frame's own camera rays, with the same frame's raster.
///
/// # Errors
/// Inputs that are not about the same anchors.
pub fn counted(
    anchors: &Anchors,
    facing: &[bool],
    agreements: &[Agreement],
    witnesses: &[Agreement],
) -> Result<(Vec<bool>, Coverage), MetricsError> {
    expect_length("anchors that face the light", anchors.len(), facing.len())?;
    let mut counts = facing.to_vec();
    let mut coverage = Coverage {
        pixels: anchors.view.width as usize * anchors.view.height as usize,
        anchors: anchors.len(),
        facing: facing.iter().filter(|&&f| f).count(),
        counted: 0,
        inside: 0,
        hidden: 0,
        seen: witnesses.iter().map(|w| w.same.len()).sum(),
        disagreeing: witnesses.iter().map(|w| w.other_surface).sum(),
    };
    for agreement in agreements {
        expect_length("anchors of an agreement", anchors.len(), agreement.same.len())?;
        counts.iter_mut().zip(&agreement.same).for_each(|(count, &same)| *count &= same);
        coverage.inside += anchors.len() - agreement.outside;
        coverage.hidden += agreement.other_surface;
    }
    coverage.counted = counts.iter().filter(|&&c| c).count();
    Ok((counts, coverage))
}
