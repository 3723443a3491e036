//! A user's own technique: one WGSL file whose `shade` is called where a built-in's is.
//!
//! The file becomes a `Technique` like any other and goes through the same last pass, so that a
//! built-in's body in a user's file gives the same values bit for bit. Deliberately absent: passes
//! before the last one, and anything that only scores would see.

mod check;
mod endless;
mod header;
mod number;
mod verdict;

pub(crate) use verdict::judged;

use crate::calibration::Law;
use crate::shader::{self, Fragment};
use crate::stages::{Shade, seeds, shade};
use crate::{
    Calibration, Info, Inputs, Kernels, LightKind, Lights, PROBES, Recording, ShadowError, Technique,
    VARIANTS, Variant, VariantId,
};
use header::{Constant, Header};
use std::borrow::Cow;

/// The entry function that a file has to define.
const SIGNATURE: &str = "fn shade(r: Receiver) -> f32";

const PRELUDE: Fragment = Fragment::new("own", include_str!("own.wgsl"));
const PRELUDE_SUN: Fragment = Fragment::new("own_sun", include_str!("own_sun.wgsl"));
const PRELUDE_LOCAL: Fragment = Fragment::new("own_local", include_str!("own_local.wgsl"));

/// A technique that was read from a file.
pub struct Own {
    /// As messages name it.
    file: String,
    /// All of the file: its header is comments.
    text: Cow<'static, str>,
    header: Header,
    label: &'static str,
    title: &'static str,
    document: &'static str,
}

impl Own {
    /// Reads a file's header; `file` is what messages call it.
    ///
    /// # Errors
    /// A header that is missing, wrong, or names a technique that there is already.
    pub fn read(file: &str, text: String) -> Result<Self, ShadowError> {
        // Some editors put a mark before the text.
        let text = text.strip_prefix('\u{feff}').map_or_else(|| text.clone(), str::to_string);
        let header = Header::read(file, &text)?;
        if VARIANTS.iter().chain(PROBES).any(|v| v.name == header.name) || header.name == "all" {
            let message = format!("\"{}\" is the name of a built-in variant: choose another", header.name);
            return Err(ShadowError::Own { file: file.into(), place: header.name_place, message });
        }
        let (label, title, document) = ("", "", "");
        Ok(Self { file: file.into(), text: text.into(), header, label, title, document })
    }

    /// What the header calls it.
    pub fn name(&self) -> &str {
        &self.header.name
    }

    /// Replaces the value of a constant, or of `search_taps` and `filter_taps`.
    ///
    /// # Errors
    /// A constant that the header does not have, or a value of another kind.
    pub fn set(&mut self, constant: &str, value: &str) -> Result<(), ShadowError> {
        let name = self.header.name.clone();
        self.header.set(constant, value).map_err(|message| ShadowError::Setting { name, message })
    }

    /// Checks the WGSL and makes it a variant, which lives as long as the program.
    ///
    /// # Errors
    /// What naga says about it, at the user's own line; or a wrong entry function.
    pub fn into_variant(mut self) -> Result<VariantId, ShadowError> {
        // Variants are `&'static` everywhere, and a run reads a file or two once: what is leaked here
        // is what the program would hold to its end anyway.
        let leak = |text: String| -> &'static str { Box::leak(text.into_boxed_str()) };
        self.label = leak(self.header.name.clone());
        self.title = leak(self.header.title.clone());
        self.document = leak(format!("the user's own: {}", self.file));
        self.text = Cow::Borrowed(leak(self.text.into_owned()));
        check::check(&self)?;
        let (name, calibration) = (self.label, self.header.calibration);
        let technique: &'static Self = Box::leak(Box::new(self));
        Ok(VariantId { variant: Box::leak(Box::new(Variant { name, technique })), calibration })
    }

    /// The file, then a line for each constant.
    fn fragments(&self) -> [Fragment; 2] {
        let line = |c: &Constant| format!("const {} = {};\n", c.name, c.value);
        let constants: String = self.header.constants.iter().map(line).collect();
        [
            Fragment { name: "own_file".into(), source: self.text.clone() },
            Fragment { name: "own_constants".into(), source: constants.into() },
        ]
    }

    fn described_constants(&self) -> String {
        let each = self.header.constants.iter().map(|c| format!("{} = {}", c.name, c.value));
        each.collect::<Vec<_>>().join(", ")
    }

    fn shading(&self, inputs: &Inputs<'_>) -> Shade {
        let [own, constants] = self.fragments();
        let (of_light, plane) = match inputs.light.kind {
            LightKind::Sun => (PRELUDE_SUN, shader::PLANE_SUN),
            LightKind::Local | LightKind::Cube => (PRELUDE_LOCAL, shader::PLANE_LOCAL),
        };
        let mut uses = vec![constants, PRELUDE, of_light, plane, self.header.kernel.fragment()];
        uses.extend([shader::HARDEN, shader::BLOCKER_SEARCH, shader::FILTER_DISC]);
        // A pattern brings its seeds along; without one they are there for the file to call.
        if self.header.pattern.is_none() {
            uses.extend(seeds(inputs.seeding));
        }
        Shade {
            uses,
            constants: vec![
                ("SEARCH_TAPS", self.header.search_taps.into()),
                ("SEARCH_SCALE", 1.0),
                ("FILTER_TAPS", self.header.filter_taps.into()),
            ],
            law: Law::Standard,
            pattern: Some(self.header.pattern.fragment()),
            ..Shade::new(self.label, own)
        }
    }
}

impl Technique for Own {
    fn info(&self) -> Info {
        Info {
            title: self.title,
            document: self.document,
            options: self.described_constants(),
            taps: "as its file says".into(),
            stochastic: self.header.stochastic,
        }
    }

    fn kernels(&self, _: Calibration) -> Kernels {
        let own = || "as its file says".to_string();
        Kernels { search_radius: own(), kernel: own(), cap: own(), radius_convention: own() }
    }

    fn lights(&self) -> Lights {
        self.header.lights
    }

    fn own_file(&self) -> Option<&str> {
        Some(&self.file)
    }

    fn settings(&self) -> Vec<(String, String)> {
        let taps = [("search_taps", self.header.search_taps), ("filter_taps", self.header.filter_taps)];
        let own = self.header.constants.iter().map(|c| (format!("constant {}", c.name), c.value.to_string()));
        let slots = [("pattern", self.header.pattern.name()), ("points", self.header.kernel.name())];
        let slots = slots.map(|(slot, name)| (slot.to_string(), name.to_string()));
        taps.iter().map(|(k, v)| ((*k).to_string(), v.to_string())).chain(slots).chain(own).collect()
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        shade(recording, inputs, self.shading(inputs));
    }
}
