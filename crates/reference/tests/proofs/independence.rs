//! The same bits whatever the number of threads, and whatever company a point is asked for in.

use crate::common::*;
use glam::Vec3;
use umbrage_reference::{Irradiance, Method, Points, PrimaryHits, RadianceSettings, Tracer, TruthSettings};
use umbrage_scene::{AreaLight, Scene};

fn blocks() -> Scene {
    let mut triangles = floor(20.0).to_vec();
    let mut random = Random(5);
    for _ in 0..200 {
        let centre = random.vector() * Vec3::new(6.0, 1.0, 6.0) + Vec3::Y * 1.2;
        triangles.extend(block(centre, Vec3::new(0.2, 0.2, 0.3)));
    }
    scene(&triangles)
}

fn light() -> AreaLight {
    AreaLight::Disk { centre: Vec3::new(2.0, 6.0, 1.0), normal: Vec3::Y, radius_world: 0.5 }
}

fn eye() -> umbrage_frame::View {
    view(Vec3::new(0.0, 3.0, 8.0), Vec3::ZERO, [64, 36])
}

#[test]
fn same_bits_at_any_thread_count() {
    let all = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let tracer = Tracer::new(&blocks()).expect("a scene");
            let PrimaryHits { gbuffer, triangle, .. } = tracer.primary(&eye());
            let points = PrimaryHits { gbuffer, triangle: triangle.clone(), material: triangle }.points();
            let truths = [Method::Rays, Method::Shafts, Method::Scanlines]
                .map(|m| tracer.truth(&points, &light(), &settings(32, m)));
            let [shadowed, ratio] = [Method::Rays, Method::Scanlines].map(|m| {
                let Irradiance { shadowed, ratio, .. } =
                    tracer.irradiance(&points, &light(), &settings(32, m));
                (shadowed, ratio)
            });
            let picture =
                tracer.radiance(&eye(), &light(), &RadianceSettings { samples: 4, bounces: 2, seed: 3 });
            (points, truths, shadowed, ratio, picture)
        })
    };
    assert_eq!(all(1), all(4));
}

#[test]
fn same_bits_in_any_company() {
    let tracer = Tracer::new(&blocks()).expect("a scene");
    let points = tracer.primary(&eye()).points();
    let settings = TruthSettings { seed: 11, ..settings(32, Method::Shafts) };
    let together = tracer.truth(&points, &light(), &settings);
    let reversed = Points {
        position: points.position.iter().rev().copied().collect(),
        normal: points.normal.iter().rev().copied().collect(),
        triangle: points.triangle.iter().rev().copied().collect(),
    };
    let mut backwards = tracer.truth(&reversed, &light(), &settings).mean;
    backwards.reverse();
    assert_eq!(together.mean, backwards);
    for i in (0..points.len()).step_by(97) {
        let alone = Points {
            position: vec![points.position[i]],
            normal: vec![points.normal[i]],
            triangle: vec![points.triangle[i]],
        };
        assert_eq!(tracer.truth(&alone, &light(), &settings).halves[0][0], together.halves[0][i]);
    }
}

/// On scanlines neighbours share what is found of triangles: up to ties on edges, one sample of 64 or two.
#[test]
fn same_samples_in_any_company() {
    let tracer = Tracer::new(&blocks()).expect("a scene");
    let points = tracer.primary(&eye()).points();
    let settings = TruthSettings { seed: 11, ..settings(32, Method::Scanlines) };
    let together = tracer.truth(&points, &light(), &settings);
    let (mut partial, mut differing) = (0, 0);
    for i in (0..points.len()).step_by(7) {
        let alone = Points {
            position: vec![points.position[i]],
            normal: vec![points.normal[i]],
            triangle: vec![points.triangle[i]],
        };
        let off = (tracer.truth(&alone, &light(), &settings).mean[0] - together.mean[i]).abs();
        assert!(off < 2.5 / 64.0, "point {i}: {off}");
        differing += u32::from(off > 0.0);
        partial += u32::from(together.mean[i] > 0.0 && together.mean[i] < 1.0);
    }
    assert!(partial > 20 && differing <= 2, "{differing} differ, {partial} in a penumbra");
}

#[test]
fn no_points_no_truth() {
    let tracer = Tracer::new(&blocks()).expect("a scene");
    let truth = tracer.truth(&Points::default(), &light(), &TruthSettings::default());
    assert!(truth.mean.is_empty() && truth.facing.is_empty());
}
