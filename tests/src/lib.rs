//! What the end-to-end tests share: the program, its scorecards, and small models.
//!
//! Deliberately absent: any way to skip a test. Without a graphics adapter, or without the program,
//! they fail and say what to do.

mod card;
mod models;
mod program;

pub use card::{Card, Span};
pub use models::{Mesh, scene_toml};
pub use program::{Ran, files_below, program, run, umbrage};

use tempfile::TempDir;

/// An empty folder that goes away with the value.
///
/// # Panics
/// When the system gives none.
pub fn empty_folder() -> TempDir {
    tempfile::Builder::new().prefix("umbrage-").tempdir().expect("a temporary folder")
}

/// A folder with `model.obj`: a plate, a tall box and a low one over a floor; and `scene.toml`, which
/// looks at them under a sun of 2 degrees.
///
/// # Panics
/// When the files cannot be written.
pub fn folder_with_scene() -> TempDir {
    let folder = empty_folder();
    std::fs::write(folder.path().join("model.obj"), Mesh::boxes_on_a_floor().to_obj()).expect("written");
    std::fs::write(folder.path().join("scene.toml"), scene_toml(SUN, DOLLY)).expect("written");
    folder
}

/// The table of a sun with penumbrae.
pub const SUN: &str =
    "kind = \"sun\"\nangular_diameter_degrees = 2.0\nelevation_degrees = 50.0\nazimuth_degrees = 30.0";

/// The motion of a camera that looks at the boxes and moves towards them.
pub const DOLLY: &str =
    "kind = \"dolly\", eye = [0.0, 3.0, 6.0], target = [0.0, 0.4, 0.0], metres_per_second = 2.0";
