//! Cut-out surfaces: closed forms, and the ways to the truth against each other.

use crate::agreement::{assert_ties_only, differences, lights, thicket};
use crate::common::*;
use crate::primary::assert_rays;
use glam::{Vec2, Vec3};
use umbrage_reference::{GroundTruth, Method, Points, Tracer};
use umbrage_scene::{AlphaMask, AreaLight, Material, Scene, Wrap};

const METHODS: [Method; 4] = [Method::Rays, Method::Shafts, Method::ScanlineRays, Method::Scanlines];

/// The scene with the triangles from `first` on cut out; each pair of them is a quad that the mask
/// covers `tiles` times along each side.
fn cut(mut scene: Scene, first: usize, (mask, tiles): (AlphaMask, f32)) -> Scene {
    let corner = |u: f32, v: f32| Vec2::new(u, v) * tiles;
    let quad = [
        [corner(0.0, 1.0), corner(1.0, 1.0), corner(1.0, 0.0)],
        [corner(0.0, 1.0), corner(1.0, 0.0), corner(0.0, 0.0)],
    ];
    let count = scene.geometry.triangles.len();
    scene.geometry.uvs = (0..count).map(|t| quad[t % 2]).collect();
    scene.geometry.material = (0..count).map(|t| u32::from(t >= first)).collect();
    scene.materials.push(Material { mask: Some(mask), ..Material::plain("leaf", Vec3::ONE) });
    scene
}

fn checker(size: u32) -> AlphaMask {
    AlphaMask::new([size; 2], [Wrap::Repeat; 2], |x, y| (x + y) % 2 == 0)
}

fn truth(scene: &Scene, points: &Points, light: &AreaLight, method: Method) -> GroundTruth {
    let tracer = Tracer::new(scene).expect("a scene");
    tracer.truth(points, light, &settings(512, method))
}

/// Rays in eights, where there are too many leaves for anything else: as single ones, sample for sample.
#[test]
fn a_thicket_of_leaves() {
    let mut random = Random(43);
    let scene = cut(scene(&thicket(&mut random, 24_000)), 2, (checker(4), 1.0));
    let points = on_floor((0..60).map(|_| random.unit() - 0.5), 0.5);
    let centre = Vec3::new(1.8, 5.0, 1.2);
    let light = AreaLight::Rect { centre, half_u: Vec3::X * 2.0, half_v: Vec3::Z * 2.0 };
    let pair = [Method::ScanlineRays, Method::Scanlines].map(|method| truth(&scene, &points, &light, method));
    assert_eq!(pair[0].mean, pair[1].mean);
    let whole = Scene { materials: vec![Material::plain("leaf", Vec3::ONE); 2], ..scene };
    let whole = truth(&whole, &points, &light, Method::Scanlines);
    let lighter = pair[0].mean.iter().zip(&whole.mean).filter(|(cut, whole)| *cut > *whole).count();
    assert!(lighter > 55, "{lighter} of 60 see more through cut-out leaves");
}

/// Fifty cards strewn over a floor, with blocks among them.
fn leaves() -> Vec<[Vec3; 3]> {
    let mut triangles = floor(20.0).to_vec();
    let mut random = Random(8);
    triangles.extend(block(Vec3::new(1.5, 1.2, 0.3), Vec3::new(0.4, 0.2, 0.3)));
    for _ in 0..50 {
        let centre = random.vector() * Vec3::new(4.0, 1.0, 4.0) + Vec3::Y * 1.5;
        let (u, v) = (random.vector(), random.vector());
        let u = u.normalize() * 0.5;
        triangles.extend(quad(centre, u, u.cross(v).normalize() * 0.5));
    }
    triangles
}

/// What of `leaves` is no card.
const WHOLE: usize = 2 + 12;

fn leafy(mask: AlphaMask) -> Scene {
    cut(scene(&leaves()), WHOLE, (mask, 1.5))
}

fn on_leafy_floor() -> Points {
    let tracer = Tracer::new(&scene(&leaves()[..2])).expect("a scene");
    tracer.primary(&view(Vec3::new(0.0, 3.0, 8.0), Vec3::ZERO, [64, 36])).points()
}

/// A square of checkers, seen whole before a wide light, hides the half of it: with as many checkers as
/// stand on it, the error is a row of half texels along each edge of the light at most, and that of
/// 1024 stratified samples.
#[test]
fn a_checkerboard_before_a_light_hides_its_half() {
    let light = AreaLight::Rect { centre: Vec3::Y * 4.0, half_u: Vec3::X * 0.5, half_v: Vec3::Z * 0.5 };
    let mut triangles = floor(20.0).to_vec();
    triangles.extend(quad(Vec3::Y * 2.0, Vec3::X * 2.0, Vec3::NEG_Z * 2.0));
    let scene = cut(scene(&triangles), 2, (checker(8), 4.0));
    let points = on_floor([0.0, 0.1, -0.3], 0.05);
    for method in METHODS {
        let found = truth(&scene, &points, &light, method);
        for mean in found.mean {
            // The card at half height shows half of the light's width, 0.5 m: four whole checkers.
            assert!((mean - 0.5).abs() < 0.02, "{method:?}: {mean}");
        }
    }
}

/// A hard shadow is the mask itself, texel by texel.
#[test]
fn under_a_light_of_no_size_the_shadow_is_the_mask() {
    let mask = AlphaMask::new([4, 4], [Wrap::Clamp; 2], |x, y| (x * 7 + y * 3) % 5 < 2);
    let mut triangles = floor(20.0).to_vec();
    triangles.extend(quad(Vec3::Y, Vec3::X * 2.0, Vec3::NEG_Z * 2.0));
    let scene = cut(scene(&triangles), 2, (mask.clone(), 1.0));
    for row in 0..4u32 {
        let z = row as f32 - 1.5;
        let points = on_floor((0..4).map(|x| x as f32 - 1.5), z);
        for method in METHODS {
            let found = truth(&scene, &points, &overhead_sun(0.0), method);
            // v = 0 stands at -v of the quad's second side: z = -2.
            let expected: Vec<f32> = (0..4u32)
                .map(|x| {
                    let uv = glam::DVec2::new((f64::from(x) + 0.5) / 4.0, (f64::from(row) + 0.5) / 4.0);
                    if mask.is_opaque(uv) { 0.0 } else { 1.0 }
                })
                .collect();
            assert_eq!(found.mean, expected, "{method:?}, row {row}");
        }
    }
}

/// Rays see through what the shadow sees through: camera rays meet the floor behind a hole.
#[test]
fn camera_rays_pass_through_holes() {
    let mut triangles = floor(20.0).to_vec();
    triangles.extend(quad(Vec3::Y, Vec3::X * 2.0, Vec3::NEG_Z * 2.0));
    let nothing = AlphaMask::new([1, 1], [Wrap::Repeat; 2], |_, _| false);
    let from_above = view(Vec3::new(0.3, 6.0, 0.2), Vec3::new(0.2, 0.0, 0.0), [32, 18]);
    let through = Tracer::new(&cut(scene(&triangles), 2, (nothing, 1.0))).expect("a scene");
    let without = Tracer::new(&scene(&triangles[..2])).expect("a scene");
    let (through, without) = (through.primary(&from_above), without.primary(&from_above));
    assert_eq!(through.triangle.pixels(), without.triangle.pixels());
    assert_eq!(through.gbuffer.depth.pixels(), without.gbuffer.depth.pixels());
}

#[test]
fn all_there_is_as_no_mask_and_none_there_as_no_triangle() {
    let points = on_leafy_floor();
    for light in lights() {
        for method in METHODS {
            let with = |there: bool| AlphaMask::new([3, 5], [Wrap::Mirror; 2], |_, _| there);
            let whole = truth(&scene(&leaves()), &points, &light, method);
            assert_eq!(truth(&leafy(with(true)), &points, &light, method), whole, "{method:?} {light:?}");
            let bare = truth(&scene(&leaves()[..WHOLE]), &points, &light, method);
            assert_eq!(truth(&leafy(with(false)), &points, &light, method), bare, "{method:?} {light:?}");
        }
    }
}

#[test]
fn the_ways_to_the_truth_agree_on_leaves() {
    let scene = leafy(checker(8));
    let tracer = Tracer::new(&scene).expect("a scene");
    let points = tracer.primary(&view(Vec3::new(0.0, 3.0, 8.0), Vec3::ZERO, [96, 54])).points();
    for light in lights() {
        for pair in [[Method::Rays, Method::Shafts], [Method::ScanlineRays, Method::Scanlines]] {
            let both = pair.map(|method| tracer.truth(&points, &light, &settings(128, method)));
            assert_ties_only(&format!("{pair:?} {light:?}"), &both);
        }
    }
}

/// A cached truth of whole leaves is not that of cut-out ones.
#[test]
fn masks_are_part_of_the_key() {
    let hash = |mask| leafy(mask).content_hash();
    assert_ne!(hash(checker(8)), hash(checker(4)));
    assert_ne!(hash(checker(8)), scene(&leaves()).content_hash());
}

/// A tree of 260 twigs and a trellis, with as many ties as the standard scenes are allowed.
#[test]
fn the_ways_to_the_truth_agree_on_a_tree() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/leaves");
    let scene = Scene::load(&folder).expect("a scene");
    assert!(scene.has_masks());
    let tracer = Tracer::new(&scene).expect("a scene");
    let points = tracer.primary(&view_of(&scene.paths[0].frames[0].camera, [64, 36])).points();
    for light in &scene.lights {
        for pair in [[Method::Rays, Method::Shafts], [Method::ScanlineRays, Method::Scanlines]] {
            let both = pair.map(|method| tracer.truth(&points, light, &settings(128, method)));
            let found = differences(&both);
            let (count, worst) = (found.iter().filter(|&&d| d > 0).count(), found.iter().max());
            assert!(
                count <= points.len() / 100 && worst <= Some(&3),
                "{pair:?}: {count} differ, by up to {worst:?}"
            );
        }
    }
}

#[test]
fn tiles_equal_rays_through_leaves() {
    for scene in [leafy(checker(8)), leafy(checker(61))] {
        for (eye, size) in [(Vec3::new(0.0, 3.0, 8.0), [64, 40]), (Vec3::new(0.5, 1.5, 0.2), [61, 37])] {
            assert!(assert_rays(&scene, &view(eye, Vec3::ZERO, size)) > 0);
        }
    }
}
