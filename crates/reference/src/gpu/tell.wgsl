// What the samples of a receiver's rows say.

// Visible samples, and in the upper half all.
fn counted(row: Row) -> u32 {
    return countOneBits(row.inside & ~row.hidden) + (countOneBits(row.inside) << 16u);
}

// Counts the samples and writes what they say.
fn tell(to: u32, lane: u32) {
    var count = 0u;
    // each row
    count += counted(row_ROW);
    // end
    counts[lane] = count;
    workgroupBarrier();
    if lane == 0u {
        var halves = vec2<u32>(0u);
        for (var k = 0u; k < REPLICATES; k++) {
            let all = counts[k] + counts[k + 8u] + counts[k + 16u] + counts[k + 24u];
            counts[k] = all;
            halves[k / 4u] += all;
        }
        let visible = (halves.x & 0xffffu) + (halves.y & 0xffffu);
        let inside = (halves.x >> 16u) + (halves.y >> 16u);
        if SET != 0u {
            // Of twice what a half holds: shares, not counts, matter.
            results[to].z = bitcast<u32>(f32(visible) / f32(max(inside, 1u)));
        } else {
            // No share yet: what a lost pass leaves is no number.
            results[to] = vec4<u32>(halves, UNSEEN, bitcast<u32>(variance(visible, inside)));
        }
    }
    workgroupBarrier();
}

// Of a ratio: the residuals of each replicate against the common share, whole numbers below 2^31
// (Cochran 1977, 6.4).
fn variance(visible: u32, inside: u32) -> f32 {
    var squares = 0.0;
    let all = f32(max(inside, 1u));
    for (var k = 0u; k < REPLICATES; k++) {
        let here = counts[k];
        let residual = f32(i32((here & 0xffffu) * inside) - i32(visible * (here >> 16u))) / all;
        squares += residual * residual;
    }
    let count = f32(REPLICATES);
    let average = all / count;
    return squares / (count * (count - 1.0) * max(average * average, 1.0));
}
