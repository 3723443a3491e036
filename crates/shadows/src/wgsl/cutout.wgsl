// Cut-out surfaces: one is there where the bit of its texel is set, the texel at floor(uv * size), as
// truth reads it. A mask is its width, height and wraps (u, then v in the next byte), then its bits.
@group(0) @binding(12) var<storage, read> cutouts: array<u32>;

const CLAMP = 1u;
const MIRROR = 2u;

// The texel that stands for one beyond the edge.
fn wrapped(at: i32, size: i32, wrap: u32) -> u32 {
    if wrap == CLAMP {
        return u32(clamp(at, 0, size - 1));
    }
    let period = select(size, 2 * size, wrap == MIRROR);
    let rest = at % period;
    let inside = select(rest, rest + period, rest < 0);
    return u32(min(inside, 2 * size - 1 - inside));
}

fn is_there(uv: vec2<f32>, mask: u32) -> bool {
    let size = vec2<i32>(i32(cutouts[mask]), i32(cutouts[mask + 1u]));
    let wraps = cutouts[mask + 2u];
    let at = vec2<i32>(floor(uv * vec2<f32>(size)));
    let x = wrapped(at.x, size.x, wraps & 0xffu);
    let y = wrapped(at.y, size.y, wraps >> 8u);
    let texel = y * u32(size.x) + x;
    return (cutouts[mask + 3u + texel / 32u] >> (texel % 32u) & 1u) != 0u;
}
