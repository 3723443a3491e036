//! The points of a window in square tiles of the middle frame: the unit of projection and bootstrap.

use crate::regions::regions;
use crate::{MetricsError, PanelTruth, Projection, Region};
use rayon::prelude::*;
use umbrage_frame::Anchors;

/// Side of a tile in pixels unless told otherwise.
pub const TILE_PX: u32 = 32;

/// One square of the middle frame. Lists hold indices of panel points, ascending.
#[derive(Clone, Debug, PartialEq)]
pub struct Tile {
    /// Column, in tiles.
    pub column: u32,
    /// Row, in tiles.
    pub row: u32,
    /// Points in the penumbra; the cells are theirs.
    pub penumbra: Vec<u32>,
    /// Points in the umbra.
    pub umbra: Vec<u32>,
    /// Points in full light.
    pub lit: Vec<u32>,
    /// Over the penumbra points, in their order.
    pub projection: Projection,
}

impl Tile {
    /// Every counted point, penumbra first.
    pub fn points(&self) -> impl Iterator<Item = u32> {
        self.penumbra.iter().chain(&self.umbra).chain(&self.lit).copied()
    }
}

/// All tiles that hold a counted point, in row order.
#[derive(Clone, Debug, PartialEq)]
pub struct Tiling {
    /// Side of a tile in pixels.
    pub tile_px: u32,
    /// Size of the middle frame in pixels.
    pub size: [u32; 2],
    /// Pixel (index in row order) of each point.
    pub pixel: Vec<u32>,
    /// Region of each point.
    pub regions: Vec<Region>,
    /// Row by row.
    pub tiles: Vec<Tile>,
}

impl Tiling {
    /// Sorts the counted points into tiles and builds each tile's projection.
    ///
    /// Build it once per window, from the anchored truth, and use it for every variant and for both
    /// readings: paired differences need the same tiles.
    ///
    /// # Errors
    /// Inputs that are not about the same points, a truth that is not finite, a tile side of 0.
    pub fn new(
        anchors: &Anchors,
        truth: &PanelTruth,
        counted: &[bool],
        tile_px: u32,
    ) -> Result<Self, MetricsError> {
        if tile_px == 0 {
            return Err(MetricsError::Zero("the side of a tile"));
        }
        let regions = regions(anchors, truth, counted)?;
        let size = [anchors.view.width, anchors.view.height];
        let columns = size[0].div_ceil(tile_px);
        let mut members = vec![Vec::new(); (columns * size[1].div_ceil(tile_px)) as usize];
        for (point, &pixel) in anchors.pixel.iter().enumerate() {
            if regions[point] != Region::LeftOut {
                let (x, y) = (pixel % size[0], pixel / size[0]);
                members[(y / tile_px * columns + x / tile_px) as usize].push(point as u32);
            }
        }
        let mut tiling = Self { tile_px, size, pixel: anchors.pixel.clone(), regions, tiles: Vec::new() };
        tiling.tiles = members
            .into_par_iter()
            .enumerate()
            .filter(|(_, points)| !points.is_empty())
            .map(|(index, points)| {
                tiling.tile([index as u32 % columns, index as u32 / columns], &points, truth)
            })
            .collect();
        Ok(tiling)
    }

    fn tile(&self, [column, row]: [u32; 2], points: &[u32], truth: &PanelTruth) -> Tile {
        let of = |region: Region| -> Vec<u32> {
            points.iter().copied().filter(|&p| self.regions[p as usize] == region).collect()
        };
        let penumbra = of(Region::Penumbra);
        let g: Vec<f64> = penumbra.iter().map(|&p| f64::from(truth.basis[p as usize])).collect();
        let px: Vec<[f64; 2]> = penumbra.iter().map(|&p| self.place(p).map(f64::from)).collect();
        let projection = Projection::new(&g, &px);
        Tile { column, row, penumbra, umbra: of(Region::Umbra), lit: of(Region::Lit), projection }
    }

    /// Column and row of a point's pixel in the middle frame.
    pub fn place(&self, point: u32) -> [u32; 2] {
        let pixel = self.pixel[point as usize];
        [pixel % self.size[0], pixel / self.size[0]]
    }

    /// Number of points of the panel, counted or not.
    pub fn points(&self) -> usize {
        self.pixel.len()
    }
}
