//! Light samples a second of both ways to the truth, from the middle of a scene's first path.
//!
//! `cargo run --release -p umbrage-reference --example throughput [SCENE]`, where SCENE is the name
//! of a built-in scene (the colonnade if none is given) or a file.
#![expect(clippy::print_stdout, reason = "a program, not a library")]

use std::path::Path;
use std::time::Instant;
use umbrage_frame::View;
use umbrage_reference::{Method, Tracer, TruthSettings};
use umbrage_scene::{Camera, Scene};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let name = std::env::args().nth(1).unwrap_or_else(|| "colonnade".into());
    let scene =
        if Path::new(&name).is_file() { Scene::load(Path::new(&name))? } else { Scene::builtin(&name)? };
    let (tracer, seconds) = timed(|| Tracer::new(&scene));
    let tracer = tracer?;
    println!("{name}: {} triangles, tree in {seconds:.2} s", scene.geometry.triangles.len());
    let frames = &scene.paths[0].frames;
    let frame = &frames[frames.len() / 2];
    let (points, seconds) = timed(|| tracer.primary(&view(&frame.camera, [480, 270])).points());
    println!("{} points, camera rays in {seconds:.2} s; {:?}", points.len(), frame.light);
    for (method, samples) in
        [(Method::Rays, 32), (Method::Shafts, 32), (Method::Shafts, 64), (Method::Shafts, 512)]
    {
        let settings = TruthSettings { samples, basis_samples: 2 * samples, method, ..Default::default() };
        let (truth, seconds) = timed(|| tracer.truth(&points, &frame.light, &settings));
        let facing = truth.facing.iter().filter(|&&f| f).count();
        let partial = truth.mean.iter().filter(|&&m| m > 0.0 && m < 1.0).count();
        let rate = facing as f64 * f64::from(4 * samples) / seconds / 1e6;
        println!(
            "{method:?}, 2 x {samples} + {}: {seconds:.2} s, {rate:.1} Msamples/s; {facing} face the light, {partial} in a penumbra",
            2 * samples
        );
    }
    Ok(())
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let started = Instant::now();
    let result = work();
    (result, started.elapsed().as_secs_f64())
}

fn view(camera: &Camera, [width, height]: [u32; 2]) -> View {
    View {
        width,
        height,
        clip_from_world: camera.clip_from_camera(width as f32 / height as f32) * camera.camera_from_world(),
        camera_from_world: camera.camera_from_world(),
        yfov_radians: camera.yfov_radians,
    }
}
