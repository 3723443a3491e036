//! What was measured, by place and variant.

use super::needs::Measure;
use super::place::Place;
use std::collections::BTreeMap;
use umbrage_frame::Image;
use umbrage_metrics::{SumKind, SumTable};

/// Everything that was measured.
#[derive(Default)]
pub(crate) struct Measurements {
    pub(crate) places: BTreeMap<Place, PlaceFacts>,
    pub(super) tables: BTreeMap<(Place, String, Measure), BTreeMap<SumKind, SumTable>>,
    pub(super) masks: BTreeMap<(Place, String), Image<f32>>,
    /// Why a variant, or every variant of a place (no name), was not measured.
    pub(super) refused: BTreeMap<(Place, Option<String>), String>,
}

/// What is known of a place besides its variants.
pub(crate) struct PlaceFacts {
    /// True visibility in the middle frame; NaN where nothing counts.
    pub(crate) truth: Image<f32>,
    pub(crate) tiles: u32,
    pub(crate) frames: u32,
}

impl Measurements {
    pub(crate) fn table(
        &self,
        place: &Place,
        variant: &str,
        (measure, kind): (&Measure, SumKind),
    ) -> Option<&SumTable> {
        self.tables.get(&(place.clone(), variant.to_string(), measure.clone()))?.get(&kind)
    }

    /// The middle frame of a variant.
    pub(crate) fn mask(&self, place: &Place, variant: &str) -> Option<&Image<f32>> {
        self.masks.get(&(place.clone(), variant.to_string()))
    }

    /// Why there is nothing of a variant in a place.
    pub(crate) fn reason(&self, place: &Place, variant: &str) -> String {
        let of = |name: Option<String>| self.refused.get(&(place.clone(), name)).cloned();
        of(Some(variant.to_string())).or(of(None)).unwrap_or_else(|| "it was not measured".into())
    }
}
