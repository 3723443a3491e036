// The lines that edges are on the rows, and which rows they may touch (scanlines/outline.rs).

// x = slope y + at in the rows' coordinates, and whether the inside is to the right.
struct Line {
    slope: f32,
    at: f32,
    left: bool,
}

fn line_of(turn: vec4<f32>, e: vec3<f32>) -> Line {
    let x = e.x * turn.x + e.y * turn.z;
    let y = e.x * turn.y + e.y * turn.w;
    // An edge along the rows becomes one that all but is.
    let wide = max(abs(x), 1e-12 * (abs(y) + abs(e.z)) + SMALLEST);
    let per = select(-1.0, 1.0, (bitcast<u32>(x) >> 31u) != 0u) / wide;
    return Line(y * per, e.z * per, per < 0.0);
}

// The rows that may be touched: the first, and the one after the last.
fn rows_of(s: Sight, seen: Seen, turn: vec4<f32>) -> vec2<u32> {
    let depths = vec3<f32>(seen.a.z, seen.b.z, seen.c.z);
    let xs = vec3<f32>(seen.a.x, seen.b.x, seen.c.x);
    let ys = vec3<f32>(seen.a.y, seen.b.y, seen.c.y);
    let nearest = min(depths.x, min(depths.y, depths.z));
    let farthest = max(depths.x, max(depths.y, depths.z));
    if !(nearest > 1e-6 * farthest) {
        return vec2<u32>(0u, ALL_ROWS);
    }
    let at = (turn.w * ys - turn.z * xs) / depths;
    return rows_between(s, min(at.x, min(at.y, at.z)), max(at.x, max(at.y, at.z)));
}

// The rows that may be between two places across them.
fn rows_between(s: Sight, lowest: f32, highest: f32) -> vec2<u32> {
    var low = lowest;
    var high = highest;
    if CONE {
        low = min(low, low * s.cone.w);
        high = max(high, high * s.cone.w);
    }
    let half = 0.5 * f32(BASE_ROWS);
    let middle = half + f32(ALL_ROWS - BASE_ROWS) * 0.5;
    // Row j of a replicate stands between j and j + 1.
    let first = low * half + (middle - 1.0 - MARGIN * half);
    let last = high * half + (middle + 1.0 + MARGIN * half);
    let span = floor(clamp(vec2<f32>(first, last), vec2<f32>(0.0), vec2<f32>(255.0)));
    return min(vec2<u32>(span), vec2<u32>(ALL_ROWS));
}
