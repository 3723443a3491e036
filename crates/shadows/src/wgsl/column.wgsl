// Grids that are split into rows, one a pixel, and columns, which are put together from the rows of
// those pixels that see the receiver's plane there (T20).
override GRID_SIDE: u32;

// Distance of a pixel's surface from the receiver's plane over the receiver's depth, from which it
// is another surface.
const OTHER_SURFACE: f32 = 0.005;

// Tap `k` of a row or column of this half-length.
fn grid_offset(k: u32, half: f32) -> f32 {
    return (2.0 * f32(k) / f32(GRID_SIDE - 1u) - 1.0) * half;
}

struct Neighbour {
    pixel: vec2<i32>,
    // Whether it sees the receiver's surface.
    found: bool,
}

// The pixel that sees the receiver's plane at an offset along the map's columns.
fn neighbour(r: Receiver, offset_v: f32) -> Neighbour {
    let wanted = plane_point(r, vec2(0.0, offset_v));
    let clip = globals.clip_from_world * vec4(wanted, 1.0);
    let place = (clip.xy / clip.w * vec2(0.5, -0.5) + 0.5) * vec2<f32>(globals.frame_size);
    let pixel = vec2<i32>(floor(clamp(place, vec2(-1.0), vec2<f32>(globals.frame_size))));
    if clip.w <= 0.0 || !in_frame(pixel) {
        return Neighbour(pixel, false);
    }
    let depth = depth_at(pixel);
    let there = unprojected(globals.world_from_camera, globals.half_extent, pixel, depth);
    let apart = abs(dot(r.normal, there - r.position));
    return Neighbour(pixel, depth > 0.0 && apart <= OTHER_SURFACE * view_depth(r.position));
}
