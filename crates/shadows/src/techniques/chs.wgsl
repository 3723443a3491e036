// Contact hardening shadows over a pyramid (T18): search and filter read 8x8 texels each, of the
// level on which these span the disc. A texel's weight is about its share of the disc.

// Most texels from the centre to the disc's border, so that 8x8 hold all of it.
override REACH_TEXELS: f32;
// Radius of the search over the largest kernel's.
override SEARCH_SCALE: f32;

struct Block {
    level: u32,
    // Texels of the level: the receiver's place, the first texel, the disc's radius.
    place: vec2<f32>,
    first: vec2<f32>,
    radius: f32,
}

fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let blocker = mean_blocker_block(s, block_of(s, SEARCH_SCALE * search_radius_uv(s.depth)));
    if blocker < 0.0 {
        return filter_block(s, block_of(s, 0.0));
    }
    return filter_block(s, block_of(s, kernel_radius_uv(s.depth, blocker)));
}

// The finest level on which a disc's radius is no more than REACH_TEXELS.
fn block_of(s: ShadowPoint, radius_uv: f32) -> Block {
    let coarsest = textureNumLevels(mean_depths);
    var level = 0u;
    while radius_uv > REACH_TEXELS * level_texel(level) && level < coarsest {
        level++;
    }
    let place = s.uv / level_texel(level);
    return Block(level, place, floor(place + 0.5) - 4.0, radius_uv / level_texel(level));
}

// One inside the disc, falling to none over the texel that its border crosses; a point is a tent as
// wide as a texel.
fn weight_of(b: Block, texel: vec2<f32>) -> f32 {
    return saturate(max(b.radius, 0.5) + 0.5 - length(texel + 0.5 - b.place));
}

fn texel_of(b: Block, k: u32) -> vec2<f32> {
    return b.first + vec2(f32(k % 8u), f32(k / 8u));
}

fn is_inside(b: Block, texel: vec2<f32>) -> bool {
    return inside_map((texel + 0.5) * level_texel(b.level));
}

// Weighted mean depth of the blockers; negative without any.
fn mean_blocker_block(s: ShadowPoint, b: Block) -> f32 {
    var sum = 0.0;
    var total = 0.0;
    for (var k = 0u; k < 64u; k++) {
        let texel = texel_of(b, k);
        let weight = weight_of(b, texel);
        if weight > 0.0 && is_inside(b, texel) {
            let depth = level_depth(texel, b.level);
            if depth < level_reference(s, texel, b.level) {
                sum += weight * depth;
                total += weight;
            }
        }
    }
    return select(-1.0, sum / total, total > 0.0);
}

// Weighted share of the lit texels.
fn filter_block(s: ShadowPoint, b: Block) -> f32 {
    var lit = 0.0;
    var total = 0.0;
    for (var k = 0u; k < 64u; k++) {
        let texel = texel_of(b, k);
        let weight = weight_of(b, texel);
        if weight > 0.0 {
            total += weight;
            lit += weight * select(1.0, lit_texel(s, texel, b.level), is_inside(b, texel));
        }
    }
    return lit / total;
}
