//! A scene for other renderers: its triangles as OBJ, and beside them as JSON the light and the
//! camera of one frame.
//!
//! `cargo run -p umbrage-scene --example export -- SCENE OUT.obj [PATH [FRAME]]`, where SCENE is the
//! name of a built-in scene or a file, and PATH and FRAME are the first if none is given. Numbers
//! are written so that they read back as the same f32. Materials are left out.
#![expect(clippy::print_stdout, reason = "a program, not a library")]

use glam::Vec3;
use serde_json::{Value, json};
use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use umbrage_scene::{AreaLight, Camera, Geometry, PathFrame, Scene};

const USAGE: &str = "usage: export SCENE OUT.obj [PATH [FRAME]]";

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let name = words.next().ok_or(USAGE)?;
    let out = PathBuf::from(words.next().ok_or(USAGE)?);
    let scene =
        if Path::new(&name).exists() { Scene::load(Path::new(&name))? } else { Scene::builtin(&name)? };
    let path = match words.next() {
        Some(name) => scene.path(&name)?,
        None => &scene.paths[0],
    };
    let index: usize = words.next().map_or(Ok(0), |frame| frame.parse())?;
    let frame = path.frames.get(index).ok_or_else(|| format!("{} has no frame {index}", path.name))?;

    write_obj(&out, &scene.geometry)?;
    let description = json!({
        "scene": scene.name,
        "path": path.name,
        "frame": index,
        "triangles": scene.geometry.triangles.len(),
        "camera": camera(&frame.camera),
        "light": light(frame),
    });
    let beside = out.with_extension("json");
    std::fs::write(&beside, format!("{description:#}\n"))?;
    println!("{} {}", out.display(), beside.display());
    Ok(())
}

fn write_obj(path: &Path, geometry: &Geometry) -> std::io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    for p in &geometry.positions {
        writeln!(file, "v {} {} {}", p.x, p.y, p.z)?;
    }
    for triangle in &geometry.triangles {
        let [a, b, c] = triangle.map(|index| index + 1);
        writeln!(file, "f {a} {b} {c}")?;
    }
    file.flush()
}

/// `world_from_camera` is a list of columns; the camera looks along its -z, y is up.
fn camera(camera: &Camera) -> Value {
    json!({
        "world_from_camera": camera.world_from_camera.to_cols_array_2d(),
        "yfov_radians": camera.yfov_radians,
        "near_world": camera.near_world,
        "far_world": camera.far_world,
    })
}

fn light(frame: &PathFrame) -> Value {
    let list = Vec3::to_array;
    match &frame.light {
        AreaLight::Sun { direction_to_light, angular_diameter_radians } => json!({
            "kind": "sun",
            "direction_to_light": list(direction_to_light),
            "angular_diameter_radians": angular_diameter_radians,
        }),
        AreaLight::Disk { centre, normal, radius_world } => json!({
            "kind": "disk", "centre": list(centre), "normal": list(normal), "radius_world": radius_world,
        }),
        AreaLight::Rect { centre, half_u, half_v } => json!({
            "kind": "rect", "centre": list(centre), "half_u": list(half_u), "half_v": list(half_v),
        }),
        AreaLight::Sphere { centre, radius_world } => json!({
            "kind": "sphere", "centre": list(centre), "radius_world": radius_world,
        }),
    }
}
