//! The TOML header of a user's file, in its leading `//!` comments.

use super::number::Number;
use crate::shader::Fragment;
use crate::techniques::{Points, Rotation};
use crate::{Calibration, Lights, ShadowError};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::ops::Range;
use toml::{Spanned, Value};

/// What a header says, checked.
pub(super) struct Header {
    pub(super) name: String,
    /// Line and column.
    pub(super) name_place: (usize, usize),
    pub(super) title: String,
    pub(super) stochastic: bool,
    pub(super) lights: Lights,
    pub(super) calibration: Calibration,
    pub(super) pattern: Pattern,
    pub(super) kernel: Kernel,
    pub(super) search_taps: u32,
    pub(super) filter_taps: u32,
    /// In order of their names.
    pub(super) constants: Vec<Constant>,
}

/// A `const` of the WGSL.
pub(super) struct Constant {
    pub(super) name: String,
    pub(super) value: Number,
    /// Line and column.
    pub(super) place: (usize, usize),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Raw {
    name: Spanned<String>,
    title: Option<String>,
    stochastic: Option<bool>,
    #[serde(default)]
    lights: Option<Spanned<Vec<Light>>>,
    #[serde(default)]
    calibration: Calibrated,
    #[serde(default)]
    pattern: Pattern,
    #[serde(default)]
    kernel: Kernel,
    search_taps: Option<Spanned<u32>>,
    filter_taps: Option<Spanned<u32>>,
    #[serde(default)]
    constants: BTreeMap<String, Spanned<Value>>,
}

#[derive(Deserialize, Clone, Copy, PartialEq)]
#[serde(rename_all = "kebab-case")]
enum Light {
    Sun,
    Local,
}

#[derive(Deserialize, Clone, Copy, Default)]
#[serde(rename_all = "kebab-case")]
enum Calibrated {
    #[default]
    LightMatched,
    AsPrinted,
}

/// Slot `pattern`.
#[derive(Deserialize, Clone, Copy, Default, PartialEq)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Pattern {
    #[default]
    Ign,
    White,
    World,
    None,
}

/// Slot `kernel_tap`.
#[derive(Deserialize, Clone, Copy, Default)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Kernel {
    #[default]
    Vogel,
    Poisson,
    Spiral,
}

/// Taps that a loop may have: more would make a frame on a software driver take minutes.
const MOST_TAPS: u32 = 1024;

impl Header {
    /// Reads the leading comments of a file.
    pub(super) fn read(file: &str, text: &str) -> Result<Self, ShadowError> {
        let toml = toml_of(text).map_err(|(line, message)| at(file, (line, 1), message))?;
        let raw: Raw = toml::from_str(&toml).map_err(|e| {
            let place = place_of(text, e.span().unwrap_or(0..0));
            at(file, place, e.message().to_string())
        })?;
        raw.checked(text).map_err(|(span, message)| at(file, place_of(text, span), message))
    }

    /// Replaces a number; the error says what is wrong.
    pub(super) fn set(&mut self, constant: &str, value: &str) -> Result<(), String> {
        if let Some(taps) = match constant {
            "search_taps" => Some(&mut self.search_taps),
            "filter_taps" => Some(&mut self.filter_taps),
            _ => None,
        } {
            let number = value.parse().map_err(|_| format!("{constant}: \"{value}\" is no whole number"))?;
            *taps = self.kernel.taps(number).map_err(|message| format!("{constant}: {message}"))?;
            return Ok(());
        }
        let known = || self.constants.iter().map(|c| c.name.as_str()).collect::<Vec<_>>().join(", ");
        let message = || format!("no constant \"{constant}\"; its header has: {}", known());
        let found = self.constants.iter().position(|c| c.name == constant).ok_or_else(message)?;
        let found = &mut self.constants[found];
        found.value = found.value.like(value).map_err(|message| format!("{constant}: {message}"))?;
        Ok(())
    }
}

impl Raw {
    fn checked(self, text: &str) -> Result<Header, (Range<usize>, String)> {
        let name = self.name.get_ref().clone();
        let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "-.".contains(c);
        if !(1..=40).contains(&name.len()) || !name.chars().all(plain) || name.starts_with(['-', '.']) {
            let message = "a name has 1 to 40 of a-z, 0-9, - and .: it is part of file names".to_string();
            return Err((self.name.span(), message));
        }
        let taps = |given: Option<Spanned<u32>>, usual: u32| match given {
            None => Ok(usual.min(self.kernel.points())),
            Some(taps) => self.kernel.taps(*taps.get_ref()).map_err(|message| (taps.span(), message)),
        };
        let constant = |(name, value): (String, Spanned<Value>)| {
            let number = Number::of(value.get_ref());
            let value_at = value.span();
            let number = number.map_err(|message| (value_at.clone(), format!("{name}: {message}")))?;
            Ok(Constant { name, value: number, place: place_of(text, value_at) })
        };
        Ok(Header {
            title: self.title.unwrap_or_else(|| name.clone()),
            name_place: place_of(text, self.name.span()),
            name,
            stochastic: self.stochastic.unwrap_or(!self.pattern.is_none()),
            lights: lights(self.lights)?,
            calibration: match self.calibration {
                Calibrated::LightMatched => Calibration::LightMatched,
                Calibrated::AsPrinted => Calibration::AsPrinted,
            },
            pattern: self.pattern,
            kernel: self.kernel,
            search_taps: taps(self.search_taps, 32)?,
            filter_taps: taps(self.filter_taps, 16)?,
            constants: self.constants.into_iter().map(constant).collect::<Result<_, _>>()?,
        })
    }
}

fn lights(given: Option<Spanned<Vec<Light>>>) -> Result<Lights, (Range<usize>, String)> {
    let Some(given) = given else { return Ok(Lights::All) };
    let has = |light| given.get_ref().contains(&light);
    match (has(Light::Sun), has(Light::Local)) {
        (true, true) => Ok(Lights::All),
        (true, false) => Ok(Lights::Suns),
        (false, true) => Ok(Lights::Placed),
        (false, false) => Err((given.span(), "a technique does \"sun\", \"local\" or both".into())),
    }
}

impl Pattern {
    pub(super) fn is_none(self) -> bool {
        self == Self::None
    }

    pub(super) fn fragment(self) -> Fragment {
        match self {
            Self::Ign => Rotation::Ign,
            Self::White => Rotation::White,
            Self::World => Rotation::World,
            Self::None => Rotation::Fixed,
        }
        .fragment()
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Ign => "ign",
            Self::White => "white",
            Self::World => "world",
            Self::None => "none",
        }
    }
}

impl Kernel {
    pub(super) fn fragment(self) -> Fragment {
        match self {
            Self::Vogel => Points::Vogel,
            Self::Poisson => Points::Poisson,
            Self::Spiral => Points::Spiral,
        }
        .fragment(0)
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Vogel => "vogel",
            Self::Poisson => "poisson",
            Self::Spiral => "spiral",
        }
    }

    /// How many there are.
    fn points(self) -> u32 {
        match self {
            Self::Vogel => MOST_TAPS,
            Self::Poisson => 64,
            Self::Spiral => 8,
        }
    }

    fn taps(self, wanted: u32) -> Result<u32, String> {
        let most = self.points();
        let message = || format!("{wanted} taps: the kernel \"{}\" has 1 to {most}", self.name());
        if (1..=most).contains(&wanted) { Ok(wanted) } else { Err(message()) }
    }
}

/// The header's text with every byte where the file has it; else line and message.
fn toml_of(text: &str) -> Result<String, (usize, String)> {
    let (mut toml, mut in_code, mut found) = (String::new(), false, false);
    for (index, line) in text.split('\n').enumerate() {
        let inner = line.strip_prefix("//!");
        match (inner, in_code) {
            (Some(_), true) => {
                return Err((index + 1, "a header line below code: the header comes first".into()));
            }
            (Some(inner), false) => {
                found = true;
                toml.push_str("   ");
                toml.push_str(inner);
            }
            (None, _) => {
                in_code |= !(line.trim().is_empty() || line.starts_with("//"));
                // Other lines say nothing, but offsets stay the file's own.
                toml.extend(std::iter::repeat_n(' ', line.len()));
            }
        }
        toml.push('\n');
    }
    if found { Ok(toml) } else { Err((1, NO_HEADER.into())) }
}

const NO_HEADER: &str =
    "no header: the file begins with comments such as `//! name = \"mine\"` (docs/your-technique.md)";

/// Line and column of a span, from 1.
fn place_of(text: &str, span: Range<usize>) -> (usize, usize) {
    let before = text.get(..span.start).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    (line, column)
}

fn at(file: &str, place: (usize, usize), message: String) -> ShadowError {
    ShadowError::Own { file: file.into(), place, message }
}
