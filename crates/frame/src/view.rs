//! From where a frame was seen.

use glam::{Mat4, Vec2, Vec3};

/// A pinhole view in glTF's conventions: right-handed, y up, the camera looks along its -z;
/// clip depth 0 (near) to 1 (far); pixel row 0 at the top, pixel centres at +0.5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// World to clip space (before the division by w).
    pub clip_from_world: Mat4,
    /// World to camera space; linear depth is `-z` there.
    pub camera_from_world: Mat4,
    /// Vertical field of view.
    pub yfov_radians: f32,
}

impl View {
    /// The eye in world space.
    pub fn eye(&self) -> Vec3 {
        self.camera_from_world.inverse().w_axis.truncate()
    }

    /// Where a world point lands, in pixels (a pixel's centre is at +0.5); `None` behind the
    /// camera or outside the picture.
    pub fn project(&self, point: Vec3) -> Option<Vec2> {
        let clip = self.clip_from_world * point.extend(1.0);
        if clip.w <= 0.0 {
            return None;
        }
        let size = Vec2::new(self.width as f32, self.height as f32);
        let ndc = clip.truncate().truncate() / clip.w;
        let px = (ndc * Vec2::new(0.5, -0.5) + 0.5) * size;
        let inside = px.x >= 0.0 && px.y >= 0.0 && px.x < size.x && px.y < size.y;
        inside.then_some(px)
    }

    /// The unit direction from the eye through a place in the picture, in pixels.
    pub fn direction(&self, px: Vec2) -> Vec3 {
        let size = Vec2::new(self.width as f32, self.height as f32);
        let tan = (0.5 * self.yfov_radians).tan();
        let ndc = (px / size - 0.5) * Vec2::new(2.0, -2.0);
        let camera = Vec3::new(ndc.x * tan * size.x / size.y, ndc.y * tan, -1.0);
        self.camera_from_world.inverse().transform_vector3(camera).normalize()
    }

    /// Linear depth (metres along the viewing direction) of a world point.
    pub fn depth(&self, point: Vec3) -> f32 {
        -self.camera_from_world.transform_point3(point).z
    }
}
