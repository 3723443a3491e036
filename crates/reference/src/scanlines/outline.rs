//! One triangle as seen on the light from one receiver.
//!
//! In the basis of the light's axes every corner is (X, Y, Z), its picture on the light (X / Z,
//! Y / Z). With homogeneous edges (Olano and Greer 1997) corners behind the receiver need no
//! clipping. Edges are the cross product of sum and difference of their ends, which negates exactly
//! when the ends change places: nothing leaks between neighbours.

use super::lines::{Lines, REPLICATES, RISE, Row, Ruling};
use crate::aim::{Aim, Distance, Outline as Rim, Spread};
use crate::rays::LIGHT_GAP;
use crate::receiver::Receiver;
use glam::{DMat3, DVec3, Mat3, Vec3};

/// Spacing of bounds kept free of rounding: f32's 2^-24 times a handful of operations, in half
/// widths of the light.
const MARGIN: f32 = 1e-4;

/// Half widths that lie off every row, a wide cone's too.
const BEYOND: f32 = 1e4;

/// The light's axes as one receiver rules them.
pub(crate) struct Frame {
    /// Receiver's place, in two f32 that add up to it.
    place: [Vec3; 2],
    light_from_world: Mat3,
    /// The rows' direction, the other one, and the axis.
    axes: [DVec3; 3],
    tilt: [f64; 2],
    /// Rise of y per x on a rectangle.
    pub(crate) shear: f64,
    cone: Option<Cone>,
    /// Depth (in lengths of the axis) before which a surface hides for sure, and from which it never
    /// does.
    depth: [f32; 2],
    flat: bool,
}

/// A cone's samples are uniform in the angle across the rows and in the sine along them
/// (Archimedes: together they are uniform by solid angle).
#[derive(Clone, Copy)]
struct Cone {
    angle: f64,
    cos: f64,
    sin: f32,
    tan: f32,
}

/// `a x + b y + c >= 0` inside.
#[derive(Clone, Copy, Default)]
struct Edge {
    a: f32,
    b: f32,
    c: f32,
}

/// What a triangle hides.
pub(crate) struct Outline {
    edges: [Edge; 4],
    count: usize,
    rows: [usize; 2],
    straddles: bool,
}

impl Frame {
    /// `None` when the light has no size or is seen edge-on.
    pub(crate) fn new((receiver, aim): (&Receiver, &Aim), tilt: [f64; 2]) -> Option<Self> {
        let round = aim.outline == Rim::Disk;
        let (u, v) = if round {
            (aim.u * tilt[0] + aim.v * tilt[1], aim.v * tilt[0] - aim.u * tilt[1])
        } else {
            (aim.u + aim.v * tilt[0], aim.v)
        };
        let matrix = DMat3::from_cols(u, v, aim.axis);
        let size = u.length() * v.length() * aim.axis.length();
        if !(matrix.determinant().abs() > 1e-5 * size) || u.length().min(v.length()) < 1e-6 * aim.axis.length()
        {
            return None;
        }
        let (cone, depth, flat) = match aim.spread {
            Spread::Area => (None, [(1.0 - LIGHT_GAP) as f32; 2], true),
            Spread::Cone { one_minus_cos, distance } => {
                let cos = 1.0 - one_minus_cos;
                let sin = (one_minus_cos * (2.0 - one_minus_cos)).sqrt();
                let cone = Cone { angle: sin.atan2(cos), cos, sin: sin as f32, tan: (sin / cos) as f32 };
                let depth = match distance {
                    Distance::Infinite => [f32::INFINITY; 2],
                    Distance::Sphere => {
                        let [far, near] = aim.nearness().map(f64::recip);
                        [(near * (1.0 - LIGHT_GAP)) as f32, far as f32]
                    }
                };
                (Some(cone), depth, false)
            }
        };
        let shear = if round { 0.0 } else { tilt[0] };
        let light_from_world = matrix.inverse().as_mat3();
        let high = receiver.position.as_vec3();
        let place = [high, (receiver.position - high.as_dvec3()).as_vec3()];
        Some(Self { place, light_from_world, axes: [u, v, aim.axis], tilt, shear, cone, depth, flat })
    }

    /// A row's place on the tangent plane, and 1 + y^2 there in units of the axis.
    pub(crate) fn row(&self, y: f32) -> (f32, f32) {
        match self.cone {
            None => (y, 1.0),
            Some(cone) => {
                let tan = (f64::from(y) * cone.angle).tan();
                ((tan / f64::from(cone.tan)) as f32, (1.0 + tan * tan) as f32)
            }
        }
    }

    /// The square of the half width that the rim leaves of a row.
    pub(crate) fn chord(&self, y: f32) -> f32 {
        match self.cone {
            None => 1.0 - y * y,
            Some(cone) => {
                let cos = (f64::from(y) * cone.angle).cos();
                ((1.0 - (cone.cos / cos).powi(2)) / f64::from(cone.sin).powi(2)) as f32
            }
        }
    }

    /// Where a sample stands in the aim's own coordinates.
    pub(crate) fn place(&self, along: f32, y: f32, q2: f32) -> [f32; 2] {
        let x = match self.cone {
            None => f64::from(along),
            Some(cone) => {
                let s = f64::from(along) * f64::from(cone.sin);
                s * f64::from(q2).sqrt() / ((1.0 - s * s).sqrt() * f64::from(cone.tan))
            }
        };
        let y = f64::from(y);
        let [c, s] = self.tilt;
        let (x, y) = if self.shear == 0.0 { (c * x - s * y, s * x + c * y) } else { (x, y + self.shear * x) };
        [x as f32, y as f32]
    }

    /// `None` for a triangle that hides nothing.
    pub(crate) fn outline(&self, corners: &[Vec3; 3], ruling: &Ruling) -> Option<Outline> {
        let [a, b, c] = corners.map(|v| self.light_from_world * ((v - self.place[0]) - self.place[1]));
        let (nearest, farthest) = (a.z.min(b.z).min(c.z), a.z.max(b.z).max(c.z));
        if farthest <= 0.0 || nearest >= self.depth[1] {
            return None;
        }
        let mut rows = [0, usize::MAX];
        if nearest > 1e-6 * farthest {
            let [p, q, r] = [a, b, c].map(|v| v / v.z);
            let (low, high) = (p.min(q).min(r), p.max(q).max(r));
            // The sheared frame's y goes beyond 1 by the shear.
            let tall = 1.0 + self.shear.abs() as f32 + MARGIN;
            let wide = 1.0 + MARGIN;
            if low.x > wide || high.x < -wide || low.y > tall || high.y < -tall {
                return None;
            }
            rows = self.rows([low.y, high.y], ruling);
        }
        self.edges([a, b, c], farthest).map(|outline| Outline { rows, ..outline })
    }

    /// Rows between two places, rounded outwards.
    fn rows(&self, [low, high]: [f32; 2], ruling: &Ruling) -> [usize; 2] {
        let even = |y: f32| match self.cone {
            None => y,
            // Monotonic and within a row of the angle: atan bends the other way by y^3 / 3.
            Some(cone) => (y * cone.tan).atan() / cone.angle as f32,
        };
        let half = 0.5 * ruling.rows as f32;
        let before = if self.shear == 0.0 { 0.0 } else { 0.5 * RISE as f32 };
        let row = |y: f32| (even(y) + 1.0) * half + before;
        // Row j of a replicate stands between j and j + 1.
        let first = (row(low) - 1.0 - MARGIN * half).ceil().max(0.0) as usize;
        let last = (row(high) + MARGIN * half).floor() + 1.0;
        [first, last.max(0.0) as usize]
    }

    fn edges(&self, [a, b, c]: [Vec3; 3], farthest: f32) -> Option<Outline> {
        let edge = |from: Vec3, to: Vec3| (from + to).cross(to - from) * 0.5;
        let (n0, n1, n2) = (edge(b, c), edge(c, a), edge(a, b));
        let volume = a.dot(n0);
        if volume == 0.0 || !volume.is_finite() {
            return None;
        }
        let sign = volume.signum();
        let mut outline = Outline { edges: Default::default(), count: 3, rows: [0, usize::MAX], straddles: false };
        for (edge, n) in outline.edges.iter_mut().zip([n0, n1, n2]) {
            *edge = Edge { a: n.x * sign, b: n.y * sign, c: n.z * sign };
        }
        if farthest >= self.depth[0] {
            if self.flat {
                let sum = (n0 + n1 + n2) * sign;
                outline.edges[3] = Edge { a: sum.x, b: sum.y, c: sum.z - volume * sign / self.depth[0] };
                outline.count = 4;
            } else {
                outline.straddles = true;
            }
        }
        Some(outline)
    }
}

impl Outline {
    /// What is below a surface's horizon.
    pub(crate) fn horizon(frame: &Frame, normal: DVec3) -> Self {
        let [a, b, c] = frame.axes.map(|axis| -(normal.dot(axis)) as f32);
        Self {
            edges: [Edge { a, b, c }, Edge::default(), Edge::default(), Edge::default()],
            count: 1,
            rows: [0, usize::MAX],
            straddles: false,
        }
    }

    /// Whether samples must be asked one by one: it crosses a sphere's surface.
    pub(crate) fn straddles(&self) -> bool {
        self.straddles
    }

    /// Hides what is inside.
    pub(crate) fn cover(&self, lines: &mut Lines, frame: &Frame) {
        let mut low = [(0.0f32, -BEYOND); 4];
        let mut high = [(0.0f32, BEYOND); 4];
        let (mut lows, mut highs) = (0, 0);
        for edge in &self.edges[..self.count] {
            // An edge along the rows becomes one that all but is.
            let least = 1e-12 * (edge.b.abs() + edge.c.abs());
            let a = if edge.a.abs() > least { edge.a } else { least.max(f32::MIN_POSITIVE) };
            let line = (-edge.b / a, -edge.c / a);
            if a > 0.0 {
                low[lows] = line;
                lows += 1;
            } else {
                high[highs] = line;
                highs += 1;
            }
        }
        let count = lines.rows.len();
        let range = self.rows[0].min(count)..self.rows[1].min(count);
        let per_row = lines.per_row;
        for row in &mut lines.rows[range] {
            let (mut from, mut to) = ([-BEYOND; REPLICATES], [BEYOND; REPLICATES]);
            for &(slope, at) in &low[..lows] {
                for (from, y) in from.iter_mut().zip(row.y) {
                    let x = slope * y + at;
                    *from = if x > *from { x } else { *from };
                }
            }
            for &(slope, at) in &high[..highs] {
                for (to, y) in to.iter_mut().zip(row.y) {
                    let x = slope * y + at;
                    *to = if x < *to { x } else { *to };
                }
            }
            if let Some(cone) = frame.cone {
                straighten(&mut from, row, cone);
                straighten(&mut to, row, cone);
            }
            let [from, to] = [from, to].map(|x| index(&x, &row.shift, per_row));
            for ((hidden, from), to) in row.hidden.iter_mut().zip(from).zip(to) {
                *hidden |= below(to) & !below(from);
            }
        }
    }
}

/// From the tangent plane to the sine along a row, in half widths.
fn straighten(x: &mut [f32; REPLICATES], row: &Row, cone: Cone) {
    for (x, q2) in x.iter_mut().zip(row.q2) {
        let t = *x * cone.tan;
        *x = t / ((q2 + t * t).sqrt() * cone.sin);
    }
}

/// The first sample at or after a place, 0 to 32.
fn index(x: &[f32; REPLICATES], shift: &[f32; REPLICATES], per_row: f32) -> [u32; REPLICATES] {
    let mut out = [0; REPLICATES];
    for ((out, x), shift) in out.iter_mut().zip(x).zip(shift) {
        let at = (x + 1.0) * (0.5 * per_row) - shift;
        let at = if at > 0.0 { at } else { 0.0 };
        let at = if at < 32.0 { at } else { 32.0 };
        // Rounds up: adding 2^23 drops the fraction, to the nearest.
        let nearest = (at + 8_388_608.0) - 8_388_608.0;
        let up = if nearest < at { nearest + 1.0 } else { nearest };
        *out = (up + 8_388_608.0).to_bits() & 0x3f;
    }
    out
}

/// The lowest `count` bits.
fn below(count: u32) -> u32 {
    ((1u64 << count) - 1) as u32
}
