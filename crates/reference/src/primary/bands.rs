//! The picture in bands, each a row of tiles.

use super::camera::CameraRays;
use super::finish::Row;
use super::tile::{NONE, Place, ROWS, Tile};
use super::{NOTHING, Seen};
use crate::Tracer;
use crate::scanlines::LANES;
use glam::Vec3;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

/// What is found, pixel by pixel, in rows.
pub(super) struct Hits<D, V, W> {
    pub(super) depth: D,
    pub(super) position: V,
    pub(super) normal: V,
    pub(super) triangle: W,
    pub(super) material: W,
}

type Whole = Hits<Vec<f32>, Vec<Vec3>, Vec<u32>>;
type Part<'a> = Hits<&'a mut [f32], &'a mut [Vec3], &'a mut [u32]>;

/// With more triangles than this per pixel of a picture, tiles look at more triangles than they have rays. Both ways
/// take as long at 8 (an atrium) to 13 (Crytek Sponza).
const CROWD: usize = 8;

/// All pixels of a picture of some size.
pub(super) fn fill(tracer: &Tracer, camera: &CameraRays, size: [u32; 2], hits: &mut Whole) {
    if hits.depth.is_empty() {
        return;
    }
    // A flat view has no depth, and no tiles.
    let crowded = tracer.surfaces.corners.len() / CROWD >= hits.depth.len();
    let together = !crowded && camera.depth.is_finite();
    let rows = if together { ROWS } else { 1 };
    let band = size[0] as usize * rows;
    let place = Place { surfaces: &tracer.surfaces, camera, size };
    let parts = (
        hits.depth.par_chunks_mut(band),
        hits.position.par_chunks_mut(band),
        hits.normal.par_chunks_mut(band),
        hits.triangle.par_chunks_mut(band),
        hits.material.par_chunks_mut(band),
    );
    parts.into_par_iter().enumerate().for_each_init(Vec::new, |open, (index, part)| {
        let (depth, position, normal, triangle, material) = part;
        let out = Hits { depth, position, normal, triangle, material };
        let mut band = Band { tracer, place, first: (index * rows) as u32, out, open };
        if together {
            Arch::new().dispatch(band);
        } else {
            for x in 0..size[0] {
                band.set([x, 0], tracer.seen(camera, x, band.first));
            }
        }
    });
}

struct Band<'a> {
    tracer: &'a Tracer,
    place: Place<'a>,
    /// Its first row.
    first: u32,
    out: Part<'a>,
    /// Nodes of the tree still to visit.
    open: &'a mut Vec<(u32, f32)>,
}

// Compiled for the widest registers that there are; the same bits with any.
impl WithSimd for Band<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _: S) {
        for x in (0..self.place.size[0]).step_by(LANES) {
            let mut tile = Tile::new(&self.place, [x, self.first]);
            tile.walk(self.place.surfaces, self.open);
            for row in 0..ROWS.min((self.place.size[1] - self.first) as usize) {
                self.row(&tile, x, row);
            }
        }
    }
}

impl Band<'_> {
    #[inline(always)]
    fn row(&mut self, tile: &Tile, x: u32, row: usize) {
        let found = Row::new(&self.place, tile, row);
        for k in 0..LANES.min((self.place.size[0] - x) as usize) {
            let at = [x + k as u32, row as u32];
            let slot = tile.slot[row][k];
            let seen = if !found.known[k] {
                self.tracer.seen(self.place.camera, at[0], self.first + at[1])
            } else if slot == NONE {
                NOTHING
            } else {
                let triangle = self.place.surfaces.triangle_of_slot[slot as usize];
                Seen {
                    depth: found.depth[k],
                    position: found.position[k],
                    normal: found.normal[k],
                    triangle,
                    material: self.tracer.material[triangle as usize],
                }
            };
            self.set(at, seen);
        }
    }

    #[inline(always)]
    fn set(&mut self, [x, row]: [u32; 2], seen: Seen) {
        let at = row as usize * self.place.size[0] as usize + x as usize;
        self.out.depth[at] = seen.depth;
        self.out.position[at] = seen.position;
        self.out.normal[at] = seen.normal;
        self.out.triangle[at] = seen.triangle;
        self.out.material[at] = seen.material;
    }
}
