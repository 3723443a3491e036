// The shadow map's texels as patches that hide a part of the light's disc (Guennebaud et al. 2006).
// The law's kernel for a depth is the light's cone there: a place at that depth, divided by the
// cone's radius, is the place on the light's unit disc that it hides.
override SEARCH_CELLS: i32;

// A grid of cells of `stride` x `stride` texels, fixed to the map.
struct Cells {
    first: vec2<i32>,
    count: vec2<i32>,
    stride: i32,
}

// The cells that the widest cone meets, SEARCH_CELLS a side at most.
fn cells_of(s: ShadowPoint) -> Cells {
    let size = f32(globals.map_size);
    let radius = search_radius_uv(s.depth);
    let stride = max(1, i32(ceil(2.0 * radius * size / f32(SEARCH_CELLS - 1))));
    let first = vec2<i32>(floor((s.uv - radius) * size / f32(stride)));
    let last = vec2<i32>(floor((s.uv + radius) * size / f32(stride)));
    return Cells(first, min(last - first + 1, vec2(SEARCH_CELLS)), stride);
}

// The rectangle of the light's disc that a cell hides: lower and upper corner, or nothing (lower
// above upper). Its middle texel's depth counts for all of it.
fn patch_of(s: ShadowPoint, cells: Cells, k: i32) -> vec4<f32> {
    let nothing = vec4(1.0, 1.0, -1.0, -1.0);
    let size = f32(globals.map_size);
    let cell = (cells.first + vec2(k % cells.count.x, k / cells.count.x)) * cells.stride;
    let texel = vec2<f32>(cell + cells.stride / 2);
    if !inside_map((texel + 0.5) / size) {
        return nothing;
    }
    let pair = nearest_pair(s, (texel + 0.5) / size - s.uv);
    if !(pair.x < pair.y) {
        return nothing;
    }
    let cone = max(kernel_radius_uv(s.depth, pair.x), 1e-9);
    let low = (vec2<f32>(cell) / size - s.uv) / cone;
    let high = (vec2<f32>(cell + cells.stride) / size - s.uv) / cone;
    return vec4(low, high);
}
