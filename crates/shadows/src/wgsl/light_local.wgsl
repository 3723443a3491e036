// Slot `light`: a perspective shadow map of a light that has a place. Depth is linear in metres
// along the map's axis.
struct ShadowPoint {
    uv: vec2<f32>,
    depth: f32,
    // Change of the receiver plane's 1/depth per map width (1/depth is linear over the map).
    slope: vec2<f32>,
}

// Normal offset in texels, scaled by the sine between normal and light (Filament's form).
override NORMAL_OFFSET_TEXELS: f32;
// Steepest receiver plane that is followed, metres of depth per metre across.
override MAX_SLOPE: f32;

fn shadow_point(position: vec3<f32>, normal: vec3<f32>) -> ShadowPoint {
    let n = (globals.light_from_world * vec4(normal, 0.0)).xyz;
    let centre = (globals.light_from_world * vec4(position, 1.0)).xyz;
    let texel_world = max(-centre.z, 1e-6) / (globals.map_scale * f32(globals.map_size));
    let cosine = dot(n, -normalize(centre));
    let sine = sqrt(max(0.0, 1.0 - cosine * cosine));
    let offset = normal * (NORMAL_OFFSET_TEXELS * texel_world * sine);
    let p = (globals.light_from_world * vec4(position + offset, 1.0)).xyz;
    let depth = -p.z;
    // Behind the light's map: a place outside it.
    if depth <= 1e-6 {
        return ShadowPoint(vec2(-1.0), 1e-6, vec2(0.0));
    }
    let uv = vec2(p.x, -p.y) / depth * globals.map_scale + 0.5;
    let tilt = vec2(n.x, -n.y) / (globals.map_scale * min(dot(n, p), -1e-6));
    let steepness = depth * globals.map_scale * length(tilt);
    return ShadowPoint(uv, depth, tilt * min(1.0, MAX_SLOPE / max(steepness, 1e-12)));
}

fn plane_depth(s: ShadowPoint, offset_uv: vec2<f32>) -> f32 {
    return 1.0 / max(1.0 / s.depth + dot(s.slope, offset_uv), 1e-6);
}

// The same at the four texels of a gather, in its order: 1/depth changes by as much from texel to texel.
fn plane_quad(s: ShadowPoint, first: vec2<f32>, step: f32) -> vec4<f32> {
    let change = s.slope * step;
    let base = 1.0 / s.depth + dot(s.slope, first);
    let all = base + vec4(change.y, change.x + change.y, change.x, 0.0);
    return 1.0 / max(all, vec4(1e-6));
}

// Radius of the cone from a receiver to the light's disc where it passes the blocker's depth, in
// map widths at that depth: R (z - b) / z across, divided by b.
fn true_radius_uv(receiver: f32, blocker: f32) -> f32 {
    let across = globals.light_size * max(receiver - blocker, 0.0) / receiver;
    return across / max(blocker, 1e-4) * globals.map_scale;
}
