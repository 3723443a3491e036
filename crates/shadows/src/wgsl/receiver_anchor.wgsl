// Slot `receiver`: anchors, fixed points of surfaces, at their own world positions (scores). The
// pixel that an anchor projects to supplies whatever is screen-space.
struct Receiver {
    position: vec3<f32>,
    normal: vec3<f32>,
    place: vec2<f32>,
    seen: bool,
}

struct Anchor {
    position: vec4<f32>,
    normal: vec4<f32>,
}

@group(0) @binding(4) var<storage, read> anchors: array<Anchor>;

fn receiver_index(id: vec3<u32>) -> u32 {
    return (id.y / 8u * ROW_GROUPS + id.x / 8u) * 64u + (id.y % 8u) * 8u + id.x % 8u;
}

// Workgroups per row of the dispatch: a dispatch has at most 65535 a side.
const ROW_GROUPS: u32 = 1024u;

fn receiver(index: u32) -> Receiver {
    let anchor = anchors[index];
    let clip = globals.clip_from_world * vec4(anchor.position.xyz, 1.0);
    let size = vec2<f32>(globals.frame_size);
    let place = (clip.xy / clip.w * vec2(0.5, -0.5) + 0.5) * size;
    let seen = clip.w > 0.0 && all(place >= vec2(0.0)) && all(place < size);
    return Receiver(anchor.position.xyz, anchor.normal.xyz, place, seen);
}
