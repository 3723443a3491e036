//! Light samples a second of both ways to the truth, on a built-in scene of columns.
//!
//! `cargo run --release -p umbrage-reference --example throughput`
#![expect(clippy::print_stdout, reason = "a program, not a library")]

use glam::{DVec3, Vec3};
use std::time::Instant;
use umbrage_frame::View;
use umbrage_reference::{Method, ReferenceError, Tracer, TruthSettings};
use umbrage_scene::{AreaLight, Camera, Geometry, Material, Scene, ShadowRegion};

fn main() -> Result<(), ReferenceError> {
    let scene = columns(10, 64);
    let started = Instant::now();
    let tracer = Tracer::new(&scene)?;
    println!("{} triangles, tree in {:.0?}", scene.geometry.triangles.len(), started.elapsed());
    let started = Instant::now();
    let points = tracer.primary(&view([480, 270])).points();
    println!("{} points, camera rays in {:.0?}", points.len(), started.elapsed());
    for (method, samples) in [(Method::Rays, 64), (Method::Shafts, 64), (Method::Shafts, 512)] {
        let settings = TruthSettings { samples, basis_samples: 2 * samples, method, ..Default::default() };
        let started = Instant::now();
        let truth = tracer.truth(&points, &scene.lights[0], &settings);
        let seconds = started.elapsed().as_secs_f64();
        let facing = truth.facing.iter().filter(|&&f| f).count();
        let partial = truth.mean.iter().filter(|&&m| m > 0.0 && m < 1.0).count();
        let rate = facing as f64 * f64::from(4 * samples) / seconds / 1e6;
        println!(
            "{method:?} 2 x {samples} + {}: {seconds:.2} s, {rate:.1} Msamples/s, {partial} of {facing} in a penumbra",
            2 * samples
        );
    }
    Ok(())
}

/// `side` x `side` columns of `facets` facets and 16 drums on a floor, under a sun of 2 degrees.
fn columns(side: u32, facets: u32) -> Scene {
    let mut geometry = Geometry::default();
    quad(&mut geometry, [(-40.0, 0.0, 40.0), (40.0, 0.0, 40.0), (40.0, 0.0, -40.0), (-40.0, 0.0, -40.0)]);
    let centred = |i: u32| (i as f32 - 0.5 * (side - 1) as f32) * 4.0;
    for (column, facet, drum) in
        (0..side * side * facets * 16).map(|i| (i / 16 / facets, i / 16 % facets, i % 16))
    {
        let corner = |f: u32, y: f32| {
            let angle = f as f32 / facets as f32 * std::f32::consts::TAU;
            (centred(column % side) + 0.3 * angle.cos(), y, centred(column / side) + 0.3 * angle.sin())
        };
        let (low, high) = (drum as f32 * 0.25, (drum + 1) as f32 * 0.25);
        quad(
            &mut geometry,
            [corner(facet, low), corner(facet, high), corner(facet + 1, high), corner(facet + 1, low)],
        );
    }
    let direction_to_light = Vec3::new(0.5, 0.8, 0.3).normalize();
    Scene {
        name: "columns".into(),
        title: "columns on a floor".into(),
        geometry,
        materials: vec![Material { name: "grey".into(), albedo: Vec3::splat(0.5) }],
        lights: vec![AreaLight::Sun { direction_to_light, angular_diameter_radians: 2f32.to_radians() }],
        paths: vec![],
        shadow_region: ShadowRegion { centre: Vec3::ZERO, width_world: 60.0, reference_gap_world: 2.0 },
        origin: DVec3::ZERO,
        notes: vec![],
    }
}

fn quad(geometry: &mut Geometry, corners: [(f32, f32, f32); 4]) {
    let first = geometry.positions.len() as u32;
    geometry.positions.extend(corners.map(Vec3::from));
    geometry.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    geometry.material.extend([0, 0]);
}

fn view([width, height]: [u32; 2]) -> View {
    let camera = Camera::look_at(Vec3::new(-3.0, 1.7, 19.0), Vec3::new(2.0, 0.8, 0.0), 1.0, 0.1, 200.0);
    View {
        width,
        height,
        clip_from_world: camera.clip_from_camera(width as f32 / height as f32) * camera.camera_from_world(),
        camera_from_world: camera.camera_from_world(),
        yfov_radians: camera.yfov_radians,
    }
}
