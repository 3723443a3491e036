//! Camera rays: what is seen through the pixel centres.

use crate::{Tracer, surfaces::Hit, surfaces::Line};
use glam::{DMat4, DVec3, DVec4, Vec3};
use rayon::prelude::*;
use umbrage_frame::{Gbuffer, Image, View};

/// What the camera rays through the pixel centres hit first.
#[derive(Clone, Debug)]
pub struct PrimaryHits {
    /// Depth, position and normal.
    pub gbuffer: Gbuffer,
    /// Triangle of the scene; `u32::MAX` where nothing is hit.
    pub triangle: Image<u32>,
    /// Material of the scene; `u32::MAX` where nothing is hit.
    pub material: Image<u32>,
}

/// Surface points to find the truth at. All three lists are of one length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    /// World position in metres.
    pub position: Vec<Vec3>,
    /// Unit geometric normal on the viewer's side: what is below its plane is hidden. Zero for a
    /// point in mid-air, which has no horizon.
    pub normal: Vec<Vec3>,
    /// The triangle of the scene that each point lies on; `u32::MAX` for a point in mid-air.
    pub triangle: Vec<u32>,
}

/// One pixel.
#[derive(Clone, Copy)]
struct Seen {
    depth: f32,
    position: Vec3,
    normal: Vec3,
    triangle: u32,
    material: u32,
}

const NOTHING: Seen = Seen {
    depth: f32::INFINITY,
    position: Vec3::ZERO,
    normal: Vec3::ZERO,
    triangle: u32::MAX,
    material: u32::MAX,
};

impl Tracer {
    /// The closest hits through the pixel centres, between the view's near and far planes.
    pub fn primary(&self, view: &View) -> PrimaryHits {
        let camera = CameraRays::new(view);
        let rows: Vec<Vec<Seen>> = (0..view.height)
            .into_par_iter()
            .map(|y| (0..view.width).map(|x| self.seen(&camera, x, y)).collect())
            .collect();
        let seen: Vec<Seen> = rows.into_iter().flatten().collect();
        PrimaryHits {
            gbuffer: Gbuffer {
                view: *view,
                depth: image(view, &seen, |s| s.depth),
                position: image(view, &seen, |s| s.position),
                normal: image(view, &seen, |s| s.normal),
            },
            triangle: image(view, &seen, |s| s.triangle),
            material: image(view, &seen, |s| s.material),
        }
    }

    /// The same through some of the pixel centres (indices in row order): linear depth of each, infinite where
    /// nothing is hit, and the points of those that hit.
    pub fn primary_some(&self, view: &View, pixels: &[u32]) -> (Vec<f32>, Points) {
        let camera = CameraRays::new(view);
        let at = |&pixel: &u32| self.seen(&camera, pixel % view.width, pixel / view.width);
        let seen: Vec<Seen> = pixels.par_iter().map(at).collect();
        let hits = || seen.iter().filter(|s| s.depth.is_finite());
        let points = Points {
            position: hits().map(|s| s.position).collect(),
            normal: hits().map(|s| s.normal).collect(),
            triangle: hits().map(|s| s.triangle).collect(),
        };
        (seen.iter().map(|s| s.depth).collect(), points)
    }

    fn seen(&self, camera: &CameraRays, x: u32, y: u32) -> Seen {
        let line = camera.line(x, y);
        let Some(hit) = self.surfaces.closest(&line, |_, _| false) else { return NOTHING };
        let position = (line.origin + line.direction * hit.distance).as_vec3();
        let triangle = self.surfaces.triangle_of_slot[hit.slot as usize];
        Seen {
            depth: (hit.distance * camera.cos(line.direction)) as f32,
            position,
            normal: self.normal_towards(&hit, line.direction).as_vec3(),
            triangle,
            material: self.material[triangle as usize],
        }
    }

    /// The geometric normal on the side that a ray comes from.
    pub(crate) fn normal_towards(&self, hit: &Hit, direction: DVec3) -> DVec3 {
        let [a, b, c] = self.surfaces.corners_f64(hit.slot);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        if normal.dot(direction) > 0.0 { -normal } else { normal }
    }
}

impl PrimaryHits {
    /// The pixels that hit a surface, in row order: aligned with `umbrage_frame::Anchors::of`.
    pub fn points(&self) -> Points {
        let hits: Vec<usize> =
            (0..self.triangle.pixels().len()).filter(|&p| self.gbuffer.is_hit(p)).collect();
        Points {
            position: hits.iter().map(|&p| self.gbuffer.position.pixels()[p]).collect(),
            normal: hits.iter().map(|&p| self.gbuffer.normal.pixels()[p]).collect(),
            triangle: hits.iter().map(|&p| self.triangle.pixels()[p]).collect(),
        }
    }
}

impl Points {
    /// How many.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    pub(crate) fn check(&self) {
        assert_eq!(self.position.len(), self.normal.len(), "a normal for each point");
        assert_eq!(self.position.len(), self.triangle.len(), "a triangle for each point");
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }
}

fn image<T>(view: &View, seen: &[Seen], pick: impl Fn(&Seen) -> T) -> Image<T> {
    Image::from_pixels(view.width, view.height, seen.iter().map(pick).collect())
}

/// A view's rays, in f64.
pub(crate) struct CameraRays {
    eye: DVec3,
    /// Direction of the top left corner, and of one pixel to the right and one down.
    corner: DVec3,
    right: DVec3,
    down: DVec3,
    forward: DVec3,
    clip_from_world: DMat4,
}

impl CameraRays {
    pub(crate) fn new(view: &View) -> Self {
        let world_from_camera = view.camera_from_world.as_dmat4().inverse();
        let tan = (0.5 * f64::from(view.yfov_radians)).tan();
        let pixel = 2.0 * tan / f64::from(view.height.max(1));
        let (width, height) = (f64::from(view.width), f64::from(view.height));
        let corner = DVec3::new(-0.5 * width * pixel, 0.5 * height * pixel, -1.0);
        Self {
            eye: world_from_camera.w_axis.truncate(),
            corner: world_from_camera.transform_vector3(corner),
            right: world_from_camera.transform_vector3(DVec3::X * pixel),
            down: world_from_camera.transform_vector3(DVec3::NEG_Y * pixel),
            forward: world_from_camera.transform_vector3(DVec3::NEG_Z).normalize(),
            clip_from_world: view.clip_from_world.as_dmat4(),
        }
    }

    /// Through the centre of a pixel, from the near plane to the far plane.
    pub(crate) fn line(&self, x: u32, y: u32) -> Line {
        let through = self.corner + self.right * (f64::from(x) + 0.5) + self.down * (f64::from(y) + 0.5);
        let direction = through.normalize();
        Line { origin: self.eye, direction, range: self.range(direction) }
    }

    /// Linear depth per distance along a direction.
    fn cos(&self, direction: DVec3) -> f64 {
        self.forward.dot(direction)
    }

    /// Distances at which clip depth is 0 (z = 0) and 1 (z = w); both are linear along a ray.
    fn range(&self, direction: DVec3) -> [f64; 2] {
        let at_eye = self.clip_from_world * self.eye.extend(1.0);
        let along = self.clip_from_world * direction.extend(0.0);
        let zero = |at: f64, along: f64| -at / along;
        let beyond = |v: DVec4| v.w - v.z;
        let near = zero(at_eye.z, along.z);
        let far = zero(beyond(at_eye), beyond(along));
        // A matrix without a near or a far plane has no zero there.
        let near = if near.is_finite() { near.max(0.0) } else { 0.0 };
        let far = if far.is_finite() && far > near { far } else { f64::INFINITY };
        [near, far]
    }
}
