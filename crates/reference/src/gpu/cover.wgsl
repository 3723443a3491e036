// A triangle on the rows (scanlines/blocks.rs `sides`, outline.rs `cover`).

// A fourth line, as the third: slope, place, and beyond all rows on the side that it does not bound. (`lines` holds
// the lines on the left and on the right of the inside, slope and place of each, and the third.)
var<workgroup> kept_fourth: array<vec3<f32>, KEPT>;
// One over the depth of the triangle's plane.
var<workgroup> kept_form: array<vec3<f32>, KEPT>;
// A bit for each lane's row that it may touch, of which there are 32 at most; and what else there is.
var<workgroup> kept_rows: array<u32, KEPT>;
var<workgroup> kept_more: array<u32, KEPT>;
const WITH_FOURTH = 1u;
const WITH_FORM = 2u;

fn third(line: Line) -> vec3<f32> {
    return vec3<f32>(line.slope, line.at, select(-BEYOND, BEYOND, line.left));
}

fn keep(s: Sight, t: u32, slot: u32) {
    // What is on the list has been found to count.
    let seen = survey(s, slot | CLEAR, corners_of(slot));
    let a = line_of(s.turn, seen.edges[0]);
    let b = line_of(s.turn, seen.edges[1]);
    let c = line_of(s.turn, seen.edges[2]);
    let span = rows_of(s, seen, s.turn);
    var more = 0u;
    let plane = seen.edges[0] + seen.edges[1] + seen.edges[2];
    // One line on each side, and a third; all three on one side where it reaches behind the receiver.
    if a.left == b.left && b.left == c.left {
        lines[t] = vec4<f32>(
            select(vec2<f32>(0.0, -BEYOND), vec2<f32>(a.slope, a.at), a.left),
            select(vec2<f32>(a.slope, a.at), vec2<f32>(0.0, BEYOND), a.left),
        );
        lines[KEPT + t] = vec4<f32>(third(b), 0.0);
        kept_fourth[t] = third(c);
        more |= WITH_FOURTH;
        if seen.straddles {
            more |= WITH_FORM;
        }
    } else {
        var left = a;
        var right = b;
        var other = c;
        if a.left == b.left {
            right = c;
            other = b;
            if !a.left {
                left = c;
                right = a;
            }
        } else if !a.left {
            left = b;
            right = a;
        }
        lines[t] = vec4<f32>(left.slope, left.at, right.slope, right.at);
        lines[KEPT + t] = vec4<f32>(third(other), 0.0);
        if seen.straddles && FLAT {
            kept_fourth[t] = third(line_of(s.turn, vec3<f32>(plane.xy, plane.z - seen.volume / s.near)));
            more |= WITH_FOURTH;
        } else if seen.straddles {
            more |= WITH_FORM;
        }
    }
    kept_form[t] = plane / seen.volume;
    kept_rows[t] = touched(span);
    kept_more[t] = more;
}

// Hides what is inside one of the triangles on the list.
fn cover(s: Sight, t: u32) {
    let rows = kept_rows[t];
    let more = kept_more[t];
    let sides = lines[t];
    let bound = lines[KEPT + t].xyz;
    // each row
    if (rows & (1u << ROWu)) != 0u {
        row_ROW.hidden |= covered(s, t, more, sides, bound, row_ROW);
    }
    // end row
}

// A bit for each number of a lane's row, of which there are STRIDES side by side, between two rows.
fn touched(rows: vec2<u32>) -> u32 {
    let first = rows.x / STRIDES;
    let last = (max(rows.y, rows.x) + STRIDES - 1u) / STRIDES;
    return low_bits(last) & ~low_bits(first);
}

fn covered(s: Sight, t: u32, more: u32, sides: vec4<f32>, bound: vec3<f32>, row: Row) -> u32 {
    let x = bound.x * row.y + bound.y;
    var places = vec2<f32>(
        max(sides.x * row.y + sides.y, min(x, bound.z)),
        min(sides.z * row.y + sides.w, max(x, bound.z)),
    );
    if (more & WITH_FOURTH) != 0u {
        let fourth = kept_fourth[t];
        let x = fourth.x * row.y + fourth.y;
        places = vec2<f32>(max(places.x, min(x, fourth.z)), min(places.y, max(x, fourth.z)));
    }
    var bits = between(s, row, places);
    if KIND != SUN && (more & WITH_FORM) != 0u {
        bits = nearer(s, s.turn, row, kept_form[t], bits);
    }
    return bits;
}
