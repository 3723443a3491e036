//! The two ways to the truth, against each other: same samples, same answer.

use crate::common::*;
use glam::Vec3;
use umbrage_reference::{GroundTruth, Method, Points, Tracer, TruthSettings};
use umbrage_scene::AreaLight;

/// Four kinds of light, a few metres up.
pub(crate) fn lights() -> [AreaLight; 4] {
    let direction = Vec3::new(0.4, 1.0, 0.3).normalize();
    [
        AreaLight::Sun { direction_to_light: direction, angular_diameter_radians: 0.08 },
        AreaLight::Disk { centre: direction * 6.0, normal: direction, radius_world: 0.5 },
        AreaLight::Rect { centre: direction * 6.0, half_u: Vec3::X * 0.5, half_v: Vec3::Z * 0.3 },
        AreaLight::Sphere { centre: direction * 6.0, radius_world: 0.5 },
    ]
}

/// An arbiter and what it judges, on the same samples.
const PAIRS: [[Method; 2]; 2] = [[Method::Rays, Method::Shafts], [Method::ScanlineRays, Method::Scanlines]];

fn both(tracer: &Tracer, points: &Points, light: &AreaLight, pair: [Method; 2]) -> [GroundTruth; 2] {
    pair.map(|method| tracer.truth(points, light, &settings(128, method)))
}

/// Samples, of 256, that differ at each point.
pub(crate) fn differences([rays, shafts]: &[GroundTruth; 2]) -> Vec<u32> {
    assert_eq!(rays.facing, shafts.facing);
    let samples = rays.samples[0] as f32;
    rays.mean.iter().zip(&shafts.mean).map(|(a, b)| ((a - b).abs() * samples).round() as u32).collect()
}

/// The rays' samples are f64 crossings, the shafts' are f32 forms: a sample differs where a
/// silhouette passes within about 2^-22 of it (of the light's width). A silhouette as long as the
/// light sweeps 256 * 2^-21 samples: one in 8,000 points for each silhouette, and 4 samples at one
/// point is beyond chance. A wrong sign, plane or candidate list gives tens of samples.
pub(crate) fn assert_ties_only(what: &str, pair: &[GroundTruth; 2]) {
    let differing = differences(pair);
    let points = differing.len();
    let (count, worst) =
        (differing.iter().filter(|&&d| d > 0).count(), differing.iter().max().copied().unwrap_or(0));
    let partial = pair[0].mean.iter().filter(|&&m| m > 0.0 && m < 1.0).count();
    assert!(partial > points / 50, "{what}: only {partial} of {points} points are in a penumbra");
    assert!(count <= points / 100 && worst <= 3, "{what}: {count} of {points} differ, by up to {worst}");
}

/// Forty blocks over a floor, and what a camera sees of them.
pub(crate) fn blocks() -> (Tracer, Points) {
    let mut triangles = floor(20.0).to_vec();
    let mut random = Random(3);
    for _ in 0..40 {
        let centre = random.vector() * Vec3::new(5.0, 1.0, 5.0) + Vec3::Y * 1.2;
        triangles.extend(block(centre, Vec3::new(0.3, 0.2, 0.4)));
    }
    let tracer = Tracer::new(&scene(&triangles)).expect("a scene");
    let points = tracer.primary(&view(Vec3::new(0.0, 3.0, 8.0), Vec3::ZERO, [96, 54])).points();
    (tracer, points)
}

/// A sun that grazes a floor.
pub(crate) fn low_sun() -> AreaLight {
    let grazing = Vec3::new(1.0, 0.05, 0.2).normalize();
    AreaLight::Sun { direction_to_light: grazing, angular_diameter_radians: 0.08 }
}

#[test]
fn blocks_on_a_floor() {
    let (tracer, points) = blocks();
    for light in lights().into_iter().chain([low_sun()]) {
        for pair in PAIRS {
            assert_ties_only(&format!("{pair:?} {light:?}"), &both(&tracer, &points, &light, pair));
        }
    }
}

/// Triangles everywhere, also behind the light and through it.
pub(crate) fn large_soup() -> (Tracer, Points) {
    let mut random = Random(4);
    let triangles: Vec<[Vec3; 3]> = (0..600)
        .map(|_| {
            let centre = random.vector() * 8.0;
            [0, 1, 2].map(|_| centre + random.vector() * 0.6)
        })
        .collect();
    let tracer = Tracer::new(&scene(&triangles)).expect("a scene");
    let points = tracer.primary(&view(Vec3::new(0.0, 1.0, 12.0), Vec3::ZERO, [96, 54])).points();
    (tracer, points)
}

#[test]
fn triangle_soup() {
    let (tracer, points) = large_soup();
    for light in lights() {
        for pair in PAIRS {
            assert_ties_only(&format!("{pair:?} {light:?}"), &both(&tracer, &points, &light, pair));
        }
    }
}

/// Triangles of all sizes, with receivers on them and in mid-air, in contact, grazing, behind the light.
pub(crate) fn small_soup(random: &mut Random) -> (Tracer, Points) {
    let triangles: Vec<[Vec3; 3]> = (0..30)
        .map(|_| {
            let size = 4.0 * random.unit().powi(3) + 1e-3;
            let centre = random.vector() * 5.0;
            [0, 1, 2].map(|_| centre + random.vector() * size)
        })
        .collect();
    let tracer = Tracer::new(&scene(&triangles)).expect("a scene");
    let mut points = Points::default();
    for index in 0..40 {
        let t = index % triangles.len();
        let [a, b, c] = triangles[t];
        let (p, q) = (random.unit(), random.unit());
        // Every fourth near an edge, every fourth in mid-air.
        let p = if index % 4 == 0 { p * 1e-4 } else { p };
        let on = a + (b - a) * (p * (1.0 - q)) + (c - a) * (q * 0.999);
        let floats = index % 4 == 1;
        points.position.push(if floats { random.vector() * 6.0 } else { on });
        let normal = (b - a).cross(c - a).normalize_or_zero();
        points.normal.push(if floats { Vec3::ZERO } else { normal });
        points.triangle.push(if floats { u32::MAX } else { t as u32 });
    }
    (tracer, points)
}

/// A thousand scenes at random, each with one light of each kind in turn. Ties are as in
/// `assert_ties_only`: about one point in 8,000 for each silhouette. There are 40,000 points with up
/// to 30 silhouettes each, of which most hide all or nothing: at most one in 200.
#[test]
fn a_thousand_soups() {
    let mut random = Random(11);
    let (mut points_in_all, mut differing, mut partial) = (0, 0, 0);
    for soup in 0..1000 {
        let (tracer, points) = small_soup(&mut random);
        let light = lights()[soup % 4];
        let pair = both(&tracer, &points, &light, PAIRS[1]);
        let found = differences(&pair);
        assert!(found.iter().all(|&d| d <= 3), "soup {soup}, {light:?}: {found:?}");
        points_in_all += found.len();
        differing += found.iter().filter(|&&d| d > 0).count();
        partial += pair[0].mean.iter().filter(|&&m| m > 0.0 && m < 1.0).count();
    }
    assert!(partial > points_in_all / 20, "only {partial} of {points_in_all} in a penumbra");
    assert!(differing <= points_in_all / 200, "{differing} of {points_in_all} differ");
}

#[test]
fn standard_scenes() {
    for name in umbrage_scene::builtin_names() {
        let scene = umbrage_scene::Scene::builtin(name).expect("a standard scene");
        let tracer = Tracer::new(&scene).expect("a scene");
        let frames = &scene.paths[0].frames;
        let middle = &frames[frames.len() / 2];
        let points = tracer.primary(&view_of(&middle.camera, [64, 36])).points();
        for pair in PAIRS {
            let differing = differences(&both(&tracer, &points, &middle.light, pair));
            let count = differing.iter().filter(|&&d| d > 0).count();
            let worst = differing.iter().max().copied().unwrap_or(0);
            assert!(
                count <= points.len() / 100 && worst <= 3,
                "{name}, {pair:?}: {count} differ, by up to {worst}"
            );
        }
    }
}

/// With the default's number of samples and the most, and with flat lights too: scanlines and their arbiter. A
/// silhouette sweeps as many ties as there are samples: one in 2,000 points at 1024, one in 128 at 16384, for each.
#[test]
fn standard_scenes_with_more_samples() {
    for name in umbrage_scene::builtin_names() {
        let scene = umbrage_scene::Scene::builtin(name).expect("a standard scene");
        let tracer = Tracer::new(&scene).expect("a scene");
        let frames = &scene.paths[0].frames;
        let middle = &frames[frames.len() / 2];
        let [_, disk, rect, _] = lights();
        for (samples, size, light) in [
            (512, [48, 27], middle.light),
            (512, [32, 18], disk),
            (512, [32, 18], rect),
            (8192, [16, 9], middle.light),
        ] {
            let points = tracer.primary(&view_of(&middle.camera, size)).points();
            let differing = differences(&PAIRS[1].map(|method| {
                tracer.truth(
                    &points,
                    &light,
                    &TruthSettings { basis_samples: 0, ..settings(samples, method) },
                )
            }));
            let count = differing.iter().filter(|&&d| d > 0).count();
            let worst = differing.iter().max().copied().unwrap_or(0);
            let most = points.len() * (1 + samples as usize / 1024) / 100 + 1;
            assert!(
                count <= most && worst <= 3,
                "{name}, {samples}, {light:?}: {count} differ, by up to {worst}"
            );
        }
    }
}

/// Receivers all but in the plane of a flat light: what f32 makes of the light's axes is nearly singular
/// there, and just above a limit that was too low light came through walls.
#[test]
fn a_flat_light_seen_all_but_edge_on() {
    let mut random = Random(21);
    let mut triangles = floor(20.0).to_vec();
    for _ in 0..60 {
        let centre = random.vector() * Vec3::new(4.0, 0.3, 4.0) + Vec3::Y * 5.0;
        triangles.extend(block(centre, Vec3::new(0.2, 0.15, 0.2)));
    }
    let tracer = Tracer::new(&scene(&triangles)).expect("a scene");
    let light = AreaLight::Rect { centre: Vec3::Y * 5.0, half_u: Vec3::X * 0.5, half_v: Vec3::Z * 0.3 };
    let mut points = Points::default();
    for _ in 0..4000 {
        let (angle, distance) = (random.unit() * std::f32::consts::TAU, 4.0 + 4.0 * random.unit());
        // Angles to the light's plane from 1e-5 to 1e-2, evenly by size.
        let rise = distance * 10f32.powf(-5.0 + 3.0 * random.unit());
        points.position.push(Vec3::new(distance * angle.cos(), 5.0 - rise, distance * angle.sin()));
        points.normal.push(Vec3::ZERO);
        points.triangle.push(u32::MAX);
    }
    let found = differences(&both(&tracer, &points, &light, PAIRS[1]));
    let worst = found.iter().max().copied().unwrap_or(0);
    // At a sine of 1e-3 f32 places an edge to 2^-24 / 1e-3 of the light's width, times a handful of
    // roundings: up to a sample of each of the eight replicates' rows along an edge.
    assert!(worst <= 8, "up to {worst} of 256 samples differ");
}

/// More layers than a byte counts, with all their edges across the light. Each of the 300 edges may tie at one point in
/// 8,000, as in `assert_ties_only`: at one in 26 in all.
#[test]
fn hundreds_of_layers() {
    let mut triangles = floor(20.0).to_vec();
    for layer in 0..300 {
        let (y, x) = (1.5 + 0.004 * layer as f32, 0.001 * layer as f32);
        let corner = |x: f32, z: f32| Vec3::new(x, y, z);
        let [a, b, c, d] = [corner(-6.0, -6.0), corner(x, -6.0), corner(x + 0.3, 6.0), corner(-6.0, 6.0)];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    let tracer = Tracer::new(&scene(&triangles)).expect("a scene");
    let points = tracer.primary(&view(Vec3::new(0.0, 1.2, 8.0), Vec3::ZERO, [96, 54])).points();
    for light in lights() {
        let pair = both(&tracer, &points, &light, PAIRS[1]);
        let differing = differences(&pair);
        let count = differing.iter().filter(|&&d| d > 0).count();
        let worst = differing.iter().max().copied().unwrap_or(0);
        assert!(pair[0].mean.iter().any(|&m| m > 0.1 && m < 0.9), "{light:?}: no penumbra");
        assert!(count <= points.len() / 26 && worst <= 3, "{light:?}: {count} differ, by up to {worst}");
    }
}

/// A ceiling that passes through a small lamp's plane right at the lamp, all but parallel to it: where it ends for a
/// receiver depends on how far from it the receiver is (`LIGHT_GAP`). A wall does as well, but at one place for all.
#[test]
fn a_ceiling_through_a_lamp() {
    let mut random = Random(51);
    for rise in [0.009, 0.02, 0.06, 0.5, 20.0] {
        let ceiling = quad(Vec3::new(0.02, 3.0, 0.01), Vec3::new(5.0, 0.5 * rise, 0.0), Vec3::Z * 5.0);
        let tracer = Tracer::new(&scene(&[floor(20.0), ceiling].concat())).expect("a scene");
        let light = AreaLight::Rect { centre: Vec3::Y * 3.0, half_u: Vec3::X * 0.1, half_v: Vec3::Z * 0.1 };
        let mut points = Points::default();
        for _ in 0..2000 {
            points.position.push(random.vector() * Vec3::new(0.3, 1.0, 0.3) + Vec3::Y * 1.2);
            points.normal.push(Vec3::ZERO);
            points.triangle.push(u32::MAX);
        }
        let pair = both(&tracer, &points, &light, PAIRS[1]);
        let differing = differences(&pair);
        let worst = differing.iter().max().copied().unwrap_or(0);
        let count = differing.iter().filter(|&&d| d > 0).count();
        let partial = pair[0].mean.iter().filter(|&&m| m > 0.0 && m < 1.0).count();
        assert!(partial > 100, "rise {rise}: {partial} in a penumbra");
        // The edge is within a 512th of the lamp's width of where each receiver has it: up to one sample of 256, and
        // rarely two, in addition to ties.
        assert!(worst <= 3, "rise {rise}: up to {worst} of 256 samples differ, at {count} points");
    }
}

/// Triangles by themselves, so many that rays are faster: `samples * 96` edges, three of each triangle.
pub(crate) fn thicket(random: &mut Random, leaves: usize) -> Vec<[Vec3; 3]> {
    let mut triangles = floor(20.0).to_vec();
    for _ in 0..leaves {
        let place = random.vector() * Vec3::new(1.0, 0.4, 1.0) + Vec3::new(0.7, 2.5, 0.9);
        triangles.push([0, 1, 2].map(|_| place + random.vector() * 0.02));
    }
    triangles
}

/// Rays in eights find what single ones do, in the same operations: no sample differs. Edges would tie at some of
/// them: 24,000 triangles have 72,000 edges, each of which ties at one point in 8,000.
#[test]
fn a_thicket_is_asked_by_rays() {
    let mut random = Random(41);
    let tracer = Tracer::new(&scene(&thicket(&mut random, 24_000))).expect("a scene");
    let points = on_floor((0..150).map(|_| random.unit() - 0.5), 0.5);
    let centre = Vec3::new(1.8, 5.0, 1.2);
    let lights = [
        AreaLight::Sun { direction_to_light: Vec3::new(0.3, 1.0, 0.2), angular_diameter_radians: 1.2 },
        AreaLight::Disk { centre, normal: Vec3::Y, radius_world: 2.0 },
        AreaLight::Rect { centre, half_u: Vec3::X * 2.0, half_v: Vec3::Z * 2.0 },
        AreaLight::Sphere { centre, radius_world: 1.5 },
    ];
    for light in lights {
        let pair = both(&tracer, &points, &light, PAIRS[1]);
        assert!(differences(&pair).iter().all(|&d| d == 0), "{light:?}: {:?}", differences(&pair));
        let partial = pair[0].mean.iter().filter(|&&m| m > 0.0 && m < 1.0).count();
        assert!(partial > 140, "{light:?}: {partial} in a penumbra");
        let irradiance = [Method::ScanlineRays, Method::Scanlines]
            .map(|method| tracer.irradiance(&points, &light, &settings(128, method)));
        assert_eq!(irradiance[0].shadowed, irradiance[1].shadowed, "{light:?}");
    }
}

/// All samples are one: every method says lit or hidden, and the same.
#[test]
fn lights_without_a_size() {
    let (tracer, points) = large_soup();
    let direction = Vec3::new(0.4, 1.0, 0.3).normalize();
    let centre = direction * 6.0;
    for light in [
        AreaLight::Sun { direction_to_light: direction, angular_diameter_radians: 0.0 },
        AreaLight::Disk { centre, normal: direction, radius_world: 0.0 },
        AreaLight::Rect { centre, half_u: Vec3::ZERO, half_v: Vec3::ZERO },
        AreaLight::Sphere { centre, radius_world: 0.0 },
    ] {
        let [rays, scanlines] = both(&tracer, &points, &light, [Method::Rays, Method::Scanlines]);
        assert_eq!(rays.mean, scanlines.mean, "{light:?}");
        assert_eq!(rays.facing, scanlines.facing, "{light:?}");
        assert!(rays.mean.contains(&0.0) && rays.mean.contains(&1.0), "{light:?}: all the same");
        assert!(scanlines.variance.iter().all(|&v| v == 0.0), "{light:?}");
    }
}

/// Sheets of connected triangles, crumpled, with holes, some triangles wound the other way, through each other, behind
/// the receivers and through the light's plane: what is joined to patches, cut and counted by edges.
fn sheets(random: &mut Random) -> (Tracer, Points) {
    const N: usize = 24;
    let mut triangles = floor(20.0).to_vec();
    for sheet in 0..6 {
        let centre = random.vector() * Vec3::new(5.0, 1.5, 5.0) + Vec3::Y * 2.5;
        let size = 0.5 + 3.0 * random.unit();
        let (u, v) = (random.vector() * size, random.vector() * size);
        let crumpled = 0.6 * random.unit().powi(2) * size;
        // Two of them are walls that stand in the floor.
        let wall = sheet < 2;
        let (centre, u, v) = if wall {
            (centre * Vec3::new(0.5, 0.0, 0.5), u * Vec3::new(2.0, 0.0, 2.0), Vec3::Y * 2.0)
        } else {
            (centre, u, v)
        };
        let places: Vec<Vec3> = (0..=N * (N + 1) + N)
            .map(|i| {
                let [p, q] = [i % (N + 1), i / (N + 1)].map(|k| k as f32 / N as f32 - 0.5);
                centre + u * p + v * q + random.vector() * crumpled / N as f32
            })
            .collect();
        for i in (0..N * (N + 1)).filter(|i| i % (N + 1) < N) {
            let [a, b, c, d] = [i, i + 1, i + N + 2, i + N + 1].map(|i| places[i]);
            for mut triangle in [[a, b, c], [a, c, d]] {
                if random.unit() < 0.1 {
                    triangle.swap(0, 1);
                }
                if random.unit() > 0.005 {
                    triangles.push(triangle);
                }
            }
        }
    }
    let tracer = Tracer::new(&scene(&triangles)).expect("a scene");
    let points = tracer.primary(&view(Vec3::new(0.0, 3.0, 9.0), Vec3::Y, [96, 54])).points();
    (tracer, points)
}

/// Ties are as in `assert_ties_only`: at most one point in 100, by at most 3 samples.
#[test]
fn connected_sheets() {
    let mut random = Random(31);
    let near = Vec3::new(0.5, 4.0, 0.5);
    let wide = AreaLight::Rect { centre: near, half_u: Vec3::X * 2.0, half_v: Vec3::new(0.0, 0.7, 1.5) };
    let lights = lights().into_iter().chain([low_sun(), wide]);
    let (mut seen, mut partial, mut hidden) = (0, 0, 0);
    for (number, light) in lights.cycle().take(60).enumerate() {
        let (tracer, points) = sheets(&mut random);
        let pair = both(&tracer, &points, &light, PAIRS[1]);
        let differing = differences(&pair);
        let count = differing.iter().filter(|&&d| d > 0).count();
        let worst = differing.iter().max().copied().unwrap_or(0);
        assert!(
            count <= points.len() / 100 && worst <= 3,
            "{number}, {light:?}: {count} of {} differ, by up to {worst}",
            points.len()
        );
        seen += points.len();
        partial += pair[0].mean.iter().filter(|&&m| m > 0.0 && m < 1.0).count();
        hidden +=
            pair[0].mean.iter().zip(&pair[0].facing).filter(|&(&m, &facing)| facing && m == 0.0).count();
    }
    assert!(
        partial > seen / 20 && hidden > seen / 50,
        "{partial} in penumbrae, {hidden} in shadow, of {seen}"
    );
}
