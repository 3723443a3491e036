//! Camera rays: what the rest of the project takes for what is seen.

use crate::common::*;
use glam::{Vec2, Vec3};
use umbrage_frame::{Anchors, View};
use umbrage_reference::Tracer;
use umbrage_scene::{Camera, Scene};

fn soup() -> Vec<[Vec3; 3]> {
    let mut random = Random(6);
    (0..400)
        .map(|_| {
            let centre = random.vector() * 4.0;
            [0, 1, 2].map(|_| centre + random.vector() * 0.8)
        })
        .collect()
}

/// Every pixel against every triangle, in f64.
#[test]
fn closest_hits_equal_brute_force() {
    let triangles = soup();
    let tracer = Tracer::new(&scene(&triangles)).expect("a scene");
    let view = view(Vec3::new(1.0, 2.0, 9.0), Vec3::ZERO, [64, 36]);
    let hits = tracer.primary(&view);
    let eye = view.eye().as_dvec3();
    for (x, y) in (0..36).flat_map(|y| (0..64).map(move |x| (x, y))) {
        let through = view.direction(Vec2::new(x as f32 + 0.5, y as f32 + 0.5)).as_dvec3();
        let distance = |t: &[Vec3; 3]| {
            let [a, b, c] = t.map(|v| v.as_dvec3() - eye);
            let edges = [a.cross(b), b.cross(c), c.cross(a)].map(|n| n.dot(through));
            let inside = edges.iter().all(|&e| e >= 0.0) || edges.iter().all(|&e| e <= 0.0);
            let normal = (b - a).cross(c - a);
            let t = normal.dot(a) / normal.dot(through);
            (inside && t > 0.0).then_some(t)
        };
        let all = triangles.iter().enumerate().filter_map(|(i, t)| Some((distance(t)?, i as u32)));
        let (nearest, triangle) =
            all.fold((f64::INFINITY, u32::MAX), |best, hit| if hit.0 < best.0 { hit } else { best });
        assert_eq!(*hits.triangle.at(x, y), triangle, "the scene's index, not the tree's");
        let want = (nearest * through.dot(view.direction(Vec2::new(32.0, 18.0)).as_dvec3())) as f32;
        let depth = *hits.gbuffer.depth.at(x, y);
        // Both directions carry f32 roundings (view.direction): 1e-6 of the depth, times the slope
        // of a surface seen at 1 degree, 60.
        let equal = depth == want || (depth - want).abs() < 6e-5 * want;
        assert!(equal, "pixel {x}, {y}: {depth} for {want}");
    }
}

#[test]
fn surfaces_lie_on_their_pixels() {
    let tracer = Tracer::new(&scene(&[soup(), floor(30.0).to_vec()].concat())).expect("a scene");
    let view = view(Vec3::new(1.0, 2.0, 9.0), Vec3::ZERO, [64, 36]);
    let hits = tracer.primary(&view);
    let (points, anchors) = (hits.points(), Anchors::of(&hits.gbuffer));
    assert_eq!((&points.position, &points.normal), (&anchors.position, &anchors.normal));
    assert!(points.len() > 1000);
    for (i, &pixel) in anchors.pixel.iter().enumerate() {
        let centre = Vec2::new((pixel % 64) as f32 + 0.5, (pixel / 64) as f32 + 0.5);
        // f32 matrices: a few ulps of 2^-24 over a picture 64 pixels wide.
        let px = view.project(points.position[i]).expect("in the picture");
        assert!(px.distance(centre) < 1e-3, "{px} for {centre}");
        let depth = hits.gbuffer.depth.pixels()[pixel as usize];
        assert!((depth - view.depth(points.position[i])).abs() < 1e-5 * depth);
        let towards = points.normal[i].dot(view.eye() - points.position[i]);
        assert!(towards >= 0.0 && (points.normal[i].length() - 1.0).abs() < 1e-6);
        assert_eq!(hits.material.pixels()[pixel as usize], 0);
    }
}

/// The near plane (5 cm) cuts, as it does for a rasteriser; so does the far plane (500 m).
#[test]
fn near_and_far_planes_cut() {
    let wall = |z: f32| quad(Vec3::Z * z, Vec3::X * 1000.0, Vec3::Y * 1000.0);
    let seen = |walls: &[[Vec3; 3]]| {
        let tracer = Tracer::new(&scene(walls)).expect("a scene");
        *tracer.primary(&view(Vec3::ZERO, Vec3::NEG_Z, [5, 3])).gbuffer.depth.at(0, 0)
    };
    assert!((seen(&[wall(-0.04), wall(-2.0)].concat()) - 2.0).abs() < 1e-5);
    assert!((seen(&[wall(-0.06), wall(-2.0)].concat()) - 0.06).abs() < 1e-6);
    // The far plane is known to about 1e-7 far / near = 1e-3.
    assert!((seen(&wall(-498.0)) - 498.0).abs() < 1e-2);
    assert_eq!(seen(&wall(-502.0)), f32::INFINITY);
}

#[test]
fn nothing_to_see() {
    let tracer = Tracer::new(&scene(&floor(1.0))).expect("a scene");
    let hits = tracer.primary(&view(Vec3::Y, Vec3::Y * 9.0, [4, 4]));
    assert!(hits.points().is_empty() && hits.triangle.pixels().iter().all(|&t| t == u32::MAX));
}

/// Bit by bit what each pixel's ray finds on its own.
pub(crate) fn assert_rays(scene: &Scene, view: &View) -> usize {
    let tracer = Tracer::new(scene).expect("a scene");
    let hits = tracer.primary(view);
    let pixels: Vec<u32> = (0..view.width * view.height).collect();
    let (depth, points) = tracer.primary_some(view, &pixels);
    let bits = |depth: &[f32]| depth.iter().map(|d| d.to_bits()).collect::<Vec<_>>();
    let bits_of = |v: &[Vec3]| v.iter().map(|v| v.to_array().map(f32::to_bits)).collect::<Vec<_>>();
    let found = hits.points();
    assert_eq!(bits(hits.gbuffer.depth.pixels()), bits(&depth));
    assert_eq!(found.triangle, points.triangle);
    assert_eq!(bits_of(&found.position), bits_of(&points.position));
    assert_eq!(bits_of(&found.normal), bits_of(&points.normal));
    for (&triangle, &material) in hits.triangle.pixels().iter().zip(hits.material.pixels()) {
        assert_eq!(material, scene.geometry.material.get(triangle as usize).copied().unwrap_or(u32::MAX));
    }
    points.len()
}

/// Sizes that are none of a whole number of tiles, and some that are.
const SIZES: [[u32; 2]; 5] = [[64, 40], [61, 37], [9, 100], [100, 1], [7, 5]];

#[test]
fn tiles_equal_rays_in_a_soup() {
    let scene = scene(&soup());
    for size in SIZES {
        assert_rays(&scene, &view(Vec3::new(1.0, 2.0, 9.0), Vec3::ZERO, size));
        // From within.
        assert!(assert_rays(&scene, &view(Vec3::new(0.2, 0.1, -0.3), Vec3::X, size)) > 0);
        assert_eq!(assert_rays(&scene, &view(Vec3::Z * 9.0, Vec3::Z * 20.0, size)), 0);
    }
    // More triangles than a picture of this size has use for.
    assert_rays(&scene, &view(Vec3::new(1.0, 2.0, 9.0), Vec3::ZERO, [4, 3]));
}

/// Both planes cut through triangles, which stand beside and behind the eye too.
#[test]
fn tiles_equal_rays_between_the_planes() {
    let scene = scene(&soup());
    let mut random = Random(41);
    for _ in 0..30 {
        let (eye, target) = (random.vector() * 3.0, random.vector());
        let near = 0.2 + random.unit();
        let camera = Camera::look_at(eye, target, 80f32.to_radians(), near, near + 2.0 * random.unit());
        assert_rays(&scene, &view_of(&camera, [61, 37]));
    }
}

/// Where rays run along planes, edges meet pixel centres and surfaces lie on each other, tiles have doubts.
#[test]
fn tiles_equal_rays_where_surfaces_meet() {
    let mut triangles = strewn_blocks();
    triangles.extend(block(Vec3::new(0.0, 1.0, 0.0), Vec3::new(1.0, 0.5, 1.0)));
    // On the floor, on a block, and on themselves.
    triangles.extend(block(Vec3::new(0.5, 0.5, 0.0), Vec3::new(1.0, 0.5, 0.5)));
    triangles.extend_from_within(..40);
    // No area.
    triangles.extend([[Vec3::ZERO, Vec3::Y, Vec3::Y * 2.0], [Vec3::Y; 3]]);
    let scene = scene(&triangles);
    let views = [
        ([0.0, 1.0, 6.0], [0.0, 1.0, 0.0]),
        ([0.0, 0.0, 6.0], [0.0, 0.0, 0.0]),
        ([0.0, 1.5, 6.0], [0.0, 1.5, 0.0]),
        ([1.0, 1.5, 6.0], [1.0, 1.5, 0.0]),
        ([0.0, 8.0, 0.01], [0.0, 0.0, 0.0]),
        ([3.0, 3.0, 3.0], [0.0, 0.0, 0.0]),
    ];
    for ((eye, target), size) in views.into_iter().flat_map(|v| SIZES.map(|size| (v, size))) {
        assert_rays(&scene, &view(eye.into(), target.into(), size));
    }
}

#[test]
fn tiles_equal_rays_in_a_scene() {
    let scene = Scene::builtin("colonnade").expect("a built-in scene");
    for path in &scene.paths {
        let frame = &path.frames[path.frames.len() / 2];
        assert!(assert_rays(&scene, &view_of(&frame.camera, [203, 117])) > 0);
    }
}

/// The numbers leave f32's range, or all but.
#[test]
fn tiles_equal_rays_at_any_scale() {
    for scale in [1e-9, 1e-5, 1e6, 1e10] {
        let scene = scene(&soup().into_iter().map(|t| t.map(|v| v * scale)).collect::<Vec<_>>());
        let eye = Vec3::new(1.0, 2.0, 9.0) * scale;
        let camera = Camera::look_at(eye, Vec3::ZERO, 1.0, 0.05 * scale, 500.0 * scale);
        assert!(assert_rays(&scene, &view_of(&camera, [61, 37])) > 0, "{scale}");
    }
}

/// f32 coordinates far from the origin, of the eye and of the triangles.
#[test]
fn tiles_equal_rays_far_away() {
    let place = Vec3::new(3e4, -1e4, 2e4);
    let scene = scene(&soup().into_iter().map(|t| t.map(|v| v + place)).collect::<Vec<_>>());
    for direction in [Vec3::X, Vec3::Y + Vec3::Z * 0.01, Vec3::ONE] {
        assert!(assert_rays(&scene, &view(place + direction * 9.0, place, [61, 37])) > 0);
    }
}
