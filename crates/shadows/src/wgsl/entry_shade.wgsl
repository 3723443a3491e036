// The last pass of a technique: every receiver's unoccluded fraction of the light. `receiver`,
// `receiver_index` and `shade` are slots.
@group(0) @binding(5) var<storage, read_write> values: array<f32>;

@compute @workgroup_size(8, 8)
fn shade_receivers(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = receiver_index(id);
    if index >= globals.receivers {
        return;
    }
    let r = receiver(index);
    if r.seen {
        values[index] = shade(r);
    } else {
        // Nothing is seen there: fully lit, and never scored.
        values[index] = 1.0;
    }
}
