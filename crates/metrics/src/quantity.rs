//! The quantities that can be pooled, bootstrapped and paired from tile tables.

use crate::bootstrap::Stratum;
use crate::{Missing, TileRow, TileTable};
use serde::{Deserialize, Serialize};

/// A number made from the sums of tiles. Units are visibility (0 to 1) or its square.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Root of [`Quantity::Mse`].
    Error,
    /// Mean squared error in the penumbra: the sum of the five cells.
    Mse,
    /// The structured row: static bands and crawling ones.
    Banding,
    /// The moving column: smooth swim and crawling bands.
    Swimming,
    /// What differs between seeds.
    Noise,
    /// Smooth bias that stands still.
    SmoothStatic,
    /// Smooth bias that moves.
    SmoothMoving,
    /// Bands that stand still.
    StructuredStatic,
    /// Bands that crawl.
    StructuredMoving,
    /// Mean visibility in the umbra.
    LightLeak,
    /// Mean darkness in full light.
    FalseShadow,
    /// Share of the squared error that lies outside the penumbra.
    OutsideShare,
    /// MSSD / (2 M): 0 = slow drift, 1 = white, 2 = two-frame flicker.
    VonNeumann,
    /// The truth's own noise.
    ReferenceNoise,
    /// Functions over points of the projection.
    BasisShare,
}

// Places in the vector of sums that is pooled and resampled.
const POINTS: usize = 0;
const UMBRA: usize = 1;
const LIT: usize = 2;
const SMOOTH_STATIC: usize = 3;
const SMOOTH_MOVING: usize = 4;
const STRUCTURED_STATIC: usize = 5;
const STRUCTURED_MOVING: usize = 6;
const NOISE: usize = 7;
const SQUARED: usize = 8;
const LEAK: usize = 9;
const FALSE_SHADOW: usize = 10;
const OUTSIDE: usize = 11;
const SUCCESSIVE: usize = 12;
const REFERENCE: usize = 13;
const FUNCTIONS: usize = 14;
/// Length of that vector.
pub(crate) const SUMS: usize = 15;

/// The sums of one tile.
pub(crate) fn sums(tile: &TileRow) -> Vec<f64> {
    let mut sums = vec![0.0; SUMS];
    sums[POINTS] = f64::from(tile.points);
    sums[UMBRA] = f64::from(tile.umbra.points);
    sums[LIT] = f64::from(tile.lit.points);
    sums[SMOOTH_STATIC] = tile.smooth.fixed;
    sums[SMOOTH_MOVING] = tile.smooth.moving;
    sums[STRUCTURED_STATIC] = tile.structured.fixed;
    sums[STRUCTURED_MOVING] = tile.structured.moving;
    sums[NOISE] = tile.smooth.noise + tile.structured.noise;
    sums[SQUARED] = tile.squared;
    sums[LEAK] = tile.umbra.wrong;
    sums[FALSE_SHADOW] = tile.lit.wrong;
    sums[OUTSIDE] = tile.umbra.squared + tile.lit.squared;
    sums[SUCCESSIVE] = tile.successive;
    sums[REFERENCE] = tile.reference;
    sums[FUNCTIONS] = f64::from(tile.functions);
    sums
}

/// The clusters of a window.
pub(crate) fn stratum(table: &TileTable, cluster_tiles: u32) -> Stratum {
    Stratum::new(SUMS, table.tiles.iter().map(|t| (t.column, t.row, sums(t))), cluster_tiles)
}

impl Quantity {
    /// All, in display order.
    pub const ALL: [Self; 15] = [
        Self::Error,
        Self::Mse,
        Self::Banding,
        Self::Swimming,
        Self::Noise,
        Self::SmoothStatic,
        Self::SmoothMoving,
        Self::StructuredStatic,
        Self::StructuredMoving,
        Self::LightLeak,
        Self::FalseShadow,
        Self::OutsideShare,
        Self::VonNeumann,
        Self::ReferenceNoise,
        Self::BasisShare,
    ];

    /// The metric's id in the registry.
    pub fn id(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Mse => "mse",
            Self::Banding => "banding",
            Self::Swimming => "swimming",
            Self::Noise => "noise",
            Self::SmoothStatic => "smooth_static",
            Self::SmoothMoving => "smooth_moving",
            Self::StructuredStatic => "structured_static",
            Self::StructuredMoving => "structured_moving",
            Self::LightLeak => "light_leak",
            Self::FalseShadow => "false_shadow",
            Self::OutsideShare => "outside_share",
            Self::VonNeumann => "von_neumann",
            Self::ReferenceNoise => "reference_noise",
            Self::BasisShare => "basis_share",
        }
    }

    /// The quantity of these windows' sums: the mean over windows of each window's value, or
    /// for what lies outside the penumbra the value of all windows' points together. NaN where
    /// no window has points of its region.
    pub(crate) fn value(self, windows: &[Vec<f64>]) -> f64 {
        let mean = |slots: &[usize]| self.mean(windows, slots);
        let total = |slot: usize| windows.iter().map(|w| w[slot]).sum::<f64>();
        match self {
            Self::Error => mean(&[SQUARED]).max(0.0).sqrt(),
            Self::Mse => mean(&[SQUARED]),
            Self::Banding => mean(&[STRUCTURED_STATIC, STRUCTURED_MOVING]),
            Self::Swimming => mean(&[SMOOTH_MOVING, STRUCTURED_MOVING]),
            Self::Noise => mean(&[NOISE]),
            Self::SmoothStatic => mean(&[SMOOTH_STATIC]),
            Self::SmoothMoving => mean(&[SMOOTH_MOVING]),
            Self::StructuredStatic => mean(&[STRUCTURED_STATIC]),
            Self::StructuredMoving => mean(&[STRUCTURED_MOVING]),
            // Over all points: a window whose umbra is seven pixels must not outweigh the others.
            Self::LightLeak => total(LEAK) / total(UMBRA),
            Self::FalseShadow => total(FALSE_SHADOW) / total(LIT),
            Self::OutsideShare => total(OUTSIDE) / (total(OUTSIDE) + total(SQUARED)),
            Self::VonNeumann => mean(&[SUCCESSIVE]) / (2.0 * mean(&[SMOOTH_MOVING, STRUCTURED_MOVING])),
            Self::ReferenceNoise => mean(&[REFERENCE]),
            Self::BasisShare => mean(&[FUNCTIONS]),
        }
    }

    fn mean(self, windows: &[Vec<f64>], slots: &[usize]) -> f64 {
        let weight = self.weight();
        let of_window = |w: &Vec<f64>| slots.iter().map(|&s| w[s]).sum::<f64>() / w[weight];
        let seen: Vec<f64> = windows.iter().filter(|w| w[weight] > 0.0).map(of_window).collect();
        seen.iter().sum::<f64>() / seen.len() as f64
    }

    /// The sum that counts this quantity's points.
    fn weight(self) -> usize {
        match self {
            Self::LightLeak => UMBRA,
            Self::FalseShadow => LIT,
            _ => POINTS,
        }
    }

    /// The sums of which a cluster must have one to say anything about this quantity.
    pub(crate) fn seen_by(self) -> &'static [usize] {
        match self {
            Self::LightLeak => &[UMBRA],
            Self::FalseShadow => &[LIT],
            Self::OutsideShare => &[POINTS, UMBRA, LIT],
            _ => &[POINTS],
        }
    }

    /// Why these tables cannot give this quantity, if they cannot.
    pub(crate) fn missing(self, tables: &[&TileTable]) -> Option<Missing> {
        let points = |of: fn(&TileRow) -> u32| tables.iter().flat_map(|t| &t.tiles).any(|tile| of(tile) > 0);
        let one_frame = tables.iter().any(|t| t.frames < 2);
        match self {
            Self::LightLeak => (!points(|t| t.umbra.points)).then_some(Missing::NoUmbra),
            Self::FalseShadow => (!points(|t| t.lit.points)).then_some(Missing::NoLit),
            _ if !points(|t| t.points) => Some(Missing::NoPenumbra),
            Self::Swimming | Self::SmoothMoving | Self::StructuredMoving | Self::VonNeumann if one_frame => {
                Some(Missing::OneFrame)
            }
            _ => None,
        }
    }
}
