//! What is sure of eight triangles from all receivers of a group at once.
//!
//! Bounds are f32; what is not sure is asked again at each receiver. Of triangles so small or so thin that f32 does not tell
//! their sides a side may be sure and wrong: their pictures are as thin as f32's rounding.

use super::blocks::Block;
use super::clip::{Clip, upright};
use super::eight::{Eight, LANES, Mask, bytes};
use super::groups::Placed;
use crate::aim::{Aim, Distance, Spread};
use crate::rays::LIGHT_GAP;
use crate::receiver::{COPLANAR, Receiver};
use glam::{DVec3, Vec3};
use umbrage_scene::AreaLight;

/// f32 rounds by 2^-24 each time: what a height of a few dozen operations may be off by, for each metre of what
/// it was made of.
pub(super) const ROUNDING: f32 = 4e-6;

/// Receivers differ in where exactly they stop to look for a triangle that crosses the light's plane. It is cut at one
/// place for all of them if that moves its picture by less than a part of the light's width in so many.
const THROUGH: f32 = 512.0;

/// Where the receivers of a group are, and how the light lies to them.
pub(super) struct Standpoint {
    centre: Vec3,
    /// Half of the box around all places, rounding included.
    half: Vec3,
    /// The middle of all normals, and half of the box around them.
    normal: Vec3,
    sway: Vec3,
    /// The lowest and the highest place along `normal`, from the centre.
    heights: [f32; 2],
    extent: f32,
    far: Far,
    /// A flat light's centre from the group's, and its axes.
    light: Option<[Vec3; 3]>,
    clip: Option<Clip>,
    /// Whether all are in mid-air: nothing is their own or below a horizon.
    airborne: bool,
    /// The normal that all share, if they do, and the lowest place along it.
    shared: Option<(DVec3, f64)>,
}

/// Between which depths a triangle surely stands before the light.
enum Far {
    /// Along a direction, from the centre: above the first and below the second. Below the third it is behind
    /// all receivers, above the fourth behind the light. Triangles are cut at `end`, by `doubt` more or less than
    /// each receiver would.
    Plane { axis: Vec3, range: [f32; 2], out: [f32; 2], end: f64, doubt: f32 },
    /// Towards a sphere's centre; how far the receivers are from the group's, and the most that
    /// `corner . axis` may be.
    Ball { axis: Vec3, reach: f32, most: f32 },
}

/// A bit for each triangle of a block.
#[derive(Clone, Copy)]
pub(super) struct Sure {
    /// Wholly before all receivers.
    pub(super) front: u32,
    /// What of it is before the light is nearer than the light.
    pub(super) nearer: u32,
    /// All of it is nearer than the light.
    pub(super) below: u32,
    /// Surely not the receiver's own, in its plane or below its horizon.
    pub(super) clear: u32,
    /// All receivers are on one side of its plane, with all that is before them up to where triangles are cut; on which.
    pub(super) sided: u32,
    pub(super) behind: u32,
    /// May be cut where it reaches behind the receivers, and through the light.
    pub(super) cut_near: u32,
    pub(super) cut_far: u32,
    /// Hides nothing from any receiver.
    pub(super) never: u32,
}

impl Standpoint {
    /// `None` where the light stands differently to different receivers.
    pub(super) fn new(light: &AreaLight, receivers: &[Placed]) -> Option<Self> {
        let fold = |pick: fn(&Receiver) -> DVec3| {
            receivers
                .iter()
                .map(|r| pick(&r.receiver))
                .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
        };
        let (low, high) = fold(|r| r.position);
        let centre = ((low + high) * 0.5).as_vec3();
        let (below, above) = (centre.as_dvec3() - low, high - centre.as_dvec3());
        let widened = |v: DVec3| v.as_vec3() * (1.0 + ROUNDING) + Vec3::splat(1e-30);
        let half = widened(below.max(above));
        let (low, high) = fold(|r| r.normal);
        let normal = ((low + high) * 0.5).as_vec3();
        let sway = widened((normal.as_dvec3() - low).max(high - normal.as_dvec3()));
        let reach = |axis: DVec3| {
            let along = receivers.iter().map(|r| axis.dot(r.receiver.position - centre.as_dvec3()));
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], t| [low.min(t), high.max(t)])
        };
        let middle = Receiver { position: centre.as_dvec3(), ..receivers[0].receiver };
        let aim = Aim::new(light, &middle)?;
        let mut far = match aim.spread {
            Spread::Cone { distance: Distance::Infinite, .. } => {
                let axis = upright(&aim);
                let [lowest, highest] = reach(axis).map(|t| t as f32);
                let (range, out) = ([highest, f32::INFINITY], [lowest, f32::INFINITY]);
                Far::Plane { axis: axis.as_vec3(), range, out, end: f64::INFINITY, doubt: 0.0 }
            }
            Spread::Area => {
                let axis = upright(&aim);
                let light = axis.dot(aim.axis);
                let [nearest, farthest] = reach(axis);
                if light - farthest <= 0.0 {
                    return None;
                }
                let most = light - 2.0 * LIGHT_GAP * (light - nearest);
                let (range, out) = ([farthest as f32, most as f32], [nearest as f32, light as f32]);
                let end = light - LIGHT_GAP * (light - 0.5 * (nearest + farthest));
                let doubt = 0.5 * LIGHT_GAP * (farthest - nearest) + f64::from(ROUNDING) * light;
                Far::Plane { axis: axis.as_vec3(), range, out, end, doubt: doubt as f32 }
            }
            Spread::Cone { one_minus_cos, distance: Distance::Sphere } => {
                let cos = 1.0 - one_minus_cos;
                let radius = aim.axis.length() * (1.0 - cos * cos).sqrt();
                let reach = f64::from(half.length());
                let length = aim.axis.length() - reach;
                if length <= radius {
                    return None;
                }
                // (corner - p) . (light - p) is below this for every receiver p if nearer than the near side.
                let most = length * (length - radius) * (1.0 - 2.0 * LIGHT_GAP) - reach * reach;
                Far::Ball { axis: aim.axis.as_vec3(), reach: reach as f32, most: most as f32 }
            }
        };
        let light = matches!(aim.spread, Spread::Area).then(|| [aim.axis, aim.u, aim.v].map(DVec3::as_vec3));
        let clip = match &mut far {
            Far::Plane { range: [nearest, _], out: [lowest, _], end, .. } => {
                let heights = [*lowest, *nearest].map(f64::from);
                let clip = Clip::new(centre, half, &aim, heights, *end);
                *nearest = clip.height().unwrap_or(*nearest);
                Some(clip)
            }
            Far::Ball { .. } => None,
        };
        let heights = reach(normal.as_dvec3()).map(|h| h as f32);
        let own = receivers[0].receiver.normal;
        let shared = (low == high && own != DVec3::ZERO).then(|| {
            let heights = receivers.iter().map(|r| own.dot(r.receiver.position));
            (own, heights.fold(f64::INFINITY, f64::min))
        });
        let airborne = receivers.iter().all(|r| r.receiver.is_in_air());
        Some(Self {
            light,
            clip,
            airborne,
            shared,
            centre,
            half,
            normal,
            sway,
            heights,
            extent: centre.abs().element_sum(),
            far,
        })
    }

    /// At a light whose points are the same from everywhere: not at a sphere, of which each receiver sees other parts.
    pub(super) fn aim(&self, light: &AreaLight) -> Option<Aim> {
        match light {
            AreaLight::Sphere { .. } => None,
            _ => Aim::new(light, &Receiver::in_air(self.centre.as_dvec3())),
        }
    }

    /// Where triangles are cut.
    pub(super) fn clip(&self) -> Option<&Clip> {
        self.clip.as_ref()
    }

    pub(super) fn centre(&self) -> Vec3 {
        self.centre
    }

    /// Of a box around all places.
    pub(super) fn corners(&self) -> [Vec3; 8] {
        let ulps = Vec3::splat(1.2e-7) * (self.centre.abs() + self.half);
        let half = self.half + ulps;
        std::array::from_fn(|i| {
            let sign = |axis: usize| if i >> axis & 1 == 0 { -1.0 } else { 1.0 };
            self.centre + half * Vec3::new(sign(0), sign(1), sign(2))
        })
    }

    /// A bit for each triangle in the plane of all receivers, or below it, as `Receiver::skips` would say at each.
    #[inline(always)]
    pub(super) fn skips(&self, block: &Block) -> u32 {
        let Some((normal, lowest)) = self.shared else { return 0 };
        let mut above = [f64::NEG_INFINITY; LANES];
        for corner in block.corners() {
            let [x, y, z] = corner;
            for k in 0..LANES {
                let place = [f64::from(x.0[k]), f64::from(y.0[k]), f64::from(z.0[k])];
                let height = normal.x * place[0] + normal.y * place[1] + normal.z * place[2] - lowest;
                let sizes = normal.x.abs() * place[0].abs() + normal.y.abs() * place[1].abs();
                let size = sizes + normal.z.abs() * place[2].abs();
                // Half of what every receiver allows: the rest is for f64's own rounding.
                let over = height - 0.5 * COPLANAR * size;
                above[k] = if over > above[k] { over } else { above[k] };
            }
        }
        let mut skips = 0;
        for (k, above) in above.iter().enumerate() {
            skips |= u32::from(*above <= 0.0) << k;
        }
        skips
    }

    #[inline(always)]
    pub(super) fn sure(&self, block: &Block) -> Sure {
        let c = self.centre;
        let d = block.from(c);
        let [a, b, c] = &d;
        let ([p, q, r], one) = ([abs(a), abs(b), abs(c)], Vec3::ONE);
        let size = dot(one, &p).max(dot(one, &q)).max(dot(one, &r)) + Eight::all(self.extent);
        let rounding = size * Eight::all(ROUNDING);
        // Heights over every receiver's horizon.
        let (p, away) = (dot(self.normal, a), dot(self.sway, &p));
        let (q, gone) = (dot(self.normal, b), dot(self.sway, &q));
        let (r, off) = (dot(self.normal, c), dot(self.sway, &r));
        let highest = (p - away).max(q - gone).max(r - off);
        let at_most = (p + away).max(q + gone).max(r + off);
        let ([low, high], sway) = (self.heights, self.sway.dot(self.half));
        let mut clear = (Eight::all(high + sway) + rounding).below(highest);
        if self.airborne {
            clear = Eight::all(0.0).below(Eight::all(1.0));
        }
        let below = (at_most + rounding).below(Eight::all(low - sway));
        let [front, nearer, out] = self.between(&d, rounding);
        // The height of the triangle's plane over the centre, times twice its area.
        let (p, q) = (sub(b, a), sub(c, a));
        let half = self.half.to_array();
        let mut plane = Eight::all(0.0);
        let mut off = Eight::all(0.0);
        let mut normal = [Eight::all(0.0); 3];
        for [i, j, k] in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
            let (x, y) = (p[j] * q[k], p[k] * q[j]);
            let n = x - y;
            plane = plane + n * a[i];
            normal[i] = n;
            let wide = a[i].abs() + Eight::all(half[i]);
            off = off
                + n.abs() * (Eight::all(half[i]) + rounding)
                + (x.abs() + y.abs()) * wide * Eight::all(ROUNDING);
        }
        // And from all the places where the view meets the plane at which triangles are cut.
        let [drift, widest] = self.clip.as_ref().map_or([Vec3::ZERO; 2], Clip::drift);
        let ahead = plane - dot(drift, &normal);
        let far_off = off + dot(widest, &abs(&normal));
        let sided = off.below(plane.abs()).and(far_off.below(ahead.signed_as(plane)));
        let behind = plane.below(Eight::all(0.0));
        let all_nearer = nearer;
        let mut nearer = nearer;
        let mut through = Eight::all(0.0).below(Eight::all(0.0));
        if let Some([middle, u, v]) = self.light {
            // Or its plane has all receivers on one side and all of the light on the other.
            let (u, v) = (dot(u, &normal).abs(), dot(v, &normal).abs());
            if let Far::Plane { axis, doubt, .. } = self.far {
                let moved = dot(axis, &normal).abs() * Eight::all(THROUGH * doubt);
                through = moved.below(u + v);
            }
            let beyond = (dot(middle, &normal) - plane).signed_as(plane) - u - v;
            let size = dot(middle.abs(), &abs(&normal)) + plane.abs() + off + u + v;
            nearer = nearer.or((size * Eight::all(4.0 * LIGHT_GAP as f32)).below(beyond).and(sided));
        }
        let [nearer, below, never, through] = bytes([nearer, all_nearer, out.or(below), through]);
        let [front, clear, sided, behind] = bytes([front, clear, sided, behind]);
        let near = self.clip.as_ref().is_some_and(|clip| clip.height().is_some());
        let cut_near = if near { clear & sided } else { 0 };
        Sure { front, nearer, below, clear, sided, behind, cut_near, cut_far: clear & sided & through, never }
    }

    #[inline(always)]
    fn between(&self, [a, b, c]: &[[Eight; 3]; 3], rounding: Eight) -> [Mask; 3] {
        match self.far {
            Far::Plane { axis, range: [nearest, most], out: [behind, beyond], .. } => {
                let [a, b, c] = [dot(axis, a), dot(axis, b), dot(axis, c)];
                let (low, high) = (a.min(b).min(c) - rounding, a.max(b).max(c) + rounding);
                let (front, nearer) = (Eight::all(nearest).below(low), high.below(Eight::all(most)));
                let out = high.below(Eight::all(behind)).or(Eight::all(beyond).below(low));
                [front, nearer, out]
            }
            Far::Ball { axis, reach, most } => {
                let away = length(axis, a).max(length(axis, b)).max(length(axis, c));
                let spread = away * Eight::all(reach * (1.0 + ROUNDING))
                    + rounding * Eight::all(axis.abs().element_sum());
                let [a, b, c] = [dot(axis, a), dot(axis, b), dot(axis, c)];
                let (low, high) = (a.min(b).min(c) - spread, a.max(b).max(c) + spread);
                let (zero, most) = (Eight::all(0.0), Eight::all(most));
                let behind = (high + Eight::all(reach * reach)).below(zero);
                [zero.below(low), high.below(most), behind]
            }
        }
    }
}

#[inline(always)]
fn dot(n: Vec3, v: &[Eight; 3]) -> Eight {
    Eight::all(n.x) * v[0] + Eight::all(n.y) * v[1] + Eight::all(n.z) * v[2]
}

#[inline(always)]
fn abs(v: &[Eight; 3]) -> [Eight; 3] {
    [v[0].abs(), v[1].abs(), v[2].abs()]
}

/// Of the sum.
#[inline(always)]
fn length(n: Vec3, v: &[Eight; 3]) -> Eight {
    let s = [v[0] + Eight::all(n.x), v[1] + Eight::all(n.y), v[2] + Eight::all(n.z)];
    (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]).sqrt()
}

#[inline(always)]
fn sub(a: &[Eight; 3], b: &[Eight; 3]) -> [Eight; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
