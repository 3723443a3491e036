// Slot `light`: an orthographic shadow map. Depth is linear in metres along the light.
struct ShadowPoint {
    uv: vec2<f32>,
    depth: f32,
    // Change of the receiver plane's depth per map width.
    slope: vec2<f32>,
}

// Normal offset in texels, scaled by the sine between normal and light (Filament's form).
override NORMAL_OFFSET_TEXELS: f32;
// Steepest receiver plane that is followed, metres of depth per metre across.
override MAX_SLOPE: f32;

fn shadow_point(position: vec3<f32>, normal: vec3<f32>) -> ShadowPoint {
    let n = (globals.light_from_world * vec4(normal, 0.0)).xyz;
    let texel_world = 1.0 / (globals.map_scale * f32(globals.map_size));
    let offset = normal * (NORMAL_OFFSET_TEXELS * texel_world * length(n.xy));
    let p = (globals.light_from_world * vec4(position + offset, 1.0)).xyz;
    let uv = vec2(p.x, -p.y) * globals.map_scale + 0.5;
    let tilt = vec2(n.x, -n.y) / max(n.z, 1e-6);
    let followed = tilt * min(1.0, MAX_SLOPE / max(length(tilt), 1e-12));
    return ShadowPoint(uv, -p.z, followed / globals.map_scale);
}

fn plane_depth(s: ShadowPoint, offset_uv: vec2<f32>) -> f32 {
    return s.depth + dot(s.slope, offset_uv);
}

// The same at the four texels of a gather, in its order: depth changes by as much from texel to texel.
fn plane_quad(s: ShadowPoint, first: vec2<f32>, step: f32) -> vec4<f32> {
    let change = s.slope * step;
    let base = s.depth + dot(s.slope, first);
    let all = base + vec4(change.y, change.x + change.y, change.x, 0.0);
    return all;
}

// Radius of the cone from a receiver to the light's disc where it passes the blocker's depth:
// for a straight edge parallel to the map this kernel has the true penumbra's profile.
fn true_radius_uv(receiver: f32, blocker: f32) -> f32 {
    return max(receiver - blocker, 0.0) * globals.light_size * globals.map_scale;
}
