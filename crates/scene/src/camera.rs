//! Cameras, and the paths along which they (or the light) move.

use crate::AreaLight;
use glam::{Mat4, Vec3};

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Camera to world: a rotation and a translation. The camera looks along its -z, y is up.
    pub world_from_camera: Mat4,
    /// Vertical field of view.
    pub yfov_radians: f32,
    /// Nearest visible distance along the viewing direction, metres.
    pub near_world: f32,
    /// Farthest visible distance along the viewing direction, metres.
    pub far_world: f32,
}

/// What is different from frame to frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathFrame {
    /// From where the frame is seen.
    pub camera: Camera,
    /// The light (the same in each frame unless the path moves it).
    pub light: AreaLight,
    /// Since the start of the path.
    pub time_secs: f32,
}

/// A named run of frames.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraPath {
    /// "P1", or the user's name for it.
    pub name: String,
    /// One line for people: "dolly, 2 m/s towards the target".
    pub title: String,
    /// Frames per second.
    pub frames_per_second: f32,
    /// Every frame, in order; never empty.
    pub frames: Vec<PathFrame>,
}

impl Camera {
    /// A camera at `eye` that looks at `target` with y up (with -z up when it looks straight
    /// along y).
    pub fn look_at(eye: Vec3, target: Vec3, yfov_radians: f32, near_world: f32, far_world: f32) -> Self {
        let back = (eye - target).normalize_or(Vec3::Z);
        let up = if back.y.abs() > 0.9999 { Vec3::NEG_Z } else { Vec3::Y };
        let right = up.cross(back).normalize();
        let up = back.cross(right);
        let world_from_camera =
            Mat4::from_cols(right.extend(0.0), up.extend(0.0), back.extend(0.0), eye.extend(1.0));
        Self { world_from_camera, yfov_radians, near_world, far_world }
    }

    /// World to camera space.
    pub fn camera_from_world(&self) -> Mat4 {
        self.world_from_camera.inverse()
    }

    /// Camera to clip space, depth 0 (near) to 1 (far), for a picture of this width over height.
    pub fn clip_from_camera(&self, aspect: f32) -> Mat4 {
        glam::camera::rh::proj::directx::perspective(
            self.yfov_radians,
            aspect,
            self.near_world,
            self.far_world,
        )
    }

    /// The eye in world space.
    pub fn eye(&self) -> Vec3 {
        self.world_from_camera.w_axis.truncate()
    }
}

impl CameraPath {
    /// Whether the light differs between frames.
    pub fn light_moves(&self) -> bool {
        self.frames.windows(2).any(|pair| pair[0].light != pair[1].light)
    }
}
