//! The rays through a view's pixel centres.

use crate::scanlines::LANES;
use crate::surfaces::Line;
use crate::wide::{Wide, Wide3};
use glam::{DMat4, DVec3, DVec4};
use umbrage_frame::View;

/// A view's rays, in f64.
pub(crate) struct CameraRays {
    pub(super) eye: DVec3,
    /// Direction of the top left corner, and of one pixel to the right and one down.
    pub(super) corner: DVec3,
    pub(super) right: DVec3,
    pub(super) down: DVec3,
    pub(super) forward: DVec3,
    /// A place's depth along this is how often it is as far as the end of [`Self::through`].
    pub(super) depth: DVec3,
    /// No direction of [`Self::through`] is longer.
    pub(super) longest: f64,
    clip_from_world: DMat4,
    /// The eye in clip space.
    clip_eye: DVec4,
}

/// Eight pixels of a row.
#[derive(Clone, Copy)]
pub(super) struct Lines {
    /// Unit length.
    pub(super) direction: Wide3,
    /// Of the direction before it was made one.
    pub(super) length: Wide,
    pub(super) near: Wide,
    pub(super) far: Wide,
}

impl CameraRays {
    pub(crate) fn new(view: &View) -> Self {
        let world_from_camera = view.camera_from_world.as_dmat4().inverse();
        let tan = (0.5 * f64::from(view.yfov_radians)).tan();
        let pixel = 2.0 * tan / f64::from(view.height.max(1));
        let (width, height) = (f64::from(view.width), f64::from(view.height));
        let corner = DVec3::new(-0.5 * width * pixel, 0.5 * height * pixel, -1.0);
        let eye = world_from_camera.w_axis.truncate();
        let clip_from_world = view.clip_from_world.as_dmat4();
        let corner = world_from_camera.transform_vector3(corner);
        let right = world_from_camera.transform_vector3(DVec3::X * pixel);
        let down = world_from_camera.transform_vector3(DVec3::NEG_Y * pixel);
        let depth = right.cross(down);
        Self {
            eye,
            corner,
            right,
            down,
            depth: depth / depth.dot(corner),
            longest: corner.length() + width * right.length() + height * down.length(),
            forward: world_from_camera.transform_vector3(DVec3::NEG_Z).normalize(),
            clip_from_world,
            clip_eye: clip_from_world * eye.extend(1.0),
        }
    }

    /// Through the centre of a pixel, from the near plane to the far plane.
    pub(crate) fn line(&self, x: u32, y: u32) -> Line {
        let through = self.through(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let direction = through.normalize();
        Line { origin: self.eye, direction, range: self.range(direction) }
    }

    /// Linear depth per distance along a direction.
    pub(super) fn cos(&self, direction: DVec3) -> f64 {
        self.forward.dot(direction)
    }

    /// Towards a place in the picture, in pixels; not of unit length.
    #[inline(always)]
    pub(super) fn through(&self, x: f64, y: f64) -> DVec3 {
        self.corner + self.right * x + self.down * y
    }

    /// Distances at which clip depth is 0 (z = 0) and 1 (z = w); both are linear along a ray.
    fn range(&self, direction: DVec3) -> [f64; 2] {
        let along = self.clip_from_world * direction.extend(0.0);
        range([self.clip_eye.z, along.z], [beyond(self.clip_eye), beyond(along)])
    }

    /// The lines of a pixel and of the seven to its right, bit by bit what [`Self::line`] finds.
    #[inline(always)]
    pub(super) fn lines(&self, x: u32, y: u32) -> Lines {
        let mut across = Wide::all(0.0);
        for k in 0..LANES {
            across.0[k] = f64::from(x + k as u32) + 0.5;
        }
        let through = Wide3::all(self.corner)
            + Wide3::all(self.right) * across
            + Wide3::all(self.down * (f64::from(y) + 0.5));
        let length = through.dot(through).sqrt();
        let direction = through * (Wide::all(1.0) / length);
        let (z, w) =
            (along(self.clip_from_world.row(2), direction), along(self.clip_from_world.row(3), direction));
        let (mut near, mut far) = (Wide::all(0.0), Wide::all(0.0));
        for k in 0..LANES {
            [near.0[k], far.0[k]] =
                range([self.clip_eye.z, z.0[k]], [beyond(self.clip_eye), w.0[k] - z.0[k]]);
        }
        Lines { direction, length, near, far }
    }
}

impl Lines {
    /// One of them.
    pub(super) fn line(&self, eye: DVec3, lane: usize) -> Line {
        let range = [self.near.0[lane], self.far.0[lane]];
        Line { origin: eye, direction: self.direction.lane(lane), range }
    }
}

/// A row of a matrix times directions.
#[inline(always)]
fn along(row: DVec4, directions: Wide3) -> Wide {
    directions.x * Wide::all(row.x)
        + directions.y * Wide::all(row.y)
        + directions.z * Wide::all(row.z)
        + Wide::all(row.w * 0.0)
}

/// Clip space's w - z: zero at the far plane.
#[inline(always)]
fn beyond(v: DVec4) -> f64 {
    v.w - v.z
}

/// From what stands at the eye and what a step along the ray adds, for the near and the far plane.
#[inline(always)]
fn range(near: [f64; 2], far: [f64; 2]) -> [f64; 2] {
    let (near, far) = (-near[0] / near[1], -far[0] / far[1]);
    // A matrix without a near or a far plane has no zero there.
    let near = if near.is_finite() { near.max(0.0) } else { 0.0 };
    let far = if far.is_finite() && far > near { far } else { f64::INFINITY };
    [near, far]
}
