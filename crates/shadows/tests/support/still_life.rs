//! A small scene with every situation that a decision of the pipeline depends on: contact, a gap,
//! stacked blockers, a thin pole, a tilted plane, an open sheet, a floor that reaches beyond the
//! shadow map, and sky.

use glam::{Mat4, Quat, Vec2, Vec3};
use umbrage_frame::View;
use umbrage_scene::{AlphaMask, AreaLight, Camera, Geometry, Material, Scene, ShadowRegion, Wrap};
use umbrage_shadows::VariantId;

/// Width and height of the test pictures.
pub(crate) const SIZE: (u32, u32) = (96, 54);

/// The scene, with a sun and a sphere light.
pub(crate) fn scene() -> Scene {
    let mut geometry = Geometry::default();
    let size = Vec3::new;
    block(&mut geometry, size(7.6, 0.1, 7.6), at(0.0, -0.05, 0.0));
    block(&mut geometry, size(0.2, 2.0, 4.0), at(-2.0, 1.0, 0.0));
    block(&mut geometry, size(0.6, 0.6, 0.6), at(0.9, 0.3, 0.7) * Mat4::from_rotation_y(0.4));
    block(&mut geometry, size(1.2, 0.08, 0.9), at(-0.5, 0.25, 0.9) * Mat4::from_rotation_z(0.35));
    block(&mut geometry, size(0.9, 0.03, 0.7), at(0.5, 1.1, -0.5) * Mat4::from_rotation_y(0.3));
    block(&mut geometry, size(0.5, 0.03, 1.4), at(0.9, 1.7, -0.3) * Mat4::from_rotation_x(0.2));
    block(&mut geometry, size(2.6, 0.05, 0.05), at(-0.2, 1.5, 0.4) * Mat4::from_rotation_y(-0.5));
    let sheet = [[-1.5, 0.2, -1.0], [-1.0, 0.2, -1.4], [-1.0, 1.3, -1.5], [-1.5, 1.3, -1.0]];
    quad(&mut geometry, sheet.map(Vec3::from));
    of_geometry(geometry)
}

/// The same with its last two plates, the pole and the sheet cut out by a mask.
pub(crate) fn leafy(mask: AlphaMask) -> Scene {
    let mut scene = scene();
    let count = scene.geometry.triangles.len();
    let first = count - 2 - 3 * 12;
    let corner = |u: f32, v: f32| Vec2::new(u, v) * 2.3 - 0.4;
    let (a, b, c, d) = (corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0));
    scene.geometry.uvs = (0..count).map(|t| if t % 2 == 0 { [a, b, c] } else { [a, c, d] }).collect();
    scene.geometry.material = (0..count).map(|t| u32::from(t >= first)).collect();
    scene.materials.push(Material { mask: Some(mask), ..Material::plain("leaf", Vec3::ONE) });
    scene
}

/// A mask without a symmetry.
pub(crate) fn leaf(wrap: Wrap) -> AlphaMask {
    AlphaMask::new([5, 3], [wrap; 2], |x, y| (x * 7 + y * 3) % 5 < 2)
}

/// A scene of these triangles, under the same lights and with the same shadow region.
pub(crate) fn of_geometry(geometry: Geometry) -> Scene {
    let material = vec![0; geometry.triangles.len()];
    Scene {
        name: "still-life".into(),
        title: "blocks, plates, a pole and a sheet".into(),
        geometry: Geometry { material, ..geometry },
        materials: vec![Material::plain("grey", Vec3::splat(0.5))],
        lights: vec![sun(), sphere()],
        paths: Vec::new(),
        shadow_region: ShadowRegion {
            centre: Vec3::new(0.0, 0.4, 0.0),
            width_world: 6.0,
            reference_gap_world: 1.1,
        },
        origin: glam::DVec3::ZERO,
        notes: Vec::new(),
    }
}

/// A sun of 3 degrees.
pub(crate) fn sun() -> AreaLight {
    AreaLight::Sun {
        direction_to_light: Vec3::new(0.5, 0.7, -0.45).normalize(),
        angular_diameter_radians: 0.052,
    }
}

/// A ball of light over the scene; one wall rises behind it.
pub(crate) fn sphere() -> AreaLight {
    AreaLight::Sphere { centre: Vec3::new(1.0, 2.9, -1.2), radius_world: 0.07 }
}

/// A disc of light.
pub(crate) fn disk() -> AreaLight {
    AreaLight::Disk {
        centre: Vec3::new(-0.4, 3.1, 1.6),
        normal: Vec3::new(0.0, -1.0, -0.2).normalize(),
        radius_world: 0.1,
    }
}

/// The picture's camera.
pub(crate) fn camera() -> Camera {
    Camera::look_at(Vec3::new(2.3, 1.9, 3.3), Vec3::new(-0.4, 0.6, -0.1), 0.95, 0.1, 40.0)
}

/// Another one, which sees the same things from elsewhere.
pub(crate) fn other_camera() -> Camera {
    Camera::look_at(Vec3::new(1.1, 2.3, 3.6), Vec3::new(-0.3, 0.5, -0.2), 1.1, 0.1, 40.0)
}

/// What a camera sees.
pub(crate) fn view_of(camera: &Camera) -> View {
    let (width, height) = SIZE;
    let camera_from_world = camera.camera_from_world();
    View {
        width,
        height,
        clip_from_world: camera.clip_from_camera(width as f32 / height as f32) * camera_from_world,
        camera_from_world,
        yfov_radians: camera.yfov_radians,
    }
}

/// Adds a block of this size, placed by a rigid motion.
pub(crate) fn block(geometry: &mut Geometry, size: Vec3, world_from_block: Mat4) {
    let corner = |k: u32| {
        let sign = |bit: u32| if k >> bit & 1 == 1 { 0.5 } else { -0.5 };
        world_from_block.transform_point3(size * Vec3::new(sign(0), sign(1), sign(2)))
    };
    for face in [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]] {
        quad(geometry, face.map(corner));
    }
}

/// Adds a flat quadrilateral.
pub(crate) fn quad(geometry: &mut Geometry, corners: [Vec3; 4]) {
    let first = geometry.positions.len() as u32;
    geometry.positions.extend(corners);
    geometry.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
}

/// A square of this half-width whose normal is turned from +y by a rotation.
pub(crate) fn plane(half: f32, turn: Quat) -> Geometry {
    let mut geometry = Geometry::default();
    let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    quad(&mut geometry, corners.map(|(x, z)| turn * Vec3::new(x * half, 0.0, z * half)));
    geometry
}

fn at(x: f32, y: f32, z: f32) -> Mat4 {
    Mat4::from_translation(Vec3::new(x, y, z))
}

/// A light that the variant can do: the sun if it can.
pub(crate) fn light_for(id: VariantId) -> AreaLight {
    if id.check_light(&sun()).is_ok() { sun() } else { sphere() }
}

/// The sun and the sphere, as far as the variant can do them.
pub(crate) fn lights_for(id: VariantId) -> Vec<AreaLight> {
    [sun(), sphere()].into_iter().filter(|light| id.check_light(light).is_ok()).collect()
}

/// Distance from a point to the nearest surface, by brute force: a fine grid of points on every
/// triangle, within a thousandth of its size.
pub(crate) fn nearest_to(from: glam::DVec3) -> f64 {
    const STEPS: u32 = 400;
    let scene = scene();
    let triangles = (0..scene.geometry.triangles.len()).map(|t| scene.geometry.corners(t));
    let nearest = |[a, b, c]: [Vec3; 3]| {
        let (a, b, c) = (a.as_dvec3(), b.as_dvec3(), c.as_dvec3());
        let grid = (0..=STEPS).flat_map(|i| (0..=STEPS - i).map(move |j| (i, j)));
        let point = |(i, j): (u32, u32)| {
            let (u, v) = (f64::from(i) / f64::from(STEPS), f64::from(j) / f64::from(STEPS));
            (a + (b - a) * u + (c - a) * v).distance(from)
        };
        grid.map(point).fold(f64::INFINITY, f64::min)
    };
    // Only the nearest few triangles by their corners are worth a grid.
    let mut all: Vec<[Vec3; 3]> = triangles.collect();
    let reach = |t: &[Vec3; 3]| t.iter().map(|p| p.as_dvec3().distance(from)).fold(f64::INFINITY, f64::min);
    all.sort_by(|a, b| reach(a).total_cmp(&reach(b)));
    all.into_iter().take(24).map(nearest).fold(f64::INFINITY, f64::min)
}
