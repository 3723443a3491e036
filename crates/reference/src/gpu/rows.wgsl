// The rows of samples that one lane keeps: every fourth of one replicate (scanlines/lines.rs).

const REPLICATES = 8u;
const EXTRA = ALL_ROWS - BASE_ROWS;
const EVERY = 0xffffffffu >> (32u - PER_ROW);

struct Row {
    // Across the rows; on a cone, the cosine of the row's angle; where the samples start along it.
    y: f32,
    cosine: f32,
    shift: f32,
    inside: u32,
    hidden: u32,
    // Layers before some samples, 32 / FIELDS bits each.
    // each word
    layers_WORD: u32,
    // end word
}

// Rows are named, not numbered: loops over an array would keep it in memory. The host writes what is
// between `each row` and `end row` once for each.
// each row
var<private> row_ROW: Row;
// end row

// How rows lie on the light: x = xx x' + xy y', y = yx x' + yy y' as (xx, xy, yx, yy).
fn turn_of(seed: vec2<u32>) -> vec4<f32> {
    let word = mix(seed ^ vec2<u32>(0x7157u, 0u)).x;
    if ROUND {
        let turns = unit(word);
        let quarter = floor(4.0 * turns + 0.5);
        let at = sin_cos((turns - 0.25 * quarter) * 6.2831853);
        let quadrant = u32(quarter) & 3u;
        var sc = at;
        if (quadrant & 1u) != 0u {
            sc = vec2<f32>(at.y, -at.x);
        }
        if (quadrant & 2u) != 0u {
            sc = -sc;
        }
        return vec4<f32>(sc.y, -sc.x, sc.x, sc.y);
    }
    let rise = f32(EXTRA) / f32(BASE_ROWS);
    return vec4<f32>(1.0, 0.0, select(-rise, rise, (word & 1u) == 0u), 1.0);
}

// A receiver's seed for one set of samples.
fn seed_of(index: u32) -> vec2<u32> {
    let at = receivers[index].xyz;
    var state = task.seed;
    state = mix(state ^ vec2<u32>(at.x, 0u));
    state = mix(state ^ vec2<u32>(at.y, 0u));
    state = mix(state ^ vec2<u32>(at.z, 0u));
    return mix(state ^ vec2<u32>(SET, 0u));
}

// What the rows of a replicate share.
struct Ruling {
    across: f32,
    along: f32,
    step: f32,
    falls: bool,
    // The first row: rows that rise start below the light, rows that fall end above it.
    first: f32,
    middle: f32,
}

fn ruling_of(turn: vec4<f32>, seed: vec2<u32>, lane: u32) -> Ruling {
    let key = mix(sum(seed, vec2<u32>((lane % REPLICATES + 1u) << 8u, 0u)));
    let rest = ((key.x & 0xffu) << 8u) | (key.y & 0xffu);
    let step = STEP_LEAST + STEP_RANGE * (f32(rest) * (1.0 / 65536.0));
    let falls = turn.z < 0.0;
    let first = select(-f32(EXTRA), 0.0, ROUND || falls);
    let middle = select(select(0.5, -0.5, falls) * f32(EXTRA), 0.0, ROUND);
    return Ruling(unit(key.x), unit(key.y), step, falls, first, middle);
}

fn drawn_row(s: Sight, ruling: Ruling, j: u32) -> Row {
    var row: Row;
    let at = ruling.first + f32(j);
    // A row that leaves on one side comes back on the other: the same shift along it.
    let name = (j + select(BASE_ROWS - EXTRA, 0u, ROUND || ruling.falls)) % BASE_ROWS;
    let shift = ruling.along + f32(name) * ruling.step;
    row.shift = shift - floor(shift);
    row.y = 2.0 * (at + ruling.across + ruling.middle) / f32(BASE_ROWS) - 1.0;
    if ROUND {
        row = within(s, row);
    } else {
        row.inside = wrapped(at, ruling.across, row.shift, ruling.falls);
    }
    row.inside = select(0u, row.inside, j < ALL_ROWS);
    return row;
}

// The samples of a row that are on a round light.
fn within(s: Sight, drawn: Row) -> Row {
    var row = drawn;
    var reach2 = 1.0 - row.y * row.y;
    if CONE {
        let at = sin_cos(row.y * s.cone.x);
        let height = at.x / s.cone.y;
        row.y = at.x / (at.y * s.cone.z);
        row.cosine = at.y;
        reach2 = (1.0 - height * height) / (at.y * at.y);
    }
    let half = 0.5 * f32(PER_ROW);
    let wide = sqrt(max(reach2, 0.0)) * half;
    let centre = half - row.shift;
    row.inside = before(centre + wide) & ~before(centre - wide);
    return row;
}

// The samples of a row that are on a rectangle. Its other end has the same part, so that the two split
// their samples exactly.
fn wrapped(whole: f32, part: f32, shift: f32, falls: bool) -> u32 {
    if whole >= f32(EXTRA) && whole < f32(BASE_ROWS - EXTRA) {
        return EVERY;
    }
    // One that starts beyond an end enters, all others leave: at its first sample beyond the end.
    let enters = select((whole < 0.0), (whole >= f32(BASE_ROWS)), falls);
    let end = select(-whole, f32(BASE_ROWS) - whole, enters == falls);
    let rise = select(1.0, -1.0, falls) * f32(EXTRA);
    let bits = before((end - part) * (f32(PER_ROW) / rise) - shift);
    return select(bits, ~bits, enters) & EVERY;
}
