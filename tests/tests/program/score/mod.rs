//! Frames of another engine: scored, and refused where cameras or files are wrong.

mod cameras;
mod files;

use std::path::{Path, PathBuf};
use umbrage_frame::{Image, Layer, read_exr, write_exr};
use umbrage_scene::{Camera, Scene};
use umbrage_tests::{Card, Ran, run, umbrage};

/// Five frames of a path with parallax, as another engine would hand them over: truth itself, with depth.
struct Handed {
    home: tempfile::TempDir,
    cameras: Vec<Camera>,
}

const FIRST: usize = 50;
const COUNT: usize = 5;
const SIZE: &str = "160x90";

impl Handed {
    fn new() -> Self {
        let home = tempfile::tempdir().expect("a temporary folder");
        let scene = Scene::builtin("colonnade").expect("a standard scene");
        let path = scene.path("P1").expect("a path");
        // Every tenth frame: 33 cm apart.
        let frames: Vec<usize> = (0..COUNT).map(|i| FIRST + 10 * i).collect();
        for (number, frame) in frames.iter().enumerate() {
            let line = format!(
                "reference colonnade --path P1 --frame {frame} --size {SIZE} --samples 128 --only-v --reference-on cpu \
                 --out truth.{number:04}.exr"
            );
            run(&mut umbrage(home.path(), &line)).ended_with(0);
        }
        let cameras = frames.iter().map(|&f| path.frames[f].camera).collect();
        let handed = Self { home, cameras };
        handed.rewrite("shadow", |_, image| image.clone());
        handed.write_cameras("cameras.json", "{}", |c| c.world_from_camera.to_cols_array().map(f64::from));
        handed
    }

    fn folder(&self) -> &Path {
        self.home.path()
    }

    fn truth(&self, number: usize) -> Vec<Layer> {
        read_exr(&self.folder().join(format!("truth.{number:04}.exr"))).expect("read")
    }

    /// Masks alone, changed.
    fn rewrite(&self, stem: &str, change: impl Fn(usize, &Image<f32>) -> Image<f32>) {
        for number in 0..COUNT {
            let layers = self.truth(number);
            let mask = &layers.iter().find(|l| l.0 == "reference.V").expect("a shadow").1;
            let file = self.folder().join(format!("{stem}.{number:04}.exr"));
            write_exr(&file, &[("shadow.V".into(), change(number, mask))]).expect("written");
        }
    }

    fn write_cameras(&self, file: &str, convention: &str, numbers: impl Fn(&Camera) -> [f64; 16]) {
        let frame = |(i, c): (usize, &Camera)| {
            format!(
                "{{\"index\": {i}, \"world_from_camera\": {:?}, \"yfov\": {}}}",
                numbers(c),
                c.yfov_radians
            )
        };
        let frames: Vec<String> = self.cameras.iter().enumerate().map(frame).collect();
        let text =
            format!("{{\"version\": 1, \"convention\": {convention}, \"frames\": [{}]}}", frames.join(",\n"));
        std::fs::write(self.folder().join(file), text).expect("written");
    }

    fn score(&self, more: &str) -> Ran {
        let line =
            format!("score --scene colonnade --samples 64 --reference-on cpu --cache cache --out run {more}");
        run(&mut umbrage(self.folder(), &line))
    }
}

/// By depth, and by the shadow alone.
const WAYS: [&str; 2] = ["--frames truth.####.exr --channel reference.V", "--frames shadow.####.exr"];

#[test]
fn truth_scores_at_its_noise() {
    let handed = Handed::new();
    let ran = handed.score(&format!("--cameras cameras.json {}", WAYS[0])).ended_with(0);
    assert!(ran.stderr.contains("the cameras fit the frames: 0.0"), "{}", ran.stderr);
    let card = Card::load(&handed.folder().join("run"));
    let (_, _, scores) = card.results()[0];
    // A fresh estimate of 256 samples has a standard error of .006 on average in this penumbra, and less
    // than .01 anywhere but at single points.
    let error = scores["error"]["value"].as_f64().expect("ERROR");
    assert!(error < 0.01, "{error}");
    for id in ["noise", "edge_crawl"] {
        assert!(scores[id]["not_measured"].is_string(), "{id}: {}", scores[id]);
    }
    // Several takes have noise; a name groups them.
    handed.rewrite("take", |n, image| noisy(image, 7 + n as u32));
    handed.rewrite("more", |n, image| noisy(image, 90 + n as u32));
    let takes = "--cameras cameras.json --frames mine=take.####.exr --frames mine=more.####.exr";
    handed.score(takes).ended_with(0);
    let card = Card::load(&handed.folder().join("run"));
    let (_, _, scores) = card.results()[0];
    // Uniform noise of +-.1 has a variance of .2^2 / 12 = 3.3e-3; clamped at 0 or 1, .1^2 / 6 - .025^2 = 1.04e-3.
    let noise = scores["noise"]["value"].as_f64().expect("noise");
    assert!((1.0e-3..3.4e-3).contains(&noise), "{noise}");
    // Three takes can be gated, one cannot: nobody knows how much it varies.
    handed.rewrite("third", |n, image| noisy(image, 300 + n as u32));
    let three = format!("{takes} --frames mine=third.####.exr");
    handed.score(&format!("{three} --save-baseline mine")).ended_with(0);
    handed.score(&format!("{three} --baseline mine")).ended_with(0);
    let one = "--cameras cameras.json --frames one=take.####.exr";
    handed.score(&format!("{one} --save-baseline one")).ended_with(0).says("or --deterministic");
    handed.score(&format!("{one} --baseline one")).ended_with(3).says("--deterministic");
    handed.score(&format!("{one} --deterministic --save-baseline one")).ended_with(0);
    handed.score(&format!("{one} --deterministic --baseline one")).ended_with(0);
    handed.score(takes).ended_with(0);
    // The page opens and says what this is.
    let page = std::fs::read_to_string(handed.folder().join("run/index.html")).expect("a page");
    assert!(page.contains("from elsewhere") && page.contains("with edge crawl"));
}

fn noisy(image: &Image<f32>, seed: u32) -> Image<f32> {
    let mut state = seed.wrapping_mul(0x9e37_79b9) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        state as f32 / u32::MAX as f32
    };
    image.map(|v| (v + 0.2 * next() - 0.1).clamp(0.0, 1.0))
}

/// Pictures with the shadow in them, against pictures without.
#[test]
fn a_ratio_of_pictures_is_a_shadow() {
    let handed = Handed::new();
    for number in 0..COUNT {
        let layers = handed.truth(number);
        let mask = &layers.iter().find(|l| l.0 == "reference.V").expect("a shadow").1;
        // Some texture, a sky that adds light, and a corner without any light of the lamp.
        let light = |x: u32, y: u32| if x < 8 { 0.0 } else { 0.3 + 0.1 * ((x / 8 + y / 8) % 2) as f32 };
        let picture = |factor: &dyn Fn(u32, u32) -> f32| {
            Image::from_fn(mask.width(), mask.height(), |x, y| 0.05 + light(x, y) * factor(x, y))
        };
        let all = [
            ("lit", picture(&|x, y| *mask.at(x, y))),
            ("bright", picture(&|_, _| 1.0)),
            ("dim", picture(&|_, _| 0.0)),
        ];
        for (stem, image) in all {
            let rgb: Vec<Layer> = ["R", "G", "B"].iter().map(|c| (c.to_string(), image.clone())).collect();
            write_exr(&handed.folder().join(format!("{stem}.{number:04}.exr")), &rgb).expect("written");
        }
    }
    let line =
        "--cameras cameras.json --frames lit.####.exr --unshadowed bright.####.exr --ambient dim.####.exr";
    let ran = handed.score(line).ended_with(0);
    let card = Card::load(&handed.folder().join("run"));
    assert!(card.results()[0].2["error"]["value"].as_f64().expect("ERROR") < 0.01, "{}", ran.stderr);
    let notes = card.windows()[0]["notes"].to_string();
    assert!(notes.contains("without shadows they have no light"), "{notes}");
    // A lamp in the picture does not make the rest dark.
    let errors = card.results()[0].2["error"]["value"].clone();
    for number in 0..COUNT {
        for stem in ["lit", "bright", "dim"] {
            let file = handed.folder().join(format!("{stem}.{number:04}.exr"));
            let mut layers = read_exr(&file).expect("read");
            layers.iter_mut().for_each(|l| l.1.pixels_mut()[0] = 5000.0);
            write_exr(&file, &layers).expect("written");
        }
    }
    handed.score(line).ended_with(0);
    assert_eq!(Card::load(&handed.folder().join("run")).results()[0].2["error"]["value"], errors);
    let swapped =
        line.replace("lit.####", "x").replace("bright.####", "lit.####").replace("x.exr", "bright.####.exr");
    handed.score(&swapped).ended_with(4).says("the other way round");
    // A picture is not taken for a shadow.
    for number in 0..COUNT {
        let file = |stem: &str| -> PathBuf { handed.folder().join(format!("{stem}.{number:04}.exr")) };
        let brighter: Vec<Layer> = read_exr(&file("bright"))
            .expect("read")
            .into_iter()
            .map(|(n, i)| (n, i.map(|v| v * 9.0)))
            .collect();
        write_exr(&file("glare"), &brighter).expect("written");
    }
    handed.score("--cameras cameras.json --frames glare.####.exr").ended_with(4).says("outside 0 to 1");
}

#[test]
fn pngs_need_their_curve_and_show_their_floor() {
    let handed = Handed::new();
    for number in 0..COUNT {
        let layers = handed.truth(number);
        let mask = &layers.iter().find(|l| l.0 == "reference.V").expect("a shadow").1;
        let code = |v: f32| if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 };
        let grey = image::GrayImage::from_fn(mask.width(), mask.height(), |x, y| {
            image::Luma([(255.0 * code(*mask.at(x, y))).round() as u8])
        });
        grey.save(handed.folder().join(format!("grey_{number}.png"))).expect("written");
    }
    let line = "--cameras cameras.json --frames grey_#.png";
    handed.score(line).ended_with(2).says("--transfer srgb");
    handed.score(&format!("{line} --transfer srgb")).ended_with(0);
    let card = Card::load(&handed.folder().join("run"));
    assert!(card.results()[0].2["error"]["value"].as_f64().expect("ERROR") < 0.012);
    let notes = card.windows()[0]["notes"].to_string();
    assert!(notes.contains("8 bits make an error of"), "{notes}");
}
