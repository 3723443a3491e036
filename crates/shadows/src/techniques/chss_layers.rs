//! T22: contact hardening whose blocker search knows several layers of the map.
//!
//! Light passes a texel's first blocker or not, whatever lies behind it: the filter needs one layer.
//! The width of the penumbra is another matter: a blocker that another hides from the light, nearer
//! to the receiver, narrows it. Two layers of a solid are its front and its back, so that the
//! hidden blocker is found only from the third layer on where the nearer one is solid.

use super::chss;
use crate::shader::{self, Fragment};
use crate::stages::{Shade, deeper_layers, shade};
use crate::{Binding, Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("chss_layers", include_str!("chss_layers.wgsl"));

/// So many layers of the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Layers {
    /// Front and back of the first solid.
    Two,
    /// Of the first two.
    Four,
}

/// `chss` with the deepest blocker of each tap.
pub(crate) struct ChssLayers {
    /// How many.
    pub(crate) layers: Layers,
}

impl Layers {
    fn count(self) -> u32 {
        match self {
            Self::Two => 2,
            Self::Four => 4,
        }
    }
}

impl Technique for ChssLayers {
    fn info(&self) -> Info {
        let count = self.layers.count();
        Info {
            title: "contact hardening with the deepest blocker of each tap, from several layers of the map",
            document: "T22: excerpt of Real-Time Rendering; Bavoil et al. 2008 (layers by depth peeling)",
            options: format!("{count} layers"),
            taps: format!("{} x {count} search + {} x 4", chss::CHSS.search_taps, chss::CHSS.filter_taps),
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let search = chss::CHSS.kernels(calibration).search_radius;
        let blocker = "the mean over taps of the deepest blocker among the layers";
        let kernel = format!("{}; without a blocker 0", calibration.radius_for(blocker));
        Kernels::hardening(calibration, search, kernel)
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let layers = deeper_layers(recording, inputs, self.layers.count());
        // The shader declares three; two layers never read the others.
        let layer = |k: usize| layers[k.min(layers.len() - 1)];
        let mut constants = chss::CHSS.constants();
        constants.push(("LAYERS", f64::from(self.layers.count())));
        let technique = Shade {
            uses: vec![shader::FILTER_DISC, shader::KERNEL_VOGEL],
            constants,
            reads: vec![Binding::Source(layer(0)), Binding::SourceB(layer(1)), Binding::SourceC(layer(2))],
            pattern: Some(shader::PATTERN_IGN),
            ..Shade::new("chss-layers", OWN)
        };
        shade(recording, inputs, technique);
    }
}
