// Slot `plane_point`: where the light's ray beside the receiver's, by an offset in map widths, meets
// the receiver's plane (world space).
fn plane_point(r: Receiver, offset_uv: vec2<f32>) -> vec3<f32> {
    let n = (globals.light_from_world * vec4(r.normal, 0.0)).xyz;
    let p = (globals.light_from_world * vec4(r.position, 1.0)).xyz;
    let across = vec2(offset_uv.x, -offset_uv.y) / globals.map_scale;
    let ray = vec3(p.xy / max(-p.z, 1e-6) + across, -1.0);
    // Surfaces seen from behind are planes too; edge-on ones end somewhere.
    let facing = select(-1.0, 1.0, dot(n, ray) >= 0.0) * max(abs(dot(n, ray)), 1e-6);
    let step = ray * (dot(n, p) / facing) - p;
    // A rotation's inverse is its transpose: from light space back to the world.
    return r.position + (vec4(step, 0.0) * globals.light_from_world).xyz;
}
