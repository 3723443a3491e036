//! T20: separable soft shadow mapping. "The process of sampling a grid is split into separable parts
//! and elements are reused as possible from pixel to pixel."
//!
//! A square grid's search and filter each become a row of taps a pixel, along the map's u, and a
//! column of the rows of other pixels: those that see the receiver's plane where the light's rays
//! along v meet it. Search and filter then cost 2 N fetches a pixel each, not N^2. The split is not
//! exact: a row is as long as its own pixel's kernel, at that pixel's place, and is missing where
//! another surface hides it or the picture ends; then the others have its weight.

use crate::calibration::{self, Law};
use crate::recording::{ComputePass, Format, TextureId, TextureInfo};
use crate::shader::{self, Fragment};
use crate::stages::{Shade, depth_prepass, shade, shadow_map};
use crate::{Binding, Calibration, Info, Inputs, Kernels, LightKind, Receivers, Recording, Technique};

const OWN: Fragment = Fragment::new("sssm", include_str!("sssm.wgsl"));

/// Search radius over the largest kernel radius.
const SEARCH_SCALE: f64 = 1.0;

/// A grid of this many taps a side.
pub(crate) struct Sssm {
    /// Odd, so that a tap is the receiver's own.
    pub(crate) side: u32,
}

/// One of the passes over the frame.
struct Row {
    label: &'static str,
    entry: &'static str,
    shader: Fragment,
    format: Format,
    /// What the pass before it wrote.
    source: Option<TextureId>,
}

impl Sssm {
    fn constants(&self) -> Vec<(&'static str, f64)> {
        vec![("GRID_SIDE", self.side.into()), ("SEARCH_SCALE", SEARCH_SCALE), ("DEPTH_BITS", 32.0)]
    }

    fn row(&self, recording: &mut Recording, inputs: &Inputs<'_>, row: Row) -> TextureId {
        let map = shadow_map(recording, inputs);
        let surfaces = depth_prepass(recording, inputs);
        let (width, height) = (inputs.view.width, inputs.view.height);
        let info = TextureInfo { label: row.label, width, height, format: row.format, mips: 1, kept: None };
        let target = recording.texture(info);
        let (slots, mut constants) = calibration::slots(inputs, Law::Standard);
        constants.extend(self.constants());
        let mut shader = vec![row.shader, shader::GLOBALS, shader::SURFACE];
        shader.extend(fragments(inputs.light.kind));
        shader.extend(slots);
        let mut bindings = vec![
            Binding::Globals,
            Binding::ShadowMap(map),
            Binding::CameraDepth(surfaces.depth),
            Binding::CameraNormal(surfaces.normal),
            Binding::Destination(target),
            Binding::Nearest,
        ];
        bindings.extend(row.source.map(Binding::Source));
        let (label, entry) = (row.label, row.entry);
        let pass = ComputePass { label, shader, entry, constants, bindings, groups: [0, 0] };
        recording.filter(pass, target);
        target
    }
}

/// Rows and columns, and the light's way back from the map to a plane.
fn fragments(kind: LightKind) -> Vec<Fragment> {
    let plane = if kind == LightKind::Sun { shader::PLANE_SUN } else { shader::PLANE_LOCAL };
    vec![shader::COLUMN, plane, shader::FRAME_DEPTH]
}

impl Technique for Sssm {
    fn info(&self) -> Info {
        Info {
            title: "separable soft shadow mapping: rows of taps, columns of other pixels' rows",
            document: "T20: excerpt of Real-Time Rendering (Buades et al., known from it alone)",
            options: format!("a grid of {side}x{side}", side = self.side),
            taps: format!("{side} + {side} search, {side} x 4 + {side}", side = self.side),
            stochastic: false,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let search =
            format!("{} x {SEARCH_SCALE:.1}, {} taps a side", calibration.largest_radius(), self.side);
        let kernel = format!(
            "{}, {} taps a side; without a blocker 0",
            calibration.radius_for("the blockers' mean depth"),
            self.side
        );
        let convention = "half the side of the square in which the taps lie";
        Kernels { radius_convention: convention.into(), ..Kernels::hardening(calibration, search, kernel) }
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let search = Row {
            label: "sssm-search-rows",
            entry: "sssm_search",
            shader: shader::SSSM_SEARCH,
            format: Format::Rg32Float,
            source: None,
        };
        let searched = self.row(recording, inputs, search);
        let radius = Row {
            label: "sssm-radius",
            entry: "sssm_radius",
            shader: shader::SSSM_RADIUS,
            format: Format::R32Float,
            source: Some(searched),
        };
        let radii = self.row(recording, inputs, radius);
        let filter = Row {
            label: "sssm-filter-rows",
            entry: "sssm_filter",
            shader: shader::SSSM_FILTER,
            format: Format::R32Float,
            source: Some(radii),
        };
        let rows = self.row(recording, inputs, filter);
        let mut uses = fragments(inputs.light.kind);
        let mut reads = vec![Binding::Source(radii), Binding::SourceB(rows)];
        if let Receivers::Anchors { .. } = inputs.receivers {
            // Anchors look at the frame too.
            uses.push(shader::CAMERA_DEPTH);
            reads.push(Binding::CameraDepth(depth_prepass(recording, inputs).depth));
        }
        let technique = Shade { uses, reads, constants: self.constants(), ..Shade::new("sssm", OWN) };
        shade(recording, inputs, technique);
    }
}
