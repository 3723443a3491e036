//! Scanlines on a GPU against scanlines on the CPU: the same samples, the same answer.

use crate::agreement::{
    assert_ties_only, blocks, differences, large_soup, lights, low_sun, small_soup, thicket,
};
use crate::common::*;
use glam::Vec3;
use std::sync::OnceLock;
use umbrage_reference::{
    AdapterChoice, Finder, GpuTracer, GroundTruth, Method, Points, Share, Tracer, TruthGpu, TruthSettings,
};
use umbrage_scene::{AreaLight, Scene};

/// One for all tests: kernels are compiled once.
fn gpu() -> &'static TruthGpu {
    static GPU: OnceLock<TruthGpu> = OnceLock::new();
    let message = "these tests need a graphics adapter; a software one will do: \
                   apt-get install mesa-vulkan-drivers libvulkan1";
    GPU.get_or_init(|| TruthGpu::open(&AdapterChoice::default()).expect(message))
}

fn find(
    tracer: &Tracer,
    points: &Points,
    light: &AreaLight,
    settings: &TruthSettings,
) -> (GroundTruth, Share) {
    let mut gpu = GpuTracer::new(tracer, gpu()).expect("it fits");
    let truth = gpu.truth(points, light, settings).expect("the driver does it");
    (truth, gpu.share())
}

fn both(tracer: &Tracer, points: &Points, light: &AreaLight) -> ([GroundTruth; 2], Share) {
    let settings = settings(128, Method::Scanlines);
    let (truth, share) = find(tracer, points, light, &settings);
    ([tracer.truth(points, light, &settings), truth], share)
}

/// Where V is the same, so is all the rest: halves to the bit, the others to f32's rounding of a few
/// operations.
fn assert_all_the_rest([cpu, gpu]: &[GroundTruth; 2]) {
    let same = (0..cpu.mean.len()).filter(|&i| cpu.mean[i] == gpu.mean[i]);
    let near = |a: f32, b: f32| (a - b).abs() <= 1e-5 * a.abs().max(1e-6);
    let mut odd = 0;
    for i in same {
        // Two samples that differ in opposite ways, or one of the basis alone.
        let halves = [0, 1].iter().all(|&h| cpu.halves[h][i] == gpu.halves[h][i]);
        let basis = cpu.basis.is_empty() || near(cpu.basis[i], gpu.basis[i]);
        odd += usize::from(!halves || !basis || !near(cpu.variance[i], gpu.variance[i]));
    }
    assert_eq!(cpu.samples, gpu.samples);
    assert!(odd <= cpu.mean.len() / 200, "{odd} of {} points differ in the rest", cpu.mean.len());
}

/// What f32 cannot tell: a light seen within .1 degrees of edge-on, a sphere from within a tenth of its radius,
/// a horizon without a triangle.
const MOST_ON_CPU: usize = 100;

#[test]
fn blocks_on_a_floor() {
    let (tracer, points) = blocks();
    for light in lights().into_iter().chain([low_sun()]) {
        let (pair, share) = both(&tracer, &points, &light);
        assert_ties_only(&format!("{light:?}"), &pair);
        assert_all_the_rest(&pair);
        assert!(share.cpu <= points.len() / MOST_ON_CPU, "{light:?}: {share:?}");
    }
}

#[test]
fn a_large_soup() {
    let (tracer, points) = large_soup();
    for light in lights() {
        let (pair, share) = both(&tracer, &points, &light);
        assert_ties_only(&format!("{light:?}"), &pair);
        assert_all_the_rest(&pair);
        assert!(share.cpu <= points.len() / MOST_ON_CPU, "{light:?}: {share:?}");
    }
}

/// Bounds as for a thousand soups on the CPU.
#[test]
fn three_hundred_soups() {
    let mut random = Random(12);
    let (mut points_in_all, mut differing, mut partial, mut cpu) = (0, 0, 0, 0);
    for soup in 0..300 {
        let (tracer, points) = small_soup(&mut random);
        let light = lights()[soup % 4];
        let (pair, share) = both(&tracer, &points, &light);
        let found = differences(&pair);
        assert!(found.iter().all(|&d| d <= 3), "soup {soup}, {light:?}: {found:?}");
        points_in_all += found.len();
        cpu += share.cpu;
        differing += found.iter().filter(|&&d| d > 0).count();
        partial += pair[0].mean.iter().filter(|&&m| m > 0.0 && m < 1.0).count();
    }
    assert!(partial > points_in_all / 20, "only {partial} of {points_in_all} in a penumbra");
    assert!(differing <= points_in_all / 200, "{differing} of {points_in_all} differ");
    assert!(cpu <= points_in_all / MOST_ON_CPU, "{cpu} of {points_in_all} on the CPU");
}

/// Leaves one on the other: every sample behind them has as many layers, one more than a byte counts among them, where
/// it would see light again.
#[test]
fn more_layers_than_a_byte_counts() {
    for leaves in [255, 256, 300] {
        let mut triangles = floor(20.0).to_vec();
        for i in 0..leaves {
            // Up to the middle of the lights, seen from about x = 0.
            let height = 1.0 + 0.004 * i as f32;
            triangles.extend(quad(Vec3::new(0.4 * height - 3.0, height, 0.0), Vec3::X * 3.0, Vec3::Z * 4.0));
        }
        let tracer = Tracer::new(&scene(&triangles)).expect("a scene");
        let points = on_floor((0..200).map(|i| 0.002 * (i as f32 - 99.5)), 0.0);
        for light in lights() {
            let (pair, share) = both(&tracer, &points, &light);
            assert_ties_only(&format!("{leaves} leaves, {light:?}"), &pair);
            assert_all_the_rest(&pair);
            assert_eq!(share.cpu, 0, "{leaves} leaves, {light:?}: {share:?}");
        }
    }
}

/// Many leaves without order before large lights: thousands of edges to a group.
#[test]
fn a_thicket() {
    let mut random = Random(47);
    let points = on_floor((0..150).map(|_| random.unit() - 0.5), 0.5);
    let centre = Vec3::new(1.8, 5.0, 1.2);
    let sun = AreaLight::Sun { direction_to_light: Vec3::new(0.3, 1.0, 0.2), angular_diameter_radians: 0.6 };
    let rect = AreaLight::Rect { centre, half_u: Vec3::X, half_v: Vec3::Z };
    // As edges, and as triangles.
    for leaves in [1000, 3000] {
        let tracer = Tracer::new(&scene(&thicket(&mut random, leaves))).expect("a scene");
        for light in [sun, rect] {
            let (pair, share) = both(&tracer, &points, &light);
            let found = differences(&pair);
            // Each edge ties at one point in 8,000.
            let differing = found.iter().filter(|&&d| d > 0).count();
            let expected = 3 * leaves * points.len() / 8000;
            assert!(differing <= 2 * expected, "{leaves} leaves, {light:?}: {differing} differ");
            // Three samples at a tie, as anywhere, and two ties at one point among thousands of edges.
            assert!(found.iter().all(|&d| d <= 6), "{leaves} leaves, {light:?}: {found:?}");
            let partial = pair[0].mean.iter().filter(|&&m| m > 0.0 && m < 1.0).count();
            assert!(partial > 140, "{leaves} leaves, {light:?}: {partial} in a penumbra");
            assert_eq!(share.cpu, 0, "{leaves} leaves, {light:?}: {share:?}");
        }
    }
}

/// Points of a G-buffer in half floats may lie a millimetre off their triangles: receivers stand in the plane.
#[test]
fn points_off_their_planes() {
    let (tracer, mut points) = blocks();
    let mut random = Random(59);
    for (position, normal) in points.position.iter_mut().zip(&points.normal) {
        *position += *normal * (random.unit() - 0.5) * 4e-3;
    }
    for light in lights() {
        let (pair, share) = both(&tracer, &points, &light);
        assert_ties_only(&format!("{light:?}"), &pair);
        assert!(share.cpu <= points.len() / MOST_ON_CPU, "{light:?}: {share:?}");
    }
}

/// Receivers on a wall and in mid-air, on either side of a flat light's plane and in it.
#[test]
fn astride_a_lamp() {
    let mut triangles = quad(Vec3::new(4.0, 1.0, 0.0), Vec3::Y * 3.0, Vec3::Z * 3.0).to_vec();
    let mut random = Random(53);
    for _ in 0..60 {
        let centre = random.vector() * Vec3::new(1.2, 0.8, 2.0) + Vec3::new(2.0, 1.0, 0.0);
        triangles.extend(block(centre, Vec3::splat(0.1)));
    }
    let tracer = Tracer::new(&scene(&triangles)).expect("a scene");
    let mut points = Points::default();
    for i in 0..1200 {
        let in_air = i % 3 == 0;
        let place = random.vector() * Vec3::new(0.0, 0.3, 1.0) + Vec3::new(4.0, 1.0, 0.0);
        points.position.push(if in_air { place - Vec3::X * 0.1 } else { place });
        points.normal.push(if in_air { Vec3::ZERO } else { Vec3::NEG_X });
        // The wall's diagonal runs from its lowest corner with the least z to the highest.
        points.triangle.push(if in_air { u32::MAX } else { u32::from(place.y - 1.0 < place.z) });
    }
    let centre = Vec3::Y;
    for light in [
        AreaLight::Rect { centre, half_u: Vec3::X * 0.4, half_v: Vec3::Z * 0.3 },
        AreaLight::Disk { centre, normal: Vec3::Y, radius_world: 0.4 },
    ] {
        let (pair, share) = both(&tracer, &points, &light);
        assert_ties_only(&format!("{light:?}"), &pair);
        assert_all_the_rest(&pair);
        // Four metres away within 2.2e-3 of edge-on, of heights up to .3: one in 34.
        assert!(share.cpu > 0 && share.cpu <= points.len() / 20, "{light:?}: {share:?}");
    }
}

#[test]
fn standard_scenes() {
    for name in umbrage_scene::builtin_names() {
        let (tracer, points, light) = standard(name);
        let (pair, share) = both(&tracer, &points, &light);
        let differing = differences(&pair);
        let count = differing.iter().filter(|&&d| d > 0).count();
        let worst = differing.iter().max().copied().unwrap_or(0);
        assert!(count <= points.len() / 100 && worst <= 3, "{name}: {count} differ, by up to {worst}");
        assert_all_the_rest(&pair);
        assert!(share.cpu <= points.len() / MOST_ON_CPU, "{name}: {share:?}");
        assert_eq!(share.gpu + share.below + share.cpu, points.len());
    }
}

fn standard(name: &str) -> (Tracer, Points, AreaLight) {
    let scene = Scene::builtin(name).expect("a standard scene");
    let tracer = Tracer::new(&scene).expect("a scene");
    let frames = &scene.paths[0].frames;
    let middle = &frames[frames.len() / 2];
    let points = tracer.primary(&view_of(&middle.camera, [64, 36])).points();
    (tracer, points, middle.light)
}

/// The errors that the tests above are there for.
#[test]
fn a_planted_error_is_noticed() {
    let noticed = |pair: [GroundTruth; 2]| {
        let found = differences(&pair);
        let count = found.iter().filter(|&&d| d > 0).count();
        count > found.len() / 100 || found.iter().any(|&d| d > 3)
    };
    let (tracer, points) = blocks();
    let cpu = settings(128, Method::Scanlines);
    for light in lights() {
        let truth = || tracer.truth(&points, &light, &cpu);
        let seed = find(&tracer, &points, &light, &TruthSettings { seed: 2, ..cpu }).0;
        assert!(noticed([truth(), seed]), "{light:?}: another seed");
        let samples = find(&tracer, &points, &light, &TruthSettings { samples: 192, ..cpu }).0;
        assert!(noticed([truth(), samples]), "{light:?}: another ruling");
    }
    // One triangle of the two that a shadow is made of.
    let mut triangles = floor(5.0).to_vec();
    triangles.extend(quad(Vec3::Y, Vec3::X, Vec3::Z));
    let whole = Tracer::new(&scene(&triangles)).expect("a scene");
    let points = whole.primary(&view(Vec3::new(0.0, 3.0, 5.0), Vec3::ZERO, [32, 18])).points();
    let without = Tracer::new(&scene(&triangles[..3])).expect("a scene");
    for light in lights() {
        let truths = [&whole, &without].map(|tracer| find(tracer, &points, &light, &cpu).0);
        let found = points.triangle.iter().zip(differences(&truths)).filter(|(t, d)| **t < 2 && *d > 3);
        assert!(found.count() > 5, "{light:?}: a triangle that is not there");
    }
}

#[test]
fn any_number_of_samples() {
    let (tracer, points, light) = standard("curved-receivers");
    let rect = lights()[2];
    for (samples, basis_samples) in [(1, 0), (16, 256), (512, 1024), (2048, 0), (8192, 16)] {
        for light in [&light, &rect] {
            let settings = TruthSettings { samples, basis_samples, ..settings(0, Method::Scanlines) };
            let (truth, share) = find(&tracer, &points, light, &settings);
            let pair = [tracer.truth(&points, light, &settings), truth];
            let differing = differences(&pair).iter().filter(|&&d| d > 0).count();
            // Ties go with the samples of a row: at most 64 times those of 256.
            let most = points.len() * (1 + samples as usize / 512) / 100;
            assert!(differing <= most, "{samples}: {differing} of {} differ", points.len());
            // And with those of one row, all of which may lie on one silhouette.
            let worst = differences(&pair).into_iter().max().unwrap_or(0);
            assert!(worst <= 32, "{samples}, {light:?}: {worst} samples differ at one point");
            // Mesa's software driver ends loops after 65,535 turns in all, which long rows come near to.
            let most = points.len() / if samples > 4096 { 20 } else { MOST_ON_CPU };
            assert!(share.cpu <= most, "{samples}: {share:?}");
            assert_eq!(pair[1].basis.is_empty(), basis_samples == 0);
        }
    }
}

#[test]
fn a_tolerance_is_reached_with_the_same_samples() {
    let (tracer, points, light) = standard("contact");
    let settings = TruthSettings { samples: 64, tolerance: Some(0.004), ..settings(64, Method::Scanlines) };
    let (truth, _) = find(&tracer, &points, &light, &settings);
    let cpu = tracer.truth(&points, &light, &settings);
    let other = cpu.samples.iter().zip(&truth.samples).filter(|(a, b)| a != b).count();
    // A tie in the pilot may ask for more.
    assert!(other <= points.len() / 100, "{other} of {} have another number of samples", points.len());
    assert!(cpu.samples.iter().any(|&s| s > cpu.samples[0].min(s)), "nothing was refined");
}

/// What only the CPU does, it does to the bit.
#[test]
fn the_rest_is_the_cpus() {
    let (tracer, points) = blocks();
    let settings = settings(32, Method::Shafts);
    let no_size = AreaLight::Sun { direction_to_light: Vec3::Y, angular_diameter_radians: 0.0 };
    let scanlines = TruthSettings { method: Method::Scanlines, ..settings };
    for (light, settings) in [(lights()[0], settings), (no_size, scanlines)] {
        let (truth, share) = find(&tracer, &points, &light, &settings);
        assert_eq!(share.cpu, points.len());
        assert_eq!(truth, tracer.truth(&points, &light, &settings));
    }
    let (nothing, _) = find(&tracer, &Points::default(), &lights()[1], &scanlines);
    assert!(nothing.mean.is_empty() && nothing.basis.is_empty());
}

/// Two devices, two keys; the CPU's own where it does the work.
#[test]
fn keys_say_where() {
    let (tracer, points) = blocks();
    let (light, settings) = (lights()[0], settings(32, Method::Scanlines));
    let shafts = TruthSettings { method: Method::Shafts, ..settings };
    let finder = Finder::new(&tracer, Some(gpu())).expect("it fits");
    let key = |settings| tracer.truth_key(&points, &light, settings);
    assert_ne!(finder.truth_key(&points, &light, &settings), key(&settings));
    assert_eq!(finder.truth_key(&points, &light, &shafts), key(&shafts));
    assert_eq!(Finder::Cpu(&tracer).truth_key(&points, &light, &settings), key(&settings));
}

#[test]
fn an_adapter_that_is_not_there_is_named_and_one_that_computes_nothing_refused() {
    let open = |name: Option<&str>, backend: Option<&str>| {
        let [name, backend] = [name, backend].map(|s| s.map(String::from));
        TruthGpu::open(&AdapterChoice { name, backend }).map(|_| ()).expect_err("refused").to_string()
    };
    let missing = open(Some("no such adapter"), None);
    assert!(missing.contains("no such adapter") && missing.contains("umbrage list adapters"), "{missing}");
    assert!(open(None, Some("noop")).contains("computes nothing"));
}
