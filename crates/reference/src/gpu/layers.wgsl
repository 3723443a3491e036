// Layers before each sample, counted edge by edge (scanlines/edges.rs, winding.rs).

// Edges that are listed before they are counted.
const RUNS = 128u;
// A line as `x = slope y + at`, and from where to where it goes across the rows. Of a triangle on the list: two of
// its lines, and in the second half of the list another.
var<workgroup> lines: array<vec4<f32>, RUNS>;
// What an edge adds, to each sample's part of a word; a bit for each lane's row that it may touch.
var<workgroup> weights: array<vec2<u32>, RUNS>;
// Layers before all samples, and how many there may be at most.
var<workgroup> throughout: atomic<i32>;
var<workgroup> deepest: atomic<i32>;
// Samples whose layers share a word, and what each of them can hold.
const FIELD = 32u / FIELDS;
// Less than none, which only rounding makes, takes nothing from the next sample: a sixteenth of the range is below 0.
const BIAS = 1u << (FIELD - 4u);
const MOST_LAYERS = i32(15u * BIAS - 1u);
const EACH = select(0x00010001, 0x01010101, FIELDS == 4u);

// The turn's inverse, whose determinant is 1.
fn turned(turn: vec4<f32>, p: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(turn.w * p.x - turn.y * p.y, turn.x * p.y - turn.z * p.x);
}

// Layers before the light that do not depend on the sample are added up, other edges listed.
fn meet(s: Sight, place: u32, stride: u32) {
    let seen = see(s, corner(place, stride), corner(place + 3u * stride, stride), pool[place + 6u * stride]);
    let start = turned(s.turn, seen.start);
    let stop = turned(s.turn, seen.stop);
    let low = min(start.y, stop.y);
    let high = max(start.y, stop.y);
    let end = 1.0 + MARGIN;
    // Rows all lie within this.
    let rim = end + 2.0 * f32(EXTRA) / f32(BASE_ROWS);
    // On the right of the light nothing changes.
    if min(start.x, stop.x) > end || !(low < rim && high > -rim && low < high) {
        return;
    }
    let adds = select(-seen.weight, seen.weight, start.y < stop.y);
    let before_all = max(start.x, stop.x) < -end;
    if before_all && low < -rim && high > rim {
        atomicAdd(&throughout, adds);
        return;
    }
    if adds > 0 {
        atomicAdd(&deepest, adds);
    }
    let along = line_of(s.turn, seen.line);
    let at = atomicAdd(&tally, 1u);
    var run = select(vec2<f32>(along.slope, along.at), vec2<f32>(0.0, -BEYOND), before_all);
    if !CONE {
        // In samples of a row from its start.
        run = (run + vec2<f32>(0.0, 1.0)) * (0.5 * f32(PER_ROW));
    }
    lines[at] = vec4<f32>(run, low, high);
    weights[at] = vec2<u32>(bitcast<u32>(adds * EACH), touched(rows_between(s, low, high)));
}

// Adds the edges on the list to the samples on their right.
fn wind(s: Sight, count: u32) {
    var t = 0u;
    while t < count {
        let run = lines[t];
        let weight = weights[t];
        // each row
        if (weight.y & (1u << ROWu)) != 0u {
            let first = first_after(s, row_ROW, run);
            // each word
            row_ROW.layers_WORD += added(weight.x, first, WORDu);
            // end word
        }
        // end row
        t++;
    }
    broken = broken || t != count;
}

// The first sample of a row on the right of an edge; beyond all where the row passes it by.
fn first_after(s: Sight, row: Row, run: vec4<f32>) -> u32 {
    var x = run.x * row.y + run.y;
    if CONE {
        x = (along_cone(s, x, row.cosine) + 1.0) * (0.5 * f32(PER_ROW));
    }
    let first = u32(ceil(clamp(x - row.shift, 0.0, f32(PER_ROW))));
    return select(PER_ROW, first, run.z <= row.y && row.y < run.w);
}

fn added(weight: u32, first: u32, word: u32) -> u32 {
    let past = max(first, FIELDS * word) - FIELDS * word;
    return select(weight << ((FIELD * past) & 31u), 0u, past >= FIELDS);
}

// A bit for each sample's part of a word that has layers.
fn layered(sums: u32) -> u32 {
    let none = BIAS * u32(EACH);
    let word = (sums + none) ^ none;
    if FIELDS == 2u {
        return select(0u, 1u, (word & 0xffffu) != 0u) | select(0u, 2u, (word >> 16u) != 0u);
    }
    let high = (((word & 0x7f7f7f7fu) + 0x7f7f7f7fu) | word) & 0x80808080u;
    return ((high >> 7u) * 0x10204080u) >> 28u;
}

// Hides the samples that have a layer before them.
fn hide_layered() {
    let all = bitcast<u32>(atomicLoad(&throughout) * EACH);
    // each row
    // each word
    row_ROW.hidden |= layered(row_ROW.layers_WORD + all) << (FIELDS * WORDu);
    // end word
    // end row
}
