//! One triangle against all samples.
//!
//! Let a, b, c be the corners relative to the receiver, `n0 = b x c`, `n1 = c x a`, `n2 = a x b`
//! and `D = a.n0 > 0` (flip all signs otherwise). The segment to a sample s crosses the triangle
//! exactly when `n_k.s >= 0` for all k and `(n0 + n1 + n2).s > D`. With `s = (axis + x u + y v) /
//! nearness` these are four forms linear in (x, y). They are set up in f64 and share their edges'
//! bits with the neighbouring triangle, so that nothing leaks through a mesh.

use crate::aim::{Aim, Distance, Spread};
use crate::rays::LIGHT_GAP;
use crate::receiver::Receiver;
use crate::samples::{LANES, LightSamples};
use glam::DVec3;

/// `a x + b y + c - d nearness >= 0`.
#[derive(Clone, Copy, Debug, Default)]
struct Form {
    a: f32,
    b: f32,
    c: f32,
    d: f32,
}

/// A triangle's outline on the light: the forms that do not hold everywhere.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Silhouette {
    forms: [Form; 4],
    count: usize,
}

/// How much of the light a triangle hides.
pub(crate) enum Shade {
    None,
    Whole,
    Part(Silhouette),
}

/// Decides by the forms' ranges over the light's outline what can be decided without samples.
pub(crate) fn shade(receiver: &Receiver, aim: &Aim, corners: [DVec3; 3]) -> Shade {
    let [a, b, c] = corners.map(|v| v - receiver.position);
    let (n0, n1, n2) = (b.cross(c), c.cross(a), a.cross(b));
    let volume = a.dot(n0);
    if volume == 0.0 {
        return Shade::None;
    }
    let sign = volume.signum();
    let mut silhouette = Silhouette::default();
    for normal in [n0, n1, n2] {
        if !silhouette.add(aim, normal * sign, 0.0) {
            return Shade::None;
        }
    }
    // Every surface is nearer than a sun.
    let sun = matches!(aim.spread, Spread::Cone { distance: Distance::Infinite, .. });
    if !sun && !silhouette.add(aim, (n0 + n1 + n2) * sign, volume * sign / (1.0 - LIGHT_GAP)) {
        return Shade::None;
    }
    if silhouette.count == 0 { Shade::Whole } else { Shade::Part(silhouette) }
}

impl Silhouette {
    /// Adds `normal.s >= offset` if it does not hold everywhere; false if it holds nowhere.
    fn add(&mut self, aim: &Aim, normal: DVec3, offset: f64) -> bool {
        let [a, b, c] = [aim.u, aim.v, aim.axis].map(|side| normal.dot(side));
        let reach = aim.reach(a, b);
        let [far, near] = aim.nearness().map(|nearness| offset * nearness);
        if c + reach - far < 0.0 {
            return false;
        }
        if c - reach - near >= 0.0 {
            return true;
        }
        // On flat lights the offset joins the constant before rounding.
        let (c, d) = if far == near { (c - far, 0.0) } else { (c, offset) };
        let scale = 1.0 / a.abs().max(b.abs()).max(c.abs()).max(d.abs());
        let [a, b, c, d] = [a, b, c, d].map(|v| (v * scale) as f32);
        self.forms[self.count] = Form { a, b, c, d };
        self.count += 1;
        true
    }

    /// Raises `cover` to 0 or above at the samples inside.
    pub(crate) fn cover(&self, samples: &LightSamples, cover: &mut [f32]) {
        let x = samples.x.chunks_exact(LANES);
        let y = samples.y.chunks_exact(LANES);
        let nearness = samples.nearness.chunks_exact(LANES);
        for (((x, y), nearness), cover) in x.zip(y).zip(nearness).zip(cover.chunks_exact_mut(LANES)) {
            let inside = self.inside(x, y, nearness);
            for (cover, inside) in cover.iter_mut().zip(inside) {
                *cover = if inside > *cover { inside } else { *cover };
            }
        }
    }

    /// The same, only for samples whose place passes a test.
    pub(crate) fn cover_where(
        &self,
        samples: &LightSamples,
        cover: &mut [f32],
        passes: impl Fn([f32; 2]) -> bool,
    ) {
        let x = samples.x.chunks_exact(LANES);
        let y = samples.y.chunks_exact(LANES);
        let nearness = samples.nearness.chunks_exact(LANES);
        for (((x, y), nearness), cover) in x.zip(y).zip(nearness).zip(cover.chunks_exact_mut(LANES)) {
            let inside = self.inside(x, y, nearness);
            for k in 0..LANES {
                if inside[k] >= 0.0 && cover[k] < 0.0 && passes([x[k], y[k]]) {
                    cover[k] = inside[k];
                }
            }
        }
    }

    /// Not negative inside.
    fn inside(&self, x: &[f32], y: &[f32], nearness: &[f32]) -> [f32; LANES] {
        let mut inside = [f32::MAX; LANES];
        for form in &self.forms[..self.count] {
            form.lower(x, y, nearness, &mut inside);
        }
        inside
    }
}

impl Form {
    fn lower(&self, x: &[f32], y: &[f32], nearness: &[f32], inside: &mut [f32; LANES]) {
        if self.d == 0.0 {
            for ((inside, x), y) in inside.iter_mut().zip(x).zip(y) {
                let value = self.a * x + self.b * y + self.c;
                *inside = if value < *inside { value } else { *inside };
            }
        } else {
            for (((inside, x), y), nearness) in inside.iter_mut().zip(x).zip(y).zip(nearness) {
                let value = self.a * x + self.b * y + self.c - self.d * nearness;
                *inside = if value < *inside { value } else { *inside };
            }
        }
    }
}
