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
    // end row
    counts[lane] = count;
    workgroupBarrier();
    // Of the lane's replicate, then of each half.
    let k = lane % REPLICATES;
    let here = counts[k] + counts[k + 8u] + counts[k + 16u] + counts[k + 24u];
    workgroupBarrier();
    counts[lane] = here;
    workgroupBarrier();
    let halves = vec2<u32>(
        counts[0] + counts[1] + counts[2] + counts[3], counts[4] + counts[5] + counts[6] + counts[7],
    );
    workgroupBarrier();
    let visible = (halves.x & 0xffffu) + (halves.y & 0xffffu);
    let inside = (halves.x >> 16u) + (halves.y >> 16u);
    // The variance of a ratio: the residuals of each replicate against the common share, whole numbers below 2^31
    // (Cochran 1977, 6.4).
    let all = f32(max(inside, 1u));
    let residual = f32(i32((here & 0xffffu) * inside) - i32(visible * (here >> 16u))) / all;
    counts[lane] = bitcast<u32>(residual * residual);
    workgroupBarrier();
    if lane == 0u {
        if SET != 0u {
            // Of twice what a half holds: shares, not counts, matter.
            results[to].z = bitcast<u32>(f32(visible) / all);
        } else {
            let replicates = f32(REPLICATES);
            let average = all / replicates;
            let variance = squares() / (replicates * (replicates - 1.0) * max(average * average, 1.0));
            // No share yet: what a lost pass leaves is no number.
            results[to] = vec4<u32>(halves, UNSEEN, bitcast<u32>(variance));
        }
    }
    workgroupBarrier();
}

// Of all replicates.
fn squares() -> f32 {
    var sum = 0.0;
    for (var k = 0u; k < REPLICATES; k++) {
        sum += bitcast<f32>(counts[k]);
    }
    return sum;
}
