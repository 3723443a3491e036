// A receiver a lane, or several lanes: tells those that see all of the light or nothing of it, and puts the others into a queue.

// How many stand there, nothing, then each receiver and the list of its group, with COUNTS.
@group(0) @binding(8) var<storage, read_write> queue: array<atomic<u32>>;

var<workgroup> queued: atomic<u32>;
var<workgroup> place: u32;

// Two pieces a word: the layers of each before the light's middle.
struct Layers {
    // each pair
    of_PAIR: u32,
    // end pair
    crossed: u32,
}

// A part of the list: of a triangle three corners, of an edge two ends, and with the first what else there is.
const STAGE = 128u;
var<workgroup> stage: array<vec4<u32>, 3u * STAGE>;

// Lanes that share a receiver, each with another part of what is staged, and what they found: layers, then the
// pieces crossed, then what triangles tell, then how many they met.
const LANES = 128u;
const MOST = 64u;
var<workgroup> joint: array<atomic<u32>, MOST * WORDS>;
const WORDS = PIECES / 2u + 3u;
const PARTLY = 1u;
const WHOLE = 2u;
const FAILED = 4u;

@compute @workgroup_size(128)
fn glance(@builtin(workgroup_id) workgroup: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let group = groups[task.first_group + workgroup.x];
    let list = heads[workgroup.x];
    // Receivers stand side by side, a power of two of them, as often as there is room.
    let wide = min(1u << (32u - countLeadingZeros(group.count - 1u)), MOST);
    let own = lane & (wide - 1u);
    let some = lane < group.count;
    let index = group.first + min(own, group.count - 1u);
    for (var i = lane; i < MOST * WORDS; i += LANES) {
        atomicStore(&joint[i], 0u);
    }
    if lane == 0u {
        atomicStore(&queued, 0u);
    }
    workgroupBarrier();
    var outcome = 0u;
    if list.first == OVERFLOW {
        outcome = FOR_CPU;
    } else if list.first == EXHAUSTED {
        outcome = AGAIN;
    } else {
        look_over(index, list, lane, vec2<u32>(lane / wide, LANES / wide), WORDS * own);
        workgroupBarrier();
        if some {
            outcome = told(list, WORDS * own);
        }
    }
    var turn = 0u;
    if some && outcome != 0u {
        results[index] = vec4<u32>(outcome, 0u, 0u, 0u);
    }
    if some && outcome == 0u {
        turn = atomicAdd(&queued, 1u);
    }
    workgroupBarrier();
    if lane == 0u {
        place = atomicAdd(&queue[0], atomicLoad(&queued));
    }
    workgroupBarrier();
    if some && outcome == 0u {
        let at = 2u * (1u + place + turn);
        atomicStore(&queue[at], index);
        let crossed = atomicLoad(&joint[WORDS * own + PIECES / 2u]) != 0u;
        atomicStore(&queue[at + 1u], workgroup.x | select(0u, COUNTS, crossed));
    }
}

// Every so many of the list's triangles and edges from one receiver. All lanes go through the list together.
fn look_over(index: u32, list: List, lane: u32, part: vec2<u32>, joint_at: u32) {
    let s = sight_of(index);
    var layers: Layers;
    var met = 0u;
    var said = select(0u, FAILED, s.thin);
    if s.across {
        said |= PARTLY;
    }
    var at = list.first;
    while at != NONE {
        let length = pool[at + 1u];
        let sides = pool[at + 2u];
        for (var first = 0u; first < sides; first += STAGE) {
            let count = min(STAGE, sides - first);
            workgroupBarrier();
            if lane < count {
                let from_here = at + 3u + 10u * length + first + lane;
                stage[2u * lane] = vec4<u32>(bits(from_here, sides), pool[from_here + 6u * sides]);
                stage[2u * lane + 1u] = vec4<u32>(bits(from_here + 3u * sides, sides), 0u);
            }
            workgroupBarrier();
            for (var i = part.x; i < count; i += part.y) {
                let seen = see(s, staged(2u * i), staged(2u * i + 1u), stage[2u * i].w);
                if crosses(seen) {
                    layers.crossed |= 1u << seen.piece;
                }
                let adds = u32(before_middle(seen));
                if adds != 0u {
                    let shifted = adds << (16u * (seen.piece & 1u));
                    // each pair
                    layers.of_PAIR += select(0u, shifted, (seen.piece >> 1u) == PAIRu);
                    // end pair
                }
                met++;
            }
        }
        for (var first = 0u; first < length; first += STAGE) {
            let count = min(STAGE, length - first);
            workgroupBarrier();
            if lane < count {
                let from_here = at + 3u + first + lane;
                stage[3u * lane] = vec4<u32>(bits(from_here + length, length), pool[from_here]);
                stage[3u * lane + 1u] = vec4<u32>(bits(from_here + 4u * length, length), 0u);
                stage[3u * lane + 2u] = vec4<u32>(bits(from_here + 7u * length, length), 0u);
            }
            workgroupBarrier();
            for (var i = part.x; i < count; i += part.y) {
                if (said & WHOLE) == 0u {
                    let triangle = mat3x3<f32>(staged(3u * i), staged(3u * i + 1u), staged(3u * i + 2u));
                    let seen = survey(s, stage[3u * i].w, triangle);
                    said |= select(0u, PARTLY, seen.some) | select(0u, WHOLE, seen.whole);
                }
                met++;
            }
        }
        at = pool[at];
    }
    // each pair
    if layers.of_PAIR != 0u {
        atomicAdd(&joint[joint_at + PAIRu], layers.of_PAIR);
    }
    // end pair
    atomicOr(&joint[joint_at + PIECES / 2u], layers.crossed);
    atomicOr(&joint[joint_at + PIECES / 2u + 1u], said);
    atomicAdd(&joint[joint_at + PIECES / 2u + 2u], met);
}

fn staged(at: u32) -> vec3<f32> {
    return bitcast<vec3<f32>>(stage[at].xyz);
}

// A first word of results, or 0 where samples have to tell.
fn told(list: List, joint_at: u32) -> u32 {
    let crossed = atomicLoad(&joint[joint_at + PIECES / 2u]);
    let said = atomicLoad(&joint[joint_at + PIECES / 2u + 1u]);
    let met = atomicLoad(&joint[joint_at + PIECES / 2u + 2u]);
    // Some drivers end a loop that they think is endless.
    if (said & FAILED) != 0u || met != list.length + list.edges {
        return FOR_CPU;
    }
    // A piece with layers before the middle and no edge that crosses the light hides all of it.
    var whole = 0u;
    var layers = 0u;
    // each pair
    // Less than none, which only rounding makes, takes nothing from the other.
    layers = (atomicLoad(&joint[joint_at + PAIRu]) + 0x40004000u) ^ 0x40004000u;
    whole |= select(0u, 1u, (layers & 0xffffu) != 0u) << (2u * PAIRu);
    whole |= select(0u, 2u, (layers >> 16u) != 0u) << (2u * PAIRu);
    // end pair
    if (said & WHOLE) != 0u || (whole & ~crossed) != 0u {
        return HIDDEN;
    }
    return select(LIT, 0u, (said & PARTLY) != 0u || crossed != 0u);
}
