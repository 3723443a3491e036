//! Truth against closed forms, its value and its variance.

use crate::common::*;
use crate::exact::*;
use glam::{DVec3, Vec3};
use std::f64::consts::FRAC_PI_2;
use umbrage_reference::{GroundTruth, Method, Points, Tracer};
use umbrage_scene::AreaLight;

/// Compares a truth with exact values.
///
/// With independent points and the right variances s_i^2,
/// - the sum of the errors is 0 within 3 standard deviations `sqrt(sum s_i^2)`, plus what is known
///   to be wrong with the scene itself (`geometry`, per point);
/// - `sum error^2 / sum s^2` is 1. The numerator is a sum of weighted chi-squares: its relative
///   standard deviation is `sqrt(2 sum s^4) / sum s^2`, and that of the denominator, of K - 1
///   degrees of freedom a point, is sqrt(K - 1) times smaller. Five of them together: a variance
///   that is wrong by a factor of 2 fails.
pub(crate) fn assert_exact(what: &str, truth: &GroundTruth, exact: &[f64], geometry: f64) {
    let errors: Vec<f64> = truth.mean.iter().zip(exact).map(|(&m, g)| f64::from(m) - g).collect();
    let variances: Vec<f64> = truth.variance.iter().map(|&v| f64::from(v)).collect();
    let partial = exact.iter().filter(|&&g| g > 0.01 && g < 0.99).count();
    assert!(partial > 100, "{what}: only {partial} points in the penumbra");
    let (bias, total) = (errors.iter().sum::<f64>(), variances.iter().sum::<f64>());
    let allowed = 3.0 * total.sqrt() + geometry * errors.len() as f64;
    assert!(bias.abs() < allowed, "{what}: the errors add up to {bias:.2e}, allowed {allowed:.2e}");
    let ratio = errors.iter().map(|e| e * e).sum::<f64>() / total;
    let fourth = variances.iter().map(|v| v * v).sum::<f64>();
    let spread = 5.0 * (2.0 * fourth * (1.0 + 1.0 / 7.0)).sqrt() / total;
    assert!((ratio - 1.0).abs() < spread, "{what}: squared error / variance {ratio:.3}, 1 +- {spread:.3}");
}

fn check(what: &str, scene: &[[Vec3; 3]], points: &Points, light: &AreaLight, exact: &[f64]) {
    let tracer = Tracer::new(&crate::common::scene(scene)).expect("a scene");
    // Of the default method also as many samples as it takes, 16384 in two halves: a bias that 256 hide shows.
    let asked =
        [(128, Method::Rays), (128, Method::Shafts), (128, Method::Scanlines), (8192, Method::Scanlines)];
    for (samples, method) in asked {
        let truth = tracer.truth(points, light, &settings(samples, method));
        assert_exact(&format!("{what}, {method:?}, 2 x {samples}"), &truth, exact, 0.0);
    }
}

/// A horizontal plate whose edge passes above (`x`, `z` = 0) at height `y`, turned by `angle` from
/// the z axis, on the edge's +x side.
fn plate(x: f32, y: f32, angle: f32) -> [[Vec3; 3]; 2] {
    let along = Vec3::new(angle.sin(), 0.0, angle.cos());
    let beyond = Vec3::new(angle.cos(), 0.0, -angle.sin());
    quad(Vec3::new(x, y, 0.0) + beyond * 50.0, along * 60.0, beyond * 50.0)
}

fn steps(range: std::ops::Range<f32>, count: usize) -> Vec<f32> {
    (0..count).map(|i| range.start + (range.end - range.start) * i as f32 / count as f32).collect()
}

#[test]
fn disk_cut_by_an_edge() {
    let (height, edge, radius) = (5.0, 1.5, 0.4);
    let light = AreaLight::Disk { centre: Vec3::Y * height, normal: Vec3::Y, radius_world: radius };
    let xs = steps(-0.3..0.3, 400);
    let exact: Vec<f64> = xs
        .iter()
        .map(|&x| f64::from(x))
        .map(|x| disk_cut_by_line(x * (1.0 - f64::from(height / edge)) / f64::from(radius)))
        .collect();
    let scene = [floor(10.0), plate(0.0, edge, 0.0)].concat();
    check("disk", &scene, &on_floor(xs, 0.25), &light, &exact);
}

#[test]
fn rectangle_cut_by_an_oblique_edge() {
    let (height, edge, angle) = (4.0, 1.0, 0.5f32);
    let (half_u, half_v) = (Vec3::new(0.5, 0.0, 0.1), Vec3::new(-0.06, 0.0, 0.3));
    let light = AreaLight::Rect { centre: Vec3::Y * height, half_u, half_v };
    let corners = [half_u + half_v, half_v - half_u, -half_u - half_v, half_u - half_v];
    let corners = corners.map(|c| (Vec3::Y * height + c).as_dvec3());
    let towards_edge = DVec3::new(f64::from(angle.cos()), 0.0, -f64::from(angle.sin()));
    let xs = steps(-0.3..0.3, 400);
    let points = on_floor(xs, 0.0);
    let visible = |p: &Vec3| {
        // Where the edge's point above the origin lands on the light's plane, from p.
        let p = p.as_dvec3();
        let landing = p + (DVec3::Y * f64::from(edge) - p) * f64::from(height / edge);
        area(&clip(&corners, -towards_edge, -towards_edge.dot(landing))) / area(&corners)
    };
    let exact: Vec<f64> = points.position.iter().map(visible).collect();
    let scene = [floor(10.0), plate(0.0, edge, angle)].concat();
    check("rectangle", &scene, &points, &light, &exact);
}

/// Also what `1 - cos` in f32 gets wrong: a sun of .53 degrees.
#[test]
fn sun_behind_a_half_plane() {
    for (degrees, reach) in [(0.53, 0.02), (20.0, 0.6)] {
        let direction = Vec3::new(0.2, 1.0, 0.4).normalize();
        let angular_diameter_radians = f32::to_radians(degrees);
        let light = AreaLight::Sun { direction_to_light: direction, angular_diameter_radians };
        let edge = 2.0;
        // Where the centre's ray through the edge meets the floor.
        let middle = -edge * direction.x / direction.y;
        let points = on_floor(steps(middle - reach..middle + reach, 400), 0.1);
        let visible = |p: &Vec3| {
            // Directions with a positive product are hidden: those beyond the plane through p and
            // the edge, which runs along z.
            let to_edge = DVec3::new(0.0, f64::from(edge), 0.0) - p.as_dvec3();
            let hidden_side = DVec3::new(to_edge.y, -to_edge.x, 0.0).normalize();
            let angle = hidden_side.angle_between(direction.as_dvec3());
            cap_visible(0.5 * f64::from(angular_diameter_radians), FRAC_PI_2, angle)
        };
        let exact: Vec<f64> = points.position.iter().map(visible).collect();
        let scene = [floor(10.0), plate(0.0, edge, 0.0)].concat();
        check(&format!("sun of {degrees} degrees"), &scene, &points, &light, &exact);
    }
}

/// The blocker is a polyhedron inscribed in the sphere: its silhouette lies at most the sagitta
/// `r (1 - cos(pi / segments))` inside the sphere's. It is also more than the shafts take on: they
/// leave it to rays.
#[test]
fn sphere_behind_a_sphere() {
    let segments = 192;
    let (light_centre, light_radius) = (Vec3::new(0.0, 6.0, 0.0), 0.5);
    let (centre, radius) = (Vec3::new(0.0, 2.0, 0.0), 0.25);
    let light = AreaLight::Sphere { centre: light_centre, radius_world: light_radius };
    let points = on_floor(steps(-0.6..0.6, 240), 0.05);
    let cone = |p: DVec3, centre: Vec3, radius: f32| {
        let axis = centre.as_dvec3() - p;
        (axis, (f64::from(radius) / axis.length()).asin())
    };
    let visible = |p: &Vec3| {
        let (to_light, al) = cone(p.as_dvec3(), light_centre, light_radius);
        let (to_blocker, be) = cone(p.as_dvec3(), centre, radius);
        cap_visible(al, be, to_light.angle_between(to_blocker))
    };
    let exact: Vec<f64> = points.position.iter().map(visible).collect();
    let scene = [floor(10.0).to_vec(), ball(centre, radius, segments)].concat();
    let tracer = Tracer::new(&crate::common::scene(&scene)).expect("a scene");
    // A silhouette moved by `t be` across a chord of at most `2 al` of a light of `pi al^2`.
    let sagitta = 1.0 - (std::f64::consts::PI / f64::from(segments)).cos();
    let (al, be) = (0.5 / 6.0, 0.25 / 2.0);
    let geometry = 2.0 * sagitta * be / (std::f64::consts::PI * al);
    for (samples, method) in [(128, Method::Shafts), (128, Method::Scanlines), (8192, Method::Scanlines)] {
        let truth = tracer.truth(&points, &light, &settings(samples, method));
        assert_exact(&format!("sphere, {method:?}, 2 x {samples}"), &truth, &exact, geometry);
    }
}

/// A ball's upper and lower halves in rings of `segments` facets.
fn ball(centre: Vec3, radius: f32, segments: u32) -> Vec<[Vec3; 3]> {
    let rings = segments / 2;
    let at = |ring: u32, segment: u32| {
        let polar = std::f32::consts::PI * ring as f32 / rings as f32;
        let around = std::f32::consts::TAU * (segment % segments) as f32 / segments as f32;
        let flat = Vec3::new(around.cos(), 0.0, around.sin()) * polar.sin();
        centre + (flat + Vec3::Y * polar.cos()) * radius
    };
    (0..rings)
        .flat_map(|ring| (0..segments).map(move |segment| (ring, segment)))
        .flat_map(|(r, s)| {
            let upper = [at(r, s), at(r, s + 1), at(r + 1, s)];
            let lower = [at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)];
            [(r > 0, upper), (r + 1 < rings, lower)]
        })
        .filter_map(|(exists, triangle)| exists.then_some(triangle))
        .collect()
}
