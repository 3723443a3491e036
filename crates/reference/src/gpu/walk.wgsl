// One group of receivers a workgroup: walks the tree with the volume between them and the light, and lists the
// triangles that it touches: those wholly between by the edges at which layers change (scanlines/candidates.rs),
// the others one by one.

@group(0) @binding(4) var<storage, read> nodes: array<vec4<u32>>;
@group(0) @binding(5) var<storage, read_write> pool: array<u32>;
@group(0) @binding(6) var<storage, read_write> heads: array<List>;
@group(0) @binding(7) var<storage, read_write> next_free: atomic<u32>;
// Two a slot: a unit normal with its offset, then what f32 left of them.
@group(0) @binding(8) var<storage, read> planes: array<vec4<f32>>;

const THREADS = 64u;
// Pairs of nodes that are open at once, and from where on fewer are taken: a tree of 100 levels fits.
const OPEN = 1024u;
const CROWDED = 512u;
// Triangles of leaves that wait, and from where on they are sorted: 64 leaves of eight still fit.
const WAITING = 1024u;
const ENOUGH = 512u;
// Listed when there is no room for those of 64 more.
const PLAIN = 256u;
const EDGES = 512u;
// Groups of more edges than this look at triangles one by one, and stop sooner.
const DENSE = 4096u;
// f32 rounding of all of the below, in parts of the extent: four times the host's, whose planes are f64.
const ROUNDING = 64.0 / 16777216.0;

var<workgroup> open: array<u32, OPEN>;
var<workgroup> opened: atomic<u32>;
var<workgroup> waiting: array<u32, WAITING>;
var<workgroup> awaited: atomic<u32>;
var<workgroup> plain: array<u32, PLAIN>;
var<workgroup> plain_count: atomic<u32>;
// 16 times the slot, 4 times the side, and the weight's number.
var<workgroup> edges: array<u32, EDGES>;
var<workgroup> edge_count: atomic<u32>;
var<workgroup> lost: atomic<u32>;
const CROSSED_OUT = 1u;
const NO_ROOM = 2u;
const TOO_DENSE = 4u;
var<workgroup> least: array<vec4<f32>, THREADS>;
// Where the list goes on, and the chunk before.
var<workgroup> chunk: u32;
var<workgroup> before: u32;
var<workgroup> listed: u32;
// The word of the lowest receiver, where all have one normal.
var<workgroup> ground: u32;

@compute @workgroup_size(64)
fn walk(@builtin(workgroup_id) workgroup: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let group = groups[task.first_group + workgroup.x];
    let apart = stand(group, lane);
    var by_edges = apart;
    loop {
        if lane == 0u {
            open[0] = task.root;
            atomicStore(&opened, 1u);
            atomicStore(&awaited, 0u);
            atomicStore(&plain_count, 0u);
            atomicStore(&edge_count, 0u);
            atomicStore(&lost, 0u);
            before = NONE;
            listed = 0u;
            heads[workgroup.x] = List(NONE, 0u, 0u, 0u);
        }
        workgroupBarrier();
        descend(workgroup.x, lane, by_edges);
        workgroupBarrier();
        let failed = atomicLoad(&lost);
        workgroupBarrier();
        if failed != TOO_DENSE {
            break;
        }
        by_edges = false;
    }
    if lane == 0u {
        // Some drivers end a loop that they think is endless: then something is left.
        let failed = atomicLoad(&lost);
        if failed == NO_ROOM {
            heads[workgroup.x].first = EXHAUSTED;
        } else if failed != 0u || atomicLoad(&opened) != 0u || atomicLoad(&awaited) != 0u {
            heads[workgroup.x].first = OVERFLOW;
        }
    }
}

// The volume, and what else is the same for all of a group; whether its receivers are all before the light.
fn stand(group: Group, lane: u32) -> bool {
    let slack = ROUNDING * (task.extent + max(max_of(abs(group.low)), max_of(abs(group.high))));
    loose = slack;
    centre = 0.5 * (group.low + group.high);
    wide = (0.5 + DOUBT) * (group.high - group.low) + 1e-30;
    let word = receivers[group.first + min(lane, group.count - 1u)];
    var at = bitcast<vec3<f32>>(word.xyz);
    // Normals. A receiver stands in its triangle's plane, wherever its point is.
    let in_air = (word.w & IN_AIR) == IN_AIR;
    var own = vec3<f32>(0.0);
    var plane = 3e38;
    if !in_air {
        let under = 2u * (word.w & IN_AIR);
        let facing = select(1.0, -1.0, (word.w & BACK) != 0u);
        own = planes[under].xyz * facing;
        at -= (dot(planes[under].xyz, at) - planes[under].w) * planes[under].xyz;
        plane = (planes[under].w + planes[under + 1u].w) * facing;
    }
    let lower = least_of(vec4<f32>(own, plane), lane);
    let upper = -least_of(vec4<f32>(-own, select(0.0, 1.0, in_air)), lane);
    airborne = upper.w < 0.0;
    normal = 0.5 * (lower.xyz + upper.xyz);
    sway = (0.5 + DOUBT) * (upper.xyz - lower.xyz) + 1e-7;
    level = any(group.normal != vec3<f32>(0.0));
    if plane == lower.w {
        ground = word.w;
    }
    // Heights: over the receivers' planes, and towards the light.
    var apart = KIND != SPHERE;
    upright = vec3<f32>(0.0);
    farthest = 3e38;
    if KIND != SPHERE {
        upright = normalize(task.axis);
        if FLAT && dot(upright, task.centre - centre) < 0.0 {
            upright = -upright;
        }
    }
    let d = at - centre;
    let over = dot(normal, d);
    let up = dot(upright, d);
    let range = least_of(vec4<f32>(over, -over, up, -up), lane);
    heights = vec2<f32>(range.x, -range.y);
    nearest = -range.w;
    if FLAT {
        let light = dot(upright, task.centre - centre);
        farthest = light - 2.0 * LIGHT_GAP * (light - range.z);
        apart = light > nearest + slack;
    }
    // The volume: planes as low as the lowest receiver and the light.
    if FLAT && !apart {
        set_slab(centre);
    } else {
        set_sides(centre);
    }
    low = min(group.low, task.low.xyz) - slack;
    high = max(group.high, task.high.xyz) + slack;
    let sides = least_of(
        vec4<f32>(dot(plane_0.xyz, at), dot(plane_1.xyz, at), dot(plane_2.xyz, at), dot(plane_3.xyz, at)), lane,
    );
    plane_0.w = offset(plane_0, sides.x, slack);
    plane_1.w = offset(plane_1, sides.y, slack);
    plane_2.w = offset(plane_2, sides.z, slack);
    plane_3.w = offset(plane_3, sides.w, slack);
    plane_4 = vec4<f32>(group.normal, 1.0);
    let lowest = least_of(vec4<f32>(dot(group.normal, at)), lane).x;
    plane_4.w = select(-1.0, lowest - slack, level);
    return apart;
}

// The least of all lanes' values.
fn least_of(value: vec4<f32>, lane: u32) -> vec4<f32> {
    least[lane] = value;
    for (var step = THREADS / 2u; step > 0u; step = step / 2u) {
        workgroupBarrier();
        if lane < step {
            least[lane] = min(least[lane], least[lane + step]);
        }
    }
    workgroupBarrier();
    let found = least[0];
    workgroupBarrier();
    return found;
}

// The walk.
fn descend(group: u32, lane: u32, by_edges: bool) {
    loop {
        let top = atomicLoad(&opened);
        let taken = min(top, select(THREADS / 2u, 4u, top > CROWDED));
        var pair = 0u;
        let has = lane / 2u < taken;
        if has {
            pair = open[top - 1u - lane / 2u];
        }
        workgroupBarrier();
        if lane == 0u {
            atomicStore(&opened, top - taken);
        }
        workgroupBarrier();
        if has {
            visit(pair + (lane & 1u));
        }
        workgroupBarrier();
        let left = atomicLoad(&opened);
        let ready = atomicLoad(&awaited);
        workgroupBarrier();
        if ready > ENOUGH || left == 0u {
            sift(group, lane, by_edges, left == 0u);
        }
        let failed = atomicLoad(&lost);
        workgroupBarrier();
        if failed != 0u || left == 0u {
            break;
        }
    }
}

fn visit(index: u32) {
    let lower = nodes[2u * index];
    let upper = nodes[2u * index + 1u];
    if !touches(bitcast<vec3<f32>>(lower.xyz), bitcast<vec3<f32>>(upper.xyz)) {
        return;
    }
    if lower.w == 0u {
        let place = atomicAdd(&opened, 1u);
        if place < OPEN {
            open[place] = upper.w;
        } else {
            atomicOr(&lost, CROSSED_OUT);
        }
        return;
    }
    let place = atomicAdd(&awaited, lower.w);
    if place + lower.w > WAITING {
        atomicOr(&lost, CROSSED_OUT);
        return;
    }
    for (var i = 0u; i < lower.w; i++) {
        waiting[place + i] = upper.w + i;
    }
}

// Sorts all that wait; lists what there is, if that is the last of it.
fn sift(group: u32, lane: u32, by_edges: bool, last: bool) {
    let count = min(atomicLoad(&awaited), WAITING);
    for (var i = 0u; i < count; i += THREADS) {
        if i + lane < count {
            sort(waiting[i + lane], by_edges);
        }
        workgroupBarrier();
        let full = atomicLoad(&plain_count) > PLAIN - THREADS || atomicLoad(&edge_count) > EDGES - 3u * THREADS;
        workgroupBarrier();
        if full {
            list(group, lane);
        }
        if lane == 0u && i + THREADS >= count {
            atomicStore(&awaited, 0u);
        }
    }
    workgroupBarrier();
    if last {
        list(group, lane);
    }
}

// One triangle: by its edges where layers change, by itself, or not at all.
fn sort(slot: u32, by_edges: bool) {
    var own = OUT;
    // One loop for the triangle and its three mates: the same answer for each, whoever asks.
    for (var k = 0u; k < 4u; k++) {
        var mate = slot << 4u;
        if k > 0u {
            mate = corners[3u * slot + k - 1u].w;
        }
        var side = OUT;
        if (mate >> 4u) != IN_AIR {
            side = side_of(mate >> 4u);
        }
        if k == 0u {
            own = side;
            if own == OUT {
                return;
            }
            if own == DOUBTFUL && level && lies(slot) {
                return;
            }
            if abs(own) != 1 || !by_edges {
                plain[atomicAdd(&plain_count, 1u)] = slot | select(CLEAR, 0u, own == DOUBTFUL);
                return;
            }
            continue;
        }
        var weight = own;
        if abs(side) == 1 {
            // One of the two names the edge; two sides of one triangle are none.
            if (mate >> 4u) <= slot {
                continue;
            }
            weight += select(side, -side, (mate & 1u) != 0u);
        }
        if weight != 0 {
            let number = u32(select(weight + 2, weight + 1, weight > 0));
            edges[atomicAdd(&edge_count, 1u)] = (slot << 4u) | ((k - 1u) << 2u) | number;
        }
    }
}

// Whether a triangle is in the plane of all receivers or below it. Half of what every receiver allows: the rest is
// for how near to the lowest plane another may be.
fn lies(slot: u32) -> bool {
    let under = ground & IN_AIR;
    let n = abs(planes[2u * under].xyz);
    for (var k = 0u; k < 3u; k++) {
        let corner = vertex(3u * slot + k);
        let over = height(under, corner);
        if select(over, -over, (ground & BACK) != 0u) > 0.5 * COPLANAR * dot(n, abs(corner)) {
            return false;
        }
    }
    return true;
}

// Appends what was found to the group's list: a chunk is the next one's place, how many triangles and edges there
// are, the triangles' slots, each coordinate of all their corners, each coordinate of all edges' ends, and what
// edges add, with their piece.
fn list(group: u32, lane: u32) {
    workgroupBarrier();
    let length = atomicLoad(&plain_count);
    let sides = atomicLoad(&edge_count);
    workgroupBarrier();
    if length + sides == 0u {
        return;
    }
    if lane == 0u {
        let words = 10u * length + 7u * sides + 3u;
        let place = atomicAdd(&next_free, words);
        listed += sides;
        chunk = place;
        if listed > DENSE {
            atomicOr(&lost, TOO_DENSE);
            chunk = NONE;
        } else if place > task.pool_words || words > task.pool_words - place {
            atomicOr(&lost, NO_ROOM);
            chunk = NONE;
        } else {
            pool[place] = NONE;
            pool[place + 1u] = length;
            pool[place + 2u] = sides;
            if before == NONE {
                heads[group].first = place;
            } else {
                pool[before] = place;
            }
            before = place;
            heads[group].length += length;
            heads[group].edges += sides;
        }
        atomicStore(&plain_count, 0u);
        atomicStore(&edge_count, 0u);
    }
    workgroupBarrier();
    if chunk == NONE {
        return;
    }
    for (var i = lane; i < length; i += THREADS) {
        let at = chunk + 3u + i;
        let slot = plain[i] & ~CLEAR;
        pool[at] = plain[i];
        for (var k = 0u; k < 3u; k++) {
            put(at + (3u * k + 1u) * length, length, corners[3u * slot + k].xyz);
        }
    }
    for (var i = lane; i < sides; i += THREADS) {
        let at = chunk + 3u + 10u * length + i;
        let word = edges[i];
        let slot = 3u * (word >> 4u);
        let k = (word >> 2u) & 3u;
        put(at, sides, corners[slot + k].xyz);
        put(at + 3u * sides, sides, corners[slot + select(k + 1u, 0u, k == 2u)].xyz);
        pool[at + 6u * sides] = (piece_of(slot) << 2u) | (word & 3u);
    }
    workgroupBarrier();
}

// Of a triangle by its first corner.
fn piece_of(first: u32) -> u32 {
    var piece = 0u;
    for (var k = 0u; k < 3u; k++) {
        piece |= ((corners[first + k].w >> 1u) & 3u) << (2u * k);
    }
    return piece;
}

fn put(at: u32, stride: u32, bits: vec3<u32>) {
    pool[at] = bits.x;
    pool[at + stride] = bits.y;
    pool[at + 2u * stride] = bits.z;
}

fn max_of(v: vec3<f32>) -> f32 {
    return max(v.x, max(v.y, v.z));
}
