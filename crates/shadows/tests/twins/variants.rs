//! Twin of every variant: what a receiver may be told, given the targets that came before.

use super::approx::Approx;
use super::light::{Law, Light};
use super::map::{Lit, Map};
use super::pattern::Pattern;
use super::screen::{Receiver, fetched};
use umbrage_frame::Image;
use umbrage_shadows::{Bias, Calibration};

/// Everything that a variant's last pass may read.
pub(crate) struct Twin<'a> {
    pub(crate) light: &'a Light,
    pub(crate) calibration: Calibration,
    pub(crate) bias: Bias,
    pub(crate) pattern: Pattern,
    /// The shadow map.
    pub(crate) depths: &'a Image<f32>,
    /// The blurred penumbra mask or minimum map.
    pub(crate) source: Option<&'a Image<f32>>,
}

/// What may come out: any of these, or anything (`None`: too much is open).
pub(crate) type Answer = Option<Vec<Lit>>;

/// Taps of searches and filters, and the largest radius of the mask over that of the filter.
const SEARCH_TAPS: u32 = 32;
const FILTER_TAPS: u32 = 16;
const MASK_SEARCH_SCALE: f64 = 1.2;
/// Pixels per mask texel, and its levels as printed.
pub(crate) const MASK_STEP: u32 = 4;
const MASK_LEVELS: f64 = 255.0;

impl Twin<'_> {
    fn map(&self) -> Map<'_> {
        Map { light: self.light, depths: self.depths, bias: self.bias }
    }

    fn law(&self) -> Law<'_> {
        Law { light: self.light, calibration: self.calibration }
    }

    /// The angle of the pattern at a place; `None` where the pixel itself is open.
    fn angle(&self, place: [Approx; 2]) -> Option<Approx> {
        let [columns, rows] = place.map(Approx::floors);
        if columns.clone().count() > 1 || rows.clone().count() > 1 {
            return None;
        }
        let turns = self.pattern.turns([*columns.start() as u32, *rows.start() as u32]);
        Some(Approx::constant(std::f64::consts::TAU) * turns)
    }

    /// What the variant of this name says about a receiver.
    pub(crate) fn shade(&self, name: &str, receiver: &Receiver) -> Answer {
        let Some(point) = self.light.point((receiver.position, receiver.normal), &self.bias) else {
            return Some(vec![Lit { low: 1.0, high: 1.0, open: 0 }]);
        };
        let (map, law, z) = (self.map(), self.law(), point.depth);
        let disc = |radius, angle| map.disc(&point, (radius, angle), FILTER_TAPS);
        let still = Approx::exact(0.0);
        let one = match name {
            "hard" => map.nearest(&point, [still; 2]),
            "pcf-grid-11" => {
                // A texel as printed; light-matched, the grid's half-side is the fixed radius.
                let step = match self.calibration {
                    Calibration::AsPrinted => Approx::exact(1.0) / Approx::exact(self.light.texels.into()),
                    Calibration::LightMatched => law.fixed(z) / Approx::exact(5.0),
                };
                map.grid(&point, step, 11)
            }
            "pcf-vogel-16" => disc(law.fixed(z), still),
            "pcf-vogel-16-ign" => disc(law.fixed(z), self.angle(receiver.place)?),
            "chss" => {
                let angle = self.angle(receiver.place)?;
                let blockers = map.blockers(&point, (law.search(z), angle), SEARCH_TAPS)?;
                let radius = |b: Option<Approx>| b.map_or(still, |b| law.kernel(z, b));
                return Some(blockers.into_iter().map(|b| disc(radius(b), angle)).collect());
            }
            "chss-mask" => {
                let step = Approx::exact(MASK_STEP.into());
                let radius = fetched(self.source?, receiver.place.map(|c| c / step));
                disc(radius, self.angle(receiver.place)?)
            }
            "chss-min" => {
                let source = self.source?;
                let size = [source.width(), source.height()].map(|c| Approx::exact(c.into()));
                let nearest = fetched(source, [point.uv[0] * size[0], point.uv[1] * size[1]]);
                disc(law.kernel(z, nearest.min(z)), self.angle(receiver.place)?)
            }
            _ => panic!("{name} has no twin: write one"),
        };
        Some(vec![one])
    }

    /// What the penumbra mask may hold for the receiver of one of its texels: radii in map widths.
    pub(crate) fn mask(&self, receiver: Option<&Receiver>, texel: [u32; 2]) -> Option<Vec<Approx>> {
        let nothing = Approx::exact(0.0);
        let Some(receiver) = receiver else { return Some(vec![nothing]) };
        let Some(point) = self.light.point((receiver.position, receiver.normal), &self.bias) else {
            return Some(vec![nothing]);
        };
        let (law, z) = (self.law(), point.depth);
        let angle = self.angle(texel.map(|c| Approx::exact(f64::from(c) + 0.5)))?;
        let wide = Approx::constant(MASK_SEARCH_SCALE) * law.search(z);
        let blockers = self.map().blockers(&point, (wide, angle), SEARCH_TAPS)?;
        let radii = blockers.into_iter().map(|b| b.map_or(nothing, |b| law.kernel(z, b)));
        match self.calibration {
            Calibration::LightMatched => Some(radii.collect()),
            Calibration::AsPrinted => Some(radii.flat_map(|r| stored(r, law.search(z))).collect()),
        }
    }
}

/// A radius through eight bits of the largest one.
fn stored(radius: Approx, largest: Approx) -> Vec<Approx> {
    let levels = Approx::exact(MASK_LEVELS);
    let nearest = (radius / largest * levels + Approx::exact(0.5)).floors();
    nearest.map(|level| Approx::exact(level as f64) / levels * largest).collect()
}
