//! Everything between a group of receivers and the light: one walk of the tree for all of them.

use super::blocks::Blocks;
use super::eight::{Eight, LANES};
use super::groups::Placed;
use crate::aim::Aim;
use crate::receiver::Receiver;
use crate::surfaces::Surfaces;
use glam::{DVec3, Vec3, Vec3A};
use obvhs::aabb::Aabb;
use umbrage_scene::AreaLight;

/// Rounding of the f32 arithmetic below, in ulps of the extent, as in `shafts::shaft`.
const ROUNDING: f64 = 16.0 / (1 << 24) as f64;

/// Half-spaces that hold the convex hull of the receivers and the light, and its bounding box.
pub(super) struct Volume {
    /// Normals turned inwards, without their signs, and heights of up to eight planes; the others hold all.
    normals: [Eight; 3],
    sizes: [Eight; 3],
    heights: Eight,
    planes: usize,
    low: Vec3A,
    high: Vec3A,
}

impl Volume {
    pub(super) fn new(light: &AreaLight, receivers: &[Placed], extent: f64) -> Self {
        let places = || receivers.iter().map(|r| r.receiver.position);
        let (low, high) =
            places().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let middle = Receiver { position: (low + high) * 0.5, ..receivers[0].receiver };
        let slack = ROUNDING * (extent + low.abs().max(high.abs()).max_element());
        let far = far_end(light);
        let none = [Eight::all(0.0); 3];
        let mut volume = Self {
            normals: none,
            sizes: none,
            heights: Eight::all(f32::NEG_INFINITY),
            planes: 0,
            low: Vec3A::ZERO,
            high: Vec3A::ZERO,
        };
        // Inside a sphere light there is no aim, and no candidate either way: keep everything.
        if let Some(aim) = Aim::new(light, &middle) {
            for normal in sides(&aim) {
                let lowest = places().map(|p| normal.dot(p)).fold(f64::INFINITY, f64::min);
                volume.plane(normal, lowest.min(far.lowest(normal)) - slack);
            }
        }
        let normal = receivers[0].receiver.normal;
        if normal != DVec3::ZERO && receivers.iter().all(|r| r.receiver.normal == normal) {
            let lowest = places().map(|p| normal.dot(p)).fold(f64::INFINITY, f64::min);
            volume.plane(normal, lowest - slack);
        }
        let [from, to] = far.bounds();
        volume.low = (low.min(from) - DVec3::splat(slack)).as_vec3a();
        volume.high = (high.max(to) + DVec3::splat(slack)).as_vec3a();
        volume
    }

    /// Lists the triangles that may hide a part of the light from any of the receivers; cut-out ones apart. Gives up,
    /// and says so, if there are more than `most`.
    #[inline(always)]
    pub(super) fn gather(
        &self,
        surfaces: &Surfaces,
        (open, blocks, cards): (&mut Vec<u32>, &mut Blocks, &mut Blocks),
        most: usize,
    ) -> bool {
        blocks.clear();
        cards.clear();
        open.clear();
        open.push(0);
        while let Some(index) = open.pop() {
            let node = &surfaces.bvh.nodes[index as usize];
            if !self.touches(node.aabb()) {
                continue;
            }
            let first = node.first_index;
            if !node.is_leaf() {
                open.extend([first, first + 1]);
                continue;
            }
            if LANES * (blocks.blocks.len() + cards.blocks.len()) > most {
                return false;
            }
            for slot in first..first + node.prim_count {
                let corners = surfaces.corners[slot as usize];
                if !self.misses(&corners) {
                    if surfaces.is_cut(slot) { &mut *cards } else { &mut *blocks }.push(slot, &corners);
                }
            }
        }
        cards.close();
        true
    }

    /// Lists those of a list.
    #[inline(always)]
    pub(super) fn filter(&self, from: &Blocks, into: &mut Blocks) {
        into.clear();
        for block in &from.blocks {
            let mut some = Eight::all(0.0).below(Eight::all(1.0));
            for plane in 0..self.planes {
                let n = [0, 1, 2].map(|axis| Eight::all(self.normals[axis].0[plane]));
                let [a, b, c] = block.corners();
                let highest = dot(&n, a).max(dot(&n, b)).max(dot(&n, c));
                some = some.and(highest.below(Eight::all(self.heights.0[plane])).not());
            }
            into.push_some(block, block.used() & some.bits());
        }
    }

    fn plane(&mut self, normal: DVec3, height: f64) {
        let normal = normal.as_vec3().to_array();
        for axis in 0..3 {
            self.normals[axis].0[self.planes] = normal[axis];
            self.sizes[axis].0[self.planes] = normal[axis].abs();
        }
        self.heights.0[self.planes] = height as f32;
        self.planes += 1;
    }

    #[inline(always)]
    fn touches(&self, bounds: &Aabb) -> bool {
        if (bounds.min.cmpgt(self.high) | bounds.max.cmplt(self.low)).any() {
            return false;
        }
        let centre = ((bounds.min + bounds.max) * 0.5).to_array();
        let half = ((bounds.max - bounds.min) * 0.5).to_array();
        let highest = self.along(&self.normals, centre) + self.along(&self.sizes, half);
        highest.below(self.heights).bits() == 0
    }

    #[inline(always)]
    fn misses(&self, corners: &[Vec3; 3]) -> bool {
        let [a, b, c] = corners;
        let highest = self.along(&self.normals, a.to_array());
        let highest = highest.max(self.along(&self.normals, b.to_array()));
        let highest = highest.max(self.along(&self.normals, c.to_array()));
        highest.below(self.heights).bits() != 0
    }

    #[inline(always)]
    fn along(&self, normals: &[Eight; 3], place: [f32; 3]) -> Eight {
        normals[0] * Eight::all(place[0])
            + normals[1] * Eight::all(place[1])
            + normals[2] * Eight::all(place[2])
    }
}

#[inline(always)]
fn dot(n: &[Eight; 3], v: &[Eight; 3]) -> Eight {
    n[0] * v[0] + n[1] * v[1] + n[2] * v[2]
}

/// The planes through the receiver that hold the light's outline, turned inwards.
pub(crate) fn sides(aim: &Aim) -> impl Iterator<Item = DVec3> {
    let (axis, u, v) = (aim.axis, aim.u, aim.v);
    [(axis + u, v), (axis - u, v), (axis + v, u), (axis - v, u)].into_iter().filter_map(move |(at, along)| {
        let normal = at.cross(along).normalize_or_zero();
        let height = normal.dot(axis);
        (height.abs() > 1e-9 * axis.length()).then(|| normal * height.signum())
    })
}

/// The box that a light ends in: infinite towards a sun.
pub(crate) fn bounds(light: &AreaLight) -> [DVec3; 2] {
    far_end(light).bounds()
}

/// What the volume ends at.
enum FarEnd {
    /// Directions: the axis and how far they reach to either side.
    Sun {
        axis: DVec3,
        reach: DVec3,
    },
    Corners([DVec3; 4]),
    Ball {
        centre: DVec3,
        radius: f64,
    },
}

fn far_end(light: &AreaLight) -> FarEnd {
    let origin = Receiver::in_air(DVec3::ZERO);
    match *light {
        AreaLight::Sphere { centre, radius_world } => {
            FarEnd::Ball { centre: centre.as_dvec3(), radius: f64::from(radius_world) }
        }
        _ => match Aim::new(light, &origin) {
            Some(aim) if matches!(light, AreaLight::Sun { .. }) => {
                let reach = DVec3::from_array([0, 1, 2].map(|i| aim.reach(aim.u[i], aim.v[i])));
                FarEnd::Sun { axis: aim.axis, reach: reach + DVec3::splat(1e-9) }
            }
            Some(Aim { axis, u, v, .. }) => {
                FarEnd::Corners([axis + u + v, axis + u - v, axis - u + v, axis - u - v])
            }
            None => FarEnd::Ball { centre: DVec3::ZERO, radius: f64::INFINITY },
        },
    }
}

impl FarEnd {
    fn lowest(&self, normal: DVec3) -> f64 {
        match self {
            // The sides of a sun are the same from everywhere: nothing of it is below them.
            Self::Sun { .. } => f64::INFINITY,
            Self::Corners(corners) => corners.iter().map(|c| normal.dot(*c)).fold(f64::INFINITY, f64::min),
            Self::Ball { centre, radius } => normal.dot(*centre) - radius,
        }
    }

    fn bounds(&self) -> [DVec3; 2] {
        match self {
            Self::Sun { axis, reach } => {
                let end = |c: f64, sign: f64| {
                    if sign * c > 0.0 { sign * f64::INFINITY } else { -sign * f64::INFINITY }
                };
                [(*axis - *reach).map(|c| end(c, -1.0)), (*axis + *reach).map(|c| end(c, 1.0))]
            }
            Self::Corners(corners) => {
                let fold =
                    |f: fn(DVec3, DVec3) -> DVec3| corners[1..].iter().fold(corners[0], |m, &c| f(m, c));
                [fold(DVec3::min), fold(DVec3::max)]
            }
            Self::Ball { centre, radius } => [*centre - *radius, *centre + *radius],
        }
    }
}
