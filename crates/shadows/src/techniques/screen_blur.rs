//! T30: a hard shadow, blurred in screen space as wide as its penumbra is seen.

use crate::calibration::Law;
use crate::recording::{ComputePass, Format, TextureInfo};
use crate::shader::{self, Fragment};
use crate::stages::{Resolve, depth_prepass, resolve, seeded, shadow_map};
use crate::{
    Binding, Calibration, Info, Inputs, Kernels, LightKind, Recording, Technique, TextureId, calibration,
};

const OWN: Fragment = Fragment::new("screen_blur", include_str!("screen_blur.wgsl"));

/// Search radius over the largest kernel radius, as at full resolution.
const SEARCH_SCALE: f64 = 1.0;

/// Blur in screen space.
pub(crate) struct ScreenBlur {
    /// Point taps of the blocker search.
    pub(crate) search_taps: u32,
    /// Widest blur, pixels to each side.
    pub(crate) max_pixels: u32,
}

/// As many taps as everywhere; 65 pixels a side are what a pass can afford.
pub(crate) const WIDEST_32: ScreenBlur = ScreenBlur { search_taps: 32, max_pixels: 32 };

/// A texture over the frame.
fn over_frame(inputs: &Inputs<'_>, label: &'static str, format: Format) -> TextureInfo {
    TextureInfo { label, width: inputs.view.width, height: inputs.view.height, format, mips: 1, kept: None }
}

impl ScreenBlur {
    /// Hard shadow and radius in pixels.
    fn penumbra(&self, recording: &mut Recording, inputs: &Inputs<'_>) -> TextureId {
        let map = shadow_map(recording, inputs);
        let surfaces = depth_prepass(recording, inputs);
        let target = recording.texture(over_frame(inputs, "lit-hard", Format::Rg32Float));
        let (slots, mut constants) = calibration::slots(inputs, Law::Standard);
        constants.extend([
            ("SEARCH_TAPS", f64::from(self.search_taps)),
            ("SEARCH_SCALE", SEARCH_SCALE),
            ("MAX_PIXELS", f64::from(self.max_pixels)),
            ("MAP_WIDENS", f64::from(u8::from(inputs.light.kind != LightKind::Sun))),
            ("PATTERN_SALT", 0.0),
        ]);
        let mut fragments = vec![
            shader::SCREEN_PENUMBRA,
            shader::GLOBALS,
            shader::SURFACE,
            shader::TURN,
            shader::BLOCKER_SEARCH,
            shader::KERNEL_VOGEL,
        ];
        fragments.extend(slots);
        fragments.extend(seeded(shader::PATTERN_IGN, inputs.seeding));
        let pass = ComputePass {
            label: "screen-penumbra",
            shader: fragments,
            entry: "screen_penumbra",
            constants,
            bindings: vec![
                Binding::Globals,
                Binding::ShadowMap(map),
                Binding::CameraDepth(surfaces.depth),
                Binding::CameraNormal(surfaces.normal),
                Binding::Destination(target),
                Binding::Nearest,
            ],
            groups: [0, 0],
        };
        recording.filter(pass, target);
        target
    }
}

/// The blur's first axis.
fn rows(recording: &mut Recording, inputs: &Inputs<'_>, penumbra: TextureId) -> TextureId {
    let surfaces = depth_prepass(recording, inputs);
    let target = recording.texture(over_frame(inputs, "lit-rows", Format::R32Float));
    let pass = ComputePass {
        label: "screen-rows",
        shader: vec![
            shader::SCREEN_ROWS,
            shader::GLOBALS,
            shader::SURFACE,
            shader::FRAME_DEPTH,
            shader::HALF_DISC,
            shader::WEIGHT_PLANE,
        ],
        entry: "screen_rows",
        constants: vec![("DEPTH_BITS", 32.0)],
        bindings: vec![
            Binding::Globals,
            Binding::CameraDepth(surfaces.depth),
            Binding::CameraNormal(surfaces.normal),
            Binding::Source(penumbra),
            Binding::Destination(target),
        ],
        groups: [0, 0],
    };
    recording.filter(pass, target);
    target
}

impl Technique for ScreenBlur {
    fn info(&self) -> Info {
        Info {
            title: "a hard shadow blurred in screen space as wide as its penumbra is seen",
            document: "T30: named in the first document, introduction (MohammadBagher et al. 2010)",
            options: format!("cross-bilateral, at most {} pixels to each side", self.max_pixels),
            taps: format!("{} search + 4", self.search_taps),
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let search = format!("{} x {SEARCH_SCALE:.1}", calibration.largest_radius());
        let kernel = format!(
            "{}; without a blocker 0; in metres at the receiver, over the camera's depth in pixels, at most {}; along rows \
             and columns, weighted by the disc's chord and by 1 / (.001 + distance from the pixel's plane / depth)",
            calibration.radius_for("the blockers' mean depth"),
            self.max_pixels
        );
        Kernels::hardening(calibration, search, kernel)
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let penumbra = self.penumbra(recording, inputs);
        let blurred = rows(recording, inputs, penumbra);
        let technique = Resolve {
            label: "screen-blur",
            own: OWN,
            // No document prints weights for it: one kind serves both calibrations.
            uses: vec![shader::HALF_DISC, shader::WEIGHT_PLANE],
            constants: vec![("DEPTH_BITS", 32.0)],
            reads: vec![Binding::Source(blurred), Binding::SourceB(penumbra)],
        };
        resolve(recording, inputs, technique);
    }
}
