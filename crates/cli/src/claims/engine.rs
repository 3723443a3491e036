//! Measures what claims need: stage by stage (a scene with its map), window by window, variant by
//! variant, each only in the ways that some claim asks for.

use super::measurements::Measurements;
use super::needs::{Measure, Needs};
use super::place::Place;
use super::store::Store;
use super::subject::variant_of;
use super::ways;
use crate::error::CliError;
use crate::interrupt;
use crate::progress::Progress;
use crate::run::DISAGREEMENT_LIMIT;
use crate::run::unit;
use crate::run::window::{Readings, Request, Window};
use crate::suite::Sampling;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use umbrage_frame::Image;
use umbrage_reference::{Cache, Finder, Tracer, TruthGpu};
use umbrage_scene::Scene;
use umbrage_shadows::{Gpu, Renderer, VariantId};

/// How everything is measured.
pub(crate) struct Settings {
    /// What finds truth, where it is not the CPU.
    pub(crate) truth_gpu: Option<TruthGpu>,
    pub(crate) cache: PathBuf,
    /// Side of the map where a place says nothing else.
    pub(crate) map_texels: u32,
    pub(crate) sampling: Sampling,
}

/// The work in progress.
struct Run<'a> {
    settings: &'a Settings,
    truths: Cache,
    store: Store,
    progress: Progress,
    done: Measurements,
    adapter: String,
}

/// Measures all of it; what was measured before is read back.
pub(crate) fn run(needs: &Needs, settings: &Settings, gpu: &mut Gpu) -> Result<Measurements, CliError> {
    let units: usize = needs.values().flat_map(BTreeMap::values).map(BTreeSet::len).sum();
    let mut run = Run {
        settings,
        truths: Cache::open(settings.cache.join("truth"))?,
        store: Store::open(&settings.cache.join("claims"))?,
        progress: Progress::new((units + needs.len()) as u64),
        done: Measurements::default(),
        adapter: format!("{:?} {}", gpu.description(), unit::program_hash()),
    };
    let mut stages: Vec<Vec<&Place>> = Vec::new();
    for place in needs.keys() {
        match stages.last_mut() {
            Some(stage) if stage[0].stage() == place.stage() => stage.push(place),
            _ => stages.push(vec![place]),
        }
    }
    for stage in stages {
        run.stage(&stage, needs, gpu)?;
    }
    run.progress.finish();
    Ok(run.done)
}

impl Run<'_> {
    /// All places of one scene under one light with one map.
    fn stage(&mut self, places: &[&Place], needs: &Needs, gpu: &mut Gpu) -> Result<(), CliError> {
        let scene = match places[0].build() {
            Ok(scene) => scene,
            Err(CliError::Scene(error)) => {
                places.iter().for_each(|place| self.refuse(place, &error.to_string(), &needs[*place]));
                return Ok(());
            }
            Err(error) => return Err(error),
        };
        let tracer = Tracer::new(&scene)?;
        let mut finder = Finder::new(&tracer, self.settings.truth_gpu.as_ref())?;
        let texels = places[0].map.unwrap_or(self.settings.map_texels);
        let mut renderer = Renderer::new(gpu, &scene, texels)?;
        for place in places {
            if scene.path(&place.path).is_err() {
                let reason = format!("{} has no path {}", scene.name, place.path);
                self.refuse(place, &reason, &needs[*place]);
                continue;
            }
            self.place(place, &needs[*place], (&scene, &mut finder, &mut renderer))?;
        }
        Ok(())
    }

    fn refuse(&mut self, place: &Place, reason: &str, variants: &BTreeMap<String, BTreeSet<Measure>>) {
        self.progress.note(&format!("warning: {}: {reason}", place.label()));
        self.done.refused.insert((place.clone(), None), reason.to_string());
        self.progress.advance(1 + variants.values().map(BTreeSet::len).sum::<usize>() as u64);
    }

    fn place(
        &mut self,
        place: &Place,
        variants: &BTreeMap<String, BTreeSet<Measure>>,
        (scene, finder, renderer): (&Scene, &mut Finder<'_>, &mut Renderer<'_>),
    ) -> Result<(), CliError> {
        interrupt::check(&self.settings.cache)?;
        self.progress.say(format!("{}: truth", place.label()));
        let path = scene.path(&place.path)?;
        let count = self.settings.sampling.window.min(path.frames.len() as u32);
        // From the middle of the path, as in evaluations.
        let first = (path.frames.len() as u32 - count) / 2;
        let frames = &path.frames[first as usize..(first + count) as usize];
        let reads_pixels = variants.values().flatten().any(Measure::reads_pixels);
        let readings = if reads_pixels { Readings::Both } else { Readings::Anchored };
        let request = Request { scene, path, first, step: 1, frames, readings };
        let window = Window::new(&request, (finder, &self.truths, Some(renderer)), &self.settings.sampling)?;
        if window.disagreement() > DISAGREEMENT_LIMIT {
            self.refuse(place, "truth and raster see different surfaces", variants);
            return Ok(());
        }
        self.progress.advance(1);
        renderer.set_anchors(&window.anchors)?;
        self.done.places.insert(place.clone(), ways::facts(&window));
        for (name, measures) in variants {
            let Some(variant) = variant_of(name) else {
                let reason = format!("this build has no variant {name}");
                self.done.refused.insert((place.clone(), Some(name.clone())), reason);
                self.progress.advance(measures.len() as u64);
                continue;
            };
            for measure in measures {
                self.progress.say(format!("{}: {name}", place.label()));
                self.unit(place, (variant, measure), (&window, renderer))?;
                self.progress.advance(1);
            }
        }
        Ok(())
    }

    /// One variant, measured in one way.
    fn unit(
        &mut self,
        place: &Place,
        (variant, measure): (VariantId, &Measure),
        (window, renderer): (&Window, &mut Renderer<'_>),
    ) -> Result<(), CliError> {
        interrupt::check(&self.settings.cache)?;
        let name = variant.name();
        let companion = match measure {
            Measure::Against(other) => match variant_of(other) {
                Some(other) => Some(other),
                None => {
                    let reason = format!("this build has no variant {other}");
                    self.done.refused.insert((place.clone(), Some(name)), reason);
                    return Ok(());
                }
            },
            _ => None,
        };
        let sampling = &self.settings.sampling;
        let mut key = String::new();
        for variant in std::iter::once(variant).chain(companion) {
            key += &unit::key(window, variant, (renderer, sampling, &self.adapter))?;
        }
        let key = blake3::hash(format!("claims 1 {measure:?} {key}").as_bytes()).to_hex().to_string();
        let unit = match self.store.read(&key) {
            Some(stored) => stored,
            None => {
                let fresh = match (measure, companion) {
                    (Measure::Scores, _) => ways::scores(window, (variant, renderer), sampling)?,
                    (Measure::Values, _) => ways::values(window, (variant, renderer), sampling)?,
                    (Measure::Frozen, _) => ways::frozen(window, (variant, renderer))?,
                    (Measure::Pixels, _) => ways::pixels(window, (variant, renderer), sampling)?,
                    (Measure::FrozenPixels, _) => ways::frozen_pixels(window, (variant, renderer))?,
                    (Measure::Against(_), other) => {
                        ways::against(window, (variant, other.unwrap_or(variant)), (renderer, sampling))?
                    }
                };
                self.store.write(&key, &fresh);
                fresh
            }
        };
        let (width, height) = window.size();
        if unit.mask.len() == width as usize * height as usize {
            let plane = Image::from_pixels(width, height, unit.mask).map(|&v| f32::from(v) / 255.0);
            self.done.masks.insert((place.clone(), name.clone()), plane);
        }
        self.done.tables.insert((place.clone(), name, measure.clone()), unit.tables);
        Ok(())
    }
}
