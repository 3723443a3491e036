//! Checks a user's WGSL before any device sees it, and says what is wrong at the user's own line.

use super::endless::endless_loop;
use super::{Own, SIGNATURE};
use crate::recording::{ComputePass, Pass};
use crate::{
    Inputs, LightKind, LightMap, Lights, Receivers, Recording, Seeding, ShadowError, Technique as _,
};
use glam::Mat4;
use naga::{Module, ScalarKind, Span, TypeInner};
use std::ops::Range;
use umbrage_frame::View;

/// Checks the pass that the file becomes, for every light and kind of receiver.
pub(super) fn check(own: &Own) -> Result<(), ShadowError> {
    let kinds: &[LightKind] = match own.header.lights {
        Lights::All => &[LightKind::Sun, LightKind::Local],
        Lights::Suns => &[LightKind::Sun],
        Lights::Placed => &[LightKind::Local],
    };
    for &kind in kinds {
        for receivers in [Receivers::Anchors { count: 1 }, Receivers::Frame] {
            Checked::of(own, (kind, receivers)).check()?;
        }
    }
    Ok(())
}

/// One module: the file, then everything that it is put together with.
struct Checked<'a> {
    own: &'a Own,
    /// With the entry point that calls `shade`, and without.
    sources: [String; 2],
    constants: naga::back::PipelineConstants,
}

/// Where a complaint lies, and what it says.
type Complaint = (Vec<Span>, String);

impl<'a> Checked<'a> {
    fn of(own: &'a Own, (kind, receivers): (LightKind, Receivers)) -> Self {
        let pass = last_pass(own, kind, receivers);
        let text = |keep: &dyn Fn(&str) -> bool| {
            let kept = pass.shader.iter().filter(|f| keep(&f.name));
            kept.map(|f| f.source.as_ref()).collect::<Vec<_>>().join("\n")
        };
        let sources = [text(&|_| true), text(&|name| name != crate::shader::ENTRY_SHADE.name)];
        let declared = crate::shader::declared(&sources[0], &pass.constants);
        let constants = declared.into_iter().map(|(name, value)| (name.to_string(), value)).collect();
        Self { own, sources, constants }
    }

    /// First without a caller of `shade`: that it is missing is then ours to say.
    fn check(&self) -> Result<(), ShadowError> {
        let [whole, alone] = &self.sources;
        let module = parsed(alone).map_err(|c| self.error(alone, c))?;
        self.check_declarations(&module)?;
        self.check_entry(&module)?;
        if let Some(span) = endless_loop(&module) {
            return Err(self.error(alone, (vec![span], "a loop that nothing ends".into())));
        }
        let module = parsed(whole).map_err(|c| self.error(whole, c))?;
        // The same capability as the built-ins': WebGPU's own.
        let own = naga::valid::Capabilities::SHADER_FLOAT16_IN_FLOAT32;
        let mut validator = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), own);
        let info = validator.validate(&module).map_err(|e| {
            let spans: Vec<Span> = e.spans().map(|s| s.0).collect();
            let message = chain(e.as_inner());
            match spans.iter().any(|s| self.in_file(*s).is_some()) {
                // Of what a compute pass may not do the validator names the entry point alone, which is ours.
                false if message.contains("forbidden at this stage") => {
                    self.at(self.line_of(&STAGE_BOUND), message)
                }
                _ => self.error(whole, (spans, message)),
            }
        })?;
        naga::back::pipeline_constants::process_overrides(&module, &info, None, &self.constants)
            .map_err(|e| self.error(whole, (vec![], chain(&e))))?;
        Ok(())
    }

    /// What only the program declares.
    fn check_declarations(&self, module: &Module) -> Result<(), ShadowError> {
        let resources = module.global_variables.iter().filter(|(_, v)| v.binding.is_some());
        let resources =
            resources.map(|(h, _)| (module.global_variables.get_span(h), "a resource: files bind none"));
        let overrides = module.overrides.iter();
        let overrides = overrides.map(|(h, _)| {
            (module.overrides.get_span(h), "an override: put it under [constants] of the header")
        });
        match resources.chain(overrides).find(|(span, _)| self.in_file(*span).is_some()) {
            Some((span, message)) => Err(self.error(&self.sources[1], (vec![span], message.into()))),
            None if module.entry_points.is_empty() => Ok(()),
            None => {
                let message = format!("an entry point: the file defines `{SIGNATURE}` and is called by one");
                Err(self.at(self.line_of(&["@compute", "@vertex", "@fragment"]), message))
            }
        }
    }

    fn check_entry(&self, module: &Module) -> Result<(), ShadowError> {
        let Some((handle, shade)) = module.functions.iter().find(|(_, f)| f.name.as_deref() == Some("shade"))
        else {
            let message = format!("no entry function: the file has to define `{SIGNATURE}`");
            return Err(self.at(self.line_of(&["fn "]), message));
        };
        let inner = |ty| &module.types[ty].inner;
        let takes = |ty| module.types[ty].name.as_deref() == Some("Receiver");
        let gives =
            |ty| matches!(inner(ty), TypeInner::Scalar(s) if s.kind == ScalarKind::Float && s.width == 4);
        let fits = matches!(&shade.arguments[..], [only] if takes(only.ty))
            && shade.result.as_ref().is_some_and(|r| gives(r.ty));
        if fits {
            return Ok(());
        }
        let message = format!("the entry function has another signature: `{SIGNATURE}` is called");
        Err(self.error(&self.sources[1], (vec![module.functions.get_span(handle)], message)))
    }

    /// The part of a span that lies in the user's file.
    fn in_file(&self, span: Span) -> Option<Range<usize>> {
        span.to_range().filter(|r| r.start < self.own.text.len())
    }

    /// A complaint about a module, at the narrowest of its places that is the user's: in the file, or in
    /// the lines that the header's constants became.
    fn error(&self, source: &str, (spans, message): Complaint) -> ShadowError {
        if let Some(range) = spans.iter().filter_map(|s| self.in_file(*s)).min_by_key(Range::len) {
            return self.at(place_of(source, range.start), message);
        }
        let constant = spans.iter().find_map(|s| self.constant_at(source, s.to_range()?.start));
        self.at(constant.unwrap_or((1, 1)), message)
    }

    /// Place in the header of the constant whose line a position of the module is in.
    fn constant_at(&self, source: &str, position: usize) -> Option<(usize, usize)> {
        let [_, constants] = self.own.fragments();
        // Behind the file, which may hold the same words.
        let file = self.own.text.len();
        let start = file + source.get(file..)?.find(constants.source.as_ref())?;
        let line = source.get(start..position)?.matches('\n').count();
        self.own.header.constants.get(line).map(|c| c.place)
    }

    /// The first line with one of these words; the file's first without.
    fn line_of(&self, words: &[&str]) -> (usize, usize) {
        let has = |line: &str| !line.starts_with("//") && words.iter().any(|w| line.contains(w));
        (self.own.text.lines().position(has).unwrap_or(0) + 1, 1)
    }

    fn at(&self, place: (usize, usize), message: String) -> ShadowError {
        let line = self.own.text.lines().nth(place.0 - 1).unwrap_or_default();
        let caret = format!("{}^", " ".repeat(place.1 - 1));
        let message = format!("{message}\n  | {}\n  | {caret}", line.replace('\t', " "));
        ShadowError::Own { file: self.own.file.clone(), place, message }
    }
}

/// What fragments alone may do.
const STAGE_BOUND: [&str; 8] = [
    "discard",
    "dpdx",
    "dpdy",
    "fwidth",
    "textureSample(",
    "textureSampleBias",
    "textureSampleCompare(",
    "textureQueryLod",
];
/// A label may quote all of the source that follows: a word of it will do.
const LONGEST_LABEL: usize = 80;

fn parsed(source: &str) -> Result<Module, Complaint> {
    naga::front::wgsl::parse_str(source).map_err(|e| {
        let short = |text: &str| -> String {
            let first = text.lines().next().unwrap_or_default();
            match first.char_indices().nth(LONGEST_LABEL) {
                Some((end, _)) => format!("{}…", &first[..end]),
                None if first.len() < text.len() => format!("{first}…"),
                None => first.into(),
            }
        };
        let message = short(e.message());
        let labels: Vec<String> =
            e.labels().map(|l| short(l.1)).filter(|l| !message.contains(l.as_str())).collect();
        let notes: Vec<&str> = e.notes().collect();
        let more = if labels.is_empty() { String::new() } else { format!(" ({})", labels.join("; ")) };
        let notes: String = notes.iter().map(|n| format!("; {n}")).collect();
        (e.labels().map(|l| l.0).collect(), format!("{message}{more}{notes}"))
    })
}

/// An error with its causes.
fn chain(error: &dyn std::error::Error) -> String {
    let mut message = error.to_string();
    let mut cause = error.source();
    while let Some(next) = cause {
        message = format!("{message}: {next}");
        cause = next.source();
    }
    message
}

/// Line and column of a byte, from 1.
fn place_of(source: &str, position: usize) -> (usize, usize) {
    let before = source.get(..position).unwrap_or(source);
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    (before.matches('\n').count() + 1, column)
}

/// The pass as it will be recorded. Only the kind of the light matters to its text.
fn last_pass(own: &Own, kind: LightKind, receivers: Receivers) -> ComputePass {
    let view = View {
        width: 8,
        height: 8,
        clip_from_world: Mat4::IDENTITY,
        camera_from_world: Mat4::IDENTITY,
        yfov_radians: 1.0,
    };
    let light = LightMap {
        kind,
        light_from_world: Mat4::IDENTITY,
        clip_from_world: Mat4::IDENTITY,
        texels: 64,
        scale: 1.0,
        light_size: 1.0,
        nearest_blocker: 1.0,
        far: 2.0,
        eye_distance: 1.5,
        reference_gap: 0.1,
    };
    let inputs = Inputs {
        view: &view,
        light: &light,
        calibration: own.header.calibration,
        bias: own.header.calibration.default_bias(),
        receivers,
        seeding: Seeding::Fresh,
        geometry_key: 0,
        has_cutouts: false,
        past: &[],
        age: 0,
    };
    let mut recording = Recording::new(inputs.globals(0, 0));
    own.record(&mut recording, &inputs);
    match recording.passes.pop() {
        Some(Pass::Compute(pass)) => pass,
        // `record` ends with the pass that fills the values.
        other => unreachable!("the last pass is a compute pass, not {other:?}"),
    }
}
