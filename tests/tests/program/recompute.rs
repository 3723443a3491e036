//! `chss-mask/light-matched` in plain f64 from dumped targets and matrices alone, as somebody would
//! write it who has only the first seed document, the EXR files and the JSON beside them.

use glam::{DMat4, DVec2, DVec3};
use std::path::Path;
use umbrage_frame::{Image, read_exr};

/// How far f32 on the GPU may put a tap from where f64 puts it, in texels of a 512 map over 30 m:
/// positions of 20 m carry 1e-6 of their size through four matrices (1e-4 m, 2e-3 texels), angles
/// 2e-5 of a turn from the pattern (1e-3 texels at a radius of 8).
pub(crate) const DRIFT_TEXELS: f64 = 4e-3;

/// Depths closer than this, metres, may compare either way: two roundings at 40 m and the drift.
const CLOSE_WORLD: f64 = 1e-4;

const SEARCH_TAPS: u32 = 32;
const SEARCH_SCALE: f64 = 1.2;
const FILTER_TAPS: u32 = 16;
const MASK_STEP: u32 = 4;

/// Everything that `render --dump` wrote for one frame.
pub(crate) struct Dump {
    pub(crate) visibility: Image<f32>,
    pub(crate) mask: Image<f32>,
    pub(crate) blurred: Image<f32>,
    map: Image<f32>,
    depth: Image<f32>,
    normal: [Image<f32>; 3],
    world_from_camera: DMat4,
    light_from_world: DMat4,
    half_extent: DVec2,
    scale: f64,
    light_size: f64,
    nearest_blocker: f64,
    bias: Bias,
}

/// As the JSON has it.
struct Bias {
    constant_world: f64,
    normal_offset_texels: f64,
    max_slope: f64,
}

/// What the filter finds.
pub(crate) enum Taps {
    /// Their lit share.
    Lit(f64),
    /// A compare that f32 may decide otherwise.
    Unclear,
}

/// A receiver as the light sees it.
struct ShadowPoint {
    uv: DVec2,
    depth: f64,
    /// Metres of depth per map width.
    slope: DVec2,
}

impl Dump {
    /// Reads the files.
    pub(crate) fn read(folder: &Path, stem: &str, matrices: &str) -> Self {
        let layers = |target: &str| read_exr(&folder.join(format!("{stem}{target}.exr"))).expect("a target");
        let only = |target: &str| layers(target).remove(0).1;
        let depth = only(".camera-depth");
        let normals = layers(".camera-normal");
        let axis = |name: &str| normals.iter().find(|l| l.0 == name).expect("an axis").1.clone();
        let text = std::fs::read_to_string(folder.join(matrices)).expect("matrices");
        let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let number = |key: &str| json[key].as_f64().unwrap_or_else(|| panic!("no {key}"));
        let bias =
            |key: &str| json["bias"]["light-matched"][key].as_f64().unwrap_or_else(|| panic!("no {key}"));
        let matrix = |key: &str| {
            let columns = json[key].as_array().unwrap_or_else(|| panic!("no {key}")).iter();
            let columns: Vec<f64> = columns.map(|v| v.as_f64().expect("a number")).collect();
            DMat4::from_cols_slice(&columns)
        };
        let tan = (0.5 * number("yfov_radians")).tan();
        Self {
            visibility: only(""),
            mask: only(".penumbra-mask"),
            blurred: only(".penumbra-mask-blurred"),
            map: only(".shadow-map"),
            normal: [axis("normal.X"), axis("normal.Y"), axis("normal.Z")],
            world_from_camera: matrix("camera_from_world").inverse(),
            light_from_world: matrix("light_from_world"),
            half_extent: DVec2::new(tan * f64::from(depth.width()) / f64::from(depth.height()), tan),
            scale: number("map_widths_per_metre_or_slope"),
            light_size: number("light_size"),
            nearest_blocker: number("nearest_blocker_metres"),
            bias: Bias {
                constant_world: bias("constant_metres"),
                normal_offset_texels: bias("normal_offset_texels"),
                max_slope: bias("receiver_plane_max_slope"),
            },
            depth,
        }
    }

    /// Kernel radius in map widths per metre between blocker and receiver.
    pub(crate) fn radius_per_gap(&self) -> f64 {
        self.light_size * self.scale
    }

    /// The blocker search of a mask texel: its kernel radius; none where f32 may decide otherwise.
    pub(crate) fn searched_radius(&self, x: u32, y: u32) -> Option<f64> {
        let last = [self.depth.width() - 1, self.depth.height() - 1];
        let middle = |k: u32, last: u32| (k * MASK_STEP + MASK_STEP / 2).min(last);
        let Some(s) = self.shadow_point(middle(x, last[0]), middle(y, last[1])) else { return Some(0.0) };
        let angle = std::f64::consts::TAU * interleaved_gradient_noise(x, y);
        let radius = SEARCH_SCALE * self.radius_per_gap() * (s.depth - self.nearest_blocker).max(0.0);
        let (mut sum, mut count) = (0.0, 0);
        for i in 0..SEARCH_TAPS {
            if let Some(blocker) = self.blocker(&s, radius * vogel(i, SEARCH_TAPS, angle))? {
                sum += blocker;
                count += 1;
            }
        }
        let gap = if count == 0 { 0.0 } else { (s.depth - sum / f64::from(count)).max(0.0) };
        Some(gap * self.radius_per_gap())
    }

    /// The filter at a pixel.
    pub(crate) fn filtered(&self, x: u32, y: u32) -> Taps {
        let Some(s) = self.shadow_point(x, y) else { return Taps::Lit(1.0) };
        let place = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) / f64::from(MASK_STEP);
        let radius = bilinear(&self.blurred, place);
        let angle = std::f64::consts::TAU * interleaved_gradient_noise(x, y);
        let taps = (0..FILTER_TAPS).map(|i| self.lit(&s, radius * vogel(i, FILTER_TAPS, angle)));
        let sum: Option<f64> = taps.sum();
        sum.map_or(Taps::Unclear, |sum| Taps::Lit(sum / f64::from(FILTER_TAPS)))
    }

    /// The surface at a pixel centre, in the light's map; none where nothing is seen.
    fn shadow_point(&self, x: u32, y: u32) -> Option<ShadowPoint> {
        let depth = f64::from(*self.depth.at(x, y));
        if depth <= 0.0 {
            return None;
        }
        let size = DVec2::new(f64::from(self.depth.width()), f64::from(self.depth.height()));
        let ndc = (DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) / size - 0.5) * DVec2::new(2.0, -2.0);
        let camera = (ndc * self.half_extent).extend(-1.0) * depth;
        let world = self.world_from_camera.transform_point3(camera);
        let normal = DVec3::from_array([0, 1, 2].map(|k| f64::from(*self.normal[k].at(x, y)))).normalize();
        let n = self.light_from_world.transform_vector3(normal);
        // Along the normal, by texels times the sine between normal and light.
        let texel_world = 1.0 / (self.scale * self.texels());
        let offset = normal * (self.bias.normal_offset_texels * texel_world * n.truncate().length());
        let p = self.light_from_world.transform_point3(world + offset);
        let tilt = DVec2::new(n.x, -n.y) / n.z.max(1e-6);
        let followed = tilt * (self.bias.max_slope / tilt.length().max(1e-12)).min(1.0);
        let uv = DVec2::new(p.x, -p.y) * self.scale + 0.5;
        Some(ShadowPoint { uv, depth: -p.z, slope: followed / self.scale })
    }

    fn texels(&self) -> f64 {
        f64::from(self.map.width())
    }

    /// Depth of a texel and the receiver plane's there; none outside the map.
    fn pair(&self, s: &ShadowPoint, texel: DVec2) -> Option<(f64, f64)> {
        if texel.min_element() < 0.0 || texel.max_element() >= self.texels() {
            return None;
        }
        let stored = f64::from(*self.map.at(texel.x as u32, texel.y as u32));
        let offset = (texel + 0.5) / self.texels() - s.uv;
        Some((stored, s.depth + s.slope.dot(offset) - self.bias.constant_world))
    }

    /// How far compares must be apart to be beyond doubt: the drift times the plane's slope is added.
    fn close(&self, s: &ShadowPoint) -> f64 {
        CLOSE_WORLD + s.slope.length() * DRIFT_TEXELS / self.texels()
    }

    /// The blocker's depth at a tap, if something blocks there; none where that is in doubt: the
    /// tap's neighbourhood of a few thousandths of a texel must agree.
    fn blocker(&self, s: &ShadowPoint, offset: DVec2) -> Option<Option<f64>> {
        let place = (s.uv + offset) * self.texels();
        let mut found: Option<Option<f64>> = None;
        for (dx, dy) in [(0.0, 0.0), (-1.0, 0.0), (1.0, 0.0), (0.0, -1.0), (0.0, 1.0)] {
            let texel = (place + DVec2::new(dx, dy) * DRIFT_TEXELS).floor();
            let here = match self.pair(s, texel) {
                Some((stored, reference)) if (stored - reference).abs() < self.close(s) => return None,
                Some((stored, reference)) if stored < reference => Some(stored),
                _ => None,
            };
            if found.is_some_and(|found| found != here) {
                return None;
            }
            found = Some(here);
        }
        found
    }

    /// Four compares, bilinearly weighted; none where one is in doubt.
    fn lit(&self, s: &ShadowPoint, offset: DVec2) -> Option<f64> {
        let uv = s.uv + offset;
        let place = uv * self.texels() - 0.5;
        let (base, weight) = (place.floor(), place - place.floor());
        let mut lit = 0.0;
        for (corner, share) in [
            (DVec2::new(0.0, 0.0), (1.0 - weight.x) * (1.0 - weight.y)),
            (DVec2::new(1.0, 0.0), weight.x * (1.0 - weight.y)),
            (DVec2::new(0.0, 1.0), (1.0 - weight.x) * weight.y),
            (DVec2::new(1.0, 1.0), weight.x * weight.y),
        ] {
            // The edge of the map is nowhere near the picture: beyond it this says nothing.
            let (stored, reference) = self.pair(s, base + corner)?;
            if (stored - reference).abs() < self.close(s) {
                return None;
            }
            lit += if reference <= stored { share } else { 0.0 };
        }
        Some(lit)
    }
}

/// Listing 1 of the first document; unit radius.
fn vogel(i: u32, count: u32, angle: f64) -> DVec2 {
    let radius = ((f64::from(i) + 0.5) / f64::from(count)).sqrt();
    let theta = f64::from(i) * 2.4 + angle;
    radius * DVec2::new(theta.cos(), theta.sin())
}

/// Listing 2, at a pixel centre, 0 to 1. In f32: its large factor is meant to amplify roundings.
fn interleaved_gradient_noise(x: u32, y: u32) -> f64 {
    let inner = (x as f32 + 0.5) * 0.067_110_56 + (y as f32 + 0.5) * 0.005_837_15;
    f64::from((52.982_918 * inner.fract()).fract())
}

/// Between the centres of four texels, clamped at the border.
fn bilinear(image: &Image<f32>, place: DVec2) -> f64 {
    let (base, weight) = ((place - 0.5).floor(), (place - 0.5) - (place - 0.5).floor());
    let at = |dx: f64, dy: f64| {
        let x = (base.x + dx).clamp(0.0, f64::from(image.width() - 1));
        let y = (base.y + dy).clamp(0.0, f64::from(image.height() - 1));
        f64::from(*image.at(x as u32, y as u32))
    };
    let row = |dy: f64| at(0.0, dy) * (1.0 - weight.x) + at(1.0, dy) * weight.x;
    row(0.0) * (1.0 - weight.y) + row(1.0) * weight.y
}
