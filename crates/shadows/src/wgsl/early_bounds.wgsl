// What the pyramid's bounds say of a receiver before its search (T19): no error is allowed here.

// How far from a tap the centre of a texel lies that it compares (bilinear: less than 1), and a half
// for whatever rounding puts a tap beyond its disc.
const FOOTPRINT_TEXELS: f32 = 1.5;

// What all taps of search and filter find, if it is the same.
const UNDECIDED: u32 = 0u;
const ALL_LIT: u32 = 1u;
const ALL_DARK: u32 = 2u;

struct EarlyOut {
    verdict: u32,
    fetches: u32,
}

// `radius_uv` is that of the search, in whose disc the filter stays unless it says otherwise.
fn early_out(s: ShadowPoint, radius_uv: f32) -> EarlyOut {
    let half_side = radius_uv + FOOTPRINT_TEXELS / f32(globals.map_size);
    let bounds = map_bounds(s.uv, half_side);
    let references = reference_bounds(s, half_side);
    if references.y <= bounds.depths.x {
        return EarlyOut(ALL_LIT, bounds.fetches);
    }
    // No kernel is wider than that of the nearest depth. Its taps lie within 0.985 of its radius.
    let widest = kernel_radius_uv(s.depth, bounds.depths.x);
    if bounds.inside && bounds.depths.y < references.x && widest <= 1.001 * radius_uv {
        return EarlyOut(ALL_DARK, bounds.fetches);
    }
    return EarlyOut(UNDECIDED, bounds.fetches);
}

// Least and largest depth that a texel of the square is compared with. Under either light the
// plane's depth is monotone along its slope: its extremes lie at the corners along it.
fn reference_bounds(s: ShadowPoint, half_side: f32) -> vec2<f32> {
    let corner = half_side * sign(s.slope);
    let ends = vec2(reference_depth(s, corner), reference_depth(s, -corner));
    // Roundings of a reference: some ten of 6e-8, which the inverse of a perspective map's 1/depth
    // magnifies by the ratio of the depths.
    let magnified = 1.0 + abs(ends) / s.depth;
    let slack = 2.0e-6 * max(abs(ends), vec2(s.depth)) * magnified;
    return vec2(min(ends.x - slack.x, ends.y - slack.y), max(ends.x + slack.x, ends.y + slack.y));
}
