// Slot `light`: a map in every direction of a light that has a place. Depth is the distance from
// the light in metres; places in the map are tangents of angles from the receiver's direction.
struct ShadowPoint {
    uv: vec2<f32>,
    depth: f32,
    // Change of the receiver plane's 1/depth per tangent (1/depth is linear over a plane that is
    // square to the direction).
    slope: vec2<f32>,
    direction: vec3<f32>,
    tangent: vec3<f32>,
    bitangent: vec3<f32>,
}

// Normal offset in texels, scaled by the sine between normal and light (Filament's form).
override NORMAL_OFFSET_TEXELS: f32;
// Steepest receiver plane that is followed, metres of depth per metre across.
override MAX_SLOPE: f32;

fn shadow_point(position: vec3<f32>, normal: vec3<f32>) -> ShadowPoint {
    let centre = (globals.light_from_world * vec4(position, 1.0)).xyz;
    let texel_world = length(centre) * 2.0 / f32(globals.face_size);
    let cosine = dot(normal, -normalize(centre));
    let sine = sqrt(max(0.0, 1.0 - cosine * cosine));
    let p = centre + normal * (NORMAL_OFFSET_TEXELS * texel_world * sine);
    let depth = max(length(p), 1e-6);
    let direction = p / depth;
    // The second seed document's basis.
    let up = select(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), abs(direction.y) < 0.999);
    let tangent = normalize(cross(up, direction));
    let bitangent = cross(direction, tangent);
    let tilt = vec2(dot(normal, tangent), dot(normal, bitangent)) / min(dot(normal, p), -1e-6);
    let steepness = depth * length(tilt);
    let slope = tilt * min(1.0, MAX_SLOPE / max(steepness, 1e-12));
    return ShadowPoint(vec2(0.0), depth, slope, direction, tangent, bitangent);
}

// Distance of the receiver's plane in the direction of a tangent.
fn plane_depth(s: ShadowPoint, offset: vec2<f32>) -> f32 {
    return sqrt(1.0 + dot(offset, offset)) / max(1.0 / s.depth + dot(s.slope, offset), 1e-6);
}

// Four texels of a face are not evenly spaced in tangents: taps of a cube take them one by one, and
// this is never called.
fn plane_quad(s: ShadowPoint, first: vec2<f32>, step: f32) -> vec4<f32> {
    return vec4(plane_depth(s, first));
}

// Radius of the cone from a receiver to the light where it passes the blocker's distance, as a
// tangent: R (z - b) / z across, over b.
fn true_radius_uv(receiver: f32, blocker: f32) -> f32 {
    return globals.light_size * max(receiver - blocker, 0.0) / (receiver * max(blocker, 1e-4));
}
