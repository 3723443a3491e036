//! Single formulas, read out of the pipeline's own fragments by a probe in place of the last pass.

use crate::case::{Case, MAP_TEXELS, Ran};
use crate::support::edited::probe;
use crate::support::{still_life, variant_id};
use crate::twins::approx::Approx;
use crate::twins::light::{Law, Point};
use crate::twins::pattern::{Pattern, vogel};
use umbrage_scene::AreaLight;
use umbrage_shadows::{Bias, Calibration, ConstantBias, ReceiverPlane, Seeding};

/// The values of a probe with the pixels that they belong to, where a surface is seen.
fn seen(ran: &Ran) -> impl Iterator<Item = ([u32; 2], f32)> {
    let pixel = |index: usize| [index as u32 % still_life::SIZE.0, index as u32 / still_life::SIZE.0];
    let all = ran.values.iter().enumerate().map(move |(index, &value)| (pixel(index), value));
    all.filter(|(pixel, _)| ran.surface(*pixel).is_some())
}

fn probed(body: &'static str, calibration: Calibration, light: AreaLight) -> Case {
    Case::new(probe(variant_id("chss", calibration), body), light)
}

/// Distance round a circle of length 1.
fn round(a: f64, b: f64) -> f64 {
    let apart = (a - b).rem_euclid(1.0);
    apart.min(1.0 - apart)
}

#[test]
fn gradient_noise_and_its_seedings() {
    for seeding in [Seeding::Fresh, Seeding::Frozen, Seeding::Animated] {
        for [frame, seed] in [[0, 0], [1, 0], [63, 2], [64, 2]] {
            let case =
                probed("return pattern(r.place, r.position);", Calibration::LightMatched, still_life::sun());
            let ran = Case { seeding, pattern: [frame, seed], ..case }.run();
            let twin = Pattern { seeding, frame, seed, pass: 0 };
            for (pixel, value) in seen(&ran) {
                let turns = twin.turns(pixel);
                // The noise magnifies the rounding of its argument 53 times: at most 4e-4 turns.
                assert!(turns.error < 5e-4 || turns.error > 1.0, "{pixel:?}: {turns:?}");
                let apart = round(value.into(), turns.value);
                assert!(apart <= turns.error, "{seeding:?} {frame} {seed} {pixel:?}: {value}, {turns:?}");
            }
        }
    }
}

#[test]
fn vogels_disc() {
    // Columns choose the tap, rows the angle; x and y in turn.
    let body = "let k = kernel_tap(u32(r.place.x) % 32u, 32u, turn_of(0.125 * floor(r.place.y))); \
                return select(k.x, k.y, u32(r.place.y) % 2u == 1u);";
    let ran = probed(body, Calibration::LightMatched, still_life::sun()).run();
    for (pixel, value) in seen(&ran) {
        let tap = vogel(pixel[0] % 32, 32, Approx::exact(0.125 * f64::from(pixel[1])));
        let [x, y] = tap;
        let expected = if pixel[1] % 2 == 1 { y } else { x };
        // An angle of up to 80 radians: f32 keeps it to 4e-6, three times over.
        assert!(expected.error < 4e-5 && expected.admits(value), "{pixel:?}: {value}, {expected:?}");
    }
}

/// A bias that uses all three kinds.
const EVERY_BIAS: Bias = Bias {
    constant: ConstantBias::World(0.003),
    normal_offset_texels: 1.3,
    receiver_plane: ReceiverPlane::On { max_slope: 5.0 },
};

/// Every pixel's probe against a formula of the twin's receiver.
fn check_points(case: Case, expected: impl Fn(&Ran, &Point, [u32; 2]) -> Approx) {
    let ran = case.run();
    let light = ran.light();
    for (pixel, value) in seen(&ran) {
        let receiver = ran.surface(pixel).expect("seen");
        let point = light.point((receiver.position, receiver.normal), &ran.case.bias);
        let expected = expected(&ran, &point.expect("before the light"), pixel);
        assert!(expected.admits(value), "{:?} {pixel:?}: {value}, {expected:?}", ran.case);
    }
}

fn both_lights() -> [AreaLight; 2] {
    [still_life::sun(), still_life::sphere()]
}

#[test]
fn projection_slope_and_reference() {
    // Columns choose the quantity.
    let body = "let s = shadow_point(r.position, r.normal); \
                let all = array(s.uv.x, s.uv.y, s.depth, s.slope.x, s.slope.y, \
                reference_depth(s, vec2(0.25, 0.5) - s.uv)); return all[u32(r.place.x) % 6u];";
    for light in both_lights() {
        let case = Case { bias: EVERY_BIAS, ..probed(body, Calibration::LightMatched, light) };
        check_points(case, |ran, point, pixel| {
            let centre = [Approx::exact(0.25), Approx::exact(0.5)];
            let reference = ran.light().reference(point, centre, &ran.case.bias);
            let all = [point.uv[0], point.uv[1], point.depth, point.slope[0], point.slope[1], reference];
            // A place in the map is known to a thirtieth of a texel, also far outside of it: a half
            // one would show.
            assert!(all[0].error * f64::from(MAP_TEXELS) < 0.03, "{:?}", all[0]);
            all[pixel[0] as usize % 6]
        });
    }
}

#[test]
fn penumbra_laws() {
    // Rows choose the blocker, columns the quantity.
    let body = "let s = shadow_point(r.position, r.normal); let b = s.depth * 0.03125 * floor(r.place.y % 32.0 + 1.0); \
                let all = array(search_radius_uv(s.depth), kernel_radius_uv(s.depth, b), fixed_radius_uv(s.depth)); \
                return all[u32(r.place.x) % 3u];";
    for light in both_lights() {
        for calibration in Calibration::ALL {
            check_points(probed(body, calibration, light), |ran, point, [x, y]| {
                let share = Approx::exact(0.03125 * f64::from(y % 32 + 1));
                let (light, z) = (ran.light(), point.depth);
                let law = Law { light: &light, calibration };
                [law.search(z), law.kernel(z, z * share), law.fixed(z)][x as usize % 3]
            });
        }
    }
}

#[test]
fn blocker_search() {
    let body = "let s = shadow_point(r.position, r.normal); return mean_blocker(s, 0.02, 1.5);";
    for light in both_lights() {
        let ran = probed(body, Calibration::LightMatched, light).run();
        let light = ran.light();
        let map =
            crate::twins::map::Map { light: &light, depths: ran.image("shadow-map"), bias: ran.case.bias };
        let (mut clear, mut found) = (0, 0);
        for (pixel, value) in seen(&ran) {
            let receiver = ran.surface(pixel).expect("seen");
            let point = light.point((receiver.position, receiver.normal), &ran.case.bias).expect("before it");
            let disc = (Approx::constant(0.02), Approx::exact(1.5));
            let Some(means) = map.blockers(&point, disc, 32) else { continue };
            // A search without a blocker says -1.
            let admits = |m: &Option<Approx>| m.map_or(value == -1.0, |m| m.admits(value));
            assert!(means.iter().any(admits), "{pixel:?}: {value} is none of {means:?}");
            clear += usize::from(means.len() == 1);
            found += usize::from(value > 0.0);
        }
        // Enough of both, or nothing was tested.
        assert!(clear > 2000 && found > 300, "{clear} clear, {found} with blockers");
    }
}
