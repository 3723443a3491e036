//! One run of a variant on the adapter, and its comparison with the twin.

use crate::bands::Bands;
use crate::support::{self, still_life};
use crate::twins::light::Light;
use crate::twins::pattern::Pattern;
use crate::twins::plain::{Plain, Spot, shade};
use crate::twins::screen::{Receiver, anchor, surface};
use crate::twins::variants::{Answer, Twin};
use umbrage_frame::{Anchors, Image, View};
use umbrage_scene::{AreaLight, Scene};
use umbrage_shadows::{Bias, Dump, Pass, Projection, Renderer, Seeding, VariantId};

/// Side of the tests' shadow map: not a power of two, so that no division is exact by luck.
pub(crate) const MAP_TEXELS: u32 = 500;

/// Frames that a technique may look back.
const MOST_HISTORY: usize = 3;

/// What is run.
#[derive(Clone)]
pub(crate) struct Case {
    pub(crate) variant: VariantId,
    pub(crate) light: AreaLight,
    pub(crate) seeding: Seeding,
    /// Frame and seed of the pattern.
    pub(crate) pattern: [u32; 2],
    pub(crate) bias: Bias,
    /// Where the camera was in the frames before, newest first; without any it stood still.
    pub(crate) past: Vec<View>,
}

/// What the adapter computed.
pub(crate) struct Ran {
    pub(crate) scene: Scene,
    pub(crate) case: Case,
    pub(crate) values: Vec<f32>,
    pub(crate) dumps: Vec<Dump>,
    /// The frame's own pixel centres as anchors, and what the variant says there.
    pub(crate) anchors: Anchors,
    pub(crate) anchored: Vec<f32>,
}

/// Where a result is taken.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Reading {
    Pixels,
    Anchors,
}

/// One in four at irregular places: enough, and fast.
fn is_compared(index: usize) -> bool {
    (index as u32).wrapping_mul(0x9e37_79b9) >> 30 == 0
}

/// The comparison of many results.
#[derive(Debug, Default)]
pub(crate) struct Tally {
    pub(crate) compared: usize,
    /// Results that depend on a rounding.
    pub(crate) open: usize,
    /// Results outside of their bounds.
    pub(crate) wrong: Vec<String>,
}

/// The constants of all compute passes of a case.
pub(crate) fn constants(case: &Case) -> Vec<(&'static str, f64)> {
    let (scene, view) = (still_life::scene(), still_life::view_of(&still_life::camera()));
    let mut gpu = support::gpu();
    let mut renderer = Renderer::new(&mut gpu, &scene, MAP_TEXELS).expect("fits");
    let recording = renderer.recording(case.variant, (&view, &case.light), (case.seeding, case.pattern));
    let of_pass = |pass: &Pass| match pass {
        Pass::Raster(_) => Vec::new(),
        Pass::Compute(compute) => compute.constants.clone(),
    };
    recording.expect("fits").passes.iter().flat_map(of_pass).collect()
}

impl std::fmt::Debug for Case {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{} {:?} {:?} {:?} {:?}",
            self.variant.name(),
            self.light,
            self.seeding,
            self.pattern,
            self.bias
        )
    }
}

impl Case {
    /// A variant at its own bias, with a fresh pattern.
    pub(crate) fn new(variant: VariantId, light: AreaLight) -> Self {
        let bias = variant.calibration.default_bias();
        Self { variant, light, seeding: Seeding::Fresh, pattern: [3, 7], bias, past: Vec::new() }
    }

    /// The camera of so many frames ago.
    pub(crate) fn view(&self, age: usize) -> View {
        let now = still_life::view_of(&still_life::camera());
        if age == 0 { now } else { *self.past.get(age - 1).or(self.past.last()).unwrap_or(&now) }
    }

    /// Runs it over the frame and over the frame's pixel centres as anchors.
    pub(crate) fn run(&self) -> Ran {
        let scene = still_life::scene();
        let view = still_life::view_of(&still_life::camera());
        let mut gpu = support::gpu();
        let mut renderer = Renderer::new(&mut gpu, &scene, MAP_TEXELS).expect("fits");
        renderer.set_bias(self.bias);
        renderer.set_past(self.past.clone());
        let anchors = Anchors::of(&renderer.gbuffer(&view, &self.light).expect("rasterises"));
        renderer.set_anchors(&anchors).expect("fits");
        let what = ((&view, &self.light), (self.seeding, self.pattern));
        let anchored = renderer.shade_anchors(self.variant, what.0, what.1).expect("runs").values;
        let (shaded, dumps) = renderer.dump(self.variant, what.0, what.1).expect("runs");
        drop(gpu);
        Ran { scene, case: self.clone(), values: shaded.values, dumps, anchors, anchored }
    }
}

impl Ran {
    /// A target by its label.
    pub(crate) fn channels(&self, label: &str) -> &[Image<f32>] {
        let found = self.dumps.iter().find(|dump| dump.label == label);
        &found.unwrap_or_else(|| panic!("{} dumps no {label}", self.case.variant.name())).channels
    }

    /// The first channel of a target.
    pub(crate) fn image(&self, label: &str) -> &Image<f32> {
        &self.channels(label)[0]
    }

    /// The surface at a pixel, from the pipeline's own depth and normals.
    pub(crate) fn surface(&self, pixel: [u32; 2]) -> Option<Receiver> {
        self.surface_of(0, pixel)
    }

    /// The same in the frame of so many frames ago.
    pub(crate) fn surface_of(&self, age: usize, pixel: [u32; 2]) -> Option<Receiver> {
        let [depth, normal] = match age {
            0 => ["camera-depth".to_string(), "camera-normal".to_string()],
            _ => ["depth", "normal"].map(|what| format!("earlier-{age}-{what}")),
        };
        surface(&self.case.view(age), (self.image(&depth), self.channels(&normal)), pixel)
    }

    pub(crate) fn light(&self) -> Light {
        let of = match self.case.variant.variant.technique.projection() {
            Projection::Guarded => Light::guarded,
            Projection::Single | Projection::Cube => Light::new,
        };
        of(&self.scene, &self.case.light, MAP_TEXELS)
    }

    /// The twin of a pass of this run: 0 for the last, 1 for the mask.
    pub(crate) fn twin<'a>(&'a self, light: &'a Light, pass: u32) -> Twin<'a> {
        let source = match self.case.variant.variant.name {
            "chss-mask" => Some(self.image("penumbra-mask-blurred")),
            "chss-min" => Some(self.image("min-map-blurred")),
            _ => None,
        };
        let [frame, seed] = self.case.pattern;
        Twin {
            light,
            calibration: self.case.variant.calibration,
            bias: self.case.bias,
            pattern: Pattern { seeding: self.case.seeding, frame, seed, pass },
            depths: self.image("shadow-map"),
            source,
        }
    }

    /// The plain twin of a pass of this run.
    pub(crate) fn plain<'a>(&'a self, light: &'a Light, pass: u32) -> Plain<'a> {
        let Twin { calibration, bias, pattern, .. } = self.twin(light, pass);
        let views = (0..=MOST_HISTORY).map(|age| self.case.view(age)).collect();
        Plain { light, calibration, bias, pattern, views, dumps: &self.dumps }
    }

    /// One in four pixels, or anchors, against the band of the plain twin.
    pub(crate) fn compare_plain(&self, reading: Reading) -> Bands {
        let (light, mut bands) = (self.light(), Bands::default());
        let (plain, name) = (self.plain(&light, 0), self.case.variant.variant.name);
        let mut add = |receiver: &Receiver, value: f32| {
            bands.compare(value, &Spot::of(receiver), |s| shade(&plain, name, s));
        };
        match reading {
            Reading::Pixels => {
                for (index, &value) in self.values.iter().enumerate().filter(|(k, _)| is_compared(*k)) {
                    let pixel = [index as u32 % still_life::SIZE.0, index as u32 / still_life::SIZE.0];
                    self.surface(pixel).iter().for_each(|receiver| add(receiver, value));
                }
            }
            Reading::Anchors => {
                for (k, &value) in self.anchored.iter().enumerate().filter(|(k, _)| is_compared(*k)) {
                    let (position, normal) = (self.anchors.position[k], self.anchors.normal[k]);
                    add(&anchor(&self.anchors.view, position, normal), value);
                }
            }
        }
        bands
    }

    /// Every pixel of the frame against the twin.
    pub(crate) fn compare_frame(&self) -> Tally {
        let (light, mut tally) = (self.light(), Tally::default());
        let twin = self.twin(&light, 0);
        let name = self.case.variant.variant.name;
        for (index, &value) in self.values.iter().enumerate() {
            let pixel = [index as u32 % still_life::SIZE.0, index as u32 / still_life::SIZE.0];
            match self.surface(pixel) {
                Some(receiver) => tally.add(twin.shade(name, &receiver), value, pixel),
                None => assert!(value == 1.0, "{pixel:?} sees nothing and is {value}"),
            }
        }
        tally
    }

    /// Both readings of a point against each other: wherever no decision is open, they differ by no
    /// more than the bounds of the pixel's.
    pub(crate) fn check_readings_agree(&self) {
        let (light, name) = (self.light(), self.case.variant.variant.name);
        let twin = self.twin(&light, 0);
        for (k, &anchored) in self.anchored.iter().enumerate() {
            let index = self.anchors.pixel[k];
            let pixel = [index % still_life::SIZE.0, index / still_life::SIZE.0];
            let receiver = self.surface(pixel).expect("anchors are surfaces");
            // A pixel whose every decision is clear leaves its anchor no choice.
            if let Some([lit]) = twin.shade(name, &receiver).as_deref()
                && lit.open == 0
            {
                let frame = self.values[index as usize];
                let limit = lit.high - lit.low;
                let difference = f64::from(anchored - frame).abs();
                assert!(difference <= limit, "{pixel:?} is {frame}, its anchor {anchored}, limit {limit}");
            }
        }
    }

    /// Every anchor against the twin.
    pub(crate) fn compare_anchors(&self) -> Tally {
        let (light, mut tally) = (self.light(), Tally::default());
        let twin = self.twin(&light, 0);
        for (k, &value) in self.anchored.iter().enumerate() {
            let (position, normal) = (self.anchors.position[k], self.anchors.normal[k]);
            let receiver = anchor(&self.anchors.view, position, normal);
            let pixel = self.anchors.pixel[k];
            let pixel = [pixel % still_life::SIZE.0, pixel / still_life::SIZE.0];
            tally.add(twin.shade(self.case.variant.variant.name, &receiver), value, pixel);
        }
        tally
    }
}

impl Tally {
    fn add(&mut self, answer: Answer, value: f32, pixel: [u32; 2]) {
        self.compared += 1;
        let Some(alternatives) = answer else {
            self.open += 1;
            return;
        };
        self.open += usize::from(alternatives.len() > 1 || alternatives[0].open > 0);
        if !alternatives.iter().any(|lit| lit.admits(value)) {
            self.wrong.push(format!("{pixel:?}: {value} is not in {alternatives:?}"));
        }
    }

    /// Fails unless everything lies within its bounds and few results are open.
    pub(crate) fn check(&self, what: &str, largest_open_share: f64) {
        let some: Vec<_> = self.wrong.iter().take(5).collect();
        assert!(some.is_empty(), "{what}: {} of {} are wrong: {some:#?}", self.wrong.len(), self.compared);
        assert!(self.compared > 1000, "{what}: only {} compared", self.compared);
        let share = self.open as f64 / self.compared as f64;
        assert!(share <= largest_open_share, "{what}: {share:.4} of all depend on a rounding");
    }
}
