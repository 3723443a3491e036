//! Closed shapes, counter-clockwise seen from outside, from which the generators build.

use crate::Material;
use crate::model::{Model, Object};
use glam::{DAffine3, DVec2, DVec3, Vec3};
use std::f64::consts::{PI, TAU};

/// Positions and triangles of one shape.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mesh {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

/// A material that was added to the model.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Paint(u32);

impl Model {
    pub(crate) fn paint(&mut self, name: &str, albedo: [f32; 3]) -> Paint {
        self.materials.push(Material::plain(name, Vec3::from(albedo)));
        Paint(self.materials.len() as u32 - 1)
    }

    pub(crate) fn add(&mut self, name: impl Into<String>, paint: Paint, mesh: Mesh) {
        self.objects.push(Object {
            name: name.into(),
            positions: mesh.positions,
            triangles: mesh.triangles,
            uvs: Vec::new(),
            material: paint.0,
        });
    }
}

impl Mesh {
    /// An upright box between two opposite corners.
    pub(crate) fn cuboid(lo: DVec3, hi: DVec3) -> Self {
        Self::turned_cuboid((lo + hi) * 0.5, (hi - lo) * 0.5, 0.0)
    }

    /// A box whose x axis is turned by `azimuth_radians` from x towards z.
    pub(crate) fn turned_cuboid(centre: DVec3, half: DVec3, azimuth_radians: f64) -> Self {
        let (sin, cos) = azimuth_radians.sin_cos();
        let corner = |k: usize| {
            let sign = |bit: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
            let at = half * DVec3::new(sign(0), sign(1), sign(2));
            centre + DVec3::new(at.x * cos - at.z * sin, at.y, at.x * sin + at.z * cos)
        };
        let mut mesh = Self { positions: (0..8).map(corner).collect(), triangles: Vec::new() };
        for quad in [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]] {
            mesh.quad(quad);
        }
        mesh
    }

    /// A cylinder with flat ends: a prism whose corners lie on the radius.
    pub(crate) fn cylinder(from: DVec3, to: DVec3, radius: f64, sides: u32) -> Self {
        let axis = (to - from).normalize();
        let (u, v) = axis.any_orthonormal_pair();
        let spoke = |k: u32| {
            let angle = TAU * f64::from(k) / f64::from(sides);
            (u * angle.cos() + v * angle.sin()) * radius
        };
        let mut mesh = Self { positions: vec![from, to], triangles: Vec::new() };
        mesh.positions.extend((0..sides).flat_map(|k| [from + spoke(k), to + spoke(k)]));
        for k in 0..sides {
            let (a, b) = (2 + 2 * k, 2 + 2 * ((k + 1) % sides));
            mesh.quad([a, b, b + 1, a + 1]);
            mesh.triangles.extend([[0, b, a], [1, a + 1, b + 1]]);
        }
        mesh
    }

    /// A wall along z between a lower and an upper outline, extruded from `x0` to `x1`. Each pair
    /// is (z, y) below and above; z does not decrease along the list, and consecutive points of an
    /// outline differ.
    pub(crate) fn wall_between(outlines: &[(DVec2, DVec2)], x0: f64, x1: f64) -> Self {
        let mut mesh = Self::default();
        for &(below, above) in outlines {
            let place = |p: DVec2, x: f64| DVec3::new(x, p.y, p.x);
            mesh.positions.extend([place(below, x0), place(below, x1), place(above, x0), place(above, x1)]);
        }
        let last = 4 * (outlines.len() as u32 - 1);
        for a in (0..last).step_by(4) {
            let b = a + 4;
            mesh.quad([b + 1, a + 1, a + 3, b + 3]);
            mesh.quad([a, b, b + 2, a + 2]);
            mesh.quad([a + 2, b + 2, b + 3, a + 3]);
            mesh.quad([a, a + 1, b + 1, b]);
        }
        mesh.quad([0, 2, 3, 1]);
        mesh.quad([last, last + 1, last + 3, last + 2]);
        mesh
    }

    /// An open sheet of `nu` x `nv` quads through `point(u, v)`, both parameters from 0 to 1.
    pub(crate) fn sheet(nu: u32, nv: u32, point: impl Fn(f64, f64) -> DVec3) -> Self {
        let mut mesh = Self::default();
        for i in 0..=nu {
            let u = f64::from(i) / f64::from(nu);
            mesh.positions.extend((0..=nv).map(|j| point(u, f64::from(j) / f64::from(nv))));
        }
        for (i, j) in (0..nu).flat_map(|i| (0..nv).map(move |j| (i, j))) {
            let a = i * (nv + 1) + j;
            mesh.quad([a, a + nv + 1, a + nv + 2, a + 1]);
        }
        mesh
    }

    /// A ramp that rises along x from the origin to `rise` at `run`, and ends there in a wall; as
    /// wide to both sides of z = 0.
    pub(crate) fn wedge(run: f64, rise: f64, half_width: f64) -> Self {
        let side = |z: f64| [DVec3::new(0.0, 0.0, z), DVec3::new(run, 0.0, z), DVec3::new(run, rise, z)];
        let positions = [side(-half_width), side(half_width)].concat();
        let mut mesh = Self { positions, triangles: vec![[0, 2, 1], [3, 4, 5]] };
        for quad in [[0, 1, 4, 3], [1, 2, 5, 4], [0, 3, 5, 2]] {
            mesh.quad(quad);
        }
        mesh
    }

    /// A ball whose corners lie on the radius, its poles above and below the centre.
    pub(crate) fn sphere(centre: DVec3, radius: f64, [rings, sectors]: [u32; 2]) -> Self {
        let pole = DVec3::Y * radius;
        let mut mesh = Self { positions: vec![centre - pole, centre + pole], triangles: Vec::new() };
        for (ring, k) in (1..rings).flat_map(|ring| (0..sectors).map(move |k| (ring, k))) {
            let (out, up) = (PI * f64::from(ring) / f64::from(rings)).sin_cos();
            let (z, x) = (TAU * f64::from(k) / f64::from(sectors)).sin_cos();
            mesh.positions.push(centre + DVec3::new(out * x, -up, out * z) * radius);
        }
        let at = |ring: u32, k: u32| 2 + (ring - 1) * sectors + k % sectors;
        for k in 0..sectors {
            mesh.triangles.push([0, at(1, k), at(1, k + 1)]);
            for ring in 1..rings - 1 {
                mesh.quad([at(ring, k), at(ring + 1, k), at(ring + 1, k + 1), at(ring, k + 1)]);
            }
            mesh.triangles.push([1, at(rings - 1, k + 1), at(rings - 1, k)]);
        }
        mesh
    }

    /// A ring that lies level: `ring_radius` to the middle of a tube of `tube_radius`.
    pub(crate) fn torus(
        centre: DVec3,
        [ring_radius, tube_radius]: [f64; 2],
        [round, across]: [u32; 2],
    ) -> Self {
        let mut mesh = Self::default();
        for (i, k) in (0..round).flat_map(|i| (0..across).map(move |k| (i, k))) {
            let (z, x) = (TAU * f64::from(i) / f64::from(round)).sin_cos();
            let (up, out) = (TAU * f64::from(k) / f64::from(across)).sin_cos();
            let from_axis = ring_radius + tube_radius * out;
            mesh.positions.push(centre + DVec3::new(from_axis * x, tube_radius * up, from_axis * z));
        }
        let at = |i: u32, k: u32| (i % round) * across + k % across;
        for (i, k) in (0..round).flat_map(|i| (0..across).map(move |k| (i, k))) {
            mesh.quad([at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)]);
        }
        mesh
    }

    /// Turned and moved; not mirrored, which would turn it inside out.
    pub(crate) fn placed(mut self, world_from_shape: DAffine3) -> Self {
        for position in &mut self.positions {
            *position = world_from_shape.transform_point3(*position);
        }
        self
    }

    fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.triangles.extend([[a, b, c], [a, c, d]]);
    }
}
