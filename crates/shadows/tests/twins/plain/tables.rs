//! Kernel tables and laws for the twins. Tables are data: they are read out of the shaders that
//! carry them; their properties are tested where they are made.

use crate::support;
use crate::twins::approx::Approx;
use crate::twins::light::Light;
use std::sync::LazyLock;
use umbrage_shadows::Calibration;

/// Points listed as `vec2(x, y)` in a text.
fn points_in(source: &str) -> Vec<[f64; 2]> {
    let pairs = source.split("vec2(").filter_map(|part| part.split(')').next()?.split_once(", "));
    let number = |text: &str| text.trim().parse::<f64>().ok();
    pairs.filter_map(|(x, y)| Some([number(x)?, number(y)?])).collect()
}

/// The first of the second document's points.
pub(crate) fn poisson(count: usize) -> Vec<[f64; 2]> {
    static ALL: LazyLock<Vec<[f64; 2]>> =
        LazyLock::new(|| points_in(include_str!("../../../src/wgsl/kernel_poisson.wgsl")));
    assert_eq!(ALL.len(), 64);
    ALL[..count].to_vec()
}

/// Jimenez's eight.
pub(crate) fn spiral() -> Vec<[f64; 2]> {
    let all = points_in(include_str!("../../../src/wgsl/kernel_spiral.wgsl"));
    assert_eq!(all.len(), 8);
    all
}

/// Best-candidate points, out of the shader of the variant that uses them.
pub(crate) fn blue(count: usize) -> Vec<[f64; 2]> {
    static TABLES: [LazyLock<Vec<[f64; 2]>>; 2] =
        [LazyLock::new(|| blue_of(16)), LazyLock::new(|| blue_of(32))];
    TABLES[usize::from(count == 32)].to_vec()
}

fn blue_of(count: usize) -> Vec<[f64; 2]> {
    let name = format!("pcf-blue-{count}-ign");
    let id = support::variant_id(&name, Calibration::LightMatched);
    let recording = support::recording_of(id, 256);
    let umbrage_shadows::Pass::Compute(last) = recording.passes.last().expect("passes") else {
        panic!("the last pass computes")
    };
    let all = last.shader.iter().find(|f| f.name.starts_with("kernel_blue")).map(|f| points_in(&f.source));
    let all = all.expect("a table");
    assert_eq!(all.len(), count);
    all
}

/// Ratio (z - b) / b at which listing 4 saturates: 80 r^2 = 1.
const SATURATES: f64 = 0.111_803_398_874_989_5;

/// Kernel radius for depths of receiver and blocker: the shape of a law, scaled to .002 map widths
/// where listing 4 saturates, or to the light's cone at the reference gap.
pub(crate) fn law(name: &str, light: &Light, calibration: Calibration) -> impl Fn(f64, f64) -> f64 + use<> {
    // The listing's near plane is fitted to the nearest geometry.
    let near = 0.999 * light.nearest.value;
    let name = name.to_owned();
    let shape = move |z: f64, b: f64| match name.as_str() {
        "chss-squared" => ((z - b) / b).powi(2),
        "chss-linear" => (z - b) / b,
        "chss-plane" => (z - b) / z,
        "chss-distance" => z - b,
        "pcss-listing" => (z - b) / (b - near),
        _ => panic!("{name} has no law of its own"),
    };
    let z = light.eye_distance.value;
    let (b, radius) = match calibration {
        Calibration::AsPrinted => (z / (1.0 + SATURATES), 0.002),
        Calibration::LightMatched => {
            let b = (z - light.reference_gap.value).max(light.nearest.value);
            (b, light.cone(Approx::exact(z), Approx::exact(b)).value)
        }
    };
    let scale = radius / shape(z, b);
    move |z, b| scale * shape(z, b)
}
