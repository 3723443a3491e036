//! Camera rays: what is seen through the pixel centres.

mod bands;
mod camera;
mod finish;
mod frustum;
mod sheet;
mod tile;

use crate::{Tracer, surfaces::Hit};
use bands::Hits;
pub(crate) use camera::CameraRays;
use glam::{DVec3, Vec3};
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
        let pixels = view.width as usize * view.height as usize;
        let mut hits = Hits {
            depth: vec![0.0; pixels],
            position: bytemuck::zeroed_vec(pixels),
            normal: bytemuck::zeroed_vec(pixels),
            triangle: vec![0; pixels],
            material: vec![0; pixels],
        };
        bands::fill(self, &camera, [view.width, view.height], &mut hits);
        let (width, height) = (view.width, view.height);
        PrimaryHits {
            gbuffer: Gbuffer {
                view: *view,
                depth: Image::from_pixels(width, height, hits.depth),
                position: Image::from_pixels(width, height, hits.position),
                normal: Image::from_pixels(width, height, hits.normal),
            },
            triangle: Image::from_pixels(width, height, hits.triangle),
            material: Image::from_pixels(width, height, hits.material),
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

    /// Through one pixel: what the tiles must equal.
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
