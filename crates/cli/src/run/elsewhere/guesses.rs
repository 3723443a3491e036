//! The usual mistakes with cameras, each with what it would have been and what to do.

use glam::{DVec3, Mat4, Vec3};
use umbrage_scene::{Camera, CameraFile, Convention, Preset};

/// Cameras with one mistake taken back.
pub(super) struct Guess {
    pub(super) cameras: Vec<Camera>,
    /// Frames later by so many.
    pub(super) offset: isize,
    /// Left for right, top for bottom.
    pub(super) flip: [bool; 2],
    /// Metres in a unit of the frames' depth.
    pub(super) depth_unit: f32,
    /// "with the cameras read as Unity's".
    pub(super) words: String,
    pub(super) cure: String,
}

impl Guess {
    /// The cameras as they are.
    pub(super) fn none(cameras: &[Camera]) -> Self {
        Self::new(cameras.to_vec(), "", "")
    }

    fn new(cameras: Vec<Camera>, words: impl Into<String>, cure: impl Into<String>) -> Self {
        let (words, cure) = (words.into(), cure.into());
        Self { cameras, offset: 0, flip: [false; 2], depth_unit: 1.0, words, cure }
    }

    /// Where in the picture a pixel of the cameras' is.
    pub(super) fn flipped(&self, pixel: u32, (width, height): (u32, u32)) -> u32 {
        let (x, y) = (pixel % width, pixel / width);
        let x = if self.flip[0] { width - 1 - x } else { x };
        let y = if self.flip[1] { height - 1 - y } else { y };
        y * width + x
    }
}

/// Everything that is tried: `file` where the cameras are written in one.
pub(super) fn guesses(given: &[Camera], aspect: f32, file: Option<(&CameraFile, DVec3)>) -> Vec<Guess> {
    // On ties the first counts: an engine's name says more than an axis.
    let mut all: Vec<Guess> =
        file.into_iter().flat_map(|(file, origin)| of_conventions(file, origin)).collect();
    all.extend(of_pictures(given));
    all.extend(of_lenses(given, aspect));
    all.extend(of_places(given));
    all.extend(of_depth(given));
    all
}

fn of_depth(given: &[Camera]) -> impl Iterator<Item = Guess> {
    let units = [
        ("centimetres", 0.01),
        ("millimetres", 0.001),
        ("kilometres", 1000.0),
        ("feet", 0.3048),
        ("inches", 0.0254),
    ];
    units.into_iter().map(|(name, depth_unit)| Guess {
        depth_unit,
        ..Guess::new(given.to_vec(), format!("with the frames' depth in {name}"), "write depth in metres")
    })
}

fn of_pictures(given: &[Camera]) -> Vec<Guess> {
    let later = |offset: isize, words: &str| Guess {
        offset,
        ..Guess::new(
            given.to_vec(),
            words,
            "shift \"index\" in the cameras' file, or the numbers of the frames",
        )
    };
    let flip = |flip: [bool; 2], words: &str| Guess {
        flip,
        ..Guess::new(given.to_vec(), words, "write row 0 at the top, and columns from the left")
    };
    vec![
        flip([false, true], "with the pictures upside down"),
        flip([true, false], "with left and right of the pictures swapped (a left-handed camera?)"),
        flip([true, true], "with the pictures turned by half a turn"),
        later(1, "with each frame's camera taken from the next frame (off by one)"),
        later(-1, "with each frame's camera taken from the frame before (off by one)"),
    ]
}

/// Finer steps near 1, where a sensor's size or an aspect ratio was rounded.
const SCALES: [f32; 14] = [0.5, 0.667, 0.8, 0.9, 0.95, 0.98, 0.99, 1.01, 1.02, 1.05, 1.1, 1.25, 1.5, 2.0];

fn of_lenses(given: &[Camera], aspect: f32) -> Vec<Guess> {
    let scaled = |by: f32| -> Vec<Camera> {
        let lens =
            |c: &Camera| Camera { yfov_radians: 2.0 * ((0.5 * c.yfov_radians).tan() * by).atan(), ..*c };
        given.iter().map(lens).collect()
    };
    let degrees = |cameras: &[Camera]| cameras.first().map_or(0.0, |c| c.yfov_radians.to_degrees());
    let mut all: Vec<Guess> = SCALES
        .iter()
        .map(|&by| {
            let cameras = scaled(by);
            let words = format!(
                "with a vertical field of view of {:.2} degrees in place of {:.2}",
                degrees(&cameras),
                degrees(given)
            );
            Guess::new(
                cameras,
                words,
                "give the vertical field of view, in radians, of the picture as it was written",
            )
        })
        .collect();
    all.push(Guess::new(
        scaled(1.0 / aspect),
        "with the field of view taken for the horizontal one",
        "\"yfov\" is the vertical field of view: 2 atan(tan(x / 2) height / width)",
    ));
    all
}

fn of_places(given: &[Camera]) -> Vec<Guess> {
    let placed = |place: &dyn Fn(Mat4) -> Mat4| -> Vec<Camera> {
        given.iter().map(|c| Camera { world_from_camera: place(c.world_from_camera), ..*c }).collect()
    };
    let farther = |by: f32| move |m: Mat4| Mat4 { w_axis: (m.w_axis.truncate() * by).extend(1.0), ..m };
    let turned = |turn: Mat4| move |m: Mat4| turn * m;
    // A mirrored world with a camera that is mirrored with it is a camera again.
    let mirrored =
        |axis: Vec3| move |m: Mat4| Mat4::from_scale(axis) * m * Mat4::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    let axes = "set \"right\", \"up\" and \"forward\" of the convention, or --convention ENGINE";
    let units = "set \"units_per_meter\" of the convention";
    let half = std::f32::consts::PI;
    vec![
        Guess::new(placed(&farther(0.01)), "with the cameras' places in centimetres", units),
        Guess::new(placed(&farther(100.0)), "with the scene in centimetres and the cameras in metres", units),
        Guess::new(placed(&farther(0.001)), "with the cameras' places in millimetres", units),
        Guess::new(
            placed(&mirrored(Vec3::new(-1.0, 1.0, 1.0))),
            "with the other handedness (x mirrored)",
            axes,
        ),
        Guess::new(
            placed(&mirrored(Vec3::new(1.0, 1.0, -1.0))),
            "with the other handedness (z mirrored)",
            axes,
        ),
        Guess::new(
            placed(&turned(Mat4::from_rotation_y(half))),
            "with the scene turned by half a turn about y",
            axes,
        ),
        Guess::new(
            placed(&turned(Mat4::from_rotation_x(-0.5 * half))),
            "with z up in the cameras' world",
            axes,
        ),
        Guess::new(
            placed(&turned(Mat4::from_rotation_x(0.5 * half))),
            "with y up in the cameras' world",
            axes,
        ),
        Guess::new(
            placed(&|m: Mat4| m * Mat4::from_rotation_y(half)),
            "with cameras that look along their +z",
            "set \"camera_forward\" of the convention",
        ),
        Guess::new(
            placed(&|m: Mat4| m.inverse()),
            "with the matrices taken for world to camera",
            "write the camera's place in the world: the inverse of a view matrix",
        ),
    ]
}

/// The file's numbers read as other engines write them.
fn of_conventions(file: &CameraFile, origin: DVec3) -> Vec<Guess> {
    let mut all: Vec<Guess> = Vec::new();
    // Godot and Bevy are as glTF.
    for preset in [Preset::Gltf, Preset::Blender, Preset::Unity, Preset::Unreal] {
        // The numbers may follow each other as the engine has them, or as the file says.
        let own = preset.convention();
        let as_written = Convention { matrix_order: file.convention.matrix_order, ..own };
        for convention in [own, as_written] {
            if convention == file.convention {
                continue;
            }
            let Ok(cameras) = file.cameras(&convention, origin) else { continue };
            let cameras = cameras.iter().map(|c| c.camera).collect();
            let words = format!("with the cameras read as {} writes them", preset.name());
            all.push(Guess::new(cameras, words, format!("--convention {}", preset.name())));
        }
    }
    all
}
