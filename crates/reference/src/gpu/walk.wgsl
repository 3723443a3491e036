// One group of receivers a workgroup: walks the tree with the volume between them and the light, and
// lists the triangles that it touches.

@group(0) @binding(4) var<storage, read> nodes: array<vec4<u32>>;
@group(0) @binding(5) var<storage, read_write> pool: array<u32>;
@group(0) @binding(6) var<storage, read_write> heads: array<List>;
@group(0) @binding(7) var<storage, read_write> next_free: atomic<u32>;

const THREADS = 64u;
// Pairs of nodes that are open at once, and from where on fewer are taken: a tree of 100 levels fits.
const OPEN = 1024u;
const CROWDED = 512u;
const FOUND = 2048u;
// Listed when that many are found: 64 leaves of eight still fit.
const ENOUGH = 1536u;
// f32 rounding of all of the below, in parts of the extent: four times the host's, whose planes are f64.
const ROUNDING = 64.0 / 16777216.0;

var<workgroup> open: array<u32, OPEN>;
var<workgroup> opened: atomic<u32>;
var<workgroup> found: array<u32, FOUND>;
var<workgroup> count: atomic<u32>;
var<workgroup> lost: atomic<u32>;
var<workgroup> least: array<vec4<f32>, THREADS>;
var<workgroup> least_over: array<f32, THREADS>;
// Where the list goes on, and the chunk before.
var<workgroup> chunk: u32;
var<workgroup> before: u32;

@compute @workgroup_size(64)
fn walk(@builtin(workgroup_id) workgroup: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let group = groups[task.first_group + workgroup.x];
    let slack = ROUNDING * (task.extent + max(max_of(abs(group.low)), max_of(abs(group.high))));
    // The volume: planes as low as the lowest receiver and the light.
    set_sides(0.5 * (group.low + group.high));
    plane_4 = vec4<f32>(group.normal, 0.0);
    low = min(group.low, task.low.xyz) - slack;
    high = max(group.high, task.high.xyz) + slack;
    let at = bitcast<vec3<f32>>(receivers[group.first + min(lane, group.count - 1u)].xyz);
    least[lane] = vec4<f32>(
        dot(plane_0.xyz, at), dot(plane_1.xyz, at), dot(plane_2.xyz, at), dot(plane_3.xyz, at),
    );
    least_over[lane] = dot(group.normal, at);
    if lane == 0u {
        open[0] = task.root;
        atomicStore(&opened, 1u);
        atomicStore(&count, 0u);
        atomicStore(&lost, 0u);
        before = NONE;
        heads[workgroup.x] = List(NONE, 0u);
    }
    for (var step = THREADS / 2u; step > 0u; step = step / 2u) {
        workgroupBarrier();
        if lane < step {
            least[lane] = min(least[lane], least[lane + step]);
            least_over[lane] = min(least_over[lane], least_over[lane + step]);
        }
    }
    workgroupBarrier();
    plane_0.w = offset(plane_0, least[0].x, slack);
    plane_1.w = offset(plane_1, least[0].y, slack);
    plane_2.w = offset(plane_2, least[0].z, slack);
    plane_3.w = offset(plane_3, least[0].w, slack);
    plane_4.w = select(least_over[0] - slack, -1.0, all(group.normal == vec3<f32>(0.0)));
    // The walk.
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
        let enough = atomicLoad(&count) > ENOUGH;
        let done = atomicLoad(&opened) == 0u;
        let failed = atomicLoad(&lost);
        if enough || done {
            list(workgroup.x, lane);
        }
        if failed != 0u || done {
            break;
        }
        workgroupBarrier();
    }
    workgroupBarrier();
    if lane == 0u {
        // Some drivers end a loop that they think is endless: then pairs are left.
        let failed = atomicLoad(&lost);
        if failed == 2u {
            heads[workgroup.x].first = EXHAUSTED;
        } else if failed != 0u || atomicLoad(&opened) != 0u {
            heads[workgroup.x].first = OVERFLOW;
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
            atomicOr(&lost, 1u);
        }
        return;
    }
    for (var slot = upper.w; slot < upper.w + lower.w; slot++) {
        if misses(slot) {
            continue;
        }
        let place = atomicAdd(&count, 1u);
        if place < FOUND {
            found[place] = slot;
        } else {
            atomicOr(&lost, 1u);
        }
    }
}

// Appends what was found to the group's list: a chunk is the next one's place, its length, its slots,
// then each coordinate of all their corners.
fn list(group: u32, lane: u32) {
    let length = min(atomicLoad(&count), FOUND);
    workgroupBarrier();
    if length == 0u {
        return;
    }
    if lane == 0u {
        let words = 10u * length + 2u;
        let place = atomicAdd(&next_free, words);
        chunk = place;
        if place > task.pool_words || words > task.pool_words - place {
            atomicOr(&lost, 2u);
            chunk = NONE;
        } else {
            pool[place] = NONE;
            pool[place + 1u] = length;
            if before == NONE {
                heads[group].first = place;
            } else {
                pool[before] = place;
            }
            before = place;
            heads[group].length += length;
        }
        atomicStore(&count, 0u);
    }
    workgroupBarrier();
    if chunk != NONE {
        for (var i = lane; i < length; i += THREADS) {
            let at = chunk + 2u + i;
            let slot = found[i];
            pool[at] = slot;
            for (var k = 0u; k < 3u; k++) {
                let corner = bitcast<vec3<u32>>(corners[3u * slot + k].xyz);
                pool[at + (3u * k + 1u) * length] = corner.x;
                pool[at + (3u * k + 2u) * length] = corner.y;
                pool[at + (3u * k + 3u) * length] = corner.z;
            }
        }
    }
    workgroupBarrier();
}

fn max_of(v: vec3<f32>) -> f32 {
    return max(v.x, max(v.y, v.z));
}
