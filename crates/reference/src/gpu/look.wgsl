// 32 lanes look at the light from one receiver after another: they survey 32 candidates at once and
// list those that hide a part, then each lane hides samples of its own rows (scanlines/mod.rs, `look`).

@group(0) @binding(5) var<storage, read> pool: array<u32>;
@group(0) @binding(6) var<storage, read> heads: array<List>;
// Visible and (upper half) all samples of both halves; the basis' share and the variance as bits.
@group(0) @binding(7) var<storage, read_write> results: array<vec4<u32>>;
// Which result is a receiver's.
@group(0) @binding(8) var<storage, read> order: array<u32>;

const LANES = 32u;
// Receivers of a workgroup; the y of its place says which.
const RECEIVERS = 16u;
// Triangles that are listed before they hide their samples.
const KEPT = 64u;

// First words of results that are none.
const LIT = 0xffffffffu;
const HIDDEN = 0xfffffffeu;
const FOR_CPU = 0xfffffffdu;
const AGAIN = 0xfffffffcu;

// The basis' share before its pass: not a number.
const UNSEEN = 0xffffffffu;

var<workgroup> kept: array<u32, KEPT>;
// How many are listed; above, whether one hides everything, and whether a sample is visible still.
var<workgroup> tally: atomic<u32>;
const WHOLE = 0x10000u;
const VISIBLE = 0x20000u;
var<workgroup> counts: array<u32, LANES>;

var<private> turn: vec4<f32>;
var<private> drawn: bool;
// Some drivers end a loop that they think is endless: what was not looked at is told.
var<private> broken: bool;

@compute @workgroup_size(32)
fn look(@builtin(workgroup_id) workgroup: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let group = groups[task.first_group + workgroup.x];
    let list = heads[workgroup.x];
    let head = list.first;
    // The candidates, at most 32, among which is the one that hid the light from the last receiver.
    var last = vec3<u32>(0u);
    let end = min((workgroup.y + 1u) * RECEIVERS, group.count);
    for (var n = workgroup.y * RECEIVERS; n < end; n++) {
        let index = group.first + n;
        let to = order[index];
        if head == OVERFLOW || head == EXHAUSTED {
            if lane == 0u && SET == 0u {
                results[to] = vec4<u32>(select(AGAIN, FOR_CPU, head == OVERFLOW), 0u, 0u, 0u);
            }
            continue;
        }
        if SET != 0u && results[to].x >= AGAIN {
            continue;
        }
        let s = sight_of(index);
        if s.thin {
            if lane == 0u {
                results[to] = vec4<u32>(FOR_CPU, 0u, 0u, 0u);
            }
            continue;
        }
        drawn = false;
        broken = false;
        let outcome = hide(s, index, list, last, lane);
        if broken {
            if lane == 0u {
                results[to] = vec4<u32>(FOR_CPU, 0u, 0u, 0u);
            }
            continue;
        }
        if outcome.x == HIDDEN {
            last = outcome.yzw;
        }
        if outcome.x != 0u {
            if lane == 0u {
                // The basis of what is lit or hidden is, too.
                if SET == 0u {
                    results[to] = vec4<u32>(outcome.x, 0u, 0u, 0u);
                } else {
                    results[to].z = bitcast<u32>(select(0.0, 1.0, outcome.x == LIT));
                }
            }
            continue;
        }
        tell(to, lane);
    }
}

// Hides the samples: LIT or HIDDEN (with the candidates that tell) where all or none are visible for
// sure, otherwise 0.
fn hide(s: Sight, index: u32, list: List, last: vec3<u32>, lane: u32) -> vec4<u32> {
    if lane == 0u {
        atomicStore(&tally, 0u);
    }
    workgroupBarrier();
    // What hid the light from the neighbour comes first.
    if last.y > 0u {
        if lane < last.y && candidate(s, last.x + lane, last.z).whole {
            atomicOr(&tally, WHOLE);
        }
        workgroupBarrier();
        let hidden = atomicLoad(&tally) != 0u;
        workgroupBarrier();
        if hidden {
            return vec4<u32>(HIDDEN, last);
        }
    }
    var at = list.first;
    var surveyed = 0u;
    while at != NONE {
        let length = pool[at + 1u];
        for (var i = 0u; i < length; i += LANES) {
            let place = at + 2u + i;
            surveyed += min(length - i, LANES);
            if i + lane < length {
                let seen = candidate(s, place + lane, length);
                if seen.whole {
                    atomicOr(&tally, WHOLE);
                } else if seen.some {
                    kept[atomicAdd(&tally, 1u) & 0xffu] = pool[place + lane];
                }
            }
            workgroupBarrier();
            let now = atomicLoad(&tally);
            workgroupBarrier();
            if now >= WHOLE {
                return vec4<u32>(HIDDEN, place, min(length - i, LANES), length);
            }
            if now > KEPT - LANES {
                if !settle(s, index, now, lane) {
                    return vec4<u32>(0u);
                }
            }
        }
        at = pool[at];
    }
    broken = broken || surveyed != list.length;
    let rest = atomicLoad(&tally);
    workgroupBarrier();
    if rest > 0u || (s.across && !drawn) {
        settle(s, index, rest, lane);
    }
    return vec4<u32>(select(LIT, 0u, drawn), 0u, 0u, 0u);
}

// Looks at a candidate by its place in a chunk of the list: the slots, then each coordinate of all.
fn candidate(s: Sight, place: u32, length: u32) -> Seen {
    let triangle = mat3x3<f32>(
        corner(place + length, length), corner(place + 4u * length, length), corner(place + 7u * length, length),
    );
    return survey(s, pool[place], triangle);
}

fn corner(place: u32, length: u32) -> vec3<f32> {
    return bitcast<vec3<f32>>(vec3<u32>(pool[place], pool[place + length], pool[place + 2u * length]));
}

// Hides the samples behind the triangles on the list and empties it; whether any is visible still.
fn settle(s: Sight, index: u32, count: u32, lane: u32) -> bool {
    if !drawn {
        let seed = seed_of(index);
        turn = turn_of(seed);
        let ruling = ruling_of(turn, seed, lane);
        // each row
        row_ROW = drawn_row(s, ruling, STRIDES * ROWu + lane / REPLICATES);
        // end
        drawn = true;
        if s.across {
            let below = line_of(turn, -s.horizon);
            // each row
            row_ROW.hidden = under(s, below, row_ROW);
            // end
        }
    }
    for (var t = lane; t < count; t += LANES) {
        keep(s, t, kept[t]);
    }
    if lane == 0u {
        atomicStore(&tally, 0u);
    }
    workgroupBarrier();
    var t = 0u;
    while t < count {
        cover(s, t);
        t++;
    }
    broken = broken || t != count;
    var open = 0u;
    // each row
    open |= row_ROW.inside & ~row_ROW.hidden;
    // end
    if open != 0u {
        atomicOr(&tally, VISIBLE);
    }
    workgroupBarrier();
    let visible = atomicLoad(&tally) != 0u;
    workgroupBarrier();
    if lane == 0u {
        atomicStore(&tally, 0u);
    }
    workgroupBarrier();
    return visible;
}

// The samples below the horizon.
fn under(s: Sight, below: Line, row: Row) -> u32 {
    let x = below.slope * row.y + below.at;
    return between(s, row, select(vec2<f32>(-BEYOND, x), vec2<f32>(x, BEYOND), below.left));
}
