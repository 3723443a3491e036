//! A map in every direction: the second document's point light.

use super::{Plain, Spot, placed, tables};
use crate::support::still_life;
use glam::DVec3;
use std::sync::OnceLock;
use umbrage_shadows::{Calibration, ReceiverPlane};

/// The light and its cube, from definitions: six faces of half the single map's side, three by two
/// (+x -x +y -y +z -z), distances from the light.
struct Cube<'a> {
    plain: &'a Plain<'a>,
    eye: DVec3,
    radius: f64,
    side: f64,
}

/// A receiver moved by the normal offset, seen from the light.
struct Seen {
    direction: DVec3,
    tangent: DVec3,
    bitangent: DVec3,
    normal: DVec3,
    depth: f64,
}

/// What a variant with a cube map may say; `None` for any other name.
pub(crate) fn shade(plain: &Plain<'_>, name: &str, spot: &Spot) -> Option<Vec<f64>> {
    let light = still_life::sphere();
    let cube = Cube {
        plain,
        eye: light.centre()?.as_dvec3(),
        radius: f64::from(light.radius_world()?),
        side: f64::from(plain.light.texels / 2),
    };
    let s = cube.seen(spot);
    let angles = || (0..24).map(|k| f64::from(k) * 0.26);
    let lit = |points: usize, radius: f64, angle: f64| {
        let kernel = placed(&tables::poisson(points), radius, angle);
        plain.mean(&kernel, |o| cube.nearest(&s, o))
    };
    match name {
        "hard-cube" => Some(vec![cube.nearest(&s, [0.0; 2])]),
        "pcf-cube" => {
            let radius = match plain.calibration {
                // A disc of the light's radius at the receiver.
                Calibration::AsPrinted => cube.radius / s.depth,
                Calibration::LightMatched => {
                    let gap = plain.light.reference_gap.value;
                    cube.cone(s.depth, (s.depth - gap).max(cube.nearest_surface()))
                }
            };
            Some(angles().map(|angle| lit(16, radius, angle)).collect())
        }
        "pcss-cube" => {
            let search = match plain.calibration {
                Calibration::AsPrinted => 1.5 * cube.radius / s.depth,
                Calibration::LightMatched => cube.cone(s.depth, cube.nearest_surface()),
            };
            let at = |angle: f64| {
                let taps = placed(&tables::poisson(16), search, angle);
                let pairs = taps.iter().map(|&o| cube.pair(&s, o));
                let before: Vec<f64> = pairs.filter(|p| p.0 < p.1).map(|p| p.0).collect();
                if before.is_empty() {
                    return 1.0;
                }
                let b = before.iter().sum::<f64>() / before.len() as f64;
                lit(32, cube.cone(s.depth, b), angle)
            };
            Some(angles().map(at).collect())
        }
        _ => None,
    }
}

impl Cube<'_> {
    fn seen(&self, spot: &Spot) -> Seen {
        let to = spot.position - self.eye;
        let cosine = spot.normal.dot(-to.normalize());
        let texel = to.length() * 2.0 / self.side;
        let texels = self.plain.bias.normal_offset_texels;
        let p = to + spot.normal * (texels * texel * (1.0 - cosine * cosine).max(0.0).sqrt());
        let direction = p.normalize();
        let up = if direction.y.abs() < 0.999 { DVec3::Y } else { DVec3::X };
        let tangent = up.cross(direction).normalize();
        Seen {
            direction,
            tangent,
            bitangent: direction.cross(tangent),
            normal: spot.normal,
            depth: p.length(),
        }
    }

    /// R (z - b) / b at the receiver, as a tangent.
    fn cone(&self, z: f64, b: f64) -> f64 {
        self.radius * (z - b).max(0.0) / b / z
    }

    /// The nearest surface to the light, by brute force over points of every triangle.
    fn nearest_surface(&self) -> f64 {
        static FOUND: OnceLock<f64> = OnceLock::new();
        *FOUND.get_or_init(|| still_life::nearest_to(self.eye))
    }

    /// Depth of the texel that a tap meets, and the reference at its centre.
    fn pair(&self, s: &Seen, offset: [f64; 2]) -> (f64, f64) {
        let d = s.direction + s.tangent * offset[0] + s.bitangent * offset[1];
        let axis = (0..3).max_by(|&a, &b| d[a].abs().total_cmp(&d[b].abs()).then(b.cmp(&a))).unwrap_or(0);
        let (right, up) = ((axis + 1) % 3, (axis + 2) % 3);
        let sign = d[axis].signum();
        let place = [d[right] / d[axis].abs(), -d[up] / d[axis].abs()];
        let texel = place.map(|c| (((c + 1.0) * 0.5 * self.side).floor()).clamp(0.0, self.side - 1.0));
        let face = 2 * axis + usize::from(sign < 0.0);
        let corner = [face % 3, face / 3].map(|k| k as f64 * self.side);
        let map = self.plain.channel("shadow-map", 0, 0);
        let depth = f64::from(*map.at((corner[0] + texel[0]) as u32, (corner[1] + texel[1]) as u32));
        let centre = texel.map(|c| (c + 0.5) / self.side * 2.0 - 1.0);
        let mut along = DVec3::ZERO;
        along[axis] = sign;
        along[right] = centre[0];
        along[up] = -centre[1];
        (depth, self.reference(s, along.normalize()))
    }

    /// Distance of the receiver, or of its plane along a direction, less the constant.
    fn reference(&self, s: &Seen, along: DVec3) -> f64 {
        use umbrage_shadows::ConstantBias::{PerDistance, World};
        let constant = match self.plain.bias.constant {
            World(metres) => metres,
            PerDistance(part) => part * self.plain.light.eye_distance.value,
        };
        let ReceiverPlane::On { max_slope } = self.plain.bias.receiver_plane else {
            return s.depth - constant;
        };
        // No steeper than the cap: the plane is turned towards the light about the receiver.
        let towards = -s.normal.dot(s.direction);
        let across = [s.normal.dot(s.tangent), s.normal.dot(s.bitangent)];
        let steep = across[0].hypot(across[1]) / towards.max(1e-6 / s.depth);
        let part = (max_slope / steep.max(1e-12)).min(1.0) / towards.max(1e-6 / s.depth);
        let forward = along.dot(s.direction).max(1e-3);
        let (x, y) = (along.dot(s.tangent) / forward, along.dot(s.bitangent) / forward);
        let inverse = 1.0 / s.depth - part / s.depth * (across[0] * x + across[1] * y);
        (1.0 + x * x + y * y).sqrt() / inverse.max(1e-6) - constant
    }

    fn nearest(&self, s: &Seen, offset: [f64; 2]) -> f64 {
        let (depth, reference) = self.pair(s, offset);
        f64::from(u8::from(reference <= depth))
    }
}
