// Bilinear fetch in full precision, clamped at the border. `place` in texels, centres at +0.5.
@group(0) @binding(6) var source: texture_2d<f32>;

fn fetch_bilinear(place: vec2<f32>) -> f32 {
    let last = vec2<i32>(textureDimensions(source)) - 1;
    let corner = place - 0.5;
    let base = vec2<i32>(floor(corner));
    let weight = corner - floor(corner);
    let a = textureLoad(source, clamp(base, vec2(0), last), 0).x;
    let b = textureLoad(source, clamp(base + vec2(1, 0), vec2(0), last), 0).x;
    let c = textureLoad(source, clamp(base + vec2(0, 1), vec2(0), last), 0).x;
    let d = textureLoad(source, clamp(base + vec2(1, 1), vec2(0), last), 0).x;
    return mix(mix(a, b, weight.x), mix(c, d, weight.x), weight.y);
}
