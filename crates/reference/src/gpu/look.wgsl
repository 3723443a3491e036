// 32 lanes look at the light from one receiver after another: they list edges and triangles, then each lane hides
// samples of its own rows (scanlines/look.rs).

@group(0) @binding(8) var<storage, read> queue: array<u32>;

const LANES = 32u;
// Receivers that a workgroup takes from the queue at a time.
const RECEIVERS = 4u;
// Triangles that are listed before they hide their samples: half of the edges (layers.wgsl).
const KEPT = 64u;

// The basis' share before its pass: not a number.
const UNSEEN = 0xffffffffu;

var<workgroup> sights: array<Sight, RECEIVERS>;
// Each receiver and the list of its group, with COUNTS.
var<workgroup> taken: array<vec2<u32>, RECEIVERS>;
var<workgroup> kept: array<u32, KEPT>;
// How many are listed; above, whether a sample is visible still.
var<workgroup> tally: atomic<u32>;
const VISIBLE = 0x20000u;
var<workgroup> counts: array<u32, LANES>;

// Some drivers end a loop that they think is endless: what was not looked at is told.
var<private> broken: bool;
var<private> deep: bool;

@compute @workgroup_size(32)
fn look(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let count = queue[0];
    for (var first = RECEIVERS * workgroup.x; first < count; first += RECEIVERS * workgroups.x) {
        let here = min(RECEIVERS, count - first);
        if lane < here {
            let at = 2u * (1u + first + lane);
            taken[lane] = vec2<u32>(queue[at], queue[at + 1u]);
            var s = sight_of(queue[at]);
            s.seed = seed_of(queue[at]);
            s.turn = turn_of(s.seed);
            sights[lane] = s;
        }
        workgroupBarrier();
        for (var n = 0u; n < here; n++) {
            let index = taken[n].x;
            broken = false;
            deep = false;
            let counts = (taken[n].y & COUNTS) != 0u;
            hide(standing(sights[n]), heads[taken[n].y & ~COUNTS], counts, lane);
            if broken || deep {
                if lane == 0u {
                    results[index] = vec4<u32>(select(TOO_DEEP, FOR_CPU, broken), 0u, 0u, 0u);
                }
            } else if SET == 0u || results[index].x < TOO_DEEP {
                tell(index, lane);
            }
        }
        workgroupBarrier();
    }
}

// Hides the samples behind everything on a list.
fn hide(s: Sight, list: List, counts: bool, lane: u32) {
    if lane == 0u {
        atomicStore(&tally, 0u);
        atomicStore(&throughout, 0);
        atomicStore(&deepest, 0);
    }
    draw(s, lane);
    workgroupBarrier();
    // Where no edge crosses the light nothing is before it by edges: the glance would have told.
    if counts && !count_layers(s, list, lane) {
        return;
    }
    // Triangles one by one.
    var at = list.first;
    var i = 0u;
    var surveyed = 0u;
    while at != NONE {
        var now = 0u;
        while at != NONE && now <= KEPT - LANES {
            let length = pool[at + 1u];
            if i < length {
                let place = at + 3u + i + lane;
                if i + lane < length && candidate(s, place, length).some {
                    kept[atomicAdd(&tally, 1u) & 0xffu] = pool[place] & ~CLEAR;
                }
                surveyed += min(length - i, LANES);
                i += LANES;
                workgroupBarrier();
                now = atomicLoad(&tally);
                workgroupBarrier();
            } else {
                at = pool[at];
                i = 0u;
            }
        }
        if now > 0u && !settle(s, now, lane) {
            return;
        }
    }
    broken = broken || surveyed != list.length;
}

// Looks at a candidate by its place in a chunk of the list: the slots, then each coordinate of all.
fn candidate(s: Sight, place: u32, length: u32) -> Seen {
    let triangle = mat3x3<f32>(
        corner(place + length, length), corner(place + 4u * length, length), corner(place + 7u * length, length),
    );
    return survey(s, pool[place], triangle);
}

// Hides the samples behind the triangles on the list and empties it; whether any is visible still.
fn settle(s: Sight, count: u32, lane: u32) -> bool {
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
    return any_visible(lane);
}

// Whether a sample of any lane is visible still; empties the list.
fn any_visible(lane: u32) -> bool {
    var open = 0u;
    // each row
    open |= row_ROW.inside & ~row_ROW.hidden;
    // end row
    if open != 0u {
        atomicOr(&tally, VISIBLE);
    }
    workgroupBarrier();
    let visible = (atomicLoad(&tally) & VISIBLE) != 0u;
    workgroupBarrier();
    if lane == 0u {
        atomicStore(&tally, 0u);
    }
    workgroupBarrier();
    return visible;
}

// Hides the samples that have layers before them; whether any is visible still.
fn count_layers(s: Sight, list: List, lane: u32) -> bool {
    var at = list.first;
    var i = 0u;
    var met = 0u;
    while at != NONE {
        var now = 0u;
        while at != NONE && now <= RUNS - LANES {
            let sides = pool[at + 2u];
            if i < sides {
                if i + lane < sides {
                    meet(s, at + 3u + 10u * pool[at + 1u] + i + lane, sides);
                }
                met += min(sides - i, LANES);
                i += LANES;
                workgroupBarrier();
                now = atomicLoad(&tally);
                workgroupBarrier();
            } else {
                at = pool[at];
                i = 0u;
            }
        }
        wind(s, now);
        workgroupBarrier();
        if lane == 0u {
            atomicStore(&tally, 0u);
        }
        workgroupBarrier();
    }
    broken = broken || met != list.edges;
    deep = deep || atomicLoad(&deepest) + max(atomicLoad(&throughout), 0) > MOST_LAYERS;
    hide_layered();
    return any_visible(lane);
}

// Draws the rows.
fn draw(s: Sight, lane: u32) {
    let ruling = ruling_of(s.turn, s.seed, lane);
    // each row
    row_ROW = drawn_row(s, ruling, STRIDES * ROWu + lane / REPLICATES);
    // end row
    if s.across {
        let below = line_of(s.turn, -s.horizon);
        // each row
        row_ROW.hidden = under(s, below, row_ROW);
        // end row
    }
}

// The samples below the horizon.
fn under(s: Sight, below: Line, row: Row) -> u32 {
    let x = below.slope * row.y + below.at;
    return between(s, row, select(vec2<f32>(-BEYOND, x), vec2<f32>(x, BEYOND), below.left));
}
