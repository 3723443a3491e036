//! What is seen: surfaces, area lights and camera paths, from `scene.toml`, OBJ and glTF files or
//! from generators.
//!
//! A leaf crate. It knows no renderer, no image and no score. Space is glTF's: right-handed, y up,
//! metres, a camera looks along its -z.

mod assemble;
mod builtin;
mod camera;
mod cameras;
#[cfg(test)]
mod cutout_tests;
mod error;
mod fitted;
mod generators;
mod gltf_file;
mod hash;
mod hermite;
mod light;
mod load;
mod model;
mod notes;
mod obj;
mod paths;
mod picture;
mod rays;
mod spec;
mod suggest;
#[cfg(test)]
mod tests;
mod texture;

pub use builtin::builtin_names;
pub use camera::{Camera, CameraPath, PathFrame};
pub use cameras::{
    Axis, CameraFile, CamerasJson, Convention, ConventionJson, FrameCamera, FrameJson, Handedness,
    MatrixOrder, Preset, VectorKind, cameras_schema,
};
pub use error::SceneError;
pub use generators::Generator;
pub use light::AreaLight;
pub use spec::{
    GeometrySpec, Interpolation, Keyframe, KeyframeList, LightSpec, Motion, PathSpec, SceneFile,
    ShadowRegionSpec, UpAxis,
};
pub use suggest::suggest;
pub use texture::{AlphaMask, Texture, Wrap};

use glam::{DVec2, DVec3, Vec2, Vec3};

/// Everything a picture is made of. Coordinates are metres after recentring by `origin`.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Short name: the folder's or the model file's stem.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// All surfaces, in world space.
    pub geometry: Geometry,
    /// Diffuse materials; never empty.
    pub materials: Vec<Material>,
    /// Area lights; never empty. The first is the one that is scored.
    pub lights: Vec<AreaLight>,
    /// Named camera paths; never empty.
    pub paths: Vec<CameraPath>,
    /// What a shadow map must cover.
    pub shadow_region: ShadowRegion,
    /// What was subtracted from the file's coordinates (0 unless the scene lies far from its
    /// origin, where f32 loses millimetres).
    pub origin: DVec3,
    /// What the loader changed or dropped, for people to read ("12 degenerate triangles dropped").
    pub notes: Vec<String>,
}

/// Triangles in world space, counter-clockwise seen from outside where the file says so; both
/// sides cast and receive.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Geometry {
    /// Vertex positions in metres, all finite.
    pub positions: Vec<Vec3>,
    /// Indices into `positions`; no triangle is degenerate.
    pub triangles: Vec<[u32; 3]>,
    /// Per triangle, an index into the scene's materials.
    pub material: Vec<u32>,
    /// Per triangle, where its corners stand in its material's pictures (v downwards); empty where no
    /// material has any.
    pub uvs: Vec<[Vec2; 3]>,
}

/// A diffuse surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// As in the file.
    pub name: String,
    /// Linear reflectance per colour, 0 to 1.
    pub albedo: Vec3,
    /// Where it is cut out.
    pub mask: Option<AlphaMask>,
    /// Multiplies the reflectance in shaded pictures; shadows do not depend on it.
    pub texture: Option<Texture>,
}

/// The part of the world that a sun's orthographic shadow map covers, and the blocker distance
/// for which techniques of a fixed kernel are set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadowRegion {
    /// Centre of the map.
    pub centre: Vec3,
    /// Side of the square map in metres.
    pub width_world: f32,
    /// Typical distance from blocker to receiver: a light-matched fixed kernel is as wide as the
    /// penumbra of a blocker at this distance.
    pub reference_gap_world: f32,
}

impl Scene {
    /// The path of this name.
    ///
    /// # Errors
    /// `UnknownName` with the nearest name when there is none.
    pub fn path(&self, name: &str) -> Result<&CameraPath, SceneError> {
        let names = self.paths.iter().map(|path| path.name.as_str());
        let found = self.paths.iter().find(|path| path.name == name);
        found.ok_or_else(|| SceneError::unknown("path", name, names))
    }

    /// Whether any triangle is cut out.
    pub fn has_masks(&self) -> bool {
        self.geometry.material.iter().any(|&m| self.materials[m as usize].mask.is_some())
    }

    /// Linear reflectance of a triangle at a place on it.
    pub fn albedo_at(&self, triangle: usize, place: Vec3) -> Vec3 {
        let material = &self.materials[self.geometry.material[triangle] as usize];
        match self.geometry.uvs.get(triangle) {
            Some(uvs) if material.texture.is_some() => {
                let corners = self.geometry.corners(triangle).map(|corner| corner.as_dvec3());
                material.albedo_at(uv_at((&corners, uvs), place.as_dvec3()))
            }
            _ => material.albedo,
        }
    }
}

impl Material {
    /// Of one colour, whole.
    pub fn plain(name: impl Into<String>, albedo: Vec3) -> Self {
        Self { name: name.into(), albedo, mask: None, texture: None }
    }

    /// What has no colour of its own: grey 0.5.
    pub(crate) fn grey() -> Self {
        Self::plain("grey", Vec3::splat(0.5))
    }

    /// Linear reflectance at a place of the material's pictures.
    pub fn albedo_at(&self, uv: DVec2) -> Vec3 {
        self.texture.as_ref().map_or(self.albedo, |texture| self.albedo * texture.colour(uv))
    }
}

impl Geometry {
    /// The corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [Vec3; 3] {
        self.triangles[triangle].map(|v| self.positions[v as usize])
    }

    /// Smallest and largest coordinates (zero for an empty geometry).
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let first = self.positions.first().copied().unwrap_or(Vec3::ZERO);
        self.positions.iter().fold((first, first), |(lo, hi), &p| (lo.min(p), hi.max(p)))
    }
}

/// Where a place on a triangle stands in its pictures: its corners' places, weighed by the parts of
/// the area that are opposite (0 for a triangle without an area).
pub fn uv_at((corners, uvs): (&[DVec3; 3], &[Vec2; 3]), place: DVec3) -> DVec2 {
    let [a, b, c] = *corners;
    let normal = (b - a).cross(c - a);
    let per_area = 1.0 / normal.length_squared().max(f64::MIN_POSITIVE);
    let u = (place - a).cross(c - a).dot(normal) * per_area;
    let v = (b - a).cross(place - a).dot(normal) * per_area;
    let [at_a, at_b, at_c] = uvs.map(Vec2::as_dvec2);
    at_a + u * (at_b - at_a) + v * (at_c - at_a)
}
