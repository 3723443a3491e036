//! The direction of the true shadow's edge on its receiver, per tile.
//!
//! From differences of the true visibility between neighbouring pixels, in the plane of the surface:
//! the direction belongs to the world, not to the view. The classes' origin is the projection of the
//! world's x axis (z where the surface faces x).

use crate::{Region, Tiling};
use glam::Vec3;
use umbrage_frame::Anchors;

/// Classes of 22.5 degrees, centred on multiples of it; a direction and its opposite are one.
pub(crate) const CLASSES: usize = 8;

/// Below this coherence of its gradients (0 = all directions, 1 = one) a tile has no direction.
const COHERENT: f64 = 0.7;

/// Cosine above which two neighbouring anchors are taken to lie in one plane.
const SAME_PLANE: f32 = 0.99;

pub(crate) struct EdgeClasses {
    /// Class of each tile, from its own gradients or else those of the tiles around it.
    pub(crate) of_tile: Vec<Option<usize>>,
    /// Whether a tile or one around it has penumbra.
    pub(crate) near_penumbra: Vec<bool>,
}

/// Sums of squares of gradients: xx, yy, xy.
type Tensor = [f64; 3];

impl EdgeClasses {
    pub(crate) fn new(anchors: &Anchors, g: &[f32], tiling: &Tiling) -> Self {
        let slopes = Slopes::new(anchors, g, tiling);
        let columns = tiling.size[0].div_ceil(tiling.tile_px) as usize;
        let rows = tiling.size[1].div_ceil(tiling.tile_px) as usize;
        let mut tensors = vec![[0.0; 3]; columns * rows];
        let mut penumbra = vec![false; columns * rows];
        for tile in &tiling.tiles {
            let index = tile.row as usize * columns + tile.column as usize;
            penumbra[index] = !tile.penumbra.is_empty();
            for slope in tile.penumbra.iter().filter_map(|&p| slopes.at(p)) {
                add(&mut tensors[index], slope.gradient);
            }
        }
        let around = |tile: &crate::Tile| {
            let (column, row) = (tile.column as usize, tile.row as usize);
            let range = |at: usize, count: usize| at.saturating_sub(1)..=(at + 1).min(count - 1);
            range(row, rows).flat_map(move |r| range(column, columns).map(move |c| r * columns + c))
        };
        let own = |tile: &crate::Tile| tensors[tile.row as usize * columns + tile.column as usize];
        let class_of =
            |tile: &crate::Tile| class(own(tile)).or_else(|| class(sum(around(tile).map(|i| tensors[i]))));
        Self {
            of_tile: tiling.tiles.iter().map(class_of).collect(),
            near_penumbra: tiling.tiles.iter().map(|tile| around(tile).any(|i| penumbra[i])).collect(),
        }
    }
}

fn points_by_pixel(anchors: &Anchors) -> Vec<Option<u32>> {
    let mut point_at = vec![None; anchors.view.width as usize * anchors.view.height as usize];
    anchors
        .pixel
        .iter()
        .enumerate()
        .for_each(|(point, &pixel)| point_at[pixel as usize] = Some(point as u32));
    point_at
}

/// How the true visibility rises at a point of a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slope {
    /// Per metre, along two axes of the surface.
    pub(crate) gradient: [f64; 2],
    /// Its length, per metre.
    pub(crate) steepness: f64,
    /// The pixel's area on the surface, square metres.
    pub(crate) footprint: f64,
}

/// Slopes from the neighbours to the right and below.
pub(crate) struct Slopes<'a> {
    anchors: &'a Anchors,
    g: &'a [f32],
    tiling: &'a Tiling,
    point_at: Vec<Option<u32>>,
}

impl<'a> Slopes<'a> {
    pub(crate) fn new(anchors: &'a Anchors, g: &'a [f32], tiling: &'a Tiling) -> Self {
        Self { anchors, g, tiling, point_at: points_by_pixel(anchors) }
    }

    /// None beside another surface, or one that does not count.
    pub(crate) fn at(&self, point: u32) -> Option<Slope> {
        let [x, y] = self.tiling.place(point);
        let axes = tangents(self.anchors.normal[point as usize]);
        let (a, rise_a) = self.step(point, [x + 1, y], axes)?;
        let (b, rise_b) = self.step(point, [x, y + 1], axes)?;
        let determinant = a[0] * b[1] - a[1] * b[0];
        let gradient =
            [(rise_a * b[1] - rise_b * a[1]) / determinant, (rise_b * a[0] - rise_a * b[0]) / determinant];
        let steepness = gradient[0].hypot(gradient[1]);
        gradient.iter().all(|g| g.is_finite()).then_some(Slope {
            gradient,
            steepness,
            footprint: determinant.abs(),
        })
    }

    /// The way to a neighbour along the axes, and the rise.
    fn step(&self, point: u32, [x, y]: [u32; 2], axes: [Vec3; 2]) -> Option<([f64; 2], f64)> {
        let [width, height] = self.tiling.size;
        let n =
            (x < width && y < height).then(|| self.point_at[(y * width + x) as usize]).flatten()? as usize;
        let p = point as usize;
        let same = self.tiling.regions[n] != Region::LeftOut
            && self.anchors.normal[n].dot(self.anchors.normal[p]) > SAME_PLANE;
        let way = self.anchors.position[n] - self.anchors.position[p];
        let rise = f64::from(self.g[n]) - f64::from(self.g[p]);
        same.then(|| (axes.map(|axis| f64::from(axis.dot(way))), rise))
    }
}

/// Two axes of the plane with this normal.
fn tangents(normal: Vec3) -> [Vec3; 2] {
    let world = if normal.x.abs() < 0.9 { Vec3::X } else { Vec3::Z };
    let u = (world - normal * normal.dot(world)).normalize_or_zero();
    [u, normal.cross(u)]
}

fn add(tensor: &mut Tensor, [x, y]: [f64; 2]) {
    tensor.iter_mut().zip([x * x, y * y, x * y]).for_each(|(t, product)| *t += product);
}

fn sum(tensors: impl Iterator<Item = Tensor>) -> Tensor {
    tensors.fold([0.0; 3], |sum, t| [sum[0] + t[0], sum[1] + t[1], sum[2] + t[2]])
}

/// The class of the tensor's main direction, where it has one.
fn class([xx, yy, xy]: Tensor) -> Option<usize> {
    let strength = (xx - yy).hypot(2.0 * xy);
    if strength <= COHERENT * (xx + yy) || strength == 0.0 {
        return None;
    }
    let turns = 0.5 * (2.0 * xy).atan2(xx - yy) / std::f64::consts::PI;
    Some((turns * CLASSES as f64).round().rem_euclid(CLASSES as f64) as usize)
}
