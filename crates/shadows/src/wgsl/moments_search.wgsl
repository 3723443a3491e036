// Mean depth of the blockers in a square, from its moments alone (Yang et al. 2010; third seed
// document): the mean is p z + (1 - p) b, p being the lit share. Negative where hardly anything
// blocks. Searches are SEARCH_SCALE times as wide as the largest kernel.
override SEARCH_SCALE: f32;

fn moments_blocker(s: ShadowPoint) -> f32 {
    let width = 2.0 * SEARCH_SCALE * search_radius_uv(s.depth) * f32(globals.map_size);
    let m = moments_over(s.uv, width);
    let depth = moment_depth(reference_depth(s, vec2(0.0)));
    let lit = upper_bound(m, depth);
    if lit > 0.99 {
        return -1.0;
    }
    // Far from a pair of depths the formula may point before everything that there is.
    let blocker = (m.x - lit * depth) / (1.0 - lit);
    return max(moment_centre() + globals.far * blocker, globals.nearest_blocker);
}
