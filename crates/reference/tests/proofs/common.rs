//! Small scenes for the tests of this crate.

use glam::{DVec3, Vec3};
use umbrage_frame::View;
use umbrage_reference::{Method, Points, TruthSettings};
use umbrage_scene::{AreaLight, Camera, Geometry, Material, Scene, ShadowRegion};

/// A scene of nothing but triangles.
pub(crate) fn scene(triangles: &[[Vec3; 3]]) -> Scene {
    let geometry = Geometry {
        positions: triangles.iter().flatten().copied().collect(),
        triangles: (0..triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
        material: vec![0; triangles.len()],
        uvs: vec![],
    };
    Scene {
        name: "test".into(),
        title: "a test".into(),
        geometry,
        materials: vec![Material::plain("grey", Vec3::splat(0.5))],
        lights: vec![overhead_sun(0.53)],
        paths: vec![],
        shadow_region: ShadowRegion { centre: Vec3::ZERO, width_world: 30.0, reference_gap_world: 1.0 },
        origin: DVec3::ZERO,
        notes: vec![],
    }
}

/// A parallelogram: centre and half axes.
pub(crate) fn quad(centre: Vec3, u: Vec3, v: Vec3) -> [[Vec3; 3]; 2] {
    let [a, b, c, d] = [centre - u - v, centre + u - v, centre + u + v, centre - u + v];
    [[a, b, c], [a, c, d]]
}

/// A floor at y = 0, its half width in metres.
pub(crate) fn floor(half: f32) -> [[Vec3; 3]; 2] {
    quad(Vec3::ZERO, Vec3::X * half, Vec3::NEG_Z * half)
}

/// An axis-aligned box.
pub(crate) fn block(centre: Vec3, half: Vec3) -> Vec<[Vec3; 3]> {
    let (x, y, z) = (Vec3::X * half.x, Vec3::Y * half.y, Vec3::Z * half.z);
    [(x, y, z), (y, z, x), (z, x, y)]
        .into_iter()
        .flat_map(|(n, u, v)| [quad(centre + n, u, v), quad(centre - n, v, u)])
        .flatten()
        .collect()
}

/// Thirty blocks strewn over a floor.
pub(crate) fn strewn_blocks() -> Vec<[Vec3; 3]> {
    let mut triangles = floor(20.0).to_vec();
    let mut random = Random(5);
    for _ in 0..30 {
        let centre = random.vector() * Vec3::new(4.0, 1.0, 4.0) + Vec3::Y * 1.4;
        triangles.extend(block(centre, Vec3::new(0.35, 0.2, 0.25)));
    }
    triangles
}

/// Straight overhead; full angle in degrees.
pub(crate) fn overhead_sun(degrees: f32) -> AreaLight {
    AreaLight::Sun { direction_to_light: Vec3::Y, angular_diameter_radians: degrees.to_radians() }
}

/// Points on a floor whose first triangles are `floor`'s, along z = `z`.
pub(crate) fn on_floor(xs: impl IntoIterator<Item = f32>, z: f32) -> Points {
    let position: Vec<Vec3> = xs.into_iter().map(|x| Vec3::new(x, 0.0, z)).collect();
    // The floor's diagonal runs from (-, +) to (+, -) in (x, z): triangle 0 is where x + z > 0.
    let triangle = position.iter().map(|p| u32::from(p.x + p.z < 0.0)).collect();
    Points { normal: vec![Vec3::Y; position.len()], triangle, position }
}

/// Settings for a test.
pub(crate) fn settings(samples: u32, method: Method) -> TruthSettings {
    TruthSettings { samples, replicates: 8, basis_samples: samples, seed: 1, method, tolerance: None }
}

/// A camera of 60 degrees.
pub(crate) fn view(eye: Vec3, target: Vec3, size: [u32; 2]) -> View {
    view_of(&Camera::look_at(eye, target, 60f32.to_radians(), 0.05, 500.0), size)
}

pub(crate) fn view_of(camera: &Camera, [width, height]: [u32; 2]) -> View {
    View {
        width,
        height,
        clip_from_world: camera.clip_from_camera(width as f32 / height as f32) * camera.camera_from_world(),
        camera_from_world: camera.camera_from_world(),
        yfov_radians: camera.yfov_radians,
    }
}

/// Numbers in [0, 1) from a fixed sequence (SplitMix64).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1 << 24) as f32
    }

    /// In [-1, 1)^3.
    pub(crate) fn vector(&mut self) -> Vec3 {
        Vec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }
}
