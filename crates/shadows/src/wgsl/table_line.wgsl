// One axis of a summed-area table: running sums along a line, each line by one group. A thread adds
// up a stretch of the line, learns what lies before it, and writes the stretch's running sums. Slot:
// `summand`.
@group(0) @binding(7) var destination: texture_storage_2d<rg32uint, write>;

override AXIS: u32;

const THREADS: u32 = 64u;

var<workgroup> totals: array<vec2<u32>, THREADS>;

fn texel_of(line: u32, k: u32) -> vec2<u32> {
    return select(vec2(line, k), vec2(k, line), AXIS == 0u);
}

@compute @workgroup_size(THREADS)
fn table_line(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) thread: u32) {
    // The table is square.
    let length = textureDimensions(destination).x;
    let stretch = (length + THREADS - 1u) / THREADS;
    let first = min(thread * stretch, length);
    let end = min(first + stretch, length);
    var total = vec2(0u);
    for (var k = first; k < end; k++) {
        total += summand(texel_of(group.x, k));
    }
    totals[thread] = total;
    workgroupBarrier();
    var sum = vec2(0u);
    for (var before = 0u; before < thread; before++) {
        sum += totals[before];
    }
    for (var k = first; k < end; k++) {
        let texel = texel_of(group.x, k);
        sum += summand(texel);
        textureStore(destination, texel, vec4(sum, 0u, 0u));
    }
}
