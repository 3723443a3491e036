// Reading and comparing a cube map: as `tap.wgsl`, with offsets that are tangents. References are
// taken at texel centres, across the seams of faces too.
@group(0) @binding(1) var shadow_map: texture_2d<f32>;

// Centre of a texel of a face (which may lie beyond its border) as a direction.
fn texel_direction(face: u32, texel: vec2<f32>) -> vec3<f32> {
    let place = (texel + 0.5) * (2.0 / f32(globals.face_size)) - 1.0;
    return from_face(face, vec3(place.x, -place.y, 1.0));
}

// Place on a face in texels.
fn face_place(face: u32, direction: vec3<f32>) -> vec2<f32> {
    let f = on_face(face, direction);
    return (vec2(f.x, -f.y) / f.z + 1.0) * (0.5 * f32(globals.face_size));
}

fn tap_direction(s: ShadowPoint, offset: vec2<f32>) -> vec3<f32> {
    return s.direction + s.tangent * offset.x + s.bitangent * offset.y;
}

// Depth of the texel that a direction meets, and the receiver's reference at that texel's centre.
fn pair_along(s: ShadowPoint, direction: vec3<f32>) -> vec2<f32> {
    let face = face_of(direction);
    let side = f32(globals.face_size);
    let texel = clamp(floor(face_place(face, direction)), vec2(0.0), vec2(side - 1.0));
    let corner = vec2(face % 3u, face / 3u) * globals.face_size;
    let depth = textureLoad(shadow_map, corner + vec2<u32>(texel), 0).x;
    let centre = texel_direction(face, texel);
    let forward = dot(centre, s.direction);
    let offset = vec2(dot(centre, s.tangent), dot(centre, s.bitangent)) / max(forward, 1e-3);
    return vec2(depth, reference_depth(s, offset));
}

fn nearest_pair(s: ShadowPoint, offset: vec2<f32>) -> vec2<f32> {
    return pair_along(s, tap_direction(s, offset));
}

fn lit_nearest(s: ShadowPoint, offset: vec2<f32>) -> f32 {
    let pair = nearest_pair(s, offset);
    return select(0.0, 1.0, pair.y <= pair.x);
}

// Four compares round a tap, weighted bilinearly on the face that the tap meets.
fn lit_bilinear(s: ShadowPoint, offset: vec2<f32>) -> f32 {
    let direction = tap_direction(s, offset);
    let face = face_of(direction);
    let place = face_place(face, direction) - 0.5;
    let base = floor(place);
    let weight = place - base;
    var lit: array<f32, 4>;
    for (var k = 0u; k < 4u; k++) {
        let corner = base + vec2(f32(k % 2u), f32(k / 2u));
        let pair = pair_along(s, texel_direction(face, corner));
        lit[k] = select(0.0, 1.0, pair.y <= pair.x);
    }
    return mix(mix(lit[0], lit[1], weight.x), mix(lit[2], lit[3], weight.x), weight.y);
}
