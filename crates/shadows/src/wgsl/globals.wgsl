// What every pass may read. The Rust twin is `layout::Globals`; a test compares the two.
const TAU: f32 = 6.283185307179586;

struct Globals {
    world_from_camera: mat4x4<f32>,
    clip_from_world: mat4x4<f32>,
    light_from_world: mat4x4<f32>,
    light_clip_from_world: mat4x4<f32>,
    // Pixels of the frame.
    frame_size: vec2<u32>,
    // Receivers to shade: pixels, or anchors.
    receivers: u32,
    // Side of the square shadow map in texels.
    map_size: u32,
    // Half the picture at depth 1: metres right, metres up.
    half_extent: vec2<f32>,
    // Sun: map widths per metre. Local light: map widths per unit of slope.
    map_scale: f32,
    // Sun: tangent of its angular radius. Local light: its radius in metres.
    light_size: f32,
    // Light-space depth before which there is no blocker.
    nearest_blocker: f32,
    // Blocker distance for which fixed kernels are set, metres.
    reference_gap: f32,
    // Which pattern: scores draw one per frame, seed and block.
    pattern_frame: u32,
    pattern_seed: u32,
    // Number of the frame, for what alternates from frame to frame.
    frame_index: u32,
    // Light-space depth of the shadow region's centre, and of the far plane, metres.
    eye_distance: f32,
    far: f32,
    // Side of one face of a cube map in texels; 0 for a single map.
    face_size: u32,
}

@group(0) @binding(0) var<uniform> globals: Globals;
