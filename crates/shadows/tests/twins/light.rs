//! Twin of the shadow map's projection, of the three kinds of bias, and of the penumbra laws.

use super::approx::{Approx, Approx3, sum};
use super::pyramid::nearest;
use glam::Vec3;
use umbrage_scene::{AreaLight, Scene};
use umbrage_shadows::{Bias, Calibration, ConstantBias, ReceiverPlane};

/// How the light sees the world: x right, y up, z towards the light, in metres from its eye.
pub(crate) struct Light {
    axes: [Approx3; 3],
    eye: Approx3,
    pub(crate) is_sun: bool,
    /// Map widths per metre (sun) or per unit of slope.
    pub(crate) scale: Approx,
    /// Tangent of a sun's angular radius, or the radius in metres.
    pub(crate) size: Approx,
    /// Depth of the nearest geometry.
    pub(crate) nearest: Approx,
    /// Depth of the shadow region's centre.
    pub(crate) eye_distance: Approx,
    pub(crate) reference_gap: Approx,
    /// Depth of the far plane, a hundredth and a centimetre beyond all geometry.
    pub(crate) far: f64,
    pub(crate) texels: u32,
}

/// A receiver in the map: place (0 to 1, row 0 at the top), depth, and how its plane leans: change
/// of depth (sun) or of 1/depth (local light) per map width.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) uv: [Approx; 2],
    pub(crate) depth: Approx,
    pub(crate) slope: [Approx; 2],
}

const ONE: Approx = Approx::exact(1.0);
const HALF: Approx = Approx::exact(0.5);

impl Light {
    pub(crate) fn new(scene: &Scene, light: &AreaLight, texels: u32) -> Self {
        let region = scene.shadow_region;
        let centre = Approx3::from_vec(region.centre);
        let width = Approx::from(region.width_world);
        let reference_gap = Approx::from(region.reference_gap_world);
        if let AreaLight::Sun { direction_to_light, angular_diameter_radians } = *light {
            let towards = Approx3::from_vec(direction_to_light);
            let height = |&p: &Vec3| Approx3::from_vec(p).minus(centre).dot(towards);
            let highest = scene.geometry.positions.iter().map(height).fold(Approx::exact(0.0), Approx::max);
            // One map width away, or a little above everything.
            let clear = highest * Approx::constant(1.01) + Approx::constant(0.01);
            let eye_distance = width.max(clear);
            let axes = axes(towards);
            let overlaps = |corners: &[Approx3; 3]| {
                axes[..2].iter().all(|&axis| {
                    let place = corners.map(|p| p.minus(centre).dot(axis).value);
                    let half = 0.5 * width.value;
                    place.iter().any(|&x| x <= half) && place.iter().any(|&x| x >= -half)
                })
            };
            // Of the triangles whose bounding rectangles overlap the map.
            let triangles = (0..scene.geometry.triangles.len()).map(|t| scene.geometry.corners(t));
            let seen = triangles.map(|corners| corners.map(Approx3::from_vec)).filter(overlaps);
            let heights = seen.flatten().map(|p| p.minus(centre).dot(towards));
            let highest_seen = heights.reduce(Approx::max).expect("the map sees something");
            let lowest = scene.geometry.positions.iter().map(height).fold(Approx::exact(0.0), Approx::min);
            let tangent = f64::from(0.5 * angular_diameter_radians).tan();
            Self {
                axes,
                eye: centre.plus(towards.times(eye_distance)),
                is_sun: true,
                scale: ONE / width,
                size: Approx::library(tangent),
                nearest: eye_distance - highest_seen,
                eye_distance,
                reference_gap,
                far: eye_distance.value - lowest.value * 1.01 + 0.01,
                texels,
            }
        } else {
            let eye = Approx3::from_vec(light.centre().expect("a local light has a place"));
            let back = eye.minus(centre);
            let eye_distance = back.length();
            // The map just covers the region's width at its centre.
            let mut local = Self {
                axes: axes(back.normalized_on_cpu()),
                eye,
                is_sun: false,
                // Half over the tangent of half the map's angle, the way back from an arc tangent.
                scale: (eye_distance / width) * Approx::library(1.0),
                size: Approx::from(light.radius_world().expect("and a radius")),
                nearest: ONE,
                eye_distance,
                reference_gap,
                far: 0.0,
                texels,
            };
            let steepest = f64::from(region.width_world) / (2.0 * eye_distance.value);
            assert!(steepest < 60f64.to_radians().tan(), "tests stay below the widest map");
            let corners = |t| scene.geometry.corners(t).map(|p| local.coordinates(Approx3::from_vec(p)));
            let triangles: Vec<_> = (0..scene.geometry.triangles.len()).map(corners).collect();
            local.nearest = nearest(&triangles, local.scale);
            let depths = triangles.iter().flatten().map(|p| -p.0[2].value);
            local.far = depths.fold(0.0, f64::max) * 1.01 + 0.01;
            local
        }
    }

    /// Of a map with a guard band: wider by the largest kernel on each side, the cone from the region's
    /// centre to the nearest geometry.
    pub(crate) fn guarded(scene: &Scene, light: &AreaLight, texels: u32) -> Self {
        let single = Self::new(scene, light, texels);
        let width = if single.is_sun { ONE } else { single.eye_distance };
        let radius = single.cone(single.eye_distance, single.nearest) / single.scale * width;
        let mut wider = scene.clone();
        wider.shadow_region.width_world += 2.0 * radius.value as f32;
        Self::new(&wider, light, texels)
    }

    /// Light-space coordinates of a world point.
    pub(crate) fn coordinates(&self, p: Approx3) -> Approx3 {
        Approx3(self.axes.map(|axis| {
            let products: [Approx; 3] = std::array::from_fn(|k| axis.0[k] * p.0[k]);
            sum(&[products[0], products[1], products[2], -axis.dot(self.eye)])
        }))
    }

    fn turned(&self, direction: Approx3) -> [Approx; 3] {
        self.axes.map(|axis| axis.dot(direction))
    }

    /// Width of a texel at a depth, metres.
    fn texel_world(&self, depth: Approx) -> Approx {
        let width = if self.is_sun { ONE } else { depth };
        width / (self.scale * Approx::exact(self.texels.into()))
    }

    /// A receiver moved by the normal offset, in the map; `None` behind a local light.
    pub(crate) fn point(&self, (position, normal): (Approx3, Approx3), bias: &Bias) -> Option<Point> {
        let [nx, ny, nz] = self.turned(normal);
        let centre = self.coordinates(position);
        // Sine of the angle between the normal and the direction to the light.
        let sine = if self.is_sun {
            (nx * nx + ny * ny).sqrt()
        } else {
            let cosine = Approx3([nx, ny, nz]).dot(centre.normalized());
            (ONE - cosine * cosine).max(Approx::exact(0.0)).sqrt()
        };
        let texel_world = self.texel_world((-centre.0[2]).max(Approx::constant(1e-6)));
        let texels = Approx::constant(bias.normal_offset_texels);
        let moved = position.plus(normal.times(texels * texel_world * sine));
        let p = self.coordinates(moved);
        let ([x, y, z], flat) = (p.0, (nx * nx + ny * ny).sqrt());
        let depth = -z;
        if !self.is_sun && depth.value <= 0.0 {
            return None;
        }
        let across = if self.is_sun { ONE } else { depth };
        let uv = [x / across * self.scale + HALF, -y / across * self.scale + HALF];
        // No plane is followed beyond its cap: as if it were turned back to that slope.
        let max_slope = match bias.receiver_plane {
            ReceiverPlane::On { max_slope } => Approx::constant(max_slope),
            ReceiverPlane::Off => return Some(Point { uv, depth, slope: [Approx::exact(0.0); 2] }),
        };
        let towards = if self.is_sun { nz } else { -Approx3([nx, ny, nz]).dot(p) };
        let divisor = towards.max(across * flat / max_slope) * self.scale;
        // u grows with x, v against y; 1/depth falls where depth rises.
        let (right, down) = if self.is_sun { (nx, -ny) } else { (-nx, ny) };
        Some(Point { uv, depth, slope: [right / divisor, down / divisor] })
    }

    /// The depth that a texel is compared with: that of the receiver, or of its plane at the
    /// texel's centre (`centre` in map widths), less the constant.
    pub(crate) fn reference(&self, point: &Point, centre: [Approx; 2], bias: &Bias) -> Approx {
        let constant = match bias.constant {
            ConstantBias::World(metres) => Approx::constant(metres),
            ConstantBias::PerDistance(fraction) => Approx::constant(fraction) * self.eye_distance,
        };
        let step = |k: usize| point.slope[k] * (centre[k] - point.uv[k]);
        let depth = match (bias.receiver_plane, self.is_sun) {
            (ReceiverPlane::Off, _) => point.depth,
            (_, true) => sum(&[point.depth, step(0), step(1)]),
            (_, false) => {
                let inverse = sum(&[ONE / point.depth, step(0), step(1)]);
                ONE / inverse.max(Approx::constant(1e-6))
            }
        };
        depth - constant
    }

    /// Radius of the light's cone from a receiver at depth `z` where it passes depth `b`, in map
    /// widths there: gap tan(angle / 2) under a sun; R (z - b) / z under a light of radius R.
    pub(crate) fn cone(&self, z: Approx, b: Approx) -> Approx {
        let gap = (z - b).max(Approx::exact(0.0));
        if self.is_sun {
            gap * self.size * self.scale
        } else {
            self.size * gap / z / b.max(Approx::constant(1e-4)) * self.scale
        }
    }
}

/// Radii in map widths: how far blockers are sought, how wide a kernel is for a blocker, and how
/// wide one is that knows no blocker.
pub(crate) struct Law<'a> {
    pub(crate) light: &'a Light,
    pub(crate) calibration: Calibration,
}

/// The demo's largest kernel radius (TECHNIQUES section 2: 0.002 map widths).
const PRINTED_RADIUS: f64 = 0.002;

impl Law<'_> {
    pub(crate) fn search(&self, z: Approx) -> Approx {
        match self.calibration {
            Calibration::AsPrinted => Approx::constant(PRINTED_RADIUS),
            Calibration::LightMatched => self.light.cone(z, self.light.nearest),
        }
    }

    /// As printed: listing 4, saturate(80 ((z - b) / b)^2) of the largest radius.
    pub(crate) fn kernel(&self, z: Approx, b: Approx) -> Approx {
        match self.calibration {
            Calibration::AsPrinted => {
                let ratio = (z - b) / b;
                let share = Approx::exact(80.0) * ratio * ratio;
                Approx::constant(PRINTED_RADIUS) * share.min(ONE)
            }
            Calibration::LightMatched => self.light.cone(z, b),
        }
    }

    pub(crate) fn fixed(&self, z: Approx) -> Approx {
        match self.calibration {
            Calibration::AsPrinted => Approx::constant(PRINTED_RADIUS),
            Calibration::LightMatched => {
                self.light.cone(z, (z - self.light.reference_gap).max(self.light.nearest))
            }
        }
    }

    /// Half-width, in texels of the map reduced by 4, of the region whose minimum stands for the
    /// blocker (first document, 2.3: "region of max penumbra size"): the demo's 2, or the cone
    /// from the region's centre to the nearest geometry.
    pub(crate) fn region(&self) -> u32 {
        let radius = match self.calibration {
            Calibration::AsPrinted => Approx::constant(PRINTED_RADIUS),
            Calibration::LightMatched => self.light.cone(self.light.eye_distance, self.light.nearest),
        };
        let reduced = radius.value * f64::from(self.light.texels) / 4.0;
        assert!((reduced - reduced.round()).abs() > 1e-4, "the scene leaves no doubt about the region");
        (reduced.ceil() as u32).clamp(2, 64)
    }
}

/// Right, up and backwards of an eye that looks away from `towards`; up is +y, or -z for a light
/// from straight above or below.
fn axes(towards: Approx3) -> [Approx3; 3] {
    let steep = towards.0[1].value.abs() > 0.99;
    let up = Approx3::from_vec(if steep { Vec3::NEG_Z } else { Vec3::Y });
    let right = up.cross(towards).normalized_on_cpu();
    [right, towards.cross(right), towards]
}
