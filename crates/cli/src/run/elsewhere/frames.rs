//! Frames of another program as shadow masks: read, checked, and never silently repaired.

use crate::args::{ScoreArgs, TransferArg};
use crate::error::CliError;
use std::path::{Path, PathBuf};
use umbrage_frame::{Image, NumberedFiles, Picture, Transfer};

/// What is scored: a name and its takes, which differ in noise alone.
pub(crate) struct Subject {
    pub(crate) name: String,
    pub(crate) takes: Vec<NumberedFiles>,
}

/// Everything that frames are read from.
pub(crate) struct Frames {
    pub(crate) subjects: Vec<Subject>,
    pub(crate) unshadowed: Option<NumberedFiles>,
    pub(crate) ambient: Option<NumberedFiles>,
    pub(crate) depth: Option<NumberedFiles>,
    channel: Option<String>,
    transfer: Option<TransferArg>,
    /// Of every picture.
    pub(crate) size: (u32, u32),
    /// Bits of integer pictures.
    pub(crate) bits: Option<u8>,
    /// Whether another take would be the same.
    pub(crate) deterministic: bool,
}

/// A mask; NaN where a ratio is not defined, and nowhere else.
pub(crate) struct Mask {
    pub(crate) image: Image<f32>,
    pub(crate) depth: Option<Image<f32>>,
}

/// Light without shadows below this part of what a bright pixel has: a ratio of it is noise.
const DARK: f32 = 1e-3;
/// A bright pixel is brighter than this part of those with light: a lamp in the picture, or a highlight, may be
/// any number of times brighter.
const BRIGHT: f32 = 0.9;
/// How far a mask may lie outside 0 to 1: rounding of half floats and of a ratio.
const ROUNDING: f32 = 0.01;
/// Frames of a sequence, with its holes.
const MOST_HOLES: usize = 100_000;
/// Numbers that a message lists.
const LISTED: usize = 12;

impl Frames {
    /// Finds the files and looks at the first.
    pub(crate) fn find(args: &ScoreArgs) -> Result<Self, CliError> {
        let mut subjects: Vec<Subject> = Vec::new();
        for given in &args.frames {
            let (name, pattern, is_named) = match given.split_once('=') {
                Some((name, pattern)) if !name.is_empty() && !name.contains(['/', '\\']) => {
                    (name.into(), pattern, true)
                }
                _ => (name_of(given), given.as_str(), false),
            };
            if !is_named && subjects.iter().any(|s| s.name == name) {
                return Err(CliError::Usage(format!(
                    "several --frames are called \"{name}\": are they takes of one variant, or two? Say NAME=PATTERN"
                )));
            }
            let take = NumberedFiles::find(pattern)?;
            match subjects.iter_mut().find(|s| s.name == name) {
                Some(subject) if subject.takes.contains(&take) => {
                    return Err(CliError::Usage(format!("{pattern} is given twice for {name}")));
                }
                Some(subject) => subject.takes.push(take),
                None => subjects.push(Subject { name, takes: vec![take] }),
            }
        }
        let find = |pattern: &Option<String>| pattern.as_deref().map(NumberedFiles::find).transpose();
        let mut frames = Self {
            subjects,
            unshadowed: find(&args.unshadowed)?,
            ambient: find(&args.ambient)?,
            depth: find(&args.depth)?,
            channel: args.channel.clone(),
            transfer: args.transfer,
            size: (0, 0),
            bits: None,
            deterministic: args.deterministic,
        };
        let first = Picture::read(frames.first_file())?;
        if first.bits.is_none() && args.transfer.is_some() {
            return Err(CliError::Usage(format!(
                "--transfer is for code values: {} holds light itself",
                frames.first_file().display()
            )));
        }
        (frames.size, frames.bits) = (first.size(), first.bits);
        if frames.bits.is_some() && args.transfer.is_none() {
            return Err(CliError::Usage(format!(
                "{} has code values, not light: say --transfer srgb (screen captures) or --transfer linear",
                frames.first_file().display()
            )));
        }
        Ok(frames)
    }

    /// The numbers of the first sequence, and those between them.
    pub(crate) fn numbers(&self) -> Vec<u32> {
        let take = self.subjects.first().and_then(|s| s.takes.first());
        let ends = take.and_then(|t| Some((*t.files.keys().next()?, *t.files.keys().last()?)));
        let files = take.map(|t| t.files.keys().copied().collect()).unwrap_or_default();
        match ends {
            // A number that is far off is a file of something else: it will be missed by its own number.
            Some((first, last)) if (last - first) as usize <= MOST_HOLES => (first..=last).collect(),
            _ => files,
        }
    }

    fn first_file(&self) -> &Path {
        let first = self.subjects.first().and_then(|s| s.takes.first()).and_then(|t| t.files.values().next());
        first.map_or(Path::new(""), PathBuf::as_path)
    }

    /// Every sequence.
    fn sequences(&self) -> impl Iterator<Item = &NumberedFiles> {
        let shared = [&self.unshadowed, &self.ambient, &self.depth].into_iter().flatten();
        self.subjects.iter().flat_map(|s| &s.takes).chain(shared)
    }

    /// Checks that every sequence has a file for each of these numbers.
    pub(crate) fn check_numbers(&self, wanted: &[u32]) -> Result<(), CliError> {
        for sequence in self.sequences() {
            let missing: Vec<u32> =
                wanted.iter().copied().filter(|n| !sequence.files.contains_key(n)).collect();
            if !missing.is_empty() {
                let message =
                    format!("{} of {} frames are missing: {}", missing.len(), wanted.len(), listed(&missing));
                return Err(CliError::Frame { path: sequence.pattern.clone().into(), message });
            }
        }
        Ok(())
    }

    /// Numbers that files have, and `what` (cameras, true frames) has not.
    pub(crate) fn spare(&self, wanted: &[u32], what: &str) -> Vec<String> {
        let spare = |s: &NumberedFiles| -> Option<String> {
            let more: Vec<u32> = s.files.keys().copied().filter(|n| !wanted.contains(n)).collect();
            (!more.is_empty()).then(|| format!("{}: no {what} for frames {}", s.pattern, listed(&more)))
        };
        self.sequences().filter_map(spare).collect()
    }

    /// Frames that are the same picture as the one before: right where nothing moves, which nobody can tell
    /// without cameras.
    pub(crate) fn repeated(&self, reference: &NumberedFiles) -> Result<Vec<String>, CliError> {
        let mut notes = Vec::new();
        let takes = self.subjects.iter().flat_map(|s| &s.takes);
        for sequence in takes.chain([reference]) {
            let (mut last, mut same) = (None, Vec::new());
            for &number in reference.files.keys() {
                let picture = Some(self.mask(sequence, number)?.image);
                if picture == last {
                    same.push(number);
                }
                last = picture;
            }
            if !same.is_empty() {
                notes.push(format!(
                    "{}: frames {} repeat the one before them",
                    sequence.pattern,
                    listed(&same)
                ));
            }
        }
        Ok(notes)
    }

    /// A subject's mask in a take and frame.
    pub(crate) fn mask(&self, take: &NumberedFiles, number: u32) -> Result<Mask, CliError> {
        let (path, picture) = self.read(take, number)?;
        let refuse = |message: String| CliError::Frame { path: path.clone(), message };
        let image = match &self.unshadowed {
            None => self.light(&picture, picture.shadow(self.channel.as_deref()).map_err(refuse)?),
            Some(unshadowed) => {
                let with = self.light(&picture, &picture.luminance().map_err(refuse)?);
                self.ratio(&path, &with, (unshadowed, number))?
            }
        };
        if self.unshadowed.is_none() {
            check_finite(&path, &image)?;
            check_range(&path, &image)?;
        }
        let depth = match &self.depth {
            Some(depth) => Some(self.depth(depth, number)?),
            None => picture.depth().cloned(),
        };
        Ok(Mask { image, depth })
    }

    fn depth(&self, files: &NumberedFiles, number: u32) -> Result<Image<f32>, CliError> {
        let (path, picture) = self.read(files, number)?;
        let only = || picture.layers.first().map(|l| &l.1);
        let found = picture.depth().or_else(only).cloned();
        found.ok_or_else(|| CliError::Frame { path, message: "has no channel".into() })
    }

    /// (with - ambient) / (without - ambient).
    fn ratio(
        &self,
        path: &Path,
        with: &Image<f32>,
        (unshadowed, number): (&NumberedFiles, u32),
    ) -> Result<Image<f32>, CliError> {
        let lights = |files: &NumberedFiles| -> Result<Image<f32>, CliError> {
            let (path, picture) = self.read(files, number)?;
            let light =
                picture.luminance().map_err(|message| CliError::Frame { path: path.clone(), message })?;
            check_finite(&path, &light)?;
            Ok(self.light(&picture, &light))
        };
        check_finite(path, with)?;
        let without = lights(unshadowed)?;
        let ambient = self.ambient.as_ref().map(lights).transpose()?;
        let dark = DARK * bright(&without);
        let (width, height) = self.size;
        let ratio = |x, y| {
            let ambient = ambient.as_ref().map_or(0.0, |a| *a.at(x, y));
            let all = without.at(x, y) - ambient;
            if all <= dark { f32::NAN } else { (with.at(x, y) - ambient) / all }
        };
        let image = Image::from_fn(width, height, ratio);
        // Noise takes single pixels over 1; pictures that were swapped take whole shadows there.
        let brighter = image.pixels().iter().filter(|v| **v > 1.5).count();
        if brighter * 50 > image.pixels().len() {
            let message = format!(
                "{brighter} pixels are brighter with shadows than without: is --unshadowed the other way round, or of another \
                 exposure?"
            );
            return Err(CliError::Frame { path: path.into(), message });
        }
        Ok(image)
    }

    /// Code values become light; floats are it.
    fn light(&self, picture: &Picture, codes: &Image<f32>) -> Image<f32> {
        match self.transfer().filter(|_| picture.bits.is_some()) {
            Some(transfer) => codes.map(|&code| transfer.decode(code)),
            None => codes.clone(),
        }
    }

    fn transfer(&self) -> Option<Transfer> {
        self.transfer.map(|t| match t {
            TransferArg::Linear => Transfer::Linear,
            TransferArg::Srgb => Transfer::Srgb,
        })
    }

    /// The mean squared error that steps of an integer format make at these lights: a uniform distribution over
    /// a step has a variance of its square over 12. None for floats.
    pub(crate) fn quantisation(&self, lights: impl Iterator<Item = f32>) -> Option<f64> {
        if self.unshadowed.is_some() {
            // Of a ratio it depends on how bright the picture is.
            return None;
        }
        let (bits, transfer) = (self.bits?, self.transfer()?);
        let step = 1.0 / f64::from((1u32 << bits) - 1);
        let (mut sum, mut count) = (0.0, 0usize);
        for light in lights {
            sum += (step * f64::from(transfer.slope(light.clamp(0.0, 1.0)))).powi(2) / 12.0;
            count += 1;
        }
        Some(sum / count.max(1) as f64)
    }

    fn read(&self, files: &NumberedFiles, number: u32) -> Result<(PathBuf, Picture), CliError> {
        let Some(path) = files.files.get(&number) else {
            let message = format!("has no frame {number}");
            return Err(CliError::Frame { path: files.pattern.clone().into(), message });
        };
        let picture = Picture::read(path)?;
        let refuse = |message: String| Err(CliError::Frame { path: path.clone(), message });
        if let Some(odd) = picture.layers.iter().find(|l| (l.1.width(), l.1.height()) != self.size) {
            let ((w, h), (width, height)) = ((odd.1.width(), odd.1.height()), self.size);
            return refuse(format!(
                "has {w}x{h} pixels, but {} has {width}x{height}: all frames must be of one size",
                self.first_file().display()
            ));
        }
        if picture.bits.is_some() && self.transfer.is_none() {
            return refuse("has code values, not light: say --transfer srgb or --transfer linear".into());
        }
        Ok((path.clone(), picture))
    }
}

/// What is bright in a picture; 0 where nothing has light.
fn bright(picture: &Image<f32>) -> f32 {
    let mut lit: Vec<f32> = picture.pixels().iter().copied().filter(|&v| v > 0.0).collect();
    lit.sort_unstable_by(f32::total_cmp);
    lit.get((lit.len() as f32 * BRIGHT) as usize).copied().unwrap_or(0.0)
}

/// The folder's name, or the file's up to its number: "chss/shadow.####.exr" is "chss".
fn name_of(pattern: &str) -> String {
    let path = Path::new(pattern);
    let folder = if path.is_dir() { Some(path) } else { path.parent() };
    let folder = folder.and_then(Path::file_name).map(|n| n.to_string_lossy().into_owned());
    let stem = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let stem: String = stem.split(['#', '%', '*', '.']).next().unwrap_or_default().into();
    folder.filter(|f| !f.is_empty() && f != "..").unwrap_or(if stem.is_empty() {
        "frames".into()
    } else {
        stem
    })
}

/// "3, 4, 9 and 20 more".
pub(super) fn listed(numbers: &[u32]) -> String {
    let some: Vec<String> = numbers.iter().take(LISTED).map(u32::to_string).collect();
    match numbers.len().checked_sub(LISTED) {
        Some(more @ 1..) => format!("{} and {more} more", some.join(", ")),
        _ => some.join(", "),
    }
}

fn check_finite(path: &Path, image: &Image<f32>) -> Result<(), CliError> {
    let odd = image.pixels().iter().filter(|v| !v.is_finite()).count();
    let Some(first) = image.pixels().iter().position(|v| !v.is_finite()) else { return Ok(()) };
    let (x, y) = (first as u32 % image.width(), first as u32 / image.width());
    let message = format!("{odd} pixels are NaN or infinite, the first at ({x}, {y})");
    Err(CliError::Frame { path: path.into(), message })
}

/// A beauty picture, or an inverted scale, is not taken for a shadow.
fn check_range(path: &Path, image: &Image<f32>) -> Result<(), CliError> {
    let outside = |v: &&f32| **v < -ROUNDING || **v > 1.0 + ROUNDING;
    let count = image.pixels().iter().filter(outside).count();
    let wild = |v: &&f32| **v < -1.0 || **v > 2.0;
    if count * 1000 <= image.pixels().len() && !image.pixels().iter().any(|v| wild(&v)) {
        return Ok(());
    }
    let (low, high) = image.pixels().iter().fold((f32::MAX, f32::MIN), |(l, h), &v| (l.min(v), h.max(v)));
    let message = format!(
        "{count} pixels are outside 0 to 1 ({low} to {high}): a shadow is the unoccluded part of the light. For pictures with \
         the shadow in them give --unshadowed, for another channel --channel"
    );
    Err(CliError::Frame { path: path.into(), message })
}
