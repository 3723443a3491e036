//! What bites whoever traces rays through obvhs in f32 (GROUND_TRUTH, sections 1 and 5), one test
//! each.

use crate::closed_forms::assert_exact;
use crate::common::*;
use crate::exact::{cap_visible, disk_cut_by_line};
use glam::{DVec3, Vec3};
use std::f64::consts::FRAC_PI_2;
use umbrage_reference::{Method, Points, ReferenceError, Tracer};
use umbrage_scene::AreaLight;

const METHODS: [Method; 4] = [Method::Rays, Method::Shafts, Method::Scanlines, Method::ScanlineRays];

fn values(triangles: &[[Vec3; 3]], points: &Points, light: &AreaLight, method: Method) -> Vec<f32> {
    let tracer = Tracer::new(&scene(triangles)).expect("a scene");
    tracer.truth(points, light, &settings(32, method)).mean
}

/// A direction component of -0.0: `CwBvh` misses everything.
#[test]
fn negative_zero_directions() {
    let roof = quad(Vec3::Y * 2.0, Vec3::X * 3.0, Vec3::Z * 3.0);
    let triangles = [floor(10.0), roof].concat();
    let points = on_floor([0.5, 1.0, 2.0, 9.0], 0.1);
    for direction in [Vec3::new(-0.0, 1.0, -0.0), Vec3::new(0.0, 1.0, -0.0), Vec3::Y] {
        let light = AreaLight::Sun { direction_to_light: direction, angular_diameter_radians: 0.0 };
        for method in METHODS {
            assert_eq!(values(&triangles, &points, &light, method), [0.0, 0.0, 0.0, 1.0], "{direction:?}");
        }
    }
    // A camera that looks along -y, -x and -z has such directions at its middle pixel.
    let tracer = Tracer::new(&scene(&block(Vec3::ZERO, Vec3::ONE))).expect("a scene");
    for eye in [Vec3::Y, Vec3::X, Vec3::Z] {
        let hits = tracer.primary(&view(eye * 4.0, Vec3::ZERO, [3, 3]));
        assert!((hits.gbuffer.depth.at(1, 1) - 3.0).abs() < 1e-6, "seen from {eye}");
    }
}

/// `CwBvh` never sees an occluder nearer than 1e-4. Neither does a tracer that lifts its rays.
#[test]
fn contact() {
    for gap in [1e-3, 9e-5, 5e-5, 1e-5, 1e-6] {
        let plate = quad(Vec3::new(0.0, gap, 0.0), Vec3::X, Vec3::Z);
        let triangles = [floor(10.0), plate].concat();
        let points = on_floor([-0.9, -0.1, 0.5, 0.99, 1.01, 3.0], 0.2);
        for method in METHODS {
            let found = values(&triangles, &points, &overhead_sun(1.0), method);
            assert_eq!(found, [0.0, 0.0, 0.0, 0.0, 1.0, 1.0], "a gap of {gap}, {method:?}");
        }
    }
}

/// The same on a tilted floor away from the origin, where a coordinate's ulp is 1e-6.
#[test]
fn contact_on_a_slope() {
    let normal = Vec3::new(0.3, 0.9, -0.2).normalize();
    let (u, v) = normal.any_orthonormal_pair();
    let centre = Vec3::new(7.0, 3.0, -9.0);
    for gap in [1e-4, 1e-5] {
        let triangles = [quad(centre, u * 4.0, v * 4.0), quad(centre + normal * gap, u, v)].concat();
        let tracer = Tracer::new(&scene(&triangles)).expect("a scene");
        let light = AreaLight::Sun { direction_to_light: normal, angular_diameter_radians: 0.01 };
        let offsets = [(-0.9, 0.3), (0.1, 0.2), (0.8, -0.7), (1.2, 0.1), (-0.3, 2.0)];
        // Triangle 0 holds the corners (-1, -1), (1, -1), (1, 1) in (u, v).
        let points = Points {
            position: offsets.iter().map(|&(a, b)| centre + u * a + v * b).collect(),
            normal: vec![normal; offsets.len()],
            triangle: offsets.iter().map(|&(a, b)| u32::from(b > a)).collect(),
        };
        for method in METHODS {
            let found = tracer.truth(&points, &light, &settings(32, method)).mean;
            assert_eq!(found, [0.0, 0.0, 0.0, 1.0, 1.0], "a gap of {gap}, {method:?}");
        }
    }
}

/// Lifting the ray's origin by 1e-4 (1 + t) at 10 m biases V under a blocker 2 cm up by .44, lifting
/// it by a bare 1e-4 m by several hundredths.
#[test]
fn nothing_is_lifted() {
    let (edge, far) = (0.02f32, 10.0f32);
    let direction = Vec3::new(0.8, 0.6, 0.0);
    let light = AreaLight::Sun { direction_to_light: direction, angular_diameter_radians: 2f32.to_radians() };
    let plate = quad(Vec3::new(far + 20.0, edge, 0.0), Vec3::Z * 40.0, Vec3::X * 20.0);
    let middle = far - edge * direction.x / direction.y;
    let points = on_floor((0..300).map(|i| middle + (i as f32 - 150.0) * 6e-6), 0.1);
    let exact: Vec<f64> = points
        .position
        .iter()
        .map(|p| {
            let to_edge = DVec3::new(f64::from(far) - f64::from(p.x), f64::from(edge), 0.0);
            let hidden_side = DVec3::new(to_edge.y, -to_edge.x, 0.0);
            cap_visible(1f64.to_radians(), FRAC_PI_2, hidden_side.angle_between(direction.as_dvec3()))
        })
        .collect();
    let tracer = Tracer::new(&scene(&[floor(60.0), plate].concat())).expect("a scene");
    for method in METHODS {
        let truth = tracer.truth(&points, &light, &settings(128, method));
        assert_exact("2 cm above the floor", &truth, &exact, 0.0);
    }
}

/// Without an offset, what keeps a surface from shadowing itself is that its own plane is skipped:
/// neighbours in a tilted mesh whose vertices are rounded, also at their common edges and corners,
/// and the same surface modelled twice.
#[test]
fn no_surface_shadows_itself() {
    let normal = Vec3::new(0.31, 0.88, -0.17).normalize();
    let (u, v) = normal.any_orthonormal_pair();
    let centre = Vec3::new(7.3, 3.1, -9.7);
    let at = |i: i32, j: i32| centre + u * (i as f32 * 0.13) + v * (j as f32 * 0.17);
    let cells = (-10..10).flat_map(|i| (-10..10).map(move |j| (i, j)));
    let mesh: Vec<[Vec3; 3]> = cells
        .flat_map(|(i, j)| {
            [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
        })
        .collect();
    // A corner, the middles of the edges and the middle of each triangle.
    let weights = [Vec3::X, Vec3::new(0.5, 0.5, 0.0), Vec3::new(0.5, 0.0, 0.5), Vec3::splat(1.0 / 3.0)];
    let on = |t: &[Vec3; 3], w: Vec3| t[0] * w.x + t[1] * w.y + t[2] * w.z;
    let points = Points {
        position: mesh.iter().flat_map(|t| weights.map(|w| on(t, w))).collect(),
        normal: vec![normal; 4 * mesh.len()],
        triangle: (0..4 * mesh.len() as u32).map(|i| i / 4).collect(),
    };
    let twice = [mesh.clone(), mesh].concat();
    let tracer = Tracer::new(&scene(&twice)).expect("a scene");
    for degrees in [3f32, 30.0, 80.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let direction_to_light = u * cos + normal * sin;
        let light = AreaLight::Sun { direction_to_light, angular_diameter_radians: 0.01 };
        for method in METHODS {
            let truth = tracer.truth(&points, &light, &settings(16, method));
            let shadowed = truth.mean.iter().filter(|&&v| v < 1.0).count();
            assert_eq!(shadowed, 0, "of {} points at {degrees} degrees, {method:?}", points.len());
        }
    }
}

/// Neighbours share their edges to the bit: nothing leaks between them.
#[test]
fn meshes_are_tight() {
    let at = |i: i32, j: i32| {
        Vec3::new(i as f32 * 0.071, 1.3 + 0.03 * ((i * i + 3 * j) % 7) as f32, j as f32 * 0.067)
    };
    let roof = (-30..30).flat_map(|i| (-30..30).map(move |j| (i, j))).flat_map(|(i, j)| {
        [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i, j + 1), at(i + 1, j + 1)]]
    });
    let triangles: Vec<[Vec3; 3]> = floor(10.0).into_iter().chain(roof).collect();
    let points = on_floor((0..60).map(|i| i as f32 * 0.01 - 0.3), 0.05);
    let lights = [overhead_sun(20.0), AreaLight::Sphere { centre: Vec3::Y * 4.0, radius_world: 1.0 }];
    let tracer = Tracer::new(&scene(&triangles)).expect("a scene");
    for (light, method) in lights.iter().flat_map(|l| METHODS.map(|m| (l, m))) {
        let mean = tracer.truth(&points, light, &settings(256, method)).mean;
        assert!(mean.iter().all(|&v| v == 0.0), "{light:?}, {method:?}: {mean:?}");
    }
}

/// The lamp's own panel, modelled where the light is, does not shadow it; a blocker does.
#[test]
fn a_lamp_at_the_light() {
    let light = AreaLight::Rect { centre: Vec3::Y * 3.0, half_u: Vec3::X * 0.5, half_v: Vec3::Z * 0.5 };
    let panel = |y: f32| [floor(10.0), quad(Vec3::Y * y, Vec3::X, Vec3::Z)].concat();
    let points = on_floor([0.1, 0.7], 0.1);
    for method in METHODS {
        assert_eq!(values(&panel(3.0), &points, &light, method), [1.0, 1.0]);
        assert_eq!(values(&panel(3.1), &points, &light, method), [1.0, 1.0], "behind the light");
        assert_eq!(values(&panel(2.99), &points, &light, method), [0.0, 0.0]);
    }
}

/// obvhs wants unit directions: with a length of 1e4 an occluder 0.05 m away is lost.
#[test]
fn light_directions_of_any_length() {
    let plate = quad(Vec3::Y * 0.05, Vec3::X, Vec3::Z);
    let triangles = [floor(10.0), plate].concat();
    let points = on_floor([0.0, 0.5, 3.0], 0.1);
    for length in [1e-3, 1.0, 1e4] {
        let lights = [
            AreaLight::Sun { direction_to_light: Vec3::Y * length, angular_diameter_radians: 0.01 },
            AreaLight::Disk { centre: Vec3::Y * 1e4, normal: Vec3::Y * length, radius_world: 1.0 },
        ];
        for (light, method) in lights.iter().flat_map(|l| METHODS.map(|m| (l, m))) {
            assert_eq!(values(&triangles, &points, light, method), [0.0, 0.0, 1.0], "{light:?}");
        }
    }
}

/// Triangles that grow by a constant factor, each round the smaller ones, make a tree deeper than
/// obvhs's usual stack of 96 (a unit test of the tree says so); an overflow would drop some of them.
#[test]
fn deep_trees() {
    let shape = [Vec3::new(1.0, 0.1, 0.0), Vec3::new(-0.5, 0.1, 0.8), Vec3::new(-0.5, 0.1, -0.8)];
    let triangles: Vec<[Vec3; 3]> =
        (0..236).map(|k| 1e-15 * 1.3f32.powi(k)).map(|s| shape.map(|v| v * s)).collect();
    let tracer = Tracer::new(&scene(&triangles)).expect("a scene");
    // Above each triangle's corner, where no other lies between it and a light from below.
    let position: Vec<Vec3> = triangles.iter().map(|t| t[0] * Vec3::new(0.85, 1.01, 0.0)).collect();
    let points = Points {
        normal: vec![Vec3::ZERO; position.len()],
        triangle: vec![u32::MAX; position.len()],
        position,
    };
    let light = AreaLight::Sun { direction_to_light: Vec3::NEG_Y, angular_diameter_radians: 0.0 };
    for method in METHODS {
        let mean = tracer.truth(&points, &light, &settings(2, method)).mean;
        assert!(mean.iter().all(|&v| v == 0.0), "{method:?}: {mean:?}");
    }
}

/// 1 km out, f32 coordinates are 0.06 mm apart. The scene crate recentres; what it hands over must
/// be as good as a scene made at the origin, and even without it a gap of 5 mm must hold.
#[test]
fn a_kilometre_from_the_origin() {
    let centre = DVec3::new(1000.0, 250.0, -700.0);
    let placed = [floor(20.0), quad(Vec3::new(10.0, 0.005, 0.0), Vec3::X * 10.0, Vec3::Z * 20.0)]
        .concat()
        .iter()
        .map(|t| t.map(|v| v.as_dvec3() + centre))
        .collect::<Vec<_>>();
    let recentred: Vec<[Vec3; 3]> = placed.iter().map(|t| t.map(|v| (v - centre).as_vec3())).collect();
    let points = on_floor((0..300).map(|i| (i as f32 - 150.0) * 1e-6), 0.1);
    let tracer = Tracer::new(&scene(&recentred)).expect("a scene");
    let truth = tracer.truth(&points, &overhead_sun(2.0), &settings(128, Method::Shafts));
    let radius = 0.005 * 1f64.to_radians().tan();
    let exact: Vec<f64> =
        points.position.iter().map(|p| disk_cut_by_line(-f64::from(p.x) / radius)).collect();
    assert_exact("recentred", &truth, &exact, 1e-4);

    let far: Vec<[Vec3; 3]> = placed.iter().map(|t| t.map(|v| v.as_vec3())).collect();
    let mut points = on_floor([-1.0, -0.01, 0.01, 1.0, 5.0], 0.1);
    points.position.iter_mut().for_each(|p| *p += centre.as_vec3());
    for method in METHODS {
        let found = values(&far, &points, &overhead_sun(2.0), method);
        assert_eq!(found, [1.0, 1.0, 0.0, 0.0, 0.0], "where it was, {method:?}");
    }
}

/// A light of no size casts hard shadows.
#[test]
fn lights_of_no_size() {
    let triangles = [floor(10.0), quad(Vec3::Y * 1.0, Vec3::X, Vec3::Z)].concat();
    let points = on_floor((0..40).map(|i| i as f32 * 0.11 - 2.2), 0.13);
    let centre = Vec3::new(0.3, 5.0, 0.1);
    let lights = [
        AreaLight::Sun { direction_to_light: Vec3::new(0.1, 1.0, 0.0), angular_diameter_radians: 0.0 },
        AreaLight::Disk { centre, normal: Vec3::Y, radius_world: 0.0 },
        AreaLight::Rect { centre, half_u: Vec3::ZERO, half_v: Vec3::ZERO },
        AreaLight::Sphere { centre, radius_world: 0.0 },
    ];
    for light in lights {
        let [rays, others @ ..] = METHODS.map(|method| values(&triangles, &points, &light, method));
        assert!(others.iter().all(|other| *other == rays), "{light:?}");
        assert!(rays.iter().all(|&v| v == 0.0 || v == 1.0) && rays.contains(&0.0) && rays.contains(&1.0));
    }
    // One axis alone: a tube.
    let tube = AreaLight::Rect { centre, half_u: Vec3::X * 0.5, half_v: Vec3::ZERO };
    let [rays, others @ ..] = METHODS.map(|method| values(&triangles, &points, &tube, method));
    assert!(others.iter().all(|other| *other == rays));
    assert!(rays.iter().any(|&v| v > 0.0 && v < 1.0), "a tube has penumbrae along its axis");
}

/// Half of a light stands below the horizon; inside a light there is no shadow to speak of.
#[test]
fn lights_across_the_horizon_and_round_the_point() {
    let tracer = Tracer::new(&scene(&floor(10.0))).expect("a scene");
    let points = on_floor([3.0], 0.1);
    let disk = |y: f32| AreaLight::Disk { centre: Vec3::Y * y, normal: Vec3::X, radius_world: 0.5 };
    for method in METHODS {
        let truth = |light: &AreaLight| tracer.truth(&points, light, &settings(512, method));
        let half = truth(&disk(0.0));
        // Eight strata of a straight edge: an error of 1 % is ten times the expected one.
        assert!((half.mean[0] - 0.5).abs() < 0.01 && !half.facing[0], "{}", half.mean[0]);
        assert_eq!((truth(&disk(-0.6)).mean[0], truth(&disk(-0.6)).facing[0]), (0.0, false));
        assert_eq!((truth(&disk(0.6)).mean[0], truth(&disk(0.6)).facing[0]), (1.0, true));
        let round = truth(&AreaLight::Sphere { centre: Vec3::new(3.0, 0.5, 0.1), radius_world: 1.0 });
        assert_eq!((round.mean[0], round.facing[0]), (1.0, false));
    }
}

#[test]
fn bad_scenes_are_refused() {
    let refused = |change: fn(&mut umbrage_scene::Scene)| {
        let mut scene = scene(&floor(1.0));
        change(&mut scene);
        Tracer::new(&scene).err().expect("an error")
    };
    assert!(matches!(refused(|s| s.geometry.triangles.clear()), ReferenceError::NoTriangles));
    assert!(matches!(refused(|s| s.geometry.positions[2].y = f32::NAN), ReferenceError::VertexNotFinite(2)));
    assert!(matches!(refused(|s| s.geometry.triangles[1][0] = 99), ReferenceError::NoSuchVertex(1)));
    assert!(matches!(refused(|s| s.geometry.material[1] = 7), ReferenceError::NoSuchMaterial(1)));
    assert!(matches!(refused(|s| s.geometry.material.clear()), ReferenceError::NoSuchMaterial(0)));
}
