//! What a variant said, and what is true, at the points of a window.

use crate::MetricsError;
use crate::error::expect_length;

/// What a variant said at each anchor, per frame and seed.
///
/// A variant without randomness has one seed: its noise is then 0 by definition, so a *stochastic*
/// variant must never be given with one seed.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Anchors.
    pub points: usize,
    /// Frames of the window (T).
    pub frames: usize,
    /// Pattern seeds per frame (S), independent between frames.
    pub seeds: usize,
    /// Visibility, 1 = fully lit, laid out `[(frame * seeds + seed) * points + point]`.
    pub values: Vec<f32>,
}

/// Truth at the points of a panel: two independent halves, and a third estimate for the projection.
#[derive(Clone, Debug, PartialEq)]
pub struct PanelTruth {
    /// 1 when nothing but the camera moves (anchored reading); T for a moving light or for pixels.
    pub frames: usize,
    /// Two independent estimates of visibility, each laid out `[frame * points + point]`.
    pub halves: [Vec<f32>; 2],
    /// A third independent estimate, per point, in the middle frame. Regions, profiles and the basis
    /// of the projection come from it, so that they share no noise with the halves.
    pub basis: Vec<f32>,
    /// Variance of the mean of the halves, per point, in the middle frame (for display).
    pub variance: Vec<f32>,
}

impl Panel {
    /// The value at a frame, seed and point.
    pub fn at(&self, frame: usize, seed: usize, point: usize) -> f32 {
        self.values[(frame * self.seeds + seed) * self.points + point]
    }

    /// One of its frames.
    ///
    /// # Panics
    /// When there is no such frame: a programming error, never a user's.
    pub fn frame(&self, frame: usize) -> Self {
        let length = self.seeds * self.points;
        let values = self.values[frame * length..][..length].to_vec();
        Self { frames: 1, values, ..*self }
    }

    /// Checks that the layout holds what the counts say.
    ///
    /// # Errors
    /// A count of zero or a wrong number of values.
    pub fn check(&self) -> Result<(), MetricsError> {
        if self.frames == 0 {
            return Err(MetricsError::Zero("frames of a panel"));
        }
        if self.seeds == 0 {
            return Err(MetricsError::Zero("seeds of a panel"));
        }
        expect_length("panel values", self.frames * self.seeds * self.points, self.values.len())
    }
}

impl PanelTruth {
    /// A half's value; a truth of one frame is the same in every frame.
    pub fn half(&self, which: usize, frame: usize, point: usize) -> f32 {
        let frame = if self.frames == 1 { 0 } else { frame };
        self.halves[which][frame * self.basis.len() + point]
    }

    /// One of its frames; all there is of a truth of one frame.
    pub fn frame(&self, frame: usize) -> Self {
        let length = self.basis.len();
        let start = if self.frames == 1 { 0 } else { frame * length };
        let halves = [0, 1].map(|half| self.halves[half][start..start + length].to_vec());
        Self { frames: 1, halves, basis: self.basis.clone(), variance: self.variance.clone() }
    }

    /// Mean of the halves over the frames, at a point.
    pub fn mean(&self, point: usize) -> f64 {
        let sum: f64 = (0..self.frames)
            .map(|t| f64::from(self.half(0, t, point)) + f64::from(self.half(1, t, point)))
            .sum();
        sum / (2 * self.frames) as f64
    }

    /// Checks that it fits `points` points.
    ///
    /// # Errors
    /// A wrong number of values.
    pub fn check(&self, points: usize) -> Result<(), MetricsError> {
        if self.frames == 0 {
            return Err(MetricsError::Zero("frames of a truth"));
        }
        expect_length("first half of the truth", self.frames * points, self.halves[0].len())?;
        expect_length("second half of the truth", self.frames * points, self.halves[1].len())?;
        expect_length("basis of the truth", points, self.basis.len())?;
        expect_length("variance of the truth", points, self.variance.len())
    }
}
