//! A light's axes as one receiver sees them, and how its rows lie in them.

use super::eight::{Eight, LANES};
use super::lines::Ruling;
use super::outline::MARGIN;
use crate::aim::{Aim, Distance, Outline, Spread};
use crate::rays::LIGHT_GAP;
use crate::receiver::Receiver;
use glam::{DMat3, DVec3, Mat3, Vec3};

/// Sine of the angle to a flat light's plane below which it counts as seen edge-on. f32 loses its 2^-24 over
/// this in `light_from_world`: at 1e-5 whole samples, at 1e-3 less than a thousandth of a light.
const EDGE_ON: f64 = 1e-3;

/// From the world to a light: a corner (X, Y, Z) has its picture at (X / Z, Y / Z) of the aim's
/// coordinates; Z is in lengths of the axis.
#[derive(Clone, Copy)]
pub(crate) struct Frame {
    /// Receiver's place, in two f32 that add up to it.
    pub(crate) place: [Vec3; 2],
    pub(crate) light_from_world: Mat3,
    pub(crate) normal: Vec3,
    /// Sum of the receiver's coordinates without signs.
    pub(crate) extent: f32,
    /// Whether the receiver has neither a surface of its own nor a horizon.
    pub(crate) in_air: bool,
    /// The aim's u, v and axis.
    axes: [DVec3; 3],
    pub(crate) round: bool,
    pub(crate) cone: Option<Cone>,
    /// Depth Z before which a surface hides for sure, and from which it never does.
    pub(crate) depth: [f32; 2],
    /// Whether the light is flat: the two depths are one plane.
    pub(crate) flat: bool,
}

/// A cone's samples are uniform in the angle across the rows and in the sine along them
/// (Archimedes: together they are uniform by solid angle).
#[derive(Clone, Copy)]
pub(crate) struct Cone {
    /// Half of the full angle, and functions of it.
    pub(crate) angle: f32,
    pub(crate) sin: f32,
    pub(crate) tan: f32,
    /// tan / angle.
    stretch: f32,
    pub(super) per_sin: f32,
    pub(super) narrow: bool,
}

/// The aim's coordinates from the rows': `x = xx x' + xy y'`, `y = yx x' + yy y'`.
#[derive(Clone, Copy)]
pub(crate) struct Turn {
    pub(crate) xx: f32,
    pub(crate) xy: f32,
    pub(crate) yx: f32,
    pub(crate) yy: f32,
}

impl Frame {
    /// `None` when the light has no size or is seen edge-on.
    pub(crate) fn new(receiver: &Receiver, aim: &Aim) -> Option<Self> {
        let matrix = DMat3::from_cols(aim.u, aim.v, aim.axis);
        let (width, height, length) = (aim.u.length(), aim.v.length(), aim.axis.length());
        let thin = matrix.determinant().abs() <= EDGE_ON * width * height * length;
        if thin || width.min(height) < 1e-6 * length {
            return None;
        }
        let (cone, depth) = match aim.spread {
            Spread::Area => (None, [(1.0 - LIGHT_GAP) as f32; 2]),
            Spread::Cone { one_minus_cos, distance } => {
                let cos = 1.0 - one_minus_cos;
                let sin = (one_minus_cos * (2.0 - one_minus_cos)).sqrt();
                let (angle, tan) = (sin.atan2(cos), sin / cos);
                let cone = Cone {
                    angle: angle as f32,
                    sin: sin as f32,
                    tan: tan as f32,
                    stretch: (tan / angle) as f32,
                    per_sin: (1.0 / sin) as f32,
                    narrow: tan < 0.1,
                };
                let depth = match distance {
                    Distance::Infinite => [f32::INFINITY; 2],
                    Distance::Sphere => {
                        let [far, near] = aim.nearness().map(f64::recip);
                        [(near * (1.0 - LIGHT_GAP)) as f32, far as f32]
                    }
                };
                (Some(cone), depth)
            }
        };
        let mut frame = Self {
            place: [Vec3::ZERO; 2],
            light_from_world: matrix.inverse().as_mat3(),
            normal: Vec3::ZERO,
            extent: 0.0,
            in_air: false,
            axes: [aim.u, aim.v, aim.axis],
            round: aim.outline == Outline::Disk,
            flat: cone.is_none(),
            cone,
            depth,
        };
        frame.stand(receiver);
        Some(frame)
    }

    /// Moves to a receiver that sees the light in the same direction.
    #[inline(always)]
    pub(crate) fn stand(&mut self, receiver: &Receiver) {
        let high = receiver.position.as_vec3();
        self.place = [high, (receiver.position - high.as_dvec3()).as_vec3()];
        self.normal = receiver.normal.as_vec3();
        self.extent = high.abs().element_sum();
        self.in_air = receiver.is_in_air();
    }

    /// A plane's linear form on the light.
    pub(crate) fn form(&self, normal: DVec3) -> [f32; 3] {
        self.axes.map(|axis| normal.dot(axis) as f32)
    }

    /// The first row that may be at a place across the rows or above, and the one after the last that may be at
    /// another or below.
    #[inline(always)]
    pub(crate) fn rows(&self, ruling: &Ruling, mut low: Eight, mut high: Eight) -> [[u32; LANES]; 2] {
        if let Some(cone) = &self.cone {
            [low, high] = cone.angles(low, high);
        }
        let half = 0.5 * ruling.rows as f32;
        let middle = half + ruling.before();
        // Row j of a replicate stands between j and j + 1.
        let first = low * Eight::all(half) + Eight::all(middle - 1.0 - MARGIN * half);
        let last = high * Eight::all(half) + Eight::all(middle + 1.0 + MARGIN * half);
        [first.floor(), last.floor()]
    }

    /// Where a sample stands in the aim's coordinates: `along` of a row from -1 to 1.
    pub(crate) fn place(&self, turn: &Turn, along: f32, [y, cos]: [f32; 2]) -> [f32; 2] {
        let x = match self.cone {
            None => f64::from(along),
            Some(cone) => {
                let s = f64::from(along) * f64::from(cone.sin);
                s / (f64::from(cos) * (1.0 - s * s).sqrt() * f64::from(cone.tan))
            }
        };
        let y = f64::from(y);
        let [xx, xy, yx, yy] = [turn.xx, turn.xy, turn.yx, turn.yy].map(f64::from);
        [(xx * x + xy * y) as f32, (yx * x + yy * y) as f32]
    }
}

impl Cone {
    /// Angle, sine, tangent, and tangent per angle.
    pub(crate) fn sizes(&self) -> [f32; 4] {
        [self.angle, self.sin, self.tan, self.stretch]
    }

    /// A row's place on the tangent plane, the cosine of its angle, and the square of the half width
    /// that the rim leaves of it: `y` is its angle in half angles of the cone.
    #[inline(always)]
    pub(crate) fn row(&self, y: f32) -> [f32; 3] {
        let [sin, cos] = sin_cos(y * self.angle);
        let height = sin / self.sin;
        [sin / (cos * self.tan), cos, (1.0 - height * height) / (cos * cos)]
    }

    /// The least and the largest angle that places on the tangent plane may stand for: on the light
    /// an angle is at least its tangent (both in units of the rim's) and at most `stretch` times it.
    #[inline(always)]
    pub(crate) fn angles(&self, low: Eight, high: Eight) -> [Eight; 2] {
        let stretch = Eight::all(self.stretch);
        [low.min(low * stretch), high.max(high * stretch)]
    }

    /// From the tangent plane to the sine along a row, in half widths.
    #[inline(always)]
    pub(crate) fn along(&self, x: Eight, cos: Eight) -> Eight {
        let w = x * Eight::all(self.tan) * cos;
        let square = w * w;
        if self.narrow {
            // The binomial series of 1 / sqrt(1 + w^2): w^2 is below 0.01 on the light, the first term
            // left out below 3e-7. Off the light the sign is all that counts.
            let square = square.min(Eight::all(0.02));
            let root = Eight::all(1.0) - square * (Eight::all(0.5) - square * Eight::all(0.375));
            w * root * Eight::all(self.per_sin)
        } else {
            w * Eight::all(self.per_sin) / (Eight::all(1.0) + square).sqrt()
        }
    }
}

/// Taylor's series, good to 1e-7 up to a right angle.
#[inline(always)]
fn sin_cos(t: f32) -> [f32; 2] {
    let s = t * t;
    let sin = 1.0
        + s * (-1.0 / 6.0
            + s * (1.0 / 120.0 + s * (-1.0 / 5040.0 + s * (1.0 / 362_880.0 - s / 39_916_800.0))));
    let cos = 1.0
        + s * (-0.5
            + s * (1.0 / 24.0
                + s * (-1.0 / 720.0
                    + s * (1.0 / 40_320.0 + s * (-1.0 / 3_628_800.0 + s * (1.0 / 479_001_600.0))))));
    [t * sin, cos]
}
