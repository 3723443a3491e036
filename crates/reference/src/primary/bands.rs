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

/// All pixels of a picture of some size.
pub(super) fn fill(tracer: &Tracer, camera: &CameraRays, size: [u32; 2], hits: &mut Whole) {
    let band = size[0] as usize * ROWS;
    if size[0] == 0 {
        return;
    }
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
        Arch::new().dispatch(Band { tracer, place, first: (index * ROWS) as u32, out, open });
    });
}

/// Compiled for the widest registers that there are; the same bits with any.
struct Band<'a> {
    tracer: &'a Tracer,
    place: Place<'a>,
    /// Its first row.
    first: u32,
    out: Part<'a>,
    /// Nodes of the tree still to visit.
    open: &'a mut Vec<(u32, f32)>,
}

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
        let width = self.place.size[0];
        let found = Row::new(&self.place, tile, row);
        for k in 0..LANES.min((width - x) as usize) {
            let slot = tile.slot[row][k];
            let seen = if !found.known[k] {
                self.tracer.seen(self.place.camera, x + k as u32, self.first + row as u32)
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
            let at = row * width as usize + x as usize + k;
            self.out.depth[at] = seen.depth;
            self.out.position[at] = seen.position;
            self.out.normal[at] = seen.normal;
            self.out.triangle[at] = seen.triangle;
            self.out.material[at] = seen.material;
        }
    }
}
