//! T1: one comparison.

use crate::shader::Fragment;
use crate::stages::{Shade, shade};
use crate::{Info, Inputs, Recording, Technique};

const OWN: Fragment = Fragment::new("hard", include_str!("hard.wgsl"));

/// The hard shadow map.
pub(crate) struct Hard;

impl Technique for Hard {
    fn info(&self) -> Info {
        Info {
            title: "hard shadow map: one comparison with the nearest texel",
            document: "T1: second document; fourth document",
            taps: "1".into(),
            stochastic: false,
        }
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let technique = Shade { label: "hard", own: OWN, uses: vec![], constants: vec![], source: None };
        shade(recording, inputs, technique);
    }
}
