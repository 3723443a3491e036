//! The shadow map's projection: orthographic for a sun, perspective for a light that has a place.

use crate::Projection;
use crate::map_depths::{Pyramid, distances, over_square};
use glam::{Mat4, Vec3};
use std::f32::consts::FRAC_PI_2;
use umbrage_scene::{AreaLight, Scene, ShadowRegion};

/// Which of the two projections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightKind {
    /// Orthographic.
    Sun,
    /// Perspective.
    Local,
    /// Six perspective faces; depth is the distance from the light.
    Cube,
}

/// How the light sees the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightMap {
    /// Which projection.
    pub kind: LightKind,
    /// World to light space; linear depth is `-z` there.
    pub light_from_world: Mat4,
    /// World to the map's clip space.
    pub clip_from_world: Mat4,
    /// Side in texels.
    pub texels: u32,
    /// Sun: map widths per metre. Local: map widths per unit of slope. Cube: 1.
    pub scale: f32,
    /// Sun: tangent of the angular radius. Local: radius in metres (disc of equal area).
    pub light_size: f32,
    /// Smallest depth of any surface in the map, metres. Sun: of any corner of a triangle whose
    /// bounding rectangle in light space overlaps the map, which is no more.
    pub nearest_blocker: f32,
    /// Depth of the far plane, metres.
    pub far: f32,
    /// Depth of the region's centre, metres: what the seeds' relative constants scale with.
    pub eye_distance: f32,
    /// Blocker distance for which fixed kernels are set, metres.
    pub reference_gap: f32,
}

/// Widest half-angle of a local light's single map: beyond it texels stretch without bound.
const MAX_HALF_ANGLE: f32 = 60.0 * std::f32::consts::PI / 180.0;

impl LightMap {
    /// Fits one map to the scene's shadow region.
    pub fn new(scene: &Scene, light: &AreaLight, texels: u32) -> Self {
        Self::with(scene, light, (texels, Projection::Single))
    }

    /// Fits a map of this layout. A sun has no cube: it gets a single map.
    pub fn with(scene: &Scene, light: &AreaLight, (texels, projection): (u32, Projection)) -> Self {
        let fit = |scene: &Scene| match (light.centre(), projection) {
            (None, _) => Self::sun(scene, light, texels),
            (Some(centre), Projection::Cube) => Self::cube(scene, light, centre, texels),
            (Some(centre), _) => Self::local(scene, light, centre, texels),
        };
        let single = fit(scene);
        if projection != Projection::Guarded {
            return single;
        }
        let mut wider = scene.shadow_region;
        wider.width_world += 2.0 * single.largest_penumbra_world();
        fit(&Scene { shadow_region: wider, ..scene.clone() })
    }

    /// Radius of the largest kernel, in metres at the region's centre: the light's cone from there
    /// to the nearest geometry.
    fn largest_penumbra_world(&self) -> f32 {
        let gap = (self.eye_distance - self.nearest_blocker).max(0.0);
        match self.kind {
            LightKind::Sun => gap * self.light_size,
            LightKind::Local | LightKind::Cube => self.light_size * gap / self.nearest_blocker.max(1e-4),
        }
    }

    /// Radius of the light's cone from a receiver at depth `z` where it passes depth `b`, in map
    /// widths there: the twin of the `light` slot's `true_radius_uv`.
    pub(crate) fn true_radius_uv(&self, z: f32, b: f32) -> f32 {
        let gap = (z - b).max(0.0);
        match self.kind {
            LightKind::Sun => gap * self.light_size * self.scale,
            LightKind::Local | LightKind::Cube => self.light_size * gap / (z * b.max(1e-4)) * self.scale,
        }
    }

    /// Texels of one side of a cube's face; 0 for a single map. Six of half the single map's side
    /// take half as much memory again.
    pub fn face_texels(&self) -> u32 {
        if self.kind == LightKind::Cube { (self.texels / 2).max(1) } else { 0 }
    }

    /// Texels of the whole map: a cube's faces lie in a texture, three by two.
    pub fn size(&self) -> [u32; 2] {
        match self.face_texels() {
            0 => [self.texels; 2],
            face => [3 * face, 2 * face],
        }
    }

    fn sun(scene: &Scene, light: &AreaLight, texels: u32) -> Self {
        let ShadowRegion { centre, width_world, reference_gap_world } = scene.shadow_region;
        let towards = light.direction_from(centre);
        // The first document's demo sees the scene from one map width away; farther where
        // something stands higher, for nothing may be behind the light.
        let height = |p: Vec3| (p - centre).dot(towards);
        let heights = scene.geometry.positions.iter().map(|&p| height(p));
        let (low, high) = heights.fold((0f32, 0f32), |(lo, hi), h| (lo.min(h), hi.max(h)));
        let eye_distance = width_world.max(high * 1.01 + 0.01);
        let light_from_world = view_matrix(centre + towards * eye_distance, -towards);
        let far = eye_distance - low * 1.01 + 0.01;
        let half = 0.5 * width_world;
        let projection = glam::camera::rh::proj::directx::orthographic(-half, half, -half, half, 0.0, far);
        // What stands beside the map casts nothing into it and must not widen searches.
        let corners = over_square(&scene.geometry, light_from_world, half).flatten();
        let highest = corners.map(height).reduce(f32::max);
        let angular_radius = 0.5 * light.angular_diameter_radians().unwrap_or(0.0);
        Self {
            kind: LightKind::Sun,
            light_from_world,
            clip_from_world: projection * light_from_world,
            texels,
            scale: 1.0 / width_world,
            light_size: angular_radius.tan(),
            // Without any surface there is nothing to search.
            nearest_blocker: highest.map_or(far, |high| eye_distance - high),
            far,
            eye_distance,
            reference_gap: reference_gap_world,
        }
    }

    fn local(scene: &Scene, light: &AreaLight, eye: Vec3, texels: u32) -> Self {
        let ShadowRegion { centre, width_world, reference_gap_world } = scene.shadow_region;
        let axis = (centre - eye).normalize_or(Vec3::NEG_Y);
        let distance = (centre - eye).length().max(1e-3);
        let half_angle = (0.5 * width_world / distance).atan().min(MAX_HALF_ANGLE);
        let light_from_world = view_matrix(eye, axis);
        let near = 1e-3 * distance;
        let scale = 0.5 / half_angle.tan();
        let (nearest, farthest) = Pyramid::new(scale, near).depths(&scene.geometry, light_from_world);
        // Without any surface there is nothing to search.
        let nearest_blocker = nearest.unwrap_or(near);
        let far = farthest.max(near) * 1.01 + 0.01;
        let projection = glam::camera::rh::proj::directx::perspective(2.0 * half_angle, 1.0, near, far);
        Self {
            kind: LightKind::Local,
            light_from_world,
            clip_from_world: projection * light_from_world,
            texels,
            scale,
            light_size: light.radius_world().unwrap_or(0.0),
            nearest_blocker,
            far,
            eye_distance: distance,
            reference_gap: reference_gap_world,
        }
    }

    /// A map in every direction. Radii are tangents of angles seen from the light: `scale` is 1.
    fn cube(scene: &Scene, light: &AreaLight, eye: Vec3, texels: u32) -> Self {
        let ShadowRegion { centre, reference_gap_world, .. } = scene.shadow_region;
        let distance = (centre - eye).length().max(1e-3);
        let range = distances(&scene.geometry, eye);
        let far = range.1.max(distance) * 1.01 + 0.01;
        let light_from_world = Mat4::from_translation(-eye);
        let near = 1e-3 * distance;
        // A face's own projection; the raster pass turns the world before it.
        let projection = glam::camera::rh::proj::directx::perspective(FRAC_PI_2, 1.0, near, far);
        Self {
            kind: LightKind::Cube,
            light_from_world,
            clip_from_world: projection * light_from_world,
            texels,
            scale: 1.0,
            light_size: light.radius_world().unwrap_or(0.0),
            nearest_blocker: range.0.clamp(near, far),
            far,
            eye_distance: distance,
            reference_gap: reference_gap_world,
        }
    }

    /// Identifies the map's contents together with the geometry's own hash.
    pub(crate) fn key(&self) -> u64 {
        let floats = self.clip_from_world.to_cols_array();
        let seed = 0xcbf2_9ce4_8422_2325u64 ^ u64::from(self.texels) ^ (self.kind as u64) << 40;
        floats.iter().fold(seed, |hash, f| (hash ^ u64::from(f.to_bits())).wrapping_mul(0x0100_0000_01b3))
    }

    /// Width of a texel in metres at the region's centre.
    pub fn texel_world(&self) -> f32 {
        let width = match self.kind {
            LightKind::Sun => 1.0 / self.scale,
            LightKind::Local => self.eye_distance / self.scale,
            // A face spans the tangents from -1 to 1.
            LightKind::Cube => return 2.0 * self.eye_distance / self.face_texels() as f32,
        };
        width / self.texels as f32
    }
}

/// A view matrix that looks along `forward`.
fn view_matrix(eye: Vec3, forward: Vec3) -> Mat4 {
    let up = if forward.y.abs() > 0.99 { Vec3::NEG_Z } else { Vec3::Y };
    glam::camera::rh::view::look_to_mat4(eye, forward, up)
}
