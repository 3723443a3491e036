// Slot `moments_over`: means over a square by one trilinear tap of a mip chain (third seed document),
// in full precision, clamped at the border. A texture of one level is looked up bilinearly.
@group(0) @binding(6) var moments: texture_2d<f32>;

// Texels of the map per texel of the finest level.
override MOMENTS_STEP: f32;

// Its size is computed: asked for the size of a level that differs from pixel to pixel, llvmpipe
// answers with one pixel's.
fn moments_at(uv: vec2<f32>, level: u32) -> vec2<f32> {
    let last = max(vec2<i32>(textureDimensions(moments) >> vec2(level)), vec2(1)) - 1;
    let corner = uv * (f32(globals.map_size) / (MOMENTS_STEP * f32(1u << level))) - 0.5;
    let base = vec2<i32>(floor(corner));
    let weight = corner - floor(corner);
    let a = textureLoad(moments, clamp(base, vec2(0), last), level).xy;
    let b = textureLoad(moments, clamp(base + vec2(1, 0), vec2(0), last), level).xy;
    let c = textureLoad(moments, clamp(base + vec2(0, 1), vec2(0), last), level).xy;
    let d = textureLoad(moments, clamp(base + vec2(1, 1), vec2(0), last), level).xy;
    return mix(mix(a, b, weight.x), mix(c, d, weight.x), weight.y);
}

// Between the two levels whose texels are so many of the map's wide.
fn moments_over(uv: vec2<f32>, width_texels: f32) -> vec2<f32> {
    let coarsest = textureNumLevels(moments) - 1u;
    let lod = clamp(log2(max(width_texels, 1.0)), 0.0, f32(coarsest));
    let level = u32(lod);
    let fine = moments_at(uv, level);
    return mix(fine, moments_at(uv, min(level + 1u, coarsest)), lod - f32(level));
}
