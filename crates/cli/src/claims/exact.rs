//! Numbers that follow from a definition: no picture, no interval.

/// Their names.
pub(crate) const NAMES: [&str; 4] = ["vogel_radii", "ign_neighbours", "chebyshev_worst", "lbr_threshold"];

/// The number of this name; NaN for another.
pub(crate) fn value(name: &str) -> f64 {
    match name {
        "vogel_radii" => vogel_radii(),
        "ign_neighbours" => ign_neighbours([1, 4]) / ign_neighbours([1, 1]) - 1.0,
        "chebyshev_worst" => chebyshev_worst(),
        "lbr_threshold" => lbr_threshold(),
        _ => f64::NAN,
    }
}

/// Smallest gap between the radii of two points of a Vogel set, over the larger one, for up to 64
/// points. A rotation maps each point onto one of its own radius: where no two radii are equal, each
/// point must stay, which only a full turn does.
fn vogel_radii() -> f64 {
    let radius = |i: u32, count: u32| ((f64::from(i) + 0.5) / f64::from(count)).sqrt();
    let gaps = (2..=64).flat_map(|n| (1..n).map(move |i| 1.0 - radius(i - 1, n) / radius(i, n)));
    gaps.fold(f64::INFINITY, f64::min)
}

/// Interleaved gradient noise at a pixel.
fn ign(x: f64, y: f64) -> f64 {
    (52.982_918_9 * (0.067_110_56 * x + 0.005_837_15 * y).fract()).fract()
}

/// Root mean square error of the mean of a missing checkerboard pixel's four neighbours, each of which
/// says whether its noise lies below a threshold. `scale` multiplies the frame's coordinates, as
/// listing 7 does.
fn ign_neighbours(scale: [u32; 2]) -> f64 {
    const SIDE: u32 = 64;
    const THRESHOLDS: u32 = 32;
    let at = |c: u32, scale: u32| (f64::from(c) + 0.5) * f64::from(scale);
    let noise = |x: u32, y: u32| ign(at(x, scale[0]), at(y, scale[1]));
    let (mut squared, mut count) = (0.0, 0u32);
    for threshold in (0..THRESHOLDS).map(|t| (f64::from(t) + 0.5) / f64::from(THRESHOLDS)) {
        for y in 1..=SIDE {
            for x in (1..=SIDE).filter(|x| (x + y).is_multiple_of(2)) {
                let neighbours = [(x, y - 1), (x, y + 1), (x - 1, y), (x + 1, y)];
                let below = neighbours.iter().filter(|&&(x, y)| noise(x, y) < threshold).count();
                squared += (below as f64 / 4.0 - threshold).powi(2);
                count += 1;
            }
        }
    }
    (squared / f64::from(count)).sqrt()
}

/// The leak of Chebyshev's bound behind occluders at 0 (covering a share `p`) and at 1, for a
/// receiver at `t` > 1: the true visibility is 0.
fn leak(p: f64, t: f64) -> f64 {
    let (mean, variance) = (1.0 - p, p * (1.0 - p));
    variance / (variance + (t - mean).powi(2))
}

/// The largest leak over coverage, by golden-section search (it has one maximum).
fn worst_leak(t: f64) -> f64 {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..80 {
        let (left, right) = (high - golden * (high - low), low + golden * (high - low));
        if leak(left, t) < leak(right, t) { low = left } else { high = right }
    }
    leak(0.5 * (low + high), t)
}

/// Largest relative distance of the worst leak from 1/(2t-1)^2 over the rig's stairs.
fn chebyshev_worst() -> f64 {
    let off = |t: f64| (worst_leak(t) * (2.0 * t - 1.0).powi(2) - 1.0).abs();
    [1.1, 1.25, 1.5, 2.0, 3.0].into_iter().map(off).fold(0.0, f64::max)
}

/// Smallest t at which the worst leak is at most .2, which linstep(.2, 1) takes to 0.
fn lbr_threshold() -> f64 {
    let (mut low, mut high) = (1.0 + 1e-9, 8.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if worst_leak(middle) > 0.2 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn closed_forms_come_out() {
        assert!(chebyshev_worst() < 1e-9);
        // 1/(2t-1)^2 = 1/5 at t = (1 + sqrt 5) / 2.
        assert!((lbr_threshold() - 0.5 * (1.0 + 5f64.sqrt())).abs() < 1e-6);
    }

    #[test]
    fn no_rotation_maps_a_vogel_set_onto_itself() {
        let count = 16;
        let point = |i: u32, turn: f64| {
            let (r, angle) = (((f64::from(i) + 0.5) / f64::from(count)).sqrt(), 2.4 * f64::from(i) + turn);
            [r * angle.cos(), r * angle.sin()]
        };
        let distance = |turn: f64| {
            let nearest = |p: [f64; 2]| {
                let to = |q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
                (0..count).map(|j| to(point(j, 0.0))).fold(f64::INFINITY, f64::min)
            };
            (0..count).map(|i| nearest(point(i, turn))).fold(0.0, f64::max)
        };
        // The outermost point moves at most as far as the angle: steps of a milliradian miss at most
        // half of one.
        let least = (50..6233).map(|step| distance(1e-3 * f64::from(step))).fold(f64::INFINITY, f64::min);
        assert!(least > 0.04 && distance(TAU) < 1e-12, "{least}");
        assert!(vogel_radii() > 0.007, "64 points: 1 - sqrt(62.5 / 63.5)");
    }

    #[test]
    fn stretched_noise_fills_thresholds_better() {
        // The project's own pre-check, on another range of pixels: .171 for .227.
        let ratio = value("ign_neighbours");
        assert!((ratio - (0.171 / 0.227 - 1.0)).abs() < 0.03, "{ratio}");
    }
}
